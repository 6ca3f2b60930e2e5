/* SPDX-License-Identifier: MIT */
/* A hub: packets of two senders -> readings with hub times -> pairs, the lag between them -> a hinge of either kind. */
#ifndef JCAL_BATCH_HUB_H
#define JCAL_BATCH_HUB_H

#include "batch.h"

#include "jointcal/hinge_auto.h"
#include "jointcal/packet.h"
#include "jointcal/pairing.h"

/* Numbers per pair: status, ready_for, model, axis1 (3), axis2 (3), uncertainty1_rad, uncertainty2_rad, flexion_uncertainty_rad, lag_known,
   lag_s, bound_s, taken_s. */
#define JCAL_BATCH_HUB_COLUMNS 16

/* Raw values are those of an LSM6DSV at 2000 deg/s and 16 g. */
typedef struct {
    uint32_t period_ns;
    int32_t counter_bits;
    int32_t per_packet;
    int32_t is_raw;
    float max_delay_s;
    const float *si;    /* readings x 6, or ... */
    const int16_t *raw; /* ... these */
} jcal_batch_sender_t;

/* Packets in the order of arrival. */
typedef struct {
    jcal_batch_sender_t sender[2];
    const uint8_t *which; /* 0 or 1 */
    const uint64_t *arrival_us;
    const uint32_t *counter;
    const uint8_t *readings;
    const uint32_t *at; /* row of the sender's first reading */
    size_t count;
} jcal_batch_hub_in_t;

typedef struct {
    uint64_t *t_us; /* room */
    float *values;  /* room x 6 */
    size_t room;
    size_t count;
} jcal_batch_hub_readings_t;

typedef struct {
    jcal_batch_hub_readings_t readings[2]; /* as they came out of the packets */
    uint64_t *pair_us;                     /* room */
    float *rows;                           /* room x JCAL_BATCH_HUB_COLUMNS: what is known after each pair */
    size_t room;
    size_t pair_count;
    uint32_t taken; /* times that a lag was taken off */
    jcal_packets_status_t packets[2];
    jcal_pairing_result_t pairing;
} jcal_batch_hub_out_t;

/* The hinge gets pairs from the first time on that the lag is known, and begins anew when more than 20 ms are taken off. */
JCAL_BATCH_EXPORT int32_t jcal_batch_hub(const jcal_batch_hub_in_t *in, jcal_batch_hub_out_t *out);

#endif /* JCAL_BATCH_HUB_H */
