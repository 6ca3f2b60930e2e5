/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/calib/hinge_judge.h: what keeps or takes away `ready`, one condition at a time.
#include "calib/hinge_judge.h"
#include "calib/hinge_model.h"
#include "calib/hinge_point.h"
#include "calib/hinge_search.h"
#include "hinge_fixture.h"
#include "math/sym.h"

/* An engine that is ready after 20 s of lively motion. */
static void make_ready(void)
{
    const motion_t motion = motion_lively(9);
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).status);
}

static void judge_several_times(void)
{
    for (int k = 0; k < 10; ++k) {
        jcal_hinge_judge(&engine);
    }
}

static void assert_verdict(jcal_calibration_t status, jcal_reason_t reason, jcal_hint_t hint)
{
    judge_several_times();
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(reason, r.reason);
    TEST_ASSERT_EQUAL_INT(status, r.status);
    TEST_ASSERT_EQUAL_INT(hint, r.hint);
}

static void nothing_to_compare_with_is_no_rival(void)
{
    make_ready();
    engine.search.has_rival = false;
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

static void starts_that_were_not_tried_yet_may_hold_a_rival(void)
{
    make_ready();
    engine.search.rounds = 0;
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_OTHER_MINIMUM, JCAL_HINT_MOVE_JOINT);
}

static void set_rival(jcal_vec3_t j1, jcal_vec3_t j2)
{
    engine.search.has_rival = true;
    engine.search.rival = (jcal_hinge_place_t){j1, j2, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
}

static void a_rival_that_costs_hardly_more_makes_the_joint_ambiguous(void)
{
    make_ready();
    /* A hint that agrees with the data, so that the pairing is not asked for below. */
    const bool same = jcal_hinge_main_sign(engine.point.axis1.j) == jcal_hinge_main_sign(engine.point.axis2.j);
    engine.cfg.sign_hint = same ? JCAL_SIGN_SAME : JCAL_SIGN_OPPOSITE;
    set_rival(engine.point.axis1.j, engine.point.axis2.j); /* on the same lines: the bound covers it */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    set_rival(engine.point.axis1.u, engine.point.axis2.u); /* elsewhere, and far worse */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    /* A residual that is the same for all axes raises both costs until their ratio is near 1: it fits |w1|^2 - |w2|^2
       with the weight of the isotropic part of f. */
    const float isotropic[19] = {1.0f,  1.0f,  1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, -1.0f,
                                 -1.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const float cost = jcal_hinge_cost_of_rival(&engine);
    jcal_sym_rank1(engine.moments.gyr, 19u, isotropic, cost);
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_OTHER_MINIMUM, JCAL_HINT_MOVE_JOINT);
}

/* Makes the rates of one sensor, in the sums that show their direction, turn about a line beside the axis; small, so
   that the sums are of no other consequence. */
static void turn_about_a_line_beside(const jcal_hinge_axis_t *axis, size_t first, float degrees)
{
    const float rad = degrees * JCAL_RAD_PER_DEG;
    const jcal_vec3_t line = jcal_vec3_add(jcal_vec3_scale(axis->j, cosf(rad)), jcal_vec3_scale(axis->u, sinf(rad)));
    const float products[6] = {line.x * line.x, line.y * line.y, line.z * line.z,
                               line.x * line.y, line.x * line.z, line.y * line.z};
    for (size_t i = 0; i < 6; ++i) {
        engine.moments.gyr[jcal_sym_at(JCAL_HINGE_Z_ONE, first + i)] = products[i];
    }
}

static void a_segment_that_turns_about_one_line_must_have_its_axis_there(void)
{
    for (int sensor = 0; sensor < 2; ++sensor) {
        const float degrees[2] = {2.0f,
                                  5.0f}; /* below and above max_bound, 3 deg; both within the 8 of planar motion */
        for (int i = 0; i < 2; ++i) {
            setUp();
            make_ready();
            turn_about_a_line_beside((sensor == 0) ? &engine.point.axis1 : &engine.point.axis2,
                                     (sensor == 0) ? JCAL_HINGE_Z_W1W1 : JCAL_HINGE_Z_W2W2, degrees[i]);
            if (i == 0) {
                assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
            } else {
                assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_OTHER_MINIMUM, JCAL_HINT_MOVE_JOINT);
            }
        }
    }
}

static void until_the_other_pairing_was_looked_for_the_sign_stays_open(void)
{
    make_ready();
    engine.search.has_flip = false;
    engine.search.rounds = 0;
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_SIGN, result_of(&engine).weak);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, result_of(&engine).sign_margin);
    engine.search.rounds = 1; /* looked for and not found: then it is worse than where axis 2 is turned round */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

static void a_joint_that_did_not_move_enough_is_said_so_before_anything_else(void)
{
    make_ready();
    engine.evidence.excitation =
        0.029f; /* limit: half a second at 0.3 rad/s beyond errors, 0.03 rad^2/s in round numbers */
    assert_verdict(JCAL_COLLECTING, JCAL_REASON_NO_MOTION, JCAL_HINT_MOVE_JOINT);
    engine.evidence.excitation = 0.031f;
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

static void residuals_of_a_quarter_of_the_difference_of_the_rates_do_not_fit(void)
{
    make_ready();
    /* rms difference 1 rad/s: the limit is 0.25 + 0.02 rad/s */
    engine.evidence.fit_time_s = 10.0f;
    engine.evidence.difference2 = 10.0f;
    engine.evidence.across_error2 = 10.0f * 0.275f * 0.275f;
    assert_verdict(JCAL_COLLECTING, JCAL_REASON_DOES_NOT_FIT, JCAL_HINT_CHECK_SENSORS);
    engine.evidence.across_error2 = 10.0f * 0.265f * 0.265f;
    judge_several_times();
    TEST_ASSERT_NOT_EQUAL(JCAL_REASON_DOES_NOT_FIT, result_of(&engine).reason);
}

static void a_bound_above_the_limit_names_the_axis(void)
{
    make_ready();
    engine.moved_rad[1] = 0.2f;
    assert_verdict(JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, JCAL_HINT_MOVE_SEGMENT2);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS2, result_of(&engine).weak);
    engine.moved_rad[1] = 0.0f;
    engine.moved_rad[0] = 0.2f;
    assert_verdict(JCAL_COLLECTING, JCAL_REASON_UNCERTAIN, JCAL_HINT_MOVE_SEGMENT1);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS1, result_of(&engine).weak);
    TEST_ASSERT_TRUE(result_of(&engine).progress_axis1 < 0.2f); /* 3 deg of 17 */
}

static void ready_takes_more_than_two_judgements_in_a_row_that_agree(void)
{
    make_ready();
    engine.agreed = 0;
    engine.verdict.status = (uint8_t)JCAL_COLLECTING;
    for (int k = 0; k < 2; ++k) {
        jcal_hinge_judge(&engine);
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result_of(&engine).status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, result_of(&engine).reason);
    }
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

static void an_estimate_that_the_hint_excludes_leaves_ready(void)
{
    make_ready();
    const bool same = jcal_hinge_main_sign(engine.point.axis1.j) == jcal_hinge_main_sign(engine.point.axis2.j);
    engine.cfg.sign_hint = same ? JCAL_SIGN_OPPOSITE : JCAL_SIGN_SAME;
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    engine.cfg.sign_hint = same ? JCAL_SIGN_SAME : JCAL_SIGN_OPPOSITE;
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

/* As if the same residuals had been met in fewer readings: all sums of squares shrink alike. */
static void weaken(float share)
{
    jcal_hinge_scatter_t *const scatters[2] = {&engine.evidence.axis1, &engine.evidence.axis2};
    jcal_sym_scale(engine.moments.gyr, 19u, share);
    jcal_sym_scale(engine.moments.acc, 7u, share);
    for (int i = 0; i < 2; ++i) {
        jcal_sym_scale(scatters[i]->scatter, 4u, share);
        jcal_sym_scale(scatters[i]->fine_scatter, 4u, share);
        scatters[i]->second *= share;
        scatters[i]->fine_second *= share;
    }
}

static void a_rival_many_times_as_costly_counts_while_the_difference_is_a_few_readings(void)
{
    make_ready();
    const bool same = jcal_hinge_main_sign(engine.point.axis1.j) == jcal_hinge_main_sign(engine.point.axis2.j);
    engine.cfg.sign_hint = same ? JCAL_SIGN_SAME : JCAL_SIGN_OPPOSITE;
    engine.cfg.max_bound_rad = 0.5f; /* the widest: bounds are not what this is about */
    const float c = cosf(0.26f);     /* 15 deg: another line */
    const float s = sinf(0.26f);
    set_rival(jcal_vec3_add(jcal_vec3_scale(engine.point.axis1.j, c), jcal_vec3_scale(engine.point.axis1.u, s)),
              jcal_vec3_add(jcal_vec3_scale(engine.point.axis2.j, c), jcal_vec3_scale(engine.point.axis2.u, s)));
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    /* Until the rival costs 3 readings more: below 15 times the least scatter that is believed, 0.3. */
    weaken(3.0f / (jcal_hinge_cost_of_rival(&engine) - jcal_hinge_cost(&engine, &engine.point)));
    TEST_ASSERT_TRUE(jcal_hinge_cost_of_rival(&engine) > 1.5f * jcal_hinge_cost(&engine, &engine.point));
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_OTHER_MINIMUM, JCAL_HINT_MOVE_JOINT);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(nothing_to_compare_with_is_no_rival);
    RUN_TEST(starts_that_were_not_tried_yet_may_hold_a_rival);
    RUN_TEST(a_rival_that_costs_hardly_more_makes_the_joint_ambiguous);
    RUN_TEST(a_segment_that_turns_about_one_line_must_have_its_axis_there);
    RUN_TEST(until_the_other_pairing_was_looked_for_the_sign_stays_open);
    RUN_TEST(a_joint_that_did_not_move_enough_is_said_so_before_anything_else);
    RUN_TEST(residuals_of_a_quarter_of_the_difference_of_the_rates_do_not_fit);
    RUN_TEST(a_bound_above_the_limit_names_the_axis);
    RUN_TEST(ready_takes_more_than_two_judgements_in_a_row_that_agree);
    RUN_TEST(an_estimate_that_the_hint_excludes_leaves_ready);
    RUN_TEST(a_rival_many_times_as_costly_counts_while_the_difference_is_a_few_readings);
    return UNITY_END();
}
