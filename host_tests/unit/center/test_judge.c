/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of center/judge.h: covariances, doubts and bounds against the same in double precision, and each reason for a verdict.
#include "center/judge.h"

#include "center/result.h"
#include "jointcal/vec3.h"
#include "math/sym.h"
#include "unit/center/double.h"

#include <unity.h>

#define SLICE_DOUBTS (JCAL_CENTER_JUDGE_SLICES - 4u)
#define SLICE_BOUNDS (JCAL_CENTER_JUDGE_SLICES - 3u)
#define SLICE_VERDICT (JCAL_CENTER_JUDGE_SLICES - 1u)

static jcal_center_config_t config;
static jcal_center_work_t work;

void setUp(void)
{
    config = jcal_center_config_default();
    memset(&work, 0, sizeof work);
    jcal_center_verdict_begin(&work.verdict, JCAL_COLLECTING);
    work.gravity = (jcal_center_gravity_t){.level1 = 9.81f, .level2 = 9.81f, .time_s = 10.0f};
}

void tearDown(void)
{
}

static bool is_near(double expected, double value, double tolerance)
{
    return fabs(value - expected) <= tolerance;
}

/* All slices up to the bounds; doubts as often as their iteration needs to arrive. */
static void judge_to_bounds(void)
{
    for (unsigned slice = 0u; slice < SLICE_DOUBTS; ++slice) {
        TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, slice));
    }
    for (int i = 0; i < 30; ++i) {
        TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, SLICE_DOUBTS));
    }
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, SLICE_BOUNDS));
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, SLICE_BOUNDS + 1u));
}

/* H^-1 (S + P) H^-1 with S taken to be larger by what few blocks lose, and H^-1 with the residuals' own size. */
static void expect_covariances(double_matrix_t *by_scatter, double_matrix_t *least)
{
    const jcal_center_sums_t *const sums = &work.sums;
    const double_matrix_t inverse = double_inverse_of(sums);
    double_matrix_t scatter = double_unpacked(sums->scatter);
    double_matrix_t rows = double_unpacked(sums->matrix);
    const double_matrix_t prior = double_prior(sums);
    const double own = fmax((double)sums->cost / (double)sums->noise, 1.0);
    const double excess = fmax((double)sums->cost / (double)sums->noise, 0.3);
    const double few = fmax((double)sums->time_s / (0.5 * fmax((double)sums->blocks - 4.0, 1.0)), 1.0);
    for (int i = 0; i < DN; ++i) {
        for (int j = 0; j < DN; ++j) {
            scatter.m[i][j] = few * scatter.m[i][j] + own * prior.m[i][j];
            rows.m[i][j] = excess * rows.m[i][j] + own * prior.m[i][j];
        }
    }
    *by_scatter = double_sandwich(&inverse, &scatter);
    *least = double_sandwich(&inverse, &rows);
}

static void covariances_are_those_of_scatter_and_of_rows(void)
{
    const float costs[3] = {220.0f, 66.0f, 11.0f}; /* larger than usual, smaller, much smaller */
    const float blocks[3] = {20.0f, 12.0f, 30.0f};
    for (int which = 0; which < 3; ++which) {
        work.sums = double_sums(which + 1, 0.5, 1.0);
        work.sums.cost = costs[which];
        work.sums.blocks = blocks[which];
        double_matrix_t by_scatter;
        double_matrix_t least;
        judge_to_bounds();
        expect_covariances(&by_scatter, &least);
        for (size_t sensor = 0u; sensor < 2u; ++sensor) {
            for (size_t i = 0u; i < 3u; ++i) {
                for (size_t j = 0u; j <= i; ++j) {
                    const size_t row = 3u * sensor + i;
                    const size_t column = 3u * sensor + j;
                    const size_t at = jcal_sym_at(i, j);
                    const double scale = sqrt(by_scatter.m[row][row] * by_scatter.m[column][column]);
                    const double scale_least = sqrt(least.m[row][row] * least.m[column][column]);
                    TEST_ASSERT_TRUE(is_near(by_scatter.m[row][column], (double)work.as.inverse.covariance[sensor][at],
                                             1e-3 * scale));
                    TEST_ASSERT_TRUE(
                        is_near(least.m[row][column], (double)work.as.inverse.least[sensor][at], 1e-3 * scale_least));
                }
            }
        }
    }
}

/* Root of the information that rows wrong by 8 % make of one sensor's vector. */
static double wrong_rows(const double_matrix_t *rows, int sensor)
{
    const int at = 3 * sensor;
    return 0.08 * sqrt(fmax(rows->m[at][at] + rows->m[at + 1][at + 1] + rows->m[at + 2][at + 2], 1.0));
}

/* y <- the direction of (r1, r2) of whose information the largest share may come from wrong rows; that share. */
static double expect_doubt(double *y)
{
    const double_matrix_t rows = double_unpacked(work.sums.matrix);
    const double_matrix_t inverse = double_inverse_of(&work.sums);
    const double d[2] = {wrong_rows(&rows, 0), wrong_rows(&rows, 1)};
    double z[6] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    double share = 0.0;
    for (int step = 0; step < 500; ++step) {
        double on[6];
        share = 0.0;
        for (int i = 0; i < 6; ++i) {
            on[i] = 0.0;
            for (int k = 0; k < 6; ++k) {
                on[i] += d[i / 3] * d[k / 3] * inverse.m[i][k] * z[k];
            }
            share += on[i] * on[i];
        }
        share = sqrt(share);
        for (int i = 0; i < 6; ++i) {
            z[i] = on[i] / share;
        }
    }
    for (int i = 0; i < 6; ++i) {
        y[i] = z[i] / d[i / 3];
    }
    return share;
}

/* Both larger eigenvalues, by the power method and once more without the first. */
static void larger_eigenvalues(double c[3][3], double *values)
{
    for (int which = 0; which < 2; ++which) {
        double v[3] = {0.5, 0.6, 0.7};
        double length = 0.0;
        for (int step = 0; step < 2000; ++step) {
            double on[3];
            length = 0.0;
            for (int i = 0; i < 3; ++i) {
                on[i] = c[i][0] * v[0] + c[i][1] * v[1] + c[i][2] * v[2];
                length += on[i] * on[i];
            }
            length = sqrt(length);
            for (int i = 0; i < 3; ++i) {
                v[i] = on[i] / length;
            }
        }
        values[which] = length;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                c[i][j] -= length * v[i] * v[j];
            }
        }
    }
}

static double bound_of(double radius)
{
    const double hidden = (double)work.as.inverse.hidden_m;
    return 0.002 + sqrt(radius * radius + hidden * hidden);
}

/* Without the information that wrong rows made, errors of one sensor's vector along y are larger by 1 / (1 - share). */
static void add_doubt(int sensor, const double *y, double share, double c[3][3])
{
    const double_matrix_t inverse = double_inverse_of(&work.sums);
    double own[3][3];
    double_block(&inverse, sensor, 1.0, own);
    const double size = (c[0][0] + c[1][1] + c[2][2]) / (own[0][0] + own[1][1] + own[2][2]);
    const double more = share * (1.0 / ((1.0 - share) * (1.0 - share)) - 1.0) * size;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            c[i][j] += more * y[3 * sensor + i] * y[3 * sensor + j];
        }
    }
}

/* Compares the bounds of one sensor; without an axis. */
static void assert_bounds(int sensor, const double_matrix_t *larger, const double *y, double share)
{
    const double none[3] = {0.0, 0.0, 0.0};
    double c[3][3];
    double_block(larger, sensor, 1.0, c);
    add_doubt(sensor, y, share, c);
    const jcal_center_bounds_t *const b = &work.as.inverse.bounds[sensor];
    const double all = bound_of(double_radius(c, none));
    double values[2];
    larger_eigenvalues(c, values);
    TEST_ASSERT_TRUE(is_near(all, (double)b->all, 2e-3 * all));
    TEST_ASSERT_TRUE(is_near(bound_of(1.96 * sqrt(values[0])), (double)b->weakest, 2e-3 * all));
    TEST_ASSERT_TRUE(is_near(bound_of(1.96 * sqrt(values[1])), (double)b->second, 2e-3 * all));
}

static void bounds_are_of_the_larger_covariance_without_what_wrong_rows_told(void)
{
    for (int which = 0; which < 2; ++which) {
        work.sums = double_sums(which + 3, 0.25, (which == 0) ? 3.0 : 0.03);
        judge_to_bounds();
        double_matrix_t by_scatter;
        double_matrix_t least;
        double y[6];
        expect_covariances(&by_scatter, &least);
        const double share = expect_doubt(y);
        TEST_ASSERT_TRUE((share > 0.1) && (share < 0.8));
        TEST_ASSERT_TRUE(is_near(share, (double)work.as.inverse.fake_share, 2e-3 * share));
        assert_bounds(0, (which == 0) ? &by_scatter : &least, y, share);
        assert_bounds(1, (which == 0) ? &by_scatter : &least, y, share);
    }
}

/* A unit vector `angle` away from v. */
static jcal_vec3_t beside(const double *v, double angle)
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double flat = sqrt(v[0] * v[0] + v[1] * v[1]);
    const double across[3] = {-v[1] / flat, v[0] / flat, 0.0};
    float out[3];
    for (int i = 0; i < 3; ++i) {
        out[i] = (float)(cos(angle) * v[i] / length + sin(angle) * across[i]);
    }
    return jcal_vec3(out[0], out[1], out[2]);
}

static void a_doubtful_direction_near_the_known_axis_is_the_axis(void)
{
    double y[6];
    work.sums = double_sums(3, 0.25, 3.0);
    const double share = expect_doubt(y);
    for (int which = 0; which < 2; ++which) {
        /* 18 deg are between 15 and 21 */
        config.hinge_axis1 = beside(&y[0], (which == 0) ? 0.26 : 0.37);
        config.hinge_axis2 = beside(&y[3], (which == 0) ? 0.37 : 0.26);
        const jcal_vec3_t axes[2] = {config.hinge_axis1, config.hinge_axis2};
        double_matrix_t by_scatter;
        double_matrix_t least;
        judge_to_bounds();
        expect_covariances(&by_scatter, &least);
        for (int sensor = 0; sensor < 2; ++sensor) {
            const double axis[3] = {(double)axes[sensor].x, (double)axes[sensor].y, (double)axes[sensor].z};
            double c[3][3];
            double_block(&by_scatter, sensor, 1.0, c);
            if (sensor != which) {
                add_doubt(sensor, y, share, c);
            }
            const double expected = bound_of(double_radius(c, axis));
            TEST_ASSERT_TRUE(is_near(expected, (double)work.as.inverse.bounds[sensor].all, 2e-3 * expected));
        }
    }
}

static void a_direction_that_wrong_rows_may_have_told_is_open(void)
{
    work.sums = double_sums(5, 0.32, 1.0);
    double y[6];
    const float much = 1e4f; /* the prior says nothing then */
    jcal_sym_scale(work.sums.matrix, JCAL_CENTER_UNKNOWNS, much);
    jcal_sym_scale(work.sums.scatter, JCAL_CENTER_UNKNOWNS, much);
    const double share = expect_doubt(y);
    TEST_ASSERT_TRUE((share > 0.81) && (share < 0.95));
    judge_to_bounds();
    for (int sensor = 0; sensor < 2; ++sensor) {
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, work.as.inverse.bounds[sensor].all);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, work.as.inverse.bounds[sensor].weakest);
        TEST_ASSERT_TRUE(work.as.inverse.bounds[sensor].second < 1.0f);
    }
}

static void an_open_direction_of_one_vector_leaves_the_other_as_it_is(void)
{
    /* Diagonal, and along z of sensor 1 a hundredth: rows wrong by 8 % may have made 0.0064 * 2.01 / 0.01 of it, more than all. */
    work.sums = double_sums(1, 0.5, 1.0);
    memset(work.sums.matrix, 0, sizeof work.sums.matrix);
    memset(work.sums.scatter, 0, sizeof work.sums.scatter);
    for (size_t i = 0u; i < JCAL_CENTER_UNKNOWNS; ++i) {
        const float information = (i == 2u) ? 4e3f : 4e5f;
        work.sums.matrix[jcal_sym_at(i, i)] = information;
        work.sums.scatter[jcal_sym_at(i, i)] = 0.1f * information;
    }
    work.sums.effect = 1e9f;
    judge_to_bounds();
    TEST_ASSERT_TRUE(work.as.inverse.bounds[0].all > 1.0f);
    TEST_ASSERT_TRUE(fabsf(work.as.inverse.bounds[0].direction.z) > 0.99f);
    TEST_ASSERT_TRUE(work.as.inverse.bounds[1].all < 0.02f);
}

static void what_is_hidden_is_the_lasting_part_of_what_is_unexplained(void)
{
    const float smoothing[3] = {0.12f, 0.5f, 0.12f};
    for (int which = 0; which < 3; ++which) {
        work.sums = double_sums(1, 0.5, 1.0);
        work.sums.effect = 2000.0f;
        config.kinematics.smoothing_s = smoothing[which];
        if (which == 2) {
            const jcal_vec3_t r1 = work.sums.point.place.r1;
            work.sums.point.place.r1 = work.sums.point.place.r2;
            work.sums.point.place.r2 = r1;
        }
        judge_to_bounds();
        const double share = 220.0 / 2000.0;
        const double length = sqrt(0.03 * 0.03 + 0.2 * 0.2 + 0.04 * 0.04); /* of the longer one */
        /* a quarter of the residuals lasts; with four times the smoothing that is all right for, all of them, four times */
        const double expected = (which == 1) ? (0.65 * 4.0 * sqrt(share) + share) : (0.65 * sqrt(share * 0.25) + share);
        TEST_ASSERT_TRUE(is_near(expected * length, (double)work.as.inverse.hidden_m, 1e-5));
        TEST_ASSERT_TRUE(is_near(sqrt(share), (double)work.verdict.misfit, 1e-5));
    }
}

static void a_matrix_without_a_factor_ends_the_work(void)
{
    work.sums = double_sums(2, 0.5, 1.0);
    work.sums.matrix[jcal_sym_at(4u, 2u)] = NAN;
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, JCAL_CENTER_SLICE_SCALE));
    TEST_ASSERT_FALSE(jcal_center_judge(&config, &work, JCAL_CENTER_SLICE_FACTOR));
    TEST_ASSERT_FALSE(work.as.inverse.is_factored);
}

static void the_step_goes_to_the_minimum(void)
{
    work.sums = double_sums(2, 0.5, 1.0);
    double gradient[DN];
    for (int i = 0; i < DN; ++i) {
        work.sums.gradient[i] = (float)center_noise(7u, (uint32_t)i);
        gradient[i] = (double)work.sums.gradient[i];
    }
    const jcal_center_point_t *const p = &work.sums.point;
    const float x[6] = {p->place.r1.x, p->place.r1.y, p->place.r1.z, p->place.r2.x, p->place.r2.y, p->place.r2.z};
    const double_matrix_t prior = double_prior(&work.sums);
    const double_matrix_t inverse = double_inverse_of(&work.sums);
    for (int i = 0; i < 6; ++i) {
        gradient[i] += prior.m[i][i] * (double)x[i];
    }
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, JCAL_CENTER_SLICE_SCALE));
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, JCAL_CENTER_SLICE_FACTOR));
    jcal_center_solve(&config, &work);
    for (int i = 0; i < DN; ++i) {
        double expected = 0.0;
        for (int k = 0; k < DN; ++k) {
            expected -= inverse.m[i][k] * gradient[k];
        }
        TEST_ASSERT_TRUE(is_near(expected, (double)work.as.inverse.step[i], 1e-3 * (fabs(expected) + 0.01)));
    }
}

/* A verdict on two bounds; the second direction of both is known. */
static const jcal_center_verdict_t *judge(float bound1_m, float bound2_m)
{
    work.as.inverse.bounds[0] = (jcal_center_bounds_t){bound1_m, bound1_m, 0.001f, {1.0f, 0.0f, 0.0f}};
    work.as.inverse.bounds[1] = (jcal_center_bounds_t){bound2_m, bound2_m, 0.001f, {0.0f, 1.0f, 0.0f}};
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, SLICE_VERDICT));
    return &work.verdict;
}

static void ready_takes_three_judgements_and_is_lost_beyond_a_fifth_more(void)
{
    work.sums = double_sums(1, 0.5, 1.0);
    for (int k = 0; k < 2; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge(0.009f, 0.009f)->status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, work.verdict.reason);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge(0.011f, 0.009f)->status); /* begins anew */
    for (int k = 0; k < 2; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge(0.009f, 0.009f)->status);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge(0.009f, 0.009f)->status);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge(0.0119f, 0.0119f)->status);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge(0.0121f, 0.009f)->status);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge(0.0119f, 0.009f)->status);
}

static void no_gravity_is_no_ready_and_says_so(void)
{
    work.sums = double_sums(1, 0.5, 1.0);
    for (int k = 0; k < 3; ++k) {
        (void)judge(0.009f, 0.009f);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_READY, work.verdict.status);
    work.gravity.level2 = 10.45f; /* within 1.2 times 6 % */
    TEST_ASSERT_EQUAL_INT(JCAL_READY, judge(0.009f, 0.009f)->status);
    work.gravity.level2 = 10.55f;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge(0.009f, 0.009f)->status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_GRAVITY_OFF, work.verdict.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, work.verdict.hint);
    work.gravity.level2 = 10.45f;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge(0.009f, 0.009f)->status);
    work.gravity.level2 = 9.81f;
    work.gravity.time_s = 1.9f; /* not known */
    for (int k = 0; k < 4; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, judge(0.009f, 0.009f)->status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, work.verdict.reason);
    }
}

/* 2 mm and sqrt(radius^2 + hidden^2 + shift^2), of which only the radius is there at a place of zero. */
static void errors_of_scale_are_in_the_bound_of_their_sensor(void)
{
    work.sums = double_sums(1, 0.5, 1.0);
    jcal_sym_scale(work.sums.matrix, JCAL_CENTER_UNKNOWNS,
                   1e4f); /* what is known well, so that scale is what is left */
    const jcal_vec3_t none = {0.0f, 0.0f, 0.0f};
    work.sums.point.place.r1 = none; /* nothing to be scaled, and nothing that hides */
    work.sums.point.place.r2 = none;
    judge_to_bounds();
    const double before = (double)work.as.inverse.bounds[1].all - 0.002;
    const double other = (double)work.as.inverse.bounds[0].all;
    work.sums.point.place.r2 = jcal_vec3(0.0f, 0.3f, 0.4f);
    config.rate_mismatch = 0.01f;
    judge_to_bounds();
    const double hidden = (double)work.as.inverse.hidden_m;
    const double expected = 0.002 + sqrt(before * before + hidden * hidden + 0.01 * 0.01);
    TEST_ASSERT_TRUE(before < 0.02);
    TEST_ASSERT_TRUE(is_near(expected, (double)work.as.inverse.bounds[1].all, 1e-3 * expected));
    const double alone = 0.002 + sqrt((other - 0.002) * (other - 0.002) + hidden * hidden);
    TEST_ASSERT_TRUE(is_near(alone, (double)work.as.inverse.bounds[0].all, 1e-3 * alone));
}

static void a_few_blocks_tell_no_bounds(void)
{
    work.sums = double_sums(1, 0.5, 1.0);
    work.sums.blocks = 7.9f;
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, judge(0.009f, 0.009f)->bound1_m);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, work.verdict.bound2_m);
    TEST_ASSERT_EQUAL_UINT(0u, work.verdict.agreed);
    work.sums.blocks = 8.0f;
    TEST_ASSERT_EQUAL_FLOAT(0.009f, judge(0.009f, 0.008f)->bound1_m);
    TEST_ASSERT_EQUAL_FLOAT(0.008f, work.verdict.bound2_m);
    TEST_ASSERT_EQUAL_UINT(1u, work.verdict.agreed);
}

static void assert_verdict(jcal_weak_t weak, jcal_reason_t reason, jcal_hint_t hint)
{
    TEST_ASSERT_EQUAL_INT(weak, work.verdict.weak);
    TEST_ASSERT_EQUAL_INT(reason, work.verdict.reason);
    TEST_ASSERT_EQUAL_INT(hint, work.verdict.hint);
}

static void what_is_missing_is_named(void)
{
    work.sums = double_sums(1, 0.5, 1.0);
    (void)judge(0.02f, 0.03f);
    assert_verdict(JCAL_WEAK_CENTER2, JCAL_REASON_UNCERTAIN, JCAL_HINT_MORE_DIRECTIONS);
    (void)judge(0.03f, 0.02f);
    assert_verdict(JCAL_WEAK_CENTER1, JCAL_REASON_UNCERTAIN, JCAL_HINT_MORE_DIRECTIONS);
    work.as.inverse.bounds[0].second = 0.011f;
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, SLICE_VERDICT));
    assert_verdict(JCAL_WEAK_CENTER1, JCAL_REASON_UNCERTAIN, JCAL_HINT_MOVE_JOINT);
    work.as.inverse.lasting_m = 0.0079f; /* with 2 mm of mismatch not the whole of 10 mm */
    (void)judge(0.03f, 0.02f);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, work.verdict.reason);
    work.as.inverse.lasting_m = 0.0081f;
    (void)judge(0.03f, 0.02f);
    assert_verdict(JCAL_WEAK_CENTER1, JCAL_REASON_DOES_NOT_FIT, JCAL_HINT_CHECK_SENSORS);
    work.sums.turn2 = 1.0f; /* less than 0.1 (rad/s)^2 in 11 s */
    (void)judge(0.03f, 0.02f);
    assert_verdict(JCAL_WEAK_CENTER1, JCAL_REASON_NO_MOTION, JCAL_HINT_MOVE_SEGMENT2);
    work.sums.turn1 = 0.9f;
    (void)judge(0.03f, 0.02f);
    assert_verdict(JCAL_WEAK_CENTER1, JCAL_REASON_NO_MOTION, JCAL_HINT_MOVE_SEGMENT1);
}

static void a_covariance_that_is_no_number_has_no_bounds(void)
{
    work.sums = double_sums(1, 0.5, 1.0);
    judge_to_bounds();
    work.as.inverse.covariance[0][1] = NAN;
    work.as.inverse.least[0][1] = NAN;
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, SLICE_BOUNDS));
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, work.as.inverse.bounds[0].all);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, work.as.inverse.bounds[0].second);
}

static void what_does_not_last_may_hide_an_error_too(void)
{
    work.sums = double_sums(1, 0.5, 1.0);
    work.sums.effect = 2000.0f;
    work.sums.lagged = 0.0f;
    judge_to_bounds();
    const double share = 220.0 / 2000.0;
    const double length = sqrt(0.03 * 0.03 + 0.2 * 0.2 + 0.04 * 0.04);
    /* as if 0.15 of it lasted */
    TEST_ASSERT_TRUE(is_near((0.65 * sqrt(share * 0.15) + share) * length, (double)work.as.inverse.hidden_m, 1e-5));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, work.as.inverse.lasting_m);
}

static void noise_alone_is_no_misfit(void)
{
    work.sums = double_sums(1, 0.5, 1.0);
    work.sums.effect = 10.0f * work.sums.cost; /* a tenth of 0.2 m may hide, nothing of which lasts */
    work.sums.lagged = 0.0f;
    judge_to_bounds();
    TEST_ASSERT_TRUE(work.as.inverse.hidden_m > 0.02f);
    TEST_ASSERT_TRUE(jcal_center_judge(&config, &work, SLICE_VERDICT));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, work.verdict.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, work.verdict.hint);
}

static void progress_is_the_share_of_the_way_to_the_bound(void)
{
    static jcal_center_input_t input;
    jcal_center_result_t r;
    memset(&input, 0, sizeof input);
    work.verdict.bound1_m = 0.02f;
    work.verdict.bound2_m = 0.04f;
    jcal_center_report(&config, &work, &input, true, &r);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, r.progress1);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, r.progress2);
    jcal_center_report(&config, &work, &input, false, &r);
    TEST_ASSERT_FALSE(r.has_center);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_vec3_norm(r.joint_to_sensor1_m));
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty1_m);
    TEST_ASSERT_EQUAL_FLOAT(0.001f, r.progress1);
}

static void a_place_that_no_body_has_is_not_told_and_never_ready(void)
{
    static jcal_center_input_t input;
    jcal_center_result_t r;
    memset(&input, 0, sizeof input);
    for (int sensor = 0; sensor < 2; ++sensor) {
        for (int hinge = 0; hinge < 2; ++hinge) {
            setUp();
            config.hinge_axis1 = jcal_vec3(0.0f, 0.0f, (hinge == 1) ? 1.0f : 0.0f);
            config.hinge_axis2 = jcal_vec3((hinge == 1) ? 1.0f : 0.0f, 0.0f, 0.0f);
            jcal_center_place_t *const place = &work.sums.point.place;
            jcal_vec3_t *const r_m = (sensor == 0) ? &place->r1 : &place->r2;
            place->r1 = jcal_vec3(0.1f, 0.0f, (hinge == 1) ? 40.0f : 0.0f);
            place->r2 = jcal_vec3((hinge == 1) ? 40.0f : 0.0f, 0.0f, -0.1f); /* far along the axis is the same joint */
            work.verdict.status = (uint8_t)JCAL_READY;
            work.verdict.reason = (uint8_t)JCAL_REASON_NONE;
            r_m->y = 0.99f;
            jcal_center_report(&config, &work, &input, true, &r);
            TEST_ASSERT_TRUE(r.has_center);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
            TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.99f, (sensor == 0) ? r.joint_to_sensor1_m.y : r.joint_to_sensor2_m.y);
            const float far_m[3] = {1.01f, -90.0f, NAN};
            for (int k = 0; k < 3; ++k) {
                r_m->y = far_m[k];
                jcal_center_report(&config, &work, &input, true, &r);
                TEST_ASSERT_FALSE(r.has_center);
                TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
                TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, r.head.reason);
                TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_vec3_norm(r.joint_to_sensor1_m));
                TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_vec3_norm(r.joint_to_sensor2_m));
                TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty1_m);
                TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty_weakest2_m);
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(covariances_are_those_of_scatter_and_of_rows);
    RUN_TEST(bounds_are_of_the_larger_covariance_without_what_wrong_rows_told);
    RUN_TEST(a_doubtful_direction_near_the_known_axis_is_the_axis);
    RUN_TEST(a_direction_that_wrong_rows_may_have_told_is_open);
    RUN_TEST(an_open_direction_of_one_vector_leaves_the_other_as_it_is);
    RUN_TEST(what_is_hidden_is_the_lasting_part_of_what_is_unexplained);
    RUN_TEST(a_matrix_without_a_factor_ends_the_work);
    RUN_TEST(the_step_goes_to_the_minimum);
    RUN_TEST(ready_takes_three_judgements_and_is_lost_beyond_a_fifth_more);
    RUN_TEST(no_gravity_is_no_ready_and_says_so);
    RUN_TEST(errors_of_scale_are_in_the_bound_of_their_sensor);
    RUN_TEST(a_few_blocks_tell_no_bounds);
    RUN_TEST(what_is_missing_is_named);
    RUN_TEST(a_covariance_that_is_no_number_has_no_bounds);
    RUN_TEST(what_does_not_last_may_hide_an_error_too);
    RUN_TEST(noise_alone_is_no_misfit);
    RUN_TEST(progress_is_the_share_of_the_way_to_the_bound);
    RUN_TEST(a_place_that_no_body_has_is_not_told_and_never_ready);
    return UNITY_END();
}
