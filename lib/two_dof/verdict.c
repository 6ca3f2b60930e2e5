/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and readiness of a 2-DoF joint. See two_dof/verdict.h.
#include "two_dof/verdict.h"

#include "joint/hysteresis.h"
#include "joint/sign.h"
#include "jointcal/head.h"
#include "math/chol.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/sym.h"
#include "two_dof/residual.h"

#include <math.h>
#include <stddef.h>

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

/// Residuals, squared, are never taken for less than this share of what the config calls usual.
#define EXCESS_MIN 0.35f

/// An inclined earth frame turns the heading more than it turns an axis.
#define HEADING_MISMATCH 1.5f

typedef struct {
    float axis1, axis2, heading;
} bounds_t;

/// Residuals, squared, over what the config takes for usual, of the worse part. 2.5 unknowns are taken from each.
static float misfit_of(const jcal_two_dof_config_t *cfg, const jcal_two_dof_evidence_t *evidence)
{
    const float n1 = jcal_max((evidence->moving_s / JCAL_TWO_DOF_RATE_TIME_S) - 2.5f, 1.0f);
    const float n2 = jcal_max((evidence->moving_s / JCAL_TWO_DOF_ANGLE_TIME_S) - 2.5f, 1.0f);
    const float ratio1 = (cfg->constraint == JCAL_CONSTRAINT_ORIENTATION) ? 0.0f : (evidence->parts[0] / n1);
    const float ratio2 = (cfg->constraint == JCAL_CONSTRAINT_ROTATION) ? 0.0f : (evidence->parts[1] / n2);
    return jcal_max(ratio1, ratio2);
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

bool jcal_two_dof_covariance(float *matrix, unsigned n, float *inverse)
{
    float scale[JCAL_CHOL_MAX];
    jcal_chol_scale(matrix, n, scale);
    if (!jcal_chol_factor(matrix, n, matrix, NULL)) {
        return false;
    }
    jcal_chol_inverse(matrix, n, inverse);
    for (unsigned i = 0u; i < n; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            inverse[jcal_sym_at(i, k)] *= scale[i] * scale[k];
        }
    }
    return true;
}

static bounds_t bounds_of(const jcal_two_dof_config_t *cfg, const jcal_two_dof_evidence_t *evidence)
{
    bounds_t bounds = {JCAL_BOUND_UNKNOWN_RAD, JCAL_BOUND_UNKNOWN_RAD, JCAL_BOUND_UNKNOWN_RAD};
    const float *const p = evidence->covariance;
    if (p == NULL) {
        return bounds;
    }
    const float mismatch = cfg->mismatch_rad;
    const float drift = cfg->heading_drift_rad_s * evidence->age_s;
    bounds.axis1 = jcal_min(radius(p[0], p[1], p[2]) + mismatch, JCAL_BOUND_UNKNOWN_RAD);
    bounds.axis2 = jcal_min(radius(p[jcal_sym_at(2u, 2u)], p[jcal_sym_at(3u, 2u)], p[jcal_sym_at(3u, 3u)]) + mismatch,
                            JCAL_BOUND_UNKNOWN_RAD);
    const float spread = sqrtf(SQUARE_1D * jcal_max(p[jcal_sym_at(4u, 4u)], 0.0f));
    bounds.heading = jcal_min(spread + (HEADING_MISMATCH * mismatch) + drift, JCAL_BOUND_UNKNOWN_RAD);
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

/// Other axes explain the data about as well.
static bool has_close_rival(const jcal_two_dof_evidence_t *evidence)
{
    return evidence->has_rival &&
           (evidence->rival_cost < jcal_max(evidence->cost + RIVAL_GAP, RIVAL_RATIO * evidence->cost));
}

/// What is missing; JCAL_COLLECTING with reason NONE stands for nothing.
static jcal_calibration_t missing(jcal_two_dof_verdict_t *verdict, const jcal_two_dof_config_t *cfg,
                                  const jcal_two_dof_evidence_t *evidence, const bounds_t *bounds, float misfit)
{
    const bool was_ready = verdict->status == (uint8_t)JCAL_READY;
    const float limit = cfg->max_bound_rad * (was_ready ? JCAL_HYSTERESIS : 1.0f);
    const jcal_weak_t weak = weakest(bounds, limit);
    if (evidence->complaint != JCAL_REASON_NONE) {
        say(verdict, weak, JCAL_HINT_CHECK_SENSORS, evidence->complaint);
        return JCAL_COLLECTING;
    }
    if (!was_ready && (evidence->moving_s < MOVING_MIN_S)) { /* `moved` stays until there is something new to say */
        say(verdict, weak, JCAL_HINT_MOVE_JOINT, JCAL_REASON_NO_MOTION);
        return (verdict->status == (uint8_t)JCAL_MOVED) ? JCAL_MOVED : JCAL_COLLECTING;
    }
    if ((misfit > MISFIT_MAX) || (fabsf(evidence->sine) > SINE_MAX)) {
        say(verdict, weak, JCAL_HINT_CHECK_SENSORS, JCAL_REASON_DOES_NOT_FIT);
        return JCAL_COLLECTING;
    }
    if (weak != JCAL_WEAK_NONE) {
        say(verdict, weak, (weak == JCAL_WEAK_HEADING) ? JCAL_HINT_MOVE_SEGMENT1 : JCAL_HINT_MOVE_JOINT,
            JCAL_REASON_UNCERTAIN);
        return JCAL_COLLECTING;
    }
    if (has_close_rival(evidence)) {
        say(verdict, JCAL_WEAK_NONE, JCAL_HINT_MOVE_JOINT, JCAL_REASON_OTHER_MINIMUM);
        return JCAL_AMBIGUOUS;
    }
    if ((evidence->tried < TRIED_MIN) || (evidence->exchanges < EXCHANGES_MIN)) {
        say(verdict, JCAL_WEAK_NONE, JCAL_HINT_MOVE_JOINT, JCAL_REASON_UNCERTAIN);
        return JCAL_COLLECTING;
    }
    say(verdict, JCAL_WEAK_NONE, JCAL_HINT_NONE, JCAL_REASON_NONE);
    return JCAL_READY;
}

void jcal_two_dof_verdict_begin(jcal_two_dof_verdict_t *verdict, jcal_calibration_t status)
{
    jcal_clear(verdict, sizeof *verdict);
    verdict->status = (uint8_t)status;
    verdict->bound1_rad = JCAL_BOUND_UNKNOWN_RAD;
    verdict->bound2_rad = JCAL_BOUND_UNKNOWN_RAD;
    verdict->bound_heading_rad = JCAL_BOUND_UNKNOWN_RAD;
    verdict->excess = 1.0f;
    say(verdict, JCAL_WEAK_AXIS1, JCAL_HINT_MOVE_JOINT, JCAL_REASON_NO_DATA);
}

void jcal_two_dof_conclude(jcal_two_dof_verdict_t *verdict, const jcal_two_dof_config_t *cfg,
                           const jcal_two_dof_evidence_t *evidence)
{
    const float misfit = misfit_of(cfg, evidence);
    const bounds_t bounds = bounds_of(cfg, evidence);
    const bool open = has_close_rival(evidence); /* a bound around one of two places bounds nothing */
    verdict->bound1_rad = open ? JCAL_BOUND_UNKNOWN_RAD : bounds.axis1;
    verdict->bound2_rad = open ? JCAL_BOUND_UNKNOWN_RAD : bounds.axis2;
    verdict->bound_heading_rad = open ? JCAL_BOUND_UNKNOWN_RAD : bounds.heading;
    verdict->sine = evidence->sine;
    const jcal_calibration_t found = missing(verdict, cfg, evidence, &bounds, misfit);
    if (found != JCAL_READY) {
        verdict->agreed = 0u;
        verdict->status = (uint8_t)found;
    } else if (verdict->status != (uint8_t)JCAL_READY) {
        verdict->agreed = (uint8_t)(verdict->agreed + 1u);
        if (verdict->agreed >= AGREED_MIN) {
            verdict->status = (uint8_t)JCAL_READY;
        } else {
            say(verdict, JCAL_WEAK_NONE, JCAL_HINT_MOVE_JOINT, JCAL_REASON_UNCERTAIN);
        }
    } else {
        /* ready, and stays so */
    }
    if (verdict->status == (uint8_t)JCAL_READY) {
        jcal_sign_keep(&verdict->sign1, evidence->point->j1, cfg->axis1_toward);
        jcal_sign_keep(&verdict->sign2, evidence->point->j2, cfg->axis2_toward);
    }
    verdict->excess = jcal_max(misfit, EXCESS_MIN);
}
