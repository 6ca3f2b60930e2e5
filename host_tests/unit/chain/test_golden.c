/* SPDX-License-Identifier: MIT */
/// @file
/// What ties hip and knee, one observation after the other in float32, against least squares over all of them at once in float64,
/// tools/maintain/make_golden.py.
#include "chain/tie.h"
#include "golden/chain.h"
#include "math/sym.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define N JCAL_CHAIN_STATES

/* At most five observations, each a product of 18 terms and some ten operations more on every element: 140 roundings of up to 6e-8,
 * which do not all point the same way, so that about the root of their number counts; of what was known before, which no tie makes
 * more. In units of the standard deviations before. */
static const double COVARIANCE_TOL = 1e-6;
/* An observation moves no mean by more than three standard deviations; and how far away it is takes differences of lengths of 0.5 m,
 * whose roundings of 3e-8 m are 1e-5 of the tolerances of 5 mm and more. */
static const double MEAN_TOL = 5e-5;

void setUp(void)
{
}

void tearDown(void)
{
}

static void begin(size_t which, jcal_chain_state_t *state)
{
    (void)memcpy(state->x, golden_means[which], sizeof state->x);
    (void)memcpy(state->covariance, golden_covariances[which], sizeof state->covariance);
}

/* Standard deviation of one state before any tie. */
static double deviation_of(size_t which, size_t i)
{
    return sqrt((double)golden_covariances[which][jcal_sym_at(i, i)]);
}

static void assert_state(size_t which, const double *mean, const double *covariance, const jcal_chain_state_t *state)
{
    for (size_t i = 0u; i < N; ++i) {
        const double unit = deviation_of(which, i);
        TEST_ASSERT_TRUE(fabs((double)state->x[i] - mean[i]) <= MEAN_TOL * unit);
        for (size_t j = 0u; j <= i; ++j) {
            const size_t at = jcal_sym_at(i, j);
            TEST_ASSERT_TRUE(fabs((double)state->covariance[at] - covariance[at]) <=
                             COVARIANCE_TOL * unit * deviation_of(which, j));
        }
    }
}

static void the_states_have_the_size_of_the_reference(void)
{
    TEST_ASSERT_EQUAL_UINT32(N, GOLDEN_STATES);
    TEST_ASSERT_EQUAL_UINT32(JCAL_SYM_SIZE(N), sizeof golden_covariances[0] / sizeof golden_covariances[0][0]);
}

static jcal_chain_config_t config_of(const float *tie)
{
    jcal_chain_config_t config = jcal_chain_config_default();
    config.center.acc_bias_m_s2 = (tie[0] > 0.0f) ? config.center.acc_bias_m_s2 : 0.0f;
    config.plane_normal = (jcal_vec3_t){tie[1], tie[2], tie[3]};
    config.plane_tolerance_m = tie[4];
    config.segment_length_m = tie[5];
    config.segment_tolerance_m = tie[6];
    return config;
}

static void ties_are_the_least_squares_of_all_at_once(void)
{
    for (size_t k = 0u; k < GOLDEN_CASES; ++k) {
        const jcal_chain_config_t config = config_of(golden_ties[k]);
        jcal_chain_state_t state;
        begin(k, &state);
        const bool fits = golden_ties[k][7] > 0.0f;
        TEST_ASSERT_TRUE(jcal_chain_tie(&config, &state) == fits);
        assert_state(k, golden_tied_means[k], golden_tied_covariances[k], &state);
    }
}

static void biases_are_no_states_of_vectors_by_orientations(void)
{
    jcal_chain_config_t config = config_of(golden_ties[0]); /* nothing but biases */
    config.center.method = JCAL_CENTER_LS;
    jcal_chain_state_t state;
    begin(0u, &state);
    TEST_ASSERT_TRUE(jcal_chain_tie(&config, &state));
    TEST_ASSERT_EQUAL_MEMORY(golden_means[0], state.x, sizeof state.x);
    TEST_ASSERT_EQUAL_MEMORY(golden_covariances[0], state.covariance, sizeof state.covariance);
}

static void observations_in_any_order_are_the_least_squares_of_all_at_once(void)
{
    for (size_t first = 0u; first < GOLDEN_OBSERVED; ++first) {
        jcal_chain_state_t state;
        begin(0u, &state);
        for (size_t k = 0u; k < GOLDEN_OBSERVED; ++k) {
            const float *const row = golden_observations[(first + k) % GOLDEN_OBSERVED];
            float predicted = 0.0f;
            for (size_t i = 0u; i < N; ++i) {
                predicted += row[i] * state.x[i];
            }
            TEST_ASSERT_TRUE(jcal_chain_observe(&state, row, row[N] - predicted, row[N + 1u]));
        }
        assert_state(0u, golden_observed_mean[0], golden_observed_covariance[0], &state);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_states_have_the_size_of_the_reference);
    RUN_TEST(ties_are_the_least_squares_of_all_at_once);
    RUN_TEST(biases_are_no_states_of_vectors_by_orientations);
    RUN_TEST(observations_in_any_order_are_the_least_squares_of_all_at_once);
    return UNITY_END();
}
