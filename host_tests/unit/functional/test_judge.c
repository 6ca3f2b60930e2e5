/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of functional/judge.h: each thing that keeps an estimate from being ready, by itself, on either side of its limit.
#include "functional/judge.h"

#include "joint/hysteresis.h"
#include "jointcal/functional.h"
#include "unit/functional/fixture.h"

static run_t run;
static jcal_functional_t good; /* ready, and far from every limit */

void setUp(void)
{
    const hinge_t hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
    run_for(&run, 10.0);
    good = run.joint;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, good.verdict.status);
    good.ticks.gravity_off = 0.0f;
    good.sums.motion_s = 8.0f;
    good.point.size[JCAL_FAMILY_TURN] = 0.005f;
    good.point.lack = 0.0f;
    good.point.speed2 = 0.2f;
    good.verdict.evidence[0] = 5.0f;
    good.verdict.evidence[1] = 5.0f;
    good.verdict.evidence[2] = 30.0f;
    good.verdict.opposite = 0.1f;
    good.verdict.share = 0.999f;
    good.verdict.bend_rad = 0.6f;
    good.verdict.stiffness = 0.5f;
    good.verdict.bound1_rad = 2.0f * (float)HINGE_DEG;
    good.verdict.bound2_rad = 2.0f * (float)HINGE_DEG;
    good.verdict.status = (uint8_t)JCAL_COLLECTING;
    good.verdict.agreed = 0u;
}

void tearDown(void)
{
}

/* What three judgements say of it. */
static jcal_reason_t judged(const jcal_functional_t *joint)
{
    jcal_functional_t copy = *joint;
    for (int k = 0; k < 3; ++k) {
        jcal_functional_judge(&copy);
    }
    TEST_ASSERT_EQUAL_INT(copy.verdict.reason == (uint8_t)JCAL_REASON_NONE, copy.verdict.status == (uint8_t)JCAL_READY);
    return (jcal_reason_t)copy.verdict.reason;
}

/* `value` at `inside` is ready, at `outside` for this reason not; where it was ready before, a value a little beyond is still. */
static void expect_limit(float *value, float inside, float outside, jcal_reason_t reason)
{
    *value = inside;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
    *value = outside;
    TEST_ASSERT_EQUAL_INT(reason, judged(&good));
    good.verdict.status = (uint8_t)JCAL_READY;
    good.verdict.agreed = 3u;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
    setUp();
}

static void each_limit_alone(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
    expect_limit(&good.ticks.gravity_off, 0.59f, 0.61f, JCAL_REASON_GRAVITY_OFF);
    expect_limit(&good.sums.motion_s, 3.01f, 2.99f, JCAL_REASON_NO_MOTION);
    expect_limit(&good.point.size[JCAL_FAMILY_TURN], 0.060f, 0.062f, JCAL_REASON_DOES_NOT_FIT);
    good.point.speed2 = 1.0f; /* 0.0256 (m/s)^2 may be left, times 8 s */
    good.verdict.opposite = 2.0f;
    expect_limit(&good.point.lack, 8.0f * 0.0255f, 8.0f * 0.0257f, JCAL_REASON_NOT_ONE_JOINT);
    good.verdict.share = 0.9999f;
    expect_limit(&good.verdict.bend_rad, 15.2f * (float)HINGE_DEG, 14.8f * (float)HINGE_DEG, JCAL_REASON_NO_BEND);
    expect_limit(&good.verdict.stiffness, 0.051f, 0.049f, JCAL_REASON_NO_BEND);
    expect_limit(&good.verdict.share, 0.801f, 0.799f, JCAL_REASON_MORE_AXES);
    expect_limit(&good.point.speed2, 0.031f, 0.029f, JCAL_REASON_SIGN_OPEN);
    good.verdict.evidence[2] = 4.0f;
    good.verdict.evidence[1] = 0.0f;
    expect_limit(&good.verdict.evidence[0], 3.1f, 2.9f, JCAL_REASON_SIGN_OPEN);
    expect_limit(&good.verdict.evidence[2], 3.1f, 2.9f, JCAL_REASON_SIGN_OPEN);
    good.point.lack = 8.0f * 1e-3f;
    expect_limit(&good.verdict.opposite, 4.7e-3f, 4.5e-3f, JCAL_REASON_SIGN_OPEN);
}

/* Clean bending is asked for in proportion to what the centre's motion leaves. */
static void bending_is_to_be_clear(void)
{
    good.verdict.share = 0.9f; /* three times the bending */
    expect_limit(&good.verdict.bend_rad, 40.5f / 3.0f * 1.2f * (float)HINGE_DEG, 14.0f * (float)HINGE_DEG,
                 JCAL_REASON_NO_BEND);
    good.verdict.share = 0.84f; /* 2.29 times */
    expect_limit(&good.verdict.bend_rad, 17.7f * (float)HINGE_DEG, 17.2f * (float)HINGE_DEG, JCAL_REASON_MORE_AXES);
}

static void axes_or_the_angle(void)
{
    good.verdict.bound1_rad = 2.9f * (float)HINGE_DEG;
    good.cfg.max_flexion_rad = 0.001f;
    expect_limit(&good.verdict.bound2_rad, 2.9f * (float)HINGE_DEG, 3.1f * (float)HINGE_DEG, JCAL_REASON_UNCERTAIN);
    good.cfg.max_flexion_rad = 0.3f;
    expect_limit(&good.verdict.bound1_rad, 9.9f * (float)HINGE_DEG, 10.1f * (float)HINGE_DEG, JCAL_REASON_UNCERTAIN);
}

/* A user's hint settles the pairing, unless the data insist on the other one. */
static void a_hint_that_the_data_contradict(void)
{
    good.cfg.sign_hint = JCAL_SIGN_SAME;
    expect_limit(&good.point.speed2, 0.00122f, 0.00118f, JCAL_REASON_SIGN_OPEN);
    good.cfg.sign_hint = JCAL_SIGN_SAME;
    good.point.speed2 = 0.002f;
    good.verdict.opposite = 0.0f;
    good.verdict.evidence[0] = 0.0f;
    good.verdict.evidence[1] = 0.0f;
    good.verdict.evidence[2] = -6.9f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
    good.verdict.evidence[2] = -7.1f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SIGN_OPEN, judged(&good));
}

/* What get says of the axes after a judgement. */
static float bound_told(const jcal_functional_t *joint)
{
    jcal_functional_t copy = *joint;
    jcal_functional_judge(&copy);
    jcal_functional_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_get(&copy, &result));
    TEST_ASSERT_EQUAL_FLOAT(result.uncertainty1_rad, result.uncertainty2_rad);
    return result.uncertainty1_rad;
}

/* Motion too slow for the pairing may still say that there is no axis. */
static void no_bound_without_an_axis(void)
{
    TEST_ASSERT_EQUAL_FLOAT(good.verdict.bound1_rad, bound_told(&good));
    good.point.speed2 = 0.02f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SIGN_OPEN, judged(&good));
    TEST_ASSERT_EQUAL_FLOAT(good.verdict.bound1_rad, bound_told(&good));
    good.verdict.bend_rad = 0.1f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SIGN_OPEN, judged(&good));
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, bound_told(&good));
    setUp();
    good.ticks.gravity_off = 0.7f;
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, bound_told(&good));
    setUp();
    good.point.size[JCAL_FAMILY_TURN] = 0.07f;
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, bound_told(&good));
}

static void three_judgements_must_agree(void)
{
    for (int k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, good.verdict.status);
        jcal_functional_judge(&good);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_READY, good.verdict.status);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_NONE, good.verdict.hint);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_NONE, good.verdict.weak);
    good.verdict.bend_rad = 0.0f;
    jcal_functional_judge(&good);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, good.verdict.status);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, good.verdict.hint);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(each_limit_alone);
    RUN_TEST(bending_is_to_be_clear);
    RUN_TEST(axes_or_the_angle);
    RUN_TEST(a_hint_that_the_data_contradict);
    RUN_TEST(no_bound_without_an_axis);
    RUN_TEST(three_judgements_must_agree);
    return UNITY_END();
}
