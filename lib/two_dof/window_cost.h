/* SPDX-License-Identifier: MIT */
/// @file
/// Residuals of a 2-DoF joint over rows, with Jacobians. Private.
///
/// With a = R1 j1, D = Rz(delta), b = D R2 j2, n = a x b, w = w1 - D w2 and u = n / |n|, in E1:
///
///     rotation-based (7), (17) of [LAI22]:     e = w . u          by n: p = (w - e u) / |n|, as (A13)
///     orientation-based (13), (18) of [LAI22]: e = a . b - sin(beta0)
///
/// (12) of the paper equals the arc sine of a . b, so the chain (A24) to (A40) is not needed.
#ifndef JCAL_TWO_DOF_WINDOW_COST_H
#define JCAL_TWO_DOF_WINDOW_COST_H

#include "jointcal/private/two_dof/row.h"
#include "jointcal/status.h"
#include "jointcal/two_dof_config.h"
#include "math/sym.h"
#include "two_dof/point.h"

/// Steps of j1 (2), j2 (2) and delta, and sin(beta0) for the orientation-based constraint.
#define JCAL_TWO_DOF_WINDOW_UNKNOWNS 6u

/// Rows, in any order.
typedef struct {
    const jcal_two_dof_row_t *rows;
    size_t count;
    const jcal_two_dof_config_t *cfg;
    jcal_reason_t complaint;  ///< Of the gate.
} jcal_two_dof_rows_t;

/// A residual and its derivatives.
typedef struct {
    float e;
    float slope[JCAL_TWO_DOF_WINDOW_UNKNOWNS];
    float product;  ///< a . b.
} jcal_two_dof_residual_t;

/// Sums over rows.
typedef struct {
    float cost;                                    ///< Residuals, squared.
    float gradient[JCAL_TWO_DOF_WINDOW_UNKNOWNS];  ///< J' e.
    float
        matrix[JCAL_SYM_SIZE(JCAL_TWO_DOF_WINDOW_UNKNOWNS)];  ///< J' J, n x n packed, n = jcal_two_dof_window_unknowns.
    float spread[JCAL_SYM_SIZE(
        JCAL_TWO_DOF_WINDOW_UNKNOWNS)];  ///< J' J with the variance that the residuals' neighbours add up to.
    float weighted;                      ///< Residuals, squared, over their variance and correlation time.
    float moving_s;                      ///< Time, rest left out.
    float sine;                          ///< Mean of a . b.
} jcal_two_dof_window_sums_t;

/// 5 or 6.
unsigned jcal_two_dof_window_unknowns(jcal_constraint_t constraint);

/// Residual of one row; slope[5] is that by sin(beta0), zero for the rotation-based one. Cost: about 200 multiply-adds.
void jcal_two_dof_window_residual(const jcal_two_dof_row_t *row, jcal_constraint_t constraint,
                                  const jcal_two_dof_point_t *point, float sine, jcal_two_dof_residual_t *out);

/// All sums at a point.
void jcal_two_dof_window_sum(const jcal_two_dof_rows_t *rows, const jcal_two_dof_point_t *point, float sine,
                             jcal_two_dof_window_sums_t *out);

/// Cost for each heading of a start (JCAL_TWO_DOF_HEADINGS), with the best sin(beta0), and that mean of a . b.
void jcal_two_dof_window_costs(const jcal_two_dof_rows_t *rows, const jcal_two_dof_point_t *point, float *costs,
                               float *sines);

#endif /* JCAL_TWO_DOF_WINDOW_COST_H */
