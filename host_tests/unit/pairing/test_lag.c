/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/lag.h: sums against double precision, and the lag of made-up joints, which has no noise.
#include "jointcal/lag.h"

#include "pairing/lag_search.h"
#include "pairing/lag_sums.h"
#include "unit/pairing/warm.h"

#include <string.h>

/* 200 roundings of 6e-8, all to one side, of sums of squares. */
static const double SUM_TOL = 200.0 * 6e-8;

enum { N = JCAL_LAG_NODES, SIDE = JCAL_LAG_SIDE };

static jcal_lag_t lag;
static uint32_t next;

void setUp(void)
{
    next = 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_init(&lag));
}

void tearDown(void)
{
}

/* Sensor 2 of `two` says too late by late_s. */
static void add_pair(const hinge_t *one, const hinge_t *two, double late_s)
{
    const double t = 0.05 * (double)next;
    const uint64_t t_us = (uint64_t)next * TICK_US;
    const jcal_tick_t tick1 = warm_tick(one, t, 1, t_us);
    const jcal_tick_t tick2 = warm_tick(two, t - late_s, 2, t_us);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_add(&lag, &tick1, &tick2));
    ++next;
}

static void judge_once(void)
{
    for (unsigned k = 0u; k < JCAL_LAG_SEARCH_SLICES; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_step(&lag));
    }
}

static jcal_lag_result_t result(void)
{
    jcal_lag_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_get(&lag, &out));
    return out;
}

/* Seconds of ticks, five slices of work for each, and the lag taken off where it is to be; returns what was taken off. */
static double run(const hinge_t *one, const hinge_t *two, double late_s, double seconds)
{
    double taken = 0.0;
    for (int k = 0; k < (int)(20.0 * seconds); ++k) {
        add_pair(one, two, late_s - taken);
        for (int i = 0; i < 5; ++i) {
            TEST_ASSERT_TRUE(jcal_lag_step(&lag) >= JCAL_OK);
        }
        taken += (double)jcal_lag_take(&lag);
    }
    return taken;
}

/* [U B] of a tick in double precision, row by row. */
static void rows_of(const jcal_tick_t *tick, double f[3][4])
{
    const float u[3] = {tick->velocity.x, tick->velocity.y, tick->velocity.z};
    for (int i = 0; i < 3; ++i) {
        f[i][0] = (double)u[i];
        for (int k = 0; k < 3; ++k) {
            f[i][k + 1] = (double)tick->lever[3 * i + k];
        }
    }
}

enum { TICKS = 60, TERMS = 24 }; /* of ticks 13, 15 ... 59 */

static double f1[TICKS][3][4];
static double f2[TICKS][3][4];

static double dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* What element (i, k) of each sum of a node must be, and how large what was added. */
typedef struct {
    double own2, up, re, im, size;
} element_t;

static element_t element_of(int node, int i, int k)
{
    element_t out = {0.0, 0.0, 0.0, 0.0, 0.0};
    for (int t = SIDE; t < TICKS - SIDE; t += 2) {
        const int late = t + node - SIDE;
        const double a[3] = {f1[t][0][i], f1[t][1][i], f1[t][2][i]};
        const double b[3] = {f2[late][0][k], f2[late][1][k], f2[late][2][k]};
        const double c[3] = {f2[late][0][i], f2[late][1][i], f2[late][2][i]};
        out.own2 += dot3(c, b);
        out.up += a[2] * b[2];
        out.re += a[0] * b[0] + a[1] * b[1];
        out.im += a[0] * b[1] - a[1] * b[0];
        out.size += dot3(a, a) + dot3(b, b) + dot3(c, c);
    }
    return out;
}

static void node_is_right(int node)
{
    const jcal_lag_node_t *const found = &lag.sums.node[node];
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
            const element_t e = element_of(node, i, k);
            const double tolerance = SUM_TOL * e.size;
            if (k <= i) {
                TEST_ASSERT_DOUBLE_WITHIN(tolerance, e.own2, (double)found->own2[i * (i + 1) / 2 + k]);
            }
            TEST_ASSERT_DOUBLE_WITHIN(tolerance, e.up, (double)found->up[4 * i + k]);
            TEST_ASSERT_DOUBLE_WITHIN(tolerance, e.re, (double)found->across.re[4 * i + k]);
            TEST_ASSERT_DOUBLE_WITHIN(tolerance, e.im, (double)found->across.im[4 * i + k]);
        }
    }
}

static void own_sums_are_right(void)
{
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k <= i; ++k) {
            double sum = 0.0;
            double size = 0.0;
            for (int t = SIDE; t < TICKS - SIDE; t += 2) {
                for (int c = 0; c < 3; ++c) {
                    sum += f1[t][c][i] * f1[t][c][k];
                    size += f1[t][c][i] * f1[t][c][i] + f1[t][c][k] * f1[t][c][k];
                }
            }
            TEST_ASSERT_DOUBLE_WITHIN(SUM_TOL * size, sum, (double)lag.sums.own1[i * (i + 1) / 2 + k]);
        }
    }
}

/* Of every second tick: node k has F_1(t) beside F_2(t + lag), for the same t at all nodes. Work is done after each tick, or after none: the
 * halves of a term are the same. */
static void sums_are_those_of_double_precision(void)
{
    const hinge_t arm = arm_usual();
    for (int works = 0; works < 2; ++works) {
        setUp();
        for (uint32_t k = 1u; k <= TICKS; ++k) {
            const jcal_tick_t tick1 = warm_tick(&arm, 0.05 * k, 1, 0u);
            const jcal_tick_t tick2 = warm_tick(&arm, 0.05 * k, 2, 0u);
            rows_of(&tick1, f1[k - 1u]);
            rows_of(&tick2, f2[k - 1u]);
            add_pair(&arm, &arm, 0.0);
            if (works != 0) {
                TEST_ASSERT_TRUE(jcal_lag_step(&lag) >= JCAL_OK);
            }
        }
        TEST_ASSERT_EQUAL_FLOAT((float)TERMS, lag.sums.count);
        TEST_ASSERT_FALSE(jcal_lag_sums_finish(&lag)); /* the last tick is one of those between */
        for (int node = 0; node < N; ++node) {
            node_is_right(node);
        }
        own_sums_are_right();
    }
}

/* A search sees all nodes with the same terms: the second half of a term is done before the search goes on. */
static void a_search_waits_for_the_other_half(void)
{
    const hinge_t arm = arm_usual();
    for (int k = 0; k < 79; ++k) {
        add_pair(&arm, &arm, 0.0);
    }
    const uint8_t slice = lag.search.slice;
    TEST_ASSERT_TRUE(lag.half_done);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_step(&lag));
    TEST_ASSERT_FALSE(lag.half_done);
    TEST_ASSERT_EQUAL_UINT8(slice, lag.search.slice);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_step(&lag));
    TEST_ASSERT_EQUAL_UINT8(slice + 1u, lag.search.slice);
}

/* A gap comes between the halves: the term is whole all the same. */
static void a_gap_does_not_leave_half_a_term(void)
{
    const hinge_t arm = arm_usual();
    for (uint32_t k = 1u; k <= 59u; ++k) {
        const jcal_tick_t tick1 = warm_tick(&arm, 0.05 * k, 1, 0u);
        const jcal_tick_t tick2 = warm_tick(&arm, 0.05 * k, 2, 0u);
        rows_of(&tick1, f1[k - 1u]);
        rows_of(&tick2, f2[k - 1u]);
        add_pair(&arm, &arm, 0.0);
    }
    TEST_ASSERT_TRUE(lag.half_done);
    jcal_tick_t tick1 = warm_tick(&arm, 3.0, 1, 60u * TICK_US);
    jcal_tick_t tick2 = warm_tick(&arm, 3.0, 2, 60u * TICK_US);
    tick1.epoch = tick2.epoch = 2u;
    tick1.since_s = tick2.since_s = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_add(&lag, &tick1, &tick2));
    for (int node = 0; node < N; ++node) {
        node_is_right(node);
    }
}

static double some_polynomial(double x)
{
    return 1.0 + x - 0.5 * x * x + 0.02 * pow(x, 5.0) - 0.01 * pow(x, 6.0);
}

/* A polynomial of degree 6 in the lag is met between nodes: terms up to 5000 of float32, and weights up to 100. */
static void between_nodes_is_a_polynomial(void)
{
    static jcal_lag_sums_t sums;
    memset(&sums, 0, sizeof sums);
    for (int node = 0; node < N; ++node) {
        const double x = node - SIDE;
        sums.node[node].up[5] = (float)some_polynomial(x);
        sums.node[node].own2[9] = (float)x;
        sums.node[node].across.im[15] = 2.0f;
    }
    for (int k = -26; k <= 26; ++k) { /* a parabola's points may be a quarter outside */
        const double x = 0.25 * k;
        jcal_lever_sums_t at;
        jcal_lag_sums_at(&sums, (float)x, &at);
        TEST_ASSERT_DOUBLE_WITHIN(2e-5 * (1.0 + fabs(some_polynomial(x))), some_polynomial(x), (double)at.up[5]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-5, x, (double)at.own2[9]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-5, 2.0, (double)at.block[0].im[15]);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, at.block[1].re[0]);
    }
}

/* Of a wave of 3 Hz, the fastest that features have, the polynomial through the nearest seven misses at most 2 % in the middle and
 * 15 % at the ends: prod (x - node) / 7! of its seventh derivative. */
static void the_nearest_nodes_tell_of_what_is_between(void)
{
    static jcal_lag_sums_t sums;
    const double by_node = 6.283185307179586 * 3.0 * 0.05;
    memset(&sums, 0, sizeof sums);
    for (int node = 0; node < N; ++node) {
        sums.node[node].up[0] = (float)sin(by_node * (node - SIDE) + 0.4);
    }
    for (int k = -24; k <= 24; ++k) {
        const double x = 0.25 * k;
        const int first = (int)fmin(fmax(floor(x + 0.5) + SIDE - 3.0, 0.0), 6.0);
        double most = pow(by_node, 7.0) / 5040.0;
        for (int node = first; node < first + 7; ++node) {
            most *= fabs(x - (node - SIDE));
        }
        jcal_lever_sums_t at;
        jcal_lag_sums_at(&sums, (float)x, &at);
        TEST_ASSERT_DOUBLE_WITHIN(most + 1e-5, sin(by_node * x + 0.4), (double)at.up[0]);
    }
}

static void lags_of_both_signs_are_found_and_taken_off(void)
{
    static const double late[] = {0.0, 0.0123, -0.037, 0.09, -0.14, 0.2, -0.244};
    const hinge_t arm = arm_usual();
    for (size_t k = 0u; k < sizeof late / sizeof late[0]; ++k) {
        setUp();
        const double taken = run(&arm, &arm, late[k], 20.0);
        const jcal_lag_result_t out = result();
        TEST_ASSERT_TRUE(out.lag_known);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, taken, (double)out.taken_s);
        TEST_ASSERT_DOUBLE_WITHIN(0.001, late[k], (double)out.lag_s); /* no noise: what is left is the polynomial's */
        TEST_ASSERT_TRUE(out.bound_s >= 0.002f);
        TEST_ASSERT_TRUE(out.bound_s <= 0.010f);
        TEST_ASSERT_TRUE(fabs(late[k] - taken) <= 0.010);
    }
}

static void mounts_and_levers_do_not_matter(void)
{
    int known = 0;
    for (int number = 0; number < 6; ++number) {
        const hinge_t arm = some_arm(number);
        setUp();
        (void)run(&arm, &arm, 0.08, 30.0);
        const jcal_lag_result_t out = result();
        TEST_ASSERT_TRUE(!out.lag_known || (fabsf(out.lag_s - 0.08f) <= out.bound_s));
        known += out.lag_known ? 1 : 0;
    }
    TEST_ASSERT_TRUE(known >= 5);
}

/* The sensors of two arms that move otherwise share no joint. */
static void sensors_of_two_joints_have_no_lag(void)
{
    for (int number = 0; number < 8; ++number) {
        const hinge_t one = some_arm(number);
        const hinge_t two = some_arm(number + 20);
        setUp();
        for (int k = 0; k < 800; ++k) {
            add_pair(&one, &two, 3.0);
            for (int i = 0; i < 5; ++i) {
                (void)jcal_lag_step(&lag);
            }
            (void)jcal_lag_take(&lag);
            TEST_ASSERT_FALSE(result().lag_known);
        }
        TEST_ASSERT_EQUAL_FLOAT(JCAL_LAG_UNKNOWN_S, result().bound_s);
    }
}

static void nothing_is_known_without_motion(void)
{
    hinge_t arm = arm_usual();
    arm.rest_s = 1e6;
    (void)run(&arm, &arm, 0.05, 20.0);
    TEST_ASSERT_FALSE(result().lag_known);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, result().lag_s);
}

/* Products of features of before and after a gap would be of no time. */
static void a_gap_empties_what_is_kept_but_not_the_sums(void)
{
    const hinge_t arm = arm_usual();
    for (int k = 0; k < 40; ++k) {
        add_pair(&arm, &arm, 0.0);
    }
    const float count = lag.sums.count;
    (void)jcal_lag_sums_finish(&lag);
    for (int k = 0; k < N - 1; ++k) {
        jcal_tick_t tick1 = warm_tick(&arm, 0.05 * next, 1, (uint64_t)next * TICK_US);
        jcal_tick_t tick2 = warm_tick(&arm, 0.05 * next, 2, (uint64_t)next * TICK_US);
        tick1.epoch = tick2.epoch = 2u;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_add(&lag, &tick1, &tick2));
        TEST_ASSERT_EQUAL_FLOAT(count, lag.sums.count);
        ++next;
    }
}

/* For two seconds after the first reading and three after a gap: of the sensor that has run for less. */
static void filters_must_be_warm(void)
{
    const hinge_t arm = arm_usual();
    for (uint32_t epoch = 1u; epoch <= 2u; ++epoch) {
        const uint32_t cold = (epoch == 1u) ? 39u : 59u; /* ticks of less than that */
        setUp();
        for (uint32_t k = 1u; k <= cold + N; ++k) {
            TEST_ASSERT_EQUAL_FLOAT(0.0f, lag.sums.count);
            TEST_ASSERT_TRUE((k <= cold + 1u) == (lag.sums.motion_s == 0.0f));
            jcal_tick_t tick1 = warm_tick(&arm, 0.05 * k, 1, (uint64_t)k * TICK_US);
            jcal_tick_t tick2 = warm_tick(&arm, 0.05 * k, 2, (uint64_t)k * TICK_US);
            jcal_tick_t *const colder = (k % 2u == 0u) ? &tick1 : &tick2;
            colder->since_s = 0.05f * (float)k + 1e-4f;
            tick1.epoch = tick2.epoch = epoch;
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_add(&lag, &tick1, &tick2));
        }
        TEST_ASSERT_EQUAL_FLOAT(1.0f, lag.sums.count);
    }
}

/* What was kept before a tick that is left out is of another time than what comes after it. */
static void a_cold_tick_empties_what_is_kept(void)
{
    const hinge_t arm = arm_usual();
    for (int k = 0; k < 40; ++k) {
        add_pair(&arm, &arm, 0.0);
    }
    const float count = lag.sums.count;
    jcal_tick_t tick1 = warm_tick(&arm, 0.05 * next, 1, (uint64_t)next * TICK_US);
    const jcal_tick_t tick2 = warm_tick(&arm, 0.05 * next, 2, (uint64_t)next * TICK_US);
    tick1.since_s = 0.5f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_add(&lag, &tick1, &tick2));
    ++next;
    for (int k = 0; k < N - 1; ++k) {
        add_pair(&arm, &arm, 0.0);
        TEST_ASSERT_EQUAL_FLOAT(count, lag.sums.count);
    }
    add_pair(&arm, &arm, 0.0);
    TEST_ASSERT_EQUAL_FLOAT(count + 1.0f, lag.sums.count);
}

static void old_motion_fades(void)
{
    const hinge_t arm = arm_usual();
    bool has_faded = false;
    float before = 0.0f;
    for (int k = 0; k < 1600; ++k) {
        add_pair(&arm, &arm, 0.0);
        has_faded = has_faded || (lag.sums.motion_s < before);
        TEST_ASSERT_TRUE(lag.sums.motion_s < 30.2f);
        TEST_ASSERT_TRUE(!has_faded || (lag.sums.motion_s > 14.9f)); /* half of it stays */
        before = lag.sums.motion_s;
    }
    TEST_ASSERT_TRUE(has_faded);
}

static void wrong_calls_are_refused(void)
{
    const hinge_t arm = arm_usual();
    static jcal_lag_t zeros;
    jcal_lag_result_t out;
    const jcal_tick_t tick1 = warm_tick(&arm, 1.0, 1, 1000u);
    jcal_tick_t tick2 = warm_tick(&arm, 1.0, 2, 1000u);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_init(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_add(NULL, &tick1, &tick2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_add(&lag, NULL, &tick2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_add(&lag, &tick1, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_add(&zeros, &tick1, &tick2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_step(&zeros));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_get(NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_get(&lag, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_lag_get(&zeros, &out));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_lag_take(NULL));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_lag_due(NULL));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_lag_due(&lag));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_lag_take(&lag));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_lag_step(&lag));
    tick2.t_us = 1001u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_lag_add(&lag, &tick1, &tick2));
    tick2.t_us = 1000u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_add(&lag, &tick1, &tick2));
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_lag_add(&lag, &tick1, &tick2));
}

/* In slices and one after the other it is the same. */
static void a_judgement_begins_anew_each_time(void)
{
    const hinge_t arm = arm_usual();
    for (int k = 0; k < 200; ++k) {
        add_pair(&arm, &arm, 0.03);
    }
    (void)jcal_lag_sums_finish(&lag);
    judge_once();
    const jcal_lag_verdict_t first = lag.verdict;
    judge_once();
    TEST_ASSERT_EQUAL_FLOAT(first.lag_s, lag.verdict.lag_s);
    TEST_ASSERT_EQUAL_FLOAT(first.share, lag.verdict.share);
    TEST_ASSERT_EQUAL_FLOAT(first.bound_s, lag.verdict.bound_s);
    TEST_ASSERT_FLOAT_WITHIN(0.004f, 0.03f, first.lag_s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(sums_are_those_of_double_precision);
    RUN_TEST(a_search_waits_for_the_other_half);
    RUN_TEST(a_gap_does_not_leave_half_a_term);
    RUN_TEST(between_nodes_is_a_polynomial);
    RUN_TEST(the_nearest_nodes_tell_of_what_is_between);
    RUN_TEST(lags_of_both_signs_are_found_and_taken_off);
    RUN_TEST(mounts_and_levers_do_not_matter);
    RUN_TEST(sensors_of_two_joints_have_no_lag);
    RUN_TEST(nothing_is_known_without_motion);
    RUN_TEST(a_gap_empties_what_is_kept_but_not_the_sums);
    RUN_TEST(filters_must_be_warm);
    RUN_TEST(a_cold_tick_empties_what_is_kept);
    RUN_TEST(old_motion_fades);
    RUN_TEST(wrong_calls_are_refused);
    RUN_TEST(a_judgement_begins_anew_each_time);
    return UNITY_END();
}
