/* SPDX-License-Identifier: MIT */
/// @file
/// Payloads of a body session, as its sender writes and reads them. Specification: docs/PROTOCOL.md.
///
/// A `write` function fills a payload; a `read` function returns false if the payload is not exactly such a message.
#ifndef JCAL_CLI_RUN_BODY_WIRE_H
#define JCAL_CLI_RUN_BODY_WIRE_H

#include "frame.h"
#include "jointcal/chips.h"
#include "jointcal/types.h"

#define BODY_WIRE_NAME_MAX 16
#define BODY_WIRE_TEXT_MAX 200
#define BODY_WIRE_WHAT_MAX 24
#define BODY_WIRE_RECORD_BYTES 128
#define BODY_WIRE_FLEXIONS_MAX 22
#define BODY_WIRE_ORIENTATIONS_MAX 9

/// Types of frames.
enum {
    BODY_WIRE_BEGIN = 0x04,
    BODY_WIRE_SENSOR = 0x05,
    BODY_WIRE_JOINT = 0x06,
    BODY_WIRE_PACKET = 0x07,
    BODY_WIRE_PUT_KEPT = 0x09,
    BODY_WIRE_GET_KEPT = 0x0A,
    BODY_WIRE_TABLE = 0x85,
    BODY_WIRE_EVENT = 0x86,
    BODY_WIRE_JOINT_STATE = 0x87,
    BODY_WIRE_SENSOR_STATE = 0x88,
    BODY_WIRE_BODY_STATE = 0x89,
    BODY_WIRE_FLEXIONS = 0x8A,
    BODY_WIRE_ORIENTATIONS = 0x8B,
    BODY_WIRE_ADVICE = 0x8C,
    BODY_WIRE_KEPT = 0x8D,
    BODY_WIRE_VERSION = 0x8E
};

/// Flags of begin.
#define BODY_WIRE_LAGS 1u
#define BODY_WIRE_EXAMINE 2u
#define BODY_WIRE_KEEP 4u

typedef struct {
    uint32_t nonce;
    uint64_t every_us, angles_every_us;
    uint8_t sensors, joints, flags;
} body_wire_begin_t;

typedef struct {
    uint8_t number;
    uint64_t serial;
    uint32_t period_ns;
    uint8_t counter_bits, per_packet;
    jcal_scale_t scale;
    float max_drift_ppm;
    const char *name;
} body_wire_sensor_t;

typedef struct {
    uint8_t number, kind, proximal, distal;
    float max_bound_rad;
    const char *name;
} body_wire_joint_t;

typedef struct {
    uint8_t sensor;
    uint64_t arrival_us;
    uint32_t counter;
    uint8_t count;
    const int16_t *raw; /* count x 6 */
} body_wire_packet_t;

typedef struct {
    bool refused;
    uint8_t at;
    char what[BODY_WIRE_WHAT_MAX + 1];
} body_wire_table_t;

typedef struct {
    uint64_t t_us;
    uint8_t kind, joint, sensor, what;
    float value;
} body_wire_event_t;

typedef struct {
    uint32_t token;
    uint8_t joint, status, weak, hint, reason;
    bool lag_known, heading_known, record_found, asleep;
    uint8_t kept, kept_reason;
    float lag_s, lag_bound_s;
    jcal_vec3_t axis1, axis2;
    float uncertainty1_rad, uncertainty2_rad;
    jcal_vec3_t joint_to_sensor1_m, joint_to_sensor2_m;
    float heading_rad, flexion_bound_rad, relative_bound_rad;
    uint32_t samples;
} body_wire_joint_state_t;

typedef struct {
    uint32_t token;
    uint8_t sensor;
    bool heard;
    uint16_t bad;
    uint32_t readings, lost, late, duplicate, odd, restarts, steps, overruns;
    float period_s, drift_ppm, shift_s;
    uint32_t samples, missed, rejected, late_readings;
} body_wire_sensor_state_t;

typedef struct {
    uint32_t token;
    uint64_t t_us;
    uint32_t rounds, restarts, lags_refused, events_dropped;
    uint64_t units;
    uint32_t writes;
} body_wire_body_state_t;

typedef struct {
    uint64_t t_us;
    uint8_t count;
    struct {
        uint8_t joint;
        float angle_rad, bound_rad;
    } of[BODY_WIRE_FLEXIONS_MAX];
} body_wire_flexions_t;

typedef struct {
    uint64_t t_us;
    uint8_t count;
    struct {
        uint8_t joint;
        jcal_quat_t relative;
        float bound_rad;
    } of[BODY_WIRE_ORIENTATIONS_MAX];
} body_wire_orientations_t;

typedef struct {
    uint8_t joint, sensor, hint, reason;
    char text[BODY_WIRE_TEXT_MAX + 1];
} body_wire_advice_t;

typedef struct {
    uint32_t token;
    uint8_t joint, refusal;
    uint8_t record[BODY_WIRE_RECORD_BYTES];
} body_wire_kept_t;

void body_wire_write_begin(frame_writer_t *out, const body_wire_begin_t *in);
void body_wire_write_sensor(frame_writer_t *out, const body_wire_sensor_t *in);
void body_wire_write_joint(frame_writer_t *out, const body_wire_joint_t *in);
void body_wire_write_packet(frame_writer_t *out, const body_wire_packet_t *in);
void body_wire_write_put_kept(frame_writer_t *out, uint32_t token, const uint8_t record[BODY_WIRE_RECORD_BYTES]);
void body_wire_write_get_kept(frame_writer_t *out, uint32_t token, uint8_t joint);

bool body_wire_read_table(const frame_t *frame, body_wire_table_t *out);
bool body_wire_read_event(const frame_t *frame, body_wire_event_t *out);
bool body_wire_read_joint(const frame_t *frame, body_wire_joint_state_t *out);
bool body_wire_read_sensor(const frame_t *frame, body_wire_sensor_state_t *out);
bool body_wire_read_body(const frame_t *frame, body_wire_body_state_t *out);
bool body_wire_read_flexions(const frame_t *frame, body_wire_flexions_t *out);
bool body_wire_read_orientations(const frame_t *frame, body_wire_orientations_t *out);
bool body_wire_read_advice(const frame_t *frame, body_wire_advice_t *out);
bool body_wire_read_kept(const frame_t *frame, body_wire_kept_t *out);

#endif
