/* SPDX-License-Identifier: MIT */
/* `jointcal angles`: rows in, angles out. */
#include "angles_command.h"

#include "angles_options.h"
#include "angles_output.h"
#include "calibration_file.h"
#include "input.h"
#include "message.h"
#include "orientations.h"
#include "progress.h"
#include "recording.h"
#include "row_clock.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Memory of the heading unless --window says otherwise, s. */
#define MEMORY_S 10.0f

/* What is known of the joint now. */
typedef struct {
    bool known;
    jcal_vec3_t axis1, axis2;
    float carrying_rad;
    float heading_rad; /* of the engine; a follower has its own */
} joint_t;

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    angles_options_t options;
    input_t input;
    recording_t recording;
    orientations_t orientations;
    progress_t progress;
    angles_output_t output;
    jcal_hinge_t hinge;
    jcal_two_dof_t two_dof;
    jcal_orientation_gate_t gate;
    jcal_gate_config_t gate_config;
    joint_t joint;
    jcal_joint_heading_t follower;
    bool has_follower;
    row_clock_t clock;
    bool at_end; /* the last row whose orientations were of use had angles */
} session_t;

static exit_status_t start_engine(session_t *session)
{
    const angles_options_t *options = &session->options;
    session->gate_config = jcal_gate_config_default();
    jcal_hinge_config_t hinge = jcal_hinge_config_default();
    jcal_two_dof_config_t two_dof = jcal_two_dof_config_default();
    hinge.sign_hint = options->sign_hint;
    if (options->max_bound_rad > 0.0f) {
        hinge.max_bound_rad = options->max_bound_rad;
        two_dof.max_bound_rad = options->max_bound_rad;
    }
    if (options->window_s > 0.0f) {
        two_dof.memory_s = options->window_s;
    }
    if (jcal_hinge_init(&session->hinge, &hinge) != JCAL_OK ||
        jcal_two_dof_init(&session->two_dof, &two_dof) != JCAL_OK) {
        complain("jointcal", 0, 0, "the library refused its settings; please report this");
        return EXIT_TROUBLE;
    }
    return EXIT_READY;
}

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
static void set_axes(session_t *session, jcal_vec3_t axis1, jcal_vec3_t axis2, float carrying_rad)
{
    const angles_options_t *options = &session->options;
    joint_t *joint = &session->joint;
    const bool has_before = joint->axis1.x != 0.0f || joint->axis1.y != 0.0f || joint->axis1.z != 0.0f;
    const jcal_vec3_t signed1 = settle_sign(axis1, has_before, joint->axis1, options->has_toward1, options->toward1);
    jcal_vec3_t signed2 = settle_sign(axis2, has_before, joint->axis2, options->has_toward2, options->toward2);
    const bool turned1 = jcal_vec3_dot(signed1, axis1) < 0.0f;
    if (options->hinge) {
        signed2 = turned1 ? jcal_vec3_scale(axis2, -1.0f) : axis2;
    }
    const bool turned2 = jcal_vec3_dot(signed2, axis2) < 0.0f;
    joint->axis1 = signed1;
    joint->axis2 = signed2;
    joint->carrying_rad = (turned1 != turned2) ? -carrying_rad : carrying_rad;
    joint->known = true;
}

/* The calibration of this recording, up to this row. */
static bool update_engine(session_t *session, const recording_row_t *row, const jcal_orientation_pair_t *orientations)
{
    session->joint.known = false;
    if (session->options.hinge) {
        jcal_pair_t pair = {orientations->t_us, row->imu1, row->imu2};
        if (!row->has_time) {
            pair.imu1.gyr_rad_s.x = NAN;
        }
        jcal_hinge_result_t result;
        if (jcal_hinge_update(&session->hinge, &pair) < 0 || jcal_hinge_get(&session->hinge, &result) != JCAL_OK) {
            return false;
        }
        if (result.head.status == JCAL_READY) {
            set_axes(session, result.axis1, result.axis2, 0.0f);
        }
        return true;
    }
    jcal_two_dof_result_t result;
    if (jcal_two_dof_update(&session->two_dof, orientations) < 0 ||
        jcal_two_dof_get(&session->two_dof, &result) != JCAL_OK) {
        return false;
    }
    if (result.head.status == JCAL_READY) {
        set_axes(session, result.axis1, result.axis2, result.carrying_angle_rad);
        session->joint.heading_rad = result.heading_offset_rad;
    }
    return true;
}

/* The heading offset of this row: of the engine, or followed with the axes that are known. */
static bool update_heading(session_t *session, const jcal_orientation_pair_t *orientations, jcal_heading_t *heading)
{
    const joint_t *joint = &session->joint;
    const bool hinge = session->options.hinge;
    const float memory_s = (session->options.window_s > 0.0f) ? session->options.window_s : MEMORY_S;
    *heading = (jcal_heading_t){joint->heading_rad, joint->known};
    if (!joint->known || (!hinge && session->options.calibration == NULL)) {
        return true;
    }
    jcal_joint_heading_t *follower = &session->follower;
    jcal_status_t status = JCAL_OK;
    if (session->has_follower) {
        status = jcal_joint_heading_improve(follower, joint->axis1, joint->axis2, joint->carrying_rad);
    } else if (hinge) {
        status = jcal_joint_heading_hinge(follower, joint->axis1, joint->axis2, memory_s);
    } else {
        status = jcal_joint_heading_two_dof(follower, joint->axis1, joint->axis2, joint->carrying_rad, memory_s);
    }
    session->has_follower = true;
    return status == JCAL_OK && jcal_joint_heading_push(follower, orientations) >= 0 &&
           jcal_joint_heading_get(follower, heading) == JCAL_OK;
}

/* Angles with the axes and the heading of this row. */
static bool compute(const session_t *session, const jcal_orientation_pair_t *orientations, float heading_rad,
                    jcal_joint_angles_t *angles)
{
    const joint_t *joint = &session->joint;
    jcal_joint_frames_t frames;
    const bool hinge = session->options.hinge;
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

static exit_status_t run_row(session_t *session, const oriented_row_t *oriented)
{
    const recording_row_t *row = &oriented->row;
    jcal_orientation_pair_t orientations = {row_clock_advance(&session->clock, row), row->q1, row->q2};
    if (!row->has_time || oriented->reject != JCAL_REJECT_NONE) {
        orientations.q1.w = NAN; /* the library's time has no NaN; the sample has */
    }
    if (oriented->restarted) { /* headings of before are gone */
        (void)jcal_two_dof_reset(&session->two_dof);
        session->has_follower = false;
    }
    const bool usable = is_usable(jcal_orientation_gate_check(&session->gate, &session->gate_config, &orientations));
    angles_row_t out = {row->t_us, row->has_time, false, {0.0f, 0.0f, 0.0f}, 0.0f};
    bool understood = session->options.calibration != NULL || update_engine(session, row, &orientations);
    if (usable && understood) {
        jcal_heading_t heading;
        orientations.q1 = jcal_quat_normalise(orientations.q1);
        orientations.q2 = jcal_quat_normalise(orientations.q2);
        understood = update_heading(session, &orientations, &heading);
        if (understood && session->joint.known && heading.known) {
            out.heading_rad = heading.heading_rad;
            out.known = true;
            understood = compute(session, &orientations, heading.heading_rad, &out.angles);
        }
        session->at_end = out.known;
    }
    if (!understood) {
        complain("jointcal", 0, 0, "the library refused a sample; please report this");
        return EXIT_TROUBLE;
    }
    return angles_output_row(&session->output, &out);
}

/* Says why the recording could not be read on. */
static exit_status_t give_up(session_t *session, recording_event_t event)
{
    const recording_fault_t *fault = &session->recording.fault;
    progress_clear(&session->progress);
    if (event == RECORDING_BAD) {
        complain(session->input.name, fault->line, fault->column, "%s", fault->text);
        return EXIT_INPUT;
    }
    complain(session->input.name, 0, 0, "%s", strerror((session->input.error != 0) ? session->input.error : ENOMEM));
    return EXIT_TROUBLE;
}

static exit_status_t run_rows(session_t *session)
{
    oriented_row_t row;
    recording_event_t event = orientations_next(&session->orientations, &row);
    for (; event == RECORDING_ROW; event = orientations_next(&session->orientations, &row)) {
        const exit_status_t status = run_row(session, &row);
        if (status != EXIT_READY) {
            return status;
        }
        progress_show(&session->progress, session->recording.csv.bytes);
    }
    if (event != RECORDING_END) {
        return give_up(session, event);
    }
    progress_clear(&session->progress);
    const exit_status_t status = angles_output_end(&session->output);
    if (status != EXIT_READY) {
        return status;
    }
    return session->at_end ? EXIT_READY : EXIT_NOT_READY;
}

static exit_status_t run_oriented(session_t *session)
{
    exit_status_t status = angles_output_open(&session->output, &session->options);
    if (status == EXIT_READY) {
        progress_start(&session->progress, session->input.size);
        status = run_rows(session);
    }
    angles_output_close(&session->output);
    return status;
}

static exit_status_t run_recording(session_t *session)
{
    recording_event_t event = recording_open(&session->recording, input_read, &session->input);
    if (event == RECORDING_ROW) {
        event = orientations_open(&session->orientations, &session->recording);
    }
    const exit_status_t status = (event == RECORDING_ROW) ? run_oriented(session) : give_up(session, event);
    orientations_close(&session->orientations);
    recording_close(&session->recording);
    return status;
}

/* Everything that can be wrong before the recording is read. */
static exit_status_t prepare(session_t *session)
{
    const angles_options_t *options = &session->options;
    if (options->calibration != NULL) {
        calibration_t calibration;
        if (!calibration_load(options->calibration, options->hinge, &calibration)) {
            return EXIT_INPUT;
        }
        set_axes(session, calibration.axis1, calibration.axis2, calibration.carrying_angle_rad);
    }
    if (input_open(&session->input, options->recording) != 0) {
        complain(options->recording, 0, 0, "%s", strerror(session->input.error));
        return EXIT_INPUT;
    }
    return start_engine(session);
}

int angles_command(int argc, char **argv)
{
    session_t *session = calloc(1, sizeof *session);
    if (session == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    session->options = angles_options(argc, argv);
    exit_status_t status = prepare(session);
    if (status == EXIT_READY) {
        status = run_recording(session);
        input_close(&session->input);
    }
    free(session);
    return (int)status;
}
