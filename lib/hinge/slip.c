/* SPDX-License-Identifier: MIT */
/// @file
/// Small slips. See hinge/slip.h.
#include "hinge/slip.h"

#include "hinge/block.h"
#include "hinge/model.h"
#include "math/chol.h"
#include "math/scalar.h"
#include "math/solve.h"
#include "math/sym.h"

#define TILTS JCAL_HINGE_TILTS

/// Memory, s in blocks.
#define MEMORY_S 3.0f
/// With less than this in it there is no alarm, s.
#define SEEN_MIN_S 1.0f
/// What is taken off must be this many times the residuals' own variance: residuals of neighbouring readings are alike, so that chance
/// makes it ten times what it would be were they not.
#define EXPLAINED_MIN 45.0f
/// Residual power below which nothing is believed, in units of the assumed noise power.
#define NOISE_MIN 0.05f
/// Damping of the step beside a unit diagonal: what the last seconds leave open does not count as off.
#define DAMPING 0.02f

void jcal_hinge_slip_fade(jcal_hinge_slip_t *self, float time_s)
{
    const float share = MEMORY_S / (MEMORY_S + time_s);
    for (unsigned i = 0u; i < TILTS; ++i) {
        self->gradient[i] *= share;
    }
    jcal_sym_scale(self->matrix, TILTS, share);
    self->cost *= share;
    self->time_s *= share;
}

void jcal_hinge_slip_move(jcal_hinge_slip_t *self, const float *d)
{
    float shift[TILTS];
    jcal_sym_times(self->matrix, TILTS, d, shift);
    for (unsigned i = 0u; i < TILTS; ++i) {
        self->gradient[i] += shift[i];
    }
}

bool jcal_hinge_slip_alarm(const jcal_hinge_slip_t *self, float allowed_rad)
{
    float factor[JCAL_SYM_SIZE(TILTS)];
    float scale[TILTS];
    float d[TILTS];
    for (unsigned i = 0u; i < JCAL_SYM_SIZE(TILTS); ++i) {
        factor[i] = self->matrix[i];
    }
    if ((self->time_s < SEEN_MIN_S) || !jcal_chol_factor_damped(factor, TILTS, DAMPING, scale)) {
        return false;
    }
    float explained = 0.0f;
    for (unsigned i = 0u; i < TILTS; ++i) {
        d[i] = self->gradient[i];
    }
    jcal_chol_solve_scaled(factor, TILTS, scale, d);
    for (unsigned i = 0u; i < TILTS; ++i) {
        explained += d[i] * self->gradient[i];
    }
    const float readings = 2.0f * self->time_s / JCAL_HINGE_UNIT_S;
    const float left = jcal_max(self->cost - explained, NOISE_MIN * readings) / readings;
    const float most = jcal_max(jcal_gn_length(&d[0], 2u), jcal_gn_length(&d[2], 2u));
    return (explained > (EXPLAINED_MIN * left)) && (most > allowed_rad);
}
