/* SPDX-License-Identifier: MIT */
/* The hub's core: bytes in, bytes out, however the two sides interleave. */
#include "hub.h"
#include "jointcal/jointcal.h"

#include <unity.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES 600u

static hub_t hub;
static jcal_hinge_auto_t alone; /* fed with the same samples in the plain way */

/* What has come from the hub. */
static struct {
    frame_decoder_t decoder;
    unsigned hellos, estimates, counters_seen, bad;
    uint32_t limit;
    message_hello_t hello;
    message_estimate_t estimate;
    message_counters_t counters;
} seen;

void setUp(void)
{
    hub_init(&hub);
    memset(&seen, 0, sizeof seen);
    const jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_init(&alone, &config));
}

void tearDown(void)
{
}

static void take(const frame_t *frame)
{
    if (frame->type == FRAME_HELLO) {
        TEST_ASSERT_TRUE(message_read_hello(frame, &seen.hello));
        seen.hellos++;
        seen.limit = 1u + seen.hello.credit; /* starts are number 0 here */
    } else if (frame->type == FRAME_ESTIMATE) {
        TEST_ASSERT_TRUE(message_read_estimate(frame, &seen.estimate));
        seen.estimates++;
    } else if (frame->type == FRAME_COUNTERS) {
        TEST_ASSERT_TRUE(message_read_counters(frame, &seen.counters));
        seen.counters_seen++;
    } else {
        TEST_ASSERT_EQUAL_UINT8(FRAME_CREDIT, frame->type);
        TEST_ASSERT_TRUE(message_read_number(frame, &seen.limit));
    }
}

static void listen(void)
{
    uint8_t byte = 0;
    frame_t frame;
    while (hub_send(&hub, &byte)) {
        const frame_event_t event = frame_decode(&seen.decoder, byte, &frame);
        seen.bad += (event == FRAME_BAD) ? 1u : 0u;
        if (event == FRAME_GOOD) {
            take(&frame);
        }
    }
}

static void work(void)
{
    do {
        listen();
    } while (hub_work(&hub));
    listen();
}

static void send(frame_type_t type, uint32_t sequence, const frame_writer_t *payload)
{
    uint8_t wire[FRAME_WIRE_MAX];
    const size_t size = frame_encode(wire, type, sequence, payload->bytes, payload->size);
    for (size_t k = 0; k < size; k++) {
        hub_receive(&hub, wire[k]);
    }
}

static void send_start(uint32_t nonce, uint64_t every_us, float max_bound_rad)
{
    const message_start_t start = {nonce, every_us, max_bound_rad, 0};
    frame_writer_t payload;
    message_write_start(&payload, &start);
    send(FRAME_START, 0, &payload);
}

static void send_number(frame_type_t type, uint32_t sequence, uint32_t number)
{
    frame_writer_t payload;
    message_write_number(&payload, number);
    send(type, sequence, &payload);
}

/* A segment that hangs from a tilting axis (its z) and turns about it. */
static jcal_imu_t segment(float tilt, float tilt_rate, float turn, float turn_rate)
{
    const float g = 9.81f, s = sinf(turn), c = cosf(turn);
    const jcal_imu_t imu = {{tilt_rate * c, -tilt_rate * s, turn_rate},
                            {g * sinf(tilt) * s, g * sinf(tilt) * c, g * cosf(tilt)}};
    return imu;
}

static jcal_pair_t sample(uint32_t k)
{
    const float t = 0.02f * (float)k, tilt = 1.0f + sinf(t), tilt_rate = cosf(t);
    const jcal_pair_t pair = {20000u * (uint64_t)k,
                              segment(tilt, tilt_rate, 0.4f * sinf(2.0f * t), 0.8f * cosf(2.0f * t)),
                              segment(tilt, tilt_rate, 0.9f * sinf(3.0f * t), 2.7f * cosf(3.0f * t))};
    return pair;
}

/* Frame number k + 1 is sample k. */
static void send_sample(uint32_t k)
{
    const jcal_pair_t pair = sample(k);
    frame_writer_t payload;
    message_write_sample(&payload, &pair);
    send(FRAME_SAMPLE, k + 1u, &payload);
}

static void update_alone(uint32_t k)
{
    const jcal_pair_t pair = sample(k);
    (void)jcal_hinge_auto_update(&alone, &pair);
}

static void same_result(void)
{
    jcal_hinge_auto_result_t all;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_get(&alone, &all));
    const jcal_hinge_result_t expected = all.hinge;
    const jcal_hinge_result_t *got = &seen.estimate.result.hinge;
    TEST_ASSERT_EQUAL_INT(all.model, seen.estimate.result.model);
    TEST_ASSERT_EQUAL_INT(all.ready_for, seen.estimate.result.ready_for);
    TEST_ASSERT_EQUAL_MEMORY(&all.flexion_uncertainty_rad, &seen.estimate.result.flexion_uncertainty_rad,
                             sizeof(float));
    TEST_ASSERT_EQUAL_MEMORY(&all.joint_to_sensor1_m, &seen.estimate.result.joint_to_sensor1_m, sizeof(jcal_vec3_t));
    TEST_ASSERT_EQUAL_UINT32(expected.head.samples, got->head.samples);
    TEST_ASSERT_EQUAL_UINT32(expected.head.rejected, got->head.rejected);
    TEST_ASSERT_EQUAL_INT(expected.head.status, got->head.status);
    TEST_ASSERT_EQUAL_MEMORY(&expected.axis1, &got->axis1, sizeof got->axis1);
    TEST_ASSERT_EQUAL_MEMORY(&expected.axis2, &got->axis2, sizeof got->axis2);
    TEST_ASSERT_EQUAL_MEMORY(&expected.uncertainty1_rad, &got->uncertainty1_rad, sizeof(float));
    TEST_ASSERT_EQUAL_MEMORY(&expected.sign_margin, &got->sign_margin, sizeof(float));
}

/* Sends all samples within the credit; `eager` of 1 works after each frame, of 0 only when credit is used up, else at random. */
static void play(int eager)
{
    send_start(1, 0, 0.0523599f);
    work();
    TEST_ASSERT_EQUAL_UINT(1, seen.hellos);
    TEST_ASSERT_FALSE(seen.hello.refused);
    srand(7);
    for (uint32_t k = 0; k < SAMPLES; k++) {
        while (k + 1u >= seen.limit) {
            TEST_ASSERT_TRUE(hub_work(&hub)); /* else the hub would be stuck */
            listen();
        }
        send_sample(k);
        update_alone(k);
        if (eager == 1 || (eager == 2 && rand() % 3 == 0)) {
            (void)hub_work(&hub);
            listen();
        }
    }
    send_number(FRAME_REQUEST, SAMPLES + 1u, 99);
    work();
    TEST_ASSERT_EQUAL_UINT32(99, seen.estimate.token);
    TEST_ASSERT_EQUAL_UINT32(99, seen.counters.token);
    same_result();
    TEST_ASSERT_EQUAL_INT(JCAL_READY, seen.estimate.result.hinge.head.status);
    TEST_ASSERT_EQUAL_UINT32(SAMPLES + 2u, seen.counters.link.received);
    TEST_ASSERT_EQUAL_UINT32(SAMPLES + 2u, seen.counters.link.taken);
    TEST_ASSERT_EQUAL_UINT32(SAMPLES, seen.counters.samples);
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.overrun);
    TEST_ASSERT_EQUAL_UINT(0, seen.bad);
}

static void the_same_result_with_a_fast_hub(void)
{
    play(1);
}

static void the_same_result_with_a_slow_hub(void)
{
    play(0);
}

static void the_same_result_with_an_irregular_hub(void)
{
    play(2);
}

static void nothing_is_said_or_counted_before_a_start(void)
{
    send_sample(0);
    send_number(FRAME_REQUEST, 1, 5);
    TEST_ASSERT_FALSE(hub_waiting(&hub));
    work();
    send_start(3, 0, 0.05f);
    work();
    send_number(FRAME_REQUEST, 1, 5);
    work();
    TEST_ASSERT_EQUAL_UINT(1, seen.estimates);
    TEST_ASSERT_EQUAL_UINT32(2, seen.counters.link.received);
    TEST_ASSERT_TRUE(MESSAGE_TIME_UNKNOWN == seen.estimate.now_us); /* Unity has no 64 bits on targets */
}

static void a_new_nonce_begins_anew_and_the_old_one_does_not(void)
{
    send_start(1, 0, 0.05f);
    work();
    send_sample(0);
    work();
    send_start(1, 0, 0.05f); /* repeated on the way */
    work();
    TEST_ASSERT_EQUAL_UINT(1, seen.hellos);
    send_number(FRAME_REQUEST, 2, 5);
    work();
    TEST_ASSERT_EQUAL_UINT32(1, seen.counters.samples);
    TEST_ASSERT_EQUAL_UINT32(1, seen.counters.link.repeated);
    send_start(2, 0, 0.05f);
    work();
    TEST_ASSERT_EQUAL_UINT(2, seen.hellos);
    send_number(FRAME_REQUEST, 1, 6);
    work();
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.samples);
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.link.repeated);
}

static void a_wrong_configuration_is_refused(void)
{
    send_start(1, 0, 1e9f);
    work();
    TEST_ASSERT_TRUE(seen.hello.refused);
    send_sample(0);
    send_number(FRAME_REQUEST, 2, 5);
    work();
    TEST_ASSERT_EQUAL_UINT(0, seen.estimates);
    send_start(2, 0, 0.05f);
    work();
    TEST_ASSERT_FALSE(seen.hello.refused);
}

static void a_sender_without_manners_is_counted(void)
{
    send_start(1, 0, 0.05f);
    for (uint32_t k = 0; k < 100u; k++) {
        send_sample(k);
    }
    work();
    send_number(FRAME_REQUEST, 101, 5);
    work();
    TEST_ASSERT_EQUAL_UINT32(102, seen.counters.link.taken);
    TEST_ASSERT_EQUAL_UINT32(HUB_QUEUE - 1u, seen.counters.samples); /* the start takes a place, too */
    TEST_ASSERT_EQUAL_UINT32(100u - (HUB_QUEUE - 1u), seen.counters.overrun);
}

static void lost_repeated_late_and_unknown_frames_are_counted(void)
{
    frame_writer_t nothing;
    frame_write_begin(&nothing);
    send_start(1, 0, 0.05f);
    work();
    send_sample(0);
    send_sample(0);
    send_sample(2);
    send_sample(1);
    send_sample(5);
    hub_receive(&hub, 3);
    hub_receive(&hub, 0);
    send((frame_type_t)0x55, 7, &nothing);
    send(FRAME_SAMPLE, 8, &nothing); /* too short */
    work();
    send_number(FRAME_REQUEST, 9, 5);
    work();
    const message_counters_t expected = {
        .token = 5,
        .link = {.received = 9, .taken = 7, .lost = 2, .repeated = 1, .corrupted = 1, .reordered = 1},
        .unknown = 2,
        .samples = 3};
    TEST_ASSERT_EQUAL_MEMORY(&expected.link, &seen.counters.link, sizeof expected.link);
    TEST_ASSERT_EQUAL_UINT32(expected.unknown, seen.counters.unknown);
    TEST_ASSERT_EQUAL_UINT32(expected.samples, seen.counters.samples);
}

static void a_sample_without_time_is_not_finite(void)
{
    jcal_pair_t pair = sample(1);
    pair.t_us = MESSAGE_TIME_UNKNOWN;
    frame_writer_t payload;
    send_start(1, 0, 0.05f);
    work();
    message_write_sample(&payload, &pair);
    send(FRAME_SAMPLE, 1, &payload);
    send_number(FRAME_REQUEST, 2, 5);
    work();
    TEST_ASSERT_EQUAL_UINT32(1, seen.counters.rejected_by[JCAL_REJECT_NOT_FINITE]);
}

static void estimates_come_by_sample_time(void)
{
    send_start(1, 1000000, 0.05f);
    work();
    for (uint32_t k = 0; k <= 200u; k++) { /* four seconds */
        send_sample(k);
        work();
        TEST_ASSERT_EQUAL_UINT(k / 50u, seen.counters_seen);
    }
    TEST_ASSERT_TRUE(4000000 == seen.estimate.now_us); /* Unity has no 64 bits on targets */
}

/* Nobody takes the answers: the hub waits, and loses none of them. */
static void answers_wait_for_room(void)
{
    send_start(1, 20000, 0.05f); /* an estimate for each sample */
    work();
    for (uint32_t k = 0; k < 20u; k++) {
        send_sample(k);
        (void)hub_work(&hub);
    }
    TEST_ASSERT_TRUE(hub_waiting(&hub));
    TEST_ASSERT_FALSE(hub_work(&hub));
    work();
    TEST_ASSERT_FALSE(hub_waiting(&hub));
    TEST_ASSERT_EQUAL_UINT(19, seen.counters_seen);
    TEST_ASSERT_EQUAL_UINT(0, seen.bad);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_same_result_with_a_fast_hub);
    RUN_TEST(the_same_result_with_a_slow_hub);
    RUN_TEST(the_same_result_with_an_irregular_hub);
    RUN_TEST(nothing_is_said_or_counted_before_a_start);
    RUN_TEST(a_new_nonce_begins_anew_and_the_old_one_does_not);
    RUN_TEST(a_wrong_configuration_is_refused);
    RUN_TEST(a_sender_without_manners_is_counted);
    RUN_TEST(lost_repeated_late_and_unknown_frames_are_counted);
    RUN_TEST(a_sample_without_time_is_not_finite);
    RUN_TEST(estimates_come_by_sample_time);
    RUN_TEST(answers_wait_for_room);
    return UNITY_END();
}
