/* SPDX-License-Identifier: MIT */
/// @file
/// Plain data types, units and frames: the words that every other header uses.
///
///       proximal segment (a thigh, say)             distal segment (a shank)
///     ------------[ sensor 1 ]------------( o )------------[ sensor 2 ]------------
///                       <------- r1 -------  ------- r2 ------->
///
/// - Sensor 1 sits on the proximal segment, sensor 2 on the distal one; each anywhere, turned in any way.
/// - o is the joint. r1 and r2 lead from it to the sensors, in m; r1 is given in sensor frame 1, r2 in sensor frame 2.
/// - j1 and j2 are the joint's axes, unit vectors: j1 in sensor frame 1, j2 in sensor frame 2. A hinge has one axis, seen by both.
/// - Rates are in rad/s, specific forces in m/s^2: a sensor at rest reads +9.81 on the axis that points up.
/// - Time is in microseconds from any origin. Angles are in rad, lengths in m. A clock that goes back, as 32-bit microseconds after
///   71.6 minutes, is believed after 0.4 s; what was found is kept.
/// - Earth frames have z up. Orientations without a magnetometer have a heading of their own each: E1 and E2. The heading offset
///   turns E2 to E1 about z.
///
/// Threads. Every estimator is a struct of the caller, and nothing is shared between two of them. Of one estimator two calls may run at
/// the same time: one push, in an interrupt, another task or on another core, and one of step, get or update's other verbs. They hand
/// samples over without a lock: 16-bit loads and stores must be atomic, JCAL_BARRIER of config.h keeps their order, and no call waits.
/// All other calls on one estimator belong to one task, or behind the caller's lock: two pushes (of two interrupts, say) must not
/// preempt each other, nor may step and get; update is push and step in one, so nothing may push beside it. The counters that get
/// reports may be one push behind each other if a push preempts it. init, reset and attach write everything: keep push out meanwhile,
/// by a masked interrupt or a flag that the producer looks at; a push that preempts them may be lost or leave a wrong count.
#ifndef JCAL_TYPES_H
#define JCAL_TYPES_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A 3-vector; the name of the variable says in which frame.
typedef struct {
    float x, y, z;
} jcal_vec3_t;

/// A unit quaternion (w, x, y, z). `q_a_b` rotates a vector from frame A to frame B: v_b = q v_a q*.
typedef struct {
    float w, x, y, z;
} jcal_quat_t;

/// One reading of one IMU in its own sensor frame.
typedef struct {
    jcal_vec3_t gyr_rad_s;  ///< Angular rate.
    jcal_vec3_t acc_m_s2;   ///< Specific force: at rest 9.81 upward.
} jcal_imu_t;

/// One reading and its time.
typedef struct {
    uint64_t t_us;  ///< Time in microseconds, any origin, strictly increasing.
    jcal_imu_t imu;
} jcal_reading_t;

/// Simultaneous readings of the two IMUs of a joint: 1 on the proximal segment, 2 on the distal one.
typedef struct {
    uint64_t t_us;  ///< Time in microseconds, any origin, strictly increasing.
    jcal_imu_t imu1;
    jcal_imu_t imu2;
} jcal_pair_t;

/// Simultaneous orientations of the two IMUs of a joint: 1 on the proximal segment, 2 on the distal one.
typedef struct {
    uint64_t t_us;   ///< Time in microseconds, any origin, strictly increasing.
    jcal_quat_t q1;  ///< Sensor 1 to its earth frame E1.
    jcal_quat_t q2;  ///< Sensor 2 to its earth frame E2.
} jcal_orientation_pair_t;

/// Orientations of the two IMUs of a joint, each to its own earth frame; all zero if there are none.
typedef struct {
    jcal_quat_t q1, q2;
} jcal_attitudes_t;

/// A heading offset.
typedef struct {
    float heading_rad;  ///< delta, in [-pi, pi]; 0 while it is not known.
    bool known;         ///< The data of this moment tell it, or data before did and none since tell otherwise.
} jcal_heading_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TYPES_H */
