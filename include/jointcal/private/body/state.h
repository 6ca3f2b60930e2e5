/* SPDX-License-Identifier: MIT */
/// @file
/// State of a body. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_BODY_STATE_H
#define JCAL_PRIVATE_BODY_STATE_H

#include "jointcal/private/keep/writer.h"
#include "jointcal/private/packet/packets.h"
#include "jointcal/private/sensor/stage.h"
#include "jointcal/types.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Places for kept calibrations that are looked at: as many as fit into the lag's memory.
#define JCAL_BODY_PLACES 5u
/// Events that may wait.
#define JCAL_BODY_EVENTS 16u

/// The last two readings of a sensor, by the body's time, less its lag.
typedef struct {
    uint64_t before_us, after_us;
    jcal_imu_t before, after;
    uint32_t begin;  ///< Number of the first common time that it may tell of.
    uint32_t last;   ///< The last that it told of; 0: none.
    bool has;        ///< There is a reading.
} jcal_body_line_t;

/// A sensor of a body. Caller-owned; all members are private.
typedef struct {
    jcal_packets_t packets;
    jcal_sensor_t stage;
    jcal_body_line_t line;
    uint64_t heard_us;         ///< Body's time of its last reading.
    int32_t shift_us;          ///< Lag that is taken off its times.
    uint32_t samples, missed;  ///< Common times that it told of, and that it did not.
    uint32_t rejected, late;   ///< Readings: of a wrong time, or after all common times that they could tell of.
    uint32_t same_us;          ///< So long its readings have all been the same.
    uint16_t bad;              ///< What is named, a bit for each finding.
    uint8_t joint;             ///< Joint that it is distal to; 255: none.
    bool ticks;                ///< It made a tick in this round.
    bool is_heard;             ///< It sent something within the last second.
} jcal_body_sensor_t;

/// A joint of a body. Caller-owned; all members are private.
typedef struct {
    uint32_t probed;           ///< Round in which its lag was last looked at; 0: never.
    float lag_s, lag_bound_s;  ///< Lag of the distal sensor, what is taken off included.
    uint32_t epoch1, epoch2;   ///< Of the last ticks that its engine took.
    int32_t off_us;            ///< What was taken off since the engine began.
    uint8_t status;            ///< As last told: jcal_calibration_t.
    uint8_t ticks;             ///< Ticks since it was looked at.
    bool lag_known;
    uint8_t against;      ///< Looks at which the two sensors seemed to share no joint, less those at which they did.
    bool no_lag;          ///< No lag was found although it moved: nothing that both sensors share was seen at any.
    bool not_one;         ///< That was told.
    bool due;             ///< Its engine may have a slice of work.
    uint8_t kept;         ///< What became of its kept calibration: jcal_body_kept_phase_t of lib/body/restore.h.
    uint8_t kept_reason;  ///< jcal_remember_reason_t.
    bool lag_is_kept;     ///< Its lag is that of its kept calibration.
} jcal_body_joint_t;

/// Something that happened.
typedef struct {
    uint64_t t_us;   ///< Hub time of the round.
    float value;     ///< LAG_FOUND: the lag, s; SENSOR_BAD: the finding's fact; else 0.
    uint8_t kind;    ///< jcal_body_event_kind_t.
    uint8_t joint;   ///< Number of the joint; 255: it is about a sensor.
    uint8_t sensor;  ///< Number of the sensor; 255: it is about a joint.
    uint8_t what;    ///< SENSOR_BAD: jcal_finding_t; LEFT_READY: jcal_reason_t; else 0.
} jcal_body_event_t;

/// Events that wait.
typedef struct {
    jcal_body_event_t ring[JCAL_BODY_EVENTS];
    uint32_t dropped;  ///< The oldest ones, which found no reader in time.
    uint8_t first, count;
} jcal_body_events_t;

/// Settings and what follows from them.
typedef struct {
    float gap_s;
    uint32_t period_us;
    uint32_t stride;  ///< Rounds from tick to tick.
    uint32_t hole;    ///< Rounds after which a stage takes its next sample for a gap.
    uint32_t wait_us;
    uint32_t examine;  ///< Rounds that a sensor is examined.
} jcal_body_pace_t;

/// Where the round is.
typedef struct {
    uint64_t now_us;     ///< The body's time when step was called last.
    uint64_t origin_us;  ///< Hub time less the body's time, modulo 2^64.
    uint32_t number;     ///< Common time, in periods.
    uint8_t phase;       ///< take, sample or add ...
    uint8_t at;          ///< ... and the next sensor or joint of it.
    bool has_begun;
} jcal_body_round_t;

/// Whose lag is looked for.
typedef struct {
    uint32_t since;   ///< Round in which it began.
    uint32_t looked;  ///< Round in which it was last looked at.
    uint8_t joint;    ///< 255: nobody's.
    uint8_t other;    ///< Sensor that is looked at instead of the joint's lower one; 255: none.
    bool was_other;   ///< It was so the last time: turns alternate.
    bool due;         ///< A slice of work may be due.
} jcal_body_probe_t;

#define JCAL_BODY_HALF_NONE 0u
#define JCAL_BODY_HALF_FOUND 1u
#define JCAL_BODY_HALF_TRIED 2u

/// Sensors that sit on each other's segment.
typedef struct {
    uint16_t next;             ///< Pair of joints that is tried next.
    uint8_t half;              ///< One way round fits: then the other is tried. JCAL_BODY_HALF_ ...
    uint8_t joint, other;      ///< ... of this joint's upper sensor and this sensor.
    uint8_t sensor1, sensor2;  ///< What was told last; alike: nothing.
} jcal_body_exchange_t;

/// Kept calibrations that are looked at, and what is worth a write.
typedef struct {
    uint32_t since[JCAL_BODY_PLACES];  ///< Round in which each got its place.
    uint32_t rest;                     ///< Round until which nobody is looked at.
    uint32_t checked;                  ///< Round in which a joint was last looked at for something worth a write.
    uint32_t worth;                    ///< Bit j: joint j has something worth a write.
    jcal_keep_schedule_t schedule;
    uint8_t joint[JCAL_BODY_PLACES];  ///< 255: the place is free.
    uint8_t next;                     ///< Place whose slice is next ...
    uint8_t next_joint;               ///< ... joint that is next to get a place ...
    uint8_t next_check;               ///< ... and joint that is next to be looked at for a write.
    bool open;                        ///< The memory that is shared has places, not a lag.
} jcal_body_restore_t;

/// Who is examined.
typedef struct {
    uint32_t since;   ///< Round in which it began.
    uint32_t looked;  ///< Round in which it was last looked at.
    uint8_t sensor;
} jcal_body_exam_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_BODY_STATE_H */
