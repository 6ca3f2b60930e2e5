/* SPDX-License-Identifier: MIT */
/// @file
/// What is summed at the running estimate, sample by sample: how its gradient scatters, how well it fits, which sign
/// pairing the data prefer. Private. The moments know nothing of an estimate; these sums do, and begin anew when it
/// moves far.
#ifndef JCAL_HINGE_EVIDENCE_H
#define JCAL_HINGE_EVIDENCE_H

#include "jointcal/hinge.h"

/// One sample with what both kinds of sums need of it.
typedef struct {
    jcal_vec3_t w1, w2;  ///< Rates, rad/s.
    jcal_vec3_t a1, a2;  ///< Specific forces, m/s^2.
    float w1_2, w2_2;    ///< |w1|^2, |w2|^2.
    float dt_s;          ///< Time that the sample stands for.
    float gyr_weight;    ///< Weight of the squared form of (24), integrated over dt.
    float acc_weight;    ///< Weight of (25), integrated over dt.
} jcal_hinge_sample_t;

/// Duration that counts as one independent reading: sets the unit of the cost, s.
#define JCAL_HINGE_UNIT_S 0.05f

/// Sums that need no estimate: excitation and information.
void jcal_hinge_evidence_watch(jcal_hinge_evidence_t *self, const jcal_hinge_sample_t *sample);

/// Sums at the estimate. `gyr_bias_rad_s` is the unit of the bias unknowns.
void jcal_hinge_evidence_add(jcal_hinge_evidence_t *self, const jcal_hinge_point_t *point, float acc_constant_m_s2,
                             float gyr_bias_rad_s, const jcal_hinge_sample_t *sample);

/// Begins anew what was summed too far from the estimate; `all` begins everything anew that depends on the estimate.
void jcal_hinge_evidence_follow(jcal_hinge_evidence_t *self, const jcal_hinge_point_t *point, bool all);

/// Halves all sums, together with the moments, so that nothing ever grows without bound.
void jcal_hinge_evidence_halve(jcal_hinge_evidence_t *self);

#endif /* JCAL_HINGE_EVIDENCE_H */
