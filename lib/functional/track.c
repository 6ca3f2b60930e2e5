/* SPDX-License-Identifier: MIT */
/// @file
/// The heading of this moment. See functional/track.h.
#include "functional/track.h"

#include "functional/model.h"
#include "functional/twist.h"
#include "imu/turn.h"
#include "joint/sign.h"
#include "jointcal/functional.h"
#include "jointcal/vec3.h"
#include "levers/levers.h"
#include "math/plane.h"
#include "math/scalar.h"

#include <float.h>

/// Time constant of the heading, s: 4 to 16 s do alike where it rests; where it drifts it lags by so much, which must not look like a slip.
#define MEMORY_S 4.0f

/// Squared rate that is added before a residual of the rates is taken as a share of them, (rad/s)^2.
#define WATCH_REST_RATE2 0.3f
/// Motion that residuals are averaged over, s, and the most that one of them counts.
#define WATCH_S 1.5f
#define WATCH_CLIP 50.0f
/// A sensor has moved when a mean is this many times the usual: half as much again as the largest that whole recordings without a slip
/// held (docs/METHOD_PEOPLE.md, section 6).
#define MOVED_TURN 12.0f
#define MOVED_RATE 15.0f
#define MOVED_LEVER 22.0f

/// Nothing that was said against another estimate counts.
static void forget(jcal_functional_track_t *self)
{
    for (unsigned f = 0u; f < JCAL_FAMILIES; ++f) {
        self->recent[f] = 0.0f;
    }
}

void jcal_functional_track_trust(jcal_functional_t *self)
{
    jcal_functional_track_t *const track = &self->track;
    const float size = jcal_plane_norm(track->sum);
    forget(track);
    track->heading = self->point.heading[0];
    track->sum = (jcal_plane_t){size * track->heading.re, size * track->heading.im};
    self->track.zero[0] = jcal_twist_zero(self->point.j1);
    self->track.zero[1] = jcal_twist_zero(self->point.j2);
}

void jcal_functional_track_begin(jcal_functional_t *self)
{
    jcal_functional_track_clear(self);
    jcal_functional_track_trust(self);
}

/// What both sensors see of the axis and of the joint's centre, each in its level frame.
typedef struct {
    jcal_vec3_t axis1, axis2;
    jcal_vec3_t velocity1, velocity2;
} seen_t;

static seen_t seen_by(const jcal_functional_point_t *point, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    const seen_t out = {jcal_turn_times(tick1->turn, point->j1), jcal_turn_times(tick2->turn, point->j2),
                        jcal_levers_velocity(tick1, point->r1), jcal_levers_velocity(tick2, point->r2)};
    return out;
}

/// Horizontal part: x + i y.
static inline jcal_plane_t horizontal(jcal_vec3_t v)
{
    const jcal_plane_t out = {v.x, v.y};
    return out;
}

/// |a - Rz(heading) b|^2.
static float apart2(jcal_plane_t heading, jcal_vec3_t a, jcal_vec3_t b)
{
    const jcal_plane_t off = jcal_plane_add(horizontal(a), -1.0f, jcal_plane_times(heading, horizontal(b)));
    const float up = a.z - b.z;
    return jcal_plane_norm2(off) + (up * up);
}

/// Residuals of this moment beside the sizes that they have in the sums; `rate2` is that of the rates.
static void watch(jcal_functional_t *self, const seen_t *seen, float rate2, float motion_s)
{
    const jcal_plane_t heading = self->track.heading;
    const float turn2 = apart2(heading, seen->axis1, seen->axis2);
    const float lever2 = apart2(heading, seen->velocity1, seen->velocity2);
    const float squares[JCAL_FAMILIES] = {0.5f * turn2, 0.5f * rate2 / (self->ticks.rate2 + WATCH_REST_RATE2),
                                          lever2 / 3.0f};
    const float share = motion_s / (motion_s + WATCH_S);
    for (unsigned f = 0u; f < JCAL_FAMILIES; ++f) {
        const float square = jcal_min(squares[f] / self->point.size[f], WATCH_CLIP);
        self->track.recent[f] += share * (square - self->track.recent[f]);
    }
}

bool jcal_functional_track_alarm(const jcal_functional_track_t *self)
{
    return (self->recent[JCAL_FAMILY_TURN] > MOVED_TURN) || (self->recent[JCAL_FAMILY_RATE] > MOVED_RATE) ||
           (self->recent[JCAL_FAMILY_LEVER] > MOVED_LEVER);
}

void jcal_functional_track_add(jcal_functional_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                               float motion_s)
{
    if (!self->search.has_estimate) {
        return;
    }
    jcal_functional_track_t *const track = &self->track;
    const jcal_functional_point_t *const point = &self->point;
    const float fade = 1.0f / (1.0f + (tick1->dt_s / MEMORY_S));
    const float all_s = jcal_max(self->sums.motion_s, FLT_MIN);
    const float turn = motion_s * point->weight[JCAL_FAMILY_TURN] / all_s;
    const float lever = motion_s * point->weight[JCAL_FAMILY_LEVER] / all_s;
    const seen_t seen = seen_by(point, tick1, tick2);
    const jcal_plane_t by_axis = jcal_plane_against(horizontal(seen.axis2), horizontal(seen.axis1));
    const jcal_plane_t by_centre = jcal_plane_against(horizontal(seen.velocity2), horizontal(seen.velocity1));
    track->sum.re = (fade * track->sum.re) + (turn * by_axis.re) + (lever * by_centre.re);
    track->sum.im = (fade * track->sum.im) + (turn * by_axis.im) + (lever * by_centre.im);
    if (jcal_plane_norm2(track->sum) > FLT_MIN) {
        track->heading = jcal_plane_direction(track->sum);
        track->known = true;
        const jcal_vec3_t rate1 = jcal_turn_times(tick1->rate, point->j1);
        const jcal_vec3_t rate2 = jcal_turn_times(tick2->rate, point->j2);
        watch(self, &seen, apart2(track->heading, rate1, rate2), motion_s);
    }
}

void jcal_functional_track_clear(jcal_functional_t *self)
{
    self->track.sum = (jcal_plane_t){0.0f, 0.0f};
    self->track.heading = self->point.heading[0];
    self->track.known = false;
    forget(&self->track);
}

float jcal_functional_flexion(const jcal_functional_t *self, jcal_quat_t orientation1, jcal_quat_t orientation2)
{
    if ((self == NULL) || !self->search.has_estimate) {
        return NAN;
    }
    const jcal_twist_t twist = {self->point.j1, self->point.j2, {self->track.zero[0], self->track.zero[1]}};
    const float sign = jcal_sign_of(self->point.j1, self->cfg.axis1_toward, self->kept_sign[0]);
    return sign * jcal_twist_angle(&twist, self->track.heading, orientation1, orientation2);
}
