/* SPDX-License-Identifier: MIT */
/// @file
/// Products of the columns of two sensors' matrices, split by what a heading does to them. Private.
#ifndef JCAL_LEVERS_PRODUCTS_H
#define JCAL_LEVERS_PRODUCTS_H

#include "jointcal/private/plane.h"
#include "jointcal/types.h"

#include <stddef.h>

/// One product of columns: its vertical part, and the complex one of its horizontal parts, (x1 - i y1)(x2 + i y2).
typedef struct {
    float *up, *re, *im;
} jcal_products_t;

static inline void jcal_products_add(const jcal_products_t *to, size_t at, jcal_vec3_t a, jcal_vec3_t b)
{
    to->up[at] += a.z * b.z;
    to->re[at] += (a.x * b.x) + (a.y * b.y);
    to->im[at] += (a.x * b.y) - (a.y * b.x);
}

/// out (n) <- out + Re(heading (re + i im)).
static inline void jcal_products_turned(float *out, const float *re, const float *im, jcal_plane_t heading, size_t n)
{
    for (size_t i = 0u; i < n; ++i) {
        out[i] += (heading.re * re[i]) - (heading.im * im[i]);
    }
}

#endif /* JCAL_LEVERS_PRODUCTS_H */
