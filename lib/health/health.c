/* SPDX-License-Identifier: MIT */
/// @file
/// The health of one sensor: who takes in what, and what is said. See health.h.
#include "jointcal/health.h"

#include "health/block.h"
#include "health/frames.h"
#include "health/motion.h"
#include "health/pace.h"
#include "health/rails.h"
#include "health/scale.h"
#include "health/values.h"
#include "jointcal/vec3.h"
#include "math/clear.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

/// Largest rate and specific force that are taken in, in any unit.
#define VALUE_MOST 1e6f
/// Longest distance of readings over which rates can be summed, us.
#define STEP_MOST_US 105000u

typedef char jcal_health_fits_its_budget[(sizeof(jcal_health_t) <= 976u) ? 1 : -1];

jcal_status_t jcal_health_init(jcal_health_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    jcal_clear(self, sizeof *self);
    jcal_health_frames_begin(&self->frames);
    self->is_ready = true;
    return JCAL_OK;
}

/// Not so for what is not finite.
static bool is_bounded(const jcal_health_squares_t *squares)
{
    return (squares->rate2 <= (VALUE_MOST * VALUE_MOST)) && (squares->acc2 <= (VALUE_MOST * VALUE_MOST));
}

/// What sums over time begins anew.
static void start(jcal_health_t *self, const jcal_imu_t *imu)
{
    jcal_clear(&self->block, sizeof self->block);
    jcal_health_scale_break(&self->scale);
    if (self->frames.filled < JCAL_HEALTH_BLOCKS) {
        jcal_health_frames_break(&self->frames);
    }
    jcal_health_rest_break(&self->rest);
    jcal_health_motion_break(&self->motion);
    self->values.last = *imu;
    self->values.same_us = 0u;
}

/// True if rates as they stand fit best of all ways.
static bool fit_as_is(const jcal_health_frames_t *frames)
{
    float next = 0.0f;
    return jcal_health_frames_best(frames, &next) == JCAL_HEALTH_AS_IS;
}

static void end_block(jcal_health_t *self)
{
    const bool may_take = jcal_health_scale_is_due(&self->scale, &self->block) && fit_as_is(&self->frames);
    jcal_health_scale_add(&self->scale, &self->block, may_take);
    jcal_health_frames_add(&self->frames, &self->block);
    jcal_health_rest_add(&self->rest, &self->block);
    jcal_clear(&self->block, sizeof self->block);
}

jcal_status_t jcal_health_push(jcal_health_t *self, const jcal_reading_t *reading)
{
    if ((self == NULL) || (reading == NULL) || !self->is_ready) {
        return JCAL_ERR_ARG;
    }
    const jcal_imu_t *const imu = &reading->imu;
    const bool is_first = !self->pace.has_last;
    const uint64_t t_us = reading->t_us;
    const jcal_health_squares_t squares = {jcal_vec3_dot(imu->gyr_rad_s, imu->gyr_rad_s),
                                           jcal_vec3_dot(imu->acc_m_s2, imu->acc_m_s2)};
    if (!is_bounded(&squares) || (!is_first && (t_us <= self->pace.last_us))) {
        self->rejected += (self->rejected < UINT32_MAX) ? 1u : 0u;
        /* A clock that was set back is believed at once: nothing here hangs on times of before. */
        self->pace.last_us = (!is_first && (t_us < self->pace.last_us)) ? t_us : self->pace.last_us;
        return JCAL_REJECTED;
    }
    const uint64_t dt_us = is_first ? 0u : (t_us - self->pace.last_us);
    self->pace.last_us = t_us;
    self->pace.has_last = true;
    jcal_health_rails_add(&self->rails, imu);
    if (!is_first) {
        jcal_health_pace_add(&self->pace, dt_us);
    }
    if (is_first || (dt_us > STEP_MOST_US)) {
        start(self, imu);
        return JCAL_OK;
    }
    const float dt_s = 1e-6f * (float)(uint32_t)dt_us;
    jcal_health_motion_add(&self->motion, self->values.last.gyr_rad_s, imu->gyr_rad_s, &squares, dt_s);
    jcal_health_values_add(&self->values, imu, &squares, (uint32_t)dt_us);
    if (jcal_health_block_add(&self->block, imu, dt_s, jcal_health_scale_taken(&self->scale))) {
        end_block(self);
    } else {
        jcal_health_frames_step(&self->frames);
    }
    return JCAL_OK;
}
