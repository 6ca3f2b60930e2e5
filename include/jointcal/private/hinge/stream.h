/* SPDX-License-Identifier: MIT */
/// @file
/// State of the stream engine of the hinge. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_HINGE_STREAM_H
#define JCAL_PRIVATE_HINGE_STREAM_H

#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/coarse.h"
#include "jointcal/private/hinge/refine.h"
#include "jointcal/private/hinge/search.h"
#include "jointcal/private/hinge/smooth.h"
#include "jointcal/private/hinge/verdict.h"
#include "jointcal/private/hinge/weigh.h"
#include "jointcal/private/inbox.h"
#include "jointcal/private/watch.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The stream engine. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_hinge_config_t cfg;
    jcal_gate_t gate;
    jcal_inbox_t inbox;
    jcal_hinge_smooth_t smooth;
    jcal_hinge_coarse_t coarse;
    jcal_hinge_refine_t refine;
    jcal_hinge_search_t search;
    jcal_hinge_verdict_t verdict;
    jcal_watch_t watch;  ///< Of the gyroscopes' residual and the accelerometers'.
    jcal_hinge_weigh_t weigh;
    jcal_hinge_amount_t amount;
    float credit_s;       ///< Time not yet paid for with slices of work.
    uint8_t slice;        ///< Next slice of the cycle.
    int8_t kept_sign[2];  ///< Signs of both axes from the first `ready` on; lib/joint/sign.h.
    bool has_last;
    uint64_t last_us;
} jcal_hinge_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_STREAM_H */
