/* SPDX-License-Identifier: MIT */
/// @file
/// Steps of a search from several starts. See two_dof/step.h.
#include "two_dof/step.h"

#include "two_dof/point.h"

float jcal_two_dof_make_step(jcal_gn_t *gn, const jcal_gn_model_t *model, jcal_two_dof_point_t *point, float *d,
                             float *predicted)
{
    *predicted = 0.0f;
    for (size_t i = 0u; i < model->n; ++i) {
        d[i] = 0.0f;
    }
    if (!jcal_gn_step(gn, model, d, predicted)) {
        return JCAL_TWO_DOF_STEP_MAX_RAD;
    }
    const float length = jcal_gn_length(d, model->n);
    if (length > JCAL_TWO_DOF_STEP_MAX_RAD) {
        for (size_t i = 0u; i < model->n; ++i) {
            d[i] *= JCAL_TWO_DOF_STEP_MAX_RAD / length;
        }
        *predicted = jcal_gn_predict(model, d);
    }
    jcal_two_dof_point_move(point, d);
    return length;
}
