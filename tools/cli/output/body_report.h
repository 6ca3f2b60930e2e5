/* SPDX-License-Identifier: MIT */
/// @file
/// Lines of a body session: events, states and angles of joints and sensors by name, as JSON Lines. What is not known is null.
#ifndef JCAL_CLI_OUTPUT_BODY_REPORT_H
#define JCAL_CLI_OUTPUT_BODY_REPORT_H

#include "body_messages.h"
#include "output/json.h"

/// Most sensors and joints that are told of.
#define BODY_REPORT_MAX 32

/// A name, ended by a zero.
typedef char body_name_t[MESSAGE_NAME_BYTES + 1];

typedef struct {
    FILE *file;
    uint64_t origin_us;  ///< The hub's time ...
    int64_t start_us;    ///< ... at this time of the recording.
    unsigned sensor_count, joint_count;
    body_name_t sensors[BODY_REPORT_MAX];
    body_name_t joints[BODY_REPORT_MAX];
    uint8_t kinds[BODY_REPORT_MAX]; /* of the joints: jcal_body_kind_t */

    /* Private. */
    bool has_angles; /* flexions wait for the orientations that may follow them */
    uint64_t angles_us;
    bool known[BODY_REPORT_MAX];
    float angle_rad[BODY_REPORT_MAX];
    jcal_quat_t relative[BODY_REPORT_MAX];
    float bound_rad[BODY_REPORT_MAX];
} body_report_t;

/// One line each.
void body_report_event(body_report_t *self, const jcal_body_event_t *event);
void body_report_body(body_report_t *self, const message_body_state_t *state);
void body_report_sensor(body_report_t *self, uint64_t t_us, const message_sensor_state_t *state);
void body_report_joint(body_report_t *self, uint64_t t_us, const message_joint_state_t *state);
void body_report_advice(body_report_t *self, uint64_t t_us, const message_advice_t *advice);

/// Angles of one time make one line, which is written by the next call of body_report_flush.
void body_report_flexions(body_report_t *self, const message_flexions_t *flexions);
void body_report_orientations(body_report_t *self, const message_orientations_t *orientations);
void body_report_flush(body_report_t *self);

/// Keys of a state, into an object that is being written.
void body_report_body_keys(json_t *json, const message_body_state_t *state);
void body_report_sensor_keys(const body_report_t *self, json_t *json, const message_sensor_state_t *state);
void body_report_joint_keys(const body_report_t *self, json_t *json, const message_joint_state_t *state);

/// `t_s` of the hub's time `t_us`, null before any.
void body_report_time(const body_report_t *self, json_t *json, uint64_t t_us);

#endif
