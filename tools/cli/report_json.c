/* SPDX-License-Identifier: MIT */
/* What the lines of JSON of all joints have in common. */
#include "report.h"

json_t report_json_begin(FILE *file, const char *event, const report_t *report)
{
    const finding_t *finding = &report->finding;
    json_t json = json_begin(file);
    json_word(&json, "event", event);
    json_time(&json, "t_s", report->clock.has_time, report->clock.t_us);
    json_word(&json, "status", jcal_calibration_string(finding->status));
    json_word(&json, "engine", jcal_engine_string(finding->engine));
    json_word(&json, "weak", jcal_weak_string(finding->weak));
    json_word(&json, "hint", jcal_hint_string(finding->hint));
    json_word(&json, "reason", jcal_reason_string(finding->reason));
    return json;
}

void report_json_axes(json_t *json, const finding_t *finding)
{
    const float axis1[] = {finding->axis1.x, finding->axis1.y, finding->axis1.z};
    const float axis2[] = {finding->axis2.x, finding->axis2.y, finding->axis2.z};
    const float bounds[] = {DEG_PER_RAD * finding->bound1, DEG_PER_RAD * finding->bound2};
    /* Where one of two bounds is unknown it reads 90: true of any axis. */
    const bool bounded =
        finding->has_estimate && (finding->bound1 < BOUND_UNKNOWN_RAD || finding->bound2 < BOUND_UNKNOWN_RAD);
    json_numbers(json, "axis1", finding->has_estimate, axis1, 3);
    json_numbers(json, "axis2", finding->has_estimate, axis2, 3);
    json_numbers(json, "uncertainty_deg", bounded, bounds, 2);
}

void report_json_end(json_t *json, const finding_t *finding)
{
    json_count(json, "samples", finding->samples);
    json_count(json, "rejected", finding->rejected);
    json_key(json, "rejected_by");
    json_t inner = json_begin(json->file);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        json_count(&inner, jcal_reject_string((jcal_reject_t)k), finding->rejected_by[k]);
    }
    json_end(&inner);
    json_end(json);
    (void)fputc('\n', json->file);
}
