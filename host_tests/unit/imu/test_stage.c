/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/sensor.h: times, gaps, what is refused, the level of the specific force.
#include "jointcal/sensor.h"

#include "jointcal/quat.h"
#include "jointcal/vec3.h"
#include "unit/imu/motion.h"

#include "unity.h"

#include <stdlib.h>

enum { DT_US = 10000 };

static const motion_mount_t MOUNT = {{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, {0.05, -0.1, 0.08}, 0.0};

void setUp(void)
{
}

void tearDown(void)
{
}

static motion_t lively(void)
{
    return motion_begin(1.5, 2.0, 1.0);
}

static jcal_reading_t reading_at(motion_t *motion, uint64_t begin_us, uint64_t since_us)
{
    double gyr[3];
    double acc[3];
    double turn[9];
    motion_to(motion, (double)since_us * 1e-6);
    motion_read(motion, &MOUNT, gyr, acc, turn);
    return to_reading(begin_us + since_us, gyr, acc);
}

static void start(jcal_sensor_t *sensor)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_sensor_init(sensor));
}

/* The multiple of the samples' distance that is nearest to 50 ms; the lower one if two are. */
static void ticks_are_the_multiple_of_the_samples_that_is_nearest_to_50_ms(void)
{
    static const uint32_t dt_us[] = {1000,  2500,  5000,  7813,  10000, 16667, 20000, 25000,
                                     31000, 33333, 34000, 40000, 50000, 70000, 100000};
    static const uint32_t tick_us[] = {50000, 50000, 50000, 46878, 50000, 50001, 40000, 50000,
                                       62000, 66666, 34000, 40000, 50000, 70000, 100000};
    for (size_t n = 0; n < sizeof(dt_us) / sizeof(dt_us[0]); ++n) {
        jcal_sensor_t sensor;
        start(&sensor);
        motion_t motion = lively();
        uint64_t last_us = 1000;
        TEST_ASSERT_NULL(jcal_sensor_tick(&sensor));
        for (uint64_t k = 0; k < 200; ++k) {
            const jcal_reading_t reading = reading_at(&motion, 1000, k * dt_us[n]);
            if (jcal_sensor_push(&sensor, &reading) == JCAL_TICK) {
                const jcal_tick_t *const tick = jcal_sensor_tick(&sensor);
                TEST_ASSERT_TRUE(tick->t_us == reading.t_us);
                TEST_ASSERT_TRUE(tick->t_us - last_us == tick_us[n]);
                TEST_ASSERT_EQUAL_FLOAT((float)tick_us[n] * 1e-6f, tick->dt_s);
                TEST_ASSERT_EQUAL_UINT32(1u, tick->epoch);
                TEST_ASSERT_TRUE(fabs((double)tick->since_s - (double)(reading.t_us - 1000) * 1e-6) < 1e-4);
                last_us = tick->t_us;
            }
        }
        TEST_ASSERT_TRUE(last_us > 1000 + 190 * dt_us[n] - tick_us[n]);
    }
}

/* Samples that come when they like: the orientation follows, every tick has its own time. */
static void distances_of_samples_may_vary(void)
{
    jcal_sensor_t sensor;
    start(&sensor);
    motion_t motion = lively();
    uint64_t t_us = 0;
    uint64_t tick_us = 0;
    uint32_t random = 7;
    double before[9];
    double first[9] = {0.0};
    for (int k = 0; k < 3000; ++k) {
        const jcal_reading_t reading = reading_at(&motion, 5, t_us);
        const jcal_status_t status = jcal_sensor_push(&sensor, &reading);
        if (status == JCAL_TICK) {
            const jcal_tick_t *const tick = jcal_sensor_tick(&sensor);
            const uint64_t since_us = t_us - tick_us;
            TEST_ASSERT_EQUAL_FLOAT((float)since_us * 1e-6f, tick->dt_s);
            TEST_ASSERT_TRUE((since_us >= 40000) && (since_us <= 65000));
            double found[9];
            double turn[9];
            for (int i = 0; i < 9; ++i) {
                found[i] = (double)tick->turn[i];
            }
            mat_of(sensor.attitude.q_s_e, turn);
            TEST_ASSERT_TRUE(mat_angle_between(found, turn) < 1e-6);
            tick_us = t_us;
        }
        mat_of(sensor.attitude.q_s_e, before);
        if (k == 2000) {
            /* The turn from true to found, which only drifts from here on. */
            mat_transpose(motion.turn, first);
            mat_mul(before, first, first);
        }
        if (k > 2000) {
            double error[9];
            mat_transpose(motion.turn, error);
            mat_mul(before, error, error);
            TEST_ASSERT_TRUE(mat_angle_between(first, error) < 0.04);
        }
        random = 1664525u * random + 1013904223u;
        t_us += 5000 + (random >> 16) % 10001u;
    }
    TEST_ASSERT_EQUAL_UINT32(1u, jcal_sensor_tick(&sensor)->epoch);
}

/* The same as those of a sensor that knows nothing from before, but for the heading. */
static void assert_same_but_for_heading(const jcal_tick_t *a, const jcal_tick_t *fresh)
{
    TEST_ASSERT_EQUAL_UINT32(2u, a->epoch);
    TEST_ASSERT_EQUAL_UINT32(1u, fresh->epoch);
    TEST_ASSERT_EQUAL_FLOAT(fresh->since_s, a->since_s);
    TEST_ASSERT_EQUAL_FLOAT(fresh->acc_level_m_s2, a->acc_level_m_s2);
    TEST_ASSERT_EQUAL_FLOAT(fresh->gyr.x, a->gyr.x);
    TEST_ASSERT_TRUE(fabsf(a->velocity.z - fresh->velocity.z) < 1e-4f);
    for (int i = 6; i < 9; ++i) {
        TEST_ASSERT_TRUE(fabsf(a->lever[i] - fresh->lever[i]) < 1e-4f);
        TEST_ASSERT_TRUE(fabsf(a->turn[i] - fresh->turn[i]) < 1e-5f);
    }
}

static void a_gap_starts_features_anew_and_keeps_the_heading(void)
{
    jcal_sensor_t sensor;
    jcal_sensor_t fresh;
    start(&sensor);
    start(&fresh);
    motion_t motion = lively();
    uint64_t t_us = 0;
    for (; t_us < 2000000; t_us += DT_US) {
        const jcal_reading_t reading = reading_at(&motion, 0, t_us);
        (void)jcal_sensor_push(&sensor, &reading);
    }
    double before[9];
    double after[9];
    double step[9];
    mat_of(sensor.attitude.q_s_e, before);
    mat_transpose(before, before);
    TEST_ASSERT_EQUAL_UINT32(1u, jcal_sensor_tick(&sensor)->epoch);
    t_us += 200000;
    const jcal_reading_t first = reading_at(&motion, 0, t_us);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_sensor_push(&sensor, &first));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_sensor_push(&fresh, &first));
    mat_of(sensor.attitude.q_s_e, after);
    mat_mul(after, before, step);
    TEST_ASSERT_TRUE(fabs(step[3] - step[1]) < 1e-6);
    TEST_ASSERT_NULL(jcal_sensor_tick(&sensor));
    for (t_us += DT_US; t_us < 4000000; t_us += DT_US) {
        const jcal_reading_t reading = reading_at(&motion, 0, t_us);
        const jcal_status_t status = jcal_sensor_push(&sensor, &reading);
        TEST_ASSERT_EQUAL_INT(status, jcal_sensor_push(&fresh, &reading));
        if (status == JCAL_TICK) {
            assert_same_but_for_heading(jcal_sensor_tick(&sensor), jcal_sensor_tick(&fresh));
        }
    }
}

static uint32_t epoch_after(uint64_t from_us, uint64_t to_us)
{
    jcal_sensor_t sensor;
    start(&sensor);
    motion_t motion = lively();
    for (uint64_t k = 0; k < 20; ++k) {
        const jcal_reading_t reading = reading_at(&motion, from_us, k * DT_US);
        (void)jcal_sensor_push(&sensor, &reading);
    }
    for (uint64_t k = 0; k < 20; ++k) {
        jcal_reading_t reading = reading_at(&motion, from_us, (20 + k) * DT_US);
        reading.t_us = to_us + k * DT_US;
        (void)jcal_sensor_push(&sensor, &reading);
    }
    return jcal_sensor_tick(&sensor)->epoch;
}

/* The last of twenty samples is at 190 ms. */
static void more_than_105_ms_are_a_gap_and_so_is_time_that_goes_back(void)
{
    const uint64_t at_us = (uint64_t)1 << 40;
    TEST_ASSERT_EQUAL_UINT32(1u, epoch_after(at_us, at_us + 190000 + 104000));
    TEST_ASSERT_EQUAL_UINT32(2u, epoch_after(at_us, at_us + 190000 + 106000));
    TEST_ASSERT_EQUAL_UINT32(2u, epoch_after(at_us, at_us));
    TEST_ASSERT_EQUAL_UINT32(2u, epoch_after(at_us, 0));
    TEST_ASSERT_EQUAL_UINT32(2u, epoch_after(at_us, at_us + 190000 + DT_US + ((uint64_t)1 << 32)));
}

static void assert_same_sensor(const jcal_sensor_t *a, const jcal_sensor_t *b)
{
    TEST_ASSERT_EQUAL_MEMORY(a, b, sizeof *a);
}

/* Each component, of each kind that is no reading; the state stays as it is to the last bit. */
static void what_is_no_reading_never_gets_in(void)
{
    static const float bad_gyr[] = {NAN, INFINITY, -INFINITY, 3e38f, -200.1f, 200.1f};
    static const float bad_acc[] = {NAN, INFINITY, -INFINITY, 3e38f, -4000.1f, 4000.1f};
    jcal_sensor_t sensor;
    jcal_sensor_t copy;
    start(&sensor);
    motion_t motion = lively();
    for (uint64_t k = 0; k < 300; ++k) {
        jcal_reading_t reading = reading_at(&motion, 0, k * DT_US);
        (void)memcpy(&copy, &sensor, sizeof copy);
        for (size_t n = 0; n < 6; ++n) {
            for (int component = 0; component < 6; ++component) {
                jcal_reading_t bad = reading;
                float *const at[] = {&bad.imu.gyr_rad_s.x, &bad.imu.gyr_rad_s.y, &bad.imu.gyr_rad_s.z,
                                     &bad.imu.acc_m_s2.x,  &bad.imu.acc_m_s2.y,  &bad.imu.acc_m_s2.z};
                *at[component] = (component < 3) ? bad_gyr[n] : bad_acc[n];
                TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_sensor_push(&sensor, &bad));
            }
        }
        assert_same_sensor(&copy, &sensor);
        TEST_ASSERT_TRUE(jcal_sensor_push(&sensor, &reading) >= JCAL_OK);
        (void)memcpy(&copy, &sensor, sizeof copy);
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_sensor_push(&sensor, &reading));
        assert_same_sensor(&copy, &sensor);
    }
}

/* The largest readings that are taken in, in any order, at any distance: every number stays one. */
static void the_wildest_readings_leave_numbers(void)
{
    jcal_sensor_t sensor;
    start(&sensor);
    uint32_t random = 11;
    uint64_t t_us = 0;
    for (int k = 0; k < 20000; ++k) {
        float v[6];
        for (int i = 0; i < 6; ++i) {
            random = 1664525u * random + 1013904223u;
            const float most = (i < 3) ? JCAL_SENSOR_GYR_MAX_RAD_S : JCAL_SENSOR_ACC_MAX_M_S2;
            const float kinds[4] = {0.0f, most, -most, 0.001f * most};
            v[i] = kinds[random >> 30];
        }
        const jcal_reading_t reading = {t_us, {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}};
        TEST_ASSERT_TRUE(jcal_sensor_push(&sensor, &reading) != JCAL_REJECTED);
        const jcal_quat_t q = jcal_sensor_orientation(&sensor);
        TEST_ASSERT_TRUE(fabsf((q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z) - 1.0f) < 1e-5f);
        TEST_ASSERT_TRUE(jcal_vec3_is_finite(jcal_sensor_gyr_bias(&sensor)));
        const jcal_tick_t *const tick = jcal_sensor_tick(&sensor);
        if (tick != NULL) {
            TEST_ASSERT_TRUE(jcal_vec3_is_finite(tick->velocity) && jcal_vec3_is_finite(tick->gyr));
            TEST_ASSERT_TRUE(isfinite(tick->lever[k % 9]) && isfinite(tick->rate[k % 9]) &&
                             isfinite(tick->acc_level_m_s2));
        }
        random = 1664525u * random + 1013904223u;
        t_us += 1u + (random >> 15);
    }
}

/* Up to where 64 bits end. */
static void shifting_all_times_changes_no_bit(void)
{
    static const uint64_t shifts[] = {1, 123456789, (uint64_t)1 << 32, (uint64_t)1 << 52, UINT64_MAX - 3000000};
    for (size_t n = 0; n < sizeof(shifts) / sizeof(shifts[0]); ++n) {
        jcal_sensor_t a;
        jcal_sensor_t b;
        start(&a);
        start(&b);
        motion_t motion = lively();
        for (uint64_t k = 0; k < 500; ++k) {
            jcal_reading_t reading = reading_at(&motion, 0, (k * DT_US) + (k * k % 3000));
            const jcal_status_t status = jcal_sensor_push(&a, &reading);
            reading.t_us += shifts[n];
            TEST_ASSERT_EQUAL_INT(status, jcal_sensor_push(&b, &reading));
            TEST_ASSERT_EQUAL_MEMORY(&a.attitude, &b.attitude, sizeof a.attitude);
            TEST_ASSERT_EQUAL_MEMORY(&a.bias, &b.bias, sizeof a.bias);
        }
        TEST_ASSERT_EQUAL_MEMORY(a.features.tick.turn, b.features.tick.turn, sizeof a.features.tick.turn);
        TEST_ASSERT_EQUAL_MEMORY(a.features.tick.lever, b.features.tick.lever, sizeof a.features.tick.lever);
        TEST_ASSERT_EQUAL_MEMORY(a.features.chain, b.features.chain, sizeof a.features.chain);
    }
}

static void nothing_is_an_argument_that_is_missing(void)
{
    jcal_sensor_t sensor;
    const jcal_reading_t reading = {0, {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 9.81f}}};
    start(&sensor);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_sensor_init(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_sensor_push(NULL, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_sensor_push(&sensor, NULL));
    jcal_sensor_t zeros;
    memset(&zeros, 0, sizeof zeros);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_sensor_push(&zeros, &reading));
    TEST_ASSERT_NULL(jcal_sensor_tick(&zeros));
    TEST_ASSERT_NULL(jcal_sensor_tick(NULL));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sensor_orientation(NULL).w);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sensor_orientation(&sensor).w);
    TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_sensor_gyr_bias(NULL)) == 0.0f);
}

static float level_after(jcal_sensor_t *sensor, int from, int to, float (*acc_z)(int))
{
    for (int k = from; k < to; ++k) {
        const jcal_reading_t reading = {(uint64_t)k * DT_US, {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, acc_z(k)}}};
        (void)jcal_sensor_push(sensor, &reading);
    }
    return jcal_sensor_tick(sensor)->acc_level_m_s2;
}

/* Steps: 20 m/s^2 more for a tenth of the time and 20/9 less for the rest; the median is 2.2 m/s^2 from the mean. */
static float steps_of_a_run(int k)
{
    return 9.81f + (((k % 50) < 5) ? 20.0f : (-20.0f / 9.0f));
}

static float heavy(int k)
{
    (void)k;
    return 10.9f;
}

static float in_g(int k)
{
    (void)k;
    return 1.0f;
}

static void the_level_of_gravity_is_the_mean_whatever_the_motion(void)
{
    jcal_sensor_t sensor;
    start(&sensor);
    TEST_ASSERT_TRUE(fabsf(level_after(&sensor, 0, 3000, steps_of_a_run) - 9.81f) < 0.15f);
    /* Three times its memory later 5 % of the 1.09 m/s^2 are left to go. */
    TEST_ASSERT_TRUE(fabsf(level_after(&sensor, 3000, 9000, heavy) - 10.9f) < 0.08f);
}

static void an_accelerometer_in_g_shows_within_seconds(void)
{
    jcal_sensor_t sensor;
    start(&sensor);
    /* The low-pass of 5 Hz takes a tenth of a second to see it, 1 % of the time. */
    TEST_ASSERT_TRUE(fabsf(level_after(&sensor, 0, 1000, in_g) - 1.0f) < 0.2f);
}

/* A reading is the mean over the time before it. After n readings of one rate the features' R has turned n - 1 times, which is what the
   means of neighbours make of it, and the orientation that is given half a step more. */
static void the_orientation_at_a_reading_is_half_a_step_further_than_that_of_the_features(void)
{
    jcal_sensor_t sensor;
    start(&sensor);
    const float rate = 2.0f;
    for (int k = 0; k < 31; ++k) {
        const jcal_reading_t reading = {(uint64_t)k * DT_US, {{0.0f, 0.0f, rate}, {0.0f, 0.0f, 9.81f}}};
        (void)jcal_sensor_push(&sensor, &reading);
    }
    const jcal_quat_t inside = sensor.attitude.q_s_e;
    const jcal_quat_t outside = jcal_sensor_orientation(&sensor);
    const float step_rad = rate * (float)DT_US * 1e-6f;
    TEST_ASSERT_TRUE(fabsf((2.0f * atan2f(inside.z, inside.w)) - (30.0f * step_rad)) < 1e-5f);
    TEST_ASSERT_TRUE(fabsf((2.0f * atan2f(outside.z, outside.w)) - (30.5f * step_rad)) < 1e-5f);
}

static void a_sensor_takes_no_more_than_800_bytes(void)
{
    TEST_ASSERT_TRUE(sizeof(jcal_sensor_t) <= 800u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ticks_are_the_multiple_of_the_samples_that_is_nearest_to_50_ms);
    RUN_TEST(distances_of_samples_may_vary);
    RUN_TEST(a_gap_starts_features_anew_and_keeps_the_heading);
    RUN_TEST(more_than_105_ms_are_a_gap_and_so_is_time_that_goes_back);
    RUN_TEST(what_is_no_reading_never_gets_in);
    RUN_TEST(the_wildest_readings_leave_numbers);
    RUN_TEST(shifting_all_times_changes_no_bit);
    RUN_TEST(nothing_is_an_argument_that_is_missing);
    RUN_TEST(the_level_of_gravity_is_the_mean_whatever_the_motion);
    RUN_TEST(an_accelerometer_in_g_shows_within_seconds);
    RUN_TEST(the_orientation_at_a_reading_is_half_a_step_further_than_that_of_the_features);
    RUN_TEST(a_sensor_takes_no_more_than_800_bytes);
    return UNITY_END();
}
