/* SPDX-License-Identifier: MIT */
/// @file
/// What the engines of the joint centre tell their user. See center/result.h.
#include "center/result.h"

#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/scalar.h"

#include <float.h>
#include <stddef.h>

static float progress(float bound_m, float max_bound_m)
{
    return jcal_min(1.0f, max_bound_m / jcal_max(bound_m, FLT_MIN));
}

/// The points on both axes that are next to the sensors: (11), (12) of [SAL15]. Any other centre on the axis explains as much.
static void shift_along_axis(const jcal_center_config_t *cfg, jcal_center_place_t *place)
{
    const float along1 = jcal_vec3_dot(place->r1, cfg->hinge_axis1);
    const float along2 = jcal_vec3_dot(place->r2, cfg->hinge_axis2);
    const float shift = 0.5f * (along1 + along2);
    place->r1 = jcal_vec3_sub(place->r1, jcal_vec3_scale(cfg->hinge_axis1, shift));
    place->r2 = jcal_vec3_sub(place->r2, jcal_vec3_scale(cfg->hinge_axis2, shift));
}

static void tell_point(const jcal_center_config_t *cfg, const jcal_center_point_t *point, jcal_center_result_t *out)
{
    jcal_center_place_t place = point->place;
    shift_along_axis(cfg, &place);
    out->joint_to_sensor1_m = place.r1;
    out->joint_to_sensor2_m = place.r2;
    out->acc_bias1_m_s2 = point->b1;
    out->acc_bias2_m_s2 = point->b2;
    out->heading_offset_rad = jcal_atan2(point->heading.im, point->heading.re);
}

void jcal_center_report(const jcal_center_config_t *cfg, const jcal_center_work_t *work,
                        const jcal_center_input_t *input, bool has_point, jcal_center_result_t *out)
{
    const jcal_center_verdict_t *const verdict = &work->verdict;
    *out = (jcal_center_result_t){0};
    out->head.status = (jcal_calibration_t)verdict->status;
    out->head.weak = (jcal_weak_t)verdict->weak;
    out->head.hint = (jcal_hint_t)verdict->hint;
    out->head.reason = (jcal_reason_t)verdict->reason;
    out->uncertainty1_m = verdict->bound1_m;
    out->uncertainty2_m = verdict->bound2_m;
    out->uncertainty_weakest1_m = verdict->weakest1_m;
    out->uncertainty_weakest2_m = verdict->weakest2_m;
    out->weakest_direction1 = verdict->direction1;
    out->weakest_direction2 = verdict->direction2;
    out->misfit = verdict->misfit;
    out->progress1 = progress(verdict->bound1_m, cfg->max_bound_m);
    out->progress2 = progress(verdict->bound2_m, cfg->max_bound_m);
    const jcal_reason_t complaint = jcal_gate_complaint(&input->gate);
    if (complaint != JCAL_REASON_NONE) { /* a sensor that fails sends nothing that a judgement would follow */
        out->head.status = JCAL_COLLECTING;
        out->head.reason = complaint;
        out->head.hint = JCAL_HINT_CHECK_SENSORS;
    }
    out->has_center = has_point;
    if (has_point) {
        tell_point(cfg, &work->sums.point, out);
    }
    out->head.samples = input->gate.samples;
    out->head.overrun = input->inbox.ring.overrun;
    for (unsigned i = 0u; i < (unsigned)JCAL_REJECT_COUNT; ++i) {
        out->head.rejected_by[i] = input->gate.rejected_by[i];
        out->head.rejected += input->gate.rejected_by[i];
    }
}

jcal_status_t jcal_center_get(const jcal_center_t *self, jcal_center_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_center_report(&self->cfg, &self->work, &self->input, self->has_point, out);
    out->head.engine = JCAL_ENGINE_STREAM;
    out->head.t_us = self->t_us;
    return JCAL_OK;
}
