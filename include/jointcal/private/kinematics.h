/* SPDX-License-Identifier: MIT */
/// @file
/// State of what turns readings into angular accelerations. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_KINEMATICS_H
#define JCAL_PRIVATE_KINEMATICS_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Mean readings over one bin of about 20 ms.
typedef struct {
    jcal_imu_t imu1, imu2;
    jcal_attitudes_t attitudes;
    uint32_t t_us;  ///< Middle of the bin, low half of the time.
} jcal_bin_t;

/// One body at one time, in a frame of its own: its sensor's, one that does not turn, or its earth frame.
typedef struct {
    jcal_vec3_t a;        ///< Specific force of the sensor, m/s^2.
    jcal_vec3_t k[3];     ///< Columns of K, 1/s^2: for vectors in the sensor's frame.
    jcal_vec3_t turn[3];  ///< Columns of the matrix that turns vectors from the sensor's frame.
    float rate2;          ///< |w|^2, (rad/s)^2.
} jcal_segment_t;

/// Both bodies.
typedef struct {
    jcal_segment_t body1, body2;
} jcal_bodies_t;

/// Both bodies at one time.
typedef struct {
    jcal_segment_t body1, body2;
    uint64_t t_us;
    float dt_s;  ///< The time it stands for.
} jcal_kinematic_t;

/// Bins that a derivative needs.
#define JCAL_BINS 5u

/// Blocks that smoothing takes.
#define JCAL_BLOCKS 4u

/// The last bins without a hole.
typedef struct {
    jcal_bin_t ring[JCAL_BINS];
    jcal_bin_t sum;      ///< Of the bin that is being filled.
    float interval_s;    ///< Distance of the samples when the chain began.
    uint64_t last_us;    ///< Time of the last sample.
    uint64_t begin_us;   ///< Time of the first sample in the bin.
    uint8_t in_bin;      ///< Samples in it ...
    uint8_t per_bin;     ///< ... and how many it takes.
    uint8_t filled;      ///< Bins in the ring.
    uint8_t next;        ///< Where the next one goes.
    uint8_t per_block;   ///< Bins that a block takes.
    uint8_t in_block;    ///< Bins in the block ...
    uint8_t blocks;      ///< ... blocks in `block` ...
    uint8_t next_block;  ///< ... and where the next one goes.
    bool has_middle;
    uint32_t middle_us;            ///< Time of the middle bin ...
    jcal_vec3_t middle1, middle2;  ///< ... its rates, rad/s ...
    jcal_quat_t turn1, turn2;      ///< ... and how both frames turn to where they were when the blocks began.
    jcal_bodies_t
        block[JCAL_BLOCKS];  ///< Sums over the bins of a block; the one being filled takes the place of the oldest.
} jcal_kinematics_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_KINEMATICS_H */
