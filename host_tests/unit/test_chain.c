/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/chain.h: hip and knee together, what ties them, what is never ready, and the interface.
#include "calib/center_judge.h"
#include "calib/chain_tie.h"
#include "chain_motion.h"
#include "jointcal/vec3.h"
#include "math/chol.h"
#include "math/sym.h"

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
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.status);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_NONE, r.weak);
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
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.status);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_CENTER2, r.weak);
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
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.status);
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
        TEST_ASSERT_TRUE(result().status != JCAL_READY);
    }
    const jcal_chain_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, r.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.hint);
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
    TEST_ASSERT_TRUE(jcal_chain_collect(&engine, &state));
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
    TEST_ASSERT_TRUE(jcal_chain_collect(&engine, &state));
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
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().status);
    engine.hip.work.verdict.status = (uint8_t)JCAL_COLLECTING;
    engine.hip.work.verdict.reason = (uint8_t)JCAL_REASON_DOES_NOT_FIT;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result().status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, result().reason);
    engine.hip.work.verdict.reason =
        (uint8_t)JCAL_REASON_UNCERTAIN; /* then what ties both may have made it small enough */
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().status);
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

static void a_stiff_hip_is_never_ready(void)
{
    chain_motion_t m = chain_lively(1);
    m.hip.dof = CENTER_STIFF;
    for (int k = 0; k < 10; ++k) {
        run(&m, 0.1 * NEVER_S * k, 0.1 * NEVER_S * (k + 1));
        TEST_ASSERT_TRUE(result().status != JCAL_READY);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_CENTER1, result().weak);
}

static void a_slip_of_the_shanks_sensor_is_noticed(void)
{
    chain_motion_t m = chain_lively(0);
    run(&m, 0.0, 25.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().status);
    m.knee_to_shank[0] += 0.1;
    bool moved = false;
    for (int k = 0; k < 50; ++k) {
        run(&m, 25.0 + 0.1 * k, 25.1 + 0.1 * k);
        moved = moved || (result().status == JCAL_MOVED);
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
    const jcal_chain_result_t r = result();
    TEST_ASSERT_EQUAL_UINT32(102u, r.samples);
    TEST_ASSERT_EQUAL_UINT32(2u, r.rejected);
    TEST_ASSERT_EQUAL_UINT32(1u, r.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_UINT32(1u, r.rejected_by[JCAL_REJECT_OUT_OF_RANGE]);
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
    TEST_ASSERT_EQUAL_UINT32(0u, r.samples);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, r.segment_length_m);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.reason);
    jcal_status_t status = JCAL_OK;
    for (uint32_t k = 0; (k < 20u) && (status == JCAL_OK); ++k) {
        const jcal_triple_t triple = chain_sample(&m, k);
        status = jcal_chain_push(&engine, &triple, NULL);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, status);
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
    RUN_TEST(a_stiff_hip_is_never_ready);
    RUN_TEST(a_slip_of_the_shanks_sensor_is_noticed);
    RUN_TEST(rejected_samples_are_counted_once);
    RUN_TEST(every_field_out_of_its_range_is_named);
    RUN_TEST(null_is_refused);
    RUN_TEST(reset_forgets_and_a_full_inbox_says_so);
    return UNITY_END();
}
