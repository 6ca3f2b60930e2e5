/* SPDX-License-Identifier: MIT */
/// @file
/// One row of a recording.
#ifndef JCAL_CLI_INPUT_ROW_H
#define JCAL_CLI_INPUT_ROW_H

#include "jointcal/types.h"

typedef enum {
    RECORDING_ROW,    ///< A row was read.
    RECORDING_END,    ///< There are no more rows.
    RECORDING_BAD,    ///< The file is no recording: see fault.
    RECORDING_FAILED  ///< It could not be read to the end, or memory ran out.
} recording_event_t;

/// One row. Empty cells are NaN; cells that are not finite, or too large for a float, are NaN or infinite.
typedef struct {
    bool has_time;  ///< False if the time is empty or not finite.
    int64_t t_us;   ///< As in the file, from whatever origin.
    double t_s;     ///< The same in double, without limits; NaN if the time is empty or not finite.
    jcal_imu_t imu1;
    jcal_imu_t imu2;
    jcal_imu_t imu3;  ///< All zero unless wanted.
    jcal_quat_t q1;   ///< Sensor to earth; all zero unless wanted.
    jcal_quat_t q2;
    jcal_quat_t q3;  ///< Zero unless the third sensor is wanted too.
} recording_row_t;

#endif
