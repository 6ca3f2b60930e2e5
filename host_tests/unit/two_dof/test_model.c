/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of two_dof/model.h and two_dof/prior.h against sums over samples and finite differences in double precision.
#include "math/sym.h"
#include "two_dof/model.h"
#include "two_dof/prior.h"
#include "unit/two_dof/double.h"

#include <string.h>
#include <unity.h>

#define SAMPLES 40

static double_sample_t samples[SAMPLES];
static jcal_two_dof_moments_t moments;

/* Weights of the two kinds, anything but one. */
static const float W_RATE = 3.0f;
static const float W_ANGLE = 0.7f;

void setUp(void)
{
    memset(&moments, 0, sizeof moments);
    for (int k = 0; k < SAMPLES; ++k) {
        samples[k] = (double_sample_t){pose_single(pose_any(7 * k + 1)),
                                       pose_single(pose_any(17 * k + 2)),
                                       {(float)sin(1.1 * k), (float)(2.0 * cos(0.7 * k)), (float)sin(2.1 * k + 1.0)},
                                       {(float)cos(1.3 * k), (float)sin(0.5 * k), (float)(1.5 * cos(1.9 * k))}};
        const jcal_two_dof_sample_t sample = {samples[k].q1, samples[k].q2, samples[k].w1, samples[k].w2};
        float f[JCAL_TWO_DOF_FEATURES];
        float g[JCAL_TWO_DOF_FEATURES];
        jcal_two_dof_rotation_features(&sample, f);
        jcal_two_dof_orientation_features(sample.q1, sample.q2, g);
        jcal_two_dof_add(moments.rotation, f, W_RATE);
        jcal_two_dof_add(moments.orientation, g, W_ANGLE);
        for (int i = 0; i < JCAL_TWO_DOF_FEATURES; ++i) {
            moments.mean[i] += W_ANGLE * g[i];
        }
        moments.weight += W_ANGLE;
    }
}

void tearDown(void)
{
}

/* g of one sample. */
static double sine_of(const double_sample_t *s, const unknowns_t *x)
{
    unknowns_t zero = *x;
    zero.sine = 0.0;
    return residual_double(s, JCAL_CONSTRAINT_ORIENTATION, &zero);
}

/* (7) without its denominator |n|, |n|^2 = 1 - g^2. */
static double numerator_of(const double_sample_t *s, const unknowns_t *x)
{
    const double g = sine_of(s, x);
    return residual_double(s, JCAL_CONSTRAINT_ROTATION, x) * sqrt(1.0 - g * g);
}

/* The cost as the header states it, summed over samples. */
static double cost_of(jcal_constraint_t constraint, const unknowns_t *x, double *parts)
{
    double n2 = 0.0;
    double g1 = 0.0;
    double g2 = 0.0;
    for (int k = 0; k < SAMPLES; ++k) {
        const double n = numerator_of(&samples[k], x);
        const double g = sine_of(&samples[k], x);
        n2 += (double)W_RATE * n * n;
        g1 += (double)W_ANGLE * g;
        g2 += (double)W_ANGLE * g * g;
    }
    const double weight = (double)W_ANGLE * SAMPLES;
    parts[0] = (constraint == JCAL_CONSTRAINT_ORIENTATION) ? 0.0 : (n2 / (1.0 - g2 / weight));
    parts[1] = (constraint == JCAL_CONSTRAINT_ROTATION) ? 0.0 : (g2 - g1 * g1 / weight);
    return parts[0] + parts[1];
}

static jcal_two_dof_lin_t lin_at(jcal_constraint_t constraint, const jcal_two_dof_point_t *point, float *parts)
{
    jcal_two_dof_lin_t lin;
    jcal_two_dof_form(moments.rotation, point, &lin);
    jcal_two_dof_combine(&moments, constraint, point, &lin, parts);
    return lin;
}

static void features_times_phi_are_the_constraints(void)
{
    for (int k = 0; k < SAMPLES; ++k) {
        const jcal_two_dof_sample_t sample = {samples[k].q1, samples[k].q2, samples[k].w1, samples[k].w2};
        const jcal_two_dof_point_t point = point_of(k);
        const unknowns_t x = moved(&point, 0.0f, 0, 0.0);
        float f[JCAL_TWO_DOF_FEATURES];
        jcal_two_dof_rotation_features(&sample, f);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, numerator_of(&samples[k], &x), (double)jcal_two_dof_value(f, &point));
        jcal_two_dof_orientation_features(sample.q1, sample.q2, f);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, sine_of(&samples[k], &x), (double)jcal_two_dof_value(f, &point));
    }
}

static void the_cost_is_the_sum_over_samples(void)
{
    for (int k = 0; k < 30; ++k) {
        const jcal_two_dof_point_t point = point_of(k);
        const unknowns_t x = moved(&point, 0.0f, 0, 0.0);
        for (int c = 0; c < 3; ++c) {
            double parts[2];
            float got[2];
            const double cost = cost_of((jcal_constraint_t)c, &x, parts);
            const jcal_two_dof_lin_t lin = lin_at((jcal_constraint_t)c, &point, got);
            TEST_ASSERT_DOUBLE_WITHIN(2e-5 * cost, cost, (double)lin.cost);
            if (c == (int)JCAL_CONSTRAINT_COMBINED) {
                TEST_ASSERT_DOUBLE_WITHIN(2e-5 * cost, parts[0], (double)got[0]);
                TEST_ASSERT_DOUBLE_WITHIN(2e-5 * cost, parts[1], (double)got[1]);
            }
        }
    }
}

static void the_gradient_is_half_the_costs_slope(void)
{
    const double h = 1e-5;
    for (int k = 0; k < 30; ++k) {
        const jcal_two_dof_point_t point = point_of(k);
        for (int c = 0; c < 3; ++c) {
            const jcal_two_dof_lin_t lin = lin_at((jcal_constraint_t)c, &point, NULL);
            for (int i = 0; i < 5; ++i) {
                const unknowns_t on = moved(&point, 0.0f, i, h);
                const unknowns_t back = moved(&point, 0.0f, i, -h);
                double parts[2];
                const double slope =
                    (cost_of((jcal_constraint_t)c, &on, parts) - cost_of((jcal_constraint_t)c, &back, parts)) /
                    (4.0 * h);
                TEST_ASSERT_DOUBLE_WITHIN(1e-4 * (double)lin.cost, slope, (double)lin.gradient[i]);
            }
        }
    }
}

static void the_matrix_is_made_of_the_residuals_slopes(void)
{
    /* Orientation-based: slopes of g less their mean. Rotation-based: slopes of the numerator over the root of the mean of |n|^2,
       that root held: the denominator's own slope is no part of a Gauss-Newton matrix. */
    const double h = 1e-5;
    for (int k = 0; k < 10; ++k) {
        const jcal_two_dof_point_t point = point_of(k);
        const unknowns_t at = moved(&point, 0.0f, 0, 0.0);
        double g2 = 0.0;
        double slope_g[SAMPLES][5];
        double slope_n[SAMPLES][5];
        double mean[5] = {0.0};
        for (int n = 0; n < SAMPLES; ++n) {
            const double g = sine_of(&samples[n], &at);
            g2 += g * g / SAMPLES;
            for (int i = 0; i < 5; ++i) {
                const unknowns_t on = moved(&point, 0.0f, i, h);
                const unknowns_t back = moved(&point, 0.0f, i, -h);
                slope_g[n][i] = (sine_of(&samples[n], &on) - sine_of(&samples[n], &back)) / (2.0 * h);
                slope_n[n][i] = (numerator_of(&samples[n], &on) - numerator_of(&samples[n], &back)) / (2.0 * h);
                mean[i] += slope_g[n][i] / SAMPLES;
            }
        }
        const jcal_two_dof_lin_t orientation = lin_at(JCAL_CONSTRAINT_ORIENTATION, &point, NULL);
        const jcal_two_dof_lin_t both = lin_at(JCAL_CONSTRAINT_COMBINED, &point, NULL);
        for (unsigned i = 0; i < 5u; ++i) {
            for (unsigned j = 0; j <= i; ++j) {
                double from_g = 0.0;
                double from_n = 0.0;
                for (int n = 0; n < SAMPLES; ++n) {
                    from_g += (double)W_ANGLE * (slope_g[n][i] - mean[i]) * (slope_g[n][j] - mean[j]);
                    from_n += (double)W_RATE * slope_n[n][i] * slope_n[n][j] / (1.0 - g2);
                }
                const size_t place = jcal_sym_at(i, j);
                TEST_ASSERT_DOUBLE_WITHIN(1e-3, from_g, (double)orientation.matrix[place]);
                TEST_ASSERT_DOUBLE_WITHIN(5e-3, from_g + from_n, (double)both.matrix[place]);
            }
        }
    }
}

static void costs_of_many_headings_are_those_of_each(void)
{
    const jcal_two_dof_point_t point = point_of(4);
    jcal_two_dof_guess_t guesses[8];
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < 8; ++i) {
            guesses[i].heading = (jcal_plane_t){(float)cos(0.8 * i), (float)sin(0.8 * i)};
        }
        jcal_two_dof_costs(&moments, (jcal_constraint_t)c, &point, guesses, 8u);
        for (int i = 0; i < 8; ++i) {
            jcal_two_dof_point_t there = point;
            there.heading = guesses[i].heading;
            const jcal_two_dof_lin_t lin = lin_at((jcal_constraint_t)c, &there, NULL);
            TEST_ASSERT_FLOAT_WITHIN(1e-4f * lin.cost, lin.cost, guesses[i].cost);
        }
    }
}

static void the_mean_is_that_of_the_sines(void)
{
    const jcal_two_dof_point_t point = point_of(9);
    const unknowns_t x = moved(&point, 0.0f, 0, 0.0);
    double mean = 0.0;
    for (int k = 0; k < SAMPLES; ++k) {
        mean += sine_of(&samples[k], &x) / SAMPLES;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, mean, (double)jcal_two_dof_mean(&moments, &point));
}

static void sums_of_nothing_cost_nothing(void)
{
    const jcal_two_dof_point_t point = point_of(4);
    jcal_two_dof_guess_t guess = {{1.0f, 0.0f}, 1.0f};
    memset(&moments, 0, sizeof moments);
    jcal_two_dof_costs(&moments, JCAL_CONSTRAINT_COMBINED, &point, &guess, 1u);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, lin_at(JCAL_CONSTRAINT_COMBINED, &point, NULL).cost);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, guess.cost);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_two_dof_mean(&moments, &point));
}

static void turned_sums_are_those_of_another_heading(void)
{
    const double angle = 0.37;
    jcal_two_dof_turn(&moments, (jcal_plane_t){(float)cos(angle), (float)sin(angle)});
    for (int k = 0; k < 10; ++k) {
        jcal_two_dof_point_t before = point_of(k);
        jcal_two_dof_point_t after = before;
        const jcal_plane_t turn = {(float)cos(angle), (float)sin(angle)};
        after.heading = jcal_plane_times(before.heading, turn);
        const unknowns_t x = moved(&before, 0.0f, 0, 0.0);
        double parts[2];
        const double cost = cost_of(JCAL_CONSTRAINT_COMBINED, &x, parts);
        const jcal_two_dof_lin_t lin = lin_at(JCAL_CONSTRAINT_COMBINED, &after, NULL);
        TEST_ASSERT_DOUBLE_WITHIN(5e-5 * cost, cost, (double)lin.cost);
    }
}

static void fading_is_a_factor(void)
{
    const jcal_two_dof_moments_t before = moments;
    const jcal_two_dof_point_t point = point_of(2);
    const float mean = jcal_two_dof_mean(&moments, &point);
    jcal_two_dof_fade(&moments, 0.75f);
    TEST_ASSERT_EQUAL_FLOAT(0.75f * before.rotation[377], moments.rotation[377]);
    TEST_ASSERT_EQUAL_FLOAT(0.75f * before.orientation[100], moments.orientation[100]);
    TEST_ASSERT_EQUAL_FLOAT(0.75f * before.mean[26], moments.mean[26]);
    TEST_ASSERT_EQUAL_FLOAT(0.75f * before.weight, moments.weight);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, mean, jcal_two_dof_mean(&moments, &point));
}

/* What is remembered of forgotten samples. */

/* A point `size` rad from `from` along unknown `which`. */
static jcal_two_dof_point_t step_from(const jcal_two_dof_point_t *from, int which, float size)
{
    jcal_two_dof_point_t to = *from;
    float d[5] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    d[which] = size;
    jcal_two_dof_point_move(&to, d);
    return to;
}

static void the_prior_is_the_sums_with_the_heading_eliminated(void)
{
    const jcal_two_dof_point_t point = point_of(6);
    const jcal_two_dof_lin_t lin = lin_at(JCAL_CONSTRAINT_COMBINED, &point, NULL);
    jcal_two_dof_prior_t prior = {0};
    jcal_two_dof_prior_take(&prior, &point, &lin, 0.25f);
    const float own = lin.matrix[jcal_sym_at(4u, 4u)];
    for (unsigned i = 0; i < 4u; ++i) {
        const float across = lin.matrix[jcal_sym_at(4u, i)];
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * lin.cost, 0.25f * (lin.gradient[i] - (across * lin.gradient[4] / own)),
                                 prior.gradient[i]);
        for (unsigned j = 0; j <= i; ++j) {
            const float expected =
                0.25f * (lin.matrix[jcal_sym_at(i, j)] - (across * lin.matrix[jcal_sym_at(4u, j)] / own));
            TEST_ASSERT_FLOAT_WITHIN(1e-4f * own, expected, prior.matrix[jcal_sym_at(i, j)]);
        }
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.0f, jcal_two_dof_prior_cost(&prior, &point));
}

static void the_priors_slopes_are_those_of_its_cost(void)
{
    const jcal_two_dof_point_t anchor = point_of(6);
    const jcal_two_dof_lin_t lin = lin_at(JCAL_CONSTRAINT_COMBINED, &anchor, NULL);
    jcal_two_dof_prior_t prior = {0};
    jcal_two_dof_prior_take(&prior, &anchor, &lin, 0.5f);
    jcal_two_dof_point_t point = step_from(&anchor, 0, 0.2f);
    point = step_from(&point, 3, -0.15f);
    const jcal_two_dof_lin_t none = {0};
    jcal_two_dof_lin_t all;
    jcal_two_dof_prior_apply(&prior, &point, &none, &all);
    TEST_ASSERT_EQUAL_FLOAT(jcal_two_dof_prior_cost(&prior, &point), all.cost);
    const float h = 1e-2f;
    for (int i = 0; i < 5; ++i) {
        const jcal_two_dof_point_t on = step_from(&point, i, h);
        const jcal_two_dof_point_t back = step_from(&point, i, -h);
        const float slope =
            (jcal_two_dof_prior_cost(&prior, &on) - jcal_two_dof_prior_cost(&prior, &back)) / (4.0f * h);
        TEST_ASSERT_FLOAT_WITHIN(2e-3f * prior.matrix[0], slope, all.gradient[i]);
    }
    /* curvature of the offsets is left out: their slope is that of a projection, so the second difference is the matrix up to it */
    for (unsigned i = 0; i < 4u; ++i) {
        TEST_ASSERT_TRUE(all.matrix[jcal_sym_at(i, i)] > 0.0f);
    }
    TEST_ASSERT_EQUAL_FLOAT(0.0f, all.matrix[jcal_sym_at(4u, 4u)]);
}

static void the_prior_adds_to_what_the_sums_say(void)
{
    const jcal_two_dof_point_t point = point_of(6);
    const jcal_two_dof_lin_t lin = lin_at(JCAL_CONSTRAINT_COMBINED, &point, NULL);
    jcal_two_dof_prior_t prior = {0};
    jcal_two_dof_prior_take(&prior, &point, &lin, 0.5f);
    const jcal_two_dof_point_t near = step_from(&point, 1, 0.1f);
    const jcal_two_dof_lin_t none = {0};
    jcal_two_dof_lin_t alone;
    jcal_two_dof_lin_t both;
    jcal_two_dof_prior_apply(&prior, &near, &none, &alone);
    jcal_two_dof_prior_apply(&prior, &near, &lin, &both);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f * both.cost, lin.cost + alone.cost, both.cost);
    for (unsigned i = 0; i < 15u; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(1e-5f * both.cost, lin.matrix[i] + alone.matrix[i], both.matrix[i]);
    }
    TEST_ASSERT_EQUAL_FLOAT(lin.gradient[4], both.gradient[4]);
}

static void another_anchor_keeps_the_priors_form(void)
{
    const jcal_two_dof_point_t first = point_of(6);
    const jcal_two_dof_lin_t lin = lin_at(JCAL_CONSTRAINT_COMBINED, &first, NULL);
    const jcal_two_dof_lin_t none = {0};
    jcal_two_dof_prior_t prior = {0};
    jcal_two_dof_prior_take(&prior, &first, &lin, 0.5f);
    const jcal_two_dof_point_t second = step_from(&first, 2, 0.02f);
    const jcal_two_dof_point_t near = step_from(&second, 1, 0.03f);
    jcal_two_dof_lin_t before;
    jcal_two_dof_lin_t after;
    jcal_two_dof_prior_apply(&prior, &near, &none, &before);
    jcal_two_dof_prior_take(&prior, &second, &none, 0.5f);
    jcal_two_dof_prior_apply(&prior, &near, &none, &after);
    for (unsigned i = 0; i < 4u; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(5e-3f * before.matrix[jcal_sym_at(i, i)], before.gradient[i], after.gradient[i]);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.0f, jcal_two_dof_prior_cost(&prior, &second)); /* a constant is left out */
}

static void axes_are_lines_to_the_prior(void)
{
    const jcal_two_dof_point_t point = point_of(6);
    const jcal_two_dof_lin_t lin = lin_at(JCAL_CONSTRAINT_COMBINED, &point, NULL);
    jcal_two_dof_prior_t prior = {0};
    jcal_two_dof_prior_take(&prior, &point, &lin, 0.5f);
    const jcal_two_dof_point_t near = step_from(&point, 0, 0.05f);
    jcal_two_dof_point_t turned = near;
    turned.j1 = jcal_vec3_scale(near.j1, -1.0f);
    turned.j2 = jcal_vec3_scale(near.j2, -1.0f);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f * prior.matrix[0], jcal_two_dof_prior_cost(&prior, &near),
                             jcal_two_dof_prior_cost(&prior, &turned));
}

static void the_prior_is_limited(void)
{
    const jcal_two_dof_point_t point = point_of(6);
    jcal_two_dof_lin_t lin = lin_at(JCAL_CONSTRAINT_COMBINED, &point, NULL);
    for (unsigned i = 0; i < 15u; ++i) {
        lin.matrix[i] *= 1e6f;
    }
    for (unsigned i = 0; i < 5u; ++i) {
        lin.gradient[i] *= 1e6f;
    }
    jcal_two_dof_prior_t prior = {0};
    for (int k = 0; k < 10; ++k) {
        jcal_two_dof_prior_take(&prior, &point, &lin, 1.0f);
    }
    float trace = 0.0f;
    for (unsigned i = 0; i < 4u; ++i) {
        trace += prior.matrix[jcal_sym_at(i, i)];
    }
    TEST_ASSERT_FLOAT_WITHIN(50.0f, 5e6f, trace); /* 0.05 deg for each of the four tilts */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(features_times_phi_are_the_constraints);
    RUN_TEST(the_cost_is_the_sum_over_samples);
    RUN_TEST(the_gradient_is_half_the_costs_slope);
    RUN_TEST(the_matrix_is_made_of_the_residuals_slopes);
    RUN_TEST(costs_of_many_headings_are_those_of_each);
    RUN_TEST(the_mean_is_that_of_the_sines);
    RUN_TEST(sums_of_nothing_cost_nothing);
    RUN_TEST(turned_sums_are_those_of_another_heading);
    RUN_TEST(fading_is_a_factor);
    RUN_TEST(the_prior_is_the_sums_with_the_heading_eliminated);
    RUN_TEST(the_priors_slopes_are_those_of_its_cost);
    RUN_TEST(the_prior_adds_to_what_the_sums_say);
    RUN_TEST(another_anchor_keeps_the_priors_form);
    RUN_TEST(axes_are_lines_to_the_prior);
    RUN_TEST(the_prior_is_limited);
    return UNITY_END();
}
