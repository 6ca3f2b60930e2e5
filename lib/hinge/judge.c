/* SPDX-License-Identifier: MIT */
/// @file
/// Readiness of the hinge. See hinge/judge.h.
#include "hinge/judge.h"

#include "hinge/bounds.h"
#include "hinge/model.h"
#include "hinge/point.h"
#include "hinge/refine.h"
#include "hinge/search.h"
#include "joint/hysteresis.h"
#include "jointcal/head.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <math.h>

/// Integral of the squared difference of the rates, beyond what errors make, that shows that the joint moves, rad^2/s:
/// half a second at 0.3 rad/s.
#define EXCITATION_MIN 0.03f

/// The disagreement across the axis must be small beside the difference of the rates, or no hinge explains the data.
#define MISFIT_SHARE 0.35f
#define MISFIT_NOISE_RAD_S 0.02f
/// The same by the squared form of (24): share of what the difference of the rates costs without any axes.
#define UNEXPLAINED_MAX 0.1f
/// The same share beyond which there is something else in the sums than rigid segments leave: 0.0003 in 5 s of simulated motion with
/// a bias of 0.5 deg/s, 0.002 in 10 s on the rig.
#define STRAINED_MIN 0.001f

/// Durations after which residuals count as independent, s, when the pairings are compared.
#define ACC_MEMORY_S 0.3f
#define TURN_MEMORY_S 0.2f
/// Logarithm of the odds that the sign pairing needs, and the ratio of costs, and limits of a believable ratio.
#define SIGN_EVIDENCE_MIN 7.0f
#define SIGN_MARGIN_MIN 1.3f
/// Evidence at which the other pairing takes over.
#define SIGN_EVIDENCE_TURN (-1.0f)
#define RATIO_MIN 1e-3f
#define RATIO_MAX 1e6f

/// Another minimum must cost this much more, in units of the scatter, and this many times as much.
#define RIVAL_COST_MIN 15.0f
#define RIVAL_RATIO_MIN 1.5f
#define INFLATION_MIN 0.3f

/// Judgements in a row, one each 45 ms, that must agree before `ready`.
#define AGREED_MIN 6u

/// Rounds of the global check, half a second each, after which the axes should have been found.
#define ROUNDS_MANY 16u

/// How the two sign pairings compare.
typedef struct {
    float margin;    ///< Cost of the other over the cost of this one.
    float evidence;  ///< Logarithm of the odds for this one.
} sign_t;

static float ratio_of(float other, float same)
{
    return jcal_min(jcal_max(other / jcal_max(same, 1e-20f), RATIO_MIN), RATIO_MAX);
}

/// With unknown noise, N independent residuals whose sum of squares is r times larger speak with the odds r^(N / 2).
static sign_t compare_signs(const jcal_hinge_evidence_t *self)
{
    sign_t sign = {0.0f, 0.0f};
    if (!self->search->has_flip && (self->search->rounds == 0u)) {
        return sign;
    }
    const jcal_hinge_refine_t *const refine = self->refine;
    const jcal_hinge_point_t flip = jcal_hinge_flipped(self->search, &self->coarse->point);
    const float acc_same = jcal_hinge_cost_acc(&self->coarse->moments, self->cfg, &self->coarse->point);
    const float acc_other = jcal_hinge_cost_acc(&self->coarse->moments, self->cfg, &flip);
    const float weight_acc = self->coarse->moments.acc[jcal_sym_at(6u, 6u)];
    const float acc_time_s = (weight_acc * weight_acc) / jcal_max(self->amount->weight_acc2, 1e-20f);
    const float acc_odds = (acc_time_s / ACC_MEMORY_S) * jcal_ln(ratio_of(acc_other, acc_same));
    const float turn_odds = (refine->sign_time_s / TURN_MEMORY_S) * jcal_ln(ratio_of(refine->other, refine->same));
    sign.evidence = 0.5f * (acc_odds + turn_odds);
    sign.margin =
        ratio_of(acc_other + (refine->other / JCAL_HINGE_UNIT_S), acc_same + (refine->same / JCAL_HINGE_UNIT_S));
    return sign;
}

/// True if another minimum explains the data about as well, or if not all starts have been tried yet.
static bool has_rival(const jcal_hinge_evidence_t *self, float cost, float inflation, float slack)
{
    if (self->search->rounds == 0u) {
        return true;
    }
    jcal_hinge_point_t there = self->coarse->point;
    jcal_hinge_point_recall(&there, self->search->rival);
    if (!self->search->has_rival || jcal_hinge_same_lines(&self->coarse->point, &there)) {
        return false;
    }
    const float other = jcal_hinge_cost_of_rival(self->search, &self->coarse->moments, self->cfg);
    const bool much_worse = (slack * (other - cost)) > (RIVAL_COST_MIN * jcal_max(inflation, INFLATION_MIN));
    return !(much_worse && ((slack * other) > (RIVAL_RATIO_MIN * cost)));
}

/// True if what remains of the rates is small beside the joint's own rate.
static bool fits(const jcal_hinge_evidence_t *self, float slack)
{
    const float unit = self->cfg->gyr_noise_rad_s * self->cfg->gyr_noise_rad_s;
    const float units = jcal_max(self->refine->time_s / JCAL_HINGE_UNIT_S, 1e-9f);
    const float error = sqrtf(unit * self->refine->cost / units);
    const float joint = sqrtf(unit * self->refine->joint / units);
    return error < (slack * ((MISFIT_SHARE * joint) + MISFIT_NOISE_RAD_S));
}

/// True if some hinge explains the lengths of the rates, whatever the refined axes are doing.
static bool is_explained(const jcal_hinge_evidence_t *self, float share)
{
    const float left = jcal_hinge_cost_gyr(&self->coarse->moments, &self->coarse->point);
    return left < (share * jcal_hinge_cost_gyr_alone(&self->coarse->moments));
}

static jcal_hint_t hint_for(jcal_reason_t reason, jcal_weak_t weak)
{
    switch (reason) {
    case JCAL_REASON_NO_DATA:
    case JCAL_REASON_NO_MOTION:
    case JCAL_REASON_OTHER_MINIMUM:
        return JCAL_HINT_MOVE_JOINT;
    case JCAL_REASON_UNCERTAIN:
        return (weak == JCAL_WEAK_AXIS1) ? JCAL_HINT_MOVE_SEGMENT1 : JCAL_HINT_MOVE_SEGMENT2;
    case JCAL_REASON_SIGN_OPEN:
        return JCAL_HINT_TILT_AXIS;
    case JCAL_REASON_DOES_NOT_FIT:
    case JCAL_REASON_BAD_SAMPLES:
    case JCAL_REASON_WRONG_UNITS_GYR:
    case JCAL_REASON_WRONG_UNITS_ACC:
    case JCAL_REASON_RATE_TOO_LOW:
        return JCAL_HINT_CHECK_SENSORS;
    case JCAL_REASON_NONE:
    default:
        return JCAL_HINT_NONE;
    }
}

static bool is_hinted(const jcal_hinge_evidence_t *self)
{
    return self->cfg->sign_hint != JCAL_SIGN_UNKNOWN;
}

/// True if the data insist on the pairing that the user's hint excludes.
static bool contradicts_hint(const jcal_hinge_evidence_t *self, const sign_t *sign)
{
    const bool contradicted = (sign->evidence < -SIGN_EVIDENCE_MIN) && (sign->margin < (1.0f / SIGN_MARGIN_MIN));
    const bool obeys = jcal_hinge_obeys(&self->refine->point, self->cfg->sign_hint, self->kept_sign);
    return is_hinted(self) && (contradicted || !obeys);
}

/// The first thing that keeps the estimate from being ready, the worst first.
static jcal_reason_t find_reason(const jcal_hinge_evidence_t *self, const jcal_hinge_bounds_t *bounds,
                                 const sign_t *sign, float slack)
{
    if (self->complaint != JCAL_REASON_NONE) {
        return self->complaint;
    }
    if (self->amount->excitation < EXCITATION_MIN) {
        return JCAL_REASON_NO_MOTION;
    }
    if (contradicts_hint(self, sign)) {
        return JCAL_REASON_SIGN_OPEN;
    }
    if (!fits(self, slack) || !is_explained(self, slack * UNEXPLAINED_MAX)) {
        return JCAL_REASON_DOES_NOT_FIT;
    }
    if (!(jcal_max(bounds->bound1_rad, bounds->bound2_rad) <= (slack * self->cfg->max_bound_rad))) {
        return JCAL_REASON_UNCERTAIN;
    }
    const bool certain = ((slack * sign->evidence) > SIGN_EVIDENCE_MIN) && ((slack * sign->margin) > SIGN_MARGIN_MIN);
    if (!is_hinted(self) && !certain) {
        return JCAL_REASON_SIGN_OPEN;
    }
    const float cost = jcal_hinge_cost(&self->coarse->moments, self->cfg, &self->coarse->point);
    return has_rival(self, cost, bounds->inflation, slack) ? JCAL_REASON_OTHER_MINIMUM : JCAL_REASON_NONE;
}

/// The wider bound; where nothing is known of either axis, the one about which its segment turned less.
static jcal_weak_t weak_for(const jcal_hinge_evidence_t *self, jcal_reason_t reason, const jcal_hinge_bounds_t *bounds)
{
    if (reason == JCAL_REASON_NONE) {
        return JCAL_WEAK_NONE;
    }
    if (reason == JCAL_REASON_SIGN_OPEN) {
        return JCAL_WEAK_SIGN;
    }
    if (bounds->bound1_rad == bounds->bound2_rad) {
        return (self->refine->along[0] <= self->refine->along[1]) ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2;
    }
    return (bounds->bound1_rad > bounds->bound2_rad) ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2;
}

static void report(const jcal_hinge_evidence_t *self, jcal_hinge_verdict_t *verdict, jcal_reason_t found,
                   const jcal_hinge_bounds_t *bounds, const sign_t *sign)
{
    if (found != JCAL_REASON_NONE) {
        verdict->agreed = 0u;
    } else if (verdict->agreed < AGREED_MIN) {
        verdict->agreed = (uint8_t)(verdict->agreed + 1u);
    }
    const bool ready = verdict->agreed >= AGREED_MIN;
    jcal_reason_t reason = (!ready && (found == JCAL_REASON_NONE)) ? JCAL_REASON_UNCERTAIN : found;
    if (verdict->after_doubt && ((reason == JCAL_REASON_NO_DATA) || (reason == JCAL_REASON_UNCERTAIN))) {
        reason = JCAL_REASON_DOES_NOT_FIT; /* what came before did not, and this is too little to say that it does */
    }
    const bool ambiguous = (reason == JCAL_REASON_SIGN_OPEN) || (reason == JCAL_REASON_OTHER_MINIMUM);
    const jcal_weak_t weak = weak_for(self, reason, bounds);
    if ((verdict->status != (uint8_t)JCAL_MOVED) || (self->search->rounds > 0u)) { /* there is something new to say */
        verdict->status = (uint8_t)(ready ? JCAL_READY : (ambiguous ? JCAL_AMBIGUOUS : JCAL_COLLECTING));
    }
    verdict->reason = (uint8_t)reason;
    verdict->weak = (uint8_t)weak;
    verdict->hint = (uint8_t)hint_for(reason, weak);
    verdict->bound1_rad = bounds->bound1_rad;
    verdict->bound2_rad = bounds->bound2_rad;
    verdict->sign_margin = sign->margin;
    verdict->sign_progress = (uint8_t)(255.0f * jcal_max(jcal_min(sign->evidence / SIGN_EVIDENCE_MIN, 1.0f), 0.0f));
}

/// Why there are no bounds.
static jcal_reason_t why_nothing_is_known(const jcal_hinge_evidence_t *self, const sign_t *sign)
{
    if (self->complaint != JCAL_REASON_NONE) {
        return self->complaint;
    }
    if (contradicts_hint(self, sign)) {
        return JCAL_REASON_SIGN_OPEN;
    }
    if (self->search->rounds < ROUNDS_MANY) {
        return JCAL_REASON_NO_DATA;
    }
    if (self->amount->excitation < EXCITATION_MIN) {
        return JCAL_REASON_NO_MOTION;
    }
    return is_explained(self, UNEXPLAINED_MAX) ? JCAL_REASON_UNCERTAIN : JCAL_REASON_DOES_NOT_FIT;
}

/// True if something other than this joint seems to be in the sums, although it has moved: no hinge explains them; or one does, but not
/// as well as a joint does, and no axis comes out of it.
static bool is_contradicted(const jcal_hinge_evidence_t *self, const jcal_hinge_bounds_t *bounds, bool has_bounds)
{
    if (!(self->amount->excitation > EXCITATION_MIN)) {
        return false;
    }
    const bool blank = jcal_min(bounds->bound1_rad, bounds->bound2_rad) >= JCAL_BOUND_UNKNOWN_RAD;
    return !is_explained(self, UNEXPLAINED_MAX) || (has_bounds && !fits(self, 1.0f)) ||
           (blank && !is_explained(self, STRAINED_MIN));
}

bool jcal_hinge_judge(const jcal_hinge_evidence_t *self, jcal_hinge_verdict_t *verdict)
{
    jcal_hinge_bounds_t bounds = {JCAL_BOUND_UNKNOWN_RAD, JCAL_BOUND_UNKNOWN_RAD, 0.0f};
    sign_t sign = {0.0f, 0.0f};
    bool has_bounds = false;
    if (self->coarse->has_point) {
        sign = compare_signs(self);
        has_bounds = jcal_hinge_bounds(self->refine, &self->coarse->moments, self->cfg, &bounds);
        verdict->contradicted = is_contradicted(self, &bounds, has_bounds);
    }
    if (!has_bounds) {
        report(self, verdict, why_nothing_is_known(self, &sign), &bounds, &sign);
        return false;
    }
    const float slack = (verdict->status == (uint8_t)JCAL_READY) ? JCAL_HYSTERESIS : 1.0f;
    report(self, verdict, find_reason(self, &bounds, &sign, slack), &bounds, &sign);
    return !is_hinted(self) && (sign.evidence < SIGN_EVIDENCE_TURN);
}
