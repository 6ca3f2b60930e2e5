/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of body/events.h: the oldest event first, and those that are dropped are counted.
#include "body/events.h"

#include "unity.h"

#include <string.h>

static jcal_body_events_t events;

void setUp(void)
{
    memset(&events, 0, sizeof events);
}

void tearDown(void)
{
}

static void put(unsigned first, unsigned count)
{
    for (unsigned k = first; k < first + count; ++k) {
        const jcal_body_event_t event = {k, 0.5f * (float)k, 1u, 2u, 3u, 4u};
        jcal_body_events_put(&events, &event);
    }
}

static void take(unsigned first, unsigned count)
{
    for (unsigned k = first; k < first + count; ++k) {
        jcal_body_event_t event;
        TEST_ASSERT_TRUE(jcal_body_events_take(&events, &event));
        TEST_ASSERT_TRUE((k) == (event.t_us));
        TEST_ASSERT_EQUAL_FLOAT(0.5f * (float)k, event.value);
    }
}

static void events_come_out_as_they_went_in(void)
{
    jcal_body_event_t event;
    TEST_ASSERT_FALSE(jcal_body_events_take(&events, &event));
    put(1u, 3u);
    take(1u, 2u);
    put(4u, JCAL_BODY_EVENTS - 1u); /* round the end of the ring */
    take(3u, JCAL_BODY_EVENTS);
    TEST_ASSERT_FALSE(jcal_body_events_take(&events, &event));
    TEST_ASSERT_EQUAL_UINT32(0u, events.dropped);
}

static void the_oldest_are_dropped_and_counted(void)
{
    put(0u, JCAL_BODY_EVENTS + 5u);
    TEST_ASSERT_EQUAL_UINT32(5u, events.dropped);
    take(5u, JCAL_BODY_EVENTS);
    jcal_body_event_t event;
    TEST_ASSERT_FALSE(jcal_body_events_take(&events, &event));
    put(0u, 2u * JCAL_BODY_EVENTS);
    TEST_ASSERT_EQUAL_UINT32(5u + JCAL_BODY_EVENTS, events.dropped);
    take(JCAL_BODY_EVENTS, JCAL_BODY_EVENTS);
}

static void every_kind_has_a_word(void)
{
    TEST_ASSERT_EQUAL_STRING("ready", jcal_body_event_string(JCAL_BODY_READY));
    TEST_ASSERT_EQUAL_STRING("left_ready", jcal_body_event_string(JCAL_BODY_LEFT_READY));
    TEST_ASSERT_EQUAL_STRING("moved", jcal_body_event_string(JCAL_BODY_MOVED));
    TEST_ASSERT_EQUAL_STRING("not_one", jcal_body_event_string(JCAL_BODY_NOT_ONE));
    TEST_ASSERT_EQUAL_STRING("lag_found", jcal_body_event_string(JCAL_BODY_LAG_FOUND));
    TEST_ASSERT_EQUAL_STRING("sensor_bad", jcal_body_event_string(JCAL_BODY_SENSOR_BAD));
    TEST_ASSERT_EQUAL_STRING("sensor_fine", jcal_body_event_string(JCAL_BODY_SENSOR_FINE));
    TEST_ASSERT_EQUAL_STRING("sensor_lost", jcal_body_event_string(JCAL_BODY_SENSOR_LOST));
    TEST_ASSERT_EQUAL_STRING("sensor_back", jcal_body_event_string(JCAL_BODY_SENSOR_BACK));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(events_come_out_as_they_went_in);
    RUN_TEST(the_oldest_are_dropped_and_counted);
    RUN_TEST(every_kind_has_a_word);
    return UNITY_END();
}
