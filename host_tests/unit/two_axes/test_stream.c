/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/two_axes.h: an exact elbow that is made up bends, then turns, in either order; gaps, slips, signs, what is no joint.
#include "ball/judge.h"
#include "unit/two_axes/fixture.h"

#include <stddef.h>

static run_t run;
static run_t other;

#define MAX_BOUND_RAD (15.0f / 57.29578f)

void setUp(void)
{
}

void tearDown(void)
{
}

static void expect_axes_within_bounds(const run_t *r)
{
    const jcal_two_axes_result_t result = run_result(r);
    TEST_ASSERT_TRUE((result.windows1 == 0u) ||
                     (line_angle(result.axis1, elbow_axis(&r->elbow, 1)) < (double)result.uncertainty1_rad));
    TEST_ASSERT_TRUE((result.windows2 == 0u) ||
                     (line_angle(result.axis2, elbow_axis(&r->elbow, 2)) < (double)result.uncertainty2_rad));
}

/* So many seconds, in which whatever is known is within its bounds. */
static void watch_for(run_t *r, elbow_motion_t motion, double seconds)
{
    for (double done = 0.0; done < seconds; done += 0.5) {
        run_for(r, motion, 0.5);
        expect_axes_within_bounds(r);
    }
}

static void nothing_is_known_at_first(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    const jcal_two_axes_result_t r = run_result(&run);
    TEST_ASSERT_FALSE(r.for_heading || r.for_axis1 || r.for_axis2);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.ball.head.reason);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty1_rad);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty2_rad);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_vec3_norm(r.axis1));
}

static void bending_then_turning(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    watch_for(&run, BEND, 5.0);
    jcal_two_axes_result_t r = run_result(&run);
    TEST_ASSERT_TRUE(r.for_heading && r.ball.head.status == JCAL_COLLECTING);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS1, r.ball.head.weak);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_BEND_ONLY, r.ball.head.hint);
    watch_for(&run, BEND, 10.0);
    r = run_result(&run);
    TEST_ASSERT_TRUE(r.for_heading && r.for_axis1 && !r.for_axis2);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.ball.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, r.ball.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS2, r.ball.head.weak);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_TURN_ONLY, r.ball.head.hint);
    TEST_ASSERT_TRUE(line_angle(r.axis1, elbow_axis(&elbow, 1)) < 0.01);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, r.progress_axis1);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, MAX_BOUND_RAD / JCAL_BOUND_UNKNOWN_RAD, r.progress_axis2);
    const uint8_t windows1 = r.windows1;
    watch_for(&run, TURN, 15.0);
    r = run_result(&run);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.ball.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, r.ball.head.reason);
    TEST_ASSERT_TRUE(r.for_heading && r.for_axis1 && r.for_axis2);
    TEST_ASSERT_TRUE(line_angle(r.axis1, elbow_axis(&elbow, 1)) < 0.01);
    TEST_ASSERT_TRUE(line_angle(r.axis2, elbow_axis(&elbow, 2)) < 0.01);
    TEST_ASSERT_EQUAL_UINT8(windows1, r.windows1); /* turning shows no bending */
    TEST_ASSERT_TRUE(r.windows2 >= 3u);
}

/* A forearm that only turns does not tell its lever along itself, so that nobody knows yet that it is turning; bending tells. */
static void turning_then_bending(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    watch_for(&run, TURN, 20.0);
    jcal_two_axes_result_t r = run_result(&run);
    TEST_ASSERT_FALSE(r.for_axis1 || r.for_axis2);
    TEST_ASSERT_EQUAL_UINT8(0u, r.windows1 + r.windows2);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS1, r.ball.head.weak);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_BEND_ONLY, r.ball.head.hint);
    watch_for(&run, BEND, 15.0);
    r = run_result(&run);
    TEST_ASSERT_TRUE(r.for_axis1);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_TURN_ONLY, r.ball.head.hint);
    watch_for(&run, TURN, 15.0);
    r = run_result(&run);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.ball.head.status);
    TEST_ASSERT_TRUE(line_angle(r.axis1, elbow_axis(&elbow, 1)) < 0.01);
    TEST_ASSERT_TRUE(line_angle(r.axis2, elbow_axis(&elbow, 2)) < 0.01);
}

/* No window of both motions at once shows an axis. */
static void both_at_once_show_nothing(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    run_for(&run, BOTH, 30.0);
    const jcal_two_axes_result_t r = run_result(&run);
    TEST_ASSERT_TRUE(r.for_heading);
    TEST_ASSERT_EQUAL_UINT8(0u, r.windows1);
    TEST_ASSERT_EQUAL_UINT8(0u, r.windows2);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_BEND_ONLY, r.ball.head.hint);
}

/* An axis is reported towards what the user names, or with its largest component positive, until it is known; then the sign stays. */
static void signs_are_those_that_were_asked_for_and_stay(void)
{
    const hinge_t elbow = elbow_usual();
    for (int n = 0; n < 2; ++n) {
        const float sign = (n == 0) ? 1.0f : -1.0f;
        jcal_two_axes_config_t config = jcal_two_axes_config_default();
        config.axis1_toward = jcal_vec3_scale(elbow_axis(&elbow, 1), 2.0f * sign);
        config.axis2_toward = jcal_vec3_scale(elbow_axis(&elbow, 2), -3.0f * sign);
        run_begin(&run, &elbow, &config);
        run_for(&run, BEND, 15.0);
        run_for(&run, TURN, 15.0);
        const jcal_two_axes_result_t r = run_result(&run);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, r.ball.head.status);
        TEST_ASSERT_TRUE(sign * jcal_vec3_dot(r.axis1, elbow_axis(&elbow, 1)) > 0.99f);
        TEST_ASSERT_TRUE(sign * jcal_vec3_dot(r.axis2, elbow_axis(&elbow, 2)) < -0.99f);
        TEST_ASSERT_TRUE((run.joint.windows.found[0].kept_sign != 0) && (run.joint.windows.found[1].kept_sign != 0));
        run.joint.cfg.axis1_toward = jcal_vec3_scale(config.axis1_toward, -1.0f); /* as if it were a tie that tips */
        run.joint.windows.found[0].axis = jcal_vec3_scale(run.joint.windows.found[0].axis, -1.0f);
        TEST_ASSERT_TRUE(jcal_vec3_dot(r.axis1, run_result(&run).axis1) > 0.99f);
    }
}

static void the_sign_is_not_kept_before_the_axis_is_known(void)
{
    const hinge_t elbow = elbow_usual();
    for (int n = 0; n < 4; ++n) {
        const float sign1 = (n % 2 == 0) ? 1.0f : -1.0f;
        const float sign2 = (n < 2) ? 1.0f : -1.0f;
        jcal_two_axes_config_t config = jcal_two_axes_config_default();
        config.max_bound_rad = 0.01f; /* 2 deg are never below */
        config.axis1_toward = jcal_vec3_scale(elbow_axis(&elbow, 1), sign1);
        config.axis2_toward = jcal_vec3_scale(elbow_axis(&elbow, 2), sign2);
        run_begin(&run, &elbow, &config);
        run_for(&run, BEND, 15.0);
        run_for(&run, TURN, 15.0);
        const jcal_two_axes_result_t r = run_result(&run);
        TEST_ASSERT_TRUE((r.windows1 > 0u) && (r.windows2 > 0u));
        TEST_ASSERT_FALSE(r.for_axis1 || r.for_axis2);
        TEST_ASSERT_TRUE(sign1 * jcal_vec3_dot(r.axis1, elbow_axis(&elbow, 1)) > 0.99f);
        TEST_ASSERT_TRUE(sign2 * jcal_vec3_dot(r.axis2, elbow_axis(&elbow, 2)) > 0.99f);
        TEST_ASSERT_EQUAL_INT(0, run.joint.windows.found[0].kept_sign);
        TEST_ASSERT_EQUAL_INT(0, run.joint.windows.found[1].kept_sign);
    }
}

/* The sensor on the upper arm is turned about the joint's centre, 50 deg: its lever is as before, so that the centre does not tell, but
   the axis is another in its frame. */
static void an_axis_that_is_another_now_is_replaced(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    run_for(&run, BEND, 20.0);
    TEST_ASSERT_TRUE(run_result(&run).windows1 >= 3u);
    const double about_z[3] = {0.0, 0.0, 0.9};
    double step[9];
    mat_turn(about_z, step);
    mat_mul(step, run.elbow.mount1, run.elbow.mount1);
    double worst = 0.0;
    for (int k = 0; (k < 20 * 20) && (run_result(&run).windows1 != 1u); ++k) {
        worst = line_angle(run_result(&run).axis1, elbow_axis(&run.elbow, 1));
        run_for(&run, BEND, 0.05);
    }
    TEST_ASSERT_TRUE(worst > 0.8);
    TEST_ASSERT_TRUE(line_angle(run_result(&run).axis1, elbow_axis(&run.elbow, 1)) < 0.05);
}

/* Two sensors that have nothing to do with each other: no window is believed, whatever they show. */
static void what_is_no_joint_shows_no_axis(void)
{
    const hinge_t elbow = elbow_usual();
    hinge_t stranger = elbow_usual();
    stranger.rest_s = -7.0;
    stranger.pace = 1.3;
    run_begin(&run, &elbow, NULL);
    for (int k = 0; k < 20 * 40; ++k) {
        jcal_tick_t tick1;
        jcal_tick_t tick2;
        elbow_do(&run.elbow, BEND);
        run_make(&run, &tick1, &tick2);
        tick2 = hinge_tick(&stranger, run_time(&run), 2, tick1.t_us);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_add(&run.joint, &tick1, &tick2));
        run_work(&run);
        ++run.next;
        const jcal_two_axes_result_t r = run_result(&run);
        TEST_ASSERT_FALSE(r.for_heading || r.for_axis1 || r.for_axis2);
    }
    TEST_ASSERT_EQUAL_UINT8(0u, run_result(&run).windows1);
    TEST_ASSERT_EQUAL_UINT8(0u, run_result(&run).windows2);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, run_result(&run).ball.head.reason);
}

/* An axis that was found is of no use while both sensors do not move as one joint. */
static void an_axis_is_known_only_of_a_joint(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    run_for(&run, BEND, 15.0);
    run_for(&run, TURN, 15.0);
    run.joint.ball.verdict.agreed = 2u;
    const jcal_two_axes_result_t r = run_result(&run);
    TEST_ASSERT_FALSE(r.for_axis1 || r.for_axis2);
    TEST_ASSERT_TRUE(jcal_vec3_norm(r.axis1) > 0.99f);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.ball.head.status);
}

/* After a gap windows begin anew, what was found stays. */
static void a_gap_keeps_axes_and_begins_windows_anew(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    run_for(&run, BEND, 14.0);
    const jcal_two_axes_result_t before = run_result(&run);
    TEST_ASSERT_TRUE(before.for_axis1);
    TEST_ASSERT_TRUE(run.joint.windows.part[0].time_s + run.joint.windows.part[1].time_s > 0.0f);
    run.epoch += 1u;
    run.next += 40u;
    run.elbow.heading += 1.0;
    run_for(&run, BEND, 0.05);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, run.joint.windows.part[0].time_s);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, run.joint.windows.part[1].time_s);
    TEST_ASSERT_EQUAL_UINT8(before.windows1, run_result(&run).windows1);
    watch_for(&run, BEND, 4.5); /* no window is full yet */
    TEST_ASSERT_EQUAL_UINT8(before.windows1, run_result(&run).windows1);
    watch_for(&run, BEND, 10.0);
    TEST_ASSERT_TRUE(run_result(&run).windows1 > before.windows1);
}

/* What has been no joint for a while may come back as another mounting: axes wait for a window that agrees. */
static void a_joint_that_was_lost_leaves_axes_in_doubt(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    run_for(&run, BEND, 16.0);
    TEST_ASSERT_TRUE(run_result(&run).for_axis1);
    run.joint.ball.refused_s = 4.5f;
    run_for(&run, BEND, 0.05);
    TEST_ASSERT_TRUE(run_result(&run).for_axis1);
    run.joint.ball.refused_s = 5.1f;
    run_for(&run, BEND, 0.05);
    TEST_ASSERT_FALSE(run_result(&run).for_axis1);
    run_for(&run, BEND, 5.5);
    TEST_ASSERT_TRUE(run_result(&run).for_axis1);
    TEST_ASSERT_TRUE(line_angle(run_result(&run).axis1, elbow_axis(&elbow, 1)) < 0.01);
}

/* A sensor that sits elsewhere: axes are forgotten with all the rest. */
static void a_slip_forgets_the_axes(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    run_for(&run, BEND, 15.0);
    run_for(&run, TURN, 15.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).ball.head.status);
    run.elbow.r2[0] += 0.2;
    run.elbow.r2[1] -= 0.2;
    for (int k = 0; (k < 20 * 5) && (run_result(&run).ball.head.status != JCAL_MOVED); ++k) {
        run_for(&run, BOTH, 0.05);
    }
    const jcal_two_axes_result_t r = run_result(&run);
    TEST_ASSERT_EQUAL_INT(JCAL_MOVED, r.ball.head.status);
    TEST_ASSERT_FALSE(r.for_heading || r.for_axis1 || r.for_axis2);
    TEST_ASSERT_EQUAL_UINT8(0u, r.windows1);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty2_rad);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_vec3_norm(r.axis2));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, run.joint.windows.part[0].time_s);
}

static void times_do_not_matter_but_for_their_order(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    run_begin(&other, &elbow, NULL);
    run.begin_us = 17u;
    other.begin_us = 0x123456789abcull;
    run_for(&run, BEND, 15.0);
    run_for(&other, BEND, 15.0);
    other.joint.ball.ticks.last_us = run.joint.ball.ticks.last_us;
    TEST_ASSERT_EQUAL_MEMORY(&run.joint, &other.joint, sizeof run.joint);
}

/* Which way level frame 2 looks is in the heading and nowhere else. */
static void another_level_frame_turns_only_the_heading(void)
{
    hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    elbow.heading += 2.2;
    run_begin(&other, &elbow, NULL);
    run_for(&run, BEND, 15.0);
    run_for(&run, TURN, 15.0);
    run_for(&other, BEND, 15.0);
    run_for(&other, TURN, 15.0);
    const jcal_two_axes_result_t a = run_result(&run);
    const jcal_two_axes_result_t b = run_result(&other);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, b.ball.head.status);
    /* starts are tried in another order, and the first window has the first headings, which are off by half a degree */
    TEST_ASSERT_TRUE(line_angle(a.axis1, b.axis1) < 5e-3);
    TEST_ASSERT_TRUE(line_angle(a.axis2, b.axis2) < 5e-3);
    const double off = (double)(b.ball.heading.heading_rad - a.ball.heading.heading_rad) - 2.2;
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.0, remainder(off, 2.0 * MOTION_PI));
}

static void ticks_that_are_refused_leave_no_trace(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&run, &elbow, NULL);
    run_for(&run, BEND, 6.0);
    jcal_tick_t good1;
    jcal_tick_t good2;
    run_make(&run, &good1, &good2);
    const jcal_two_axes_t before = run.joint;
    jcal_tick_t bad = good2;
    bad.gyr.y = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_two_axes_add(&run.joint, &good1, &bad));
    bad = good2;
    bad.t_us += 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_two_axes_add(&run.joint, &good1, &bad));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_add(NULL, &good1, &good2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_add(&run.joint, NULL, &good2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_add(&run.joint, &good1, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint, sizeof before);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_add(&run.joint, &good1, &good2));
}

static void the_state_has_its_size(void)
{
    TEST_ASSERT_TRUE(sizeof(jcal_two_axes_t) <= 2304u);
}

static void settings_have_ranges(void)
{
    const jcal_two_axes_config_t usual = jcal_two_axes_config_default();
    TEST_ASSERT_NULL(jcal_two_axes_config_check(&usual));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, MAX_BOUND_RAD, usual.max_bound_rad);
    TEST_ASSERT_EQUAL_STRING("config", jcal_two_axes_config_check(NULL));
    const float wrong[] = {0.0099f, 0.51f, -1.0f, NAN, INFINITY};
    for (int k = -2; k < 5; ++k) {
        jcal_two_axes_config_t config = usual;
        config.max_bound_rad = (k == -2) ? 0.01f : ((k == -1) ? 0.5f : wrong[k]);
        if (k < 0) {
            TEST_ASSERT_NULL(jcal_two_axes_config_check(&config));
            continue;
        }
        TEST_ASSERT_EQUAL_STRING("max_bound_rad", jcal_two_axes_config_check(&config));
        memset(&run.joint, 0x5a, sizeof run.joint);
        const jcal_two_axes_t before = run.joint;
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_two_axes_init(&run.joint, &config));
        TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint, sizeof before);
    }
    jcal_two_axes_config_t config = usual;
    config.axis1_toward.y = NAN;
    TEST_ASSERT_EQUAL_STRING("axis1_toward", jcal_two_axes_config_check(&config));
    config = usual;
    config.axis2_toward.z = 1.1e6f;
    TEST_ASSERT_EQUAL_STRING("axis2_toward", jcal_two_axes_config_check(&config));
    config = usual;
    config.ball.max_lever_m = 0.0f;
    TEST_ASSERT_EQUAL_STRING("max_lever_m", jcal_two_axes_config_check(&config));
}

static void null_is_an_error(void)
{
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    jcal_two_axes_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_init(&run.joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_init(&run.joint, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_get(NULL, &result));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_get(&run.joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_axes_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_two_axes_step(&run.joint));
}

static void reset_is_a_new_beginning(void)
{
    const hinge_t elbow = elbow_usual();
    run_begin(&other, &elbow, NULL);
    run_for(&other, BEND, 16.0);
    TEST_ASSERT_TRUE(run_result(&other).windows1 > 0u);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_reset(&other.joint));
    run_begin(&run, &elbow, NULL);
    TEST_ASSERT_EQUAL_MEMORY(&run.joint, &other.joint, sizeof run.joint);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(nothing_is_known_at_first);
    RUN_TEST(bending_then_turning);
    RUN_TEST(turning_then_bending);
    RUN_TEST(both_at_once_show_nothing);
    RUN_TEST(signs_are_those_that_were_asked_for_and_stay);
    RUN_TEST(the_sign_is_not_kept_before_the_axis_is_known);
    RUN_TEST(an_axis_that_is_another_now_is_replaced);
    RUN_TEST(what_is_no_joint_shows_no_axis);
    RUN_TEST(an_axis_is_known_only_of_a_joint);
    RUN_TEST(a_gap_keeps_axes_and_begins_windows_anew);
    RUN_TEST(a_joint_that_was_lost_leaves_axes_in_doubt);
    RUN_TEST(a_slip_forgets_the_axes);
    RUN_TEST(times_do_not_matter_but_for_their_order);
    RUN_TEST(another_level_frame_turns_only_the_heading);
    RUN_TEST(ticks_that_are_refused_leave_no_trace);
    RUN_TEST(the_state_has_its_size);
    RUN_TEST(settings_have_ranges);
    RUN_TEST(null_is_an_error);
    RUN_TEST(reset_is_a_new_beginning);
    return UNITY_END();
}
