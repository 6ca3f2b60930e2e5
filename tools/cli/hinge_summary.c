/* SPDX-License-Identifier: MIT */
/* What `jointcal hinge` tells a person. */
#include "hinge_summary.h"

#include "json.h"
#include "message.h"

#include <inttypes.h>

static double degrees(float rad)
{
    return (double)(DEG_PER_RAD * rad);
}

static const char *status_words(jcal_calibration_t status)
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

static const char *reason_words(jcal_reason_t reason)
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
        return "no hinge explains the data: another kind of joint, or sensors that share none";
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

static const char *hint_words(jcal_hint_t hint)
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

static const char *weak_words(jcal_weak_t weak)
{
    switch (weak) {
    case JCAL_WEAK_AXIS1:
        return "axis in sensor 1";
    case JCAL_WEAK_AXIS2:
        return "axis in sensor 2";
    case JCAL_WEAK_SIGN:
        return "sign pairing";
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

/* A labelled line, or nothing if there are no words. */
static void print_words(FILE *file, const char *label, const char *words)
{
    if (words != NULL) {
        (void)fprintf(file, "  %-18s %s\n", label, words);
    }
}

static void print_axis(FILE *file, const char *label, bool known, jcal_vec3_t axis, float bound_rad)
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

static void print_pairing(FILE *file, float margin)
{
    if (margin > 0.0f) {
        (void)fprintf(file, "  %-18s the other one explains the data %.3g times worse\n", "sign pairing",
                      (double)margin);
    } else {
        print_words(file, "sign pairing", "unknown");
    }
}

static void print_ready_time(FILE *file, const hinge_report_t *report)
{
    if (report->was_ready) {
        char buffer[32];
        (void)fprintf(file, "  %-18s %s s after the start\n", "first ready",
                      time_text(report->ready_us - report->start_us, buffer));
    } else {
        print_words(file, "first ready", "never");
    }
}

static void print_samples(FILE *file, const jcal_hinge_result_t *result)
{
    (void)fprintf(file, "  %-18s %" PRIu32 " read, %" PRIu32 " rejected", "samples", result->samples, result->rejected);
    const char *before = ": ";
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        if (result->rejected_by[k] > 0) {
            (void)fprintf(file, "%s%" PRIu32 " %s", before, result->rejected_by[k], reject_words((jcal_reject_t)k));
            before = ", ";
        }
    }
    (void)fputc('\n', file);
}

void hinge_print_event(FILE *file, const char *event, const hinge_report_t *report)
{
    const jcal_hinge_result_t *result = &report->result;
    char buffer[32];
    (void)fprintf(file, "%10s s  %-8s %-10s", report->has_time ? time_text(report->t_us, buffer) : "?", event,
                  jcal_calibration_string(result->status));
    if (result->has_axes && result->uncertainty1_rad < BOUND_UNKNOWN_RAD &&
        result->uncertainty2_rad < BOUND_UNKNOWN_RAD) {
        (void)fprintf(file, "  axes to within %.1f and %.1f deg", degrees(result->uncertainty1_rad),
                      degrees(result->uncertainty2_rad));
    }
    const char *reason = reason_words(result->reason);
    (void)fprintf(file, "%s%s\n", (reason != NULL) ? "  " : "", (reason != NULL) ? reason : "");
}

void hinge_print_summary(FILE *file, const hinge_report_t *report)
{
    const jcal_hinge_result_t *result = &report->result;
    (void)fprintf(file, "Hinge, %s engine: %s\n", jcal_engine_string(result->engine), status_words(result->status));
    print_words(file, "why", reason_words(result->reason));
    print_axis(file, "axis in sensor 1", result->has_axes, result->axis1, result->uncertainty1_rad);
    print_axis(file, "axis in sensor 2", result->has_axes, result->axis2, result->uncertainty2_rad);
    print_pairing(file, result->sign_margin);
    (void)fprintf(file, "  %-18s both axes to within %.3g deg (95 %% confidence)\n", "asked for",
                  degrees(report->max_bound_rad));
    print_words(file, "weakest", weak_words(result->weak));
    print_words(file, "what would help", hint_words(result->hint));
    print_ready_time(file, report);
    print_samples(file, result);
    if (result->engine == JCAL_ENGINE_WINDOW) {
        print_words(file, "paper's test", result->paper_accepted ? "accepted" : "not accepted");
    }
    const bool ready = result->status == JCAL_READY;
    (void)fprintf(file, "  %-18s %d: read to the end, %s\n", "exit status", (int)(ready ? EXIT_READY : EXIT_NOT_READY),
                  ready ? "ready" : "not ready");
}
