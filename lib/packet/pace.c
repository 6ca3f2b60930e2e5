/* SPDX-License-Identifier: MIT */
/// @file
/// Hub times that go on evenly. See packet/pace.h.
#include "packet/pace.h"

#include "math/scalar.h"
#include "packet/envelope.h"

#define NS_PER_US 1000u
/// Time constant of the approach, s, and its largest share of the time that passes.
#define PACE_TAU_S 2.0f
#define PACE_MOST 0.01f
/// So far off, us, is no matter of pace; then this share of a period is the least step.
#define PACE_OFF_US 50000.0f
#define PACE_LEAST 0.9f

/// Largest correction, us, that 32 bits hold.
#define STEP_US 2e9f

/// Where 32 bits are enough their division is.
static uint64_t whole_us(uint64_t ns)
{
    return (ns <= UINT32_MAX) ? ((uint32_t)ns / NS_PER_US) : (ns / NS_PER_US);
}

static void advance(jcal_packet_pace_t *self, uint64_t ns)
{
    const uint64_t sum = self->ns + ns;
    const uint64_t whole = whole_us(sum);
    self->us += whole;
    self->ns = (uint32_t)(sum - (whole * NS_PER_US));
}

void jcal_pace_begin(jcal_packet_pace_t *self, uint32_t period_ns, uint64_t at, uint64_t us)
{
    self->at = at;
    if (self->has_last && ((int64_t)(us - self->us) <= 0)) {
        advance(self, period_ns);
        return;
    }
    self->us = us;
    self->ns = 0u;
    self->has_last = true;
}

/// What time goes on by beyond its own pace, us, when it would be `off_us` above the line after `way_us`.
static float approach(float off_us, float way_us, float period_us)
{
    if (off_us < -PACE_OFF_US) {
        return -off_us;
    }
    if (off_us > PACE_OFF_US) {
        return -jcal_min(off_us, way_us - (PACE_LEAST * period_us));
    }
    const float most_us = PACE_MOST * way_us;
    const float share = jcal_min(way_us * (1e-6f / PACE_TAU_S), 1.0f);
    return -jcal_max(jcal_min(share * off_us, most_us), -most_us);
}

uint64_t jcal_pace_to(jcal_packet_pace_t *self, uint32_t period_ns, const jcal_envelope_t *envelope, uint64_t at)
{
    if (at == self->at) {
        return self->us; /* the one with which it began */
    }
    const int64_t way_ns = (int64_t)((at - self->at) * (uint64_t)period_ns);
    const float way_us = jcal_float_of(way_ns) * 1e-3f;
    const uint64_t nominal_us = self->us + whole_us(self->ns + (uint64_t)way_ns);
    const float drift_us = 1e-6f * envelope->drift_ppm * way_us;
    const float off_us = jcal_envelope_above(envelope, period_ns, at, nominal_us) + drift_us;
    const float step_us =
        jcal_max(jcal_min(drift_us + approach(off_us, way_us, 1e-3f * (float)period_ns), STEP_US), -STEP_US);
    const int32_t step_whole_us = (int32_t)step_us;
    const int32_t rest_ns = (int32_t)((step_us - (float)step_whole_us) * (float)NS_PER_US);
    advance(self, (uint64_t)(way_ns + ((int64_t)step_whole_us * (int64_t)NS_PER_US) + rest_ns));
    self->at = at;
    return self->us;
}
