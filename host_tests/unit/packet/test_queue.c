/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/packet.h: what push hands to pull, conversion, settings and errors.
#include "unit/packet/radio.h"

#include "unity.h"

#include <math.h>

static jcal_packets_t packets;
static unsigned char storage[JCAL_PACKETS_STORAGE_BYTES(256, 16, JCAL_PACKET_SI)];
static float values[96];

void setUp(void)
{
}

void tearDown(void)
{
}

static jcal_packet_t packet_at(uint64_t first, unsigned count)
{
    radio_t radio = radio_begin();
    radio.count = count;
    return radio_packet(&radio, first, 1000000u + 10000u * (first + count), values);
}

static void assert_reading(const jcal_reading_t *reading, uint64_t k)
{
    float expected[6];
    radio_values(k, expected);
    TEST_ASSERT_EQUAL_MEMORY(expected, &reading->imu, sizeof expected);
}

static void start(uint16_t capacity, uint8_t per_packet)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.packets = capacity;
    config.per_packet = per_packet;
    memset(storage, 0xA5, sizeof storage);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_init(&packets, &config, storage, sizeof storage));
}

static void what_is_full_refuses_and_counts(void)
{
    start(4, 2);
    for (unsigned k = 0; k < 4; ++k) {
        const jcal_packet_t packet = packet_at(2u * k, 2);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_push(&packets, &packet));
    }
    const jcal_packet_t packet = packet_at(8, 2);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, jcal_packets_push(&packets, &packet));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, jcal_packets_push(&packets, &packet));
    jcal_packets_status_t status;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_get(&packets, &status));
    TEST_ASSERT_EQUAL_UINT32(2, status.overruns);
    TEST_ASSERT_EQUAL_UINT32(4, status.waiting);
    jcal_reading_t reading;
    for (unsigned k = 0; k < 8; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
        assert_reading(&reading, k);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_packets_pull(&packets, &reading));
}

/* A packet's slot belongs to pull until its last reading is out; push comes in between as often as it can. */
static void push_may_come_between_any_two_readings(void)
{
    for (uint16_t capacity = 2; capacity <= RADIO_PACKETS; capacity = (uint16_t)(2u * capacity)) {
        for (unsigned pushes = 1; pushes <= 3; ++pushes) {
            start(capacity, 5);
            uint64_t in = 0;
            uint64_t out = 0;
            uint32_t refused = 0;
            jcal_reading_t reading;
            while (in < 70000u * 5u / 50u) {
                for (unsigned k = 0; k < pushes; ++k) {
                    const jcal_packet_t packet = packet_at(in, 5);
                    const jcal_status_t pushed = jcal_packets_push(&packets, &packet);
                    refused += (pushed == JCAL_ERR_FULL) ? 1u : 0u;
                    in += (pushed == JCAL_OK) ? 5u : 0u;
                }
                TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
                assert_reading(&reading, out);
                out++;
            }
            jcal_packets_status_t status;
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_get(&packets, &status));
            TEST_ASSERT_EQUAL_UINT32(refused, status.overruns);
            TEST_ASSERT_EQUAL_UINT32(out, status.readings);
            TEST_ASSERT_EQUAL_UINT32(0, status.lost + status.odd + status.restarts);
        }
    }
}

/* What pull reads of the slot and what push writes are never the same: the slot of an open packet keeps every byte. */
static void push_leaves_the_slot_of_pull_alone(void)
{
    start(2, 3);
    const size_t slot = JCAL_PACKETS_STORAGE_BYTES(1, 3, JCAL_PACKET_SI);
    const jcal_packet_t first = packet_at(0, 3);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_push(&packets, &first));
    jcal_reading_t reading;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
    unsigned char before[JCAL_PACKETS_STORAGE_BYTES(1, 3, JCAL_PACKET_SI)];
    memcpy(before, storage, slot);
    for (unsigned k = 1; k <= 4; ++k) {
        const jcal_packet_t packet = packet_at(3u * k, 3);
        TEST_ASSERT_EQUAL_INT((k == 1) ? JCAL_OK : JCAL_ERR_FULL, jcal_packets_push(&packets, &packet));
        TEST_ASSERT_EQUAL_MEMORY(before, storage, slot);
    }
    TEST_ASSERT_EACH_EQUAL_HEX8(0xA5, &storage[2u * slot], 64);
}

/* The queue's 16-bit indices run over after 65,536 packets. */
static void indices_may_run_over(void)
{
    start(4, 1);
    packets.ring.written = UINT16_MAX - 5u;
    packets.ring.taken = UINT16_MAX - 5u;
    for (unsigned k = 0; k < 20; ++k) {
        const jcal_packet_t packet = packet_at(k, 1);
        jcal_reading_t reading;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_push(&packets, &packet));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
        assert_reading(&reading, k);
    }
}

static void raw_values_are_converted_exactly(void)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.values = JCAL_PACKET_RAW;
    config.per_packet = 2;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chip_scale("ICM-42688", 500.0f, 4.0f, &config.scale));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_init(&packets, &config, storage, sizeof storage));
    uint64_t t_us = 1000000;
    for (int32_t value = -32768; value <= 32767; value += 2) {
        const int16_t raw[12] = {(int16_t)value,
                                 (int16_t)(value + 1),
                                 0,
                                 1,
                                 (int16_t)(value + 1),
                                 (int16_t)value,
                                 7,
                                 8,
                                 (int16_t)value,
                                 -1,
                                 0,
                                 (int16_t)value};
        t_us += 20000;
        const jcal_packet_t packet = {t_us, (uint32_t)(value + 32768), 2, raw, NULL};
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_push(&packets, &packet));
        for (unsigned r = 0; r < 2; ++r) {
            jcal_reading_t reading;
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
            float found[6];
            memcpy(found, &reading.imu, sizeof found);
            for (unsigned k = 0; k < 6; ++k) {
                const float scale = (k < 3) ? config.scale.gyr_rad_s : config.scale.acc_m_s2;
                TEST_ASSERT_TRUE(found[k] == (float)raw[6 * r + k] * scale);
            }
        }
    }
}

static void floats_are_handed_through_whatever_they_are(void)
{
    start(4, 1);
    const float si[6] = {NAN, INFINITY, -INFINITY, -0.0f, 1e-42f, 3e38f};
    const jcal_packet_t packet = {.arrival_us = 5, .counter = 1, .count = 1, .si = si};
    jcal_reading_t reading;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_push(&packets, &packet));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
    TEST_ASSERT_EQUAL_MEMORY(si, &reading.imu, sizeof si);
    TEST_ASSERT_TRUE(reading.t_us == 5);
}

static void storage_may_lie_anywhere_and_must_be_large_enough(void)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.per_packet = 3;
    const size_t bytes = JCAL_PACKETS_STORAGE_BYTES(16, 3, JCAL_PACKET_SI);
    TEST_ASSERT_EQUAL_UINT(16u * (16u + 72u), bytes);
    TEST_ASSERT_EQUAL_UINT(16u * (16u + 48u), JCAL_PACKETS_STORAGE_BYTES(16, 4, JCAL_PACKET_RAW));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_packets_init(&packets, &config, storage, bytes - 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_init(&packets, &config, &storage[1], bytes));
    for (unsigned k = 0; k < 100; ++k) {
        const jcal_packet_t packet = packet_at(3u * k, 3);
        jcal_reading_t reading;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_push(&packets, &packet));
        for (unsigned r = 0; r < 3; ++r) {
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_packets_pull(&packets, &reading));
            assert_reading(&reading, 3u * k + r);
        }
    }
    TEST_ASSERT_TRUE(sizeof(jcal_packets_t) <= 512u);
}

static void arguments_that_are_wrong_leave_no_trace(void)
{
    static const jcal_packets_t zero;
    jcal_packets_t never = zero;
    const jcal_packet_t good = packet_at(0, 2);
    jcal_reading_t reading = {.t_us = 7};
    jcal_packets_status_t status;
    const jcal_packet_config_t config = jcal_packet_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_init(NULL, &config, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_init(&packets, NULL, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_init(&packets, &config, NULL, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_push(&never, &good));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_pull(&never, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_get(&never, &status));
    start(4, 2);
    const jcal_packets_t before = packets;
    jcal_packet_t bad[4] = {good, good, good, good};
    bad[0].count = 0;
    bad[1].count = 3;
    bad[2].si = NULL;
    bad[3].si = NULL;
    bad[3].raw = (const int16_t[12]){0};
    for (unsigned k = 0; k < 4; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_push(&packets, &bad[k]));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_push(&packets, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_push(NULL, &good));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_pull(&packets, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_pull(NULL, &reading));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_get(&packets, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_packets_get(NULL, &status));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_packets_pull(&packets, &reading));
    TEST_ASSERT_EQUAL_MEMORY(&before, &packets, sizeof packets);
    TEST_ASSERT_TRUE(reading.t_us == 7);
}

static void assert_wrong(const char *field, const jcal_packet_config_t *config)
{
    TEST_ASSERT_EQUAL_STRING(field, jcal_packet_config_check(config));
    TEST_ASSERT_EQUAL_INT((field == NULL) ? JCAL_OK : JCAL_ERR_CONFIG,
                          jcal_packets_init(&packets, config, storage, sizeof storage));
}

/* A config of which one field is about to be changed. */
static jcal_packet_config_t *fresh(void)
{
    static jcal_packet_config_t config;
    config = jcal_packet_config_default();
    return &config;
}

static void counts_out_of_their_ranges_are_named(void)
{
    static const uint32_t period_ns[4] = {499999u, 1000000001u, 500000u, 1000000000u};
    static const uint8_t bits[4] = {7, 33, 9, 32};
    static const uint8_t per_packet[4] = {0, 17, 1, 16};
    static const uint16_t powers[4] = {1, 512, 2, 256};
    static const uint16_t others[4] = {0, 3, 4, 128};
    for (unsigned k = 0; k < 4; ++k) {
        jcal_packet_config_t *config = fresh();
        config->period_ns = period_ns[k];
        assert_wrong((k < 2) ? "period_ns" : NULL, config);
        config = fresh();
        config->counter_bits = bits[k];
        assert_wrong((k < 2) ? "counter_bits" : NULL, config);
        config = fresh();
        config->per_packet = per_packet[k];
        assert_wrong((k < 2) ? "per_packet" : NULL, config);
        config = fresh();
        config->packets = powers[k];
        assert_wrong((k < 2) ? "packets" : NULL, config);
        config->packets = others[k];
        assert_wrong((k < 2) ? "packets" : NULL, config);
    }
}

static void limits_out_of_their_ranges_are_named(void)
{
    static const float delay_s[4] = {0.019f, 10.1f, 0.02f, 10.0f};
    static const float drift_ppm[4] = {9.9f, NAN, 10.0f, 1000.0f};
    for (unsigned k = 0; k < 4; ++k) {
        jcal_packet_config_t *config = fresh();
        config->max_delay_s = delay_s[k];
        assert_wrong((k < 2) ? "max_delay_s" : NULL, config);
        config = fresh();
        config->max_drift_ppm = drift_ppm[k];
        assert_wrong((k < 2) ? "max_drift_ppm" : NULL, config);
    }
    jcal_packet_config_t *config = fresh();
    config->counter_bits = 8; /* 2.56 s a round */
    assert_wrong("max_delay_s", config);
    config->max_delay_s = 1.28f;
    assert_wrong(NULL, config);
    config->values = (jcal_packet_values_t)2;
    assert_wrong("values", config);
    TEST_ASSERT_EQUAL_STRING("config", jcal_packet_config_check(NULL));
}

static void raw_values_need_a_scale(void)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.values = JCAL_PACKET_RAW;
    assert_wrong("scale.gyr_rad_s", &config);
    config.scale.gyr_rad_s = 1e-3f;
    assert_wrong("scale.acc_m_s2", &config);
    config.scale.acc_m_s2 = NAN;
    assert_wrong("scale.acc_m_s2", &config);
    config.scale.acc_m_s2 = 1e-3f;
    assert_wrong("scale.gyr_rail", &config);
    config.scale.gyr_rail = 1;
    assert_wrong("scale.acc_rail", &config);
    config.scale.acc_rail = 32767;
    assert_wrong(NULL, &config);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(what_is_full_refuses_and_counts);
    RUN_TEST(push_may_come_between_any_two_readings);
    RUN_TEST(push_leaves_the_slot_of_pull_alone);
    RUN_TEST(indices_may_run_over);
    RUN_TEST(raw_values_are_converted_exactly);
    RUN_TEST(floats_are_handed_through_whatever_they_are);
    RUN_TEST(storage_may_lie_anywhere_and_must_be_large_enough);
    RUN_TEST(arguments_that_are_wrong_leave_no_trace);
    RUN_TEST(counts_out_of_their_ranges_are_named);
    RUN_TEST(limits_out_of_their_ranges_are_named);
    RUN_TEST(raw_values_need_a_scale);
    return UNITY_END();
}
