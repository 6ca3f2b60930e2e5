/* SPDX-License-Identifier: MIT */
/// @file
/// A remembered calibration: when it is confirmed, when it is dropped. See jointcal/remember.h; docs/METHOD_HUB.md, section 4.
#include "jointcal/remember.h"

#include "jointcal/vec3.h"
#include "levers/ticks.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/sphere.h"
#include "remember/look.h"
#include "remember/sums.h"

#include <math.h>
#include <stddef.h>

/// Ticks from one look to the next, about a quarter of a second, and looks in a row that must agree.
#define LOOK_TICKS 5u
#define AGREED_MIN 3u
/// What a sensor says before it has run for so long is left out, s: inclinations that began in motion are off by 4 deg until then.
#define SETTLED_S 3.0f
/// Duration of a block, s, in which the heading stands still. What is closed is halved at so much motion, s.
#define BLOCK_S 5.0f
#define PAST_MAX_S 30.0f

/// Motion before anything is said, s; bending within 5 s, rms, rad.
#define MOTION_MIN_S 2.0f
#define BEND_MIN_RAD (10.0f * JCAL_RAD_PER_DEG)
/// Speed of the centre, both sides, m/s, rigid and functional: ten times the power of its noise, 20 and 24 mm/s.
#define RIGID_SPEED_M_S 0.063f
#define FUNCTIONAL_SPEED_M_S 0.08f
/// How many standard deviations count for a decision, and for the bound that is said then.
#define SIGMAS 0.5f
#define SIGMAS_BOUND 1.0f
/// Confirmed: an axis is elsewhere by at most this, rad, rigid and functional: what the estimators ask of an axis that is good for angles.
#define RIGID_MAX_RAD (3.0f * JCAL_RAD_PER_DEG)
#define FUNCTIONAL_MAX_RAD (10.0f * JCAL_RAD_PER_DEG)
/// Dropped: it is elsewhere by more than this, rad.
#define RIGID_OFF_RAD (3.0f * JCAL_RAD_PER_DEG)
#define FUNCTIONAL_OFF_RAD (6.0f * JCAL_RAD_PER_DEG)
/// Share of the centre's motion that may be left, and from which on it is another place.
#define LACK_MAX 0.12f
#define LACK_OFF 0.3f
/// Evidence for the pairing, and against it.
#define EVIDENCE_MIN 1.5f
#define EVIDENCE_OFF (-3.0f)

typedef char jcal_remember_fits_its_budget[(sizeof(jcal_remember_t) <= 1024u) ? 1 : -1];

static jcal_remember_reason_t reason_of(jcal_kept_refusal_t refusal)
{
    return (refusal == JCAL_KEPT_OTHER_SENSORS) ? JCAL_REMEMBER_OTHER_SENSORS : JCAL_REMEMBER_NO_RECORD;
}

/// Sensor frame's u, v and axis.
static void set_basis(jcal_vec3_t e[3], jcal_vec3_t axis)
{
    const jcal_vec3_t unit = jcal_vec3_scale(axis, 1.0f / jcal_vec3_norm(axis));
    const jcal_tangent_t tangent = jcal_sphere_tangent(unit);
    e[0] = tangent.u;
    e[1] = tangent.v;
    e[2] = unit;
}

jcal_status_t jcal_remember_init(jcal_remember_t *self, const jcal_kept_t *kept, jcal_kept_refusal_t refusal)
{
    if ((self == NULL) || ((kept == NULL) && (refusal == JCAL_KEPT_FITS))) {
        return JCAL_ERR_ARG;
    }
    if ((refusal == JCAL_KEPT_FITS) && !jcal_kept_is_valid(kept)) {
        return JCAL_ERR_ARG;
    }
    jcal_clear((unsigned char *)self, sizeof *self);
    if (refusal != JCAL_KEPT_FITS) {
        self->state = (uint8_t)JCAL_REMEMBER_DROPPED;
        self->reason = (uint8_t)reason_of(refusal);
        return JCAL_OK;
    }
    self->kept = *kept;
    self->has_axes = kept->kind == JCAL_KEPT_HINGE;
    self->has_levers = kept->has_levers;
    if (self->has_axes) {
        set_basis(self->e1, kept->axis1);
        set_basis(self->e2, kept->axis2);
    }
    self->heading.re = 1.0f;
    self->reason = (uint8_t)JCAL_REMEMBER_NO_MOTION;
    return JCAL_OK;
}

/// A block with hardly any motion is forgotten.
static void end_block(jcal_remember_t *self)
{
    if (self->block.motion_s < JCAL_REMEMBER_BLOCK_MIN_S) {
        self->block = (jcal_remember_sums_t){0};
        return;
    }
    jcal_remember_look_heading(self);
    jcal_remember_look_pairing(self);
    jcal_remember_look_axes(self, true);
}

jcal_status_t jcal_remember_add(jcal_remember_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    if ((self == NULL) || (tick1 == NULL) || (tick2 == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (self->state != (uint8_t)JCAL_REMEMBERED) {
        return JCAL_OK;
    }
    const jcal_ticks_t what = jcal_ticks_take(&self->ticks, tick1, tick2);
    if (what == JCAL_TICKS_REJECTED) {
        return JCAL_REJECTED;
    }
    if (what == JCAL_TICKS_ANEW) { /* headings of before are not those of now */
        end_block(self);
        self->slice = 0u;
        return JCAL_OK;
    }
    if (!(jcal_min(tick1->since_s, tick2->since_s) >= SETTLED_S)) {
        return JCAL_OK;
    }
    const jcal_tick_weights_t weights = jcal_ticks_weigh(&self->ticks, tick1, tick2);
    jcal_remember_sums_add(self, tick1, tick2, &weights);
    self->count = (uint8_t)(self->count + 1u);
    if ((self->count >= LOOK_TICKS) || (self->block.time_s >= BLOCK_S)) {
        self->count = 0u;
        if (self->block.motion_s >= JCAL_REMEMBER_BLOCK_MIN_S) {
            self->slice = (self->slice == 0u) ? 1u : self->slice;
        } else if (self->block.time_s >= BLOCK_S) {
            self->block = (jcal_remember_sums_t){0};
        }
    }
    return JCAL_OK;
}

/// True if levers were kept and the centre moves enough for them to tell something.
static bool moves(const jcal_remember_t *self)
{
    const float least = (self->kept.model == JCAL_MODEL_RIGID) ? RIGID_SPEED_M_S : FUNCTIONAL_SPEED_M_S;
    return self->has_levers && (self->speed_m_s >= least);
}

/// What speaks against it, or nothing.
static jcal_remember_reason_t against(const jcal_remember_t *self)
{
    const float most = (self->kept.model == JCAL_MODEL_RIGID) ? RIGID_OFF_RAD : FUNCTIONAL_OFF_RAD;
    const float off =
        jcal_max(self->off1_rad - (SIGMAS * self->sigma1_rad), self->off2_rad - (SIGMAS * self->sigma2_rad));
    if (moves(self) && (self->lack > LACK_OFF)) {
        return JCAL_REMEMBER_PLACES;
    }
    if (!self->has_axes) {
        return JCAL_REMEMBER_NONE;
    }
    if (self->evidence < EVIDENCE_OFF) {
        return JCAL_REMEMBER_SENSE;
    }
    return ((self->bend_rad >= BEND_MIN_RAD) && (off > most)) ? JCAL_REMEMBER_AXES : JCAL_REMEMBER_NONE;
}

/// What is missing until it is confirmed, or nothing. Exchanged sensors are told by the levers alone, so nothing is confirmed without.
static jcal_remember_reason_t missing(const jcal_remember_t *self)
{
    const float most = (self->kept.model == JCAL_MODEL_RIGID) ? RIGID_MAX_RAD : FUNCTIONAL_MAX_RAD;
    const float off =
        jcal_max(self->off1_rad + (SIGMAS * self->sigma1_rad), self->off2_rad + (SIGMAS * self->sigma2_rad));
    if ((self->motion_s < MOTION_MIN_S) || (self->has_axes && (self->bend_rad < BEND_MIN_RAD))) {
        return JCAL_REMEMBER_NO_MOTION;
    }
    if (!moves(self) || !(self->lack <= LACK_MAX)) {
        return JCAL_REMEMBER_PLACES;
    }
    if (!self->has_axes || !(off <= most)) {
        return JCAL_REMEMBER_AXES;
    }
    return (self->evidence >= EVIDENCE_MIN) ? JCAL_REMEMBER_NONE : JCAL_REMEMBER_SENSE;
}

static void confirm(jcal_remember_t *self)
{
    self->state = (uint8_t)JCAL_REMEMBER_CONFIRMED;
    self->reason = (uint8_t)JCAL_REMEMBER_NONE;
}

static void drop(jcal_remember_t *self, jcal_remember_reason_t reason)
{
    self->state = (uint8_t)JCAL_REMEMBER_DROPPED;
    self->reason = (uint8_t)reason;
}

static void judge(jcal_remember_t *self)
{
    const jcal_remember_reason_t lacks = missing(self);
    self->reason = (uint8_t)lacks;
    if (self->motion_s < MOTION_MIN_S) {
        return;
    }
    const jcal_remember_reason_t no = against(self);
    self->for_it = (lacks == JCAL_REMEMBER_NONE) ? (uint8_t)(self->for_it + 1u) : 0u;
    self->against_it = (no != JCAL_REMEMBER_NONE) ? (uint8_t)(self->against_it + 1u) : 0u;
    if (self->against_it >= AGREED_MIN) {
        drop(self, no);
    } else if (self->for_it >= AGREED_MIN) {
        confirm(self);
    } else if (lacks == JCAL_REMEMBER_NONE) {
        self->reason = (uint8_t)JCAL_REMEMBER_NO_MOTION;
    }
}

/// What lies long back counts less.
static void fade(jcal_remember_past_t *past)
{
    float *const numbers = (float *)past;
    for (size_t i = 0u; i < (sizeof *past / sizeof(float)); ++i) {
        numbers[i] *= 0.5f;
    }
}

jcal_status_t jcal_remember_step(jcal_remember_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    if ((self->slice == 0u) || (self->state != (uint8_t)JCAL_REMEMBERED)) {
        return JCAL_IDLE;
    }
    if (self->slice == 1u) {
        jcal_remember_look_heading(self);
        self->slice = 2u;
        return JCAL_OK;
    }
    if (self->slice == 2u) {
        jcal_remember_look_pairing(self);
        self->slice = 3u;
        return JCAL_OK;
    }
    jcal_remember_look_axes(self, self->block.time_s >= BLOCK_S);
    self->slice = 0u;
    judge(self);
    if (self->past.motion_s > PAST_MAX_S) {
        fade(&self->past);
    }
    return JCAL_OK;
}

static bool is_near(jcal_vec3_t a, jcal_vec3_t b, float bound_a, float bound_b)
{
    return jcal_vec3_norm(jcal_vec3_sub(a, b)) <= sqrtf((bound_a * bound_a) + (bound_b * bound_b));
}

/// Axis b with the sign that is nearer to a.
static jcal_vec3_t signed_as(jcal_vec3_t a, jcal_vec3_t b)
{
    return (jcal_vec3_dot(a, b) < 0.0f) ? jcal_vec3_scale(b, -1.0f) : b;
}

/// Of a hinge both signs turn together; of two axes each by itself.
static bool has_same_axes(const jcal_kept_t *a, const jcal_kept_t *b)
{
    const jcal_vec3_t axis1 = signed_as(a->axis1, b->axis1);
    const bool is_turned = jcal_vec3_dot(a->axis1, b->axis1) < 0.0f;
    const jcal_vec3_t paired = is_turned ? jcal_vec3_scale(b->axis2, -1.0f) : b->axis2;
    const jcal_vec3_t axis2 = (a->kind == JCAL_KEPT_HINGE) ? paired : signed_as(a->axis2, b->axis2);
    return is_near(a->axis1, axis1, a->bound1_rad, b->bound1_rad) &&
           is_near(a->axis2, axis2, a->bound2_rad, b->bound2_rad);
}

static bool has_same_levers(const jcal_kept_t *a, const jcal_kept_t *b)
{
    return !a->has_levers || !b->has_levers ||
           (is_near(a->lever1_m, b->lever1_m, a->bound_lever1_m, b->bound_lever1_m) &&
            is_near(a->lever2_m, b->lever2_m, a->bound_lever2_m, b->bound_lever2_m));
}

bool jcal_remember_agrees(const jcal_kept_t *kept, const jcal_kept_t *now)
{
    return (kept != NULL) && (now != NULL) && (kept->kind == now->kind) && has_same_levers(kept, now) &&
           ((now->kind == JCAL_KEPT_BALL) || has_same_axes(kept, now));
}

jcal_status_t jcal_remember_settle(jcal_remember_t *self, const jcal_kept_t *now)
{
    if ((self == NULL) || (now == NULL) || !jcal_kept_is_valid(now)) {
        return JCAL_ERR_ARG;
    }
    if (self->state != (uint8_t)JCAL_REMEMBERED) {
        return JCAL_OK;
    }
    if (jcal_remember_agrees(&self->kept, now)) {
        self->off1_rad = 0.0f; /* the kept bounds hold */
        self->off2_rad = 0.0f;
        self->sigma1_rad = 0.0f;
        self->sigma2_rad = 0.0f;
        confirm(self);
    } else {
        drop(self, JCAL_REMEMBER_ESTIMATE);
    }
    return JCAL_OK;
}

jcal_status_t jcal_remember_get(const jcal_remember_t *self, jcal_remember_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    const bool is_confirmed = self->state == (uint8_t)JCAL_REMEMBER_CONFIRMED;
    out->state = (jcal_remember_state_t)self->state;
    out->reason = (jcal_remember_reason_t)self->reason;
    out->motion_s = self->motion_s;
    out->bound1_rad = JCAL_BOUND_UNKNOWN_RAD;
    out->bound2_rad = JCAL_BOUND_UNKNOWN_RAD;
    if (is_confirmed) {
        out->bound1_rad = jcal_max(self->kept.bound1_rad, self->off1_rad + (SIGMAS_BOUND * self->sigma1_rad));
        out->bound2_rad = jcal_max(self->kept.bound2_rad, self->off2_rad + (SIGMAS_BOUND * self->sigma2_rad));
    }
    return JCAL_OK;
}

const char *jcal_remember_state_string(jcal_remember_state_t state)
{
    switch (state) {
    case JCAL_REMEMBERED:
        return "remembered";
    case JCAL_REMEMBER_CONFIRMED:
        return "confirmed";
    case JCAL_REMEMBER_DROPPED:
        return "dropped";
    default:
        return "unknown";
    }
}

const char *jcal_remember_reason_string(jcal_remember_reason_t reason)
{
    static const char *const WORDS[] = {NULL,     "no_record", "other_sensors", "axes",
                                        "places", "sense",     "no_motion",     "estimate"};
    const size_t at = (size_t)(unsigned)reason;
    return (at < (sizeof(WORDS) / sizeof(WORDS[0]))) ? WORDS[at] : "unknown";
}
