/* SPDX-License-Identifier: MIT */
/// @file
/// The levers of the functional joint. See functional/levers.h.
#include "functional/levers.h"

#include "math/chol_small.h"
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
    g[0] = s1[1] - x[4];
    g[1] = s1[3] - x[8];
    g[2] = s1[6] - x[12];
    g[3] = s2[1] - x[1];
    g[4] = s2[3] - x[2];
    g[5] = s2[6] - x[3];
    h[0] = s1[2]; /* S1 but for its first row */
    h[1] = s1[4];
    h[2] = s1[5];
    h[3] = s1[7];
    h[4] = s1[8];
    h[5] = s1[9];
    h[6] = -x[5]; /* a column of X, a row of S2 */
    h[7] = -x[9];
    h[8] = -x[13];
    h[9] = s2[2];
    h[10] = -x[6];
    h[11] = -x[10];
    h[12] = -x[14];
    h[13] = s2[4];
    h[14] = s2[5];
    h[15] = -x[7];
    h[16] = -x[11];
    h[17] = -x[15];
    h[18] = s2[7];
    h[19] = s2[8];
    h[20] = s2[9];
}

/// x' S x of [1; -r], S (4 x 4, packed).
static float left_of(const float *s, const float *r)
{
    const jcal_vec3_t v = {-r[0], -r[1], -r[2]};
    const float below = (s[1] * v.x) + ((s[3] + (s[4] * v.x)) * v.y) + ((s[6] + (s[7] * v.x) + (s[8] * v.y)) * v.z);
    const float diagonal = s[0] + (s[2] * v.x * v.x) + (s[5] * v.y * v.y) + (s[9] * v.z * v.z);
    return diagonal + (2.0f * below);
}

/// row [1; v].
static inline float row_times(const float *row, jcal_vec3_t v)
{
    return row[0] + (row[1] * v.x) + (row[2] * v.y) + (row[3] * v.z);
}

/// [1; -r1]' X [1; -r2].
static float product_of(const float *x, const float *r1, const float *r2)
{
    const jcal_vec3_t v = {-r2[0], -r2[1], -r2[2]};
    return row_times(x, v) - (r1[0] * row_times(&x[4], v)) - (r1[1] * row_times(&x[8], v)) -
           (r1[2] * row_times(&x[12], v));
}

void jcal_functional_levers(const jcal_functional_sums_t *sums, const float *x, jcal_functional_point_t *point)
{
    float h[JCAL_SYM_SIZE(UNKNOWNS)];
    float r[UNKNOWNS];
    normal_equations(sums, x, h, r);
    const float trace = h[0] + h[2] + h[5] + h[9] + h[14] + h[20];
    const float ridge = (RIDGE / (float)UNKNOWNS * trace) + FLT_MIN;
    for (size_t i = 0u; i < UNKNOWNS; ++i) {
        h[jcal_sym_at(i, i)] += ridge;
    }
    if (jcal_chol6_factor(h)) {
        jcal_chol6_solve(h, r);
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
