/* SPDX-License-Identifier: MIT */
/// @file
/// Payloads of a body session. Specification: docs/PROTOCOL.md.
///
/// As in messages.h, a `write` function fills a payload, and a `read` function returns false if the payload is not exactly such a message.
#ifndef JCAL_HUB_BODY_MESSAGES_H
#define JCAL_HUB_BODY_MESSAGES_H

#include "frame.h"
#include "jointcal/body.h"
#include "jointcal/keep.h"

/// Arrival of a packet that the hub's own clock is to say.
#define MESSAGE_ARRIVAL_NOW UINT64_MAX
/// Bytes of a name, without the zero behind it.
#define MESSAGE_NAME_BYTES 16u
#define MESSAGE_WHAT_BYTES 24u
#define MESSAGE_ADVICE_BYTES 200u
/// Most angles of one message.
#define MESSAGE_FLEXIONS 22u
#define MESSAGE_ORIENTATIONS 9u
/// All joints, of forget; no sensor or joint, of table.
#define MESSAGE_ALL 255u

/// Flags of begin.
#define MESSAGE_LAGS 1u
#define MESSAGE_EXAMINE 2u
#define MESSAGE_KEEP 4u

typedef struct {
    uint32_t nonce;
    uint64_t every_us;         ///< States every so often; 0: never.
    uint64_t angles_every_us;  ///< Angles every so often; 0: never.
    uint8_t sensors, joints;
    uint8_t flags;
} message_begin_t;

typedef struct {
    uint8_t number;
    uint64_t serial;
    jcal_packet_config_t
        packets;  ///< Its period, counter, readings, scale and drift; the rest as by default, raw values.
    char name[MESSAGE_NAME_BYTES + 1u];
} message_sensor_t;

typedef struct {
    uint8_t number, kind, proximal, distal;
    float max_bound_rad;  ///< 0: the library's.
    char name[MESSAGE_NAME_BYTES + 1u];
} message_joint_t;

typedef struct {
    uint8_t sensor, count;
    uint64_t arrival_us;
    uint32_t counter;
    int16_t raw[JCAL_PACKET_READINGS_MAX * JCAL_PACKET_VALUES];
} message_packet_t;

typedef struct {
    uint32_t token;
    uint8_t bytes[JCAL_KEPT_BYTES];
} message_put_kept_t;

/// Of get kept and forget.
typedef struct {
    uint32_t token;
    uint8_t joint;
} message_ask_kept_t;

typedef struct {
    uint8_t joint;
    bool asleep;
} message_sleep_t;

typedef struct {
    bool refused;
    uint8_t at;  ///< The sensor or joint that is meant.
    char what[MESSAGE_WHAT_BYTES + 1u];
} message_table_t;

/// Answers beyond those of jcal_kept_refusal_t.
enum { MESSAGE_KEPT_FLASH_FAILED = 6, MESSAGE_KEPT_WRITTEN = 7, MESSAGE_KEPT_FORGOTTEN = 8 };

typedef struct {
    uint32_t token;
    uint8_t joint, refusal;
    uint8_t bytes[JCAL_KEPT_BYTES];
} message_kept_t;

typedef struct {
    uint32_t token;
    uint8_t joint;
    bool asleep;
    jcal_body_joint_result_t result;  ///< Of its head: status, weak, hint, reason and samples. Without angles.
} message_joint_state_t;

typedef struct {
    uint32_t token;
    uint8_t sensor;
    jcal_body_sensor_result_t
        result;  ///< Without orientation, time and what its packets have besides counters, period and drift.
} message_sensor_state_t;

typedef struct {
    uint32_t token;
    jcal_body_status_t status;
    uint32_t writes;  ///< Images in flash so far.
} message_body_state_t;

typedef struct {
    uint8_t joint;
    float flexion_rad, bound_rad;
} message_flexion_t;

typedef struct {
    uint64_t t_us;
    unsigned count;
    message_flexion_t of[MESSAGE_FLEXIONS];
} message_flexions_t;

typedef struct {
    uint8_t joint;
    jcal_quat_t relative;
    float bound_rad;
} message_orientation_t;

typedef struct {
    uint64_t t_us;
    unsigned count;
    message_orientation_t of[MESSAGE_ORIENTATIONS];
} message_orientations_t;

typedef struct {
    jcal_body_advice_t advice;
    char text[MESSAGE_ADVICE_BYTES + 1u];
} message_advice_t;

void message_write_begin(frame_writer_t *out, const message_begin_t *in);
bool message_read_begin(const frame_t *frame, message_begin_t *out);

void message_write_sensor(frame_writer_t *out, const message_sensor_t *in);
bool message_read_sensor(const frame_t *frame, message_sensor_t *out);

void message_write_joint(frame_writer_t *out, const message_joint_t *in);
bool message_read_joint(const frame_t *frame, message_joint_t *out);

void message_write_packet(frame_writer_t *out, const message_packet_t *in);
bool message_read_packet(const frame_t *frame, message_packet_t *out);

void message_write_time(frame_writer_t *out, uint64_t now_us);
bool message_read_time(const frame_t *frame, uint64_t *now_us);

void message_write_put_kept(frame_writer_t *out, const message_put_kept_t *in);
bool message_read_put_kept(const frame_t *frame, message_put_kept_t *out);

void message_write_ask_kept(frame_writer_t *out, const message_ask_kept_t *in);
bool message_read_ask_kept(const frame_t *frame, message_ask_kept_t *out);

void message_write_sleep(frame_writer_t *out, const message_sleep_t *in);
bool message_read_sleep(const frame_t *frame, message_sleep_t *out);

void message_write_table(frame_writer_t *out, const message_table_t *in);
bool message_read_table(const frame_t *frame, message_table_t *out);

void message_write_event(frame_writer_t *out, const jcal_body_event_t *in);
bool message_read_event(const frame_t *frame, jcal_body_event_t *out);

void message_write_joint_state(frame_writer_t *out, const message_joint_state_t *in);
bool message_read_joint_state(const frame_t *frame, message_joint_state_t *out);

void message_write_sensor_state(frame_writer_t *out, const message_sensor_state_t *in);
bool message_read_sensor_state(const frame_t *frame, message_sensor_state_t *out);

void message_write_body_state(frame_writer_t *out, const message_body_state_t *in);
bool message_read_body_state(const frame_t *frame, message_body_state_t *out);

void message_write_flexions(frame_writer_t *out, const message_flexions_t *in);
bool message_read_flexions(const frame_t *frame, message_flexions_t *out);

void message_write_orientations(frame_writer_t *out, const message_orientations_t *in);
bool message_read_orientations(const frame_t *frame, message_orientations_t *out);

void message_write_advice(frame_writer_t *out, const message_advice_t *in);
bool message_read_advice(const frame_t *frame, message_advice_t *out);

void message_write_kept(frame_writer_t *out, const message_kept_t *in);
bool message_read_kept(const frame_t *frame, message_kept_t *out);

void message_write_other_version(frame_writer_t *out, uint8_t version);
bool message_read_other_version(const frame_t *frame, uint8_t *version);

#endif
