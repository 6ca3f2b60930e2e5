/* SPDX-License-Identifier: MIT */
/// @file
/// 6D orientation filter. See imu/attitude.h.
#include "imu/attitude.h"

#include "imu/turn.h"

/// A mean specific force below this tells no direction, m/s^2.
#define FORCE_MIN_M_S2 0.5f
/// 1 + z of a direction nearer to straight down than 0.1 deg: any horizontal axis does.
#define DOWN 1e-6f

/// The smallest rotation that turns a direction to z.
static jcal_quat_t upright(jcal_vec3_t d)
{
    const float w2 = 0.5f * (1.0f + d.z);
    if (!(w2 > DOWN)) {
        return jcal_quat(0.0f, 1.0f, 0.0f, 0.0f);
    }
    const float w = sqrtf(w2);
    const float half = 0.5f / w;
    return jcal_quat(w, half * d.y, -half * d.x, 0.0f);
}

/// Turns the orientation so that `force`, in the earth frame, points up. False if it has no direction.
static bool correct(jcal_attitude_t *self, jcal_vec3_t force, jcal_quat_t *correction)
{
    const float length = jcal_vec3_norm(force);
    if (!(length > FORCE_MIN_M_S2)) {
        return false;
    }
    *correction = upright(jcal_vec3_scale(force, 1.0f / length));
    self->q_s_e = jcal_quat_normalise(jcal_quat_mul(*correction, self->q_s_e));
    return true;
}

void jcal_attitude_begin(jcal_attitude_t *self, jcal_vec3_t gyr_rad_s, jcal_vec3_t acc_m_s2)
{
    const jcal_vec3_t zero = {0.0f, 0.0f, 0.0f};
    jcal_quat_t correction;
    (void)correct(self, jcal_quat_rotate(self->q_s_e, acc_m_s2), &correction);
    self->gyr_rad_s = gyr_rad_s;
    self->sum_m_s = zero;
    self->mean_m_s2 = zero;
    self->slope_m_s2 = zero;
}

/// q of nearly unit length to unit length: one step of Newton's method.
static jcal_quat_t keep_unit(jcal_quat_t q)
{
    const float s = 1.5f - (0.5f * ((q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z)));
    return jcal_quat(s * q.w, s * q.x, s * q.y, s * q.z);
}

jcal_vec3_t jcal_attitude_turn(jcal_attitude_t *self, jcal_vec3_t gyr_rad_s, jcal_vec3_t acc_m_s2, float dt_s,
                               float r[9])
{
    const jcal_vec3_t angle = jcal_vec3_scale(jcal_vec3_add(self->gyr_rad_s, gyr_rad_s), 0.5f * dt_s);
    self->q_s_e = keep_unit(jcal_quat_mul(self->q_s_e, jcal_turn_by(angle)));
    self->gyr_rad_s = gyr_rad_s;
    jcal_turn_matrix(self->q_s_e, r);
    const jcal_vec3_t force = jcal_turn_times(r, acc_m_s2);
    self->sum_m_s = jcal_vec3_add(self->sum_m_s, jcal_vec3_scale(force, dt_s));
    return force;
}

bool jcal_attitude_level(jcal_attitude_t *self, const jcal_lowpass_t *by, float dt_s, jcal_vec3_t *correction_rad)
{
    const jcal_vec3_t force = jcal_vec3_scale(self->sum_m_s, 1.0f / dt_s);
    jcal_vec3_t *const mean = &self->mean_m_s2;
    jcal_vec3_t *const slope = &self->slope_m_s2;
    const float x = jcal_lowpass_put(by, force.x, &mean->x, &slope->x);
    const float y = jcal_lowpass_put(by, force.y, &mean->y, &slope->y);
    const float z = jcal_lowpass_put(by, force.z, &mean->z, &slope->z);
    self->sum_m_s = jcal_vec3(0.0f, 0.0f, 0.0f);
    jcal_quat_t correction;
    if (!correct(self, jcal_vec3(x, y, z), &correction)) {
        return false;
    }
    *mean = jcal_quat_rotate(correction, *mean);
    *slope = jcal_quat_rotate(correction, *slope);
    *correction_rad = jcal_vec3(2.0f * correction.x, 2.0f * correction.y, 0.0f); /* small, but for a start */
    return true;
}
