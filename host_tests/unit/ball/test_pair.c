/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/ball_pair.h: readings of two exact sensors on a made-up arm, through stages of their own.
#include "jointcal/ball_pair.h"

#include "unit/ball/fixture.h"

enum { PERIOD_US = 10000 };

static jcal_ball_pair_t joint;
static hinge_t arm;

static jcal_pair_t pair_at(uint32_t k)
{
    const double t = (double)k * 1e-6 * PERIOD_US;
    hinge_sensor_t s1;
    hinge_sensor_t s2;
    hinge_sensor(&arm, t, 1, &s1);
    hinge_sensor(&arm, t, 2, &s2);
    for (int i = 0; i < 3; ++i) { /* real sensors do not repeat themselves at rest */
        s1.gyr[i] += 1e-3 * sin(11.0 * k + i);
        s2.gyr[i] += 1e-3 * sin(13.0 * k + i);
        s1.force[i] += 1e-2 * sin(17.0 * k + i);
        s2.force[i] += 1e-2 * sin(19.0 * k + i);
    }
    const jcal_pair_t out = {
        1000u + (uint64_t)k * PERIOD_US, {to_vec3(s1.gyr), to_vec3(s1.force)}, {to_vec3(s2.gyr), to_vec3(s2.force)}};
    return out;
}

static jcal_ball_result_t result(void)
{
    jcal_ball_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_pair_get(&joint, &out));
    return out;
}

static void push(uint32_t from, uint32_t until)
{
    for (uint32_t k = from; k < until; ++k) {
        const jcal_pair_t pair = pair_at(k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_pair_update(&joint, &pair));
    }
}

void setUp(void)
{
    jcal_ball_config_t config = jcal_ball_config_default();
    config.max_lever_m = 0.08f; /* the proximal segment turns little */
    arm = arm_usual();
    arm.rest_s = 1.0; /* the level frames are right from the beginning */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_pair_init(&joint, &config, NULL));
}

void tearDown(void)
{
}

static double off_m(jcal_vec3_t found, const double truth[3])
{
    return (double)jcal_vec3_norm(jcal_vec3_sub(found, to_vec3(truth)));
}

/* From readings to levers and to the orientation of one segment in the other. */
static void readings_become_levers_and_a_relative_orientation(void)
{
    int compared = 0;
    TEST_ASSERT_TRUE(isnan(jcal_ball_pair_relative(&joint).w));
    for (uint32_t k = 0; k < 2000u; ++k) {
        push(k, k + 1u);
        const jcal_ball_result_t now = result();
        if (now.head.status != JCAL_READY) {
            continue;
        }
        ++compared;
        TEST_ASSERT_TRUE(off_m(now.joint_to_sensor1_m, arm.r1) < (double)now.uncertainty1_m);
        TEST_ASSERT_TRUE(off_m(now.joint_to_sensor2_m, arm.r2) < (double)now.uncertainty2_m);
        double turn1[9];
        double turn2[9];
        double ignored[3];
        double truth[9];
        double relative[9];
        hinge_pose(&arm, (double)k * 0.01, turn1, turn2, ignored);
        mat_transpose(turn1, turn1);
        mat_mul(turn1, turn2, truth);
        mat_of(jcal_ball_pair_relative(&joint), relative);
        /* inclinations of a degree or two each, and half a sample of 5 rad/s */
        TEST_ASSERT_TRUE(mat_angle_between(truth, relative) < (double)now.uncertainty_heading_rad + 4.0 * HINGE_DEG);
    }
    TEST_ASSERT_TRUE(compared > 1000);
    TEST_ASSERT_EQUAL_UINT32(2000u, result().head.samples);
    TEST_ASSERT_TRUE(result().for_center1 && result().for_center2);
}

/* What cannot be is counted and leaves the estimate alone. */
static void readings_that_cannot_be_are_rejected(void)
{
    push(0u, 800u);
    const jcal_ball_t before = joint.joint;
    jcal_pair_t pair = pair_at(800u);
    pair.imu2.acc_m_s2.y = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_ball_pair_update(&joint, &pair));
    pair = pair_at(400u);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_ball_pair_update(&joint, &pair));
    TEST_ASSERT_EQUAL_MEMORY(&before, &joint.joint, sizeof before);
    TEST_ASSERT_EQUAL_UINT32(1u, result().head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_UINT32(1u, result().head.rejected_by[JCAL_REJECT_TIME_ORDER]);
}

/* What the gate complains of stands above what was judged: of readings that repeat themselves nothing is ready. */
static void the_gate_speaks_first(void)
{
    push(0u, 1500u);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().head.status);
    TEST_ASSERT_TRUE(result().for_center2);
    jcal_pair_t pair = pair_at(1500u);
    for (uint32_t k = 1500u; k < 1700u; ++k) {
        pair.t_us = 1000u + (uint64_t)k * PERIOD_US;
        (void)jcal_ball_pair_update(&joint, &pair);
    }
    const jcal_ball_result_t frozen = result();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, frozen.head.reason);
    TEST_ASSERT_TRUE(frozen.head.status != JCAL_READY);
    TEST_ASSERT_FALSE(frozen.for_center1 || frozen.for_center2);
}

static void null_and_wrong_settings_are_errors(void)
{
    jcal_ball_config_t config = jcal_ball_config_default();
    const jcal_pair_t pair = pair_at(0u);
    jcal_ball_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_pair_init(NULL, &config, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_pair_init(&joint, NULL, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_pair_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_pair_update(&joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_pair_get(NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_pair_get(&joint, NULL));
    TEST_ASSERT_TRUE(isnan(jcal_ball_pair_relative(NULL).x));
    jcal_gate_config_t limits = jcal_gate_config_default();
    limits.frozen_s = NAN;
    const jcal_ball_pair_t before = joint;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_ball_pair_init(&joint, &config, &limits));
    config.max_heading_rad = 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_ball_pair_init(&joint, &config, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &joint, sizeof before);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(readings_become_levers_and_a_relative_orientation);
    RUN_TEST(readings_that_cannot_be_are_rejected);
    RUN_TEST(the_gate_speaks_first);
    RUN_TEST(null_and_wrong_settings_are_errors);
    return UNITY_END();
}
