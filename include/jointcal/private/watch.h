/* SPDX-License-Identifier: MIT */
/// @file
/// Layout of what notices that a sensor has moved. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_WATCH_H
#define JCAL_PRIVATE_WATCH_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Residuals of two kinds, squared, in units of what the config takes for usual.
typedef struct {
    float recent[2];  ///< Mean over the last 1.5 s of motion.
    float usual[2];   ///< Mean over the last 20 s of motion since the calibration was ready.
    float seen_s[2];  ///< How much motion that is, at most 20 s; until it is on, free for what counts then.
    bool on;          ///< There is a calibration that was ready.
} jcal_watch_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_WATCH_H */
