/* SPDX-License-Identifier: MIT */
/// @file
/// Arc tangent, sine and cosine by polynomials, and the mean length of a Gaussian vector.
#include "math/angle.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* atan(x) = x + x^3 p(x^2) on |x| <= tan(pi/8), minimax in the absolute error: 4.9e-9 rad before rounding. */
static const float atan_poly[4] = {-0.333327562f, 0.199718788f, -0.138244539f, 0.0790259689f};

/* sin(x) = x + x^3 p(x^2), cos(x) = 1 - x^2 / 2 + x^4 q(x^2) on |x| <= pi/4, minimax: 1.8e-9 and 1e-10. */
static const float sin_poly[3] = {-0.16666651f, 0.008331979f, -0.00019495636f};
static const float cos_poly[3] = {0.041666646f, -0.0013887368f, 2.4438452e-05f};

/* pi/2 in three parts; a small whole number times the first or the second is exact. */
static const float half_pi_parts[3] = {1.5703125f, 0.00048375129699707f, 7.54979e-08f};

static const float tan_pi_8 = 0.414213562f;
static const float quarter_pi = 0.785398163f;
static const float two_over_pi = 0.636619772f;

/* atan(small / large) for 0 <= small <= large, large > 0: in [0, pi/4]. */
static float atan_ratio(float small, float large)
{
    /* Above pi/8: atan(q) = pi/4 + atan((q - 1) / (q + 1)), without dividing twice. */
    const bool upper = small > (tan_pi_8 * large);
    const float x = upper ? ((small - large) / (small + large)) : (small / large);
    const float z = x * x;
    const float p = atan_poly[0] + (z * (atan_poly[1] + (z * (atan_poly[2] + (z * atan_poly[3])))));
    const float a = x + (x * z * p);
    return upper ? (quarter_pi + a) : a;
}

float jcal_atan2(float y, float x)
{
    const float ax = fabsf(x);
    const float ay = fabsf(y);
    if ((ax == 0.0f) && (ay == 0.0f)) {
        return 0.0f;
    }
    const float octant = (ay <= ax) ? atan_ratio(ay, ax) : (JCAL_HALF_PI - atan_ratio(ax, ay));
    const float half = (x >= 0.0f) ? octant : (JCAL_PI - octant);
    return (y >= 0.0f) ? half : -half;
}

jcal_plane_t jcal_cis(float x)
{
    if (!(fabsf(x) <= JCAL_CIS_MAX_RAD)) {
        const jcal_plane_t none = {NAN, NAN};
        return none;
    }
    const float quarters = x * two_over_pi;
    const int32_t k = (int32_t)(quarters + ((quarters >= 0.0f) ? 0.5f : -0.5f));
    const float n = (float)k;
    const float r = ((x - (n * half_pi_parts[0])) - (n * half_pi_parts[1])) - (n * half_pi_parts[2]);
    const float z = r * r;
    const float s = r + (r * z * (sin_poly[0] + (z * (sin_poly[1] + (z * sin_poly[2])))));
    const float c = 1.0f - (0.5f * z) + (z * z * (cos_poly[0] + (z * (cos_poly[1] + (z * cos_poly[2])))));
    const uint32_t quadrant = (uint32_t)k & 3u; /* of the complement, so negative k wrap as they must */
    const jcal_plane_t straight = {c, s};
    const jcal_plane_t quarter = {-s, c};
    const jcal_plane_t at = ((quadrant & 1u) != 0u) ? quarter : straight;
    const jcal_plane_t out = {(quadrant >= 2u) ? -at.re : at.re, (quadrant >= 2u) ? -at.im : at.im};
    return out;
}

float jcal_angle_mean_plus_2_sigma(float p00, float p01, float p11)
{
    const float mean = 0.5f * (p00 + p11);
    const float half_difference = 0.5f * (p00 - p11);
    const float radius = sqrtf((half_difference * half_difference) + (p01 * p01));
    /* The clamps keep rounding of a nearly singular covariance out of the square roots; NaN passes through. */
    const float s1 = sqrtf(((mean + radius) < 0.0f) ? 0.0f : (mean + radius));
    const float s2 = sqrtf(((mean - radius) < 0.0f) ? 0.0f : (mean - radius));
    const float sum = s1 + s2;
    if (sum == 0.0f) {
        return 0.0f;
    }
    const float root_h = (s1 - s2) / sum;
    const float three_h = 3.0f * root_h * root_h;
    /* Ramanujan 1914: quarter perimeter = pi/4 (s1 + s2) (1 + 3h / (10 + sqrt(4 - 3h))). */
    const float quarter_perimeter = quarter_pi * sum * (1.0f + (three_h / (10.0f + sqrtf(4.0f - three_h))));
    const float mu = sqrtf(two_over_pi) * quarter_perimeter;
    /* At least (1 - 2 / pi) s1^2, far from a negative argument. */
    return mu + (2.0f * sqrtf((s1 * s1) + (s2 * s2) - (mu * mu)));
}
