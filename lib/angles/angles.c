/* SPDX-License-Identifier: MIT */
/// @file
/// Joint angles. See joint_angles.h.
#include "jointcal/joint_angles.h"

#include "jointcal/quat.h"
#include "math/angle.h"
#include "math/scalar.h"
#include "math/sphere.h"
#include "sample/unit.h"

#include <math.h>
#include <stddef.h>

/// Cosine of the carrying angle below which the two axes count as parallel.
#define PARALLEL_COS 1e-3f

/// A mean angle below this share of the range says nothing about the sign.
#define OPEN_SHARE 0.05f

/* False for NaN and for angles whose sine has no digits left. */
static bool can_be_turned_by(float angle_rad)
{
    return fabsf(angle_rad) <= JCAL_CIS_MAX_RAD;
}

/* The rotation by `angle_rad` about z. */
static jcal_quat_t about_z(float angle_rad)
{
    const jcal_plane_t half = jcal_cis(0.5f * angle_rad);
    return jcal_quat(half.re, 0.0f, 0.0f, half.im);
}

/* The rotation by `angle_rad` about y. */
static jcal_quat_t about_y(float angle_rad)
{
    const jcal_plane_t half = jcal_cis(0.5f * angle_rad);
    return jcal_quat(half.re, 0.0f, half.im, 0.0f);
}

/* The smallest rotation that takes unit vector `from` to unit vector `to`; if they are opposite, about anything across.
 * Its half angle has the tangent sin / (1 + cos) = (1 - cos) / sin; either divisor is used where it is large. */
static jcal_quat_t shortest_turn(jcal_vec3_t from, jcal_vec3_t to)
{
    const jcal_vec3_t cross = jcal_vec3_cross(from, to);
    const float cos_angle = jcal_vec3_dot(from, to);
    if (cos_angle >= 0.0f) {
        return jcal_quat_normalise(jcal_quat(1.0f + cos_angle, cross.x, cross.y, cross.z));
    }
    const float sin_angle = jcal_vec3_norm(cross);
    jcal_vec3_t about = jcal_sphere_tangent(from).u;
    if (sin_angle > 0.0f) {
        about = jcal_vec3_scale(cross, 1.0f / sin_angle);
    }
    const jcal_vec3_t v = jcal_vec3_scale(about, 1.0f - cos_angle);
    return jcal_quat_normalise(jcal_quat(sin_angle, v.x, v.y, v.z));
}

/* Square of the least level part of the direction that a pose is aligned with: 11 deg from upright. */
#define POSE_LEVEL2_MIN 0.04f

/* The unit vector along an axis; false if it has no direction. */
static bool direction_of(jcal_vec3_t axis, jcal_vec3_t *out)
{
    *out = jcal_vec3_normalise(axis);
    return jcal_vec3_is_finite(*out) && (jcal_vec3_dot(*out, *out) > 0.5f);
}

static jcal_status_t frames(jcal_vec3_t axis1, jcal_vec3_t axis2, jcal_vec3_t place2, jcal_joint_frames_t *out)
{
    jcal_vec3_t j1;
    jcal_vec3_t j2;
    if ((out == NULL) || !direction_of(axis1, &j1) || !direction_of(axis2, &j2)) {
        return JCAL_ERR_ARG;
    }
    out->q_b1_s1 = shortest_turn(jcal_vec3(0.0f, 0.0f, 1.0f), j1);
    out->q_b2_s2 = shortest_turn(place2, j2);
    return JCAL_OK;
}

float jcal_angle_wrap(float angle_rad)
{
    if (fabsf(angle_rad) <= JCAL_PI) {
        return angle_rad; /* in range already: every bit is kept */
    }
    const jcal_plane_t turn = jcal_cis(angle_rad);
    return jcal_atan2(turn.im, turn.re);
}

jcal_status_t jcal_frames_hinge(jcal_vec3_t axis1, jcal_vec3_t axis2, jcal_joint_frames_t *out)
{
    return frames(axis1, axis2, jcal_vec3(0.0f, 0.0f, 1.0f), out);
}

jcal_status_t jcal_frames_two_dof(jcal_vec3_t axis1, jcal_vec3_t axis2, jcal_joint_frames_t *out)
{
    return frames(axis1, axis2, jcal_vec3(0.0f, 1.0f, 0.0f), out);
}

jcal_quat_t jcal_joint_orientation(const jcal_joint_frames_t *frames, jcal_quat_t q_s1_e1, jcal_quat_t q_s2_e2,
                                   float heading_rad)
{
    if ((frames == NULL) || !jcal_is_unit(q_s1_e1) || !jcal_is_unit(q_s2_e2) || !can_be_turned_by(heading_rad)) {
        return jcal_quat(NAN, NAN, NAN, NAN); /* an angle of 0 would look like a measurement */
    }
    const jcal_quat_t q_b1_e1 = jcal_quat_mul(q_s1_e1, frames->q_b1_s1);
    const jcal_quat_t q_b2_e2 = jcal_quat_mul(q_s2_e2, frames->q_b2_s2);
    const jcal_quat_t q_b2_e1 = jcal_quat_mul(about_z(heading_rad), q_b2_e2);
    return jcal_quat_normalise(jcal_quat_mul(jcal_quat_conj(q_b1_e1), q_b2_e1));
}

jcal_joint_angles_t jcal_hinge_angles(jcal_quat_t q_b2_b1)
{
    const jcal_quat_t q = q_b2_b1;
    /* tan(angle / 2) = z / w, so this has the right quadrant whichever of q and -q it is. */
    const jcal_joint_angles_t out = {jcal_atan2(2.0f * q.w * q.z, (q.w - q.z) * (q.w + q.z)), 0.0f, 0.0f};
    return out;
}

jcal_joint_angles_t jcal_two_dof_angles(jcal_quat_t q_b2_b1)
{
    const jcal_quat_t q = q_b2_b1;
    const float ww = q.w * q.w;
    const float xx = q.x * q.x;
    const float yy = q.y * q.y;
    const float zz = q.z * q.z;
    /* cos(beta) times sine and cosine of alpha, as in (22), and the sine of beta, as in (23). */
    const float sin_alpha = 2.0f * ((q.w * q.z) - (q.x * q.y));
    const float cos_alpha = (ww - xx) + (yy - zz);
    const float sin_beta = 2.0f * ((q.w * q.x) + (q.y * q.z));
    const float cos_beta = sqrtf((sin_alpha * sin_alpha) + (cos_alpha * cos_alpha));
    jcal_joint_angles_t out = {0.0f, 0.0f, jcal_atan2(sin_beta, cos_beta)};
    if (cos_beta < PARALLEL_COS) {
        out.flexion_rad = jcal_atan2(2.0f * ((q.w * q.z) + (q.x * q.y)), (ww + xx) - (yy + zz));
        return out;
    }
    out.flexion_rad = jcal_atan2(sin_alpha, cos_alpha);
    out.pronation_rad = jcal_atan2(2.0f * ((q.w * q.y) - (q.x * q.z)), (ww - xx) + (zz - yy));
    return out;
}

jcal_status_t jcal_frames_pose(jcal_quat_t q_s1_e1, jcal_quat_t q_s2_e2, float heading_rad, jcal_vec3_t toward1,
                               jcal_joint_frames_t *out)
{
    if ((out == NULL) || !jcal_is_unit(q_s1_e1) || !jcal_is_unit(q_s2_e2) || !can_be_turned_by(heading_rad)) {
        return JCAL_ERR_ARG;
    }
    jcal_vec3_t right;
    jcal_vec3_t level;
    if (!direction_of(toward1, &right)) {
        return JCAL_ERR_ARG;
    }
    const jcal_vec3_t z = jcal_quat_rotate(jcal_quat_normalise(q_s1_e1), right);
    if ((((z.x * z.x) + (z.y * z.y)) < POSE_LEVEL2_MIN) || !direction_of(jcal_vec3(z.x, z.y, 0.0f), &level)) {
        return JCAL_ERR_ARG;
    }
    const float w = sqrtf(0.5f * (1.0f + jcal_max(level.x, -1.0f))); /* half the angle of `level` about z */
    const float up = copysignf(sqrtf(jcal_max(1.0f - (w * w), 0.0f)), level.y);
    const jcal_quat_t upright = jcal_quat(0.5f, 0.5f, 0.5f, 0.5f); /* x to y, y to z, z to x */
    const jcal_quat_t q_b_e1 = jcal_quat_mul(jcal_quat(w, 0.0f, 0.0f, up), upright);
    const jcal_quat_t q_s2_e1 = jcal_quat_mul(about_z(heading_rad), q_s2_e2);
    out->q_b1_s1 = jcal_quat_normalise(jcal_quat_mul(jcal_quat_conj(q_s1_e1), q_b_e1));
    out->q_b2_s2 = jcal_quat_normalise(jcal_quat_mul(jcal_quat_conj(q_s2_e1), q_b_e1));
    return JCAL_OK;
}

jcal_joint_angles_t jcal_hip_angles(jcal_quat_t q_b2_b1)
{
    return jcal_two_dof_angles(q_b2_b1);
}

jcal_shoulder_angles_t jcal_shoulder_angles(jcal_quat_t q_b2_b1)
{
    /* R = Ry(plane) Rx(-elevation) Ry(rotation): its second column and its second row. */
    const jcal_quat_t q = q_b2_b1;
    const float r01 = 2.0f * ((q.x * q.y) - (q.w * q.z));
    const float r21 = 2.0f * ((q.y * q.z) + (q.w * q.x));
    const float r10 = 2.0f * ((q.x * q.y) + (q.w * q.z));
    const float r12 = 2.0f * ((q.y * q.z) - (q.w * q.x));
    const float r11 = ((q.w * q.w) + (q.y * q.y)) - ((q.x * q.x) + (q.z * q.z));
    const float sine = sqrtf((r01 * r01) + (r21 * r21));
    jcal_shoulder_angles_t out = {0.0f, jcal_atan2(sine, r11), 0.0f};
    if (sine < PARALLEL_COS) {
        out.rotation_rad =
            jcal_atan2(2.0f * ((q.x * q.z) + (q.w * q.y)), ((q.w * q.w) + (q.x * q.x)) - ((q.y * q.y) + (q.z * q.z)));
        return out;
    }
    out.plane_rad = jcal_atan2(-r01, -r21);
    out.rotation_rad = jcal_atan2(-r10, r12);
    return out;
}

void jcal_frames_zero(jcal_joint_frames_t *frames, const jcal_joint_angles_t *is, const jcal_joint_angles_t *shall)
{
    if ((frames == NULL) || (is == NULL) || (shall == NULL)) {
        return;
    }
    const float flexion_rad = is->flexion_rad - shall->flexion_rad;       /* (25) */
    const float pronation_rad = shall->pronation_rad - is->pronation_rad; /* (26) */
    if (!can_be_turned_by(flexion_rad) || !can_be_turned_by(pronation_rad)) {
        return;
    }
    const jcal_quat_t turn1 = about_z(flexion_rad);
    const jcal_quat_t turn2 = about_y(pronation_rad);
    frames->q_b1_s1 = jcal_quat_normalise(jcal_quat_mul(frames->q_b1_s1, turn1));
    frames->q_b2_s2 = jcal_quat_normalise(jcal_quat_mul(frames->q_b2_s2, turn2));
}

jcal_joint_angles_t jcal_angles_signed(jcal_joint_angles_t angles, jcal_positive_t positive)
{
    const bool extension =
        (positive == JCAL_POSITIVE_EXTENSION_PRONATION) || (positive == JCAL_POSITIVE_EXTENSION_SUPINATION);
    const bool supination =
        (positive == JCAL_POSITIVE_FLEXION_SUPINATION) || (positive == JCAL_POSITIVE_EXTENSION_SUPINATION);
    const jcal_joint_angles_t out = {extension ? -angles.flexion_rad : angles.flexion_rad,
                                     supination ? -angles.pronation_rad : angles.pronation_rad, angles.carrying_rad};
    return out;
}

jcal_vec3_t jcal_axis_toward(jcal_vec3_t axis, jcal_vec3_t direction)
{
    return (jcal_vec3_dot(axis, direction) < 0.0f) ? jcal_vec3_scale(axis, -1.0f) : axis;
}

void jcal_angle_range_reset(jcal_angle_range_t *self)
{
    const jcal_angle_range_t empty = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0u};
    if (self != NULL) {
        *self = empty;
    }
}

void jcal_angle_range_push(jcal_angle_range_t *self, float angle_rad)
{
    if ((self == NULL) || !can_be_turned_by(angle_rad)) {
        return;
    }
    const float wrapped = jcal_angle_wrap(angle_rad);
    float value = wrapped;
    if (self->count == 0u) {
        self->low_rad = value;
        self->high_rad = value;
    } else {
        value = self->followed_rad + jcal_angle_wrap(wrapped - self->last_rad);
    }
    self->last_rad = wrapped;
    self->followed_rad = value;
    self->low_rad = (value < self->low_rad) ? value : self->low_rad;
    self->high_rad = (value > self->high_rad) ? value : self->high_rad;
    self->count += (self->count < UINT32_MAX) ? 1u : 0u;
    self->mean_rad += (value - self->mean_rad) / (float)self->count;
}

int jcal_axis_sign_by_range(const jcal_angle_range_t *range)
{
    if ((range == NULL) || (range->count == 0u) ||
        (fabsf(range->mean_rad) <= (OPEN_SHARE * (range->high_rad - range->low_rad)))) {
        return 0;
    }
    return (range->mean_rad > 0.0f) ? 1 : -1;
}
