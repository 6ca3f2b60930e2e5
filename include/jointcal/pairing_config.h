/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of the pairing. Start from jcal_pairing_config_default().
#ifndef JCAL_PAIRING_CONFIG_H
#define JCAL_PAIRING_CONFIG_H

#ifdef __cplusplus
extern "C" {
#endif

/// Readings of one sensor that may wait for those of the other one, in periods: 32 are 320 ms at the default period. A lag that is taken off
/// counts: the sensor whose times were early waits that much longer.
#ifndef JCAL_PAIRING_WAITING
#define JCAL_PAIRING_WAITING 32u
#endif
#if ((JCAL_PAIRING_WAITING) < 2) || ((JCAL_PAIRING_WAITING) > 1024)
#error "JCAL_PAIRING_WAITING must be 2 to 1024"
#endif

/// Settings of the pairing.
typedef struct {
    /// Time from one pair to the next, s, in whole microseconds. Range [0.004, 0.05], default 0.01. Longer: less work, and more waiting is
    /// borne; what is faster than a few Hz is cut off.
    float period_s;
    /// Longest distance of two readings of a sensor between which is interpolated, s. Range [0.005, 0.1], default 0.1: joints go on over
    /// 105 ms. Shorter: fewer made-up pairs where packets are lost, more beginnings.
    float gap_s;
} jcal_pairing_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_pairing_config_t jcal_pairing_config_default(void);

/// Name of the first field that is out of its range, "config" for null, or null if the config is valid.
/// Threads:  no state.
const char *jcal_pairing_config_check(const jcal_pairing_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PAIRING_CONFIG_H */
