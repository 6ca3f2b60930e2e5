/* SPDX-License-Identifier: MIT */
/// @file
/// A whole body: wireless sensors and the joints between them, from packets to angles, within a budget of work.
///
/// How it is used, with the tables of body_config.h:
///
///     static jcal_body_sensor_t sensor_states[3];
///     static jcal_body_joint_t joint_states[2];
///     static jcal_lag_t lag;
///     static jcal_health_t health;
///     static jcal_body_t body;
///
///     (void)jcal_ball_init(&hip, &ball_config);                          estimators with settings of their own
///     (void)jcal_functional_init(&knee, &hinge_config);
///     const jcal_body_table_t table = {sensors, sensor_states, 3u, joints, joint_states, 2u, &lag, &health};
///     if (jcal_body_init(&body, &table, &config) != JCAL_OK) { ... jcal_body_table_check(&table, &at) ... }
///
///     (void)jcal_body_push(&body, sensor, &packet);                      in the interrupt of the radio
///
///     while (jcal_body_step(&body, now_us, 65u) == JCAL_OK) { ... }      in the task, every 10 ms; one call of it where time is short
///     while (jcal_body_event(&body, &event) == JCAL_OK) { ... }
///     (void)jcal_body_joint(&body, 1u, &joint);
///     if (joint.head.status == JCAL_READY) { ... joint.flexion_rad ... }
///
/// A joint is `ready` only if its engine says so, the lag of its sensors is known, and nothing bad is named of either sensor; else `reason`
/// is `sensor_bad` or `out_of_step`. Every sensor is brought to the same times, multiples of the period from the first reading on. Results are
/// behind `now_us` by what the latest sensor needs, and by `wait_s` for as long as a second when one falls silent.
///
/// Shifting all times changes no bit of the result. A clock of the hub that goes back, and a sensor that begins anew, lose nothing but a stretch of
/// time. What is dropped is counted: jcal_body_sensor(), jcal_body_status().
///
/// Cost. Of state, on a 32-bit processor, JCAL_BODY_STATE_BYTES, and what packets need: for 16 sensors and 15 hinges 64 KiB with all estimators and
/// 32 raw readings of each sensor that may wait. A unit of work is about 1,000 instructions on a Cortex-M4F and never more than 2,900;
/// docs/METHOD_HUB.md has the price of each kind.
/// Method: docs/METHOD_HUB.md, section 1. Units and frames: types.h.
/// Threads: push may preempt everything but init, as types.h says, one push of each sensor at a time; all other calls belong to one task.
#ifndef JCAL_BODY_H
#define JCAL_BODY_H

#include "jointcal/body_config.h"
#include "jointcal/head.h"
#include "jointcal/private/body/body.h"
#include "jointcal/sensor.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Fewest units of a step: below, nothing is worked off.
#define JCAL_BODY_UNITS_MIN 3u
/// No joint, no sensor.
#define JCAL_BODY_NONE 255u
/// Largest lag that is taken off a sensor, in all, s.
#define JCAL_BODY_SHIFT_MAX_S 0.3f

/// Bytes of a body's state without packets' storage; of joints, the sum of the estimators' sizes. Usable in array sizes.
#define JCAL_BODY_STATE_BYTES(sensor_count, joint_count, engines_bytes)                                                \
    (sizeof(jcal_body_t) + ((size_t)(sensor_count) * sizeof(jcal_body_sensor_t)) +                                     \
     ((size_t)(joint_count) * sizeof(jcal_body_joint_t)) + (size_t)(engines_bytes) + sizeof(jcal_body_shared_t) +      \
     sizeof(jcal_health_t))

/// What happened.
typedef enum {
    JCAL_BODY_READY = 0,        ///< A joint became ready.
    JCAL_BODY_LEFT_READY = 1,   ///< A joint is not ready any more; `what` has the reason.
    JCAL_BODY_MOVED = 2,        ///< A sensor of a joint slipped; the joint begins anew.
    JCAL_BODY_NOT_ONE = 3,      ///< The two sensors of a joint share none: exchanged, or on another segment.
    JCAL_BODY_LAG_FOUND = 4,    ///< The lag of a joint is known, and taken off; `value` has it, s.
    JCAL_BODY_SENSOR_BAD = 5,   ///< Something is named of a sensor; `what` has the finding, `value` its fact.
    JCAL_BODY_SENSOR_FINE = 6,  ///< Nothing bad is named of a sensor any more.
    JCAL_BODY_SENSOR_LOST = 7,  ///< A sensor has been silent for a second.
    JCAL_BODY_SENSOR_BACK = 8,  ///< It sends again.
    JCAL_BODY_REMEMBERED = 9,   ///< A calibration of a joint was kept; motion is to confirm it.
    JCAL_BODY_CONFIRMED = 10,   ///< It still holds.
    JCAL_BODY_DROPPED = 11,     ///< It does not; `what` has the reason of remember.h.
    JCAL_BODY_KEPT = 12,        ///< What is worth it was written to flash; of no joint and no sensor.
    JCAL_BODY_EXCHANGED = 13    ///< `sensor` and sensor number `what` seem to sit on each other's segment.
} jcal_body_event_kind_t;

/// What is known of a joint.
typedef struct {
    jcal_head_t head;  ///< Samples are pairs of ticks, about 20 a second.
    bool lag_known;    ///< Also where none is looked for.
    float lag_s,
        lag_bound_s;  ///< The distal sensor's times are late by it; 95 % bound, JCAL_LAG_UNKNOWN_S while it is not known.
    jcal_vec3_t axis1, axis2;                  ///< Of hinges and joints with two axes; zero while nothing is known.
    float uncertainty1_rad, uncertainty2_rad;  ///< 95 % bounds; a right angle while unknown.
    jcal_vec3_t joint_to_sensor1_m, joint_to_sensor2_m;
    jcal_heading_t heading;  ///< L2 to L1, now.
    /// Hinge: its angle, while the joint is ready, both sensors tell of the same time, and the heading is known, which takes some seconds after
    /// a gap of either; else NaN. functional.h has its zero.
    float flexion_rad;
    float flexion_bound_rad;  ///< Error that the axes make in it, rms; a right angle while unknown.
    /// Ball and two axes: sensor 2 in sensor 1, as long; else all NaN.
    jcal_quat_t relative;
    float relative_bound_rad;  ///< 95 % bound of its heading; a right angle while unknown.
    bool has_kept;             ///< A calibration of it was kept, whatever became of that:
    jcal_remember_state_t kept;
    jcal_remember_reason_t kept_reason;
} jcal_body_joint_result_t;

/// What became of a sensor. Common times that were = samples + missed, from its table's first common time on.
typedef struct {
    jcal_packets_status_t packets;
    float shift_s;     ///< Lag that is taken off its times.
    uint32_t samples;  ///< Common times that it told of ...
    uint32_t missed;   ///< ... and that it did not: lost, late, or not begun.
    uint32_t
        rejected;  ///< Readings whose time does not increase, or is more than a second ahead of the hub's, or whose values no sensor makes.
    uint32_t late;            ///< Readings that came after the common times that they could tell of.
    uint16_t bad;             ///< Bit k: finding k of health.h is named, and makes results worthless.
    bool is_heard;            ///< It sent something within the last second.
    jcal_quat_t orientation;  ///< Sensor to its level frame, at the last common time that it told of.
    uint64_t t_us;            ///< Hub time of that; 0 before any.
} jcal_body_sensor_result_t;

/// What became of the body.
typedef struct {
    uint32_t rounds;          ///< Common times so far.
    uint32_t restarts;        ///< Times that the hub's clock went back.
    uint32_t lags_refused;    ///< Lags that were not taken off, for a sensor would have been shifted too far.
    uint32_t events_dropped;  ///< Events that found no reader in time; the oldest are dropped.
    uint64_t units;           ///< Units of work so far.
    uint64_t t_us;            ///< Hub time of the round that is worked at; 0 before any.
} jcal_body_status_t;

/// What to do next.
typedef struct {
    uint8_t joint;   ///< JCAL_BODY_NONE: nothing is to be done.
    uint8_t sensor;  ///< Sensor that is bad, or JCAL_BODY_NONE.
    jcal_hint_t hint;
    jcal_reason_t reason;  ///< Why.
} jcal_body_advice_t;

/// Prepares a body; whatever the states held before is lost, estimators are reset.
///
/// Errors:   JCAL_ERR_ARG (null, or jcal_body_table_check says what); JCAL_ERR_CONFIG (jcal_body_config_check says which field);
///           JCAL_ERR_STORAGE (a sensor's packets find no room). After the last the body is not prepared; else it is untouched.
JCAL_MUST_CHECK jcal_status_t jcal_body_init(jcal_body_t *self, const jcal_body_table_t *table,
                                             const jcal_body_config_t *config);

/// Copies a packet of a sensor; may run in an interrupt. As jcal_packets_push.
jcal_status_t jcal_body_push(jcal_body_t *self, unsigned sensor, const jcal_packet_t *packet);

/// Works off what is due, `units` of work at most.
///
/// Inputs:   now_us, the hub's time, of the clock of the packets' arrivals. units, see above; below JCAL_BODY_UNITS_MIN nothing is done.
/// Returns:  JCAL_IDLE: nothing is left to do before the next packet, or for a period; JCAL_OK: there may be more; JCAL_ERR_ARG.
jcal_status_t jcal_body_step(jcal_body_t *self, uint64_t now_us, unsigned units);

/// The oldest event that waits. Returns: JCAL_OK; JCAL_IDLE if there is none, out untouched; JCAL_ERR_ARG.
jcal_status_t jcal_body_event(jcal_body_t *self, jcal_body_event_t *out);

/// What is known of a joint; best after step has returned JCAL_IDLE, for then all sensors tell of the same time. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_body_joint(const jcal_body_t *self, unsigned joint, jcal_body_joint_result_t *out);

/// Puts a hinge that is ready to sleep, or wakes it: functional.h. Other joints do not sleep.
/// Returns: JCAL_OK; JCAL_REJECTED (it is not ready, or no hinge); JCAL_ERR_ARG.
jcal_status_t jcal_body_sleep(jcal_body_t *self, unsigned joint, bool asleep);

/// True if a joint sleeps.
bool jcal_body_sleeps(const jcal_body_t *self, unsigned joint);

/// The calibration of a joint as it would be kept.
///
/// Returns:  JCAL_OK; JCAL_IDLE: the joint is not ready, or a serial number is not known; JCAL_ERR_ARG; out untouched.
jcal_status_t jcal_body_kept(const jcal_body_t *self, unsigned joint, jcal_kept_t *out);

/// True if something is worth a write, and the schedule of keep_flash.h allows it now. Looks at one joint a second.
bool jcal_body_keep_due(jcal_body_t *self);

/// Writes what is worth it to flash; the processor may stand still for as long as an erase takes.
///
/// Returns:  JCAL_OK; JCAL_IDLE: nothing is worth it; JCAL_ERR_FLASH: it failed, what was kept before stands; JCAL_ERR_ARG.
jcal_status_t jcal_body_keep(jcal_body_t *self);

/// What became of a sensor. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_body_sensor(const jcal_body_t *self, unsigned sensor, jcal_body_sensor_result_t *out);

/// What became of the body. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_body_status(const jcal_body_t *self, jcal_body_status_t *out);

/// What to do next: of the joints that are not ready one with a bad sensor first, then one that is not one joint, then the first of the table.
/// Errors: JCAL_ERR_ARG.
jcal_status_t jcal_body_advice(const jcal_body_t *self, jcal_body_advice_t *out);

/// The advice as a sentence, with the names of the tables.
///
/// Outputs:  text (size bytes), ends with a zero; what finds no room is left out.
/// Errors:   JCAL_ERR_ARG (null, size 0, a joint or sensor that there is not); text untouched.
jcal_status_t jcal_body_sentence(const jcal_body_t *self, const jcal_body_advice_t *advice, char *text, size_t size);

/// `ready`, `left_ready`, `lag_found`, ...; null for what is none. Threads: no state.
const char *jcal_body_event_string(jcal_body_event_kind_t kind);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_BODY_H */
