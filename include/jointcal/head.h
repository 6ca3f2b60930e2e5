/* SPDX-License-Identifier: MIT */
/// @file
/// What every result begins with, whatever the joint: what is known, what is missing, and what became of the samples.
#ifndef JCAL_HEAD_H
#define JCAL_HEAD_H

#include "jointcal/reject.h"
#include "jointcal/status.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The bound of an axis or a heading of which nothing is known, rad: a right angle, the largest angle between two lines.
#define JCAL_BOUND_UNKNOWN_RAD 1.57079633f

/// The bound of a place of which nothing is known, m.
#define JCAL_BOUND_UNKNOWN_M 10.0f

/// The head of a result.
typedef struct {
    jcal_calibration_t status;
    jcal_engine_t engine;
    jcal_weak_t weak;      ///< The unknown that keeps the status from `ready`, if there is one.
    jcal_hint_t hint;      ///< The motion that would help.
    jcal_reason_t reason;  ///< Why the status is not `ready`.
    uint32_t samples;      ///< Samples taken or rejected; those of `overrun` are not among them.
    uint32_t rejected;     ///< Samples rejected, all causes.
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    uint32_t overrun;  ///< Samples that found the inbox full: push returned JCAL_ERR_FULL, and they are lost.
    uint64_t t_us;     ///< Time of the last sample that went into this result, us; 0 before any.
} jcal_head_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HEAD_H */
