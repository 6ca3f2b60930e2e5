/* SPDX-License-Identifier: MIT */
/* Frame codec: the vectors of docs/PROTOCOL.md, damage of every kind, sequence numbers, payloads. */
#include "frame.h"
#include "messages.h"

#include <unity.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void setUp(void)
{
}

void tearDown(void)
{
}

/* Decodes all bytes; counts frames and pieces that are none. The last frame is copied out. */
typedef struct {
    unsigned good, bad;
    frame_t frame;
    uint8_t payload[FRAME_MAX];
} decoded_t;

static decoded_t decode_all(frame_decoder_t *decoder, const uint8_t *bytes, size_t size)
{
    decoded_t out = {0};
    for (size_t k = 0; k < size; k++) {
        frame_t frame;
        const frame_event_t event = frame_decode(decoder, bytes[k], &frame);
        out.bad += (event == FRAME_BAD) ? 1u : 0u;
        if (event == FRAME_GOOD) {
            out.good++;
            out.frame = frame;
            memcpy(out.payload, frame.payload, frame.size);
        }
    }
    return out;
}

static size_t from_hex(const char *text, uint8_t *bytes, size_t room)
{
    size_t size = 0;
    for (; text[0] != '-' && text[2 * size] != '\0' && size < room; size++) {
        const char digits[3] = {text[2 * size], text[2 * size + 1], '\0'};
        bytes[size] = (uint8_t)strtoul(digits, NULL, 16);
    }
    return size;
}

static void check_vector(const char *line)
{
    char type[8], number[16], payload_hex[500], wire_hex[500];
    uint8_t payload[FRAME_PAYLOAD_MAX], wire[FRAME_WIRE_MAX], made[FRAME_WIRE_MAX];
    TEST_ASSERT_EQUAL_INT(4, sscanf(line, "vector %7s %15s %499s %499s", type, number, payload_hex, wire_hex));
    const size_t size = from_hex(payload_hex, payload, sizeof payload);
    const size_t wire_size = from_hex(wire_hex, wire, sizeof wire);
    const frame_type_t kind = (frame_type_t)strtoul(type, NULL, 16);
    const uint32_t sequence = (uint32_t)strtoul(number, NULL, 16);
    TEST_ASSERT_EQUAL_size_t(wire_size, frame_encode(made, kind, sequence, payload, size));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(wire, made, wire_size);

    frame_decoder_t decoder = {0};
    const decoded_t got = decode_all(&decoder, wire, wire_size);
    TEST_ASSERT_EQUAL_UINT(1, got.good);
    TEST_ASSERT_EQUAL_UINT(0, got.bad);
    TEST_ASSERT_EQUAL_UINT8(FRAME_VERSION, got.frame.version);
    TEST_ASSERT_EQUAL_UINT8(kind, got.frame.type);
    TEST_ASSERT_EQUAL_HEX32(sequence, got.frame.sequence);
    TEST_ASSERT_EQUAL_size_t(size, got.frame.size);
    if (size > 0) {
        TEST_ASSERT_EQUAL_HEX8_ARRAY(payload, got.payload, size);
    }
}

static void the_vectors_of_the_specification(void)
{
    char line[1100];
    unsigned count = 0;
    FILE *file = fopen("docs/PROTOCOL.md", "r");
    if (file == NULL) {
        TEST_IGNORE_MESSAGE("docs/PROTOCOL.md is not in reach");
    }
    while (fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "vector ", 7) == 0) {
            check_vector(line);
            count++;
        }
    }
    (void)fclose(file);
    TEST_ASSERT_EQUAL_UINT(36, count);
}

static void crc_is_that_of_ieee_802_3(void)
{
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, frame_crc32((const uint8_t *)"123456789", 9));
}

static void payloads_of_every_length_and_zeros_everywhere(void)
{
    frame_decoder_t decoder = {0};
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t wire[FRAME_WIRE_MAX];
    for (size_t size = 0; size <= sizeof payload; size++) {
        for (unsigned zero_each = 1; zero_each < 5; zero_each++) {
            for (size_t k = 0; k < size; k++) {
                payload[k] = (k % zero_each == 0) ? 0 : (uint8_t)(7u * k);
            }
            const size_t length = frame_encode(wire, FRAME_SAMPLE, (uint32_t)size, payload, size);
            TEST_ASSERT_EQUAL_size_t(size + FRAME_HEAD_BYTES + FRAME_CRC_BYTES + 2u, length);
            TEST_ASSERT_NULL(memchr(wire, 0, length - 1u));
            const decoded_t got = decode_all(&decoder, wire, length);
            TEST_ASSERT_EQUAL_UINT(1, got.good);
            TEST_ASSERT_EQUAL_size_t(size, got.frame.size);
            TEST_ASSERT_EQUAL_INT(0, memcmp(payload, got.payload, size));
        }
    }
    TEST_ASSERT_EQUAL_size_t(0, frame_encode(wire, FRAME_SAMPLE, 0, payload, FRAME_PAYLOAD_MAX + 1u));
}

static size_t make_sample(uint8_t *wire, uint32_t sequence)
{
    const jcal_pair_t pair = {123456789u, {{0.1f, 0.0f, -3.0f}, {9.8f, 0.0f, 1.0f}}, {{2.0f, 1.0f, 0}, {0, 9.7f, 0}}};
    frame_writer_t payload;
    message_write_sample(&payload, &pair);
    return frame_encode(wire, FRAME_SAMPLE, sequence, payload.bytes, payload.size);
}

static void any_single_and_double_bit_flip_is_found(void)
{
    uint8_t wire[FRAME_WIRE_MAX];
    const size_t size = make_sample(wire, 5);
    const size_t bits = 8u * (size - 1u); /* the zero at the end stays */
    for (size_t first = 0; first < bits; first++) {
        /* All second bits for a few first ones, one for the others. */
        const size_t step = (first % 16u == 0) ? 1u : bits;
        for (size_t second = first; second < bits; second += step) {
            frame_decoder_t decoder = {0};
            uint8_t damaged[FRAME_WIRE_MAX];
            memcpy(damaged, wire, size);
            damaged[first / 8u] ^= (uint8_t)(1u << (first % 8u));
            damaged[second / 8u] ^= (uint8_t)((second == first) ? 0u : 1u << (second % 8u));
            const decoded_t got = decode_all(&decoder, damaged, size);
            TEST_ASSERT_EQUAL_UINT(0, got.good);
            TEST_ASSERT_TRUE(got.bad >= 1u);
        }
    }
}

static void a_damaged_frame_leaves_the_next_one_alone(void)
{
    uint8_t wire[2u * FRAME_WIRE_MAX];
    const size_t first = make_sample(wire, 5);
    const size_t both = first + make_sample(wire + first, 6);
    for (size_t from = 1; from < first - 1u; from++) { /* the beginning is cut off */
        frame_decoder_t decoder = {0};
        const decoded_t got = decode_all(&decoder, wire + from, both - from);
        TEST_ASSERT_EQUAL_UINT(1, got.good);
        TEST_ASSERT_EQUAL_UINT(1, got.bad);
        TEST_ASSERT_EQUAL_UINT32(6, got.frame.sequence);
    }
}

static void endless_bytes_are_one_piece(void)
{
    frame_decoder_t decoder = {0};
    frame_t frame;
    for (unsigned k = 0; k < 100000u; k++) {
        TEST_ASSERT_EQUAL_INT(FRAME_NONE, frame_decode(&decoder, (uint8_t)(1u + k % 255u), &frame));
    }
    TEST_ASSERT_EQUAL_INT(FRAME_BAD, frame_decode(&decoder, 0, &frame));
    TEST_ASSERT_EQUAL_INT(FRAME_NONE, frame_decode(&decoder, 0, &frame));
    uint8_t wire[FRAME_WIRE_MAX];
    TEST_ASSERT_EQUAL_UINT(1, decode_all(&decoder, wire, make_sample(wire, 1)).good);
}

static void check_counts(const frame_link_t *link, frame_counts_t expected)
{
    TEST_ASSERT_EQUAL_MEMORY(&expected, &link->counts, sizeof expected);
    TEST_ASSERT_EQUAL_UINT32(expected.received,
                             expected.taken + expected.repeated + expected.reordered + expected.stale);
}

static void numbers_in_order_with_gaps_repeats_and_late_ones(void)
{
    frame_link_t link = {0};
    frame_link_start(&link, 10);
    TEST_ASSERT_EQUAL_INT(FRAME_TAKEN, frame_link_count(&link, 11));
    TEST_ASSERT_EQUAL_INT(FRAME_REPEATED, frame_link_count(&link, 11));
    TEST_ASSERT_EQUAL_INT(FRAME_TAKEN, frame_link_count(&link, 14)); /* 12 and 13 are missing */
    check_counts(&link, (frame_counts_t){.received = 4, .taken = 3, .lost = 2, .repeated = 1});
    TEST_ASSERT_EQUAL_INT(FRAME_REORDERED, frame_link_count(&link, 12));
    TEST_ASSERT_EQUAL_INT(FRAME_REPEATED, frame_link_count(&link, 12));
    TEST_ASSERT_EQUAL_INT(FRAME_TAKEN, frame_link_count(&link, 15));
    TEST_ASSERT_EQUAL_INT(FRAME_REORDERED, frame_link_count(&link, 13));
    check_counts(&link, (frame_counts_t){.received = 8, .taken = 4, .repeated = 2, .reordered = 2});
}

static void the_history_has_an_end(void)
{
    for (uint32_t jump = 60; jump < 70u; jump++) {
        frame_link_t link = {0};
        frame_link_start(&link, UINT32_MAX - 3u); /* across the wrap */
        TEST_ASSERT_EQUAL_INT(FRAME_TAKEN, frame_link_count(&link, UINT32_MAX - 3u + jump));
        TEST_ASSERT_EQUAL_UINT32(jump - 1u, link.counts.lost);
        const frame_order_t start = (jump < FRAME_HISTORY) ? FRAME_REPEATED : FRAME_STALE;
        TEST_ASSERT_EQUAL_INT(start, frame_link_count(&link, UINT32_MAX - 3u));
        const frame_order_t first_missing = (jump - 1u < FRAME_HISTORY) ? FRAME_REORDERED : FRAME_STALE;
        TEST_ASSERT_EQUAL_INT(first_missing, frame_link_count(&link, UINT32_MAX - 2u));
        TEST_ASSERT_EQUAL_INT(FRAME_REORDERED, frame_link_count(&link, UINT32_MAX - 4u + jump));
    }
}

/* Every field has a value of its own. */
static void fill_result(jcal_hinge_auto_result_t *all)
{
    jcal_hinge_result_t *result = &all->hinge;
    all->model = JCAL_MODEL_FUNCTIONAL;
    all->ready_for = JCAL_FOR_FLEXION;
    all->flexion_uncertainty_rad = 0.03f;
    all->heading = (jcal_heading_t){1.25f, true};
    all->has_levers = true;
    all->joint_to_sensor1_m = (jcal_vec3_t){0.11f, 0.12f, 0.13f};
    all->joint_to_sensor2_m = (jcal_vec3_t){0.14f, 0.15f, 0.16f};
    result->head.status = JCAL_READY;
    result->head.weak = JCAL_WEAK_SIGN;
    result->head.hint = JCAL_HINT_TILT_AXIS;
    result->head.reason = JCAL_REASON_SIGN_OPEN;
    result->has_axes = true;
    result->axis1 = (jcal_vec3_t){0.1f, 0.2f, 0.3f};
    result->axis2 = (jcal_vec3_t){0.4f, 0.5f, 0.6f};
    result->uncertainty1_rad = 0.01f;
    result->uncertainty2_rad = 0.02f;
    result->sign_margin = 17.0f;
    result->progress_axis1 = 0.7f;
    result->progress_axis2 = 0.8f;
    result->progress_sign = 0.9f;
    result->head.t_us = (UINT64_C(1) << 62) - 1u;
    result->head.samples = 4711;
    result->head.rejected_by[JCAL_REJECT_GAP] = 3;
    result->head.rejected_by[JCAL_REJECT_NOT_FINITE] = 4;
    result->head.rejected = 7;
}

static void an_estimate_comes_back_as_it_was(void)
{
    message_estimate_t out = {.events = 5, .token = 77, .now_us = UINT64_C(1) << 62};
    message_estimate_t in;
    fill_result(&out.result);
    frame_writer_t payload;
    message_write_estimate(&payload, &out);
    TEST_ASSERT_TRUE(payload.ok);
    const frame_t frame = {
        .version = FRAME_VERSION, .type = FRAME_ESTIMATE, .payload = payload.bytes, .size = payload.size};
    TEST_ASSERT_TRUE(message_read_estimate(&frame, &in));
    TEST_ASSERT_EQUAL_UINT8(out.events, in.events);
    TEST_ASSERT_EQUAL_UINT32(out.token, in.token);
    TEST_ASSERT_TRUE(out.now_us == in.now_us); /* Unity has no 64 bits on targets */
    TEST_ASSERT_EQUAL_MEMORY(&out.result.hinge.axis1, &in.result.hinge.axis1, sizeof out.result.hinge.axis1);
    TEST_ASSERT_EQUAL_MEMORY(&out.result.hinge.axis2, &in.result.hinge.axis2, sizeof out.result.hinge.axis2);
    TEST_ASSERT_EQUAL_INT(out.result.hinge.head.status, in.result.hinge.head.status);
    TEST_ASSERT_EQUAL_INT(out.result.hinge.head.reason, in.result.hinge.head.reason);
    TEST_ASSERT_EQUAL_FLOAT(out.result.hinge.sign_margin, in.result.hinge.sign_margin);
    TEST_ASSERT_EQUAL_FLOAT(out.result.hinge.progress_sign, in.result.hinge.progress_sign);
    TEST_ASSERT_TRUE(out.result.hinge.head.t_us == in.result.hinge.head.t_us); /* Unity has no 64 bits on targets */
    TEST_ASSERT_EQUAL_UINT32(7, in.result.hinge.head.rejected);
    TEST_ASSERT_EQUAL_INT(out.result.model, in.result.model);
    TEST_ASSERT_EQUAL_INT(out.result.ready_for, in.result.ready_for);
    TEST_ASSERT_EQUAL_FLOAT(out.result.flexion_uncertainty_rad, in.result.flexion_uncertainty_rad);
    TEST_ASSERT_EQUAL_FLOAT(out.result.heading.heading_rad, in.result.heading.heading_rad);
    TEST_ASSERT_TRUE(in.result.heading.known && in.result.has_levers);
    TEST_ASSERT_EQUAL_MEMORY(&out.result.joint_to_sensor1_m, &in.result.joint_to_sensor1_m, sizeof(jcal_vec3_t));
    TEST_ASSERT_EQUAL_MEMORY(&out.result.joint_to_sensor2_m, &in.result.joint_to_sensor2_m, sizeof(jcal_vec3_t));
    for (size_t size = 0; size < payload.size; size++) { /* shorter is no estimate */
        const frame_t part = {.payload = payload.bytes, .size = size};
        TEST_ASSERT_FALSE(message_read_estimate(&part, &in));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_vectors_of_the_specification);
    RUN_TEST(crc_is_that_of_ieee_802_3);
    RUN_TEST(payloads_of_every_length_and_zeros_everywhere);
    RUN_TEST(any_single_and_double_bit_flip_is_found);
    RUN_TEST(a_damaged_frame_leaves_the_next_one_alone);
    RUN_TEST(endless_bytes_are_one_piece);
    RUN_TEST(numbers_in_order_with_gaps_repeats_and_late_ones);
    RUN_TEST(the_history_has_an_end);
    RUN_TEST(an_estimate_comes_back_as_it_was);
    return UNITY_END();
}
