/* SPDX-License-Identifier: MIT */
/* The health of one sensor over arrays. */
#ifndef JCAL_BATCH_HEALTH_H
#define JCAL_BATCH_HEALTH_H

#include "batch.h"

#include "jointcal/health.h"

/* rate_hz, gaps, rest_s, rms_rad_s, motion_s, scale_bound, fast_share, dead, clipped, way_known, way_of_gyr, columns and signs of the way. */
#define JCAL_BATCH_HEALTH_NUMBERS 17

typedef struct {
    int32_t state[JCAL_FINDING_COUNT];
    float fact[JCAL_FINDING_COUNT];
    float numbers[JCAL_BATCH_HEALTH_NUMBERS];
    float score[JCAL_HEALTH_WAYS]; /* sums of what ways leave open */
    float trials, fits;
    float scale, deviation;
} jcal_batch_health_out_t;

/* What is said after the last of `count` readings; values: count x 6, rate, specific force. */
JCAL_BATCH_EXPORT int32_t jcal_batch_health(const uint64_t *t_us, const float *values, size_t count,
                                            jcal_batch_health_out_t *out);

#endif /* JCAL_BATCH_HEALTH_H */
