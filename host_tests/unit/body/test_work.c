/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/body.h: the budget of work, who is next, lags down the tree, and what is advised.
#include "unit/body/fixture.h"

#include "body/tree.h"

enum { SENSORS = 4, JOINTS = 3 };

static body_fixture_t f;
static hinge_t hinge;

void setUp(void)
{
    hinge = hinge_usual();
    body_fill(&f, SENSORS);
    body_begin(&f);
}

void tearDown(void)
{
}

static uint64_t hub_time(uint32_t k)
{
    return 1000000u + (uint64_t)k * BODY_PERIOD_US;
}

/* Sensors 0 and 1 are on a hinge; 2 and 3 go the same ways, so that every joint has work. */
static void send_all(uint32_t k)
{
    for (unsigned s = 0u; s < SENSORS; ++s) {
        hinge_sensor_t read;
        float values[6];
        hinge_sensor(&hinge, 0.01 * k, (int)(s % 2u) + 1, &read);
        for (unsigned i = 0u; i < 3u; ++i) {
            values[i] = (float)(read.gyr[i] + 1e-3 * sin(11.0 * k + s + i));
            values[i + 3u] = (float)read.force[i];
        }
        body_send(&f, s, hub_time(k), values);
    }
}

/* However few units there are: never more are used, and what a step leaves the next one does. */
static void no_step_uses_more_than_it_was_handed(void)
{
    uint64_t used = 0u;
    for (uint32_t k = 0u; k < 500u; ++k) {
        const unsigned units = k % 67u;
        send_all(k);
        const jcal_status_t status = jcal_body_step(&f.body, hub_time(k), units);
        const uint64_t now = body_status(&f).units;
        TEST_ASSERT_TRUE((now - used) <= units);
        TEST_ASSERT_TRUE((status == JCAL_IDLE) || ((now - used + JCAL_BODY_UNITS_MIN) > units));
        used = now;
        if (units < JCAL_BODY_UNITS_MIN) {
            TEST_ASSERT_EQUAL_INT(JCAL_OK, status);
        }
    }
    (void)body_work(&f, hub_time(499u));
    for (unsigned s = 0u; s < SENSORS; ++s) {
        const jcal_body_sensor_result_t sensor = body_sensor(&f, s);
        TEST_ASSERT_EQUAL_UINT32(500u, sensor.packets.readings + sensor.packets.overruns);
        TEST_ASSERT_EQUAL_UINT32(body_status(&f).rounds, sensor.samples + sensor.missed);
    }
}

/* With half of the units that are needed readings overrun, which is counted, and slices are done all the same, as many of each joint. */
static void too_few_units_starve_nobody(void)
{
    for (uint32_t k = 0u; k < 1000u; ++k) {
        for (unsigned s = 0u; s < SENSORS; ++s) {
            const float values[6] = {(float)(k % 7u), 0.1f * (float)(k % 3u), 1.0f, (float)(k % 5u), (float)s, 9.81f};
            const jcal_packet_t packet = {hub_time(k), k, 1u, NULL, values};
            (void)jcal_body_push(&f.body, s, &packet);
        }
        (void)jcal_body_step(&f.body, hub_time(k), 7u);
    }
    uint32_t overruns = 0u;
    for (unsigned s = 0u; s < SENSORS; ++s) {
        overruns += body_sensor(&f, s).packets.overruns;
    }
    TEST_ASSERT_TRUE(overruns > 0u);
    TEST_ASSERT_TRUE(body_status(&f).rounds > 100u);
    for (unsigned j = 0u; j < JOINTS; ++j) {
        TEST_ASSERT_TRUE(body_joint(&f, j).head.samples > 10u);
        TEST_ASSERT_TRUE(f.hinges[j].slice != 0u); /* it has got somewhere */
    }
}

/* Three joints with as much to do each: one slice of each in turn. */
static void joints_take_turns(void)
{
    (void)body_work(&f, 0u); /* looks at the beginning */
    for (uint32_t k = 1u; k < 60u; ++k) {
        const jcal_tick_t tick1 = hinge_tick(&hinge, 0.05 * k, 1, 50000u * k);
        const jcal_tick_t tick2 = hinge_tick(&hinge, 0.05 * k, 2, 50000u * k);
        for (unsigned j = 0u; j < JOINTS; ++j) {
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&f.hinges[j], &tick1, &tick2));
            f.joint_states[j].due = true;
            f.body.slices_due = true;
        }
    }
    const float credit = f.hinges[0].credit;
    TEST_ASSERT_TRUE(credit >= 8.0f);
    unsigned done[JOINTS] = {0u, 0u, 0u};
    for (unsigned k = 0u; k < 21u; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_step(&f.body, 0u, 4u)); /* room for one slice of two units */
        unsigned most = 0u;
        unsigned least = 100u;
        for (unsigned j = 0u; j < JOINTS; ++j) {
            done[j] = (unsigned)(credit - f.hinges[j].credit + 0.5f);
            most = (done[j] > most) ? done[j] : most;
            least = (done[j] < least) ? done[j] : least;
        }
        TEST_ASSERT_EQUAL_UINT(k + 1u, done[0] + done[1] + done[2]);
        TEST_ASSERT_TRUE(most <= (least + 1u));
    }
}

/* 0 - 1 - 2, and 3 hangs on 0: a lag of the joint 0 - 1 is one of sensors 1 and 2, and of nobody else. */
static void a_lag_goes_down_the_tree(void)
{
    f.joints[2].proximal = 0u;
    body_begin(&f);
    for (uint32_t k = 0u; k < 800u; ++k) {
        send_all(k);
        (void)body_work(&f, hub_time(k));
    }
    const uint32_t samples = body_sensor(&f, 1u).samples;
    TEST_ASSERT_TRUE(jcal_body_shift(&f.body, 0u, 0.1f));
    for (uint32_t k = 800u; k < 1350u; ++k) {
        send_all(k);
        (void)body_work(&f, hub_time(k));
    }
    const float expected[SENSORS] = {0.0f, 0.1f, 0.1f, 0.0f};
    for (unsigned s = 0u; s < SENSORS; ++s) {
        const bool is_shifted = expected[s] > 0.0f;
        TEST_ASSERT_EQUAL_FLOAT(expected[s], body_sensor(&f, s).shift_s);
        /* a hole that its stage sees, and ticks at the times of all others */
        TEST_ASSERT_EQUAL_UINT32(is_shifted ? 2u : 1u, jcal_sensor_tick(&f.sensor_states[s].stage)->epoch);
        TEST_ASSERT_TRUE(jcal_sensor_tick(&f.sensor_states[0].stage)->t_us ==
                         jcal_sensor_tick(&f.sensor_states[s].stage)->t_us);
    }
    TEST_ASSERT_TRUE(body_sensor(&f, 1u).samples <= samples + 550u - 30u);
    TEST_ASSERT_TRUE(body_sensor(&f, 1u).samples >= samples + 550u - 50u);
    /* more than 20 ms: the joint began anew, the others did not */
    TEST_ASSERT_TRUE(body_joint(&f, 0u).head.samples <
                     20u); /* 0.4 s of the last 5.5: a hole, and filters that settle */
    TEST_ASSERT_TRUE(body_joint(&f, 1u).head.samples > 40u);
    TEST_ASSERT_TRUE(body_joint(&f, 2u).head.samples > 100u);
}

/* What was taken off counts in all: a joint begins anew when it is more than 20 ms, also in two steps. */
static void small_lags_add_up(void)
{
    for (uint32_t k = 0u; k < 700u; ++k) {
        send_all(k);
        (void)body_work(&f, hub_time(k));
    }
    const uint32_t kept = body_joint(&f, 1u).head.samples;
    TEST_ASSERT_TRUE(kept > 20u);
    TEST_ASSERT_TRUE(jcal_body_shift(&f.body, 1u, -0.015f));
    TEST_ASSERT_EQUAL_UINT32(kept, body_joint(&f, 1u).head.samples);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, body_sensor(&f, 1u).shift_s);
    TEST_ASSERT_EQUAL_FLOAT(-0.015f, body_sensor(&f, 2u).shift_s);
    TEST_ASSERT_TRUE(jcal_body_shift(&f.body, 1u, -0.015f));
    TEST_ASSERT_EQUAL_UINT32(0u, body_joint(&f, 1u).head.samples);
    TEST_ASSERT_EQUAL_FLOAT(-0.03f, body_sensor(&f, 3u).shift_s);
}

/* A sensor further down would be shifted too far: nobody is. */
static void a_lag_that_is_too_large_in_all_is_refused(void)
{
    TEST_ASSERT_TRUE(jcal_body_shift(&f.body, 2u, 0.25f));
    TEST_ASSERT_FALSE(jcal_body_shift(&f.body, 0u, 0.06f));
    TEST_ASSERT_EQUAL_UINT32(1u, body_status(&f).lags_refused);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, body_sensor(&f, 1u).shift_s);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, body_sensor(&f, 3u).shift_s);
    TEST_ASSERT_TRUE(jcal_body_shift(&f.body, 0u, 0.05f));
    TEST_ASSERT_EQUAL_FLOAT(0.3f, body_sensor(&f, 3u).shift_s);
    TEST_ASSERT_FALSE(jcal_body_shift(&f.body, 1u, 0.001f));
    TEST_ASSERT_TRUE(jcal_body_shift(&f.body, 1u, -0.35f)); /* sensor 2 at -0.3, sensor 3 at -0.05 */
    TEST_ASSERT_FALSE(jcal_body_shift(&f.body, 2u, -0.26f));
    TEST_ASSERT_EQUAL_UINT32(3u, body_status(&f).lags_refused);
}

static void a_joint_is_held_back_until_its_lag_is_known(void)
{
    f.joint_states[0].lag_known = true;
    f.hinges[0].verdict.status = (uint8_t)JCAL_READY;
    f.hinges[0].verdict.reason = (uint8_t)JCAL_REASON_NONE;
    f.hinges[1].verdict = f.hinges[0].verdict;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, body_joint(&f, 0u).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_OUT_OF_STEP, body_joint(&f, 1u).head.reason);
    f.sensor_states[1].bad = 4u;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SENSOR_BAD, body_joint(&f, 0u).head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SENSOR_BAD, body_joint(&f, 1u).head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, body_joint(&f, 2u).head.reason);
    f.sensor_states[1].bad = 0u;
    f.body.table.shared = NULL; /* sensors share one clock */
    TEST_ASSERT_EQUAL_INT(JCAL_READY, body_joint(&f, 1u).head.status);
    TEST_ASSERT_TRUE(body_joint(&f, 1u).lag_known);
}

static void says(const char *expected)
{
    jcal_body_advice_t advice;
    char text[120];
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_advice(&f.body, &advice));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_sentence(&f.body, &advice, text, sizeof text));
    TEST_ASSERT_EQUAL_STRING(expected, text);
}

static void set(unsigned joint, jcal_calibration_t status, jcal_reason_t reason, jcal_hint_t hint)
{
    f.joint_states[joint].lag_known = true;
    f.hinges[joint].verdict.status = (uint8_t)status;
    f.hinges[joint].verdict.reason = (uint8_t)reason;
    f.hinges[joint].verdict.hint = (uint8_t)hint;
}

/* The most urgent first: a bad sensor, a joint that is none, the first of the table. */
static void advice_is_for_a_person(void)
{
    f.joints[1].name = "left knee";
    f.sensors[2].name = "left shank";
    says("Bend and stretch the joint 0.");
    set(0u, JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    set(1u, JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, JCAL_HINT_TILT_AXIS);
    set(2u, JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, JCAL_HINT_MOVE_FASTER);
    says("Move the left knee while its axis is not level, lying on the side, say.");
    set(2u, JCAL_COLLECTING, JCAL_REASON_NOT_ONE_JOINT, JCAL_HINT_CHECK_SENSORS);
    says("Move the left knee while its axis is not level, lying on the side, say.");
    f.joint_states[2].not_one = true; /* it was for long, and no lag is to blame */
    says("Check the two sensors of the joint 2: is each on its segment, and the right way in its strap?");
    f.sensor_states[2].bad = 4u;
    says("Check the sensor on the left shank: it is faulty or set up wrongly.");
    f.sensor_states[2].bad = 0u;
    f.joint_states[2].not_one = false;
    set(1u, JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    says("Bend and stretch the joint 2."); /* a lag that is not known yet looks the same */
    set(2u, JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    says("Nothing is to be done.");
}

static void every_hint_has_a_sentence(void)
{
    static const char *const expected[10] = {
        "Move the joint 1.",
        "Bend and stretch the joint 1.",
        "Turn the segment above the joint 1.",
        "Turn the segment below the joint 1.",
        "Move the joint 1 while its axis is not level, lying on the side, say.",
        "Check the two sensors of the joint 1: is each on its segment, and the right way in its strap?",
        "Move the joint 1 in other directions too.",
        "Move the joint 1 faster, walking, say.",
        "Bend and stretch the joint 1 for ten seconds, without turning the segment below it.",
        "Turn the segment below the joint 1 about its own line for ten seconds, without bending."};
    char text[120];
    for (unsigned k = 0u; k < 10u; ++k) {
        const jcal_body_advice_t advice = {1u, JCAL_BODY_NONE, (jcal_hint_t)k, JCAL_REASON_UNCERTAIN};
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_sentence(&f.body, &advice, text, sizeof text));
        TEST_ASSERT_EQUAL_STRING(expected[k], text);
    }
    const jcal_body_advice_t sensor = {1u, 3u, JCAL_HINT_CHECK_SENSORS, JCAL_REASON_SENSOR_BAD};
    TEST_ASSERT_EQUAL_INT(JCAL_OK,
                          jcal_body_sentence(&f.body, &sensor, text, 12u)); /* what finds no room is left out */
    TEST_ASSERT_EQUAL_STRING("Check the s", text);
    const jcal_body_advice_t wrong[2] = {{3u, JCAL_BODY_NONE, JCAL_HINT_NONE, JCAL_REASON_NONE},
                                         {0u, 4u, JCAL_HINT_NONE, JCAL_REASON_NONE}};
    for (unsigned k = 0u; k < 2u; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_sentence(&f.body, &wrong[k], text, sizeof text));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_sentence(&f.body, &sensor, text, 0u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_sentence(&f.body, &sensor, NULL, 9u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(no_step_uses_more_than_it_was_handed);
    RUN_TEST(too_few_units_starve_nobody);
    RUN_TEST(joints_take_turns);
    RUN_TEST(a_lag_goes_down_the_tree);
    RUN_TEST(small_lags_add_up);
    RUN_TEST(a_lag_that_is_too_large_in_all_is_refused);
    RUN_TEST(a_joint_is_held_back_until_its_lag_is_known);
    RUN_TEST(advice_is_for_a_person);
    RUN_TEST(every_hint_has_a_sentence);
    return UNITY_END();
}
