/* SPDX-License-Identifier: MIT */
/// @file
/// State of the pairing. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_PAIRING_STREAM_H
#define JCAL_PRIVATE_PAIRING_STREAM_H

#include "jointcal/pairing_config.h"
#include "jointcal/private/clock.h"
#include "jointcal/types.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The last reading of a sensor.
typedef struct {
    jcal_clock_t clock;
    uint64_t t_us;  ///< Its time, less the lag that is taken off ...
    uint64_t next;  ///< ... and the number of the first common time after it.
    jcal_imu_t imu;
    bool has_last;
} jcal_pairing_sensor_t;

/// The stretch between the last two readings of a sensor, as far as it is not used yet.
typedef struct {
    uint64_t from_us;  ///< Time of the first one.
    uint64_t next;     ///< Number of the next common time in it ...
    uint64_t end;      ///< ... and of the first one that is not.
    float length_us;
    jcal_imu_t before;  ///< The first reading; the second one is the sensor's last.
    uint8_t sensor;     ///< Whose: 0 or 1.
} jcal_pairing_stretch_t;

/// The pairing. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_pairing_config_t cfg;
    jcal_pairing_sensor_t sensor[2];
    jcal_pairing_stretch_t stretch;
    jcal_imu_t waiting[JCAL_PAIRING_WAITING];  ///< A ring: one sensor at common times, before the other one got there.
    uint32_t numbers[JCAL_PAIRING_WAITING];    ///< Their common times: the lower half of the numbers.
    uint64_t begin;                            ///< No pair before this number.
    uint64_t past;                             ///< One more than the number of the last pair that was handed out.
    int64_t shift_us;                          ///< Lag that is taken off sensor 2's times.
    uint32_t period_us;                        ///< Common times are its multiples; 0: not prepared.
    uint32_t pairs, rejected;
    uint32_t lost[2];       ///< Common times that only one sensor told of.
    uint16_t first, count;  ///< Of those that wait.
    uint8_t ahead;          ///< Sensor that they are of: 0 or 1.
} jcal_pairing_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_PAIRING_STREAM_H */
