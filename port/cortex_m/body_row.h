/* SPDX-License-Identifier: MIT */
/* A row of numbers of a body's joint, the same from a processor (replay_person.h) and from Python's library (tools/native/batch_body.c). */
#ifndef BODY_ROW_H
#define BODY_ROW_H

#include "jointcal/body.h"

#include <string.h>

enum { BODY_ROW_COLUMNS = 16 };

static inline void body_row(const jcal_body_joint_result_t *r, bool for_axes, float values[BODY_ROW_COLUMNS])
{
    const float all[BODY_ROW_COLUMNS] = {(float)r->head.status,
                                         (float)r->head.reason,
                                         for_axes ? 1.0f : 0.0f,
                                         r->lag_known ? 1.0f : 0.0f,
                                         r->lag_s,
                                         r->lag_bound_s,
                                         r->axis1.x,
                                         r->axis1.y,
                                         r->axis1.z,
                                         r->axis2.x,
                                         r->axis2.y,
                                         r->axis2.z,
                                         r->uncertainty1_rad,
                                         r->uncertainty2_rad,
                                         r->flexion_rad,
                                         r->flexion_bound_rad};
    memcpy(values, all, sizeof(all));
}

#endif
