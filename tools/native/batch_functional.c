/* SPDX-License-Identifier: MIT */
/* Runs the functional joint over arrays. */
#include "batch_functional.h"

#include <math.h>
#include <string.h>

void jcal_batch_functional_defaults(jcal_batch_functional_options_t *options)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    *options = (jcal_batch_functional_options_t){
        .max_bound_rad = config.max_bound_rad,
        .max_flexion_rad = config.max_flexion_rad,
        .slices_per_s = config.slices_per_s,
        .sign_hint = (int32_t)config.sign_hint,
    };
}

/* What is said, by both models or by the functional one alone, in the form of the former. */
static jcal_hinge_auto_result_t said(const jcal_hinge_auto_t *engine, bool either)
{
    jcal_hinge_auto_result_t out;
    (void)jcal_hinge_auto_get(engine, &out);
    if (!either) {
        jcal_functional_result_t r;
        (void)jcal_functional_pair_get(&engine->functional, &r);
        out.hinge.head = r.head;
        out.hinge.axis1 = r.axis1;
        out.hinge.axis2 = r.axis2;
        out.hinge.uncertainty1_rad = r.uncertainty1_rad;
        out.hinge.uncertainty2_rad = r.uncertainty2_rad;
        out.flexion_uncertainty_rad = r.flexion_uncertainty_rad;
        out.model = JCAL_MODEL_FUNCTIONAL;
        out.ready_for = r.for_axes ? JCAL_FOR_AXES : (r.for_flexion ? JCAL_FOR_FLEXION : JCAL_FOR_NOTHING);
    }
    return out;
}

static void write_row(const jcal_hinge_auto_t *engine, bool either, size_t sample,
                      float row[static JCAL_BATCH_FUNCTIONAL_COLUMNS])
{
    const jcal_hinge_auto_result_t all = said(engine, either);
    const jcal_hinge_result_t *const r = &all.hinge;
    const jcal_functional_t *const joint = &engine->functional.joint;
    const jcal_functional_verdict_t *const v = &joint->verdict;
    const float motion_s = (joint->sums.motion_s > 0.0f) ? joint->sums.motion_s : 1.0f;
    const float values[JCAL_BATCH_FUNCTIONAL_COLUMNS] = {
        (float)r->head.status,
        (float)r->head.reason,
        (float)r->head.weak,
        (float)r->head.hint,
        r->axis1.x,
        r->axis1.y,
        r->axis1.z,
        r->axis2.x,
        r->axis2.y,
        r->axis2.z,
        r->uncertainty1_rad,
        r->uncertainty2_rad,
        all.flexion_uncertainty_rad,
        (all.ready_for == JCAL_FOR_AXES) ? 1.0f : 0.0f,
        (all.ready_for != JCAL_FOR_NOTHING && all.flexion_uncertainty_rad <= joint->cfg.max_flexion_rad) ? 1.0f : 0.0f,
        (all.model == JCAL_MODEL_FUNCTIONAL) ? 1.0f : 0.0f,
        all.heading.heading_rad,
        all.joint_to_sensor1_m.x,
        all.joint_to_sensor1_m.y,
        all.joint_to_sensor1_m.z,
        all.joint_to_sensor2_m.x,
        all.joint_to_sensor2_m.y,
        all.joint_to_sensor2_m.z,
        v->evidence[0],
        v->evidence[1],
        v->evidence[2],
        v->opposite,
        v->share,
        v->bend_rad,
        v->stiffness,
        joint->point.lack / motion_s,
        joint->point.speed2,
        joint->sums.motion_s,
        joint->point.size[0],
        joint->point.size[1],
        joint->point.size[2],
        joint->ticks.gravity_off,
        joint->motion_s,
        joint->point.energy,
        (float)sample,
    };
    memcpy(row, values, sizeof(values));
}

static void write_turns(const jcal_hinge_auto_t *engine, float turns[static 8])
{
    for (unsigned which = 1u; which <= 2u; ++which) {
        const jcal_quat_t q = jcal_hinge_auto_orientation(engine, which);
        const float values[4] = {q.w, q.x, q.y, q.z};
        memcpy(turns + 4u * (which - 1u), values, sizeof(values));
    }
}

int32_t jcal_batch_functional(const jcal_batch_functional_options_t *options, const jcal_batch_input_t *in,
                              jcal_batch_functional_out_t *out)
{
    jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    config.hinge.max_bound_rad = options->max_bound_rad;
    config.max_flexion_rad = options->max_flexion_rad;
    config.hinge.sign_hint = (jcal_sign_hint_t)options->sign_hint;
    jcal_hinge_auto_t engine;
    if (jcal_hinge_auto_init(&engine, &config) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    engine.functional.joint.cfg.slices_per_s = options->slices_per_s;
    const jcal_hinge_auto_t fresh = engine;
    out->row_count = 0;
    uint32_t ticks = 0;
    for (size_t k = 0; k < in->count; k++) {
        const jcal_pair_t pair = jcal_batch_pair(in, k);
        if ((options->hold > 0) && (k >= (size_t)options->hold)) { /* no slice of solving is paid for any more */
            engine.functional.joint.cfg.slices_per_s = 0.0f;
            engine.functional.joint.credit = 0.0f;
        }
        if (options->either != 0) {
            (void)jcal_hinge_auto_update(&engine, &pair);
        } else {
            (void)jcal_functional_pair_update(&engine.functional, &pair);
        }
        write_turns(&engine, out->turns + k * 8);
        if (k < (size_t)options->begin) {
            engine.rigid = fresh.rigid;
            engine.functional.joint = fresh.functional.joint;
            out->flexion[k] = NAN;
            continue;
        }
        out->flexion[k] = (options->either != 0) ? jcal_hinge_auto_flexion(&engine)
                                                 : jcal_functional_pair_flexion(&engine.functional);
        if (engine.functional.joint.ticks.count != ticks) {
            ticks = engine.functional.joint.ticks.count;
            write_row(&engine, options->either != 0, k, out->rows + out->row_count * JCAL_BATCH_FUNCTIONAL_COLUMNS);
            out->row_count++;
        }
    }
    return JCAL_BATCH_DONE;
}
