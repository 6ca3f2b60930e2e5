/* SPDX-License-Identifier: MIT */
/// @file
/// What a body is made of: its sensors, its joints, and settings. Start from jcal_body_config_default().
///
/// A table of pelvis, thigh and shank, with a hip and a knee:
///
///     static const jcal_body_sensor_spec_t sensors[] = {
///         {"pelvis", &packets, storage[0], sizeof storage[0]},
///         {"thigh", &packets, storage[1], sizeof storage[1]},
///         {"shank", &packets, storage[2], sizeof storage[2]}};
///     static const jcal_body_joint_spec_t joints[] = {
///         {"hip", 0u, 1u, JCAL_BODY_BALL, {.ball = &hip}},
///         {"knee", 1u, 2u, JCAL_BODY_HINGE, {.hinge = &knee}}};
///
/// Sensors are numbered as they stand in their table, from 0, and so are joints.
#ifndef JCAL_BODY_CONFIG_H
#define JCAL_BODY_CONFIG_H

#include "jointcal/ball.h"
#include "jointcal/functional.h"
#include "jointcal/health.h"
#include "jointcal/keep_flash.h"
#include "jointcal/lag.h"
#include "jointcal/packet.h"
#include "jointcal/private/body/state.h"
#include "jointcal/remember.h"
#include "jointcal/two_axes.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Most sensors and joints of a body.
#define JCAL_BODY_SENSORS_MAX 32u
#define JCAL_BODY_JOINTS_MAX 31u

/// What a joint is.
typedef enum {
    JCAL_BODY_HINGE = 0,     ///< One axis that explains most of the motion: knee, ankle; functional.h.
    JCAL_BODY_BALL = 1,      ///< Heading and centre: hip, shoulder; ball.h.
    JCAL_BODY_TWO_AXES = 2,  ///< Elbow and forearm; two_axes.h.
    JCAL_BODY_KIND_COUNT = 3
} jcal_body_kind_t;

/// The estimator of a joint, of the joint's kind. It is the caller's, prepared by its own init, and belongs to the body from then on.
typedef union {
    jcal_functional_t *hinge;
    jcal_ball_t *ball;
    jcal_two_axes_t *two_axes;
} jcal_body_engine_t;

/// Kept calibrations that are looked at at a time.
#define JCAL_BODY_LOOKS JCAL_BODY_PLACES

/// Memory for what is looked at at the beginning, kept calibrations, and later the lag of one joint after the other. All members are private.
typedef union {
    jcal_lag_t lag;
    jcal_remember_t remember[JCAL_BODY_LOOKS];
} jcal_body_shared_t;

/// A sensor.
typedef struct {
    const char *name;                     ///< For sentences; null: its number.
    const jcal_packet_config_t *packets;  ///< How its packets are made.
    void *storage;                        ///< Packets that wait; JCAL_PACKETS_STORAGE_BYTES of packet.h.
    size_t storage_bytes;  ///< Room for wait_s, what comes between two steps, and the largest lag is enough.
    uint64_t serial;       ///< Serial number; 0: not known, and nothing of its joints is kept or remembered.
} jcal_body_sensor_spec_t;

/// A joint.
typedef struct {
    const char *name;  ///< For sentences; null: its number.
    uint8_t proximal;  ///< Number of the sensor on the segment nearer to the trunk: sensor 1 of the joint.
    uint8_t distal;    ///< The other one: sensor 2. A sensor is distal to one joint at most, and there is no circle.
    jcal_body_kind_t kind;
    jcal_body_engine_t engine;
} jcal_body_joint_spec_t;

/// All that a body is made of. Tables and states belong to the body as long as it is used.
typedef struct {
    const jcal_body_sensor_spec_t *sensors;
    jcal_body_sensor_t *sensor_states;  ///< sensor_count of them.
    unsigned sensor_count;              ///< 2 to JCAL_BODY_SENSORS_MAX.
    const jcal_body_joint_spec_t *joints;
    jcal_body_joint_t *joint_states;  ///< joint_count of them.
    unsigned joint_count;             ///< 1 to JCAL_BODY_JOINTS_MAX.
    jcal_body_shared_t
        *shared;  ///< One for all joints; null: sensors share one clock, no lag is looked for, nothing is remembered.
    jcal_health_t *health;      ///< One for all sensors; null: none is examined.
    const jcal_flash_t *flash;  ///< Where calibrations are kept; null: nowhere.
} jcal_body_table_t;

/// Settings of a body.
typedef struct {
    float period_s;  ///< As of pairing_config.h: from one common time to the next. Range [0.004, 0.05], default 0.01.
    float gap_s;     ///< As of pairing_config.h. Range [0.005, 0.1], default 0.1.
    /// How long a common time waits for a sensor that is late, s: lag and delay together. Range [0.05, 2], default 0.32. Longer: later
    /// results when a sensor is lost, and more room for packets; shorter: more beginnings.
    float wait_s;
    float examine_s;  ///< How long a sensor is examined before the next one, s. Range [5, 600], default 30.
} jcal_body_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_body_config_t jcal_body_config_default(void);

/// Name of the first field that is out of its range, "config" for null, or null if the config is valid.
/// Threads:  no state.
const char *jcal_body_config_check(const jcal_body_config_t *config);

/// What is wrong with a table, or null if nothing is: "table" (null), "sensor_count", "joint_count", "sensors", "sensor_states", "joints",
/// "joint_states" (null); then of the first sensor that is wrong "packets"; of the first joint "no_such_sensor", "same_sensor",
/// "distal_twice", "no_such_kind", "engine" (null or never prepared); "circle" of joints.
///
/// Outputs:  at, the number of that sensor or joint, 0 where none is meant; may be null.
/// Threads:  no state.
const char *jcal_body_table_check(const jcal_body_table_t *table, unsigned *at);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_BODY_CONFIG_H */
