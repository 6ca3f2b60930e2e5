/* SPDX-License-Identifier: MIT */
/// @file
/// Small helpers on single floats that C's library would turn into calls.
#ifndef JCAL_SCALAR_H
#define JCAL_SCALAR_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The larger of two numbers; b if either is NaN.
static inline float jcal_max(float a, float b)
{
    return (a > b) ? a : b;
}

/// The smaller of two numbers; b if either is NaN.
static inline float jcal_min(float a, float b)
{
    return (a < b) ? a : b;
}

/// True if low <= value <= high; NaN is outside of every range.
static inline bool jcal_within(float value, float low, float high)
{
    return (value >= low) && (value <= high);
}

/// True unless NaN or infinite: the exponent is not all ones. Works on bits, so that no option of the compiler changes it.
static inline bool jcal_is_finite(float value)
{
    const uint32_t exponent = 0x7F800000u;
    uint32_t bits;
    (void)memcpy(&bits, &value, sizeof bits);
    return (bits & exponent) != exponent;
}

/// A whole number as a float, rounded once; without the run-time's conversion of 64 bits, 80 instructions, where 32 are enough.
static inline float jcal_float_of(int64_t whole)
{
    const bool is_short = (whole >= INT32_MIN) && (whole <= INT32_MAX);
    return is_short ? (float)(int32_t)whole : (float)whole;
}

/// Natural logarithm of a positive, normal number; relative error below 1e-6, absolute error below 1e-7 near 1.
///
/// Method:   x = 2^k m with m in [2/3, 4/3], then ln m = 2 artanh((m - 1) / (m + 1)) as a series of four terms.
static inline float jcal_ln(float x)
{
    const uint32_t two_thirds = 0x3F2AAAABu;
    const float ln_2 = 0.69314718f;
    uint32_t bits;
    (void)memcpy(&bits, &x, sizeof bits);
    const int32_t k = ((int32_t)(bits - two_thirds)) >> 23;
    bits -= (uint32_t)k << 23;
    float m;
    (void)memcpy(&m, &bits, sizeof m);
    const float s = (m - 1.0f) / (m + 1.0f);
    const float s2 = s * s;
    const float series = s * (2.0f + (s2 * ((2.0f / 3.0f) + (s2 * ((2.0f / 5.0f) + (s2 * (2.0f / 7.0f)))))));
    return ((float)k * ln_2) + series;
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_SCALAR_H */
