/* SPDX-License-Identifier: MIT */
/// @file
/// Which sensors hang on which, and lags taken off down the tree. See body/tree.h.
#include "body/tree.h"

#include "body/engine.h"
#include "body/line.h"
#include "jointcal/pairing.h"

#define MICROSECONDS 1e-6f

/// What an engine learnt with times that were off by less it keeps, us.
#define ANEW_US 20000

bool jcal_body_hangs_on(const jcal_body_t *self, unsigned sensor, unsigned root)
{
    unsigned at = sensor;
    for (unsigned k = 0u; k < self->table.sensor_count; ++k) {
        const unsigned joint = self->table.sensor_states[at].joint;
        if ((at == root) || (joint >= self->table.joint_count)) {
            break;
        }
        at = self->table.joints[joint].proximal;
    }
    return at == root;
}

static int64_t magnitude(int64_t value)
{
    return (value < 0) ? -value : value;
}

bool jcal_body_shift(jcal_body_t *self, unsigned joint, float lag_s)
{
    const int32_t most_us = (int32_t)((JCAL_BODY_SHIFT_MAX_S / MICROSECONDS) + 0.5f);
    const int32_t lag_us = (int32_t)((lag_s / MICROSECONDS) + ((lag_s < 0.0f) ? -0.5f : 0.5f));
    const unsigned root = self->table.joints[joint].distal;
    for (unsigned s = 0u; s < self->table.sensor_count; ++s) {
        if (jcal_body_hangs_on(self, s, root) &&
            (magnitude((int64_t)self->table.sensor_states[s].shift_us + lag_us) > most_us)) {
            self->lags_refused += 1u;
            return false;
        }
    }
    const uint32_t from = self->round.number + (JCAL_PAIRING_HOLE_US / self->pace.period_us) + 1u;
    for (unsigned s = 0u; s < self->table.sensor_count; ++s) {
        if (jcal_body_hangs_on(self, s, root)) {
            jcal_body_sensor_t *const sensor = &self->table.sensor_states[s];
            sensor->shift_us += lag_us;
            jcal_body_line_begin(&sensor->line, &self->pace, from);
        }
    }
    jcal_body_joint_t *const state = &self->table.joint_states[joint];
    state->off_us = (int32_t)((uint32_t)state->off_us + (uint32_t)lag_us);
    if (magnitude(state->off_us) > ANEW_US) {
        state->off_us = 0;
        jcal_body_engine_reset(&self->table.joints[joint]);
    }
    return true;
}
