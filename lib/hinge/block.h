/* SPDX-License-Identifier: MIT */
/// @file
/// One block of the refined axes: residual and derivatives of each sample, with the phase as one more unknown. Private.
/// Equations: hinge/refine.h.
#ifndef JCAL_HINGE_BLOCK_H
#define JCAL_HINGE_BLOCK_H

#include "hinge/refine.h"

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
