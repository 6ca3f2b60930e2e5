/* SPDX-License-Identifier: MIT */
/// @file
/// State of the window engine of the joint with two axes. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_TWO_DOF_WINDOW_H
#define JCAL_PRIVATE_TWO_DOF_WINDOW_H

#include "jointcal/private/two_dof/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A kept sample.
typedef struct {
    uint64_t t_us;
    jcal_quat_t q1, q2;  ///< Sensor to its earth frame.
    jcal_vec3_t w1, w2;  ///< rad/s, in E1 and in E2.
    float dt_s;          ///< The time it stands for.
} jcal_two_dof_row_t;

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
    uint8_t agreed;     ///< Judgements in a row that found nothing missing.
    bool has_best, has_rival, probing;
    bool exchange;  ///< The next start is the exchanged axes.
} jcal_two_dof_window_search_t;

/// The window engine. Caller-owned; all members are private.
///
/// It may be copied together with its storage; jcal_two_dof_window_attach() then tells the copy where its storage is.
typedef struct {
    jcal_two_dof_window_config_t cfg;
    void *storage;
    jcal_orientation_gate_t gate;
    jcal_two_dof_kept_t kept;
    uint16_t count;  ///< Rows in the storage.
    uint16_t next;   ///< Where the next one goes.
    jcal_two_dof_window_search_t search;
    jcal_two_dof_verdict_t verdict;
} jcal_two_dof_window_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_WINDOW_H */
