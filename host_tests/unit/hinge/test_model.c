/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/hinge/model.h: moments and derivatives against double precision, sample by sample.
#include "unit/hinge/double.h"
#include "unity.h"

#include <string.h>

enum { SAMPLES = 60, POINTS = 12, N = JCAL_HINGE_TILTS };

/* Float sums of 60 terms: 60 roundings of 6e-8, which partly cancel, relative to the sum of the magnitudes. */
static const double SUM_TOL = 2e-6;
/* Step of the central differences, rad: their error is of the order h^2 = 1e-10. */
static const double STEP = 1e-5;

static dsample_t samples[SAMPLES];
static jcal_hinge_moments_t moments;
static jcal_hinge_config_t cfg;
static jcal_rng_t rng;

void setUp(void)
{
    rng.state = 20;
    memset(&moments, 0, sizeof moments);
    cfg = jcal_hinge_config_default();
    cfg.acc_bias_m_s2 = 0.4f;
    for (int k = 0; k < SAMPLES; ++k) {
        samples[k] = random_sample(&rng);
        add_to_moments(&samples[k], &moments);
    }
}

void tearDown(void)
{
}

static double prior(void)
{
    return 1.0 / (2.0 * (double)cfg.acc_bias_m_s2 * (double)cfg.acc_bias_m_s2);
}

static double cost_gyr(const dpoint_t *p)
{
    double sum = 0.0;
    for (int k = 0; k < SAMPLES; ++k) {
        const double e = de_gyr(&samples[k], p);
        sum += samples[k].gyr_weight * e * e;
    }
    return sum;
}

/* Accelerometer part for a given constant. */
static double cost_acc_with(const dpoint_t *p, double c)
{
    double sum = prior() * c * c;
    for (int k = 0; k < SAMPLES; ++k) {
        const double e = de_acc(&samples[k], p) - c;
        sum += samples[k].acc_weight * e * e;
    }
    return sum;
}

/* The constant that minimises it: vertex of the parabola through three points, exact because it is a parabola. */
static double best_constant(const dpoint_t *p)
{
    const double low = cost_acc_with(p, -1.0);
    const double middle = cost_acc_with(p, 0.0);
    const double high = cost_acc_with(p, 1.0);
    return 0.5 * (low - high) / (low - (2.0 * middle) + high);
}

static double cost_acc(const dpoint_t *p)
{
    return cost_acc_with(p, best_constant(p));
}

static double cost_all(const dpoint_t *p)
{
    return cost_gyr(p) + cost_acc(p);
}

/* The packed matrix holds 12 features: 78 numbers, for which hinge.h has room. */
static void the_twelve_features_are_the_products_of_each_sensors_rates(void)
{
    float z[JCAL_HINGE_FEATURES];
    TEST_ASSERT_EQUAL_INT(12, JCAL_HINGE_FEATURES);
    TEST_ASSERT_EQUAL_size_t(sizeof moments.gyr, JCAL_SYM_SIZE(JCAL_HINGE_FEATURES) * sizeof(float));
    jcal_hinge_features(jcal_vec3(2.0f, 3.0f, 5.0f), jcal_vec3(7.0f, 11.0f, 13.0f), z);
    const float expected[12] = {4.0f,  9.0f,   25.0f,  6.0f,  10.0f, 15.0f, /* xx yy zz xy xz yz of sensor 1 */
                                49.0f, 121.0f, 169.0f, 77.0f, 91.0f, 143.0f};
    for (int i = 0; i < 12; ++i) {
        TEST_ASSERT_EQUAL_FLOAT(expected[i], z[i]); /* small integers: exact */
    }
}

static void features_times_coefficients_are_the_squared_constraint(void)
{
    for (int k = 0; k < SAMPLES; ++k) {
        const jcal_hinge_point_t point = random_point(&rng);
        const dpoint_t p = dpoint(&point);
        float z[JCAL_HINGE_FEATURES];
        float f[JCAL_HINGE_FEATURES];
        double sum = 0.0;
        double size = 0.0;
        jcal_hinge_features(dget(samples[k].w[0]), dget(samples[k].w[1]), z);
        jcal_hinge_coefficients(&point, f);
        for (int i = 0; i < JCAL_HINGE_FEATURES; ++i) {
            sum += (double)z[i] * (double)f[i];
            size += fabs((double)z[i] * (double)f[i]);
        }
        TEST_ASSERT_TRUE(fabs(sum - de_gyr(&samples[k], &p)) < 1e-6 * size); /* j is unit to 1e-7 only */
    }
}

static void costs_equal_direct_sums(void)
{
    for (int pass = 0; pass < POINTS; ++pass) {
        const jcal_hinge_point_t point = random_point(&rng);
        const dpoint_t p = dpoint(&point);
        const double gyr = cost_gyr(&p);
        const double acc = cost_acc(&p);
        TEST_ASSERT_TRUE(fabs((double)jcal_hinge_cost_gyr(&moments, &point) - gyr) < SUM_TOL * gyr);
        TEST_ASSERT_TRUE(fabs((double)jcal_hinge_cost_acc(&moments, &cfg, &point) - acc) < SUM_TOL * acc);
        TEST_ASSERT_TRUE(fabs((double)jcal_hinge_cost(&moments, &cfg, &point) - (gyr + acc)) < SUM_TOL * (gyr + acc));
    }
}

static void the_accelerometer_constant_minimises_its_part(void)
{
    for (int pass = 0; pass < POINTS; ++pass) {
        const jcal_hinge_point_t point = random_point(&rng);
        const dpoint_t p = dpoint(&point);
        const double c = (double)jcal_hinge_acc_constant(&moments, &cfg, &point);
        /* m/s^2; sums of 60 terms up to 15 m/s^2, divided by 60 */
        TEST_ASSERT_TRUE(fabs(c - best_constant(&p)) < 5e-6);
    }
}

static void a_tight_prior_holds_the_constant_at_zero_and_a_wide_one_frees_it(void)
{
    const jcal_hinge_point_t point = random_point(&rng);
    const dpoint_t p = dpoint(&point);
    double mean = 0.0;
    double weight = 0.0;
    for (int k = 0; k < SAMPLES; ++k) {
        mean += samples[k].acc_weight * de_acc(&samples[k], &p);
        weight += samples[k].acc_weight;
    }
    cfg.acc_bias_m_s2 = 1e-4f;
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.0f, jcal_hinge_acc_constant(&moments, &cfg, &point));
    cfg.acc_bias_m_s2 = 5.0f;
    /* The prior then weighs 0.02 beside 9. */
    TEST_ASSERT_FLOAT_WITHIN(0.004f * (float)fabs(mean / weight), (float)(mean / weight),
                             jcal_hinge_acc_constant(&moments, &cfg, &point));
}

static void the_gradient_equals_central_differences_of_the_cost(void)
{
    for (int pass = 0; pass < POINTS; ++pass) {
        const jcal_hinge_point_t point = random_point(&rng);
        const dpoint_t here = dpoint(&point);
        const double size = cost_all(&here);
        const double size_acc = cost_acc(&here);
        jcal_hinge_lin_t lin;
        jcal_hinge_lin_t acc;
        jcal_hinge_linearise(&moments, &cfg, &point, &lin);
        jcal_hinge_linearise_acc(&moments, &cfg, &point, &acc);
        TEST_ASSERT_TRUE(fabs((double)lin.cost_gyr - cost_gyr(&here)) < SUM_TOL * size);
        TEST_ASSERT_TRUE(fabs((double)lin.cost_acc - size_acc) < SUM_TOL * size);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, acc.cost_gyr);
        TEST_ASSERT_TRUE(fabs((double)acc.cost_acc - size_acc) < SUM_TOL * size_acc);
        for (unsigned r = 0; r < N; ++r) {
            const dpoint_t plus = dmoved(&point, r, STEP);
            const dpoint_t minus = dmoved(&point, r, -STEP);
            const double half_slope = (cost_all(&plus) - cost_all(&minus)) / (4.0 * STEP);
            const double half_slope_acc = (cost_acc(&plus) - cost_acc(&minus)) / (4.0 * STEP);
            TEST_ASSERT_TRUE(fabs((double)lin.gradient[r] - half_slope) < 5.0 * SUM_TOL * size);
            TEST_ASSERT_TRUE(fabs((double)acc.gradient[r] - half_slope_acc) < 5.0 * SUM_TOL * size_acc);
        }
    }
}

/* Derivatives of e_w and e_a of one sample by all unknowns. */
static void slopes(const dsample_t *s, const jcal_hinge_point_t *point, double gyr[N], double acc[N])
{
    for (unsigned r = 0; r < N; ++r) {
        const dpoint_t plus = dmoved(point, r, STEP);
        const dpoint_t minus = dmoved(point, r, -STEP);
        gyr[r] = (de_gyr(s, &plus) - de_gyr(s, &minus)) / (2.0 * STEP);
        acc[r] = (de_acc(s, &plus) - de_acc(s, &minus)) / (2.0 * STEP);
    }
}

typedef struct {
    double all[N][N];
    double acc[N][N];
} dmatrix_t;

/* Gauss-Newton matrices, the constant c eliminated as one more linear unknown. */
static dmatrix_t direct_matrix(const jcal_hinge_point_t *point)
{
    dmatrix_t m = {{{0.0}}, {{0.0}}};
    double sums[N] = {0.0};
    double weight = prior();
    for (int k = 0; k < SAMPLES; ++k) {
        double gyr[N];
        double acc[N];
        slopes(&samples[k], point, gyr, acc);
        weight += samples[k].acc_weight;
        for (unsigned i = 0; i < N * N; ++i) {
            m.all[i / N][i % N] += samples[k].gyr_weight * gyr[i / N] * gyr[i % N];
            m.acc[i / N][i % N] += samples[k].acc_weight * acc[i / N] * acc[i % N];
        }
        for (unsigned i = 0; i < N; ++i) {
            sums[i] += samples[k].acc_weight * acc[i];
        }
    }
    for (unsigned i = 0; i < N * N; ++i) {
        m.acc[i / N][i % N] -= sums[i / N] * sums[i % N] / weight;
        m.all[i / N][i % N] += m.acc[i / N][i % N];
    }
    return m;
}

static void the_matrix_equals_direct_sums_of_derivative_products(void)
{
    for (int pass = 0; pass < POINTS; ++pass) {
        const jcal_hinge_point_t point = random_point(&rng);
        const dmatrix_t expected = direct_matrix(&point);
        jcal_hinge_lin_t lin;
        jcal_hinge_lin_t acc;
        memset(&lin, 0x5a, sizeof lin); /* whatever was there before is lost */
        memset(&acc, 0x5a, sizeof acc);
        jcal_hinge_linearise(&moments, &cfg, &point, &lin);
        jcal_hinge_linearise_acc(&moments, &cfg, &point, &acc);
        for (unsigned r = 0; r < N; ++r) {
            for (unsigned c = 0; c <= r; ++c) {
                const double size = sqrt(expected.all[r][r] * expected.all[c][c]);
                const double part = sqrt(expected.acc[r][r] * expected.acc[c][c]);
                TEST_ASSERT_TRUE(fabs((double)lin.matrix[jcal_sym_at(r, c)] - expected.all[r][c]) < 5e-6 * size);
                TEST_ASSERT_TRUE(fabs((double)acc.matrix[jcal_sym_at(r, c)] - expected.acc[r][c]) < 5e-6 * part);
            }
        }
    }
}

static void change_equals_the_difference_of_the_costs(void)
{
    for (float step = 1e-3f; step < 1.0f; step *= 3.0f) {
        const jcal_hinge_point_t from = random_point(&rng);
        jcal_hinge_point_t to = from;
        float d[N];
        for (unsigned i = 0; i < N; ++i) {
            d[i] = step * jcal_rng_symmetric(&rng);
        }
        jcal_hinge_point_move(&to, d);
        const dpoint_t a = dpoint(&from);
        const dpoint_t b = dpoint(&to);
        const double expected = cost_all(&b) - cost_all(&a);
        /* Coefficients are rounded to 6e-8, some of them twice, and are multiplied by sums of the size of the cost. */
        const double tol = 3e-7 * 4.0 * (cost_all(&a) + cost_all(&b));
        TEST_ASSERT_TRUE(fabs((double)jcal_hinge_change(&moments, &cfg, &from, &to) - expected) < tol);
        TEST_ASSERT_TRUE(fabs(expected) > 5.0 * tol); /* else this would compare nothing with nothing */
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_twelve_features_are_the_products_of_each_sensors_rates);
    RUN_TEST(features_times_coefficients_are_the_squared_constraint);
    RUN_TEST(costs_equal_direct_sums);
    RUN_TEST(the_accelerometer_constant_minimises_its_part);
    RUN_TEST(a_tight_prior_holds_the_constant_at_zero_and_a_wide_one_frees_it);
    RUN_TEST(the_gradient_equals_central_differences_of_the_cost);
    RUN_TEST(the_matrix_equals_direct_sums_of_derivative_products);
    RUN_TEST(change_equals_the_difference_of_the_costs);
    return UNITY_END();
}
