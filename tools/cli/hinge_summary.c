/* SPDX-License-Identifier: MIT */
/* What `jointcal hinge` tells a person. */
#include "hinge_summary.h"

#include "json.h"
#include "message.h"
#include "words.h"

static double degrees(float rad)
{
    return (double)(DEG_PER_RAD * rad);
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
    print_samples(file, result->samples, result->rejected, result->rejected_by);
    if (result->engine == JCAL_ENGINE_WINDOW) {
        print_words(file, "paper's test", result->paper_accepted ? "accepted" : "not accepted");
    }
    const bool ready = result->status == JCAL_READY;
    (void)fprintf(file, "  %-18s %d: read to the end, %s\n", "exit status", (int)(ready ? EXIT_READY : EXIT_NOT_READY),
                  ready ? "ready" : "not ready");
}
