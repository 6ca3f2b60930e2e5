/* SPDX-License-Identifier: MIT */
/// @file
/// What is told of a joint: its engine's word, as far as it is believed. Private.
#ifndef JCAL_BODY_REPORT_H
#define JCAL_BODY_REPORT_H

#include "jointcal/body.h"

/// True if the lag of a joint is known, or none is looked for.
static inline bool jcal_body_in_step(const jcal_body_t *self, unsigned joint)
{
    return (self->table.shared == NULL) || self->table.joint_states[joint].lag_known;
}

/// Everything but angles, which are NaN; the head as it is believed, its time that of the hub.
void jcal_body_report(const jcal_body_t *self, unsigned joint, jcal_body_joint_result_t *out);

#endif /* JCAL_BODY_REPORT_H */
