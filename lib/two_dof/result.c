/* SPDX-License-Identifier: MIT */
/// @file
/// What the engines of the 2-DoF joint tell their user. See two_dof/result.h.
#include "two_dof/result.h"

#include "joint/head.h"
#include "joint/sign.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

static void put_estimate(const jcal_two_dof_verdict_t *verdict, const jcal_two_dof_config_t *cfg,
                         const jcal_two_dof_point_t *point, jcal_two_dof_result_t *out)
{
    const float sine = verdict->sine;
    const float sign1 = jcal_sign_of(point->j1, cfg->axis1_toward, verdict->sign1);
    const float sign2 = jcal_sign_of(point->j2, cfg->axis2_toward, verdict->sign2);
    out->axis1 = jcal_vec3_scale(point->j1, sign1);
    out->axis2 = jcal_vec3_scale(point->j2, sign2);
    out->heading_offset_rad = jcal_atan2(point->heading.im, point->heading.re);
    out->carrying_angle_rad = sign1 * sign2 * jcal_atan2(sine, sqrtf(jcal_max(1.0f - (sine * sine), 0.0f)));
}

void jcal_two_dof_report(const jcal_two_dof_verdict_t *verdict, const jcal_two_dof_config_t *cfg,
                         const jcal_two_dof_point_t *point, jcal_two_dof_result_t *out)
{
    const float limit = cfg->max_bound_rad;
    *out = (jcal_two_dof_result_t){0};
    out->head.status = (jcal_calibration_t)verdict->status;
    out->head.weak = (jcal_weak_t)verdict->weak;
    out->head.hint = (jcal_hint_t)verdict->hint;
    out->head.reason = (jcal_reason_t)verdict->reason;
    out->uncertainty1_rad = verdict->bound1_rad;
    out->uncertainty2_rad = verdict->bound2_rad;
    out->uncertainty_heading_rad = verdict->bound_heading_rad;
    if (point != NULL) {
        out->has_axes = true;
        out->progress_axis1 = jcal_head_progress(verdict->bound1_rad, limit);
        out->progress_axis2 = jcal_head_progress(verdict->bound2_rad, limit);
        out->progress_heading = jcal_head_progress(verdict->bound_heading_rad, limit);
        put_estimate(verdict, cfg, point, out);
    }
}

void jcal_two_dof_report_gate(const jcal_orientation_gate_t *gate, jcal_two_dof_result_t *out)
{
    const bool first = out->uncertainty1_rad >= out->uncertainty2_rad;
    jcal_head_complain(&out->head, jcal_orientation_gate_complaint(gate), first ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2);
    jcal_head_count(&out->head, gate->samples, gate->rejected_by);
}

jcal_status_t jcal_two_dof_get(const jcal_two_dof_t *self, jcal_two_dof_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_two_dof_report(&self->verdict, &self->cfg, self->search.has_best ? &self->search.best.point : NULL, out);
    jcal_two_dof_report_gate(&self->gate, out);
    out->head.engine = JCAL_ENGINE_STREAM;
    out->head.t_us = self->t_us;
    out->head.overrun = self->kept.ring.overrun;
    return JCAL_OK;
}
