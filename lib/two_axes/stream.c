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

jcal_status_t jcal_two_axes_add(jcal_two_axes_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    if ((self == NULL) || (tick1 == NULL) || (tick2 == NULL)) {
        return JCAL_ERR_ARG;
    }
    const uint32_t epoch1 = self->ball.ticks.epoch1;
    const uint32_t epoch2 = self->ball.ticks.epoch2;
    const jcal_status_t status = jcal_ball_add(&self->ball, tick1, tick2);
    if (status != JCAL_OK) {
        return status;
    }
    if ((self->ball.ticks.epoch1 != epoch1) || (self->ball.ticks.epoch2 != epoch2)) {
        jcal_axis_windows_cut(&self->windows);
    } else if (self->ball.track.known) {
        jcal_axis_windows_add(&self->windows, tick1, tick2, self->ball.track.heading);
    } else {
        /* without a heading there is no relative rate */
    }
    return JCAL_OK;
}

jcal_status_t jcal_two_axes_step(jcal_two_axes_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    const bool had_moved = self->ball.verdict.status == (uint8_t)JCAL_MOVED;
    const jcal_status_t status = jcal_ball_step(&self->ball);
    if (!had_moved && (self->ball.verdict.status == (uint8_t)JCAL_MOVED)) {
        clear(self);
        return status;
    }
    if (status != JCAL_IDLE) {
        return status;
    }
    const jcal_window_context_t context = {self->ball.point.r1, self->ball.point.r2, self->ball.verdict.heading_rad,
                                           jcal_ball_is_joint(&self->ball)};
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
