/* SPDX-License-Identifier: MIT */
/// @file
/// The two constraints of a 2-DoF joint as quadratic forms in moments. Private.
///
/// With R_i from sensor frame i to its earth frame E_i, w_i the rate in E_i, D = Rz(delta) = c D_0 + s D_1 + D_2 and
/// n = R1 j1 x D R2 j2:
///
///     rotation-based (7) of [LAI22]:      e = (w1 - D w2) . n / |n|
///     orientation-based (13) of [LAI22]:  g = R1 j1 . D R2 j2 = sin(beta) = const.
///
/// e |n| and g are multilinear in j1, j2 and u = (c, s, 1): sums over i, k, m of F[i][k][m] and G[i][k][m] times
/// phi[i][k][m] = j1_i j2_k u_m, with
///
///     F[i][k][m] = w1 . (R1 e_i x D_m R2 e_k) - w2 . (D_m' R1 e_i x R2 e_k)
///     G[i][k][m] = R1 e_i . D_m R2 e_k.
///
/// So sums of F F' and of G G', G hold all samples, and because |n|^2 = 1 - g^2 the normalisation follows from the latter:
///
///     cost = phi' M_F phi / (1 - phi' M_G phi / N) + phi' M_G phi - (m . phi)^2 / N,
///
/// in which the sums are already divided by the variance of what disturbs them, and N is that of the orientation-based weights.
/// The mean of |n|^2 stands in for that of each sample: it is constant where the constraint holds.
#ifndef JCAL_TWO_DOF_MODEL_H
#define JCAL_TWO_DOF_MODEL_H

#include "jointcal/private/two_dof/moments.h"
#include "jointcal/two_dof_config.h"
#include "two_dof/point.h"

/// One sample: orientations, and rates in the earth frames.
typedef struct {
    jcal_quat_t q1, q2;
    jcal_vec3_t w1, w2;  ///< rad/s, in E1 and in E2.
} jcal_two_dof_sample_t;

/// Features F (27) and G (27), index (3 i + k) 3 + m. Cost: about 200 multiply-adds each.
void jcal_two_dof_rotation_features(const jcal_two_dof_sample_t *sample, float *f);
void jcal_two_dof_orientation_features(jcal_quat_t q1, jcal_quat_t q2, float *g);

/// features . phi. Cost: 36 multiply-adds.
float jcal_two_dof_value(const float *features, const jcal_two_dof_point_t *point);

/// m (27 x 27, packed) <- m + weight v v'. Cost: 378 multiply-adds.
void jcal_two_dof_add(float *m, const float *v, float weight);

/// lin <- phi' M phi with half its gradient and J' M J, M one of the two matrices of moments. Cost: about 1,600 multiply-adds.
void jcal_two_dof_form(const float *m, const jcal_two_dof_point_t *point, jcal_two_dof_lin_t *lin);

/// lin, which holds the form of the rotation-based moments, becomes the cost as above.
///
/// Outputs:  parts (2, may be null): the rotation-based and the orientation-based part of the cost.
void jcal_two_dof_combine(const jcal_two_dof_moments_t *moments, jcal_constraint_t constraint,
                          const jcal_two_dof_point_t *point, jcal_two_dof_lin_t *lin, float *parts);

/// A heading offset and the cost there.
typedef struct {
    jcal_plane_t heading;
    float cost;
} jcal_two_dof_guess_t;

/// The cost of jcal_two_dof_combine at the axes of `point` for `count` heading offsets at once.
///
/// Cost: about 900 multiply-adds and 60 for each heading.
void jcal_two_dof_costs(const jcal_two_dof_moments_t *moments, jcal_constraint_t constraint,
                        const jcal_two_dof_point_t *point, jcal_two_dof_guess_t *guesses, unsigned count);

/// Refers all sums to a heading offset that is larger by `turn`: samples taken at delta look as if taken at delta + turn.
///
/// phi depends on the heading by u = (c, s, 1) only, so that this is a turn of the features with m = 0 and m = 1.
/// Cost: about 2,000 multiply-adds.
void jcal_two_dof_turn(jcal_two_dof_moments_t *moments, jcal_plane_t turn);

/// All sums become `share` of themselves.
void jcal_two_dof_fade(jcal_two_dof_moments_t *moments, float share);

/// Mean of g: sin(beta0).
float jcal_two_dof_mean(const jcal_two_dof_moments_t *moments, const jcal_two_dof_point_t *point);

#endif /* JCAL_TWO_DOF_MODEL_H */
