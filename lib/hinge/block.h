/* SPDX-License-Identifier: MIT */
/// @file
/// One block of the refined axes: residual and derivatives of each sample, with the phase as one more unknown. Private.
/// Equations: hinge/refine.h.
#ifndef JCAL_HINGE_BLOCK_H
#define JCAL_HINGE_BLOCK_H

#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/refine.h"

/// Unknowns: 4 tilts, rad, then 4 biases across the axes, in standard deviations.
#define JCAL_HINGE_UNKNOWNS 8u

/// Duration that counts as one independent reading: sets the unit of the cost, s.
#define JCAL_HINGE_UNIT_S 0.05f

/// One sample with what the sums need of it.
typedef struct {
    jcal_vec3_t w1, w2;  ///< Rates, rad/s.
    jcal_vec3_t a1, a2;  ///< Specific forces, m/s^2.
    float w1_2, w2_2;    ///< |w1|^2, |w2|^2.
    float dt_s;          ///< Time that the sample stands for.
    float gyr_weight;    ///< Weight of (24), integrated over dt.
    float acc_weight;    ///< The same of (25).
    float acc_variance;  ///< Of (25), (m/s^2)^2.
} jcal_hinge_sample_t;

/// The phase stands behind the unknowns; it is eliminated when the block closes.
#define JCAL_HINGE_BLOCK_PHASE JCAL_HINGE_UNKNOWNS
#define JCAL_HINGE_BLOCK_COLUMNS (JCAL_HINGE_BLOCK_PHASE + 1u)

/// Empties a block.
void jcal_hinge_block_begin(jcal_hinge_block_t *block);

/// Adds one sample at the refined axes and biases. `constant_m_s2`: the accelerometers' constant c.
///
/// Cost:     about 250 multiply-adds.
void jcal_hinge_block_add(jcal_hinge_refine_t *self, const jcal_hinge_config_t *cfg, float constant_m_s2,
                          const jcal_hinge_sample_t *sample);

#endif /* JCAL_HINGE_BLOCK_H */
