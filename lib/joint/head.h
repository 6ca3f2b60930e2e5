/* SPDX-License-Identifier: MIT */
/// @file
/// Fills in the head of a result. Private.
#ifndef JCAL_JOINT_HEAD_H
#define JCAL_JOINT_HEAD_H

#include "jointcal/head.h"

/// What a gate complains of stands above what was judged: a sensor that fails sends nothing that a judgement would follow, so without
/// this a calibration would stay `ready` for ever. `weakest` is named if the judgement found nothing weak.
static inline void jcal_head_complain(jcal_head_t *head, jcal_reason_t complaint, jcal_weak_t weakest)
{
    if (complaint != JCAL_REASON_NONE) {
        head->status = JCAL_COLLECTING;
        head->reason = complaint;
        head->hint = JCAL_HINT_CHECK_SENSORS;
        head->weak = (head->weak == JCAL_WEAK_NONE) ? weakest : head->weak;
    }
}

/// The counters of a gate; rejected_by (JCAL_REJECT_COUNT).
static inline void jcal_head_count(jcal_head_t *head, uint32_t samples, const uint32_t *rejected_by)
{
    head->samples = samples;
    head->rejected = 0u;
    for (unsigned i = 0u; i < (unsigned)JCAL_REJECT_COUNT; ++i) {
        head->rejected_by[i] = rejected_by[i];
        head->rejected += rejected_by[i];
    }
}

/// 0 to 1: how far a bound is on the way to its limit, both in the same unit.
float jcal_head_progress(float bound, float limit);

#endif /* JCAL_JOINT_HEAD_H */
