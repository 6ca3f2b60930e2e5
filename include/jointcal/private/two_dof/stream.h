/* SPDX-License-Identifier: MIT */
/// @file
/// State of the stream engine of the joint with two axes. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_TWO_DOF_STREAM_H
#define JCAL_PRIVATE_TWO_DOF_STREAM_H

#include "jointcal/orientation.h"
#include "jointcal/private/two_dof/kept.h"
#include "jointcal/private/two_dof/memory.h"
#include "jointcal/private/two_dof/moments.h"
#include "jointcal/private/two_dof/prior.h"
#include "jointcal/private/two_dof/search.h"
#include "jointcal/private/two_dof/verdict.h"
#include "jointcal/private/watch.h"
#include "jointcal/two_dof_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The stream engine. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_two_dof_config_t cfg;
    jcal_orientation_gate_t gate;
    jcal_two_dof_kept_t kept;
    jcal_two_dof_moments_t moments;
    jcal_two_dof_prior_t prior;
    jcal_two_dof_search_t search;
    jcal_two_dof_verdict_t verdict;
    jcal_two_dof_memory_t memory;
    uint64_t t_us;       ///< Time of the last sample in the sums.
    float age_s;         ///< Mean age of what is in the sums.
    float moving_s;      ///< Time in the sums, rest left out.
    uint8_t share;       ///< Items of work per call of step.
    uint8_t item;        ///< Next item of work on the sample last taken.
    uint8_t turn;        ///< Next turn of the cycle of estimate, judgement and search.
    uint8_t misfits;     ///< Judgements in a row that found that the data do not fit.
    float time_s;        ///< Weight of the sample that is being summed, s: its time, less if there is little motion.
    bool odd;            ///< Every other sample, once the status is ready, gets a slice of the search.
    bool recovers;       ///< A sensor has moved since the status was `ready`.
    jcal_watch_t watch;  ///< Of the rotation-based and the orientation-based residual.
} jcal_two_dof_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_STREAM_H */
