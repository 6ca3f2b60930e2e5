/* SPDX-License-Identifier: MIT */
/// @file
/// State of the functional joint. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_FUNCTIONAL_STREAM_H
#define JCAL_PRIVATE_FUNCTIONAL_STREAM_H

#include "jointcal/functional_config.h"
#include "jointcal/private/functional/point.h"
#include "jointcal/private/functional/sums.h"
#include "jointcal/private/functional/verdict.h"
#include "jointcal/private/levers/ticks.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Other headings that are tried.
typedef struct {
    jcal_functional_point_t trial;  ///< The one on its way; between trials, the other pairing.
    uint8_t turn;                   ///< Number of the heading, and of the axes that it begins with.
    uint8_t tried;                  ///< How many were tried, at most 255.
    bool has_estimate;              ///< One was taken.
} jcal_functional_search_t;

/// The heading of this moment, for the angle.
typedef struct {
    jcal_plane_t sum;             ///< What the last seconds say, fading.
    jcal_plane_t heading;         ///< L2 to L1.
    float recent[JCAL_FAMILIES];  ///< Squared residuals of the last 1.5 s of motion beside their usual sizes.
    uint8_t zero[2];              ///< The axis of each sensor that the angle's zero is taken from.
    bool known;
} jcal_functional_track_t;

/// The functional joint. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_functional_config_t cfg;
    jcal_functional_sums_t sums;
    jcal_functional_point_t point;  ///< The estimate.
    jcal_functional_search_t search;
    jcal_functional_verdict_t verdict;
    jcal_functional_track_t track;
    jcal_tick_pair_t ticks;
    float motion_s;  ///< Motion since the beginning, s.
    float since_s;   ///< Time since the last judgement began, s.
    float credit;    ///< Slices that are paid for.
    uint8_t slice;   ///< Next slice of the judgement.
    int8_t kept_sign[2];
    bool merged;   ///< A block was merged: headings cannot be begun anew any more.
    bool cut;      ///< Features began anew, and no judgement has begun since.
    bool asleep;   ///< Nothing is learnt: the heading is followed, and slips are watched for.
    bool adopted;  ///< The estimate was handed over, and is not of the sums.
} jcal_functional_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_FUNCTIONAL_STREAM_H */
