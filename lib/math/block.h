/* SPDX-License-Identifier: MIT */
/// @file
/// Products with blocks of packed symmetric matrices (layout: sym.h), written out.
///
/// The sums of the hinge fall into one block per sensor and one across. Loops over a packed triangle cost three to seven
/// times as many instructions on a small core as the same products written out, and these are most of the work.
#ifndef JCAL_BLOCK_H
#define JCAL_BLOCK_H

#include "jointcal/types.h"
#include "math/sym.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Start of row `row` of a block whose first column is `column`.
static inline const float *jcal_block_row(const float *m, size_t row, size_t column)
{
    return &m[JCAL_SYM_SIZE(row) + column];
}

/// a . b, both (6).
static inline float jcal_dot6(const float *a, const float *b)
{
    return (a[0] * b[0]) + (a[1] * b[1]) + (a[2] * b[2]) + (a[3] * b[3]) + (a[4] * b[4]) + (a[5] * b[5]);
}

/// y (6) <- y + s x, x (6).
static inline void jcal_add6(float *y, float s, const float *x)
{
    y[0] += s * x[0];
    y[1] += s * x[1];
    y[2] += s * x[2];
    y[3] += s * x[3];
    y[4] += s * x[4];
    y[5] += s * x[5];
}

/// out (6) <- D v, v (6), D the 6 x 6 block on the diagonal of m that begins at `first`. Cost: 36 multiply-adds.
static inline void jcal_block_diagonal6(const float *m, size_t first, const float *v, float *out)
{
    const float *const r0 = jcal_block_row(m, first, first);
    const float *const r1 = jcal_block_row(m, first + 1u, first);
    const float *const r2 = jcal_block_row(m, first + 2u, first);
    const float *const r3 = jcal_block_row(m, first + 3u, first);
    const float *const r4 = jcal_block_row(m, first + 4u, first);
    const float *const r5 = jcal_block_row(m, first + 5u, first);
    out[0] = (r0[0] * v[0]) + (r1[0] * v[1]) + (r2[0] * v[2]) + (r3[0] * v[3]) + (r4[0] * v[4]) + (r5[0] * v[5]);
    out[1] = (r1[0] * v[0]) + (r1[1] * v[1]) + (r2[1] * v[2]) + (r3[1] * v[3]) + (r4[1] * v[4]) + (r5[1] * v[5]);
    out[2] = (r2[0] * v[0]) + (r2[1] * v[1]) + (r2[2] * v[2]) + (r3[2] * v[3]) + (r4[2] * v[4]) + (r5[2] * v[5]);
    out[3] = (r3[0] * v[0]) + (r3[1] * v[1]) + (r3[2] * v[2]) + (r3[3] * v[3]) + (r4[3] * v[4]) + (r5[3] * v[5]);
    out[4] = (r4[0] * v[0]) + (r4[1] * v[1]) + (r4[2] * v[2]) + (r4[3] * v[3]) + (r4[4] * v[4]) + (r5[4] * v[5]);
    out[5] = jcal_dot6(r5, v);
}

/// out (6) <- C v, v (6), C the 6 x 6 block below the diagonal: rows 6 to 11, columns 0 to 5. Cost: 36 multiply-adds.
static inline void jcal_block_below6(const float *m, const float *v, float *out)
{
    for (size_t i = 0u; i < 6u; ++i) {
        out[i] = jcal_dot6(jcal_block_row(m, 6u + i, 0u), v);
    }
}

/// y (6) <- y + C' v, v (6), with the same C. Cost: 36 multiply-adds.
static inline void jcal_block_add_above6(const float *m, const float *v, float *y)
{
    for (size_t i = 0u; i < 6u; ++i) {
        jcal_add6(y, v[i], jcal_block_row(m, 6u + i, 0u));
    }
}

/// D v, D the 3 x 3 block on the diagonal of m that begins at `first`. Cost: 9 multiply-adds.
static inline jcal_vec3_t jcal_block_diagonal3(const float *m, size_t first, jcal_vec3_t v)
{
    const float *const r0 = jcal_block_row(m, first, first);
    const float *const r1 = jcal_block_row(m, first + 1u, first);
    const float *const r2 = jcal_block_row(m, first + 2u, first);
    const jcal_vec3_t out = {(r0[0] * v.x) + (r1[0] * v.y) + (r2[0] * v.z),
                             (r1[0] * v.x) + (r1[1] * v.y) + (r2[1] * v.z),
                             (r2[0] * v.x) + (r2[1] * v.y) + (r2[2] * v.z)};
    return out;
}

/// C v, C the 3 x 3 block of rows 3 to 5 and columns 0 to 2. Cost: 9 multiply-adds.
static inline jcal_vec3_t jcal_block_below3(const float *m, jcal_vec3_t v)
{
    const float *const r3 = jcal_block_row(m, 3u, 0u);
    const float *const r4 = jcal_block_row(m, 4u, 0u);
    const float *const r5 = jcal_block_row(m, 5u, 0u);
    const jcal_vec3_t out = {(r3[0] * v.x) + (r3[1] * v.y) + (r3[2] * v.z),
                             (r4[0] * v.x) + (r4[1] * v.y) + (r4[2] * v.z),
                             (r5[0] * v.x) + (r5[1] * v.y) + (r5[2] * v.z)};
    return out;
}

/// C' v with the same C. Cost: 9 multiply-adds.
static inline jcal_vec3_t jcal_block_above3(const float *m, jcal_vec3_t v)
{
    const float *const r3 = jcal_block_row(m, 3u, 0u);
    const float *const r4 = jcal_block_row(m, 4u, 0u);
    const float *const r5 = jcal_block_row(m, 5u, 0u);
    const jcal_vec3_t out = {(r3[0] * v.x) + (r4[0] * v.y) + (r5[0] * v.z),
                             (r3[1] * v.x) + (r4[1] * v.y) + (r5[1] * v.z),
                             (r3[2] * v.x) + (r4[2] * v.y) + (r5[2] * v.z)};
    return out;
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_BLOCK_H */
