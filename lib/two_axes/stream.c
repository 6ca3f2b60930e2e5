/* SPDX-License-Identifier: MIT */
/// @file
/// A person's joint with two axes: heading and levers of a ball joint, and axes from windows. Method: docs/METHOD_PEOPLE.md, section 11.
#include "ball/judge.h"
#include "joint/sign.h"
#include "jointcal/two_axes.h"
#include "jointcal/vec3.h"
#include "math/clear.h"
#include "two_axes/windows.h"

#include <stddef.h>

/// Motion of what is no joint, s, after which axes are in doubt.
#define LOST_S 5.0f

typedef char jcal_two_axes_fits_its_budget[(sizeof(jcal_two_axes_t) <= 1536u) ? 1 : -1];

static void clear(jcal_two_axes_t *self)
{
    jcal_clear(&self->windows, sizeof self->windows);
    jcal_axis_windows_cut(&self->windows);
    for (size_t k = 0u; k < 2u; ++k) {
        self->windows.found[k].bound_rad = JCAL_BOUND_UNKNOWN_RAD;
    }
}

jcal_status_t jcal_two_axes_init(jcal_two_axes_t *self, const jcal_two_axes_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_two_axes_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    self->cfg = *config;
    clear(self);
    return jcal_ball_init(&self->ball, &config->ball);
}

jcal_status_t jcal_two_axes_reset(jcal_two_axes_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_two_axes_init(self, &self->cfg);
}

/// Axes that were found are in doubt once the joint has been lost for a while: what comes back may be another mounting.
static void doubt(jcal_two_axes_t *self)
{
    if (self->ball.refused_s > LOST_S) {
        self->windows.found[0].in_doubt = true;
        self->windows.found[1].in_doubt = true;
    }
}

jcal_status_t jcal_two_axes_add(jcal_two_axes_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    if ((self == NULL) || (tick1 == NULL) || (tick2 == NULL)) {
        return JCAL_ERR_ARG;
    }
    const bool had_estimate = self->ball.has_estimate;
    const jcal_status_t status = jcal_ball_add(&self->ball, tick1, tick2);
    if (status != JCAL_OK) {
        return status;
    }
    if (had_estimate && !self->ball.has_estimate) {
        clear(self);
    }
    if (self->ball.track.known) {
        jcal_axis_windows_add(&self->windows, tick1, tick2, self->ball.track.heading);
    } else { /* without a heading there is no relative rate, and none of before fits the next one */
        jcal_axis_windows_cut(&self->windows);
    }
    doubt(self);
    return JCAL_OK;
}

jcal_status_t jcal_two_axes_step(jcal_two_axes_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    const bool had_estimate = self->ball.has_estimate;
    const jcal_status_t status = jcal_ball_step(&self->ball);
    if (had_estimate && !self->ball.has_estimate) { /* all is learnt anew */
        clear(self);
        return status;
    }
    if (status != JCAL_IDLE) {
        return status;
    }
    const jcal_ball_t *const ball = &self->ball;
    const jcal_window_context_t context = {ball->point.r1,         ball->point.r2,
                                           ball->track.heading,    ball->verdict.heading_rad,
                                           ball->verdict.bound2_m, jcal_ball_is_joint(ball)};
    if (!jcal_axis_windows_step(&self->windows, &context)) {
        return JCAL_IDLE;
    }
    const jcal_vec3_t toward[2] = {self->cfg.axis1_toward, self->cfg.axis2_toward};
    for (size_t k = 0u; k < 2u; ++k) { /* the sign of what is known stays */
        jcal_axis_found_t *const found = &self->windows.found[k];
        if (found->bound_rad <= self->cfg.max_bound_rad) {
            jcal_sign_keep(&found->kept_sign, found->axis, toward[k]);
        }
    }
    return JCAL_OK;
}
