/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/imu/features.h with orientations that are exact: against double precision, and by what two sensors on one body must share.
#include "imu/features.h"

#include "jointcal/vec3.h"
#include "unit/imu/stage_double.h"

#include "unity.h"

static const motion_t LIVELY = {2.5, 4.0, 1.0, {0.0}, 0.0};

void setUp(void)
{
}

void tearDown(void)
{
}

static void to_floats(const double *from, float *to, int count)
{
    for (int i = 0; i < count; ++i) {
        to[i] = (float)from[i];
    }
}

/// Filters of the library, fed with exact orientations at a rate.
typedef struct {
    jcal_features_t features;
    jcal_sample_rates_t sample;
    jcal_tick_rates_t tick;
    motion_mount_t mount;
    bool has_second;
} fed_t;

static void feed(fed_t *self, const motion_t *motion, bool is_first)
{
    double gyr[3];
    double acc[3];
    double turn[9];
    float r[9];
    motion_read(motion, &self->mount, gyr, acc, turn);
    to_floats(turn, r, 9);
    double force[3];
    mat_times(turn, acc, force);
    const jcal_imu_t imu = {to_vec3(gyr), to_vec3(acc)};
    if (is_first) {
        jcal_features_begin(&self->features, r, &imu, to_vec3(force));
    } else {
        if (!self->has_second) {
            jcal_features_second(&self->features, &self->sample);
            self->has_second = true;
        }
        jcal_features_sample(&self->features, &self->sample, r, &imu, to_vec3(force));
    }
}

static void make_tick(fed_t *self, const motion_t *motion)
{
    double gyr[3];
    double acc[3];
    double turn[9];
    float r[9];
    motion_read(motion, &self->mount, gyr, acc, turn);
    to_floats(turn, r, 9);
    jcal_features_tick(&self->features, &self->tick, r);
}

static fed_t fed(const motion_mount_t *mount, double dt_s, double tick_s)
{
    fed_t out;
    memset(&out, 0, sizeof out);
    out.mount = *mount;
    out.sample.dt_s = (float)dt_s;
    out.tick.dt_s = (float)tick_s;
    jcal_features_set_sample(&out.sample);
    jcal_features_set_tick(&out.tick);
    return out;
}

/* U - B r, of r from the body's origin to the sensor. */
static void at_origin(const fed_t *self, double out[3])
{
    double back[9];
    double r[3];
    double lever[9];
    mat_transpose(self->mount.frame, back);
    mat_times(back, self->mount.place, r);
    for (int i = 0; i < 9; ++i) {
        lever[i] = (double)self->features.tick.lever[i];
    }
    mat_times(lever, r, out);
    out[0] = (double)self->features.tick.velocity.x - out[0];
    out[1] = (double)self->features.tick.velocity.y - out[1];
    out[2] = (double)self->features.tick.velocity.z - out[2];
}

typedef struct {
    double worst;   ///< Largest difference of U_1 - B_1 r_1 and Rz (U_2 - B_2 r_2), m/s.
    double moved;   ///< Largest |U_1|, so that nothing is compared with nothing.
    double parted;  ///< Largest |U_1 - Rz U_2|: what the levers explain.
} shared_t;

static shared_t compare_two_sensors(int per_tick, double tick_s, double pace)
{
    const double turn1[3] = {0.5, 1.1, -0.3};
    const double turn2[3] = {-1.9, 0.4, 0.8};
    const double place1[3] = {0.12, -0.25, 0.08};
    const double place2[3] = {-0.2, 0.07, 0.15};
    const motion_mount_t mount1 = motion_mount(turn1, place1, 0.4);
    const motion_mount_t mount2 = motion_mount(turn2, place2, -1.3);
    const double dt_s = tick_s / per_tick;
    fed_t one = fed(&mount1, dt_s, tick_s);
    fed_t two = fed(&mount2, dt_s, tick_s);
    motion_t motion = motion_begin(LIVELY.rate, LIVELY.force, pace);
    const double about_z[3] = {0.0, 0.0, mount1.heading - mount2.heading};
    double heading[9];
    mat_turn(about_z, heading);
    shared_t out = {0.0, 0.0, 0.0};
    feed(&one, &motion, true);
    feed(&two, &motion, true);
    for (int k = 1; k <= 200 * per_tick; ++k) {
        motion_to(&motion, k * dt_s);
        feed(&one, &motion, false);
        feed(&two, &motion, false);
        if (k % per_tick == 0) {
            make_tick(&one, &motion);
            make_tick(&two, &motion);
            double e1[3];
            double e2[3];
            const jcal_vec3_t u1 = one.features.tick.velocity;
            double u2[3] = {(double)two.features.tick.velocity.x, (double)two.features.tick.velocity.y,
                            (double)two.features.tick.velocity.z};
            at_origin(&one, e1);
            at_origin(&two, e2);
            mat_times(heading, e2, e2);
            mat_times(heading, u2, u2);
            const double apart = fmax(fabs(e1[0] - e2[0]), fmax(fabs(e1[1] - e2[1]), fabs(e1[2] - e2[2])));
            out.worst = fmax(out.worst, apart);
            out.moved = fmax(out.moved, fabs((double)u1.x));
            out.parted = fmax(out.parted, fabs((double)u1.x - u2[0]));
        }
    }
    return out;
}

/* What the trapezoidal rule leaves, as a share: (omega dt)^2 / 12, omega the rate of the body (7.4 rad/s at most) and its own frequency. */
static double left_over(double dt_s, double pace)
{
    const double omega = 7.4 + (5.3 * pace);
    return omega * dt_s * omega * dt_s / 12.0;
}

/* And no more, from the first tick on, where start values that do not belong together would show: they fade within 2 s. A quarter at half
   the step tells the trapezoidal rule from anything of first order. */
static void two_sensors_of_one_body_tell_the_same_from_the_first_sample_on(void)
{
    const shared_t at_100_hz = compare_two_sensors(5, 0.05, 1.0);
    const shared_t at_200_hz = compare_two_sensors(10, 0.05, 1.0);
    const shared_t at_800_hz = compare_two_sensors(40, 0.05, 1.0);
    TEST_ASSERT_TRUE(at_100_hz.moved > 0.3);
    TEST_ASSERT_TRUE(at_100_hz.parted > 0.3);
    TEST_ASSERT_TRUE(at_100_hz.worst < left_over(0.01, 1.0) * at_100_hz.parted);
    TEST_ASSERT_TRUE(at_200_hz.worst < 0.3 * at_100_hz.worst);
    TEST_ASSERT_TRUE(at_800_hz.worst < 0.02 * at_100_hz.worst);
}

/* The lowest rate, and ticks of 47 ms. */
static void that_holds_at_other_rates_too(void)
{
    const shared_t at_10_hz = compare_two_sensors(1, 0.1, 0.2);
    const shared_t at_128_hz = compare_two_sensors(6, 6.0 / 128.0, 1.0);
    TEST_ASSERT_TRUE(at_10_hz.worst < left_over(0.1, 0.2) * at_10_hz.parted);
    TEST_ASSERT_TRUE(at_128_hz.worst < left_over(1.0 / 128.0, 1.0) * at_128_hz.parted);
}

static void assert_near(double tolerance, const double *expected, const float *found, int count)
{
    for (int i = 0; i < count; ++i) {
        TEST_ASSERT_TRUE(fabs(expected[i] - (double)found[i]) < tolerance);
    }
}

static void assert_like_double(int per_tick, double tick_s, int ticks)
{
    const double none[3] = {0.3, -0.6, 1.2};
    const double place[3] = {0.1, 0.2, -0.1};
    const motion_mount_t mount = motion_mount(none, place, 0.3);
    const double dt_s = tick_s / per_tick;
    fed_t self = fed(&mount, dt_s, tick_s);
    motion_t motion = motion_begin(LIVELY.rate, LIVELY.force, LIVELY.pace);
    double_features_t expected;
    double gyr[3];
    double acc[3];
    double turn[9];
    motion_read(&motion, &mount, gyr, acc, turn);
    double_features_begin(&expected, turn, gyr, acc);
    feed(&self, &motion, true);
    for (int k = 1; k <= ticks * per_tick; ++k) {
        motion_to(&motion, k * dt_s);
        motion_read(&motion, &mount, gyr, acc, turn);
        double_features_sample(&expected, turn, gyr, acc, dt_s);
        feed(&self, &motion, false);
        if (k % per_tick == 0) {
            double_features_tick(&expected, tick_s);
            make_tick(&self, &motion);
            const jcal_tick_t *const tick = &self.features.tick;
            const float velocity[3] = {tick->velocity.x, tick->velocity.y, tick->velocity.z};
            const float slow[3] = {tick->gyr.x, tick->gyr.y, tick->gyr.z};
            const double w[3] = {expected.w[0].y[2], expected.w[1].y[2], expected.w[2].y[2]};
            assert_near(1e-6, turn, tick->turn, 9);
            assert_near(1e-5, expected.rate, tick->rate, 9);
            assert_near(1e-5, expected.lever_low, tick->lever, 9);
            assert_near(1e-5, expected.velocity_low, velocity, 3);
            assert_near(1e-5, w, slow, 3);
        }
    }
    TEST_ASSERT_TRUE(fabs(expected.velocity_low[0]) + fabs(expected.velocity_low[1]) > 0.01);
    TEST_ASSERT_TRUE(fabs(expected.lever_low[0]) + fabs(expected.lever_low[1]) > 0.01);
}

static void features_are_those_of_double_precision(void)
{
    assert_like_double(5, 0.05, 1200);
    assert_like_double(6, 6.0 / 128.0, 400);
    assert_like_double(1, 0.1, 400);
}

/* Every distance of samples another: coefficients follow. */
static void distances_of_samples_may_vary(void)
{
    const double none[3] = {0.3, -0.6, 1.2};
    const double place[3] = {0.1, 0.2, -0.1};
    const motion_mount_t mount = motion_mount(none, place, 0.3);
    fed_t self = fed(&mount, 0.01, 0.05);
    motion_t motion = motion_begin(LIVELY.rate, LIVELY.force, LIVELY.pace);
    double_features_t expected;
    double gyr[3];
    double acc[3];
    double turn[9];
    motion_read(&motion, &mount, gyr, acc, turn);
    double_features_begin(&expected, turn, gyr, acc);
    feed(&self, &motion, true);
    double t_s = 0.0;
    double tick_s = 0.0;
    for (int k = 1; k <= 2000; ++k) {
        const double dt_s = 0.004 + (0.001 * (double)((7 * k) % 13));
        t_s += dt_s;
        tick_s += dt_s;
        self.sample.dt_s = (float)dt_s;
        jcal_features_set_sample(&self.sample);
        motion_to(&motion, t_s);
        motion_read(&motion, &mount, gyr, acc, turn);
        double_features_sample(&expected, turn, gyr, acc, dt_s);
        feed(&self, &motion, false);
        if (k % 5 == 0) {
            self.tick.dt_s = (float)tick_s;
            jcal_features_set_tick(&self.tick);
            double_features_tick(&expected, tick_s);
            make_tick(&self, &motion);
            tick_s = 0.0;
            assert_near(1e-5, expected.lever_low, self.features.tick.lever, 9);
            TEST_ASSERT_TRUE(fabs(expected.velocity_low[0] - (double)self.features.tick.velocity.x) < 1e-5);
        }
    }
}

/* A body at rest that is level: nothing but R. */
static void at_rest_there_is_nothing(void)
{
    const double none[3] = {0.0, 0.0, 0.0};
    const motion_mount_t mount = motion_mount(none, none, 0.0);
    fed_t self = fed(&mount, 0.01, 0.05);
    const motion_t rest = {0.0, 0.0, 1.0, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, 0.0};
    feed(&self, &rest, true);
    for (int k = 1; k <= 100; ++k) {
        feed(&self, &rest, false);
        if (k % 5 == 0) {
            make_tick(&self, &rest);
        }
    }
    const jcal_tick_t *const tick = &self.features.tick;
    for (int i = 0; i < 9; ++i) {
        TEST_ASSERT_EQUAL_FLOAT((i % 4 == 0) ? 1.0f : 0.0f, tick->turn[i]);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, tick->rate[i]);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, tick->lever[i]);
    }
    TEST_ASSERT_TRUE(jcal_vec3_norm(tick->velocity) < 1e-6f);
    TEST_ASSERT_TRUE(jcal_vec3_norm(tick->gyr) == 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(two_sensors_of_one_body_tell_the_same_from_the_first_sample_on);
    RUN_TEST(that_holds_at_other_rates_too);
    RUN_TEST(features_are_those_of_double_precision);
    RUN_TEST(distances_of_samples_may_vary);
    RUN_TEST(at_rest_there_is_nothing);
    return UNITY_END();
}
