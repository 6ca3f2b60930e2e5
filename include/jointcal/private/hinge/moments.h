/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of the coarse search for the axes; lib/hinge/model.h has the equations.
#ifndef JCAL_PRIVATE_HINGE_MOMENTS_H
#define JCAL_PRIVATE_HINGE_MOMENTS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Number of features of the gyroscope residual; lib/hinge/model.h says which.
#define JCAL_HINGE_FEATURES 12

/// Weighted sums over all samples, packed symmetric.
typedef struct {
    float gyr[78];  ///< 12 x 12: products of the gyroscope features.
    float acc[28];  ///< 7 x 7: products of (a1, -a2, 1).
} jcal_hinge_moments_t;

/// How much has gone into the sums.
typedef struct {
    float
        weight_acc2;  ///< Sum of the squared accelerometer weights per second; their own sum is the last one of `acc`.
    float motion;     ///< Integral of the squared rates: what the sums are limited by.
    float bend;  ///< Integral of the difference of |w1| and |w2| beyond what errors make, fading in a second, rad ...
    float
        excitation;  ///< ... and that of its square while that shows that the joint has turned, and does not merely tremble.
} jcal_hinge_amount_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_MOMENTS_H */
