/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of body/trust.h: what is believed of what an engine says.
#include "body/trust.h"

#include "unity.h"

#include <string.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static jcal_head_t head_of(jcal_calibration_t status)
{
    jcal_head_t head;
    memset(&head, 0, sizeof head);
    head.status = status;
    head.reason = (status == JCAL_READY) ? JCAL_REASON_NONE : JCAL_REASON_NO_BEND;
    head.hint = (status == JCAL_READY) ? JCAL_HINT_NONE : JCAL_HINT_TILT_AXIS;
    head.samples = 7u;
    return head;
}

static const jcal_calibration_t all[4] = {JCAL_COLLECTING, JCAL_AMBIGUOUS, JCAL_READY, JCAL_MOVED};

/* Nothing speaks against the sensors: not a bit of the head changes. */
static void an_engine_is_believed_that_reads_good_sensors(void)
{
    const jcal_trust_t good = {0u, 0u, false, true};
    for (size_t k = 0u; k < 4u; ++k) {
        const jcal_head_t before = head_of(all[k]);
        jcal_head_t head = before;
        jcal_trust(&good, &head);
        TEST_ASSERT_EQUAL_MEMORY(&before, &head, sizeof head);
    }
}

static void a_bad_sensor_stands_above_everything(void)
{
    const jcal_trust_t of[4] = {
        {1u << 4, 0u, false, true}, {0u, 1u << 7, true, true}, {0u, 1u, true, false}, {8u, 8u, false, false}};
    for (size_t k = 0u; k < 4u; ++k) {
        for (size_t i = 0u; i < 4u; ++i) {
            jcal_head_t head = head_of(all[k]);
            jcal_trust(&of[i], &head);
            TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, head.status);
            TEST_ASSERT_EQUAL_INT(JCAL_REASON_SENSOR_BAD, head.reason);
            TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, head.hint);
            TEST_ASSERT_EQUAL_INT((of[i].bad1 != 0u) ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2, head.weak);
            TEST_ASSERT_EQUAL_UINT32(7u, head.samples);
        }
    }
}

static void sensors_that_share_no_joint_keep_from_ready(void)
{
    const jcal_trust_t of[2] = {{0u, 0u, true, true}, {0u, 0u, true, false}};
    for (size_t k = 0u; k < 4u; ++k) {
        for (size_t i = 0u; i < 2u; ++i) {
            jcal_head_t head = head_of(all[k]);
            jcal_trust(&of[i], &head);
            TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, head.status);
            TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, head.reason);
            TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, head.hint);
        }
    }
}

/* What an engine lacks beside the lag is worth more to a person than the lag. */
static void a_lag_that_is_not_known_keeps_from_ready_alone(void)
{
    const jcal_trust_t unknown = {0u, 0u, false, false};
    for (size_t k = 0u; k < 4u; ++k) {
        const jcal_head_t before = head_of(all[k]);
        jcal_head_t head = before;
        jcal_trust(&unknown, &head);
        if (all[k] == JCAL_READY) {
            TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, head.status);
            TEST_ASSERT_EQUAL_INT(JCAL_REASON_OUT_OF_STEP, head.reason);
            TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, head.hint);
        } else {
            TEST_ASSERT_EQUAL_MEMORY(&before, &head, sizeof head);
        }
    }
}

/* Each finding alone: those that make results worthless come in when named, go when fine, and stay when nothing is told. */
static void findings_come_go_and_stay(void)
{
    static const jcal_finding_t worthless[8] = {JCAL_FINDING_HELD,        JCAL_FINDING_DEAD,      JCAL_FINDING_CLIPPED,
                                                JCAL_FINDING_NO_GRAVITY,  JCAL_FINDING_RATE_UNIT, JCAL_FINDING_FRAMES,
                                                JCAL_FINDING_GRAVITY_OFF, JCAL_FINDING_SCALE};
    unsigned expected = 0u;
    for (size_t i = 0u; i < 8u; ++i) {
        expected |= 1u << (unsigned)worthless[i];
    }
    jcal_health_result_t result;
    memset(&result, 0, sizeof result);
    for (unsigned k = 0u; k < (unsigned)JCAL_FINDING_COUNT; ++k) {
        const unsigned bit = (1u << k) & expected;
        result.state[k] = JCAL_HEALTH_NAMED;
        TEST_ASSERT_EQUAL_HEX16(bit, jcal_trust_findings(0u, &result));
        TEST_ASSERT_EQUAL_HEX16(expected, jcal_trust_findings((uint16_t)expected, &result));
        result.state[k] = JCAL_HEALTH_FINE;
        TEST_ASSERT_EQUAL_HEX16(0u, jcal_trust_findings(0u, &result));
        TEST_ASSERT_EQUAL_HEX16(expected & ~bit, jcal_trust_findings((uint16_t)expected, &result));
        result.state[k] = JCAL_HEALTH_UNKNOWN;
        TEST_ASSERT_EQUAL_HEX16(expected, jcal_trust_findings((uint16_t)expected, &result));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_engine_is_believed_that_reads_good_sensors);
    RUN_TEST(a_bad_sensor_stands_above_everything);
    RUN_TEST(sensors_that_share_no_joint_keep_from_ready);
    RUN_TEST(a_lag_that_is_not_known_keeps_from_ready_alone);
    RUN_TEST(findings_come_go_and_stay);
    return UNITY_END();
}
