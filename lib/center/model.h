/* SPDX-License-Identifier: MIT */
/// @file
/// The joint centre's residual, exactly as a row and squared as a polynomial. Private.
///
/// [OLS17] (16): e = |a1 - b1 - K1 r1| - |a2 - b2 - K2 r2|, with K and a from sample/kinematics.h and b the accelerometers' biases.
///
/// Without biases |a - K r|^2 = |a|^2 - 2 a'K r + r'K'K r is linear in (1, r, r r'). So |a1 - K1 r1|^2 - |a2 - K2 r2|^2 = f . phi with
/// 19 features f and phi = (1, r1, r1 r1', r2, r2 r2'), r r' packed as in sym.h, its mixed products counted twice in f. Over
/// |a1| + |a2| it is e as long as |a - K r| differs little from |a|; where the whole recording's minimum of its square lies needs
/// nothing but the 19 x 19 moments of f.
#ifndef JCAL_CENTER_MODEL_H
#define JCAL_CENTER_MODEL_H

#include "jointcal/private/center/point.h"
#include "sample/kinematics.h"

#include <stddef.h>

/// Unknowns of the squared form: r1, r2.
#define JCAL_CENTER_PLACE_UNKNOWNS 6u

/// f (19) of one sample.
void jcal_center_features(const jcal_kinematic_t *sample, float *f);

/// phi (19) at a place.
void jcal_center_monomials(const jcal_center_place_t *place, float *phi);

/// Cost phi' M phi at a place, M the packed moments of f, with half its gradient (6). Cost: about 450 multiply-adds.
float jcal_center_form(const float *moments, const jcal_center_place_t *place, float *gradient);

/// One row of its Gauss-Newton matrix (6 x 6, packed). Cost: at most about 200 multiply-adds.
void jcal_center_form_row(const float *moments, const jcal_center_place_t *place, size_t row, float *matrix);

/// A residual with its derivatives.
typedef struct {
    float e;        ///< m/s^2.
    float e_apart;  ///< The residual if both sensors sat on the joint: |a1 - b1| - |a2 - b2|.
    float turn2;    ///< |K1 r1|^2 + |K2 r2|^2.
    float row[12];  ///< de / d(r1, r2, b1, b2), or de / d(r1, r2, heading, nothing).
    unsigned part;  ///< Which of the sample's residuals it is.
} jcal_center_residual_t;

/// False if there is no direction: a specific force without gravity and motion.
bool jcal_center_residual(const jcal_kinematic_t *sample, const jcal_center_point_t *point,
                          jcal_center_residual_t *out);

/// Residuals of a sample with orientations: e = R1 (a1 - K1 r1) - Rz(heading) R2 (a2 - K2 r2), three parts. (9) to (14) of [OLS17].
#define JCAL_CENTER_PARTS 3u

/// One of them.
void jcal_center_residual_oriented(const jcal_kinematic_t *sample, const jcal_center_point_t *point, unsigned part,
                                   jcal_center_residual_t *out);

/// sum <- sum + |f1| |f2| exp(i h), f the horizontal parts of what both sensors feel at the joint, h the heading by which they agree.
void jcal_center_add_heading(const jcal_kinematic_t *sample, const jcal_center_place_t *place, jcal_plane_t *sum);

#endif /* JCAL_CENTER_MODEL_H */
