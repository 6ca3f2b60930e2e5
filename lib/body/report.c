/* SPDX-License-Identifier: MIT */
/// @file
/// What is told of a joint. See body/report.h.
#include "body/report.h"

#include "body/engine.h"
#include "body/exchange.h"
#include "body/restore.h"
#include "body/trust.h"

#include <math.h>

void jcal_body_report(const jcal_body_t *self, unsigned joint, jcal_body_joint_result_t *out)
{
    const jcal_body_joint_spec_t *const spec = &self->table.joints[joint];
    const jcal_body_joint_t *const state = &self->table.joint_states[joint];
    const jcal_quat_t unknown = {NAN, NAN, NAN, NAN};
    jcal_body_engine_get(spec, out);
    if (out->head.t_us != 0u) {
        out->head.t_us += self->round.origin_us;
    }
    const jcal_trust_t trust = {
        self->table.sensor_states[spec->proximal].bad, self->table.sensor_states[spec->distal].bad,
        state->not_one || jcal_body_exchange_doubts(self, joint), jcal_body_in_step(self, joint)};
    jcal_trust(&trust, &out->head);
    out->lag_known = trust.lag_known;
    out->lag_s = state->lag_s;
    out->lag_bound_s = state->lag_bound_s;
    jcal_body_restore_report(self, joint, out);
    out->flexion_rad = NAN;
    out->relative = unknown;
}
