/* SPDX-License-Identifier: MIT */
/// @file
/// Fading of the sums, and drift of the heading offset. See two_dof/memory.h.
#include "two_dof/memory.h"

#include "jointcal/status.h"
#include "math/angle.h"
#include "math/plane.h"
#include "math/scalar.h"

/// How often sums fade: after this share of the memory, -ln(JCAL_TWO_DOF_FADE_KEEP).
#define FADE_SHARE 0.287682f
/// Memory while nothing is known yet, s; and while what is remembered does not fit together, say because an orientation filter
/// had not settled.
#define COLLECT_MEMORY_S 40.0f
#define MISFIT_MEMORY_S 6.0f
#define MISFIT_FORGET 4.0f

/// Time over which the drift of the heading offset is averaged, s, and the largest that is believed, times what the config says.
#define DRIFT_TIME_S 20.0f
#define DRIFT_MAX 2.0f

bool jcal_two_dof_fade_is_due(const jcal_two_dof_memory_t *self, const jcal_two_dof_config_t *cfg,
                              const jcal_two_dof_verdict_t *verdict)
{
    const bool ready = verdict->status == (uint8_t)JCAL_READY;
    const float collect_s = (verdict->excess > MISFIT_FORGET) ? MISFIT_MEMORY_S : COLLECT_MEMORY_S;
    return self->since_s >= (FADE_SHARE * (ready ? cfg->memory_s : collect_s));
}

bool jcal_two_dof_follow_drift(jcal_two_dof_memory_t *self, const jcal_two_dof_config_t *cfg, jcal_plane_t now,
                               jcal_plane_t *turn)
{
    const jcal_plane_t turned = jcal_plane_against(self->heading_then, now);
    self->heading_then = now;
    if (!(jcal_plane_norm2(turned) > 0.0f)) {
        return false;
    }
    const float time_s = self->since_s;
    const float limit = DRIFT_MAX * cfg->heading_drift_rad_s;
    const float rate = jcal_atan2(turned.im, turned.re) / time_s;
    const float drift = self->drift_rad_s + ((rate - self->drift_rad_s) * (time_s / (time_s + DRIFT_TIME_S)));
    self->drift_rad_s = jcal_max(jcal_min(drift, limit), -limit);
    *turn = jcal_plane_turn(self->drift_rad_s * time_s);
    return true;
}
