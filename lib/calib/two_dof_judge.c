/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and readiness of a 2-DoF joint. See two_dof_judge.h.
#include "calib/two_dof_judge.h"

#include "calib/two_dof_model.h"
#include "calib/two_dof_prior.h"
#include "calib/two_dof_residual.h"
#include "calib/two_dof_stream.h"
#include "calib/watch.h"
#include "math/angle.h"
#include "math/chol.h"
#include "math/scalar.h"

#include <math.h>

/// Bound of something of which nothing is known: a right angle; the heading may be turned by half a turn.
#define UNKNOWN_RAD JCAL_HALF_PI

/// 95 % of a Gaussian: squares of 1.96, and what the smaller of two equal variances adds up to 2.45^2.
#define SQUARE_1D 3.84f
#define SQUARE_2ND 2.15f

/// Residuals may be this many times what is usual, squared, before no joint of this kind explains the data.
#define MISFIT_MAX 20.0f
/// Largest |sin(beta0)|, 60 deg: axes that are more alike have no common normal to speak of, and parallel ones explain a hinge.
#define SINE_MAX 0.866f
/// The other minimum must cost this much more, in units of the variance, and this many times as much: when the angles move one
/// after the other, both orders of the axes explain that about equally well, and the errors decide which is the better one.
#define RIVAL_GAP 150.0f
#define RIVAL_RATIO 5.0f
/// Probes that must have ended, how many of them from the exchanged axes, each at another pose, and judgements in a row that found nothing missing.
#define TRIED_MIN 8u
#define EXCHANGES_MIN 2u
#define AGREED_MIN 3u
/// Least motion, s.
#define MOVING_MIN_S 2.0f
/// A bound may grow by this before ready is lost.
#define HYSTERESIS 1.2f
/// Share of bad samples.
#define BAD_SHARE_MAX 0.2f

/// Residuals, squared, are never taken for less than this share of what the config calls usual.
#define EXCESS_MIN 0.35f

/// An inclined earth frame turns the heading more than it turns an axis.
#define HEADING_MISMATCH 1.5f

/// What fades once the status is `ready`, and how often: per step of time, share of the memory.
#define FADE_KEEP 0.75f
#define FADE_SHARE 0.287682f /* -ln(FADE_KEEP) */
/// Memory while nothing is known yet, s; and while what is remembered does not fit together, say because an orientation filter
/// had not settled.
#define COLLECT_MEMORY_S 40.0f
#define MISFIT_MEMORY_S 6.0f
#define MISFIT_FORGET 4.0f

/// A calibration that was ready and has not fitted for so many judgements is void.
#define MISFITS_MAX 8u

/// Time over which the drift of the heading offset is averaged, s, and the largest that is believed, times what the config says.
#define DRIFT_TIME_S 20.0f
#define DRIFT_MAX 2.0f

typedef struct {
    float axis1, axis2, heading;
} bounds_t;

/// Residuals, squared, over what the config takes for usual, of either part. 2.5 unknowns are taken from each.
static void ratios_of(const jcal_two_dof_t *self, float *ratios)
{
    const float n1 = jcal_max((self->moving_s / JCAL_TWO_DOF_RATE_TIME_S) - 2.5f, 1.0f);
    const float n2 = jcal_max((self->moving_s / JCAL_TWO_DOF_ANGLE_TIME_S) - 2.5f, 1.0f);
    ratios[0] = (self->cfg.constraint == JCAL_CONSTRAINT_ORIENTATION) ? 0.0f : (self->search.parts[0] / n1);
    ratios[1] = (self->cfg.constraint == JCAL_CONSTRAINT_ROTATION) ? 0.0f : (self->search.parts[1] / n2);
}

/* 95 % radius of a Gaussian in the plane with covariance (a b; b c). */
static float radius(float a, float b, float c)
{
    const float mean = 0.5f * (a + c);
    const float half = 0.5f * (a - c);
    const float apart = sqrtf((half * half) + (b * b));
    const float small = jcal_max(mean - apart, 0.0f);
    return sqrtf((SQUARE_1D * (mean + apart)) + (SQUARE_2ND * small));
}

static bounds_t bounds_of(const jcal_two_dof_t *self)
{
    bounds_t bounds = {UNKNOWN_RAD, UNKNOWN_RAD, UNKNOWN_RAD};
    jcal_two_dof_lin_t all;
    jcal_two_dof_prior_apply(&self->prior, &self->best.point, &self->search.lin, &all);
    float scale[JCAL_TWO_DOF_UNKNOWNS];
    float inverse[JCAL_SYM_SIZE(JCAL_TWO_DOF_UNKNOWNS)];
    jcal_chol_scale(all.matrix, JCAL_TWO_DOF_UNKNOWNS, scale);
    if (jcal_chol_factor_in_place(all.matrix, JCAL_TWO_DOF_UNKNOWNS, NULL) != JCAL_OK) {
        return bounds;
    }
    jcal_chol_inverse(all.matrix, JCAL_TWO_DOF_UNKNOWNS, inverse);
    for (unsigned i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            inverse[jcal_sym_at(i, k)] *= scale[i] * scale[k];
        }
    }
    const float mismatch = self->cfg.mismatch_rad;
    const float drift = self->cfg.heading_drift_rad_s * self->age_s;
    bounds.axis1 = jcal_min(radius(inverse[0], inverse[1], inverse[2]) + mismatch, UNKNOWN_RAD);
    bounds.axis2 = jcal_min(
        radius(inverse[jcal_sym_at(2u, 2u)], inverse[jcal_sym_at(3u, 2u)], inverse[jcal_sym_at(3u, 3u)]) + mismatch,
        UNKNOWN_RAD);
    const float spread = sqrtf(SQUARE_1D * jcal_max(inverse[jcal_sym_at(4u, 4u)], 0.0f));
    bounds.heading = jcal_min(spread + (HEADING_MISMATCH * mismatch) + drift, UNKNOWN_RAD);
    return bounds;
}

static void say(jcal_two_dof_verdict_t *verdict, jcal_weak_t weak, jcal_hint_t hint, jcal_reason_t reason)
{
    verdict->weak = (uint8_t)weak;
    verdict->hint = (uint8_t)hint;
    verdict->reason = (uint8_t)reason;
}

/// The unknown with the largest bound, if that is too large.
static jcal_weak_t weakest(const bounds_t *bounds, float limit)
{
    const float largest = jcal_max(jcal_max(bounds->axis1, bounds->axis2), bounds->heading);
    if (largest <= limit) {
        return JCAL_WEAK_NONE;
    }
    if (bounds->axis1 >= largest) {
        return JCAL_WEAK_AXIS1;
    }
    return (bounds->axis2 >= largest) ? JCAL_WEAK_AXIS2 : JCAL_WEAK_HEADING;
}

/// What is missing; JCAL_COLLECTING with reason NONE stands for nothing.
static jcal_calibration_t missing(jcal_two_dof_t *self, const bounds_t *bounds, float misfit, float sine)
{
    jcal_two_dof_verdict_t *const verdict = &self->verdict;
    const jcal_two_dof_search_t *const search = &self->search;
    const bool was_ready = verdict->status == (uint8_t)JCAL_READY;
    const float limit = self->cfg.max_bound_rad * (was_ready ? HYSTERESIS : 1.0f);
    const jcal_weak_t weak = weakest(bounds, limit);
    if (self->gate.bad_share > BAD_SHARE_MAX) {
        say(verdict, weak, JCAL_HINT_CHECK_SENSORS, JCAL_REASON_BAD_SAMPLES);
        return JCAL_COLLECTING;
    }
    if (!was_ready && (self->moving_s < MOVING_MIN_S)) { /* `moved` stays until there is something new to say */
        say(verdict, weak, JCAL_HINT_MOVE_JOINT, JCAL_REASON_NO_MOTION);
        return (verdict->status == (uint8_t)JCAL_MOVED) ? JCAL_MOVED : JCAL_COLLECTING;
    }
    if ((misfit > MISFIT_MAX) || (fabsf(sine) > SINE_MAX)) {
        say(verdict, weak, JCAL_HINT_CHECK_SENSORS, JCAL_REASON_DOES_NOT_FIT);
        return JCAL_COLLECTING;
    }
    if (weak != JCAL_WEAK_NONE) {
        say(verdict, weak, (weak == JCAL_WEAK_HEADING) ? JCAL_HINT_MOVE_SEGMENT1 : JCAL_HINT_MOVE_JOINT,
            JCAL_REASON_UNCERTAIN);
        return JCAL_COLLECTING;
    }
    if (search->has_rival && (search->rival_cost < jcal_max(search->cost + RIVAL_GAP, RIVAL_RATIO * search->cost))) {
        say(verdict, JCAL_WEAK_NONE, JCAL_HINT_MOVE_JOINT, JCAL_REASON_OTHER_MINIMUM);
        return JCAL_AMBIGUOUS;
    }
    if ((search->tried < TRIED_MIN) || (search->exchanges < EXCHANGES_MIN)) {
        say(verdict, JCAL_WEAK_NONE, JCAL_HINT_MOVE_JOINT, JCAL_REASON_UNCERTAIN);
        return JCAL_COLLECTING;
    }
    say(verdict, JCAL_WEAK_NONE, JCAL_HINT_NONE, JCAL_REASON_NONE);
    return JCAL_READY;
}

/// Follows the drift of the heading offset, and refers the sums to where it is by now.
static void follow_drift(jcal_two_dof_t *self, float time_s)
{
    const jcal_plane_t now = self->best.point.heading;
    const jcal_plane_t turned = jcal_plane_against(self->heading_then, now);
    self->heading_then = now;
    if (!(jcal_plane_norm2(turned) > 0.0f)) {
        return;
    }
    const float limit = DRIFT_MAX * self->cfg.heading_drift_rad_s;
    const float rate = jcal_atan2(turned.im, turned.re) / time_s;
    const float drift = self->drift_rad_s + ((rate - self->drift_rad_s) * (time_s / (time_s + DRIFT_TIME_S)));
    self->drift_rad_s = jcal_max(jcal_min(drift, limit), -limit);
    const jcal_plane_t turn = jcal_plane_turn(self->drift_rad_s * time_s);
    jcal_two_dof_turn(&self->moments, turn);
    self->best.point.heading = jcal_plane_direction(jcal_plane_times(now, turn));
}

bool jcal_two_dof_fade_is_due(const jcal_two_dof_t *self)
{
    const bool ready = self->verdict.status == (uint8_t)JCAL_READY;
    const float collect_s = (self->verdict.excess > MISFIT_FORGET) ? MISFIT_MEMORY_S : COLLECT_MEMORY_S;
    return self->since_forgot_s >= (FADE_SHARE * (ready ? self->cfg.memory_s : collect_s));
}

void jcal_two_dof_fade_now(jcal_two_dof_t *self)
{
    if (self->verdict.status == (uint8_t)JCAL_READY) {
        jcal_two_dof_prior_take(&self->prior, &self->best.point, &self->search.lin, 1.0f - FADE_KEEP);
    }
    jcal_two_dof_fade(&self->moments, FADE_KEEP);
    self->moving_s *= FADE_KEEP;
    self->search.cost *= FADE_KEEP;
    self->search.rival_cost *= FADE_KEEP;
}

void jcal_two_dof_follow_drift(jcal_two_dof_t *self)
{
    const float time_s = self->since_forgot_s;
    self->since_forgot_s = 0.0f;
    if (self->verdict.status == (uint8_t)JCAL_READY) {
        follow_drift(self, time_s);
    }
}

void jcal_two_dof_judge(jcal_two_dof_t *self)
{
    jcal_two_dof_verdict_t *const verdict = &self->verdict;
    float ratios[2];
    ratios_of(self, ratios);
    const float misfit = jcal_max(ratios[0], ratios[1]);
    const bounds_t bounds = bounds_of(self);
    verdict->bound1_rad = bounds.axis1;
    verdict->bound2_rad = bounds.axis2;
    verdict->bound_heading_rad = bounds.heading;
    const float sine = jcal_two_dof_mean(&self->moments, &self->best.point);
    verdict->sine = sine;
    const jcal_calibration_t found = missing(self, &bounds, misfit, sine);
    if (found != JCAL_READY) {
        self->search.agreed = 0u;
        verdict->status = (uint8_t)found;
    } else if (verdict->status != (uint8_t)JCAL_READY) {
        self->search.agreed = (uint8_t)(self->search.agreed + 1u);
        if (self->search.agreed >= AGREED_MIN) {
            verdict->status = (uint8_t)JCAL_READY;
        } else {
            say(verdict, JCAL_WEAK_NONE, JCAL_HINT_MOVE_JOINT, JCAL_REASON_UNCERTAIN);
        }
    } else {
        /* ready, and stays so */
    }
    if (verdict->reason != (uint8_t)JCAL_REASON_DOES_NOT_FIT) {
        self->search.misfits = 0u;
    } else if (self->watch.on) {
        self->search.misfits = (uint8_t)(self->search.misfits + 1u);
    } else {
        /* never did */
    }
    if (self->search.misfits >= MISFITS_MAX) {
        jcal_two_dof_begin_anew(self, JCAL_MOVED);
        return;
    }
    if (verdict->status == (uint8_t)JCAL_READY) {
        jcal_watch_start(&self->watch);
    }
    verdict->excess = jcal_max(misfit, EXCESS_MIN);
}
