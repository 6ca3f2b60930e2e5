/* SPDX-License-Identifier: MIT */
/// @file
/// Cost (23) of [OLS20] over selected samples, with what a Gauss-Newton step and Algorithm 4 need.
#ifndef JCAL_HINGE_COST_H
#define JCAL_HINGE_COST_H

#include "jointcal/private/hinge/window_search.h"
#include "jointcal/private/select.h"
#include "math/sym.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Selected samples. The gyroscope rows lie in two pieces, one per end of the ranking.
typedef struct {
    const jcal_row_t *gyr[2];
    size_t n_gyr[2];
    const jcal_row_t *acc;
    size_t n_acc;
    const float *ata;  ///< A^T A of the accelerometer rows, 6 x 6 packed.
    float w0;          ///< (70): the squared weights are w0 for e_w and 1 / w0 for e_a.
} jcal_hinge_rows_t;

/// Sums of one kind of residual, without weights. Shapes: gradient (4), matrix 4 x 4 packed.
typedef struct {
    size_t n;
    float sum;          ///< sum e
    float square;       ///< sum e^2
    float gradient[4];  ///< J^T e
    float matrix[10];   ///< J^T J
} jcal_hinge_kind_t;

/// Both kinds at one place, and together with their weights.
typedef struct {
    jcal_hinge_kind_t gyr;
    jcal_hinge_kind_t acc;
    float cost;         ///< (23): sum w0 e_w^2 + e_a^2 / w0
    float gradient[4];  ///< of cost / 2
    float matrix[10];   ///< Gauss-Newton matrix of cost / 2
} jcal_hinge_sums_t;

/// All sums at `axes`.
///
/// Cost:     65 multiply-adds, 2 square roots and 2 divisions per gyroscope row, 12 multiply-adds per accelerometer
///           row.
void jcal_hinge_cost_sums(const jcal_hinge_rows_t *rows, const jcal_hinge_axes_t *axes, jcal_hinge_sums_t *out);

/// Half the change of (23) from one place to another, summed without cancellation: sum (e' - e) (e' + e) / 2, weighted.
///
/// Cost:     55 multiply-adds, 4 square roots and 2 divisions per gyroscope row, 12 multiply-adds per accelerometer
///           row.
float jcal_hinge_cost_change(const jcal_hinge_rows_t *rows, const jcal_hinge_axes_t *from, const jcal_hinge_axes_t *to);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_COST_H */
