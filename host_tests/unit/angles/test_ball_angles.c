/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of the angles of ball joints, jointcal/joint_angles.h: segment frames from a pose, hip and shoulder, against rotations that are
/// put together in double precision.
#include "jointcal/joint_angles.h"
#include "jointcal/quat.h"
#include "unit/angles/pose.h"

#include "unity.h"

/* As of test_angles.c; the shoulder's angles are divided by the sine of the elevation. */
static const double ANGLE_TOL = 6e-6;

/* Angles of all sizes, rad. */
static double some(int k)
{
    return 3.0 * sin(1.7 * k + 0.3);
}

/* About x, y or z (0, 1, 2). */
static pose_quat_t about(int axis, double angle)
{
    const double s = sin(0.5 * angle);
    const pose_quat_t out = {cos(0.5 * angle), (axis == 0) ? s : 0.0, (axis == 1) ? s : 0.0, (axis == 2) ? s : 0.0};
    return out;
}

/* A person who stands with a heading, sensors mounted anyhow: proximal segment upright, then both segments moved. */
typedef struct {
    pose_quat_t mount1, mount2; /* segment to sensor */
    pose_quat_t upright;        /* segment to earth in the pose */
    double heading;             /* E2 to E1 */
} person_t;

static person_t person(int k)
{
    /* y up, z to the right, x forward: x to y, y to z, z to x, then the heading of the right-hand side. */
    const pose_quat_t level = {0.5, 0.5, 0.5, 0.5};
    const person_t out = {pose_any(k), pose_any(3 * k + 7), pose_mul(about(2, some(2 * k + 1)), level), some(5 * k)};
    return out;
}

static void sensors(const person_t *p, pose_quat_t proximal, pose_quat_t relative, jcal_quat_t *q1, jcal_quat_t *q2)
{
    const pose_quat_t b1 = pose_mul(p->upright, proximal);
    const pose_quat_t b2 = pose_mul(b1, relative);
    *q1 = pose_single(pose_mul(b1, pose_conj(p->mount1)));
    *q2 = pose_single(pose_mul(pose_mul(about(2, -p->heading), b2), pose_conj(p->mount2)));
}

static jcal_vec3_t right_in_sensor1(const person_t *p)
{
    return jcal_quat_rotate(pose_single(p->mount1), jcal_vec3(0.0f, 0.0f, 1.0f));
}

static jcal_joint_frames_t posed(const person_t *p)
{
    const pose_quat_t none = {1.0, 0.0, 0.0, 0.0};
    jcal_quat_t q1;
    jcal_quat_t q2;
    jcal_joint_frames_t frames;
    sensors(p, none, none, &q1, &q2);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_frames_pose(q1, q2, (float)p->heading, right_in_sensor1(p), &frames));
    return frames;
}

static jcal_quat_t relative_of(const person_t *p, const jcal_joint_frames_t *frames, int k, pose_quat_t relative)
{
    jcal_quat_t q1;
    jcal_quat_t q2;
    sensors(p, pose_any(9 * k + 2), relative, &q1, &q2);
    return jcal_joint_orientation(frames, q1, q2, (float)p->heading);
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void a_hip_has_flexion_adduction_and_rotation(void)
{
    for (int k = 0; k < 80; ++k) {
        const person_t p = person(k);
        const jcal_joint_frames_t frames = posed(&p);
        const double flexion = some(k + 3);
        const double adduction = 0.4 * some(k + 17);
        const double rotation = some(k + 29);
        const pose_quat_t r = pose_mul(pose_mul(about(2, flexion), about(0, adduction)), about(1, rotation));
        const jcal_joint_angles_t got = jcal_hip_angles(relative_of(&p, &frames, k, r));
        const double tolerance = ANGLE_TOL / cos(adduction);
        TEST_ASSERT_TRUE(pose_apart((double)got.flexion_rad, flexion) < tolerance);
        TEST_ASSERT_TRUE(pose_apart((double)got.carrying_rad, adduction) < tolerance);
        TEST_ASSERT_TRUE(pose_apart((double)got.pronation_rad, rotation) < tolerance);
    }
}

static void a_shoulder_has_plane_elevation_and_rotation(void)
{
    for (int k = 0; k < 80; ++k) {
        const person_t p = person(k);
        const jcal_joint_frames_t frames = posed(&p);
        const double plane = some(k + 3);
        const double elevation = 0.1 + 2.9 * fabs(sin(0.37 * k));
        const double rotation = some(k + 29);
        const pose_quat_t r = pose_mul(pose_mul(about(1, plane), about(0, -elevation)), about(1, rotation));
        const jcal_shoulder_angles_t got = jcal_shoulder_angles(relative_of(&p, &frames, k, r));
        const double tolerance = ANGLE_TOL / sin(elevation);
        TEST_ASSERT_TRUE(pose_apart((double)got.plane_rad, plane) < tolerance);
        TEST_ASSERT_TRUE(fabs((double)got.elevation_rad - elevation) < tolerance);
        TEST_ASSERT_TRUE(pose_apart((double)got.rotation_rad, rotation) < tolerance);
    }
}

/* A right arm that is lifted to the side is in plane 0; its elbow goes to the right. Lifted forward it is in a plane of 90 deg. */
static void planes_are_those_of_isb(void)
{
    const pose_quat_t none = {1.0, 0.0, 0.0, 0.0};
    const person_t p = {none, none, none, 0.0};
    jcal_joint_frames_t frames = {pose_single(none), pose_single(none)};
    const double lifted = 1.2;
    const jcal_shoulder_angles_t side = jcal_shoulder_angles(relative_of(&p, &frames, 1, about(0, -lifted)));
    const jcal_shoulder_angles_t forward = jcal_shoulder_angles(relative_of(&p, &frames, 1, about(2, lifted)));
    TEST_ASSERT_TRUE(pose_apart((double)side.plane_rad, 0.0) < ANGLE_TOL);
    TEST_ASSERT_TRUE(fabs((double)side.elevation_rad - lifted) < ANGLE_TOL);
    TEST_ASSERT_TRUE(pose_apart((double)forward.plane_rad, 0.5 * POSE_PI) < 2.0 * ANGLE_TOL);
    TEST_ASSERT_TRUE(fabs((double)forward.elevation_rad - lifted) < ANGLE_TOL);
}

static void an_arm_that_hangs_has_a_rotation_only(void)
{
    const person_t p = person(4);
    const jcal_joint_frames_t frames = posed(&p);
    const jcal_shoulder_angles_t got = jcal_shoulder_angles(relative_of(&p, &frames, 4, about(1, 0.7)));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, got.plane_rad);
    TEST_ASSERT_TRUE((double)got.elevation_rad < 1e-3);
    TEST_ASSERT_TRUE(fabs((double)got.rotation_rad - 0.7) < ANGLE_TOL);
    const jcal_shoulder_angles_t nothing = jcal_shoulder_angles(jcal_quat(NAN, NAN, NAN, NAN));
    TEST_ASSERT_TRUE(isnan(nothing.elevation_rad));
}

static void a_pose_needs_orientations_and_a_level_direction(void)
{
    const jcal_quat_t one = jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
    const jcal_vec3_t right = jcal_vec3(1.0f, 0.0f, 0.3f);
    jcal_joint_frames_t frames = {jcal_quat(0.0f, 1.0f, 0.0f, 0.0f), jcal_quat(0.0f, 0.0f, 1.0f, 0.0f)};
    const jcal_joint_frames_t before = frames;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_pose(one, one, 0.0f, right, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_pose(jcal_quat(0.5f, 0.0f, 0.0f, 0.0f), one, 0.0f, right, &frames));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_pose(one, jcal_quat(NAN, 0.0f, 0.0f, 0.0f), 0.0f, right, &frames));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_pose(one, one, NAN, right, &frames));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_pose(one, one, 0.0f, jcal_vec3(0.0f, 0.0f, 1.0f), &frames));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_pose(one, one, 0.0f, jcal_vec3(0.19f, 0.0f, 1.0f), &frames));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_frames_pose(one, one, 0.0f, jcal_vec3(NAN, 0.0f, 1.0f), &frames));
    TEST_ASSERT_EQUAL_MEMORY(&before, &frames, sizeof frames);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_frames_pose(one, one, 0.0f, jcal_vec3(-1.0f, 0.0f, 0.0f), &frames));
    const jcal_vec3_t z = jcal_quat_rotate(frames.q_b1_s1, jcal_vec3(0.0f, 0.0f, 1.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -1.0f, z.x);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_frames_pose(one, one, 0.0f, jcal_vec3(0.0f, 0.21f, 1.0f), &frames));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_hip_has_flexion_adduction_and_rotation);
    RUN_TEST(a_shoulder_has_plane_elevation_and_rotation);
    RUN_TEST(planes_are_those_of_isb);
    RUN_TEST(an_arm_that_hangs_has_a_rotation_only);
    RUN_TEST(a_pose_needs_orientations_and_a_level_direction);
    return UNITY_END();
}
