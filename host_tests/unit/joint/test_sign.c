/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/joint/sign.h: which direction of an axis is reported, and that it stays.
#include "joint/sign.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static const jcal_vec3_t nowhere = {0.0f, 0.0f, 0.0f};

static void the_largest_component_is_made_positive(void)
{
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_of(jcal_vec3(0.5f, -0.4f, -0.3f), nowhere, 0));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_of(jcal_vec3(0.4f, -0.5f, 0.3f), nowhere, 0));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_of(jcal_vec3(0.4f, 0.3f, -0.5f), nowhere, 0));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_of(jcal_vec3(-0.4f, -0.3f, 0.5f), nowhere, 0));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_of(nowhere, nowhere, 0));
}

static void the_number_is_that_of_the_largest_component(void)
{
    TEST_ASSERT_EQUAL_INT8(1, jcal_sign_largest(jcal_vec3(0.5f, -0.4f, -0.3f)));
    TEST_ASSERT_EQUAL_INT8(-2, jcal_sign_largest(jcal_vec3(0.4f, -0.5f, 0.3f)));
    TEST_ASSERT_EQUAL_INT8(-3, jcal_sign_largest(jcal_vec3(0.4f, 0.3f, -0.5f)));
    TEST_ASSERT_EQUAL_INT8(1, jcal_sign_largest(jcal_vec3(0.5f, 0.5f, -0.5f)));
}

static void a_named_direction_wins_over_the_largest_component(void)
{
    const jcal_vec3_t axis = jcal_vec3(-0.9f, 0.4f, 0.1f);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_of(axis, jcal_vec3(0.0f, 2.0f, 0.0f), 0));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_of(axis, jcal_vec3(0.0f, -1e-3f, 0.0f), 0));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_of(axis, nowhere, 0));
}

static void a_sign_that_is_kept_outlives_a_tie_of_components(void)
{
    int8_t kept = 0;
    jcal_sign_keep(&kept, jcal_vec3(0.71f, -0.70f, 0.1f), nowhere);
    TEST_ASSERT_EQUAL_INT8(1, kept);
    const jcal_vec3_t later = jcal_vec3(0.70f, -0.71f, 0.1f);
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_of(later, nowhere, 0));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_of(later, nowhere, kept));
    /* An estimate may turn up as its opposite. */
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_of(jcal_vec3_scale(later, -1.0f), nowhere, kept));
}

static void a_sign_that_is_kept_outlives_a_tie_towards_a_direction(void)
{
    for (unsigned i = 0u; i < 3u; ++i) {
        const jcal_vec3_t axis =
            jcal_vec3((i == 0u) ? -1.0f : 0.1f, (i == 1u) ? -1.0f : 0.1f, (i == 2u) ? -1.0f : 0.1f);
        const jcal_vec3_t toward = jcal_vec3_scale(axis, 0.5f);
        int8_t kept = 0;
        jcal_sign_keep(&kept, axis, toward);
        TEST_ASSERT_EQUAL_INT8(-(int)(i + 1u), kept);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_of(axis, jcal_vec3_scale(toward, -1.0f), kept));
        TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_of(jcal_vec3_scale(axis, -1.0f), toward, kept));
    }
}

static void a_sign_is_kept_once(void)
{
    int8_t kept = 0;
    jcal_sign_keep(&kept, jcal_vec3(0.0f, 0.0f, -1.0f), nowhere);
    TEST_ASSERT_EQUAL_INT8(3, kept); /* as it is reported */
    jcal_sign_keep(&kept, jcal_vec3(1.0f, 0.0f, 0.0f), nowhere);
    TEST_ASSERT_EQUAL_INT8(3, kept);
}

static void a_direction_is_zero_or_finite(void)
{
    TEST_ASSERT_TRUE(jcal_sign_may_be_toward(nowhere));
    TEST_ASSERT_TRUE(jcal_sign_may_be_toward(jcal_vec3(0.0f, -3.0f, 1.0f)));
    TEST_ASSERT_FALSE(jcal_sign_may_be_toward(jcal_vec3(NAN, 0.0f, 1.0f)));
    TEST_ASSERT_FALSE(jcal_sign_may_be_toward(jcal_vec3(0.0f, INFINITY, 1.0f)));
    TEST_ASSERT_FALSE(jcal_sign_may_be_toward(jcal_vec3(0.0f, 1.0f, -2e6f)));
}

/* A hint is about the largest components; once kept, it is about those that were largest then. */
static void a_hint_outlives_a_tie(void)
{
    const jcal_vec3_t axis1 = jcal_vec3(0.69f, -0.70f, 0.1f);
    const jcal_vec3_t axis2 = jcal_vec3(0.98f, 0.1f, 0.1f);
    const int8_t none[2] = {0, 0};
    const int8_t kept[2] = {1, 1};
    TEST_ASSERT_TRUE(jcal_sign_obeys(JCAL_SIGN_UNKNOWN, axis1, axis2, none));
    TEST_ASSERT_FALSE(jcal_sign_obeys(JCAL_SIGN_SAME, axis1, axis2, none));
    TEST_ASSERT_TRUE(jcal_sign_obeys(JCAL_SIGN_OPPOSITE, axis1, axis2, none));
    TEST_ASSERT_TRUE(jcal_sign_obeys(JCAL_SIGN_SAME, axis1, axis2, kept));
    TEST_ASSERT_FALSE(jcal_sign_obeys(JCAL_SIGN_OPPOSITE, axis1, axis2, kept));
    TEST_ASSERT_FALSE(jcal_sign_obeys(JCAL_SIGN_SAME, axis2, axis1, none));
    TEST_ASSERT_TRUE(jcal_sign_obeys(JCAL_SIGN_SAME, axis2, axis1, kept));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_largest_component_is_made_positive);
    RUN_TEST(the_number_is_that_of_the_largest_component);
    RUN_TEST(a_named_direction_wins_over_the_largest_component);
    RUN_TEST(a_sign_that_is_kept_outlives_a_tie_of_components);
    RUN_TEST(a_sign_that_is_kept_outlives_a_tie_towards_a_direction);
    RUN_TEST(a_sign_is_kept_once);
    RUN_TEST(a_direction_is_zero_or_finite);
    RUN_TEST(a_hint_outlives_a_tie);
    return UNITY_END();
}
