/* SPDX-License-Identifier: MIT */
/// @file
/// Why samples are not used.
#ifndef JCAL_REJECT_H
#define JCAL_REJECT_H

#include "jointcal/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Why a sample was not used; one cause counts: not finite, else time, else the first of the others. Also the index of its counter.
///
/// One wild time stamp costs one sample. Time that goes back is believed once samples have gone on from each other for 0.4 s: those
/// are `time_order`, the one at which it is believed is a `gap`, and the calibration is kept.
typedef enum {
    JCAL_REJECT_NOT_FINITE = 0,    ///< A value is NaN or infinite.
    JCAL_REJECT_OUT_OF_RANGE = 1,  ///< Beyond what a sensor can read, or wrong units.
    JCAL_REJECT_SATURATED = 2,     ///< A component stands at its extreme: clipped.
    JCAL_REJECT_FROZEN = 3,        ///< A sensor, or a component while the others move, has stood for too long.
    JCAL_REJECT_REPEATED = 4,      ///< A sensor repeats its previous reading: a lost packet.
    JCAL_REJECT_TIME_ORDER = 5,    ///< Time did not increase.
    JCAL_REJECT_GAP = 6,           ///< First sample after a hole in time.
    JCAL_REJECT_COUNT = 7,         ///< Number of causes.
    JCAL_REJECT_NONE = 7           ///< The sample was accepted.
} jcal_reject_t;

/// Name as used in `rejected_by`: `not_finite`, `out_of_range`, ...; `accepted` for JCAL_REJECT_NONE; never null.
const char *jcal_reject_string(jcal_reject_t reject);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_REJECT_H */
