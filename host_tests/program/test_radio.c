/* SPDX-License-Identifier: MIT */
/* Packets of a wireless sensor from rows: its clock, gaps, losses, bursts, order; each from what it means, not from what came out. */
#include "run/radio.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define ROWS 3000
#define ROW_US 10000

static radio_t radio;

static const radio_config_t PLAIN = {.per_packet = 4, .gyr_step = 0.001f, .acc_step = 0.01f, .seed = 1};

void setUp(void)
{
    memset(&radio, 0, sizeof radio);
}

void tearDown(void)
{
    radio_free(&radio);
}

/* Every component grows by one step a row, from its own number on; rows from `gap` on are later by `gap_us`. */
static void add_rows(int count, int gap, int64_t gap_us)
{
    for (int k = 0; k < count; k++) {
        radio_row_t row = {.t_us = 5000000 + (int64_t)k * ROW_US + ((k >= gap) ? gap_us : 0)};
        for (int c = 0; c < RADIO_VALUES; c++) {
            row.values[c] = (float)(k + c) * ((c < 3) ? 0.001f : 0.01f);
        }
        TEST_ASSERT_TRUE(radio_add(&radio, &row));
    }
}

static void rows_come_back_as_they_were(void)
{
    add_rows(10, ROWS, 0);
    TEST_ASSERT_TRUE(radio_make(&radio, &PLAIN));
    TEST_ASSERT_EQUAL_UINT32(10, radio.readings);
    TEST_ASSERT_EQUAL_UINT32(3, radio.packet_count);
    const uint8_t counts[] = {4, 4, 2};
    for (unsigned k = 0; k < 3; k++) {
        const radio_packet_t *packet = &radio.packets[k];
        TEST_ASSERT_EQUAL_UINT8(counts[k], packet->count);
        TEST_ASSERT_EQUAL_UINT32((radio.packets[0].counter + 4u * k) & 0xFFFFu, packet->counter);
        TEST_ASSERT_EQUAL_INT64(5000000 + (int64_t)(4u * k + counts[k] - 1u) * ROW_US, packet->arrival_us);
        for (int c = 0; c < RADIO_VALUES; c++) {
            TEST_ASSERT_EQUAL_INT16((int)(4u * k) + c, radio.raw[packet->first][c]);
        }
    }
}

static void a_slow_clock_reads_less_often(void)
{
    add_rows(ROWS, ROWS, 0);
    radio_config_t config = PLAIN;
    config.per_packet = 1;
    config.clock_ppm = 500.0;
    TEST_ASSERT_TRUE(radio_make(&radio, &config));
    /* 2999 periods of the rows are 2997.5 of the sensor's. */
    TEST_ASSERT_EQUAL_UINT32(2998, radio.readings);
    const radio_packet_t *last = &radio.packets[radio.packet_count - 1u];
    TEST_ASSERT_EQUAL_INT64(5000000 + 29984985, last->arrival_us);
    /* The values grow with the time, by one each 10 ms: 2998.4985 then. */
    TEST_ASSERT_EQUAL_INT16(2998, radio.raw[last->first][0]);
}

static void missing_rows_are_counted_by_the_counter(void)
{
    add_rows(20, 9, 5 * ROW_US);
    TEST_ASSERT_TRUE(radio_make(&radio, &PLAIN));
    TEST_ASSERT_EQUAL_UINT32(20, radio.readings);
    TEST_ASSERT_EQUAL_UINT32(5, radio.missing);
    TEST_ASSERT_EQUAL_UINT8(1, radio.packets[2].count); /* the ninth row alone: no packet spans a gap */
    TEST_ASSERT_EQUAL_UINT32((radio.packets[0].counter + 14u) & 0xFFFFu, radio.packets[3].counter);
}

static void times_that_are_rounded_make_an_even_clock(void)
{
    for (int k = 0; k < ROWS; k++) { /* 120 Hz in whole milliseconds: 8, 8, 9 ... */
        const radio_row_t row = {.t_us = ((int64_t)k * 1000 + 60) / 120 * 1000};
        TEST_ASSERT_TRUE(radio_add(&radio, &row));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 1e6 / 120.0, radio_period_us(&radio));
    TEST_ASSERT_TRUE(radio_make(&radio, &PLAIN));
    TEST_ASSERT_EQUAL_UINT32(ROWS, radio.readings);
    TEST_ASSERT_EQUAL_UINT32(0, radio.missing);
}

static void what_is_beyond_the_range_is_clipped_and_counted(void)
{
    add_rows(8, ROWS, 0);
    radio.rows[2].values[0] = 40.0f;
    radio.rows[5].values[4] = -1000.0f;
    TEST_ASSERT_TRUE(radio_make(&radio, &PLAIN));
    TEST_ASSERT_EQUAL_UINT32(2, radio.clipped);
    TEST_ASSERT_EQUAL_INT16(32767, radio.raw[2][0]);
    TEST_ASSERT_EQUAL_INT16(-32767, radio.raw[5][4]);
}

static void a_row_without_a_value_is_no_reading(void)
{
    add_rows(8, ROWS, 0);
    radio.rows[3].values[1] = NAN;
    TEST_ASSERT_TRUE(radio_make(&radio, &PLAIN));
    TEST_ASSERT_EQUAL_UINT32(7, radio.readings);
    TEST_ASSERT_EQUAL_UINT32(1, radio.missing);
}

static void so_many_of_a_hundred_get_lost(void)
{
    add_rows(ROWS, ROWS, 0);
    radio_config_t config = PLAIN;
    config.per_packet = 1;
    config.loss = 0.2;
    TEST_ASSERT_TRUE(radio_make(&radio, &config));
    TEST_ASSERT_EQUAL_UINT32(ROWS, radio.lost + radio.packet_count);
    /* 600, with a standard deviation of 22. */
    TEST_ASSERT_UINT32_WITHIN(90, 600, radio.lost);
}

static void bursts_have_their_length(void)
{
    add_rows(ROWS, ROWS, 0);
    radio_config_t config = PLAIN;
    config.per_packet = 1;
    config.burst_s = 2.0;
    config.sensor = 3;
    TEST_ASSERT_TRUE(radio_make(&radio, &config));
    unsigned bursts = 0;
    for (uint32_t k = 1; k < radio.packet_count; k++) {
        const int64_t silent_us = radio.packets[k].arrival_us - radio.packets[k - 1u].arrival_us;
        if (silent_us != ROW_US) {
            TEST_ASSERT_INT64_WITHIN(ROW_US, 2000000, silent_us);
            bursts++;
        }
    }
    /* 15 to 45 s apart: one at the least would begin within 30 s but for bad luck, two at the most. */
    TEST_ASSERT_UINT_WITHIN(1, 1, bursts);
    TEST_ASSERT_UINT32_WITHIN(2, 200u * bursts, radio.lost);
}

static void packets_of_a_sensor_keep_their_order(void)
{
    add_rows(ROWS, ROWS, 0);
    radio_config_t config = PLAIN;
    config.per_packet = 1;
    config.delay_us = 3000.0;
    config.jitter_us = 50000.0;
    TEST_ASSERT_TRUE(radio_make(&radio, &config));
    int64_t longest = 0;
    for (uint32_t k = 0; k < radio.packet_count; k++) {
        const int64_t under_way = radio.packets[k].arrival_us - 5000000 - (int64_t)k * ROW_US;
        TEST_ASSERT_TRUE(under_way >= 3000 && under_way <= 53000);
        TEST_ASSERT_TRUE(k == 0 || radio.packets[k].arrival_us >= radio.packets[k - 1u].arrival_us);
        longest = (under_way > longest) ? under_way : longest;
    }
    TEST_ASSERT_TRUE(longest > 50000);
}

static void one_setting_does_not_change_what_another_does(void)
{
    add_rows(400, ROWS, 0);
    radio_config_t config = PLAIN;
    config.loss = 0.3;
    TEST_ASSERT_TRUE(radio_make(&radio, &config));
    const uint32_t lost = radio.lost;
    const uint32_t counter = radio.packets[7].counter;
    radio_free(&radio);
    add_rows(400, ROWS, 0);
    config.jitter_us = 20000.0;
    TEST_ASSERT_TRUE(radio_make(&radio, &config));
    TEST_ASSERT_EQUAL_UINT32(lost, radio.lost);
    TEST_ASSERT_EQUAL_UINT32(counter, radio.packets[7].counter);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(rows_come_back_as_they_were);
    RUN_TEST(a_slow_clock_reads_less_often);
    RUN_TEST(missing_rows_are_counted_by_the_counter);
    RUN_TEST(times_that_are_rounded_make_an_even_clock);
    RUN_TEST(what_is_beyond_the_range_is_clipped_and_counted);
    RUN_TEST(a_row_without_a_value_is_no_reading);
    RUN_TEST(so_many_of_a_hundred_get_lost);
    RUN_TEST(bursts_have_their_length);
    RUN_TEST(packets_of_a_sensor_keep_their_order);
    RUN_TEST(one_setting_does_not_change_what_another_does);
    return UNITY_END();
}
