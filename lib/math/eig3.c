/* SPDX-License-Identifier: MIT */
/// @file
/// Eigenvalues of 3 x 3 matrices. See math/eig3.h.
#include "math/eig3.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"

#include <math.h>
#include <stdbool.h>

/// Sweeps of the eigenvalues, and the share of the diagonal elements' product that the square of another element must exceed.
#define SWEEPS 6u
#define NEGLIGIBLE 1e-15f

/// Columns p and q of a symmetric matrix: both diagonal elements, the one between them, and theirs in the row that is left.
typedef struct {
    float *pp, *qq, *pq, *p, *q;
} pair_t;

/// Turns both columns so that pq is zero (Golub and Van Loan, Matrix Computations, 8.5).
static void annihilate(const pair_t *at)
{
    const float pq = *at->pq;
    const float pp = *at->pp;
    const float qq = *at->qq;
    *at->pq = 0.0f;
    if ((pq * pq) <= (NEGLIGIBLE * fabsf(pp * qq))) { /* also where everything is zero */
        return;
    }
    const float tau = (qq - pp) / (2.0f * pq);
    const float t = ((tau >= 0.0f) ? 1.0f : -1.0f) / (fabsf(tau) + sqrtf(1.0f + (tau * tau)));
    const float c = 1.0f / sqrtf(1.0f + (t * t));
    const float s = t * c;
    const float p = *at->p;
    const float q = *at->q;
    *at->p = (c * p) - (s * q);
    *at->q = (s * p) + (c * q);
    *at->pp = pp - (t * pq);
    *at->qq = qq + (t * pq);
}

void jcal_eig3_values(float *m)
{
    const pair_t first = {&m[0], &m[2], &m[1], &m[3], &m[4]};
    const pair_t second = {&m[0], &m[5], &m[3], &m[1], &m[4]};
    const pair_t third = {&m[2], &m[5], &m[4], &m[1], &m[3]};
    for (unsigned sweep = 0u; (sweep < SWEEPS) && ((fabsf(m[1]) + fabsf(m[3]) + fabsf(m[4])) > 0.0f); ++sweep) {
        annihilate(&first);
        annihilate(&second);
        annihilate(&third);
    }
}

float jcal_eig3_alignment(const float *g)
{
    const jcal_vec3_t x = {g[0], g[3], g[6]};
    const jcal_vec3_t y = {g[1], g[4], g[7]};
    const jcal_vec3_t z = {g[2], g[5], g[8]};
    float square[6] = {jcal_vec3_dot(x, x), jcal_vec3_dot(y, x), jcal_vec3_dot(y, y),
                       jcal_vec3_dot(z, x), jcal_vec3_dot(z, y), jcal_vec3_dot(z, z)};
    jcal_eig3_values(square);
    const float a = sqrtf(jcal_max(square[0], 0.0f));
    const float b = sqrtf(jcal_max(square[2], 0.0f));
    const float c = sqrtf(jcal_max(square[5], 0.0f));
    const bool is_turned_over = jcal_vec3_dot(x, jcal_vec3_cross(y, z)) < 0.0f;
    return (a + b + c) - (is_turned_over ? (2.0f * jcal_min(a, jcal_min(b, c))) : 0.0f);
}
