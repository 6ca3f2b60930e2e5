/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of what jointcal/lag.h says of a search: which findings are believed, when a lag is known, and what is taken off.
#include "jointcal/lag.h"
#include "jointcal/pairing.h"
#include "pairing/lag_search.h"

#include <math.h>
#include <string.h>
#include <unity.h>

/* What a search found. */
typedef struct {
    double lag_s, share, rival, bend, motion_s, speed2;
} finding_t;

static const finding_t usual = {0.010, 0.02, 0.2, 1.0, 8.0, 0.01};

/* Terms of the sums: any number. */
static const double COUNT = 100.0;

static jcal_lag_t lag;

void setUp(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_init(&lag));
    lag.node_s = 0.05f;
}

void tearDown(void)
{
}

/* The last slice of a search that found this. It is the third lag of a parabola, at which empty sums leave nothing, so that the
 * middle goes by 2 before / bend nodes from where it is put here. */
static void judge(const finding_t *found)
{
    jcal_lag_search_t *const search = &lag.search;
    const double before = 2.0 * found->share + found->bend / 16.0;
    const double by = fmin(2.0 * before / found->bend, 0.5);
    const double own = 2.0 * found->speed2 * COUNT;
    lag.sums.count = (float)COUNT;
    lag.sums.motion_s = (float)found->motion_s;
    search->best.lag = (float)(found->lag_s / (double)lag.node_s - by);
    search->best.own = (float)own;
    search->best.lack = (float)(found->share * own);
    search->before = (float)before;
    search->point = search->best;
    for (int k = 0; k < JCAL_LAG_NODES; ++k) {
        search->least[k] = (float)found->rival;
    }
    search->slice = (uint8_t)(JCAL_LAG_SEARCH_SLICES - 1u);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_step(&lag));
    if (lag.sums.motion_s > 0.0f) { /* else all began anew */
        TEST_ASSERT_FLOAT_WITHIN(2e-6f, (float)found->lag_s, lag.verdict.lag_s);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * (float)found->bend, (float)found->bend, search->bend);
    }
}

static void judge_times(const finding_t *found, int times)
{
    for (int k = 0; k < times; ++k) {
        judge(found);
    }
}

static jcal_lag_result_t result(void)
{
    jcal_lag_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_get(&lag, &out));
    return out;
}

/* 2 ms and 1.1 standard deviations of three independent readings a second. */
static double bound_s(const finding_t *found)
{
    const double variance = 2.0 * (found->share + 0.002) / (found->bend * 3.0 * found->motion_s);
    return 0.002 + 1.1 * (double)lag.node_s * sqrt(variance);
}

static bool is_known_after(finding_t found, int times)
{
    setUp();
    judge_times(&found, times);
    return result().lag_known;
}

static void three_findings_make_a_lag(void)
{
    TEST_ASSERT_FALSE(is_known_after(usual, 2));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, result().lag_s);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_LAG_UNKNOWN_S, result().bound_s);
    TEST_ASSERT_TRUE(is_known_after(usual, 3));
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.010f, result().lag_s);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)bound_s(&usual), result().bound_s);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.02f, result().left);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.01f, lag.verdict.speed2);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 10.0f, lag.verdict.rival);
}

/* Each condition by itself, on both sides of its limit. */
static void what_speaks_against_a_finding(void)
{
    static const finding_t is[] = {
        {0.010, 0.049, 0.9, 4.0, 8.0, 0.01},    /* share that is left */
        {0.010, 0.02, 0.0505, 1.0, 8.0, 0.01},  /* what another lag leaves, 2.5 times as much */
        {0.010, 0.001, 0.0255, 1.0, 8.0, 0.01}, /* the same where hardly anything is left: of 1 % */
        {0.010, 0.02, 0.2, 1.0, 3.01, 0.01},    /* motion */
        {0.010, 0.02, 0.2, 1.0, 8.0, 0.00161},  /* speed of the centre */
        {0.010, 0.02, 0.2, 0.18, 8.0, 0.01}, /* bound: 1.1 x 0.05 s x sqrt(0.044 / (24 x 0.18)) and 2 ms are 7.6 ms */
        {0.249, 0.02, 0.2, 1.0, 8.0, 0.01},
    };
    static const finding_t is_not[] = {
        {0.010, 0.051, 0.9, 4.0, 8.0, 0.01},    {0.010, 0.02, 0.0495, 1.0, 8.0, 0.01},
        {0.010, 0.001, 0.0245, 1.0, 8.0, 0.01}, {0.010, 0.02, 0.2, 1.0, 2.99, 0.01},
        {0.010, 0.02, 0.2, 1.0, 8.0, 0.00159},  {0.010, 0.02, 0.2, 0.08, 8.0, 0.01}, /* 10.3 ms */
    };
    for (size_t k = 0u; k < sizeof is / sizeof is[0]; ++k) {
        TEST_ASSERT_TRUE(is_known_after(is[k], 3));
    }
    for (size_t k = 0u; k < sizeof is_not / sizeof is_not[0]; ++k) {
        TEST_ASSERT_FALSE(is_known_after(is_not[k], 6));
    }
}

/* 0.25 s and the bound, of all that was taken off. */
static void a_lag_has_a_range(void)
{
    finding_t found = usual;
    for (int sign = -1; sign <= 1; sign += 2) {
        setUp();
        lag.taken_s = 0.20f * (float)sign;
        found.lag_s = 0.053 * (double)sign; /* the bound is 4.4 ms */
        judge_times(&found, 3);
        TEST_ASSERT_TRUE(result().lag_known);
        TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.253f * (float)sign, result().lag_s);
        setUp();
        lag.taken_s = 0.20f * (float)sign;
        found.lag_s = 0.055 * (double)sign;
        judge_times(&found, 6);
        TEST_ASSERT_FALSE(result().lag_known);
        TEST_ASSERT_EQUAL_FLOAT(0.20f * (float)sign, result().lag_s);
    }
}

/* The bound is 4.4 ms. */
static void findings_must_agree(void)
{
    finding_t other = usual;
    other.lag_s = 0.015;
    for (int k = 0; k < 6; ++k) {
        judge((k % 2 == 0) ? &usual : &other);
        TEST_ASSERT_FALSE(result().lag_known);
    }
    judge(&other); /* as the last one */
    TEST_ASSERT_FALSE(result().lag_known);
    judge(&other);
    TEST_ASSERT_TRUE(result().lag_known);
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.015f, result().lag_s);
}

static void what_is_known_stays_until_something_speaks_against_it(void)
{
    finding_t other = usual;
    other.bend = 0.05; /* not sharp, 12 ms; but within the bounds */
    judge_times(&usual, 3);
    judge(&other);
    TEST_ASSERT_TRUE(result().lag_known);
    other.lag_s = 0.010 + 0.012;
    judge(&other);
    TEST_ASSERT_TRUE(result().lag_known);
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.010f, result().lag_s);
    other.lag_s = 0.010 + 0.020; /* beyond 12.2 and 4.4 ms */
    judge(&other);
    TEST_ASSERT_FALSE(result().lag_known);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, result().lag_s);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_LAG_UNKNOWN_S, result().bound_s);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, lag.sums.motion_s);
}

/* As long as nothing is known sums go on. */
static void what_does_not_fit_begins_nothing_anew_before(void)
{
    finding_t other = usual;
    other.share = 0.3;
    other.rival = 0.9;
    judge_times(&other, 4);
    TEST_ASSERT_EQUAL_FLOAT(8.0f, lag.sums.motion_s);
}

static bool is_known_after_another(finding_t other)
{
    setUp();
    judge_times(&usual, 3);
    judge(&other);
    TEST_ASSERT_TRUE((lag.sums.motion_s > 0.0f) == result().lag_known); /* what denies begins anew */
    return result().lag_known;
}

/* What speaks against a lag that is known is more than what keeps one from becoming known: a share of 10 %, and 6 s of motion. */
static void a_joint_that_is_none_denies_what_was_known(void)
{
    finding_t other = usual;
    other.rival = 0.9;
    other.share = 0.101;
    TEST_ASSERT_FALSE(is_known_after_another(other));
    other.share = 0.099;
    TEST_ASSERT_TRUE(is_known_after_another(other));
    other = usual;
    other.rival = 0.04;
    TEST_ASSERT_FALSE(is_known_after_another(other));
    other.motion_s = 6.01;
    TEST_ASSERT_FALSE(is_known_after_another(other));
    other.motion_s = 5.99;
    TEST_ASSERT_TRUE(is_known_after_another(other));
}

static void sums_that_began_anew_deny_nothing(void)
{
    const finding_t other = {0.1, 0.5, 0.6, 1.0, 5.9, 0.01};
    TEST_ASSERT_TRUE(is_known_after_another(other));
}

static void what_is_taken_off_adds_up(void)
{
    lag.taken_s = 0.1f;
    judge_times(&usual, 3);
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.11f, result().lag_s);
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.01f, jcal_lag_due(&lag));
    TEST_ASSERT_EQUAL_FLOAT(8.0f, lag.sums.motion_s);
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.01f, jcal_lag_take(&lag));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, lag.sums.motion_s);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_lag_take(&lag)); /* once */
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.11f, result().taken_s);
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.11f, result().lag_s);
    TEST_ASSERT_TRUE(result().lag_known);
}

/* A lag within its bound is none to be taken off. */
static void a_small_lag_stays(void)
{
    finding_t found = usual;
    found.lag_s = 0.003;
    judge_times(&found, 3);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_lag_take(&lag));
    TEST_ASSERT_TRUE(result().lag_known);
    TEST_ASSERT_EQUAL_FLOAT(8.0f, lag.sums.motion_s);
}

/* Between nodes a polynomial may leave more than there is. */
static void what_is_left_is_at_most_all(void)
{
    finding_t found = usual;
    found.share = 1.2;
    found.bend = 60.0;
    judge(&found);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, result().left);
}

static void a_pairing_takes_off_what_was_found(void)
{
    static jcal_pairing_t pairing;
    const jcal_pairing_config_t config = jcal_pairing_config_default();
    jcal_pairing_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_init(&pairing, &config));
    judge_times(&usual, 3);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_align(&pairing, &lag));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_get(&pairing, &out));
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.010f, out.shift_s);
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_pairing_align(&pairing, &lag));
}

/* 0.3 s in all are the most that a pairing takes off: what it refuses is not taken off. */
static void a_shift_that_is_refused_counts_as_left(void)
{
    static jcal_pairing_t pairing;
    const jcal_pairing_config_t config = jcal_pairing_config_default();
    jcal_pairing_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_init(&pairing, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, 0.295f)); /* by hand */
    judge_times(&usual, 3);
    for (int k = 0; k < 2; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_align(&pairing, &lag));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_get(&pairing, &out));
        TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.295f, out.shift_s);
        TEST_ASSERT_TRUE(result().lag_known);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, result().taken_s);
        TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.010f, result().lag_s);
        TEST_ASSERT_EQUAL_FLOAT(8.0f, lag.sums.motion_s);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, -0.1f)); /* now there is room */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_align(&pairing, &lag));
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 0.010f, result().taken_s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(three_findings_make_a_lag);
    RUN_TEST(what_speaks_against_a_finding);
    RUN_TEST(a_lag_has_a_range);
    RUN_TEST(findings_must_agree);
    RUN_TEST(what_is_known_stays_until_something_speaks_against_it);
    RUN_TEST(what_does_not_fit_begins_nothing_anew_before);
    RUN_TEST(a_joint_that_is_none_denies_what_was_known);
    RUN_TEST(sums_that_began_anew_deny_nothing);
    RUN_TEST(what_is_taken_off_adds_up);
    RUN_TEST(a_small_lag_stays);
    RUN_TEST(what_is_left_is_at_most_all);
    RUN_TEST(a_pairing_takes_off_what_was_found);
    RUN_TEST(a_shift_that_is_refused_counts_as_left);
    return UNITY_END();
}
