/* SPDX-License-Identifier: MIT */
/// @file
/// Sources of orientations that fail for ever, and what both engines of the 2-DoF joint must say of them.
#ifndef JCAL_TEST_TWO_DOF_FAULTS_H
#define JCAL_TEST_TWO_DOF_FAULTS_H

#include "jointcal/two_dof.h"
#include "unit/two_dof/motion.h"

#include <unity.h>

/// What a source of orientations may do for ever: what is not a number, no length, the same value, a clock that stands far back, holes.
enum { POSE_FAULT_NAN, POSE_FAULT_LENGTH, POSE_FAULT_FROZEN, POSE_FAULT_CLOCK, POSE_FAULT_GAPS, POSE_FAULTS };

/// The k-th pair after `last` of a source that fails so.
static inline jcal_orientation_pair_t failed(int fault, const sim_t *sim, uint32_t last, uint32_t k)
{
    jcal_orientation_pair_t pair = sample_of(sim, (fault == POSE_FAULT_GAPS) ? (last + (40u * k)) : (last + k));
    switch (fault) {
    case POSE_FAULT_NAN:
        pair.q2.w = NAN;
        break;
    case POSE_FAULT_LENGTH:
        pair.q1 = (jcal_quat_t){0.0f, 0.0f, 0.0f, 0.0f};
        break;
    case POSE_FAULT_FROZEN:
        pair.q1 = sample_of(sim, last).q1;
        break;
    case POSE_FAULT_CLOCK:
        pair.t_us = 1u;
        break;
    default:
        break;
    }
    return pair;
}

/// An engine that is ready after `last`.
typedef struct {
    jcal_status_t (*take)(const jcal_orientation_pair_t *pair);
    jcal_two_dof_result_t (*result)(void);
    uint32_t last;
} two_dof_subject_t;

/// For 2 s the source fails; then the engine must say so.
static inline void two_dof_fault_is_complained_of(const two_dof_subject_t *subject, const sim_t *sim, int fault)
{
    TEST_ASSERT_EQUAL_INT(JCAL_READY, subject->result().head.status);
    for (uint32_t k = 1; k <= 2u * RATE_HZ; ++k) {
        const jcal_orientation_pair_t pair = failed(fault, sim, subject->last, k);
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, subject->take(&pair));
    }
    const jcal_two_dof_result_t r = subject->result();
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT((fault == POSE_FAULT_GAPS) ? JCAL_REASON_RATE_TOO_LOW : JCAL_REASON_BAD_SAMPLES,
                          r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
    TEST_ASSERT_NOT_EQUAL_INT(JCAL_WEAK_NONE, r.head.weak);
}

#endif /* JCAL_TEST_TWO_DOF_FAULTS_H */
