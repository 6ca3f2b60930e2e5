/* SPDX-License-Identifier: MIT */
/// @file
/// State of the health of one sensor. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_HEALTH_STATE_H
#define JCAL_PRIVATE_HEALTH_STATE_H

#include "jointcal/quat.h"
#include "jointcal/types.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Blocks of a window, a tenth of a second each, and parts that it is cut into.
#define JCAL_HEALTH_BLOCKS 40
#define JCAL_HEALTH_PARTS 4
/// Ways to read the rates: 48 signed permutations, then rates in deg/s, then no rates at all.
#define JCAL_HEALTH_WAYS 50
/// Rates before the last one that are kept.
#define JCAL_HEALTH_BEFORE 3

/// A way to read three columns: x, y, z are `sign` times the column `column` (0, 1, 2).
typedef struct {
    int8_t column[3];
    int8_t sign[3];
} jcal_health_way_t;

/// Squared lengths of a reading's rate and specific force.
typedef struct {
    float rate2, acc2;
} jcal_health_squares_t;

/// The block that is being read.
typedef struct {
    jcal_vec3_t turn;      ///< Sum of w dt, as it stands.
    jcal_vec3_t acc_sum;   ///< Sum of specific forces, as they stand.
    jcal_vec3_t angle;     ///< Rotation vector since the block began.
    jcal_vec3_t back_sum;  ///< Sum of specific forces, each turned back to the block's begin.
    float count;
    float length_s;
} jcal_health_block_t;

/// A low-pass of the specific force in a frame that does not turn, as seen from the sensor, and what it owes to the gyroscope.
typedef struct {
    jcal_vec3_t g;
    jcal_vec3_t by_scale;  ///< Derivative of g with respect to the gyroscope's scale ...
    float by_bias[9];      ///< ... and to a bias, row by row.
} jcal_health_past_t;

/// How fast gravity turns.
typedef struct {
    jcal_health_past_t fast, slow;
    float epoch_s;        ///< Time since both began.
    float next_s;         ///< Time that is summed when the scale is judged next.
    float taken;          ///< Scale that rates are multiplied by before; 0: 1.
    uint8_t times_taken;  ///< How often a scale was taken off.
    float squares[10];    ///< Weighted sum of J J' (4 x 4, packed): bias x, y, z in units of 0.01 rad/s, scale.
    float products[4];    ///< The same of J e.
    float left;           ///< The same of e e.
    float weight;         ///< Sum of weights.
    float length_s;       ///< Time that is summed.
    float gravity_m_s2;   ///< Mean of |slow.g| ...
    float gravity_s;      ///< ... and its time, as far as it counts.
} jcal_health_scale_t;

/// Which way to read the rates fits.
typedef struct {
    int8_t turn[JCAL_HEALTH_BLOCKS][3];  ///< Blocks of the window: turns in units of 2^exponent rad ...
    int8_t acc[JCAL_HEALTH_BLOCKS][3];   ///< ... and specific forces in units of `unit`.
    int8_t exponent;
    uint8_t filled;  ///< Blocks in it.
    uint8_t way;     ///< Way that is tried ...
    uint8_t part;    ///< ... and the part of the window that is next.
    float unit;
    union {
        struct {
            jcal_vec3_t turn_rest, acc_rest;  ///< What rounding left out so far.
        } filling;
        struct {
            jcal_quat_t q;    ///< Orientation of the sensor, since the window began.
            jcal_vec3_t all;  ///< Sum of specific forces of the parts so far, in the frame of the window's begin ...
            float squares;    ///< ... and of the squares of each part's.
            float as_is;      ///< What rates as they stand leave open.
        } working;
    } of;                              ///< A window that is being filled, then worked at.
    uint16_t score[JCAL_HEALTH_WAYS];  ///< Sum over windows of what a way leaves open: jcal_health_frames_score.
    uint16_t trials;                   ///< Windows in which all ways were tried ...
    uint16_t fits;                     ///< ... and others that rates as they stand fit.
} jcal_health_frames_t;

/// One side of one component: where it stops.
typedef struct {
    uint16_t level;         ///< Where its flat peaks end.
    uint8_t hits, against;  ///< Flat peaks at the level, and what speaks against a stop there.
} jcal_health_rail_t;

/// The excursion of a component that is going on.
typedef struct {
    uint16_t peak;
    uint16_t base;      ///< Value from which on readings near the peak are counted.
    uint8_t top, side;  ///< Readings near that peak, and on the way down from it.
} jcal_health_peak_t;

/// Rates x, y, z, specific forces x, y, z.
typedef struct {
    jcal_health_rail_t rail[6][2];  ///< Upper side, lower side.
    jcal_health_peak_t peak[6];
    uint8_t is_out;    ///< Bits of the components that are on an excursion ...
    uint8_t is_lower;  ///< ... and of those whose last one was to the lower side.
} jcal_health_rails_t;

/// Values that stay, or that come more than once.
typedef struct {
    jcal_imu_t last;
    uint8_t stuck[6];                        ///< Readings in motion since the component changed.
    uint16_t moving;                         ///< Readings in motion, and those of them ...
    uint16_t acc_held, gyr_held, both_held;  ///< ... that repeat the specific force alone, the rate alone, or both.
    uint32_t same_us;                        ///< How long the whole reading has been the same ...
    uint32_t frozen_us;                      ///< ... and for how long at the most.
} jcal_health_values_t;

/// Rest of about a second.
typedef struct {
    jcal_vec3_t acc, gyr;  ///< Sums over its blocks.
    float acc2, gyr2;
    float count;
    float gravity_m_s2;  ///< Mean |acc| at rest, so far ...
    float rest_s;        ///< ... and its time.
} jcal_health_rest_t;

/// Distances of readings.
typedef struct {
    uint64_t last_us;
    float period_s, spread_s2;  ///< Mean, and mean square about it, of the last hundred or so.
    float longest_s;
    uint32_t readings, lost;
    uint16_t gaps;
    bool has_last;  ///< There was a reading.
} jcal_health_pace_t;

/// Rates that change from reading to reading.
typedef struct {
    jcal_vec3_t before[JCAL_HEALTH_BEFORE];  ///< The rates before the last one.
    float sum2, count, length_s;  ///< Of the stretch of a tenth of a second: what is fast; its readings and four ...
    float sum_rate2, sum_acc2, readings;  ///< ... rates, specific forces and readings.
    float quiet_rad_s;                    ///< Root mean square of what is fast, in the quietest tenth of the stretches.
    float stretches;
    float rate2, acc2;  ///< Mean squares of the rate and of the specific force ...
    float fast2;        ///< ... and of what is fast in the rate.
    float total;        ///< Readings in them.
    float motion_s;
} jcal_health_motion_t;

/// The health of one sensor. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_health_pace_t pace;
    jcal_health_block_t block;
    jcal_health_scale_t scale;
    jcal_health_frames_t frames;
    jcal_health_rails_t rails;
    jcal_health_values_t values;
    jcal_health_rest_t rest;
    jcal_health_motion_t motion;
    uint32_t rejected;
    bool is_ready;  ///< False: not prepared.
} jcal_health_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HEALTH_STATE_H */
