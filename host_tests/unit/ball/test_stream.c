/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/ball.h: what an exact joint that is made up gives, what is refused, gaps, slips, memory, what is no joint.
#include "ball/solve.h"
#include "ball/sums.h"
#include "ball/track.h"
#include "levers/levers.h"
#include "math/eig.h"
#include "unit/ball/fixture.h"

#include <stddef.h>
#include <string.h>

/* Arms of a test that tries many. On an emulated target the made-up motion is what takes time; few show that the code is the same. */
#ifdef JCAL_TEST_SHORT
enum { EXACT = 2, BOUNDED = 3 };
#else
enum { EXACT = 10, BOUNDED = 30 };
#endif

static run_t run;
static run_t other;

void setUp(void)
{
}

void tearDown(void)
{
}

static double length(const double v[3])
{
    return (double)jcal_vec3_norm(to_vec3(v));
}

/* Root mean square of the centre's velocity. */
static double true_speed(const hinge_t *arm, double seconds)
{
    double sum = 0.0;
    int n = 0;
    for (double t = 0.0; t < seconds; t += 0.05) {
        double ignored[9];
        double before[3];
        double after[3];
        hinge_pose(arm, t - 5e-4, ignored, ignored, before);
        hinge_pose(arm, t + 5e-4, ignored, ignored, after);
        for (int i = 0; i < 3; ++i) {
            sum += (after[i] - before[i]) * (after[i] - before[i]) * 1e6;
        }
        ++n;
    }
    return sqrt(sum / n);
}

/* By how much the ridge, 1/200 of the mean of what rates make of all directions, shortens both levers at most: in the direction that they
   make least of. */
static double ridge_error(const jcal_ball_t *joint, const hinge_t *arm)
{
    float x[16];
    float h[21];
    float g[6];
    float values[6];
    float vectors[36];
    jcal_levers_cross(&joint->sums.levers, joint->point.heading, x);
    jcal_levers_normal(&joint->sums.levers, x, h, g);
    TEST_ASSERT_TRUE(jcal_eig_symmetric(h, 6u, values, vectors));
    double ridge = 0.0;
    for (int i = 0; i < 6; ++i) {
        ridge += 0.005 / 6.0 * (double)values[i];
    }
    return ridge / (ridge + (double)values[5]) * hypot(length(arm->r1), length(arm->r2));
}

static void an_exact_joint_is_found(void)
{
    for (int number = 0; number < EXACT; ++number) {
        const hinge_t arm = some_arm(number);
        run_begin(&run, &arm, NULL);
        const jcal_ball_result_t nothing = run_result(&run);
        TEST_ASSERT_FALSE(nothing.has_estimate || nothing.heading.known);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, nothing.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, nothing.head.hint);
        TEST_ASSERT_EQUAL_INT(JCAL_WEAK_HEADING, nothing.head.weak);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, nothing.uncertainty_heading_rad);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, nothing.uncertainty1_m);
        const double took_s = run_until(&run, JCAL_READY, 15.0);
        TEST_ASSERT_TRUE_MESSAGE(took_s > 3.0, "three seconds of motion are asked for");
        run_for(&run, 20.0);
        const jcal_ball_result_t result = run_result(&run);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, result.head.status);
        TEST_ASSERT_TRUE(result.has_estimate && result.heading.known && result.for_center1 && result.for_center2);
        TEST_ASSERT_TRUE(run_heading_error(&run) < 0.01);
        const double allowed_m = ridge_error(&run.joint, &arm) + 1e-3;
        TEST_ASSERT_TRUE(run_lever_error(&run, 1) < allowed_m);
        TEST_ASSERT_TRUE(run_lever_error(&run, 2) < allowed_m);
        /* moments with little motion count less */
        const double speed = true_speed(&arm, run_time(&run));
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * speed, speed, (double)result.speed_m_s);
        TEST_ASSERT_EQUAL_UINT32(run.next, result.head.samples);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, result.progress_heading);
    }
}

/* Every judgement that is ready has heading and levers within their bounds, from the first on. */
static void nothing_ready_is_beyond_its_bounds(void)
{
    for (int number = 0; number < BOUNDED; ++number) {
        const hinge_t arm = some_arm(number);
        run_begin(&run, &arm, NULL);
        run.next = (uint32_t)(37 * number);
        for (int tick = 0; tick < 300; ++tick) {
            run_tick(&run);
            const jcal_ball_result_t result = run_result(&run);
            if (result.head.status == JCAL_READY) {
                TEST_ASSERT_TRUE(run_heading_error(&run) < (double)result.uncertainty_heading_rad);
                TEST_ASSERT_TRUE(run_lever_error(&run, 1) < (double)result.uncertainty1_m);
                TEST_ASSERT_TRUE(run_lever_error(&run, 2) < (double)result.uncertainty2_m);
            } else {
                TEST_ASSERT_FALSE(result.for_center1 || result.for_center2);
            }
        }
        TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    }
}

static void sensors_may_be_exchanged(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_begin(&other, &arm, NULL);
    other.exchanged = true;
    run_for(&run, 18.0);
    run_for(&other, 18.0);
    const jcal_ball_result_t a = run_result(&run);
    const jcal_ball_result_t b = run_result(&other);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, b.head.status);
    TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(a.joint_to_sensor1_m, b.joint_to_sensor2_m)) < 1e-3f);
    TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(a.joint_to_sensor2_m, b.joint_to_sensor1_m)) < 1e-3f);
    TEST_ASSERT_FLOAT_WITHIN(5e-4f, run.joint.point.heading[0].re, other.joint.point.heading[0].re);
    TEST_ASSERT_FLOAT_WITHIN(5e-4f, run.joint.point.heading[0].im, -other.joint.point.heading[0].im);
    TEST_ASSERT_FLOAT_WITHIN(0.03f * a.uncertainty_heading_rad, a.uncertainty_heading_rad, b.uncertainty_heading_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, run.joint.verdict.stiffness, other.joint.verdict.stiffness);
}

/* All that a mirror does is known: headings turn the other way, y of levers changes its sign. */
static void a_mirrored_joint_is_mirrored(void)
{
    const hinge_t arm = some_arm(4);
    run_begin(&run, &arm, NULL);
    run_begin(&other, &arm, NULL);
    other.mirrored = true;
    run_for(&run, 18.0);
    run_for(&other, 18.0);
    const jcal_ball_result_t a = run_result(&run);
    const jcal_ball_result_t b = run_result(&other);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, b.head.status);
    /* starts are tried the other way round: what the first estimates were like is not quite forgotten by the heading of the moment */
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, a.heading.heading_rad, -b.heading.heading_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, run.joint.point.heading[0].re, other.joint.point.heading[0].re);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, run.joint.point.heading[0].im, -other.joint.point.heading[0].im);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, a.joint_to_sensor1_m.x, b.joint_to_sensor1_m.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, a.joint_to_sensor1_m.y, -b.joint_to_sensor1_m.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, a.joint_to_sensor2_m.z, b.joint_to_sensor2_m.z);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f * a.uncertainty1_m, a.uncertainty1_m, b.uncertainty1_m);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f * a.uncertainty_heading_rad, a.uncertainty_heading_rad, b.uncertainty_heading_rad);
}

static void another_level_frame_turns_only_the_heading(void)
{
    hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    arm.heading += 1.9;
    run_begin(&other, &arm, NULL);
    run_for(&run, 18.0);
    run_for(&other, 18.0);
    const jcal_ball_result_t a = run_result(&run);
    const jcal_ball_result_t b = run_result(&other);
    TEST_ASSERT_DOUBLE_WITHIN(
        2e-3, 0.0, remainder((double)(b.heading.heading_rad - a.heading.heading_rad) - 1.9, 2.0 * MOTION_PI));
    TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(a.joint_to_sensor1_m, b.joint_to_sensor1_m)) < 1e-3f);
    TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(a.joint_to_sensor2_m, b.joint_to_sensor2_m)) < 1e-3f);
    TEST_ASSERT_FLOAT_WITHIN(0.02f * a.uncertainty1_m, a.uncertainty1_m, b.uncertainty1_m);
}

static void times_do_not_matter_but_for_their_order(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_begin(&other, &arm, NULL);
    run.begin_us = 17u;
    other.begin_us = 0x123456789abcull;
    run_for(&run, 15.0);
    run_for(&other, 15.0);
    TEST_ASSERT_TRUE(other.joint.ticks.last_us - run.joint.ticks.last_us == other.begin_us - run.begin_us);
    other.joint.ticks.last_us = run.joint.ticks.last_us;
    TEST_ASSERT_EQUAL_MEMORY(&run.joint, &other.joint, sizeof run.joint);
}

static void ticks_that_are_refused_leave_no_trace(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_for(&run, 5.0);
    jcal_tick_t good1;
    jcal_tick_t good2;
    run_make(&run, &good1, &good2);
    const jcal_ball_t before = run.joint;
    static const size_t fields[] = {offsetof(jcal_tick_t, dt_s),          offsetof(jcal_tick_t, turn),
                                    offsetof(jcal_tick_t, rate),          offsetof(jcal_tick_t, lever),
                                    offsetof(jcal_tick_t, velocity),      offsetof(jcal_tick_t, gyr),
                                    offsetof(jcal_tick_t, acc_level_m_s2)};
    static const size_t sizes[] = {1, 9, 9, 9, 3, 3, 1};
    const float bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t f = 0; f < sizeof sizes / sizeof sizes[0]; ++f) {
        for (size_t i = 0; i < sizes[f]; ++i) {
            for (size_t k = 0; k < 6; ++k) {
                jcal_tick_t tick1 = good1;
                jcal_tick_t tick2 = good2;
                unsigned char *const at = (unsigned char *)((k < 3) ? &tick1 : &tick2) + fields[f] + i * sizeof(float);
                memcpy(at, &bad[k % 3], sizeof(float));
                TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_ball_add(&run.joint, &tick1, &tick2));
            }
        }
    }
    jcal_tick_t late = good2;
    late.t_us += 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_ball_add(&run.joint, &good1, &late));
    jcal_tick_t old1 = good1;
    jcal_tick_t old2 = good2;
    old1.t_us = old2.t_us = run.joint.ticks.last_us;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_ball_add(&run.joint, &old1, &old2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_add(NULL, &good1, &good2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_add(&run.joint, NULL, &good2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_add(&run.joint, &good1, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint, sizeof before);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &good1, &good2));
}

/* After a gap the level frames have turned by any angle; levers and the joint stay, and the heading is that of the new frames. */
static void a_gap_with_another_heading_is_survived(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    (void)run_until(&run, JCAL_READY, 12.0);
    run_for(&run, 10.0);
    for (int gap = 0; gap < 4; ++gap) {
        run.epoch += 1u;
        run.next += 100u;
        run.arm.heading += 1.1;
        run_tick(&run);
        TEST_ASSERT_FALSE_MESSAGE(run_result(&run).heading.known, "what was known is of other frames");
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, run_result(&run).head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_WEAK_HEADING, run_result(&run).head.weak);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, run.joint.past.known);
        for (int k = 0; k < 60; ++k) {
            run_tick(&run);
            TEST_ASSERT_TRUE(run_result(&run).head.status != JCAL_MOVED);
            /* The levers are known to 2 % of 0.2 m, which at 3 rad/s is 12 mm/s beside a centre that moves at 0.5 m/s. */
            TEST_ASSERT_TRUE((k < 20) || (run_heading_error(&run) < 0.05));
            const jcal_ball_result_t now = run_result(&run);
            TEST_ASSERT_TRUE(!now.heading.known || run_heading_error(&run) < (double)now.uncertainty_heading_rad);
            TEST_ASSERT_TRUE(run_lever_error(&run, 1) < 0.02);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    }
    run_for(&run,
            12.0); /* the first blocks after the gap are closed, and one is merged: nothing of before pulls at them */
    const jcal_ball_past_t *const past = &run.joint.past;
    TEST_ASSERT_TRUE(past->known > 0.0f);
    TEST_ASSERT_DOUBLE_WITHIN(
        0.01, 0.0,
        remainder(atan2((double)past->heading.im, (double)past->heading.re) - run.arm.heading, 2.0 * MOTION_PI));
}

/* For two seconds after a gap the inclination of a sensor is wrong by degrees: those ticks are left out, whichever sensor began later. After
 * the very first reading they are not. */
static void cold_ticks_are_left_out(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_for(&run, 4.0);
    for (uint32_t epoch = 2u; epoch <= 3u; ++epoch) {
        run.epoch = epoch;
        run_tick(&run); /* cuts */
        const jcal_ball_sums_t before = run.joint.sums;
        const float motion_s = run.joint.motion_s;
        for (int k = 1; k <= 40; ++k) {
            jcal_tick_t tick1;
            jcal_tick_t tick2;
            run_make(&run, &tick1, &tick2);
            (((k + (int)epoch) % 2 == 0) ? &tick1 : &tick2)->since_s = 0.05f * (float)k + 1e-4f;
            TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint.sums, sizeof before);
            TEST_ASSERT_EQUAL_FLOAT(motion_s, run.joint.motion_s);
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &tick1, &tick2));
            ++run.next;
        }
        TEST_ASSERT_TRUE(run.joint.motion_s > motion_s);
        TEST_ASSERT_TRUE(run.joint.sums.motion_s > before.motion_s);
    }
    run_begin(&run, &arm, NULL);
    jcal_tick_t first1;
    jcal_tick_t first2;
    run_make(&run, &first1, &first2);
    first1.since_s = first2.since_s = 0.05f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &first1, &first2));
    TEST_ASSERT_TRUE(run.joint.motion_s > 0.0f);
}

/* At rest nothing is learnt of the heading, and nothing forgotten: noise does not become a heading. But gyroscopes may drift, by 0.25 deg/s, so
   that what was known is not for ever. */
static void rest_forgets_nothing_and_is_less_sure(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    (void)run_until(&run, JCAL_READY, 12.0);
    run_for(&run, 10.0);
    const double t = run_time(&run);
    const float before = run_result(&run).uncertainty_heading_rad;
    for (int k = 0; k < 20 * 600; ++k) {
        jcal_tick_t tick1 = hinge_tick(&run.arm, t, 1, 0u);
        jcal_tick_t tick2 = hinge_tick(&run.arm, t, 2, 0u);
        jcal_tick_t *const both[2] = {&tick1, &tick2};
        for (int i = 0; i < 2; ++i) { /* 2 mrad/s and 2 mm/s, as noise is */
            const int n = 9 * (2 * k + i);
            both[i]->t_us = run.begin_us + (uint64_t)run.next * TICK_US;
            both[i]->epoch = run.epoch;
            memset(both[i]->rate, 0, sizeof both[i]->rate);
            memset(both[i]->lever, 0, sizeof both[i]->lever);
            both[i]->gyr = (jcal_vec3_t){2e-3f * (float)any(n), 2e-3f * (float)any(n + 1), 2e-3f * (float)any(n + 2)};
            both[i]->velocity =
                (jcal_vec3_t){2e-3f * (float)any(n + 3), 2e-3f * (float)any(n + 4), 2e-3f * (float)any(n + 5)};
        }
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &tick1, &tick2));
        run_work(&run);
        ++run.next;
        const jcal_ball_result_t now = run_result(&run);
        TEST_ASSERT_TRUE(!now.heading.known || (run_heading_error(&run) < 0.02));
        if (k == 20 * 30) {
            TEST_ASSERT_EQUAL_INT(JCAL_READY, now.head.status);
            /* 4 s of motion are as old as 5 to 8 s; a new block's heading may be 4 deg from the one before */
            const float drift = now.uncertainty_heading_rad - before;
            TEST_ASSERT_TRUE((drift > 24.0f * 0.25f / 57.3f) && (drift < (28.0f * 0.25f + 4.0f) / 57.3f));
        }
    }
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, run_result(&run).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_HEADING, run_result(&run).head.weak);
    TEST_ASSERT_TRUE(run_lever_error(&run, 1) < 0.02);
    run_for(&run, 8.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    TEST_ASSERT_TRUE(run_heading_error(&run) < 0.02);
}

/* Either sensor alone may begin anew. */
static void a_gap_of_one_sensor_is_one_of_both(void)
{
    const hinge_t arm = arm_usual();
    for (int which = 1; which <= 2; ++which) {
        run_begin(&run, &arm, NULL);
        run_for(&run, 13.0);
        jcal_tick_t tick1;
        jcal_tick_t tick2;
        run_make(&run, &tick1, &tick2);
        tick1.epoch += (which == 1) ? 1u : 0u;
        tick2.epoch += (which == 2) ? 1u : 0u;
        TEST_ASSERT_TRUE(run_result(&run).heading.known && run.joint.sums.block_motion_s[1] > 0.0f);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &tick1, &tick2));
        TEST_ASSERT_FALSE(run_result(&run).heading.known);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, run.joint.sums.block_motion_s[0]);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, run.joint.sums.block_motion_s[1]);
    }
}

/* Pieces too short for a heading, each with another one: none is merged before headings are known. */
static void gaps_before_the_first_estimate_leave_nothing_behind(void)
{
    for (int number = 0; number < 20; ++number) {
        const hinge_t arm = some_arm(number);
        run_begin(&run, &arm, NULL);
        for (int piece = 0; piece < 8; ++piece) {
            run.arm.heading = arm.heading + piece;
            run_for(&run, 0.4);
            TEST_ASSERT_FALSE_MESSAGE(run.joint.has_estimate, "a piece is too short for any");
            run.epoch += 1u;
            TEST_ASSERT_FALSE(run.joint.merged);
        }
        run.arm = arm;
        (void)run_until(&run, JCAL_READY, 15.0);
        run_for(&run, 1.0);
        TEST_ASSERT_TRUE(run_heading_error(&run) < 0.05);
    }
}

/* A sensor that sits elsewhere: noticed within three seconds of motion, and learnt anew. That it was turned about the joint's centre alone
   could not be seen: its lever would be the same. */
static void a_slip_is_noticed_and_learnt(void)
{
    static const double elsewhere[3][3] = {{0.15, -0.10, 0.05}, {-0.04, -0.18, 0.05}, {0.05, 0.04, 0.18}};
    for (int n = 0; n < 3; ++n) {
        const hinge_t arm = arm_usual();
        run_begin(&run, &arm, NULL);
        (void)run_until(&run, JCAL_READY, 12.0);
        while (run_time(&run) < 16.0) {
            run_tick(&run);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
        }
        memcpy(run.arm.r2, elsewhere[n], sizeof run.arm.r2);
        TEST_ASSERT_TRUE(run_until(&run, JCAL_MOVED, 3.0) > 0.0);
        const jcal_ball_result_t moved = run_result(&run);
        TEST_ASSERT_FALSE(moved.has_estimate || moved.heading.known);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, run.joint.sums.motion_s);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, moved.uncertainty_heading_rad);
        TEST_ASSERT_EQUAL_UINT32(run.next, moved.head.samples);
        (void)run_until(&run, JCAL_COLLECTING, 4.0);
        (void)run_until(&run, JCAL_READY, 12.0);
        run_for(&run, 10.0);
        TEST_ASSERT_TRUE(run_heading_error(&run) < 0.02);
        TEST_ASSERT_TRUE(run_lever_error(&run, 2) < 0.01);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    }
}

/* Before the first ready nothing is known well enough to speak of a slip. */
static void before_ready_there_is_no_slip(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_for(&run, 2.5);
    TEST_ASSERT_FALSE(run.joint.was_ready);
    run.joint.track.recent = 49.0f;
    TEST_ASSERT_TRUE(jcal_ball_track_alarm(&run.joint.track));
    run_tick(&run);
    TEST_ASSERT_TRUE(run_result(&run).head.status != JCAL_MOVED);
    (void)run_until(&run, JCAL_READY, 12.0);
    TEST_ASSERT_TRUE(run.joint.was_ready);
    run.joint.track.recent = 49.0f;
    run_tick(&run);
    TEST_ASSERT_EQUAL_INT(JCAL_MOVED, run_result(&run).head.status);
}

/* A gyroscope whose bias is not quite known yet. The heading of the moment lags behind by its memory. */
static void a_heading_that_drifts_is_followed(void)
{
    for (int number = 0; number < 10; ++number) {
        hinge_t arm = some_arm(number);
        arm.drift_rad_s = 0.1 * HINGE_DEG;
        run_begin(&run, &arm, NULL);
        (void)run_until(&run, JCAL_READY, 15.0);
        for (int k = 0; k < 20 * 25; ++k) {
            run_tick(&run);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
        }
        TEST_ASSERT_TRUE(run_heading_error(&run) < 10.0 * arm.drift_rad_s + 0.01);
    }
}

/* Where the heading drifts, a start that is tried leaves a little less again and again. It is no other joint. */
static void a_start_that_leaves_a_little_less_does_not_end_ready(void)
{
    static const int numbers[] = {1, 4};
    for (size_t n = 0; n < sizeof numbers / sizeof numbers[0]; ++n) {
        hinge_t arm = some_arm(numbers[n]);
        arm.drift_rad_s = 0.5 * HINGE_DEG;
        run_begin(&run, &arm, NULL);
        (void)run_until(&run, JCAL_READY, 15.0);
        const jcal_ball_t was = run.joint;
        while (run_time(&run) < 12.0) {
            run_tick(&run);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
        }
        TEST_ASSERT_TRUE_MESSAGE(run.joint.tried > was.tried + 3u, "nothing was tried");
    }
}

static void the_relative_orientation_is_that_of_the_joint(void)
{
    hinge_t arm = some_arm(3);
    run_begin(&run, &arm, NULL);
    const jcal_quat_t one = jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
    TEST_ASSERT_TRUE(isnan(jcal_ball_relative(&run.joint, one, one).w));
    TEST_ASSERT_TRUE(isnan(jcal_ball_relative(NULL, one, one).z));
    run_for(&run, 20.0);
    for (int k = 0; k < 40; ++k) {
        const double t = 0.37 * k;
        const jcal_quat_t found = jcal_ball_relative(&run.joint, hinge_quat(&arm, t, 1), hinge_quat(&arm, t, 2));
        double turn1[9];
        double turn2[9];
        double ignored[3];
        double truth[9];
        double relative[9];
        hinge_pose(&arm, t, turn1, turn2, ignored);
        mat_transpose(turn1, turn1);
        mat_mul(turn1, turn2, truth);
        mat_of(found, relative);
        TEST_ASSERT_TRUE(mat_angle_between(truth, relative) < run_heading_error(&run) + 1e-3);
    }
    /* on both sides of half a turn, where half the heading changes its sign */
    for (int k = -1; k <= 1; k += 2) {
        run.joint.track.heading = (jcal_plane_t){-cosf(0.1f), (float)k * sinf(0.1f)};
        const jcal_quat_t q = jcal_ball_relative(&run.joint, one, one);
        double relative[9];
        mat_of(q, relative);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, -cos(0.1), relative[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, k * sin(0.1), relative[3]);
    }
}

/* A tick of sensor 1 of `run`, and one of sensor 2 of a body that has nothing to do with it. */
static void tick_beside(const hinge_t *stranger)
{
    jcal_tick_t tick1;
    jcal_tick_t tick2;
    run_make(&run, &tick1, &tick2);
    tick2 = hinge_tick(stranger, run_time(&run), 2, tick1.t_us);
    tick2.epoch = run.epoch;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &tick1, &tick2));
    run_work(&run);
    ++run.next;
}

/* Two sensors of two bodies that have nothing to do with each other; and two on one body. */
static void what_is_no_joint_is_never_ready(void)
{
    for (int number = 0; number < 6; ++number) {
        const hinge_t arm = some_arm(number);
        hinge_t stranger = some_arm(number + 20);
        stranger.rest_s = -7.0;
        run_begin(&run, &arm, NULL);
        for (int k = 0; k < 20 * 40; ++k) {
            tick_beside(&stranger);
            TEST_ASSERT_TRUE(run_result(&run).head.status != JCAL_READY);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, run_result(&run).head.reason);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, run_result(&run).uncertainty_heading_rad);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, run_result(&run).uncertainty2_m);
    }
    hinge_t one_body = arm_usual();
    one_body.swing = one_body.twist = one_body.side = 0.0;
    run_begin(&run, &one_body, NULL);
    for (int k = 0; k < 20 * 40; ++k) {
        run_tick(&run);
        TEST_ASSERT_TRUE(run_result(&run).head.status != JCAL_READY);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_BEND, run_result(&run).head.reason);
}

/* Sensors that were carried about before they were put on: what came before does not stand in the way. */
static void a_joint_is_found_after_what_was_none(void)
{
    for (int number = 0; number < 4; ++number) {
        const hinge_t arm = some_arm(number);
        hinge_t stranger = some_arm(number + 20);
        stranger.rest_s = -7.0;
        run_begin(&run, &arm, NULL);
        for (int k = 0; k < 20 * 30; ++k) {
            tick_beside(&stranger);
        }
        TEST_ASSERT_TRUE(run_until(&run, JCAL_READY, 40.0) < 30.0);
        TEST_ASSERT_TRUE(run_heading_error(&run) < (double)run_result(&run).uncertainty_heading_rad);
    }
}

/* Gravity that one accelerometer shows wrongly. */
static void a_wrong_gravity_is_told(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    for (int k = 0; k < 20 * 10; ++k) {
        jcal_tick_t tick1;
        jcal_tick_t tick2;
        run_make(&run, &tick1, &tick2);
        tick2.acc_level_m_s2 = 9.0f;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &tick1, &tick2));
        run_work(&run);
        ++run.next;
    }
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_GRAVITY_OFF, run_result(&run).head.reason);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.81f, run_result(&run).gravity_off_m_s2);
}

/* 60 s of motion at most once ready, 20 s before; a block of 5 s more until one closes. */
static void memory_is_bounded(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    float largest = 0.0f;
    float last = 0.0f;
    int halved = 0;
    for (int k = 0; k < 20 * 130; ++k) {
        run_tick(&run);
        const float now = run.joint.sums.motion_s;
        halved += (now < last) ? 1 : 0;
        TEST_ASSERT_TRUE((now >= last) || ((last > 60.0f) && (fabsf(now - 0.5f * last) < 0.1f)));
        largest = (now > largest) ? now : largest;
        last = now;
    }
    TEST_ASSERT_TRUE((largest > 59.0f) && (largest < 66.0f));
    TEST_ASSERT_EQUAL_INT(2, halved);
    TEST_ASSERT_TRUE(run_heading_error(&run) < 0.01);
    hinge_t stranger = some_arm(2); /* no joint: never ready */
    stranger.rest_s = -7.0;
    run_begin(&run, &arm, NULL);
    for (int k = 0; k < 20 * 60; ++k) {
        tick_beside(&stranger);
        TEST_ASSERT_TRUE(run_result(&run).head.status != JCAL_READY);
        TEST_ASSERT_TRUE(run.joint.sums.motion_s < 26.0f);
    }
}

/* What is halved is everything but the age of the block; what it is good for stays. */
static void halved_sums_say_the_same(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_for(&run, 13.0);
    jcal_ball_sums_t half = run.joint.sums;
    jcal_ball_sums_fade(&half, 0.5f);
    const float *const a = (const float *)&run.joint.sums;
    const float *const b = (const float *)&half;
    const size_t age = offsetof(jcal_ball_sums_t, block_time_s) / sizeof(float);
    for (size_t i = 0; i < sizeof half / sizeof(float); ++i) {
        TEST_ASSERT_EQUAL_FLOAT((i == age) ? a[i] : (0.5f * a[i]), b[i]);
    }
    TEST_ASSERT_EQUAL_FLOAT(jcal_ball_sums_stiffness(&run.joint.sums), jcal_ball_sums_stiffness(&half));
}

/* While no block is merged another heading is tried with every judgement, and taken if it leaves less. */
static void a_wrong_start_is_left_again(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&run, &arm, NULL);
    run_for(&run, 6.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    TEST_ASSERT_FALSE(run.joint.merged);
    jcal_ball_turn(&run.joint.point, 4u); /* the worst one */
    run.joint.point.size = 1.0f;
    run.joint.slice = 4u; /* where a trial begins */
    run.joint.turn = 4u;
    bool was_lost = false;
    for (int k = 0; k < 40; ++k) {
        run_tick(&run);
        const jcal_ball_result_t result = run_result(&run);
        was_lost = was_lost || (result.head.status != JCAL_READY);
        TEST_ASSERT_EQUAL_INT(result.head.status == JCAL_READY, result.head.reason == JCAL_REASON_NONE);
    }
    TEST_ASSERT_TRUE_MESSAGE(was_lost, "another estimate has to be judged three times");
    (void)run_until(&run, JCAL_READY, 3.0);
    TEST_ASSERT_TRUE(run_heading_error(&run) < 0.05);
}

static void starts_are_eighths_of_a_turn(void)
{
    for (unsigned number = 0; number < 16u; ++number) {
        jcal_ball_point_t point;
        memset(&point, 0, sizeof point);
        point.heading[0] = (jcal_plane_t){0.6f, 0.8f};
        point.heading[1] = (jcal_plane_t){-0.8f, 0.6f};
        jcal_ball_turn(&point, number);
        for (int b = 0; b < 2; ++b) {
            const double before = (b == 0) ? atan2(0.8, 0.6) : atan2(0.6, -0.8);
            const double expected = before + 0.25 * MOTION_PI * number;
            TEST_ASSERT_DOUBLE_WITHIN(2e-7, cos(expected), (double)point.heading[b].re);
            TEST_ASSERT_DOUBLE_WITHIN(2e-7, sin(expected), (double)point.heading[b].im);
        }
    }
    jcal_ball_past_t past = {{1.0f, 0.0f}, 0.0f};
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_ball_past_pull(&past)); /* nothing is known */
}

/* So many slices a second as are paid for, a quarter once ready, and few saved up. */
static void work_is_bounded(void)
{
    const hinge_t arm = arm_usual();
    static const float slices[2] = {40.0f, 100.0f};
    for (int n = 0; n < 2; ++n) {
        jcal_ball_config_t config = jcal_ball_config_default();
        config.slices_per_s = slices[n];
        run_begin(&run, &arm, &config);
        TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_ball_step(&run.joint));
        const double until_s = run_until(&run, JCAL_READY, 20.0);
        TEST_ASSERT_TRUE((double)run.slices <= (double)slices[n] * until_s + 8.0);
        TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_ball_step(&run.joint)); /* the rest is not paid for, or nothing is due */
        run.slices = 0u;
        run_for(&run, 30.0);
        TEST_ASSERT_TRUE((double)run.slices <= 0.25 * (double)slices[n] * 30.0 + 8.0);
        TEST_ASSERT_TRUE(run.slices > 30u); /* a judgement a second takes several */
    }
    for (int ready = 0; ready < 2; ++ready) { /* what a tick of 50 ms pays for */
        jcal_tick_t tick1;
        jcal_tick_t tick2;
        run.joint.verdict.status = (uint8_t)((ready == 1) ? JCAL_READY : JCAL_COLLECTING);
        run.joint.credit = 0.0f;
        run_make(&run, &tick1, &tick2);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &tick1, &tick2));
        TEST_ASSERT_EQUAL_FLOAT((ready == 1) ? 1.25f : 5.0f, run.joint.credit);
        ++run.next;
    }
    run_begin(&run, &arm, NULL);
    for (int k = 0; k < 100; ++k) { /* nobody works meanwhile */
        jcal_tick_t tick1;
        jcal_tick_t tick2;
        run_make(&run, &tick1, &tick2);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run.joint, &tick1, &tick2));
        ++run.next;
    }
    run_work(&run);
    TEST_ASSERT_EQUAL_UINT32(8u, run.slices);
}

static void the_state_has_its_size(void)
{
    TEST_ASSERT_TRUE(sizeof(jcal_ball_t) <= 1536u);
}

static void settings_have_ranges(void)
{
    const jcal_ball_config_t usual = jcal_ball_config_default();
    TEST_ASSERT_NULL(jcal_ball_config_check(&usual));
    TEST_ASSERT_EQUAL_STRING("config", jcal_ball_config_check(NULL));
    static const char *const names[] = {"max_heading_rad", "max_lever_m", "slices_per_s"};
    static const float least[] = {0.01f, 0.001f, 20.0f};
    static const float most[] = {1.0f, 1.0f, 800.0f};
    for (int n = 0; n < 3; ++n) {
        const float wrong[] = {0.99f * least[n], 1.01f * most[n], -1.0f, 0.0f, NAN, INFINITY};
        for (int k = -2; k < 6; ++k) {
            jcal_ball_config_t config = usual;
            float *const field =
                (n == 0) ? &config.max_heading_rad : ((n == 1) ? &config.max_lever_m : &config.slices_per_s);
            *field = (k == -2) ? least[n] : ((k == -1) ? most[n] : wrong[k]);
            if (k < 0) {
                TEST_ASSERT_NULL(jcal_ball_config_check(&config));
                continue;
            }
            TEST_ASSERT_EQUAL_STRING(names[n], jcal_ball_config_check(&config));
            memset(&run.joint, 0x5a, sizeof run.joint);
            const jcal_ball_t before = run.joint;
            TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_ball_init(&run.joint, &config));
            TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint, sizeof before);
        }
    }
}

static void null_is_an_error(void)
{
    const jcal_ball_config_t config = jcal_ball_config_default();
    jcal_ball_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_init(&run.joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_init(&run.joint, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_get(NULL, &result));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_get(&run.joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_ball_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_ball_step(&run.joint));
}

static void reset_is_a_new_beginning(void)
{
    const hinge_t arm = arm_usual();
    run_begin(&other, &arm, NULL);
    run_for(&other, 7.0);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_reset(&other.joint));
    run_begin(&run, &arm, NULL);
    TEST_ASSERT_EQUAL_MEMORY(&run.joint, &other.joint, sizeof run.joint);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_exact_joint_is_found);
    RUN_TEST(nothing_ready_is_beyond_its_bounds);
    RUN_TEST(sensors_may_be_exchanged);
    RUN_TEST(a_mirrored_joint_is_mirrored);
    RUN_TEST(another_level_frame_turns_only_the_heading);
    RUN_TEST(times_do_not_matter_but_for_their_order);
    RUN_TEST(ticks_that_are_refused_leave_no_trace);
    RUN_TEST(a_gap_with_another_heading_is_survived);
    RUN_TEST(cold_ticks_are_left_out);
    RUN_TEST(rest_forgets_nothing_and_is_less_sure);
    RUN_TEST(a_gap_of_one_sensor_is_one_of_both);
    RUN_TEST(gaps_before_the_first_estimate_leave_nothing_behind);
    RUN_TEST(a_slip_is_noticed_and_learnt);
    RUN_TEST(before_ready_there_is_no_slip);
    RUN_TEST(a_heading_that_drifts_is_followed);
    RUN_TEST(a_start_that_leaves_a_little_less_does_not_end_ready);
    RUN_TEST(the_relative_orientation_is_that_of_the_joint);
    RUN_TEST(what_is_no_joint_is_never_ready);
    RUN_TEST(a_joint_is_found_after_what_was_none);
    RUN_TEST(a_wrong_gravity_is_told);
    RUN_TEST(memory_is_bounded);
    RUN_TEST(halved_sums_say_the_same);
    RUN_TEST(a_wrong_start_is_left_again);
    RUN_TEST(starts_are_eighths_of_a_turn);
    RUN_TEST(work_is_bounded);
    RUN_TEST(the_state_has_its_size);
    RUN_TEST(settings_have_ranges);
    RUN_TEST(null_is_an_error);
    RUN_TEST(reset_is_a_new_beginning);
    return UNITY_END();
}
