/* SPDX-License-Identifier: MIT */
/* Runs the engine of joints with two axes over arrays. */
#include "joint.h"

#include <stdlib.h>
#include <string.h>

#define QUATERNIONS 8

static void write_row(const jcal_two_dof_result_t *result, float *row)
{
    const float values[JCAL_BATCH_JOINT_COLUMNS] = {(float)result->head.status,
                                                    result->axis1.x,
                                                    result->axis1.y,
                                                    result->axis1.z,
                                                    result->axis2.x,
                                                    result->axis2.y,
                                                    result->axis2.z,
                                                    result->heading_offset_rad,
                                                    result->carrying_angle_rad,
                                                    result->uncertainty1_rad,
                                                    result->uncertainty2_rad,
                                                    result->uncertainty_heading_rad};
    memcpy(row, values, sizeof values);
}

int32_t jcal_batch_two_dof(const uint64_t *t_us, const float *q, size_t count, float *rows)
{
    jcal_two_dof_t *engine = malloc(sizeof *engine);
    if (engine == NULL) {
        return JCAL_BATCH_MEMORY;
    }
    const jcal_two_dof_config_t config = jcal_two_dof_config_default();
    int32_t done = (jcal_two_dof_init(engine, &config) == JCAL_OK) ? JCAL_BATCH_DONE : JCAL_BATCH_CONFIG;
    for (size_t k = 0; k < count && done == JCAL_BATCH_DONE; k++) {
        const float *v = &q[k * QUATERNIONS];
        const jcal_orientation_pair_t pair = {t_us[k], {v[0], v[1], v[2], v[3]}, {v[4], v[5], v[6], v[7]}};
        jcal_two_dof_result_t result;
        (void)jcal_two_dof_update(engine, &pair);
        (void)jcal_two_dof_get(engine, &result);
        write_row(&result, &rows[k * JCAL_BATCH_JOINT_COLUMNS]);
    }
    free(engine);
    return done;
}
