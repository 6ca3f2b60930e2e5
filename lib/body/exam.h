/* SPDX-License-Identifier: MIT */
/// @file
/// What is wrong with sensors: one is examined at a time, all are watched for readings that stand still. Private.
#ifndef JCAL_BODY_EXAM_H
#define JCAL_BODY_EXAM_H

#include "jointcal/body.h"

/// Takes in a reading of a sensor, with hub times, if it is the one that is examined.
/// Returns the units that it costs beside those of the reading.
unsigned jcal_body_exam_push(jcal_body_t *self, unsigned sensor, const jcal_reading_t *reading);

/// Watches for readings that are all the same: `since_us` since the one before.
void jcal_body_exam_watch(jcal_body_t *self, unsigned sensor, bool same, uint64_t since_us);

/// Looks at the sensor that is examined, once a second, and goes on to the next when its time is over. False if nothing was due.
bool jcal_body_exam_look(jcal_body_t *self);

#endif /* JCAL_BODY_EXAM_H */
