/* SPDX-License-Identifier: MIT */
/// @file
/// Where the search for the axes stands.
#ifndef JCAL_PRIVATE_TWO_DOF_SEARCH_H
#define JCAL_PRIVATE_TWO_DOF_SEARCH_H

#include "jointcal/private/two_dof/moments.h"
#include "jointcal/private/two_dof/point.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An iteration under way.
typedef struct {
    jcal_two_dof_point_t point;
    jcal_two_dof_point_t from;  ///< The point before the last step.
    float from_cost;            ///< Its cost.
    float predicted;            ///< Change of cost that was promised for the step.
    float damping;
    uint8_t steps;
} jcal_two_dof_probe_t;

/// Where the search stands.
typedef struct {
    jcal_two_dof_probe_t best;  ///< The estimate.
    jcal_two_dof_probe_t probe;
    jcal_two_dof_point_t rival;  ///< Best other minimum.
    jcal_two_dof_lin_t lin;      ///< Of the point that is being worked on, rotation-based part first.
    float parts[2];              ///< Of the cost at the estimate: rotation-based, orientation-based ...
    float cost;                  ///< Cost of the estimate, prior included ...
    float rival_cost;            ///< ... and of the rival.
    uint8_t start;               ///< Which start the probe came from.
    uint8_t tried;               ///< Probes that ended since the sums began.
    uint8_t since_exchange;      ///< Starts since the exchanged axes were one.
    uint8_t exchanges;           ///< How often they were, with this estimate.
    bool half;                   ///< The rotation-based half of `lin` is done.
    bool has_best, has_rival, probing;
} jcal_two_dof_search_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_SEARCH_H */
