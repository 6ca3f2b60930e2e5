/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/pairing.h: pairs at common times from readings of any times.
#include "jointcal/pairing.h"

#include "unit/ball/fixture.h"

#include <math.h>
#include <string.h>

enum { PERIOD_US = 10000, PAIRS_MAX = 4000 };

static jcal_pairing_t pairing;
static jcal_pair_t pairs[PAIRS_MAX];
static int count;

void setUp(void)
{
    const jcal_pairing_config_t config = jcal_pairing_config_default();
    count = 0;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_init(&pairing, &config));
}

void tearDown(void)
{
}

/* Straight lines: what is interpolated is exact but for rounding. Numbers differ between sensors and components. */
static double line(unsigned which, int component, double t)
{
    return (which == 1u ? 0.5 : -0.7) * (component + 1) + (which == 1u ? 0.3 : -0.4) * (component - 2.2) * t;
}

static jcal_reading_t on_line(unsigned which, uint64_t t_us)
{
    const double t = 1e-6 * (double)t_us;
    float v[6];
    for (int i = 0; i < 6; ++i) {
        v[i] = (float)line(which, i, t);
    }
    const jcal_reading_t out = {t_us, {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}};
    return out;
}

static void pull_all(void)
{
    jcal_pair_t pair;
    while (jcal_pairing_pull(&pairing, &pair) == JCAL_OK) {
        TEST_ASSERT_TRUE(count < PAIRS_MAX);
        pairs[count] = pair;
        ++count;
    }
}

static void push(unsigned which, uint64_t t_us)
{
    const jcal_reading_t reading = on_line(which, t_us);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, which, &reading));
    pull_all();
}

static void imu_is_on_line(const jcal_imu_t *imu, unsigned which, uint64_t t_us)
{
    const float found[6] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z,
                            imu->acc_m_s2.x,  imu->acc_m_s2.y,  imu->acc_m_s2.z};
    for (int i = 0; i < 6; ++i) {
        const double expected = line(which, i, 1e-6 * (double)t_us);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * (fabs(expected) + 3.0), expected, (double)found[i]);
    }
}

static void all_pairs_are_on_lines(void)
{
    for (int k = 0; k < count; ++k) {
        TEST_ASSERT_TRUE((pairs[k].t_us % PERIOD_US) == 0u);
        TEST_ASSERT_TRUE((k == 0) || (pairs[k].t_us > pairs[k - 1].t_us));
        imu_is_on_line(&pairs[k].imu1, 1u, pairs[k].t_us);
        imu_is_on_line(&pairs[k].imu2, 2u, pairs[k].t_us);
    }
}

static jcal_pairing_result_t result(void)
{
    jcal_pairing_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_get(&pairing, &out));
    return out;
}

/* No jump but those that are expected. */
static int jumps(void)
{
    int out = 0;
    for (int k = 1; k < count; ++k) {
        out += (pairs[k].t_us - pairs[k - 1].t_us != PERIOD_US) ? 1 : 0;
    }
    return out;
}

/* A time stamp between 0 and jitter_us late; another one for each k. */
static uint64_t jittered(uint64_t t_us, uint64_t jitter_us, int k)
{
    return t_us + (uint64_t)((double)jitter_us * (0.5 + 0.5 * any(k)));
}

/* Readings in the order of their times, sensor 2 arriving `behind_us` later. */
static void stream(uint64_t step1_us, uint64_t step2_us, uint64_t jitter_us, uint64_t behind_us, uint64_t until_us)
{
    uint64_t k1 = 0u;
    uint64_t k2 = 0u;
    while (k1 * step1_us < until_us) {
        if (k1 * step1_us <= k2 * step2_us + behind_us) {
            push(1u, jittered(1000u + k1 * step1_us, jitter_us, (int)k1));
            ++k1;
        } else {
            push(2u, jittered(1700u + k2 * step2_us, jitter_us, (int)k2 + 100000));
            ++k2;
        }
    }
}

static void readings_at_common_times_stay_what_they_are(void)
{
    for (uint64_t k = 1u; k < 200u; ++k) {
        jcal_reading_t reading = on_line(1u, k * PERIOD_US);
        reading.imu.gyr_rad_s.x = (float)any((int)k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 1u, &reading));
        pull_all();
        reading.imu.gyr_rad_s.x = (float)any((int)k + 1000);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 2u, &reading));
        pull_all();
    }
    TEST_ASSERT_EQUAL_INT(198, count); /* a stretch needs two readings */
    for (int k = 0; k < count; ++k) {
        TEST_ASSERT_TRUE(pairs[k].t_us == ((uint64_t)(k + 2) * PERIOD_US));
        TEST_ASSERT_EQUAL_FLOAT((float)any(k + 2), pairs[k].imu1.gyr_rad_s.x);
        TEST_ASSERT_EQUAL_FLOAT((float)any(k + 1002), pairs[k].imu2.gyr_rad_s.x);
    }
    const jcal_pairing_result_t out = result();
    TEST_ASSERT_EQUAL_UINT32(198u, out.pairs);
    TEST_ASSERT_EQUAL_UINT32(0u, out.lost1 + out.lost2 + out.rejected);
}

static void rates_may_differ_and_times_jitter(void)
{
    static const uint64_t steps[][2] = {
        {2500u, 40000u}, {40000u, 2500u}, {10000u, 10000u}, {7813u, 19230u}, {5000u, 16667u}};
    for (size_t k = 0u; k < sizeof steps / sizeof steps[0]; ++k) {
        for (uint64_t jitter = 0u; jitter <= 2400u; jitter += 2400u) {
            setUp();
            stream(steps[k][0], steps[k][1], jitter, 0u, 5000000u);
            TEST_ASSERT_TRUE(count > 485);
            TEST_ASSERT_EQUAL_INT(0, jumps());
            all_pairs_are_on_lines();
            TEST_ASSERT_TRUE(result().lost1 + result().lost2 <= 6u); /* before the other one began */
        }
    }
}

static void a_sensor_may_come_a_quarter_of_a_second_later(void)
{
    stream(10000u, 20000u, 1000u, 250000u, 5000000u);
    TEST_ASSERT_TRUE(count > 460);
    TEST_ASSERT_EQUAL_INT(0, jumps());
    all_pairs_are_on_lines();
    TEST_ASSERT_EQUAL_UINT(1u, result().ahead);
    TEST_ASSERT_TRUE(result().waiting >= 20u);
}

/* Then the oldest is lost, and no pair is wrong. */
static void what_waits_too_long_is_lost(void)
{
    stream(10000u, 10000u, 0u, 400000u, 3000000u);
    all_pairs_are_on_lines();
    TEST_ASSERT_TRUE(result().lost1 > 200u);
    TEST_ASSERT_TRUE(result().waiting <= JCAL_PAIRING_WAITING);
}

/* 100 ms are filled, more is not. */
static void long_gaps_are_not_filled(void)
{
    static const uint64_t gaps_us[] = {30000u, 100000u, 110000u, 1000000u};
    for (size_t k = 0u; k < sizeof gaps_us / sizeof gaps_us[0]; ++k) {
        setUp();
        for (uint64_t t = 0u; t < 3000000u; t += 5000u) {
            const bool is_in_gap = (t > 1002000u) && (t < 1002000u + gaps_us[k] - 2000u);
            push(1u, 1000000u + t);
            if (!is_in_gap) {
                push(2u, 1000000u + t + 2000u);
            }
        }
        all_pairs_are_on_lines();
        TEST_ASSERT_EQUAL_INT((gaps_us[k] > 100000u) ? 1 : 0, jumps());
        for (int i = 1; i < count; ++i) {
            TEST_ASSERT_TRUE(pairs[i].t_us - pairs[i - 1].t_us <= gaps_us[k] + PERIOD_US);
        }
    }
}

static void sensors_that_begin_late_or_end_are_no_harm(void)
{
    for (uint64_t t = 0u; t < 2000000u; t += 5000u) {
        push(1u, t);
    }
    TEST_ASSERT_EQUAL_INT(0, count);
    TEST_ASSERT_EQUAL_UINT32(399u / 2u - JCAL_PAIRING_WAITING, result().lost1);
    for (uint64_t t = 2000000u; t < 3000000u; t += 5000u) {
        push(1u, t);
        push(2u, t);
    }
    TEST_ASSERT_TRUE(count >= 98);
    all_pairs_are_on_lines();
    const int before = count;
    for (uint64_t t = 3000000u; t < 4000000u; t += 5000u) {
        push(2u, t);
    }
    TEST_ASSERT_EQUAL_INT(before, count);
    TEST_ASSERT_EQUAL_UINT(2u, result().ahead);
}

static void one_wild_time_costs_no_more_than_a_moment(void)
{
    for (uint64_t t = 0u; t < 1000000u; t += 10000u) {
        push(1u, 1000000u + t);
        push(2u, 1000000u + t);
        if (t == 500000u) {
            push(2u, 20000000u);
        }
    }
    all_pairs_are_on_lines();
    TEST_ASSERT_TRUE(count >= 96);
    TEST_ASSERT_TRUE(pairs[count - 1].t_us == 1990000u);
}

/* 0.4 s are not believed; then pairs go on at the new times. */
static void a_clock_that_begins_anew_is_followed(void)
{
    for (uint64_t t = 0u; t < 1000000u; t += 10000u) {
        push(1u, 50000000u + t);
        push(2u, 50000000u + t);
    }
    const int before = count;
    TEST_ASSERT_EQUAL_INT(99, before);
    for (uint64_t t = 0u; t < 1000000u; t += 10000u) {
        for (unsigned which = 1u; which <= 2u; ++which) {
            const jcal_reading_t reading = on_line(which, t);
            (void)jcal_pairing_push(&pairing, which, &reading);
            pull_all();
        }
    }
    TEST_ASSERT_TRUE(count - before >= 55);
    TEST_ASSERT_TRUE(pairs[count - 1].t_us == 990000u);
    for (int k = before; k < count; ++k) {
        imu_is_on_line(&pairs[k].imu1, 1u, pairs[k].t_us);
        imu_is_on_line(&pairs[k].imu2, 2u, pairs[k].t_us);
    }
}

static void what_is_not_pulled_is_lost_and_counted(void)
{
    for (uint64_t t = 0u; t < 1000000u; t += 10000u) {
        const jcal_reading_t one = on_line(1u, t);
        const jcal_reading_t two = on_line(2u, t);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 1u, &one));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 2u, &two));
    }
    pull_all();
    TEST_ASSERT_EQUAL_INT(1, count);
    TEST_ASSERT_EQUAL_UINT32(98u, result().lost1);
    TEST_ASSERT_EQUAL_UINT32(98u, result().lost2);
    all_pairs_are_on_lines();
}

/* Sensor 2's times are late: what it says at t happened at t - lag. Pairs stop for 0.3 s and go on with the right ones. */
static void a_lag_that_is_taken_off_makes_a_hole(void)
{
    static const double lags[] = {0.12, -0.2, 0.0034};
    for (size_t k = 0u; k < sizeof lags / sizeof lags[0]; ++k) {
        setUp();
        const int64_t late_us = (int64_t)llround(1e6 * lags[k]);
        for (uint64_t t = 1000000u; t < 3000000u; t += 10000u) {
            if (t == 2000000u) {
                TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, (float)lags[k]));
                count = 0;
            }
            push(1u, t);
            jcal_reading_t reading = on_line(2u, t);
            reading.t_us = (uint64_t)((int64_t)t + late_us);
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 2u, &reading));
            pull_all();
        }
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)lags[k], result().shift_s);
        TEST_ASSERT_TRUE(count > 60);
        TEST_ASSERT_TRUE(pairs[0].t_us >= 2000000u - 210000u + JCAL_PAIRING_HOLE_US);
        TEST_ASSERT_EQUAL_INT(0, jumps());
        all_pairs_are_on_lines();
    }
}

/* Sensor 1 comes 0.2 s later, so that sensor 2's readings wait, and a gap of sensor 2 does not spoil those. */
static void a_gap_of_the_sensor_that_is_ahead_keeps_what_waits(void)
{
    for (uint64_t t = 1000000u; t <= 3200000u; t += 10000u) {
        const bool is_in_gap = (t > 2000000u) && (t < 2150000u);
        if ((t <= 3000000u) && !is_in_gap) {
            push(2u, t);
        }
        if (t >= 1200000u) {
            push(1u, t - 200000u);
        }
    }
    TEST_ASSERT_EQUAL_INT(1, jumps());
    TEST_ASSERT_EQUAL_INT(200 - 15, count); /* 1.01 to 3 s, but for 2.01 to 2.15 s */
    TEST_ASSERT_EQUAL_UINT32(15u, result().lost1);
    TEST_ASSERT_EQUAL_UINT32(0u, result().lost2);
    all_pairs_are_on_lines();
}

/* The first pairs after a lag was taken off are 0.3 s later also where readings are missing just then. */
static void a_gap_after_a_lag_was_taken_off_leaves_the_hole(void)
{
    for (uint64_t t = 1000000u; t < 3000000u; t += 10000u) {
        if (t == 2000000u) {
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, 0.25f));
        }
        push(1u, t);
        const bool is_in_gap = (t >= 2000000u) && (t < 2150000u);
        jcal_reading_t reading = on_line(2u, t);
        reading.t_us += (t < 2000000u) ? 0u : 250000u;
        TEST_ASSERT_TRUE(is_in_gap || (jcal_pairing_push(&pairing, 2u, &reading) == JCAL_OK));
        pull_all();
    }
    TEST_ASSERT_EQUAL_INT(1, jumps());
    TEST_ASSERT_TRUE(pairs[98].t_us == 1990000u);
    TEST_ASSERT_TRUE(pairs[99].t_us == (1990000u + JCAL_PAIRING_HOLE_US + 2u * PERIOD_US));
    all_pairs_are_on_lines();
}

/* At 2^64 us times begin at 0 again: pairs go on, and a hole that was asked for just before does not last for ever. */
static void time_may_end(void)
{
    const uint64_t begin_us = UINT64_MAX - 1000000u;
    for (uint64_t t = 0u; t < 3000000u; t += 10000u) {
        if (t == 900000u) {
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, 0.02f));
        }
        for (unsigned which = 1u; which <= 2u; ++which) {
            jcal_reading_t reading = on_line(which, t);
            reading.t_us = begin_us + t;
            const jcal_status_t status = jcal_pairing_push(&pairing, which, &reading);
            TEST_ASSERT_TRUE((status == JCAL_OK) || ((which == 2u) && (reading.t_us < 20000u)));
            pull_all();
        }
    }
    const size_t told = 89u + 194u; /* 0.89 s, and from 0.03 to 1.96 s of the new time */
    TEST_ASSERT_EQUAL_INT((int)told, count);
    TEST_ASSERT_EQUAL_INT(1, jumps());
    for (int k = 0; k < count; ++k) {
        TEST_ASSERT_TRUE((pairs[k].t_us % PERIOD_US) == 0u);
    }
    TEST_ASSERT_TRUE(pairs[0].t_us > begin_us);
    TEST_ASSERT_TRUE(pairs[told - 1u].t_us > 1900000u);
}

/* The stretch of a slow sensor begins before the first reading that waits. */
static void a_sensor_that_began_later_is_met_where_it_began(void)
{
    for (uint64_t t = 1035000u; t <= 1105000u; t += 10000u) {
        push(2u, t);
    }
    push(1u, 1000000u);
    push(1u, 1080000u);
    TEST_ASSERT_EQUAL_INT(5, count); /* 1.04 to 1.08 s */
    TEST_ASSERT_TRUE(pairs[0].t_us == 1040000u);
    TEST_ASSERT_EQUAL_UINT32(3u, result().lost1);
    TEST_ASSERT_EQUAL_UINT(2u, result().waiting);
    all_pairs_are_on_lines();
}

static void lags_that_are_taken_off_add_up(void)
{
    for (uint64_t t = 1000000u; t <= 1100000u; t += 10000u) {
        push(1u, t);
    }
    TEST_ASSERT_EQUAL_UINT(10u, result().waiting);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, 0.1f));
    TEST_ASSERT_EQUAL_UINT(0u, result().waiting);
    TEST_ASSERT_EQUAL_UINT32(10u, result().lost1); /* those that waited */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, 0.15f));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.25f, result().shift_s);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_shift(&pairing, 0.06f));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, -0.55f));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.3f, result().shift_s);
}

/* Before the first pair there is no hole to cover a stretch from the old times to the new ones. */
static void no_stretch_goes_over_a_shift(void)
{
    push(2u, 1000000u);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_shift(&pairing, -0.03f));
    for (uint64_t t = 980000u; t <= 1200000u; t += 10000u) {
        jcal_reading_t reading = on_line(2u, t + 60000u);
        reading.t_us = t + 30000u;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 2u, &reading));
        push(1u, t);
    }
    TEST_ASSERT_TRUE(pairs[0].t_us == 1050000u); /* 1.04 s is the first of the new times */
    all_pairs_are_on_lines();
}

/* Every common time that a sensor told of is a pair, waits, or is lost, whatever was pulled. */
static void every_common_time_is_counted(void)
{
    for (int k = 0; k < 400; ++k) {
        const uint64_t t = 1000000u + (uint64_t)k * PERIOD_US;
        const jcal_reading_t one = on_line(1u, t);
        const jcal_reading_t two = on_line(2u, t);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 1u, &one));
        if (k % 3 == 0) {
            pull_all();
        }
        if ((k % 40) < 28) { /* gaps of 0.13 s */
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 2u, &two));
        }
    }
    pull_all();
    const jcal_pairing_result_t out = result();
    TEST_ASSERT_EQUAL_UINT32((uint32_t)count, out.pairs);
    TEST_ASSERT_EQUAL_UINT32(399u, out.pairs + out.lost1 + ((out.ahead == 1u) ? out.waiting : 0u));
    TEST_ASSERT_EQUAL_UINT32(27u * 10u, out.pairs + out.lost2 + ((out.ahead == 2u) ? out.waiting : 0u));
}

static void wrong_calls_are_refused(void)
{
    static jcal_pairing_t zeros;
    jcal_pairing_config_t config = jcal_pairing_config_default();
    jcal_lag_t lag;
    jcal_pair_t pair;
    jcal_pairing_result_t out;
    jcal_reading_t reading = on_line(1u, 5000u);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_init(&lag));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_init(&pairing, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_push(NULL, 1u, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_push(&pairing, 1u, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_push(&pairing, 0u, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_push(&pairing, 3u, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_push(&zeros, 1u, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_pull(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_pull(&pairing, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_pull(&zeros, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_get(NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_get(&pairing, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_get(&zeros, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_shift(NULL, 0.1f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_shift(&zeros, 0.1f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_shift(&pairing, 0.31f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_shift(&pairing, -0.31f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_shift(&pairing, NAN));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_align(NULL, &lag));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_align(&pairing, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_pairing_align(&zeros, &lag));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_pairing_align(&pairing, &lag));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_pairing_pull(&pairing, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_pairing_push(&pairing, 1u, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_pairing_push(&pairing, 1u, &reading));
    reading.t_us += 1000u;
    reading.imu.acc_m_s2.y = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_pairing_push(&pairing, 1u, &reading));
    TEST_ASSERT_EQUAL_UINT32(2u, result().rejected);
}

static void settings_are_checked(void)
{
    const jcal_pairing_config_t usual = jcal_pairing_config_default();
    TEST_ASSERT_NULL(jcal_pairing_config_check(&usual));
    TEST_ASSERT_EQUAL_STRING("config", jcal_pairing_config_check(NULL));
    jcal_pairing_config_t config = usual;
    config.period_s = 0.003f;
    TEST_ASSERT_EQUAL_STRING("period_s", jcal_pairing_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_pairing_init(&pairing, &config));
    config = usual;
    config.gap_s = NAN;
    TEST_ASSERT_EQUAL_STRING("gap_s", jcal_pairing_config_check(&config));
    config.gap_s = 0.2f;
    TEST_ASSERT_EQUAL_STRING("gap_s", jcal_pairing_config_check(&config));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(readings_at_common_times_stay_what_they_are);
    RUN_TEST(rates_may_differ_and_times_jitter);
    RUN_TEST(a_sensor_may_come_a_quarter_of_a_second_later);
    RUN_TEST(what_waits_too_long_is_lost);
    RUN_TEST(long_gaps_are_not_filled);
    RUN_TEST(sensors_that_begin_late_or_end_are_no_harm);
    RUN_TEST(one_wild_time_costs_no_more_than_a_moment);
    RUN_TEST(a_clock_that_begins_anew_is_followed);
    RUN_TEST(what_is_not_pulled_is_lost_and_counted);
    RUN_TEST(a_lag_that_is_taken_off_makes_a_hole);
    RUN_TEST(a_gap_of_the_sensor_that_is_ahead_keeps_what_waits);
    RUN_TEST(a_gap_after_a_lag_was_taken_off_leaves_the_hole);
    RUN_TEST(time_may_end);
    RUN_TEST(a_sensor_that_began_later_is_met_where_it_began);
    RUN_TEST(lags_that_are_taken_off_add_up);
    RUN_TEST(no_stretch_goes_over_a_shift);
    RUN_TEST(every_common_time_is_counted);
    RUN_TEST(wrong_calls_are_refused);
    RUN_TEST(settings_are_checked);
    return UNITY_END();
}
