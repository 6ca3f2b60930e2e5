/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of remember/sums.h: costs, slopes and the system of the tilts beside residuals that are written out in double precision.
#include "remember/sums.h"

#include "math/sym.h"
#include "unit/remember/fixture.h"

#define TICKS 24
#define ROWS 9 /* turn, rate, lever, three each */
#define FIRST_TICK 70

static hinge_t hinge;
static jcal_remember_t self;
static jcal_tick_t ticks[TICKS][2];
static jcal_tick_weights_t weights[TICKS];
static const float KIND[JCAL_REMEMBER_KINDS] = {3.0f, 0.7f, 40.0f};

void setUp(void)
{
}

void tearDown(void)
{
}

/* Remembered axes and levers that are off, so that no residual is zero. */
static void fill(void)
{
    hinge = hinge_usual();
    jcal_kept_t kept = kept_of(&hinge);
    kept.axis1 = turned_off(kept.axis1, 9.0);
    kept.axis2 = turned_off(kept.axis2, -14.0);
    kept.lever1_m.x += 0.05f;
    kept.lever2_m.z -= 0.07f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_init(&self, &kept, JCAL_KEPT_FITS));
    for (int n = 0; n < TICKS; ++n) {
        const double t = 0.05 * (FIRST_TICK + n);
        ticks[n][0] = hinge_tick(&hinge, t, 1, (uint64_t)(FIRST_TICK + n) * TICK_US);
        ticks[n][1] = hinge_tick(&hinge, t, 2, (uint64_t)(FIRST_TICK + n) * TICK_US);
        weights[n].motion_s = 0.05f * (1.0f + 0.5f * sinf((float)n));
        weights[n].spin = 0.02f * (1.0f + 0.5f * cosf(2.0f * (float)n));
        jcal_remember_sums_add(&self, &ticks[n][0], &ticks[n][1], &weights[n]);
    }
}

static void arrow(jcal_vec3_t v, double out[3])
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static void float_times(const float *m, const double v[3], double out[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = (double)m[3 * i] * v[0] + (double)m[3 * i + 1] * v[1] + (double)m[3 * i + 2] * v[2];
    }
}

/* x = tilts of axis 1, of axis 2, heading: the nine residuals of tick n. Axes move along their tangents. */
static void residuals(int n, const double x[5], double pairing, double out[ROWS])
{
    const jcal_tick_t *tick1 = &ticks[n][0];
    const jcal_tick_t *tick2 = &ticks[n][1];
    double e1[3][3];
    double e2[3][3];
    double j1[3];
    double j2[3];
    for (int k = 0; k < 3; ++k) {
        arrow(self.e1[k], e1[k]);
        arrow(self.e2[k], e2[k]);
    }
    for (int i = 0; i < 3; ++i) {
        j1[i] = e1[2][i] + x[0] * e1[0][i] + x[1] * e1[1][i];
        j2[i] = pairing * (e2[2][i] + x[2] * e2[0][i] + x[3] * e2[1][i]);
    }
    double left[3][3];
    double right[3][3];
    double r1[3];
    double r2[3];
    arrow(self.kept.lever1_m, r1);
    arrow(self.kept.lever2_m, r2);
    float_times(tick1->turn, j1, left[0]);
    float_times(tick2->turn, j2, right[0]);
    float_times(tick1->rate, j1, left[1]);
    float_times(tick2->rate, j2, right[1]);
    float_times(tick1->lever, r1, left[2]);
    float_times(tick2->lever, r2, right[2]);
    const double u1[3] = {tick1->velocity.x, tick1->velocity.y, tick1->velocity.z};
    const double u2[3] = {tick2->velocity.x, tick2->velocity.y, tick2->velocity.z};
    for (int i = 0; i < 3; ++i) {
        left[2][i] = u1[i] - left[2][i];
        right[2][i] = u2[i] - right[2][i];
    }
    const double c = cos(x[4]);
    const double s = sin(x[4]);
    for (int kind = 0; kind < 3; ++kind) {
        const double *b = right[kind];
        const double seen[3] = {c * b[0] - s * b[1], s * b[0] + c * b[1], b[2]};
        for (int i = 0; i < 3; ++i) {
            out[3 * kind + i] = left[kind][i] - seen[i];
        }
    }
}

static double weight_of(int n, int row)
{
    return (row / 3 == 1) ? (double)weights[n].spin : (double)weights[n].motion_s;
}

static void cost_of(const double x[5], double pairing, double cost[3])
{
    memset(cost, 0, 3 * sizeof(double));
    for (int n = 0; n < TICKS; ++n) {
        double r[ROWS];
        residuals(n, x, pairing, r);
        for (int row = 0; row < ROWS; ++row) {
            cost[row / 3] += weight_of(n, row) * r[row] * r[row];
        }
    }
}

static double half_cost(double heading)
{
    const double x[5] = {0.0, 0.0, 0.0, 0.0, heading};
    double cost[3];
    cost_of(x, 1.0, cost);
    return 0.5 * ((double)KIND[0] * cost[0] + (double)KIND[1] * cost[1] + (double)KIND[2] * cost[2]);
}

static jcal_plane_t plane(double heading)
{
    const jcal_plane_t out = {(float)cos(heading), (float)sin(heading)};
    return out;
}

static void costs_of_both_pairings_are_those_of_the_residuals(void)
{
    fill();
    for (int k = 0; k < 12; ++k) {
        const double x[5] = {0.0, 0.0, 0.0, 0.0, 0.5 * k};
        for (int p = -1; p <= 1; p += 2) {
            double expected[3];
            float cost[JCAL_REMEMBER_KINDS];
            cost_of(x, p, expected);
            jcal_remember_costs(&self.block, plane(x[4]), (float)p, cost);
            for (int kind = 0; kind < 3; ++kind) {
                TEST_ASSERT_FLOAT_WITHIN(2e-5f, (float)expected[kind], cost[kind]);
            }
        }
    }
}

static void slopes_are_differences_of_the_cost(void)
{
    fill();
    const double h = 1e-4;
    for (int k = 0; k < 12; ++k) {
        const double heading = 0.5 * k + 0.1;
        const double low = half_cost(heading - h);
        const double here = half_cost(heading);
        const double high = half_cost(heading + h);
        float slope[2];
        jcal_remember_slope(&self.block, plane(heading), KIND, slope);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * (float)here, (float)((high - low) / (2.0 * h)), slope[0]);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * (float)here, (float)((high - 2.0 * here + low) / (h * h)), slope[1]);
    }
}

/* J' J and J' r of tilts and heading, from differences; that of the heading with itself is the second derivative. */
static void expected_system(double heading, double matrix[5][5], double gradient[5])
{
    const double h = 1e-5;
    memset(matrix, 0, 25 * sizeof(double));
    memset(gradient, 0, 5 * sizeof(double));
    for (int n = 0; n < TICKS; ++n) {
        double r[ROWS];
        double j[5][ROWS];
        const double x0[5] = {0.0, 0.0, 0.0, 0.0, heading};
        residuals(n, x0, 1.0, r);
        for (int i = 0; i < 5; ++i) {
            double low[ROWS];
            double high[ROWS];
            double x[5] = {0.0, 0.0, 0.0, 0.0, heading};
            x[i] += h;
            residuals(n, x, 1.0, high);
            x[i] -= 2.0 * h;
            residuals(n, x, 1.0, low);
            for (int row = 0; row < ROWS; ++row) {
                j[i][row] = (high[row] - low[row]) / (2.0 * h);
            }
        }
        for (int row = 0; row < ROWS; ++row) {
            const double w = weight_of(n, row) * (double)KIND[row / 3];
            for (int i = 0; i < 5; ++i) {
                gradient[i] += w * j[i][row] * r[row];
                for (int k = 0; k < 5; ++k) {
                    matrix[i][k] += w * j[i][row] * j[k][row];
                }
            }
        }
    }
    const double step = 1e-4;
    matrix[4][4] = (half_cost(heading + step) - 2.0 * half_cost(heading) + half_cost(heading - step)) / (step * step);
}

static void the_system_is_that_of_the_residuals(void)
{
    fill();
    const double headings[] = {hinge.heading, hinge.heading + 0.3, hinge.heading - 0.4};
    for (int c = 0; c < 3; ++c) {
        double matrix[5][5];
        double gradient[5];
        jcal_remember_system_t found;
        expected_system(headings[c], matrix, gradient);
        TEST_ASSERT_TRUE(matrix[4][4] > 0.0);
        jcal_remember_system(&self.block, plane(headings[c]), KIND, &found);
        for (int i = 0; i < 4; ++i) {
            const double g = gradient[i] - matrix[i][4] * gradient[4] / matrix[4][4];
            TEST_ASSERT_FLOAT_WITHIN(2e-4f, (float)g, found.gradient[i]);
            for (int k = 0; k < 4; ++k) {
                const double m = matrix[i][k] - matrix[i][4] * matrix[k][4] / matrix[4][4];
                TEST_ASSERT_FLOAT_WITHIN(4e-4f, (float)m, found.matrix[jcal_sym_at((size_t)i, (size_t)k)]);
            }
        }
    }
}

/* exp(i angle) of an exact hinge, summed: as far apart as the joint's angles are. */
static void bending_is_that_of_the_joint(void)
{
    fill();
    jcal_kept_t kept = kept_of(&hinge);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_init(&self, &kept, JCAL_KEPT_FITS));
    double re = 0.0;
    double im = 0.0;
    for (int n = 0; n < TICKS; ++n) {
        const double angle = hinge_angle(&hinge, 0.05 * (FIRST_TICK + n));
        re += (double)weights[n].motion_s * cos(angle);
        im += (double)weights[n].motion_s * sin(angle);
        jcal_remember_sums_add(&self, &ticks[n][0], &ticks[n][1], &weights[n]);
    }
    const jcal_plane_t sum = jcal_remember_bend(&self.block, plane(hinge.heading));
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)sqrt(re * re + im * im), sqrtf(sum.re * sum.re + sum.im * sum.im));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(costs_of_both_pairings_are_those_of_the_residuals);
    RUN_TEST(slopes_are_differences_of_the_cost);
    RUN_TEST(the_system_is_that_of_the_residuals);
    RUN_TEST(bending_is_that_of_the_joint);
    return UNITY_END();
}
