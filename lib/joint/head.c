/* SPDX-License-Identifier: MIT */
/// @file
/// Fills in the head of a result. See joint/head.h.
#include "joint/head.h"

#include "math/scalar.h"

#include <float.h>

float jcal_head_progress(float bound, float limit)
{
    return jcal_min(1.0f, limit / jcal_max(bound, FLT_MIN));
}
