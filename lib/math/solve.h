/* SPDX-License-Identifier: MIT */
/// @file
/// Damped Gauss-Newton (Levenberg-Marquardt) steps. Sees cost, gradient and matrix, never samples.
///
/// The caller sums, over whatever it keeps, a quadratic model of its cost V around the current unknowns:
///
///     V(d) ~ cost + gradient . d + d^T matrix d / 2
///
/// With V = sum e^2 / 2 that is gradient = J^T e and matrix = J^T J. The unknowns d (n) are a step in local
/// coordinates: two per axis on the unit sphere (sphere.h), one per plain number such as a bias. One iteration:
///
///     jcal_gn_step(&gn, &model, d, NULL)           d <- -(matrix + damping D)^-1 gradient
///     trial = unknowns moved by d                  jcal_gn_move
///     change = V(trial) - V(unknowns)              the caller's, without cancellation: sum of (e' - e)(e' + e) / 2
///     jcal_gn_judge(&gn, predicted, change)        true: keep the trial. Adapts the damping either way.
///
/// In float32 the difference of two summed costs is noise once a step is small; that is why judge wants the change.
#ifndef JCAL_SOLVE_H
#define JCAL_SOLVE_H

#include "jointcal/config.h"
#include "jointcal/vec3.h"
#include "math/chol.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define JCAL_GN_DAMPING_START 1e-3f  ///< Damping after init, relative to the matrix's diagonal.
#define JCAL_GN_DAMPING_MIN                                                                                            \
    1e-6f  ///< Never damped less. If an open direction needs more, step fails once and raises it.
#define JCAL_GN_DAMPING_MAX 1e6f  ///< Never damped more.

/// An unknown counts with at least this share of the largest diagonal element when it is damped: D = max(diagonal,
/// share * largest).
#define JCAL_GN_DIAGONAL_SHARE 1e-2f

/// A step is kept if the cost falls by at least this share of what the model promised.
#define JCAL_GN_KEEP_RATIO 1e-2f

/// State of one iteration.
typedef struct {
    float damping;
} jcal_gn_t;

/// The cost around the current unknowns, see above.
typedef struct {
    size_t n;               ///< Unknowns, in [1, JCAL_CHOL_MAX].
    const float *gradient;  ///< (n)
    const float *matrix;    ///< n x n, packed as in sym.h, positive semidefinite.
} jcal_gn_model_t;

/// Start of an iteration at new unknowns.
static inline jcal_gn_t jcal_gn_begin(void)
{
    const jcal_gn_t gn = {JCAL_GN_DAMPING_START};
    return gn;
}

/// The damped step d = -(matrix + damping D)^-1 gradient.
///
/// Outputs:  d (n); predicted (may be null): the change of cost that the model promises, <= 0. Untouched where it returns false.
/// Returns:  false if there is no step with this damping, or a NaN; the damping was raised, so that the next call may succeed. Also
///           if an argument is null or n out of range.
/// Cost:     n^3 / 6 + 2 n^2 multiply-adds; stack about 600 B.
JCAL_MUST_CHECK bool jcal_gn_step(jcal_gn_t *gn, const jcal_gn_model_t *model, float *d, float *predicted);

/// The change of cost that the undamped model promises for a step d (n): gradient . d + d^T matrix d / 2.
float jcal_gn_predict(const jcal_gn_model_t *model, const float *d);

/// Compares the actual change of cost with the predicted one; true if the step is to be kept.
///
/// Lowers the damping after a good step, raises it after a poor or refused one. NaN is refused. A predicted change of
/// zero (the gradient is zero) is refused without a change of damping: there is nothing left to gain.
bool jcal_gn_judge(jcal_gn_t *gn, float predicted, float actual);

/// Moves k axes on the unit sphere and m plain numbers by d (2 k + m): axes first, each with the tangent basis of
/// jcal_sphere_tangent at its own place.
void jcal_gn_move(jcal_vec3_t *axes, size_t k, float *plain, size_t m, const float *d);

/// Length of a step, rad (or whatever the plain numbers are in).
float jcal_gn_length(const float *d, size_t n);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_SOLVE_H */
