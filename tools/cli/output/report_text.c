/* SPDX-License-Identifier: MIT */
/* What the program tells a person of any joint. */
#include "output/report.h"

#include <math.h>

#include "output/message.h"
#include "units.h"

#include <inttypes.h>

/* A lag that is not worth a word, s. */
#define LAG_BORNE_S 0.02

/* A bound in the unit that a person reads. */
static double readable(const report_t *report, float bound)
{
    return (double)(report->words->per_unit * bound);
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

static const char *uncertain_words(jcal_weak_t weak)
{
    switch (weak) {
    case JCAL_WEAK_HEADING:
        return "the heading is not known well enough";
    case JCAL_WEAK_CENTER1:
    case JCAL_WEAK_CENTER2:
        return "the joint centre is not known well enough";
    case JCAL_WEAK_NONE:
    case JCAL_WEAK_AXIS1:
    case JCAL_WEAK_AXIS2:
    case JCAL_WEAK_SIGN:
    default:
        return "an axis is not known well enough";
    }
}

void report_advise_sign(const report_axes_t *axes, check_findings_t *findings)
{
    const float sizes[3] = {fabsf(axes->axis1.x), fabsf(axes->axis1.y), fabsf(axes->axis1.z)};
    const float largest = fmaxf(fmaxf(sizes[0], sizes[1]), sizes[2]);
    const float least = fminf(fminf(sizes[0], sizes[1]), sizes[2]);
    const float second = sizes[0] + sizes[1] + sizes[2] - largest - least;
    if (axes->known && axes->bound1 < BOUND_UNKNOWN_RAD && largest - second < 2.0f * axes->bound1) {
        check_say(
            findings,
            "the sign of axis 1 hangs on a tie of its components: another recording may give its opposite, and angles "
            "of the other sign; --axis1-toward X,Y,Z settles it");
    }
}

void report_advise_lag(const report_lag_t *lag, double step_s, check_findings_t *findings)
{
    const double lag_s = 1e-6 * (double)lag->lag_us;
    if (lag->two_files || !lag->known || fabs(lag_s) <= LAG_BORNE_S) {
        return;
    }
    char rows[48] = "";
    if (step_s > 0.0) {
        (void)snprintf(rows, sizeof rows, ", %.1f rows", fabs(lag_s) / step_s);
    }
    check_findings_t own = {0};
    check_say(
        &own,
        "the readings of sensor %d come %.0f ms%s later than those of the other one, to within %.0f ms: move its columns up by that; "
        "the result is wrong by what the joint turns in that time",
        (lag_s > 0.0) ? 2 : 1, 1e3 * fabs(lag_s), rows, ceil(1e3 * (double)lag->bound_s));
    if (findings->explains) {
        check_say(findings, "%s", own.sentences[0]);
    } else {
        check_put_first(findings, &own, JCAL_REASON_BAD_SAMPLES);
    }
    findings->refuses = true;
}

void report_apply_findings(report_t *report)
{
    jcal_head_t *head = &report->head;
    if (report->findings.refuses && head->status == JCAL_READY) {
        head->status = JCAL_COLLECTING;
    }
    if (report->findings.explains && head->status != JCAL_READY) {
        /* The library's word on the unit of rates says more than that samples are bad. */
        const bool keep = head->reason == JCAL_REASON_WRONG_UNITS_GYR && report->findings.refuses;
        head->reason = keep ? head->reason : report->findings.reason;
        head->hint = JCAL_HINT_CHECK_SENSORS;
    }
}

const char *report_reason(const report_t *report)
{
    if (report->findings.explains && report->head.status != JCAL_READY) {
        return report->findings.sentences[0];
    }
    switch (report->head.reason) {
    case JCAL_REASON_NO_DATA:
        return "too few usable samples";
    case JCAL_REASON_NO_MOTION:
        return "the segments hardly turn against each other";
    case JCAL_REASON_UNCERTAIN:
        return uncertain_words(report->head.weak);
    case JCAL_REASON_SIGN_OPEN:
        return "both sign pairings explain the data about equally";
    case JCAL_REASON_OTHER_MINIMUM:
        return report->words->ambiguous;
    case JCAL_REASON_DOES_NOT_FIT:
        return report->words->misfit;
    case JCAL_REASON_BAD_SAMPLES:
        return "too many samples are rejected";
    case JCAL_REASON_WRONG_UNITS_GYR:
        return "angular rates look like deg/s; rad/s are needed";
    case JCAL_REASON_WRONG_UNITS_ACC:
        return "accelerations are too small; m/s^2 are needed, with gravity in them: a sensor at rest reads 9.81";
    case JCAL_REASON_RATE_TOO_LOW:
        return "fewer than 10 samples a second: a joint turns too far from one to the next";
    case JCAL_REASON_GRAVITY_OFF:
        return "one of the sensors does not feel 9.81 m/s^2 on the whole: its accelerometer is scaled wrongly, clips or has an offset";
    case JCAL_REASON_NOT_ONE_JOINT:
        return "the accelerations of the two sensors do not belong to one joint: another pair of sensors, readings that are not of one "
               "time, or accelerometers whose axes are not those of their gyroscopes";
    case JCAL_REASON_NO_BEND:
        return "the segments move, but the joint between them hardly bends";
    case JCAL_REASON_MORE_AXES:
        return "the joint turns about more than one axis; of one that has two, as an elbow, 'jointcal two-dof' finds both";
    case JCAL_REASON_SENSOR_BAD:
        return "one of the sensors is faulty";
    case JCAL_REASON_OUT_OF_STEP:
        return "the lag between the two sensors is not known yet";
    case JCAL_REASON_NONE:
    default:
        return NULL;
    }
}

/* How to turn a segment, 0 the proximal and 1 the distal one, of the joint that is known worst. */
static const char *turn_words(const report_t *report, int segment)
{
    static const char *const usual[2] = {"turn the proximal segment, the one with sensor 1",
                                         "turn the distal segment, the one with sensor 2"};
    const jcal_weak_t weak = report->head.weak;
    const bool has_own = report->words->centers[0] != NULL && (weak == JCAL_WEAK_CENTER1 || weak == JCAL_WEAK_CENTER2);
    return has_own ? report->words->turn[weak == JCAL_WEAK_CENTER2][segment] : usual[segment];
}

const char *report_help(const report_t *report)
{
    switch (report->head.hint) {
    case JCAL_HINT_MOVE_JOINT:
        return report->words->move_joint;
    case JCAL_HINT_MOVE_SEGMENT1:
        return turn_words(report, 0);
    case JCAL_HINT_MOVE_SEGMENT2:
        return turn_words(report, 1);
    case JCAL_HINT_TILT_AXIS:
        return "tilt the joint axis out of the horizontal";
    case JCAL_HINT_CHECK_SENSORS:
        return "check units, range, mounting and pairing of the sensors; more motion will not help";
    case JCAL_HINT_MORE_DIRECTIONS:
        return "turn both segments about other axes too; the axis of a hinge always stays open, see --calibration";
    case JCAL_HINT_MOVE_FASTER:
        return "move faster and further, so that the joint itself is accelerated, as in walking";
    case JCAL_HINT_BEND_ONLY:
        return "bend and stretch the joint only, for ten seconds, without turning the segment beyond it";
    case JCAL_HINT_TURN_ONLY:
        return "hold the joint bent and turn the segment beyond it only, as with a door handle, for ten seconds";
    case JCAL_HINT_NONE:
    default:
        return NULL;
    }
}

static const char *weak_words(const report_words_t *words, jcal_weak_t weak)
{
    if (words->centers[0] != NULL && (weak == JCAL_WEAK_CENTER1 || weak == JCAL_WEAK_CENTER2)) {
        return words->centers[weak == JCAL_WEAK_CENTER2];
    }
    switch (weak) {
    case JCAL_WEAK_AXIS1:
        return "axis in sensor 1";
    case JCAL_WEAK_AXIS2:
        return "axis in sensor 2";
    case JCAL_WEAK_SIGN:
        return "sign pairing";
    case JCAL_WEAK_HEADING:
        return "heading offset of the two orientations";
    case JCAL_WEAK_CENTER1:
        return "joint centre seen from sensor 1";
    case JCAL_WEAK_CENTER2:
        return "joint centre seen from sensor 2";
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

void report_print_words(FILE *file, const char *label, const char *words)
{
    if (words != NULL) {
        (void)fprintf(file, "  %-18s %s\n", label, words);
    }
}

bool report_is_axis(jcal_vec3_t axis)
{
    return axis.x != 0.0f || axis.y != 0.0f || axis.z != 0.0f;
}

static void print_axis(FILE *file, const char *label, bool known, jcal_vec3_t axis, float bound_rad)
{
    if (!known) {
        report_print_words(file, label, "unknown");
        return;
    }
    (void)fprintf(file, "  %-18s %8.4f %8.4f %8.4f   ", label, (double)axis.x, (double)axis.y, (double)axis.z);
    if (bound_rad < BOUND_UNKNOWN_RAD) {
        (void)fprintf(file, "to within %.1f deg\n", (double)(DEG_PER_RAD * bound_rad));
    } else {
        (void)fputs("uncertainty unknown\n", file);
    }
}

static void print_ready_time(FILE *file, const report_t *report)
{
    if (report->was_ready) {
        char buffer[32];
        (void)fprintf(file, "  %-18s %s s after the start\n", "first ready",
                      time_text(report->ready_us - report->clock.start_us, buffer));
    } else {
        report_print_words(file, "first ready", "never");
    }
    if (report->has_moved) {
        char buffer[32];
        const char *other = report->words->moved;
        (void)fprintf(file, "  %-18s %s s after the start: a sensor sits otherwise since then%s%s\n", "moved",
                      time_text(report->moved_us - report->clock.start_us, buffer), (other != NULL) ? ", or " : "",
                      (other != NULL) ? other : "");
    }
}

void report_print_samples(FILE *file, uint32_t samples, uint32_t rejected,
                          const uint32_t rejected_by[static JCAL_REJECT_COUNT])
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

void report_print_event(FILE *file, const char *event, const report_t *report)
{
    const jcal_head_t *head = &report->head;
    char buffer[32];
    (void)fprintf(file, "%10s s  %-8s %-10s", report->clock.has_time ? time_text(report->clock.t_us, buffer) : "?",
                  event, jcal_calibration_string(head->status));
    const report_words_t *words = report->words;
    const report_bounds_t *bounds = &report->bounds;
    if (bounds->known && bounds->bound1 < words->unknown && bounds->bound2 < words->unknown) {
        (void)fprintf(file, "  %s to within %.1f and %.1f %s", words->bounded, readable(report, bounds->bound1),
                      readable(report, bounds->bound2), words->unit);
    }
    const char *reason = report_reason(report);
    (void)fprintf(file, "%s%s\n", (reason != NULL) ? "  " : "", (reason != NULL) ? reason : "");
}

void report_print_head(FILE *file, const report_t *report)
{
    const jcal_head_t *head = &report->head;
    (void)fprintf(file, "%s, %s engine: %s\n", report->words->name, jcal_engine_string(head->engine),
                  status_words(head->status));
    report_print_words(file, "why", report_reason(report));
}

void report_print_axes(FILE *file, const report_axes_t *axes)
{
    print_axis(file, "axis in sensor 1", axes->known && report_is_axis(axes->axis1), axes->axis1, axes->bound1);
    print_axis(file, "axis in sensor 2", axes->known && report_is_axis(axes->axis2), axes->axis2, axes->bound2);
}

void report_print_bound_mm(FILE *file, float bound_m)
{
    if (bound_m < JCAL_BOUND_UNKNOWN_M) {
        (void)fprintf(file, "to within %.1f mm\n", (double)(MM_PER_M * bound_m));
    } else {
        (void)fputs("uncertainty unknown\n", file);
    }
}

void report_print_place(FILE *file, const char *label, jcal_vec3_t place_m, float bound_m)
{
    (void)fprintf(file, "  %-18s %8.1f %8.1f %8.1f mm   ", label, (double)(MM_PER_M * place_m.x),
                  (double)(MM_PER_M * place_m.y), (double)(MM_PER_M * place_m.z));
    report_print_bound_mm(file, bound_m);
}

void report_print_orientations(FILE *file, const report_t *report)
{
    report_print_words(file, "orientations", report->orientations);
}

/* What to do. A finding that explains has said so, and more motion will not help. */
static void print_help(FILE *file, const report_t *report)
{
    const check_findings_t *findings = &report->findings;
    const bool explained = findings->explains && report->head.status != JCAL_READY;
    if (!explained) {
        report_print_words(file, "what would help", report_help(report));
    }
    for (size_t k = explained ? 1 : 0; k < findings->count; k++) {
        report_print_words(file, "about the data", findings->sentences[k]);
    }
}

void report_print_state(FILE *file, const report_t *report)
{
    const jcal_head_t *head = &report->head;
    (void)fprintf(file, "  %-18s %s to within %.3g %s (95 %% confidence)\n", "asked for", report->words->asked_for,
                  readable(report, report->max_bound), report->words->unit);
    report_print_words(file, "weakest", weak_words(report->words, head->weak));
    print_help(file, report);
    if (report->print_more != NULL) {
        report->print_more(report->more, file);
    }
    print_ready_time(file, report);
    report_print_samples(file, head->samples, head->rejected, head->rejected_by);
}

void report_print_exit(FILE *file, const report_t *report)
{
    const bool ready = report->head.status == JCAL_READY;
    (void)fprintf(file, "  %-18s %d: read to the end, %s\n", "exit status", (int)(ready ? EXIT_READY : EXIT_NOT_READY),
                  ready ? "ready" : "not ready");
}
