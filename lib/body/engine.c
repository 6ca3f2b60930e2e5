/* SPDX-License-Identifier: MIT */
/// @file
/// The estimator of a joint, whatever its kind. See body/engine.h.
#include "body/engine.h"

#include "math/scalar.h"

#include <math.h>

void jcal_body_engine_reset(const jcal_body_joint_spec_t *joint)
{
    switch (joint->kind) {
    case JCAL_BODY_HINGE:
        (void)jcal_functional_reset(joint->engine.hinge);
        break;
    case JCAL_BODY_BALL:
        (void)jcal_ball_reset(joint->engine.ball);
        break;
    case JCAL_BODY_TWO_AXES:
    case JCAL_BODY_KIND_COUNT:
    default:
        (void)jcal_two_axes_reset(joint->engine.two_axes);
        break;
    }
}

void jcal_body_engine_add(const jcal_body_joint_spec_t *joint, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    switch (joint->kind) {
    case JCAL_BODY_HINGE:
        (void)jcal_functional_add(joint->engine.hinge, tick1, tick2);
        break;
    case JCAL_BODY_BALL:
        (void)jcal_ball_add(joint->engine.ball, tick1, tick2);
        break;
    case JCAL_BODY_TWO_AXES:
    case JCAL_BODY_KIND_COUNT:
    default:
        (void)jcal_two_axes_add(joint->engine.two_axes, tick1, tick2);
        break;
    }
}

bool jcal_body_engine_step(const jcal_body_joint_spec_t *joint)
{
    switch (joint->kind) {
    case JCAL_BODY_HINGE:
        return jcal_functional_step(joint->engine.hinge) == JCAL_OK;
    case JCAL_BODY_BALL:
        return jcal_ball_step(joint->engine.ball) == JCAL_OK;
    case JCAL_BODY_TWO_AXES:
    case JCAL_BODY_KIND_COUNT:
    default:
        return jcal_two_axes_step(joint->engine.two_axes) == JCAL_OK;
    }
}

static void get_hinge(const jcal_functional_t *engine, jcal_body_joint_result_t *out)
{
    jcal_functional_result_t of;
    (void)jcal_functional_get(engine, &of);
    out->head = of.head;
    out->axis1 = of.axis1;
    out->axis2 = of.axis2;
    out->uncertainty1_rad = of.uncertainty1_rad;
    out->uncertainty2_rad = of.uncertainty2_rad;
    out->joint_to_sensor1_m = of.joint_to_sensor1_m;
    out->joint_to_sensor2_m = of.joint_to_sensor2_m;
    out->heading = of.heading;
    out->flexion_bound_rad = of.flexion_uncertainty_rad;
    out->relative_bound_rad = JCAL_BOUND_UNKNOWN_RAD;
}

static void take_ball(const jcal_ball_result_t *of, jcal_body_joint_result_t *out)
{
    out->head = of->head;
    out->joint_to_sensor1_m = of->joint_to_sensor1_m;
    out->joint_to_sensor2_m = of->joint_to_sensor2_m;
    out->heading = of->heading;
    out->flexion_bound_rad = JCAL_BOUND_UNKNOWN_RAD;
    out->relative_bound_rad = of->uncertainty_heading_rad;
}

static void get_ball(const jcal_ball_t *engine, jcal_body_joint_result_t *out)
{
    const jcal_vec3_t none = {0.0f, 0.0f, 0.0f};
    jcal_ball_result_t of;
    (void)jcal_ball_get(engine, &of);
    take_ball(&of, out);
    out->axis1 = none;
    out->axis2 = none;
    out->uncertainty1_rad = JCAL_BOUND_UNKNOWN_RAD;
    out->uncertainty2_rad = JCAL_BOUND_UNKNOWN_RAD;
}

static void get_two_axes(const jcal_two_axes_t *engine, jcal_body_joint_result_t *out)
{
    jcal_two_axes_result_t of;
    (void)jcal_two_axes_get(engine, &of);
    take_ball(&of.ball, out);
    out->axis1 = of.axis1;
    out->axis2 = of.axis2;
    out->uncertainty1_rad = of.uncertainty1_rad;
    out->uncertainty2_rad = of.uncertainty2_rad;
}

void jcal_body_engine_get(const jcal_body_joint_spec_t *joint, jcal_body_joint_result_t *out)
{
    switch (joint->kind) {
    case JCAL_BODY_HINGE:
        get_hinge(joint->engine.hinge, out);
        break;
    case JCAL_BODY_BALL:
        get_ball(joint->engine.ball, out);
        break;
    case JCAL_BODY_TWO_AXES:
    case JCAL_BODY_KIND_COUNT:
    default:
        get_two_axes(joint->engine.two_axes, out);
        break;
    }
}

jcal_kept_kind_t jcal_body_engine_kind(const jcal_body_joint_spec_t *joint)
{
    switch (joint->kind) {
    case JCAL_BODY_HINGE:
        return JCAL_KEPT_HINGE;
    case JCAL_BODY_BALL:
        return JCAL_KEPT_BALL;
    case JCAL_BODY_TWO_AXES:
    case JCAL_BODY_KIND_COUNT:
    default:
        return JCAL_KEPT_TWO_AXES;
    }
}

static bool keep_hinge(const jcal_functional_t *engine, jcal_kept_t *out)
{
    jcal_functional_result_t of;
    (void)jcal_functional_get(engine, &of);
    if (of.head.status != JCAL_READY) {
        return false;
    }
    out->kind = JCAL_KEPT_HINGE;
    out->model = JCAL_MODEL_FUNCTIONAL;
    out->heading = JCAL_KEPT_HEADING_BY_CENTER;
    out->axis1 = of.axis1;
    out->axis2 = of.axis2;
    out->bound1_rad = of.uncertainty1_rad;
    out->bound2_rad = of.uncertainty2_rad;
    out->flexion_bound_rad = of.flexion_uncertainty_rad;
    out->has_levers = true;
    out->lever1_m = of.joint_to_sensor1_m;
    out->lever2_m = of.joint_to_sensor2_m;
    out->bound_lever1_m = JCAL_BOUND_UNKNOWN_M;
    out->bound_lever2_m = JCAL_BOUND_UNKNOWN_M;
    out->has_usual = jcal_functional_usual(engine, out->usual) == JCAL_OK;
    return true;
}

bool jcal_body_engine_kept(const jcal_body_joint_spec_t *joint, jcal_kept_t *out)
{
    jcal_ball_result_t ball;
    jcal_two_axes_result_t two_axes;
    switch (joint->kind) {
    case JCAL_BODY_HINGE:
        return keep_hinge(joint->engine.hinge, out);
    case JCAL_BODY_BALL:
        (void)jcal_ball_get(joint->engine.ball, &ball);
        return jcal_kept_from_ball(&ball, NULL, out) == JCAL_OK;
    case JCAL_BODY_TWO_AXES:
    case JCAL_BODY_KIND_COUNT:
    default:
        (void)jcal_two_axes_get(joint->engine.two_axes, &two_axes);
        return jcal_kept_from_two_axes(&two_axes, out) == JCAL_OK;
    }
}

bool jcal_body_engine_adopt(const jcal_body_joint_spec_t *joint, const jcal_kept_t *kept,
                            const jcal_remember_result_t *confirmed)
{
    jcal_functional_result_t of;
    if ((joint->kind != JCAL_BODY_HINGE) || !kept->has_usual) {
        return false;
    }
    (void)jcal_functional_get(joint->engine.hinge, &of);
    if (of.head.status == JCAL_READY) {
        return false;
    }
    /* An axis that may be off by twice as much makes twice the error in the angle. */
    const float bound = jcal_max(confirmed->bound1_rad, confirmed->bound2_rad);
    const float kept_bound = jcal_max(kept->bound1_rad, kept->bound2_rad);
    const float growth = (kept_bound > 0.0f) ? jcal_max(bound / kept_bound, 1.0f) : 1.0f;
    const jcal_functional_known_t known = {kept->axis1,
                                           kept->axis2,
                                           kept->lever1_m,
                                           kept->lever2_m,
                                           confirmed->bound1_rad,
                                           confirmed->bound2_rad,
                                           growth * kept->flexion_bound_rad,
                                           {kept->usual[0], kept->usual[1], kept->usual[2]}};
    return jcal_functional_adopt(joint->engine.hinge, &known) == JCAL_OK;
}

bool jcal_body_engine_is_adopted(const jcal_body_joint_spec_t *joint)
{
    return (joint->kind == JCAL_BODY_HINGE) && joint->engine.hinge->adopted;
}

bool jcal_body_engine_sleeps(const jcal_body_joint_spec_t *joint)
{
    return (joint->kind == JCAL_BODY_HINGE) && jcal_functional_sleeps(joint->engine.hinge);
}

float jcal_body_engine_flexion(const jcal_body_joint_spec_t *joint, jcal_quat_t q1, jcal_quat_t q2)
{
    return (joint->kind == JCAL_BODY_HINGE) ? jcal_functional_flexion(joint->engine.hinge, q1, q2) : NAN;
}

jcal_quat_t jcal_body_engine_relative(const jcal_body_joint_spec_t *joint, jcal_quat_t q1, jcal_quat_t q2)
{
    const jcal_quat_t unknown = {NAN, NAN, NAN, NAN};
    switch (joint->kind) {
    case JCAL_BODY_BALL:
        return jcal_ball_relative(joint->engine.ball, q1, q2);
    case JCAL_BODY_TWO_AXES:
        return jcal_ball_relative(&joint->engine.two_axes->ball, q1, q2);
    case JCAL_BODY_HINGE:
    case JCAL_BODY_KIND_COUNT:
    default:
        return unknown;
    }
}
