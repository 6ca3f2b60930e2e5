/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/chain.h: hip and knee together, what ties them, what is never ready, and the interface.
#include "center/judge.h"
#include "chain/tie.h"
#include "jointcal/vec3.h"
#include "math/chol.h"
#include "math/sym.h"
#include "unit/center/double.h"
#include "unit/chain/motion.h"

#include <string.h>
#include <unity.h>

#ifdef JCAL_TEST_SHORT
#define SEEDS 1
#define NEVER_S 12.0
#else
#define SEEDS 4
#define NEVER_S 40.0
#endif

static jcal_chain_t engine;
static jcal_chain_config_t config;

void setUp(void)
{
    config = jcal_chain_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_init(&engine, &config));
}

void tearDown(void)
{
}

static void begin(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_init(&engine, &config));
}

static jcal_chain_result_t result(void)
{
    jcal_chain_result_t r;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_get(&engine, &r));
    return r;
}

static void run(const chain_motion_t *m, double from_s, double to_s)
{
    for (uint32_t k = (uint32_t)(from_s * m->hip.rate_hz); k < (uint32_t)(to_s * m->hip.rate_hz); ++k) {
        const jcal_triple_t triple = chain_sample(m, k);
        const jcal_triple_attitudes_t attitudes = chain_attitudes(m, k);
        (void)jcal_chain_push(&engine, &triple, (config.center.method == JCAL_CENTER_LS) ? &attitudes : NULL);
        (void)jcal_chain_step(&engine);
    }
}

static double error_of(const chain_motion_t *m, const jcal_chain_result_t *r, int place)
{
    double truth[3];
    chain_truth(m, (jcal_chain_place_t)place, truth);
    return center_error(r->place_m[place], truth);
}

static void assert_inside(const chain_motion_t *m)
{
    const jcal_chain_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_NONE, r.head.weak);
    for (int i = 0; i < JCAL_CHAIN_PLACES; ++i) {
        TEST_ASSERT_TRUE(error_of(m, &r, i) < (double)r.uncertainty_m[i]);
    }
    const double length = sqrt(m->thigh[0] * m->thigh[0] + m->thigh[1] * m->thigh[1] + m->thigh[2] * m->thigh[2]);
    TEST_ASSERT_TRUE(fabs((double)r.segment_length_m - length) < (double)r.uncertainty_segment_m);
}

static void lively_motion_gets_ready_and_the_truth_is_inside(void)
{
    for (int seed = 0; seed < SEEDS; ++seed) {
        const chain_motion_t m = chain_lively(seed);
        setUp();
        run(&m, 0.0, 30.0);
        assert_inside(&m);
        const jcal_chain_result_t r = result();
        for (int i = 0; i < JCAL_CHAIN_PLACES; ++i) {
            TEST_ASSERT_TRUE(error_of(&m, &r, i) < 0.004);
        }
    }
}

static void orientations_with_headings_of_their_own_do_as_well(void)
{
    const chain_motion_t m = chain_lively(1);
    config.center.method = JCAL_CENTER_LS;
    begin();
    run(&m, 0.0, 30.0);
    assert_inside(&m);
}

static void a_hinge_for_a_knee_needs_its_axis(void)
{
    chain_motion_t m = chain_lively(2);
    m.is_hinge = true;
    run(&m, 0.0, 30.0);
    jcal_chain_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_CENTER2, r.head.weak);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty_segment_m);
    const pose_quat_t mounts[2] = {pose_any(7 * m.hip.seed + 2), pose_any(7 * m.hip.seed + 3)};
    const double z[3] = {0.0, 0.0, 1.0};
    double axes[2][3];
    for (int i = 0; i < 2; ++i) {
        center_turn(pose_conj(mounts[i]), z, axes[i]);
    }
    config.knee_axis2 = jcal_vec3((float)axes[0][0], (float)axes[0][1], (float)axes[0][2]);
    config.knee_axis3 = jcal_vec3((float)axes[1][0], (float)axes[1][1], (float)axes[1][2]);
    begin();
    run(&m, 0.0, 30.0);
    r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    const jcal_vec3_t found[2] = {r.place_m[JCAL_CHAIN_KNEE_TO_THIGH], r.place_m[JCAL_CHAIN_KNEE_TO_SHANK]};
    const jcal_vec3_t known[2] = {config.knee_axis2, config.knee_axis3};
    for (int i = 0; i < 2; ++i) {
        double truth[3];
        chain_truth(&m, (jcal_chain_place_t)(JCAL_CHAIN_KNEE_TO_THIGH + i), truth);
        jcal_vec3_t d = jcal_vec3_sub(found[i], jcal_vec3((float)truth[0], (float)truth[1], (float)truth[2]));
        d = jcal_vec3_sub(d, jcal_vec3_scale(known[i], jcal_vec3_dot(known[i], d)));
        TEST_ASSERT_TRUE(jcal_vec3_norm(d) < 0.004f);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.0f, jcal_vec3_dot(found[0], known[0]) + jcal_vec3_dot(found[1], known[1]));
}

static void a_known_length_is_kept(void)
{
    const chain_motion_t m = chain_lively(3);
    const float length = (float)sqrt(m.thigh[0] * m.thigh[0] + m.thigh[1] * m.thigh[1] + m.thigh[2] * m.thigh[2]);
    run(&m, 0.0, 12.0);
    const float free_m = result().uncertainty_segment_m;
    config.segment_length_m = length;
    config.segment_tolerance_m = 1e-4f;
    begin();
    run(&m, 0.0, 12.0);
    const jcal_chain_result_t r = result();
    TEST_ASSERT_FLOAT_WITHIN(5e-4f, length, r.segment_length_m);
    TEST_ASSERT_TRUE(r.uncertainty_segment_m < free_m);
}

static void a_length_that_contradicts_the_data_is_left_out_and_never_ready(void)
{
    const chain_motion_t m = chain_lively(3);
    const double length = sqrt(m.thigh[0] * m.thigh[0] + m.thigh[1] * m.thigh[1] + m.thigh[2] * m.thigh[2]);
    config.segment_length_m = (float)length - 0.08f;
    begin();
    for (int k = 0; k < 60; ++k) {
        run(&m, 0.5 * k, 0.5 * (k + 1));
        TEST_ASSERT_TRUE(result().head.status != JCAL_READY);
    }
    const jcal_chain_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
    TEST_ASSERT_TRUE(fabs((double)r.segment_length_m - length) < (double)r.uncertainty_segment_m);
    for (int i = 0; i < JCAL_CHAIN_PLACES; ++i) {
        TEST_ASSERT_TRUE(error_of(&m, &r, i) < (double)r.uncertainty_m[i]);
    }
}

static void the_thighs_accelerometer_has_one_bias(void)
{
    chain_motion_t m = chain_lively(0);
    m.hip.bias2[0] = 0.3;
    run(&m, 0.0, 30.0);
    assert_inside(&m);
    jcal_chain_state_t state;
    TEST_ASSERT_TRUE(jcal_chain_collect(&engine.hip, &engine.knee, &state));
    TEST_ASSERT_TRUE(jcal_chain_tie(&config, &state));
    for (size_t i = 0u; i < 3u; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(0.02f, state.x[JCAL_CHAIN_AT_KNEE_BIAS + i], state.x[JCAL_CHAIN_AT_HIP_BIAS + i]);
    }
}

/* Before any tie each vector's covariance has the radius that the joint states, less the fixed part; the bias is the thigh's. */
static void what_is_tied_is_what_the_joints_state(void)
{
    const chain_motion_t m = chain_lively(2);
    jcal_chain_state_t state;
    run(&m, 0.0, 20.0);
    TEST_ASSERT_TRUE(jcal_chain_collect(&engine.hip, &engine.knee, &state));
    static const size_t first[4] = {JCAL_CHAIN_AT_HIP, JCAL_CHAIN_AT_HIP_THIGH, JCAL_CHAIN_AT_KNEE_THIGH,
                                    JCAL_CHAIN_AT_KNEE_SHANK};
    const float stated[4] = {engine.hip.work.verdict.bound1_m, engine.hip.work.verdict.bound2_m,
                             engine.knee.work.verdict.bound1_m, engine.knee.work.verdict.bound2_m};
    for (size_t i = 0u; i < 4u; ++i) {
        float c[6];
        for (size_t k = 0u; k < 3u; ++k) {
            for (size_t l = 0u; l <= k; ++l) {
                c[jcal_sym_at(k, l)] = state.covariance[jcal_sym_at(first[i] + k, first[i] + l)];
            }
        }
        const float radius = jcal_center_radius_across(c, jcal_vec3(0.0f, 0.0f, 0.0f));
        const float expected = stated[i] - config.center.mismatch_m; /* of a matrix that may be some samples older */
        TEST_ASSERT_FLOAT_WITHIN(0.1f * expected, expected, radius);
    }
    const jcal_center_t *const joints[2] = {&engine.hip, &engine.knee};
    static const size_t bias[2] = {JCAL_CHAIN_AT_HIP_BIAS, JCAL_CHAIN_AT_KNEE_BIAS}, unknown[2] = {9u, 6u};
    for (size_t joint = 0u; joint < 2u; ++joint) {
        float diagonal[3];
        for (size_t k = 0u; k < 3u; ++k) {
            const jcal_center_inverse_t *const inverse = &joints[joint]->work.as.inverse;
            float column[JCAL_CENTER_UNKNOWNS] = {0.0f};
            column[unknown[joint] + k] = 1.0f;
            jcal_chol_solve_scaled(inverse->factor, JCAL_CENTER_UNKNOWNS, inverse->scale, column);
            diagonal[k] = column[unknown[joint] + k];
        }
        for (size_t k = 1u; k < 3u; ++k) {
            const float tied = state.covariance[jcal_sym_at(bias[joint] + k, bias[joint] + k)] /
                               state.covariance[jcal_sym_at(bias[joint], bias[joint])];
            TEST_ASSERT_FLOAT_WITHIN(1e-4f * tied, diagonal[k] / diagonal[0], tied);
        }
    }
}

static void a_joint_that_does_not_fit_is_not_made_ready_by_small_bounds(void)
{
    const chain_motion_t m = chain_lively(2);
    run(&m, 0.0, 25.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().head.status);
    engine.hip.work.verdict.status = (uint8_t)JCAL_COLLECTING;
    engine.hip.work.verdict.reason = (uint8_t)JCAL_REASON_DOES_NOT_FIT;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result().head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, result().head.reason);
    engine.hip.work.verdict.reason =
        (uint8_t)JCAL_REASON_UNCERTAIN; /* then what ties both may have made it small enough */
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().head.status);
}

/* Against the least-squares solution of two unknowns, by hand: x0 of variance 4, x1 of variance 1, x0 - x1 = 3 of variance 4. */
static void an_observation_moves_what_is_known_worse(void)
{
    jcal_chain_state_t state;
    memset(&state, 0, sizeof state);
    state.covariance[jcal_sym_at(0u, 0u)] = 4.0f;
    state.covariance[jcal_sym_at(1u, 1u)] = 1.0f;
    float slope[JCAL_CHAIN_STATES] = {1.0f, -1.0f};
    TEST_ASSERT_FALSE(jcal_chain_observe(&state, slope, 9.1f, 2.0f)); /* three standard deviations are 9 */
    TEST_ASSERT_EQUAL_FLOAT(0.0f, state.x[0]);
    jcal_chain_state_t other = state;
    TEST_ASSERT_TRUE(jcal_chain_observe(&other, slope, -8.9f, 2.0f));
    TEST_ASSERT_TRUE(jcal_chain_observe(&state, slope, 3.0f, 2.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 12.0f / 9.0f, state.x[0]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -3.0f / 9.0f, state.x[1]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 4.0f - 16.0f / 9.0f, state.covariance[jcal_sym_at(0u, 0u)]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 4.0f / 9.0f, state.covariance[jcal_sym_at(1u, 0u)]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f - 1.0f / 9.0f, state.covariance[jcal_sym_at(1u, 1u)]);
}

static void the_plane_pulls_both_centres_towards_it(void)
{
    jcal_chain_state_t state;
    memset(&state, 0, sizeof state);
    for (unsigned i = 0u; i < JCAL_CHAIN_STATES; ++i) {
        state.covariance[jcal_sym_at(i, i)] = 1e-4f;
    }
    state.x[JCAL_CHAIN_AT_HIP_THIGH + 2u] = 0.02f;
    state.x[JCAL_CHAIN_AT_KNEE_THIGH + 1u] = -0.4f;
    config.plane_normal = jcal_vec3(0.0f, 0.0f, 1.0f);
    config.plane_tolerance_m = 1e-4f;
    config.center.acc_bias_m_s2 = 0.0f;
    TEST_ASSERT_TRUE(jcal_chain_tie(&config, &state));
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.01f, state.x[JCAL_CHAIN_AT_HIP_THIGH + 2u]);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.01f, state.x[JCAL_CHAIN_AT_KNEE_THIGH + 2u]);
    TEST_ASSERT_EQUAL_FLOAT(-0.4f, state.x[JCAL_CHAIN_AT_KNEE_THIGH + 1u]);
}

/* Made-up sums for a joint, with what is worked out from them; both bounds as they are stated. */
static void make_up(jcal_center_t *joint, int seed, float bound1_m, float bound2_m)
{
    joint->work.sums = double_sums(seed, 0.5, 1.0);
    joint->work.sums.point.b1 = jcal_vec3(0.1f, 0.2f, 0.3f * (float)seed);
    joint->work.sums.point.b2 = jcal_vec3(-0.1f, -0.2f, 0.1f * (float)seed);
    for (unsigned slice = 0u; slice < JCAL_CENTER_JUDGE_SLICES - 1u; ++slice) {
        TEST_ASSERT_TRUE(jcal_center_judge(&joint->cfg, &joint->work, slice));
    }
    joint->work.verdict.bound1_m = bound1_m;
    joint->work.verdict.bound2_m = bound2_m;
    joint->has_point = true;
}

static void make_up_both(void)
{
    config.knee_axis2 = jcal_vec3(0.6f, 0.8f, 0.0f);
    config.knee_axis3 = jcal_vec3(0.0f, 0.0f, 1.0f);
    begin();
    make_up(&engine.hip, 1, 0.012f, 0.03f);
    make_up(&engine.knee, 2, 0.05f, 0.022f);
}

/* How much the deviations of both sensors' vectors grow to make the bounds. */
static void growth_of(const jcal_center_t *joint, double axes[2][3], double *grow)
{
    const double_matrix_t inverse = double_inverse_of(&joint->work.sums);
    const double bounds[2] = {(double)joint->work.verdict.bound1_m, (double)joint->work.verdict.bound2_m};
    for (int sensor = 0; sensor < 2; ++sensor) {
        double c[3][3];
        double_block(&inverse, sensor, 1.0, c);
        grow[sensor] = (bounds[sensor] - 0.002) / double_radius(c, axes[sensor]); /* the mismatch is no scatter */
    }
    grow[2] = fmax(grow[0], grow[1]);
}

/* `first` of the state and `from` of the joint's unknowns: r1, r2, bias. */
static void assert_collected(const jcal_center_t *joint, double axes[2][3], const size_t *first, const size_t *from,
                             const jcal_chain_state_t *state)
{
    const double_matrix_t inverse = double_inverse_of(&joint->work.sums);
    double grow[3];
    growth_of(joint, axes, grow);
    for (size_t i = 0u; i < 9u; ++i) {
        for (size_t j = 0u; j < 9u; ++j) {
            const size_t row = from[i / 3u] + i % 3u;
            const size_t column = from[j / 3u] + j % 3u;
            const double expected = grow[i / 3u] * grow[j / 3u] * inverse.m[row][column];
            const double scale = grow[i / 3u] * grow[j / 3u] * sqrt(inverse.m[row][row] * inverse.m[column][column]);
            const size_t at = jcal_sym_at(first[i / 3u] + i % 3u, first[j / 3u] + j % 3u);
            TEST_ASSERT_TRUE(fabs((double)state->covariance[at] - expected) < 2e-3 * scale);
        }
    }
}

static void assert_vector(jcal_vec3_t expected, const float *x)
{
    TEST_ASSERT_EQUAL_FLOAT(expected.x, x[0]);
    TEST_ASSERT_EQUAL_FLOAT(expected.y, x[1]);
    TEST_ASSERT_EQUAL_FLOAT(expected.z, x[2]);
}

static void both_joints_become_one_gaussian_as_wide_as_their_bounds(void)
{
    jcal_chain_state_t state;
    double no_axes[2][3] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    double axes[2][3] = {{0.6, 0.8, 0.0}, {0.0, 0.0, 1.0}};
    const size_t hip_first[3] = {JCAL_CHAIN_AT_HIP, JCAL_CHAIN_AT_HIP_THIGH, JCAL_CHAIN_AT_HIP_BIAS};
    const size_t hip_from[3] = {0u, 3u, 9u}; /* the bias of its second sensor */
    const size_t knee_first[3] = {JCAL_CHAIN_AT_KNEE_THIGH, JCAL_CHAIN_AT_KNEE_SHANK, JCAL_CHAIN_AT_KNEE_BIAS};
    const size_t knee_from[3] = {0u, 3u, 6u}; /* the bias of its first one */
    make_up_both();
    TEST_ASSERT_TRUE(jcal_chain_collect(&engine.hip, &engine.knee, &state));
    assert_collected(&engine.hip, no_axes, hip_first, hip_from, &state);
    assert_collected(&engine.knee, axes, knee_first, knee_from, &state);
    for (size_t i = 0u; i < 9u; ++i) {
        for (size_t j = 9u; j < 18u; ++j) {
            TEST_ASSERT_EQUAL_FLOAT(0.0f, state.covariance[jcal_sym_at(i, j)]);
        }
    }
    const jcal_center_point_t *const hip = &engine.hip.work.sums.point;
    const jcal_center_point_t *const knee = &engine.knee.work.sums.point;
    assert_vector(hip->place.r1, &state.x[JCAL_CHAIN_AT_HIP]);
    assert_vector(hip->place.r2, &state.x[JCAL_CHAIN_AT_HIP_THIGH]);
    assert_vector(hip->b2, &state.x[JCAL_CHAIN_AT_HIP_BIAS]);
    assert_vector(knee->b1, &state.x[JCAL_CHAIN_AT_KNEE_BIAS]);
    assert_vector(knee->place.r1, &state.x[JCAL_CHAIN_AT_KNEE_THIGH]);
    assert_vector(knee->place.r2, &state.x[JCAL_CHAIN_AT_KNEE_SHANK]);
    engine.knee.work.as.inverse.is_factored = false;
    TEST_ASSERT_FALSE(jcal_chain_collect(&engine.hip, &engine.knee, &state));
    engine.knee.work.as.inverse.is_factored = true;
    engine.hip.work.as.inverse.is_factored = false;
    TEST_ASSERT_FALSE(jcal_chain_collect(&engine.hip, &engine.knee, &state));
    engine.hip.work.as.inverse.is_factored = true;
    engine.knee.work.verdict.bound2_m = 1.0f; /* none to build on */
    TEST_ASSERT_FALSE(jcal_chain_collect(&engine.hip, &engine.knee, &state));
}

static double covariance_at(const jcal_chain_state_t *state, size_t i, size_t j)
{
    return (double)state->covariance[jcal_sym_at(i, j)];
}

static void bounds_are_those_of_the_tied_gaussian(void)
{
    const size_t first[JCAL_CHAIN_PLACES] = {JCAL_CHAIN_AT_HIP, JCAL_CHAIN_AT_HIP_THIGH, JCAL_CHAIN_AT_KNEE_THIGH,
                                             JCAL_CHAIN_AT_KNEE_SHANK};
    const double axes[JCAL_CHAIN_PLACES][3] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.6, 0.8, 0.0}, {0.0, 0.0, 1.0}};
    jcal_chain_state_t state;
    make_up_both();
    const jcal_vec3_t bias = engine.hip.work.sums.point.b2;
    engine.knee.work.sums.point.b1 = jcal_vec3(bias.x + 0.001f, bias.y, bias.z); /* nothing contradicts */
    TEST_ASSERT_TRUE(jcal_chain_collect(&engine.hip, &engine.knee, &state));
    TEST_ASSERT_TRUE(jcal_chain_tie(&config, &state));
    const jcal_chain_result_t r = result();
    for (int p = 0; p < JCAL_CHAIN_PLACES; ++p) {
        double c[3][3];
        for (size_t i = 0u; i < 9u; ++i) {
            c[i / 3u][i % 3u] = covariance_at(&state, first[p] + i / 3u, first[p] + i % 3u);
        }
        const double expected = 0.002 + double_radius(c, axes[p]);
        TEST_ASSERT_TRUE(fabs((double)r.uncertainty_m[p] - expected) < 1e-3 * expected);
    }
    const jcal_vec3_t segment = jcal_vec3_sub(r.place_m[JCAL_CHAIN_HIP_TO_THIGH], r.place_m[JCAL_CHAIN_KNEE_TO_THIGH]);
    const double d[3] = {(double)segment.x, (double)segment.y, (double)segment.z};
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double variance = 0.0; /* of the difference of both vectors, along it */
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t j = 0u; j < 3u; ++j) {
            const double part =
                covariance_at(&state, first[1] + i, first[1] + j) + covariance_at(&state, first[2] + i, first[2] + j) -
                covariance_at(&state, first[1] + i, first[2] + j) - covariance_at(&state, first[2] + i, first[1] + j);
            variance += part * d[i] * d[j] / (length * length);
        }
    }
    const double expected = 2.0 * 0.002 + 1.96 * sqrt(variance);
    TEST_ASSERT_TRUE(fabs((double)r.segment_length_m - length) < 1e-5);
    TEST_ASSERT_TRUE(fabs((double)r.uncertainty_segment_m - expected) < 1e-3 * expected);
}

static void a_bias_known_twice_is_known_better(void)
{
    /* variances 0.04 and 0.01, and 0.01 m/s^2 between both: least squares of each component by itself */
    const double hip[3] = {0.1, -0.2, 0.05};
    const double knee[3] = {-0.05, 0.1, 0.2};
    jcal_chain_state_t state;
    memset(&state, 0, sizeof state);
    for (size_t i = 0u; i < 3u; ++i) {
        state.x[JCAL_CHAIN_AT_HIP_BIAS + i] = (float)hip[i];
        state.x[JCAL_CHAIN_AT_KNEE_BIAS + i] = (float)knee[i];
        state.covariance[jcal_sym_at(JCAL_CHAIN_AT_HIP_BIAS + i, JCAL_CHAIN_AT_HIP_BIAS + i)] = 0.04f;
        state.covariance[jcal_sym_at(JCAL_CHAIN_AT_KNEE_BIAS + i, JCAL_CHAIN_AT_KNEE_BIAS + i)] = 0.01f;
    }
    TEST_ASSERT_TRUE(jcal_chain_tie(&config, &state));
    for (size_t i = 0u; i < 3u; ++i) {
        /* two equations: own value, and the other's through the tie */
        const double at_hip = 1.0 / 0.04 + 1.0 / (0.01 + 1e-4);
        const double at_knee = 1.0 / 0.01 + 1.0 / (0.04 + 1e-4);
        const double x_hip = (hip[i] / 0.04 + knee[i] / (0.01 + 1e-4)) / at_hip;
        const double x_knee = (knee[i] / 0.01 + hip[i] / (0.04 + 1e-4)) / at_knee;
        TEST_ASSERT_TRUE(fabs((double)state.x[JCAL_CHAIN_AT_HIP_BIAS + i] - x_hip) < 1e-5);
        TEST_ASSERT_TRUE(fabs((double)state.x[JCAL_CHAIN_AT_KNEE_BIAS + i] - x_knee) < 1e-5);
        TEST_ASSERT_TRUE(
            fabs(covariance_at(&state, JCAL_CHAIN_AT_HIP_BIAS + i, JCAL_CHAIN_AT_HIP_BIAS + i) - 1.0 / at_hip) < 1e-6);
    }
}

static void a_length_that_turns_the_thigh_is_met(void)
{
    /* what is wrong along y is wrong along x, too: 5 cm more of length turn the thigh by 6 deg, which the first slope knows nothing of */
    jcal_chain_state_t state;
    memset(&state, 0, sizeof state);
    const size_t parts[2] = {JCAL_CHAIN_AT_HIP_THIGH, JCAL_CHAIN_AT_KNEE_THIGH};
    for (size_t k = 0u; k < 2u; ++k) {
        state.covariance[jcal_sym_at(parts[k], parts[k])] = 1e-2f;
        state.covariance[jcal_sym_at(parts[k] + 1u, parts[k] + 1u)] = 1e-2f;
        state.covariance[jcal_sym_at(parts[k] + 1u, parts[k])] = 0.9e-2f;
    }
    state.x[JCAL_CHAIN_AT_HIP_THIGH + 1u] = 0.2f;
    state.x[JCAL_CHAIN_AT_KNEE_THIGH + 1u] = -0.2f;
    config.segment_length_m = 0.45f;
    config.segment_tolerance_m = 1e-4f;
    config.center.acc_bias_m_s2 = 0.0f;
    TEST_ASSERT_TRUE(jcal_chain_tie(&config, &state));
    const float x = state.x[JCAL_CHAIN_AT_HIP_THIGH] - state.x[JCAL_CHAIN_AT_KNEE_THIGH];
    const float y = state.x[JCAL_CHAIN_AT_HIP_THIGH + 1u] - state.x[JCAL_CHAIN_AT_KNEE_THIGH + 1u];
    TEST_ASSERT_TRUE(x > 0.04f);
    TEST_ASSERT_FLOAT_WITHIN(3e-4f, 0.45f, sqrtf((x * x) + (y * y)));
}

/* A joint that says so. */
static void say(jcal_center_t *joint, jcal_calibration_t status, jcal_reason_t reason, float bound_m)
{
    joint->has_point = true;
    joint->work.verdict.status = (uint8_t)status;
    joint->work.verdict.reason = (uint8_t)reason;
    joint->work.verdict.bound1_m = bound_m;
    joint->work.verdict.bound2_m = 0.5f * bound_m;
}

static void assert_said(jcal_calibration_t status, jcal_weak_t weak, jcal_reason_t reason)
{
    const jcal_chain_result_t r = result();
    TEST_ASSERT_EQUAL_INT(status, r.head.status);
    TEST_ASSERT_EQUAL_INT(weak, r.head.weak);
    TEST_ASSERT_EQUAL_INT(reason, r.head.reason);
}

static void the_weaker_joint_is_named(void)
{
    say(&engine.hip, JCAL_COLLECTING, JCAL_REASON_NO_MOTION, 0.05f);
    say(&engine.knee, JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, 0.03f);
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER1, JCAL_REASON_NO_MOTION);
    say(&engine.knee, JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, 0.06f);
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
    say(&engine.hip, JCAL_READY, JCAL_REASON_NONE, 0.009f);
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
    engine.knee.work.verdict.bound1_m = 0.005f; /* the other one of its vectors, 3 cm, is known worse */
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
    say(&engine.hip, JCAL_READY, JCAL_REASON_NONE, 0.0115f); /* what is ready stays so for a little more */
    say(&engine.knee, JCAL_READY, JCAL_REASON_NONE, 0.0115f);
    assert_said(JCAL_READY, JCAL_WEAK_NONE, JCAL_REASON_NONE);
    say(&engine.hip, JCAL_READY, JCAL_REASON_NONE, 0.009f);
    say(&engine.knee, JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, 0.009f); /* small enough, if not three times in a row */
    assert_said(JCAL_READY, JCAL_WEAK_NONE, JCAL_REASON_NONE);
    say(&engine.hip, JCAL_COLLECTING, JCAL_REASON_DOES_NOT_FIT, 0.005f); /* what is wrong is not made good by a bound */
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER1, JCAL_REASON_DOES_NOT_FIT);
    say(&engine.hip, JCAL_READY, JCAL_REASON_NONE, 0.009f);
    say(&engine.knee, JCAL_MOVED, JCAL_REASON_UNCERTAIN, 0.009f);
    assert_said(JCAL_MOVED, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
    say(&engine.hip, JCAL_MOVED, JCAL_REASON_UNCERTAIN, 0.03f);
    say(&engine.knee, JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, 0.009f);
    assert_said(JCAL_MOVED, JCAL_WEAK_CENTER1, JCAL_REASON_UNCERTAIN);
}

static void there_are_places_once_both_joints_have_theirs(void)
{
    engine.hip.has_point = true;
    TEST_ASSERT_FALSE(result().has_places);
    engine.hip.has_point = false;
    engine.knee.has_point = true;
    TEST_ASSERT_FALSE(result().has_places);
    engine.hip.has_point = true;
    TEST_ASSERT_TRUE(result().has_places);
}

static void a_stiff_hip_is_never_ready(void)
{
    chain_motion_t m = chain_lively(1);
    m.hip.dof = CENTER_STIFF;
    for (int k = 0; k < 10; ++k) {
        run(&m, 0.1 * NEVER_S * k, 0.1 * NEVER_S * (k + 1));
        TEST_ASSERT_TRUE(result().head.status != JCAL_READY);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_CENTER1, result().head.weak);
}

static void a_slip_of_the_shanks_sensor_is_noticed(void)
{
    chain_motion_t m = chain_lively(0);
    run(&m, 0.0, 25.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().head.status);
    m.knee_to_shank[0] += 0.1;
    bool moved = false;
    for (int k = 0; k < 50; ++k) {
        run(&m, 25.0 + 0.1 * k, 25.1 + 0.1 * k);
        moved = moved || (result().head.status == JCAL_MOVED);
    }
    TEST_ASSERT_TRUE(moved);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().joint_status[0]);
}

static void rejected_samples_are_counted_once(void)
{
    const chain_motion_t m = chain_lively(0);
    run(&m, 0.0, 2.0);
    jcal_triple_t triple = chain_sample(&m, 100);
    triple.imu2.acc_m_s2.x = NAN; /* both joints refuse it */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_chain_push(&engine, &triple, NULL));
    triple = chain_sample(&m, 101);
    triple.imu3.acc_m_s2.x = 1e9f; /* the knee alone */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_chain_push(&engine, &triple, NULL));
    triple = chain_sample(&m, 102);
    triple.imu1.acc_m_s2.x = NAN; /* each for a cause of its own: the first in the list counts */
    triple.imu3.acc_m_s2.x = 1e9f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_chain_push(&engine, &triple, NULL));
    const jcal_chain_result_t r = result();
    TEST_ASSERT_EQUAL_UINT32(103u, r.head.samples);
    TEST_ASSERT_EQUAL_UINT32(3u, r.head.rejected);
    TEST_ASSERT_EQUAL_UINT32(2u, r.head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_UINT32(1u, r.head.rejected_by[JCAL_REJECT_OUT_OF_RANGE]);
}

static void every_field_out_of_its_range_is_named(void)
{
    const struct {
        const char *name;
        float *field;
        float wrong;
    } fields[] = {{"max_bound_m", &config.center.max_bound_m, 0.0f},
                  {"hinge_axis1", &config.center.hinge_axis1.x, 0.5f},
                  {"segment_length_m", &config.segment_length_m, 0.04f},
                  {"segment_length_m", &config.segment_length_m, 1.1f},
                  {"segment_length_m", &config.segment_length_m, NAN},
                  {"segment_tolerance_m", &config.segment_tolerance_m, 0.0f},
                  {"plane_normal", &config.plane_normal.y, 0.5f},
                  {"plane_tolerance_m", &config.plane_tolerance_m, 0.3f},
                  {"knee_axis2", &config.knee_axis2.z, 2.0f},
                  {"knee_axis3", &config.knee_axis3.z, 2.0f},
                  {"knee_axis3", &config.knee_axis2.z, 1.0f}};
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; ++i) {
        const float right = *fields[i].field;
        *fields[i].field = fields[i].wrong;
        TEST_ASSERT_EQUAL_STRING(fields[i].name, jcal_chain_config_check(&config));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_chain_init(&engine, &config));
        *fields[i].field = right;
        TEST_ASSERT_NULL(jcal_chain_config_check(&config));
    }
    config.center.hinge_axis1 = jcal_vec3(1.0f, 0.0f, 0.0f);
    config.center.hinge_axis2 = config.center.hinge_axis1;
    TEST_ASSERT_EQUAL_STRING("hinge_axis1", jcal_chain_config_check(&config));
}

static void a_joint_without_a_sample_does_not_hold_up_the_other(void)
{
    const chain_motion_t m = chain_lively(0);
    jcal_triple_t triple = chain_sample(&m, 0);
    triple.imu1.gyr_rad_s.x = NAN; /* the pelvis: of the hip alone */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_chain_push(&engine, &triple, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_step(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_chain_step(&engine));
}

static void null_is_refused(void)
{
    const chain_motion_t m = chain_lively(0);
    const jcal_triple_t triple = chain_sample(&m, 0);
    jcal_chain_result_t r;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_init(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_push(NULL, &triple, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_push(&engine, NULL, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_get(NULL, &r));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_get(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_chain_step(&engine));
    config.center.method = JCAL_CENTER_LS;
    begin();
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_push(&engine, &triple, NULL));
}

static void reset_forgets_and_a_full_inbox_says_so(void)
{
    const chain_motion_t m = chain_lively(0);
    run(&m, 0.0, 5.0);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_reset(&engine));
    const jcal_chain_result_t r = result();
    TEST_ASSERT_FALSE(r.has_places);
    TEST_ASSERT_EQUAL_UINT32(0u, r.head.samples);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, r.segment_length_m);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.head.reason);
    jcal_status_t status = JCAL_OK;
    for (uint32_t k = 0; (k < 20u) && (status == JCAL_OK); ++k) {
        const jcal_triple_t triple = chain_sample(&m, k);
        status = jcal_chain_push(&engine, &triple, NULL);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, status);
}

static void a_push_that_finds_no_room_leaves_no_trace(void)
{
    const chain_motion_t m = chain_lively(0);
    for (int broken = 0; broken < 2;
         ++broken) { /* the sensor of one joint only, so that the other one's inbox is full first */
        setUp();
        jcal_triple_t triple = chain_sample(&m, 0);
        for (uint32_t k = 0; k < 2u * JCAL_INBOX_CAPACITY; ++k) {
            triple = chain_sample(&m, k);
            if (k == 2u) {
                *((broken == 0) ? &triple.imu1.gyr_rad_s.x : &triple.imu3.gyr_rad_s.x) = NAN;
            }
            const jcal_chain_t before = engine;
            const jcal_status_t status = jcal_chain_push(&engine, &triple, NULL);
            TEST_ASSERT_EQUAL_INT((k == 2u) ? JCAL_REJECTED : ((k < JCAL_INBOX_CAPACITY) ? JCAL_OK : JCAL_ERR_FULL),
                                  status);
            if (status == JCAL_ERR_FULL) {
                TEST_ASSERT_EQUAL_UINT32((k - JCAL_INBOX_CAPACITY) + 1u, result().head.overrun);
                TEST_ASSERT_EQUAL_MEMORY(&before.hip, &engine.hip, sizeof before.hip);
                TEST_ASSERT_EQUAL_MEMORY(&before.knee, &engine.knee, sizeof before.knee);
            }
        }
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_step(&engine));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_push(&engine, &triple, NULL)); /* the same once more */
    }
}

static void update_is_push_and_step_and_makes_room(void)
{
    static jcal_chain_t other;
    const chain_motion_t m = chain_lively(0);
    other = engine;
    for (uint32_t k = 0; k < 300u; ++k) {
        const jcal_triple_t triple = chain_sample(&m, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_update(&engine, &triple, NULL));
        (void)jcal_chain_push(&other, &triple, NULL);
        (void)jcal_chain_step(&other);
    }
    const jcal_chain_result_t a = result();
    jcal_chain_result_t b;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_get(&other, &b));
    TEST_ASSERT_EQUAL_MEMORY(&a, &b, sizeof a);
    for (uint32_t k = 300u; k < 310u; ++k) {
        const jcal_triple_t triple = chain_sample(&m, k);
        (void)jcal_chain_push(&engine, &triple, NULL); /* until it is full */
    }
    for (uint32_t k = 310u; k < 330u; ++k) {
        const jcal_triple_t triple = chain_sample(&m, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_update(&engine, &triple, NULL));
    }
    jcal_triple_t bad = chain_sample(&m, 330u);
    bad.imu2.acc_m_s2.x = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_chain_update(&engine, &bad, NULL));
}

/* The knee is judged once more. */
static void judge_knee(float bound_m)
{
    say(&engine.knee, JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, bound_m);
    (void)jcal_chain_step(&engine);
}

static void ready_by_what_ties_both_is_left_later_than_it_is_entered(void)
{
    const float limit_m = config.center.max_bound_m;
    say(&engine.hip, JCAL_READY, JCAL_REASON_NONE, 0.5f * limit_m);
    judge_knee(1.1f * limit_m);
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
    judge_knee(0.99f * limit_m);
    assert_said(JCAL_READY, JCAL_WEAK_NONE, JCAL_REASON_NONE);
    judge_knee(1.1f * limit_m);
    assert_said(JCAL_READY, JCAL_WEAK_NONE, JCAL_REASON_NONE);
    judge_knee(1.1f * limit_m);
    assert_said(JCAL_READY, JCAL_WEAK_NONE, JCAL_REASON_NONE);
    judge_knee(1.25f * limit_m);
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
    judge_knee(1.1f * limit_m);
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
}

static float knees_worst_m(void)
{
    const jcal_chain_result_t r = result();
    return fmaxf(r.uncertainty_m[JCAL_CHAIN_KNEE_TO_THIGH], r.uncertainty_m[JCAL_CHAIN_KNEE_TO_SHANK]);
}

static void a_tie_that_makes_ready_does_so_while_bounds_breathe(void)
{
    const float own_m = 0.03f;
    make_up_both();
    engine.knee.work.sums.point.b1 = engine.hip.work.sums.point.b2;
    engine.cfg.plane_normal = jcal_vec3(0.0f, 0.0f, 1.0f); /* across the knee's axis, where a tie buys something */
    engine.cfg.plane_tolerance_m = 1e-3f;
    const jcal_vec3_t hip = engine.hip.work.sums.point.place.r2;
    engine.knee.work.sums.point.place.r1 = jcal_vec3_sub(hip, jcal_vec3(0.0f, 0.4f, 0.0f)); /* which fits */
    say(&engine.hip, JCAL_READY, JCAL_REASON_NONE, 0.01f);
    judge_knee(own_m);
    const float limit_m = 1.01f * knees_worst_m();
    TEST_ASSERT_TRUE(limit_m < 0.9f * own_m);
    engine.cfg.center.max_bound_m = limit_m;
    assert_said(JCAL_READY, JCAL_WEAK_NONE, JCAL_REASON_NONE);
    judge_knee(1.1f * own_m);
    TEST_ASSERT_TRUE(knees_worst_m() > limit_m);
    assert_said(JCAL_READY, JCAL_WEAK_NONE, JCAL_REASON_NONE);
    judge_knee(1.5f * own_m);
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
    judge_knee(1.3f * own_m);
    assert_said(JCAL_COLLECTING, JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN);
    judge_knee(own_m);
    assert_said(JCAL_READY, JCAL_WEAK_NONE, JCAL_REASON_NONE);
}

static void what_was_never_prepared_does_nothing(void)
{
    const chain_motion_t m = chain_lively(0);
    const jcal_triple_t triple = chain_sample(&m, 0);
    memset(&engine, 0, sizeof engine);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_push(&engine, &triple, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_step(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_update(&engine, &triple, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_chain_reset(&engine));
    TEST_ASSERT_FALSE(result().has_places);
    TEST_ASSERT_EQUAL_STRING("config", jcal_chain_config_check(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chain_update(NULL, &triple, NULL));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(lively_motion_gets_ready_and_the_truth_is_inside);
    RUN_TEST(orientations_with_headings_of_their_own_do_as_well);
    RUN_TEST(a_hinge_for_a_knee_needs_its_axis);
    RUN_TEST(a_known_length_is_kept);
    RUN_TEST(a_length_that_contradicts_the_data_is_left_out_and_never_ready);
    RUN_TEST(the_thighs_accelerometer_has_one_bias);
    RUN_TEST(what_is_tied_is_what_the_joints_state);
    RUN_TEST(a_joint_that_does_not_fit_is_not_made_ready_by_small_bounds);
    RUN_TEST(an_observation_moves_what_is_known_worse);
    RUN_TEST(the_plane_pulls_both_centres_towards_it);
    RUN_TEST(both_joints_become_one_gaussian_as_wide_as_their_bounds);
    RUN_TEST(bounds_are_those_of_the_tied_gaussian);
    RUN_TEST(a_bias_known_twice_is_known_better);
    RUN_TEST(a_length_that_turns_the_thigh_is_met);
    RUN_TEST(the_weaker_joint_is_named);
    RUN_TEST(there_are_places_once_both_joints_have_theirs);
    RUN_TEST(a_stiff_hip_is_never_ready);
    RUN_TEST(a_slip_of_the_shanks_sensor_is_noticed);
    RUN_TEST(rejected_samples_are_counted_once);
    RUN_TEST(every_field_out_of_its_range_is_named);
    RUN_TEST(a_joint_without_a_sample_does_not_hold_up_the_other);
    RUN_TEST(null_is_refused);
    RUN_TEST(reset_forgets_and_a_full_inbox_says_so);
    RUN_TEST(a_push_that_finds_no_room_leaves_no_trace);
    RUN_TEST(update_is_push_and_step_and_makes_room);
    RUN_TEST(ready_by_what_ties_both_is_left_later_than_it_is_entered);
    RUN_TEST(a_tie_that_makes_ready_does_so_while_bounds_breathe);
    RUN_TEST(what_was_never_prepared_does_nothing);
    return UNITY_END();
}
