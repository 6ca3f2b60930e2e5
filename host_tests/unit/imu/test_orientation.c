/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of the orientation and of the gyroscope's bias in jointcal/sensor.h.
#include "jointcal/quat.h"
#include "jointcal/sensor.h"

#include "imu/attitude.h"
#include "unit/imu/stage_double.h"

#include "unity.h"

enum { DT_US = 10000 };
static const double DT_S = 0.01;

void setUp(void)
{
}

void tearDown(void)
{
}

typedef struct {
    jcal_sensor_t sensor;
    uint64_t t_us;
} run_t;

static void begin(run_t *run)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_sensor_init(&run->sensor));
    run->t_us = 1000000;
}

static jcal_status_t put(run_t *run, const double gyr[3], const double acc[3])
{
    const jcal_reading_t reading = to_reading(run->t_us, gyr, acc);
    run->t_us += DT_US;
    const jcal_status_t status = jcal_sensor_push(&run->sensor, &reading);
    TEST_ASSERT_TRUE((status == JCAL_OK) || (status == JCAL_TICK));
    return status;
}

static void turn_of(const run_t *run, double out[9])
{
    mat_of(run->sensor.attitude.q_s_e, out);
}

/* Angle of the direction that is taken for up with the one that is. */
static double tilt_error(const run_t *run, const double turn[9])
{
    double found[9];
    turn_of(run, found);
    const double a[3] = {found[6], found[7], found[8]};
    const double b[3] = {turn[6], turn[7], turn[8]};
    double c[3];
    vec_cross(a, b, c);
    return atan2(sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/* Specific force in the sensor of a body at rest. */
static void at_rest(const double turn[9], double acc[3])
{
    acc[0] = MOTION_G * turn[6];
    acc[1] = MOTION_G * turn[7];
    acc[2] = MOTION_G * turn[8];
}

/* At a constant rate about its own axis a step is exact, whatever its size; the specific force follows, so that nothing is corrected. */
static void a_constant_rate_turns_exactly_about_each_axis(void)
{
    const double rates[] = {0.3, -2.0, 30.0, 150.0};
    for (int axis = 0; axis < 3; ++axis) {
        for (int n = 0; n < 4; ++n) {
            run_t run;
            begin(&run);
            double turn[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
            double gyr[3] = {0.0, 0.0, 0.0};
            gyr[axis] = rates[n];
            double step[9];
            const double angle[3] = {gyr[0] * DT_S, gyr[1] * DT_S, gyr[2] * DT_S};
            mat_turn(angle, step);
            for (int k = 0; k < 100; ++k) {
                double acc[3];
                double found[9];
                at_rest(turn, acc);
                (void)put(&run, gyr, acc);
                turn_of(&run, found);
                TEST_ASSERT_TRUE(mat_angle_between(turn, found) < 2e-5);
                mat_mul(turn, step, turn);
            }
        }
    }
}

/* Any orientation, at rest: from the first sample on. */
static void at_rest_the_first_sample_gives_the_inclination(void)
{
    for (int k = 0; k < 60; ++k) {
        run_t run;
        begin(&run);
        const double v[3] = {3.0 * sin(1.3 * k), 2.5 * cos(0.7 * k), 2.0 * sin(0.4 * k + 1.0)};
        const double none[3] = {0.0, 0.0, 0.0};
        double turn[9];
        double acc[3];
        mat_turn(v, turn);
        at_rest(turn, acc);
        (void)put(&run, none, acc);
        TEST_ASSERT_TRUE(tilt_error(&run, turn) < 1e-6);
    }
}

static void upside_down_is_an_inclination_too(void)
{
    run_t run;
    begin(&run);
    const double none[3] = {0.0, 0.0, 0.0};
    const double acc[3] = {0.0, 0.0, -MOTION_G};
    const double turn[9] = {1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0};
    (void)put(&run, none, acc);
    TEST_ASSERT_TRUE(tilt_error(&run, turn) < 1e-6);
}

/* In motion the first sample is wrong by whatever the body accelerates, up to 38 deg here. The mean over 3 s of 4 m/s^2 at 4.6 rad/s and
   more is at most 2 * 4 / (4.6 * 3) = 0.58 m/s^2 in each direction, 4.8 deg in two; after 10 s the low-pass is left, which lets 1 % pass,
   and a bias that the start was taken for. */
static void in_motion_the_inclination_is_found_within_seconds(void)
{
    for (int start = 0; start < 8; ++start) {
        run_t run;
        begin(&run);
        motion_t motion = motion_begin(1.5, 4.0, 1.7);
        const double turn_at[3] = {0.8 * start, -0.5 * start, 0.3};
        const double place[3] = {0.05, -0.02, 0.03};
        const motion_mount_t mount = motion_mount(turn_at, place, 0.0);
        for (int k = 0; k < 1500; ++k) {
            double gyr[3];
            double acc[3];
            double turn[9];
            motion_to(&motion, 0.37 * start + k * DT_S);
            motion_read(&motion, &mount, gyr, acc, turn);
            (void)put(&run, gyr, acc);
            const double error = tilt_error(&run, turn) / DOUBLE_DEG;
            TEST_ASSERT_TRUE((k < 300) || (error < 4.8));
            TEST_ASSERT_TRUE((k < 1000) || (error < 1.5));
        }
    }
}

/* Whatever the orientation and the force: the correction turns about a horizontal axis, so nothing turns about the vertical. */
static void levelling_changes_no_heading(void)
{
    float level[3];
    jcal_lowpass_set(level, 0.05f);
    for (int k = 0; k < 200; ++k) {
        jcal_attitude_t attitude;
        memset(&attitude, 0, sizeof attitude);
        attitude.q_s_e = jcal_quat_normalise(
            jcal_quat((float)sin(1.0 + k), (float)cos(2.0 * k), (float)sin(0.7 * k), (float)cos(0.3 * k)));
        attitude.sum_m_s =
            jcal_vec3((float)(5.0 * sin(0.9 * k)), (float)(5.0 * cos(1.7 * k)), (float)(9.0 * sin(0.4 * k)));
        double before[9];
        double after[9];
        double step[9];
        mat_of(attitude.q_s_e, before);
        mat_transpose(before, before);
        jcal_vec3_t correction;
        const jcal_vec3_t force = attitude.sum_m_s;
        const jcal_lowpass_t by = jcal_lowpass_for(level, 0.0f, 0.05f);
        TEST_ASSERT_TRUE(jcal_attitude_level(&attitude, &by, 0.05f, &correction));
        mat_of(attitude.q_s_e, after);
        mat_mul(after, before, step);
        TEST_ASSERT_TRUE(fabs(step[3] - step[1]) < 1e-6);
        const double f[3] = {(double)force.x, (double)force.y, (double)force.z};
        double up[3];
        mat_times(step, f, up);
        TEST_ASSERT_TRUE((fabs(up[0]) < 1e-5) && (fabs(up[1]) < 1e-5) && (up[2] > 0.0));
    }
}

static void free_fall_and_nothing_at_all_leave_the_orientation(void)
{
    run_t run;
    begin(&run);
    const double none[3] = {0.0, 0.0, 0.0};
    const double up[3] = {0.0, 0.0, MOTION_G};
    (void)put(&run, none, none);
    for (int k = 0; k < 400; ++k) {
        (void)put(&run, none, (k < 200) ? none : up);
        double found[9];
        turn_of(&run, found);
        TEST_ASSERT_TRUE(fabs(found[8] - 1.0) < 1e-6);
    }
}

static const double BIAS[3] = {0.6 * DOUBLE_DEG, -0.4 * DOUBLE_DEG, 0.9 * DOUBLE_DEG};

static double bias_error_deg(const run_t *run, const double bias[3])
{
    const jcal_vec3_t b = jcal_sensor_gyr_bias(&run->sensor);
    const double e[3] = {(double)b.x - bias[0], (double)b.y - bias[1], (double)b.z - bias[2]};
    return sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) / DOUBLE_DEG;
}

/* All of it, the vertical part too. n ticks at rest leave 1 / (1 + n P / noise^2): P = (0.5 deg/s)^2 before anything is known, noise^2 such
   that 0.065 deg/s remain in the end. */
static void at_rest_the_bias_is_found(void)
{
    run_t run;
    begin(&run);
    const double acc[3] = {3.0, 2.0, 9.1};
    const double begin2 = 0.5 * 0.5;
    const double growth = 0.1 * 0.1 * 0.05 / 100.0;
    const double end2 = 0.065 * 0.065;
    const double noise2 = end2 + end2 * end2 / growth;
    const double all = sqrt(0.6 * 0.6 + 0.4 * 0.4 + 0.9 * 0.9);
    for (int k = 0; k < 2001; ++k) {
        (void)put(&run, BIAS, acc);
        if ((k % 5 == 0) && (k >= 200)) {
            const int ticks = (k - 195) / 5;
            const double left = 1.0 / (1.0 + ticks * begin2 / noise2);
            TEST_ASSERT_TRUE(fabs(bias_error_deg(&run, BIAS) - left * all) < 0.02 * all);
        }
    }
    /* What is left turns the heading. */
    double before[9];
    double after[9];
    turn_of(&run, before);
    for (int k = 0; k < 6000; ++k) {
        (void)put(&run, BIAS, acc);
    }
    turn_of(&run, after);
    TEST_ASSERT_TRUE(mat_angle_between(before, after) < 60.0 * 0.05 * DOUBLE_DEG);
    TEST_ASSERT_TRUE(bias_error_deg(&run, BIAS) < 0.02);
}

/* Faster than any bias: that is motion. */
static void a_slow_turn_is_no_bias(void)
{
    run_t run;
    begin(&run);
    double turn[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const double gyr[3] = {0.0, 0.0, 4.0 * DOUBLE_DEG};
    double acc[3];
    at_rest(turn, acc);
    const double none[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3000; ++k) {
        (void)put(&run, gyr, acc);
    }
    TEST_ASSERT_TRUE(bias_error_deg(&run, none) < 0.1);
}

/* A second and a half of a slow turn, as an arm makes it. */
static void a_short_rest_is_none(void)
{
    run_t run;
    begin(&run);
    const double gyr[3] = {0.0, 0.0, 1.5 * DOUBLE_DEG};
    const double faster[3] = {0.0, 0.0, 0.4};
    const double none[3] = {0.0, 0.0, 0.0};
    const double up[3] = {0.0, 0.0, MOTION_G};
    for (int k = 0; k < 2000; ++k) {
        (void)put(&run, (k % 200 < 170) ? gyr : faster, up);
    }
    TEST_ASSERT_TRUE(bias_error_deg(&run, none) < 0.1);
}

/* Reading k of a sensor in motion, with a bias. */
static void put_moving(run_t *run, motion_t *motion, int k, const double bias[3])
{
    const double turn_at[3] = {0.3, 0.2, 0.1};
    const double place[3] = {0.05, -0.02, 0.03};
    const motion_mount_t mount = motion_mount(turn_at, place, 0.0);
    double gyr[3];
    double acc[3];
    double turn[9];
    motion_to(motion, k * DT_S);
    motion_read(motion, &mount, gyr, acc, turn);
    for (int i = 0; i < 3; ++i) {
        gyr[i] += bias[i];
    }
    (void)put(run, gyr, acc);
}

/* No rest anywhere: the horizontal parts are told by the corrections, and all three while the sensor turns. 1.15 deg/s before. */
static void in_motion_the_bias_is_found_too(void)
{
    run_t run;
    begin(&run);
    motion_t motion = motion_begin(1.5, 2.0, 1.0);
    for (int k = 0; k < 12000; ++k) {
        put_moving(&run, &motion, k, BIAS);
        const double error = bias_error_deg(&run, BIAS);
        TEST_ASSERT_TRUE((k < 6000) || (error < 1.15 / 2.0));
        TEST_ASSERT_TRUE((k < 11000) || (error < 1.15 / 4.0));
    }
}

static void a_bias_is_never_larger_than_two_degrees_a_second(void)
{
    run_t run;
    begin(&run);
    const double large[3] = {6.0 * DOUBLE_DEG, 0.0, 0.0};
    motion_t motion = motion_begin(1.5, 2.0, 1.0);
    for (int k = 0; k < 6000; ++k) {
        put_moving(&run, &motion, k, large);
        const jcal_vec3_t b = jcal_sensor_gyr_bias(&run.sensor);
        TEST_ASSERT_TRUE(fabsf(b.x) <= 2.0001f * (float)DOUBLE_DEG);
        TEST_ASSERT_TRUE(fabsf(b.y) <= 2.0001f * (float)DOUBLE_DEG);
        TEST_ASSERT_TRUE(fabsf(b.z) <= 2.0001f * (float)DOUBLE_DEG);
    }
}

/* What the sensor reads at sample k: rest, motion from 5.03 s on, rest again after 40 s; always with the bias, as floats. */
static void rest_and_motion(motion_t *motion, int k, double gyr[3], double acc[3])
{
    const double turn_at[3] = {0.3, -0.2, 1.1};
    const double place[3] = {0.1, -0.2, 0.05};
    const motion_mount_t mount = motion_mount(turn_at, place, 0.0);
    double turn[9];
    const bool moves = (k >= 503) && (k < 4503);
    motion_to(motion, moves ? (k - 503) * DT_S : motion->t_s);
    motion_read(motion, &mount, gyr, acc, turn);
    if (!moves) {
        at_rest(turn, acc);
    }
    for (int i = 0; i < 3; ++i) {
        gyr[i] = (double)(float)((moves ? gyr[i] : 0.0) + BIAS[i]);
        acc[i] = (double)(float)acc[i];
    }
}

static void assert_same_features(const double_features_t *expected, const jcal_tick_t *tick)
{
    const float velocity[3] = {tick->velocity.x, tick->velocity.y, tick->velocity.z};
    for (int i = 0; i < 9; ++i) {
        TEST_ASSERT_TRUE(fabs((double)tick->lever[i] - expected->lever_low[i]) < 1e-4);
        TEST_ASSERT_TRUE(fabs((double)tick->rate[i] - expected->rate[i]) < 1e-4);
        TEST_ASSERT_TRUE(fabs((double)velocity[i % 3] - expected->velocity_low[i % 3]) < 1e-4);
    }
}

/* Corrections are never so large here that they are clipped. Orientation, bias and features beside a second form of all of it in double
   precision. */
static void the_whole_stage_is_that_of_double_precision(void)
{
    run_t run;
    begin(&run);
    double_stage_t expected;
    motion_t motion = motion_begin(0.8, 0.5, 1.0);
    for (int k = 0; k < 6000; ++k) {
        double gyr[3];
        double acc[3];
        const bool due = (k > 0) && (k % 5 == 0);
        rest_and_motion(&motion, k, gyr, acc);
        TEST_ASSERT_EQUAL_INT(due ? JCAL_TICK : JCAL_OK, put(&run, gyr, acc));
        if (k == 0) {
            double_stage_begin(&expected, DT_S, 0.05, gyr, acc);
        } else {
            double_stage_put(&expected, gyr, acc, due);
        }
        double found[9];
        turn_of(&run, found);
        TEST_ASSERT_TRUE(mat_angle_between(expected.now, found) < 3e-5);
        TEST_ASSERT_TRUE(bias_error_deg(&run, expected.bias) < 1e-4);
        if (due) {
            assert_same_features(&expected.features, jcal_sensor_tick(&run.sensor));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_constant_rate_turns_exactly_about_each_axis);
    RUN_TEST(at_rest_the_first_sample_gives_the_inclination);
    RUN_TEST(upside_down_is_an_inclination_too);
    RUN_TEST(in_motion_the_inclination_is_found_within_seconds);
    RUN_TEST(levelling_changes_no_heading);
    RUN_TEST(free_fall_and_nothing_at_all_leave_the_orientation);
    RUN_TEST(at_rest_the_bias_is_found);
    RUN_TEST(a_slow_turn_is_no_bias);
    RUN_TEST(a_short_rest_is_none);
    RUN_TEST(in_motion_the_bias_is_found_too);
    RUN_TEST(a_bias_is_never_larger_than_two_degrees_a_second);
    RUN_TEST(the_whole_stage_is_that_of_double_precision);
    return UNITY_END();
}
