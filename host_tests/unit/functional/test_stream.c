/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/functional.h: what an exact hinge that is made up gives, what is refused, gaps, slips, memory, the angle.
#include "functional/headings.h"
#include "functional/model.h"
#include "functional/rival.h"
#include "functional/sums.h"
#include "functional/track.h"
#include "levers/levers.h"
#include "unit/functional/fixture.h"

#include <stddef.h>
#include <string.h>

/* Hinges of a test that tries many. On an emulated target the made-up motion is what takes time; few show that the code is the same. */
#ifdef JCAL_TEST_SHORT
enum { EXACT = 2, BOUNDED = 3, READY = 4 };
#else
enum { EXACT = 10, BOUNDED = 30, READY = 60 };
#endif

static run_t run;
static run_t other;

void setUp(void)
{
}

void tearDown(void)
{
}

/// The part of `v` across `j`.
static double across(jcal_vec3_t v, jcal_vec3_t j)
{
    return (double)jcal_vec3_norm(jcal_vec3_cross(v, j));
}

/// A number in [-1, 1] that is another one for each n.
static double any(int n)
{
    uint32_t x = 2654435761u * ((uint32_t)n + 12345u);
    x ^= x >> 15;
    x *= 2246822519u;
    x ^= x >> 13;
    return (double)(x >> 8) / 8388607.5 - 1.0;
}

/// Hinges that differ in everything: mounts, levers, heading, pace, how much the segments turn and the centre moves.
static hinge_t some_hinge(int number)
{
    hinge_t h = hinge_usual();
    const int n = 16 * number;
    const double turn1[3] = {2.0 * any(n), 2.0 * any(n + 1), 2.0 * any(n + 2)};
    const double turn2[3] = {2.0 * any(n + 3), 2.0 * any(n + 4), 2.0 * any(n + 5)};
    mat_turn(turn1, h.mount1);
    mat_turn(turn2, h.mount2);
    for (int i = 0; i < 3; ++i) {
        h.r1[i] = 0.2 * any(n + 6 + i);
        h.r2[i] = 0.2 * any(n + 9 + i);
    }
    h.heading = 3.0 * any(n + 12);
    h.pace = pow(2.0, any(n + 13));
    h.turn = pow(2.0, any(n + 14));
    h.lift = pow(2.0, any(n + 15));
    return h;
}

static void an_exact_hinge_is_found(void)
{
    for (int number = 0; number < EXACT; ++number) {
        const hinge_t hinge = some_hinge(number);
        run_begin(&run, &hinge, NULL);
        TEST_ASSERT_FALSE(run_result(&run).has_axes);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, run_result(&run).head.reason);
        const double took_s = run_until(&run, JCAL_READY, 12.0);
        TEST_ASSERT_TRUE_MESSAGE(took_s > 3.0, "three seconds of motion are asked for");
        const jcal_functional_result_t first = run_result(&run);
        TEST_ASSERT_TRUE(first.for_axes && first.for_flexion);
        TEST_ASSERT_TRUE(axes_error_deg(&run) <
                         (double)jcal_min(first.uncertainty1_rad, first.uncertainty2_rad) / HINGE_DEG);
        run_for(&run, 15.0);
        const jcal_functional_result_t result = run_result(&run);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, result.head.status);
        TEST_ASSERT_TRUE(axes_error_deg(&run) < 0.1);
        /* Along the axis a hinge's centre is open. Across it the ridge, 1/200 of the mean of what the rates make of all
         * directions, shortens one that they make little of: 4 % where that is an eighth of the mean. */
        const jcal_vec3_t off1 = jcal_vec3_sub(result.joint_to_sensor1_m, to_vec3(hinge.r1));
        const jcal_vec3_t off2 = jcal_vec3_sub(result.joint_to_sensor2_m, to_vec3(hinge.r2));
        TEST_ASSERT_TRUE(across(off1, result.axis1) < 0.04 * (double)jcal_vec3_norm(to_vec3(hinge.r1)));
        TEST_ASSERT_TRUE(across(off2, result.axis2) < 0.04 * (double)jcal_vec3_norm(to_vec3(hinge.r2)));
        TEST_ASSERT_TRUE(result.heading.known);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0,
                                  remainder((double)result.heading.heading_rad - hinge.heading, 2.0 * MOTION_PI));
    }
}

/* Every judgement that is ready has both axes within their bounds, from the first on; nearly plane motion is the hard case. */
static void nothing_ready_is_beyond_its_bounds(void)
{
    for (int k = 0; k <= BOUNDED; ++k) {
        const int number = (k < BOUNDED) ? k : 179; /* the last one is nearly plane at first */
        const hinge_t hinge = some_hinge(number);
        run_begin(&run, &hinge, NULL);
        run.next = (uint32_t)(37 * number);
        for (int tick = 0; tick < 240; ++tick) {
            run_tick(&run);
            const jcal_functional_result_t result = run_result(&run);
            const float bound = jcal_max(result.uncertainty1_rad, result.uncertainty2_rad);
            TEST_ASSERT_TRUE((result.head.status != JCAL_READY) || (axes_error_deg(&run) < (double)bound / HINGE_DEG));
        }
        TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    }
}

static void sensors_may_be_exchanged(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_begin(&other, &hinge, NULL);
    other.exchanged = true;
    run_for(&run, 12.0);
    run_for(&other, 12.0);
    const jcal_functional_result_t a = run_result(&run);
    const jcal_functional_result_t b = run_result(&other);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, b.head.status);
    const float sign = (jcal_vec3_dot(a.axis1, b.axis2) < 0.0f) ? -1.0f : 1.0f;
    TEST_ASSERT_TRUE(jcal_sphere_angle(a.axis1, jcal_vec3_scale(b.axis2, sign)) < 1e-3f);
    TEST_ASSERT_TRUE(jcal_sphere_angle(a.axis2, jcal_vec3_scale(b.axis1, sign)) < 1e-3f);
    TEST_ASSERT_FLOAT_WITHIN(0.03f * a.uncertainty1_rad, a.uncertainty1_rad, b.uncertainty2_rad);
    TEST_ASSERT_FLOAT_WITHIN(0.03f * a.uncertainty2_rad, a.uncertainty2_rad, b.uncertainty1_rad);
    TEST_ASSERT_FLOAT_WITHIN(5e-4f, run.joint.point.heading[0].re, other.joint.point.heading[0].re);
    TEST_ASSERT_FLOAT_WITHIN(5e-4f, run.joint.point.heading[0].im, -other.joint.point.heading[0].im);
    /* the heading of this moment still knows a little of the first estimates, 12 s ago */
    TEST_ASSERT_DOUBLE_WITHIN(5e-3, 0.0,
                              remainder((double)(a.heading.heading_rad + b.heading.heading_rad), 2.0 * MOTION_PI));
    TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(a.joint_to_sensor1_m, b.joint_to_sensor2_m)) < 1e-3f);
}

static void times_do_not_matter_but_for_their_order(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_begin(&other, &hinge, NULL);
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
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 5.0);
    jcal_tick_t good1;
    jcal_tick_t good2;
    run_make(&run, &good1, &good2);
    const jcal_functional_t before = run.joint;
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
                TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_add(&run.joint, &tick1, &tick2));
            }
        }
    }
    jcal_tick_t late = good2;
    late.t_us += 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_add(&run.joint, &good1, &late));
    jcal_tick_t old1 = good1;
    jcal_tick_t old2 = good2;
    old1.t_us = old2.t_us = run.joint.ticks.last_us;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_add(&run.joint, &old1, &old2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_add(NULL, &good1, &good2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_add(&run.joint, NULL, &good2));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_add(&run.joint, &good1, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint, sizeof before);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run.joint, &good1, &good2));
}

/* After a gap the level frames have turned; the joint goes on. */
static void a_gap_with_another_heading_is_survived(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    (void)run_until(&run, JCAL_READY, 10.0);
    run_for(&run, 2.0);
    for (int gap = 0; gap < 4; ++gap) {
        run.epoch += 1u;
        run.next += 100u;
        run.hinge.heading += 0.2;
        for (int k = 0; k < 60; ++k) {
            run_tick(&run);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
            TEST_ASSERT_TRUE(axes_error_deg(&run) < 0.7);
        }
        TEST_ASSERT_DOUBLE_WITHIN(
            0.06, 0.0, remainder((double)run_result(&run).heading.heading_rad - run.hinge.heading, 2.0 * MOTION_PI));
    }
}

/* For two seconds after a gap the inclination of a sensor is wrong by degrees: those ticks are left out, whichever sensor began later. After
 * the very first reading they are not. */
static void cold_ticks_are_left_out(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 4.0);
    for (uint32_t epoch = 2u; epoch <= 3u; ++epoch) {
        run.epoch = epoch;
        run_tick(&run); /* cuts */
        const jcal_functional_sums_t before = run.joint.sums;
        const float motion_s = run.joint.motion_s;
        for (int k = 1; k <= 40; ++k) {
            jcal_tick_t tick1;
            jcal_tick_t tick2;
            run_make(&run, &tick1, &tick2);
            (((k + (int)epoch) % 2 == 0) ? &tick1 : &tick2)->since_s = 0.05f * (float)k + 1e-4f;
            TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint.sums, sizeof before);
            TEST_ASSERT_EQUAL_FLOAT(motion_s, run.joint.motion_s);
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run.joint, &tick1, &tick2));
            ++run.next;
        }
        TEST_ASSERT_TRUE(run.joint.motion_s > motion_s);
        TEST_ASSERT_TRUE(run.joint.sums.motion_s > before.motion_s);
    }
    run_begin(&run, &hinge, NULL);
    jcal_tick_t first1;
    jcal_tick_t first2;
    run_make(&run, &first1, &first2);
    first1.since_s = first2.since_s = 0.05f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run.joint, &first1, &first2));
    TEST_ASSERT_TRUE(run.joint.motion_s > 0.0f);
}

/* Pieces too short for a heading, each with another one: none is merged before headings are known. */
static void gaps_before_the_first_estimate_leave_nothing_behind(void)
{
    for (int number = 0; number < 20; ++number) {
        const hinge_t hinge = some_hinge(number);
        run_begin(&run, &hinge, NULL);
        for (int piece = 0; piece < 8; ++piece) {
            run.hinge.heading = hinge.heading + piece;
            run_for(&run, 0.4);
            run.epoch += 1u;
        }
        run.hinge = hinge;
        (void)run_until(&run, JCAL_READY, 12.0);
        run_for(&run, 1.0);
        TEST_ASSERT_TRUE(axes_error_deg(&run) < 2.0);
    }
}

static void headings_of_merged_blocks_turn_back_when_reversed_twice(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 17.0);
    jcal_functional_sums_t sums = run.joint.sums;
    TEST_ASSERT_TRUE(fabsf(sums.old_turn[0]) > 0.1f);
    jcal_functional_sums_reverse(&sums);
    for (int i = 0; i < 9; ++i) {
        TEST_ASSERT_TRUE(sums.old_turn[i] == -run.joint.sums.old_turn[i]);
        TEST_ASSERT_TRUE(sums.old_rate[i] == -run.joint.sums.old_rate[i]);
    }
    const jcal_functional_sums_t once = sums;
    jcal_functional_sums_reverse(&sums);
    for (int i = 0; i < 9;
         ++i) { /* relative turns are lost: level ones stand in for them, to 77 roundings of sums of this size */
        TEST_ASSERT_FLOAT_WITHIN(0.02f * run.joint.sums.rate2, run.joint.sums.rate_free[i], sums.rate_free[i]);
    }
    jcal_functional_sums_reverse(&sums);
    TEST_ASSERT_EQUAL_MEMORY(&once, &sums, sizeof sums);
    jcal_functional_sums_reverse(&sums);
    memcpy(sums.rate_free, run.joint.sums.rate_free, sizeof sums.rate_free);
    TEST_ASSERT_EQUAL_MEMORY(&run.joint.sums, &sums, sizeof sums);
}

/* With the joint's centre almost at rest and levers along the axis nothing tells the pairing; a hint does. At rest altogether nothing tells
   that there is one joint, and no hint helps. */
static void a_hint_settles_the_pairing(void)
{
    hinge_t hinge = hinge_usual();
    hinge.lift = 0.1;
    memset(hinge.r1, 0, sizeof hinge.r1);
    memset(hinge.r2, 0, sizeof hinge.r2);
    run_begin(&run, &hinge, NULL);
    run_for(&run, 12.0);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_FASTER, run_result(&run).head.hint);
    TEST_ASSERT_EQUAL_INT(JCAL_AMBIGUOUS, run_result(&run).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SIGN_OPEN, run_result(&run).head.reason);
    const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
    const jcal_vec3_t true2 = hinge_axis(&hinge, 2, 0.0);
    const bool same = (jcal_sign_main(true1) * jcal_sign_main(true2)) > 0.0f;
    jcal_functional_config_t config = jcal_functional_config_default();
    config.sign_hint = same ? JCAL_SIGN_SAME : JCAL_SIGN_OPPOSITE;
    run_begin(&run, &hinge, &config);
    (void)run_until(&run, JCAL_READY, 12.0);
    TEST_ASSERT_TRUE(axes_error_deg(&run) < 0.5);
    hinge.lift = 0.0;
    run_begin(&run, &hinge, &config);
    run_for(&run, 12.0);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SIGN_OPEN, run_result(&run).head.reason);
}

/* A hint that the data contradict is never ready. */
static void a_wrong_hint_is_contradicted(void)
{
    const hinge_t hinge = hinge_usual();
    const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
    const jcal_vec3_t true2 = hinge_axis(&hinge, 2, 0.0);
    const bool same = (jcal_sign_main(true1) * jcal_sign_main(true2)) > 0.0f;
    jcal_functional_config_t config = jcal_functional_config_default();
    config.sign_hint = same ? JCAL_SIGN_OPPOSITE : JCAL_SIGN_SAME;
    run_begin(&run, &hinge, &config);
    for (int k = 0; k < 400; ++k) {
        run_tick(&run);
        TEST_ASSERT_TRUE(run_result(&run).head.status != JCAL_READY);
    }
}

/* A sensor that is turned by 30 deg: noticed within three seconds of motion, and learnt anew; one after the other, these statuses. */
static void a_slip_is_noticed_and_learnt(void)
{
    static const double about[3][3] = {{1.0, 0.0, 0.0}, {0.0, 0.6, 0.8}, {0.7, -0.7, 0.1}};
    for (int n = 0; n < 3; ++n) {
        hinge_t hinge = hinge_usual();
        hinge.slip_s = 12.0;
        for (int i = 0; i < 3; ++i) {
            hinge.slip[i] = 30.0 * HINGE_DEG * about[n][i];
        }
        run_begin(&run, &hinge, NULL);
        (void)run_until(&run, JCAL_READY, 10.0);
        while (run_time(&run) < 12.0) {
            run_tick(&run);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
        }
        TEST_ASSERT_TRUE(run_until(&run, JCAL_MOVED, 3.0) > 0.0);
        TEST_ASSERT_FALSE(run_result(&run).has_axes);
        TEST_ASSERT_FALSE(run_result(&run).heading.known);
        TEST_ASSERT_TRUE(isnan(run_flexion(&run)));
        (void)run_until(&run, JCAL_COLLECTING, 4.0);
        (void)run_until(&run, JCAL_READY, 10.0);
        TEST_ASSERT_TRUE(axes_error_deg(&run) < 1.0);
        for (int k = 0; k < 300; ++k) {
            run_tick(&run);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
        }
    }
}

/* A gyroscope whose bias is not known yet: the heading lags behind, half a degree a second is no slip. */
static void a_heading_that_drifts_is_no_slip(void)
{
    for (int number = 0; number < 20; ++number) {
        hinge_t hinge = some_hinge(number);
        hinge.drift_rad_s = 0.01;
        run_begin(&run, &hinge, NULL);
        (void)run_until(&run, JCAL_READY, 15.0);
        for (int k = 0; k < 20 * 25; ++k) {
            run_tick(&run);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
        }
        TEST_ASSERT_TRUE(axes_error_deg(&run) < 1.0);
    }
}

/* What estimates before the first ready left is no sign of a slip. */
static void ready_is_no_slip(void)
{
    for (int number = 0; number < READY; ++number) {
        const hinge_t hinge = some_hinge(number);
        run_begin(&run, &hinge, NULL);
        run.next = (uint32_t)(53 * number);
        (void)run_until(&run, JCAL_READY, 15.0);
        TEST_ASSERT_TRUE((run.joint.kept_sign[0] != 0) && (run.joint.kept_sign[1] != 0));
        for (int k = 0; k < 60; ++k) {
            run_tick(&run);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
        }
    }
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 2.5);
    TEST_ASSERT_EQUAL_INT(0, run.joint.kept_sign[0]);
    TEST_ASSERT_EQUAL_INT(0, run.joint.kept_sign[1]);
    for (int f = 0; f < 3; ++f) { /* as if another estimate had been wrong until now */
        run.joint.track.recent[f] = 50.0f;
    }
    (void)run_until(&run, JCAL_READY, 5.0);
    run_for(&run, 1.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
}

static void what_the_last_seconds_said_goes_with_the_estimate(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 6.0);
    for (int f = 0; f < 3; ++f) {
        run.joint.track.recent[f] = 50.0f;
    }
    TEST_ASSERT_TRUE(jcal_functional_track_alarm(&run.joint.track));
    const jcal_functional_t was = run.joint;
    jcal_functional_track_begin(&run.joint);
    TEST_ASSERT_FALSE(jcal_functional_track_alarm(&run.joint.track));
    run.joint = was;
    jcal_functional_track_clear(&run.joint);
    TEST_ASSERT_FALSE(jcal_functional_track_alarm(&run.joint.track));
}

static void expect_half_turned(const float *was, const float *up, const float *now, size_t n, float tolerance)
{
    for (size_t i = 0; i < n; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(tolerance, 2.0f * up[i] - was[i], now[i]);
    }
}

/* The other pairing is all headings turned by half a turn, merged ones too; an estimate that has it goes back. */
static void a_wrong_pairing_is_turned_back_with_what_was_merged(void)
{
    for (int number = 0; number < 6; ++number) {
        const hinge_t hinge = some_hinge(number);
        run_begin(&run, &hinge, NULL);
        run_for(&run, 18.0);
        jcal_functional_t *const joint = &run.joint;
        TEST_ASSERT_TRUE(joint->merged);
        float was[34];
        float now[34];
        jcal_functional_cross_turn(&joint->sums, &joint->point, was);
        jcal_functional_cross_level(&joint->sums, &joint->point, &was[9]);
        jcal_levers_cross(&joint->sums.levers, joint->point.heading, &was[18]);
        joint->search.trial = joint->point;
        joint->search.trial.j2 = jcal_vec3_scale(joint->point.j2, -1.0f);
        jcal_functional_turn_round(joint);
        jcal_functional_cross_turn(&joint->sums, &joint->point, now);
        jcal_functional_cross_level(&joint->sums, &joint->point, &now[9]);
        jcal_levers_cross(&joint->sums.levers, joint->point.heading, &now[18]);
        const float rounding = 1e-5f;
        expect_half_turned(was, joint->sums.turn_up, now, 9, rounding * joint->sums.motion_s);
        expect_half_turned(&was[9], joint->sums.rate_up, &now[9], 9, rounding * joint->sums.rate2);
        expect_half_turned(&was[18], joint->sums.levers.up, &now[18], 16,
                           rounding * (joint->sums.levers.own1[9] + joint->sums.levers.own2[9]) * 10.0f);
        TEST_ASSERT_TRUE(axes_error_deg(&run) > 150.0);
        run_for(&run, 6.0); /* it turns back, or what it leaves is taken for a slip and all is learnt anew */
        TEST_ASSERT_TRUE(axes_error_deg(&run) < 1.0);
    }
}

/* 60 s of motion at most once ready, 20 s before; a block of 5 s more until one closes. */
static void memory_is_bounded(void)
{
    hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    float largest = 0.0f;
    float last = 0.0f;
    int halved = 0;
    for (int k = 0; k < 20 * 130; ++k) {
        run_tick(&run);
        const float now = run.joint.sums.motion_s;
        halved += (now < last) ? 1 : 0;
        TEST_ASSERT_TRUE((now >= last) || ((last > 60.0f) && (fabsf(now - 0.5f * last) < 0.1f)));
        largest = jcal_max(largest, now);
        last = now;
    }
    TEST_ASSERT_TRUE((largest > 59.0f) && (largest < 65.0f));
    TEST_ASSERT_EQUAL_INT(2, halved);
    TEST_ASSERT_TRUE(axes_error_deg(&run) < 0.1);
    hinge.skin_rad = 0.6; /* no hinge: never ready */
    run_begin(&run, &hinge, NULL);
    for (int k = 0; k < 20 * 60; ++k) {
        run_tick(&run);
        TEST_ASSERT_TRUE(run_result(&run).head.status != JCAL_READY);
        TEST_ASSERT_TRUE(run.joint.sums.motion_s < 25.5f);
    }
}

static void the_state_has_its_size(void)
{
    TEST_ASSERT_TRUE(sizeof(jcal_functional_t) <= 3072u);
}

static void settings_have_ranges(void)
{
    const jcal_functional_config_t usual = jcal_functional_config_default();
    TEST_ASSERT_NULL(jcal_functional_config_check(&usual));
    TEST_ASSERT_EQUAL_STRING("config", jcal_functional_config_check(NULL));
    static const char *const names[] = {"max_bound_rad", "max_flexion_rad", "slices_per_s"};
    static const float least[] = {0.001f, 0.001f, 20.0f};
    static const float most[] = {0.5f, 0.5f, 800.0f};
    for (int n = 0; n < 3; ++n) {
        const float wrong[] = {0.99f * least[n], 1.01f * most[n], -1.0f, 0.0f, NAN, INFINITY};
        for (int k = -2; k < 6; ++k) {
            jcal_functional_config_t config = usual;
            float *const field =
                (n == 0) ? &config.max_bound_rad : ((n == 1) ? &config.max_flexion_rad : &config.slices_per_s);
            *field = (k == -2) ? least[n] : ((k == -1) ? most[n] : wrong[k]);
            if (k < 0) {
                TEST_ASSERT_NULL(jcal_functional_config_check(&config));
                continue;
            }
            TEST_ASSERT_EQUAL_STRING(names[n], jcal_functional_config_check(&config));
            memset(&run.joint, 0x5a, sizeof run.joint);
            const jcal_functional_t before = run.joint;
            TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_functional_init(&run.joint, &config));
            TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint, sizeof before);
        }
    }
    jcal_functional_config_t config = usual;
    config.sign_hint = (jcal_sign_hint_t)3;
    TEST_ASSERT_EQUAL_STRING("sign_hint", jcal_functional_config_check(&config));
    config = usual;
    config.axis1_toward.y = NAN;
    TEST_ASSERT_EQUAL_STRING("axis1_toward", jcal_functional_config_check(&config));
}

static void null_is_an_error(void)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    jcal_functional_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_init(&run.joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_init(&run.joint, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_get(NULL, &result));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_get(&run.joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_functional_step(&run.joint));
    const jcal_quat_t q = {1.0f, 0.0f, 0.0f, 0.0f};
    TEST_ASSERT_TRUE(isnan(jcal_functional_flexion(NULL, q, q)));
    TEST_ASSERT_TRUE(isnan(jcal_functional_flexion(&run.joint, q, q)));
}

static void reset_is_a_new_beginning(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&other, &hinge, NULL);
    run_for(&other, 7.0);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_reset(&other.joint));
    run_begin(&run, &hinge, NULL);
    const size_t first =
        offsetof(jcal_functional_t, sums); /* settings have bytes between their fields that mean nothing */
    TEST_ASSERT_EQUAL_MEMORY((const char *)&run.joint + first, (const char *)&other.joint + first,
                             sizeof run.joint - first);
}

/* Largest components that take turns: an axis near (1, 1, 0) / sqrt(2), and one that the user names at right angles nearly. */
static void the_sign_stays_once_ready(void)
{
    for (int toward = 0; toward < 2; ++toward) {
        hinge_t hinge = hinge_usual();
        const double about_z[3] = {0.0, 0.0, 0.25 * MOTION_PI};
        mat_turn(about_z, hinge.mount1); /* axis1 is (1, 1, 0) / sqrt(2), but for its sign */
        hinge.skin_rad = 0.02;
        jcal_functional_config_t config = jcal_functional_config_default();
        config.max_bound_rad = 0.2f;
        if (toward == 1) {
            config.axis1_toward = jcal_vec3(1.0f, -1.0f, 0.01f);
        }
        run_begin(&run, &hinge, &config);
        (void)run_until(&run, JCAL_READY, 12.0);
        const jcal_vec3_t first = run_result(&run).axis1;
        for (int k = 0; k < 20 * 40; ++k) {
            run_tick(&run);
            TEST_ASSERT_TRUE(jcal_vec3_dot(first, run_result(&run).axis1) > 0.9f);
        }
    }
}

/* Of the joint's angle, but for a constant: from ready on, while judgements go on and axes and heading settle. */
static void the_angle_is_that_of_the_joint(void)
{
    static const int numbers[] = {0, 1, 2, 22, 147, 199}; /* in the last three the heading changes most before ready */
    for (size_t n = 0; n < sizeof numbers / sizeof numbers[0]; ++n) {
        const hinge_t hinge = some_hinge(numbers[n]);
        run_begin(&run, &hinge, NULL);
        run.next = (uint32_t)(37 * numbers[n]);
        (void)run_until(&run, JCAL_READY, 12.0);
        const double sense = (jcal_vec3_dot(run_result(&run).axis1, hinge_axis(&hinge, 1, 0.0)) > 0.0f) ? 1.0 : -1.0;
        double mean = 0.0;
        double least = 10.0;
        double most = -10.0;
        double before = 0.0;
        for (int k = 0; k < 400; ++k) {
            run_tick(&run);
            const double off = sense * run_flexion(&run) - hinge_angle(&hinge, run_time(&run) - 0.05);
            mean = (k == 0) ? off : mean;
            const double now = remainder(off - mean, 2.0 * MOTION_PI);
            TEST_ASSERT_TRUE_MESSAGE((k == 0) || (fabs(now - before) < 0.5 * HINGE_DEG), "a jump");
            TEST_ASSERT_TRUE(fabs(now) < HINGE_DEG);
            before = now;
            if (k >= 200) {
                least = fmin(least, now);
                most = fmax(most, now);
            }
        }
        TEST_ASSERT_TRUE(most - least < 0.2 * HINGE_DEG);
    }
}

/* On skin the search goes on after the first ready and takes other estimates: within the bounds they are the same, and the angle goes on. */
static void the_angle_does_not_jump_with_another_estimate(void)
{
    static const int numbers[] = {0, 1, 2, 3, 7, 45, 68, 141};
    int searched = 0;
    for (size_t n = 0; n < sizeof numbers / sizeof numbers[0]; ++n) {
        const int number = numbers[n];
        hinge_t hinge = some_hinge(number);
        hinge.skin_rad = 0.06;
        run_begin(&run, &hinge, NULL);
        run.next = (uint32_t)(29 * number);
        double before = 0.0;
        bool was_ready = false;
        for (int k = 0; k < 20 * 25; ++k) {
            const uint8_t tried = run.joint.search.tried;
            run_tick(&run);
            const bool is_ready = run_result(&run).head.status == JCAL_READY;
            TEST_ASSERT_TRUE(is_ready || !was_ready);
            const double sense =
                (jcal_vec3_dot(run_result(&run).axis1, hinge_axis(&hinge, 1, 0.0)) > 0.0f) ? 1.0 : -1.0;
            const double off = sense * run_flexion(&run) - hinge_angle(&hinge, run_time(&run) - 0.05);
            if (is_ready && was_ready) {
                searched += (run.joint.search.tried != tried) ? 1 : 0;
                /* the skin itself makes 5 deg at 7 rad/s: 2 deg in a tick */
                TEST_ASSERT_TRUE(fabs(remainder(off - before, 2.0 * MOTION_PI)) < 3.0 * HINGE_DEG);
            }
            was_ready = is_ready;
            before = off;
        }
    }
    TEST_ASSERT_TRUE(searched > 5);
}

/* Its zero is taken from a direction of the sensor that is far from the axis, whatever the first estimates were. */
static void the_zero_of_the_angle_is_far_from_the_axis(void)
{
    for (int number = 0; number < 4; ++number) {
        const hinge_t hinge = some_hinge(number);
        run_begin(&run, &hinge, NULL);
        while (run.joint.verdict.agreed < 2u) {
            run_tick(&run);
        }
        for (int i = 0; i < 2; ++i) { /* as if the first estimate had been at right angles to the last one */
            const int8_t largest = jcal_sign_largest((i == 0) ? run.joint.point.j1 : run.joint.point.j2);
            run.joint.track.zero[i] = (uint8_t)(((largest < 0) ? -largest : largest) - 1);
        }
        (void)run_until(&run, JCAL_READY, 15.0);
        for (int i = 0; i < 2; ++i) {
            const jcal_vec3_t j = (i == 0) ? run.joint.point.j1 : run.joint.point.j2;
            const float all[3] = {j.x, j.y, j.z};
            TEST_ASSERT_TRUE(fabsf(all[run.joint.track.zero[i]]) < 0.6f);
        }
    }
}

/* A small change of both axes changes the angle by as little, wherever they are. */
static void the_angle_follows_its_axes_without_a_jump(void)
{
    for (int number = 0; number < 30; ++number) {
        const hinge_t hinge = some_hinge(number);
        run_begin(&run, &hinge, NULL);
        run.next = (uint32_t)(41 * number);
        (void)run_until(&run, JCAL_READY, 15.0);
        const double before = run_flexion(&run);
        jcal_functional_point_t *const point = &run.joint.point;
        const jcal_functional_point_t was = *point;
        for (int k = 0; k < 16; ++k) {
            const float step = 0.01f;
            const jcal_tangent_t t1 = jcal_sphere_tangent(was.j1);
            const jcal_tangent_t t2 = jcal_sphere_tangent(was.j2);
            point->j1 = jcal_sphere_move(was.j1, &t1, (k & 1) ? step : -step, (k & 2) ? step : -step);
            point->j2 = jcal_sphere_move(was.j2, &t2, (k & 4) ? step : -step, (k & 8) ? step : -step);
            TEST_ASSERT_DOUBLE_WITHIN(0.06, 0.0, remainder(run_flexion(&run) - before, 2.0 * MOTION_PI));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_exact_hinge_is_found);
    RUN_TEST(nothing_ready_is_beyond_its_bounds);
    RUN_TEST(sensors_may_be_exchanged);
    RUN_TEST(times_do_not_matter_but_for_their_order);
    RUN_TEST(ticks_that_are_refused_leave_no_trace);
    RUN_TEST(a_gap_with_another_heading_is_survived);
    RUN_TEST(cold_ticks_are_left_out);
    RUN_TEST(gaps_before_the_first_estimate_leave_nothing_behind);
    RUN_TEST(headings_of_merged_blocks_turn_back_when_reversed_twice);
    RUN_TEST(a_hint_settles_the_pairing);
    RUN_TEST(a_wrong_hint_is_contradicted);
    RUN_TEST(a_slip_is_noticed_and_learnt);
    RUN_TEST(a_heading_that_drifts_is_no_slip);
    RUN_TEST(ready_is_no_slip);
    RUN_TEST(a_wrong_pairing_is_turned_back_with_what_was_merged);
    RUN_TEST(what_the_last_seconds_said_goes_with_the_estimate);
    RUN_TEST(memory_is_bounded);
    RUN_TEST(the_state_has_its_size);
    RUN_TEST(settings_have_ranges);
    RUN_TEST(null_is_an_error);
    RUN_TEST(reset_is_a_new_beginning);
    RUN_TEST(the_sign_stays_once_ready);
    RUN_TEST(the_angle_is_that_of_the_joint);
    RUN_TEST(the_angle_does_not_jump_with_another_estimate);
    RUN_TEST(the_zero_of_the_angle_is_far_from_the_axis);
    RUN_TEST(the_angle_follows_its_axes_without_a_jump);
    return UNITY_END();
}
