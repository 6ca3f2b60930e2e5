/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/vec3.h and jointcal/quat.h.
#include "jointcal/quat.h"

#include "unity.h"

#include <math.h>

static const float TOL = 1e-6f;

static void assert_vec3(jcal_vec3_t expected, jcal_vec3_t got)
{
    TEST_ASSERT_FLOAT_WITHIN(TOL, expected.x, got.x);
    TEST_ASSERT_FLOAT_WITHIN(TOL, expected.y, got.y);
    TEST_ASSERT_FLOAT_WITHIN(TOL, expected.z, got.z);
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void sums_products_and_norms_of_vectors_are_right(void)
{
    const jcal_vec3_t a = jcal_vec3(1.0f, 2.0f, 3.0f);
    const jcal_vec3_t b = jcal_vec3(-4.0f, 5.0f, 0.5f);
    assert_vec3(jcal_vec3(-3.0f, 7.0f, 3.5f), jcal_vec3_add(a, b));
    assert_vec3(jcal_vec3(5.0f, -3.0f, 2.5f), jcal_vec3_sub(a, b));
    assert_vec3(jcal_vec3(-2.0f, -4.0f, -6.0f), jcal_vec3_scale(a, -2.0f));
    TEST_ASSERT_EQUAL_FLOAT(7.5f, jcal_vec3_dot(a, b));
    assert_vec3(jcal_vec3(-14.0f, -12.5f, 13.0f), jcal_vec3_cross(a, b));
    TEST_ASSERT_EQUAL_FLOAT(sqrtf(14.0f), jcal_vec3_norm(a));
}

static void normalising_gives_unit_length_and_zero_for_what_has_no_direction(void)
{
    const jcal_vec3_t zero = {0.0f, 0.0f, 0.0f};
    assert_vec3(jcal_vec3(0.0f, 0.6f, -0.8f), jcal_vec3_normalise(jcal_vec3(0.0f, 3.0f, -4.0f)));
    assert_vec3(zero, jcal_vec3_normalise(zero));
    assert_vec3(zero, jcal_vec3_normalise(jcal_vec3(NAN, 1.0f, 1.0f)));
}

static void a_vector_is_finite_only_if_every_component_is(void)
{
    TEST_ASSERT_TRUE(jcal_vec3_is_finite(jcal_vec3(1.0f, 0.0f, -1e38f)));
    TEST_ASSERT_FALSE(jcal_vec3_is_finite(jcal_vec3(NAN, 0.0f, 0.0f)));
    TEST_ASSERT_FALSE(jcal_vec3_is_finite(jcal_vec3(0.0f, INFINITY, 0.0f)));
    TEST_ASSERT_FALSE(jcal_vec3_is_finite(jcal_vec3(0.0f, 0.0f, -INFINITY)));
}

static void a_quarter_turn_about_z_takes_x_to_y(void)
{
    const float h = sqrtf(0.5f);
    const jcal_quat_t q = jcal_quat(h, 0.0f, 0.0f, h);
    assert_vec3(jcal_vec3(0.0f, 1.0f, 0.0f), jcal_quat_rotate(q, jcal_vec3(1.0f, 0.0f, 0.0f)));
    assert_vec3(jcal_vec3(-1.0f, 0.0f, 0.0f), jcal_quat_rotate(q, jcal_vec3(0.0f, 1.0f, 0.0f)));
    assert_vec3(jcal_vec3(0.0f, 0.0f, 1.0f), jcal_quat_rotate(q, jcal_vec3(0.0f, 0.0f, 1.0f)));
}

static void products_chain_from_right_to_left(void)
{
    const jcal_quat_t p = jcal_quat_normalise(jcal_quat(0.3f, -0.5f, 0.7f, 0.2f));
    const jcal_quat_t q = jcal_quat_normalise(jcal_quat(-0.1f, 0.9f, 0.4f, 0.6f));
    const jcal_vec3_t v = jcal_vec3(0.2f, -1.0f, 0.5f);
    assert_vec3(jcal_quat_rotate(p, jcal_quat_rotate(q, v)), jcal_quat_rotate(jcal_quat_mul(p, q), v));
}

static void the_conjugate_turns_back(void)
{
    const jcal_quat_t q = jcal_quat_normalise(jcal_quat(0.3f, -0.5f, 0.7f, 0.2f));
    const jcal_vec3_t v = jcal_vec3(0.2f, -1.0f, 0.5f);
    assert_vec3(v, jcal_quat_rotate(jcal_quat_conj(q), jcal_quat_rotate(q, v)));
    const jcal_quat_t one = jcal_quat_mul(q, jcal_quat_conj(q));
    TEST_ASSERT_FLOAT_WITHIN(TOL, 1.0f, one.w);
    TEST_ASSERT_FLOAT_WITHIN(TOL, 0.0f, fabsf(one.x) + fabsf(one.y) + fabsf(one.z));
}

static void a_quaternion_without_length_becomes_the_identity(void)
{
    const jcal_quat_t zero = jcal_quat_normalise(jcal_quat(0.0f, 0.0f, 0.0f, 0.0f));
    const jcal_quat_t nan = jcal_quat_normalise(jcal_quat(NAN, 0.0f, 0.0f, 0.0f));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, zero.w);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, nan.w);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, zero.x + zero.y + zero.z + nan.x + nan.y + nan.z);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(sums_products_and_norms_of_vectors_are_right);
    RUN_TEST(normalising_gives_unit_length_and_zero_for_what_has_no_direction);
    RUN_TEST(a_vector_is_finite_only_if_every_component_is);
    RUN_TEST(a_quarter_turn_about_z_takes_x_to_y);
    RUN_TEST(products_chain_from_right_to_left);
    RUN_TEST(the_conjugate_turns_back);
    RUN_TEST(a_quaternion_without_length_becomes_the_identity);
    return UNITY_END();
}
