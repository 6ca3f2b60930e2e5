/* SPDX-License-Identifier: MIT */
/* A flat face for ctypes; jointcal_tools/native.py mirrors these structs. */
#ifndef JCAL_BATCH_H
#define JCAL_BATCH_H

#include "jointcal/jointcal.h"

#if defined(__GNUC__)
#define JCAL_BATCH_EXPORT __attribute__((visibility("default")))
#else
#define JCAL_BATCH_EXPORT
#endif

/* Numbers per sample in jcal_batch_output_t.rows, in this order: status, reason, weak, hint, axis1 (3), axis2 (3),
   uncertainty1_rad, uncertainty2_rad, sign_margin, paper_accepted, progress_axis1, progress_axis2, progress_sign. */
#define JCAL_BATCH_COLUMNS 17

enum { JCAL_BATCH_DONE = 0, JCAL_BATCH_CONFIG = -1, JCAL_BATCH_MEMORY = -2 };

/* Those fields of both configs that measurements turn; jcal_batch_defaults() fills in the library's. */
typedef struct {
    int32_t engine;
    int32_t sign_hint;
    float max_bound_rad;
    float gyr_noise_rad_s;
    float acc_noise_m_s2;
    float lever_arm_m;
    float rate_mismatch;
    float gyr_bias_rad_s;
    float acc_bias_m_s2;
    float slices_per_s;
    int32_t n_max;
    int32_t half_window;
    int32_t acc_min;
    int32_t accept_count;
    uint32_t seed;
    float w0;
    float energy_max_rad2_s2;
    float accept_bound_rad;
    float solve_period_s;
} jcal_batch_options_t;

typedef struct {
    const uint64_t *t_us;
    const float *values; /* count x 12: gyr1, acc1, gyr2, acc2 */
    size_t count;
} jcal_batch_input_t;

/* Sample k. */
static inline jcal_pair_t jcal_batch_pair(const jcal_batch_input_t *in, size_t k)
{
    const float *const v = in->values + 12u * k;
    const jcal_pair_t pair = {
        .t_us = in->t_us[k],
        .imu1 = {.gyr_rad_s = {v[0], v[1], v[2]}, .acc_m_s2 = {v[3], v[4], v[5]}},
        .imu2 = {.gyr_rad_s = {v[6], v[7], v[8]}, .acc_m_s2 = {v[9], v[10], v[11]}},
    };
    return pair;
}

typedef struct {
    float *rows;           /* count x JCAL_BATCH_COLUMNS, the result after each sample */
    uint32_t *rejected_by; /* JCAL_REJECT_COUNT */
    uint32_t *gyr_ids;     /* window engine: room for n_max numbers of samples selected at the end */
    uint32_t *acc_ids;
    size_t gyr_count; /* how many they are */
    size_t acc_count;
} jcal_batch_output_t;

JCAL_BATCH_EXPORT void jcal_batch_defaults(jcal_batch_options_t *options);
/* So that the two sides of ctypes notice when they differ. */
JCAL_BATCH_EXPORT size_t jcal_batch_options_size(void);
/* Name of the first field out of its range, or null. */
JCAL_BATCH_EXPORT const char *jcal_batch_check(const jcal_batch_options_t *options);
/* A fresh instance over all samples. JCAL_BATCH_DONE or what was wrong. */
JCAL_BATCH_EXPORT int32_t jcal_batch_run(const jcal_batch_options_t *options, const jcal_batch_input_t *in,
                                         jcal_batch_output_t *out);
JCAL_BATCH_EXPORT const char *jcal_batch_version(void);
/* Name of a jcal_reason_t; null for none. */
JCAL_BATCH_EXPORT const char *jcal_batch_reason(int32_t reason);

#endif /* JCAL_BATCH_H */
