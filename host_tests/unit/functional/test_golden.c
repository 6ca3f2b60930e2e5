/* SPDX-License-Identifier: MIT */
/// @file
/// Every step of the functional joint against the float64 numpy reference, tools/maintain/make_golden.py.
#include "functional/axes.h"
#include "functional/bounds.h"
#include "functional/describe.h"
#include "functional/headings.h"
#include "functional/levers.h"
#include "functional/model.h"
#include "functional/rival.h"
#include "functional/sums.h"
#include "functional/track.h"
#include "golden/functional.h"
#include "joint/sign.h"
#include "jointcal/functional.h"
#include "jointcal/quat.h"
#include "levers/levers.h"

#include <math.h>
#include <string.h>
#include <unity.h>

/* 77 roundings of 6e-8 of a sum, all to one side; and twice that where two such sums are taken from each other. */
static const double SUM_TOL = 4.6e-6;
/* A system of equations multiplies that by what its condition is worth: 6 x 6 with a ridge of 1/200 of the mean diagonal, at most 20
 * times; the axes' 4 x 4 and the turns' 3 x 3 are better. */
static const double SOLVE_TOL = 1e-4;
/* The best heading and turn are found to a rounding of their slopes, 6e-8 of matrices of 500 over a curvature of 100. */
static const double SETTLED_TOL = 1e-5;
/* Bending takes the axes for the stiffest direction; those of the points are 6 deg off in the mean, 1 % of the squares. */
static const double BEND_TOL = 0.03;
/* Quaternions and axes are unit to 1e-7, and some poses turn the axes 60 deg apart, which takes three quarters of the arms of the arctangent. */
static const double ANGLE_TOL = 1e-5;

static jcal_functional_t joint;

static jcal_vec3_t vector(const float *v)
{
    return (jcal_vec3_t){v[0], v[1], v[2]};
}

static jcal_tick_t tick_of(const float *v)
{
    jcal_tick_t out;
    memset(&out, 0, sizeof out);
    out.dt_s = GOLDEN_TICK_S;
    memcpy(out.turn, v, sizeof out.turn);
    memcpy(out.rate, &v[9], sizeof out.rate);
    memcpy(out.lever, &v[18], sizeof out.lever);
    out.velocity = vector(&v[27]);
    out.gyr = vector(&v[30]);
    return out;
}

/* All ticks; blocks are closed where the reference closed them. */
static void sum_up(void)
{
    int closed = 0;
    for (int k = 0; k < GOLDEN_TICKS; ++k) {
        const float *const g = golden_ticks[k];
        const jcal_tick_t tick1 = tick_of(g);
        const jcal_tick_t tick2 = tick_of(&g[33]);
        const jcal_tick_weights_t weights = {g[66], g[67], g[68]};
        jcal_functional_sums_add(&joint.sums, &tick1, &tick2, &weights);
        const bool due = (closed < GOLDEN_CLOSES) && (golden_closes[closed][0] == (float)(k + 1));
        TEST_ASSERT_EQUAL_INT(due, jcal_functional_sums_full(&joint.sums));
        if (due) {
            const float *const c = golden_closes[closed++];
            joint.point.heading[1] = (jcal_plane_t){c[1], c[2]};
            memcpy(joint.point.turn[1], &c[3], sizeof joint.point.turn[1]);
            jcal_functional_sums_close(&joint.sums, &joint.point);
        }
    }
    TEST_ASSERT_EQUAL_INT(GOLDEN_CLOSES, closed);
}

static void measure(void)
{
    jcal_functional_cross_t x;
    jcal_functional_cross(&joint.sums, &joint.point, &x);
    jcal_functional_measure(&joint.sums, &x, &joint.point);
}

/* A point of the reference, with its levers and weights. */
static void go_to(int p)
{
    const float *const g = golden_points[p];
    jcal_functional_point_t *const point = &joint.point;
    point->j1 = vector(g);
    point->j2 = vector(&g[3]);
    for (int b = 0; b < 2; ++b) {
        point->heading[b] = (jcal_plane_t){g[12 + 2 * b], g[13 + 2 * b]};
        memcpy(point->turn[b], &g[16 + 9 * b], sizeof point->turn[b]);
    }
    float x[16];
    jcal_levers_cross(&joint.sums.levers, point->heading, x);
    jcal_functional_levers(&joint.sums, x, point);
    measure();
}

static double size_of(const double *values, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        sum += values[i] * values[i];
    }
    return sqrt(sum);
}

/* Both arrays, to `tolerance` of the length of the expected one or of `scale` if that is larger. */
static void expect(const double *expected, const float *found, int n, double tolerance, double scale)
{
    const double allowed = tolerance * fmax(size_of(expected, n), scale);
    for (int i = 0; i < n; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(allowed, expected[i], (double)found[i]);
    }
}

static void expect_vector(const double *expected, jcal_vec3_t found, double tolerance)
{
    const float v[3] = {found.x, found.y, found.z};
    expect(expected, v, 3, tolerance, 0.0);
}

void setUp(void)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_init(&joint, &config));
    sum_up();
}

void tearDown(void)
{
}

static void cross_products(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        jcal_functional_cross_t x;
        float lever[16];
        float level[9];
        jcal_functional_cross(&joint.sums, &joint.point, &x);
        jcal_levers_cross(&joint.sums.levers, joint.point.heading, lever);
        jcal_functional_cross_level(&joint.sums, &joint.point, level);
        expect(&golden_cross[p][0], x.turn, 9, SUM_TOL, 0.0);
        expect(&golden_cross[p][9], x.rate, 9, SUM_TOL, 0.0);
        expect(&golden_cross[p][18], lever, 16, SUM_TOL, 0.0);
        expect(&golden_cross[p][34], level, 9, SUM_TOL, 0.0);
    }
}

static void levers_and_what_they_leave(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        const double *const g = golden_levers[p];
        expect_vector(&g[0], joint.point.r1, SOLVE_TOL);
        expect_vector(&g[3], joint.point.r2, SOLVE_TOL);
        /* what is left is the difference of both sides and their product */
        const double both = g[7] * (double)joint.sums.motion_s;
        TEST_ASSERT_DOUBLE_WITHIN(2.0 * SUM_TOL * both, g[6], (double)joint.point.lack);
        TEST_ASSERT_DOUBLE_WITHIN(SOLVE_TOL * g[7], g[7], (double)joint.point.speed2);
    }
}

static void sizes_weights_and_energy(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        const double *const g = golden_sizes[p];
        const double both[3] = {2.0, 1.0, golden_levers[p][7]}; /* each is the difference of sums of this size */
        for (int f = 0; f < 3; ++f) {
            const double allowed = 2.0 * SUM_TOL * both[f] / g[f];
            TEST_ASSERT_DOUBLE_WITHIN(allowed * g[f], g[f], (double)joint.point.size[f]);
            TEST_ASSERT_DOUBLE_WITHIN(allowed * g[3 + f], g[3 + f], (double)joint.point.weight[f]);
        }
        TEST_ASSERT_DOUBLE_WITHIN(SOLVE_TOL * fabs(g[6]), g[6], (double)joint.point.energy);
    }
}

static void cost_of_the_axes_and_a_newton_step(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        jcal_functional_cross_t x;
        jcal_functional_quadric_t h;
        jcal_functional_cross(&joint.sums, &joint.point, &x);
        jcal_functional_quadric(&joint.sums, &x, &joint.point, &h);
        /* The weights are as right as the sizes. */
        expect(&golden_quadric[p][0], h.h11, 6, SOLVE_TOL, 0.0);
        expect(&golden_quadric[p][6], h.h22, 6, SOLVE_TOL, 0.0);
        expect(&golden_quadric[p][12], h.h12, 9, SOLVE_TOL, 0.0);
        const jcal_tangent_t t[2] = {jcal_sphere_tangent(joint.point.j1), jcal_sphere_tangent(joint.point.j2)};
        float hessian[10];
        float slope[4];
        const jcal_vec3_t axes[2] = {joint.point.j1, joint.point.j2};
        jcal_functional_tangent_hessian(&h, axes, true, hessian, slope);
        const double scale = size_of(&golden_quadric[p][0], 6);
        for (int i = 0; i < 4; ++i) {
            const double *const free = &golden_quadric[p][21 + 3 * (i / 2)];
            const jcal_vec3_t d = (i % 2 == 0) ? t[i / 2].u : t[i / 2].v;
            const double along = free[0] * (double)d.x + free[1] * (double)d.y + free[2] * (double)d.z;
            TEST_ASSERT_DOUBLE_WITHIN(SOLVE_TOL * scale, along, (double)slope[i]);
        }
        jcal_functional_step_axes(&h, &joint.point.j1, &joint.point.j2);
        expect_vector(&golden_axes[p][0], joint.point.j1, SOLVE_TOL);
        expect_vector(&golden_axes[p][3], joint.point.j2, SOLVE_TOL);
    }
}

static void headings_and_turns(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        for (size_t b = 0; b < 2; ++b) {
            go_to(p);
            jcal_functional_grip_t grip;
            float n[9];
            float slope[3];
            jcal_functional_grip(&joint.sums, &joint.point, b, &grip);
            jcal_functional_times_transposed(joint.point.turn[b], grip.m, n);
            jcal_functional_turn_slope(n, slope);
            double size = 0.0;
            for (int i = 0; i < 9; ++i) {
                size += (double)grip.m[i] * (double)grip.m[i];
            }
            expect(&golden_turn_slopes[p][3 * b], slope, 3, SOLVE_TOL, sqrt(size));
            jcal_functional_find_heading(&joint.sums, &joint.point, b);
            const float heading[2] = {joint.point.heading[b].re, joint.point.heading[b].im};
            expect(&golden_headings[p][2 * b], heading, 2, SETTLED_TOL, 0.0);
        }
    }
}

/* The reference finds the nearest rotation; a Newton step for each round ends there too. */
static void headings_and_turns_settle_where_they_are_best(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        for (int round = 0; round < 100; ++round) {
            jcal_functional_find_heading(&joint.sums, &joint.point, 0u);
            jcal_functional_find_heading(&joint.sums, &joint.point, 1u);
        }
        for (int b = 0; b < 2; ++b) {
            const float heading[2] = {joint.point.heading[b].re, joint.point.heading[b].im};
            expect(&golden_settled[p][2 * b], heading, 2, SETTLED_TOL, 0.0);
            expect(&golden_settled[p][4 + 9 * b], joint.point.turn[b], 9, SETTLED_TOL, 0.0);
        }
    }
}

static void what_blocks_take_from_the_axes(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        go_to(p);
        const jcal_tangent_t t[2] = {jcal_sphere_tangent(joint.point.j1), jcal_sphere_tangent(joint.point.j2)};
        for (size_t b = 0; b < 2; ++b) {
            float nuisance[6];
            float coupling[12];
            float slope[3];
            jcal_functional_bound_slope(&joint.sums, &joint.point, b, slope);
            jcal_functional_bound_nuisance(&joint.sums, &joint.point, b, nuisance);
            jcal_functional_bound_coupling(&joint.sums, &joint.point, b, coupling);
            expect(&golden_nuisances[p][6 * b], nuisance, 6, SOLVE_TOL, 0.0);
            expect(&golden_nuisance_slopes[p][3 * b], slope, 3, SOLVE_TOL, size_of(&golden_nuisances[p][6 * b], 6));
            const double *const free = &golden_couplings[p][18 * b];
            const double scale = size_of(free, 18);
            for (int i = 0; i < 4; ++i) {
                const jcal_vec3_t d = (i % 2 == 0) ? t[i / 2].u : t[i / 2].v;
                const double *const rows = &free[9 * (i / 2)];
                for (int k = 0; k < 3; ++k) {
                    const double along = rows[k] * (double)d.x + rows[3 + k] * (double)d.y + rows[6 + k] * (double)d.z;
                    TEST_ASSERT_DOUBLE_WITHIN(SOLVE_TOL * scale, along, (double)coupling[3 * i + k]);
                }
            }
        }
    }
}

/* From headings and turns that have settled. */
static void settle_at(int p)
{
    go_to(p);
    for (int b = 0; b < 2; ++b) {
        const double *const g = golden_settled[p];
        joint.point.heading[b] = (jcal_plane_t){(float)g[2 * b], (float)g[2 * b + 1]};
        for (int i = 0; i < 9; ++i) {
            joint.point.turn[b][i] = (float)g[4 + 9 * b + i];
        }
    }
}

static void describe(void)
{
    jcal_functional_cross_t x;
    jcal_functional_cross(&joint.sums, &joint.point, &x);
    jcal_functional_describe(&joint, &x);
}

static void share_bending_and_stiffness(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        settle_at(p);
        describe();
        jcal_functional_stiffness(&joint);
        const double *const g = golden_described[p];
        TEST_ASSERT_DOUBLE_WITHIN(SOLVE_TOL, g[0], (double)joint.verdict.share);
        TEST_ASSERT_DOUBLE_WITHIN(SOLVE_TOL, g[2], (double)joint.verdict.stiffness);
        TEST_ASSERT_DOUBLE_WITHIN(BEND_TOL * g[1], g[1], (double)joint.verdict.bend_rad);
        joint.point.j1 =
            (jcal_vec3_t){(float)golden_stiffest[p][0], (float)golden_stiffest[p][1], (float)golden_stiffest[p][2]};
        joint.point.j2 =
            (jcal_vec3_t){(float)golden_stiffest[p][3], (float)golden_stiffest[p][4], (float)golden_stiffest[p][5]};
        describe();
        TEST_ASSERT_DOUBLE_WITHIN(SOLVE_TOL, g[1], (double)joint.verdict.bend_rad);
    }
}

static void bounds(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        settle_at(p);
        describe();
        for (unsigned part = 0; part < JCAL_FUNCTIONAL_BOUND_SLICES; ++part) {
            jcal_functional_bound(&joint, part);
        }
        const float found[2] = {joint.verdict.bound1_rad, joint.verdict.bound2_rad};
        /* what is left of the information once the blocks have taken theirs is a fifth of it: five times the tolerance */
        expect(golden_bounds[p], found, 2, 5.0 * SOLVE_TOL, 0.0);
        expect_vector(&golden_home[p][0], joint.point.j1, 5.0 * SOLVE_TOL);
        expect_vector(&golden_home[p][3], joint.point.j2, 5.0 * SOLVE_TOL);
        joint.search.has_estimate = true;
        TEST_ASSERT_DOUBLE_WITHIN(BEND_TOL * golden_bounds[p][2], golden_bounds[p][2],
                                  (double)jcal_functional_flexion_error(&joint, fmaxf(found[0], found[1])));
    }
}

static void the_other_pairing(void)
{
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        settle_at(p);
        for (unsigned part = 0; part < JCAL_FUNCTIONAL_RIVAL_SLICES; ++part) {
            jcal_functional_compare(&joint, part);
        }
        const double *const g = golden_rivals[p];
        expect(g, joint.verdict.evidence, 3, SOLVE_TOL, 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(SOLVE_TOL * g[3], g[3], (double)joint.verdict.opposite);
        expect_vector(&g[4], joint.search.trial.j1, SOLVE_TOL);
        expect_vector(&g[7], joint.search.trial.j2, SOLVE_TOL);
    }
}

static void the_angle_but_for_its_zero(void)
{
    go_to(0);
    joint.search.has_estimate = true;
    jcal_functional_track_begin(&joint);
    double zero = 0.0;
    for (int k = 0; k < GOLDEN_POSES; ++k) {
        const double *const g = golden_poses[k];
        const jcal_quat_t q1 = jcal_quat_normalise(jcal_quat((float)g[0], (float)g[1], (float)g[2], (float)g[3]));
        const jcal_quat_t q2 = jcal_quat_normalise(jcal_quat((float)g[4], (float)g[5], (float)g[6], (float)g[7]));
        /* the angle grows about the axis as it is reported */
        const double sign = (double)jcal_sign_main(joint.point.j1);
        const double off = sign * (double)jcal_functional_flexion(&joint, q1, q2) - g[8];
        zero = (k == 0) ? off : zero;
        TEST_ASSERT_DOUBLE_WITHIN(ANGLE_TOL, 0.0, remainder(off - zero, 6.283185307179586));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(cross_products);
    RUN_TEST(levers_and_what_they_leave);
    RUN_TEST(sizes_weights_and_energy);
    RUN_TEST(cost_of_the_axes_and_a_newton_step);
    RUN_TEST(headings_and_turns);
    RUN_TEST(headings_and_turns_settle_where_they_are_best);
    RUN_TEST(what_blocks_take_from_the_axes);
    RUN_TEST(share_bending_and_stiffness);
    RUN_TEST(bounds);
    RUN_TEST(the_other_pairing);
    RUN_TEST(the_angle_but_for_its_zero);
    return UNITY_END();
}
