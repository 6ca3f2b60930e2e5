/* SPDX-License-Identifier: MIT */
/// @file
/// The axes of the functional joint. See functional/axes.h.
#include "functional/axes.h"

#include "functional/model.h"
#include "imu/turn.h"
#include "jointcal/vec3.h"
#include "math/chol_small.h"
#include "math/scalar.h"

#include <float.h>

/// Floors of the mean squared residuals: 4 deg of inclination, an accelerometer wrong by 0.7 m/s^2; 1 % of a rate; 14 mm/s.
#define TURN_FLOOR 4.8739e-3f
#define RATE_FLOOR 1e-4f
#define LEVER_FLOOR 2e-4f

/// Motion after which a residual of each kind is an independent reading, s, and the share of it that never averages out.
#define TURN_MEMORY_S 4.0f
#define RATE_MEMORY_S 0.3f
#define LEVER_MEMORY_S 1.0f
#define LASTING 0.16f

#define STEP_MAX_RAD 0.4f
/// Rounds of inverse iteration; one gains the ratio of neighbouring eigenvalues.
#define ROUNDS 3u
/// Share of the mean diagonal that is added before H is inverted.
#define SHIFT 1e-4f

void jcal_functional_cross(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point,
                           jcal_functional_cross_t *out)
{
    jcal_functional_cross_turn(sums, point, out->turn);
    jcal_functional_cross_rate(sums, point, out->rate);
}

static const float MEMORY_S[JCAL_FAMILIES] = {TURN_MEMORY_S, RATE_MEMORY_S, LEVER_MEMORY_S};
/* Two directions across an axis, three of a velocity: halved. */
const float jcal_functional_rows_per_s[JCAL_FAMILIES] = {1.0f / TURN_MEMORY_S, 1.0f / RATE_MEMORY_S,
                                                         1.5f / LEVER_MEMORY_S};

void jcal_functional_measure(const jcal_functional_sums_t *sums, const jcal_functional_cross_t *x,
                             jcal_functional_point_t *point)
{
    const float motion_s = jcal_max(sums->motion_s, FLT_MIN);
    const float floors[JCAL_FAMILIES] = {TURN_FLOOR, RATE_FLOOR, LEVER_FLOOR};
    const float sizes[JCAL_FAMILIES] = {
        jcal_functional_turn_size(sums, x->turn, point->j1, point->j2),
        jcal_functional_rate_size(sums, x->rate, point->j1, point->j2),
        point->lack / (3.0f * motion_s),
    };
    float energy = 0.0f;
    for (unsigned f = 0u; f < JCAL_FAMILIES; ++f) {
        const float size = jcal_max(sizes[f], floors[f]);
        point->size[f] = size;
        point->weight[f] = 1.0f / (size * (LASTING + (MEMORY_S[f] / motion_s)));
        energy += jcal_functional_rows_per_s[f] * jcal_ln(size);
    }
    point->energy = energy;
}

void jcal_functional_quadric(const jcal_functional_sums_t *sums, const jcal_functional_cross_t *x,
                             const jcal_functional_point_t *point, jcal_functional_quadric_t *out)
{
    const float turn = point->weight[JCAL_FAMILY_TURN] / jcal_max(sums->motion_s, FLT_MIN);
    const float rate = point->weight[JCAL_FAMILY_RATE] / jcal_max(sums->rate2, FLT_MIN);
    for (size_t i = 0u; i < 6u; ++i) {
        out->h11[i] = rate * sums->rate1[i];
        out->h22[i] = rate * sums->rate2nd[i];
    }
    for (size_t i = 0u; i < 3u; ++i) {
        out->h11[jcal_sym_at(i, i)] += turn * sums->motion_s;
        out->h22[jcal_sym_at(i, i)] += turn * sums->motion_s;
    }
    for (size_t i = 0u; i < 9u; ++i) {
        out->h12[i] = -((turn * x->turn[i]) + (rate * x->rate[i]));
    }
}

/// Both parts of H [a; b].
static void slopes(const jcal_functional_quadric_t *h, jcal_vec3_t a, jcal_vec3_t b, jcal_vec3_t *slope1,
                   jcal_vec3_t *slope2)
{
    *slope1 = jcal_vec3_add(jcal_functional_times_packed(h->h11, a), jcal_turn_times(h->h12, b));
    *slope2 = jcal_vec3_add(jcal_functional_times_left(h->h12, a), jcal_functional_times_packed(h->h22, b));
}

void jcal_functional_tangent_hessian(const jcal_functional_quadric_t *h, const jcal_vec3_t j[2], bool bend,
                                     float *hessian, float *slope)
{
    const jcal_tangent_t t1 = jcal_sphere_tangent(j[0]);
    const jcal_tangent_t t2 = jcal_sphere_tangent(j[1]);
    jcal_vec3_t slope1;
    jcal_vec3_t slope2;
    slopes(h, j[0], j[1], &slope1, &slope2);
    slope[0] = jcal_vec3_dot(t1.u, slope1);
    slope[1] = jcal_vec3_dot(t1.v, slope1);
    slope[2] = jcal_vec3_dot(t2.u, slope2);
    slope[3] = jcal_vec3_dot(t2.v, slope2);
    const float off1 = bend ? jcal_vec3_dot(j[0], slope1) : 0.0f;
    const float off2 = bend ? jcal_vec3_dot(j[1], slope2) : 0.0f;
    const jcal_vec3_t h1u = jcal_functional_times_packed(h->h11, t1.u);
    const jcal_vec3_t h2u = jcal_functional_times_packed(h->h22, t2.u);
    const jcal_vec3_t x1u = jcal_functional_times_left(h->h12, t1.u);
    const jcal_vec3_t x1v = jcal_functional_times_left(h->h12, t1.v);
    hessian[0] = jcal_vec3_dot(t1.u, h1u) - off1;
    hessian[1] = jcal_vec3_dot(t1.v, h1u);
    hessian[2] = jcal_vec3_dot(t1.v, jcal_functional_times_packed(h->h11, t1.v)) - off1;
    hessian[3] = jcal_vec3_dot(t2.u, x1u);
    hessian[4] = jcal_vec3_dot(t2.u, x1v);
    hessian[5] = jcal_vec3_dot(t2.u, h2u) - off2;
    hessian[6] = jcal_vec3_dot(t2.v, x1u);
    hessian[7] = jcal_vec3_dot(t2.v, x1v);
    hessian[8] = jcal_vec3_dot(t2.v, h2u);
    hessian[9] = jcal_vec3_dot(t2.v, jcal_functional_times_packed(h->h22, t2.v)) - off2;
}

void jcal_functional_step_axes(const jcal_functional_quadric_t *h, jcal_vec3_t *j1, jcal_vec3_t *j2)
{
    float hessian[JCAL_SYM_SIZE(4u)];
    float step[4];
    const jcal_vec3_t j[2] = {*j1, *j2};
    jcal_functional_tangent_hessian(h, j, true, hessian, step);
    if (!jcal_chol4_factor(hessian)) { /* far from a minimum: downhill without the spheres' bend */
        jcal_functional_tangent_hessian(h, j, false, hessian, step);
        if (!jcal_chol4_factor(hessian)) {
            return;
        }
    }
    jcal_chol4_solve(hessian, step);
    const float length2 = (step[0] * step[0]) + (step[1] * step[1]) + (step[2] * step[2]) + (step[3] * step[3]);
    const float scale = (length2 > (STEP_MAX_RAD * STEP_MAX_RAD)) ? (-STEP_MAX_RAD / sqrtf(length2)) : -1.0f;
    const jcal_tangent_t t1 = jcal_sphere_tangent(*j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(*j2);
    *j1 = jcal_sphere_move(*j1, &t1, scale * step[0], scale * step[1]);
    *j2 = jcal_sphere_move(*j2, &t2, scale * step[2], scale * step[3]);
}

static float dot6(const float *a, const float *b)
{
    return (a[0] * b[0]) + (a[1] * b[1]) + (a[2] * b[2]) + (a[3] * b[3]) + (a[4] * b[4]) + (a[5] * b[5]);
}

/// v (6) <- v brought to unit length; zero stays.
static void normalise6(float *v)
{
    const float length = sqrtf(dot6(v, v));
    const float scale = (length > 0.0f) ? (1.0f / length) : 0.0f;
    for (size_t i = 0u; i < 6u; ++i) {
        v[i] *= scale;
    }
}

/// The two eigenvectors (6 each) of the smallest eigenvalues of a matrix, by inverse iteration from its Cholesky factor.
static void two_smallest(const float *factor, float *v0, float *v1)
{
    for (size_t i = 0u; i < 6u; ++i) { /* any start that is not one of them */
        v0[i] = 1.0f - (0.25f * (float)i);
        v1[i] = ((i % 2u) == 0u) ? 1.0f : -0.7f;
    }
    for (unsigned round = 0u; round < ROUNDS; ++round) {
        jcal_chol6_solve(factor, v0);
        normalise6(v0);
        jcal_chol6_solve(factor, v1);
        const float common = dot6(v0, v1);
        for (size_t i = 0u; i < 6u; ++i) {
            v1[i] -= common * v0[i];
        }
        normalise6(v1);
    }
}

/// m (6 x 6, packed) <- H, with a little more on its diagonal.
static void joined(const jcal_functional_quadric_t *h, float *m)
{
    const float *const a = h->h11;
    const float *const c = h->h22;
    const float *const x = h->h12;
    const float shift = (SHIFT / 6.0f) * ((a[0] + c[0]) + (a[2] + c[2]) + (a[5] + c[5]));
    m[0] = a[0] + shift;
    m[1] = a[1];
    m[2] = a[2] + shift;
    m[3] = a[3];
    m[4] = a[4];
    m[5] = a[5] + shift;
    m[6] = x[0]; /* a column of h12, a row of h22 */
    m[7] = x[3];
    m[8] = x[6];
    m[9] = c[0] + shift;
    m[10] = x[1];
    m[11] = x[4];
    m[12] = x[7];
    m[13] = c[1];
    m[14] = c[2] + shift;
    m[15] = x[2];
    m[16] = x[5];
    m[17] = x[8];
    m[18] = c[3];
    m[19] = c[4];
    m[20] = c[5] + shift;
}

bool jcal_functional_open_axes(const jcal_functional_quadric_t *h, unsigned which, jcal_vec3_t *j1, jcal_vec3_t *j2)
{
    float m[JCAL_SYM_SIZE(6u)];
    joined(h, m);
    if (!jcal_chol6_factor(m)) {
        return false;
    }
    float v[2][6];
    two_smallest(m, v[0], v[1]);
    const float *const found = v[which & 1u];
    const jcal_vec3_t a = jcal_vec3(found[0], found[1], found[2]);
    const jcal_vec3_t b = jcal_vec3(found[3], found[4], found[5]);
    const float least = 1e-3f;
    if (!((jcal_vec3_norm(a) > least) && (jcal_vec3_norm(b) > least))) {
        return false;
    }
    *j1 = jcal_vec3_normalise(a);
    *j2 = jcal_vec3_normalise(b);
    return true;
}
