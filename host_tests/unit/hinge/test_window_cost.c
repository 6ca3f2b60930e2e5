/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/hinge/window_residual.h, hinge/window_cost.h and hinge/window_accept.h: OLS20 formulas against double precision.
#include "hinge/window_accept.h"
#include "hinge/window_cost.h"
#include "hinge/window_residual.h"
#include "math/angle.h"
#include "math/rng.h"
#include "unity.h"

#include <math.h>

enum { GYR = 90, ACC = 70 };

static jcal_row_t gyr[GYR];
static jcal_row_t acc[ACC];
static float ata[21];
static jcal_hinge_rows_t rows;

void setUp(void)
{
    jcal_rng_t rng = {77};
    for (int k = 0; k < GYR; ++k) {
        for (int i = 0; i < 6; ++i) {
            gyr[k].v[i] = 3.0f * jcal_rng_symmetric(&rng);
        }
    }
    jcal_sym_zero(ata, 6);
    for (int k = 0; k < ACC; ++k) {
        for (int i = 0; i < 6; ++i) {
            acc[k].v[i] = 9.0f * jcal_rng_symmetric(&rng);
        }
        jcal_sym_rank1(ata, 6, acc[k].v, 1.0f);
    }
    rows = (jcal_hinge_rows_t){{gyr, &gyr[30]}, {30, GYR - 30}, acc, ACC, ata, 50.0f};
}

void tearDown(void)
{
}

static double across(const float *w, const double *j)
{
    const double c[3] = {((double)w[1] * j[2]) - ((double)w[2] * j[1]), ((double)w[2] * j[0]) - ((double)w[0] * j[2]),
                         ((double)w[0] * j[1]) - ((double)w[1] * j[0])};
    return sqrt((c[0] * c[0]) + (c[1] * c[1]) + (c[2] * c[2]));
}

static double residual_gyr(const float *w, const double *j)
{
    return across(w, j) - across(&w[3], &j[3]);
}

static double residual_acc(const float *a, const double *j)
{
    double e = 0.0;
    for (int i = 0; i < 6; ++i) {
        e += (double)a[i] * j[i];
    }
    return e;
}

/* (j1, j2) moved by h in one tangent coordinate and brought back to unit length. */
static void moved(const jcal_hinge_axes_t *axes, int coordinate, double h, double out[6])
{
    for (int s = 0; s < 2; ++s) {
        const jcal_vec3_t j = axes->j[s];
        const jcal_tangent_t t = jcal_sphere_tangent(j);
        const jcal_vec3_t b = ((coordinate % 2) == 0) ? t.u : t.v;
        const double step = (coordinate / 2 == s) ? h : 0.0;
        const double v[3] = {(double)j.x + (step * (double)b.x), (double)j.y + (step * (double)b.y),
                             (double)j.z + (step * (double)b.z)};
        const double norm = sqrt((v[0] * v[0]) + (v[1] * v[1]) + (v[2] * v[2]));
        for (int i = 0; i < 3; ++i) {
            out[(3 * s) + i] = v[i] / norm;
        }
    }
}

static double slope(double (*residual)(const float *, const double *), const float *row, const jcal_hinge_axes_t *axes,
                    int coordinate)
{
    const double h = 1e-5;
    double plus[6];
    double minus[6];
    moved(axes, coordinate, h, plus);
    moved(axes, coordinate, -h, minus);
    return (residual(row, plus) - residual(row, minus)) / (2.0 * h);
}

static jcal_hinge_axes_t random_axes(jcal_rng_t *rng)
{
    jcal_hinge_axes_t axes;
    axes.j[0] = jcal_rng_unit(rng);
    axes.j[1] = jcal_rng_unit(rng);
    return axes;
}

static void gyroscope_jacobian_equals_central_differences(void)
{
    jcal_rng_t rng = {1};
    for (int pass = 0; pass < 20; ++pass) {
        const jcal_hinge_axes_t axes = random_axes(&rng);
        const jcal_hinge_frame_t frames[2] = {jcal_hinge_frame(axes.j[0]), jcal_hinge_frame(axes.j[1])};
        double j[6];
        moved(&axes, 0, 0.0, j);
        for (int k = 0; k < GYR; ++k) {
            float jac[4];
            const float e = jcal_hinge_gyr_residual(frames, gyr[k].v, jac);
            TEST_ASSERT_FLOAT_WITHIN(3e-6f, (float)residual_gyr(gyr[k].v, j), e);
            const double nearest = fmin(across(gyr[k].v, j), across(&gyr[k].v[3], &j[3]));
            for (int i = 0; i < 4; ++i) {
                const float tol = (nearest < 0.05) ? 1e-3f : 2e-5f;
                TEST_ASSERT_FLOAT_WITHIN(tol, (float)slope(residual_gyr, gyr[k].v, &axes, i), jac[i]);
            }
        }
    }
}

static void a_rate_along_the_axis_has_no_derivative_and_no_nan(void)
{
    const jcal_hinge_frame_t frames[2] = {jcal_hinge_frame(jcal_vec3(0.0f, 0.0f, 1.0f)),
                                          jcal_hinge_frame(jcal_vec3(1.0f, 0.0f, 0.0f))};
    const float zero[6] = {0.0f};
    const float along[6] = {0.0f, 0.0f, 2.0f, -3.0f, 0.0f, 0.0f};
    const float tiny[6] = {1e-30f, 0.0f, 2.0f, -3.0f, 1e-30f, 0.0f};
    const float *cases[3] = {zero, along, tiny};
    for (int c = 0; c < 3; ++c) {
        float jac[4];
        TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_hinge_gyr_residual(frames, cases[c], jac));
        for (int i = 0; i < 4; ++i) {
            TEST_ASSERT_EQUAL_FLOAT(0.0f, jac[i]);
        }
    }
}

static void sums_equal_double_precision(void)
{
    jcal_rng_t rng = {2};
    for (int pass = 0; pass < 10; ++pass) {
        const jcal_hinge_axes_t axes = random_axes(&rng);
        double j[6];
        double cost = 0.0;
        double gradient[4] = {0.0};
        double matrix[4][4] = {{0.0}};
        jcal_hinge_sums_t sums;
        moved(&axes, 0, 0.0, j);
        for (int k = 0; k < GYR + ACC; ++k) {
            const bool is_gyr = k < GYR;
            double (*const residual)(const float *, const double *) = is_gyr ? residual_gyr : residual_acc;
            const float *const row = is_gyr ? gyr[k].v : acc[k - GYR].v;
            const double weight = is_gyr ? 50.0 : 1.0 / 50.0;
            const double e = residual(row, j);
            double jac[4];
            cost += weight * e * e;
            for (int i = 0; i < 4; ++i) {
                jac[i] = slope(residual, row, &axes, i);
                gradient[i] += weight * jac[i] * e;
            }
            for (int i = 0; i < 16; ++i) {
                matrix[i / 4][i % 4] += weight * jac[i / 4] * jac[i % 4];
            }
        }
        jcal_hinge_cost_sums(&rows, &axes, &sums);
        TEST_ASSERT_EQUAL_size_t(GYR, sums.gyr.n);
        TEST_ASSERT_EQUAL_size_t(ACC, sums.acc.n);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f * (float)cost, (float)cost, sums.cost);
        for (int i = 0; i < 4; ++i) {
            TEST_ASSERT_FLOAT_WITHIN(1e-4f * (float)cost, (float)gradient[i], sums.gradient[i]);
            for (int k = 0; k <= i; ++k) {
                TEST_ASSERT_FLOAT_WITHIN(1e-3f * (float)matrix[i][i], (float)matrix[i][k],
                                         sums.matrix[jcal_sym_at((size_t)i, (size_t)k)]);
            }
        }
    }
}

static void change_of_cost_is_exact_even_for_the_smallest_steps(void)
{
    jcal_rng_t rng = {3};
    for (float step = 1e-5f; step < 2.0f; step *= 3.0f) {
        const jcal_hinge_axes_t from = random_axes(&rng);
        jcal_hinge_axes_t to = from;
        for (int s = 0; s < 2; ++s) {
            const jcal_tangent_t t = jcal_sphere_tangent(from.j[s]);
            to.j[s] = jcal_sphere_move(from.j[s], &t, step * jcal_rng_symmetric(&rng), step * jcal_rng_symmetric(&rng));
        }
        double a[6];
        double b[6];
        moved(&from, 0, 0.0, a);
        moved(&to, 0, 0.0, b);
        double change = 0.0;
        double size = 0.0;
        for (int k = 0; k < GYR + ACC; ++k) {
            const double ea = (k < GYR) ? residual_gyr(gyr[k].v, a) : residual_acc(acc[k - GYR].v, a);
            const double eb = (k < GYR) ? residual_gyr(gyr[k].v, b) : residual_acc(acc[k - GYR].v, b);
            const double weight = (k < GYR) ? 50.0 : 1.0 / 50.0;
            change += 0.5 * weight * (eb - ea) * (eb + ea);
            size += 0.5 * weight * fabs((eb - ea) * (eb + ea));
        }
        const double tol = 1e-6 * size; /* a few roundings per term; the rounding of the axes does not count */
        TEST_ASSERT_TRUE(fabs((double)jcal_hinge_cost_change(&rows, &from, &to) - change) < tol);
    }
}

static void samples_without_rates_change_nothing(void)
{
    const jcal_row_t still[1] = {{0.0f, 0, {0.0f}}};
    const jcal_hinge_rows_t none = {{still, still}, {1, 0}, acc, 0, ata, 50.0f};
    const jcal_hinge_axes_t from = {{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}}};
    const jcal_hinge_axes_t to = {{{0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}};
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_hinge_cost_change(&none, &from, &to));
}

static void local_uncertainty_is_that_of_57_and_58(void)
{
    jcal_hinge_sums_t sums = {0};
    float local[2];
    sums.gyr = (jcal_hinge_kind_t){101, 10.1f, 5.01f, {0.0f}, {0.0f}}; /* variance (5.01 - 1.01) / 100 = 0.04 */
    sums.acc = (jcal_hinge_kind_t){11, 0.0f, 2.5f, {0.0f}, {0.0f}};    /* variance 0.25 */
    for (size_t i = 0; i < 4; ++i) {
        sums.gyr.matrix[jcal_sym_at(i, i)] = (i < 2) ? 4.0f : 1.0f;
        sums.acc.matrix[jcal_sym_at(i, i)] = (i < 2) ? 75.0f : 225.0f;
    }
    /* Information 100 + 300 and 25 + 900. */
    jcal_hinge_local_uncertainty(&sums, local);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, jcal_angle_mean_plus_2_sigma(1.0f / 400.0f, 0.0f, 1.0f / 400.0f), local[0]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, jcal_angle_mean_plus_2_sigma(1.0f / 925.0f, 0.0f, 1.0f / 925.0f), local[1]);
}

static void local_uncertainty_is_unknown_without_scatter_data_or_rank(void)
{
    jcal_hinge_sums_t good = {0};
    good.gyr = (jcal_hinge_kind_t){10, 0.0f, 1.0f, {0.0f}, {0.0f}};
    good.acc = (jcal_hinge_kind_t){10, 0.0f, 1.0f, {0.0f}, {0.0f}};
    for (size_t i = 0; i < 4; ++i) {
        good.gyr.matrix[jcal_sym_at(i, i)] = 100.0f;
    }
    jcal_hinge_sums_t bad[6] = {good, good, good, good, good, good};
    bad[0].gyr.n = 1;
    bad[1].acc.n = 0;
    bad[2].gyr.square = 0.0f;
    bad[3].acc.square = NAN;
    bad[4].gyr.matrix[jcal_sym_at(3, 3)] = 0.0f;
    for (size_t i = 0; i < 4; ++i) {
        bad[5].gyr.matrix[jcal_sym_at(i, i)] = 1e-3f; /* known, but worse than nothing */
    }
    for (int k = 0; k < 6; ++k) {
        float local[2] = {0.0f, 0.0f};
        jcal_hinge_local_uncertainty(&bad[k], local);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_HALF_PI, local[0]);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_HALF_PI, local[1]);
    }
}

static jcal_hinge_axes_t axes_at(float deg1, float deg2)
{
    const jcal_hinge_axes_t axes = {{{cosf(deg1 * JCAL_RAD_PER_DEG), sinf(deg1 * JCAL_RAD_PER_DEG), 0.0f},
                                     {0.0f, cosf(deg2 * JCAL_RAD_PER_DEG), sinf(deg2 * JCAL_RAD_PER_DEG)}}};
    return axes;
}

static jcal_hinge_sums_t sums_with_local(float rad)
{
    jcal_hinge_sums_t sums = {0};
    sums.gyr = (jcal_hinge_kind_t){2, 0.0f, 1.0f, {0.0f}, {0.0f}};
    sums.acc = (jcal_hinge_kind_t){2, 0.0f, 1.0f, {0.0f}, {0.0f}};
    for (size_t i = 0; i < 4; ++i) {
        sums.gyr.matrix[jcal_sym_at(i, i)] = 6.6f / (rad * rad);
    }
    return sums;
}

static void sequential_deviation_ignores_the_common_sign_and_takes_the_worse_axis(void)
{
    const jcal_hinge_window_config_t cfg = {.accept_bound_rad = 0.05f, .accept_count = 2};
    const jcal_hinge_sums_t sums = sums_with_local(0.01f);
    jcal_hinge_accept_t self = {0};
    jcal_hinge_axes_t axes = axes_at(0.0f, 0.0f);
    jcal_hinge_accept_update(&self, &cfg, &axes, &sums);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_PI, self.seqad_rad); /* (67): 180 deg at first */
    axes = axes_at(181.0f, 182.0f);
    jcal_hinge_accept_update(&self, &cfg, &axes, &sums);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 2.0f * JCAL_RAD_PER_DEG, self.seqad_rad);
    axes = axes_at(0.0f, 180.0f); /* the other pairing */
    jcal_hinge_accept_update(&self, &cfg, &axes, &sums);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 178.0f * JCAL_RAD_PER_DEG, self.seqad_rad);
}

static void an_estimate_is_accepted_after_n_min_agreeing_ones_and_not_before(void)
{
    const jcal_hinge_window_config_t cfg = {.accept_bound_rad = 0.05f, .accept_count = 3};
    const jcal_hinge_sums_t sure = sums_with_local(0.01f);
    const jcal_hinge_sums_t unsure = sums_with_local(0.1f);
    const jcal_hinge_axes_t here = axes_at(0.0f, 0.0f);
    const jcal_hinge_axes_t there = axes_at(5.0f, 0.0f);
    jcal_hinge_accept_t self = {0};
    for (int k = 0; k < 4; ++k) {
        TEST_ASSERT_FALSE(self.accepted);
        jcal_hinge_accept_update(&self, &cfg, &here, &sure);
    }
    TEST_ASSERT_TRUE(self.accepted); /* the first has no predecessor, so the fourth is the third that agrees */
    jcal_hinge_accept_update(&self, &cfg, &here, &unsure);
    TEST_ASSERT_FALSE(self.accepted);
    jcal_hinge_accept_update(&self, &cfg, &here, &sure);
    TEST_ASSERT_TRUE(self.accepted);
    jcal_hinge_accept_update(&self, &cfg, &there, &sure);
    TEST_ASSERT_FALSE(self.accepted);
    jcal_hinge_accept_update(&self, &cfg, &there, &sure);
    jcal_hinge_accept_update(&self, &cfg, &there, &sure);
    TEST_ASSERT_FALSE(self.accepted);
    jcal_hinge_accept_update(&self, &cfg, &there, &sure);
    TEST_ASSERT_TRUE(self.accepted);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(gyroscope_jacobian_equals_central_differences);
    RUN_TEST(a_rate_along_the_axis_has_no_derivative_and_no_nan);
    RUN_TEST(sums_equal_double_precision);
    RUN_TEST(change_of_cost_is_exact_even_for_the_smallest_steps);
    RUN_TEST(samples_without_rates_change_nothing);
    RUN_TEST(local_uncertainty_is_that_of_57_and_58);
    RUN_TEST(local_uncertainty_is_unknown_without_scatter_data_or_rank);
    RUN_TEST(sequential_deviation_ignores_the_common_sign_and_takes_the_worse_axis);
    RUN_TEST(an_estimate_is_accepted_after_n_min_agreeing_ones_and_not_before);
    return UNITY_END();
}
