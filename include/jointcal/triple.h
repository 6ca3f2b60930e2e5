/* SPDX-License-Identifier: MIT */
/// @file
/// Readings of the three IMUs on pelvis, thigh and shank, and the four vectors that hip and knee have in their frames.
#ifndef JCAL_TRIPLE_H
#define JCAL_TRIPLE_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Simultaneous readings of the three IMUs: 1 pelvis, 2 thigh, 3 shank.
typedef struct {
    uint64_t t_us;  ///< Time in microseconds, any origin, strictly increasing.
    jcal_imu_t imu1, imu2, imu3;
} jcal_triple_t;

/// The four vectors of hip and knee.
typedef enum {
    JCAL_CHAIN_HIP_TO_PELVIS = 0,  ///< From the hip's centre to sensor 1, in sensor frame 1.
    JCAL_CHAIN_HIP_TO_THIGH = 1,   ///< From the hip's centre to sensor 2, in sensor frame 2.
    JCAL_CHAIN_KNEE_TO_THIGH = 2,  ///< From the knee's centre to sensor 2, in sensor frame 2.
    JCAL_CHAIN_KNEE_TO_SHANK = 3   ///< From the knee's centre to sensor 3, in sensor frame 3.
} jcal_chain_place_t;
#define JCAL_CHAIN_PLACES 4

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TRIPLE_H */
