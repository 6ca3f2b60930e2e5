/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of ball/bounds.h: parts of the information against the whole of it, inverted in double precision; and where nothing is known.
#include "ball/bounds.h"

#include "ball/solve.h"
#include "jointcal/head.h"
#include "math/sym.h"
#include "unit/ball/fixture.h"

enum { N = 8 };

static run_t run;

void setUp(void)
{
}

void tearDown(void)
{
}

/* The whole information, with the share of its largest element about a lever that every direction of the levers is given. */
static void information_of(const jcal_ball_t *joint, double h[N][N])
{
    jcal_ball_information_t all;
    jcal_ball_information(&joint->sums, &joint->past, &joint->point, &all);
    const float *const levers = all.levers;
    const float *const coupling = all.coupling;
    const float *const headings = all.headings;
    double largest = 0.0;
    for (size_t i = 0; i < 6u; ++i) {
        largest = fmax(largest, (double)levers[jcal_sym_at(i, i)]);
    }
    for (size_t i = 0; i < 6u; ++i) {
        for (size_t k = 0; k < 6u; ++k) {
            h[i][k] = (double)levers[jcal_sym_at(i, k)] + ((i == k) ? 1e-5 * largest : 0.0);
        }
        for (size_t b = 0; b < 2u; ++b) {
            h[i][6u + b] = h[6u + b][i] = (double)coupling[(6u * b) + i];
        }
    }
    h[6][6] = (double)headings[0];
    h[6][7] = h[7][6] = (double)headings[1];
    h[7][7] = (double)headings[2];
}

/* h <- its inverse, by Gauss and Jordan without exchanges, as a positive matrix allows; false if it is none. */
static bool invert(double h[N][N])
{
    for (int p = 0; p < N; ++p) {
        const double pivot = h[p][p];
        if (!(pivot > 0.0)) {
            return false;
        }
        h[p][p] = 1.0;
        for (int k = 0; k < N; ++k) {
            h[p][k] /= pivot;
        }
        for (int i = 0; i < N; ++i) {
            const double factor = h[i][p];
            if (i != p) {
                h[i][p] = 0.0;
                for (int k = 0; k < N; ++k) {
                    h[i][k] -= factor * h[p][k];
                }
            }
        }
    }
    return true;
}

/* Largest eigenvalue of a 3 x 3 part, by powers. */
static double largest_of(double h[N][N], int first)
{
    double v[3] = {0.5, 0.7, 0.4};
    double size = 0.0;
    for (int round = 0; round < 400; ++round) {
        double next[3] = {0.0};
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) {
                next[i] += h[first + i][first + k] * v[k];
            }
        }
        size = sqrt(next[0] * next[0] + next[1] * next[1] + next[2] * next[2]);
        for (int i = 0; i < 3; ++i) {
            v[i] = next[i] / size;
        }
    }
    return size;
}

static void bound_all(jcal_ball_t *joint)
{
    for (unsigned part = 0u; part < JCAL_BALL_BOUND_SLICES; ++part) {
        jcal_ball_bound(joint, part);
    }
}

/* Away from the best point, where levers and headings hang together: longer levers, headings that are off. */
static void bounds_are_those_of_the_whole(void)
{
    for (int number = 0; number < 8; ++number) {
        const hinge_t arm = some_arm(number);
        run_begin(&run, &arm, NULL);
        run_for(&run, 13.0);
        jcal_ball_t *const joint = &run.joint;
        TEST_ASSERT_TRUE(joint->sums.block_motion_s[1] > 0.0f);
        const jcal_plane_t off[2] = {{cosf(0.4f), sinf(0.4f)}, {cosf(0.2f), -sinf(0.2f)}};
        for (int b = 0; b < 2; ++b) {
            const jcal_plane_t was = joint->point.heading[b];
            joint->point.heading[b].re = (was.re * off[b].re) - (was.im * off[b].im);
            joint->point.heading[b].im = (was.re * off[b].im) + (was.im * off[b].re);
        }
        joint->point.size = 2e-4f;
        joint->point.r1.x += 0.02f;
        joint->past.known = 300.0f;
        double h[N][N];
        information_of(joint, h);
        double coupling = 0.0;
        for (int i = 0; i < 6; ++i) {
            coupling += fabs(h[i][6]) + fabs(h[i][7]);
        }
        TEST_ASSERT_TRUE_MESSAGE(coupling > 10.0, "nothing hangs together");
        TEST_ASSERT_TRUE(invert(h));
        bound_all(joint);
        /* parts are rounded once, and their inverse has a condition of some hundreds */
        const double tolerance = 1e-4;
        const double heading = 2.0 * sqrt(h[6][6]);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance * heading, heading, (double)joint->verdict.heading_rad);
        const double spread1 = 0.5 * sqrt(largest_of(h, 0));
        const double spread2 = 0.5 * sqrt(largest_of(h, 3));
        TEST_ASSERT_DOUBLE_WITHIN(tolerance * spread1, spread1, (double)joint->verdict.spread1_m);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance * spread2, spread2, (double)joint->verdict.spread2_m);
        TEST_ASSERT_TRUE(joint->verdict.bound1_m > joint->verdict.spread1_m + 0.003f);
    }
}

/* The wrong way round a heading has no bound, and levers have none without it. */
static void nothing_is_known_where_the_cost_bends_down(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_for(&run, 4.5);
    jcal_ball_t *const joint = &run.joint;
    bound_all(joint);
    TEST_ASSERT_TRUE(joint->verdict.heading_rad < 0.1f);
    TEST_ASSERT_TRUE(joint->verdict.bound1_m < 0.1f);
    jcal_ball_turn(&joint->point, 4u);
    bound_all(joint);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, joint->verdict.heading_rad);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, joint->verdict.bound1_m);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, joint->verdict.bound2_m);
}

/* One of the two headings the wrong way round: as soon as the whole has a direction in which the cost bends down, nothing is told. */
static void one_heading_that_is_wrong_spoils_all(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_for(&run, 8.5);
    jcal_ball_t *const joint = &run.joint;
    const jcal_ball_point_t best = joint->point;
    int spoilt = 0;
    for (unsigned n = 1u; n < 16u; ++n) {
        const size_t b = n % 2u;
        joint->point = best;
        jcal_ball_turn(&joint->point, 1u + (n / 2u));
        joint->point.heading[1u - b] = best.heading[1u - b];
        joint->point.r1 = jcal_vec3_scale(best.r1, 4.0f); /* and levers as wrong, so that ties do not hold it */
        joint->point.r2 = jcal_vec3_scale(best.r2, 4.0f);
        double h[N][N];
        information_of(joint, h);
        bound_all(joint);
        if (!invert(h)) {
            ++spoilt;
            TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, joint->verdict.heading_rad);
            TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, joint->verdict.bound1_m);
            TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, joint->verdict.bound2_m);
        }
    }
    TEST_ASSERT_TRUE(spoilt > 3);
}

/* A joint that bends about one line has a heading, while its centre is open along that line. */
static void a_hinge_has_a_heading_and_no_centre(void)
{
    hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 10.0);
    const jcal_ball_result_t result = run_result(&run);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result.head.status);
    TEST_ASSERT_TRUE(run_heading_error(&run) < 0.01);
    TEST_ASSERT_TRUE(result.uncertainty1_m > 0.3f && result.uncertainty2_m > 0.3f);
    TEST_ASSERT_FALSE(result.for_center1 || result.for_center2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(bounds_are_those_of_the_whole);
    RUN_TEST(nothing_is_known_where_the_cost_bends_down);
    RUN_TEST(one_heading_that_is_wrong_spoils_all);
    RUN_TEST(a_hinge_has_a_heading_and_no_centre);
    return UNITY_END();
}
