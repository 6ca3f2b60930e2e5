/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/center.h: what the stream engine finds, what it never finds, and its interface.
#include "center/input.h"
#include "center/model.h"
#include "jointcal/center.h"
#include "jointcal/vec3.h"
#include "math/sym.h"
#include "unit/center/faults.h"
#include "unit/center/motion.h"

#include <string.h>
#include <unity.h>

#ifdef JCAL_TEST_SHORT
#define SEEDS 2
#define NEVER_SEEDS 1
#define NEVER_S 12.0
#define HINGE_S 30.0
#else
#define SEEDS 12
#define NEVER_SEEDS 4
#define NEVER_S 60.0
#define HINGE_S 60.0
#endif

static jcal_center_t engine;
static jcal_center_config_t config;

void setUp(void)
{
    config = jcal_center_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
}

void tearDown(void)
{
}

static jcal_center_result_t result_of(const jcal_center_t *self)
{
    jcal_center_result_t r;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_get(self, &r));
    return r;
}

static void run(jcal_center_t *self, const center_motion_t *m, double from_s, double to_s)
{
    for (uint32_t k = (uint32_t)(from_s * m->rate_hz); k < (uint32_t)(to_s * m->rate_hz); ++k) {
        const jcal_pair_t pair = center_sample(m, k);
        (void)jcal_center_update(self, &pair);
    }
}

/* Runs until ready or until the end; when, s, or -1. */
static double run_until_ready(jcal_center_t *self, const center_motion_t *m, double from_s, double to_s)
{
    for (uint32_t k = (uint32_t)(from_s * m->rate_hz); k < (uint32_t)(to_s * m->rate_hz); ++k) {
        const jcal_pair_t pair = center_sample(m, k);
        (void)jcal_center_update(self, &pair);
        if (result_of(self).head.status == JCAL_READY) {
            return (double)k / m->rate_hz;
        }
    }
    return -1.0;
}

static void assert_inside(const center_motion_t *m)
{
    const jcal_center_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor1_m, m->r1) < (double)r.uncertainty1_m);
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor2_m, m->r2) < (double)r.uncertainty2_m);
    TEST_ASSERT_TRUE(r.uncertainty1_m <= config.max_bound_m * 1.2f);
    TEST_ASSERT_TRUE(r.uncertainty_weakest1_m <= r.uncertainty1_m);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.0f, jcal_vec3_norm(r.weakest_direction2));
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_NONE, r.head.weak);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, r.head.reason);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, r.progress1);
}

static void lively_motion_gets_ready_and_the_truth_is_inside(void)
{
    for (int seed = 0; seed < SEEDS; ++seed) {
        const center_motion_t m = center_lively(seed);
        setUp();
        const double at_s = run_until_ready(&engine, &m, 0.0, 30.0);
        TEST_ASSERT_TRUE(at_s > 4.0);
        assert_inside(&m);
        run(&engine, &m, at_s, 30.0);
        assert_inside(&m);
        const jcal_center_result_t r = result_of(&engine);
        TEST_ASSERT_TRUE(center_error(r.joint_to_sensor1_m, m.r1) < 0.004);
        TEST_ASSERT_TRUE(center_error(r.joint_to_sensor2_m, m.r2) < 0.004);
    }
}

static void any_rate_of_samples_will_do(void)
{
    const double rates[] = {25.0, 60.0, 100.0, 200.0};
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; ++i) {
        center_motion_t m = center_lively((int)i);
        m.rate_hz = rates[i];
        setUp();
        run(&engine, &m, 0.0, 25.0);
        assert_inside(&m);
    }
}

static void two_axes_are_enough(void)
{
    center_motion_t m = center_lively(3);
    m.dof = CENTER_TWO_AXES;
    run(&engine, &m, 0.0, 30.0);
    assert_inside(&m);
}

static void biases_are_told_from_positions(void)
{
    center_motion_t m = center_lively(5);
    m.bias1[2] = 0.3;
    m.bias2[0] = -0.3;
    run(&engine, &m, 0.0, 40.0);
    assert_inside(&m);
    const jcal_center_result_t r = result_of(&engine);
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor1_m, m.r1) < 0.003);
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor2_m, m.r2) < 0.003);
    TEST_ASSERT_FLOAT_WITHIN(0.05f, 0.3f, r.acc_bias1_m_s2.z);
    TEST_ASSERT_FLOAT_WITHIN(0.05f, -0.3f, r.acc_bias2_m_s2.x);
}

static void knocks_hardly_matter_to_absolute_differences(void)
{
    double error[2];
    for (int method = 0; method < 2; ++method) {
        const center_motion_t m = center_lively(7);
        config.method = (jcal_center_method_t)method;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
        for (uint32_t k = 0; k < 1500u; ++k) {
            jcal_pair_t pair = center_sample(&m, k);
            if ((k % 50u) < 2u) {
                pair.imu1.acc_m_s2 = jcal_vec3_scale(pair.imu1.acc_m_s2, 1.5f);
            }
            (void)jcal_center_update(&engine, &pair);
        }
        const jcal_center_result_t r = result_of(&engine);
        error[method] = center_error(r.joint_to_sensor1_m, m.r1) + center_error(r.joint_to_sensor2_m, m.r2);
    }
    TEST_ASSERT_TRUE(error[JCAL_CENTER_SA] < 0.5 * error[JCAL_CENTER_SS]);
}

static void orientations_give_the_centre_and_the_heading_offset(void)
{
    const double headings[] = {0.0, 1.0, -2.5, 3.1};
    config.method = JCAL_CENTER_LS;
    for (int i = 0; i < 4; ++i) {
        const center_motion_t m = center_lively(i);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
        for (uint32_t k = 0; k < (uint32_t)(30.0 * m.rate_hz); ++k) {
            const jcal_pair_t pair = center_sample(&m, k);
            const jcal_attitudes_t attitudes = center_attitudes(&m, k, headings[i]);
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_push_oriented(&engine, &pair, &attitudes));
            (void)jcal_center_step(&engine);
        }
        assert_inside(&m);
        const jcal_center_result_t r = result_of(&engine);
        TEST_ASSERT_TRUE(center_error(r.joint_to_sensor1_m, m.r1) < 0.003);
        TEST_ASSERT_TRUE(center_error(r.joint_to_sensor2_m, m.r2) < 0.003);
        TEST_ASSERT_FLOAT_WITHIN(0.01f, 0.0f, (float)sin((double)r.heading_offset_rad - headings[i]));
        TEST_ASSERT_TRUE(cos((double)r.heading_offset_rad - headings[i]) > 0.0);
    }
}

static void orientations_are_needed_by_their_method_and_must_be_of_length_one(void)
{
    const center_motion_t m = center_lively(1);
    const jcal_pair_t pair = center_sample(&m, 1);
    jcal_attitudes_t attitudes = center_attitudes(&m, 1, 0.0);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_push_oriented(&engine, &pair, &attitudes)); /* not needed, welcome */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_step(&engine));
    config.method = JCAL_CENTER_LS;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_push(&engine, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_push_oriented(&engine, &pair, NULL));
    attitudes.q2.w += 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_center_push_oriented(&engine, &pair, &attitudes));
    TEST_ASSERT_EQUAL_UINT32(1u, result_of(&engine).head.rejected_by[JCAL_REJECT_OUT_OF_RANGE]);
    attitudes.q2.w = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_center_push_oriented(&engine, &pair, &attitudes));
    TEST_ASSERT_EQUAL_UINT32(2u, result_of(&engine).head.rejected);
    attitudes = center_attitudes(&m, 1, 0.0);
    attitudes.q1.x -= 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_center_push_oriented(&engine, &pair, &attitudes));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_push_oriented(NULL, &pair, &attitudes));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_push_oriented(&engine, NULL, &attitudes));
}

static void exchanged_sensors_give_the_exchanged_result(void)
{
    const center_motion_t m = center_lively(2);
    jcal_center_t other;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&other, &config));
    for (uint32_t k = 0; k < 1000u; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        const jcal_pair_t exchanged = {pair.t_us, pair.imu2, pair.imu1};
        (void)jcal_center_update(&engine, &pair);
        (void)jcal_center_update(&other, &exchanged);
    }
    const jcal_center_result_t a = result_of(&engine);
    const jcal_center_result_t b = result_of(&other);
    TEST_ASSERT_EQUAL_INT(a.head.status, b.head.status);
    const double r1[3] = {(double)a.joint_to_sensor1_m.x, (double)a.joint_to_sensor1_m.y,
                          (double)a.joint_to_sensor1_m.z};
    const double r2[3] = {(double)a.joint_to_sensor2_m.x, (double)a.joint_to_sensor2_m.y,
                          (double)a.joint_to_sensor2_m.z};
    printf("%g %g\n", center_error(b.joint_to_sensor2_m, r1), center_error(b.joint_to_sensor1_m, r2));
    TEST_ASSERT_TRUE(center_error(b.joint_to_sensor2_m, r1) < 1e-4);
    TEST_ASSERT_TRUE(center_error(b.joint_to_sensor1_m, r2) < 1e-4);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, a.uncertainty1_m,
                             b.uncertainty2_m); /* rounding may begin the sums a sample earlier */
}

/* Runs a motion; never ready. The last result. */
static jcal_center_result_t never(const center_motion_t *m, double duration_s)
{
    setUp();
    TEST_ASSERT_TRUE(run_until_ready(&engine, m, 0.0, duration_s) < 0.0);
    return result_of(&engine);
}

static void motion_that_leaves_something_open_is_never_ready(void)
{
    for (int seed = 0; seed < NEVER_SEEDS; ++seed) {
        center_motion_t m = center_lively(seed);
        m.dof = CENTER_STIFF;
        (void)never(&m, NEVER_S);
        m = center_lively(seed);
        m.base = 0.0;
        m.carried = 0.0;
        jcal_center_result_t r = never(&m, NEVER_S);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_MOTION, r.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_SEGMENT1, r.head.hint);
        m.joint = 0.0;
        r = never(&m, NEVER_S);
        TEST_ASSERT_FALSE(r.has_center);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.head.reason);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty1_m);
    }
}

static void along_a_hinge_nothing_is_known(void)
{
    for (int seed = 0; seed < NEVER_SEEDS; ++seed) {
        center_motion_t m = center_lively(seed);
        m.dof = CENTER_HINGE;
        const jcal_center_result_t r = never(&m, HINGE_S);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, r.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_MORE_DIRECTIONS, r.head.hint);
        TEST_ASSERT_TRUE(r.uncertainty_weakest1_m > 0.1f);
        const jcal_vec3_t axis1 = pose_axis(pose_conj(pose_any(7 * seed + 1)), 2);
        TEST_ASSERT_TRUE(fabsf(jcal_vec3_dot(axis1, r.weakest_direction1)) > 0.99f);
    }
}

static void with_its_axis_known_a_hinge_has_a_centre_next_to_the_sensors(void)
{
    center_motion_t m = center_lively(1);
    m.dof = CENTER_HINGE;
    /* z of segment 1; of segment 2 what the later, constant turns make of it */
    const pose_quat_t fixed = pose_mul(pose_turn(0.2, 0.0, 1.0, 0.0), pose_turn(0.1, 1.0, 0.0, 0.0));
    config.hinge_axis1 = pose_axis(pose_conj(pose_any(7 + 1)), 2);
    config.hinge_axis2 = pose_axis(pose_conj(pose_mul(fixed, pose_any(7 + 2))), 2);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
    run(&engine, &m, 0.0, 40.0);
    const jcal_center_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    TEST_ASSERT_TRUE(r.uncertainty_weakest1_m > 0.1f);
    const float along = jcal_vec3_dot(config.hinge_axis1, r.joint_to_sensor1_m) +
                        jcal_vec3_dot(config.hinge_axis2, r.joint_to_sensor2_m);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.0f, along); /* (11), (12) of SAL15: as far to one sensor as to the other */
    double truth_along = 0.0;
    for (int i = 0; i < 3; ++i) {
        const float *const a1 =
            (i == 0) ? &config.hinge_axis1.x : ((i == 1) ? &config.hinge_axis1.y : &config.hinge_axis1.z);
        const float *const a2 =
            (i == 0) ? &config.hinge_axis2.x : ((i == 1) ? &config.hinge_axis2.y : &config.hinge_axis2.z);
        truth_along += 0.5 * (m.r1[i] * (double)*a1 + m.r2[i] * (double)*a2);
    }
    const double shifted1[3] = {m.r1[0] - truth_along * (double)config.hinge_axis1.x,
                                m.r1[1] - truth_along * (double)config.hinge_axis1.y,
                                m.r1[2] - truth_along * (double)config.hinge_axis1.z};
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor1_m, shifted1) < 0.005);
}

static void sensors_that_share_no_joint_do_not_fit(void)
{
    for (int seed = 0; seed < 4; ++seed) {
        /* Joints that hardly move are alike: gravity is what both feel. These are carried around. */
        center_motion_t a = center_lively(seed);
        center_motion_t b = center_lively(seed + 10);
        a.carried = 0.15;
        b.carried = 0.15;
        setUp();
        for (uint32_t k = 0; k < (uint32_t)(NEVER_S * a.rate_hz); ++k) {
            jcal_pair_t pair = center_sample(&a, k);
            pair.imu2 = center_imu(&b, 2, k);
            (void)jcal_center_update(&engine, &pair);
            TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, result_of(&engine).head.reason);
    }
}

static void noise_and_wrong_units_are_never_ready(void)
{
    for (uint32_t k = 0; k < (uint32_t)(NEVER_S * 50.0); ++k) {
        jcal_pair_t pair = {
            20000u * (uint64_t)k, {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 9.81f}}, {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 9.81f}}};
        float *const values[4] = {&pair.imu1.gyr_rad_s.x, &pair.imu1.acc_m_s2.x, &pair.imu2.gyr_rad_s.x,
                                  &pair.imu2.acc_m_s2.x};
        for (uint32_t i = 0; i < 12u; ++i) {
            values[i / 3u][i % 3u] += (float)center_noise(k, i);
        }
        (void)jcal_center_update(&engine, &pair);
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    }
    setUp();
    const center_motion_t m = center_lively(1);
    for (uint32_t k = 0; k < 1000u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        pair.imu1.gyr_rad_s = jcal_vec3_scale(pair.imu1.gyr_rad_s, 57.3f);
        pair.imu2.gyr_rad_s = jcal_vec3_scale(pair.imu2.gyr_rad_s, 57.3f);
        (void)jcal_center_update(&engine, &pair);
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_GYR, result_of(&engine).head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, result_of(&engine).head.hint);
}

static void a_slip_is_noticed_and_calibrated_anew(void)
{
    const center_motion_t m = center_lively(4);
    run(&engine, &m, 0.0, 20.0);
    assert_inside(&m);
    const pose_quat_t slip = pose_turn(0.6, 1.0, 2.0, -1.0);
    double moved_s = -1.0;
    double again_s = -1.0;
    for (uint32_t k = 1000u; k < 3000u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        const double g[3] = {(double)pair.imu1.gyr_rad_s.x, (double)pair.imu1.gyr_rad_s.y,
                             (double)pair.imu1.gyr_rad_s.z};
        const double a[3] = {(double)pair.imu1.acc_m_s2.x, (double)pair.imu1.acc_m_s2.y, (double)pair.imu1.acc_m_s2.z};
        double out[3];
        center_turn(slip, g, out);
        pair.imu1.gyr_rad_s = jcal_vec3((float)out[0], (float)out[1], (float)out[2]);
        center_turn(slip, a, out);
        pair.imu1.acc_m_s2 = jcal_vec3((float)out[0], (float)out[1], (float)out[2]);
        (void)jcal_center_update(&engine, &pair);
        const jcal_calibration_t status = result_of(&engine).head.status;
        moved_s = ((moved_s < 0.0) && (status == JCAL_MOVED)) ? (0.02 * (double)(k - 1000u)) : moved_s;
        again_s =
            ((moved_s > 0.0) && (again_s < 0.0) && (status == JCAL_READY)) ? (0.02 * (double)(k - 1000u)) : again_s;
    }
    TEST_ASSERT_TRUE((moved_s > 0.0) && (moved_s < 5.0));
    TEST_ASSERT_TRUE(again_s > moved_s);
    double r1[3];
    center_turn(slip, m.r1, r1);
    TEST_ASSERT_TRUE(center_error(result_of(&engine).joint_to_sensor1_m, r1) < 0.005);
}

static void rest_after_ready_changes_nothing(void)
{
    center_motion_t m = center_lively(6);
    run(&engine, &m, 0.0, 25.0);
    assert_inside(&m);
    center_motion_t still = m;
    still.base = 0.0;
    still.joint = 0.0;
    still.carried = 0.0;
    const uint32_t rest = (uint32_t)(50.0 * 60.0 * ((NEVER_S > 30.0) ? 60.0 : 2.0)); /* an hour */
    for (uint32_t k = 0; k < rest; ++k) {
        const jcal_pair_t pair = center_sample(&still, 1250u + k);
        (void)jcal_center_update(&engine, &pair);
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_MOVED, result_of(&engine).head.status);
    }
    const jcal_center_result_t r = result_of(&engine);
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor1_m, m.r1) < (double)r.uncertainty1_m);
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor2_m, m.r2) < (double)r.uncertainty2_m);
}

static void shifting_all_times_changes_no_bit(void)
{
    const center_motion_t m = center_lively(3);
    jcal_center_t later;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&later, &config));
    for (uint32_t k = 0; k < 700u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        (void)jcal_center_update(&engine, &pair);
        pair.t_us += UINT64_C(0x123456789ABCDEF);
        (void)jcal_center_update(&later, &pair);
    }
    jcal_center_result_t a = result_of(&engine);
    jcal_center_result_t b = result_of(&later);
    TEST_ASSERT_TRUE(a.head.t_us + UINT64_C(0x123456789ABCDEF) == b.head.t_us);
    a.head.t_us = 0u;
    b.head.t_us = 0u;
    TEST_ASSERT_EQUAL_MEMORY(&a, &b, sizeof a);
}

static void push_and_step_are_update_and_a_copy_goes_on_alike(void)
{
    const center_motion_t m = center_lively(3);
    jcal_center_t split;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&split, &config));
    for (uint32_t k = 0; k < 600u; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_update(&engine, &pair));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_push(&split, &pair));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_step(&split));
        if (k == 300u) {
            const jcal_center_t copy = split;
            memset(&split, 0xA5, sizeof split);
            split = copy;
        }
    }
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_center_step(&split));
    const jcal_center_result_t a = result_of(&engine);
    const jcal_center_result_t b = result_of(&split);
    TEST_ASSERT_EQUAL_MEMORY(&a, &b, sizeof a);
}

static void a_full_inbox_says_so(void)
{
    const center_motion_t m = center_lively(3);
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_push(&engine, &pair));
    }
    const jcal_pair_t pair = center_sample(&m, JCAL_INBOX_CAPACITY);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, jcal_center_push(&engine, &pair));
    TEST_ASSERT_EQUAL_UINT32(JCAL_INBOX_CAPACITY, result_of(&engine).head.samples);
}

static void null_is_refused(void)
{
    const jcal_pair_t pair = {0};
    jcal_center_result_t r;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_init(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_push(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_push(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_get(NULL, &r));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_get(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_reset(&engine));
}

static void every_field_out_of_its_range_is_named(void)
{
    jcal_center_config_t c = config;
    const struct {
        const char *name;
        float *field;
        float low, high;
    } fields[] = {
        {"max_bound_m", &c.max_bound_m, 0.001f, 0.1f},          {"mismatch_m", &c.mismatch_m, 0.0f, 0.05f},
        {"acc_noise_m_s2", &c.acc_noise_m_s2, 1e-3f, 10.0f},    {"turn_error", &c.turn_error, 0.0f, 0.5f},
        {"acc_bias_m_s2", &c.acc_bias_m_s2, 0.0f, 2.0f},        {"min_rate_rad_s", &c.min_rate_rad_s, 0.0f, 20.0f},
        {"smoothing_s", &c.kinematics.smoothing_s, 0.0f, 2.0f}, {"memory_s", &c.memory_s, 10.0f, 3600.0f},
        {"gate.frozen_s", &c.gate.frozen_s, 0.02f, 10.0f},
    };
    TEST_ASSERT_NULL(jcal_center_config_check(&config));
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; ++i) {
        const float bad[4] = {nextafterf(fields[i].low, -1.0f), nextafterf(fields[i].high, INFINITY), NAN, INFINITY};
        for (int k = 0; k < 4; ++k) {
            c = config;
            *fields[i].field = bad[k];
            TEST_ASSERT_EQUAL_STRING(fields[i].name, jcal_center_config_check(&c));
            TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_center_init(&engine, &c));
        }
        c = config;
        *fields[i].field = fields[i].low;
        TEST_ASSERT_NULL(jcal_center_config_check(&c));
        *fields[i].field = fields[i].high;
        TEST_ASSERT_NULL(jcal_center_config_check(&c));
    }
    c = config;
    c.method = (jcal_center_method_t)3;
    TEST_ASSERT_EQUAL_STRING("method", jcal_center_config_check(&c));
    c.method = (jcal_center_method_t)-1;
    TEST_ASSERT_EQUAL_STRING("method", jcal_center_config_check(&c));
    c = config;
    c.kinematics.derivative = (jcal_derivative_t)2;
    TEST_ASSERT_EQUAL_STRING("derivative", jcal_center_config_check(&c));
    c.kinematics.derivative = (jcal_derivative_t)-1;
    TEST_ASSERT_EQUAL_STRING("derivative", jcal_center_config_check(&c));
    c = config;
    c.hinge_axis1 = jcal_vec3(0.5f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL_STRING("hinge_axis1", jcal_center_config_check(&c));
    c.hinge_axis1 = jcal_vec3(1.0f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL_STRING("hinge_axis2", jcal_center_config_check(&c)); /* one without the other */
    c.hinge_axis2 = jcal_vec3(0.0f, 2.0f, 0.0f);
    TEST_ASSERT_EQUAL_STRING("hinge_axis2", jcal_center_config_check(&c));
    c.hinge_axis2 = jcal_vec3(0.0f, 1.0f, 0.0f);
    TEST_ASSERT_NULL(jcal_center_config_check(&c));
}

/* How many samples of 20 readings with steady rates about z count as slow. */
static int slow_ones(float rate1, float rate2)
{
    static jcal_center_input_t input;
    jcal_center_input_begin(&input);
    config.min_rate_rad_s = 0.5f;
    config.kinematics.smoothing_s = 0.0f;
    int slow = 0;
    int samples = 0;
    for (uint32_t k = 0; k < 20u; ++k) {
        const float wobble = 1e-3f * (float)center_noise(k, 1u); /* readings that never change are refused */
        const jcal_pair_t pair = {20000u * (uint64_t)k,
                                  {{0.0f, 0.0f, rate1 + wobble}, {wobble, 0.0f, 9.81f + wobble}},
                                  {{0.0f, 0.0f, rate2 + wobble}, {wobble, 0.0f, 9.81f + wobble}}};
        jcal_kinematic_t sample;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_input_push(&input, &config, &pair, NULL));
        const jcal_center_input_event_t event = jcal_center_input_take(&input, &config, &sample);
        slow += (event == JCAL_CENTER_SLOW) ? 1 : 0;
        samples += ((event == JCAL_CENTER_SLOW) || (event == JCAL_CENTER_SAMPLE)) ? 1 : 0;
    }
    TEST_ASSERT_EQUAL_INT(15, samples);
    return slow;
}

static void a_sample_is_slow_if_both_sensors_are(void)
{
    TEST_ASSERT_EQUAL_INT(15, slow_ones(0.4f, 0.4f));
    TEST_ASSERT_EQUAL_INT(0, slow_ones(0.6f, 0.1f));
    TEST_ASSERT_EQUAL_INT(0, slow_ones(0.1f, 0.6f));
    TEST_ASSERT_EQUAL_INT(0, slow_ones(0.6f, 0.6f));
}

static void moments_are_weighted_by_the_noise_of_the_difference_of_squares(void)
{
    const center_motion_t m = center_lively(2);
    jcal_kinematics_t chain;
    jcal_kinematics_begin(&chain);
    double sums[3] = {0.0, 0.0, 0.0};
    for (uint32_t k = 0; k < 24u; ++k) { /* less than half a second of motion: no work yet */
        const jcal_pair_t pair = center_sample(&m, k);
        jcal_kinematic_t s;
        (void)jcal_center_update(&engine, &pair);
        if (jcal_kinematics_put(&chain, &config.kinematics, &pair, NULL, &s)) {
            float f[JCAL_CENTER_FEATURES];
            jcal_center_features(&s, f);
            /* |a1|^2 - |a2|^2 = (|a1| - |a2|) (|a1| + |a2|): the noise of |a1| - |a2| times their sum, one reading in 0.1 s */
            const double noise = 0.05 * ((double)jcal_vec3_norm(s.body1.a) + (double)jcal_vec3_norm(s.body2.a));
            const double weight = (double)s.dt_s / 0.1 / (noise * noise);
            sums[0] += weight * (double)f[0] * (double)f[0];
            sums[1] += weight * (double)f[1] * (double)f[0];
            sums[2] += weight * (double)f[12] * (double)f[12];
        }
    }
    const float *const moments = engine.work.as.moments;
    TEST_ASSERT_TRUE(sums[2] > 0.0);
    TEST_ASSERT_TRUE(fabs((double)moments[0] - sums[0]) < 1e-4 * sums[0]);
    TEST_ASSERT_TRUE(fabs((double)moments[jcal_sym_at(1u, 0u)] - sums[1]) < 1e-3 * fabs(sums[1]));
    TEST_ASSERT_TRUE(fabs((double)moments[jcal_sym_at(12u, 12u)] - sums[2]) < 1e-4 * sums[2]);
}

static void moments_of_the_memory_count_half(void)
{
    const center_motion_t m = center_lively(2);
    config.memory_s = 10.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
    run(&engine, &m, 0.0, 0.4);
    engine.moving_s = config.memory_s; /* as if there had been no start in all that time */
    const float before = engine.work.as.moments[jcal_sym_at(12u, 12u)];
    run(&engine, &m, 0.4, 0.421);
    const float after = engine.work.as.moments[jcal_sym_at(12u, 12u)];
    TEST_ASSERT_TRUE((after >= 0.5f * before) && (after < 0.7f * before)); /* and one sample more */
    TEST_ASSERT_FLOAT_WITHIN(0.02f, 5.0f, engine.moving_s);
}

/* The sample with which the sums begin. */
static uint32_t begin_of_sums(float acc_noise_m_s2)
{
    center_motion_t m = center_lively(1);
    m.noise = 0.1;
    m.base = 0.1; /* so little motion that it takes a while to be known */
    m.joint = 0.1;
    config.acc_noise_m_s2 = acc_noise_m_s2;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
    for (uint32_t k = 0; k < 500u; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        (void)jcal_center_update(&engine, &pair);
        if (engine.has_point) {
            return k;
        }
    }
    return 0u;
}

static void a_start_takes_residuals_for_as_large_as_they_are(void)
{
    /* of readings that are noisier than either config says: whichever it says, the same is known */
    const uint32_t begin = begin_of_sums(1.0f / 512.0f);
    TEST_ASSERT_GREATER_THAN_UINT32(100u, begin);
    TEST_ASSERT_EQUAL_UINT32(begin, begin_of_sums(1.0f / 32.0f));
}

static float way_between(const jcal_center_place_t *a, const jcal_center_place_t *b)
{
    const jcal_vec3_t d1 = jcal_vec3_sub(a->r1, b->r1);
    const jcal_vec3_t d2 = jcal_vec3_sub(a->r2, b->r2);
    return sqrtf(jcal_vec3_dot(d1, d1) + jcal_vec3_dot(d2, d2));
}

static void the_start_comes_in_steps_of_a_foot_at_most(void)
{
    center_motion_t m = center_lively(1);
    m.r1[0] = 1.5; /* five steps away */
    float longest = 0.0f;
    for (uint32_t k = 0; (k < 600u) && !engine.has_start; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        const jcal_center_place_t before = engine.start;
        (void)jcal_center_update(&engine, &pair);
        longest = fmaxf(longest, way_between(&engine.start, &before));
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.3f, longest);
}

static void samples_and_work_take_turns(void)
{
    center_motion_t m = center_lively(1);
    m.rate_hz = 100.0;
    uint32_t works = 0u;
    for (uint32_t k = 0; k < 2000u; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        const float time_s = engine.work.sums.time_s;
        const uint8_t turn = engine.turn;
        const bool goes_on = engine.has_point;
        (void)jcal_center_update(&engine, &pair);
        if (goes_on && (engine.turn != turn)) {
            TEST_ASSERT_EQUAL_FLOAT(time_s, engine.work.sums.time_s);
            ++works;
        }
    }
    TEST_ASSERT_TRUE(works > 700u); /* nearly every second update, once there is an estimate */
}

static void memory_has_a_limit_and_a_shorter_one_with_headings(void)
{
    const float limits[2] = {100.0f, 60.0f}; /* lengths; orientations with the same config */
    const center_motion_t m = center_lively(1);
    for (int which = 0; which < 2; ++which) {
        config.method = (which == 0) ? JCAL_CENTER_SS : JCAL_CENTER_LS;
        config.memory_s = 100.0f;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
        bool halved = false;
        for (uint32_t k = 0; (k < 320u) && !halved; ++k) {
            const jcal_pair_t pair = center_sample(&m, k);
            const jcal_attitudes_t attitudes = center_attitudes(&m, k, 0.5);
            const float before_s = engine.work.sums.time_s;
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_push_oriented(&engine, &pair, &attitudes));
            (void)jcal_center_step(&engine);
            halved = (k > 300u) && (engine.work.sums.time_s < before_s);
            if (k == 300u) {
                TEST_ASSERT_TRUE(engine.has_point);
                engine.work.sums.time_s = limits[which] - 0.11f; /* as if that had passed */
            }
            TEST_ASSERT_TRUE(engine.work.sums.time_s < limits[which] + 0.001f);
        }
        TEST_ASSERT_TRUE(halved);
        TEST_ASSERT_FLOAT_WITHIN(0.1f, 0.5f * limits[which], engine.work.sums.time_s);
    }
}

/* Begins the sums 0.25 m off the truth and with biases that are not there; false if they never begin anew within `samples`. */
static bool leaves_a_wrong_place(const center_motion_t *m, uint32_t samples, bool is_ready)
{
    config.max_bound_m = 0.001f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
    bool displaced = false;
    for (uint32_t k = 0; k < samples; ++k) {
        const jcal_pair_t pair = center_sample(m, k);
        const float before_s = engine.work.sums.time_s;
        const float before_m = engine.work.sums.point.place.r1.x;
        (void)jcal_center_update(&engine, &pair);
        if (engine.has_point && (engine.work.sums.time_s < before_s)) {
            TEST_ASSERT_TRUE(before_s > 4.0f);
            TEST_ASSERT_TRUE(fabs((double)before_m - m->r1[0]) > 0.2); /* it stays until it jumps */
            return true;
        }
        if (engine.has_start && !displaced) {
            engine.start.r1.x += 0.25f;
            displaced = true;
        }
        if (engine.has_point && (engine.work.sums.time_s == 0.0f)) {
            engine.work.sums.point.b1.y = 0.05f;
            engine.work.sums.point.b2.z = -0.05f;
        }
        if (is_ready) {
            engine.work.verdict.status = (uint8_t)JCAL_READY;
        }
    }
    return false;
}

static void sums_begin_anew_where_the_data_want_them_but_for_what_is_ready(void)
{
    const center_motion_t m = center_lively(1);
    TEST_ASSERT_TRUE(leaves_a_wrong_place(&m, 500u, false));
    const jcal_center_point_t *const p = &engine.work.sums.point;
    TEST_ASSERT_TRUE(center_error(p->place.r1, m.r1) < 0.05);
    TEST_ASSERT_TRUE(center_error(p->place.r2, m.r2) < 0.05);
    TEST_ASSERT_EQUAL_MEMORY(&p->place, &engine.work.sums.anchor, sizeof p->place);
    TEST_ASSERT_EQUAL_FLOAT(0.05f, p->b1.y); /* kept: only the place was wrong by more than a step could mend */
    TEST_ASSERT_EQUAL_FLOAT(-0.05f, p->b2.z);
    TEST_ASSERT_FALSE(leaves_a_wrong_place(&m, 500u, true));
}

static void rejected_samples_are_counted_and_break_the_chain(void)
{
    const center_motion_t m = center_lively(3);
    for (uint32_t k = 0; k < 1500u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        if ((k % 40u) == 0u) {
            pair.imu2.acc_m_s2.y = NAN;
            TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_center_update(&engine, &pair));
        } else {
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_update(&engine, &pair));
        }
    }
    const jcal_center_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_UINT32(38u, r.head.rejected);
    TEST_ASSERT_EQUAL_UINT32(38u, r.head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_UINT32(1500u, r.head.samples);
    assert_inside(&m);
}

/* On targets the first two only: each takes half a minute of samples. */
#if defined(JCAL_TEST_SHORT)
#define FAULTS_TRIED 2
#else
#define FAULTS_TRIED ((int)FAULTS)
#endif

static void begin_oriented(void)
{
    config.method = JCAL_CENTER_LS;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&engine, &config));
}

static void take_oriented(const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    (void)jcal_center_push_oriented(&engine, pair, attitudes);
    (void)jcal_center_step(&engine);
}

static jcal_center_result_t own_result(void)
{
    return result_of(&engine);
}

static void a_source_that_fails_is_not_ready_for_long(void)
{
    const center_subject_t subject = {begin_oriented, take_oriented, own_result, 30.0, FAULTS_TRIED};
    center_after_faults_it_is_not_ready(&subject);
}

static void what_was_never_prepared_does_nothing(void)
{
    const center_motion_t m = center_lively(0);
    const jcal_pair_t pair = center_sample(&m, 0);
    const jcal_attitudes_t attitudes = center_attitudes(&m, 0, 0.0);
    memset(&engine, 0, sizeof engine);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_push(&engine, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_push_oriented(&engine, &pair, &attitudes));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_update(&engine, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_step(&engine));
    TEST_ASSERT_FALSE(result_of(&engine).has_center);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_center_reset(&engine));
    TEST_ASSERT_EQUAL_STRING("config", jcal_center_config_check(NULL));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(lively_motion_gets_ready_and_the_truth_is_inside);
    RUN_TEST(any_rate_of_samples_will_do);
    RUN_TEST(two_axes_are_enough);
    RUN_TEST(biases_are_told_from_positions);
    RUN_TEST(knocks_hardly_matter_to_absolute_differences);
    RUN_TEST(orientations_give_the_centre_and_the_heading_offset);
    RUN_TEST(orientations_are_needed_by_their_method_and_must_be_of_length_one);
    RUN_TEST(exchanged_sensors_give_the_exchanged_result);
    RUN_TEST(motion_that_leaves_something_open_is_never_ready);
    RUN_TEST(along_a_hinge_nothing_is_known);
    RUN_TEST(with_its_axis_known_a_hinge_has_a_centre_next_to_the_sensors);
    RUN_TEST(sensors_that_share_no_joint_do_not_fit);
    RUN_TEST(noise_and_wrong_units_are_never_ready);
    RUN_TEST(a_slip_is_noticed_and_calibrated_anew);
    RUN_TEST(rest_after_ready_changes_nothing);
    RUN_TEST(shifting_all_times_changes_no_bit);
    RUN_TEST(push_and_step_are_update_and_a_copy_goes_on_alike);
    RUN_TEST(a_full_inbox_says_so);
    RUN_TEST(null_is_refused);
    RUN_TEST(every_field_out_of_its_range_is_named);
    RUN_TEST(a_sample_is_slow_if_both_sensors_are);
    RUN_TEST(moments_are_weighted_by_the_noise_of_the_difference_of_squares);
    RUN_TEST(moments_of_the_memory_count_half);
    RUN_TEST(a_start_takes_residuals_for_as_large_as_they_are);
    RUN_TEST(the_start_comes_in_steps_of_a_foot_at_most);
    RUN_TEST(samples_and_work_take_turns);
    RUN_TEST(memory_has_a_limit_and_a_shorter_one_with_headings);
    RUN_TEST(sums_begin_anew_where_the_data_want_them_but_for_what_is_ready);
    RUN_TEST(rejected_samples_are_counted_and_break_the_chain);
    RUN_TEST(a_source_that_fails_is_not_ready_for_long);
    RUN_TEST(what_was_never_prepared_does_nothing);
    return UNITY_END();
}
