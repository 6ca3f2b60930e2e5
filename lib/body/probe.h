/* SPDX-License-Identifier: MIT */
/// @file
/// The estimator of a lag goes from joint to joint. Private.
#ifndef JCAL_BODY_PROBE_H
#define JCAL_BODY_PROBE_H

#include "jointcal/body.h"

/// Takes in the ticks of both sensors of the joint that is looked at.
void jcal_body_probe_add(jcal_body_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// A slice of work, and what follows from it; false if nothing was due.
bool jcal_body_probe_step(jcal_body_t *self);

/// Once in a quarter of a second: what is known by now, and whether another joint is to be looked at. False if nothing was due.
bool jcal_body_probe_look(jcal_body_t *self);

#endif /* JCAL_BODY_PROBE_H */
