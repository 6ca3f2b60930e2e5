/* SPDX-License-Identifier: MIT */
/// @file
/// Axes from windows that one motion dominates. See two_axes/windows.h.
#include "two_axes/windows.h"

#include "imu/turn.h"
#include "jointcal/head.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/eig.h"
#include "math/plane.h"
#include "math/scalar.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#define PART_S 2.5f
/// Square of the relative rate at which it counts half, and half as moving, (rad/s)^2.
#define FAST_RATE2 4.0f
#define REST_RATE2 0.3f

/// What a window must show (docs/METHOD_PEOPLE.md, section 11).
#define MOTION_MIN_S 1.0f
#define SIDEWAYS_MAX 0.12f
#define TURNED_MAX_COSINE 0.9659258f /* 15 deg */
#define BEND_MIN2 0.04f
#define SKIN_COSINE 0.85f
#define ACROSS_COSINE 0.5f
#define ALONG_COSINE 0.9f
/// The distal lever tells bending from turning if it is so long across the one or along the other, m; for the latter with a bound of at most
/// so much of it.
#define ARM_MIN_M 0.1f
#define LEVER_BOUND_SHARE 0.5f

/// Bound of an axis.
#define AXIS_FLOOR_RAD (2.0f * JCAL_RAD_PER_DEG)
#define AXIS_SHARE 0.5f
#define AXIS_HEADING_SHARE 0.5f

/// A window may show a line that no axis has: of both motions at once, in phase. It takes several to know; by so much one may be off.
#define LONE1_RAD (6.0f * JCAL_RAD_PER_DEG)
#define LONE2_RAD (12.0f * JCAL_RAD_PER_DEG)

/// Windows in a row that say otherwise, before they are believed; and how many an axis remembers.
#define AGAINST_MAX 2u
#define REMEMBERED 12u

/// Slices of the work on a window.
enum { HALF1, HALF2, WINDOW1, WINDOW2, AXIS, IDLE };

/// sum (3 x 3, packed) <- sum + weight v v'.
static void add_square(float *sum, float weight, jcal_vec3_t v)
{
    sum[0] += weight * v.x * v.x;
    sum[1] += weight * v.y * v.x;
    sum[2] += weight * v.y * v.y;
    sum[3] += weight * v.z * v.x;
    sum[4] += weight * v.z * v.y;
    sum[5] += weight * v.z * v.z;
}

/// Rz v.
static jcal_vec3_t turned(jcal_plane_t heading, jcal_vec3_t v)
{
    const jcal_vec3_t out = {(heading.re * v.x) - (heading.im * v.y), (heading.im * v.x) + (heading.re * v.y), v.z};
    return out;
}

void jcal_axis_windows_cut(jcal_axis_windows_t *self)
{
    jcal_clear(self->part, sizeof self->part);
    self->slice = (uint8_t)IDLE;
}

static void close(jcal_axis_windows_t *self)
{
    self->part[2] = self->part[1];
    self->part[1] = self->part[0];
    jcal_clear(&self->part[0], sizeof self->part[0]);
    self->slice = (uint8_t)HALF1;
}

void jcal_axis_windows_add(jcal_axis_windows_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                           jcal_plane_t heading)
{
    jcal_axis_part_t *const part = &self->part[0];
    const jcal_vec3_t rate1 = jcal_turn_times(tick1->turn, tick1->gyr);
    const jcal_vec3_t rate2 = turned(heading, jcal_turn_times(tick2->turn, tick2->gyr));
    const jcal_vec3_t relative = jcal_vec3_sub(rate2, rate1);
    const jcal_plane_t back = {heading.re, -heading.im};
    part->heading = (part->time_s > 0.0f) ? part->heading : heading;
    const float relative2 = jcal_vec3_dot(relative, relative);
    const float weight = tick1->dt_s / (1.0f + (relative2 / FAST_RATE2));
    add_square(part->seen[0], weight, jcal_turn_back(tick1->turn, relative));
    add_square(part->seen[1], weight, jcal_turn_back(tick2->turn, turned(back, relative)));
    for (size_t k = 0u; k < 3u; ++k) {
        const jcal_vec3_t of2 = jcal_vec3_scale(turned(heading, jcal_column(tick2->turn, k)), tick1->dt_s);
        const jcal_vec3_t in1 = jcal_turn_back(tick1->turn, of2);
        part->mean[k] += in1.x;
        part->mean[3u + k] += in1.y;
        part->mean[6u + k] += in1.z;
    }
    part->carried2 += weight * jcal_vec3_dot(tick1->gyr, tick1->gyr);
    part->motion_s += tick1->dt_s * relative2 / (relative2 + REST_RATE2);
    part->time_s += tick1->dt_s;
    if (part->time_s >= PART_S) {
        close(self);
    }
}

/// Main direction of M (3 x 3, packed), and its second eigenvalue over the first.
static jcal_vec3_t main_of(const float *m, float *sideways)
{
    float values[3];
    float vectors[9];
    jcal_vec3_t out = {0.0f, 0.0f, 0.0f};
    *sideways = 1.0f;
    if (jcal_eig_symmetric(m, 3u, values, vectors)) {
        *sideways = jcal_max(values[1], 0.0f) / jcal_max(values[0], FLT_MIN);
        out = (jcal_vec3_t){vectors[0], vectors[1], vectors[2]};
    }
    return out;
}

/// Sum of both halves.
static void window_of(const jcal_axis_windows_t *self, size_t frame, float *out)
{
    for (size_t i = 0u; i < 6u; ++i) {
        out[i] = self->part[1].seen[frame][i] + self->part[2].seen[frame][i];
    }
}

/// True if both halves move enough, about the same line, and far enough.
static bool is_worth_a_look(const jcal_axis_windows_t *self)
{
    const jcal_axis_part_t *const a = &self->part[1];
    const jcal_axis_part_t *const b = &self->part[2];
    const float time_s = a->time_s + b->time_s;
    float mean2 = 0.0f;
    for (size_t i = 0u; i < 9u; ++i) {
        const float mean = (a->mean[i] + b->mean[i]) / time_s;
        mean2 += mean * mean;
    }
    return (b->time_s > 0.0f) && ((a->motion_s + b->motion_s) >= MOTION_MIN_S) &&
           (fabsf(jcal_vec3_dot(a->main[0], b->main[0])) >= TURNED_MAX_COSINE) &&
           (fabsf(jcal_vec3_dot(a->main[1], b->main[1])) >= TURNED_MAX_COSINE) &&
           ((0.5f * (3.0f - mean2)) >= BEND_MIN2);
}

/// Which axis the window shows: 0, 1, or 2 for none. A forearm that only turns says nothing of its lever along itself, which then looks
/// short and across; so a lever must be long in the direction that decides.
static uint8_t kind_of(const jcal_axis_windows_t *self, const jcal_window_context_t *context)
{
    const float skin = fabsf(jcal_vec3_dot(self->main[0], jcal_vec3_normalise(context->r1)));
    const float length = jcal_vec3_norm(context->r2);
    const float along = fabsf(jcal_vec3_dot(self->main[1], context->r2));
    const float across = sqrtf(jcal_max((length * length) - (along * along), 0.0f));
    if (!context->is_joint || (jcal_max(self->sideways[0], self->sideways[1]) > SIDEWAYS_MAX) || (skin > SKIN_COSINE)) {
        return 2u;
    }
    if ((along <= (ACROSS_COSINE * length)) && (across >= ARM_MIN_M)) {
        return 0u;
    }
    const bool is_known = context->bound2_m <= (LEVER_BOUND_SHARE * length);
    return ((along >= (ALONG_COSINE * length)) && (along >= ARM_MIN_M) && is_known) ? 1u : 2u;
}

static float square(float x)
{
    return x * x;
}

/// Bound of an axis of so many windows, which overlap by half.
static float bound_of(float sideways, float heading_rad, unsigned kind, unsigned windows)
{
    const float lone = ((kind == 0u) ? LONE1_RAD : LONE2_RAD) / (0.5f * (float)(windows + 1u));
    const float seen = AXIS_FLOOR_RAD + (AXIS_SHARE * sqrtf(sideways)) + (AXIS_HEADING_SHARE * heading_rad);
    return jcal_min(sqrtf(square(seen) + square(lone)), JCAL_BOUND_UNKNOWN_RAD);
}

/// Bound of the headings that the window was seen with: they have moved since, and what is known is known of this moment's.
static float heading_bound(const jcal_axis_windows_t *self, const jcal_window_context_t *context)
{
    const jcal_plane_t off1 = jcal_plane_against(self->part[1].heading, context->heading);
    const jcal_plane_t off2 = jcal_plane_against(self->part[2].heading, context->heading);
    const float off = jcal_max(fabsf(jcal_atan2(off1.im, off1.re)), fabsf(jcal_atan2(off2.im, off2.re)));
    return sqrtf(square(context->heading_rad) + square(off));
}

/// Takes the window for its axis; true if its sums join those of others.
static bool take(jcal_axis_windows_t *self, const jcal_window_context_t *context)
{
    jcal_axis_found_t *const found = &self->found[self->kind];
    float seen[6];
    window_of(self, self->kind, seen);
    const float total = seen[0] + seen[2] + seen[5];
    const float carried = sqrtf((self->part[1].carried2 + self->part[2].carried2) / jcal_max(total, FLT_MIN));
    /* In the frame of the sensor that turns, a heading is wrong about what both share only. */
    const float heading_rad = heading_bound(self, context) * ((self->kind == 1u) ? jcal_min(carried, 1.0f) : 1.0f);
    const float bound = bound_of(self->sideways[self->kind], heading_rad, self->kind, 1u);
    const float cosine = fabsf(jcal_vec3_dot(found->axis, self->main[self->kind]));
    const float off = jcal_atan2(sqrtf(jcal_max(1.0f - (cosine * cosine), 0.0f)), cosine);
    if ((found->windows > 0u) && ((off * off) <= ((found->bound_rad * found->bound_rad) + (bound * bound)))) {
        const unsigned windows = (found->windows < REMEMBERED) ? found->windows : (REMEMBERED - 1u);
        const float kept = (float)windows / (float)found->windows; /* of the last twelve or so: skin and straps creep */
        for (size_t i = 0u; i < 6u; ++i) {
            found->seen[i] = (kept * found->seen[i]) + seen[i];
        }
        found->heading_rad += (heading_rad - found->heading_rad) / (float)(windows + 1u);
        found->windows = (uint8_t)(windows + 1u);
        found->against = 0u;
        found->in_doubt = false;
        return true;
    }
    found->against = (uint8_t)(found->against + 1u);
    const bool is_better = (found->windows <= 1u) && (bound < found->bound_rad);
    if ((found->windows == 0u) || is_better || found->in_doubt || (found->against >= AGAINST_MAX)) {
        for (size_t i = 0u; i < 6u; ++i) {
            found->seen[i] = seen[i];
        }
        found->axis = self->main[self->kind];
        found->bound_rad = bound;
        found->heading_rad = heading_rad;
        found->windows = 1u;
        found->against = 0u;
        found->in_doubt = false;
        found->kept_sign = 0;
    }
    return false;
}

bool jcal_axis_windows_step(jcal_axis_windows_t *self, const jcal_window_context_t *context)
{
    float ignored;
    float seen[6];
    uint8_t next = (uint8_t)(self->slice + 1u);
    switch (self->slice) {
    case HALF1:
        self->part[1].main[0] = main_of(self->part[1].seen[0], &ignored);
        break;
    case HALF2:
        self->part[1].main[1] = main_of(self->part[1].seen[1], &ignored);
        next = (uint8_t)(is_worth_a_look(self) ? WINDOW1 : IDLE);
        break;
    case WINDOW1:
        window_of(self, 0u, seen);
        self->main[0] = main_of(seen, &self->sideways[0]);
        break;
    case WINDOW2:
        window_of(self, 1u, seen);
        self->main[1] = main_of(seen, &self->sideways[1]);
        self->kind = kind_of(self, context);
        next = (uint8_t)(((self->kind < 2u) && take(self, context)) ? AXIS : IDLE);
        break;
    case AXIS: {
        jcal_axis_found_t *const found = &self->found[self->kind];
        float sideways;
        const jcal_vec3_t axis = main_of(found->seen, &sideways);
        found->axis = (jcal_vec3_dot(axis, found->axis) < 0.0f) ? jcal_vec3_scale(axis, -1.0f) : axis;
        found->bound_rad = bound_of(sideways, found->heading_rad, self->kind, found->windows);
        break;
    }
    default:
        return false;
    }
    self->slice = next;
    return true;
}
