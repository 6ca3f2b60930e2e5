/* SPDX-License-Identifier: MIT */
/// @file
/// Derivatives of the functional joint by central differences of its cost, in double precision from the same sums.
#include "functional/axes.h"
#include "functional/bounds.h"
#include "functional/headings.h"
#include "unit/functional/fixture.h"

/* Derivatives in float32 of matrices whose entries cancel to a hundredth; differences in double precision add nothing to that. */
static const double TOLERANCE = 2e-4;
static const double STEP = 1e-4;

static run_t run;

/// A point in double precision, with the weights of the joint.
typedef struct {
    double j[2][3];
    double heading[2];
    double turn[2][9];
} place_t;

static void take(double to[3], jcal_vec3_t from)
{
    to[0] = (double)from.x;
    to[1] = (double)from.y;
    to[2] = (double)from.z;
}

static place_t place_of(const jcal_functional_point_t *point)
{
    place_t out = {0};
    take(out.j[0], point->j1);
    take(out.j[1], point->j2);
    for (int b = 0; b < 2; ++b) {
        out.heading[b] = atan2((double)point->heading[b].im, (double)point->heading[b].re);
        for (int i = 0; i < 9; ++i) {
            out.turn[b][i] = (double)point->turn[b][i];
        }
    }
    return out;
}

static double between_packed(const float *m, const double a[3])
{
    return (double)m[0] * a[0] * a[0] + (double)m[2] * a[1] * a[1] + (double)m[5] * a[2] * a[2] +
           2.0 * ((double)m[1] * a[0] * a[1] + (double)m[3] * a[0] * a[2] + (double)m[4] * a[1] * a[2]);
}

/// a' m b, m (n x n, real and imaginary part) turned by an angle, its real part.
static double between_turned(const float *const m[2], double angle, const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            sum += a[i] * b[k] * (cos(angle) * (double)m[0][n * i + k] - sin(angle) * (double)m[1][n * i + k]);
        }
    }
    return sum;
}

static double between_plain(const float *m, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < 9; ++i) {
        sum += a[i / 3] * (double)m[i] * b[i % 3];
    }
    return sum;
}

/// The cost of METHOD_PEOPLE.md but for constants: half the weighted squares, and what ties relative turns to their headings.
static double cost(const place_t *at)
{
    const jcal_functional_sums_t *const sums = &run.joint.sums;
    const jcal_functional_point_t *const point = &run.joint.point;
    const double of_turn = (double)point->weight[JCAL_FAMILY_TURN] / (double)sums->motion_s;
    const double of_rate = (double)point->weight[JCAL_FAMILY_RATE] / (double)sums->rate2;
    const double of_lever = (double)point->weight[JCAL_FAMILY_LEVER] / (double)sums->motion_s;
    const double x1[4] = {1.0, -(double)point->r1.x, -(double)point->r1.y, -(double)point->r1.z};
    const double x2[4] = {1.0, -(double)point->r2.x, -(double)point->r2.y, -(double)point->r2.z};
    const double *const j1 = at->j[0];
    const double *const j2 = at->j[1];
    double lengths = 0.0;
    for (int i = 0; i < 3; ++i) {
        lengths += j1[i] * j1[i] + j2[i] * j2[i];
    }
    double turn = 0.5 * (double)sums->motion_s * lengths - between_plain(sums->turn_up, j1, j2) -
                  between_plain(sums->old_turn, j1, j2);
    double rate = 0.5 * (between_packed(sums->rate1, j1) + between_packed(sums->rate2nd, j2)) -
                  between_plain(sums->rate_free, j1, j2);
    double lever = 0.0;
    double tie = 0.0;
    for (int b = 0; b < 2; ++b) {
        const jcal_functional_block_t *const block = &sums->block[b];
        const double angle = at->heading[b];
        const float *const turns[2] = {block->turn_re, block->turn_im};
        const float *const levers[2] = {sums->levers.block[b].re, sums->levers.block[b].im};
        turn -= between_turned(turns, angle, j1, j2, 3);
        lever -= between_turned(levers, angle, x1, x2, 4);
        const double *const d = at->turn[b];
        for (int i = 0; i < 81; ++i) {
            rate -= d[3 * (i / 27) + (i % 9) / 3] * j1[(i / 9) % 3] * (double)block->rate[i] * j2[i % 3];
        }
        tie -= cos(angle) * (d[0] + d[4]) + sin(angle) * (d[3] - d[1]) + d[8];
    }
    return of_turn * turn + of_rate * rate + of_lever * lever + (double)JCAL_FUNCTIONAL_TILT_WEIGHT * tie;
}

/// Unknowns: four tangents, then the turn of a block about the axes of L2, its heading going along about z.
static double cost_off(size_t b, const double step[7])
{
    const jcal_functional_point_t *const point = &run.joint.point;
    place_t at = place_of(point);
    for (int a = 0; a < 2; ++a) {
        const jcal_tangent_t t = jcal_sphere_tangent((a == 0) ? point->j1 : point->j2);
        double u[3];
        double v[3];
        take(u, t.u);
        take(v, t.v);
        double length = 0.0;
        for (int i = 0; i < 3; ++i) {
            at.j[a][i] += step[2 * a] * u[i] + step[2 * a + 1] * v[i];
            length += at.j[a][i] * at.j[a][i];
        }
        for (int i = 0; i < 3; ++i) {
            at.j[a][i] /= sqrt(length);
        }
    }
    double by[9];
    mat_turn(&step[4], by);
    mat_mul(at.turn[b], by, at.turn[b]);
    at.heading[b] += step[6];
    return cost(&at);
}

static double slope_by(size_t b, int i)
{
    double step[7] = {0.0};
    step[i] = STEP;
    const double more = cost_off(b, step);
    step[i] = -STEP;
    return (more - cost_off(b, step)) / (2.0 * STEP);
}

static double bend_by(size_t b, int i, int k)
{
    double sum = 0.0;
    for (int n = 0; n < 4; ++n) {
        double step[7] = {0.0};
        step[i] += ((n & 1) != 0) ? 10.0 * STEP : -10.0 * STEP;
        step[k] += ((n & 2) != 0) ? 10.0 * STEP : -10.0 * STEP;
        sum += (((n == 0) || (n == 3)) ? 1.0 : -1.0) * cost_off(b, step);
    }
    return sum / (400.0 * STEP * STEP);
}

/* A hinge on skin whose heading drifts, some blocks merged, and then everything a little off. */
void setUp(void)
{
    hinge_t hinge = hinge_usual();
    hinge.skin_rad = 0.03;
    hinge.drift_rad_s = 0.01;
    run_begin(&run, &hinge, NULL);
    run_for(&run, 17.5);
    jcal_functional_point_t *const point = &run.joint.point;
    TEST_ASSERT_TRUE(run.joint.merged && (run.joint.sums.block[0].motion_s > 1.0f));
    point->j1 = jcal_vec3_normalise(jcal_vec3_add(point->j1, jcal_vec3(0.03f, -0.02f, 0.04f)));
    point->j2 = jcal_vec3_normalise(jcal_vec3_add(point->j2, jcal_vec3(-0.02f, 0.05f, 0.01f)));
    for (int b = 0; b < 2; ++b) {
        const double off[3] = {0.02, -0.03, 0.01};
        double by[9];
        place_t at = place_of(point);
        mat_turn(off, by);
        mat_mul(at.turn[b], by, at.turn[b]);
        for (int i = 0; i < 9; ++i) {
            point->turn[b][i] = (float)at.turn[b][i];
        }
    }
}

void tearDown(void)
{
}

static void of_the_axes(void)
{
    jcal_functional_cross_t x;
    jcal_functional_quadric_t h;
    float hessian[10];
    float slope[4];
    jcal_functional_cross(&run.joint.sums, &run.joint.point, &x);
    jcal_functional_quadric(&run.joint.sums, &x, &run.joint.point, &h);
    const jcal_vec3_t axes[2] = {run.joint.point.j1, run.joint.point.j2};
    jcal_functional_tangent_hessian(&h, axes, true, hessian, slope);
    const double scale = (double)jcal_max(jcal_max(h.h11[0], h.h11[2]), h.h11[5]);
    for (int i = 0; i < 4; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * scale, slope_by(0, i), (double)slope[i]);
        for (int k = 0; k <= i; ++k) {
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * scale, bend_by(0, i, k),
                                      (double)hessian[jcal_sym_at((size_t)i, (size_t)k)]);
        }
    }
}

static void of_turns_and_of_both(void)
{
    for (size_t b = 0; b < 2; ++b) {
        float slope[3];
        float nuisance[6];
        float coupling[12];
        jcal_functional_bound_slope(&run.joint.sums, &run.joint.point, b, slope);
        jcal_functional_bound_nuisance(&run.joint.sums, &run.joint.point, b, nuisance);
        jcal_functional_bound_coupling(&run.joint.sums, &run.joint.point, b, coupling);
        const double scale = (double)jcal_max(jcal_max(nuisance[0], nuisance[2]), nuisance[5]);
        /* What ties a turn that leans to its heading is counted as if it did not lean, 0.04 rad here. */
        const double leaning = (double)JCAL_FUNCTIONAL_TILT_WEIGHT * 0.05;
        for (int i = 0; i < 3; ++i) {
            TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * scale, slope_by(b, 4 + i), (double)slope[i]);
            for (int k = 0; k <= i; ++k) {
                const bool mixed = (i == 2) && (k < 2);
                TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * scale + (mixed ? leaning : 0.0), bend_by(b, 4 + i, 4 + k),
                                          (double)nuisance[jcal_sym_at((size_t)i, (size_t)k)]);
            }
            for (int t = 0; t < 4; ++t) {
                TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * scale, bend_by(b, t, 4 + i), (double)coupling[3 * t + i]);
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(of_the_axes);
    RUN_TEST(of_turns_and_of_both);
    return UNITY_END();
}
