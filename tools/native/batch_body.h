/* SPDX-License-Identifier: MIT */
/* A body of hinges over arrays of packets: one bounded step every hundredth of a second. */
#ifndef JCAL_BATCH_BODY_H
#define JCAL_BATCH_BODY_H

#include "batch.h"

#include "jointcal/body.h"

#define JCAL_BATCH_BODY_SENSORS 16
#define JCAL_BATCH_BODY_JOINTS 15
/* Numbers per joint and row: status, reason, for_axes, lag_known, lag_s, lag_bound_s, axis1 (3), axis2 (3), uncertainty1_rad,
   uncertainty2_rad, flexion_rad, flexion_bound_rad, has_kept, kept, kept_reason. */
#define JCAL_BATCH_BODY_COLUMNS 19
/* Numbers per event: kind, joint, sensor, what, value. */
#define JCAL_BATCH_EVENT_COLUMNS 5
/* Bytes of each of the two slots of a flash. */
#define JCAL_BATCH_SLOT_BYTES 4096

/* Packets in the order of arrival; `at` is the row of the sensor's first reading, `si` a pointer to each sensor's readings x 6. */
typedef struct {
    int32_t sensor_count;
    int32_t joint_count;
    const uint8_t *proximal;
    const uint8_t *distal;
    const float *si[JCAL_BATCH_BODY_SENSORS];
    const uint8_t *which;
    const uint64_t *arrival_us;
    const uint32_t *counter;
    const uint8_t *readings;
    const uint32_t *at;
    size_t count;
    int32_t counter_bits;
    int32_t units;           /* of each step */
    int32_t every;           /* steps from row to row */
    const uint64_t *serials; /* of each sensor; null: none is known */
    uint8_t *flash;          /* two slots, which outlast a run; null: nothing is kept */
    int32_t keeps;           /* at the end all that is ready is written */
    int32_t mark;            /* step at which units are noted; 0: never */
    int32_t sleeps;          /* from that step on whatever is ready is put to sleep */
} jcal_batch_body_in_t;

typedef struct {
    uint64_t *row_us;  /* room */
    float *rows;       /* room x joints x JCAL_BATCH_BODY_COLUMNS */
    uint64_t *time_us; /* room: hub time of the round at each row */
    size_t room;
    size_t row_count;
    uint64_t *event_us; /* event_room */
    float *events;      /* event_room x JCAL_BATCH_EVENT_COLUMNS */
    size_t event_room;
    size_t event_count;
    uint32_t most_units; /* of a step */
    uint32_t full_steps; /* steps that may have left something */
    uint32_t steps;
    uint32_t state_bytes; /* here, of everything but packets that wait */
    uint64_t mark_units;  /* until step `mark` */
    jcal_body_status_t status;
    jcal_body_sensor_result_t sensors[JCAL_BATCH_BODY_SENSORS];
} jcal_batch_body_out_t;

JCAL_BATCH_EXPORT int32_t jcal_batch_body(const jcal_batch_body_in_t *in, jcal_batch_body_out_t *out);

#endif /* JCAL_BATCH_BODY_H */
