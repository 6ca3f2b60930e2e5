/* SPDX-License-Identifier: MIT */
/// @file
/// Small Cholesky factors, written out. See math/chol_small.h.
#include "math/chol_small.h"

#include "math/chol.h"
#include "math/scalar.h"

#include <float.h>
#include <math.h>

/// Smallest pivot that counts, of an n x n matrix with this largest diagonal element.
static inline float tolerance_of(float n, float largest)
{
    return JCAL_CHOL_PIVOT_FACTOR * n * FLT_EPSILON * jcal_max(largest, 0.0f);
}

/// The leading 3 x 3, whose pivots are to be above `tolerance`; NaN fails.
static inline bool factor3(float *m, float tolerance)
{
    if (!(m[0] > tolerance)) {
        return false;
    }
    m[0] = sqrtf(m[0]);
    m[1] = m[1] / m[0];
    const float second = m[2] - (m[1] * m[1]);
    if (!(second > tolerance)) {
        return false;
    }
    m[2] = sqrtf(second);
    m[3] = m[3] / m[0];
    m[4] = (m[4] - (m[3] * m[1])) / m[2];
    const float third = m[5] - (m[3] * m[3]) - (m[4] * m[4]);
    if (!(third > tolerance)) {
        return false;
    }
    m[5] = sqrtf(third);
    return true;
}

/// Row 3, at m[6], behind a factored 3 x 3.
static inline bool factor_row3(float *m, float tolerance)
{
    const float a = m[6] / m[0];
    const float b = (m[7] - (a * m[1])) / m[2];
    const float c = (m[8] - (a * m[3]) - (b * m[4])) / m[5];
    const float pivot = m[9] - (a * a) - (b * b) - (c * c);
    if (!(pivot > tolerance)) {
        return false;
    }
    m[6] = a;
    m[7] = b;
    m[8] = c;
    m[9] = sqrtf(pivot);
    return true;
}

/// Row 4, at m[10].
static inline bool factor_row4(float *m, float tolerance)
{
    const float a = m[10] / m[0];
    const float b = (m[11] - (a * m[1])) / m[2];
    const float c = (m[12] - (a * m[3]) - (b * m[4])) / m[5];
    const float d = (m[13] - (a * m[6]) - (b * m[7]) - (c * m[8])) / m[9];
    const float pivot = m[14] - (a * a) - (b * b) - (c * c) - (d * d);
    if (!(pivot > tolerance)) {
        return false;
    }
    m[10] = a;
    m[11] = b;
    m[12] = c;
    m[13] = d;
    m[14] = sqrtf(pivot);
    return true;
}

/// Row 5, at m[15].
static inline bool factor_row5(float *m, float tolerance)
{
    const float a = m[15] / m[0];
    const float b = (m[16] - (a * m[1])) / m[2];
    const float c = (m[17] - (a * m[3]) - (b * m[4])) / m[5];
    const float d = (m[18] - (a * m[6]) - (b * m[7]) - (c * m[8])) / m[9];
    const float e = (m[19] - (a * m[10]) - (b * m[11]) - (c * m[12]) - (d * m[13])) / m[14];
    const float pivot = m[20] - (a * a) - (b * b) - (c * c) - (d * d) - (e * e);
    if (!(pivot > tolerance)) {
        return false;
    }
    m[15] = a;
    m[16] = b;
    m[17] = c;
    m[18] = d;
    m[19] = e;
    m[20] = sqrtf(pivot);
    return true;
}

bool jcal_chol3_factor(float *m)
{
    return factor3(m, tolerance_of(3.0f, jcal_max(jcal_max(m[0], m[2]), m[5])));
}

bool jcal_chol4_factor(float *m)
{
    const float tolerance = tolerance_of(4.0f, jcal_max(jcal_max(m[0], m[2]), jcal_max(m[5], m[9])));
    return factor3(m, tolerance) && factor_row3(m, tolerance);
}

bool jcal_chol6_factor(float *m)
{
    const float first = jcal_max(jcal_max(m[0], m[2]), m[5]);
    const float last = jcal_max(jcal_max(m[9], m[14]), m[20]);
    const float tolerance = tolerance_of(6.0f, jcal_max(first, last));
    return factor3(m, tolerance) && factor_row3(m, tolerance) && factor_row4(m, tolerance) && factor_row5(m, tolerance);
}

void jcal_chol3_solve(const float *l, float *x)
{
    const float y0 = x[0] / l[0];
    const float y1 = (x[1] - (l[1] * y0)) / l[2];
    const float y2 = (x[2] - (l[3] * y0) - (l[4] * y1)) / l[5];
    x[2] = y2 / l[5];
    x[1] = (y1 - (l[4] * x[2])) / l[2];
    x[0] = (y0 - (l[1] * x[1]) - (l[3] * x[2])) / l[0];
}

void jcal_chol4_solve(const float *l, float *x)
{
    const float y0 = x[0] / l[0];
    const float y1 = (x[1] - (l[1] * y0)) / l[2];
    const float y2 = (x[2] - (l[3] * y0) - (l[4] * y1)) / l[5];
    const float y3 = (x[3] - (l[6] * y0) - (l[7] * y1) - (l[8] * y2)) / l[9];
    const float x3 = y3 / l[9];
    const float x2 = (y2 - (l[8] * x3)) / l[5];
    const float x1 = (y1 - (l[4] * x2) - (l[7] * x3)) / l[2];
    x[0] = (y0 - (l[1] * x1) - (l[3] * x2) - (l[6] * x3)) / l[0];
    x[1] = x1;
    x[2] = x2;
    x[3] = x3;
}

void jcal_chol6_solve(const float *l, float *x)
{
    const float y0 = x[0] / l[0];
    const float y1 = (x[1] - (l[1] * y0)) / l[2];
    const float y2 = (x[2] - (l[3] * y0) - (l[4] * y1)) / l[5];
    const float y3 = (x[3] - (l[6] * y0) - (l[7] * y1) - (l[8] * y2)) / l[9];
    const float y4 = (x[4] - (l[10] * y0) - (l[11] * y1) - (l[12] * y2) - (l[13] * y3)) / l[14];
    const float y5 = (x[5] - (l[15] * y0) - (l[16] * y1) - (l[17] * y2) - (l[18] * y3) - (l[19] * y4)) / l[20];
    const float x5 = y5 / l[20];
    const float x4 = (y4 - (l[19] * x5)) / l[14];
    const float x3 = (y3 - (l[13] * x4) - (l[18] * x5)) / l[9];
    const float x2 = (y2 - (l[8] * x3) - (l[12] * x4) - (l[17] * x5)) / l[5];
    const float x1 = (y1 - (l[4] * x2) - (l[7] * x3) - (l[11] * x4) - (l[16] * x5)) / l[2];
    x[0] = (y0 - (l[1] * x1) - (l[3] * x2) - (l[6] * x3) - (l[10] * x4) - (l[15] * x5)) / l[0];
    x[1] = x1;
    x[2] = x2;
    x[3] = x3;
    x[4] = x4;
    x[5] = x5;
}
