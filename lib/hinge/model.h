/* SPDX-License-Identifier: MIT */
/// @file
/// The hinge constraint as a quadratic form in moments: features, coefficients, derivatives. Private.
///
/// [OLS20] (24), (25) in the squared form of docs/METHOD.md section 2:
///   e_w = |w_1 x j_1|^2 - |w_2 x j_2|^2 = z . f(j_1, j_2),   z: 12 features, f: 12 coefficients,
///   e_a = j_1 . a_1 - j_2 . a_2 - c,                         c: constant for both accelerometer biases.
/// The cost is f' M f + y' A y, M and A being the weighted sums of z z' and of (a_1, -a_2, 1)(a_1, -a_2, 1)' with c
/// eliminated. These sums need no estimate, so any pair of axes can be tried at any time: that is what finds the axes.
/// hinge/refine.h makes them precise.
#ifndef JCAL_HINGE_MODEL_H
#define JCAL_HINGE_MODEL_H

#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/moments.h"
#include "jointcal/private/hinge/point.h"

/// Unknowns of the linearised problem: 2 tangent coordinates per axis, rad.
#define JCAL_HINGE_TILTS 4u

/// Where the products of one sensor's rates start in z.
#define JCAL_HINGE_Z_W1W1 0
#define JCAL_HINGE_Z_W2W2 6

/// Cost, gradient and Gauss-Newton matrix at one point.
typedef struct {
    float cost_gyr;                    ///< f' M f.
    float cost_acc;                    ///< y' A y.
    float gradient[JCAL_HINGE_TILTS];  ///< Half the gradient of the cost.
    float matrix[10];                  ///< Packed 4 x 4, half the Gauss-Newton Hessian.
} jcal_hinge_lin_t;

/// z: 12 features of a pair of rates.
void jcal_hinge_features(jcal_vec3_t w1, jcal_vec3_t w2, float z[JCAL_HINGE_FEATURES]);

/// f: 12 coefficients at a point.
void jcal_hinge_coefficients(const jcal_hinge_point_t *point, float f[JCAL_HINGE_FEATURES]);

/// Cost of the gyroscope part, f' M f.
float jcal_hinge_cost_gyr(const jcal_hinge_moments_t *moments, const jcal_hinge_point_t *point);

/// The same without any axes: what the difference of |w1|^2 and |w2|^2 costs.
float jcal_hinge_cost_gyr_alone(const jcal_hinge_moments_t *moments);

/// Cost of the accelerometer part with the constant c eliminated under its prior.
float jcal_hinge_cost_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point);

/// Both together.
float jcal_hinge_cost(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                      const jcal_hinge_point_t *point);

/// The constant c that minimises the accelerometer part, m/s^2.
float jcal_hinge_acc_constant(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                              const jcal_hinge_point_t *point);

/// Cost at `to` minus cost at `from`, both parts, without cancellation.
float jcal_hinge_change(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                        const jcal_hinge_point_t *from, const jcal_hinge_point_t *to);

/// Linearises the cost at `point`. Cost: about 500 multiply-adds.
void jcal_hinge_linearise(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point, jcal_hinge_lin_t *out);

/// The accelerometer part alone; cost_gyr is 0. Cost: about 250 multiply-adds.
void jcal_hinge_linearise_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                              const jcal_hinge_point_t *point, jcal_hinge_lin_t *out);

#endif /* JCAL_HINGE_MODEL_H */
