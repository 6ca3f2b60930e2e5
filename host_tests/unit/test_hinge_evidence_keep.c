/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/calib/hinge_evidence.h: what begins anew, what is halved.
#include "hinge_evidence_fixture.h"

static void an_axis_that_moves_far_begins_its_sums_anew_and_the_other_keeps_them(void)
{
    jcal_hinge_evidence_follow(&evidence, &point, true);
    add_all(SAMPLES);
    const jcal_hinge_evidence_t before = evidence;
    const float degrees[3] = {14.0f, 21.0f, 180.0f};
    for (int i = 0; i < 3; ++i) {
        for (int sensor = 0; sensor < 2; ++sensor) {
            jcal_hinge_point_t moved = point;
            jcal_hinge_axis_t *const axis = (sensor == 0) ? &moved.axis1 : &moved.axis2;
            const float rad = degrees[i] * 0.0174532925f;
            jcal_hinge_axis_set(
                axis, jcal_vec3_add(jcal_vec3_scale(axis->j, cosf(rad)), jcal_vec3_scale(axis->u, sinf(rad))));
            evidence = before;
            jcal_hinge_evidence_follow(&evidence, &moved, false);
            const bool far = i > 0;
            const bool anew1 = far && (sensor == 0);
            const bool anew2 = far && (sensor == 1);
            TEST_ASSERT_EQUAL_FLOAT(anew1 ? 0.0f : before.axis1.time_s, evidence.axis1.time_s);
            TEST_ASSERT_EQUAL_FLOAT(anew2 ? 0.0f : before.axis2.time_s, evidence.axis2.time_s);
            TEST_ASSERT_EQUAL_FLOAT(far ? 0.0f : before.fit_time_s, evidence.fit_time_s);
            TEST_ASSERT_EQUAL_FLOAT(far ? 0.0f : before.turn_other, evidence.turn_other);
            TEST_ASSERT_EQUAL_FLOAT(before.axis1.information_all, evidence.axis1.information_all);
            TEST_ASSERT_EQUAL_FLOAT(before.axis2.information_all, evidence.axis2.information_all);
            TEST_ASSERT_EQUAL_FLOAT(before.excitation, evidence.excitation);
        }
    }
}

static void halving_halves_every_sum_over_all_samples(void)
{
    add_all(SAMPLES);
    const jcal_hinge_evidence_t b = evidence;
    jcal_hinge_evidence_halve(&evidence);
    const float before[] = {b.fit_time_s,
                            b.across_error2,
                            b.across_rate2,
                            b.difference2,
                            b.noise_sum,
                            b.noise_weight,
                            b.pair_acc,
                            b.pair_acc2,
                            b.turn_same,
                            b.turn_other,
                            b.turn_time_s,
                            b.excitation,
                            b.axis1.information,
                            b.axis1.information2,
                            b.axis1.information_all,
                            b.axis1.second,
                            b.axis1.fine_second,
                            b.axis1.time_s,
                            b.axis2.scatter[9],
                            b.axis2.fine_scatter[9],
                            b.axis2.scatter[0],
                            b.axis2.fine_scatter[0],
                            b.axis2.information_all};
    const jcal_hinge_evidence_t *const e = &evidence;
    const float after[] = {e->fit_time_s,
                           e->across_error2,
                           e->across_rate2,
                           e->difference2,
                           e->noise_sum,
                           e->noise_weight,
                           e->pair_acc,
                           e->pair_acc2,
                           e->turn_same,
                           e->turn_other,
                           e->turn_time_s,
                           e->excitation,
                           e->axis1.information,
                           e->axis1.information2,
                           e->axis1.information_all,
                           e->axis1.second,
                           e->axis1.fine_second,
                           e->axis1.time_s,
                           e->axis2.scatter[9],
                           e->axis2.fine_scatter[9],
                           e->axis2.scatter[0],
                           e->axis2.fine_scatter[0],
                           e->axis2.information_all};
    for (size_t i = 0; i < sizeof before / sizeof before[0]; ++i) {
        TEST_ASSERT_TRUE(before[i] > 0.0f);
        TEST_ASSERT_EQUAL_FLOAT(0.5f * before[i], after[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_axis_that_moves_far_begins_its_sums_anew_and_the_other_keeps_them);
    RUN_TEST(halving_halves_every_sum_over_all_samples);
    return UNITY_END();
}
