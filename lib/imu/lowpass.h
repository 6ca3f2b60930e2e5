/* SPDX-License-Identifier: MIT */
/// @file
/// Second-order Butterworth low-pass whose first seconds are the running mean. Private.
///
/// y'' = w^2 (x - y) - sqrt(2) w y', in the trapezoidal rule with the states y and y'/w, both twice: as two integrators it has neither the
/// tiny coefficients of the usual form nor states that mean something else when the step changes.
#ifndef JCAL_IMU_LOWPASS_H
#define JCAL_IMU_LOWPASS_H

#include <stdbool.h>

/// Time constant, s, as [VQF] counts it: w = sqrt(2) / tau. So long the running mean is taken.
#define JCAL_LOWPASS_TAU_S 3.0f
#define JCAL_LOWPASS_SQRT2 1.41421356f

/// What one step does.
typedef struct {
    const float *level;  ///< Coefficients of the low-pass, from jcal_lowpass_set.
    float share;         ///< Share of the new value in the running mean; 0: the low-pass works.
} jcal_lowpass_t;

/// The coefficients for steps of `dt_s`, at most 0.3 s: then the tangent's series is right to 1e-4 of itself.
static inline void jcal_lowpass_set(float level[3], float dt_s)
{
    const float x = (0.5f * JCAL_LOWPASS_SQRT2 / JCAL_LOWPASS_TAU_S) * dt_s;
    const float g = x * (1.0f + (x * x * (1.0f / 3.0f)));
    level[0] = 1.0f / (1.0f + (g * (g + JCAL_LOWPASS_SQRT2)));
    level[1] = g * level[0];
    level[2] = g * level[1];
}

/// The low-pass for a step of `dt_s` that begins `since_s` after the start: the running mean at first.
static inline jcal_lowpass_t jcal_lowpass_for(const float *level, float since_s, float dt_s)
{
    const bool is_mean = (since_s + (0.5f * dt_s)) < JCAL_LOWPASS_TAU_S;
    const jcal_lowpass_t by = {level, is_mean ? (dt_s / (since_s + dt_s)) : 0.0f};
    return by;
}

/// Takes in x; returns y.
static inline float jcal_lowpass_put(const jcal_lowpass_t *by, float x, float *mean, float *slope)
{
    const float step = x - *mean;
    if (by->share > 0.0f) {
        *mean += by->share * step;
        return *mean;
    }
    const float half = (by->level[1] * *slope) + (by->level[2] * step);
    const float out = *mean + half;
    *slope = (2.0f * ((by->level[0] * *slope) + (by->level[1] * step))) - *slope;
    *mean = out + half;
    return out;
}

#endif /* JCAL_IMU_LOWPASS_H */
