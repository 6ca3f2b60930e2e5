/* SPDX-License-Identifier: MIT */
/* A remembered hinge over ticks. */
#ifndef JCAL_BATCH_REMEMBER_H
#define JCAL_BATCH_REMEMBER_H

#include "batch_sensor.h"

#include "jointcal/remember.h"

/* axis1 3, axis2 3, bounds 2, lever1 3, lever2 3, has_levers, rigid */
#define JCAL_BATCH_KEPT_COLUMNS 16
/* state, reason, bound1, bound2, motion_s, off1, off2, sigma1, sigma2, lack, speed, evidence, bend */
#define JCAL_BATCH_REMEMBER_COLUMNS 13

typedef struct {
    const uint64_t *t_us;
    const float *ticks1; /* count x JCAL_BATCH_TICK_COLUMNS */
    const float *ticks2;
    const float *kept;
    size_t count;
    int32_t goes_on; /* what was decided is not held to: the next look decides anew */
} jcal_batch_remember_in_t;

/* A fresh one over count pairs of ticks, all slices worked off after each; rows are count x JCAL_BATCH_REMEMBER_COLUMNS. */
JCAL_BATCH_EXPORT int32_t jcal_batch_remember(const jcal_batch_remember_in_t *in, float *rows);

#endif /* JCAL_BATCH_REMEMBER_H */
