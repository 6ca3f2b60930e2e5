/* SPDX-License-Identifier: MIT */
/// @file
/// Gravity in both specific forces, and whether one of them has the wrong sign. See center/gravity.h.
#include "center/gravity.h"

#include "jointcal/vec3.h"
#include "math/plane.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

#define GRAVITY_M_S2 9.81f
/// How far it may be off: 6 %.
#define OFF_MAX_M_S2 0.59f
/// What biases may make of it without being an error of scale, share.
#define SHARE_FREE 0.02f
/// Time constant of the means, s; time after which they count; and time of theirs after which gravity is known.
#define MEAN_S 3.0f
#define WARM_S 1.0f
#define KNOWN_S 2.0f
/// Least mean force that has a direction, m/s^2.
#define FORCE_MIN 1.0f
/// The mean lengths remember so much time, s.
#define MEMORY_S 60.0f
/// A longer pause than this begins new means, us: the frames may have begun anew in it.
#define PAUSE_US 250000u
/// Sums of horizontal forces halve at twice this time, s: their frames drift. Least time that says something.
#define SIDES_S 15.0f
#define SIDES_MIN_S 4.0f
/// Least mean product of horizontal forces, (m/s^2)^2; share of it that the mirrored sum must have, and how often the other one.
#define POWER_MIN 0.04f
#define MIRRORED_SHARE 0.5f
#define MIRRORED_TIMES 2.0f

/// The part of v across the unit vector u, in a right-handed basis (e1, e2, u) that changes smoothly with u.
static jcal_plane_t across(jcal_vec3_t u, jcal_vec3_t v)
{
    const float sign = (u.z < 0.0f) ? -1.0f : 1.0f;
    const float a = -1.0f / (sign + u.z);
    const float b = u.x * u.y * a;
    const jcal_vec3_t e1 = jcal_vec3(1.0f + (sign * u.x * u.x * a), sign * b, -sign * u.x);
    const jcal_vec3_t e2 = jcal_vec3(b, sign + (u.y * u.y * a), -u.y);
    const jcal_plane_t out = {jcal_vec3_dot(e1, v), jcal_vec3_dot(e2, v)};
    return out;
}

static void halve_sides(jcal_center_gravity_t *self)
{
    self->turned = jcal_plane_add(self->turned, -0.5f, self->turned);
    self->mirrored = jcal_plane_add(self->mirrored, -0.5f, self->mirrored);
    self->power *= 0.5f;
    self->power_s *= 0.5f;
}

/// `up1` and `up2` are the directions of gravity.
static void add_sides(jcal_center_gravity_t *self, const jcal_kinematic_t *sample, const jcal_center_place_t *place,
                      jcal_vec3_t up1, jcal_vec3_t up2)
{
    const jcal_vec3_t f1 = jcal_vec3_sub(sample->body1.a, jcal_segment_times(&sample->body1, place->r1));
    const jcal_vec3_t f2 = jcal_vec3_sub(sample->body2.a, jcal_segment_times(&sample->body2, place->r2));
    const jcal_plane_t h1 = across(up1, f1);
    const jcal_plane_t h2 = across(up2, f2);
    const float dt_s = sample->dt_s;
    self->turned = jcal_plane_add(self->turned, dt_s, jcal_plane_against(h2, h1));
    self->mirrored = jcal_plane_add(self->mirrored, dt_s, jcal_plane_times(h2, h1));
    self->power += dt_s * sqrtf(jcal_plane_norm2(h1) * jcal_plane_norm2(h2));
    self->power_s += dt_s;
    if (self->power_s > (2.0f * SIDES_S)) {
        halve_sides(self);
    }
}

/// The mean lengths take in those of this sample.
static void add_levels(jcal_center_gravity_t *self, float length1, float length2, float dt_s)
{
    self->time_s = jcal_min(self->time_s + dt_s, MEMORY_S);
    const float share = dt_s / self->time_s;
    self->level1 += share * (length1 - self->level1);
    self->level2 += share * (length2 - self->level2);
}

void jcal_center_gravity_add(jcal_center_gravity_t *self, const jcal_kinematic_t *sample,
                             const jcal_center_place_t *place, bool is_turning)
{
    const bool goes_on = (sample->t_us - self->last_us) < PAUSE_US;
    const float dt_s = sample->dt_s;
    self->last_us = sample->t_us;
    if (is_turning) {
        add_levels(self, jcal_vec3_norm(sample->body1.a), jcal_vec3_norm(sample->body2.a), dt_s);
        return;
    }
    self->chain_s = (goes_on ? jcal_min(self->chain_s, MEAN_S) : 0.0f) + dt_s;
    const float share = dt_s / self->chain_s;
    self->mean1 = jcal_vec3_add(self->mean1, jcal_vec3_scale(jcal_vec3_sub(sample->body1.a, self->mean1), share));
    self->mean2 = jcal_vec3_add(self->mean2, jcal_vec3_scale(jcal_vec3_sub(sample->body2.a, self->mean2), share));
    if (self->chain_s < WARM_S) {
        return;
    }
    const float length1 = jcal_vec3_norm(self->mean1);
    const float length2 = jcal_vec3_norm(self->mean2);
    add_levels(self, length1, length2, dt_s);
    if ((length1 > FORCE_MIN) && (length2 > FORCE_MIN)) {
        add_sides(self, sample, place, jcal_vec3_scale(self->mean1, 1.0f / length1),
                  jcal_vec3_scale(self->mean2, 1.0f / length2));
    }
}

void jcal_center_gravity_forget(jcal_center_gravity_t *self)
{
    const jcal_plane_t none = {0.0f, 0.0f};
    self->turned = none;
    self->mirrored = none;
    self->power = 0.0f;
    self->power_s = 0.0f;
}

/// True if one of the forces has the wrong sign.
static bool is_mirrored(const jcal_center_gravity_t *self, float slack)
{
    const float mirrored = jcal_plane_norm(self->mirrored);
    return (self->power_s >= SIDES_MIN_S) && (self->power > (POWER_MIN * self->power_s)) &&
           (mirrored > (slack * MIRRORED_SHARE * self->power)) &&
           (mirrored > (slack * MIRRORED_TIMES * jcal_plane_norm(self->turned)));
}

jcal_reason_t jcal_center_gravity_objects(const jcal_center_gravity_t *self, float slack)
{
    if (!(self->time_s >= KNOWN_S)) {
        return JCAL_REASON_UNCERTAIN;
    }
    const float off = jcal_max(fabsf(self->level1 - GRAVITY_M_S2), fabsf(self->level2 - GRAVITY_M_S2));
    if (!(off <= (slack * OFF_MAX_M_S2))) {
        return JCAL_REASON_GRAVITY_OFF;
    }
    return is_mirrored(self, slack) ? JCAL_REASON_NOT_ONE_JOINT : JCAL_REASON_NONE;
}

float jcal_center_gravity_shift(const jcal_center_gravity_t *self, const jcal_center_config_t *cfg,
                                const jcal_center_place_t *place, size_t sensor)
{
    const jcal_vec3_t r = (sensor == 0u) ? place->r1 : place->r2;
    const float level = (sensor == 0u) ? self->level1 : self->level2;
    const float off = fabsf((level / GRAVITY_M_S2) - 1.0f);
    const float forces = (self->time_s > 0.0f) ? jcal_max(off - SHARE_FREE, 0.0f) : 0.0f;
    const float rates = 2.0f * cfg->rate_mismatch;
    return sqrtf(jcal_vec3_dot(r, r) * ((forces * forces) + (rates * rates)));
}
