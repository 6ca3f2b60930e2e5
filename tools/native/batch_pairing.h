/* SPDX-License-Identifier: MIT */
/* The pairing and the estimate of the lag over arrays. */
#ifndef JCAL_BATCH_PAIRING_H
#define JCAL_BATCH_PAIRING_H

#include "batch.h"

#include "jointcal/pairing.h"

/* Rates and specific forces of both sensors. */
#define JCAL_BATCH_PAIR_COLUMNS 12
/* lag_known, lag_s, bound_s, taken_s, left, motion_s */
#define JCAL_BATCH_LAG_COLUMNS 6

typedef struct {
    const uint8_t *which; /* 1 or 2, in the order of arrival */
    const uint64_t *t_us;
    const float *values; /* count x 6: rate, specific force */
    size_t count;
    int32_t with_lag; /* 0: pairs only */
    float period_s;
    float gap_s;
} jcal_batch_pairing_in_t;

typedef struct {
    uint64_t *t_us; /* at most room */
    float *pairs;   /* room x JCAL_BATCH_PAIR_COLUMNS */
    float *lags;    /* room x JCAL_BATCH_LAG_COLUMNS: what is known after each pair */
    size_t room;
    size_t count;
} jcal_batch_pairing_out_t;

/* Fresh sensors; a slice of the lag's work for each pair. */
JCAL_BATCH_EXPORT int32_t jcal_batch_pairing(const jcal_batch_pairing_in_t *in, jcal_batch_pairing_out_t *out);

#endif /* JCAL_BATCH_PAIRING_H */
