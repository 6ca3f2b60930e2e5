/* SPDX-License-Identifier: MIT */
/// @file
/// Scales of chips by their data sheets. See chips.h.
///
/// | chip | document | where |
/// |---|---|---|
/// | LSM6DSV | ST DS13476 | table 2, mechanical characteristics: LA_So 0.061 to 0.488 mg/LSB, G_So 4.375 to 140 mdps/LSB |
/// | BMI270 | Bosch BST-BMI270-DS000 | electrical specification: 16,384 to 2,048 LSB/g, 262.4 to 16.4 LSB/dps |
/// | ICM-42688 | TDK DS-000347 | tables 1 and 2: 16.4 to 2,097.2 LSB/dps, 2,048 to 16,384 LSB/g |
/// | ICM-20948 | TDK DS-000189 revision 1.3 | table 1: 131 to 16.4 LSB/dps; table 2: 16,384 to 2,048 LSB/g |
/// | BNO08x | 1000-3927 and the SH-2 reference manual | calibrated gyroscope: rad/s, Q point 9; accelerometer: m/s^2, Q point 8 |
/// | BHI260 | Bosch BST-BHI260AP-DS000 | electrical specification: 16.4 LSB/dps at 2000 deg/s, 4,096 LSB/g at 8 g |
/// | MPU6050 | InvenSense RM-MPU-6000A-00 revision 4.2 | registers 67 to 72: 131 to 16.4 LSB/dps; 59 to 64: 16,384 to 2,048 LSB/g |
///
/// The tables of ICM-20948 and MPU6050 (gyroscope) were read in the document, the others where vendors and drivers quote them.
///
/// Where a sheet prints 131, 65.5, 32.8, 16.4 LSB/dps (Bosch: multiples of 16.4) the full scale is 2^15 steps, which is what they round:
/// 16.384 at 2000 deg/s. The difference, 0.1 %, is a tenth and less of the sheets' tolerance. ST's steps are no such share: 2000 deg/s
/// are 28,571 steps, and the output goes on to 32,767. SH-2 reports have one scale whatever the range; there 8 g and 2000 deg/s are the rail.
#include "jointcal/chips.h"

#include "math/angle.h"

#include <stdbool.h>
#include <stddef.h>

#define GRAVITY_M_S2 9.80665f
#define FULL_SCALE 32768.0f
#define RAIL 32767

/// Most ranges of one sensor.
#define GYR_RANGES 8u
#define ACC_RANGES 4u
/// More than any name has.
#define NAME_LENGTH 16u

/// One chip. Ranges from the largest down, then zeros; a step is in proportion to the range.
typedef struct {
    const char *name;
    float gyr_deg_s[GYR_RANGES];
    float acc_g[ACC_RANGES];
    jcal_scale_t scale;  ///< At the largest ranges.
} chip_t;

#define SHARE_OF(gyr_deg_s, acc_g)                                                                                     \
    {                                                                                                                  \
        ((gyr_deg_s)*JCAL_RAD_PER_DEG) / FULL_SCALE, ((acc_g)*GRAVITY_M_S2) / FULL_SCALE, RAIL, RAIL                   \
    }

static const chip_t CHIPS[] = {
    {"LSM6DSV",
     {4000.0f, 2000.0f, 1000.0f, 500.0f, 250.0f, 125.0f},
     {16.0f, 8.0f, 4.0f, 2.0f},
     {0.140f * JCAL_RAD_PER_DEG, 0.488e-3f * GRAVITY_M_S2, RAIL, RAIL}},
    {"BMI270", {2000.0f, 1000.0f, 500.0f, 250.0f, 125.0f}, {16.0f, 8.0f, 4.0f, 2.0f}, SHARE_OF(2000.0f, 16.0f)},
    {"ICM-42688",
     {2000.0f, 1000.0f, 500.0f, 250.0f, 125.0f, 62.5f, 31.25f, 15.625f},
     {16.0f, 8.0f, 4.0f, 2.0f},
     SHARE_OF(2000.0f, 16.0f)},
    {"ICM-20948", {2000.0f, 1000.0f, 500.0f, 250.0f}, {16.0f, 8.0f, 4.0f, 2.0f}, SHARE_OF(2000.0f, 16.0f)},
    {"BNO08x", {2000.0f}, {8.0f}, {1.0f / 512.0f, 1.0f / 256.0f, 17872, 20084}},
    {"BHI260", {2000.0f, 1000.0f, 500.0f, 250.0f, 125.0f}, {16.0f, 8.0f, 4.0f, 2.0f}, SHARE_OF(2000.0f, 16.0f)},
    {"MPU6050", {2000.0f, 1000.0f, 500.0f, 250.0f}, {16.0f, 8.0f, 4.0f, 2.0f}, SHARE_OF(2000.0f, 16.0f)},
};

/// C's strcmp would be a call of the C library, which the library makes none of.
static bool is_same(const char *a, const char *b)
{
    size_t k = 0u;
    while ((k < NAME_LENGTH) && (a[k] != '\0') && (a[k] == b[k])) {
        k++;
    }
    return (k < NAME_LENGTH) && (a[k] == b[k]);
}

/// Null if there is none.
static const chip_t *find(const char *name)
{
    for (size_t k = 0u; k < (sizeof CHIPS / sizeof CHIPS[0]); ++k) {
        if (is_same(CHIPS[k].name, name)) {
            return &CHIPS[k];
        }
    }
    return NULL;
}

/// NaN and zero are no range.
static bool is_listed(const float *ranges, size_t count, float range)
{
    for (size_t k = 0u; k < count; ++k) {
        if ((range > 0.0f) && (ranges[k] >= range) && (ranges[k] <= range)) {
            return true;
        }
    }
    return false;
}

const char *jcal_chip_check(const char *name, float gyr_range_deg_s, float acc_range_g)
{
    const chip_t *const chip = (name != NULL) ? find(name) : NULL;
    if (chip == NULL) {
        return "name";
    }
    if (!is_listed(chip->gyr_deg_s, GYR_RANGES, gyr_range_deg_s)) {
        return "gyr_range_deg_s";
    }
    return is_listed(chip->acc_g, ACC_RANGES, acc_range_g) ? NULL : "acc_range_g";
}

jcal_status_t jcal_chip_scale(const char *name, float gyr_range_deg_s, float acc_range_g, jcal_scale_t *out)
{
    if ((name == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    const chip_t *const chip = find(name);
    if ((chip == NULL) || (jcal_chip_check(name, gyr_range_deg_s, acc_range_g) != NULL)) {
        return JCAL_ERR_CONFIG;
    }
    *out = chip->scale;
    out->gyr_rad_s *= gyr_range_deg_s / chip->gyr_deg_s[0]; /* a power of two: exact */
    out->acc_m_s2 *= acc_range_g / chip->acc_g[0];
    return JCAL_OK;
}
