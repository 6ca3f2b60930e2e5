/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/joint_heading.h on motions whose heading offset is known.
#include "jointcal/joint_heading.h"
#include "jointcal/quat.h"
#include "jointcal/vec3.h"
#include "unit/angles/pose.h"

#include "unity.h"

static const double DEG = POSE_PI / 180.0;
/* Single precision all along. */
static const double EXACT_TOL = 1e-5;

static const pose_joint_t HINGE = {{0.5, 0.5, -0.5, 0.5}, {0.8, 0.0, 0.6, 0.0}, 0.0, true};
static const pose_joint_t ELBOW = {{0.5, 0.5, -0.5, 0.5}, {0.8, 0.0, 0.6, 0.0}, 0.17, false};

void setUp(void)
{
}

void tearDown(void)
{
}

/* Axis 1 about horizontal, tilted by up to 55 deg. */
static pose_t moving(double t_s, double heading)
{
    const pose_quat_t tilt = pose_mul(pose_turn(0.8 * sin(0.7 * t_s), 0.3, 1.0, 0.1),
                                      pose_turn((0.5 * POSE_PI) + (0.6 * cos(0.5 * t_s)), 1.0, 0.0, 0.0));
    const pose_t pose = {0.8 + (0.9 * sin(1.9 * t_s)), 1.1 * sin((1.3 * t_s) + 1.0), heading, tilt};
    return pose;
}

static void start(jcal_joint_heading_t *follower, const pose_joint_t *joint, float memory_s)
{
    const jcal_status_t status =
        joint->hinge ? jcal_joint_heading_hinge(follower, pose_axis1(joint), pose_axis2(joint), memory_s)
                     : jcal_joint_heading_two_dof(follower, pose_axis1(joint), pose_axis2(joint),
                                                  (float)joint->carrying, memory_s);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, status);
}

static jcal_heading_t get(const jcal_joint_heading_t *follower)
{
    jcal_heading_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_get(follower, &out));
    return out;
}

static void push(jcal_joint_heading_t *follower, const pose_joint_t *joint, double t_s, double heading)
{
    const pose_t pose = moving(t_s, heading);
    const jcal_orientation_pair_t pair = pose_sensors(joint, &pose, (uint64_t)llround(1e6 * (t_s + 1.0)));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_push(follower, &pair));
}

static void a_hinge_tells_the_heading_at_every_instant(void)
{
    jcal_joint_heading_t follower;
    start(&follower, &HINGE, 0.0f);
    for (int k = 0; k < 500; ++k) {
        const double heading = 0.11 * k;
        push(&follower, &HINGE, 0.05 * k, heading);
        TEST_ASSERT_TRUE(get(&follower).known);
        TEST_ASSERT_TRUE(pose_apart((double)get(&follower).heading_rad, heading) < EXACT_TOL);
    }
}

static void smoothing_takes_a_constant_heading_as_it_is(void)
{
    for (int turn = -3; turn <= 3; ++turn) {
        jcal_joint_heading_t follower;
        start(&follower, &HINGE, 5.0f);
        for (int k = 0; k < 300; ++k) {
            push(&follower, &HINGE, 0.05 * k, turn);
            TEST_ASSERT_TRUE(pose_apart((double)get(&follower).heading_rad, turn) < EXACT_TOL);
        }
    }
}

static void a_vertical_hinge_keeps_what_was_known(void)
{
    for (int seen = 0; seen < 2; ++seen) {
        jcal_joint_heading_t follower;
        start(&follower, &HINGE, 0.0f);
        if (seen == 1) {
            push(&follower, &HINGE, 0.0, 0.6);
        }
        for (int k = 0; k < 50; ++k) {
            /* Within 8 deg of the vertical, and a heading that is another one. */
            pose_t pose = moving(0.1 * k, -2.0);
            pose.q_b1_e1 = pose_turn(8.0 * DEG * sin(k), 1.0, 0.3, 0.0);
            const jcal_orientation_pair_t pair = pose_sensors(&HINGE, &pose, 2000000u + (10000u * (uint64_t)k));
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_push(&follower, &pair));
        }
        TEST_ASSERT_EQUAL_INT(seen, get(&follower).known);
        TEST_ASSERT_TRUE(pose_apart((double)get(&follower).heading_rad, (seen == 1) ? 0.6 : 0.0) < EXACT_TOL);
    }
}

static void two_axes_tell_the_heading_after_a_few_postures(void)
{
    for (int turn = -15; turn <= 15; ++turn) {
        jcal_joint_heading_t follower;
        start(&follower, &ELBOW, 10.0f);
        int known = 0;
        for (int k = 0; k < 200; ++k) {
            push(&follower, &ELBOW, 0.05 * k, 0.2 * turn);
            if (get(&follower).known) {
                known++;
                TEST_ASSERT_TRUE(pose_apart((double)get(&follower).heading_rad, 0.2 * turn) < 100.0 * EXACT_TOL);
            }
        }
        TEST_ASSERT_TRUE(known > 120);
    }
}

static void a_drifting_heading_is_followed(void)
{
    const double drift = 3.0 * DEG / 60.0;
    for (int kind = 0; kind < 2; ++kind) {
        const pose_joint_t *joint = (kind == 0) ? &HINGE : &ELBOW;
        jcal_joint_heading_t follower;
        start(&follower, joint, 10.0f);
        for (int k = 0; k < 6000; ++k) {
            const double t_s = 0.05 * k;
            push(&follower, joint, t_s, drift * t_s);
        }
        const double behind = (drift * 0.05 * 5999.0) - (double)get(&follower).heading_rad;
        /* The mean age of fading data is the time constant; information comes in parts of a motion, so up to twice that. */
        TEST_ASSERT_TRUE(behind > 0.2 * drift * 10.0);
        TEST_ASSERT_TRUE(behind < 2.0 * drift * 10.0);
    }
}

static void one_posture_of_two_axes_tells_nothing(void)
{
    jcal_joint_heading_t follower;
    start(&follower, &ELBOW, 10.0f);
    const pose_t pose = moving(0.3, 1.0);
    for (uint64_t k = 1u; k <= 500u; ++k) {
        const jcal_orientation_pair_t pair = pose_sensors(&ELBOW, &pose, 20000u * k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_push(&follower, &pair));
        TEST_ASSERT_FALSE(get(&follower).known);
    }
}

static void flexion_alone_of_two_axes_tells_nothing_wrong(void)
{
    /* Pronation at rest and the proximal segment, too: the distal axis goes round axis 1, and its mirror image fits as well. */
    jcal_joint_heading_t follower;
    start(&follower, &ELBOW, 10.0f);
    for (uint64_t k = 1u; k <= 1000u; ++k) {
        const pose_t pose = {1.5 * sin(0.05 * (double)k), 0.4, 1.0, pose_turn(0.5 * POSE_PI, 1.0, 0.0, 0.0)};
        const jcal_orientation_pair_t pair = pose_sensors(&ELBOW, &pose, 20000u * k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_push(&follower, &pair));
        const jcal_heading_t heading = get(&follower);
        TEST_ASSERT_TRUE(!heading.known || (pose_apart((double)heading.heading_rad, 1.0) < 1.0 * DEG));
    }
}

static void pairs_without_a_value_or_out_of_order_change_nothing(void)
{
    jcal_joint_heading_t follower;
    start(&follower, &ELBOW, 10.0f);
    for (int k = 0; k < 100; ++k) {
        push(&follower, &ELBOW, 0.05 * k, 0.5);
    }
    const jcal_joint_heading_t before = follower;
    const pose_t pose = moving(1.0, -1.0);
    jcal_orientation_pair_t pair = pose_sensors(&ELBOW, &pose, 1000000u);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_joint_heading_push(&follower, &pair));
    pair.t_us = 60000000u;
    pair.q2.x = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_joint_heading_push(&follower, &pair));
    TEST_ASSERT_EQUAL_MEMORY(before.sums, follower.sums, sizeof before.sums);
    TEST_ASSERT_EQUAL_FLOAT(before.weight, follower.weight);
    TEST_ASSERT_EQUAL_FLOAT(before.last.heading_rad, follower.last.heading_rad);
    TEST_ASSERT_TRUE((before.t_us == follower.t_us) && (before.clock.last_us == follower.clock.last_us));
}

static void a_clock_that_begins_anew_is_followed_within_a_second(void)
{
    jcal_joint_heading_t follower;
    start(&follower, &ELBOW, 10.0f);
    uint32_t rejected = 0;
    for (uint64_t k = 0; k < 400u; ++k) {
        const pose_t pose = moving(0.05 * (double)k, 0.5);
        /* 20 s on, a wild time, then from zero. */
        const uint64_t t_us =
            (k == 150u) ? (1ull << 40) : ((k < 200u) ? (5000000u + (50000u * k)) : (50000u * (k - 200u)));
        const jcal_orientation_pair_t pair = pose_sensors(&ELBOW, &pose, t_us);
        rejected += (jcal_joint_heading_push(&follower, &pair) == JCAL_REJECTED) ? 1u : 0u;
    }
    /* The wild one; then 0.4 s of samples until the new clock is believed: nine of 0.05 s. */
    TEST_ASSERT_EQUAL_UINT32(1u + 9u, rejected);
    TEST_ASSERT_TRUE(get(&follower).known);
    TEST_ASSERT_TRUE(follower.t_us == 50000u * 199u);
}

static void a_vertical_axis_of_two_tells_nothing(void)
{
    jcal_joint_heading_t follower;
    start(&follower, &ELBOW, 10.0f);
    for (uint64_t k = 1u; k <= 500u; ++k) {
        pose_t pose = moving(0.02 * (double)k, 1.0);
        pose.q_b1_e1 = pose_turn(3.0 * DEG * sin(0.1 * (double)k), 1.0, 0.3, 0.0);
        const jcal_orientation_pair_t pair = pose_sensors(&ELBOW, &pose, 20000u * k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_push(&follower, &pair));
        TEST_ASSERT_FALSE(get(&follower).known);
    }
}

static void one_pair_after_a_gap_does_not_outweigh_what_came_before(void)
{
    jcal_joint_heading_t follower;
    start(&follower, &HINGE, 5.0f);
    for (int k = 0; k < 200; ++k) {
        push(&follower, &HINGE, 0.05 * k, 0.5);
    }
    push(&follower, &HINGE, 13.0, 1.5);
    /* It counts for 0.1 s beside some 3 s that are left of the others. */
    TEST_ASSERT_TRUE(pose_apart((double)get(&follower).heading_rad, 0.5) < 0.1);
}

static void better_axes_are_taken_over(void)
{
    for (int kind = 0; kind < 2; ++kind) {
        const pose_joint_t *joint = (kind == 0) ? &HINGE : &ELBOW;
        jcal_joint_heading_t follower;
        const jcal_vec3_t other = {1.0f, 0.0f, 0.0f};
        TEST_ASSERT_EQUAL_INT(JCAL_OK, joint->hinge ? jcal_joint_heading_hinge(&follower, other, other, 2.0f)
                                                    : jcal_joint_heading_two_dof(&follower, other, other, 0.9f, 2.0f));
        push(&follower, joint, 0.0, 0.4);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_improve(&follower, jcal_vec3_scale(pose_axis1(joint), 2.0f),
                                                                  pose_axis2(joint), (float)joint->carrying));
        for (int k = 1; k < 600; ++k) {
            push(&follower, joint, 0.05 * k, 0.4);
        }
        TEST_ASSERT_TRUE(get(&follower).known);
        TEST_ASSERT_TRUE(pose_apart((double)get(&follower).heading_rad, 0.4) < 100.0 * EXACT_TOL);
    }
}

static void what_is_no_orientation_changes_nothing(void)
{
    static const float lengths[] = {0.0f, 1e-3f, 0.94f, 1.06f, 7.0f, 1e10f, 1e12f, 1e30f};
    const pose_joint_t *const joints[2] = {&HINGE, &ELBOW};
    for (int j = 0; j < 2; ++j) {
        for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; ++i) {
            for (int sensor = 0; sensor < 2; ++sensor) {
                jcal_joint_heading_t follower;
                start(&follower, joints[j], 5.0f);
                for (int k = 0; k < 200; ++k) {
                    push(&follower, joints[j], 0.05 * k, 0.5);
                }
                const jcal_joint_heading_t before = follower;
                const pose_t pose = moving(11.0, 2.0);
                jcal_orientation_pair_t pair = pose_sensors(joints[j], &pose, 12000000u);
                jcal_quat_t *const q = (sensor == 0) ? &pair.q1 : &pair.q2;
                *q = jcal_quat(q->w * lengths[i], q->x * lengths[i], q->y * lengths[i], q->z * lengths[i]);
                TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_joint_heading_push(&follower, &pair));
                TEST_ASSERT_EQUAL_MEMORY(&before, &follower, sizeof before);
            }
        }
    }
}

static void a_length_that_is_off_by_rounding_does_not_matter(void)
{
    const pose_joint_t *const joints[2] = {&HINGE, &ELBOW};
    for (int j = 0; j < 2; ++j) {
        jcal_joint_heading_t follower;
        start(&follower, joints[j], 5.0f);
        for (int k = 0; k < 200; ++k) {
            const pose_t pose = moving(0.05 * k, 0.5);
            jcal_orientation_pair_t pair = pose_sensors(joints[j], &pose, 50000u * (uint64_t)(k + 1));
            const float s = (k % 2 == 0) ? 1.04f : 0.96f;
            pair.q1 = jcal_quat(pair.q1.w * s, pair.q1.x * s, pair.q1.y * s, pair.q1.z * s);
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_push(&follower, &pair));
        }
        TEST_ASSERT_TRUE(get(&follower).known);
        TEST_ASSERT_TRUE(pose_apart((double)get(&follower).heading_rad, 0.5) < 1e-3);
    }
}

static void zeros_alone_tell_nothing(void)
{
    jcal_joint_heading_t follower;
    const jcal_orientation_pair_t zeros = {1000000u, {0.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f, 0.0f}};
    start(&follower, &HINGE, 0.0f);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_joint_heading_push(&follower, &zeros));
    TEST_ASSERT_FALSE(get(&follower).known);
}

static void arguments_are_checked(void)
{
    jcal_joint_heading_t follower;
    jcal_heading_t heading;
    const jcal_vec3_t good = {0.0f, 0.0f, 3.0f};
    const jcal_vec3_t bad[] = {{0.0f, 0.0f, 0.0f}, {NAN, 0.0f, 1.0f}, {INFINITY, 0.0f, 0.0f}};
    for (int k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_hinge(&follower, bad[k], good, 1.0f));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_two_dof(&follower, good, bad[k], 0.0f, 1.0f));
    }
    const float memories[] = {-1.0f, 601.0f, NAN};
    for (int k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_hinge(&follower, good, good, memories[k]));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_two_dof(&follower, good, good, 0.0f, memories[k]));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_two_dof(&follower, good, good, 0.0f, 0.5f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_two_dof(&follower, good, good, 1.6f, 5.0f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_two_dof(&follower, good, good, NAN, 5.0f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_hinge(NULL, good, good, 1.0f));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_hinge(&follower, good, good, 1.0f));
    jcal_orientation_pair_t pair = {0u, {1.0f, 0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f, 0.0f}};
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_push(&follower, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_push(NULL, &pair));
    pair.q1.x = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_joint_heading_push(&follower, &pair));
    pair.q1.x = 0.0f;
    pair.q2.z = INFINITY;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_joint_heading_push(&follower, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_get(&follower, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_improve(NULL, good, good, 0.0f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_improve(&follower, bad[0], good, 0.0f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_improve(&follower, good, bad[1], 0.0f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_improve(&follower, good, good, 1.6f));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_joint_heading_get(NULL, &heading));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_joint_heading_get(&follower, &heading));
    TEST_ASSERT_FALSE(heading.known);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_hinge_tells_the_heading_at_every_instant);
    RUN_TEST(smoothing_takes_a_constant_heading_as_it_is);
    RUN_TEST(a_vertical_hinge_keeps_what_was_known);
    RUN_TEST(two_axes_tell_the_heading_after_a_few_postures);
    RUN_TEST(a_drifting_heading_is_followed);
    RUN_TEST(one_posture_of_two_axes_tells_nothing);
    RUN_TEST(flexion_alone_of_two_axes_tells_nothing_wrong);
    RUN_TEST(pairs_without_a_value_or_out_of_order_change_nothing);
    RUN_TEST(a_clock_that_begins_anew_is_followed_within_a_second);
    RUN_TEST(a_vertical_axis_of_two_tells_nothing);
    RUN_TEST(one_pair_after_a_gap_does_not_outweigh_what_came_before);
    RUN_TEST(better_axes_are_taken_over);
    RUN_TEST(what_is_no_orientation_changes_nothing);
    RUN_TEST(a_length_that_is_off_by_rounding_does_not_matter);
    RUN_TEST(zeros_alone_tell_nothing);
    RUN_TEST(arguments_are_checked);
    return UNITY_END();
}
