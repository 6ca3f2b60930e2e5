/* SPDX-License-Identifier: MIT */
/// @file
/// What one step of a chip's 16-bit output is worth, for common chips, by name and full-scale ranges.
///
///     jcal_scale_t scale;
///     if (jcal_chip_scale("LSM6DSV", 2000.0f, 16.0f, &scale) != JCAL_OK) {
///         puts(jcal_chip_check("LSM6DSV", 2000.0f, 16.0f));      what is wrong: "name", "gyr_range_deg_s" or "acc_range_g"
///     }
///
/// | name | gyroscope, deg/s | accelerometer, g |
/// |---|---|---|
/// | LSM6DSV | 4000, 2000, 1000, 500, 250, 125 | 16, 8, 4, 2 |
/// | BMI270 | 2000, 1000, 500, 250, 125 | 16, 8, 4, 2 |
/// | ICM-42688 | 2000, 1000, 500, 250, 125, 62.5, 31.25, 15.625 | 16, 8, 4, 2 |
/// | ICM-20948 | 2000, 1000, 500, 250 | 16, 8, 4, 2 |
/// | BNO08x | 2000 | 8 |
/// | BHI260 | 2000, 1000, 500, 250, 125 | 16, 8, 4, 2 |
/// | MPU6050 | 2000, 1000, 500, 250 | 16, 8, 4, 2 |
///
/// A chip's own error of scale, 0.5 to 3 % by those sheets, is not in these numbers. lib/packet/chips.c names the data sheets.
#ifndef JCAL_CHIPS_H
#define JCAL_CHIPS_H

#include "jointcal/status.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What raw readings mean.
typedef struct {
    float gyr_rad_s;   ///< Rate of one step of the gyroscope's output, rad/s.
    float acc_m_s2;    ///< Specific force of one step of the accelerometer's output, m/s^2.
    int16_t gyr_rail;  ///< Largest raw value of the gyroscope, at which it is clipped.
    int16_t acc_rail;  ///< Largest raw value of the accelerometer.
} jcal_scale_t;

/// Which argument of jcal_chip_scale is not in the table above: "name", "gyr_range_deg_s" or "acc_range_g", the first one; null if all are.
/// Threads:  no state.
const char *jcal_chip_check(const char *name, float gyr_range_deg_s, float acc_range_g);

/// Looks a chip up. Names as in the table, exactly; ranges as there.
///
/// Outputs:  out; untouched on error.
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_chip_check says which argument).
/// Threads:  no state.
JCAL_MUST_CHECK jcal_status_t jcal_chip_scale(const char *name, float gyr_range_deg_s, float acc_range_g,
                                              jcal_scale_t *out);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_CHIPS_H */
