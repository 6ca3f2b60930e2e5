/* SPDX-License-Identifier: MIT */
/// @file
/// A functional joint with the sensor stages of its own two sensors, for those who have readings in pairs and one joint.
///
/// Where a sensor serves two joints, or readings do not come in pairs, use sensor.h and functional.h.
///
///     static jcal_functional_pair_t knee;
///     (void)jcal_functional_pair_init(&knee, &config, &gate);
///     (void)jcal_functional_pair_update(&knee, &pair);       for each pair of readings
///     (void)jcal_functional_pair_get(&knee, &result);
///     const float flexion = jcal_functional_pair_flexion(&knee);
///
/// Cost: 5 KiB of state.
#ifndef JCAL_FUNCTIONAL_PAIR_H
#define JCAL_FUNCTIONAL_PAIR_H

#include "jointcal/functional.h"
#include "jointcal/private/functional/pair.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Prepares an estimator; whatever `self` held before is lost. `limits` of single samples; null: the defaults.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG; self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_functional_pair_init(jcal_functional_pair_t *self,
                                                        const jcal_functional_config_t *config,
                                                        const jcal_gate_config_t *limits);

/// Takes in a pair of readings and works off the slices that are due.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG.
/// Threads:  one task.
jcal_status_t jcal_functional_pair_update(jcal_functional_pair_t *self, const jcal_pair_t *pair);

/// Copies the current result; what the gate complains of stands above what was judged. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_functional_pair_get(const jcal_functional_pair_t *self, jcal_functional_result_t *out);

/// The joint's angle at the last pair, as jcal_functional_flexion; NaN for null.
float jcal_functional_pair_flexion(const jcal_functional_pair_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_FUNCTIONAL_PAIR_H */
