/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of what a body keeps of a joint, and of what becomes of it on the next day: confirmed, dropped, or refused at once.
#include "unit/body/fixture.h"

#include "math/sphere.h"
#include "unit/keep/fixture.h"

enum { KINDS = 16, LEARN_K = 4000, DAY_K = 1500 };

static body_fixture_t f;
static hinge_t hinge;
static ram_flash_t ram;
static ram_flash_t written; /* what one day left behind */
static jcal_flash_t flash;
static jcal_kept_t kept;
static unsigned told[KINDS];
static jcal_body_event_t last[KINDS];
static uint64_t told_first_us[KINDS];

/* The same sensors, prepared for another day. */
static void begin_day(uint64_t serial1, uint64_t serial2)
{
    memset(told, 0, sizeof told);
    body_fill(&f, 2u);
    f.sensors[0].serial = serial1;
    f.sensors[1].serial = serial2;
    f.joints[0].name = "left knee";
    f.table.flash = &flash;
    body_begin(&f);
}

void setUp(void)
{
    flash = ram_flash(&ram);
    hinge = hinge_usual();
    hinge.rest_s = 1.0;
    begin_day(11u, 12u);
}

void tearDown(void)
{
}

static void note_events(void)
{
    jcal_body_event_t event;
    while (jcal_body_event(&f.body, &event) == JCAL_OK) {
        TEST_ASSERT_TRUE(event.kind < KINDS);
        told_first_us[event.kind] = (told[event.kind] == 0u) ? event.t_us : told_first_us[event.kind];
        told[event.kind] += 1u;
        last[event.kind] = event;
    }
}

/* A period of the hub, with the sensors on the places `first` and 1 - `first`. */
static void play(uint32_t k, unsigned first)
{
    const uint64_t now_us = 777000u + (uint64_t)k * BODY_PERIOD_US;
    float values[6];
    for (unsigned s = 0u; s < 2u; ++s) {
        body_read_at(&hinge, 0.01 * k, (s == 0u) ? first : (1u - first), values);
        body_send(&f, s, now_us, values);
    }
    (void)body_work(&f, now_us);
    note_events();
}

static void assert_true_axes(const jcal_body_joint_result_t *joint)
{
    const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
    const jcal_vec3_t true2 = hinge_axis(&hinge, 2, 0.0);
    const float sign = (jcal_vec3_dot(joint->axis1, true1) < 0.0f) ? -1.0f : 1.0f;
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(joint->axis1, sign), true1) < joint->uncertainty1_rad);
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(joint->axis2, sign), true2) < joint->uncertainty2_rad);
}

/* One day until the joint is ready, and what is known of it then. */
static void learn(void)
{
    for (uint32_t k = 0u; k < LEARN_K; ++k) {
        play(k, 0u);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_kept(&f.body, 0u, &kept));
    TEST_ASSERT_FALSE(body_joint(&f, 0u).has_kept);
}

/* As learn, and written with jcal_keep_...: the schedule has a test of its own. `written` spares the others that day. */
static void keep(void)
{
    static bool is_done;
    if (!is_done) {
        jcal_keep_writer_t writer;
        learn();
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_begin(&writer, &flash, 1u));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_put(&writer, &kept));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_commit(&writer));
        written = ram;
        is_done = true;
    }
    ram = written;
}

/* Writes a changed record in place of the one of before. */
static void write_again(const jcal_kept_t *other)
{
    jcal_keep_writer_t writer;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_begin(&writer, &flash, (unsigned)other->joint + 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_put(&writer, other));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_commit(&writer));
}

/* A day of 15 s. While it is remembered, nothing is ready. */
static void short_day(unsigned first)
{
    for (uint32_t k = 0u; k < DAY_K; ++k) {
        play(k, first);
        const jcal_body_joint_result_t joint = body_joint(&f, 0u);
        if (joint.kept == JCAL_REMEMBERED) {
            TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, joint.head.status);
        }
    }
}

static void nothing_is_written_before_the_schedule_allows_it(void)
{
    uint32_t due_k = 0u;
    TEST_ASSERT_FALSE(jcal_body_keep_due(&f.body));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_body_keep(&f.body));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_body_kept(&f.body, 0u, &kept));
    for (uint32_t k = 0u; (k < 14000u) && (due_k == 0u); ++k) {
        play(k, 0u);
        due_k = jcal_body_keep_due(&f.body) ? k : 0u;
    }
    TEST_ASSERT_TRUE(due_k >= 6000u); /* a minute after it became ready */
    TEST_ASSERT_EQUAL_UINT(0u, ram.erases[0] + ram.erases[1]);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_keep(&f.body));
    note_events();
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_KEPT]);
    TEST_ASSERT_EQUAL_UINT8(JCAL_BODY_NONE, last[JCAL_BODY_KEPT].joint);
    TEST_ASSERT_EQUAL_UINT8(JCAL_BODY_NONE, last[JCAL_BODY_KEPT].sensor);
    TEST_ASSERT_FALSE(ram.is_misused);
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_body_keep(&f.body)); /* once */
    const jcal_kept_wanted_t wanted = {JCAL_KEPT_HINGE, 0u, 11u, 12u};
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_FITS, jcal_keep_load(&flash, &wanted, &kept));
    TEST_ASSERT_TRUE(kept.has_lag && kept.has_usual && kept.has_levers);
    TEST_ASSERT_FLOAT_WITHIN(kept.lag_bound_s, 0.0f, kept.lag_s);
    TEST_ASSERT_FALSE(jcal_body_keep_due(&f.body));
}

/* Confirmed by motion, and ready at once with the axes of before; long before it would be by itself. */
static void a_calibration_of_before_gives_angles_soon(void)
{
    keep();
    begin_day(11u, 12u);
    double zero = NAN;
    unsigned angles = 0u;
    for (uint32_t k = 0u; k < DAY_K; ++k) {
        play(k, 0u);
        const jcal_body_joint_result_t joint = body_joint(&f, 0u);
        TEST_ASSERT_EQUAL(joint.head.status == JCAL_READY, joint.kept == JCAL_REMEMBER_CONFIRMED);
        if (isnan(joint.flexion_rad)) {
            continue;
        }
        assert_true_axes(&joint);
        const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
        const float sign = (jcal_vec3_dot(joint.axis1, true1) < 0.0f) ? -1.0f : 1.0f;
        const double t = 1e-6 * ((double)body_sensor(&f, 0u).t_us - 777000.0);
        const double off = (double)(sign * joint.flexion_rad) - hinge_angle(&hinge, t);
        zero = (angles++ == 0u) ? off : zero;
        TEST_ASSERT_DOUBLE_WITHIN(2.5 * HINGE_DEG, 0.0, remainder(off - zero, 2.0 * MOTION_PI));
    }
    TEST_ASSERT_TRUE(angles > 500u);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_REMEMBERED]);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_CONFIRMED]);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_READY]);
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_DROPPED] + told[JCAL_BODY_MOVED] + told[JCAL_BODY_LEFT_READY]);
    const jcal_body_joint_result_t joint = body_joint(&f, 0u);
    TEST_ASSERT_TRUE(joint.has_kept && joint.lag_known);
    TEST_ASSERT_TRUE(joint.lag_bound_s > kept.lag_bound_s); /* a radio that connects anew */
    TEST_ASSERT_TRUE(jcal_body_sleeps(&f.body, 0u));
    TEST_ASSERT_FALSE(jcal_body_keep_due(&f.body)); /* it is there already */
}

static void while_it_is_remembered_the_sentence_says_so(void)
{
    char text[80];
    jcal_body_advice_t advice;
    keep();
    begin_day(11u, 12u);
    for (uint32_t k = 0u; k < 200u; ++k) {
        play(k, 0u);
    }
    const jcal_body_joint_result_t joint = body_joint(&f, 0u);
    TEST_ASSERT_TRUE(joint.has_kept);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBERED, joint.kept);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_NO_MOTION, joint.kept_reason);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_advice(&f.body, &advice));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_sentence(&f.body, &advice, text, sizeof text));
    TEST_ASSERT_EQUAL_STRING("Bend the left knee: its calibration of before is being checked.", text);
}

static void sensors_on_each_others_places_are_dropped(void)
{
    keep();
    begin_day(11u, 12u);
    short_day(1u);
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_CONFIRMED]);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_DROPPED]);
    TEST_ASSERT_TRUE(told_first_us[JCAL_BODY_DROPPED] < 777000u + 10000000u);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_DROPPED, body_joint(&f, 0u).kept);
}

static void a_turned_axis_is_dropped(void)
{
    keep();
    jcal_kept_t other = kept;
    const jcal_tangent_t across = jcal_sphere_tangent(kept.axis2);
    other.axis2 = jcal_vec3_add(jcal_vec3_scale(kept.axis2, 0.9659258f), jcal_vec3_scale(across.u, 0.2588190f));
    write_again(&other);
    begin_day(11u, 12u);
    short_day(0u);
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_CONFIRMED]);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_DROPPED]);
    TEST_ASSERT_EQUAL_UINT8(JCAL_REMEMBER_AXES, last[JCAL_BODY_DROPPED].what);
}

/* What is read at once: whose it is. `expected` JCAL_REMEMBER_NONE: nothing was found, and nothing is told. */
static void assert_refused(uint64_t serial1, uint64_t serial2, jcal_remember_reason_t expected)
{
    begin_day(serial1, serial2);
    for (uint32_t k = 0u; k < 10u; ++k) {
        play(k, 0u);
    }
    const bool is_told = expected != JCAL_REMEMBER_NONE;
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_REMEMBERED]);
    TEST_ASSERT_EQUAL_UINT(is_told ? 1u : 0u, told[JCAL_BODY_DROPPED]);
    TEST_ASSERT_EQUAL(is_told, body_joint(&f, 0u).has_kept);
    if (is_told) {
        TEST_ASSERT_EQUAL_UINT8(expected, last[JCAL_BODY_DROPPED].what);
        TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_DROPPED, body_joint(&f, 0u).kept);
        TEST_ASSERT_EQUAL_INT(expected, body_joint(&f, 0u).kept_reason);
    }
    TEST_ASSERT_FALSE(body_joint(&f, 0u).lag_known);
}

static void other_sensors_kinds_and_damage_are_refused_at_once(void)
{
    keep();
    assert_refused(12u, 11u, JCAL_REMEMBER_OTHER_SENSORS);
    assert_refused(11u, 13u, JCAL_REMEMBER_OTHER_SENSORS);
    assert_refused(0u, 12u, JCAL_REMEMBER_NONE);
    jcal_kept_t ball = kept;
    ball.kind = JCAL_KEPT_BALL;
    ball.model = JCAL_MODEL_RIGID;
    ball.axis1 = (jcal_vec3_t){0.0f, 0.0f, 0.0f};
    ball.axis2 = ball.axis1;
    ball.bound1_rad = 0.0f;
    ball.bound2_rad = 0.0f;
    ball.flexion_bound_rad = 0.0f;
    ball.frames.q_b1_s1.w = 1.0f;
    ball.frames.q_b2_s2.w = 1.0f;
    write_again(&ball);
    assert_refused(11u, 12u, JCAL_REMEMBER_NO_RECORD);
    ram = written;
    for (unsigned slot = 0u; slot < 2u; ++slot) {
        ram.bytes[slot][JCAL_KEEP_HEAD_BYTES + 40u] ^= 0x10u;
    }
    assert_refused(11u, 12u, JCAL_REMEMBER_NO_RECORD);
    flash = ram_flash(&ram);
    assert_refused(11u, 12u, JCAL_REMEMBER_NONE);
    jcal_kept_t second = kept;
    second.joint = 1u; /* of a table with more joints: nothing is there of joint 0 */
    write_again(&second);
    assert_refused(11u, 12u, JCAL_REMEMBER_NONE);
}

/* Without a lag its times may be off by anything: its own estimator decides, and the lag is looked for. */
static void a_record_without_a_lag_waits_for_its_own_estimator(void)
{
    keep();
    jcal_kept_t other = kept;
    other.has_lag = false;
    other.lag_s = 0.0f;
    other.lag_bound_s = 0.0f;
    write_again(&other);
    begin_day(11u, 12u);
    for (uint32_t k = 0u; k < LEARN_K; ++k) {
        play(k, 0u);
    }
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_REMEMBERED]);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_LAG_FOUND]);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_CONFIRMED]);
    TEST_ASSERT_TRUE(told_first_us[JCAL_BODY_CONFIRMED] >= told_first_us[JCAL_BODY_LAG_FOUND]);
    TEST_ASSERT_FALSE(jcal_body_sleeps(&f.body, 0u));
    TEST_ASSERT_EQUAL_INT(JCAL_READY, body_joint(&f, 0u).head.status);
}

/* The joint's own estimator found something else: its word stands. */
static void an_own_estimate_that_disagrees_drops_what_was_kept(void)
{
    keep();
    jcal_kept_t other = kept;
    other.has_lag = false;
    other.axis1 = jcal_vec3_scale(kept.axis1, -1.0f);
    write_again(&other);
    begin_day(11u, 12u);
    for (uint32_t k = 0u; k < LEARN_K; ++k) {
        play(k, 0u);
    }
    const jcal_body_joint_result_t joint = body_joint(&f, 0u);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, joint.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_DROPPED, joint.kept);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_ESTIMATE, joint.kept_reason);
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_CONFIRMED]);
    assert_true_axes(&joint);
}

/* It is woken: nothing of what was handed over is left, and it is compared once the joint is ready by itself. */
static void a_joint_that_is_woken_learns_by_itself_and_is_compared(void)
{
    keep();
    begin_day(11u, 12u);
    uint32_t k = 0u;
    for (; k < DAY_K; ++k) {
        play(k, 0u);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_sleep(&f.body, 0u, false));
    play(k++, 0u);
    TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, body_joint(&f, 0u).head.status);
    for (; k < DAY_K + LEARN_K; ++k) {
        play(k, 0u);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_READY, body_joint(&f, 0u).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_CONFIRMED, body_joint(&f, 0u).kept);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_CONFIRMED]);
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_DROPPED]);
    TEST_ASSERT_FALSE(jcal_body_sleeps(&f.body, 0u));
}

/* Asleep and adopted, a sensor slips: it begins anew, and what was kept does not hold any more. */
static void a_slip_after_confirmation_drops_it(void)
{
    keep();
    begin_day(11u, 12u);
    uint32_t k = 0u;
    for (; k < DAY_K; ++k) {
        play(k, 0u);
    }
    for (; k < DAY_K + 1000u; ++k) {
        play(k, 1u);
    }
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_MOVED]);
    TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_DROPPED]);
    TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, body_joint(&f, 0u).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REMEMBER_DROPPED, body_joint(&f, 0u).kept);
}

/* The power goes at some byte of a write: what was, or what is new, is confirmed on the next day, and nothing else is. */
static void power_that_goes_in_a_write_leaves_a_whole_record(void)
{
    keep();
    const uint32_t all = ERASE_STAGES + FLASH_BYTES;
    for (uint32_t left = 0u; left < all; left += 37u) {
        ram = written;
        ram.left = left;
        jcal_kept_t other = kept;
        other.lag_bound_s = 0.004f;
        jcal_keep_writer_t writer;
        const bool is_done = (jcal_keep_begin(&writer, &flash, 1u) == JCAL_OK) &&
                             (jcal_keep_put(&writer, &other) == JCAL_OK) && (jcal_keep_commit(&writer) == JCAL_OK);
        ram.left = POWER_FOR_EVER;
        begin_day(11u, 12u);
        for (uint32_t k = 0u; k < 10u; ++k) {
            play(k, 0u);
        }
        TEST_ASSERT_EQUAL_UINT(1u, told[JCAL_BODY_REMEMBERED]);
        const float bound_s = is_done ? other.lag_bound_s : kept.lag_bound_s;
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, bound_s + 0.01f, body_joint(&f, 0u).lag_bound_s);
    }
}

static void flash_that_fails_is_told(void)
{
    for (uint32_t k = 0u; k < 14000u; ++k) {
        play(k, 0u);
        if (jcal_body_keep_due(&f.body)) {
            break;
        }
    }
    ram.left = 100u;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FLASH, jcal_body_keep(&f.body));
    note_events();
    TEST_ASSERT_EQUAL_UINT(0u, told[JCAL_BODY_KEPT]);
    ram.left = POWER_FOR_EVER;
    TEST_ASSERT_FALSE(jcal_body_keep_due(&f.body)); /* not again at once */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_keep(&f.body));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(nothing_is_written_before_the_schedule_allows_it);
    RUN_TEST(a_calibration_of_before_gives_angles_soon);
    RUN_TEST(while_it_is_remembered_the_sentence_says_so);
    RUN_TEST(sensors_on_each_others_places_are_dropped);
    RUN_TEST(a_turned_axis_is_dropped);
    RUN_TEST(other_sensors_kinds_and_damage_are_refused_at_once);
    RUN_TEST(a_record_without_a_lag_waits_for_its_own_estimator);
    RUN_TEST(an_own_estimate_that_disagrees_drops_what_was_kept);
    RUN_TEST(a_joint_that_is_woken_learns_by_itself_and_is_compared);
    RUN_TEST(a_slip_after_confirmation_drops_it);
    RUN_TEST(power_that_goes_in_a_write_leaves_a_whole_record);
    RUN_TEST(flash_that_fails_is_told);
    return UNITY_END();
}
