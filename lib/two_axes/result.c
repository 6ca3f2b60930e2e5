/* SPDX-License-Identifier: MIT */
/// @file
/// What a person's joint with two axes says.
#include "ball/judge.h"
#include "joint/head.h"
#include "joint/sign.h"
#include "jointcal/two_axes.h"
#include "jointcal/vec3.h"

#include <stddef.h>

/// An axis with the sign that it is reported with.
static jcal_vec3_t signed_axis(const jcal_axis_found_t *found, jcal_vec3_t toward)
{
    return jcal_vec3_scale(found->axis, jcal_sign_of(found->axis, toward, found->kept_sign));
}

jcal_status_t jcal_two_axes_get(const jcal_two_axes_t *self, jcal_two_axes_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_axis_found_t *const first = &self->windows.found[0];
    const jcal_axis_found_t *const second = &self->windows.found[1];
    *out = (jcal_two_axes_result_t){0};
    (void)jcal_ball_get(&self->ball, &out->ball);
    out->for_heading = out->ball.head.status == JCAL_READY;
    const bool is_joint = jcal_ball_is_joint(&self->ball);
    out->axis1 = signed_axis(first, self->cfg.axis1_toward);
    out->axis2 = signed_axis(second, self->cfg.axis2_toward);
    out->windows1 = first->windows;
    out->windows2 = second->windows;
    out->uncertainty1_rad = first->bound_rad;
    out->uncertainty2_rad = second->bound_rad;
    out->for_axis1 = is_joint && !first->in_doubt && (first->bound_rad <= self->cfg.max_bound_rad);
    out->for_axis2 = is_joint && !second->in_doubt && (second->bound_rad <= self->cfg.max_bound_rad);
    out->progress_axis1 = jcal_head_progress(first->bound_rad, self->cfg.max_bound_rad);
    out->progress_axis2 = jcal_head_progress(second->bound_rad, self->cfg.max_bound_rad);
    jcal_head_t *const head = &out->ball.head;
    if (out->for_heading && !(out->for_axis1 && out->for_axis2)) {
        head->status = JCAL_COLLECTING;
        head->reason = JCAL_REASON_UNCERTAIN;
        head->weak = out->for_axis1 ? JCAL_WEAK_AXIS2 : JCAL_WEAK_AXIS1;
        head->hint = out->for_axis1 ? JCAL_HINT_TURN_ONLY : JCAL_HINT_BEND_ONLY;
    }
    return JCAL_OK;
}
