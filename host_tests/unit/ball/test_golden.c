/* SPDX-License-Identifier: MIT */
/// @file
/// Every step of the ball joint against the float64 numpy reference, tools/maintain/make_golden.py.
#include "ball/bounds.h"
#include "ball/solve.h"
#include "ball/sums.h"
#include "ball/track.h"
#include "golden/ball.h"
#include "jointcal/ball.h"
#include "levers/levers.h"

#include <math.h>
#include <string.h>
#include <unity.h>

/* 79 roundings of 6e-8 of a sum and 4 of what is added, all to one side. */
static const double SUM_TOL = 5e-6;
/* x' S x takes sums from each other that are as large as both sides together. */
static const double LEFT_TOL = 1e-5;
/* Factors of 6 x 6 lose a rounding or two in each of six steps, times the condition that the reference tells. */
static const double FACTOR_TOL = 12.0 * 6e-8;
/* A unit complex number, or what a few products of them are. */
static const double UNIT_TOL = 4.0 * 6e-8;

static jcal_ball_t joint;

static jcal_vec3_t vector(const float *v)
{
    return (jcal_vec3_t){v[0], v[1], v[2]};
}

static jcal_vec3_t vector_of(const double *v)
{
    return (jcal_vec3_t){(float)v[0], (float)v[1], (float)v[2]};
}

static jcal_tick_t tick_of(const float *v)
{
    jcal_tick_t out;
    memset(&out, 0, sizeof out);
    out.dt_s = GOLDEN_TICK_S;
    memcpy(out.turn, v, sizeof out.turn);
    memcpy(out.lever, &v[9], sizeof out.lever);
    out.velocity = vector(&v[18]);
    out.gyr = vector(&v[21]);
    return out;
}

/* The first ticks; blocks are closed where the reference closed them. */
static void sum_up(int until)
{
    int closed = 0;
    memset(&joint.sums, 0, sizeof joint.sums);
    for (int k = 0; k < until; ++k) {
        const float *const g = golden_ticks[k];
        const jcal_tick_t tick1 = tick_of(g);
        const jcal_tick_t tick2 = tick_of(&g[24]);
        const jcal_tick_weights_t weights = {g[48], g[49], 0.0f};
        jcal_ball_sums_add(&joint.sums, &tick1, &tick2, &weights);
        const bool due = (closed < GOLDEN_CLOSES) && (golden_closes[closed][0] == (float)(k + 1));
        TEST_ASSERT_EQUAL_INT(due, jcal_ball_sums_full(&joint.sums));
        if (due) {
            jcal_ball_sums_close(&joint.sums, (jcal_plane_t){golden_closes[closed][1], golden_closes[closed][2]});
            ++closed;
        }
    }
}

static bool has_closed(void)
{
    return joint.sums.block_motion_s[1] > 0.0f;
}

/* A point of the reference with the headings that it has, and with the levers and the size that it gives them. */
static void go_to(int p)
{
    const float *const g = golden_points[p];
    const double *const l = golden_levers[p];
    sum_up((g[0] > 0.0f) ? GOLDEN_TICKS : GOLDEN_EARLY);
    for (int b = 0; b < 2; ++b) {
        joint.point.heading[b] = (jcal_plane_t){g[1 + 2 * b], g[2 + 2 * b]};
    }
    joint.past = (jcal_ball_past_t){{g[5], g[6]}, g[7]};
    joint.point.r1 = vector_of(l);
    joint.point.r2 = vector_of(&l[3]);
    joint.point.lack = (float)l[6];
    joint.point.speed2 = (float)l[7];
    joint.point.size = (float)l[8];
}

static double size_of(const double *values, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        sum += values[i] * values[i];
    }
    return sqrt(sum);
}

/* Both arrays, to `allowed`. */
static void expect(const double *expected, const float *found, int n, double allowed)
{
    for (int i = 0; i < n; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(allowed, expected[i], (double)found[i]);
    }
}

static void expect_share(double expected, float found, double tolerance)
{
    TEST_ASSERT_DOUBLE_WITHIN(tolerance * fabs(expected), expected, (double)found);
}

/* No sum of products of both sensors is larger, however its terms cancel. */
static double own_size(const double *sums)
{
    return sqrt(size_of(&sums[14], 10) * size_of(&sums[24], 10));
}

void setUp(void)
{
    const jcal_ball_config_t config = jcal_ball_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_init(&joint, &config));
}

void tearDown(void)
{
}

static void sums_and_stiffness(void)
{
    for (int moment = 0; moment < 2; ++moment) {
        const double *const g = golden_sums[moment];
        sum_up((moment == 0) ? GOLDEN_EARLY : GOLDEN_TICKS);
        const jcal_ball_sums_t *const s = &joint.sums;
        const double both = own_size(g);
        expect_share(g[0], s->motion_s, SUM_TOL);
        expect_share(g[1], s->energy1, SUM_TOL);
        expect_share(g[2], s->energy2, SUM_TOL);
        expect(&g[3], s->block_motion_s, 2, SUM_TOL * g[0]);
        expect(&g[5], s->along, 9, SUM_TOL * sqrt(g[1] * g[2]));
        expect(&g[14], s->levers.own1, 10, SUM_TOL * size_of(&g[14], 10));
        expect(&g[24], s->levers.own2, 10, SUM_TOL * size_of(&g[24], 10));
        expect(&g[34], s->levers.up, 16, SUM_TOL * both);
        expect(&g[50], s->levers.old, 16, SUM_TOL * both);
        for (int b = 0; b < 2; ++b) {
            expect(&g[66 + 32 * b], s->levers.block[b].re, 16, SUM_TOL * both);
            expect(&g[82 + 32 * b], s->levers.block[b].im, 16, SUM_TOL * both);
        }
        /* the larger energy beside the smaller one, which what is left is divided by */
        const double unequal = fmax(g[1], g[2]) / fmin(g[1], g[2]);
        TEST_ASSERT_DOUBLE_WITHIN(4.0 * SUM_TOL * unequal, golden_stiffness[0][moment],
                                  (double)jcal_ball_sums_stiffness(s));
    }
}

static void products_of_both(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        float x[16];
        jcal_levers_cross(&joint.sums.levers, joint.point.heading, x);
        expect(golden_cross[p], x, 16, 4.0 * SUM_TOL * own_size(golden_sums[(golden_points[p][0] > 0.0f) ? 1 : 0]));
    }
}

static void levers_and_what_they_leave(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        const double *const l = golden_levers[p];
        const double motion_s = (double)joint.sums.motion_s;
        joint.point.r1 = joint.point.r2 = (jcal_vec3_t){9.0f, 9.0f, 9.0f};
        joint.point.lack = joint.point.size = joint.point.speed2 = 9.0f;
        jcal_ball_round(&joint.sums, &joint.past, &joint.point, 0u);
        const float r[6] = {joint.point.r1.x, joint.point.r1.y, joint.point.r1.z,
                            joint.point.r2.x, joint.point.r2.y, joint.point.r2.z};
        expect(l, r, 6, (SUM_TOL + FACTOR_TOL) * golden_conditions[p][0] * size_of(l, 6));
        TEST_ASSERT_DOUBLE_WITHIN(LEFT_TOL * l[7] * motion_s, l[6], (double)joint.point.lack);
        expect_share(l[7], joint.point.speed2, LEFT_TOL);
        TEST_ASSERT_DOUBLE_WITHIN(LEFT_TOL * l[7] / 3.0, l[8], (double)joint.point.size);
        TEST_ASSERT_EQUAL_FLOAT(golden_points[p][1], joint.point.heading[0].re);
    }
}

/* A heading is the direction of a sum of pulls, each known to a part of the data's own; the sum is not shorter than one tie. */
static void headings(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        const jcal_ball_point_t before = joint.point;
        jcal_ball_round(&joint.sums, &joint.past, &joint.point, 1u);
        const float found[4] = {joint.point.heading[0].re, joint.point.heading[0].im, joint.point.heading[1].re,
                                joint.point.heading[1].im};
        expect(golden_headings[p], found, 4, 2.0 * LEFT_TOL);
        if (!has_closed()) {
            TEST_ASSERT_EQUAL_FLOAT(before.heading[1].re, joint.point.heading[1].re);
        }
        TEST_ASSERT_EQUAL_FLOAT(before.size, joint.point.size);
        TEST_ASSERT_EQUAL_FLOAT(before.r1.x, joint.point.r1.x);
    }
}

static void information_and_what_the_past_is_worth(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        jcal_ball_information_t all;
        jcal_ball_information(&joint.sums, &joint.past, &joint.point, &all);
        const float *const levers = all.levers;
        const float *const coupling = all.coupling;
        const float *const of_headings = all.headings;
        const double *const g = golden_information[p];
        double theirs[3];
        memcpy(theirs, &g[33], sizeof theirs);
        theirs[2] = has_closed() ? theirs[2] : 1.0;
        const double of_levers = size_of(g, 21);
        expect(g, levers, 21, 4.0 * SUM_TOL * of_levers);
        /* a coupling is at most the geometric mean of both it couples */
        expect(&g[21], coupling, 12, LEFT_TOL * sqrt(of_levers * size_of(theirs, 3)));
        expect(theirs, of_headings, 3, LEFT_TOL * size_of(theirs, 3));
        expect_share(golden_pasts[p][0], jcal_ball_past_pull(&joint.past), 3.0 * UNIT_TOL);
        if (has_closed()) {
            jcal_ball_bound(&joint, 0u);
            jcal_ball_past_add(&joint.past, &joint.point, joint.verdict.left);
            const double tolerance = (LEFT_TOL + FACTOR_TOL) * golden_conditions[p][1];
            TEST_ASSERT_DOUBLE_WITHIN(tolerance * size_of(golden_left[p], 3), golden_pasts[p][1],
                                      (double)joint.past.known);
            TEST_ASSERT_EQUAL_FLOAT(joint.point.heading[1].re, joint.past.heading.re);
            TEST_ASSERT_EQUAL_FLOAT(joint.point.heading[1].im, joint.past.heading.im);
        }
    }
}

static void bounds(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        for (unsigned part = 0u; part < JCAL_BALL_BOUND_SLICES; ++part) {
            jcal_ball_bound(&joint, part);
        }
        const double tolerance = (LEFT_TOL + FACTOR_TOL) * golden_conditions[p][1];
        const double *const b = golden_bounds[p];
        expect(golden_left[p], joint.verdict.left, 3, tolerance * size_of(golden_left[p], 3));
        expect_share(b[0], joint.verdict.heading_rad, tolerance);
        expect_share(b[1], joint.verdict.bound1_m, tolerance);
        expect_share(b[2], joint.verdict.bound2_m, tolerance);
    }
}

static void the_heading_of_the_moment(void)
{
    go_to(GOLDEN_POINTS - 1);
    joint.has_estimate = true;
    for (int k = GOLDEN_TICKS - GOLDEN_TRACKED; k < GOLDEN_TICKS; ++k) {
        const float *const g = golden_ticks[k];
        const jcal_tick_t tick1 = tick_of(g);
        const jcal_tick_t tick2 = tick_of(&g[24]);
        TEST_ASSERT_EQUAL_INT(k > GOLDEN_TICKS - GOLDEN_TRACKED, joint.track.known);
        jcal_ball_track_add(&joint, &tick1, &tick2, g[48]);
    }
    const float found[2] = {joint.track.heading.re, joint.track.heading.im};
    expect(golden_track[0], found, 2, LEFT_TOL);
    /* squares of differences of velocities of 0.3 m/s, the noise of which is 0.06 */
    expect_share(golden_track[0][2], joint.track.recent, 10.0 * LEFT_TOL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(sums_and_stiffness);
    RUN_TEST(products_of_both);
    RUN_TEST(levers_and_what_they_leave);
    RUN_TEST(headings);
    RUN_TEST(information_and_what_the_past_is_worth);
    RUN_TEST(bounds);
    RUN_TEST(the_heading_of_the_moment);
    return UNITY_END();
}
