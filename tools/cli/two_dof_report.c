/* SPDX-License-Identifier: MIT */
/* What `jointcal two-dof` says. */
#include "two_dof_report.h"

#include "hinge_summary.h"
#include "json.h"
#include "message.h"
#include "words.h"

#include <math.h>

static double degrees(float rad)
{
    return (double)(DEG_PER_RAD * rad);
}

static bool is_bounded(float bound_rad)
{
    return bound_rad < BOUND_UNKNOWN_RAD;
}

/* Degrees if it is known. */
static float known_deg(bool known, float rad)
{
    return known ? (DEG_PER_RAD * rad) : NAN;
}

/* In (-180, 180]. */
static float heading_deg(const jcal_two_dof_result_t *result)
{
    const float deg = known_deg(result->has_axes, result->heading_offset_rad);
    return (deg <= -180.0f) ? (deg + 360.0f) : deg;
}

static void write_rejected_by(json_t *json, const two_dof_report_t *report)
{
    json_key(json, "rejected_by");
    json_t inner = json_begin(json->file);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        json_count(&inner, jcal_reject_string((jcal_reject_t)k), report->rejected_by[k]);
    }
    json_end(&inner);
}

void two_dof_write_json(FILE *file, const char *event, const two_dof_report_t *report)
{
    const jcal_two_dof_result_t *result = &report->result;
    const float axis1[] = {result->axis1.x, result->axis1.y, result->axis1.z};
    const float axis2[] = {result->axis2.x, result->axis2.y, result->axis2.z};
    const float bounds[] = {DEG_PER_RAD * result->uncertainty1_rad, DEG_PER_RAD * result->uncertainty2_rad};
    /* Where one of two bounds is unknown it reads 90: true of any axis. */
    const bool bounded =
        result->has_axes && (is_bounded(result->uncertainty1_rad) || is_bounded(result->uncertainty2_rad));
    const bool heading_bounded = result->has_axes && is_bounded(result->uncertainty_heading_rad);
    json_t json = json_begin(file);
    json_word(&json, "event", event);
    json_time(&json, "t_s", report->timeline.has_time, report->timeline.latest_us);
    json_word(&json, "status", jcal_calibration_string(result->status));
    json_word(&json, "engine", jcal_engine_string(result->engine));
    json_word(&json, "weak", jcal_weak_string(result->weak));
    json_word(&json, "hint", jcal_hint_string(result->hint));
    json_word(&json, "reason", jcal_reason_string(result->reason));
    json_numbers(&json, "axis1", result->has_axes, axis1, 3);
    json_numbers(&json, "axis2", result->has_axes, axis2, 3);
    json_numbers(&json, "uncertainty_deg", bounded, bounds, 2);
    json_number(&json, "heading_offset_deg", heading_deg(result));
    json_number(&json, "uncertainty_heading_deg", known_deg(heading_bounded, result->uncertainty_heading_rad));
    json_number(&json, "carrying_angle_deg", known_deg(result->has_axes, result->carrying_angle_rad));
    json_count(&json, "samples", report->samples);
    json_count(&json, "rejected", report->rejected);
    write_rejected_by(&json, report);
    json_end(&json);
    (void)fputc('\n', file);
}

void two_dof_print_event(FILE *file, const char *event, const two_dof_report_t *report)
{
    const jcal_two_dof_result_t *result = &report->result;
    char buffer[32];
    (void)fprintf(file, "%10s s  %-8s %-10s",
                  report->timeline.has_time ? time_text(report->timeline.latest_us, buffer) : "?", event,
                  jcal_calibration_string(result->status));
    if (result->has_axes && is_bounded(result->uncertainty1_rad) && is_bounded(result->uncertainty2_rad)) {
        (void)fprintf(file, "  axes to within %.1f and %.1f deg", degrees(result->uncertainty1_rad),
                      degrees(result->uncertainty2_rad));
    }
    if (result->has_axes && is_bounded(result->uncertainty_heading_rad)) {
        (void)fprintf(file, ", heading %.1f deg to within %.1f deg", (double)heading_deg(result),
                      degrees(result->uncertainty_heading_rad));
    }
    const char *reason = reason_words(result->reason);
    (void)fprintf(file, "%s%s\n", (reason != NULL) ? "  " : "", (reason != NULL) ? reason : "");
}

static void print_heading(FILE *file, const jcal_two_dof_result_t *result)
{
    if (!result->has_axes) {
        print_words(file, "heading offset", "unknown");
        return;
    }
    (void)fprintf(file, "  %-18s %8.2f deg   ", "heading offset", (double)heading_deg(result));
    if (is_bounded(result->uncertainty_heading_rad)) {
        (void)fprintf(file, "to within %.1f deg\n", degrees(result->uncertainty_heading_rad));
    } else {
        (void)fputs("uncertainty unknown\n", file);
    }
    (void)fprintf(file, "  %-18s %8.2f deg\n", "carrying angle", degrees(result->carrying_angle_rad));
}

static void print_ready_time(FILE *file, const two_dof_report_t *report)
{
    char buffer[32];
    if (report->was_ready) {
        (void)fprintf(file, "  %-18s %s s after the start\n", "first ready",
                      time_text(report->ready_us - report->timeline.start_us, buffer));
    } else {
        print_words(file, "first ready", "never");
    }
}

void two_dof_print_summary(FILE *file, const two_dof_report_t *report)
{
    const jcal_two_dof_result_t *result = &report->result;
    (void)fprintf(file, "Joint with two axes, %s engine: %s\n", jcal_engine_string(result->engine),
                  status_words(result->status));
    print_words(file, "why", reason_words(result->reason));
    print_axis(file, "axis in sensor 1", result->has_axes, result->axis1, result->uncertainty1_rad);
    print_axis(file, "axis in sensor 2", result->has_axes, result->axis2, result->uncertainty2_rad);
    print_heading(file, result);
    (void)fprintf(file, "  %-18s axes and heading offset to within %.3g deg (95 %% confidence)\n", "asked for",
                  degrees(report->max_bound_rad));
    print_words(file, "weakest", weak_words(result->weak));
    print_words(file, "what would help", hint_words(result->hint));
    print_ready_time(file, report);
    print_words(file, "orientations",
                report->from_columns ? "columns q1_w ... q2_z" : "VQF, from rates and accelerations");
    print_samples(file, report->samples, report->rejected, report->rejected_by);
    const bool ready = result->status == JCAL_READY;
    (void)fprintf(file, "  %-18s %d: read to the end, %s\n", "exit status", (int)(ready ? EXIT_READY : EXIT_NOT_READY),
                  ready ? "ready" : "not ready");
}
