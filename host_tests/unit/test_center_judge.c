/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of calib/center_judge.h on sums that are made up here: bounds against their formula in double precision, and the verdict.
#include "calib/center_judge.h"
#include "calib/center_sums.h"
#include "math/sym.h"

#include <math.h>
#include <string.h>
#include <unity.h>

enum { N = JCAL_CENTER_UNKNOWNS };

static jcal_center_work_t work;
static jcal_center_config_t config;

/* What test cases vary: information, scatter and prior of r1 and r2 are alike in all directions, biases hardly take part. */
static const float INFORMATION = 4e5f;
static const float TIME_S = 30.0f;
static const float BLOCKS = 12.0f;

void setUp(void)
{
    memset(&work, 0, sizeof work);
    config = jcal_center_config_default();
    jcal_center_sums_t *const sums = &work.sums;
    sums->point.place.r1.x = 0.3f;
    sums->point.place.r2.y = 0.1f;
    sums->time_s = TIME_S;
    sums->blocks = BLOCKS;
    sums->turn1 = 4.0f * TIME_S;
    sums->turn2 = 4.0f * TIME_S;
    sums->noise = 300.0f;
    sums->cost = 300.0f;
    sums->effect = 3e7f;
    sums->raw = 300.0f;
    for (size_t i = 0; i < N; ++i) {
        sums->matrix[jcal_sym_at(i, i)] = INFORMATION;
        sums->scatter[jcal_sym_at(i, i)] = 0.1f * INFORMATION;
    }
    jcal_center_verdict_begin(&work.verdict, JCAL_COLLECTING);
}

void tearDown(void)
{
}

static void judge_once(void)
{
    for (unsigned slice = 0; slice < JCAL_CENTER_JUDGE_SLICES; ++slice) {
        TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, slice));
    }
}

/* Bound of a vector whose covariance is `variance` in all directions: three equal ones have the radius sqrt(3 + 2 sqrt 6). */
static double bound_of(double variance, double hidden_m)
{
    const double radius2 = (3.0 + 2.0 * sqrt(6.0)) * variance;
    return (double)config.mismatch_m + sqrt(radius2 + (hidden_m * hidden_m));
}

static void assert_bound(double expected_m)
{
    judge_once();
    TEST_ASSERT_TRUE(fabs((double)work.verdict.bound1_m - expected_m) < 0.02 * expected_m);
    TEST_ASSERT_TRUE(fabs((double)work.verdict.bound2_m - expected_m) < 0.02 * expected_m);
}

static void without_scatter_the_bound_is_that_of_the_residuals(void)
{
    config.mismatch_m = 0.0f;
    config.acc_bias_m_s2 = 0.0f;
    work.sums.effect = 3e12f;
    assert_bound(bound_of(1.0 / (double)INFORMATION, 0.0));
    setUp();
    config.mismatch_m = 0.0f;
    work.sums.effect = 3e12f;
    work.sums.cost = 4.0f * work.sums.noise; /* twice as large */
    assert_bound(bound_of(4.0 / (double)INFORMATION, 0.0));
}

static void four_blocks_are_not_counted(void)
{
    config.mismatch_m = 0.0f;
    work.sums.effect = 3e12f;
    for (size_t i = 0; i < N; ++i) {
        work.sums.scatter[jcal_sym_at(i, i)] = 5.0f * INFORMATION;
    }
    const double few = (double)TIME_S / ((double)(BLOCKS - 4.0f) * (double)JCAL_CENTER_BLOCK_S);
    assert_bound(bound_of(few * 5.0 / (double)INFORMATION, 0.0));
}

static void what_is_known_beforehand_has_a_variance_too(void)
{
    /* 40 from the data beside 1 / 0.3^2: few times scatter, and the prior, over the square of both */
    const double h = 40.0, p = 1.0 / 0.09, s = 20.0;
    const double few = (double)TIME_S / ((double)(BLOCKS - 4.0f) * (double)JCAL_CENTER_BLOCK_S);
    config.mismatch_m = 0.0f;
    work.sums.effect = 3e12f;
    for (size_t i = 0; i < N; ++i) {
        work.sums.matrix[jcal_sym_at(i, i)] = (float)h;
        work.sums.scatter[jcal_sym_at(i, i)] = (float)s;
    }
    assert_bound(bound_of(((few * s) + p) / ((h + p) * (h + p)), 0.0));
}

static void what_is_unexplained_may_hide_an_error(void)
{
    /* a hundredth of the effect: what does not last counts by itself, times |r1| = 0.3 m, the longer one */
    work.sums.effect = 100.0f * work.sums.cost;
    work.sums.lagged = 0.0f;
    assert_bound(bound_of(1.0 / (double)INFORMATION, 0.003));
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.1f, work.verdict.misfit);
    /* ... and what lasts by its root times 0.65 */
    work.sums.lagged = 0.25f * work.sums.raw;
    assert_bound(bound_of(1.0 / (double)INFORMATION, 0.003 + (0.65 * 0.1 * 0.5 * 0.3)));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, work.verdict.reason);
}

static void noise_alone_is_no_misfit(void)
{
    work.sums.effect = 10.0f * work.sums.cost; /* 0.1 of 0.3 m, nothing of which lasts */
    work.sums.lagged = 0.0f;
    judge_once();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, work.verdict.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, work.verdict.hint);
}

static void a_sensor_at_rest_is_named(void)
{
    for (int i = 0; i < N; ++i) {
        work.sums.matrix[jcal_sym_at((size_t)i, (size_t)i)] = 10.0f;
    }
    work.sums.turn2 = 0.05f * TIME_S;
    judge_once();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_MOTION, work.verdict.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_SEGMENT2, work.verdict.hint);
    work.sums.turn1 = 0.01f * TIME_S;
    judge_once();
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_SEGMENT1, work.verdict.hint);
    work.sums.turn2 = 4.0f * TIME_S;
    judge_once();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_MOTION, work.verdict.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_SEGMENT1, work.verdict.hint);
}

static void three_judgements_must_agree(void)
{
    for (int k = 0; k < 2; ++k) {
        judge_once();
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, work.verdict.status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, work.verdict.reason);
    }
    judge_once();
    TEST_ASSERT_EQUAL_INT(JCAL_READY, work.verdict.status);
    work.sums.effect = 10.0f * work.sums.cost;
    work.sums.lagged = work.sums.raw;
    judge_once();
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, work.verdict.status);
    work.sums.effect = 3e7f;
    judge_once();
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, work.verdict.status); /* from the beginning */
}

static void few_blocks_have_no_bounds(void)
{
    work.sums.blocks = 7.0f;
    judge_once();
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, work.verdict.bound1_m);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, work.verdict.status);
}

static void a_direction_that_wrong_rows_could_have_made_is_open(void)
{
    /* along z of sensor 1 a hundredth of the information of the others: rows wrong by 8 % make 0.0064 * 2.01 of it */
    work.sums.matrix[jcal_sym_at(2, 2)] = 0.01f * INFORMATION;
    for (int k = 0; k < 20; ++k) { /* the power iteration goes on from judgement to judgement */
        judge_once();
    }
    TEST_ASSERT_TRUE(work.verdict.bound1_m > 1.0f);
    TEST_ASSERT_TRUE(fabsf(work.verdict.direction1.z) > 0.99f);
    TEST_ASSERT_TRUE(work.verdict.bound2_m < 0.02f);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, work.verdict.status);
    /* ... unless it is the known axis of a hinge */
    setUp();
    work.sums.matrix[jcal_sym_at(2, 2)] = 0.01f * INFORMATION;
    config.hinge_axis1.z = 1.0f;
    config.hinge_axis2.x = 1.0f;
    for (int k = 0; k < 20; ++k) {
        judge_once();
    }
    TEST_ASSERT_TRUE(work.verdict.bound1_m < 0.02f);
    TEST_ASSERT_TRUE(work.verdict.weakest1_m > 1.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(without_scatter_the_bound_is_that_of_the_residuals);
    RUN_TEST(four_blocks_are_not_counted);
    RUN_TEST(what_is_known_beforehand_has_a_variance_too);
    RUN_TEST(what_is_unexplained_may_hide_an_error);
    RUN_TEST(noise_alone_is_no_misfit);
    RUN_TEST(a_sensor_at_rest_is_named);
    RUN_TEST(three_judgements_must_agree);
    RUN_TEST(few_blocks_have_no_bounds);
    RUN_TEST(a_direction_that_wrong_rows_could_have_made_is_open);
    return UNITY_END();
}
