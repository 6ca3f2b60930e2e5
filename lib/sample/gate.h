/* SPDX-License-Identifier: MIT */
/// @file
/// What only the library may do to the gate for readings. Private.
#ifndef JCAL_SAMPLE_GATE_H
#define JCAL_SAMPLE_GATE_H

#include "jointcal/gate.h"

/// Counts a sample that something else than its readings excludes, as if this gate had rejected it.
void jcal_gate_refuse(jcal_gate_t *self, jcal_reject_t cause);

#endif /* JCAL_SAMPLE_GATE_H */
