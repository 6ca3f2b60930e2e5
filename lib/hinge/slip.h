/* SPDX-License-Identifier: MIT */
/// @file
/// Notices that an axis has changed by little: what the last seconds alone would make of the axes. Private.
///
/// The blocks of hinge/refine.h give, of their own, a gradient g and a matrix H of the tilts. Summed over the last seconds they
/// say that the axes are off by d = -H^-1 g, and that going there would take g' H^-1 g off the squared residuals. Where that is many
/// times what is left of them, and the tilt more than the calibration is uncertain by, a sensor has moved. Motion that merely becomes
/// livelier, with all that skin and straps add to it, raises what is left as well.
#ifndef JCAL_HINGE_SLIP_H
#define JCAL_HINGE_SLIP_H

#include "jointcal/private/hinge/slip.h"

#include <stdbool.h>

/// Makes room for a block of this duration, s.
void jcal_hinge_slip_fade(jcal_hinge_slip_t *self, float time_s);

/// The axes have been moved by d (4), rad: so have the gradients.
void jcal_hinge_slip_move(jcal_hinge_slip_t *self, const float *d);

/// True if the last seconds want one of the axes elsewhere by more than `allowed_rad`. Cost: 60 multiply-adds, 4 roots.
bool jcal_hinge_slip_alarm(const jcal_hinge_slip_t *self, float allowed_rad);

#endif /* JCAL_HINGE_SLIP_H */
