/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/calib/hinge_search.h and hinge_point.h: starts, costs, what a probe's end is filed as.
#include "calib/hinge_search.h"
#include "hinge_double.h"
#include "hinge_motion.h"
#include "unity.h"

#include <string.h>

enum { SAMPLES = 400, EIGEN_STARTS = 18 };

static jcal_hinge_t engine;
static motion_t motion;
static double rates2[2][3][3]; /* weighted sum of w w' */

void setUp(void)
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
    motion = motion_lively(21);
    memset(rates2, 0, sizeof rates2);
    for (uint32_t k = 0; k < SAMPLES; ++k) {
        const jcal_pair_t p = motion_sample(&motion, k);
        dsample_t s = {.gyr_weight = 100.0, .acc_weight = 0.1};
        dset(p.imu1.gyr_rad_s, s.w[0]);
        dset(p.imu2.gyr_rad_s, s.w[1]);
        dset(p.imu1.acc_m_s2, s.a[0]);
        dset(p.imu2.acc_m_s2, s.a[1]);
        add_to_moments(&s, &engine.moments);
        for (int i = 0; i < 18; ++i) {
            rates2[i / 9][(i / 3) % 3][i % 3] += 100.0 * s.w[i / 9][(i / 3) % 3] * s.w[i / 9][i % 3];
        }
    }
}

void tearDown(void)
{
}

static void place_at_truth(void)
{
    jcal_hinge_axis_set(&engine.point.axis1, motion_axis(&motion, 0));
    jcal_hinge_axis_set(&engine.point.axis2, motion_axis(&motion, 1));
    engine.has_point = true;
}

/* The eigenvalue of v, which must be an eigenvector; its share of the trace. */
static double eigenvalue(jcal_vec3_t axis, int sensor)
{
    double v[3];
    double image[3];
    dset(axis, v);
    for (int i = 0; i < 3; ++i) {
        image[i] = ddot(rates2[sensor][i], v);
    }
    const double value = ddot(image, v);
    const double trace = rates2[sensor][0][0] + rates2[sensor][1][1] + rates2[sensor][2][2];
    for (int i = 0; i < 3; ++i) {
        TEST_ASSERT_TRUE(fabs(image[i] - (value * v[i])) < 1e-5 * trace); /* float sums of 400 terms */
    }
    return value / trace;
}

static void the_first_18_starts_are_all_pairs_of_eigenvectors_with_either_sign(void)
{
    bool seen[3][3][2] = {{{false}}};
    double values[2][3] = {{0.0}};
    jcal_vec3_t starts[EIGEN_STARTS][2];
    place_at_truth();
    for (int s = 0; s < EIGEN_STARTS; ++s) {
        engine.search.running = false;
        engine.search.start = (uint8_t)s;
        jcal_hinge_search(&engine);
        starts[s][0] = engine.search.probe.j1;
        starts[s][1] = engine.search.probe.j2;
        values[0][(s / 2) % 3] = eigenvalue(starts[s][0], 0);
        values[1][s / 6] = eigenvalue(starts[s][1], 1);
    }
    for (int sensor = 0; sensor < 2; ++sensor) { /* three different ones, which together make the trace */
        TEST_ASSERT_TRUE((values[sensor][0] > values[sensor][1]) && (values[sensor][1] > values[sensor][2]));
        TEST_ASSERT_TRUE(fabs(values[sensor][0] + values[sensor][1] + values[sensor][2] - 1.0) < 1e-4);
    }
    for (int s = 0; s < EIGEN_STARTS; ++s) {
        const int first = s - (s % 2);
        const bool same = jcal_vec3_dot(starts[s][1], starts[first][1]) > 0.0f;
        bool *const flag = &seen[(s / 2) % 3][s / 6][same ? 1 : 0];
        TEST_ASSERT_FALSE(*flag);
        *flag = true;
    }
}

static void the_last_start_is_the_estimate_with_axis_2_turned_round(void)
{
    place_at_truth();
    engine.search.start = EIGEN_STARTS;
    jcal_hinge_search(&engine);
    const jcal_vec3_t turned = jcal_vec3_scale(engine.point.axis2.j, -1.0f);
    TEST_ASSERT_EQUAL_MEMORY(&engine.point.axis1.j, &engine.search.probe.j1, sizeof turned);
    TEST_ASSERT_EQUAL_FLOAT(turned.x, engine.search.probe.j2.x);
    TEST_ASSERT_EQUAL_FLOAT(turned.y, engine.search.probe.j2.y);
    TEST_ASSERT_EQUAL_FLOAT(turned.z, engine.search.probe.j2.z);
}

static void a_round_counts_only_after_the_joint_has_moved(void)
{
    place_at_truth();
    engine.evidence.excitation = 0.0f;
    for (int k = 0; k < 1000; ++k) {
        jcal_hinge_search(&engine);
    }
    TEST_ASSERT_EQUAL_UINT8(0, engine.search.rounds);
}

static void a_round_over_all_starts_is_counted_and_stops_counting_at_its_limit(void)
{
    place_at_truth();
    engine.evidence.excitation = 1.0f;
    engine.evidence.excitation = 0.0f;
    for (int k = 0; k < 400; ++k) {
        jcal_hinge_search(&engine);
    }
    TEST_ASSERT_EQUAL_UINT8(0, engine.search.rounds); /* rounds over data in which no joint moved say nothing */
    engine.evidence.excitation = 1.0f;
    for (int k = 0; (k < 1000) && (engine.search.rounds == 0u); ++k) {
        jcal_hinge_search(&engine);
    }
    TEST_ASSERT_EQUAL_UINT8(1, engine.search.rounds);
    TEST_ASSERT_EQUAL_UINT8(0, engine.search.start);
    TEST_ASSERT_TRUE(engine.search.has_flip); /* the other pairing was met on the way */
    engine.search.rounds = UINT8_MAX;
    for (int k = 0; k < 1000; ++k) {
        jcal_hinge_search(&engine);
    }
    TEST_ASSERT_EQUAL_UINT8(UINT8_MAX, engine.search.rounds);
}

static void a_search_without_an_estimate_finds_the_axes(void)
{
    for (int k = 0; k < 400; ++k) {
        jcal_hinge_search(&engine);
        jcal_hinge_track(&engine);
    }
    TEST_ASSERT_TRUE(engine.has_point);
    /* Noise of 0.01 rad/s, 8 s: a few tenths of a degree. */
    TEST_ASSERT_TRUE(jcal_hinge_same_lines(&engine.point, motion_axis(&motion, 0), motion_axis(&motion, 1)));
    TEST_ASSERT_TRUE(fabsf(jcal_vec3_dot(engine.point.axis1.j, motion_axis(&motion, 0))) > 0.9999f);
    TEST_ASSERT_TRUE(fabsf(jcal_vec3_dot(engine.point.axis2.j, motion_axis(&motion, 1))) > 0.9999f);
}

static void the_cost_is_the_sum_of_its_parts_and_of_the_prior(void)
{
    jcal_rng_t rng = {5};
    const jcal_hinge_point_t point = random_point(&rng, 0.02f);
    const double unit2 = (double)engine.cfg.gyr_bias_rad_s * (double)engine.cfg.gyr_bias_rad_s;
    const dpoint_t p = dpoint(&point);
    const double expected = (double)jcal_hinge_cost_gyr(&engine.moments, &point) +
                            (double)jcal_hinge_cost_acc(&engine.moments, &engine.cfg, &point) +
                            ((ddot(p.b[0], p.b[0]) + ddot(p.b[1], p.b[1])) / unit2);
    TEST_ASSERT_TRUE(fabs((double)jcal_hinge_cost(&engine, &point) - expected) < 1e-6 * expected);
    engine.search.rival = (jcal_hinge_place_t){point.axis1.j, point.axis2.j, point.axis1.bias, point.axis2.bias};
    TEST_ASSERT_TRUE(fabs((double)jcal_hinge_cost_of_rival(&engine) - expected) < 1e-5 * expected);
}

static void sums_that_hold_nan_or_nothing_give_starts_along_the_coordinates_and_no_nan(void)
{
    const float bad[2] = {NAN, 0.0f};
    for (int i = 0; i < 2; ++i) {
        setUp();
        for (size_t k = 0; k < sizeof engine.moments.gyr / sizeof(float); ++k) {
            engine.moments.gyr[k] = bad[i];
        }
        memset(engine.moments.acc, 0, sizeof engine.moments.acc);
        for (int k = 0; k < 400; ++k) {
            jcal_hinge_search(&engine);
            TEST_ASSERT_TRUE(jcal_vec3_is_finite(engine.search.probe.j1) &&
                             jcal_vec3_is_finite(engine.search.probe.j2));
            TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_norm(engine.search.probe.j1));
        }
        TEST_ASSERT_TRUE(jcal_vec3_is_finite(engine.point.axis1.j));
    }
}

static void tracking_without_an_estimate_does_nothing(void)
{
    const jcal_hinge_t before = engine;
    jcal_hinge_track(&engine);
    TEST_ASSERT_EQUAL_MEMORY(&before, &engine, sizeof engine);
}

static void an_axis_carries_an_orthonormal_tangent_and_a_bias_across_it(void)
{
    jcal_rng_t rng = {6};
    jcal_hinge_axis_t axis;
    random_axis(&rng, 0.1f, &axis);
    for (int k = 0; k < 1000; ++k) { /* random jumps: u is now and then nearly parallel to the new axis */
        jcal_hinge_axis_set(&axis, ((k % 10) == 9) ? axis.u : jcal_rng_unit(&rng));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_norm(axis.u));
        /* A carried tangent is projected and, if a tenth of it is left, lengthened tenfold, and its rounding with it. */
        TEST_ASSERT_FLOAT_WITHIN(3e-6f, 0.0f, jcal_vec3_dot(axis.u, axis.j));
        TEST_ASSERT_FLOAT_WITHIN(1e-7f, 0.0f, jcal_vec3_dot(axis.bias, axis.j));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_dot(jcal_hinge_v(&axis), jcal_vec3_cross(axis.j, axis.u)));
    }
}

static void lines_are_the_same_within_eleven_degrees_whatever_their_signs(void)
{
    jcal_rng_t rng = {7};
    const float degrees[2] = {10.0f, 13.0f};
    const jcal_hinge_point_t point = random_point(&rng, 0.0f);
    for (int i = 0; i < 2; ++i) {
        const float rad = degrees[i] * 0.0174532925f;
        const jcal_vec3_t near1 =
            jcal_vec3_add(jcal_vec3_scale(point.axis1.j, cosf(rad)), jcal_vec3_scale(point.axis1.u, sinf(rad)));
        const jcal_vec3_t near2 =
            jcal_vec3_add(jcal_vec3_scale(point.axis2.j, -cosf(rad)), jcal_vec3_scale(point.axis2.u, sinf(rad)));
        TEST_ASSERT_EQUAL_INT(i == 0, jcal_hinge_same_lines(&point, near1, point.axis2.j));
        TEST_ASSERT_EQUAL_INT(i == 0, jcal_hinge_same_lines(&point, point.axis1.j, near2));
    }
}

static void the_main_sign_is_that_of_the_largest_component(void)
{
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_hinge_main_sign(jcal_vec3(0.5f, -0.4f, -0.3f)));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_hinge_main_sign(jcal_vec3(0.4f, -0.5f, 0.3f)));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_hinge_main_sign(jcal_vec3(0.4f, 0.3f, -0.5f)));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_hinge_main_sign(jcal_vec3(-0.4f, -0.3f, 0.5f)));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_hinge_main_sign(jcal_vec3(0.0f, 0.0f, 0.0f)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_first_18_starts_are_all_pairs_of_eigenvectors_with_either_sign);
    RUN_TEST(the_last_start_is_the_estimate_with_axis_2_turned_round);
    RUN_TEST(a_round_counts_only_after_the_joint_has_moved);
    RUN_TEST(a_round_over_all_starts_is_counted_and_stops_counting_at_its_limit);
    RUN_TEST(a_search_without_an_estimate_finds_the_axes);
    RUN_TEST(the_cost_is_the_sum_of_its_parts_and_of_the_prior);
    RUN_TEST(sums_that_hold_nan_or_nothing_give_starts_along_the_coordinates_and_no_nan);
    RUN_TEST(tracking_without_an_estimate_does_nothing);
    RUN_TEST(an_axis_carries_an_orthonormal_tangent_and_a_bias_across_it);
    RUN_TEST(lines_are_the_same_within_eleven_degrees_whatever_their_signs);
    RUN_TEST(the_main_sign_is_that_of_the_largest_component);
    return UNITY_END();
}
