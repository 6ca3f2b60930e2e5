/* SPDX-License-Identifier: MIT */
/// @file
/// Share of a one-pole low-pass. See math/decay.h.
#include "math/decay.h"

float jcal_taken_over(float x)
{
    const float y = 0.125f * x;
    const float tail =
        1.0f - (y * (1.0f / 5.0f) * (1.0f - (y * (1.0f / 6.0f) * (1.0f - (y * (1.0f / 7.0f) * (1.0f - (y / 8.0f)))))));
    float p = y * (1.0f - (0.5f * y * (1.0f - (y * (1.0f / 3.0f) * (1.0f - (0.25f * y * tail))))));
    p = p * (2.0f - p);
    p = p * (2.0f - p);
    return p * (2.0f - p);
}
