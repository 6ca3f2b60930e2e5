/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/packet.h: which reading is which. Wraps, loss, late, duplicate and odd packets, sensors that begin anew.
#include "unit/packet/radio.h"

#include "unity.h"

#include <math.h>

static jcal_packets_t packets;
static unsigned char storage[JCAL_PACKETS_STORAGE_BYTES(RADIO_PACKETS, 16, JCAL_PACKET_SI)];
static float values[96];
static jcal_packets_status_t status;
static uint64_t last_us;

void setUp(void)
{
    last_us = 0;
}

void tearDown(void)
{
}

static void start(const radio_t *radio)
{
    const jcal_packet_config_t config = radio_config(radio);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_init(&packets, &config, storage, sizeof storage));
}

static void push(const jcal_packet_t *packet)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_push(&packets, packet));
}

/* Pulls `count` readings, `first` and those after it; each packet that is dropped is one of `dropped`. */
static void pull(uint64_t first, unsigned count, unsigned dropped)
{
    jcal_reading_t reading;
    for (unsigned k = 0; k < count + dropped; ++k) {
        const jcal_status_t found = jcal_packets_pull(&packets, &reading);
        if (found == JCAL_REJECTED) {
            TEST_ASSERT_TRUE(dropped > 0);
            dropped--;
            k--;
            continue;
        }
        TEST_ASSERT_EQUAL_INT(JCAL_OK, found);
        float expected[6];
        radio_values(first, expected);
        TEST_ASSERT_EQUAL_MEMORY(expected, &reading.imu, sizeof expected);
        TEST_ASSERT_TRUE(reading.t_us > last_us);
        last_us = reading.t_us;
        first++;
    }
    TEST_ASSERT_EQUAL_UINT(0, dropped);
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_packets_pull(&packets, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_get(&packets, &status));
}

/* The next packet comes and is pulled. */
static void next(radio_t *radio)
{
    const uint64_t first = radio->sent;
    const jcal_packet_t packet = radio_next(radio, values);
    push(&packet);
    pull(first, radio->count, 0);
}

static void run(radio_t *radio, double seconds)
{
    const double until_s = radio_time(radio, radio->sent) + seconds;
    while (radio_time(radio, radio->sent) < until_s) {
        next(radio);
    }
}

/* That reading has its true time, but for a constant delay and `limit_s`. */
static void assert_time(const radio_t *radio, uint64_t reading, double limit_s)
{
    const double found_s = 1e-6 * (double)(last_us - radio->hub0_us);
    TEST_ASSERT_TRUE(fabs(found_s - radio_time(radio, reading) - radio->delay_s) < limit_s);
}

static void assert_counts(uint32_t lost, uint32_t late, uint32_t duplicate, uint32_t odd, uint32_t restarts)
{
    TEST_ASSERT_EQUAL_UINT32(lost, status.lost);
    TEST_ASSERT_EQUAL_UINT32(late, status.late);
    TEST_ASSERT_EQUAL_UINT32(duplicate, status.duplicate);
    TEST_ASSERT_EQUAL_UINT32(odd, status.odd);
    TEST_ASSERT_EQUAL_UINT32(restarts, status.restarts);
}

static void counters_of_8_16_and_32_bits_wrap(void)
{
    for (unsigned bits = 8; bits <= 32; bits += 4) {
        setUp();
        radio_t radio = radio_begin();
        radio.bits = bits;
        radio.count = 7;
        radio.counter0 = (uint32_t)0u - 100u; /* soon all bits are ones, and then zeros */
        start(&radio);
        run(&radio, 30.0);
        assert_counts(0, 0, 0, 0, 0);
        TEST_ASSERT_EQUAL_UINT32(radio.sent, status.readings);
        assert_time(&radio, radio.sent - 1u, 0.01);
    }
}

static void bits_beyond_those_of_the_counter_are_ignored(void)
{
    radio_t radio = radio_begin();
    radio.bits = 11;
    start(&radio);
    for (unsigned k = 0; k < 3000; ++k) {
        jcal_packet_t packet = radio_next(&radio, values);
        packet.counter |= 0xABCD0000u << (k % 5u);
        push(&packet);
        pull(k, 1, 0);
    }
    assert_counts(0, 0, 0, 0, 0);
}

/* Losses are gaps in time as long as what was lost, be they longer than a round of the counter. */
static void losses_are_counted_and_are_gaps_in_time(void)
{
    static const unsigned lost[] = {1, 2, 50, 127, 128, 255, 256, 257, 1000, 6000};
    for (unsigned bits = 8; bits <= 32; bits += 8) {
        setUp();
        radio_t radio = radio_begin();
        radio.bits = bits;
        start(&radio);
        uint32_t sum = 0;
        for (size_t k = 0; k < sizeof lost / sizeof lost[0]; ++k) {
            run(&radio, 20.0);
            const uint64_t before_us = last_us;
            radio.sent += lost[k];
            next(&radio);
            sum += lost[k];
            TEST_ASSERT_EQUAL_UINT32(sum, status.lost);
            const double gap_s = 1e-6 * (double)(last_us - before_us);
            TEST_ASSERT_TRUE(fabs(gap_s - 0.01 * (lost[k] + 1.0)) < 1e-3 + 1e-3 * gap_s);
        }
        assert_counts(sum, 0, 0, 0, 0);
    }
}

static void packets_that_come_after_later_ones_are_late(void)
{
    radio_t radio = radio_begin();
    radio.count = 4;
    start(&radio);
    run(&radio, 5.0);
    const uint64_t first = radio.sent;
    float held[96];
    const jcal_packet_t late = radio_next(&radio, held);
    next(&radio);
    TEST_ASSERT_EQUAL_UINT32(4, status.lost);
    push(&late);
    pull(0, 0, 1);
    assert_counts(4, 4, 0, 0, 0);
    push(&late); /* by now it has come */
    pull(0, 0, 1);
    assert_counts(4, 4, 4, 0, 0);
    run(&radio, 1.0);
    assert_counts(4, 4, 4, 0, 0);
    TEST_ASSERT_EQUAL_UINT32(radio.sent - 4u, status.readings);
    TEST_ASSERT_TRUE(first + 4u < radio.sent);
}

static void packets_that_come_twice_are_dropped(void)
{
    radio_t radio = radio_begin();
    radio.bits = 8;
    start(&radio);
    for (unsigned k = 0; k < 600; ++k) {
        const jcal_packet_t packet = radio_next(&radio, values);
        push(&packet);
        push(&packet);
        pull(k, 1, 1);
    }
    assert_counts(0, 0, 600, 0, 0);
}

/* Sensors that send each reading again in the packets that follow: nothing is lost where a packet is. */
static void packets_may_overlap(void)
{
    radio_t radio = radio_begin();
    radio.count = 4;
    start(&radio);
    uint64_t next_reading = 0;
    for (uint64_t first = 0; first < 400; first += 2) {
        if (first % 6u == 4u) {
            continue; /* lost, but for what others repeat */
        }
        const jcal_packet_t packet = radio_packet(&radio, first, radio.hub0_us + 10000u * (first + 3u), values);
        push(&packet);
        pull(next_reading, (unsigned)(first + 4u - next_reading), 0);
        next_reading = first + 4u;
    }
    assert_counts(0, 0, status.duplicate, 0, 0);
    TEST_ASSERT_EQUAL_UINT32(next_reading, status.readings);
    TEST_ASSERT_TRUE(status.duplicate > 100);
}

/* An outage of the radio: the sensor keeps its packets and sends all of them when it is over. */
static void bursts_have_the_times_at_which_they_were_measured(void)
{
    radio_t radio = radio_begin();
    radio.count = 2;
    radio.drift_ppm = 200.0;
    start(&radio);
    run(&radio, 60.0);
    const uint64_t first = radio.sent;
    const uint64_t arrival_us = radio.hub0_us + (uint64_t)(1e6 * (radio_time(&radio, first + 120u) + 0.02));
    for (unsigned k = 0; k < 60; ++k) {
        const jcal_packet_t packet = radio_packet(&radio, first + 2u * k, arrival_us + 100u * k, values);
        push(&packet);
    }
    radio.sent += 120u;
    pull(first, 120, 0);
    assert_counts(0, 0, 0, 0, 0);
    assert_time(&radio, radio.sent - 1u, 2e-3);
    run(&radio, 5.0);
    assert_time(&radio, radio.sent - 1u, 2e-3);
    TEST_ASSERT_EQUAL_UINT32(0, status.steps);
}

static void one_packet_that_fits_nothing_costs_that_packet(void)
{
    radio_t radio = radio_begin();
    start(&radio);
    run(&radio, 10.0);
    for (unsigned k = 0; k < 5; ++k) {
        jcal_packet_t packet = radio_next(&radio, values);
        packet.counter += 30000u;
        push(&packet);
        pull(0, 0, 1);
        next(&radio);
        TEST_ASSERT_EQUAL_UINT32(k + 1u, status.lost);
    }
    assert_counts(5, 0, 0, 5, 0);
    TEST_ASSERT_TRUE(fabsf(status.drift_ppm) < 20.0f);
}

/* Times that no clock is near to, with or without a counter that goes on: each costs its packet. */
static void wild_times_cost_their_packets(void)
{
    static const uint64_t away_us[] = {1000000000u, (uint64_t)1 << 44, (uint64_t)1 << 46, (uint64_t)1 << 62};
    radio_t radio = radio_begin();
    radio.hub0_us = (uint64_t)1 << 63;
    start(&radio);
    run(&radio, 10.0);
    for (unsigned k = 0; k < 8; ++k) {
        jcal_packet_t packet = radio_next(&radio, values);
        packet.arrival_us += (k < 4) ? away_us[k] : (0u - away_us[k - 4u]);
        packet.counter += (k % 2u) * 30000u;
        push(&packet);
        pull(0, 0, 1);
        packet.arrival_us += (k % 2u == 0u) ? 10000u : (0u - 10000u);
        packet.counter += (k < 6) ? 1u : (0u - 1u);
        push(&packet);
        pull(0, 0, 1);
        assert_counts(k, 0, 0, 2u * k + 2u, 0);
        next(&radio);
    }
    assert_counts(8, 0, 0, 16, 0);
    TEST_ASSERT_TRUE(fabsf(status.drift_ppm) < 20.0f);
}

static void an_odd_packet_that_is_repeated_is_no_other_sensor(void)
{
    radio_t radio = radio_begin();
    start(&radio);
    run(&radio, 10.0);
    jcal_packet_t packet = radio_next(&radio, values);
    packet.counter += 30000u;
    for (unsigned k = 0; k < 5; ++k) {
        push(&packet);
        pull(0, 0, 1);
        packet.arrival_us += 1000;
    }
    next(&radio);
    assert_counts(1, 0, 0, 5, 0);
}

/* Begun anew while packets of before were still coming: what it kept meanwhile was measured before the last of those. */
static void times_increase_though_a_sensor_begins_anew(void)
{
    radio_t radio = radio_begin();
    radio.count = 16;
    start(&radio);
    run(&radio, 20.0);
    const uint64_t arrival_us = radio.hub0_us + (uint64_t)(1e6 * radio.last_s) + 20000u;
    for (uint64_t first = 0; first < 48; first += 16) {
        jcal_packet_t packet = radio_packet(&radio, first, arrival_us + first, values);
        packet.counter += 40000u;
        push(&packet);
    }
    pull(32, 16, 2); /* times are compared in there */
    assert_counts(0, 0, 0, 32, 1);
}

/* The counter begins at 0 again, and the sensor's clock with it; three packets, and it is believed. */
static void a_sensor_that_begins_anew_is_followed_anew(void)
{
    for (unsigned bits = 16; bits <= 32; bits += 8) {
        setUp();
        radio_t radio = radio_begin();
        radio.bits = bits;
        radio.drift_ppm = -300.0;
        radio.counter0 = 5000;
        radio.count = 2;
        start(&radio);
        run(&radio, 130.0);
        radio.hub0_us += (uint64_t)(1e6 * (radio_time(&radio, radio.sent) + 1.3));
        radio.sent = 0;
        radio.last_s = 0.0;
        radio.counter0 = 0;
        for (unsigned k = 0; k < 2; ++k) {
            const jcal_packet_t packet = radio_next(&radio, values);
            push(&packet);
            pull(0, 0, 1);
        }
        next(&radio);
        assert_counts(0, 0, 0, 4, 1);
        TEST_ASSERT_TRUE(status.bound_ppm == 500.0f); /* a guess from before */
        TEST_ASSERT_TRUE(fabsf(status.drift_ppm + 300.0f) < 20.0f);
        run(&radio, 20.0);
        assert_counts(0, 0, 0, 4, 1);
        assert_time(&radio, radio.sent - 1u, 2e-3);
    }
}

/* Its first packets are counted late: with so short a counter nothing tells them from such. */
static void a_short_counter_that_begins_anew_is_followed_too(void)
{
    for (uint32_t jump = 5; jump < 256; jump += 10) {
        setUp();
        radio_t radio = radio_begin();
        radio.bits = 8;
        start(&radio);
        run(&radio, 30.0);
        radio.counter0 += jump;
        const uint64_t before_us = last_us;
        for (unsigned k = 0; k < 2000; ++k) {
            const jcal_packet_t packet = radio_next(&radio, values);
            push(&packet);
            jcal_reading_t reading;
            while (jcal_packets_pull(&packets, &reading) != JCAL_IDLE) {
                last_us = reading.t_us;
            }
        }
        TEST_ASSERT_TRUE(last_us > before_us);
        assert_time(&radio, radio.sent - 1u, 0.02);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_get(&packets, &status));
        const bool is_seen = (jump > 12) && (jump < 248); /* less is within what delays may do */
        TEST_ASSERT_EQUAL_UINT32(is_seen ? 1 : 0, status.steps + status.restarts);
    }
}

static void a_hub_whose_clock_goes_back_goes_on_from_there(void)
{
    radio_t radio = radio_begin();
    radio.hub0_us = (uint64_t)UINT32_MAX;
    start(&radio);
    run(&radio, 10.0);
    radio.hub0_us = 1000000;
    for (unsigned k = 0; k < 2; ++k) {
        const jcal_packet_t packet = radio_next(&radio, values);
        push(&packet);
        pull(0, 0, 1);
    }
    last_us = 0;
    next(&radio);
    assert_counts(0, 0, 0, 2, 1);
    run(&radio, 10.0);
    assert_counts(0, 0, 0, 2, 1);
    assert_time(&radio, radio.sent - 1u, 5e-3);
}

/* A reading a second: each is a block of its own. */
static void a_sensor_may_be_slow(void)
{
    radio_t radio = radio_begin();
    radio.period_s = 1.0;
    radio.drift_ppm = 250.0;
    start(&radio);
    run(&radio, 400.0);
    assert_counts(0, 0, 0, 0, 0);
    TEST_ASSERT_EQUAL_UINT32(0, status.steps);
    assert_time(&radio, radio.sent - 1u, 0.02);
}

/* Any origin of time, the end of 64 bits too. */
static void time_may_begin_anywhere(void)
{
    radio_t radio = radio_begin();
    start(&radio);
    run(&radio, 20.0);
    const uint64_t way_us = last_us - radio.hub0_us;
    radio_t late = radio_begin();
    late.hub0_us = UINT64_MAX - 5000000u;
    start(&late);
    for (unsigned k = 0; k < 2000; ++k) {
        const jcal_packet_t packet = radio_next(&late, values);
        push(&packet);
        jcal_reading_t reading;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
        last_us = reading.t_us;
    }
    TEST_ASSERT_TRUE(last_us - late.hub0_us == way_us);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(counters_of_8_16_and_32_bits_wrap);
    RUN_TEST(bits_beyond_those_of_the_counter_are_ignored);
    RUN_TEST(losses_are_counted_and_are_gaps_in_time);
    RUN_TEST(packets_that_come_after_later_ones_are_late);
    RUN_TEST(packets_that_come_twice_are_dropped);
    RUN_TEST(packets_may_overlap);
    RUN_TEST(bursts_have_the_times_at_which_they_were_measured);
    RUN_TEST(one_packet_that_fits_nothing_costs_that_packet);
    RUN_TEST(wild_times_cost_their_packets);
    RUN_TEST(an_odd_packet_that_is_repeated_is_no_other_sensor);
    RUN_TEST(times_increase_though_a_sensor_begins_anew);
    RUN_TEST(a_sensor_that_begins_anew_is_followed_anew);
    RUN_TEST(a_short_counter_that_begins_anew_is_followed_too);
    RUN_TEST(a_hub_whose_clock_goes_back_goes_on_from_there);
    RUN_TEST(a_sensor_may_be_slow);
    RUN_TEST(time_may_begin_anywhere);
    return UNITY_END();
}
