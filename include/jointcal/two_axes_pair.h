/* SPDX-License-Identifier: MIT */
/// @file
/// A joint with two axes and the sensor stages of its own two sensors, for those who have readings in pairs and one joint.
///
/// Where a sensor serves two joints, or readings do not come in pairs, use sensor.h and two_axes.h.
///
///     static jcal_two_axes_pair_t elbow;
///     (void)jcal_two_axes_pair_init(&elbow, &config, &gate);
///     (void)jcal_two_axes_pair_update(&elbow, &pair);       for each pair of readings
///     (void)jcal_two_axes_pair_get(&elbow, &result);
///     const jcal_quat_t forearm_in_upper_arm = jcal_two_axes_pair_relative(&elbow);
///
/// Cost: 3.2 KiB of state.
#ifndef JCAL_TWO_AXES_PAIR_H
#define JCAL_TWO_AXES_PAIR_H

#include "jointcal/private/two_axes/pair.h"
#include "jointcal/two_axes.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Prepares an estimator; whatever `self` held before is lost. `limits` of single samples; null: the defaults.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG; self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_two_axes_pair_init(jcal_two_axes_pair_t *self, const jcal_two_axes_config_t *config,
                                                      const jcal_gate_config_t *limits);

/// Takes in a pair of readings and works off the slices that are due.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG.
/// Threads:  one task.
jcal_status_t jcal_two_axes_pair_update(jcal_two_axes_pair_t *self, const jcal_pair_t *pair);

/// Copies the current result; what the gate complains of stands above what was judged. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_two_axes_pair_get(const jcal_two_axes_pair_t *self, jcal_two_axes_result_t *out);

/// Orientation of sensor 2 in sensor 1 at the last pair, as jcal_ball_relative of ball.h.
jcal_quat_t jcal_two_axes_pair_relative(const jcal_two_axes_pair_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_AXES_PAIR_H */
