/* SPDX-License-Identifier: MIT */
/// @file
/// Brings all sensors to one common time after the other: readings, samples, ticks. Private.
#ifndef JCAL_BODY_ROUND_H
#define JCAL_BODY_ROUND_H

#include "jointcal/body.h"

/// The hub's time, for this step. One that goes back by more than a second is a clock that began anew.
void jcal_body_round_now(jcal_body_t *self, uint64_t now_us);

/// One piece of a round. Returns the units that it took, JCAL_BODY_UNITS_MIN at most; 0: nothing can be done.
unsigned jcal_body_round_step(jcal_body_t *self);

/// Who has fallen silent; to be asked when there is nothing left to do.
void jcal_body_round_listen(jcal_body_t *self);

#endif /* JCAL_BODY_ROUND_H */
