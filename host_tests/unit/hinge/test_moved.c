/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of `moved` of the hinge: slips are noticed, and what is none is not taken for one.
#include "unit/hinge/fixture.h"

#if defined(JCAL_TEST_SHORT)
enum { SLIPS = 1, REST = 1500 };
#else
enum { SLIPS = 4, REST = 30000 };
#endif
enum { SOON = 250 }; /* samples: 5 s */

/* A quaternion that turns by an angle about a unit vector. */
static jcal_quat_t turn_about(jcal_vec3_t axis, double angle)
{
    const float s = (float)sin(0.5 * angle);
    return jcal_quat((float)cos(0.5 * angle), s * axis.x, s * axis.y, s * axis.z);
}

/* The same motion with a sensor (0, 1) that has been turned about a vector of its own frame. */
static motion_t slipped(const motion_t *motion, int sensor, jcal_vec3_t about, double angle)
{
    motion_t after = *motion;
    jcal_quat_t *const q = (sensor == 0) ? &after.q_s1_a : &after.q_s2_b;
    *q = jcal_quat_mul(*q, turn_about(about, angle));
    return after;
}

/* A unit vector across the axis of a sensor. */
static jcal_vec3_t across(const motion_t *motion, int sensor)
{
    const jcal_vec3_t j = motion_axis(motion, sensor);
    const jcal_vec3_t some = (fabsf(j.x) < 0.6f) ? jcal_vec3(1.0f, 0.0f, 0.0f) : jcal_vec3(0.0f, 1.0f, 0.0f);
    const jcal_vec3_t side = jcal_vec3_cross(j, some);
    return jcal_vec3_scale(side, 1.0f / jcal_vec3_norm(side));
}

/* Samples from `begin` on until the status is `wanted`; `end` if it never is. */
static uint32_t until(const motion_t *motion, uint32_t begin, uint32_t end, jcal_calibration_t wanted)
{
    for (uint32_t k = begin; k < end; ++k) {
        run(&engine, motion, k, k + 1u);
        if (result_of(&engine).head.status == wanted) {
            return k;
        }
    }
    return end;
}

/* An engine that is ready, on this motion. */
static void get_ready(const motion_t *motion)
{
    setUp();
    run(&engine, motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
}

static void a_slip_is_noticed_and_the_new_axes_are_found(void)
{
    static const double angles[] = {10.0, 20.0, 45.0, 90.0};
    for (int i = 0; i < SLIPS; ++i) {
        for (int sensor = 0; sensor < 2; ++sensor) {
            const motion_t motion = motion_lively((uint32_t)(i + sensor));
            get_ready(&motion);
            const motion_t after =
                slipped(&motion, sensor, across(&motion, sensor), angles[i] * (double)JCAL_RAD_PER_DEG);
            const uint32_t noticed = until(&after, RUN, RUN + SOON, JCAL_MOVED);
            TEST_ASSERT_TRUE(noticed < (RUN + SOON));
            TEST_ASSERT_TRUE(until(&after, noticed + 1u, noticed + (2u * RUN), JCAL_READY) < (noticed + (2u * RUN)));
            const jcal_hinge_result_t r = result_of(&engine);
            TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis1, motion_axis(&after, 0)) < r.uncertainty1_rad);
            TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis2, motion_axis(&after, 1)) < r.uncertainty2_rad);
        }
    }
}

/* Residuals as large as those of skin: their power alone would not show so small a slip. */
static void a_small_slip_behind_noise_is_noticed_too(void)
{
    for (int sensor = 0; sensor < 2; ++sensor) {
        motion_t motion = motion_lively(1);
        motion.gyr_noise_rad_s = 0.06;
        setUp();
        run(&engine, &motion, 0, 3u * RUN);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
        const motion_t after = slipped(&motion, sensor, across(&motion, sensor), 9.0 * (double)JCAL_RAD_PER_DEG);
        TEST_ASSERT_TRUE(until(&after, 3u * RUN, (3u * RUN) + SOON, JCAL_MOVED) < ((3u * RUN) + SOON));
    }
}

static void a_turn_about_the_axis_changes_nothing(void)
{
    const motion_t motion = motion_lively(2);
    get_ready(&motion);
    const motion_t after = slipped(&motion, 1, motion_axis(&motion, 1), 0.7);
    TEST_ASSERT_EQUAL_UINT32(2u * RUN, until(&after, RUN, 2u * RUN, JCAL_MOVED));
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
}

static void livelier_and_noisier_motion_is_no_slip(void)
{
    motion_t motion = motion_lively(3);
    motion.speed = 0.4;
    motion.joint_speed = 0.5;
    setUp();
    run(&engine, &motion, 0, 2u * RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    motion.speed = 2.0;
    motion.joint_speed = 2.0;
    motion.gyr_noise_rad_s = 0.04;
    TEST_ASSERT_EQUAL_UINT32(3u * RUN, until(&motion, 2u * RUN, 3u * RUN, JCAL_MOVED));
}

static void rest_and_a_stiff_joint_are_no_slip(void)
{
    const motion_t motion = motion_lively(1);
    get_ready(&motion);
    motion_t other = motion;
    other.joint_speed = 0.0;
    TEST_ASSERT_EQUAL_UINT32(RUN + REST, until(&other, RUN, RUN + REST, JCAL_MOVED));
    other.speed = 0.0;
    TEST_ASSERT_EQUAL_UINT32(RUN + (2u * REST), until(&other, RUN + REST, RUN + (2u * REST), JCAL_MOVED));
    TEST_ASSERT_EQUAL_UINT32((2u * RUN) + (2u * REST),
                             until(&motion, RUN + (2u * REST), (2u * RUN) + (2u * REST), JCAL_MOVED));
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
}

/* The accelerometers' residual follows the motion; however much it is made to weigh, it is no slip. */
static void accelerometers_that_weigh_much_are_no_slip(void)
{
    motion_t motion = motion_lively(5);
    motion.rate_hz = 25.0;
    motion.speed = 0.3;
    motion.joint_speed = 0.3;
    config.acc_noise_m_s2 = 0.05f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
    const uint32_t ready = until(&motion, 0, RUN, JCAL_READY);
    TEST_ASSERT_TRUE(ready < RUN);
    TEST_ASSERT_EQUAL_UINT32(3u * RUN, until(&motion, ready + 1u, 3u * RUN, JCAL_MOVED));
}

static void a_knock_is_no_slip(void)
{
    const motion_t motion = motion_lively(2);
    get_ready(&motion);
    for (uint32_t k = RUN; k < 2u * RUN; ++k) {
        jcal_pair_t pair = motion_sample(&motion, k);
        if ((k % 250u) < 8u) { /* one sensor rattles for 0.16 s, every 5 s */
            pair.imu2.gyr_rad_s.x += ((k % 2u) == 0u) ? 1.5f : -1.2f;
            pair.imu2.gyr_rad_s.z -= ((k % 3u) == 0u) ? 1.0f : -0.5f;
        }
        (void)jcal_hinge_update(&engine, &pair);
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_MOVED, result_of(&engine).head.status);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_slip_is_noticed_and_the_new_axes_are_found);
    RUN_TEST(a_small_slip_behind_noise_is_noticed_too);
    RUN_TEST(a_turn_about_the_axis_changes_nothing);
    RUN_TEST(livelier_and_noisier_motion_is_no_slip);
    RUN_TEST(rest_and_a_stiff_joint_are_no_slip);
    RUN_TEST(accelerometers_that_weigh_much_are_no_slip);
    RUN_TEST(a_knock_is_no_slip);
    return UNITY_END();
}
