/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/hinge/judge.h: what keeps or takes away `ready`, one condition at a time.
#include "hinge/bounds.h"
#include "hinge/judge.h"
#include "hinge/model.h"
#include "hinge/point.h"
#include "hinge/refine.h"
#include "hinge/search.h"
#include "hinge/stream.h"
#include "joint/sign.h"
#include "math/sym.h"
#include "unit/hinge/fixture.h"

/* An engine that is ready after 20 s of lively motion. */
static void make_ready(void)
{
    const motion_t motion = motion_lively(9);
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
}

/* To enter takes more than to stay. */
static void forget_that_it_was_ready(void)
{
    engine.verdict.status = (uint8_t)JCAL_COLLECTING;
    engine.verdict.agreed = 0u;
}

static void judge_several_times(void)
{
    for (int k = 0; k < 10; ++k) {
        jcal_hinge_take_stock(&engine);
    }
}

static void assert_verdict(jcal_calibration_t status, jcal_reason_t reason, jcal_hint_t hint)
{
    judge_several_times();
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(reason, r.head.reason);
    TEST_ASSERT_EQUAL_INT(status, r.head.status);
    TEST_ASSERT_EQUAL_INT(hint, r.head.hint);
}

static bool pairing_is_same(void)
{
    return jcal_sign_main(engine.coarse.point.axis1.j) == jcal_sign_main(engine.coarse.point.axis2.j);
}

/* A hint that agrees with the data, so that the pairing is not asked for. */
static void hint_the_pairing(void)
{
    engine.cfg.sign_hint = pairing_is_same() ? JCAL_SIGN_SAME : JCAL_SIGN_OPPOSITE;
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
    engine.search.has_flip = true;
    engine.search.flip[0] = jcal_hinge_note(engine.coarse.point.axis1.j);
    engine.search.flip[1] = jcal_hinge_note(jcal_vec3_scale(engine.coarse.point.axis2.j, -1.0f));
    engine.search.rounds = 0;
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_OTHER_MINIMUM, JCAL_HINT_MOVE_JOINT);
}

static void set_rival(jcal_vec3_t j1, jcal_vec3_t j2)
{
    engine.search.has_rival = true;
    engine.search.rival[0] = jcal_hinge_note(j1);
    engine.search.rival[1] = jcal_hinge_note(j2);
}

static void a_rival_that_costs_hardly_more_makes_the_joint_ambiguous(void)
{
    make_ready();
    hint_the_pairing();
    set_rival(engine.coarse.point.axis1.j, engine.coarse.point.axis2.j); /* on the same lines: the bound covers it */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    set_rival(engine.coarse.point.axis1.u, engine.coarse.point.axis2.u); /* elsewhere, and far worse */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    /* Specific forces that cost the same for all pairs of unit vectors, c (|j1|^2 + |j2|^2), raise both costs until their ratio is
       near 1. */
    const float cost = jcal_hinge_cost_of_rival(&engine.search, &engine.coarse.moments, &engine.cfg);
    for (size_t i = 0; i < 6; ++i) {
        engine.coarse.moments.acc[jcal_sym_at(i, i)] += 3.0f * cost;
    }
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_OTHER_MINIMUM, JCAL_HINT_MOVE_JOINT);
}

static float cost_here(void)
{
    return jcal_hinge_cost(&engine.coarse.moments, &engine.cfg, &engine.coarse.point);
}

/* As if the same residuals had been met in fewer readings. */
static void weaken_to(float difference)
{
    const float share =
        difference / (jcal_hinge_cost_of_rival(&engine.search, &engine.coarse.moments, &engine.cfg) - cost_here());
    TEST_ASSERT_TRUE(share < 1.0f);
    jcal_sym_scale(engine.coarse.moments.gyr, JCAL_HINGE_FEATURES, share);
    jcal_sym_scale(engine.coarse.moments.acc, 7u, share);
}

static void a_rival_many_times_as_costly_counts_while_the_difference_is_a_few_readings(void)
{
    make_ready();
    hint_the_pairing();
    const float c = cosf(0.26f); /* 15 deg: another line */
    const float s = sinf(0.26f);
    set_rival(
        jcal_vec3_add(jcal_vec3_scale(engine.coarse.point.axis1.j, c), jcal_vec3_scale(engine.coarse.point.axis1.u, s)),
        jcal_vec3_add(jcal_vec3_scale(engine.coarse.point.axis2.j, c),
                      jcal_vec3_scale(engine.coarse.point.axis2.u, s)));
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    /* Limit: 15 readings, more where residuals scatter more than readings would, and not less than 0.3 of it. */
    const float shares[2] = {1.1f, 0.9f};
    for (int i = 0; i < 2; ++i) {
        jcal_hinge_bounds_t bounds;
        TEST_ASSERT_TRUE(jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds));
        weaken_to(shares[i] * 15.0f * fmaxf(0.3f, bounds.inflation));
        TEST_ASSERT_TRUE(jcal_hinge_cost_of_rival(&engine.search, &engine.coarse.moments, &engine.cfg) >
                         1.5f * cost_here());
        if (i == 0) {
            assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
        } else {
            assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE); /* to leave it takes a sixth less yet */
            forget_that_it_was_ready();
            assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_OTHER_MINIMUM, JCAL_HINT_MOVE_JOINT);
        }
    }
}

static void until_the_other_pairing_was_looked_for_the_sign_stays_open(void)
{
    make_ready();
    engine.search.has_flip = false;
    engine.search.rounds = 0;
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_SIGN, result_of(&engine).head.weak);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, result_of(&engine).sign_margin);
    engine.search.rounds = 1; /* looked for and not found: then it is worse than where axis 2 is turned round */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

/* The joint's own rate is 1 rad/s rms, and `error` of it remains. */
static void set_fit(float error_rad_s)
{
    const float noise = engine.cfg.gyr_noise_rad_s;
    engine.refine.time_s = 5.0f;
    engine.refine.joint = 100.0f / (noise * noise);
    engine.refine.cost = engine.refine.joint * error_rad_s * error_rad_s;
}

/* The specific forces say nothing of the pairing; the rates have compared both for `time_s`, the other costing `ratio`
   times as much. Evidence: half of ln(ratio) for each 0.2 s. */
static void rates_alone_say(float time_s, float ratio)
{
    jcal_sym_zero(engine.coarse.moments.acc, 7u);
    engine.refine.sign_time_s = time_s;
    engine.refine.same = 0.01f;
    engine.refine.other = 0.01f * ratio;
}

static void the_pairing_takes_evidence_of_seven_and_a_ratio_of_1_3(void)
{
    make_ready();
    rates_alone_say(10.0f, 1.35f); /* evidence 25 ln 1.35 = 7.50 */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 1.35f, result_of(&engine).sign_margin);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, result_of(&engine).progress_sign);
    rates_alone_say(9.0f, 1.35f); /* 6.75 */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    forget_that_it_was_ready();
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_SIGN, result_of(&engine).head.weak);
    TEST_ASSERT_FLOAT_WITHIN(1.0f / 255.0f, 22.5f * logf(1.35f) / 7.0f, result_of(&engine).progress_sign);
    rates_alone_say(20.0f, 1.28f); /* 12.3, but a ratio that a wrong weight alone would make */
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    rates_alone_say(10.0f, 1.35f);
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    rates_alone_say(7.6f, 1.35f); /* 5.70: below 7 / 1.2 */
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
}

static void specific_forces_speak_for_the_pairing_once_each_0_3_s(void)
{
    make_ready();
    engine.refine.sign_time_s = 0.0f; /* the rates say nothing */
    const jcal_hinge_point_t flip = jcal_hinge_flipped(&engine.search, &engine.coarse.point);
    const float same = jcal_hinge_cost_acc(&engine.coarse.moments, &engine.cfg, &engine.coarse.point);
    const float odds = logf(jcal_hinge_cost_acc(&engine.coarse.moments, &engine.cfg, &flip) / same);
    TEST_ASSERT_TRUE(odds > 0.5f);
    const float weight = engine.coarse.moments.acc[jcal_sym_at(6, 6)];
    engine.amount.weight_acc2 =
        weight * weight * odds / (7.2f * 2.0f * 0.3f); /* the square over that: the time they stand for */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    forget_that_it_was_ready();
    engine.amount.weight_acc2 = weight * weight * odds / (6.8f * 2.0f * 0.3f);
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
}

static void evidence_against_the_pairing_turns_it_round(void)
{
    make_ready();
    const jcal_hinge_point_t before = engine.coarse.point;
    rates_alone_say(1.0f, expf(-0.9f / 2.5f)); /* evidence 2.5 ln ratio = -0.9 */
    jcal_hinge_take_stock(&engine);
    TEST_ASSERT_TRUE(jcal_hinge_same_pairing(&before, &engine.coarse.point));
    TEST_ASSERT_TRUE(engine.refine.blocks > 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, result_of(&engine).progress_sign);
    rates_alone_say(1.0f, expf(-1.1f / 2.5f));
    const jcal_hinge_point_t flip = jcal_hinge_flipped(&engine.search, &engine.coarse.point);
    jcal_hinge_take_stock(&engine);
    TEST_ASSERT_FALSE(jcal_hinge_same_pairing(&before, &engine.coarse.point));
    TEST_ASSERT_EQUAL_MEMORY(&flip, &engine.coarse.point, sizeof flip);
    TEST_ASSERT_EQUAL_MEMORY(&flip.axis2.j, &engine.refine.point.axis2.j, sizeof flip.axis2.j);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, engine.refine.blocks); /* what was summed up was the other pairing */
    TEST_ASSERT_TRUE(engine.search.has_flip);
    const jcal_hinge_note_t old = jcal_hinge_note(before.axis2.j);
    TEST_ASSERT_EQUAL_MEMORY(&old, &engine.search.flip[1], sizeof old);
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.head.reason);
    TEST_ASSERT_EQUAL_INT(0, engine.verdict.agreed);
}

static void a_hint_is_never_turned_round_but_contradicted(void)
{
    make_ready();
    hint_the_pairing();
    const jcal_hinge_point_t before = engine.coarse.point;
    rates_alone_say(10.0f, 0.78f); /* evidence 25 ln 0.78 = -6.2: not enough against a hint */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    rates_alone_say(20.0f, 0.78f); /* -12.4, but above 1 / 1.3 */
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    rates_alone_say(20.0f, 0.75f);
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    TEST_ASSERT_EQUAL_MEMORY(&before, &engine.coarse.point, sizeof before);
}

static void a_contradicted_hint_is_named_before_residuals_and_without_bounds(void)
{
    make_ready();
    engine.cfg.sign_hint = pairing_is_same() ? JCAL_SIGN_OPPOSITE : JCAL_SIGN_SAME;
    set_fit(0.5f);
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    jcal_hinge_refine_restart(&engine.refine, &engine.coarse.point); /* no blocks, no bounds */
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, result_of(&engine).uncertainty1_rad);
}

static void an_estimate_that_the_hint_excludes_leaves_ready(void)
{
    make_ready();
    engine.cfg.sign_hint = pairing_is_same() ? JCAL_SIGN_OPPOSITE : JCAL_SIGN_SAME;
    assert_verdict(JCAL_AMBIGUOUS, JCAL_REASON_SIGN_OPEN, JCAL_HINT_TILT_AXIS);
    hint_the_pairing();
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

static void a_joint_that_did_not_move_enough_is_said_so_before_anything_else(void)
{
    make_ready();
    /* Limit: half a second at 0.3 rad/s beyond errors, 0.03 rad^2/s in round numbers. */
    engine.amount.excitation = 0.029f;
    assert_verdict(JCAL_COLLECTING, JCAL_REASON_NO_MOTION, JCAL_HINT_MOVE_JOINT);
    engine.amount.excitation = 0.031f;
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

static void residuals_of_a_third_of_the_rate_of_the_joint_do_not_fit(void)
{
    make_ready();
    engine.cfg.max_bound_rad = 10.0f; /* so much may move the axes, too; here it is not asked */
    set_fit(0.375f);                  /* limit: 0.35 + 0.02 rad/s; 1.2 times that while ready */
    judge_several_times();
    TEST_ASSERT_NOT_EQUAL(JCAL_REASON_DOES_NOT_FIT, result_of(&engine).head.reason);
    forget_that_it_was_ready();
    assert_verdict(JCAL_COLLECTING, JCAL_REASON_DOES_NOT_FIT, JCAL_HINT_CHECK_SENSORS);
    set_fit(0.365f);
    judge_several_times();
    TEST_ASSERT_NOT_EQUAL(JCAL_REASON_DOES_NOT_FIT, result_of(&engine).head.reason);
}

static void a_bound_above_the_limit_names_the_axis(void)
{
    make_ready();
    const jcal_hinge_t ready = engine;
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        engine = ready;
        engine.refine.along[axis] = 0.0f; /* its segment has not turned about it */
        assert_verdict(JCAL_COLLECTING, JCAL_REASON_UNCERTAIN,
                       (axis == 0u) ? JCAL_HINT_MOVE_SEGMENT1 : JCAL_HINT_MOVE_SEGMENT2);
        const jcal_hinge_result_t r = result_of(&engine);
        TEST_ASSERT_EQUAL_INT((axis == 0u) ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2, r.head.weak);
        const float bound = (axis == 0u) ? r.uncertainty1_rad : r.uncertainty2_rad;
        TEST_ASSERT_TRUE(bound > engine.cfg.max_bound_rad);
        TEST_ASSERT_EQUAL_FLOAT(engine.cfg.max_bound_rad / bound, (axis == 0u) ? r.progress_axis1 : r.progress_axis2);
        TEST_ASSERT_TRUE(bound > ((axis == 0u) ? r.uncertainty2_rad : r.uncertainty1_rad));
    }
}

static void ready_is_entered_at_the_limit_and_left_a_fifth_above_it(void)
{
    make_ready();
    const jcal_hinge_result_t r = result_of(&engine);
    const float bound_rad = fmaxf(r.uncertainty1_rad, r.uncertainty2_rad);
    engine.cfg.max_bound_rad = bound_rad / 1.19f;
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
    engine.cfg.max_bound_rad = bound_rad / 1.21f;
    judge_several_times();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, result_of(&engine).head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result_of(&engine).head.status);
    engine.cfg.max_bound_rad = bound_rad / 1.01f;
    judge_several_times();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, result_of(&engine).head.reason);
    engine.cfg.max_bound_rad = bound_rad / 0.99f;
    assert_verdict(JCAL_READY, JCAL_REASON_NONE, JCAL_HINT_NONE);
}

static void an_estimate_that_begins_anew_says_what_it_waits_for(void)
{
    make_ready();
    jcal_hinge_go_round(&engine);
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, r.head.hint);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS1, r.head.weak);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty1_rad); /* that of the old estimate means nothing */
}

static void ready_takes_six_judgements_in_a_row_that_agree(void)
{
    make_ready();
    const float excitation = engine.amount.excitation;
    engine.amount.excitation = 0.0f;
    jcal_hinge_take_stock(&engine); /* one that does not agree: all over again */
    engine.amount.excitation = excitation;
    for (int k = 0; k < 5; ++k) {
        jcal_hinge_take_stock(&engine);
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result_of(&engine).head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, result_of(&engine).head.reason);
    }
    jcal_hinge_take_stock(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
}

static void assert_nothing_known(jcal_reason_t reason, jcal_hint_t hint)
{
    assert_verdict(JCAL_COLLECTING, reason, hint);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, result_of(&engine).uncertainty1_rad);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, result_of(&engine).uncertainty2_rad);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS1, result_of(&engine).head.weak);
}

/* Sums of the rates of which, at the estimate, 16 remain; without axes 36 + `explained`. */
static void rates_leave_16_of_36_and(float explained)
{
    const float isotropic[JCAL_HINGE_FEATURES] = {1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f, -1.0f, -1.0f, -1.0f};
    const jcal_vec3_t j = engine.coarse.point.axis1.j;
    const float along[JCAL_HINGE_FEATURES] = {j.x * j.x, j.y * j.y, j.z * j.z, j.x * j.y, j.x * j.z, j.y * j.z};
    jcal_sym_zero(engine.coarse.moments.gyr, JCAL_HINGE_FEATURES);
    jcal_sym_rank1(engine.coarse.moments.gyr, JCAL_HINGE_FEATURES, isotropic, 1.0f); /* (2 + 2)^2, and (3 + 3)^2 */
    jcal_sym_rank1(engine.coarse.moments.gyr, JCAL_HINGE_FEATURES, along,
                   explained); /* 0, and 1: a turn about axis 1 */
}

static void without_bounds_after_many_rounds_it_is_known_why(void)
{
    make_ready();
    const jcal_hinge_t ready = engine;
    for (int blind = 0; blind < 2; ++blind) { /* no estimate, or an estimate whose blocks come to nothing */
        engine = ready;
        engine.coarse.has_point = (blind == 0);
        jcal_hinge_refine_restart(&engine.refine, &engine.coarse.point);
        engine.amount.excitation = 1.0f;
        rates_leave_16_of_36_and(120.0f); /* 10.3 %; limit: 10 % */
        engine.search.rounds = 15;
        assert_nothing_known(JCAL_REASON_NO_DATA, JCAL_HINT_MOVE_JOINT);
        engine.search.rounds = 16;
        assert_nothing_known(JCAL_REASON_DOES_NOT_FIT, JCAL_HINT_CHECK_SENSORS);
        rates_leave_16_of_36_and(130.0f); /* 9.6 %: the lengths of the rates do fit */
        assert_nothing_known(JCAL_REASON_UNCERTAIN, JCAL_HINT_MOVE_SEGMENT1);
        engine.amount.excitation = 0.029f;
        assert_nothing_known(JCAL_REASON_NO_MOTION, JCAL_HINT_MOVE_JOINT);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(nothing_to_compare_with_is_no_rival);
    RUN_TEST(starts_that_were_not_tried_yet_may_hold_a_rival);
    RUN_TEST(a_rival_that_costs_hardly_more_makes_the_joint_ambiguous);
    RUN_TEST(a_rival_many_times_as_costly_counts_while_the_difference_is_a_few_readings);
    RUN_TEST(until_the_other_pairing_was_looked_for_the_sign_stays_open);
    RUN_TEST(the_pairing_takes_evidence_of_seven_and_a_ratio_of_1_3);
    RUN_TEST(specific_forces_speak_for_the_pairing_once_each_0_3_s);
    RUN_TEST(evidence_against_the_pairing_turns_it_round);
    RUN_TEST(a_hint_is_never_turned_round_but_contradicted);
    RUN_TEST(a_contradicted_hint_is_named_before_residuals_and_without_bounds);
    RUN_TEST(an_estimate_that_the_hint_excludes_leaves_ready);
    RUN_TEST(a_joint_that_did_not_move_enough_is_said_so_before_anything_else);
    RUN_TEST(residuals_of_a_third_of_the_rate_of_the_joint_do_not_fit);
    RUN_TEST(a_bound_above_the_limit_names_the_axis);
    RUN_TEST(ready_is_entered_at_the_limit_and_left_a_fifth_above_it);
    RUN_TEST(an_estimate_that_begins_anew_says_what_it_waits_for);
    RUN_TEST(ready_takes_six_judgements_in_a_row_that_agree);
    RUN_TEST(without_bounds_after_many_rounds_it_is_known_why);
    return UNITY_END();
}
