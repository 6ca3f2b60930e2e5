/* SPDX-License-Identifier: MIT */
/// @file
/// Steps of the functional joint alone, where a whole run would cover up what they do wrong.
#include "functional/axes.h"
#include "functional/bounds.h"
#include "functional/describe.h"
#include "functional/headings.h"
#include "functional/search.h"
#include "functional/sums.h"
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

/* The weights of one tick, by their definition: m / (m + 0.3) of its time, and 1 / (m + 0.3) more for rates, m smoothed over 0.1 s. */
static void weights_of_a_tick(void)
{
    const hinge_t hinge = hinge_usual();
    jcal_tick_t tick1;
    jcal_tick_t tick2;
    run_begin(&run, &hinge, NULL);
    run.next = 40u;
    run_make(&run, &tick1, &tick2);
    tick1.gyr = jcal_vec3(1.0f, -2.0f, 0.5f);
    tick2.gyr = jcal_vec3(0.5f, 1.5f, 2.0f);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run.joint, &tick1, &tick2));
    const double m = 0.05 / 0.15 * (5.25 + 6.5);
    const double motion_s = 0.05 * m / (m + 0.3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, motion_s, (double)run.joint.sums.motion_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, motion_s * m / (m + 0.3), (double)run.joint.sums.rate2);
}

/* The worse of both sensors counts, whichever it is. */
static void gravity_of_either_sensor(void)
{
    const hinge_t hinge = hinge_usual();
    for (int which = 0; which < 2; ++which) {
        jcal_tick_t tick[2];
        run_begin(&run, &hinge, NULL);
        run_make(&run, &tick[0], &tick[1]);
        tick[0].acc_level_m_s2 = 9.81f;
        tick[1].acc_level_m_s2 = 9.81f;
        tick[which].acc_level_m_s2 = 9.01f;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run.joint, &tick[0], &tick[1]));
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.8f, run_result(&run).gravity_off_m_s2);
    }
}

/* Off gravity by so much: what is told after one more pair of ticks, whose sensor `which` has such a mean. */
static float off_after(int which, uint32_t epoch, float since_s, float mean)
{
    jcal_tick_t tick[2];
    run_make(&run, &tick[0], &tick[1]);
    tick[0].acc_level_m_s2 = 9.81f;
    tick[1].acc_level_m_s2 = 9.81f;
    tick[which].acc_level_m_s2 = mean;
    tick[1].epoch = epoch;
    tick[1].since_s = since_s;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run.joint, &tick[0], &tick[1]));
    ++run.next;
    return run_result(&run).gravity_off_m_s2;
}

/* The mean of the first seconds after a gap is none: what was known stands. The other sensor, which has a mean, is heard. */
static void gravity_after_a_gap_of_a_sensor(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.8f, off_after(1, 2u, 3.0f, 9.01f)); /* nothing is known: it must do */
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.0f, off_after(1, 2u, 30.0f, 9.81f));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.0f, off_after(1, 3u, 3.0f, 9.01f));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.7f, off_after(0, 3u, 19.0f, 9.11f));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.7f, off_after(1, 3u, 19.5f, 9.81f)); /* held, until both have a mean */
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.8f, off_after(1, 3u, 20.5f, 9.01f));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.0f, off_after(1, 3u, 21.0f, 9.81f));
}

/* After a gap no judgement begins before the new block has motion enough for a heading of its own; it then begins with that heading. */
static void a_judgement_after_a_gap_begins_with_the_heading(void)
{
    const hinge_t hinge = hinge_usual();
    jcal_tick_t tick[2];
    run_begin(&run, &hinge, NULL);
    run_for(&run, 10.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    bool has_begun = false;
    for (int k = 0; (k < 200) && !has_begun; ++k) {
        run_make(&run, &tick[0], &tick[1]);
        tick[1].epoch += 1u;
        tick[1].since_s = 5.0f;
        ++run.next;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run.joint, &tick[0], &tick[1]));
        const float motion_s = run.joint.sums.block[0].motion_s;
        const bool worked = jcal_functional_step(&run.joint) == JCAL_OK;
        has_begun = !run.joint.cut;
        TEST_ASSERT_EQUAL(has_begun, worked);
        TEST_ASSERT_TRUE(!has_begun || (motion_s >= 0.4f));
        TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    }
    TEST_ASSERT_TRUE(has_begun);
    TEST_ASSERT_EQUAL_UINT8(JCAL_FUNCTIONAL_ROUND_SLICES, run.joint.slice); /* the headings' slice was done */
}

/* A trial becomes the estimate if it is better by the odds that are asked for. */
static void a_better_trial_is_taken(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 4.0);
    TEST_ASSERT_TRUE(run.joint.search.has_estimate);
    for (int better = 0; better < 2; ++better) {
        jcal_functional_search_t search = run.joint.search;
        jcal_functional_point_t estimate = run.joint.point;
        for (unsigned part = 0; part + 1u < JCAL_FUNCTIONAL_TRIAL_SLICES; ++part) {
            TEST_ASSERT_FALSE(jcal_functional_try(&search, &run.joint.sums, &estimate, part));
        }
        jcal_functional_point_t trial = search.trial; /* what the last slice will make of it */
        jcal_functional_round(&run.joint.sums, &trial,
                              (JCAL_FUNCTIONAL_TRIAL_SLICES - 2u) % JCAL_FUNCTIONAL_ROUND_SLICES);
        estimate.energy = trial.energy + ((better == 1) ? 0.6f : 0.4f) / run.joint.sums.motion_s;
        const bool taken = jcal_functional_try(&search, &run.joint.sums, &estimate, JCAL_FUNCTIONAL_TRIAL_SLICES - 1u);
        TEST_ASSERT_EQUAL_INT(better, taken);
    }
}

/* A gap of either sensor closes the block that is open; the tick that tells of it is left out. */
static void a_gap_of_either_sensor(void)
{
    const hinge_t hinge = hinge_usual();
    for (int which = 0; which < 2; ++which) {
        jcal_tick_t tick[2];
        run_begin(&run, &hinge, NULL);
        run_for(&run, 3.0);
        const float open_s = run.joint.sums.block[0].motion_s;
        const float all_s = run.joint.sums.motion_s;
        TEST_ASSERT_TRUE(open_s > 0.5f);
        run_make(&run, &tick[0], &tick[1]);
        tick[which].epoch += 1u;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run.joint, &tick[0], &tick[1]));
        TEST_ASSERT_EQUAL_FLOAT(0.0f, run.joint.sums.block[0].motion_s);
        TEST_ASSERT_EQUAL_FLOAT(open_s, run.joint.sums.block[1].motion_s);
        TEST_ASSERT_EQUAL_FLOAT(all_s, run.joint.sums.motion_s);
    }
}

/* Judgements that agreed spoke of the estimate that was. */
static void another_estimate_is_judged_anew(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 3.0);
    jcal_functional_t *const joint = &run.joint;
    TEST_ASSERT_FALSE(joint->merged);
    joint->verdict.status = (uint8_t)JCAL_COLLECTING;
    joint->verdict.agreed = 2u;
    joint->search.trial = joint->point;
    joint->search.tried = JCAL_FUNCTIONAL_FIRST_TRIALS;
    joint->point.j1 = jcal_vec3(0.0f, 0.6f, 0.8f);
    joint->point.energy = 1e6f;
    joint->slice = (uint8_t)((2u * JCAL_FUNCTIONAL_ROUND_SLICES) + JCAL_FUNCTIONAL_TRIAL_SLICES - 1u);
    joint->credit = 1.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_step(joint));
    TEST_ASSERT_TRUE(joint->point.energy < 1e5f);
    TEST_ASSERT_EQUAL_UINT8(0u, joint->verdict.agreed);
}

/* Halving forgets motion, not how old the open block is. */
static void halving_keeps_the_age_of_a_block(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 3.0);
    const jcal_functional_sums_t was = run.joint.sums;
    jcal_functional_sums_fade(&run.joint.sums, 0.5f);
    TEST_ASSERT_EQUAL_FLOAT(was.block[0].time_s, run.joint.sums.block[0].time_s);
    TEST_ASSERT_EQUAL_FLOAT(0.5f * was.motion_s, run.joint.sums.motion_s);
    TEST_ASSERT_EQUAL_FLOAT(0.5f * was.block[0].rate[80], run.joint.sums.block[0].rate[80]);
    TEST_ASSERT_EQUAL_FLOAT(0.5f * was.along[4], run.joint.sums.along[4]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_two_axes_that_are_known_least);
    RUN_TEST(stiffness_of_known_products);
    RUN_TEST(a_turn_follows_its_heading);
    RUN_TEST(ticks_between_the_slices_of_the_bounds);
    RUN_TEST(weights_of_a_tick);
    RUN_TEST(gravity_of_either_sensor);
    RUN_TEST(gravity_after_a_gap_of_a_sensor);
    RUN_TEST(a_judgement_after_a_gap_begins_with_the_heading);
    RUN_TEST(a_better_trial_is_taken);
    RUN_TEST(a_gap_of_either_sensor);
    RUN_TEST(another_estimate_is_judged_anew);
    RUN_TEST(halving_keeps_the_age_of_a_block);
    return UNITY_END();
}
