/* SPDX-License-Identifier: MIT */
/* The joint centre for ctypes; jointcal_tools/native_center.py mirrors these structs. */
#ifndef JCAL_BATCH_CENTER_H
#define JCAL_BATCH_CENTER_H

#include "batch.h"

/* Numbers per sample in jcal_batch_center_run's rows: status, reason, weak, hint, joint_to_sensor1_m (3), joint_to_sensor2_m (3),
   uncertainty1_m, uncertainty2_m, weakest_direction1 (3), weakest_direction2 (3), uncertainty_weakest1_m, uncertainty_weakest2_m,
   acc_bias1_m_s2 (3), acc_bias2_m_s2 (3), heading_offset_rad, misfit. */
#define JCAL_BATCH_CENTER_COLUMNS 28

typedef struct {
    int32_t method;
    int32_t derivative;
    float smoothing_s;
    float max_bound_m;
    float mismatch_m;
    float rate_mismatch;
    float acc_noise_m_s2;
    float turn_error;
    float acc_bias_m_s2;
    float min_rate_rad_s;
    float memory_s;
    float hinge_axis1[3];
    float hinge_axis2[3];
    int32_t n_max; /* of the window engine; 0: the stream engine */
} jcal_batch_center_options_t;

typedef struct {
    const uint64_t *t_us;
    const float *values;       /* count x 12: rates and specific forces of sensor 1, of sensor 2 */
    const float *orientations; /* count x 8: q1, q2; null without */
    size_t count;
} jcal_batch_center_input_t;

JCAL_BATCH_EXPORT void jcal_batch_center_defaults(jcal_batch_center_options_t *options);
/* The config that these options stand for. Not for Python. */
jcal_center_config_t jcal_batch_center_config(const jcal_batch_center_options_t *options);
/* A fresh engine over all samples; rows as above, rejected_by JCAL_REJECT_COUNT. JCAL_BATCH_DONE or what was wrong. */
JCAL_BATCH_EXPORT int32_t jcal_batch_center_run(const jcal_batch_center_options_t *options,
                                                const jcal_batch_center_input_t *in, float *rows,
                                                uint32_t *rejected_by);

#endif /* JCAL_BATCH_CENTER_H */
