/* SPDX-License-Identifier: MIT */
/// @file
/// What the last seconds say; lib/hinge/slip.h has the equations.
#ifndef JCAL_PRIVATE_HINGE_SLIP_H
#define JCAL_PRIVATE_HINGE_SLIP_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What the last seconds alone say of the axes; lib/hinge/slip.h.
typedef struct {
    float gradient[4];  ///< Half the gradient of the tilts, biases eliminated.
    float matrix[10];   ///< Packed 4 x 4.
    float cost;         ///< Squared residuals, in units of the assumed noise.
    float time_s;
} jcal_hinge_slip_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_SLIP_H */
