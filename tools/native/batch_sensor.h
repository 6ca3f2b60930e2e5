/* SPDX-License-Identifier: MIT */
/* The sensor stage over arrays. */
#ifndef JCAL_BATCH_SENSOR_H
#define JCAL_BATCH_SENSOR_H

#include "batch.h"

#include "jointcal/sensor.h"

/* turn 9, rate 9, lever 9, velocity 3, gyr 3, acc_level, dt_s, since_s, epoch */
#define JCAL_BATCH_TICK_COLUMNS 37

typedef struct {
    float *orientations; /* count x 4, after each sample: R of the features */
    float *biases;       /* count x 3, rad/s */
    uint64_t *tick_us;   /* at most count */
    float *ticks;        /* at most count x JCAL_BATCH_TICK_COLUMNS */
    uint64_t tick_count;
} jcal_batch_sensor_out_t;

/* A fresh sensor over count samples; values are count x 6: rates, specific forces. */
JCAL_BATCH_EXPORT int32_t jcal_batch_sensor(const uint64_t *t_us, const float *values, size_t count,
                                            jcal_batch_sensor_out_t *out);

#endif /* JCAL_BATCH_SENSOR_H */
