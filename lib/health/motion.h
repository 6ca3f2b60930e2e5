/* SPDX-License-Identifier: MIT */
/// @file
/// How much a sensor moves, how much of it is vibration, and what it feels at rest. Private.
///
/// What is fast is the fourth difference of the rate over 16: all of it at half the frequency of the readings, 12 % at a fifth, 2 % at an eighth. Motion
/// has some of it at impacts, after which skin rings at 10 Hz or so; vibration has it always, so the quietest tenth of stretches of a tenth of a second tells.
#ifndef JCAL_HEALTH_MOTION_H
#define JCAL_HEALTH_MOTION_H

#include "jointcal/private/health/state.h"

/// The last rates are forgotten.
void jcal_health_motion_break(jcal_health_motion_t *self);

/// Takes in a reading that came dt_s after the last one, with rates w after `last`. Cost: about 80 instructions.
void jcal_health_motion_add(jcal_health_motion_t *self, jcal_vec3_t last, jcal_vec3_t w,
                            const jcal_health_squares_t *squares, float dt_s);

/// Takes in a full block: about a second of blocks that hardly differ is rest.
void jcal_health_rest_add(jcal_health_rest_t *self, const jcal_health_block_t *block);

/// No rest over a gap.
void jcal_health_rest_break(jcal_health_rest_t *self);

#endif /* JCAL_HEALTH_MOTION_H */
