/* SPDX-License-Identifier: MIT */
/// @file
/// The estimator of a joint, whatever its kind. See body/engine.h.
#include "body/engine.h"

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
