/* SPDX-License-Identifier: MIT */
/* Which two sensors are told to sit on each other's segment. Two limbs of three joints each on a trunk: sensors 1, 2, 3 and 4, 5, 6. */
#include "body/exchange.h"
#include "body/look.h"
#include "jointcal/body.h"

#include <unity.h>

#include <string.h>

enum { SENSORS = 7, JOINTS = 6 };
enum { SHOULDER_L, ELBOW_L, WRIST_L, SHOULDER_R, ELBOW_R, WRIST_R };

static jcal_body_sensor_t sensor_states[SENSORS];
static jcal_body_joint_t joint_states[JOINTS];
static jcal_body_sensor_spec_t sensors[SENSORS];
static jcal_body_joint_spec_t joints[JOINTS];
static jcal_body_t body;

void setUp(void)
{
    static const uint8_t pairs[JOINTS][2] = {{0u, 1u}, {1u, 2u}, {2u, 3u}, {0u, 4u}, {4u, 5u}, {5u, 6u}};
    static const char *const names[SENSORS] = {"chest",           "left upper arm", "left forearm", "left hand",
                                               "right upper arm", "right forearm",  "right hand"};
    memset(&body, 0, sizeof body);
    memset(sensor_states, 0, sizeof sensor_states);
    memset(joint_states, 0, sizeof joint_states);
    sensor_states[0].joint = JCAL_BODY_NONE;
    for (unsigned s = 0u; s < SENSORS; ++s) {
        sensors[s].name = names[s];
    }
    for (unsigned j = 0u; j < JOINTS; ++j) {
        joints[j].proximal = pairs[j][0];
        joints[j].distal = pairs[j][1];
        joints[j].kind = JCAL_BODY_HINGE;
        joint_states[j].status = (uint8_t)JCAL_READY;
        sensor_states[pairs[j][1]].joint = (uint8_t)j;
    }
    body.table.sensors = sensors;
    body.table.sensor_states = sensor_states;
    body.table.sensor_count = SENSORS;
    body.table.joints = joints;
    body.table.joint_states = joint_states;
    body.table.joint_count = JOINTS;
    body.is_ready = true;
}

void tearDown(void)
{
}

static void doubt(unsigned joint)
{
    joint_states[joint].not_one = true;
    joint_states[joint].status = (uint8_t)JCAL_COLLECTING;
}

/// Both ways round, as the estimator finds them. True if an exchange was told then, `event` has it.
static bool find_both(unsigned a, unsigned b, jcal_body_event_t *event)
{
    unsigned joint = 0u;
    unsigned other = 0u;
    jcal_body_exchange_found(&body, a, joints[b].distal);
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_body_event(&body, event)); /* half is not enough */
    TEST_ASSERT_TRUE(jcal_body_exchange_next(&body, &joint, &other));
    TEST_ASSERT_EQUAL_UINT(b, joint);
    TEST_ASSERT_EQUAL_UINT(joints[a].distal, other);
    jcal_body_exchange_found(&body, joint, other);
    return jcal_body_event(&body, event) == JCAL_OK;
}

static void nothing_is_tried_without_two_joints_in_doubt(void)
{
    unsigned joint = 0u;
    unsigned other = 0u;
    TEST_ASSERT_FALSE(jcal_body_exchange_next(&body, &joint, &other));
    doubt(ELBOW_L);
    doubt(WRIST_L); /* of the same limb */
    TEST_ASSERT_FALSE(jcal_body_exchange_next(&body, &joint, &other));
    doubt(WRIST_R);
    TEST_ASSERT_TRUE(jcal_body_exchange_next(&body, &joint, &other));
    TEST_ASSERT_EQUAL_UINT(WRIST_L, joint); /* as deep as the other wrist; the elbow is not */
    TEST_ASSERT_EQUAL_UINT(6u, other);
}

static void every_pair_gets_its_turn(void)
{
    unsigned joint = 0u;
    unsigned other = 0u;
    unsigned seen = 0u;
    doubt(ELBOW_L);
    doubt(ELBOW_R);
    doubt(WRIST_L);
    doubt(WRIST_R);
    for (unsigned k = 0u; k < 8u; ++k) {
        if (jcal_body_exchange_next(&body, &joint, &other)) {
            TEST_ASSERT_TRUE((joint == ELBOW_L && other == 5u) || (joint == ELBOW_R && other == 2u) ||
                             (joint == WRIST_L && other == 6u) || (joint == WRIST_R && other == 3u));
            seen |= 1u << joint;
        }
    }
    TEST_ASSERT_EQUAL_UINT((1u << ELBOW_L) | (1u << ELBOW_R) | (1u << WRIST_L) | (1u << WRIST_R), seen);
}

static void forearms_are_told_by_elbows_and_wrists(void)
{
    jcal_body_event_t event;
    doubt(ELBOW_L);
    doubt(ELBOW_R);
    doubt(WRIST_L);
    doubt(WRIST_R);
    TEST_ASSERT_TRUE(find_both(ELBOW_L, ELBOW_R, &event));
    TEST_ASSERT_EQUAL_UINT8(JCAL_BODY_EXCHANGED, event.kind);
    TEST_ASSERT_EQUAL_UINT8(5u, event.sensor);
    TEST_ASSERT_EQUAL_UINT8(2u, event.what);
    TEST_ASSERT_TRUE(jcal_body_exchange_explains(&body, WRIST_L));
    TEST_ASSERT_FALSE(jcal_body_exchange_explains(&body, SHOULDER_L));
}

static void what_the_wrists_say_means_the_forearms_too(void)
{
    jcal_body_event_t event;
    doubt(ELBOW_L);
    doubt(WRIST_L);
    doubt(WRIST_R);
    TEST_ASSERT_TRUE(find_both(WRIST_L, WRIST_R, &event));
    TEST_ASSERT_EQUAL_UINT8(5u, event.sensor);
    TEST_ASSERT_EQUAL_UINT8(2u, event.what);
    TEST_ASSERT_TRUE(joint_states[ELBOW_R].not_one); /* ready, but of such a sensor */
}

static void hands_are_told_where_elbows_are_fine(void)
{
    jcal_body_event_t event;
    doubt(WRIST_L);
    doubt(WRIST_R);
    TEST_ASSERT_TRUE(find_both(WRIST_L, WRIST_R, &event));
    TEST_ASSERT_EQUAL_UINT8(6u, event.sensor);
    TEST_ASSERT_EQUAL_UINT8(3u, event.what);
}

static void nothing_is_told_where_neighbours_are_open(void)
{
    jcal_body_event_t event;
    doubt(WRIST_L);
    doubt(WRIST_R);
    joint_states[ELBOW_R].status = (uint8_t)JCAL_COLLECTING;
    TEST_ASSERT_FALSE(find_both(WRIST_L, WRIST_R, &event));
}

static void it_is_told_once_and_said_in_words(void)
{
    jcal_body_event_t event;
    char text[160];
    const jcal_body_advice_t advice = {WRIST_L, JCAL_BODY_NONE, JCAL_HINT_CHECK_SENSORS, JCAL_REASON_NOT_ONE_JOINT};
    doubt(WRIST_L);
    doubt(WRIST_R);
    TEST_ASSERT_TRUE(find_both(WRIST_L, WRIST_R, &event));
    TEST_ASSERT_FALSE(find_both(WRIST_R, WRIST_L, &event));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_sentence(&body, &advice, text, sizeof text));
    TEST_ASSERT_EQUAL_STRING(
        "Exchange the sensors of the left hand and the right hand: each seems to sit on the other's segment.", text);
}

static void a_joint_beside_one_that_is_none_is_doubted_until_that_is_explained(void)
{
    jcal_body_event_t event;
    doubt(WRIST_L);
    doubt(WRIST_R);
    TEST_ASSERT_TRUE(jcal_body_exchange_doubts(&body, ELBOW_L));
    TEST_ASSERT_FALSE(jcal_body_exchange_doubts(&body, SHOULDER_L));
    TEST_ASSERT_TRUE(find_both(WRIST_L, WRIST_R, &event));
    TEST_ASSERT_FALSE(jcal_body_exchange_doubts(&body, ELBOW_L)); /* the hands it is, not the forearm */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(nothing_is_tried_without_two_joints_in_doubt);
    RUN_TEST(every_pair_gets_its_turn);
    RUN_TEST(forearms_are_told_by_elbows_and_wrists);
    RUN_TEST(what_the_wrists_say_means_the_forearms_too);
    RUN_TEST(hands_are_told_where_elbows_are_fine);
    RUN_TEST(nothing_is_told_where_neighbours_are_open);
    RUN_TEST(a_joint_beside_one_that_is_none_is_doubted_until_that_is_explained);
    RUN_TEST(it_is_told_once_and_said_in_words);
    return UNITY_END();
}
