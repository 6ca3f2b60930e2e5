/* SPDX-License-Identifier: MIT */
/// @file
/// Which two sensors sit on each other's segment. Private.
///
/// Where it is told of two joints of one kind that they are none, the upper sensor of one is looked at beside the lower sensor of the other, by the
/// estimator of the lag in its turns, and then the other way round: if both pairs move as one joint each, the two joints have exchanged a sensor. Which one say their
/// neighbours: the lower ones if the joint below is none either, or if both neighbours are fine, which a limb's end is; the upper ones if the
/// joint above is none; else nothing is told.
#ifndef JCAL_BODY_EXCHANGE_H
#define JCAL_BODY_EXCHANGE_H

#include "jointcal/body.h"

/// Looks at which a joint that is told to be none must not seem so before it is believed again: a minute.
#define JCAL_BODY_AGAINST_MOST 240u

/// The next two sensors to be looked at: the upper one of `joint` and `other`. False if there are none.
bool jcal_body_exchange_next(jcal_body_t *self, unsigned *joint, unsigned *other);

/// The upper sensor of a joint and `other` belong together: an exchange is told.
void jcal_body_exchange_found(jcal_body_t *self, unsigned joint, unsigned other);

/// True if a joint is not to be believed because one that shares a sensor with it is told to be none, and no exchange explains that: the sensor
/// that they share may be the one that sits elsewhere.
bool jcal_body_exchange_doubts(const jcal_body_t *self, unsigned joint);

/// True if an exchange was told that explains why a joint is none, and still does.
bool jcal_body_exchange_explains(const jcal_body_t *self, unsigned joint);

#endif /* JCAL_BODY_EXCHANGE_H */
