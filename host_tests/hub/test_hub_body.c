/* SPDX-License-Identifier: MIT */
/* Body sessions of the hub: tables, packets, answers to every message, flash. */
#include "body_fixture.h"

#include <math.h>

void setUp(void)
{
    memset(flash_bytes, 0xFF, sizeof flash_bytes);
    power_on(true, false);
}

void tearDown(void)
{
}

/* Packet k of a sensor, four readings: it lies still and trembles. */
static void send_packet(unsigned sensor, uint32_t k, uint64_t arrival_us)
{
    message_packet_t packet = {.sensor = (uint8_t)sensor, .count = 4u, .arrival_us = arrival_us, .counter = 4u * k};
    frame_writer_t payload;
    for (unsigned i = 0; i < 4u * JCAL_PACKET_VALUES; i++) {
        packet.raw[i] = (int16_t)((7u * k + 3u * i + sensor) % 5u);
        packet.raw[i] = (int16_t)(packet.raw[i] + ((i % JCAL_PACKET_VALUES == 5u) ? 1962 : 0));
    }
    message_write_packet(&payload, &packet);
    send(FRAME_PACKET, &payload);
}

static uint64_t arrival(uint32_t k)
{
    return 1000000u + 40000u * (uint64_t)k;
}

/* ---- The table */

static void a_table_is_accepted_when_its_last_part_has_come(void)
{
    send_begin(5, 3, 2, 0);
    work();
    TEST_ASSERT_EQUAL_UINT32(5, seen.hello.nonce);
    TEST_ASSERT_FALSE(seen.hello.refused);
    const message_joint_t joint = usual_joint(1);
    send_joint(&joint);
    for (unsigned s = 3; s > 0; s--) { /* in any order */
        const message_sensor_t sensor = usual_sensor(s - 1u);
        send_sensor(&sensor);
    }
    TEST_ASSERT_EQUAL_UINT(0, seen.count[FRAME_TABLE]);
    const message_joint_t last = usual_joint(0);
    send_joint(&last);
    TEST_ASSERT_EQUAL_UINT(1, seen.count[FRAME_TABLE]);
    TEST_ASSERT_FALSE(seen.table.refused);
    TEST_ASSERT_EQUAL_UINT8(MESSAGE_ALL, seen.table.at);
    TEST_ASSERT_EQUAL_STRING("", seen.table.what);
}

static void too_many_are_refused_by_hello(void)
{
    send_begin(1, HUB_SENSORS + 1u, 2, 0);
    work();
    TEST_ASSERT_TRUE(seen.hello.refused);
    send_begin(2, HUB_SENSORS, HUB_JOINTS + 1u, 0);
    work();
    TEST_ASSERT_EQUAL_UINT32(2, seen.hello.nonce);
    TEST_ASSERT_TRUE(seen.hello.refused);
    send_begin(3, HUB_SENSORS, HUB_JOINTS, 0);
    work();
    TEST_ASSERT_FALSE(seen.hello.refused);
}

static void check_refused(const char *what, unsigned at)
{
    TEST_ASSERT_EQUAL_UINT(1, seen.count[FRAME_TABLE]);
    TEST_ASSERT_TRUE(seen.table.refused);
    TEST_ASSERT_EQUAL_STRING(what, seen.table.what);
    TEST_ASSERT_EQUAL_UINT8(at, seen.table.at);
    send_packet(0, 0, arrival(0)); /* nothing comes of it */
    send_number(FRAME_REQUEST, 4);
    work();
    TEST_ASSERT_EQUAL_UINT(0, seen.count[FRAME_BODY_STATE]);
    TEST_ASSERT_EQUAL_UINT32(4, seen.counters.token);
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.samples);
    TEST_ASSERT_EQUAL_UINT(1, seen.count[FRAME_TABLE]);
    power_on(true, false);
}

/* Three sensors and two joints, of which one sensor or joint is another. */
static void check_table(const message_sensor_t *sensor, const message_joint_t *joint, const char *what, unsigned at)
{
    send_begin(1, 3, 2, MESSAGE_LAGS);
    work();
    for (unsigned s = 0; s < 3u; s++) {
        const message_sensor_t usual = usual_sensor(s);
        send_sensor((sensor != NULL && s == 1u) ? sensor : &usual);
    }
    for (unsigned j = 0; j < 2u; j++) {
        const message_joint_t usual = usual_joint(j);
        send_joint((joint != NULL && j == 1u) ? joint : &usual);
    }
    check_refused(what, at);
}

static void a_table_is_refused_with_its_word(void)
{
    message_sensor_t sensor = usual_sensor(1);
    sensor.packets.per_packet = 0;
    check_table(&sensor, NULL, "per_packet", 1);
    sensor = usual_sensor(1);
    sensor.packets.max_drift_ppm = NAN;
    check_table(&sensor, NULL, "max_drift_ppm", 1);
    sensor = usual_sensor(0);
    check_table(&sensor, NULL, "twice", 0);
    sensor = usual_sensor(3);
    check_table(&sensor, NULL, "twice", 3);
    message_joint_t joint = usual_joint(1);
    joint.kind = 3u;
    check_table(NULL, &joint, "no_such_kind", 1);
    joint = usual_joint(1);
    joint.distal = 3u;
    check_table(NULL, &joint, "no_such_sensor", 1);
    joint = usual_joint(1);
    joint.distal = 1u;
    check_table(NULL, &joint, "same_sensor", 1);
    joint.proximal = 0u;
    check_table(NULL, &joint, "distal_twice", 1);
    joint = usual_joint(1);
    joint.kind = JCAL_BODY_HINGE;
    joint.max_bound_rad = NAN;
    check_table(NULL, &joint, "max_bound_rad", 1);
    joint.max_bound_rad = -0.1f;
    check_table(NULL, &joint, "max_bound_rad", 1);
}

static void an_empty_table_is_answered(void)
{
    send_begin(1, 0, 0, 0);
    work();
    TEST_ASSERT_FALSE(seen.hello.refused);
    check_refused("sensor_count", 0);
}

static void packets_before_the_table_are_not_used(void)
{
    send_begin(1, 2, 1, 0);
    work();
    send_packet(0, 0, arrival(0));
    work();
    send_table(2);
    send_number(FRAME_REQUEST, 3);
    work();
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.samples);
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.unknown);
    TEST_ASSERT_EQUAL_UINT32(6, seen.counters.link.taken);
}

/* ---- Answers */

static unsigned first_of(uint8_t type)
{
    unsigned at = 0;
    while (at < seen.frames && seen.order[at] != type) {
        at++;
    }
    return at;
}

static void a_request_is_answered_by_all_states_in_order(void)
{
    open_session(5, MESSAGE_LAGS | MESSAGE_EXAMINE);
    send_packet(3, 0, arrival(0));
    send_packet(4, 0, arrival(1));
    work();
    seen.frames = 0;
    send_number(FRAME_REQUEST, 77);
    work();
    TEST_ASSERT_EQUAL_UINT(1u + 5u + 4u + 1u + 1u, seen.frames);
    TEST_ASSERT_EQUAL_UINT(0, first_of(FRAME_BODY_STATE));
    TEST_ASSERT_EQUAL_UINT(1, first_of(FRAME_SENSOR_STATE));
    TEST_ASSERT_EQUAL_UINT(6, first_of(FRAME_JOINT_STATE));
    TEST_ASSERT_EQUAL_UINT(10, first_of(FRAME_ADVICE));
    TEST_ASSERT_EQUAL_UINT(11, first_of(FRAME_COUNTERS));
    TEST_ASSERT_EQUAL_UINT32(77, seen.body.token);
    TEST_ASSERT_EQUAL_UINT32(77, seen.sensor.token);
    TEST_ASSERT_EQUAL_UINT8(4, seen.sensor.sensor);
    TEST_ASSERT_TRUE(seen.sensor.result.is_heard);
    TEST_ASSERT_EQUAL_UINT32(77, seen.joint.token);
    TEST_ASSERT_EQUAL_UINT8(3, seen.joint.joint);
    TEST_ASSERT_EQUAL_UINT32(77, seen.counters.token);
    TEST_ASSERT_EQUAL_UINT32(2, seen.counters.samples);
    send_number(FRAME_REQUEST, 0); /* a token like any other */
    work();
    TEST_ASSERT_EQUAL_UINT(2u * 12u, seen.frames);
    TEST_ASSERT_EQUAL_UINT(0, seen.count[FRAME_FLEXIONS]);
}

static void messages_of_the_other_kind_of_session_are_unknown(void)
{
    const jcal_pair_t pair = {0};
    const message_sleep_t sleep = {9, true};
    frame_writer_t payload;
    open_session(2, 0);
    message_write_sample(&payload, &pair);
    send(FRAME_SAMPLE, &payload);
    message_write_sleep(&payload, &sleep); /* no such joint: taken, and nothing comes of it */
    send(FRAME_SLEEP, &payload);
    send_packet(7, 0, arrival(0)); /* no such sensor */
    send_number(FRAME_REQUEST, 1);
    work();
    TEST_ASSERT_EQUAL_UINT32(1, seen.counters.unknown);
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.samples);
    const message_start_t start = {2, 0, 0.05f, 0};
    next_number = 0;
    message_write_start(&payload, &start);
    send(FRAME_START, &payload);
    send_packet(0, 0, arrival(0));
    send_number(FRAME_REQUEST, 2);
    work();
    TEST_ASSERT_EQUAL_UINT32(2, seen.counters.token);
    TEST_ASSERT_EQUAL_UINT32(1, seen.counters.unknown);
}

static void states_and_angles_come_by_time(void)
{
    const message_begin_t begin = {1, 1000000u, 200000u, 2u, 1u, 0u};
    frame_writer_t payload;
    next_number = 0;
    message_write_begin(&payload, &begin);
    send(FRAME_BEGIN, &payload);
    work();
    send_table(2);
    for (uint32_t k = 0; k <= 100u; k++) { /* four seconds */
        send_packet(0, k, arrival(k));
        send_packet(1, k, arrival(k));
        work();
        TEST_ASSERT_EQUAL_UINT(k / 25u, seen.count[FRAME_BODY_STATE]);
        TEST_ASSERT_EQUAL_UINT(k / 25u, seen.count[FRAME_COUNTERS]);
    }
    TEST_ASSERT_UINT_WITHIN(2, 20, seen.count[FRAME_FLEXIONS]); /* a little behind the packets */
    TEST_ASSERT_EQUAL_UINT(0, seen.flexions.count);
    TEST_ASSERT_EQUAL_UINT(0, seen.count[FRAME_ORIENTATIONS]);
    TEST_ASSERT_EQUAL_UINT32(2u * 100u + 1u,
                             seen.counters.samples); /* they came with the first packet of the last time */
    TEST_ASSERT_EQUAL_UINT(0, seen.unordered);
    message_write_time(&payload, arrival(100) + 5000000u); /* nothing for five seconds */
    send(FRAME_TIME, &payload);
    work();
    TEST_ASSERT_EQUAL_UINT(2, seen.events[JCAL_BODY_SENSOR_LOST]);
    TEST_ASSERT_EQUAL_UINT(5, seen.count[FRAME_BODY_STATE]);
}

/* How the hub is worked: after each frame, when credit is used up, or in between. */
static uint32_t play(unsigned each)
{
    power_on(true, false);
    open_session(4, MESSAGE_LAGS | MESSAGE_EXAMINE | MESSAGE_KEEP);
    for (uint32_t k = 0; k < 100u; k++) {
        for (unsigned s = 0; s < 4u; s++) {
            while (next_number >= seen.limit) {
                TEST_ASSERT_TRUE(hub_work(&hub)); /* else the hub would be stuck */
                listen();
            }
            send_packet(s, k, arrival(k) + 500u * s);
            if (each != 0 && (k + s) % each == 0) {
                work();
            }
        }
    }
    send_number(FRAME_REQUEST, 9);
    work();
    TEST_ASSERT_EQUAL_UINT32(400, seen.counters.samples);
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.overrun);
    TEST_ASSERT_EQUAL_UINT(0, seen.bad + seen.unordered);
    TEST_ASSERT_EQUAL_UINT(4, seen.events[JCAL_BODY_SENSOR_BACK]);
    return seen.sum;
}

static void answers_are_the_same_however_slow_the_hub_is(void)
{
    const uint32_t sum = play(1);
    TEST_ASSERT_EQUAL_HEX32(sum, play(0));
    TEST_ASSERT_EQUAL_HEX32(sum, play(7));
}

/* Nobody takes the answers: the hub waits, and loses none of them. */
static void answers_wait_for_room(void)
{
    open_session(16, MESSAGE_LAGS);
    send_number(FRAME_REQUEST, 3);
    while (hub_work(&hub)) {
    }
    TEST_ASSERT_TRUE(hub_waiting(&hub));
    TEST_ASSERT_FALSE(hub_work(&hub));
    work();
    TEST_ASSERT_FALSE(hub_waiting(&hub));
    TEST_ASSERT_EQUAL_UINT(16, seen.count[FRAME_SENSOR_STATE]);
    TEST_ASSERT_EQUAL_UINT(15, seen.count[FRAME_JOINT_STATE]);
    TEST_ASSERT_EQUAL_UINT(1, seen.count[FRAME_COUNTERS]);
    TEST_ASSERT_EQUAL_UINT(0, seen.bad + seen.unordered);
}

static void a_sender_without_manners_is_counted(void)
{
    open_session(2, 0);
    for (uint32_t k = 0; k < 100u; k++) {
        send_packet(0, k, arrival(k));
    }
    work();
    send_number(FRAME_REQUEST, 5);
    work();
    TEST_ASSERT_EQUAL_UINT32(HUB_QUEUE, seen.counters.samples);
    TEST_ASSERT_EQUAL_UINT32(100u - HUB_QUEUE, seen.counters.overrun);
}

static void the_hub_s_own_clock_stamps_packets_and_goes_on_without_them(void)
{
    open_session(2, 0);
    for (uint32_t k = 0; k < 25u; k++) {
        hub_time(&hub, (UINT64_C(1) << 32) - 500000u + 40000u * k); /* across the low word's wrap */
        send_packet(0, k, MESSAGE_ARRIVAL_NOW);
        send_packet(1, k, MESSAGE_ARRIVAL_NOW);
        work();
    }
    TEST_ASSERT_EQUAL_UINT(2, seen.events[JCAL_BODY_SENSOR_BACK]);
    TEST_ASSERT_FALSE(hub_waiting(&hub));
    for (uint32_t k = 25; k < 75u; k++) {
        hub_time(&hub, (UINT64_C(1) << 32) - 500000u + 40000u * k);
        work();
    }
    TEST_ASSERT_EQUAL_UINT(2, seen.events[JCAL_BODY_SENSOR_LOST]);
}

/* ---- Other versions */

/* A frame of another version, by hand: docs/PROTOCOL.md, section Frame. */
static void send_other(uint8_t version, uint8_t type)
{
    uint8_t frame[10] = {version, type, 0, 0, 0, 0};
    uint8_t wire[12];
    const uint32_t crc = frame_crc32(frame, 6);
    for (unsigned k = 0; k < 4u; k++) {
        frame[6u + k] = (uint8_t)(crc >> (8u * k));
    }
    unsigned code = 0;
    for (unsigned k = 0; k < 10u; k++) {
        wire[k + 1u] = frame[k];
        if (frame[k] == 0) {
            wire[code] = (uint8_t)(k + 1u - code);
            code = k + 1u;
        }
    }
    wire[code] = (uint8_t)(11u - code);
    wire[11] = 0;
    for (unsigned k = 0; k < 12u; k++) {
        hub_receive(&hub, wire[k]);
    }
    work();
}

static void versions_1_and_2_are_answered_by_version(void)
{
    send_other(1, FRAME_SAMPLE);
    TEST_ASSERT_EQUAL_UINT(1, seen.count[FRAME_OTHER_VERSION]);
    TEST_ASSERT_EQUAL_UINT8(1, seen.refused_version);
    send_other(1, FRAME_SAMPLE); /* once is enough, */
    TEST_ASSERT_EQUAL_UINT(1, seen.count[FRAME_OTHER_VERSION]);
    send_other(2, FRAME_START); /* but for each start */
    send_other(2, FRAME_START);
    TEST_ASSERT_EQUAL_UINT(3, seen.count[FRAME_OTHER_VERSION]);
    TEST_ASSERT_EQUAL_UINT8(2, seen.refused_version);
    TEST_ASSERT_EQUAL_UINT(3, seen.frames);
    open_session(2, 0);
    send_other(2, FRAME_START);
    TEST_ASSERT_EQUAL_UINT(4, seen.count[FRAME_OTHER_VERSION]);
}

/* ---- Kept */

static void a_record(uint8_t bytes[JCAL_KEPT_BYTES], unsigned joint)
{
    const jcal_kept_t kept = {.kind = JCAL_KEPT_HINGE,
                              .model = JCAL_MODEL_FUNCTIONAL,
                              .joint = (uint8_t)joint,
                              .serial1 = 100,
                              .serial2 = 101,
                              .axis1 = {1.0f, 0.0f, 0.0f},
                              .axis2 = {0.0f, 1.0f, 0.0f},
                              .bound1_rad = 0.05f,
                              .bound2_rad = 0.05f};
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_encode(&kept, bytes));
}

static void put(uint32_t token, const uint8_t bytes[JCAL_KEPT_BYTES])
{
    message_put_kept_t message = {.token = token};
    frame_writer_t payload;
    memcpy(message.bytes, bytes, JCAL_KEPT_BYTES);
    message_write_put_kept(&payload, &message);
    send(FRAME_PUT_KEPT, &payload);
}

static void check_kept(uint32_t token, unsigned joint, unsigned refusal, bool has_bytes)
{
    static const uint8_t nothing[JCAL_KEPT_BYTES];
    TEST_ASSERT_EQUAL_UINT32(token, seen.kept.token);
    TEST_ASSERT_EQUAL_UINT8(joint, seen.kept.joint);
    TEST_ASSERT_EQUAL_UINT8(refusal, seen.kept.refusal);
    TEST_ASSERT_EQUAL(has_bytes, memcmp(nothing, seen.kept.bytes, sizeof nothing) != 0);
}

static void records_go_down_and_up(void)
{
    uint8_t bytes[JCAL_KEPT_BYTES], there[JCAL_KEPT_BYTES];
    open_session(2, MESSAGE_KEEP | MESSAGE_LAGS);
    ask_kept(FRAME_GET_KEPT, 1, 0);
    work();
    check_kept(1, 0, JCAL_KEPT_NONE, false);
    a_record(bytes, 0);
    put(2, bytes);
    work();
    check_kept(2, 0, MESSAGE_KEPT_WRITTEN, true);
    memcpy(there, seen.kept.bytes, sizeof there);
    a_record(bytes, 14);
    put(3, bytes);
    ask_kept(FRAME_GET_KEPT, 4, 0);
    work();
    check_kept(4, 0, JCAL_KEPT_FITS, true);
    TEST_ASSERT_EQUAL_MEMORY(there, seen.kept.bytes, sizeof there);
    ask_kept(FRAME_FORGET, 5, 0);
    work();
    check_kept(5, 0, MESSAGE_KEPT_FORGOTTEN, false);
    ask_kept(FRAME_GET_KEPT, 6, 14);
    work();
    check_kept(6, 14, JCAL_KEPT_FITS, true);
    ask_kept(FRAME_GET_KEPT, 7, 0);
    work();
    check_kept(7, 0, JCAL_KEPT_NONE, false);
    ask_kept(FRAME_FORGET, 8, MESSAGE_ALL);
    ask_kept(FRAME_GET_KEPT, 9, 14);
    send_number(FRAME_REQUEST, 10);
    work();
    check_kept(9, 14, JCAL_KEPT_NONE, false);
    TEST_ASSERT_EQUAL_UINT32(4, seen.body.writes);
    TEST_ASSERT_EQUAL_UINT(9, seen.count[FRAME_KEPT]);
}

static void what_is_no_record_is_not_written(void)
{
    uint8_t bytes[JCAL_KEPT_BYTES];
    open_session(2, MESSAGE_KEEP);
    a_record(bytes, 0);
    bytes[40] ^= 1u;
    put(1, bytes);
    work();
    check_kept(1, MESSAGE_ALL, JCAL_KEPT_DAMAGED, false);
    a_record(bytes, 15); /* the hub has no such place */
    put(2, bytes);
    work();
    check_kept(2, MESSAGE_ALL, JCAL_KEPT_NONE, false);
    ask_kept(FRAME_GET_KEPT, 3, 15);
    work();
    check_kept(3, 15, JCAL_KEPT_NONE, false);
    ask_kept(FRAME_FORGET, 4, 15);
    send_number(FRAME_REQUEST, 5);
    work();
    check_kept(4, 15, JCAL_KEPT_NONE, false);
    TEST_ASSERT_EQUAL_UINT32(0, seen.body.writes);
    power_on(false, false); /* no flash */
    open_session(2, MESSAGE_KEEP);
    a_record(bytes, 0);
    put(5, bytes);
    work();
    check_kept(5, 0, MESSAGE_KEPT_FLASH_FAILED, false);
    ask_kept(FRAME_FORGET, 6, 0);
    work();
    check_kept(6, 0, MESSAGE_KEPT_FLASH_FAILED, false);
}

/* Flash that makes deaf waits for 20 ms without a byte, or until all has come that the hub let come. */
static void a_deaf_flash_waits_for_silence(void)
{
    uint8_t bytes[JCAL_KEPT_BYTES];
    a_record(bytes, 0);
    power_on(true, true);
    hub_time(&hub, 5000000u);
    open_session(2, MESSAGE_KEEP);
    put(1, bytes);
    work();
    TEST_ASSERT_FALSE(hub_waiting(&hub));
    TEST_ASSERT_EQUAL_UINT(0, seen.count[FRAME_KEPT]);
    const uint32_t limit = seen.limit;
    hub_time(&hub, 5015000u);
    send_packet(0, 0, arrival(0));
    work();
    TEST_ASSERT_EQUAL_UINT32(limit, seen.limit);
    hub_time(&hub, 5034999u);
    work();
    TEST_ASSERT_EQUAL_UINT(0, seen.count[FRAME_KEPT]);
    hub_time(&hub, 5035001u);
    TEST_ASSERT_TRUE(hub_waiting(&hub));
    work();
    check_kept(1, 0, MESSAGE_KEPT_WRITTEN, true);
    put(2, bytes);
    const uint32_t end = seen.limit;
    for (uint32_t k = 1; next_number != end; k++) {
        TEST_ASSERT_EQUAL_UINT(1, seen.count[FRAME_KEPT]);
        send_packet(0, k, arrival(k));
        work();
    }
    check_kept(2, 0, MESSAGE_KEPT_WRITTEN, true);
    send_number(FRAME_REQUEST, 3);
    work();
    TEST_ASSERT_EQUAL_UINT32(0, seen.counters.overrun);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_table_is_accepted_when_its_last_part_has_come);
    RUN_TEST(too_many_are_refused_by_hello);
    RUN_TEST(a_table_is_refused_with_its_word);
    RUN_TEST(an_empty_table_is_answered);
    RUN_TEST(packets_before_the_table_are_not_used);
    RUN_TEST(a_request_is_answered_by_all_states_in_order);
    RUN_TEST(messages_of_the_other_kind_of_session_are_unknown);
    RUN_TEST(states_and_angles_come_by_time);
    RUN_TEST(answers_are_the_same_however_slow_the_hub_is);
    RUN_TEST(answers_wait_for_room);
    RUN_TEST(a_sender_without_manners_is_counted);
    RUN_TEST(the_hub_s_own_clock_stamps_packets_and_goes_on_without_them);
    RUN_TEST(versions_1_and_2_are_answered_by_version);
    RUN_TEST(records_go_down_and_up);
    RUN_TEST(what_is_no_record_is_not_written);
    RUN_TEST(a_deaf_flash_waits_for_silence);
    return UNITY_END();
}
