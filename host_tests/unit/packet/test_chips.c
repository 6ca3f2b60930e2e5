/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/chips.h: what data sheets print, and what is not in the table.
#include "jointcal/chips.h"

#include "unity.h"

#include <math.h>
#include <stdbool.h>

/* Sheets print three digits or four, rounded. */
#define PRINTED 2e-3

static const double DEG = 3.14159265358979 / 180.0;
static const double G = 9.80665;

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_share(double limit, double expected, double found)
{
    TEST_ASSERT_TRUE(fabs(found / expected - 1.0) < limit);
}

static void scales_are_what_data_sheets_print(void)
{
    static const struct {
        const char *name;
        float gyr_deg_s, acc_g;
        double lsb_per_deg_s, lsb_per_g;
    } rows[] = {
        {"LSM6DSV", 125.0f, 2.0f, 1000.0 / 4.375, 1000.0 / 0.061},
        {"LSM6DSV", 2000.0f, 16.0f, 1000.0 / 70.0, 1000.0 / 0.488},
        {"LSM6DSV", 4000.0f, 4.0f, 1000.0 / 140.0, 1000.0 / 0.122},
        {"BMI270", 2000.0f, 16.0f, 16.4, 2048.0},
        {"BMI270", 125.0f, 2.0f, 262.4, 16384.0},
        {"ICM-42688", 2000.0f, 16.0f, 16.4, 2048.0},
        {"ICM-42688", 62.5f, 8.0f, 524.3, 4096.0},
        {"ICM-42688", 15.625f, 2.0f, 2097.2, 16384.0},
        {"ICM-20948", 250.0f, 2.0f, 131.0, 16384.0},
        {"ICM-20948", 1000.0f, 4.0f, 32.8, 8192.0},
        {"BHI260", 2000.0f, 8.0f, 16.4, 4096.0},
        {"MPU6050", 500.0f, 16.0f, 65.5, 2048.0},
        {"MPU6050", 250.0f, 2.0f, 131.0, 16384.0},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        jcal_scale_t scale;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chip_scale(rows[k].name, rows[k].gyr_deg_s, rows[k].acc_g, &scale));
        assert_share(PRINTED, DEG / rows[k].lsb_per_deg_s, (double)scale.gyr_rad_s);
        assert_share(PRINTED, G / rows[k].lsb_per_g, (double)scale.acc_m_s2);
        TEST_ASSERT_EQUAL_INT(32767, scale.gyr_rail);
        TEST_ASSERT_EQUAL_INT(32767, scale.acc_rail);
    }
}

static void reports_of_sh2_have_one_scale_and_their_range_is_the_rail(void)
{
    jcal_scale_t scale;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chip_scale("BNO08x", 2000.0f, 8.0f, &scale));
    TEST_ASSERT_TRUE((scale.gyr_rad_s * 512.0f == 1.0f) && (scale.acc_m_s2 * 256.0f == 1.0f));
    assert_share(1e-4, 2000.0 * DEG, (double)scale.gyr_rail * (double)scale.gyr_rad_s);
    assert_share(1e-4, 8.0 * G, (double)scale.acc_rail * (double)scale.acc_m_s2);
}

/* A step is in proportion to the range, and at every range the largest value is at least the range. */
static void every_range_that_the_header_lists_is_there(void)
{
    static const float gyr[] = {4000.0f, 2000.0f, 1000.0f, 500.0f, 250.0f, 125.0f, 62.5f, 31.25f, 15.625f};
    static const float acc[] = {16.0f, 8.0f, 4.0f, 2.0f};
    static const struct {
        const char *name;
        size_t from, to;
    } chips[] = {{"LSM6DSV", 0, 6},   {"BMI270", 1, 6}, {"ICM-42688", 1, 9},
                 {"ICM-20948", 1, 5}, {"BHI260", 1, 6}, {"MPU6050", 1, 5}};
    for (size_t c = 0; c < sizeof chips / sizeof chips[0]; ++c) {
        for (size_t k = 0; k < sizeof gyr / sizeof gyr[0]; ++k) {
            const bool is_there = (k >= chips[c].from) && (k < chips[c].to);
            TEST_ASSERT_EQUAL_INT(is_there, jcal_chip_check(chips[c].name, gyr[k], acc[k % 4]) == NULL);
            jcal_scale_t scale;
            if (is_there) {
                TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chip_scale(chips[c].name, gyr[k], acc[k % 4], &scale));
                TEST_ASSERT_TRUE((double)scale.gyr_rad_s * 32768.0 > 0.999 * DEG * (double)gyr[k]);
                TEST_ASSERT_TRUE((double)scale.acc_m_s2 * 32768.0 > 0.999 * G * (double)acc[k % 4]);
            }
        }
    }
}

static void what_is_not_there_is_named(void)
{
    TEST_ASSERT_NULL(jcal_chip_check("BMI270", 2000.0f, 16.0f));
    TEST_ASSERT_EQUAL_STRING("name", jcal_chip_check(NULL, 2000.0f, 16.0f));
    TEST_ASSERT_EQUAL_STRING("name", jcal_chip_check("", 2000.0f, 16.0f));
    TEST_ASSERT_EQUAL_STRING("name", jcal_chip_check("BMI27", 2000.0f, 16.0f));
    TEST_ASSERT_EQUAL_STRING("name", jcal_chip_check("BMI2700", 2000.0f, 16.0f));
    TEST_ASSERT_EQUAL_STRING("name", jcal_chip_check("a name that is longer than any", 2000.0f, 16.0f));
    TEST_ASSERT_EQUAL_STRING("gyr_range_deg_s", jcal_chip_check("BMI270", 4000.0f, 16.0f));
    TEST_ASSERT_EQUAL_STRING("gyr_range_deg_s", jcal_chip_check("BMI270", 0.0f, 3.0f));
    TEST_ASSERT_EQUAL_STRING("gyr_range_deg_s", jcal_chip_check("BMI270", NAN, 16.0f));
    TEST_ASSERT_EQUAL_STRING("acc_range_g", jcal_chip_check("BMI270", 2000.0f, 32.0f));
    TEST_ASSERT_EQUAL_STRING("acc_range_g", jcal_chip_check("BNO08x", 2000.0f, 0.0f));
}

static void an_error_leaves_the_output_untouched(void)
{
    jcal_scale_t scale = {1.0f, 2.0f, 3, 4};
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chip_scale(NULL, 2000.0f, 16.0f, &scale));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_chip_scale("BMI270", 2000.0f, 16.0f, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_chip_scale("bmi270", 2000.0f, 16.0f, &scale));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_chip_scale("BMI270", 2001.0f, 16.0f, &scale));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_chip_scale("BMI270", 2000.0f, 15.0f, &scale));
    TEST_ASSERT_TRUE((scale.gyr_rad_s == 1.0f) && (scale.acc_m_s2 == 2.0f));
    TEST_ASSERT_TRUE((scale.gyr_rail == 3) && (scale.acc_rail == 4));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(scales_are_what_data_sheets_print);
    RUN_TEST(reports_of_sh2_have_one_scale_and_their_range_is_the_rail);
    RUN_TEST(every_range_that_the_header_lists_is_there);
    RUN_TEST(what_is_not_there_is_named);
    RUN_TEST(an_error_leaves_the_output_untouched);
    return UNITY_END();
}
