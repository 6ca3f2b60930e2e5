/* SPDX-License-Identifier: MIT */
/// @file
/// Where the search of the window engine stands.
#ifndef JCAL_PRIVATE_TWO_DOF_WINDOW_SEARCH_H
#define JCAL_PRIVATE_TWO_DOF_WINDOW_SEARCH_H

#include "jointcal/private/two_dof/point.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A place in the parameter space that is followed.
typedef struct {
    jcal_two_dof_point_t point;
    jcal_two_dof_point_t from;  ///< The point before the last step.
    float sine;                 ///< sin(beta0), the sixth parameter.
    float from_sine;
    float from_cost;  ///< Mean squared residual there.
    float predicted;  ///< Change of cost that was promised for the step.
    float damping;
    float cost;  ///< Residuals, squared, over their variance, before the last step.
    uint8_t steps;
} jcal_two_dof_trace_t;

/// Where the search stands.
typedef struct {
    jcal_two_dof_trace_t best, rival, probe;
    uint8_t turn;
    uint8_t start;      ///< Next start.
    uint8_t tried;      ///< Probes that ended.
    uint8_t exchanges;  ///< How often the exchanged axes of this estimate were a start.
    bool has_best, has_rival, probing;
    bool exchange;  ///< The next start is the exchanged axes.
} jcal_two_dof_window_search_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_WINDOW_SEARCH_H */
