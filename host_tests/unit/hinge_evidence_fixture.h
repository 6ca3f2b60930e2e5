/* SPDX-License-Identifier: MIT */
/// @file
/// Sums at a fixed point a little beside the truth, over samples at uneven steps.
#ifndef HINGE_EVIDENCE_FIXTURE_H
#define HINGE_EVIDENCE_FIXTURE_H

#include "hinge_double.h"
#include "hinge_motion.h"
#include "jointcal/vec3.h"
#include "unity.h"

#include <string.h>

enum { SAMPLES = 900 };

#define UNIT_RAD_S 0.02f
#define ACC_CONSTANT_M_S2 0.3f

static jcal_hinge_evidence_t evidence;
static jcal_hinge_point_t point;
static jcal_hinge_sample_t samples[SAMPLES];
static double times_s[SAMPLES];

static inline jcal_hinge_sample_t sample_of(const jcal_pair_t *pair, float dt_s, uint32_t k)
{
    jcal_hinge_sample_t s;
    s.w1 = pair->imu1.gyr_rad_s;
    s.w2 = pair->imu2.gyr_rad_s;
    s.a1 = pair->imu1.acc_m_s2;
    s.a2 = pair->imu2.acc_m_s2;
    s.w1_2 = jcal_vec3_dot(s.w1, s.w1);
    s.w2_2 = jcal_vec3_dot(s.w2, s.w2);
    s.dt_s = dt_s;
    s.gyr_weight = 100.0f + (float)(k % 7u);
    s.acc_weight = 0.1f + (0.02f * (float)(k % 5u));
    return s;
}

void setUp(void)
{
    motion_t motion = motion_lively(3);
    motion.rate_hz = 100.0;
    motion.gyr_noise_rad_s = 0.03;
    memset(&evidence, 0, sizeof evidence);
    memset(&point, 0, sizeof point);
    jcal_rng_t rng = {4};
    /* A little beside the truth, so that residuals have a mean too. */
    point.axis1.bias = jcal_vec3_scale(jcal_rng_unit(&rng), 0.05f);
    point.axis2.bias = jcal_vec3_scale(jcal_rng_unit(&rng), 0.05f);
    jcal_hinge_axis_set(&point.axis1, jcal_vec3_normalise(jcal_vec3_add(motion_axis(&motion, 0),
                                                                        jcal_vec3_scale(jcal_rng_unit(&rng), 0.1f))));
    jcal_hinge_axis_set(&point.axis2, jcal_vec3_normalise(jcal_vec3_add(motion_axis(&motion, 1),
                                                                        jcal_vec3_scale(jcal_rng_unit(&rng), 0.1f))));
    evidence.before_s = 1.0f;
    double t = 0.0;
    for (uint32_t k = 0; k < SAMPLES; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        /* Uneven steps: no block then ends on a tie of rounding. */
        const float dt = 0.01f + (0.0013f * jcal_rng_symmetric(&rng));
        samples[k] = sample_of(&pair, dt, k);
        t += (double)dt;
        times_s[k] = t;
    }
}

void tearDown(void)
{
}

static inline void add_all(uint32_t count)
{
    for (uint32_t k = 0; k < count; ++k) {
        jcal_hinge_evidence_watch(&evidence, &samples[k]);
        jcal_hinge_evidence_add(&evidence, &point, ACC_CONSTANT_M_S2, UNIT_RAD_S, &samples[k]);
    }
}

#endif /* HINGE_EVIDENCE_FIXTURE_H */
