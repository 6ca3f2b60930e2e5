/* SPDX-License-Identifier: MIT */
/* Runs the health of one sensor over arrays. */
#include "batch_health.h"

#include "health/frames.h"
#include "health/scale.h"

#include <string.h>

static void write(const jcal_health_t *health, jcal_batch_health_out_t *out)
{
    jcal_health_result_t r;
    (void)jcal_health_get(health, &r);
    for (int k = 0; k < JCAL_FINDING_COUNT; k++) {
        out->state[k] = (int32_t)r.state[k];
        out->fact[k] = r.fact[k];
    }
    const float numbers[JCAL_BATCH_HEALTH_NUMBERS] = {r.rate_hz,
                                                      (float)r.gaps,
                                                      r.rest_s,
                                                      r.rms_rad_s,
                                                      r.motion_s,
                                                      r.scale_bound,
                                                      r.fast_share,
                                                      (float)r.dead,
                                                      (float)r.clipped,
                                                      r.way_known ? 1.0f : 0.0f,
                                                      r.way_of_gyr ? 1.0f : 0.0f,
                                                      r.way.column[0],
                                                      r.way.column[1],
                                                      r.way.column[2],
                                                      r.way.sign[0],
                                                      r.way.sign[1],
                                                      r.way.sign[2]};
    memcpy(out->numbers, numbers, sizeof(numbers));
    for (unsigned k = 0; k < sizeof(out->score) / sizeof(out->score[0]); k++) {
        out->score[k] = jcal_health_frames_score(&health->frames, k);
    }
    out->trials = (float)health->frames.trials;
    out->fits = (float)health->frames.fits;
    const jcal_health_scale_found_t found = jcal_health_scale_solve(&health->scale);
    out->scale = found.scale;
    out->deviation = found.deviation;
}

int32_t jcal_batch_health(const uint64_t *t_us, const float *values, size_t count, jcal_batch_health_out_t *out)
{
    jcal_health_t health;
    if (jcal_health_init(&health) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    for (size_t k = 0; k < count; k++) {
        const float *const v = values + k * 6;
        const jcal_reading_t reading = {t_us[k], {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}};
        (void)jcal_health_push(&health, &reading);
    }
    write(&health, out);
    return JCAL_BATCH_DONE;
}
