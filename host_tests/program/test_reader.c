/* SPDX-License-Identifier: MIT */
/* The program's reader, fed from memory: exact times, numbers, rows in pieces of any size, failing sources. */
#include "input/csv.h"
#include "input/number.h"
#include "input/recording.h"

#include <unity.h>

#include <math.h>
#include <string.h>

void setUp(void)
{
}

void tearDown(void)
{
}

/* A source of text in pieces; it fails instead of ending if told so. */
typedef struct {
    const char *text;
    size_t piece;
    bool fails;
} memory_t;

static long read_memory(void *context, char *buffer, size_t size)
{
    memory_t *memory = context;
    size_t count = strlen(memory->text);
    count = (count < memory->piece) ? count : memory->piece;
    count = (count < size) ? count : size;
    memcpy(buffer, memory->text, count);
    memory->text += count;
    return (count == 0 && memory->fails) ? -1 : (long)count;
}

static void assert_us(const char *text, int64_t expected)
{
    int64_t us = 0;
    TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_FINITE, number_to_us(text, &us), text);
    TEST_ASSERT_EQUAL_INT64_MESSAGE(expected, us, text);
}

static void times_are_exact(void)
{
    assert_us("0", 0);
    assert_us("-0.000000", 0);
    assert_us("1", 1000000);
    assert_us("+1.5", 1500000);
    assert_us(".5", 500000);
    assert_us("5.", 5000000);
    assert_us("0.1", 100000);
    assert_us("1700000000.123456", 1700000000123456);
    assert_us("1.7e9", 1700000000000000);
    assert_us("1234567e-6", 1234567);
    assert_us("0.0000012e6", 1200000);
    assert_us("00000000000000000000000000000001", 1000000);
    assert_us("0e999999999999", 0);
    assert_us("1e-999999999999", 0);
    assert_us("2305843009213.693952", NUMBER_US_MAX);
    assert_us("-2305843009213.693952", -NUMBER_US_MAX);
}

static void a_half_microsecond_is_rounded_upward(void)
{
    assert_us("0.0000004", 0);
    assert_us("0.0000005", 1);
    assert_us("0.00000049999999999999999", 0);
    assert_us("-0.0000005", 0);
    assert_us("-0.00000050000000000000001", -1);
    assert_us("-0.0000004", 0);
    assert_us("1.0000015", 1000002);
    assert_us("-1.0000015", -1000001);
    assert_us("5e-7", 1);
    assert_us("5e-8", 0);
    assert_us("9e-7", 1);
}

static void times_out_of_range_are_not_finite(void)
{
    static const char *const texts[] = {"2305843009213.693953",
                                        "1e13",
                                        "1e999999999999",
                                        "-1e18",
                                        "9999999999999999999",
                                        "",
                                        "nan",
                                        "-inf",
                                        "Infinity"};
    for (size_t k = 0; k < sizeof texts / sizeof texts[0]; k++) {
        int64_t us = 7;
        TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_NOT_FINITE, number_to_us(texts[k], &us), texts[k]);
        TEST_ASSERT_EQUAL_INT64(7, us);
    }
}

static void text_is_no_number(void)
{
    static const char *const texts[] = {"x",   "1x",    "e5",  ".",   "-",      "+",       "1e", "1e+",
                                        "0x1", "1.2.3", "1 2", "--1", "nan(0)", "infinit", "1,5"};
    for (size_t k = 0; k < sizeof texts / sizeof texts[0]; k++) {
        float value = 7.0f;
        int64_t us = 7;
        TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_NOT_A_NUMBER, number_to_float(texts[k], &value), texts[k]);
        TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_NOT_A_NUMBER, number_to_us(texts[k], &us), texts[k]);
        TEST_ASSERT_EQUAL_FLOAT(7.0f, value);
    }
}

static void floats_are_the_nearest_ones(void)
{
    float value = 0.0f;
    TEST_ASSERT_EQUAL_INT(NUMBER_FINITE, number_to_float("16777217.0000001", &value));
    TEST_ASSERT_TRUE(value == 16777218.0f);
    TEST_ASSERT_EQUAL_INT(NUMBER_FINITE, number_to_float("-9.81", &value));
    TEST_ASSERT_TRUE(value == -9.81f);
    TEST_ASSERT_EQUAL_INT(NUMBER_NOT_FINITE, number_to_float("1e39", &value));
    TEST_ASSERT_TRUE(isinf(value));
    TEST_ASSERT_EQUAL_INT(NUMBER_NOT_FINITE, number_to_float("", &value));
    TEST_ASSERT_TRUE(isnan(value));
}

static void rows_are_the_same_in_pieces_of_any_size(void)
{
    for (size_t piece = 1; piece < 40; piece++) {
        memory_t memory = {"\xEF\xBB\xBF a , \"b \"\"\r\nc\" ,\r\n\r\n\"\",2 3\t\r4", piece, false};
        static csv_t csv;
        csv_open(&csv, read_memory, &memory);
        TEST_ASSERT_EQUAL_INT(CSV_ROW, csv_next(&csv));
        TEST_ASSERT_EQUAL_UINT(3, csv.cell_count);
        TEST_ASSERT_EQUAL_STRING("a", csv.cells[0].text);
        TEST_ASSERT_EQUAL_STRING("b \"\nc", csv.cells[1].text);
        TEST_ASSERT_EQUAL_STRING("", csv.cells[2].text);
        TEST_ASSERT_EQUAL_INT(CSV_ROW, csv_next(&csv));
        TEST_ASSERT_EQUAL_UINT(2, csv.cell_count);
        TEST_ASSERT_EQUAL_STRING("2 3", csv.cells[1].text);
        TEST_ASSERT_EQUAL_UINT64(4, csv.cells[1].line);
        TEST_ASSERT_EQUAL_UINT64(4, csv.cells[1].column);
        TEST_ASSERT_EQUAL_INT(CSV_ROW, csv_next(&csv));
        TEST_ASSERT_EQUAL_STRING("4", csv.cells[0].text);
        TEST_ASSERT_EQUAL_INT(CSV_END, csv_next(&csv));
        TEST_ASSERT_EQUAL_INT(CSV_END, csv_next(&csv));
        csv_close(&csv);
    }
}

static void a_failing_source_is_no_end(void)
{
    static const char *const texts[] = {"", "a,b\n", "a,b", "a,\"b"};
    for (size_t k = 0; k < sizeof texts / sizeof texts[0]; k++) {
        memory_t memory = {texts[k], 100, true};
        static csv_t csv;
        csv_open(&csv, read_memory, &memory);
        csv_event_t event = csv_next(&csv);
        while (event == CSV_ROW) {
            event = csv_next(&csv);
        }
        TEST_ASSERT_EQUAL_INT_MESSAGE(CSV_FAILED, event, texts[k]);
        csv_close(&csv);
    }
}

static void a_recording_keeps_its_times_and_values(void)
{
    memory_t memory = {"acc2_z,t_s,gyr1_x,gyr1_y,gyr1_z,acc1_x,acc1_y,acc1_z,gyr2_x,gyr2_y,gyr2_z,acc2_x,acc2_y\n"
                       "12,-3.5,1,2,3,4,5,6,7,8,9,10,11\n"
                       "12,,1,2,3,4,5,6,7,8,9,10,nan\n",
                       1000, false};
    static recording_t recording;
    recording_row_t row;
    TEST_ASSERT_EQUAL_INT(RECORDING_ROW, recording_open(&recording, read_memory, &memory));
    TEST_ASSERT_EQUAL_INT(RECORDING_ROW, recording_next(&recording, &row));
    TEST_ASSERT_TRUE(row.has_time);
    TEST_ASSERT_EQUAL_INT64(-3500000, row.t_us);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, row.imu1.gyr_rad_s.x);
    TEST_ASSERT_EQUAL_FLOAT(6.0f, row.imu1.acc_m_s2.z);
    TEST_ASSERT_EQUAL_FLOAT(8.0f, row.imu2.gyr_rad_s.y);
    TEST_ASSERT_EQUAL_FLOAT(12.0f, row.imu2.acc_m_s2.z);
    TEST_ASSERT_EQUAL_INT(RECORDING_ROW, recording_next(&recording, &row));
    TEST_ASSERT_FALSE(row.has_time);
    TEST_ASSERT_TRUE(isnan(row.imu2.acc_m_s2.y));
    TEST_ASSERT_EQUAL_INT(RECORDING_END, recording_next(&recording, &row));
    recording_close(&recording);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(times_are_exact);
    RUN_TEST(a_half_microsecond_is_rounded_upward);
    RUN_TEST(times_out_of_range_are_not_finite);
    RUN_TEST(text_is_no_number);
    RUN_TEST(floats_are_the_nearest_ones);
    RUN_TEST(rows_are_the_same_in_pieces_of_any_size);
    RUN_TEST(a_failing_source_is_no_end);
    RUN_TEST(a_recording_keeps_its_times_and_values);
    return UNITY_END();
}
