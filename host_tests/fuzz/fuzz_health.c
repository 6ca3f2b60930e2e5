/* SPDX-License-Identifier: MIT */
/* Any bytes as readings of one sensor: what is said of its health stays within what the header promises, and asking changes nothing. */
#include "bytes.h"
#include "jointcal/jointcal.h"

#include <math.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define READING_BYTES 14u /* 2 bytes of time step, 6 values of 2 bytes */
#define ASK_EVERY 16u

static jcal_reading_t reading_at(const uint8_t *data, reading_t kind, uint64_t *t_us)
{
    *t_us += step_of(data, kind, 1u);
    const jcal_reading_t reading = {*t_us, imu_at(data + 2, kind, 35.0f, 160.0f)};
    return reading;
}

static void check_way(const jcal_health_way_t *way)
{
    unsigned columns = 0;
    for (int k = 0; k < 3; k++) {
        require(way->column[k] >= 0 && way->column[k] < 3 && (way->sign[k] == 1 || way->sign[k] == -1));
        columns |= 1u << (unsigned)way->column[k];
    }
    require(columns == 7u);
}

static void check_numbers(const jcal_health_result_t *result)
{
    require(isfinite(result->rate_hz) && result->rate_hz >= 0.0f);
    require(isfinite(result->longest_gap_s) && result->longest_gap_s >= 0.0f);
    require_within(result->rest_s, 0.0f, 60.0f);
    require(isfinite(result->rms_rad_s) && result->rms_rad_s >= 0.0f);
    require(isfinite(result->motion_s) && result->motion_s >= 0.0f);
    require_within(result->scale_bound, 0.0f, 1.0f);
    require_within(result->fast_share, 0.0f, 1.0f);
    require_within(result->fact[JCAL_FINDING_GAPS], 0.0f, 1.0f);
    require_within(result->fact[JCAL_FINDING_DEAD], 0.0f, 6.0f);
    require(result->dead < 64u && result->clipped < 4096u);
    require((result->dead != 0u) == (result->state[JCAL_FINDING_DEAD] == JCAL_HEALTH_NAMED));
    require((result->clipped != 0u) == (result->state[JCAL_FINDING_CLIPPED] == JCAL_HEALTH_NAMED));
}

static void check(const jcal_health_t *health, uint32_t taken, uint32_t rejected)
{
    static jcal_health_result_t result;
    static jcal_health_result_t again;
    require(jcal_health_get(health, &result) == JCAL_OK && jcal_health_get(health, &again) == JCAL_OK);
    require(memcmp(&result, &again, sizeof result) == 0);
    require(result.readings == taken && result.rejected == rejected);
    for (int k = 0; k < (int)JCAL_FINDING_COUNT; k++) {
        require(result.state[k] >= JCAL_HEALTH_UNKNOWN && result.state[k] <= JCAL_HEALTH_NAMED);
        require(isfinite(result.fact[k]) && result.fact[k] >= 0.0f);
        require(result.state[k] != JCAL_HEALTH_UNKNOWN || result.fact[k] == 0.0f);
    }
    check_numbers(&result);
    require(!result.way_known || result.state[JCAL_FINDING_FRAMES] == JCAL_HEALTH_NAMED);
    if (result.state[JCAL_FINDING_FRAMES] == JCAL_HEALTH_NAMED) {
        check_way(&result.way);
    }
}

/* The first byte chooses the kind and how often the readings are repeated; then come readings. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static jcal_health_t health;
    require(jcal_health_init(&health) == JCAL_OK);
    if (size == 0) {
        return 0;
    }
    const reading_t kind = ((data[0] & 1u) != 0) ? AS_SENSOR : AS_FLOATS;
    const unsigned repeats = 1u + (data[0] >> 4);
    uint64_t t_us = (data[0] & 2u) != 0 ? UINT64_MAX - 1000000u : 0;
    uint32_t taken = 0;
    uint32_t rejected = 0;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 1; at + READING_BYTES <= size; at += READING_BYTES) {
            const jcal_reading_t reading = reading_at(data + at, kind, &t_us);
            const jcal_status_t status = jcal_health_push(&health, &reading);
            require(status == JCAL_OK || status == JCAL_REJECTED);
            taken += (status == JCAL_OK) ? 1u : 0u;
            rejected += (status == JCAL_REJECTED) ? 1u : 0u;
            if ((taken + rejected) % ASK_EVERY == 0u) {
                check(&health, taken, rejected);
            }
        }
    }
    check(&health, taken, rejected);
    return 0;
}
