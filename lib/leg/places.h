/* SPDX-License-Identifier: MIT */
/// @file
/// The four vectors of hip and knee with their bounds, and what a known length of the thigh makes of two of them. Private.
///
/// Skin that goes along with the thigh, by a share that no IMU can see, multiplies both vectors on the thigh by one factor. With the length
/// L known both are multiplied by f = L / |hip_to_thigh - knee_to_thigh|. Instead of the skin's share of the lever (ball/bounds.h) 5 % of it
/// remain in the bound, for what is not common to both.
///
/// The rest of a bound is scaled along. Errors along the thigh, e_h and e_k, also make f wrong: with s = |r_h| / (|r_h| + |r_k|) both
/// vectors are left with the same (1 - s) e_h + s e_k, since their difference is right. So neither bound is less than that of both rests.
#ifndef JCAL_LEG_PLACES_H
#define JCAL_LEG_PLACES_H

#include "jointcal/ball.h"
#include "jointcal/private/leg/stream.h"

/// Places, by jcal_chain_place_t.
typedef struct {
    jcal_vec3_t at_m[JCAL_CHAIN_PLACES];
    float bound_m[JCAL_CHAIN_PLACES];  ///< JCAL_BOUND_UNKNOWN_M if unknown.
    float skin_m[JCAL_CHAIN_PLACES];   ///< The part of the bound that no motion makes smaller.
    bool known[JCAL_CHAIN_PLACES];
    float length_m;        ///< Distance of hip and knee, m; 0 if one has no estimate.
    float length_bound_m;  ///< 95 % bound.
    float factor;          ///< 1: not scaled.
    bool length_refused;   ///< The known length is too far from what was found.
    bool length_possible;  ///< It is within the bound of what was found all the same.
} jcal_leg_places_t;

/// Places from the results of both joints. Cost: 150 multiply-adds, two square roots.
void jcal_leg_places(const jcal_leg_t *self, const jcal_ball_result_t joints[2], jcal_leg_places_t *out);

/// Fetches both results, and the places.
void jcal_leg_places_now(const jcal_leg_t *self, jcal_ball_result_t joints[2], jcal_leg_places_t *out);

#endif /* JCAL_LEG_PLACES_H */
