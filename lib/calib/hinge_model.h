/* SPDX-License-Identifier: MIT */
/// @file
/// The hinge constraint as a quadratic form in moments: features, coefficients, derivatives. Private.
///
/// [OLS20] (24), (25) in the squared form of docs/METHOD.md section 2. With u_i = w_i - b_i (b_i: gyroscope bias
/// across j_i),
///   e_w = |u_1 x j_1|^2 - |u_2 x j_2|^2 = z . f(j_1, b_1, j_2, b_2),   z: 19 features, f: 19 coefficients,
///   e_a = j_1 . a_1 - j_2 . a_2 - c,                                   c: constant for both accelerometer biases.
/// The cost is f' M f + y' A y, M and A being the weighted sums of z z' and of (a_1, -a_2, 1)(a_1, -a_2, 1)' with c
/// eliminated.
#ifndef JCAL_HINGE_MODEL_H
#define JCAL_HINGE_MODEL_H

#include "jointcal/hinge.h"

/// Unknowns of the linearised problem: 2 tangent coordinates per axis, rad, then 2 bias coordinates per sensor, in
/// units of the bias's standard deviation.
#define JCAL_HINGE_AXIS_UNKNOWNS 4
#define JCAL_HINGE_UNKNOWNS 8

/// Where the features of one kind start in z: 6 products of w1, w1, 6 products of w2, w2, 1. What belongs to one
/// sensor stands together, so that a derivative with respect to its axis is one run of 9.
#define JCAL_HINGE_Z_W1W1 0
#define JCAL_HINGE_Z_W1 6
#define JCAL_HINGE_Z_W2W2 9
#define JCAL_HINGE_Z_W2 15
#define JCAL_HINGE_Z_ONE 18

/// Cost, gradient and Gauss-Newton matrix at one point.
typedef struct {
    float cost_gyr;                       ///< f' M f.
    float cost_acc;                       ///< y' A y.
    float gradient[JCAL_HINGE_UNKNOWNS];  ///< Half the gradient of the cost.
    float matrix[36];                     ///< Packed 8 x 8, half the Gauss-Newton Hessian.
    float matrix_acc[10];                 ///< The accelerometer's share of its first 4 x 4.
} jcal_hinge_lin_t;

/// z: 19 features of a pair of rates.
void jcal_hinge_features(jcal_vec3_t w1, jcal_vec3_t w2, float z[JCAL_HINGE_FEATURES]);

/// f: 19 coefficients at a point.
void jcal_hinge_coefficients(const jcal_hinge_point_t *point, float f[JCAL_HINGE_FEATURES]);

/// Cost of the gyroscope part, f' M f.
float jcal_hinge_cost_gyr(const jcal_hinge_moments_t *moments, const jcal_hinge_point_t *point);

/// Cost of the accelerometer part with the constant c eliminated under its prior.
float jcal_hinge_cost_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point);

/// The constant c that minimises the accelerometer part, m/s^2.
float jcal_hinge_acc_constant(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                              const jcal_hinge_point_t *point);

/// Cost at `to` minus cost at `from`, both parts and the prior of the biases, without cancellation.
float jcal_hinge_change(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                        const jcal_hinge_point_t *from, const jcal_hinge_point_t *to);

/// Linearises the cost at `point` in the first n unknowns, 4 (axes) or 8 (with biases).
///
/// Outputs:  gradient (n), matrix (n x n) and the costs; the rest of `out` is left as it was.
/// Cost:     about 750 (n = 4) or 1600 (n = 8) multiply-adds.
void jcal_hinge_linearise(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point, unsigned n, jcal_hinge_lin_t *out);

#endif /* JCAL_HINGE_MODEL_H */
