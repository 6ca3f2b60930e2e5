/* SPDX-License-Identifier: MIT */
/* An event of a hinge calibration as a line of JSON. */
#include "hinge_json.h"

#include "json.h"

#include <math.h>

static void write_rejected_by(json_t *json, const jcal_hinge_result_t *result)
{
    json_key(json, "rejected_by");
    json_t inner = json_begin(json->file);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        json_count(&inner, jcal_reject_string((jcal_reject_t)k), result->rejected_by[k]);
    }
    json_end(&inner);
}

void hinge_write_json(FILE *file, const char *event, const hinge_report_t *report)
{
    const jcal_hinge_result_t *result = &report->result;
    const float axis1[] = {result->axis1.x, result->axis1.y, result->axis1.z};
    const float axis2[] = {result->axis2.x, result->axis2.y, result->axis2.z};
    const float bounds[] = {DEG_PER_RAD * result->uncertainty1_rad, DEG_PER_RAD * result->uncertainty2_rad};
    /* Where one of two bounds is unknown it reads 90: true of any axis. */
    const bool bounded = result->has_axes &&
                         (result->uncertainty1_rad < BOUND_UNKNOWN_RAD || result->uncertainty2_rad < BOUND_UNKNOWN_RAD);
    json_t json = json_begin(file);
    json_word(&json, "event", event);
    json_time(&json, "t_s", report->has_time, report->t_us);
    json_word(&json, "status", jcal_calibration_string(result->status));
    json_word(&json, "engine", jcal_engine_string(result->engine));
    json_word(&json, "weak", jcal_weak_string(result->weak));
    json_word(&json, "hint", jcal_hint_string(result->hint));
    json_word(&json, "reason", jcal_reason_string(result->reason));
    json_numbers(&json, "axis1", result->has_axes, axis1, 3);
    json_numbers(&json, "axis2", result->has_axes, axis2, 3);
    json_numbers(&json, "uncertainty_deg", bounded, bounds, 2);
    json_number(&json, "sign_margin", (result->sign_margin > 0.0f) ? result->sign_margin : NAN);
    if (result->engine == JCAL_ENGINE_WINDOW) {
        json_bool(&json, "paper_accepted", result->paper_accepted);
    }
    json_count(&json, "samples", result->samples);
    json_count(&json, "rejected", result->rejected);
    write_rejected_by(&json, result);
    json_end(&json);
    (void)fputc('\n', file);
}
