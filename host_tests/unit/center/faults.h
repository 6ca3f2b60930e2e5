/* SPDX-License-Identifier: MIT */
/// @file
/// Sources of readings and orientations that fail for ever, and what both engines of the joint centre must say of them.
#ifndef JCAL_TEST_CENTER_FAULTS_H
#define JCAL_TEST_CENTER_FAULTS_H

#include "jointcal/center.h"
#include "unit/center/motion.h"

#include <unity.h>

/// What a source may do for ever: orientations that are no number, of no length, or the same; readings that are; a clock far back.
enum { FAULT_NAN1, FAULT_NAN2, FAULT_LENGTH, FAULT_FROZEN1, FAULT_FROZEN2, FAULT_READINGS, FAULT_CLOCK, FAULTS };

/// Makes a sample one of a source that fails so since `last`.
static inline void center_failed(int fault, uint32_t last, const center_motion_t *m, jcal_pair_t *pair,
                                 jcal_attitudes_t *attitudes)
{
    const jcal_attitudes_t before = center_attitudes(m, last, 0.5);
    switch (fault) {
    case FAULT_NAN1:
        attitudes->q1.y = NAN;
        break;
    case FAULT_NAN2:
        attitudes->q2.w = NAN;
        break;
    case FAULT_LENGTH:
        attitudes->q2 = (jcal_quat_t){0.0f, 0.0f, 0.0f, 0.0f};
        break;
    case FAULT_FROZEN1:
        attitudes->q1 = before.q1;
        break;
    case FAULT_FROZEN2:
        attitudes->q2 = before.q2;
        break;
    case FAULT_READINGS:
        pair->imu2 = center_sample(m, last).imu2;
        break;
    default:
        pair->t_us = 1u;
        break;
    }
}

/// An engine that is told orientations.
typedef struct {
    void (*begin)(void);
    void (*take)(const jcal_pair_t *pair, const jcal_attitudes_t *attitudes);
    jcal_center_result_t (*result)(void);
    double ready_s;  ///< It is ready by then.
    int faults;      ///< How many of the list are tried.
} center_subject_t;

static inline void center_after_faults_it_is_not_ready(const center_subject_t *subject)
{
    const center_motion_t m = center_lively(1);
    const uint32_t last = (uint32_t)(subject->ready_s * m.rate_hz), more = (uint32_t)(2.0 * m.rate_hz);
    for (int fault = 0; fault < subject->faults; ++fault) {
        subject->begin();
        for (uint32_t k = 0; k <= (last + more); ++k) {
            jcal_pair_t pair = center_sample(&m, k);
            jcal_attitudes_t attitudes = center_attitudes(&m, k, 0.5);
            if (k > last) {
                center_failed(fault, last, &m, &pair, &attitudes);
            }
            subject->take(&pair, &attitudes);
            if (k == last) {
                TEST_ASSERT_EQUAL_INT(JCAL_READY, subject->result().head.status);
            }
        }
        const jcal_center_result_t r = subject->result();
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, r.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_WEAK_NONE, r.head.weak);
    }
}

#endif /* JCAL_TEST_CENTER_FAULTS_H */
