/* SPDX-License-Identifier: MIT */
/* How firmware uses jointcal. The part below this comment is the README's; a test compares them. */

#include "jointcal/jointcal.h"

#include <math.h>
#include <stdio.h>

static jcal_hinge_t hinge; /* plain struct: no heap, no hidden state */

/* Call this for every pair of readings: rad/s, m/s^2, microseconds from any origin. */
static bool on_sample(uint64_t t_us, jcal_imu_t thigh, jcal_imu_t shank)
{
    const jcal_pair_t pair = {t_us, thigh, shank};
    jcal_hinge_result_t result;
    (void)jcal_hinge_update(&hinge, &pair); /* a rejected sample is counted in the result */
    (void)jcal_hinge_get(&hinge, &result);
    if (result.status == JCAL_READY) {
        printf("axis of the shank sensor: %.3f %.3f %.3f, right to %.1f deg\n", (double)result.axis2.x,
               (double)result.axis2.y, (double)result.axis2.z, (double)result.uncertainty2_rad * 57.3);
    }
    return result.status == JCAL_READY;
}

int main(void)
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    if (jcal_hinge_init(&hinge, &config) != JCAL_OK) {
        return 1;
    }
    /* In place of sensors: a knee that bends about z while the leg sways, 50 Hz, at most one minute. */
    bool ready = false;
    for (uint32_t k = 0; k < 3000 && !ready; k++) {
        const float t = 0.02f * (float)k, sway = 0.3f * cosf(t), bend = 1.5f * cosf(3.0f * t);
        const jcal_imu_t thigh = {{sway, 0.5f * sway, 0.0f}, {0.0f, 9.81f, 1.0f}};
        const jcal_imu_t shank = {{sway, 0.5f * sway, bend}, {9.81f * sinf(t), 9.81f * cosf(t), 1.0f}};
        ready = on_sample(20000u * (uint64_t)k, thigh, shank);
    }
    return 0;
}
