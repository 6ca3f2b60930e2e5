/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/joint_angles.h on poses whose angles are known.
#include "jointcal/joint_angles.h"
#include "jointcal/quat.h"
#include "unit/angles/pose.h"

#include "unity.h"

/* Seven products of quaternions in single precision, each rounded to 1e-7 or so, twice the half angle, and 5e-7 of the arc tangent. */
static const double ANGLE_TOL = 4e-6;
/* Near parallel axes the error of the elements of the rotation is divided by the cosine of the carrying angle. */
static const double MATRIX_TOL = 2e-6;

static const double DEG = POSE_PI / 180.0;
static const jcal_joint_angles_t ZERO = {0.0f, 0.0f, 0.0f};

void setUp(void)
{
}

void tearDown(void)
{
}

/* The frames that the library makes of the axes, zeroed with one pose whose true angles are told to it. */
static jcal_joint_frames_t calibrated(const pose_joint_t *joint, const pose_t *pose)
{
    jcal_joint_frames_t frames;
    const jcal_status_t status = joint->hinge ? jcal_frames_hinge(pose_axis1(joint), pose_axis2(joint), &frames)
                                              : jcal_frames_two_dof(pose_axis1(joint), pose_axis2(joint), &frames);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, status);
    const jcal_orientation_pair_t pair = pose_sensors(joint, pose, 0u);
    const jcal_quat_t q = jcal_joint_orientation(&frames, pair.q1, pair.q2, (float)pose->heading);
    const jcal_joint_angles_t is = joint->hinge ? jcal_hinge_angles(q) : jcal_two_dof_angles(q);
    const jcal_joint_angles_t shall = {(float)pose->flexion, (float)pose->pronation, 0.0f};
    jcal_frames_zero(&frames, &is, &shall);
    return frames;
}

static jcal_joint_angles_t angles_of(const pose_joint_t *joint, const jcal_joint_frames_t *frames, const pose_t *pose)
{
    const jcal_orientation_pair_t pair = pose_sensors(joint, pose, 0u);
    const jcal_quat_t q = jcal_joint_orientation(frames, pair.q1, pair.q2, (float)pose->heading);
    return joint->hinge ? jcal_hinge_angles(q) : jcal_two_dof_angles(q);
}

static void assert_angles(const pose_joint_t *joint, const pose_t *pose, jcal_joint_angles_t got)
{
    const double tolerance = ANGLE_TOL / cos(joint->carrying);
    TEST_ASSERT_TRUE(pose_apart((double)got.flexion_rad, pose->flexion) < tolerance);
    TEST_ASSERT_TRUE(pose_apart((double)got.pronation_rad, pose->pronation) < tolerance);
    TEST_ASSERT_TRUE(fabs((double)got.carrying_rad - joint->carrying) < tolerance);
}

static void all_three_angles_are_right_for_carrying_angles_to_30_deg(void)
{
    for (int k = 0; k < 60; ++k) {
        const pose_joint_t joint = {pose_any(3 * k), pose_any(7 * k + 1), (double)(k - 30) * DEG, false};
        const pose_t first = {0.4, -1.1, 2.0, pose_any(k)};
        const jcal_joint_frames_t frames = calibrated(&joint, &first);
        for (int i = -36; i <= 36; ++i) {
            const pose_t pose = {(double)i * 5.0 * DEG, (double)((i * 7) % 36) * 5.0 * DEG, 0.1 * i, pose_any(5 * i)};
            assert_angles(&joint, &pose, angles_of(&joint, &frames, &pose));
        }
    }
}

static void the_flexion_of_a_hinge_is_right_all_around(void)
{
    for (int k = 0; k < 60; ++k) {
        const pose_joint_t joint = {pose_any(3 * k), pose_any(7 * k + 1), 0.0, true};
        const pose_t first = {-0.7, 0.0, -3.0, pose_any(k)};
        const jcal_joint_frames_t frames = calibrated(&joint, &first);
        for (int i = -36; i <= 36; ++i) {
            const pose_t pose = {(double)i * 5.0 * DEG, 0.0, 0.1 * i, pose_any(5 * i)};
            assert_angles(&joint, &pose, angles_of(&joint, &frames, &pose));
        }
    }
}

static void what_is_across_the_hinge_is_ignored(void)
{
    for (int i = -17; i <= 17; ++i) {
        const pose_quat_t flexed = pose_turn((double)i * 10.0 * DEG, 0.0, 0.0, 1.0);
        const pose_quat_t q = pose_mul(flexed, pose_turn(0.2, cos(i), sin(i), 0.0));
        TEST_ASSERT_TRUE(pose_apart((double)jcal_hinge_angles(pose_single(q)).flexion_rad, (double)i * 10.0 * DEG) <
                         ANGLE_TOL);
    }
}

static void angles_do_not_depend_on_where_either_segment_heads(void)
{
    const pose_joint_t joint = {pose_any(11), pose_any(17), 0.2, false};
    const pose_t first = {0.0, 0.0, 1.0, pose_any(2)};
    const jcal_joint_frames_t frames = calibrated(&joint, &first);
    for (int i = 0; i < 100; ++i) {
        pose_t pose = {0.9, -0.6, 0.37 * i, pose_any(4)};
        pose.q_b1_e1 = pose_mul(pose_turn(0.21 * i, 0.0, 0.0, 1.0), pose.q_b1_e1);
        assert_angles(&joint, &pose, angles_of(&joint, &frames, &pose));
    }
}

static void angles_do_not_depend_on_how_the_proximal_segment_lies(void)
{
    /* Straight up, straight down and along the horizontal: places where Euler angles of the segments themselves fail. */
    const pose_joint_t joint = {pose_any(11), pose_any(17), -0.3, false};
    const pose_t first = {0.0, 0.0, 1.0, pose_any(2)};
    const jcal_joint_frames_t frames = calibrated(&joint, &first);
    for (int i = 0; i < 64; ++i) {
        const int quarter = i / 16;
        const pose_quat_t tilt = pose_mul(pose_turn(90.0 * DEG * (i % 4), 1.0, 0.0, 0.0),
                                          pose_turn(90.0 * DEG * (i / 4 % 4), 0.0, 1.0, 0.0));
        const pose_t pose = {90.0 * DEG * quarter, 1.2, 0.5, tilt};
        assert_angles(&joint, &pose, angles_of(&joint, &frames, &pose));
    }
}

static void axes_may_point_anywhere_also_against_the_axis_they_are_brought_to(void)
{
    const double tilts[] = {0.0, 1e-7, 1e-4, 0.01, 1.57079, 1.5708, 3.0, 3.1415, 3.14159, 3.1415926, POSE_PI};
    for (size_t k = 0; k < sizeof tilts / sizeof tilts[0]; ++k) {
        for (int turn = 0; turn < 8; ++turn) {
            const double a = 0.8 * turn;
            const pose_quat_t tilt1 = pose_turn(tilts[k], cos(a), sin(a), 0.0);
            const pose_quat_t tilt2 = pose_turn(tilts[k], cos(a), 0.0, sin(a));
            const pose_joint_t joint = {tilt1, tilt2, 0.1, false};
            const pose_t first = {0.0, 0.0, 1.0, pose_any(2)};
            const jcal_joint_frames_t frames = calibrated(&joint, &first);
            const pose_t pose = {-1.3, 2.8, 1.0, pose_any(turn)};
            assert_angles(&joint, &pose, angles_of(&joint, &frames, &pose));
        }
    }
}

static void angles_carry_on_across_180_deg(void)
{
    const pose_joint_t joint = {pose_any(1), pose_any(2), 0.1, false};
    const pose_t first = {0.0, 0.0, 0.0, pose_any(3)};
    const jcal_joint_frames_t frames = calibrated(&joint, &first);
    for (int i = -20; i <= 20; ++i) {
        const pose_t pose = {POSE_PI + (1e-5 * i), -POSE_PI + (1e-5 * i), 0.0, pose_any(i)};
        const jcal_joint_angles_t got = angles_of(&joint, &frames, &pose);
        assert_angles(&joint, &pose, got);
        TEST_ASSERT_TRUE(fabs((double)got.flexion_rad) <= (double)(float)POSE_PI);
        TEST_ASSERT_TRUE(fabs((double)got.pronation_rad) <= (double)(float)POSE_PI);
    }
}

/* An element of the rotation matrix. */
static double element(pose_quat_t q, int row, int column)
{
    const pose_quat_t v = {0.0, (column == 0) ? 1.0 : 0.0, (column == 1) ? 1.0 : 0.0, (column == 2) ? 1.0 : 0.0};
    const pose_quat_t out = pose_mul(pose_mul(q, v), pose_conj(q));
    return (row == 0) ? out.x : ((row == 1) ? out.y : out.z);
}

static void parallel_axes_give_angles_that_mean_the_same_rotation(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        for (int i = 0; i < 30; ++i) {
            /* Carrying angles on either side of the border between both ways. */
            const pose_joint_t joint = {pose_any(0), pose_any(0), sign * (90.0 * DEG - 1e-4 * i), false};
            const pose_t pose = {0.2 * i - 2.0, 1.0 - 0.3 * i, 0.0, pose_any(0)};
            const pose_quat_t q = pose_joint(&joint, &pose);
            const jcal_joint_angles_t got = jcal_two_dof_angles(pose_single(q));
            /* Nine steps lie within 1e-3 rad of parallel, the tenth on the border. */
            TEST_ASSERT_TRUE((i >= 10) || (got.pronation_rad == 0.0f));
            const pose_joint_t again = {q, q, (double)got.carrying_rad, false};
            const pose_t back = {(double)got.flexion_rad, (double)got.pronation_rad, 0.0, q};
            /* What is dropped at the border, 1e-3 of a cosine, may show. */
            const double tolerance = (1e-4 * i < 1e-3) ? 2e-3 : MATRIX_TOL / cos(joint.carrying);
            for (int at = 0; at < 9; ++at) {
                TEST_ASSERT_TRUE(fabs(element(q, at / 3, at % 3) - element(pose_joint(&again, &back), at / 3, at % 3)) <
                                 tolerance);
            }
        }
    }
}

static void zeroing_turns_angles_by_the_same_amount_everywhere(void)
{
    /* Equations (25) and (26) take a rotation off; for z-x'-y'' angles that is the difference of angles. */
    const pose_joint_t joint = {pose_any(8), pose_any(9), 0.4, false};
    const pose_t first = {0.0, 0.0, 0.0, pose_any(3)};
    jcal_joint_frames_t frames = calibrated(&joint, &first);
    const jcal_joint_angles_t is = {0.5f, -0.8f, 0.4f};
    const jcal_joint_angles_t shall = {-0.25f, 2.0f, 0.0f};
    jcal_frames_zero(&frames, &is, &shall);
    for (int i = 0; i < 50; ++i) {
        const pose_t pose = {0.1 * i, 0.2 * i, 0.0, pose_any(i)};
        const pose_t shifted = {pose.flexion - 0.75, pose.pronation + 2.8, 0.0, pose.q_b1_e1};
        assert_angles(&joint, &shifted, angles_of(&joint, &frames, &pose));
    }
}

static void either_sign_of_either_axis_gives_the_sign_of_its_angle(void)
{
    for (int signs = 0; signs < 4; ++signs) {
        const float s1 = (signs % 2 == 0) ? 1.0f : -1.0f;
        const float s2 = (signs / 2 == 0) ? 1.0f : -1.0f;
        const pose_joint_t joint = {pose_any(5), pose_any(6), 0.3, false};
        jcal_joint_frames_t frames;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_frames_two_dof(jcal_vec3_scale(pose_axis1(&joint), s1),
                                                           jcal_vec3_scale(pose_axis2(&joint), s2), &frames));
        const pose_t rest = {0.0, 0.0, 0.7, pose_any(1)};
        const jcal_joint_angles_t is = angles_of(&joint, &frames, &rest);
        jcal_frames_zero(&frames, &is, &ZERO);
        for (int i = 0; i < 30; ++i) {
            const pose_t pose = {0.1 * i, 0.15 * i, 0.7, pose_any(i)};
            const jcal_joint_angles_t got = angles_of(&joint, &frames, &pose);
            TEST_ASSERT_TRUE(pose_apart((double)got.flexion_rad, (double)s1 * pose.flexion) < 2.0 * ANGLE_TOL);
            TEST_ASSERT_TRUE(pose_apart((double)got.pronation_rad, (double)s2 * pose.pronation) < 2.0 * ANGLE_TOL);
            TEST_ASSERT_TRUE(pose_apart((double)got.carrying_rad, (double)(s1 * s2) * 0.3) < 2.0 * ANGLE_TOL);
        }
    }
}

static void conventions_of_sign_are_what_their_names_say(void)
{
    const jcal_joint_angles_t angles = {0.5f, 0.25f, 0.125f};
    const jcal_positive_t names[] = {JCAL_POSITIVE_ISB, JCAL_POSITIVE_FLEXION_SUPINATION,
                                     JCAL_POSITIVE_EXTENSION_PRONATION, JCAL_POSITIVE_EXTENSION_SUPINATION};
    const float flexion[] = {0.5f, 0.5f, -0.5f, -0.5f};
    const float pronation[] = {0.25f, -0.25f, 0.25f, -0.25f};
    for (int i = 0; i < 4; ++i) {
        const jcal_joint_angles_t got = jcal_angles_signed(angles, names[i]);
        TEST_ASSERT_EQUAL_FLOAT(flexion[i], got.flexion_rad);
        TEST_ASSERT_EQUAL_FLOAT(pronation[i], got.pronation_rad);
        TEST_ASSERT_EQUAL_FLOAT(0.125f, got.carrying_rad);
    }
}

static void isb_signs_on_the_right_arm(void)
{
    /* The arm hangs down, palm forward: x forward, y up, z to the right in both segments. Bent by 90 deg the hand, which was below,
     * is in front; pronated by 90 deg, the palm, which faced forward, faces left. */
    const jcal_joint_angles_t bent = jcal_two_dof_angles(jcal_quat(sqrtf(0.5f), 0.0f, 0.0f, sqrtf(0.5f)));
    const jcal_joint_angles_t turned = jcal_two_dof_angles(jcal_quat(sqrtf(0.5f), 0.0f, sqrtf(0.5f), 0.0f));
    const jcal_vec3_t hand =
        jcal_quat_rotate(jcal_quat(sqrtf(0.5f), 0.0f, 0.0f, sqrtf(0.5f)), jcal_vec3(0.0f, -1.0f, 0.0f));
    const jcal_vec3_t palm =
        jcal_quat_rotate(jcal_quat(sqrtf(0.5f), 0.0f, sqrtf(0.5f), 0.0f), jcal_vec3(1.0f, 0.0f, 0.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, hand.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -1.0f, palm.z);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)(90.0 * DEG), bent.flexion_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)(90.0 * DEG), turned.pronation_rad);
}

static void axes_are_turned_into_the_half_space_of_the_mounting(void)
{
    const jcal_vec3_t axis = {0.6f, 0.0f, -0.8f};
    TEST_ASSERT_EQUAL_FLOAT(0.6f, jcal_axis_toward(axis, jcal_vec3(1.0f, 0.0f, 0.0f)).x);
    TEST_ASSERT_EQUAL_FLOAT(-0.6f, jcal_axis_toward(axis, jcal_vec3(-3.0f, 1.0f, 0.0f)).x);
    TEST_ASSERT_EQUAL_FLOAT(0.8f, jcal_axis_toward(axis, jcal_vec3(0.0f, 1.0f, 0.1f)).z);
    TEST_ASSERT_EQUAL_FLOAT(0.6f, jcal_axis_toward(axis, jcal_vec3(0.0f, 1.0f, 0.0f)).x);
}

static void a_range_follows_an_angle_across_180_deg(void)
{
    jcal_angle_range_t range;
    jcal_angle_range_reset(&range);
    TEST_ASSERT_EQUAL_INT(0, jcal_axis_sign_by_range(&range));
    double sum = 0.0;
    for (int i = 0; i <= 1000; ++i) {
        const double angle = 2.5 + (1.2 * sin(0.02 * i)); /* 1.3 to 3.7 rad */
        sum += angle;
        jcal_angle_range_push(&range, (float)remainder(angle, 2.0 * POSE_PI));
    }
    TEST_ASSERT_EQUAL_UINT(1001u, range.count);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 1.3f, range.low_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 3.7f, range.high_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)(sum / 1001.0), range.mean_rad);
    jcal_angle_range_push(&range, NAN);
    jcal_angle_range_push(&range, INFINITY);
    TEST_ASSERT_EQUAL_UINT(1001u, range.count);
}

static void the_mean_of_the_range_gives_the_sign_of_the_axis(void)
{
    for (int sign = -1; sign <= 1; ++sign) {
        jcal_angle_range_t range;
        jcal_angle_range_reset(&range);
        for (int i = 0; i < 1000; ++i) {
            jcal_angle_range_push(&range, ((float)sign * 0.6f) + sinf(0.0628318f * (float)i));
        }
        TEST_ASSERT_EQUAL_INT(sign, jcal_axis_sign_by_range(&range));
    }
}

static void the_end_of_the_range_can_be_made_zero(void)
{
    const pose_joint_t joint = {pose_any(3), pose_any(1), 0.0, true};
    jcal_joint_frames_t frames;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_frames_hinge(pose_axis1(&joint), pose_axis2(&joint), &frames));
    jcal_angle_range_t range;
    jcal_angle_range_reset(&range);
    for (int i = 0; i <= 100; ++i) {
        const pose_t pose = {0.5 + (0.01 * i), 0.0, 0.3, pose_any(i)};
        jcal_angle_range_push(&range, angles_of(&joint, &frames, &pose).flexion_rad);
    }
    const jcal_joint_angles_t is = {range.low_rad, 0.0f, 0.0f};
    jcal_frames_zero(&frames, &is, &ZERO);
    const pose_t pose = {0.5 + 1.0, 0.0, 0.3, pose_any(7)};
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.0f, angles_of(&joint, &frames, &pose).flexion_rad);
}

static void wrapping_keeps_what_is_in_range_and_refuses_what_is_too_large(void)
{
    TEST_ASSERT_EQUAL_FLOAT(-3.1f, jcal_angle_wrap(-3.1f));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)(3.2 - 2.0 * POSE_PI), jcal_angle_wrap(3.2f));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, (float)remainder(-50.0, 2.0 * POSE_PI), jcal_angle_wrap(-50.0f));
    TEST_ASSERT_TRUE(isnan(jcal_angle_wrap(2000.0f)));
    TEST_ASSERT_TRUE(isnan(jcal_angle_wrap(INFINITY)));
    TEST_ASSERT_TRUE(isnan(jcal_angle_wrap(NAN)));
}

static void what_is_no_orientation_has_no_angle(void)
{
    const jcal_quat_t one = {0.6f, 0.0f, 0.8f, 0.0f};
    const jcal_quat_t bad[4] = {
        {0.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 2.0f, 0.0f}, {0.6f, NAN, 0.8f, 0.0f}, {0.9f, 0.0f, 0.0f, 0.0f}};
    jcal_joint_frames_t frames;
    TEST_ASSERT_EQUAL_INT(JCAL_OK,
                          jcal_frames_hinge((jcal_vec3_t){0.0f, 0.0f, 1.0f}, (jcal_vec3_t){0.0f, 0.0f, 1.0f}, &frames));
    for (int i = 0; i < 4; ++i) {
        TEST_ASSERT_FLOAT_IS_NAN(jcal_joint_orientation(&frames, bad[i], one, 0.0f).w);
        TEST_ASSERT_FLOAT_IS_NAN(jcal_joint_orientation(&frames, one, bad[i], 0.0f).x);
    }
    const float headings[3] = {NAN, INFINITY, -1001.0f};
    for (int i = 0; i < 3; ++i) {
        const jcal_quat_t q = jcal_joint_orientation(&frames, one, one, headings[i]);
        TEST_ASSERT_FLOAT_IS_NAN(jcal_hinge_angles(q).flexion_rad);
        TEST_ASSERT_FLOAT_IS_NAN(jcal_two_dof_angles(q).flexion_rad);
        TEST_ASSERT_FLOAT_IS_NAN(jcal_two_dof_angles(q).pronation_rad);
        TEST_ASSERT_FLOAT_IS_NAN(jcal_two_dof_angles(q).carrying_rad);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_joint_orientation(&frames, one, one, 0.0f).w);
}

static void null_does_nothing(void)
{
    const jcal_quat_t one = {1.0f, 0.0f, 0.0f, 0.0f};
    const jcal_joint_angles_t zero = {0.0f, 0.0f, 0.0f}, some = {0.3f, 0.2f, 0.1f};
    const jcal_joint_angles_t lost = {NAN, 0.0f, 0.0f}, far = {0.0f, 2000.0f, 0.0f};
    jcal_joint_frames_t frames = {one, one};
    jcal_frames_zero(NULL, &some, &zero);
    jcal_frames_zero(&frames, NULL, &zero);
    jcal_frames_zero(&frames, &some, NULL);
    jcal_frames_zero(&frames, &lost, &zero);
    jcal_frames_zero(&frames, &zero, &far);
    TEST_ASSERT_EQUAL_MEMORY(&one, &frames.q_b1_s1, sizeof one);
    TEST_ASSERT_EQUAL_MEMORY(&one, &frames.q_b2_s2, sizeof one);
    TEST_ASSERT_FLOAT_IS_NAN(jcal_joint_orientation(NULL, one, one, 0.0f).w);
    jcal_angle_range_reset(NULL);
    jcal_angle_range_push(NULL, 0.1f);
    TEST_ASSERT_EQUAL_INT(0, jcal_axis_sign_by_range(NULL));
}

static void axes_without_direction_are_refused_and_nothing_is_written(void)
{
    const jcal_vec3_t good = {0.0f, 2.0f, 0.0f};
    const jcal_vec3_t bad[] = {{0.0f, 0.0f, 0.0f}, {NAN, 1.0f, 0.0f}, {INFINITY, 0.0f, 0.0f}};
    jcal_joint_frames_t out = {{7.0f, 0.0f, 0.0f, 0.0f}, {8.0f, 0.0f, 0.0f, 0.0f}};
    for (int i = 0; i < 3; ++i) {
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_hinge(good, bad[i], &out));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_hinge(bad[i], good, &out));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_two_dof(good, bad[i], &out));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_two_dof(bad[i], good, &out));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_two_dof(good, good, NULL));
    TEST_ASSERT_EQUAL_FLOAT(7.0f, out.q_b1_s1.w);
    TEST_ASSERT_EQUAL_FLOAT(8.0f, out.q_b2_s2.w);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_frames_two_dof(good, good, &out));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(all_three_angles_are_right_for_carrying_angles_to_30_deg);
    RUN_TEST(the_flexion_of_a_hinge_is_right_all_around);
    RUN_TEST(what_is_across_the_hinge_is_ignored);
    RUN_TEST(angles_do_not_depend_on_where_either_segment_heads);
    RUN_TEST(angles_do_not_depend_on_how_the_proximal_segment_lies);
    RUN_TEST(axes_may_point_anywhere_also_against_the_axis_they_are_brought_to);
    RUN_TEST(angles_carry_on_across_180_deg);
    RUN_TEST(parallel_axes_give_angles_that_mean_the_same_rotation);
    RUN_TEST(zeroing_turns_angles_by_the_same_amount_everywhere);
    RUN_TEST(either_sign_of_either_axis_gives_the_sign_of_its_angle);
    RUN_TEST(conventions_of_sign_are_what_their_names_say);
    RUN_TEST(isb_signs_on_the_right_arm);
    RUN_TEST(axes_are_turned_into_the_half_space_of_the_mounting);
    RUN_TEST(a_range_follows_an_angle_across_180_deg);
    RUN_TEST(the_mean_of_the_range_gives_the_sign_of_the_axis);
    RUN_TEST(the_end_of_the_range_can_be_made_zero);
    RUN_TEST(wrapping_keeps_what_is_in_range_and_refuses_what_is_too_large);
    RUN_TEST(what_is_no_orientation_has_no_angle);
    RUN_TEST(null_does_nothing);
    RUN_TEST(axes_without_direction_are_refused_and_nothing_is_written);
    return UNITY_END();
}
