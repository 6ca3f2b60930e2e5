/* SPDX-License-Identifier: MIT */
/* The library's enumerators in words. */
#include "words.h"

#include "hinge_summary.h"

#include <inttypes.h>

static double degrees(float rad)
{
    return (double)(DEG_PER_RAD * rad);
}

const char *status_words(jcal_calibration_t status)
{
    switch (status) {
    case JCAL_READY:
        return "ready";
    case JCAL_AMBIGUOUS:
        return "not ready, because more than one answer fits";
    case JCAL_MOVED:
        return "not ready any more: a sensor has moved";
    case JCAL_COLLECTING:
    default:
        return "not ready";
    }
}

const char *reason_words(jcal_reason_t reason)
{
    switch (reason) {
    case JCAL_REASON_NO_DATA:
        return "too few usable samples";
    case JCAL_REASON_NO_MOTION:
        return "the segments hardly turn against each other";
    case JCAL_REASON_UNCERTAIN:
        return "an axis is not known well enough";
    case JCAL_REASON_SIGN_OPEN:
        return "both sign pairings explain the data about equally";
    case JCAL_REASON_OTHER_MINIMUM:
        return "other axes explain the data about equally";
    case JCAL_REASON_DOES_NOT_FIT:
        return "no joint of this kind explains the data: another kind, or sensors that share none";
    case JCAL_REASON_BAD_SAMPLES:
        return "too many samples are rejected";
    case JCAL_REASON_WRONG_UNITS_GYR:
        return "angular rates look like deg/s; rad/s are needed";
    case JCAL_REASON_WRONG_UNITS_ACC:
        return "accelerations look like g; m/s^2 are needed";
    case JCAL_REASON_NONE:
    default:
        return NULL;
    }
}

const char *hint_words(jcal_hint_t hint)
{
    switch (hint) {
    case JCAL_HINT_MOVE_JOINT:
        return "bend and stretch the joint";
    case JCAL_HINT_MOVE_SEGMENT1:
        return "turn the proximal segment, the one with sensor 1";
    case JCAL_HINT_MOVE_SEGMENT2:
        return "turn the distal segment, the one with sensor 2";
    case JCAL_HINT_TILT_AXIS:
        return "tilt the joint axis out of the horizontal";
    case JCAL_HINT_CHECK_SENSORS:
        return "check units, range, mounting and pairing of the sensors; more motion will not help";
    case JCAL_HINT_NONE:
    default:
        return NULL;
    }
}

const char *weak_words(jcal_weak_t weak)
{
    switch (weak) {
    case JCAL_WEAK_AXIS1:
        return "axis in sensor 1";
    case JCAL_WEAK_AXIS2:
        return "axis in sensor 2";
    case JCAL_WEAK_SIGN:
        return "sign pairing";
    case JCAL_WEAK_HEADING:
        return "heading offset";
    case JCAL_WEAK_NONE:
    default:
        return NULL;
    }
}

static const char *reject_words(jcal_reject_t reject)
{
    switch (reject) {
    case JCAL_REJECT_NOT_FINITE:
        return "empty or not finite";
    case JCAL_REJECT_OUT_OF_RANGE:
        return "out of range";
    case JCAL_REJECT_SATURATED:
        return "saturated";
    case JCAL_REJECT_FROZEN:
        return "frozen";
    case JCAL_REJECT_REPEATED:
        return "repeated";
    case JCAL_REJECT_TIME_ORDER:
        return "time not increasing";
    case JCAL_REJECT_GAP:
        return "after a gap";
    case JCAL_REJECT_COUNT:
    default:
        return "other";
    }
}

void print_words(FILE *file, const char *label, const char *words)
{
    if (words != NULL) {
        (void)fprintf(file, "  %-18s %s\n", label, words);
    }
}

void print_axis(FILE *file, const char *label, bool known, jcal_vec3_t axis, float bound_rad)
{
    if (!known) {
        print_words(file, label, "unknown");
        return;
    }
    (void)fprintf(file, "  %-18s %8.4f %8.4f %8.4f   ", label, (double)axis.x, (double)axis.y, (double)axis.z);
    if (bound_rad < BOUND_UNKNOWN_RAD) {
        (void)fprintf(file, "to within %.1f deg\n", degrees(bound_rad));
    } else {
        (void)fputs("uncertainty unknown\n", file);
    }
}

void print_samples(FILE *file, uint32_t samples, uint32_t rejected, const uint32_t *rejected_by)
{
    (void)fprintf(file, "  %-18s %" PRIu32 " read, %" PRIu32 " rejected", "samples", samples, rejected);
    const char *before = ": ";
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        if (rejected_by[k] > 0) {
            (void)fprintf(file, "%s%" PRIu32 " %s", before, rejected_by[k], reject_words((jcal_reject_t)k));
            before = ", ";
        }
    }
    (void)fputc('\n', file);
}
