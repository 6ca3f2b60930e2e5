/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of center/gravity.h: gravity and the sides of both forces against double precision, what is objected to, and that neither engine
/// is ever ready with forces that are scaled or of the wrong sign.
#include "center/gravity.h"

#include "jointcal/center.h"
#include "jointcal/center_window.h"
#include "jointcal/vec3.h"
#include "unit/center/motion.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#ifdef JCAL_TEST_SHORT
#define LENGTH_S 12.0
#define ENGINE_S 12.0
#else
#define LENGTH_S 24.0
#define ENGINE_S 24.0
#endif

#define DT_S 0.06
#define WINDOW 60u

static jcal_center_gravity_t gravity;
static jcal_center_config_t config;

/* A joint centre that moves in the horizontal plane, both sensors in frames that do not turn, however they are turned. */
typedef struct {
    double along, beside; /* amplitudes of the acceleration, m/s^2 */
    double size[2];       /* what each accelerometer makes of 1 */
    double gap_s;         /* a pause after 10 s, in which the frames begin anew */
} scene_t;

static const scene_t STEADY = {1.0, 1.0, {1.0, 1.0}, 0.0};

void setUp(void)
{
    config = jcal_center_config_default();
    memset(&gravity, 0, sizeof gravity);
}

void tearDown(void)
{
}

/* What sensor 0 or 1 feels at the joint, in its frame; that of the second half is another one if there is a pause. */
static void felt(const scene_t *scene, int sensor, double t_s, double *out)
{
    const bool is_late = (scene->gap_s > 0.0) && (t_s > 10.0);
    const double force[3] = {scene->along * sin(2.0 * t_s) + 0.3 * scene->along * sin(5.1 * t_s),
                             scene->beside * sin(2.7 * t_s + 1.0) + 0.3 * scene->beside * cos(4.3 * t_s),
                             CENTER_GRAVITY};
    double turned[3];
    center_turn(pose_any(sensor + (is_late ? 5 : 2)), force, turned);
    for (int i = 0; i < 3; ++i) {
        out[i] = scene->size[sensor] * turned[i];
    }
}

static const jcal_center_place_t PLACE = {{0.1f, -0.05f, 0.2f}, {-0.15f, 0.02f, 0.1f}};

/* A sample of which |a - K r| is what is felt at the joint; K as of some quick motion to and fro. */
static jcal_kinematic_t sample_at(const scene_t *scene, double t_s)
{
    jcal_kinematic_t s = {0};
    jcal_segment_t *const bodies[2] = {&s.body1, &s.body2};
    for (int k = 0; k < 2; ++k) {
        double f[3];
        felt(scene, k, t_s, f);
        bodies[k]->k[0] = jcal_vec3((float)sin(4.0 * t_s), (float)sin(5.0 * t_s), 0.0f);
        bodies[k]->k[1] = jcal_vec3((float)cos(6.0 * t_s), (float)cos(4.0 * t_s), 0.0f);
        bodies[k]->k[2] = jcal_vec3(0.0f, (float)sin(7.0 * t_s), (float)sin(6.0 * t_s));
        const jcal_vec3_t by_turning = jcal_segment_times(bodies[k], (k == 0) ? PLACE.r1 : PLACE.r2);
        bodies[k]->a = jcal_vec3_add(jcal_vec3((float)f[0], (float)f[1], (float)f[2]), by_turning);
    }
    s.dt_s = (float)DT_S;
    s.t_us = UINT64_C(1000000) + (uint64_t)(1e6 * (t_s + ((t_s > 10.0) ? scene->gap_s : 0.0)));
    return s;
}

static void run(const scene_t *scene, double to_s)
{
    for (int k = 0; k * DT_S < to_s; ++k) {
        const jcal_kinematic_t s = sample_at(scene, k * DT_S);
        jcal_center_gravity_add(&gravity, &s, &PLACE, false);
    }
}

/* The mean of the last three seconds or so, by its definition: each sample counts dt over the time since the means began, at most 3 s and
 * dt. Its lengths from 1 s on, averaged. */
static double expect_level(const scene_t *scene, int sensor, double to_s)
{
    double mean[3] = {0.0, 0.0, 0.0};
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k * DT_S < to_s; ++k) {
        const jcal_kinematic_t s = sample_at(scene, k * DT_S);
        const jcal_vec3_t a = (sensor == 0) ? s.body1.a : s.body2.a;
        const double in[3] = {(double)a.x, (double)a.y, (double)a.z};
        const double since_s = fmin(k * DT_S, 3.0) + DT_S;
        double square = 0.0;
        for (int i = 0; i < 3; ++i) {
            mean[i] += DT_S / since_s * (in[i] - mean[i]);
            square += mean[i] * mean[i];
        }
        if (since_s >= 1.0) {
            sum += sqrt(square);
            ++count;
        }
    }
    return sum / count;
}

static void levels_are_the_mean_lengths_of_means_over_three_seconds(void)
{
    run(&STEADY, LENGTH_S);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, (float)expect_level(&STEADY, 0, LENGTH_S), gravity.level1);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, (float)expect_level(&STEADY, 1, LENGTH_S), gravity.level2);
}

/* |sum h1 conj(h2)| and |sum h1 h2| do not depend on the bases; both are those of the force in the earth's frame. */
static void sums_of_both_sides_are_those_of_the_horizontal_forces(void)
{
    const double dt_s = DT_S;
    double turned = 0.0;
    double mirrored[2] = {0.0, 0.0};
    for (int k = 16; k * dt_s < LENGTH_S; ++k) { /* the means are warm then */
        double f[3];
        double h[3];
        felt(&STEADY, 0, k * dt_s, f);
        center_turn(pose_conj(pose_any(2)), f, h);
        turned += dt_s * (h[0] * h[0] + h[1] * h[1]);
        mirrored[0] += dt_s * (h[0] * h[0] - h[1] * h[1]);
        mirrored[1] += dt_s * 2.0 * h[0] * h[1];
    }
    run(&STEADY, LENGTH_S);
    /* The means lean by a few degrees: gravity leaks in, by some percent of this motion's squares. */
    const float tolerance = (float)(0.15 * turned);
    TEST_ASSERT_FLOAT_WITHIN(tolerance, (float)turned, hypotf(gravity.turned.re, gravity.turned.im));
    TEST_ASSERT_FLOAT_WITHIN(tolerance, (float)hypot(mirrored[0], mirrored[1]),
                             hypotf(gravity.mirrored.re, gravity.mirrored.im));
    TEST_ASSERT_TRUE(hypot(mirrored[0], mirrored[1]) < 0.5 * turned);
}

static void six_percent_are_allowed(void)
{
    const double sizes[4] = {0.955, 1.055, 0.93, 1.07};
    for (int which = 0; which < 8; ++which) {
        scene_t scene = STEADY;
        scene.along = 0.2;
        scene.beside = 0.2;
        scene.size[which % 2] = sizes[which / 2];
        setUp();
        run(&scene, LENGTH_S);
        TEST_ASSERT_EQUAL_INT((which < 4) ? JCAL_REASON_NONE : JCAL_REASON_GRAVITY_OFF,
                              jcal_center_gravity_objects(&gravity, 1.0f));
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_center_gravity_objects(&gravity, 1.2f));
    }
}

static void nothing_is_known_before_two_seconds_of_warm_means(void)
{
    run(&STEADY, 2.8);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, jcal_center_gravity_objects(&gravity, 1.0f));
    setUp();
    run(&STEADY, 3.2);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_center_gravity_objects(&gravity, 1.0f));
}

static void a_force_of_the_wrong_sign_is_seen_from_the_other_side(void)
{
    for (int which = 0; which < 2; ++which) {
        scene_t scene = STEADY;
        scene.size[which] = -1.0;
        setUp();
        run(&scene, LENGTH_S);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, jcal_center_gravity_objects(&gravity, 1.0f));
        jcal_center_gravity_forget(&gravity);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_center_gravity_objects(&gravity, 1.0f));
    }
    scene_t both = STEADY;
    both.size[0] = -1.0;
    both.size[1] = -1.0; /* as if the world stood on its head: nothing tells */
    setUp();
    run(&both, LENGTH_S);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_center_gravity_objects(&gravity, 1.0f));
}

static void motion_along_one_line_or_none_says_nothing_of_the_sign(void)
{
    const scene_t scenes[2] = {{1.0, 0.0, {-1.0, 1.0}, 0.0}, {0.05, 0.05, {-1.0, 1.0}, 0.0}};
    for (int which = 0; which < 2; ++which) {
        setUp();
        run(&scenes[which], LENGTH_S);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_center_gravity_objects(&gravity, 1.0f));
    }
}

/* After the pause gravity points elsewhere in both frames: without new means their lengths would be far too small for seconds. */
static void a_pause_begins_new_means(void)
{
    scene_t scene = STEADY;
    scene.gap_s = 0.3;
    run(&scene, 11.5);
    TEST_ASSERT_FLOAT_WITHIN(0.15f, 9.81f, gravity.level1);
    TEST_ASSERT_FLOAT_WITHIN(0.3f, 9.81f, jcal_vec3_norm(gravity.mean1));
}

static void frames_that_turn_have_the_mean_length_of_the_forces(void)
{
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k * DT_S < 6.0; ++k, ++count) {
        const jcal_kinematic_t s = sample_at(&STEADY, k * DT_S);
        jcal_center_gravity_add(&gravity, &s, &PLACE, true);
        sum += (double)jcal_vec3_norm(s.body2.a);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, (float)(sum / count), gravity.level2);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, gravity.power);
}

static void bounds_hold_errors_of_scale(void)
{
    const double r2 = sqrt(0.15 * 0.15 + 0.02 * 0.02 + 0.1 * 0.1);
    const double r1 = sqrt(0.1 * 0.1 + 0.05 * 0.05 + 0.2 * 0.2);
    config.rate_mismatch = 0.02f;
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)(0.04 * r1), jcal_center_gravity_shift(&gravity, &config, &PLACE, 0u));
    gravity.time_s = 10.0f;
    gravity.level1 = 9.81f * 0.99f; /* a bias */
    gravity.level2 = 9.81f * 1.05f; /* 3 % more than biases make */
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)(0.04 * r1), jcal_center_gravity_shift(&gravity, &config, &PLACE, 0u));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, (float)(0.05 * r2), jcal_center_gravity_shift(&gravity, &config, &PLACE, 1u));
}

/* A joint whose accelerometers are all `size` times as large, sensor 1's turned round if `turned`. */
static jcal_pair_t wrong_sample(const center_motion_t *m, uint32_t k, float size, bool turned)
{
    jcal_pair_t pair = center_sample(m, k);
    pair.imu1.acc_m_s2 = jcal_vec3_scale(pair.imu1.acc_m_s2, turned ? -size : size);
    pair.imu2.acc_m_s2 = jcal_vec3_scale(pair.imu2.acc_m_s2, size);
    return pair;
}

static void run_stream(float size, bool turned, jcal_reason_t expected)
{
    static jcal_center_t engine;
    center_motion_t m = center_lively(4);
    jcal_center_result_t r = {0};
    m.carried = 0.08;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
    for (uint32_t k = 0u; k < (uint32_t)(ENGINE_S * m.rate_hz); ++k) {
        const jcal_pair_t pair = wrong_sample(&m, k, size, turned);
        (void)jcal_center_update(&engine, &pair);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_get(&engine, &r));
        TEST_ASSERT_TRUE(r.head.status != JCAL_READY);
    }
    TEST_ASSERT_EQUAL_INT(expected, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
}

static void the_stream_engine_is_never_ready_with_scaled_or_turned_forces(void)
{
    run_stream(2.0f, false, JCAL_REASON_GRAVITY_OFF);
    run_stream(0.5f, false, JCAL_REASON_GRAVITY_OFF);
    run_stream(1.0f, true, JCAL_REASON_NOT_ONE_JOINT);
}

static void the_window_engine_knows_gravity_too(void)
{
    static jcal_center_window_t window;
    static uint64_t storage[JCAL_CENTER_WINDOW_STORAGE_BYTES(WINDOW) / sizeof(uint64_t)];
    jcal_center_window_config_t window_config = jcal_center_window_config_default();
    const center_motion_t m = center_lively(4);
    jcal_center_result_t r;
    window_config.n_max = WINDOW;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_init(&window, &window_config, storage, sizeof storage));
    for (uint32_t k = 0u; k < (uint32_t)(12.0 * m.rate_hz); ++k) {
        const jcal_pair_t pair = wrong_sample(&m, k, 2.0f, false);
        (void)jcal_center_window_update(&window, &pair);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_get(&window, &r));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_GRAVITY_OFF, r.head.reason);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(levels_are_the_mean_lengths_of_means_over_three_seconds);
    RUN_TEST(sums_of_both_sides_are_those_of_the_horizontal_forces);
    RUN_TEST(six_percent_are_allowed);
    RUN_TEST(nothing_is_known_before_two_seconds_of_warm_means);
    RUN_TEST(a_force_of_the_wrong_sign_is_seen_from_the_other_side);
    RUN_TEST(motion_along_one_line_or_none_says_nothing_of_the_sign);
    RUN_TEST(a_pause_begins_new_means);
    RUN_TEST(frames_that_turn_have_the_mean_length_of_the_forces);
    RUN_TEST(bounds_hold_errors_of_scale);
    RUN_TEST(the_stream_engine_is_never_ready_with_scaled_or_turned_forces);
    RUN_TEST(the_window_engine_knows_gravity_too);
    return UNITY_END();
}
