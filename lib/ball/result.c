/* SPDX-License-Identifier: MIT */
/// @file
/// What the ball joint says.
#include "ball/judge.h"
#include "joint/head.h"
#include "jointcal/ball.h"
#include "jointcal/quat.h"
#include "math/angle.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

jcal_status_t jcal_ball_get(const jcal_ball_t *self, jcal_ball_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_ball_verdict_t *const verdict = &self->verdict;
    *out = (jcal_ball_result_t){0};
    out->head.status = (jcal_calibration_t)verdict->status;
    out->head.engine = JCAL_ENGINE_STREAM;
    out->head.weak = (jcal_weak_t)verdict->weak;
    out->head.hint = (jcal_hint_t)verdict->hint;
    out->head.reason = (jcal_reason_t)verdict->reason;
    out->head.samples = self->ticks.count;
    out->head.t_us = self->ticks.last_us;
    out->has_estimate = self->has_estimate;
    const bool ready = out->head.status == JCAL_READY;
    out->for_center1 = ready && verdict->for_center1;
    out->for_center2 = ready && verdict->for_center2;
    const bool is_joint = self->has_estimate && (verdict->agreed > 0u); /* else no bound means anything */
    out->uncertainty_heading_rad = is_joint ? verdict->heading_rad : JCAL_BOUND_UNKNOWN_RAD;
    out->uncertainty1_m = is_joint ? verdict->bound1_m : JCAL_BOUND_UNKNOWN_M;
    out->uncertainty2_m = is_joint ? verdict->bound2_m : JCAL_BOUND_UNKNOWN_M;
    out->gravity_off_m_s2 = self->ticks.gravity_off;
    if (self->has_estimate) {
        out->joint_to_sensor1_m = self->point.r1;
        out->joint_to_sensor2_m = self->point.r2;
        out->speed_m_s = sqrtf(jcal_max(0.5f * self->point.speed2, 0.0f));
        out->heading.known = jcal_ball_knows_heading(self);
        out->heading.heading_rad =
            out->heading.known ? jcal_atan2(self->track.heading.im, self->track.heading.re) : 0.0f;
        out->progress_heading = jcal_head_progress(out->uncertainty_heading_rad, self->cfg.max_heading_rad);
        out->progress_center1 = jcal_head_progress(out->uncertainty1_m, self->cfg.max_lever_m);
        out->progress_center2 = jcal_head_progress(out->uncertainty2_m, self->cfg.max_lever_m);
    }
    return JCAL_OK;
}

jcal_quat_t jcal_ball_relative(const jcal_ball_t *self, jcal_quat_t orientation1, jcal_quat_t orientation2)
{
    if ((self == NULL) || !jcal_ball_knows_heading(self)) {
        return jcal_quat(NAN, NAN, NAN, NAN);
    }
    const jcal_plane_t h = self->track.heading;
    const float w = sqrtf(jcal_max(0.5f * (1.0f + h.re), 0.0f)); /* half the heading */
    const float z = copysignf(sqrtf(jcal_max(0.5f * (1.0f - h.re), 0.0f)), h.im);
    const jcal_quat_t turned = jcal_quat_mul(jcal_quat(w, 0.0f, 0.0f, z), orientation2);
    return jcal_quat_mul(jcal_quat_conj(orientation1), turned);
}
