/* SPDX-License-Identifier: MIT */
/// @file
/// Readiness of the functional joint: what stands between the estimate and `ready`, the worst first. Private.
#ifndef JCAL_FUNCTIONAL_JUDGE_H
#define JCAL_FUNCTIONAL_JUDGE_H

#include "jointcal/private/functional/stream.h"

/// Status, reason, weak and hint of the verdict.
void jcal_functional_judge(jcal_functional_t *self);

/// True if the pairing of `axis1` and `axis2` is what the user's hint says, or there is none.
bool jcal_functional_obeys(jcal_sign_hint_t hint, jcal_vec3_t axis1, jcal_vec3_t axis2);

#endif /* JCAL_FUNCTIONAL_JUDGE_H */
