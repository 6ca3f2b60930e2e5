/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/body.h: common times, sensors that are late, lost or stand still, clocks that begin anew, and what is counted.
#include "unit/body/fixture.h"

enum { SENSORS = 3, KINDS = 9 };

static body_fixture_t f;
static uint64_t origin_us;
static unsigned told[KINDS];
static jcal_body_event_t last[KINDS];

void setUp(void)
{
    origin_us = 5000000u;
    memset(told, 0, sizeof told);
    body_fill(&f, SENSORS);
    body_begin(&f);
}

void tearDown(void)
{
}

/* Readings of a sensor that is moved about; no two are the same. */
static void values_at(unsigned sensor, uint32_t k, float values[6])
{
    for (unsigned i = 0u; i < 3u; ++i) {
        values[i] = (float)(sin(0.03 * k + i) + 1e-3 * sin(7.0 * k + sensor));
        values[i + 3u] = (float)(((i == 2u) ? 9.81 : 0.0) + 0.3 * sin(0.05 * k + sensor + i));
    }
}

static uint64_t hub_time(uint32_t k)
{
    return origin_us + (uint64_t)k * BODY_PERIOD_US;
}

static void send(unsigned sensor, uint32_t k, uint32_t arrives_k)
{
    float values[6];
    values_at(sensor, k, values);
    body_send(&f, sensor, hub_time(arrives_k), values);
}

static void work(uint32_t k)
{
    jcal_body_event_t event;
    (void)body_work(&f, hub_time(k));
    while (jcal_body_event(&f.body, &event) == JCAL_OK) {
        TEST_ASSERT_TRUE(event.kind < KINDS);
        told[event.kind] += 1u;
        last[event.kind] = event;
    }
}

/* All sensors but `without` send from k to `end`. */
static void play(uint32_t k, uint32_t end, unsigned without)
{
    for (; k < end; ++k) {
        for (unsigned s = 0u; s < SENSORS; ++s) {
            if (s != without) {
                send(s, k, k);
            }
        }
        work(k);
    }
}

static void everything_is_counted(void)
{
    const jcal_body_status_t status = body_status(&f);
    for (unsigned s = 0u; s < SENSORS; ++s) {
        const jcal_body_sensor_result_t sensor = body_sensor(&f, s);
        TEST_ASSERT_EQUAL_UINT32(status.rounds, sensor.samples + sensor.missed);
        TEST_ASSERT_EQUAL_UINT32(0u, sensor.packets.waiting);
    }
}

static void all_sensors_tell_of_the_same_times(void)
{
    play(0u, 300u, SENSORS);
    everything_is_counted();
    for (unsigned s = 0u; s < SENSORS; ++s) {
        const jcal_body_sensor_result_t sensor = body_sensor(&f, s);
        TEST_ASSERT_EQUAL_UINT32(0u, sensor.late + sensor.rejected);
        TEST_ASSERT_TRUE(sensor.missed <= 5u); /* until the first time at which ticks fall on those of others */
        TEST_ASSERT_TRUE(sensor.is_heard);
        TEST_ASSERT_TRUE((body_sensor(&f, 0u).t_us) == (sensor.t_us));
        TEST_ASSERT_TRUE((sensor.t_us + BODY_PERIOD_US) >= hub_time(299u));
        TEST_ASSERT_TRUE(sensor.t_us <= hub_time(299u));
    }
    TEST_ASSERT_EQUAL_UINT(SENSORS, told[JCAL_BODY_SENSOR_BACK]);
    TEST_ASSERT_EQUAL_UINT32(0u, body_joint(&f, 0u).head.samples); /* filters settle for five seconds */
    play(300u, 490u, SENSORS);
    TEST_ASSERT_EQUAL_UINT32(0u, body_joint(&f, 0u).head.samples);
    play(490u, 700u, SENSORS);
    TEST_ASSERT_UINT32_WITHIN(2u, 38u, body_joint(&f, 0u).head.samples); /* pairs of ticks, 20 a second */
    TEST_ASSERT_TRUE(body_joint(&f, 1u).head.t_us >= hub_time(690u));
    TEST_ASSERT_TRUE(body_joint(&f, 1u).head.t_us <= hub_time(699u));
}

/* Packets that wait for 250 ms at the radio: rounds wait, and nothing is missed. */
static void a_burst_within_the_time_that_is_waited_loses_nothing(void)
{
    play(0u, 200u, SENSORS);
    const uint32_t missed = body_sensor(&f, 2u).missed;
    const uint32_t rounds = body_status(&f).rounds;
    play(200u, 225u, 2u);
    TEST_ASSERT_TRUE(body_status(&f).rounds <= rounds + 1u);
    for (uint32_t k = 200u; k < 225u; ++k) {
        send(2u, k, 225u);
    }
    play(225u, 300u, SENSORS);
    everything_is_counted();
    for (unsigned s = 0u; s < SENSORS; ++s) {
        TEST_ASSERT_EQUAL_UINT32(missed, body_sensor(&f, s).missed);
        TEST_ASSERT_EQUAL_UINT32(0u, body_sensor(&f, s).late);
    }
}

/* 500 ms are too long: others go on without it, and what comes then is late. */
static void a_burst_beyond_that_is_missed_and_counted(void)
{
    play(0u, 700u, SENSORS);
    const uint32_t missed = body_sensor(&f, 2u).missed;
    play(700u, 750u, 2u);
    for (uint32_t k = 700u; k < 750u; ++k) {
        send(2u, k, 750u);
    }
    play(750u, 850u, SENSORS);
    everything_is_counted();
    TEST_ASSERT_EQUAL_UINT32(missed, body_sensor(&f, 0u).missed);
    TEST_ASSERT_EQUAL_UINT32(missed, body_sensor(&f, 1u).missed);
    const jcal_body_sensor_result_t of = body_sensor(&f, 2u);
    TEST_ASSERT_TRUE((of.missed - missed) >= 15u); /* at least the 180 ms that were not waited for, and its hole */
    TEST_ASSERT_TRUE((of.missed - missed) <= 50u);
    TEST_ASSERT_TRUE(of.late >= 14u);
    TEST_ASSERT_TRUE(of.late <= 20u);
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_SENSOR_LOST]);
    TEST_ASSERT_EQUAL_UINT32(2u, jcal_sensor_tick(&f.sensor_states[2].stage)->epoch);
    TEST_ASSERT_EQUAL_UINT32(1u, jcal_sensor_tick(&f.sensor_states[1].stage)->epoch);
    TEST_ASSERT_TRUE(jcal_sensor_tick(&f.sensor_states[1].stage)->t_us ==
                     jcal_sensor_tick(&f.sensor_states[2].stage)->t_us);
    /* The filters of sensor 2 have seen less of the past: its joint leaves out its ticks for five seconds. */
    const uint32_t before0 = body_joint(&f, 0u).head.samples;
    const uint32_t before1 = body_joint(&f, 1u).head.samples;
    TEST_ASSERT_TRUE(before0 > before1);
    play(850u, 1000u, SENSORS);
    TEST_ASSERT_EQUAL_UINT32(before1, body_joint(&f, 1u).head.samples);
    TEST_ASSERT_EQUAL_UINT32(before0 + 30u, body_joint(&f, 0u).head.samples);
    play(1000u, 1200u, SENSORS);
    TEST_ASSERT_EQUAL_UINT32(before1, body_joint(&f, 1u).head.samples);
    play(1200u, 1350u, SENSORS);
    TEST_ASSERT_UINT32_WITHIN(6u, before1 + 20u, body_joint(&f, 1u).head.samples);
}

static void a_lost_sensor_is_told_once_and_comes_back(void)
{
    play(0u, 200u, SENSORS);
    play(200u, 700u, 1u);
    everything_is_counted();
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_SENSOR_LOST]);
    TEST_ASSERT_EQUAL_UINT8(1u, last[JCAL_BODY_SENSOR_LOST].sensor);
    TEST_ASSERT_EQUAL_UINT8(JCAL_BODY_NONE, last[JCAL_BODY_SENSOR_LOST].joint);
    TEST_ASSERT_FALSE(body_sensor(&f, 1u).is_heard);
    /* who is lost is not waited for any more */
    TEST_ASSERT_TRUE((body_sensor(&f, 0u).t_us + BODY_PERIOD_US) >= hub_time(699u));
    const uint32_t before = body_joint(&f, 0u).head.samples;
    f.counter[1] += 500u;
    play(700u, 1300u, SENSORS);
    everything_is_counted();
    TEST_ASSERT_EQUAL_UINT(SENSORS + 1u, told[JCAL_BODY_SENSOR_BACK]);
    TEST_ASSERT_EQUAL_UINT8(1u, last[JCAL_BODY_SENSOR_BACK].sensor);
    TEST_ASSERT_TRUE(body_joint(&f, 0u).head.samples >= before + 10u);
}

/* Nobody sends: time stands, and goes on where it is when they are back. */
static void when_all_are_lost_time_waits(void)
{
    play(0u, 200u, SENSORS);
    for (uint32_t k = 200u; k < 1000u; ++k) {
        work(k);
    }
    TEST_ASSERT_EQUAL_UINT(SENSORS, told[JCAL_BODY_SENSOR_LOST]);
    const uint32_t rounds = body_status(&f).rounds;
    for (unsigned s = 0u; s < SENSORS; ++s) {
        f.counter[s] += 800u;
    }
    play(1000u, 1100u, SENSORS);
    everything_is_counted();
    TEST_ASSERT_TRUE(body_status(&f).rounds >= rounds + 90u);
    TEST_ASSERT_TRUE(body_status(&f).rounds <= rounds + 130u);
    TEST_ASSERT_TRUE((body_sensor(&f, 0u).t_us + BODY_PERIOD_US) >= hub_time(1099u));
}

/* The hub's clock begins anew, as one of 32 bits does: joints go on, with times of the new clock. */
static void a_clock_that_begins_anew_loses_a_stretch_of_time(void)
{
    origin_us = 4294000000u;
    play(0u, 700u, SENSORS);
    const uint32_t before = body_joint(&f, 0u).head.samples;
    TEST_ASSERT_TRUE(before >= 30u);
    origin_us -= 4294000000u - 1000u;
    play(700u, 1400u, SENSORS);
    everything_is_counted();
    TEST_ASSERT_EQUAL_UINT32(1u, body_status(&f).restarts);
    TEST_ASSERT_TRUE(body_joint(&f, 0u).head.samples >= before + 30u);
    TEST_ASSERT_TRUE(body_joint(&f, 0u).head.t_us <= hub_time(1399u));
    TEST_ASSERT_TRUE(body_joint(&f, 0u).head.t_us >= hub_time(1380u));
    TEST_ASSERT_TRUE((body_sensor(&f, 1u).t_us + BODY_PERIOD_US) >= hub_time(1399u));
}

/* A sensor that is switched off and on counts from 0: what it sent stays counted, and its joint goes on; others do not notice. */
static void a_counter_that_begins_anew_loses_a_stretch_of_time(void)
{
    play(0u, 700u, SENSORS);
    const uint32_t before = body_joint(&f, 0u).head.samples;
    const uint32_t missed0 = body_sensor(&f, 0u).missed;
    const uint32_t missed1 = body_sensor(&f, 1u).missed;
    f.counter[1] = 0u;
    play(700u, 1500u, SENSORS);
    TEST_ASSERT_EQUAL_UINT32(missed0, body_sensor(&f, 0u).missed);
    TEST_ASSERT_TRUE(body_sensor(&f, 1u).missed <= (missed1 + 100u));
    TEST_ASSERT_TRUE(body_joint(&f, 0u).head.samples >= before + 30u);
    TEST_ASSERT_TRUE((body_sensor(&f, 1u).t_us + BODY_PERIOD_US) >= hub_time(1499u));
}

/* Shifting all times changes no bit. */
static void results_do_not_depend_on_the_origin_of_time(void)
{
    static jcal_functional_t before[SENSORS];
    play(0u, 700u, SENSORS);
    memcpy(before, f.hinges, sizeof before);
    body_fill(&f, SENSORS);
    body_begin(&f);
    origin_us = 0x123456789abcdu;
    play(0u, 700u, SENSORS);
    TEST_ASSERT_EQUAL_MEMORY(before, f.hinges, sizeof before);
}

static void readings_that_cannot_be_are_counted(void)
{
    play(0u, 100u, SENSORS);
    float values[6] = {0.0f, NAN, 0.0f, 0.0f, 0.0f, 9.81f};
    body_send(&f, 0u, hub_time(100u), values);
    values[1] = 2.0f * JCAL_SENSOR_GYR_MAX_RAD_S;
    body_send(&f, 0u, hub_time(101u), values);
    work(101u);
    TEST_ASSERT_EQUAL_UINT32(2u, body_sensor(&f, 0u).rejected);
    /* a radio whose clock is 2 s ahead of the one that steps are told */
    body_begin(&f);
    work(0u);
    send(0u, 0u, 200u);
    work(0u);
    TEST_ASSERT_EQUAL_UINT32(1u, body_sensor(&f, 0u).rejected);
    TEST_ASSERT_FALSE(body_sensor(&f, 0u).is_heard);
}

/* A sensor whose readings stand still is bad, and fine when they do not. */
static void a_sensor_that_stands_still_is_named(void)
{
    float values[6];
    play(0u, 100u, SENSORS);
    values_at(1u, 100u, values);
    for (uint32_t k = 100u; k < 200u; ++k) {
        send(0u, k, k);
        body_send(&f, 1u, hub_time(k), values);
        send(2u, k, k);
        work(k);
        if (k == 149u) {
            TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_SENSOR_BAD]);
        }
    }
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_SENSOR_BAD]);
    TEST_ASSERT_EQUAL_UINT8(1u, last[JCAL_BODY_SENSOR_BAD].sensor);
    TEST_ASSERT_EQUAL_UINT8(JCAL_FINDING_FROZEN, last[JCAL_BODY_SENSOR_BAD].what);
    TEST_ASSERT_EQUAL_HEX16(1u << (unsigned)JCAL_FINDING_FROZEN, body_sensor(&f, 1u).bad);
    for (unsigned j = 0u; j < 2u; ++j) {
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_SENSOR_BAD, body_joint(&f, j).head.reason);
    }
    jcal_body_advice_t advice;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_advice(&f.body, &advice));
    TEST_ASSERT_EQUAL_UINT8(1u, advice.sensor);
    play(200u, 210u, SENSORS);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_SENSOR_FINE]);
    TEST_ASSERT_NOT_EQUAL_INT(JCAL_REASON_SENSOR_BAD, body_joint(&f, 1u).head.reason);
}

/* What the examiner names: sensor 0 is the first that is examined, and gravity is 12 m/s^2 to it. */
static void a_sensor_with_wrong_gravity_is_named_by_the_examiner(void)
{
    f.config.examine_s = 5.0f;
    body_begin(&f);
    for (uint32_t k = 0u; k < 960u; ++k) {
        for (unsigned s = 0u; s < SENSORS; ++s) {
            float values[6];
            values_at(s, k, values);
            for (unsigned i = 0u; i < 3u; ++i) { /* at rest */
                values[i] *= 1e-3f;
                values[i + 3u] = (1e-2f * values[i]) + ((i == 2u) ? ((s == 0u) ? 12.0f : 9.81f) : 0.0f);
            }
            body_send(&f, s, hub_time(k), values);
        }
        work(k);
    }
    TEST_ASSERT_EQUAL_UINT8(1u, f.body.exam.sensor); /* five seconds each */
    TEST_ASSERT_TRUE(told[JCAL_BODY_SENSOR_BAD] > 0u);
    TEST_ASSERT_EQUAL_UINT8(0u, last[JCAL_BODY_SENSOR_BAD].sensor);
    TEST_ASSERT_TRUE((body_sensor(&f, 0u).bad & (1u << (unsigned)JCAL_FINDING_GRAVITY_OFF)) != 0u);
    TEST_ASSERT_EQUAL_HEX16(0u, body_sensor(&f, 1u).bad);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SENSOR_BAD, body_joint(&f, 0u).head.reason);
    TEST_ASSERT_NOT_EQUAL_INT(JCAL_REASON_SENSOR_BAD, body_joint(&f, 1u).head.reason);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(all_sensors_tell_of_the_same_times);
    RUN_TEST(a_burst_within_the_time_that_is_waited_loses_nothing);
    RUN_TEST(a_burst_beyond_that_is_missed_and_counted);
    RUN_TEST(a_lost_sensor_is_told_once_and_comes_back);
    RUN_TEST(when_all_are_lost_time_waits);
    RUN_TEST(a_clock_that_begins_anew_loses_a_stretch_of_time);
    RUN_TEST(a_counter_that_begins_anew_loses_a_stretch_of_time);
    RUN_TEST(results_do_not_depend_on_the_origin_of_time);
    RUN_TEST(readings_that_cannot_be_are_counted);
    RUN_TEST(a_sensor_that_stands_still_is_named);
    RUN_TEST(a_sensor_with_wrong_gravity_is_named_by_the_examiner);
    return UNITY_END();
}
