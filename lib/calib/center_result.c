/* SPDX-License-Identifier: MIT */
/// @file
/// What the stream engine of the joint centre tells its user.
#include "jointcal/center.h"
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

static void tell_verdict(const jcal_center_t *self, jcal_center_result_t *out)
{
    const jcal_center_verdict_t *const verdict = &self->work.verdict;
    out->status = (jcal_calibration_t)verdict->status;
    out->weak = (jcal_weak_t)verdict->weak;
    out->hint = (jcal_hint_t)verdict->hint;
    out->reason = (jcal_reason_t)verdict->reason;
    out->uncertainty1_m = verdict->bound1_m;
    out->uncertainty2_m = verdict->bound2_m;
    out->uncertainty_weakest1_m = verdict->weakest1_m;
    out->uncertainty_weakest2_m = verdict->weakest2_m;
    out->weakest_direction1 = verdict->direction1;
    out->weakest_direction2 = verdict->direction2;
    out->misfit = verdict->misfit;
    out->progress1 = progress(verdict->bound1_m, self->cfg.max_bound_m);
    out->progress2 = progress(verdict->bound2_m, self->cfg.max_bound_m);
    const jcal_reason_t complaint = jcal_gate_complaint(&self->gate);
    if (complaint != JCAL_REASON_NONE) { /* a sensor that fails sends nothing that a judgement would follow */
        out->status = JCAL_COLLECTING;
        out->reason = complaint;
        out->hint = JCAL_HINT_CHECK_SENSORS;
    }
}

jcal_status_t jcal_center_get(const jcal_center_t *self, jcal_center_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_center_result_t result = {0};
    result.engine = JCAL_ENGINE_STREAM;
    tell_verdict(self, &result);
    result.has_center = self->has_point;
    if (self->has_point) {
        jcal_center_place_t place = self->work.sums.point.place;
        shift_along_axis(&self->cfg, &place);
        result.joint_to_sensor1_m = place.r1;
        result.joint_to_sensor2_m = place.r2;
        result.acc_bias1_m_s2 = self->work.sums.point.b1;
        result.acc_bias2_m_s2 = self->work.sums.point.b2;
        result.heading_offset_rad = jcal_atan2(self->work.sums.point.heading.im, self->work.sums.point.heading.re);
    }
    result.t_us = self->t_us;
    result.samples = self->gate.samples;
    for (unsigned i = 0u; i < (unsigned)JCAL_REJECT_COUNT; ++i) {
        result.rejected_by[i] = self->gate.rejected_by[i];
        result.rejected += self->gate.rejected_by[i];
    }
    *out = result;
    return JCAL_OK;
}
