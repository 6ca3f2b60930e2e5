/* SPDX-License-Identifier: MIT */
/// @file
/// What the engines of the joint centre tell their user. See center/result.h.
#include "center/result.h"

#include "center/place.h"
#include "joint/head.h"
#include "math/angle.h"

#include <stddef.h>

static void tell_point(const jcal_center_point_t *point, const jcal_center_place_t *told, jcal_center_result_t *out)
{
    out->joint_to_sensor1_m = told->r1;
    out->joint_to_sensor2_m = told->r2;
    out->acc_bias1_m_s2 = point->b1;
    out->acc_bias2_m_s2 = point->b2;
    out->heading_offset_rad = jcal_atan2(point->heading.im, point->heading.re);
}

static void tell_bounds(const jcal_center_verdict_t *verdict, jcal_center_result_t *out)
{
    out->uncertainty1_m = verdict->bound1_m;
    out->uncertainty2_m = verdict->bound2_m;
    out->uncertainty_weakest1_m = verdict->weakest1_m;
    out->uncertainty_weakest2_m = verdict->weakest2_m;
    out->weakest_direction1 = verdict->direction1;
    out->weakest_direction2 = verdict->direction2;
    out->misfit = verdict->misfit;
}

/// Nothing is known of where the centre is. The verdict may be that of a moment ago.
static void tell_nothing(jcal_center_result_t *out)
{
    out->uncertainty1_m = JCAL_BOUND_UNKNOWN_M;
    out->uncertainty2_m = JCAL_BOUND_UNKNOWN_M;
    out->uncertainty_weakest1_m = JCAL_BOUND_UNKNOWN_M;
    out->uncertainty_weakest2_m = JCAL_BOUND_UNKNOWN_M;
    if (out->head.status == JCAL_READY) {
        out->head.status = JCAL_COLLECTING;
        out->head.reason = JCAL_REASON_UNCERTAIN;
        out->head.hint = JCAL_HINT_MOVE_JOINT;
        out->head.weak = JCAL_WEAK_CENTER1;
    }
}

void jcal_center_report(const jcal_center_config_t *cfg, const jcal_center_work_t *work,
                        const jcal_center_input_t *input, bool has_point, jcal_center_result_t *out)
{
    const jcal_center_verdict_t *const verdict = &work->verdict;
    const jcal_center_place_t told = jcal_center_place_told(cfg, &work->sums.point.place);
    *out = (jcal_center_result_t){0};
    out->head.status = (jcal_calibration_t)verdict->status;
    out->head.weak = (jcal_weak_t)verdict->weak;
    out->head.hint = (jcal_hint_t)verdict->hint;
    out->head.reason = (jcal_reason_t)verdict->reason;
    out->has_center = has_point && jcal_center_place_in_reach(&told);
    if (out->has_center) {
        tell_bounds(verdict, out);
        tell_point(&work->sums.point, &told, out);
    } else {
        tell_nothing(out);
    }
    out->progress1 = jcal_head_progress(out->uncertainty1_m, cfg->max_bound_m);
    out->progress2 = jcal_head_progress(out->uncertainty2_m, cfg->max_bound_m);
    const jcal_weak_t weakest = (out->uncertainty2_m > out->uncertainty1_m) ? JCAL_WEAK_CENTER2 : JCAL_WEAK_CENTER1;
    jcal_head_complain(&out->head, jcal_gate_complaint(&input->gate), weakest);
    jcal_head_count(&out->head, input->gate.samples, input->gate.rejected_by);
    out->head.overrun = input->inbox.ring.overrun;
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
