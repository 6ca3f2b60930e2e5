/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/remember.h: what is confirmed, what is dropped and why, what is neither.
#include "jointcal/vec3.h"
#include "unit/remember/fixture.h"

#include <math.h>

static run_t run;

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_decided(const jcal_remember_result_t *result, jcal_remember_state_t state,
                           jcal_remember_reason_t reason)
{
    TEST_ASSERT_EQUAL_INT(state, result->state);
    TEST_ASSERT_EQUAL_INT(reason, result->reason);
}

static void the_same_sensors_are_confirmed_within_three_seconds(void)
{
    for (int model = 0; model < 2; ++model) {
        const hinge_t hinge = hinge_usual();
        jcal_kept_t kept = kept_of(&hinge);
        kept.model = (jcal_model_t)model;
        run_begin(&run, &hinge, &kept);
        assert_decided(&(jcal_remember_result_t){run_result(&run).state, run_result(&run).reason, 0.0f, 0.0f, 0.0f},
                       JCAL_REMEMBERED, JCAL_REMEMBER_NO_MOTION);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, run_result(&run).bound1_rad);
        const jcal_remember_result_t result = run_until_decided(&run, 10.0);
        assert_decided(&result, JCAL_REMEMBER_CONFIRMED, JCAL_REMEMBER_NONE);
        TEST_ASSERT_TRUE(result.motion_s >= 2.0f && result.motion_s <= 3.0f);
        TEST_ASSERT_TRUE(result.bound1_rad >= kept.bound1_rad && result.bound1_rad <= 0.175f);
        TEST_ASSERT_TRUE(result.bound2_rad >= kept.bound2_rad && result.bound2_rad <= 0.175f);
    }
}

/* Bending is the spread of the joint's angle within the block; ticks weigh nearly alike while it moves all the time. */
static void bending_is_told_in_radians(void)
{
    const hinge_t hinge = hinge_usual();
    const jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    double re = 0.0;
    double im = 0.0;
    for (int k = 0; k < 30; ++k) {
        re += cos(hinge_angle(&hinge, 0.05 * run.next));
        im += sin(hinge_angle(&hinge, 0.05 * run.next));
        (void)run_tick(&run);
    }
    const double spread = sqrt(2.0 * (1.0 - sqrt(re * re + im * im) / 30.0));
    TEST_ASSERT_TRUE(spread > 0.3);
    TEST_ASSERT_FLOAT_WITHIN(0.1f * (float)spread, (float)spread, run.self.bend_rad);
}

/* Sensors that are named the other way round, with what is remembered of them, say the same of each axis. */
static void names_of_sensors_do_not_matter(void)
{
    const hinge_t hinge = hinge_usual();
    jcal_kept_t kept = kept_of(&hinge);
    kept.axis1 = turned_off(kept.axis1, 7.0);
    run_begin(&run, &hinge, &kept);
    for (int k = 0; k < 30; ++k) {
        (void)run_tick(&run);
    }
    const jcal_remember_t before = run.self;
    jcal_kept_t other = kept;
    other.axis1 = kept.axis2;
    other.axis2 = kept.axis1;
    other.lever1_m = kept.lever2_m;
    other.lever2_m = kept.lever1_m;
    run_begin(&run, &hinge, &other);
    run.exchanged = true;
    for (int k = 0; k < 30; ++k) {
        (void)run_tick(&run);
    }
    TEST_ASSERT_TRUE(before.sigma1_rad > 1.1f * before.sigma2_rad || before.sigma2_rad > 1.1f * before.sigma1_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, before.off1_rad, run.self.off2_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, before.off2_rad, run.self.off1_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, before.sigma1_rad, run.self.sigma2_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, before.sigma2_rad, run.self.sigma1_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, before.lack, run.self.lack);
}

/* What spoke for the other pairing before must be made up for. */
static void the_pairing_must_be_shown(void)
{
    const hinge_t hinge = hinge_usual();
    const jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_CONFIRMED, run_until_decided(&run, 4.0).state);
    const double until_s = run.until_s;
    const float gained = run.self.evidence;
    run_begin(&run, &hinge, &kept);
    run.self.past.evidence = 1.0f - gained;
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_CONFIRMED, run_until_decided(&run, 8.0).state);
    TEST_ASSERT_TRUE(run.until_s > until_s);
    TEST_ASSERT_TRUE(run.self.evidence >= 1.5f);
}

/* The limit of a rigid hinge is 3 deg, of a functional one 10 deg; beyond 6 it is dropped. */
static void axes_that_are_elsewhere_are_dropped(void)
{
    static const struct {
        double off1_deg, off2_deg;
        jcal_model_t model;
        bool holds;
    } CASES[] = {{1.0, 0.0, JCAL_MODEL_RIGID, true},        {6.0, 0.0, JCAL_MODEL_RIGID, false},
                 {0.0, 6.0, JCAL_MODEL_RIGID, false},       {3.0, 3.0, JCAL_MODEL_FUNCTIONAL, true},
                 {15.0, 0.0, JCAL_MODEL_FUNCTIONAL, false}, {0.0, 15.0, JCAL_MODEL_FUNCTIONAL, false},
                 {40.0, 0.0, JCAL_MODEL_FUNCTIONAL, false}, {0.0, 70.0, JCAL_MODEL_FUNCTIONAL, false}};
    for (unsigned i = 0u; i < sizeof CASES / sizeof CASES[0]; ++i) {
        const hinge_t hinge = hinge_usual();
        jcal_kept_t kept = kept_of(&hinge);
        kept.model = CASES[i].model;
        kept.axis1 = turned_off(kept.axis1, CASES[i].off1_deg);
        kept.axis2 = turned_off(kept.axis2, CASES[i].off2_deg);
        run_begin(&run, &hinge, &kept);
        const jcal_remember_result_t result = run_until_decided(&run, 10.0);
        assert_decided(&result, CASES[i].holds ? JCAL_REMEMBER_CONFIRMED : JCAL_REMEMBER_DROPPED,
                       CASES[i].holds ? JCAL_REMEMBER_NONE : JCAL_REMEMBER_AXES);
        TEST_ASSERT_TRUE(!CASES[i].holds || result.bound1_rad >= (float)(CASES[i].off1_deg * HINGE_DEG * 0.9));
        TEST_ASSERT_TRUE(CASES[i].holds || result.bound1_rad == JCAL_BOUND_UNKNOWN_RAD);
    }
}

static void exchanged_sensors_are_dropped_by_their_places(void)
{
    hinge_t hinge = hinge_usual();
    memcpy(hinge.mount2, hinge.mount1, sizeof hinge.mount1); /* the axes are the same for both */
    const jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    run.exchanged = true;
    const jcal_remember_result_t result = run_until_decided(&run, 10.0);
    assert_decided(&result, JCAL_REMEMBER_DROPPED, JCAL_REMEMBER_PLACES);
}

static void a_sensor_upside_down_is_dropped(void)
{
    const hinge_t hinge = hinge_usual();
    jcal_kept_t kept = kept_of(&hinge);
    kept.axis2 = turned_off(kept.axis2, 180.0);
    run_begin(&run, &hinge, &kept);
    const jcal_remember_result_t result = run_until_decided(&run, 10.0);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_DROPPED, result.state);
    TEST_ASSERT_TRUE(result.reason == JCAL_REMEMBER_SENSE || result.reason == JCAL_REMEMBER_AXES);
}

/* What shows too little stays what it is: nothing moves, the joint is stiff, its centre stands still, no levers were kept. */
static void what_shows_too_little_is_neither(void)
{
    const hinge_t usual = hinge_usual();
    hinge_t hinge = usual;
    hinge.rest_s = 1e6;
    jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    jcal_remember_result_t result = run_until_decided(&run, 4.0);
    assert_decided(&result, JCAL_REMEMBERED, JCAL_REMEMBER_NO_MOTION);
    hinge = usual;
    hinge.swing = 0.0;
    run_begin(&run, &hinge, &kept);
    result = run_until_decided(&run, 6.0);
    assert_decided(&result, JCAL_REMEMBERED, JCAL_REMEMBER_NO_MOTION);
    TEST_ASSERT_TRUE(result.motion_s > 4.0f);
    hinge = usual;
    hinge.lift = 0.0;
    run_begin(&run, &hinge, &kept);
    result = run_until_decided(&run, 4.0);
    assert_decided(&result, JCAL_REMEMBERED, JCAL_REMEMBER_PLACES);
    kept.has_levers = false;
    run_begin(&run, &usual, &kept);
    result = run_until_decided(&run, 4.0);
    assert_decided(&result, JCAL_REMEMBERED, JCAL_REMEMBER_PLACES);
}

/* In one plane with a level axis, and without the centre's motion to tell, either sense would do. */
static void motion_in_one_plane_confirms_nothing(void)
{
    hinge_t hinge = hinge_usual();
    hinge.turn = 0.0;
    hinge.lift = 0.0;
    jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBERED, run_until_decided(&run, 6.0).state);
    kept.axis2 = turned_off(kept.axis2, 180.0);
    run_begin(&run, &hinge, &kept);
    TEST_ASSERT_NOT_EQUAL(JCAL_REMEMBER_CONFIRMED, run_until_decided(&run, 6.0).state);
}

static void refusals_are_dropped_at_once(void)
{
    static const jcal_kept_refusal_t REFUSALS[] = {JCAL_KEPT_NONE, JCAL_KEPT_DAMAGED, JCAL_KEPT_OTHER_VERSION,
                                                   JCAL_KEPT_OTHER_KIND, JCAL_KEPT_OTHER_SENSORS};
    for (unsigned i = 0u; i < 5u; ++i) {
        jcal_remember_t self;
        jcal_remember_result_t result;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_init(&self, NULL, REFUSALS[i]));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_get(&self, &result));
        assert_decided(&result, JCAL_REMEMBER_DROPPED,
                       (i == 4u) ? JCAL_REMEMBER_OTHER_SENSORS : JCAL_REMEMBER_NO_RECORD);
    }
}

/* A gap makes sensors begin anew: nothing of before is mixed with what comes, and it goes on. */
static void a_gap_does_no_harm(void)
{
    hinge_t hinge = hinge_usual();
    const jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    for (int k = 0; k < 30; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, run_tick(&run));
    }
    const float before_s = run_result(&run).motion_s;
    TEST_ASSERT_TRUE(before_s > 1.0f);
    run.epoch = 2u;
    run.hinge.heading += 2.0;
    const jcal_remember_result_t result = run_until_decided(&run, 10.0);
    assert_decided(&result, JCAL_REMEMBER_CONFIRMED, JCAL_REMEMBER_NONE);
    TEST_ASSERT_TRUE(run.until_s < 2.5);
}

static void sensors_that_have_just_begun_are_not_heard(void)
{
    const hinge_t hinge = hinge_usual();
    const jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    run.next = 1u;
    while (run.next < 60u) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, run_tick(&run));
    }
    TEST_ASSERT_EQUAL_FLOAT(0.0f, run.self.block.time_s);
}

static void ticks_that_do_not_belong_together_are_rejected(void)
{
    const hinge_t hinge = hinge_usual();
    const jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, run_tick(&run));
    --run.next;
    const jcal_remember_t before = run.self;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, run_tick(&run));
    TEST_ASSERT_EQUAL_MEMORY(&before, &run.self, sizeof before);
    jcal_tick_t tick = hinge_tick(&hinge, 5.0, 1, 100u * TICK_US);
    jcal_tick_t wrong = tick;
    wrong.velocity.x = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_remember_add(&run.self, &tick, &wrong));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_add(&run.self, NULL, &tick));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_add(&run.self, &tick, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_add(NULL, &tick, &tick));
}

/* The joint's own estimator was faster. */
static void an_estimate_settles_it(void)
{
    const hinge_t hinge = hinge_usual();
    const jcal_kept_t kept = kept_of(&hinge);
    const struct {
        double off1_deg, off2_deg;
        float sign;
        bool holds;
    } CASES[] = {{0.0, 0.0, 1.0f, true},  {8.0, 0.0, 1.0f, true},  {8.2, 0.0, 1.0f, false},  {0.0, 9.6, 1.0f, true},
                 {0.0, 9.9, 1.0f, false}, {0.0, 0.0, -1.0f, true}, {0.0, 180.0, 1.0f, false}};
    for (unsigned i = 0u; i < sizeof CASES / sizeof CASES[0]; ++i) {
        jcal_kept_t now = kept;
        now.axis1 = jcal_vec3_scale(turned_off(kept.axis1, CASES[i].off1_deg), CASES[i].sign);
        now.axis2 = jcal_vec3_scale(turned_off(kept.axis2, CASES[i].off2_deg), CASES[i].sign);
        run_begin(&run, &hinge, &kept);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_settle(&run.self, &now));
        const jcal_remember_result_t result = run_result(&run);
        assert_decided(&result, CASES[i].holds ? JCAL_REMEMBER_CONFIRMED : JCAL_REMEMBER_DROPPED,
                       CASES[i].holds ? JCAL_REMEMBER_NONE : JCAL_REMEMBER_ESTIMATE);
        TEST_ASSERT_TRUE(!CASES[i].holds || result.bound1_rad == kept.bound1_rad);
        /* and what is settled stays so */
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_settle(&run.self, CASES[i].holds ? &now : &kept));
        TEST_ASSERT_EQUAL_INT(result.state, run_result(&run).state);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, run_tick(&run));
        TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_remember_step(&run.self));
    }
}

static void other_kinds_are_settled_or_dropped_by_their_levers(void)
{
    const hinge_t hinge = hinge_usual();
    jcal_kept_t kept = kept_of(&hinge);
    kept.kind = JCAL_KEPT_TWO_AXES;
    kept.bound_lever1_m = 0.05f;
    kept.bound_lever2_m = 0.05f;
    run_begin(&run, &hinge, &kept);
    jcal_remember_result_t result = run_until_decided(&run, 8.0);
    assert_decided(&result, JCAL_REMEMBERED, JCAL_REMEMBER_AXES);
    jcal_kept_t now = kept;
    now.axis2 = jcal_vec3_scale(kept.axis2, -1.0f); /* signs of two axes are free */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_settle(&run.self, &now));
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_CONFIRMED, run_result(&run).state);
    kept.kind = JCAL_KEPT_BALL;
    run_begin(&run, &hinge, &kept);
    run.exchanged = true;
    result = run_until_decided(&run, 10.0);
    assert_decided(&result, JCAL_REMEMBER_DROPPED, JCAL_REMEMBER_PLACES);
    run_begin(&run, &hinge, &kept);
    now = kept;
    now.lever2_m.x += 0.08f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_settle(&run.self, &now));
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_DROPPED, run_result(&run).state);
}

/* What was closed is halved beyond 30 s of motion; all of it, so that what it says stays the same. */
static void what_lies_long_back_fades(void)
{
    hinge_t hinge = hinge_usual();
    hinge.lift = 0.0; /* so that it stays remembered */
    const jcal_kept_t kept = kept_of(&hinge);
    run_begin(&run, &hinge, &kept);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBERED, run_until_decided(&run, 5.5).state);
    TEST_ASSERT_TRUE(run.self.past.motion_s > 3.0f && run.self.past.motion_s < 6.0f);
    float *const past = (float *)&run.self.past;
    for (size_t i = 0u; i < sizeof run.self.past / sizeof(float); ++i) {
        past[i] *= 8.0f;
    }
    const jcal_remember_past_t before = run.self.past;
    for (int k = 0; k < 6 && run.self.past.motion_s > 30.0f; ++k) {
        (void)run_tick(&run);
    }
    TEST_ASSERT_EQUAL_FLOAT(0.5f * before.motion_s, run.self.past.motion_s);
    TEST_ASSERT_EQUAL_FLOAT(0.5f * before.matrix[9], run.self.past.matrix[9]);
    TEST_ASSERT_EQUAL_FLOAT(0.5f * before.evidence, run.self.past.evidence);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBERED, run_result(&run).state);
}

static void null_and_words(void)
{
    jcal_remember_t self;
    jcal_remember_result_t result;
    const hinge_t hinge = hinge_usual();
    jcal_kept_t kept = kept_of(&hinge);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_init(NULL, &kept, JCAL_KEPT_FITS));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_init(&self, NULL, JCAL_KEPT_FITS));
    kept.axis1.x += 0.5f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_init(&self, &kept, JCAL_KEPT_FITS));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_init(&self, NULL, JCAL_KEPT_NONE));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_get(NULL, &result));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_get(&self, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_settle(&self, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_settle(&self, &kept));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_remember_settle(NULL, &kept));
    TEST_ASSERT_EQUAL_STRING("remembered", jcal_remember_state_string(JCAL_REMEMBERED));
    TEST_ASSERT_EQUAL_STRING("confirmed", jcal_remember_state_string(JCAL_REMEMBER_CONFIRMED));
    TEST_ASSERT_EQUAL_STRING("dropped", jcal_remember_state_string(JCAL_REMEMBER_DROPPED));
    TEST_ASSERT_EQUAL_STRING("unknown", jcal_remember_state_string((jcal_remember_state_t)3));
    static const char *const WORDS[] = {"no_record", "other_sensors", "axes",    "places",
                                        "sense",     "no_motion",     "estimate"};
    for (int i = 0; i < 7; ++i) {
        TEST_ASSERT_EQUAL_STRING(WORDS[i], jcal_remember_reason_string((jcal_remember_reason_t)(i + 1)));
    }
    TEST_ASSERT_NULL(jcal_remember_reason_string(JCAL_REMEMBER_NONE));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_same_sensors_are_confirmed_within_three_seconds);
    RUN_TEST(bending_is_told_in_radians);
    RUN_TEST(names_of_sensors_do_not_matter);
    RUN_TEST(the_pairing_must_be_shown);
    RUN_TEST(axes_that_are_elsewhere_are_dropped);
    RUN_TEST(exchanged_sensors_are_dropped_by_their_places);
    RUN_TEST(a_sensor_upside_down_is_dropped);
    RUN_TEST(what_shows_too_little_is_neither);
    RUN_TEST(motion_in_one_plane_confirms_nothing);
    RUN_TEST(refusals_are_dropped_at_once);
    RUN_TEST(a_gap_does_no_harm);
    RUN_TEST(sensors_that_have_just_begun_are_not_heard);
    RUN_TEST(ticks_that_do_not_belong_together_are_rejected);
    RUN_TEST(an_estimate_settles_it);
    RUN_TEST(other_kinds_are_settled_or_dropped_by_their_levers);
    RUN_TEST(what_lies_long_back_fades);
    RUN_TEST(null_and_words);
    return UNITY_END();
}
