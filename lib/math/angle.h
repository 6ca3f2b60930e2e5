/* SPDX-License-Identifier: MIT */
/// @file
/// Angles where one must be reported: own polynomials, so that every machine gives the same bits.
#ifndef JCAL_ANGLE_H
#define JCAL_ANGLE_H

#include "jointcal/config.h"
#include "jointcal/private/plane.h"

#ifdef __cplusplus
extern "C" {
#endif

#define JCAL_PI 3.14159265358979f              ///< rad
#define JCAL_HALF_PI 1.57079632679490f         ///< rad
#define JCAL_RAD_PER_DEG 0.01745329251994330f  ///< rad/deg
#define JCAL_DEG_PER_RAD 57.2957795130823f     ///< deg/rad

/// Largest error of jcal_atan2, rad: polynomial 5e-9 and rounding of the result near pi.
#define JCAL_ATAN2_ERROR_RAD 5e-7f

/// Angle of the point (x, y), rad, in [-pi, pi]; (0, 0) gives 0; NaN gives NaN.
///
/// Both infinite gives NaN; the scale of (x, y) does not matter as long as neither overflows.
/// Cost:     2 divisions, 6 multiply-adds, no loop.
float jcal_atan2(float y, float x);

/// Largest argument that jcal_cis takes, rad.
#define JCAL_CIS_MAX_RAD 1000.0f

/// Largest error of either part of jcal_cis: rounding; the polynomials' own is 2e-9.
#define JCAL_CIS_ERROR 2e-7f

/// exp(i x) = cos x + i sin x for |x| <= JCAL_CIS_MAX_RAD; NaN for everything else.
///
/// Cost:     about 20 multiply-adds, no division, no loop.
jcal_plane_t jcal_cis(float x);

/// mu + 2 sigma of the length of a Gaussian vector in the plane, zero mean: the local uncertainty of Algorithm 4.
///
/// With eigenvalues s1^2 >= s2^2 of the covariance, mu = E|d| = sqrt(2/pi) s1 E(1 - s2^2/s1^2), a quarter of the
/// perimeter of an ellipse with half axes s1 and s2, here by Ramanujan's second formula (relative error below 5e-4),
/// and sigma^2 = s1^2 + s2^2 - mu^2. Equal to the Monte Carlo of the paper to 1 % for sigma up to 5 deg.
///
/// Inputs:   p00, p01, p11  covariance on the tangent plane, rad^2; an indefinite one counts as its non-negative part.
/// Returns:  rad; NaN if an input is NaN.
/// Cost:     5 square roots, 2 divisions.
/// Source:   [OLS20] eq. (59)-(65), p. 16. Differs from the paper in: closed form instead of L random samples.
float jcal_angle_mean_plus_2_sigma(float p00, float p01, float p11);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_ANGLE_H */
