/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge.h over hours: nothing saturates, loses precision or is forgotten.
#include "hinge_fixture.h"

#include "math/sym.h"

enum { HOUR = 90000 }; /* samples at 25 Hz */

/* Builds with sanitizers or counters take thirty times as long; they look at the same code for fewer hours. */
#ifdef NDEBUG
enum { MOTION_HOURS = 3, NIGHT_HOURS = 8, HALVINGS_MIN = 2 };
#else
enum { MOTION_HOURS = 1, NIGHT_HOURS = 2, HALVINGS_MIN = 1 };
#endif

/* Largest sums that may occur: the limits in hinge.c, 5e7 of information and 2e4 of accelerometer weight, and what one
   sample can add. */
static const float INFORMATION_LIMIT = 5.001e7f;
static const float ACC_LIMIT = 2.001e4f;

static void assert_bounded(const jcal_hinge_t *self)
{
    TEST_ASSERT_TRUE(self->evidence.axis1.information_all + self->evidence.axis2.information_all < INFORMATION_LIMIT);
    TEST_ASSERT_TRUE(self->moments.acc[jcal_sym_at(6, 6)] < ACC_LIMIT);
    for (size_t k = 0; k < JCAL_SYM_SIZE(19u); ++k) {
        TEST_ASSERT_TRUE(isfinite(self->moments.gyr[k]));
    }
}

static void hours_of_motion_keep_the_sums_bounded_and_the_axes_right(void)
{
    motion_t motion = motion_lively(3);
    motion.rate_hz = 25.0;
    motion.speed = 2.0; /* brisk: the sums are halved several times in three hours */
    uint32_t halvings = 0;
    float before = 0.0f;
    for (uint32_t k = 0; k < (uint32_t)(MOTION_HOURS * HOUR); ++k) {
        run(&engine, &motion, k, k + 1);
        const float now = engine.evidence.axis1.information_all;
        halvings += (now < 0.75f * before) ? 1u : 0u;
        before = now;
        if (k % 1000u == 999u) {
            const jcal_hinge_result_t r = result_of(&engine);
            assert_bounded(&engine);
            assert_sane(&r);
            assert_axes(&r, &motion);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, r.status);
        }
    }
    TEST_ASSERT_TRUE(halvings >= (uint32_t)HALVINGS_MIN);
    TEST_ASSERT_EQUAL_UINT32(MOTION_HOURS * HOUR, result_of(&engine).samples);
}

static void accelerometer_sums_are_bounded_too(void)
{
    /* Slow turning about changing directions: no gyroscope information, but every pose is new. */
    motion_t motion = motion_lively(5);
    motion.rate_hz = 25.0;
    motion.speed = 0.3;
    motion.joint_speed = 0.3;
    config.acc_noise_m_s2 = 0.1f; /* weighs the accelerometers 200 times more than usual: hours pass in a minute */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
    uint32_t halvings = 0;
    float before = 0.0f;
    for (uint32_t k = 0; k < HOUR; ++k) {
        run(&engine, &motion, k, k + 1);
        const float now = engine.moments.acc[jcal_sym_at(6, 6)];
        halvings += (now < 0.75f * before) ? 1u : 0u;
        before = now;
        TEST_ASSERT_TRUE(now < ACC_LIMIT);
    }
    const jcal_hinge_result_t r = result_of(&engine);
    assert_axes(&r, &motion);
    TEST_ASSERT_TRUE(halvings >= 1u);
}

static void rest_for(double hours, double gyr_noise_rad_s)
{
    motion_t motion = motion_lively(4);
    motion.rate_hz = 25.0;
    run(&engine, &motion, 0, 1000);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).status);
    motion_t rest = motion;
    rest.speed = 0.0;
    rest.joint_speed = 0.0;
    rest.gyr_noise_rad_s = gyr_noise_rad_s;
    const uint32_t end = 1000u + (uint32_t)(hours * HOUR);
    run(&engine, &rest, 1000, end);
    const jcal_hinge_result_t r = result_of(&engine);
    assert_axes(&r, &motion);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.status);
    assert_bounded(&engine);
    run(&engine, &motion, end, end + 1000u);
    const jcal_hinge_result_t after = result_of(&engine);
    assert_axes(&after, &motion);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, after.status);
}

static void after_an_hour_of_rest_the_calibration_is_still_there(void)
{
    rest_for(1.0, 0.01);
}

static void after_a_night_of_rest_the_calibration_is_still_there(void)
{
    rest_for((double)NIGHT_HOURS, 0.003);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(hours_of_motion_keep_the_sums_bounded_and_the_axes_right);
    RUN_TEST(accelerometer_sums_are_bounded_too);
    RUN_TEST(after_an_hour_of_rest_the_calibration_is_still_there);
    RUN_TEST(after_a_night_of_rest_the_calibration_is_still_there);
    return UNITY_END();
}
