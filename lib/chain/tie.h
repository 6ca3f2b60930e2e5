/* SPDX-License-Identifier: MIT */
/// @file
/// What ties hip and knee together: a Kalman update of both estimates by what they have in common. Private.
///
/// State (18): r1, r2 and the bias of the thigh's accelerometer as the hip sees it, then the bias as the knee sees it, r1 and r2 of
/// the knee; in this order so that what is tied stands together. Each tie is one scalar observation: the components of both biases
/// are equal; the distance of both centres is known; (15b) of [SAL15], 0 = n . (r_HT - r_KT).
#ifndef JCAL_CHAIN_TIE_H
#define JCAL_CHAIN_TIE_H

#include "jointcal/chain_config.h"
#include "jointcal/private/center/stream.h"

#define JCAL_CHAIN_STATES 18u

/// Both joints as one Gaussian.
typedef struct {
    float x[JCAL_CHAIN_STATES];
    float covariance[171];  ///< Packed 18 x 18.
} jcal_chain_state_t;

/// Where the parts of the state begin.
#define JCAL_CHAIN_AT_HIP 0u
#define JCAL_CHAIN_AT_HIP_THIGH 3u
#define JCAL_CHAIN_AT_HIP_BIAS 6u
#define JCAL_CHAIN_AT_KNEE_BIAS 9u
#define JCAL_CHAIN_AT_KNEE_THIGH 12u
#define JCAL_CHAIN_AT_KNEE_SHANK 15u

/// state <- what both joints know, each by itself. Covariances are scaled to the bounds that the joints state. False if a joint has no
/// bound for one of its vectors: there is nothing to tie then.
bool jcal_chain_collect(const jcal_center_t *hip, const jcal_center_t *knee, jcal_chain_state_t *state);

/// Takes in that slope . x is `apart` less than it should be, with a standard deviation. False, and nothing changed, if that contradicts
/// what is known. Cost: 18^2 * 2 multiply-adds.
bool jcal_chain_observe(jcal_chain_state_t *state, const float *slope, float apart, float deviation);

/// All ties that the config has. False if one of them contradicts what is known; it is left out then.
bool jcal_chain_tie(const jcal_chain_config_t *cfg, jcal_chain_state_t *state);

#endif /* JCAL_CHAIN_TIE_H */
