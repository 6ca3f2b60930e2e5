/* SPDX-License-Identifier: MIT */
/* The 2-DoF joint for ctypes; jointcal_tools/native_two_dof.py mirrors these structs. */
#ifndef JCAL_BATCH_TWO_DOF_H
#define JCAL_BATCH_TWO_DOF_H

#include "batch.h"

/* Numbers per sample in jcal_batch_two_dof_run's rows: status, reason, weak, hint, axis1 (3), axis2 (3), heading_offset_rad,
   carrying_angle_rad, uncertainty1_rad, uncertainty2_rad, uncertainty_heading_rad. */
#define JCAL_BATCH_TWO_DOF_COLUMNS 15

typedef struct {
    int32_t constraint;
    float max_bound_rad;
    float mismatch_rad;
    float memory_s;
} jcal_batch_two_dof_options_t;

typedef struct {
    const uint64_t *t_us;
    const float *values; /* count x 8: q1, q2 */
    size_t count;
} jcal_batch_orientations_t;

typedef struct {
    float *rows;           /* count x JCAL_BATCH_TWO_DOF_COLUMNS */
    uint32_t *rejected_by; /* JCAL_REJECT_COUNT */
    uint64_t *kept_us;     /* n_max times: the buffer at the end, oldest first; kept_count of them */
    uint64_t kept_count;
} jcal_batch_two_dof_window_out_t;

JCAL_BATCH_EXPORT void jcal_batch_two_dof_defaults(jcal_batch_two_dof_options_t *options);
/* A fresh stream engine over all samples; rows as above, rejected_by JCAL_REJECT_COUNT. JCAL_BATCH_DONE or what was wrong. */
JCAL_BATCH_EXPORT int32_t jcal_batch_two_dof_run(const jcal_batch_two_dof_options_t *options,
                                                 const jcal_batch_orientations_t *in, float *rows,
                                                 uint32_t *rejected_by);
/* The same with a fresh window engine of n_max samples; memory_s has no meaning. */
JCAL_BATCH_EXPORT int32_t jcal_batch_two_dof_window_run(const jcal_batch_two_dof_options_t *options, uint32_t n_max,
                                                        const jcal_batch_orientations_t *in,
                                                        jcal_batch_two_dof_window_out_t *out);
/* Orientations (count x 4) of one sensor by VQF from values (count x 6: rates, specific forces). JCAL_BATCH_CONFIG if this was
   built without VQF. */
JCAL_BATCH_EXPORT int32_t jcal_batch_vqf(const float *values, size_t count, float period_s, float *orientations);

#endif /* JCAL_BATCH_TWO_DOF_H */
