/* SPDX-License-Identifier: MIT */
/// @file
/// Which of the places that explain the data is told, and which are none that a body has. Private.
#ifndef JCAL_CENTER_PLACE_H
#define JCAL_CENTER_PLACE_H

#include "jointcal/center_config.h"
#include "jointcal/private/center/point.h"
#include "jointcal/vec3.h"

/// On a hinge's axis: the points on both axes that are next to the sensors, (11), (12) of [SAL15]. Any other centre on the axis explains
/// as much. Without axes: the place itself.
static inline jcal_center_place_t jcal_center_place_told(const jcal_center_config_t *cfg,
                                                         const jcal_center_place_t *place)
{
    const float along1 = jcal_vec3_dot(place->r1, cfg->hinge_axis1);
    const float along2 = jcal_vec3_dot(place->r2, cfg->hinge_axis2);
    const float shift = 0.5f * (along1 + along2);
    const jcal_center_place_t told = {
        jcal_vec3_sub(place->r1, jcal_vec3_scale(cfg->hinge_axis1, shift)),
        jcal_vec3_sub(place->r2, jcal_vec3_scale(cfg->hinge_axis2, shift)),
    };
    return told;
}

/// True for a place that a body may have, on which steps of too little data may not yet have settled; not so for NaN.
static inline bool jcal_center_place_in_reach(const jcal_center_place_t *told)
{
    const float most = JCAL_CENTER_REACH_M * JCAL_CENTER_REACH_M;
    return (jcal_vec3_dot(told->r1, told->r1) <= most) && (jcal_vec3_dot(told->r2, told->r2) <= most);
}

#endif /* JCAL_CENTER_PLACE_H */
