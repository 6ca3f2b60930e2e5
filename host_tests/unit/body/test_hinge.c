/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/body.h with two exact sensors on a made-up hinge, one of which is told late.
#include "unit/body/fixture.h"

#include "math/sphere.h"

enum { KINDS = 9 };

static body_fixture_t f;
static hinge_t hinge;
static double late_s; /* of sensor 1's times */
static unsigned told[KINDS];
static jcal_body_event_t last[KINDS];

void setUp(void)
{
    memset(told, 0, sizeof told);
    hinge = hinge_usual();
    hinge.rest_s = 1.0;
    late_s = 0.08;
    body_fill(&f, 2u);
    body_begin(&f);
}

void tearDown(void)
{
}

static void note_events(void)
{
    jcal_body_event_t event;
    while (jcal_body_event(&f.body, &event) == JCAL_OK) {
        TEST_ASSERT_TRUE(event.kind < KINDS);
        told[event.kind] += 1u;
        last[event.kind] = event;
    }
}

/* One period of the hub. A reading that is told late is one of before. */
static void play(uint32_t k)
{
    const uint64_t now_us = 777000u + (uint64_t)k * BODY_PERIOD_US;
    const double t = 0.01 * k;
    float values[6];
    body_read_at(&hinge, t, 0u, values);
    body_send(&f, 0u, now_us, values);
    body_read_at(&hinge, t - late_s, 1u, values);
    body_send(&f, 1u, now_us, values);
    (void)body_work(&f, now_us);
    note_events();
}

/* The angle less the true one, at the common time of sensor 0; NaN while there is none. */
static double angle_off(void)
{
    const jcal_body_joint_result_t joint = body_joint(&f, 0u);
    const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
    const float sign = (jcal_vec3_dot(joint.axis1, true1) < 0.0f) ? -1.0f : 1.0f;
    const double t = 1e-6 * ((double)body_sensor(&f, 0u).t_us - 777000.0);
    return (double)(sign * joint.flexion_rad) - hinge_angle(&hinge, t);
}

/* The lag is found and taken off, and only then the joint is ready: with the axes and the angle that it has. */
static void a_late_sensor_is_brought_into_step_and_the_joint_ready(void)
{
    const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
    const jcal_vec3_t true2 = hinge_axis(&hinge, 2, 0.0);
    double zero = 0.0;
    unsigned compared = 0u;
    for (uint32_t k = 0u; k < 4000u; ++k) {
        play(k);
        const jcal_body_joint_result_t joint = body_joint(&f, 0u);
        if (joint.head.status != JCAL_READY) {
            TEST_ASSERT_TRUE(isnan(joint.flexion_rad));
            continue;
        }
        TEST_ASSERT_TRUE(joint.lag_known);
        const float sign = (jcal_vec3_dot(joint.axis1, true1) < 0.0f) ? -1.0f : 1.0f;
        TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(joint.axis1, sign), true1) < joint.uncertainty1_rad);
        TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(joint.axis2, sign), true2) < joint.uncertainty2_rad);
        /* The angle of the common time, which sensor 2 has reached late. */
        const double t = 1e-6 * ((double)body_sensor(&f, 0u).t_us - 777000.0);
        TEST_ASSERT_DOUBLE_WITHIN(0.03, 0.01 * k - late_s, t);
        const double off = angle_off();
        zero = (compared++ == 0u) ? off : zero;
        TEST_ASSERT_DOUBLE_WITHIN(2.5 * HINGE_DEG, 0.0, remainder(off - zero, 2.0 * MOTION_PI));
    }
    const jcal_body_joint_result_t joint = body_joint(&f, 0u);
    TEST_ASSERT_DOUBLE_WITHIN((double)joint.lag_bound_s, late_s, (double)joint.lag_s);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, late_s, (double)body_sensor(&f, 1u).shift_s);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, body_sensor(&f, 0u).shift_s);
    TEST_ASSERT_TRUE(compared > 500u);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_LAG_FOUND]);
    TEST_ASSERT_EQUAL_FLOAT(joint.lag_s, last[JCAL_BODY_LAG_FOUND].value);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_READY]);
    TEST_ASSERT_TRUE(last[JCAL_BODY_READY].t_us >= last[JCAL_BODY_LAG_FOUND].t_us);
    TEST_ASSERT_EQUAL_UINT(2u, told[JCAL_BODY_SENSOR_BACK]);
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_SENSOR_BAD] + told[JCAL_BODY_MOVED] + told[JCAL_BODY_SENSOR_LOST]);
}

/* A gap of one sensor: its heading is another afterwards. No angle is told until the joint knows it, and then the right one. */
static void after_a_gap_there_is_no_angle_until_the_heading_is_known(void)
{
    late_s = 0.0;
    double zero = 0.0;
    for (uint32_t k = 0u; k < 3000u; ++k) {
        play(k);
        zero += (k >= 2800u) ? (angle_off() / 200.0) : 0.0;
    }
    for (uint32_t k = 3000u; k < 3060u; ++k) { /* 0.6 s without sensor 1 */
        float values[6];
        body_read_at(&hinge, 0.01 * k, 0u, values);
        body_send(&f, 0u, 777000u + (uint64_t)k * BODY_PERIOD_US, values);
        (void)body_work(&f, 777000u + (uint64_t)k * BODY_PERIOD_US);
    }
    f.counter[1] += 60u;
    unsigned without = 0u;
    for (uint32_t k = 3060u; k < 4500u; ++k) {
        play(k);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, body_joint(&f, 0u).head.status);
        const double off = angle_off();
        if (isnan(off)) {
            without += 1u;
        } else {
            TEST_ASSERT_TRUE(body_joint(&f, 0u).heading.known);
            TEST_ASSERT_DOUBLE_WITHIN(2.5 * HINGE_DEG, 0.0, remainder(off - zero, 2.0 * MOTION_PI));
        }
    }
    TEST_ASSERT_TRUE(without >= 300u); /* filters settle for three seconds */
    TEST_ASSERT_TRUE(without <= 900u);
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_LEFT_READY] + told[JCAL_BODY_MOVED] + told[JCAL_BODY_SENSOR_LOST]);
}

/* The second sensor is on somebody else: the lag is looked for in vain, and it is told; nothing is ever ready. */
static void two_sensors_that_share_no_joint_are_told(void)
{
    static hinge_t other;
    other = hinge_usual();
    other.pace = 0.83;
    for (uint32_t k = 0u; k < 7000u; ++k) {
        const uint64_t now_us = 777000u + (uint64_t)k * BODY_PERIOD_US;
        const hinge_t own = hinge;
        float values[6];
        body_read_at(&hinge, 0.01 * k, 0u, values);
        body_send(&f, 0u, now_us, values);
        hinge = other;
        body_read_at(&hinge, 0.01 * k + 3.0, 1u, values);
        hinge = own;
        body_send(&f, 1u, now_us, values);
        (void)body_work(&f, now_us);
        note_events();
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, body_joint(&f, 0u).head.status);
    }
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_LAG_FOUND]);
    TEST_ASSERT_TRUE(told[JCAL_BODY_NOT_ONE] > 0u);
    TEST_ASSERT_EQUAL_UINT8(0u, last[JCAL_BODY_NOT_ONE].joint);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, body_joint(&f, 0u).head.reason);
    jcal_body_advice_t advice;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_advice(&f.body, &advice));
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, advice.hint);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_late_sensor_is_brought_into_step_and_the_joint_ready);
    RUN_TEST(after_a_gap_there_is_no_angle_until_the_heading_is_known);
    RUN_TEST(two_sensors_that_share_no_joint_are_told);
    return UNITY_END();
}
