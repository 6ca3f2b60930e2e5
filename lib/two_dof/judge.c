/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and readiness of a 2-DoF joint. See two_dof/judge.h.
#include "two_dof/judge.h"

#include "joint/watch.h"
#include "math/angle.h"
#include "math/scalar.h"
#include "math/sym.h"
#include "two_dof/model.h"
#include "two_dof/prior.h"
#include "two_dof/stream.h"
#include "two_dof/verdict.h"

#include <stddef.h>

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

/// After a slip an orientation filter takes seconds to settle. What has not fitted for so many judgements then is given up, too.
#define MISFITS_RECOVERING 16u

/// Time over which the drift of the heading offset is averaged, s, and the largest that is believed, times what the config says.
#define DRIFT_TIME_S 20.0f
#define DRIFT_MAX 2.0f

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

/// Covariance (5 x 5, packed) from the sums and the prior; false if there is none.
static bool covariance_of(const jcal_two_dof_t *self, float *inverse)
{
    jcal_two_dof_lin_t all;
    jcal_two_dof_prior_apply(&self->prior, &self->best.point, &self->search.lin, &all);
    return jcal_two_dof_covariance(all.matrix, JCAL_TWO_DOF_UNKNOWNS, inverse);
}

void jcal_two_dof_judge(jcal_two_dof_t *self)
{
    jcal_two_dof_verdict_t *const verdict = &self->verdict;
    const jcal_two_dof_search_t *const search = &self->search;
    float inverse[JCAL_SYM_SIZE(JCAL_TWO_DOF_UNKNOWNS)];
    const jcal_two_dof_evidence_t evidence = {
        .covariance = covariance_of(self, inverse) ? inverse : NULL,
        .parts = {search->parts[0], search->parts[1]},
        .moving_s = self->moving_s,
        .age_s = self->age_s,
        .sine = jcal_two_dof_mean(&self->moments, &self->best.point),
        .bad_share = self->gate.bad_share,
        .cost = search->cost,
        .rival_cost = search->rival_cost,
        .has_rival = search->has_rival,
        .tried = search->tried,
        .exchanges = search->exchanges,
    };
    jcal_two_dof_conclude(verdict, &self->cfg, &evidence, &self->search.agreed);
    if (verdict->reason != (uint8_t)JCAL_REASON_DOES_NOT_FIT) {
        self->search.misfits = 0u;
    } else if (self->watch.on || self->recovers) {
        self->search.misfits = (uint8_t)(self->search.misfits + 1u);
    } else {
        /* never did */
    }
    if (self->search.misfits >= (self->watch.on ? MISFITS_MAX : MISFITS_RECOVERING)) {
        jcal_two_dof_begin_anew(self, self->watch.on ? JCAL_MOVED : (jcal_calibration_t)verdict->status);
        return;
    }
    if (verdict->status == (uint8_t)JCAL_READY) {
        self->recovers = false;
        jcal_watch_start(&self->watch);
    }
}
