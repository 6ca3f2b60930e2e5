/* SPDX-License-Identifier: MIT */
/* Tests of lib/hinge/smooth.c: what passes of a sine, at any rate of samples, and where it begins. */
#include "hinge/smooth.h"
#include "hinge/stream.h"
#include "unity.h"

#include <math.h>

static const double PI = 3.14159265358979;

static jcal_hinge_smooth_t smooth;

void setUp(void)
{
}

void tearDown(void)
{
}

static jcal_pair_t pair_of(double t_s, double hz)
{
    const float s = (float)sin(2.0 * PI * hz * t_s);
    jcal_pair_t pair = {0};
    pair.imu1.gyr_rad_s = (jcal_vec3_t){s, 2.0f * s, 1.0f};
    pair.imu2.gyr_rad_s = (jcal_vec3_t){-s, 0.5f, 3.0f * s};
    pair.imu1.acc_m_s2 = (jcal_vec3_t){s, -s, 9.81f};
    pair.imu2.acc_m_s2 = (jcal_vec3_t){2.0f * s, s, -9.81f};
    return pair;
}

/* Largest value of a sine of `hz` behind the low-pass, once it has settled; checks what must not change on the way. */
static double passes(double hz, double rate_hz)
{
    double most = 0.0;
    jcal_pair_t pair = pair_of(0.0, hz);
    jcal_hinge_smooth_begin(&smooth, &pair);
    for (int k = 1; k < (int)(4.0 * rate_hz); ++k) {
        pair = pair_of((double)k / rate_hz, hz);
        const jcal_pair_t out = jcal_hinge_smooth(&smooth, &pair, (float)(1.0 / rate_hz));
        TEST_ASSERT_EQUAL_MEMORY(&pair.imu1.acc_m_s2, &out.imu1.acc_m_s2, sizeof pair.imu1.acc_m_s2);
        TEST_ASSERT_EQUAL_MEMORY(&pair.imu2.acc_m_s2, &out.imu2.acc_m_s2, sizeof pair.imu2.acc_m_s2);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, out.imu1.gyr_rad_s.z); /* what is constant stays */
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.5f, out.imu2.gyr_rad_s.y);
        /* All components by the same filter: what the sensors share is delayed alike. */
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, 2.0f * out.imu1.gyr_rad_s.x, out.imu1.gyr_rad_s.y);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, -3.0f * out.imu2.gyr_rad_s.x, out.imu2.gyr_rad_s.z);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, -out.imu1.gyr_rad_s.x, out.imu2.gyr_rad_s.x);
        if (k > (int)(2.0 * rate_hz)) {
            most = fmax(most, fabs((double)out.imu1.gyr_rad_s.x));
        }
    }
    return most;
}

/* Two first-order low-passes of time constant T leave 1 / (1 + (2 pi f T)^2) of the amplitude, and half the power at 5 Hz. */
static void a_sine_is_left_as_two_first_order_low_passes_leave_it(void)
{
    const double time_s = sqrt(sqrt(2.0) - 1.0) / (2.0 * PI * 5.0);
    const double frequencies_hz[] = {0.5, 1.0, 3.0, 5.0, 12.0, 33.0};
    for (int i = 0; i < 6; ++i) {
        const double hz = frequencies_hz[i];
        const double x = 2.0 * PI * hz * time_s;
        TEST_ASSERT_FLOAT_WITHIN(0.01f, (float)(1.0 / (1.0 + (x * x))), (float)passes(hz, 1000.0));
    }
    TEST_ASSERT_FLOAT_WITHIN(0.01f, sqrtf(0.5f), (float)passes(5.0, 1000.0));
}

static void at_slower_rates_about_as_much_is_left(void)
{
    const double reference = passes(3.0, 1000.0);
    const double rates_hz[] = {400.0, 100.0, 50.0, 25.0};
    for (int i = 0; i < 4; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(0.1f * (float)reference, (float)reference, (float)passes(3.0, rates_hz[i]));
    }
    TEST_ASSERT_TRUE(passes(33.0, 100.0) < 0.08);
}

static void a_gap_and_the_first_pair_begin_anew(void)
{
    jcal_hinge_t engine;
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
    jcal_pair_t pair = pair_of(0.1, 1.0);
    const uint64_t steps_us[4] = {1000000u, 10000u, 104000u, 106000u}; /* a gap is longer than 105 ms */
    for (int i = 0; i < 4; ++i) {
        const jcal_vec3_t before = engine.smooth.whole[0];
        pair.t_us += steps_us[i];
        pair.imu1.gyr_rad_s.x += 1.0f;
        jcal_hinge_take(&engine, &pair);
        const bool anew = (i == 0) || (i == 3);
        TEST_ASSERT_TRUE((engine.smooth.whole[0].x == pair.imu1.gyr_rad_s.x) == anew);
        TEST_ASSERT_TRUE((i == 0) || (engine.smooth.whole[0].x > before.x));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_sine_is_left_as_two_first_order_low_passes_leave_it);
    RUN_TEST(at_slower_rates_about_as_much_is_left);
    RUN_TEST(a_gap_and_the_first_pair_begin_anew);
    return UNITY_END();
}
