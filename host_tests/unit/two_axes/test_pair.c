/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/two_axes_pair.h: readings of two exact sensors on a made-up elbow, through stages of their own.
#include "jointcal/two_axes_pair.h"

#include "jointcal/quat.h"
#include "unit/two_axes/fixture.h"

enum { PERIOD_US = 10000 };

static jcal_two_axes_pair_t joint;
static hinge_t elbow;
static uint32_t pushed;

static jcal_pair_t pair_now(void)
{
    const double t = (double)pushed * 1e-6 * PERIOD_US;
    hinge_sensor_t s1;
    hinge_sensor_t s2;
    hinge_sensor(&elbow, t, 1, &s1);
    hinge_sensor(&elbow, t, 2, &s2);
    for (int i = 0; i < 3; ++i) { /* real sensors do not repeat themselves at rest */
        s1.gyr[i] += 1e-3 * sin(11.0 * pushed + i);
        s2.gyr[i] += 1e-3 * sin(13.0 * pushed + i);
        s1.force[i] += 1e-2 * sin(17.0 * pushed + i);
        s2.force[i] += 1e-2 * sin(19.0 * pushed + i);
    }
    const jcal_pair_t out = {1000u + (uint64_t)pushed * PERIOD_US,
                             {to_vec3(s1.gyr), to_vec3(s1.force)},
                             {to_vec3(s2.gyr), to_vec3(s2.force)}};
    return out;
}

static jcal_two_axes_result_t result(void)
{
    jcal_two_axes_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_pair_get(&joint, &out));
    return out;
}

static void move(elbow_motion_t motion, double seconds)
{
    elbow_do(&elbow, motion);
    for (uint32_t end = pushed + (uint32_t)(seconds * 100.0); pushed < end; ++pushed) {
        const jcal_pair_t pair = pair_now();
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_pair_update(&joint, &pair));
    }
}

void setUp(void)
{
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    elbow = elbow_usual();
    elbow.rest_s = 1.0; /* the level frames are right from the beginning */
    pushed = 0u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_pair_init(&joint, &config, NULL));
}

void tearDown(void)
{
}

static void expect_the_relative_orientation(void)
{
    double turn1[9];
    double turn2[9];
    double ignored[3];
    double truth[9];
    double relative[9];
    hinge_pose(&elbow, (double)(pushed - 1u) * 0.01, turn1, turn2, ignored);
    mat_transpose(turn1, turn1);
    mat_mul(turn1, turn2, truth);
    mat_of(jcal_two_axes_pair_relative(&joint), relative);
    /* inclinations of a degree or two each, and half a sample of 5 rad/s */
    TEST_ASSERT_TRUE(mat_angle_between(truth, relative) <
                     (double)result().ball.uncertainty_heading_rad + 4.0 * HINGE_DEG);
}

/* Readings that repeat themselves: what the gate complains of stands above what was judged. */
static void expect_the_gate_to_speak_first(void)
{
    jcal_pair_t pair = pair_now();
    for (int k = 0; k < 200; ++k) {
        pair.t_us += PERIOD_US;
        (void)jcal_two_axes_pair_update(&joint, &pair);
    }
    const jcal_two_axes_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, r.ball.head.reason);
    TEST_ASSERT_TRUE(r.ball.head.status != JCAL_READY);
    TEST_ASSERT_FALSE(r.for_heading || r.for_axis1 || r.for_axis2 || r.ball.for_center1 || r.ball.for_center2);
}

/* From readings to both axes: it bends, stops for a moment with its forearm at another angle, and turns. */
static void readings_become_axes(void)
{
    TEST_ASSERT_TRUE(isnan(jcal_two_axes_pair_relative(&joint).w));
    move(BEND, 20.0);
    TEST_ASSERT_TRUE(result().for_heading && result().for_axis1);
    TEST_ASSERT_FALSE(result().for_axis2);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_TURN_ONLY, result().ball.head.hint);
    expect_the_relative_orientation();
    const jcal_two_axes_result_t bent = result();
    TEST_ASSERT_TRUE(line_angle(bent.axis1, elbow_axis(&elbow, 1)) < (double)bent.uncertainty1_rad);
    elbow_do(&elbow, TURN);
    pushed += 100u; /* a gap: what the sensors read between both motions does not belong to any */
    const jcal_pair_t first = pair_now();
    (void)jcal_two_axes_pair_update(&joint, &first);
    ++pushed;
    move(TURN, 25.0);
    const jcal_two_axes_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.ball.head.status);
    TEST_ASSERT_TRUE(r.for_heading && r.for_axis1 && r.for_axis2);
    TEST_ASSERT_TRUE(line_angle(r.axis1, elbow_axis(&elbow, 1)) < (double)r.uncertainty1_rad);
    TEST_ASSERT_TRUE(line_angle(r.axis2, elbow_axis(&elbow, 2)) < (double)r.uncertainty2_rad);
    expect_the_relative_orientation();
    expect_the_gate_to_speak_first();
}

/* What cannot be is counted and leaves the estimate alone. */
static void readings_that_cannot_be_are_rejected(void)
{
    move(BEND, 8.0);
    const jcal_two_axes_t before = joint.joint;
    jcal_pair_t pair = pair_now();
    pair.imu1.gyr_rad_s.z = INFINITY;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_two_axes_pair_update(&joint, &pair));
    pair = pair_now();
    pair.t_us -= 1000000u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_two_axes_pair_update(&joint, &pair));
    TEST_ASSERT_EQUAL_MEMORY(&before, &joint.joint, sizeof before);
    TEST_ASSERT_EQUAL_UINT32(1u, result().ball.head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_UINT32(1u, result().ball.head.rejected_by[JCAL_REJECT_TIME_ORDER]);
    TEST_ASSERT_EQUAL_UINT32(pushed + 2u, result().ball.head.samples);
}

static void null_and_wrong_settings_are_errors(void)
{
    jcal_two_axes_config_t config = jcal_two_axes_config_default();
    const jcal_pair_t pair = pair_now();
    jcal_two_axes_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_pair_init(NULL, &config, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_pair_init(&joint, NULL, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_pair_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_pair_update(&joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_pair_get(NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_pair_get(&joint, NULL));
    TEST_ASSERT_TRUE(isnan(jcal_two_axes_pair_relative(NULL).x));
    jcal_gate_config_t limits = jcal_gate_config_default();
    limits.frozen_s = NAN;
    const jcal_two_axes_pair_t before = joint;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_two_axes_pair_init(&joint, &config, &limits));
    config.max_bound_rad = 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_two_axes_pair_init(&joint, &config, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &joint, sizeof before);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(readings_become_axes);
    RUN_TEST(readings_that_cannot_be_are_rejected);
    RUN_TEST(null_and_wrong_settings_are_errors);
    return UNITY_END();
}
