/* SPDX-License-Identifier: MIT */
/// @file
/// A body session of the hub: a table of sensors and joints, the packets of each sensor, what is kept. The rest of the hub calls this; see hub.h.
///
/// Work comes in pieces: hub_body_take takes in a message, and hub_body_work is called until it is idle; each call writes one frame at most.
#ifndef JCAL_HUB_HUB_BODY_H
#define JCAL_HUB_HUB_BODY_H

#include "body_messages.h"
#include "hub_out.h"
#include "jointcal/keep_flash.h"
#include "messages.h"

/// Room for sensors and joints.
#define HUB_SENSORS 16u
#define HUB_JOINTS 15u
/// Bytes of packets that may wait, of each sensor: 32 raw readings that come one by one, 64 in packets of four or more.
#define HUB_PACKETS_BYTES 1024u
/// Units of work of one piece.
#define HUB_UNITS 16u

/// Private: the estimator of a joint, of any kind.
typedef union {
    jcal_functional_t hinge;
    jcal_ball_t ball;
    jcal_two_axes_t two_axes;
} hub_engine_t;

/// Private: what is next to be done for the message that was taken.
typedef enum {
    HUB_BODY_IDLE = 0,
    HUB_BODY_TABLE,  ///< The table is answered.
    HUB_BODY_STEP,   ///< The body works.
    HUB_BODY_EVENTS,
    HUB_BODY_STATES,  ///< The body, then each sensor, each joint, the advice; counters are the hub's.
    HUB_BODY_SENSORS,
    HUB_BODY_JOINTS,
    HUB_BODY_ADVICE,
    HUB_BODY_COUNTERS,
    HUB_BODY_ANGLES,
    HUB_BODY_KEEP,   ///< Flash is written if something is worth it.
    HUB_BODY_WRITE,  ///< Flash is written as the sender asked.
    HUB_BODY_ANSWER  ///< A kept record is answered.
} hub_body_phase_t;

/// All members are private.
typedef struct {
    message_begin_t begin;
    bool running;                      ///< The table is complete and accepted.
    bool has_refused;                  ///< It is not.
    uint32_t has_sensors, has_joints;  ///< Bit n: number n of the table has come.
    message_table_t table_answer;
    char names[HUB_SENSORS + HUB_JOINTS][MESSAGE_NAME_BYTES + 1u];
    jcal_packet_config_t packets[HUB_SENSORS];
    jcal_body_sensor_spec_t sensors[HUB_SENSORS];
    jcal_body_joint_spec_t joints[HUB_JOINTS];
    float max_bound_rad[HUB_JOINTS];
    jcal_body_sensor_t sensor_states[HUB_SENSORS];
    jcal_body_joint_t joint_states[HUB_JOINTS];
    hub_engine_t engines[HUB_JOINTS];
    uint8_t storage[HUB_SENSORS][HUB_PACKETS_BYTES];
    jcal_body_shared_t shared;
    jcal_health_t health;
    jcal_body_t body;
    const jcal_flash_t *flash;  ///< Null: there is none.
    uint64_t now_us;            ///< Time of the last packet.
    uint64_t next_us;           ///< When states are due.
    uint64_t next_angles_us;    ///< When angles are due, of the body's time.
    bool has_time, has_angles_time;
    bool is_live;     ///< The hub's own clock stamps packets.
    bool is_asked;    ///< States are answered to a request, whose token follows.
    bool writes_put;  ///< The sender asked for a record, else for none.
    uint32_t pushed;  ///< Packets that were pushed.
    uint32_t token;
    hub_body_phase_t phase;
    uint8_t at;  ///< Sensor or joint that is next.
    message_kept_t kept;
} hub_body_t;

/// Begins; false if there is no room for so many. `flash` may be null.
bool hub_body_begin(hub_body_t *self, const message_begin_t *begin, const jcal_flash_t *flash);

/// Takes a frame in; now_us stamps a packet that leaves its arrival to the hub. False if it is none of a body session. Only while idle.
bool hub_body_take(hub_body_t *self, const frame_t *frame, uint64_t now_us);

/// Begins the work of a time that has passed without a frame. Only while idle.
void hub_body_pass(hub_body_t *self, uint64_t now_us);

/// True if the phase is one of counters: the hub writes them, then calls hub_body_counted.
bool hub_body_counts(const hub_body_t *self);
void hub_body_counted(hub_body_t *self);

/// True if flash is to be written before anything else is done: the hub waits until it may, then calls hub_body_write.
bool hub_body_is_to_write(hub_body_t *self);
void hub_body_write(hub_body_t *self);

/// One piece of work, at most one frame of answer. False: idle.
bool hub_body_work(hub_body_t *self, hub_out_t *out);

#endif
