/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge.h over hours: nothing saturates, loses precision or is forgotten.
#include "unit/hinge/fixture.h"

#include "math/sym.h"

enum { HOUR = 90000 }; /* samples at 25 Hz */

/* Builds with sanitizers or counters take thirty times as long; they look at the same code for fewer hours. Emulated targets
   (JCAL_TEST_SHORT), which may have no FPU, take longer still: a quarter of an hour holds several halvings of the sums of
   motion, and one of the accelerometers', which then weigh four times more; ten minutes of rest saturate what rest adds. */
#if defined(JCAL_TEST_SHORT)
static const double MOTION_HOURS = 0.25;
static const double POSES_HOURS = 0.25;
static const double REST_HOURS = 0.17;
static const double NIGHT_HOURS = 0.17;
static const float POSES_ACC_NOISE_M_S2 = 0.05f;
#else
#if defined(NDEBUG)
static const double MOTION_HOURS = 3.0;
static const double NIGHT_HOURS = 8.0;
#else
static const double MOTION_HOURS = 1.0;
static const double NIGHT_HOURS = 2.0;
#endif
static const double POSES_HOURS = 1.0;
static const double REST_HOURS = 1.0;
static const float POSES_ACC_NOISE_M_S2 = 0.1f; /* weighs the accelerometers 200 times more than usual */
#endif

/* Largest sums that may occur: the limits in hinge/stream.c, 3600 rad^2/s of motion and 2e4 of accelerometer weight, and what
   one sample can add. */
static const float MOTION_LIMIT = 3610.0f;
static const float ACC_LIMIT = 2.001e4f;

static void assert_all_finite(const float *sums, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        TEST_ASSERT_TRUE(isfinite(sums[k]));
    }
}

static void assert_bounded(const jcal_hinge_t *self)
{
    TEST_ASSERT_TRUE(self->amount.motion < MOTION_LIMIT);
    TEST_ASSERT_TRUE(self->coarse.moments.acc[jcal_sym_at(6, 6)] < ACC_LIMIT);
    assert_all_finite(self->coarse.moments.gyr, sizeof self->coarse.moments.gyr / sizeof(float));
    assert_all_finite(self->coarse.moments.acc, sizeof self->coarse.moments.acc / sizeof(float));
    assert_all_finite(self->refine.matrix, sizeof self->refine.matrix / sizeof(float));
    assert_all_finite(self->refine.scatter, sizeof self->refine.scatter / sizeof(float));
    assert_all_finite(self->refine.bias, 4u);
}

static void hours_of_motion_keep_the_sums_bounded_and_the_axes_right(void)
{
    motion_t motion = motion_lively(3);
    motion.rate_hz = 25.0;
    motion.speed = 2.0;
    const uint32_t samples = (uint32_t)(MOTION_HOURS * HOUR);
    double squares = 0.0; /* integral of the squared rates, rad^2/s */
    uint32_t halvings = 0;
    float before = 0.0f;
    for (uint32_t k = 0; k < samples; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        squares += 0.04 * (double)(jcal_vec3_dot(pair.imu1.gyr_rad_s, pair.imu1.gyr_rad_s) +
                                   jcal_vec3_dot(pair.imu2.gyr_rad_s, pair.imu2.gyr_rad_s));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        const float now = engine.amount.motion;
        halvings += (now < 0.75f * before) ? 1u : 0u;
        before = now;
        if (k % 1000u == 999u) {
            const jcal_hinge_result_t r = result_of(&engine);
            assert_bounded(&engine);
            assert_sane(&r);
            assert_axes(&r, &motion);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
        }
    }
    /* Halved at 3600, and again each time that 1800 have come in; the last may still be on the way. */
    TEST_ASSERT_TRUE(squares > 1e4);
    TEST_ASSERT_TRUE((double)halvings >= floor((squares / 1800.0) - 2.0));
    TEST_ASSERT_EQUAL_UINT32(samples, result_of(&engine).head.samples);
}

static void accelerometer_sums_are_bounded_too(void)
{
    /* Slow turning about changing directions: no gyroscope information, but every pose is new. */
    motion_t motion = motion_lively(5);
    motion.rate_hz = 25.0;
    motion.speed = 0.3;
    motion.joint_speed = 0.3;
    config.acc_noise_m_s2 = POSES_ACC_NOISE_M_S2; /* hours pass in a minute */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
    const uint32_t samples = (uint32_t)(POSES_HOURS * HOUR);
    uint32_t halvings = 0;
    float before = 0.0f;
    for (uint32_t k = 0; k < samples; ++k) {
        run(&engine, &motion, k, k + 1);
        const float now = engine.coarse.moments.acc[jcal_sym_at(6, 6)];
        halvings += (now < 0.75f * before) ? 1u : 0u;
        before = now;
        TEST_ASSERT_TRUE(now < ACC_LIMIT);
    }
    const jcal_hinge_result_t r = result_of(&engine);
    assert_axes(&r, &motion);
    TEST_ASSERT_TRUE(halvings >= 1u);
}

/* Both true axes within the bounds that go with them, the pairing being right. */
static void assert_within_bounds(const jcal_hinge_result_t *r, const motion_t *motion)
{
    const jcal_vec3_t truth1 = motion_axis(motion, 0);
    const jcal_vec3_t truth2 = motion_axis(motion, 1);
    const float sign = (jcal_vec3_dot(r->axis1, truth1) < 0.0f) ? -1.0f : 1.0f;
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(r->axis1, sign), truth1) <= r->uncertainty1_rad);
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(r->axis2, sign), truth2) <= r->uncertainty2_rad);
}

/* Rest with this noise of the two gyroscopes, after 40 s of motion: at every moment of it the calibration holds. */
static void rest_for(uint32_t mounting, double hours, double noise1_rad_s, double noise2_rad_s)
{
    motion_t motion = motion_lively(mounting);
    motion.rate_hz = 25.0;
    run(&engine, &motion, 0, 1000);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    motion_t rest = motion;
    rest.speed = 0.0;
    rest.joint_speed = 0.0;
    rest.gyr_noise_rad_s = noise1_rad_s;
    rest.gyr_noise2_rad_s = noise2_rad_s;
    const uint32_t end = 1000u + (uint32_t)(hours * HOUR);
    for (uint32_t k = 1000; k < end; ++k) {
        run(&engine, &rest, k, k + 1);
        const jcal_hinge_result_t r = result_of(&engine);
        assert_within_bounds(&r, &motion);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    }
    const jcal_hinge_result_t r = result_of(&engine);
    assert_sane(&r);
    assert_axes(&r, &motion);
    assert_bounded(&engine);
    run(&engine, &motion, end, end + 1000u);
    const jcal_hinge_result_t after = result_of(&engine);
    assert_axes(&after, &motion);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, after.head.status);
}

static void after_an_hour_of_rest_the_calibration_is_still_there(void)
{
    rest_for(4, REST_HOURS, 0.01, 0.01);
}

static void after_a_night_of_rest_the_calibration_is_still_there(void)
{
    rest_for(4, NIGHT_HOURS, 0.003, 0.003);
}

/* The squared noise of a rate does not average out: with unequal noise it pulls at the axes for as long as it counts. */
static void after_a_night_of_rest_with_a_noisy_sensor_1_the_calibration_is_still_there(void)
{
    rest_for(1, NIGHT_HOURS, 0.03, 0.003);
}

static void after_a_night_of_rest_with_a_noisy_sensor_2_the_calibration_is_still_there(void)
{
    rest_for(1, NIGHT_HOURS, 0.003, 0.03);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(hours_of_motion_keep_the_sums_bounded_and_the_axes_right);
    RUN_TEST(accelerometer_sums_are_bounded_too);
    RUN_TEST(after_an_hour_of_rest_the_calibration_is_still_there);
    RUN_TEST(after_a_night_of_rest_the_calibration_is_still_there);
    RUN_TEST(after_a_night_of_rest_with_a_noisy_sensor_1_the_calibration_is_still_there);
    RUN_TEST(after_a_night_of_rest_with_a_noisy_sensor_2_the_calibration_is_still_there);
    return UNITY_END();
}
