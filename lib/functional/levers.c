/* SPDX-License-Identifier: MIT */
/// @file
/// The levers of the functional joint. See functional/levers.h.
#include "functional/levers.h"

#include "math/chol.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>

#define RIDGE 0.005f
#define UNKNOWNS 6u

/// Normal equations H r = g of both levers: [U1 B1][1; -r1] = Rz [U2 B2][1; -r2].
static void normal_equations(const jcal_functional_sums_t *sums, const float *x, float *h, float *g)
{
    const float *const s1 = sums->lever1;
    const float *const s2 = sums->lever2;
    for (size_t i = 0u; i < 3u; ++i) {
        g[i] = s1[jcal_sym_at(i + 1u, 0u)] - x[4u * (i + 1u)];
        g[i + 3u] = s2[jcal_sym_at(i + 1u, 0u)] - x[i + 1u];
        for (size_t k = 0u; k < 3u; ++k) {
            if (k <= i) {
                h[jcal_sym_at(i, k)] = s1[jcal_sym_at(i + 1u, k + 1u)];
                h[jcal_sym_at(i + 3u, k + 3u)] = s2[jcal_sym_at(i + 1u, k + 1u)];
            }
            h[jcal_sym_at(i + 3u, k)] = -x[(4u * (k + 1u)) + i + 1u];
        }
    }
}

/// x' S x of [1; -r], S (4 x 4, packed).
static float left_of(const float *s, const float *r)
{
    const float v[4] = {1.0f, -r[0], -r[1], -r[2]};
    return jcal_sym_quadratic(s, 4u, v);
}

/// [1; -r1]' X [1; -r2].
static float product_of(const float *x, const float *r1, const float *r2)
{
    const float v1[4] = {1.0f, -r1[0], -r1[1], -r1[2]};
    const float v2[4] = {1.0f, -r2[0], -r2[1], -r2[2]};
    float sum = 0.0f;
    for (size_t i = 0u; i < 4u; ++i) {
        const float *const row = &x[4u * i];
        sum += v1[i] * ((row[0] * v2[0]) + (row[1] * v2[1]) + (row[2] * v2[2]) + (row[3] * v2[3]));
    }
    return sum;
}

void jcal_functional_levers(const jcal_functional_sums_t *sums, const float *x, jcal_functional_point_t *point)
{
    float h[JCAL_SYM_SIZE(UNKNOWNS)];
    float r[UNKNOWNS];
    normal_equations(sums, x, h, r);
    float trace = 0.0f;
    for (size_t i = 0u; i < UNKNOWNS; ++i) {
        trace += h[jcal_sym_at(i, i)];
    }
    const float ridge = (RIDGE / (float)UNKNOWNS * trace) + FLT_MIN;
    for (size_t i = 0u; i < UNKNOWNS; ++i) {
        h[jcal_sym_at(i, i)] += ridge;
    }
    if (jcal_chol_factor(h, UNKNOWNS, h, NULL)) {
        jcal_chol_solve(h, UNKNOWNS, r, r);
    } else {
        for (size_t i = 0u; i < UNKNOWNS; ++i) {
            r[i] = 0.0f;
        }
    }
    const float own = left_of(sums->lever1, r) + left_of(sums->lever2, &r[3]);
    point->r1 = (jcal_vec3_t){r[0], r[1], r[2]};
    point->r2 = (jcal_vec3_t){r[3], r[4], r[5]};
    point->lack = jcal_max(own - (2.0f * product_of(x, r, &r[3])), 0.0f);
    point->speed2 = own / jcal_max(sums->motion_s, FLT_MIN);
}
