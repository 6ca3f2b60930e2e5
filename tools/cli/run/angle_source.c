/* SPDX-License-Identifier: MIT */
/* Angles row by row. */
#include "run/angle_source.h"

#include "output/report.h"

#include <math.h>
#include <string.h>

/* Memory of the heading unless --window says otherwise, s. */
#define MEMORY_S 10.0f

/* The bound of a person's angle: at rest, rad; for each rad that the angle spreads and each rad/s of both sensors together, over MOTION_S;
 * for each m/s^2 that gravity is felt wrongly. USUAL_FLEXION_RAD is what calibrations made wrong on which these were found. */
#define MOTION_S 3.0f
#define TURN_RAD 6.2831853f
#define STILL_RAD 0.0087f
#define PER_SPREAD 0.04f
#define PER_RATE_S 0.0122f
#define PER_GRAVITY 0.03f
#define USUAL_FLEXION_RAD 0.0105f

/* The least limit of the axes and the heading of a person's joint with two axes, rad. */
#define PEOPLE_LEAST_RAD 0.01f

/* The sign that an axis had before, or the one that the command line asks for. */
static jcal_vec3_t settle_sign(jcal_vec3_t axis, bool has_before, jcal_vec3_t before, bool has_toward,
                               jcal_vec3_t toward)
{
    if (has_toward) {
        return jcal_axis_toward(axis, toward);
    }
    return has_before ? jcal_axis_toward(axis, before) : axis;
}

/* Takes over axes; what the engine calls their signs may change from row to row, what is written here may not. */
static void set_axes(angle_source_t *source, jcal_vec3_t axis1, jcal_vec3_t axis2, float carrying_rad)
{
    const angle_source_config_t *config = &source->config;
    angle_joint_t *joint = &source->joint;
    const bool has_before = joint->axis1.x != 0.0f || joint->axis1.y != 0.0f || joint->axis1.z != 0.0f;
    const jcal_vec3_t signed1 = settle_sign(axis1, has_before, joint->axis1, config->has_toward1, config->toward1);
    jcal_vec3_t signed2 = settle_sign(axis2, has_before, joint->axis2, config->has_toward2, config->toward2);
    const bool turned1 = jcal_vec3_dot(signed1, axis1) < 0.0f;
    if (config->hinge) {
        signed2 = turned1 ? jcal_vec3_scale(axis2, -1.0f) : axis2;
    }
    const bool turned2 = jcal_vec3_dot(signed2, axis2) < 0.0f;
    joint->axis1 = signed1;
    joint->axis2 = signed2;
    joint->carrying_rad = (turned1 != turned2) ? -carrying_rad : carrying_rad;
    joint->known = true;
}

/* Time since the row before, s; 0 where there is none or time went back. */
static float step_s(angle_motion_t *motion, uint64_t t_us)
{
    const bool forward = motion->has_last && t_us > motion->last_us;
    const float dt_s = forward ? 1e-6f * (float)(t_us - motion->last_us) : 0.0f;
    motion->has_last = true;
    motion->last_us = t_us;
    return fminf(dt_s, 1.0f);
}

/* Takes in the motion of a row: rates of both sensors and the angle, over the last seconds. */
static void follow_motion(angle_motion_t *motion, const recording_row_t *row, float dt_s)
{
    const float share = dt_s / (dt_s + MOTION_S);
    const jcal_vec3_t w1 = row->imu1.gyr_rad_s;
    const jcal_vec3_t w2 = row->imu2.gyr_rad_s;
    const float rate2 = jcal_vec3_dot(w1, w1) + jcal_vec3_dot(w2, w2);
    if (isfinite(rate2) && share > 0.0f) {
        motion->rate2 += share * (rate2 - motion->rate2);
    }
}

/* Takes in an angle that was written. */
static void follow_angle(angle_motion_t *motion, float angle_rad, float dt_s)
{
    const float off = remainderf(angle_rad - motion->mean_rad, TURN_RAD); /* angles of one turn are one */
    const float share = motion->has_angle ? dt_s / (dt_s + MOTION_S) : 1.0f;
    motion->mean_rad += share * off;
    motion->spread2 += share * ((off * off * (motion->has_angle ? 1.0f : 0.0f)) - motion->spread2);
    motion->has_angle = true;
}

/* How far an angle may be off, its zero apart. Of rigid segments: as far as the axes. Of people: skin and inclination make an error that
 * grows with the motion of the moment, docs/METHOD_PEOPLE.md section 7; more where the calibration is poor or gravity is felt wrongly. */
static float angle_bound(const jcal_hinge_auto_result_t *result, const angle_motion_t *motion)
{
    if (result->model == JCAL_MODEL_RIGID && result->ready_for == JCAL_FOR_AXES) {
        return fmaxf(result->hinge.uncertainty1_rad, result->hinge.uncertainty2_rad);
    }
    const float poor = fmaxf(1.0f, result->flexion_uncertainty_rad / USUAL_FLEXION_RAD);
    const float moving = (PER_SPREAD * sqrtf(motion->spread2)) + (PER_RATE_S * sqrtf(motion->rate2));
    return STILL_RAD + (poor * moving) + (PER_GRAVITY * result->gravity_off_m_s2);
}

static bool is_accepted(const angle_source_t *source, bool has_axes)
{
    return source->head.status == JCAL_READY || (source->config.accept_best && has_axes);
}

/* Both models of a joint with two axes; of a person's, orientations and heading are the engine's own. */
static bool update_two_dof(angle_source_t *source, const recording_row_t *row, jcal_orientation_pair_t *orientations)
{
    const jcal_pair_t readings = {orientations->t_us, row->imu1, row->imu2};
    jcal_two_dof_auto_result_t all;
    if (jcal_two_dof_auto_update(&source->two_dof, &readings, orientations) < 0 ||
        jcal_two_dof_auto_get(&source->two_dof, &all) != JCAL_OK) {
        return false;
    }
    const jcal_two_dof_result_t *result = &all.two_dof;
    const bool both = report_is_axis(result->axis1) && report_is_axis(result->axis2);
    source->head = result->head;
    if (!is_accepted(source, result->has_axes && both)) {
        return true;
    }
    set_axes(source, result->axis1, result->axis2, result->carrying_angle_rad);
    source->joint.bound_rad =
        fmaxf(fmaxf(result->uncertainty1_rad, result->uncertainty2_rad), result->uncertainty_heading_rad);
    source->joint.heading_rad = result->heading_offset_rad;
    if (all.model == JCAL_MODEL_FUNCTIONAL && isfinite(orientations->q1.w)) {
        orientations->q1 = jcal_two_dof_auto_orientation(&source->two_dof, 1);
        orientations->q2 = jcal_two_dof_auto_orientation(&source->two_dof, 2);
    }
    return true;
}

/* A ball joint: its heading, and orientations of its own. */
static bool update_ball(angle_source_t *source, const recording_row_t *row, jcal_orientation_pair_t *orientations)
{
    jcal_pair_t pair = {orientations->t_us, row->imu1, row->imu2};
    if (!row->has_time) {
        pair.imu1.gyr_rad_s.x = NAN;
    }
    jcal_ball_result_t result;
    if (jcal_ball_pair_update(&source->ball, &pair) < 0 || jcal_ball_pair_get(&source->ball, &result) != JCAL_OK) {
        return false;
    }
    source->head = result.head;
    if (source->has_pose && result.head.status == JCAL_MOVED) { /* it was one of other sensor frames */
        source->has_pose = false;
        source->config.pose_us = INT64_MAX;
    }
    source->joint.known = is_accepted(source, result.has_estimate) && result.heading.known;
    source->joint.heading_rad = result.heading.heading_rad;
    source->joint.bound_rad = result.uncertainty_heading_rad;
    if (isfinite(orientations->q1.w)) {
        orientations->q1 = jcal_sensor_orientation(&source->ball.sensors.sensor1);
        orientations->q2 = jcal_sensor_orientation(&source->ball.sensors.sensor2);
    }
    return true;
}

/* The calibration of this recording, up to this row. */
static bool update_engine(angle_source_t *source, const recording_row_t *row, jcal_orientation_pair_t *orientations)
{
    source->joint.known = source->given;
    if (source->config.ball) {
        return update_ball(source, row, orientations);
    }
    if (source->config.hinge) {
        jcal_pair_t pair = {orientations->t_us, row->imu1, row->imu2};
        if (!row->has_time) {
            pair.imu1.gyr_rad_s.x = NAN;
        }
        jcal_hinge_auto_result_t result;
        if (jcal_hinge_auto_update(&source->hinge, &pair) < 0 ||
            jcal_hinge_auto_get(&source->hinge, &result) != JCAL_OK) {
            return false;
        }
        const jcal_hinge_result_t *hinge = &result.hinge;
        source->head = hinge->head;
        source->own_heading = result.heading;
        if (!source->given && is_accepted(source, hinge->has_axes)) {
            set_axes(source, hinge->axis1, hinge->axis2, 0.0f);
            source->sign = (jcal_vec3_dot(source->joint.axis1, hinge->axis1) < 0.0f) ? -1.0f : 1.0f;
            source->joint.bound_rad = angle_bound(&result, &source->motion);
        }
        return true;
    }
    return update_two_dof(source, row, orientations);
}

/* The heading offset of this row: of the engine, or followed with the axes that are known. */
static bool update_heading(angle_source_t *source, const jcal_orientation_pair_t *orientations, jcal_heading_t *heading)
{
    const angle_joint_t *joint = &source->joint;
    const bool hinge = source->config.hinge;
    const float memory_s = (source->config.window_s > 0.0f) ? source->config.window_s : MEMORY_S;
    *heading = (jcal_heading_t){joint->heading_rad, joint->known};
    if (source->config.own_orientations && !source->given && !source->config.ball) {
        *heading = (jcal_heading_t){source->own_heading.heading_rad, joint->known && source->own_heading.known};
        return true;
    }
    if (!joint->known || (!hinge && !source->given)) {
        return true;
    }
    jcal_joint_heading_t *follower = &source->follower;
    jcal_status_t status = JCAL_OK;
    if (source->has_follower) {
        status = jcal_joint_heading_improve(follower, joint->axis1, joint->axis2, joint->carrying_rad);
    } else if (hinge) {
        status = jcal_joint_heading_hinge(follower, joint->axis1, joint->axis2, memory_s);
    } else {
        status = jcal_joint_heading_two_dof(follower, joint->axis1, joint->axis2, joint->carrying_rad, memory_s);
    }
    source->has_follower = true;
    return status == JCAL_OK && jcal_joint_heading_push(follower, orientations) >= 0 &&
           jcal_joint_heading_get(follower, heading) == JCAL_OK;
}

/* Angles of a ball joint; its segment frames are those of the pose. */
static void compute_ball(const angle_source_t *source, const jcal_orientation_pair_t *orientations, float heading_rad,
                         jcal_joint_angles_t *angles)
{
    const jcal_quat_t q = jcal_joint_orientation(&source->frames, orientations->q1, orientations->q2, heading_rad);
    if (source->config.shoulder) {
        const jcal_shoulder_angles_t found = jcal_shoulder_angles(q);
        *angles = (jcal_joint_angles_t){found.elevation_rad, found.rotation_rad, found.plane_rad};
    } else {
        *angles = jcal_hip_angles(q);
    }
}

/* The pose that angles of a ball joint count from, once it has come. */
static void take_pose(angle_source_t *source, const jcal_orientation_pair_t *orientations, float heading_rad,
                      int64_t t_us)
{
    const angle_source_config_t *config = &source->config;
    if (source->has_pose || (config->has_pose_time && t_us < config->pose_us)) {
        return;
    }
    source->has_pose =
        jcal_frames_pose(orientations->q1, orientations->q2, heading_rad, config->toward1, &source->frames) ==
        JCAL_OK; /* with the person's right upright there is none yet */
}

/* Angles with the axes and the heading of this row. */
static bool compute(const angle_source_t *source, const jcal_orientation_pair_t *orientations, float heading_rad,
                    jcal_joint_angles_t *angles)
{
    const angle_joint_t *joint = &source->joint;
    if (source->config.ball) {
        compute_ball(source, orientations, heading_rad, angles);
        return true;
    }
    if (source->config.own_orientations &&
        !source->given) { /* the engine keeps the zero where it is while the axes improve */
        *angles = (jcal_joint_angles_t){.flexion_rad = source->sign * jcal_hinge_auto_flexion(&source->hinge)};
        return true;
    }
    jcal_joint_frames_t frames;
    const bool hinge = source->config.hinge;
    const jcal_status_t status = hinge ? jcal_frames_hinge(joint->axis1, joint->axis2, &frames)
                                       : jcal_frames_two_dof(joint->axis1, joint->axis2, &frames);
    if (status != JCAL_OK) {
        return false;
    }
    const jcal_quat_t q = jcal_joint_orientation(&frames, orientations->q1, orientations->q2, heading_rad);
    *angles = hinge ? jcal_hinge_angles(q) : jcal_two_dof_angles(q);
    return true;
}

/* True where there are orientations: of a repeated reading or after a gap, too. */
static bool is_usable(jcal_reject_t reject)
{
    return reject == JCAL_REJECT_NONE || reject == JCAL_REJECT_GAP || reject == JCAL_REJECT_REPEATED;
}

bool angle_source_start(angle_source_t *source, const angle_source_config_t *config, const calibration_t *calibration)
{
    memset(source, 0, sizeof *source);
    source->config = *config;
    source->given = calibration != NULL;
    source->gate_config = jcal_gate_config_default();
    jcal_hinge_auto_config_t hinge = jcal_hinge_auto_config_default();
    jcal_two_dof_auto_config_t two_dof = jcal_two_dof_auto_config_default();
    hinge.hinge.sign_hint = config->sign_hint;
    if (config->max_bound_rad > 0.0f) {
        hinge.hinge.max_bound_rad = config->max_bound_rad;
        two_dof.two_dof.max_bound_rad = config->max_bound_rad;
        two_dof.people.max_bound_rad = fmaxf(config->max_bound_rad, PEOPLE_LEAST_RAD);
        two_dof.people.ball.max_heading_rad = two_dof.people.max_bound_rad;
    }
    if (config->window_s > 0.0f) {
        two_dof.two_dof.memory_s = config->window_s;
    }
    if (calibration != NULL) {
        set_axes(source, calibration->axis1, calibration->axis2, calibration->carrying_angle_rad);
    }
    jcal_ball_config_t ball = jcal_ball_config_default();
    if (config->max_bound_rad > 0.0f) {
        ball.max_heading_rad = fmaxf(config->max_bound_rad, PEOPLE_LEAST_RAD);
    }
    return jcal_hinge_auto_init(&source->hinge, &hinge) == JCAL_OK &&
           jcal_ball_pair_init(&source->ball, &ball, NULL) == JCAL_OK &&
           jcal_two_dof_auto_init(&source->two_dof, &two_dof) == JCAL_OK;
}

/* Angles of a row whose orientations are of use. */
static bool angles_of(angle_source_t *source, jcal_orientation_pair_t *orientations, angles_row_t *out)
{
    jcal_heading_t heading;
    orientations->q1 = jcal_quat_normalise(orientations->q1);
    orientations->q2 = jcal_quat_normalise(orientations->q2);
    if (!update_heading(source, orientations, &heading)) {
        return false;
    }
    out->known = source->joint.known && heading.known;
    if (source->config.ball && out->known) {
        take_pose(source, orientations, heading.heading_rad, out->t_us);
        out->known = source->has_pose;
    }
    source->at_end = out->known;
    if (!out->known) {
        return true;
    }
    out->heading_rad = heading.heading_rad;
    out->bound_rad = source->joint.bound_rad;
    return compute(source, orientations, heading.heading_rad, &out->angles);
}

bool angle_source_row(angle_source_t *source, const oriented_row_t *oriented, bool refused, angles_row_t *out)
{
    const recording_row_t *row = &oriented->row;
    jcal_orientation_pair_t orientations = {row_clock_advance(&source->clock, row), row->q1, row->q2};
    const bool runs = !source->given || source->config.own_orientations;
    if (!row->has_time || oriented->reject != JCAL_REJECT_NONE) {
        orientations.q1.w = NAN; /* the library's time has no NaN; the sample has */
    }
    if (oriented->restarted) { /* headings of before are gone */
        (void)jcal_two_dof_auto_restart(&source->two_dof);
        source->has_follower = false;
    }
    *out = (angles_row_t){.t_us = row->t_us, .has_time = row->has_time};
    const float dt_s = step_s(&source->motion, orientations.t_us);
    follow_motion(&source->motion, row, dt_s);
    if (runs && !update_engine(source, row, &orientations)) {
        return false;
    }
    if (source->config.own_orientations && !source->config.ball && oriented->reject == JCAL_REJECT_NONE) {
        orientations.q1 = jcal_hinge_auto_orientation(&source->hinge, 1);
        orientations.q2 = jcal_hinge_auto_orientation(&source->hinge, 2);
    }
    const bool usable = is_usable(jcal_orientation_gate_check(&source->gate, &source->gate_config, &orientations));
    if (usable && !angles_of(source, &orientations, out)) {
        return false;
    }
    if (out->known) {
        follow_angle(&source->motion, out->angles.flexion_rad, dt_s);
    }
    if (refused && !source->config.accept_best) {
        out->known = false;
        source->at_end = false;
    }
    source->rows += out->known ? 1u : 0u;
    return true;
}
