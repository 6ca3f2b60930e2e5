/* SPDX-License-Identifier: MIT */
/// @file
/// From readings, with or without orientations, to samples of the joint centre: gate, inbox, derivatives. Private.
#ifndef JCAL_CENTER_INPUT_H
#define JCAL_CENTER_INPUT_H

#include "jointcal/center_config.h"
#include "jointcal/private/center/input.h"
#include "sample/kinematics.h"

/// Forgets everything.
void jcal_center_input_begin(jcal_center_input_t *self);

/// True if there is no room for another pair.
bool jcal_center_input_full(const jcal_center_input_t *self);

/// Checks a pair and puts it into the inbox. `attitudes` may be null unless the method needs them.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted); JCAL_ERR_FULL.
jcal_status_t jcal_center_input_push(jcal_center_input_t *self, const jcal_center_config_t *cfg,
                                     const jcal_pair_t *pair, const jcal_attitudes_t *attitudes);

/// True if samples stand in frames that turn with the sensors: neither smoothing nor orientations.
static inline bool jcal_center_input_turns(const jcal_center_config_t *cfg)
{
    return !(cfg->kinematics.smoothing_s > 0.0f) && (cfg->method != JCAL_CENTER_LS);
}

/// What became of the oldest pair in the inbox.
typedef enum {
    JCAL_CENTER_NONE,    ///< There is none.
    JCAL_CENTER_WAITS,   ///< It waits for others: no sample yet.
    JCAL_CENTER_SAMPLE,  ///< It completed a sample.
    JCAL_CENTER_SLOW     ///< It completed one, but both sensors turned slower than min_rate_rad_s.
} jcal_center_input_event_t;

/// Takes the oldest pair out of the inbox.
jcal_center_input_event_t jcal_center_input_take(jcal_center_input_t *self, const jcal_center_config_t *cfg,
                                                 jcal_kinematic_t *sample);

#endif /* JCAL_CENTER_INPUT_H */
