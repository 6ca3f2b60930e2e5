/* SPDX-License-Identifier: MIT */
/* How firmware uses jointcal. README.md shows the first functions; a test compares them. */

#include "jointcal/jointcal.h"

#include <math.h>
#include <stdio.h>

static jcal_hinge_auto_t knee; /* a plain struct: no heap, no hidden state */

/* Once, before the first reading. */
static bool knee_start(void)
{
    const jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    return jcal_hinge_auto_init(&knee, &config) == JCAL_OK;
}

/* Call this for every pair of readings: rad/s, m/s^2, microseconds from any origin. */
static bool knee_is_ready(uint64_t t_us, jcal_imu_t thigh, jcal_imu_t shank, jcal_hinge_auto_result_t *result)
{
    const jcal_pair_t pair = {t_us, thigh, shank};
    (void)jcal_hinge_auto_update(&knee, &pair);   /* a rejected sample is counted in the result */
    (void)jcal_hinge_auto_get(&knee, result);     /* axes, what they are good for, how far off they may be */
    return result->ready_for != JCAL_FOR_NOTHING; /* jcal_hinge_auto_flexion(&knee) is the angle, rad */
}

/* In place of a sensor: a segment that hangs from a tilting joint axis (its z) and turns about it. */
static jcal_imu_t segment(float tilt, float tilt_rate, float turn, float turn_rate)
{
    const float g = 9.81f, s = sinf(turn), c = cosf(turn);
    const jcal_imu_t imu = {{tilt_rate * c, -tilt_rate * s, turn_rate},
                            {g * sinf(tilt) * s, g * sinf(tilt) * c, g * cosf(tilt)}};
    return imu;
}

int main(void)
{
    if (!knee_start()) {
        return 1;
    }
    jcal_hinge_auto_result_t result;
    bool ready = false;
    for (uint32_t k = 0; k < 3000 && !ready; k++) { /* 50 Hz, at most one minute */
        const float t = 0.02f * (float)k, tilt = 1.0f + sinf(t), tilt_rate = cosf(t);
        const jcal_imu_t thigh = segment(tilt, tilt_rate, 0.4f * sinf(2.0f * t), 0.8f * cosf(2.0f * t));
        const jcal_imu_t shank = segment(tilt, tilt_rate, 0.9f * sinf(3.0f * t), 2.7f * cosf(3.0f * t));
        ready = knee_is_ready(20000u * (uint64_t)k, thigh, shank, &result);
    }
    if (ready) {
        printf("axis of the shank sensor: %.3f %.3f %.3f, right to %.1f deg\n", (double)result.hinge.axis2.x,
               (double)result.hinge.axis2.y, (double)result.hinge.axis2.z,
               (double)result.hinge.uncertainty2_rad * 57.3);
    }
    return ready ? 0 : 1;
}
