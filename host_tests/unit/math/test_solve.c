/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/math/solve.h.
#include "math/solve.h"

#include "math/sphere.h"
#include "unity.h"

#include <math.h>

static const float matrix_2[3] = {4.0f, 1.0f, 3.0f};
static const float gradient_2[2] = {1.0f, -2.0f};
static const jcal_gn_model_t model_2 = {2, gradient_2, matrix_2};

void setUp(void)
{
}

void tearDown(void)
{
}

static void without_damping_the_step_is_the_newton_step(void)
{
    jcal_gn_t gn = {0.0f};
    float d[2];
    float predicted = 1.0f;
    TEST_ASSERT_TRUE(jcal_gn_step(&gn, &model_2, d, &predicted));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -5.0f / 11.0f, d[0]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 9.0f / 11.0f, d[1]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -23.0f / 22.0f, predicted);
}

static void more_damping_makes_a_shorter_step_downhill(void)
{
    float last = 1e9f;
    for (float damping = 1e-4f; damping < 1e5f; damping *= 10.0f) {
        jcal_gn_t gn = {damping};
        float d[2];
        float predicted = 1.0f;
        TEST_ASSERT_TRUE(jcal_gn_step(&gn, &model_2, d, &predicted));
        TEST_ASSERT_TRUE(jcal_gn_length(d, 2) < last);
        TEST_ASSERT_TRUE(predicted < 0.0f);
        last = jcal_gn_length(d, 2);
    }
}

static void the_prediction_is_the_quadratic_model(void)
{
    const float d[2] = {0.5f, -0.25f};
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f + (0.5f * ((4.0f * 0.25f) - (2.0f * 0.125f) + (3.0f * 0.0625f))),
                             jcal_gn_predict(&model_2, d));
}

static void an_open_direction_is_solved_after_the_damping_has_risen(void)
{
    const float matrix[6] = {1.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f};
    const float gradient[3] = {1.0f, 1.0f, 0.0f};
    const jcal_gn_model_t model = {3, gradient, matrix};
    jcal_gn_t gn = {JCAL_GN_DAMPING_MIN};
    float d[3] = {-5.0f, -5.0f, -5.0f};
    int calls = 1;
    while ((!jcal_gn_step(&gn, &model, d, NULL)) && (calls < 10)) {
        TEST_ASSERT_EQUAL_FLOAT(-5.0f, d[0]);
        ++calls;
    }
    TEST_ASSERT_TRUE((calls > 1) && (calls < 6));
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, -1.0f, d[0]);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, d[2]);
}

static void nan_zero_and_negative_matrices_give_no_step(void)
{
    const float bad_gradient[2] = {NAN, 1.0f};
    const float zero[3] = {0.0f, 0.0f, 0.0f};
    const float with_nan[3] = {1.0f, NAN, 1.0f};
    const float negative[3] = {-1.0f, 0.0f, -1.0f};
    const jcal_gn_model_t models[4] = {
        {2, bad_gradient, matrix_2}, {2, gradient_2, zero}, {2, gradient_2, with_nan}, {2, gradient_2, negative}};
    for (int k = 0; k < 4; ++k) {
        jcal_gn_t gn = jcal_gn_begin();
        float d[2] = {-5.0f, -5.0f};
        float predicted = -7.0f;
        TEST_ASSERT_FALSE(jcal_gn_step(&gn, &models[k], d, &predicted));
        TEST_ASSERT_EQUAL_FLOAT(-5.0f, d[0]);
        TEST_ASSERT_EQUAL_FLOAT(-7.0f, predicted);
        TEST_ASSERT_TRUE(gn.damping > JCAL_GN_DAMPING_START);
    }
}

static void wrong_arguments_are_named(void)
{
    jcal_gn_t gn = jcal_gn_begin();
    float d[2];
    const jcal_gn_model_t none = {0, gradient_2, matrix_2};
    const jcal_gn_model_t many = {JCAL_CHOL_MAX + 1u, gradient_2, matrix_2};
    TEST_ASSERT_FALSE(jcal_gn_step(NULL, &model_2, d, NULL));
    TEST_ASSERT_FALSE(jcal_gn_step(&gn, NULL, d, NULL));
    TEST_ASSERT_FALSE(jcal_gn_step(&gn, &model_2, NULL, NULL));
    TEST_ASSERT_FALSE(jcal_gn_step(&gn, &none, d, NULL));
    TEST_ASSERT_FALSE(jcal_gn_step(&gn, &many, d, NULL));
}

static void judge_keeps_what_lowers_the_cost_and_adapts_the_damping(void)
{
    const float actual[] = {-1.0f, -0.5f, -0.1f, 0.0f, 0.5f, NAN, INFINITY};
    const bool kept[] = {true, true, true, false, false, false, false};
    const float factor[] = {0.2f, 1.0f, 4.0f, 10.0f, 10.0f, 10.0f, 10.0f};
    for (int k = 0; k < 7; ++k) {
        jcal_gn_t gn = {0.5f};
        TEST_ASSERT_EQUAL_INT(kept[k], jcal_gn_judge(&gn, -1.0f, actual[k]));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.5f * factor[k], gn.damping);
    }
}

static void judge_refuses_a_step_that_promises_nothing_or_nonsense(void)
{
    jcal_gn_t gn = {0.5f};
    TEST_ASSERT_FALSE(jcal_gn_judge(&gn, 0.0f, -1.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.5f, gn.damping);
    TEST_ASSERT_FALSE(jcal_gn_judge(&gn, 1.0f, 1.0f));
    TEST_ASSERT_FALSE(jcal_gn_judge(&gn, NAN, -1.0f));
}

static void damping_stays_within_its_limits(void)
{
    jcal_gn_t gn = jcal_gn_begin();
    for (int k = 0; k < 100; ++k) {
        (void)jcal_gn_judge(&gn, -1.0f, -1.0f);
    }
    TEST_ASSERT_EQUAL_FLOAT(JCAL_GN_DAMPING_MIN, gn.damping);
    for (int k = 0; k < 100; ++k) {
        (void)jcal_gn_judge(&gn, -1.0f, 1.0f);
    }
    TEST_ASSERT_EQUAL_FLOAT(JCAL_GN_DAMPING_MAX, gn.damping);
}

static void axes_move_on_their_spheres_and_plain_numbers_on_the_line(void)
{
    jcal_vec3_t axes[2] = {{0.0f, 0.6f, 0.8f}, {1.0f, 0.0f, 0.0f}};
    const jcal_vec3_t before[2] = {{0.0f, 0.6f, 0.8f}, {1.0f, 0.0f, 0.0f}};
    float plain[2] = {1.0f, 2.0f};
    const float d[6] = {0.01f, 0.0f, 0.0f, -0.02f, 0.5f, -0.5f};
    jcal_gn_move(axes, 2, plain, 2, d);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.01f, jcal_sphere_angle(before[0], axes[0]));
    TEST_ASSERT_FLOAT_WITHIN(4e-6f, 0.02f, jcal_sphere_angle(before[1], axes[1]));
    TEST_ASSERT_EQUAL_FLOAT(1.5f, plain[0]);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, plain[1]);
}

/* V(j) = sum (row . j)^2 / 2 over rows that are nearly at right angles to `truth`, on the sphere. */
static const float rows[4][3] = {{0.8f, -0.6f, 0.01f}, {0.0f, 0.02f, 1.0f}, {1.6f, -1.2f, 0.5f}, {-0.4f, 0.29f, 1.0f}};

static float row_residual(int k, jcal_vec3_t j)
{
    return (rows[k][0] * j.x) + (rows[k][1] * j.y) + (rows[k][2] * j.z);
}

static void least_squares_on_the_sphere_converges_from_everywhere(void)
{
    const jcal_vec3_t truth = {0.6f, 0.8f, 0.0f};
    for (int start = 0; start < 6; ++start) {
        jcal_vec3_t j = {(start == 0) ? 1.0f : ((start == 1) ? -1.0f : 0.0f),
                         (start == 2) ? 1.0f : ((start == 3) ? -1.0f : 0.0f),
                         (start == 4) ? 1.0f : ((start == 5) ? -1.0f : 0.0f)};
        jcal_gn_t gn = jcal_gn_begin();
        for (int pass = 0; pass < 30; ++pass) {
            const jcal_tangent_t t = jcal_sphere_tangent(j);
            float gradient[2] = {0.0f, 0.0f};
            float matrix[3] = {0.0f, 0.0f, 0.0f};
            for (int k = 0; k < 4; ++k) {
                const float jac[2] = {row_residual(k, t.u), row_residual(k, t.v)};
                gradient[0] += jac[0] * row_residual(k, j);
                gradient[1] += jac[1] * row_residual(k, j);
                jcal_sym_rank1(matrix, 2, jac, 1.0f);
            }
            const jcal_gn_model_t model = {2, gradient, matrix};
            float d[2];
            float predicted = 0.0f;
            if (!jcal_gn_step(&gn, &model, d, &predicted)) {
                continue;
            }
            jcal_vec3_t trial = j;
            jcal_gn_move(&trial, 1, NULL, 0, d);
            float change = 0.0f;
            for (int k = 0; k < 4; ++k) {
                change += 0.5f * row_residual(k, jcal_vec3_sub(trial, j)) * row_residual(k, jcal_vec3_add(trial, j));
            }
            j = jcal_gn_judge(&gn, predicted, change) ? trial : j;
        }
        TEST_ASSERT_TRUE(jcal_sphere_line_angle(truth, j) < 0.02f);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(without_damping_the_step_is_the_newton_step);
    RUN_TEST(more_damping_makes_a_shorter_step_downhill);
    RUN_TEST(the_prediction_is_the_quadratic_model);
    RUN_TEST(an_open_direction_is_solved_after_the_damping_has_risen);
    RUN_TEST(nan_zero_and_negative_matrices_give_no_step);
    RUN_TEST(wrong_arguments_are_named);
    RUN_TEST(judge_keeps_what_lowers_the_cost_and_adapts_the_damping);
    RUN_TEST(judge_refuses_a_step_that_promises_nothing_or_nonsense);
    RUN_TEST(damping_stays_within_its_limits);
    RUN_TEST(axes_move_on_their_spheres_and_plain_numbers_on_the_line);
    RUN_TEST(least_squares_on_the_sphere_converges_from_everywhere);
    return UNITY_END();
}
