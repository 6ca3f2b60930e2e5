/* SPDX-License-Identifier: MIT */
/// @file
/// What is wrong with one sensor, as far as its own readings tell: gravity, dead, held and frozen values, clipping, frames, scale,
/// vibration, times.
///
/// How it is used:
///
///     static jcal_health_t thigh;
///     (void)jcal_health_init(&thigh);
///     (void)jcal_health_push(&thigh, &reading);          for each reading
///     jcal_health_result_t result;
///     (void)jcal_health_get(&thigh, &result);            whenever you like
///     if (result.state[JCAL_FINDING_CLIPPED] == JCAL_HEALTH_NAMED) { ... result.fact[JCAL_FINDING_CLIPPED] ... }
///
/// Nothing is named that the readings do not show: a finding is `unknown` until there was motion enough to tell. What is named may
/// be taken back when later readings show otherwise.
///
/// How frames and scale are told: gravity stays where it is, so with the right rates the specific force, turned back by them and averaged
/// over a second, is the same at all times, up to the change of the velocity in it. Windows of four seconds try all 48 ways to order and
/// sign the rates. The scale comes from what a low-pass of 2 s and one of 10 s of the force turned back differ by, with the
/// gyroscope's bias as a further unknown. No mounting and no joint is assumed.
///
/// What one sensor cannot tell: an accelerometer of which all three axes have the wrong sign. Readings of a sensor whose whole world is
/// mirrored through a point are the same but for that sign; only a second sensor, or knowledge of what is up, can tell.
///
/// Cost: 968 bytes of state. Counted on an emulated Cortex-M4F, a person's knee at 100 Hz: 880 instructions a reading in the mean, 510 in the
/// median, 3,500 at most (docs/measurements/budget.md); the mean is more where ways to read the rates have to be tried again and again.
/// Method: tools/python/jointcal_tools/health_reference.py. Limits: docs/measurements/sensor_health.md.
/// Units and frames: types.h. Threads: all calls on one sensor belong to one task, or behind the caller's lock.
#ifndef JCAL_HEALTH_H
#define JCAL_HEALTH_H

#include "jointcal/private/health/state.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What can be found. The number of each, `fact`, is 0 while nothing is known of it.
typedef enum {
    JCAL_FINDING_GAPS = 0,  ///< Readings are missing. Fact: their share, 0 to 1.
    JCAL_FINDING_UNEVEN,    ///< Times from reading to reading differ. Fact: their standard deviation, s.
    JCAL_FINDING_FROZEN,    ///< All values stood still. Fact: for how long at the most, s.
    JCAL_FINDING_HELD,      ///< Readings are repeated between new ones. Fact: how often each comes.
    JCAL_FINDING_DEAD,  ///< A component stays at one value while others move. Fact: its number, 1 to 6 (`dead` has all).
    JCAL_FINDING_CLIPPED,  ///< A component stops at a value again and again. Fact: the value, rad/s or m/s^2 (`clipped` has all).
    JCAL_FINDING_NO_GRAVITY,   ///< Gravity was taken out. Fact: what is left of it, m/s^2.
    JCAL_FINDING_GRAVITY_OFF,  ///< Gravity is not 9.81 within 6 %. Fact: what it is, m/s^2.
    JCAL_FINDING_RATE_UNIT,    ///< Rates are in deg/s. Fact: their root mean square, in what they are.
    JCAL_FINDING_FRAMES,  ///< Rates and forces are not in one right-handed frame. Fact: how much less the best way leaves open.
    JCAL_FINDING_SCALE,     ///< Gravity turns faster or slower than the rates say. Fact: how many times as fast.
    JCAL_FINDING_VIBRATES,  ///< Vibration all the time. Fact: its root mean square, rad/s.
    JCAL_FINDING_COUNT
} jcal_finding_t;

/// What is known of a finding.
typedef enum {
    JCAL_HEALTH_UNKNOWN = 0,  ///< The readings do not tell yet.
    JCAL_HEALTH_FINE = 1,     ///< They show that it is not so.
    JCAL_HEALTH_NAMED = 2     ///< They show that it is so.
} jcal_health_state_t;

/// What is known of a sensor.
typedef struct {
    jcal_health_state_t state[JCAL_FINDING_COUNT];
    float fact[JCAL_FINDING_COUNT];

    uint32_t readings;  ///< Readings taken in.
    uint32_t
        rejected;   ///< Readings with a value that is not finite or far too large, or a time that does not increase.
    float rate_hz;  ///< 0 if it is not known.
    uint32_t gaps;  ///< Stretches without a reading that are longer than 2.5 usual distances; stays at 65535.
    float longest_gap_s;  ///< The longest; 0 if there is none.
    float rest_s;         ///< Rest, the mean of which gravity was read from; else motion was.
    float rms_rad_s;      ///< Root mean square of the rate.
    float motion_s;       ///< Time in which the rate was above 0.3 rad/s.
    float scale_bound;    ///< 95 % bound of the scale's fact, as a share; 1 if it is not known.
    float fast_share;     ///< Share of the rate's power that is above a quarter or so of the readings' frequency.
    uint8_t dead;         ///< Bits 0 to 5: rates x, y, z, forces x, y, z that are dead ...
    uint16_t clipped;     ///< ... and clipped: bits 0 to 5 of the upper side, 6 to 11 of the lower side.
    bool way_known;       ///< With JCAL_FINDING_FRAMES: one way fits, and no other nearly as well.
    bool
        way_of_gyr;  ///< That way is one to read the rates; else one to read the forces. They may need the other sign all three.
    jcal_health_way_t way;
} jcal_health_result_t;

/// Prepares a sensor's health; whatever `self` held before is lost. Errors: JCAL_ERR_ARG (null).
JCAL_MUST_CHECK jcal_status_t jcal_health_init(jcal_health_t *self);

/// Takes in one reading.
///
/// Returns:  JCAL_OK; JCAL_REJECTED if a value is not finite, the rate or the specific force longer than 1e6, or the time does not increase; JCAL_ERR_ARG.
/// Cost:     bounded: six comparisons, a block's sums and one slice of a window's work, see above.
jcal_status_t jcal_health_push(jcal_health_t *self, const jcal_reading_t *reading);

/// Says what is known. Errors: JCAL_ERR_ARG; `out` is untouched then. Cost: bounded; solves a 4 x 4 system and reads all sums.
jcal_status_t jcal_health_get(const jcal_health_t *self, jcal_health_result_t *out);

/// `gravity_off`, `clipped`, ...; null for what is none. Threads: no state.
const char *jcal_finding_string(jcal_finding_t finding);
/// `unknown`, `fine`, `named`; never null. Threads: no state.
const char *jcal_health_string(jcal_health_state_t state);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HEALTH_H */
