/* SPDX-License-Identifier: MIT */
/// @file
/// The last judgement and the work on the next one.
#ifndef JCAL_PRIVATE_CENTER_JUDGE_H
#define JCAL_PRIVATE_CENTER_JUDGE_H

#include "jointcal/private/center/gravity.h"
#include "jointcal/private/center/sums.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The last judgement.
typedef struct {
    float bound1_m, bound2_m;            ///< As in the result.
    float weakest1_m, weakest2_m;        ///< As in the result.
    jcal_vec3_t direction1, direction2;  ///< As in the result.
    float misfit;                        ///< As in the result.
    uint8_t status, weak, hint, reason;  ///< As in the result.
    uint8_t agreed;                      ///< Judgements in a row that found nothing missing.
} jcal_center_verdict_t;

/// Bounds of one sensor's vector, m.
typedef struct {
    float all, weakest, second;
    jcal_vec3_t direction;
} jcal_center_bounds_t;

/// Work on the covariance of one state of the sums, a slice at a time.
typedef struct {
    float factor[78];  ///< Of the sums' matrix, prior included, scaled.
    float scale[12];   ///< Its scale.
    bool is_factored;  ///< There is a factor.
    float step[12];    ///< The Gauss-Newton step from it.
    union {
        struct {
            float matrix[78], scale[12];
        } next;                ///< What the next factor is made of ...
        float columns[6][12];  ///< ... and then those columns of the inverse that belong to r1 and r2.
    } of;
    float covariance[2][6];  ///< Of r1 and of r2, packed, from the scatter ...
    float least[2][6];       ///< ... and what it is at least, from the matrix.
    float fake[6];           ///< Direction of whose information the largest share may be none, scaled ...
    float fake_share;        ///< ... that share ...
    float lasting_m;  ///< ... how far that part of what is unexplained that lasts may have shifted the estimate ...
    float hidden_m;   ///< ... and all of it.
    jcal_center_bounds_t bounds[2];
} jcal_center_inverse_t;

/// What both engines work with.
typedef struct {
    jcal_center_sums_t sums;
    jcal_center_gravity_t gravity;
    jcal_center_verdict_t verdict;
    union {
        float moments[190];             ///< Packed 19 x 19: products of the features, before the sums begin ...
        jcal_center_inverse_t inverse;  ///< ... and after.
    } as;
} jcal_center_work_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CENTER_JUDGE_H */
