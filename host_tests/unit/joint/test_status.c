/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/status.h: every word, and numbers that stand for none.
#include "jointcal/status.h"

#include "unity.h"

#include <limits.h>
#include <string.h>

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

/* Not a value of any enumeration here, yet one that each of their types can hold. */
enum { BEYOND = 100 };

void setUp(void)
{
}

void tearDown(void)
{
}

static void every_call_result_has_a_text_of_its_own(void)
{
    const jcal_status_t all[] = {JCAL_OK,         JCAL_REJECTED,    JCAL_IDLE,     JCAL_TICK,     JCAL_ERR_ARG,
                                 JCAL_ERR_CONFIG, JCAL_ERR_STORAGE, JCAL_ERR_FULL, JCAL_ERR_FLASH};
    for (size_t i = 0; i < COUNT(all); ++i) {
        TEST_ASSERT_NOT_EQUAL(0, strcmp("unknown", jcal_status_string(all[i])));
        for (size_t k = 0; k < i; ++k) {
            TEST_ASSERT_NOT_EQUAL(0, strcmp(jcal_status_string(all[k]), jcal_status_string(all[i])));
        }
    }
    TEST_ASSERT_EQUAL_STRING("ok", jcal_status_string(JCAL_OK));
    TEST_ASSERT_EQUAL_STRING("sample rejected", jcal_status_string(JCAL_REJECTED));
    TEST_ASSERT_EQUAL_STRING("nothing to do", jcal_status_string(JCAL_IDLE));
    TEST_ASSERT_EQUAL_STRING("invalid argument", jcal_status_string(JCAL_ERR_ARG));
    TEST_ASSERT_EQUAL_STRING("config field out of range", jcal_status_string(JCAL_ERR_CONFIG));
    TEST_ASSERT_EQUAL_STRING("storage too small or not aligned", jcal_status_string(JCAL_ERR_STORAGE));
    TEST_ASSERT_EQUAL_STRING("inbox full", jcal_status_string(JCAL_ERR_FULL));
    TEST_ASSERT_EQUAL_STRING("flash failed", jcal_status_string(JCAL_ERR_FLASH));
}

static void success_is_zero_errors_are_negative_and_notices_positive(void)
{
    TEST_ASSERT_EQUAL_INT(0, JCAL_OK);
    TEST_ASSERT_TRUE((JCAL_REJECTED > 0) && (JCAL_IDLE > 0));
    TEST_ASSERT_TRUE((JCAL_ERR_ARG < 0) && (JCAL_ERR_CONFIG < 0) && (JCAL_ERR_STORAGE < 0) && (JCAL_ERR_FULL < 0) &&
                     (JCAL_ERR_FLASH < 0));
}

static void calibration_and_engine_are_words_of_the_output(void)
{
    TEST_ASSERT_EQUAL_STRING("collecting", jcal_calibration_string(JCAL_COLLECTING));
    TEST_ASSERT_EQUAL_STRING("ambiguous", jcal_calibration_string(JCAL_AMBIGUOUS));
    TEST_ASSERT_EQUAL_STRING("ready", jcal_calibration_string(JCAL_READY));
    TEST_ASSERT_EQUAL_STRING("moved", jcal_calibration_string(JCAL_MOVED));
    TEST_ASSERT_EQUAL_STRING("stream", jcal_engine_string(JCAL_ENGINE_STREAM));
    TEST_ASSERT_EQUAL_STRING("window", jcal_engine_string(JCAL_ENGINE_WINDOW));
}

static void weak_and_hint_are_null_for_none_and_words_otherwise(void)
{
    TEST_ASSERT_NULL(jcal_weak_string(JCAL_WEAK_NONE));
    TEST_ASSERT_EQUAL_STRING("axis1", jcal_weak_string(JCAL_WEAK_AXIS1));
    TEST_ASSERT_EQUAL_STRING("axis2", jcal_weak_string(JCAL_WEAK_AXIS2));
    TEST_ASSERT_EQUAL_STRING("sign", jcal_weak_string(JCAL_WEAK_SIGN));
    TEST_ASSERT_EQUAL_STRING("heading", jcal_weak_string(JCAL_WEAK_HEADING));
    TEST_ASSERT_EQUAL_STRING("center1", jcal_weak_string(JCAL_WEAK_CENTER1));
    TEST_ASSERT_EQUAL_STRING("center2", jcal_weak_string(JCAL_WEAK_CENTER2));
    TEST_ASSERT_NULL(jcal_hint_string(JCAL_HINT_NONE));
    TEST_ASSERT_EQUAL_STRING("move_joint", jcal_hint_string(JCAL_HINT_MOVE_JOINT));
    TEST_ASSERT_EQUAL_STRING("move_segment1", jcal_hint_string(JCAL_HINT_MOVE_SEGMENT1));
    TEST_ASSERT_EQUAL_STRING("move_segment2", jcal_hint_string(JCAL_HINT_MOVE_SEGMENT2));
    TEST_ASSERT_EQUAL_STRING("tilt_axis", jcal_hint_string(JCAL_HINT_TILT_AXIS));
    TEST_ASSERT_EQUAL_STRING("check_sensors", jcal_hint_string(JCAL_HINT_CHECK_SENSORS));
    TEST_ASSERT_EQUAL_STRING("more_directions", jcal_hint_string(JCAL_HINT_MORE_DIRECTIONS));
}

static void reasons_are_null_for_none_and_words_otherwise(void)
{
    TEST_ASSERT_NULL(jcal_reason_string(JCAL_REASON_NONE));
    TEST_ASSERT_EQUAL_STRING("no_data", jcal_reason_string(JCAL_REASON_NO_DATA));
    TEST_ASSERT_EQUAL_STRING("no_motion", jcal_reason_string(JCAL_REASON_NO_MOTION));
    TEST_ASSERT_EQUAL_STRING("uncertain", jcal_reason_string(JCAL_REASON_UNCERTAIN));
    TEST_ASSERT_EQUAL_STRING("sign_open", jcal_reason_string(JCAL_REASON_SIGN_OPEN));
    TEST_ASSERT_EQUAL_STRING("other_minimum", jcal_reason_string(JCAL_REASON_OTHER_MINIMUM));
    TEST_ASSERT_EQUAL_STRING("does_not_fit", jcal_reason_string(JCAL_REASON_DOES_NOT_FIT));
    TEST_ASSERT_EQUAL_STRING("bad_samples", jcal_reason_string(JCAL_REASON_BAD_SAMPLES));
    TEST_ASSERT_EQUAL_STRING("wrong_units_gyr", jcal_reason_string(JCAL_REASON_WRONG_UNITS_GYR));
    TEST_ASSERT_EQUAL_STRING("wrong_units_acc", jcal_reason_string(JCAL_REASON_WRONG_UNITS_ACC));
    TEST_ASSERT_EQUAL_STRING("rate_too_low", jcal_reason_string(JCAL_REASON_RATE_TOO_LOW));
    TEST_ASSERT_EQUAL_STRING("gravity_off", jcal_reason_string(JCAL_REASON_GRAVITY_OFF));
    TEST_ASSERT_EQUAL_STRING("not_one_joint", jcal_reason_string(JCAL_REASON_NOT_ONE_JOINT));
    TEST_ASSERT_EQUAL_STRING("no_bend", jcal_reason_string(JCAL_REASON_NO_BEND));
    TEST_ASSERT_EQUAL_STRING("more_axes", jcal_reason_string(JCAL_REASON_MORE_AXES));
    TEST_ASSERT_EQUAL_STRING("sensor_bad", jcal_reason_string(JCAL_REASON_SENSOR_BAD));
    TEST_ASSERT_EQUAL_STRING("out_of_step", jcal_reason_string(JCAL_REASON_OUT_OF_STEP));
    TEST_ASSERT_EQUAL_STRING("move_faster", jcal_hint_string(JCAL_HINT_MOVE_FASTER));
    TEST_ASSERT_EQUAL_STRING("bend_only", jcal_hint_string(JCAL_HINT_BEND_ONLY));
    TEST_ASSERT_EQUAL_STRING("turn_only", jcal_hint_string(JCAL_HINT_TURN_ONLY));
}

static void numbers_that_stand_for_nothing_reach_no_memory_beyond_the_tables(void)
{
    /* Where enumerations are one byte, as on ARM, only the lowest byte arrives: it stands for nothing either. */
    const int beyond[] = {BEYOND, INT_MAX, -BEYOND, INT_MIN + 127, -1};
    for (size_t i = 0; i < COUNT(beyond); ++i) {
        int number = beyond[i]; /* copied by bytes: a cast would be undefined beyond an enumeration's range */
        jcal_calibration_t calibration;
        jcal_engine_t engine;
        jcal_weak_t weak;
        jcal_hint_t hint;
        jcal_reason_t reason;
        memcpy(&calibration, &number, sizeof calibration);
        memcpy(&engine, &number, sizeof engine);
        memcpy(&weak, &number, sizeof weak);
        memcpy(&hint, &number, sizeof hint);
        memcpy(&reason, &number, sizeof reason);
        TEST_ASSERT_EQUAL_STRING("unknown", jcal_calibration_string(calibration));
        TEST_ASSERT_EQUAL_STRING("unknown", jcal_engine_string(engine));
        TEST_ASSERT_NULL(jcal_weak_string(weak));
        TEST_ASSERT_NULL(jcal_hint_string(hint));
        TEST_ASSERT_NULL(jcal_reason_string(reason));
    }
    TEST_ASSERT_EQUAL_STRING("unknown", jcal_status_string((jcal_status_t)BEYOND));
    TEST_ASSERT_EQUAL_STRING("unknown", jcal_status_string((jcal_status_t)-BEYOND));
}

static void the_first_number_after_each_enumeration_is_unknown(void)
{
    TEST_ASSERT_EQUAL_STRING("unknown", jcal_calibration_string((jcal_calibration_t)4));
    TEST_ASSERT_EQUAL_STRING("unknown", jcal_engine_string((jcal_engine_t)2));
    TEST_ASSERT_NULL(jcal_weak_string((jcal_weak_t)7));
    TEST_ASSERT_NULL(jcal_hint_string((jcal_hint_t)10));
    TEST_ASSERT_NULL(jcal_reason_string((jcal_reason_t)17));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_call_result_has_a_text_of_its_own);
    RUN_TEST(success_is_zero_errors_are_negative_and_notices_positive);
    RUN_TEST(calibration_and_engine_are_words_of_the_output);
    RUN_TEST(weak_and_hint_are_null_for_none_and_words_otherwise);
    RUN_TEST(reasons_are_null_for_none_and_words_otherwise);
    RUN_TEST(numbers_that_stand_for_nothing_reach_no_memory_beyond_the_tables);
    RUN_TEST(the_first_number_after_each_enumeration_is_unknown);
    return UNITY_END();
}
