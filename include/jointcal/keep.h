/* SPDX-License-Identifier: MIT */
/// @file
/// A calibration as a record of fixed layout, to be kept while the power is off.
///
/// How it is used, once a joint is ready:
///
///     jcal_kept_t kept = {0};
///     if (jcal_kept_from_hinge(&result, &kept) == JCAL_OK) {
///         kept.joint = 3u;                             its place in your table
///         kept.serial1 = thigh_serial;                 who found it
///         kept.serial2 = shank_serial;
///         uint8_t record[JCAL_KEPT_BYTES];
///         (void)jcal_kept_encode(&kept, record);       or jcal_keep_put, keep_flash.h
///     }
///
/// and on the next day:
///
///     const jcal_kept_wanted_t wanted = {JCAL_KEPT_HINGE, 3u, thigh_serial, shank_serial};
///     if (jcal_kept_decode(record, &wanted, &kept) == JCAL_KEPT_FITS) { ... }
///
/// What comes out is remembered, not known: sensors are put on anew every day. remember.h has motion confirm it.
///
/// Units and frames: types.h. The layout: docs/METHOD_HUB.md, section 2. No function here has state; all cost is constant, about 2,000
/// instructions for a CRC.
#ifndef JCAL_KEEP_H
#define JCAL_KEEP_H

#include "jointcal/hinge_auto.h"
#include "jointcal/joint_angles.h"
#include "jointcal/status.h"
#include "jointcal/two_axes.h"
#include "jointcal/types.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Bytes of a record.
#define JCAL_KEPT_BYTES 128u
/// Largest lag, s.
#define JCAL_KEPT_LAG_MAX_S 10.0f
/// Version of its layout.
#define JCAL_KEPT_VERSION 1u

/// Which joint it is of.
typedef enum { JCAL_KEPT_HINGE = 1, JCAL_KEPT_TWO_AXES = 2, JCAL_KEPT_BALL = 3 } jcal_kept_kind_t;

/// How the heading between both level frames is found again; it is not kept, because those begin anew with the power.
typedef enum {
    JCAL_KEPT_HEADING_BY_AXES = 0,   ///< By the axis, which is one direction in space (joint_heading.h).
    JCAL_KEPT_HEADING_BY_CENTER = 1  ///< By the centre's motion, with the levers.
} jcal_kept_heading_t;

/// What is kept of a joint. A field that the kind does not have is zero.
typedef struct {
    uint64_t serial1, serial2;  ///< Serial numbers of the sensors; they differ.
    jcal_kept_kind_t kind;
    jcal_model_t model;           ///< Which model of a hinge or of two axes found it.
    jcal_kept_heading_t heading;  ///< How the heading is to be found.
    uint32_t sequence;            ///< Number of the write that it was first part of; keep_flash.h sets it.
    uint8_t joint;                ///< Place in the hub's table, 0 to JCAL_KEEP_JOINTS_MAX - 1.
    bool has_levers;              ///< Levers and their bounds are known.
    bool has_zero;                ///< The user set a zero: zeros, or frames of a ball joint, are known.
    bool has_lag;                 ///< The lag of sensor 2 was known.
    bool has_usual;               ///< What residuals are usual is known.

    jcal_vec3_t axis1, axis2;  ///< Hinge, two axes: unit axes. Their signs are the pairing and the sense of the angles.
    float bound1_rad, bound2_rad;          ///< Their 95 % bounds, 0 to JCAL_BOUND_UNKNOWN_RAD.
    float flexion_bound_rad;               ///< Hinge: error that the axes make in the angle, rms.
    jcal_vec3_t lever1_m, lever2_m;        ///< Joint to sensor, within 10 m per component.
    float bound_lever1_m, bound_lever2_m;  ///< Their bounds; JCAL_BOUND_UNKNOWN_M if none was told.
    float flexion_zero_rad,
        pronation_zero_rad;  ///< Angles by jcal_frames_hinge or _two_dof in the zero pose: `is` of jcal_frames_zero.
    jcal_joint_frames_t frames;  ///< Ball: segment frames from a pose.
    float lag_s,
        lag_bound_s;  ///< The times of sensor 2 were late by it, within JCAL_KEPT_LAG_MAX_S; its 95 % bound, up to as much.
    float usual
        [3];  ///< Mean squares of the functional joint's residuals, up to 1e3: what the watch for slips compares with.
} jcal_kept_t;

/// What a record is asked for.
typedef struct {
    jcal_kept_kind_t kind;
    uint8_t joint;
    uint64_t serial1, serial2;
} jcal_kept_wanted_t;

/// Why a record is refused; the first of these that holds. FITS is not a refusal.
typedef enum {
    JCAL_KEPT_FITS = 0,
    JCAL_KEPT_NONE = 1,           ///< No record: erased flash.
    JCAL_KEPT_DAMAGED = 2,        ///< Bytes that are no record: the CRC is wrong, or a value is one that none has.
    JCAL_KEPT_OTHER_VERSION = 3,  ///< A whole record of another layout.
    JCAL_KEPT_OTHER_KIND = 4,     ///< Of another kind of joint, or another joint of the table.
    JCAL_KEPT_OTHER_SENSORS = 5   ///< Found with other sensors, or with the same ones exchanged.
} jcal_kept_refusal_t;

/// True if all values are ones that a record has: the ranges above, unit axes and quaternions, numbers that are finite. False for null.
bool jcal_kept_is_valid(const jcal_kept_t *kept);

/// Writes a record.
///
/// Errors:   JCAL_ERR_ARG: null, or a value that decode would refuse; bytes untouched.
JCAL_MUST_CHECK jcal_status_t jcal_kept_encode(const jcal_kept_t *kept, uint8_t bytes[JCAL_KEPT_BYTES]);

/// Reads a record. Bytes may be anything at all.
///
/// Inputs:   wanted  what it must be of; null: whatever it is of.
/// Outputs:  out     untouched unless JCAL_KEPT_FITS.
/// Returns:  as above; JCAL_KEPT_DAMAGED too if a pointer is null.
JCAL_MUST_CHECK jcal_kept_refusal_t jcal_kept_decode(const uint8_t bytes[JCAL_KEPT_BYTES],
                                                     const jcal_kept_wanted_t *wanted, jcal_kept_t *out);

/// `fits`, `none`, `damaged`, `other_version`, `other_kind`, `other_sensors`; never null.
const char *jcal_kept_refusal_string(jcal_kept_refusal_t refusal);

/// Fills in what a result says; joint, sequence, serial numbers, zero and lag stay as they are.
///
/// Errors:   JCAL_ERR_ARG: null, or the result is not ready; out untouched.
JCAL_MUST_CHECK jcal_status_t jcal_kept_from_hinge(const jcal_hinge_auto_result_t *result, jcal_kept_t *out);
JCAL_MUST_CHECK jcal_status_t jcal_kept_from_two_axes(const jcal_two_axes_result_t *result, jcal_kept_t *out);
/// `frames`: from the pose (jcal_frames_pose); null if there was none.
JCAL_MUST_CHECK jcal_status_t jcal_kept_from_ball(const jcal_ball_result_t *result, const jcal_joint_frames_t *frames,
                                                  jcal_kept_t *out);

/// True if `now` is worth a write where `kept` is what is kept of its joint (null: nothing, or refused): another joint, sensors, kind or
/// model; an axis or a lever further off than its kept bound; a bound half of the kept one or less; a zero that was not kept, or one that
/// is more than 2 deg from it.
bool jcal_kept_worth(const jcal_kept_t *kept, const jcal_kept_t *now);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_KEEP_H */
