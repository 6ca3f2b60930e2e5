/* SPDX-License-Identifier: MIT */
/// @file
/// Steps of the functional joint alone, where a whole run would cover up what they do wrong.
#include "functional/axes.h"
#include "functional/bounds.h"
#include "functional/describe.h"
#include "functional/headings.h"
#include "math/plane.h"
#include "math/sym.h"
#include "unit/functional/fixture.h"

#include <string.h>

static run_t run;

void setUp(void)
{
}

void tearDown(void)
{
}

/* out (3 x 3) <- rotation by a vector, as floats. */
static void turned(const double by[3], float out[9])
{
    double m[9];
    mat_turn(by, m);
    for (int i = 0; i < 9; ++i) {
        out[i] = (float)m[i];
    }
}

/* Both axes that are open are found, each with its own partner: H of two equal sensors, open along x most and along y second. */
static void the_two_axes_that_are_known_least(void)
{
    jcal_functional_quadric_t h;
    memset(&h, 0, sizeof h);
    const float own[3] = {1.0f, 1.3f, 4.0f};
    const float shared[3] = {-0.98f, -1.22f, 1.0f};
    for (size_t i = 0; i < 3; ++i) {
        h.h11[jcal_sym_at(i, i)] = own[i];
        h.h22[jcal_sym_at(i, i)] = own[i];
        h.h12[4 * i] = shared[i];
    }
    /* Of the sums of both sensors x leaves 0.02 and y 0.08; the differences and z leave at least 1.98. */
    for (unsigned which = 0; which < 2u; ++which) {
        jcal_vec3_t j1;
        jcal_vec3_t j2;
        TEST_ASSERT_TRUE(jcal_functional_open_axes(&h, which, &j1, &j2));
        const jcal_vec3_t wanted = (which == 0u) ? jcal_vec3(1.0f, 0.0f, 0.0f) : jcal_vec3(0.0f, 1.0f, 0.0f);
        TEST_ASSERT_FLOAT_WITHIN(0.01f, 1.0f, fabsf(jcal_vec3_dot(j1, wanted)));
        TEST_ASSERT_FLOAT_WITHIN(0.01f, 1.0f, jcal_vec3_dot(j1, j2));
    }
}

/* A sum of products of rates with known singular values, in any frames: what one rotation between both leaves. */
static void stiffness_of_known_products(void)
{
    static jcal_functional_t joint;
    const jcal_functional_config_t config = jcal_functional_config_default();
    const double by1[3] = {0.7, -0.4, 1.1};
    const double by2[3] = {-0.3, 0.9, 0.5};
    float u[9];
    float v[9];
    turned(by1, u);
    turned(by2, v);
    for (int over = 0; over < 2; ++over) {
        const float values[3] = {3.0f, 2.0f, (over == 0) ? 1.0f : -1.0f}; /* a negative one: the determinant's sign */
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_init(&joint, &config));
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) {
                for (int n = 0; n < 3; ++n) {
                    joint.sums.along[3 * i + k] += values[n] * u[3 * i + n] * v[3 * k + n];
                }
            }
        }
        for (size_t i = 0; i < 3; ++i) { /* half of these traces are the squared rates: 9 and 12 */
            joint.sums.rate1[jcal_sym_at(i, i)] = 6.0f;
            joint.sums.rate2nd[jcal_sym_at(i, i)] = 8.0f;
        }
        jcal_functional_stiffness(&joint);
        const float best = (over == 0) ? 6.0f : 4.0f;
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, (21.0f - 2.0f * best) / 9.0f, joint.verdict.stiffness);
    }
}

/* Heading and turn are off by the same: one step brings both back, since a turn follows its heading. */
static void a_turn_follows_its_heading(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 8.0);
    jcal_functional_point_t *const point = &run.joint.point;
    for (int round = 0; round < 50; ++round) {
        jcal_functional_find_heading(&run.joint.sums, point, 0u);
    }
    const jcal_functional_point_t settled = *point;
    const jcal_plane_t off = {0.95533649f, 0.29552021f}; /* 0.3 rad */
    point->heading[0] = jcal_plane_times(point->heading[0], off);
    for (size_t k = 0; k < 3; ++k) {
        const jcal_plane_t column = jcal_plane_times(off, (jcal_plane_t){point->turn[0][k], point->turn[0][3 + k]});
        point->turn[0][k] = column.re;
        point->turn[0][3 + k] = column.im;
    }
    jcal_functional_find_heading(&run.joint.sums, point, 0u);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, settled.heading[0].re, point->heading[0].re);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, settled.heading[0].im, point->heading[0].im);
    for (int i = 0; i < 9; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, settled.turn[0][i], point->turn[0][i]);
    }
}

static void bound_parts(jcal_functional_t *joint, unsigned from, unsigned to)
{
    for (unsigned part = from; part < to; ++part) {
        jcal_functional_bound(joint, part);
    }
}

/* Trace of what is left of the axes' information. */
static float left_of(const jcal_functional_t *joint)
{
    const float *const h = joint->verdict.hessian;
    return h[0] + h[2] + h[5] + h[9];
}

/* Ticks that come between the slices of the bounds make a young block larger than it was when they were begun: what is taken from the
 * axes' information is of the block as it was. A block of three times the same is the clearest case; only what ties turns to their
 * headings does not grow with it. */
static void ticks_between_the_slices_of_the_bounds(void)
{
    static jcal_functional_t apart;
    static jcal_functional_t at_once;
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    while (run.joint.sums.block[1].motion_s == 0.0f) { /* until a block was closed and the next begins */
        run_tick(&run);
    }
    run_for(&run, 0.3);
    at_once = run.joint;
    bound_parts(&at_once, 0u, 1u);
    const float before = left_of(&at_once);
    apart = at_once;
    float *const block = (float *)&apart.sums.block[0]; /* nothing but floats */
    for (size_t i = 0; i < sizeof apart.sums.block[0] / sizeof *block; ++i) {
        block[i] *= 3.0f;
    }
    bound_parts(&at_once, 1u, 2u);
    bound_parts(&apart, 1u, 2u);
    const float taken = before - left_of(&at_once);
    TEST_ASSERT_TRUE(taken > 0.0f);
    TEST_ASSERT_FLOAT_WITHIN(0.2f * taken, taken, before - left_of(&apart));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_two_axes_that_are_known_least);
    RUN_TEST(stiffness_of_known_products);
    RUN_TEST(a_turn_follows_its_heading);
    RUN_TEST(ticks_between_the_slices_of_the_bounds);
    return UNITY_END();
}
