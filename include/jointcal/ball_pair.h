/* SPDX-License-Identifier: MIT */
/// @file
/// A ball joint with the sensor stages of its own two sensors, for those who have readings in pairs and one joint.
///
/// Where a sensor serves two joints, or readings do not come in pairs, use sensor.h and ball.h.
///
///     static jcal_ball_pair_t hip;
///     (void)jcal_ball_pair_init(&hip, &config, &gate);
///     (void)jcal_ball_pair_update(&hip, &pair);       for each pair of readings
///     (void)jcal_ball_pair_get(&hip, &result);
///     const jcal_quat_t thigh_in_pelvis = jcal_ball_pair_relative(&hip);
///
/// Cost: 2.7 KiB of state.
#ifndef JCAL_BALL_PAIR_H
#define JCAL_BALL_PAIR_H

#include "jointcal/ball.h"
#include "jointcal/private/ball/pair.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Prepares an estimator; whatever `self` held before is lost. `limits` of single samples; null: the defaults.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG; self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_ball_pair_init(jcal_ball_pair_t *self, const jcal_ball_config_t *config,
                                                  const jcal_gate_config_t *limits);

/// Takes in a pair of readings and works off the slices that are due.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG.
/// Threads:  one task.
jcal_status_t jcal_ball_pair_update(jcal_ball_pair_t *self, const jcal_pair_t *pair);

/// Copies the current result; what the gate complains of stands above what was judged. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_ball_pair_get(const jcal_ball_pair_t *self, jcal_ball_result_t *out);

/// Orientation of sensor 2 in sensor 1 at the last pair, as jcal_ball_relative.
jcal_quat_t jcal_ball_pair_relative(const jcal_ball_pair_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_BALL_PAIR_H */
