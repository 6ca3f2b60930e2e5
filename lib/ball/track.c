/* SPDX-License-Identifier: MIT */
/// @file
/// The heading of this moment. See ball/track.h.
#include "ball/track.h"

#include "levers/levers.h"
#include "math/plane.h"
#include "math/scalar.h"

#include <float.h>

/// Motion that the heading is a mean over, s, and the age of what it was learnt from at which it is half of that: at rest nothing is forgotten,
/// since nothing is learnt, but then new motion soon says more than old. With half of it it is noise that is followed, with twice it lags where
/// it drifts.
#define MEMORY_S 6.0f
#define OLD_S 10.0f

/// As of functional/track.c: motion that the residual is averaged over, s, the most that one counts, and when it is a slip.
#define WATCH_S 1.5f
#define WATCH_CLIP 50.0f
#define MOVED_LEVER 22.0f

void jcal_ball_track_clear(jcal_ball_t *self)
{
    self->track.sum = (jcal_plane_t){0.0f, 0.0f};
    self->track.heading = self->point.heading[0];
    self->track.age_s = 0.0f;
    self->track.recent = 0.0f;
    self->track.known = false;
}

void jcal_ball_track_begin(jcal_ball_t *self)
{
    const float size = jcal_plane_norm(self->track.sum);
    const jcal_plane_t heading = self->point.heading[0];
    self->track.recent = 0.0f;
    self->track.heading = heading;
    self->track.sum = (jcal_plane_t){size * heading.re, size * heading.im};
}

void jcal_ball_track_add(jcal_ball_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float motion_s)
{
    if (!self->has_estimate) {
        return;
    }
    jcal_ball_track_t *const track = &self->track;
    const jcal_vec3_t v1 = jcal_levers_velocity(tick1, self->point.r1);
    const jcal_vec3_t v2 = jcal_levers_velocity(tick2, self->point.r2);
    const jcal_plane_t level1 = {v1.x, v1.y};
    const jcal_plane_t level2 = {v2.x, v2.y};
    const float fade = 1.0f / (1.0f + (motion_s * (1.0f + (track->age_s / OLD_S)) / MEMORY_S));
    const jcal_plane_t faded = {fade * track->sum.re, fade * track->sum.im};
    track->age_s = fade * (track->age_s + tick1->dt_s);
    track->sum = jcal_plane_add(faded, motion_s, jcal_plane_against(level2, level1));
    if (!(jcal_plane_norm2(track->sum) > FLT_MIN)) {
        return;
    }
    track->heading = jcal_plane_direction(track->sum);
    track->known = true;
    const float left2 = jcal_plane_norm2(jcal_plane_add(level1, -1.0f, jcal_plane_times(track->heading, level2))) +
                        ((v1.z - v2.z) * (v1.z - v2.z));
    const float square = jcal_min(left2 / (3.0f * self->point.size), WATCH_CLIP);
    track->recent += (motion_s / (motion_s + WATCH_S)) * (square - track->recent);
}

bool jcal_ball_track_alarm(const jcal_ball_track_t *self)
{
    return self->recent > MOVED_LEVER;
}
