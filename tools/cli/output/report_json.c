/* SPDX-License-Identifier: MIT */
/* What the lines of JSON of all joints have in common. */
#include "output/report.h"

#include "units.h"

#include <math.h>

json_t report_json_begin(FILE *file, const char *event, const report_t *report)
{
    const jcal_head_t *head = &report->head;
    json_t json = json_begin(file);
    json_word(&json, "event", event);
    json_time(&json, "t_s", report->clock.has_time, report->clock.t_us);
    json_word(&json, "status", jcal_calibration_string(head->status));
    json_word(&json, "engine", jcal_engine_string(head->engine));
    json_word(&json, "weak", jcal_weak_string(head->weak));
    json_word(&json, "hint", jcal_hint_string(head->hint));
    json_word(&json, "reason", jcal_reason_string(head->reason));
    return json;
}

void report_json_vector(json_t *json, const char *key, bool known, jcal_vec3_t v)
{
    const float values[] = {v.x, v.y, v.z};
    json_numbers(json, key, known, values, 3);
}

void report_json_axes(json_t *json, const report_axes_t *axes)
{
    const float bounds[] = {DEG_PER_RAD * axes->bound1, DEG_PER_RAD * axes->bound2};
    /* Where one of two bounds is unknown it reads 90: true of any axis. */
    const bool bounded = axes->known && (axes->bound1 < BOUND_UNKNOWN_RAD || axes->bound2 < BOUND_UNKNOWN_RAD);
    report_json_vector(json, "axis1", axes->known && report_is_axis(axes->axis1), axes->axis1);
    report_json_vector(json, "axis2", axes->known && report_is_axis(axes->axis2), axes->axis2);
    json_numbers(json, "uncertainty_deg", bounded, bounds, 2);
}

void report_json_lag(json_t *json, const report_lag_t *lag)
{
    json_time(json, "lag_s", lag->known, lag->lag_us);
    if (lag->two_files) {
        json_number(json, "lag_uncertainty_s", lag->known ? lag->bound_s : NAN);
        json_number(json, "drift_ppm", lag->known ? 1e6f * lag->drift : NAN);
    }
}

void json_rejected(json_t *json, const uint32_t rejected_by[static JCAL_REJECT_COUNT])
{
    json_key(json, "rejected_by");
    json_t inner = json_begin(json->file);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        json_count(&inner, jcal_reject_string((jcal_reject_t)k), rejected_by[k]);
    }
    json_end(&inner);
}

void report_json_end(json_t *json, const report_t *report)
{
    const jcal_head_t *head = &report->head;
    json_sentences(json, "advice", report->findings.sentences, report->findings.count);
    json_count(json, "samples", head->samples);
    json_count(json, "rejected", head->rejected);
    json_rejected(json, head->rejected_by);
    json_end(json);
    (void)fputc('\n', json->file);
}
