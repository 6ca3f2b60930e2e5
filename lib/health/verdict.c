/* SPDX-License-Identifier: MIT */
/// @file
/// What is said of a sensor's health. See health.h.
#include "jointcal/health.h"

#include "health/frames.h"
#include "health/rails.h"
#include "health/scale.h"
#include "health/values.h"
#include "math/clear.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

#define READINGS_MIN 50u
/// Share of readings that may be missing; scatter of times as a share of their distance.
#define LOST_SHARE 0.01f
#define UNEVEN_SHARE 0.3f
#define FROZEN_S 2.0f
/// Motion after which dead and clipped are denied, s.
#define MOTION_MIN_S 5.0f
/// Gravity: usual, and share that it may be off by; time of it at rest and in motion, s; what is left of it where it was taken out.
#define GRAVITY_M_S2 9.81f
#define GRAVITY_SHARE 0.06f
#define REST_MIN_S 2.0f
#define GRAVITY_MIN_S 10.0f
#define NO_GRAVITY_M_S2 0.5f
#define NO_GRAVITY_SHARE 0.4f
#define NO_GRAVITY_MOVING_M_S2 6.0f
/// Rates whose root mean square is no person's, rad/s, and how much less rates in deg/s leave open.
#define RATE_UNIT_RAD_S 8.0f
#define RATE_UNIT_SHARE 0.5f
/// Frames: windows in which all ways were tried, what rates leave open in the mean and how many times as much as the best way, and the best way beside the next.
#define TRIALS_MIN 3u
#define TRIALS_CLEAR 2u
#define OPEN_TIMES_CLEAR 12.0f
#define OPEN_MIN 0.007f
#define OPEN_LEAST 1e-6f
#define OPEN_TIMES 4.0f
#define NEXT_TIMES 1.5f
/// It is enough if it leaves less by so much, and the next one does not.
#define OPEN_TIMES_ALONE 2.5f
#define NEXT_TIMES_ALONE 2.0f
/// Rates that fit leave less open than this in the mean, and any other way so many times as much.
#define OPEN_FINE 0.03f
#define FINE_TIMES 2.0f
/// Scale: 95 % bound as so many standard deviations and a floor, what MEMS gyroscopes are off by as they come; largest bound at which it is said.
#define DEVIATIONS 3.0f
#define SCALE_FLOOR 0.02f
#define SCALE_BOUND_MOST 0.045f
/// A scale that is far off is said with a wider one.
#define SCALE_FAR 0.15f
#define SCALE_BOUND_FAR 0.085f
/// Vibration that is named, rad/s, and its least part of all that is fast: impacts come and go, vibration stays. Stretches of a tenth of a second.
#define VIBRATION_RAD_S 0.027f
#define STEADY_SHARE 0.65f
#define STRETCHES_MIN 50.0f

typedef jcal_health_result_t result_t;

static void say(result_t *out, jcal_finding_t finding, bool is_known, bool is_so, float fact)
{
    if (is_known) {
        out->state[finding] = is_so ? JCAL_HEALTH_NAMED : JCAL_HEALTH_FINE;
        out->fact[finding] = fact;
    }
}

static bool is_named(const result_t *out, jcal_finding_t finding)
{
    return out->state[finding] == JCAL_HEALTH_NAMED;
}

static void judge_times(const jcal_health_t *self, result_t *out)
{
    const jcal_health_pace_t *const pace = &self->pace;
    const bool is_known = pace->readings >= READINGS_MIN;
    const float lost = (float)pace->lost / jcal_max((float)pace->lost + (float)pace->readings, 1.0f);
    const float spread_s = sqrtf(jcal_max(pace->spread_s2, 0.0f));
    out->rate_hz = (is_known && (pace->period_s > 0.0f)) ? (1.0f / pace->period_s) : 0.0f;
    out->gaps = pace->gaps;
    out->longest_gap_s = pace->longest_s;
    say(out, JCAL_FINDING_GAPS, is_known, lost > LOST_SHARE, lost);
    say(out, JCAL_FINDING_UNEVEN, is_known, spread_s > (UNEVEN_SHARE * pace->period_s), spread_s);
}

static void judge_values(const jcal_health_t *self, result_t *out)
{
    const bool has_moved = self->motion.motion_s >= MOTION_MIN_S;
    const float frozen_s = 1e-6f * (float)self->values.frozen_us;
    const float times = jcal_health_values_times(&self->values);
    out->dead = jcal_health_values_dead(&self->values);
    say(out, JCAL_FINDING_FROZEN, has_moved || (frozen_s >= FROZEN_S), frozen_s >= FROZEN_S, frozen_s);
    say(out, JCAL_FINDING_HELD, times > 0.0f, times > 1.0f, times);
    float first = 0.0f;
    for (unsigned k = 6u; k > 0u; --k) {
        first = ((out->dead & (1u << (k - 1u))) != 0u) ? (float)k : first;
    }
    say(out, JCAL_FINDING_DEAD, has_moved || (first > 0.0f), first > 0.0f, first);
}

static void judge_rails(const jcal_health_t *self, result_t *out)
{
    float level = 0.0f;
    unsigned bits = 0u;
    for (unsigned k = 0u; k < 12u; ++k) {
        const jcal_health_rail_t *const rail = &self->rails.rail[k % 6u][k / 6u];
        if (jcal_health_rail_clips(rail)) {
            level = (bits == 0u) ? jcal_health_rail_level(rail, k % 6u) : level;
            bits |= 1u << k;
        }
    }
    out->clipped = (uint16_t)bits;
    say(out, JCAL_FINDING_CLIPPED, (self->motion.motion_s >= MOTION_MIN_S) || (bits != 0u), bits != 0u, level);
}

/// The way of the forces that does what way M of the rates does: M' a, up to the sign, with as few signs turned round as can be.
static jcal_health_way_t of_forces(const jcal_health_way_t *rates)
{
    jcal_health_way_t way;
    int signs = 0;
    for (int k = 0; k < 3; ++k) {
        way.column[rates->column[k]] = (int8_t)k;
        way.sign[rates->column[k]] = rates->sign[k];
        signs += rates->sign[k];
    }
    for (int k = 0; (k < 3) && (signs < 0); ++k) {
        way.sign[k] = (int8_t)-way.sign[k];
    }
    return way;
}

/// True if the way keeps a right-handed frame.
static bool is_right_handed(const jcal_health_way_t *way)
{
    const bool is_even = ((way->column[1] - way->column[0]) == 1) || ((way->column[1] - way->column[0]) == -2);
    const int signs = way->sign[0] * way->sign[1] * way->sign[2];
    return (signs > 0) == is_even;
}

/// What windows leave open in the mean, with rates as they stand.
static float mean_open(const jcal_health_frames_t *frames)
{
    const float windows = (float)frames->trials + (float)frames->fits;
    const float open = jcal_health_frames_score(frames, JCAL_HEALTH_AS_IS) + (JCAL_HEALTH_OPEN * (float)frames->fits);
    return (windows >= (float)TRIALS_MIN) ? (open / windows) : 1.0f;
}

static void judge_frames(const jcal_health_t *self, result_t *out)
{
    const jcal_health_frames_t *const frames = &self->frames;
    float next = 0.0f;
    const unsigned best = jcal_health_frames_best(frames, &next);
    const float least = jcal_health_frames_score(frames, best);
    const float as_is = jcal_health_frames_score(frames, JCAL_HEALTH_AS_IS);
    const float mean = as_is / jcal_max((float)frames->trials, 1.0f);
    const bool is_clear = (frames->trials >= TRIALS_CLEAR) && (as_is > (OPEN_TIMES_CLEAR * least));
    const bool is_tried = (frames->trials >= TRIALS_MIN) || is_clear;
    const bool is_deg = is_tried && (out->rms_rad_s > RATE_UNIT_RAD_S) &&
                        (jcal_health_frames_score(frames, JCAL_HEALTH_DEG) < (RATE_UNIT_SHARE * as_is));
    const float times = as_is / jcal_max(least, OPEN_LEAST);
    const bool stands_out = (times > OPEN_TIMES_ALONE) && (next > (NEXT_TIMES_ALONE * least));
    const bool is_other = is_tried && !is_deg && (mean > OPEN_MIN) && ((times > OPEN_TIMES) || stands_out);
    const bool is_right =
        is_tried && !is_deg && (best == JCAL_HEALTH_AS_IS) && (mean < OPEN_FINE) && (next > (FINE_TIMES * as_is));
    say(out, JCAL_FINDING_RATE_UNIT, is_deg || is_right, is_deg, out->rms_rad_s);
    say(out, JCAL_FINDING_FRAMES, is_other || is_right, is_other, is_other ? times : 1.0f);
    if (is_other) {
        const jcal_health_way_t way = jcal_health_frames_way(best);
        out->way_known = next > (NEXT_TIMES * least);
        out->way_of_gyr = !is_right_handed(&way);
        out->way = out->way_of_gyr ? way : of_forces(&way);
    }
}

/// True if what follows from rates and forces together is right: they fit each other, and no value is spoilt.
static bool rates_fit(const jcal_health_t *self, const result_t *out)
{
    return !is_named(out, JCAL_FINDING_FRAMES) && !is_named(out, JCAL_FINDING_RATE_UNIT) &&
           !is_named(out, JCAL_FINDING_CLIPPED) && !is_named(out, JCAL_FINDING_DEAD) &&
           !is_named(out, JCAL_FINDING_HELD) && (mean_open(&self->frames) < OPEN_FINE);
}

/// Without gravity no window fits, so that is judged first.
static void judge_gravity(const jcal_health_t *self, result_t *out)
{
    const bool rests = self->rest.rest_s >= REST_MIN_S;
    const bool moves = (self->scale.gravity_s >= GRAVITY_MIN_S) && !is_named(out, JCAL_FINDING_FRAMES) &&
                       !is_named(out, JCAL_FINDING_RATE_UNIT);
    const float gravity = rests ? self->rest.gravity_m_s2 : self->scale.gravity_m_s2;
    const float rms = sqrtf(jcal_max(self->motion.acc2, 0.0f));
    const bool is_none = rests ? (gravity < NO_GRAVITY_M_S2)
                               : ((gravity < (NO_GRAVITY_SHARE * rms)) && (gravity < NO_GRAVITY_MOVING_M_S2));
    const bool is_told = rests || (moves && rates_fit(self, out));
    out->rest_s = self->rest.rest_s;
    say(out, JCAL_FINDING_NO_GRAVITY, rests || moves, is_none, gravity);
    say(out, JCAL_FINDING_GRAVITY_OFF, is_told && !is_none,
        !jcal_within(gravity, GRAVITY_M_S2 * (1.0f - GRAVITY_SHARE), GRAVITY_M_S2 * (1.0f + GRAVITY_SHARE)), gravity);
}

static void judge_scale(const jcal_health_t *self, result_t *out)
{
    const jcal_health_scale_found_t found = jcal_health_scale_solve(&self->scale);
    const float bound = (DEVIATIONS * found.deviation) + SCALE_FLOOR;
    const float off = fabsf(found.scale - 1.0f);
    const bool is_known = rates_fit(self, out) && !is_named(out, JCAL_FINDING_NO_GRAVITY) &&
                          (bound <= ((off > SCALE_FAR) ? SCALE_BOUND_FAR : SCALE_BOUND_MOST));
    out->scale_bound = is_known ? bound : 1.0f;
    say(out, JCAL_FINDING_SCALE, is_known, off > bound, found.scale);
}

static void judge_motion(const jcal_health_t *self, result_t *out)
{
    const jcal_health_motion_t *const motion = &self->motion;
    out->rms_rad_s = sqrtf(jcal_max(motion->rate2, 0.0f));
    out->motion_s = motion->motion_s;
    out->fast_share = (motion->rate2 > 0.0f) ? jcal_min(motion->fast2 / motion->rate2, 1.0f) : 0.0f;
}

static void judge_vibration(const jcal_health_t *self, result_t *out)
{
    const jcal_health_motion_t *const motion = &self->motion;
    const bool is_known = (motion->stretches >= STRETCHES_MIN) && !is_named(out, JCAL_FINDING_HELD) &&
                          !is_named(out, JCAL_FINDING_RATE_UNIT);
    const float all_rad_s = sqrtf(jcal_max(motion->fast2, 0.0f));
    const bool is_steady = motion->quiet_rad_s > (STEADY_SHARE * all_rad_s);
    say(out, JCAL_FINDING_VIBRATES, is_known, is_steady && (motion->quiet_rad_s > VIBRATION_RAD_S),
        motion->quiet_rad_s);
}

jcal_status_t jcal_health_get(const jcal_health_t *self, jcal_health_result_t *out)
{
    if ((self == NULL) || (out == NULL) || !self->is_ready) {
        return JCAL_ERR_ARG;
    }
    jcal_clear(out, sizeof *out);
    out->readings = self->pace.readings + (self->pace.has_last ? 1u : 0u);
    out->rejected = self->rejected;
    judge_times(self, out);
    judge_values(self, out);
    judge_motion(self, out);
    judge_rails(self, out);
    judge_frames(self, out);
    judge_gravity(self, out);
    judge_scale(self, out);
    judge_vibration(self, out);
    return JCAL_OK;
}

const char *jcal_finding_string(jcal_finding_t finding)
{
    static const char *const words[JCAL_FINDING_COUNT] = {"gaps",      "uneven",  "frozen",     "held",
                                                          "dead",      "clipped", "no_gravity", "gravity_off",
                                                          "rate_unit", "frames",  "scale",      "vibrates"};
    return ((unsigned)finding < (unsigned)JCAL_FINDING_COUNT) ? words[finding] : NULL;
}

const char *jcal_health_string(jcal_health_state_t state)
{
    switch (state) {
    case JCAL_HEALTH_FINE:
        return "fine";
    case JCAL_HEALTH_NAMED:
        return "named";
    case JCAL_HEALTH_UNKNOWN:
    default:
        return "unknown";
    }
}
