/* SPDX-License-Identifier: MIT */
/// @file
/// What the stream engine of the hinge tells its user.
#include "joint/head.h"
#include "joint/sign.h"
#include "jointcal/hinge.h"
#include "jointcal/vec3.h"

#include <stddef.h>

static void tell_verdict(const jcal_hinge_t *self, jcal_hinge_result_t *result)
{
    const jcal_hinge_verdict_t *const verdict = &self->verdict;
    result->head.status = (jcal_calibration_t)verdict->status;
    result->head.weak = (jcal_weak_t)verdict->weak;
    result->head.hint = (jcal_hint_t)verdict->hint;
    result->head.reason = (jcal_reason_t)verdict->reason;
    result->uncertainty1_rad = verdict->bound1_rad;
    result->uncertainty2_rad = verdict->bound2_rad;
    result->sign_margin = verdict->sign_margin;
    result->progress_axis1 = jcal_head_progress(verdict->bound1_rad, self->cfg.max_bound_rad);
    result->progress_axis2 = jcal_head_progress(verdict->bound2_rad, self->cfg.max_bound_rad);
    result->progress_sign =
        (self->cfg.sign_hint != JCAL_SIGN_UNKNOWN) ? 1.0f : ((float)verdict->sign_progress / 255.0f);
    const bool first = verdict->bound1_rad >= verdict->bound2_rad;
    jcal_head_complain(&result->head, jcal_gate_complaint(&self->gate), first ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2);
}

jcal_status_t jcal_hinge_get(const jcal_hinge_t *self, jcal_hinge_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_hinge_result_t result = {0};
    result.head.engine = JCAL_ENGINE_STREAM;
    tell_verdict(self, &result);
    result.has_axes = self->coarse.has_point;
    if (self->coarse.has_point) {
        const float sign = jcal_sign_of(self->refine.point.axis1.j, self->cfg.axis1_toward, self->kept_sign[0]);
        result.axis1 = jcal_vec3_scale(self->refine.point.axis1.j, sign);
        result.axis2 = jcal_vec3_scale(self->refine.point.axis2.j, sign);
    }
    result.head.t_us = self->last_us;
    jcal_head_count(&result.head, self->gate.samples, self->gate.rejected_by);
    result.head.overrun = self->inbox.ring.overrun;
    *out = result;
    return JCAL_OK;
}
