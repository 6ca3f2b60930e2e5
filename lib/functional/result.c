/* SPDX-License-Identifier: MIT */
/// @file
/// What the functional joint says.
#include "functional/judge.h"
#include "joint/head.h"
#include "joint/sign.h"
#include "jointcal/functional.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/scalar.h"

#include <float.h>
#include <math.h>

/// Largest margin that is told.
#define MARGIN_MAX 1e6f

static void say_axes(const jcal_functional_t *self, jcal_functional_result_t *out)
{
    const jcal_functional_point_t *const point = &self->point;
    const jcal_functional_verdict_t *const verdict = &self->verdict;
    const float sign = jcal_sign_of(point->j1, self->cfg.axis1_toward, self->kept_sign[0]);
    out->axis1 = jcal_vec3_scale(point->j1, sign);
    out->axis2 = jcal_vec3_scale(point->j2, sign);
    out->joint_to_sensor1_m = point->r1;
    out->joint_to_sensor2_m = point->r2;
    out->bend_rad = verdict->bend_rad;
    out->rate_share = sqrtf(point->size[JCAL_FAMILY_RATE]);
    out->sign_margin = jcal_min(verdict->opposite / jcal_max(jcal_functional_left(self), FLT_MIN), MARGIN_MAX);
    const float evidence = jcal_functional_evidence(verdict);
    out->progress_sign = jcal_max(0.0f, jcal_min(1.0f, evidence / JCAL_FUNCTIONAL_EVIDENCE_MIN));
    out->progress_axis1 = jcal_head_progress(verdict->bound1_rad, self->cfg.max_bound_rad);
    out->progress_axis2 = jcal_head_progress(verdict->bound2_rad, self->cfg.max_bound_rad);
    out->heading.known = self->track.known;
    out->heading.heading_rad = self->track.known ? jcal_atan2(self->track.heading.im, self->track.heading.re) : 0.0f;
}

jcal_status_t jcal_functional_get(const jcal_functional_t *self, jcal_functional_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_functional_verdict_t *const verdict = &self->verdict;
    *out = (jcal_functional_result_t){0};
    out->head.status = (jcal_calibration_t)verdict->status;
    out->head.engine = JCAL_ENGINE_STREAM;
    out->head.weak = (jcal_weak_t)verdict->weak;
    out->head.hint = (jcal_hint_t)verdict->hint;
    out->head.reason = (jcal_reason_t)verdict->reason;
    out->head.samples = self->ticks.count;
    out->head.t_us = self->ticks.last_us;
    out->has_axes = self->search.has_estimate;
    const bool unknown = !verdict->is_one_axis;
    out->uncertainty1_rad = unknown ? JCAL_BOUND_UNKNOWN_RAD : verdict->bound1_rad;
    out->uncertainty2_rad = unknown ? JCAL_BOUND_UNKNOWN_RAD : verdict->bound2_rad;
    out->flexion_uncertainty_rad = unknown ? JCAL_BOUND_UNKNOWN_RAD : verdict->flexion_rad;
    if (out->has_axes) {
        say_axes(self, out);
    }
    out->gravity_off_m_s2 = self->ticks.gravity_off;
    const bool ready = out->head.status == JCAL_READY;
    out->for_axes = ready && verdict->for_axes;
    out->for_flexion = ready && verdict->for_flexion;
    return JCAL_OK;
}
