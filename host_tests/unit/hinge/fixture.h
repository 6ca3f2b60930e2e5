/* SPDX-License-Identifier: MIT */
/// @file
/// One stream engine, and what its tests share.
#ifndef HINGE_FIXTURE_H
#define HINGE_FIXTURE_H

#include "jointcal/hinge.h"

#include "unit/hinge/motion.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Samples of a run of 20 s at 50 Hz: well beyond the time to ready, 4 s in the median. */
enum { RUN = 1000 };

static jcal_hinge_config_t config;
static jcal_hinge_t engine;

void setUp(void)
{
    config = jcal_hinge_config_default();
    memset(&engine, 0x5a, sizeof engine); /* whatever self held before init is lost */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
}

void tearDown(void)
{
}

static inline jcal_hinge_result_t result_of(const jcal_hinge_t *self)
{
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_get(self, &result));
    return result;
}

/* No field that a reader would show is ever NaN, infinite or out of its range. */
static inline void assert_sane(const jcal_hinge_result_t *r)
{
    const bool sane = jcal_vec3_is_finite(r->axis1) && jcal_vec3_is_finite(r->axis2) && isfinite(r->sign_margin) &&
                      (r->sign_margin >= 0.0f) && (r->uncertainty1_rad >= 0.0f) &&
                      (r->uncertainty1_rad <= JCAL_BOUND_UNKNOWN_RAD) && (r->uncertainty2_rad >= 0.0f) &&
                      (r->uncertainty2_rad <= JCAL_BOUND_UNKNOWN_RAD) && (r->progress_axis1 >= 0.0f) &&
                      (r->progress_axis1 <= 1.0f) && (r->progress_axis2 >= 0.0f) && (r->progress_axis2 <= 1.0f) &&
                      (r->progress_sign >= 0.0f) && (r->progress_sign <= 1.0f);
    TEST_ASSERT_TRUE(sane);
    TEST_ASSERT_TRUE((r->head.status == JCAL_READY) == (r->head.reason == JCAL_REASON_NONE));
}

static inline void run(jcal_hinge_t *self, const motion_t *motion, uint32_t begin, uint32_t end)
{
    for (uint32_t k = begin; k < end; ++k) {
        const jcal_pair_t pair = motion_sample(motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(self, &pair));
    }
}

/* What a user sees, bit for bit; padding does not count. */
static inline void assert_same_result(const jcal_hinge_t *a, const jcal_hinge_t *b)
{
    const jcal_hinge_result_t x = result_of(a);
    const jcal_hinge_result_t y = result_of(b);
    TEST_ASSERT_EQUAL_MEMORY(&x.axis1, &y.axis1, sizeof x.axis1);
    TEST_ASSERT_EQUAL_MEMORY(&x.axis2, &y.axis2, sizeof x.axis2);
    TEST_ASSERT_EQUAL_MEMORY(&x.uncertainty1_rad, &y.uncertainty1_rad, sizeof x.uncertainty1_rad);
    TEST_ASSERT_EQUAL_MEMORY(&x.uncertainty2_rad, &y.uncertainty2_rad, sizeof x.uncertainty2_rad);
    TEST_ASSERT_EQUAL_MEMORY(&x.sign_margin, &y.sign_margin, sizeof x.sign_margin);
    TEST_ASSERT_EQUAL_MEMORY(&x.progress_sign, &y.progress_sign, sizeof x.progress_sign);
    TEST_ASSERT_EQUAL_INT(x.head.status, y.head.status);
    TEST_ASSERT_EQUAL_INT(x.head.reason, y.head.reason);
    TEST_ASSERT_EQUAL_INT(x.head.weak, y.head.weak);
    TEST_ASSERT_EQUAL_INT(x.head.hint, y.head.hint);
    TEST_ASSERT_EQUAL_INT(x.has_axes, y.has_axes);
    TEST_ASSERT_EQUAL_UINT32(x.head.samples, y.head.samples);
    TEST_ASSERT_EQUAL_UINT32(x.head.rejected, y.head.rejected);
}

/* And all sums behind it, so that the future is the same too. */
static inline void assert_same_state(const jcal_hinge_t *a, const jcal_hinge_t *b)
{
    assert_same_result(a, b);
    TEST_ASSERT_EQUAL_MEMORY(&a->coarse.moments, &b->coarse.moments, sizeof a->coarse.moments);
    TEST_ASSERT_EQUAL_MEMORY(&a->coarse.point, &b->coarse.point, sizeof a->coarse.point);
    TEST_ASSERT_EQUAL_MEMORY(&a->refine, &b->refine, offsetof(jcal_hinge_refine_t, has_last)); /* then padding */
    TEST_ASSERT_EQUAL_INT(a->refine.has_last, b->refine.has_last);
    TEST_ASSERT_EQUAL_MEMORY(&a->search.probe, &b->search.probe, sizeof a->search.probe);
}

#endif /* HINGE_FIXTURE_H */
