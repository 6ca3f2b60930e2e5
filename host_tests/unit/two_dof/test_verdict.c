/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of two_dof/verdict.h: bounds from a covariance, and what keeps a joint from being ready, one cause at a time.
#include "math/sym.h"
#include "two_dof/verdict.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define UNKNOWNS 5u

static const float RIGHT_ANGLE = 1.5707963f;
/* 95 % points of |x| for a Gaussian with unit variance: on a line, and in a plane with equal variances (sqrt(-2 ln 0.05)). */
static const float LINE_95 = 1.95996f;
static const float PLANE_95 = 2.44775f;

static jcal_two_dof_config_t config;
static jcal_two_dof_evidence_t evidence;
static jcal_two_dof_verdict_t verdict;
static float covariance[JCAL_SYM_SIZE(UNKNOWNS)];
static jcal_two_dof_point_t point;

/* Evidence to which nothing is missing. */
void setUp(void)
{
    config = jcal_two_dof_config_default();
    memset(covariance, 0, sizeof covariance);
    point = (jcal_two_dof_point_t){{0.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f}, {1.0f, 0.0f}};
    for (unsigned i = 0u; i < UNKNOWNS; ++i) {
        covariance[jcal_sym_at(i, i)] = 1e-6f;
    }
    evidence = (jcal_two_dof_evidence_t){
        .point = &point, .covariance = covariance, .moving_s = 20.0f, .cost = 40.0f, .tried = 200u, .exchanges = 20u};
    jcal_two_dof_verdict_begin(&verdict, JCAL_COLLECTING);
}

void tearDown(void)
{
}

static jcal_calibration_t judge(void)
{
    jcal_two_dof_conclude(&verdict, &config, &evidence);
    return (jcal_calibration_t)verdict.status;
}

static jcal_calibration_t judge_often(void)
{
    for (int k = 0; k < 9; ++k) {
        (void)judge();
    }
    return judge();
}

/* Variances a and b along directions turned by `angle`, for the two steps of the axis that begin at `first`. */
static void ellipse(unsigned first, float a, float b, float angle)
{
    const float c = cosf(angle);
    const float s = sinf(angle);
    covariance[jcal_sym_at(first, first)] = (a * c * c) + (b * s * s);
    covariance[jcal_sym_at(first + 1u, first + 1u)] = (a * s * s) + (b * c * c);
    covariance[jcal_sym_at(first + 1u, first)] = (a - b) * c * s;
}

static void a_bound_is_the_95_percent_radius_whichever_way_the_ellipse_lies(void)
{
    config.mismatch_rad = 0.0f;
    for (int k = 0; k < 12; ++k) {
        const float angle = 0.5f * (float)k;
        ellipse(0u, 4e-4f, 0.0f, angle);
        ellipse(2u, 1e-4f, 1e-4f, angle);
        (void)judge();
        TEST_ASSERT_FLOAT_WITHIN(2e-4f, LINE_95 * 0.02f, verdict.bound1_rad);
        TEST_ASSERT_FLOAT_WITHIN(2e-4f, PLANE_95 * 0.01f, verdict.bound2_rad);
        ellipse(2u, 4e-4f, 0.0f, angle);
        (void)judge();
        TEST_ASSERT_FLOAT_WITHIN(2e-4f, LINE_95 * 0.02f, verdict.bound2_rad);
    }
}

static void the_bound_of_the_heading_grows_with_variance_mismatch_and_drift(void)
{
    config.mismatch_rad = 0.0f;
    config.heading_drift_rad_s = 0.0f;
    covariance[jcal_sym_at(4u, 4u)] = 9e-4f;
    (void)judge();
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, LINE_95 * 0.03f, verdict.bound_heading_rad);
    const float spread = verdict.bound_heading_rad;
    config.heading_drift_rad_s = 0.001f;
    evidence.age_s = 10.0f;
    (void)judge();
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, spread + 0.01f, verdict.bound_heading_rad);
    config.mismatch_rad = 0.01f;
    (void)judge();
    TEST_ASSERT_TRUE(verdict.bound_heading_rad >= spread + 0.02f);
}

static void without_covariance_nothing_is_known(void)
{
    evidence.covariance = NULL;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge_often());
    TEST_ASSERT_EQUAL_FLOAT(RIGHT_ANGLE, verdict.bound1_rad);
    TEST_ASSERT_EQUAL_FLOAT(RIGHT_ANGLE, verdict.bound2_rad);
    TEST_ASSERT_EQUAL_FLOAT(RIGHT_ANGLE, verdict.bound_heading_rad);
}

static void ready_takes_more_than_one_judgement(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge());
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, verdict.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge_often());
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, verdict.reason);
}

static void each_lack_alone_prevents_ready(void)
{
    const jcal_two_dof_evidence_t whole = evidence;
    static const jcal_reason_t reasons[] = {
        JCAL_REASON_BAD_SAMPLES,  JCAL_REASON_NO_MOTION,    JCAL_REASON_DOES_NOT_FIT, JCAL_REASON_DOES_NOT_FIT,
        JCAL_REASON_DOES_NOT_FIT, JCAL_REASON_DOES_NOT_FIT, JCAL_REASON_UNCERTAIN,    JCAL_REASON_UNCERTAIN};
    for (unsigned lack = 0u; lack < (sizeof reasons / sizeof reasons[0]); ++lack) {
        setUp();
        evidence = whole;
        evidence.complaint = (lack == 0u) ? JCAL_REASON_BAD_SAMPLES : JCAL_REASON_NONE;
        evidence.moving_s = (lack == 1u) ? 0.2f : 20.0f;
        evidence.parts[0] = (lack == 2u) ? 1e6f : 0.0f;
        evidence.parts[1] = (lack == 3u) ? 1e6f : 0.0f;
        evidence.sine = (lack == 4u) ? 0.99f : ((lack == 5u) ? -0.99f : 0.0f);
        evidence.tried = (lack == 6u) ? 1u : 200u;
        evidence.exchanges = (lack == 7u) ? 0u : 20u;
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge_often());
        TEST_ASSERT_EQUAL_INT(reasons[lack], verdict.reason);
    }
}

static void a_part_that_is_not_used_is_not_judged(void)
{
    evidence.parts[0] = 1e6f;
    config.constraint = JCAL_CONSTRAINT_ORIENTATION;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge_often());
    setUp();
    evidence.parts[1] = 1e6f;
    config.constraint = JCAL_CONSTRAINT_ROTATION;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge_often());
}

static void another_minimum_about_as_good_is_ambiguous(void)
{
    evidence.rival_cost = 0.0f; /* of no rival */
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge_often());
    setUp();
    evidence.has_rival = true;
    evidence.rival_cost = 60.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_AMBIGUOUS, judge_often());
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_OTHER_MINIMUM, verdict.reason);
    const float right_angle = 1.57f; /* a bound around one of two places bounds nothing */
    TEST_ASSERT_TRUE((verdict.bound1_rad > right_angle) && (verdict.bound2_rad > right_angle));
    TEST_ASSERT_TRUE(verdict.bound_heading_rad > right_angle);
    evidence.rival_cost = 1e5f;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge_often());
    TEST_ASSERT_TRUE((verdict.bound1_rad < 0.1f) && (verdict.bound2_rad < 0.1f) && (verdict.bound_heading_rad < 0.1f));
    evidence.cost = 1e5f;
    evidence.rival_cost = 2e5f; /* far more, but not many times as much */
    TEST_ASSERT_EQUAL_INT(JCAL_AMBIGUOUS, judge_often());
}

static void the_weakest_unknown_is_named(void)
{
    static const jcal_weak_t names[3] = {JCAL_WEAK_AXIS1, JCAL_WEAK_AXIS2, JCAL_WEAK_HEADING};
    for (unsigned i = 0u; i < 3u; ++i) {
        setUp();
        covariance[jcal_sym_at(2u * i, 2u * i)] = 0.04f;
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge_often());
        TEST_ASSERT_EQUAL_INT(names[i], verdict.weak);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, verdict.reason);
        TEST_ASSERT_EQUAL_INT((i == 2u) ? JCAL_HINT_MOVE_SEGMENT1 : JCAL_HINT_MOVE_JOINT, verdict.hint);
    }
}

static void ready_bears_a_little_more_than_it_asked_for(void)
{
    config.mismatch_rad = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge_often());
    const float at_limit = config.max_bound_rad / LINE_95;
    covariance[0] = 1.1f * 1.1f * at_limit * at_limit;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge());
    covariance[0] = 1.3f * 1.3f * at_limit * at_limit;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge());
    covariance[0] = 1.1f * 1.1f * at_limit * at_limit;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge_often());
}

static void signs_are_kept_from_ready_on_until_moved(void)
{
    point.j1 = (jcal_vec3_t){-0.1f, 0.0f, -0.99f};
    config.axis2_toward = (jcal_vec3_t){0.0f, -2.0f, 0.0f};
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge());
    TEST_ASSERT_EQUAL_INT8(0, verdict.sign1);
    TEST_ASSERT_EQUAL_INT8(0, verdict.sign2);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge_often());
    TEST_ASSERT_EQUAL_INT8(3, verdict.sign1); /* z stays positive */
    TEST_ASSERT_EQUAL_INT8(-2, verdict.sign2);
    evidence.complaint = JCAL_REASON_BAD_SAMPLES;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge());
    TEST_ASSERT_EQUAL_INT8(3, verdict.sign1);
    jcal_two_dof_verdict_begin(&verdict, JCAL_MOVED);
    TEST_ASSERT_EQUAL_INT8(0, verdict.sign1);
    TEST_ASSERT_EQUAL_INT8(0, verdict.sign2);
}

static void moved_stays_until_there_is_motion(void)
{
    jcal_two_dof_verdict_begin(&verdict, JCAL_MOVED);
    evidence.moving_s = 0.1f;
    TEST_ASSERT_EQUAL_INT(JCAL_MOVED, judge_often());
    evidence.moving_s = 20.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge_often());
}

static void the_covariance_is_the_inverse_whatever_the_units(void)
{
    float matrix[JCAL_SYM_SIZE(2u)] = {4e8f, 2e2f, 1e-3f};
    const double det = ((double)matrix[0] * (double)matrix[2]) - ((double)matrix[1] * (double)matrix[1]);
    const double expected[3] = {(double)matrix[2] / det, -(double)matrix[1] / det, (double)matrix[0] / det};
    float inverse[JCAL_SYM_SIZE(2u)];
    TEST_ASSERT_TRUE(jcal_two_dof_covariance(matrix, 2u, inverse));
    for (int i = 0; i < 3; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(1e-5f * fabsf((float)expected[i]), (float)expected[i], inverse[i]);
    }
    float singular[JCAL_SYM_SIZE(2u)] = {1.0f, 1.0f, 1.0f};
    TEST_ASSERT_FALSE(jcal_two_dof_covariance(singular, 2u, inverse));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_bound_is_the_95_percent_radius_whichever_way_the_ellipse_lies);
    RUN_TEST(the_bound_of_the_heading_grows_with_variance_mismatch_and_drift);
    RUN_TEST(without_covariance_nothing_is_known);
    RUN_TEST(ready_takes_more_than_one_judgement);
    RUN_TEST(each_lack_alone_prevents_ready);
    RUN_TEST(a_part_that_is_not_used_is_not_judged);
    RUN_TEST(another_minimum_about_as_good_is_ambiguous);
    RUN_TEST(the_weakest_unknown_is_named);
    RUN_TEST(ready_bears_a_little_more_than_it_asked_for);
    RUN_TEST(signs_are_kept_from_ready_on_until_moved);
    RUN_TEST(moved_stays_until_there_is_motion);
    RUN_TEST(the_covariance_is_the_inverse_whatever_the_units);
    return UNITY_END();
}
