/* SPDX-License-Identifier: MIT */
/* Hip and knee for ctypes; jointcal_tools/native_chain.py mirrors these structs. */
#ifndef JCAL_BATCH_CHAIN_H
#define JCAL_BATCH_CHAIN_H

#include "batch_center.h"

/* Numbers per sample in jcal_batch_chain_run's rows: status, reason, weak, hint, the four places (12), their bounds (4), segment_length_m,
   uncertainty_segment_m, status of hip and of knee. */
#define JCAL_BATCH_CHAIN_COLUMNS 24

typedef struct {
    jcal_batch_center_options_t center; /* hinge axes are those of the knee, n_max has no meaning */
    float segment_length_m;
    float segment_tolerance_m;
    float plane_normal[3];
    float plane_tolerance_m;
} jcal_batch_chain_options_t;

typedef struct {
    const uint64_t *t_us;
    const float *values;       /* count x 18: rates and specific forces of sensors 1, 2, 3 */
    const float *orientations; /* count x 12: q1, q2, q3; null without */
    size_t count;
} jcal_batch_chain_input_t;

JCAL_BATCH_EXPORT void jcal_batch_chain_defaults(jcal_batch_chain_options_t *options);
/* A fresh instance over all samples; rows as above, a result after every `every`th sample. JCAL_BATCH_DONE or what was wrong. */
JCAL_BATCH_EXPORT int32_t jcal_batch_chain_run(const jcal_batch_chain_options_t *options,
                                               const jcal_batch_chain_input_t *in, uint32_t every, float *rows);

#endif /* JCAL_BATCH_CHAIN_H */
