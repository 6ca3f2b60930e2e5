/* SPDX-License-Identifier: MIT */
/// @file
/// Joint angles from the orientations of two IMUs and what a calibration found: flexion of a hinge; flexion, pronation and
/// carrying angle of a joint with two axes; of a ball joint, which has no axes, hip's and shoulder's angles from a pose.
///
/// Chain: jcal_frames_hinge or jcal_frames_two_dof once per calibration; for each sample jcal_joint_orientation with the heading
/// offset (joint_heading.h, or jcal_two_dof_get), then jcal_hinge_angles or jcal_two_dof_angles. What is zero is a
/// convention that no constraint of the joint knows: jcal_frames_zero takes it from a pose, or from the range of motion.
///
/// Signs. Flexion is positive about the z axis of segment frame B1, which is axis 1; pronation about the y axis of B2, which is
/// axis 2. ISB (Wu et al., J. Biomech. 2005, elbow), flexion and pronation positive: axis 1 points to the person's right, axis 2
/// toward the elbow on the right arm and away from it on the left one. A calibration does not know that [LAI22, C.3], so
/// jcal_axis_toward chooses by how the sensors are mounted, jcal_axis_sign_by_range by how the joint can move.
#ifndef JCAL_JOINT_ANGLES_H
#define JCAL_JOINT_ANGLES_H

#include "jointcal/config.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Segment frames B1 (proximal) and B2 (distal) as seen from the sensors.
typedef struct {
    jcal_quat_t q_b1_s1;  ///< B1 to sensor frame 1; z of B1 is axis 1.
    jcal_quat_t q_b2_s2;  ///< B2 to sensor frame 2; y of B2 is axis 2 (two axes), or z of B2 is (hinge).
} jcal_joint_frames_t;

/// Angles of a joint, rad. A hinge has no pronation and no carrying angle: 0.
typedef struct {
    float flexion_rad;    ///< FE, alpha, in [-pi, pi].
    float pronation_rad;  ///< PS, gamma, in [-pi, pi].
    float carrying_rad;   ///< beta, in [-pi/2, pi/2]: sin(beta) is the scalar product of the axes in a common frame.
} jcal_joint_angles_t;

/// Which motions count as positive in what is reported. Carrying angles stay as they are.
typedef enum {
    JCAL_POSITIVE_ISB = 0,                  ///< Flexion and pronation, as ISB has it (default).
    JCAL_POSITIVE_FLEXION_SUPINATION = 1,   ///< Flexion and supination.
    JCAL_POSITIVE_EXTENSION_PRONATION = 2,  ///< Extension and pronation.
    JCAL_POSITIVE_EXTENSION_SUPINATION = 3  ///< Extension and supination.
} jcal_positive_t;

/// Range of one angle over time, followed across +-180 deg: no two values in a row may lie half a turn or more apart.
/// Caller-owned, plain, copyable; start from jcal_angle_range_reset.
typedef struct {
    float last_rad;      ///< Last value.
    float followed_rad;  ///< The same, with turns counted from the first value on.
    float low_rad;       ///< Smallest value so far; may leave [-pi, pi].
    float high_rad;      ///< Largest value so far; may leave [-pi, pi].
    float mean_rad;      ///< Mean of all values.
    uint32_t count;      ///< Number of values; nothing else means anything while it is 0.
} jcal_angle_range_t;

/// The same angle in [-pi, pi]; NaN if it is not finite or beyond 1000 rad.
float jcal_angle_wrap(float angle_rad);

/// Segment frames of a hinge whose flexion is not yet zeroed: z of either is its axis.
///
/// Inputs:   axis1, axis2  axes in sensor frames 1 and 2 with the right sign pairing, any length.
/// Errors:   JCAL_ERR_ARG (null, or an axis that has no direction); out untouched.
/// Threads:  no state.
jcal_status_t jcal_frames_hinge(jcal_vec3_t axis1, jcal_vec3_t axis2, jcal_joint_frames_t *out);

/// Segment frames B'1 and B'2 of a joint with two axes: z of B'1 is axis 1, y of B'2 is axis 2.
///
/// Inputs:   axis1, axis2  j1 and j2 in sensor frames 1 and 2, any length.
/// Errors:   JCAL_ERR_ARG (null, or an axis that has no direction); out untouched.
/// Source:   [LAI22] eq. (19), (20). Differs from the paper in: no arccos; the angle's tangent is known, too.
/// Threads:  no state.
jcal_status_t jcal_frames_two_dof(jcal_vec3_t axis1, jcal_vec3_t axis2, jcal_joint_frames_t *out);

/// Orientation of B2 relative to B1: rotates from B2 to B1.
///
/// Inputs:   q_s1_e1, q_s2_e2  unit quaternions of the sensors; heading_rad  turns E2 to E1 about z, at most 1000 rad.
/// Returns:  a unit quaternion; four NaN if frames is null, the length of a quaternion differs from 1 by more than 0.05, or
///           the heading is not finite or too large.
/// Source:   [LAI22] eq. (6), (21).
/// Threads:  no state.
jcal_quat_t jcal_joint_orientation(const jcal_joint_frames_t *frames, jcal_quat_t q_s1_e1, jcal_quat_t q_s2_e2,
                                   float heading_rad);

/// Flexion of a hinge: the part of the rotation that is about z. What is left, errors of axes or heading, is ignored.
///
/// A rotation by exactly half a turn about an axis across z has no such part; it gives 0. NaN gives NaN.
/// Threads:  no state.
jcal_joint_angles_t jcal_hinge_angles(jcal_quat_t q_b2_b1);

/// z-x'-y'' Euler angles: flexion, carrying angle, pronation.
///
/// Where the axes are parallel (carrying angle of +-90 deg, to 1e-3 rad) only a sum is known: all of it is called flexion. NaN gives NaN.
/// Source:   [LAI22] eq. (22)-(24). Differs from the paper in: (23) prints q3 where q_z is meant; arcsin by way of the cosine, which
///           keeps its accuracy near 90 deg.
/// Threads:  no state.
jcal_joint_angles_t jcal_two_dof_angles(jcal_quat_t q_b2_b1);

/// Segment frames of a ball joint from a pose in which both coincide, such as standing upright: y is up, z is level and points about along
/// `toward1`, by ISB to the person's right, x is forward.
///
/// Inputs:   q_s1_e1, q_s2_e2, heading_rad  as of jcal_joint_orientation, in the pose; toward1  a direction in sensor frame 1.
/// Errors:   JCAL_ERR_ARG (null, orientations or heading that are none, toward1 within 11 deg of upright); out untouched.
/// Threads:  no state.
jcal_status_t jcal_frames_pose(jcal_quat_t q_s1_e1, jcal_quat_t q_s2_e2, float heading_rad, jcal_vec3_t toward1,
                               jcal_joint_frames_t *out);

/// Hip: z-x'-y'' Euler angles of ISB (Wu et al., J. Biomech. 2002): flexion, adduction, internal rotation of the right leg. The same as
/// jcal_two_dof_angles, with adduction in the place of the carrying angle and rotation in that of pronation.
/// Threads:  no state.
jcal_joint_angles_t jcal_hip_angles(jcal_quat_t q_b2_b1);

/// Angles of a shoulder, rad.
typedef struct {
    float plane_rad;      ///< Plane of elevation, in [-pi, pi]: 0 to the side, a right angle forward (right arm).
    float elevation_rad;  ///< In [0, pi]. ISB counts it negative.
    float rotation_rad;   ///< Axial rotation, in [-pi, pi].
} jcal_shoulder_angles_t;

/// Shoulder: y-x'-y'' Euler angles of ISB (Wu et al., J. Biomech. 2005).
///
/// Where the arm hangs as in the pose (elevation below 1e-3 rad) only a sum is known: all of it is called rotation. NaN gives NaN.
/// Threads:  no state.
jcal_shoulder_angles_t jcal_shoulder_angles(jcal_quat_t q_b2_b1);

/// Turns the segment frames so that the pose that now gives the angles `is` will give `shall` instead.
///
/// With a pose: `is` are the angles in it, `shall` the true ones (all 0, or known ones). With the range of motion:
/// `is` is the end of a jcal_angle_range_t, `shall` what the joint has there. Carrying angles do not count: nothing changes them.
/// Frames stay as they are if a pointer is null or a difference of angles is not finite or beyond 1000 rad.
/// Source:   [LAI22] eq. (25), (26).
/// Threads:  no state.
void jcal_frames_zero(jcal_joint_frames_t *frames, const jcal_joint_angles_t *is, const jcal_joint_angles_t *shall);

/// The angles in a convention of signs.
/// Threads:  no state.
jcal_joint_angles_t jcal_angles_signed(jcal_joint_angles_t angles, jcal_positive_t positive);

/// The axis or its opposite, whichever points into the half-space around `direction`; the axis itself if it lies on the border.
///
/// Source:   [LAI22] C.3, first way: a sensor placement that is roughly known.
/// Threads:  no state.
jcal_vec3_t jcal_axis_toward(jcal_vec3_t axis, jcal_vec3_t direction);

/// Nothing seen yet. Null: does nothing.
/// Threads:  no state.
void jcal_angle_range_reset(jcal_angle_range_t *self);

/// Takes in the next value; one that is not finite or beyond 1000 rad is left out. Null: does nothing. Cost: constant.
/// Threads:  no state.
void jcal_angle_range_push(jcal_angle_range_t *self, float angle_rad);

/// +1 if the axis of this angle has the sign that makes its mean positive, -1 if it is the other one, 0 if that is open: null, no
/// values, or a mean within 5 % of the range from zero.
///
/// Zero must have been set before (jcal_frames_zero): full extension for flexion, full supination for pronation. For a
/// hinge both axes change their signs together.
/// Source:   [LAI22] C.3, second way: the joint's range of motion.
int jcal_axis_sign_by_range(const jcal_angle_range_t *range);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_JOINT_ANGLES_H */
