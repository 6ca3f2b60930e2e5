/* SPDX-License-Identifier: MIT */
/* What `jointcal hinge` writes: the parts that only a hinge has. */
#include "hinge_output.h"

#include <math.h>
#include <string.h>

const report_words_t HINGE_WORDS = {
    .name = "Hinge",
    .misfit = "no hinge explains the data: another kind of joint, or sensors that share none",
    .ambiguous = "other axes explain the data about equally",
    .move_joint = "bend and stretch the joint",
    .asked_for = "both axes",
    .bounded = "axes",
    .unit = "deg",
    .per_unit = DEG_PER_RAD,
    .unknown = BOUND_UNKNOWN_RAD,
};

finding_t hinge_finding(const jcal_hinge_result_t *result)
{
    finding_t finding = {.status = result->head.status,
                         .engine = result->head.engine,
                         .weak = result->head.weak,
                         .hint = result->head.hint,
                         .reason = result->head.reason,
                         .has_estimate = result->has_axes,
                         .axis1 = result->axis1,
                         .axis2 = result->axis2,
                         .bound1 = result->uncertainty1_rad,
                         .bound2 = result->uncertainty2_rad,
                         .samples = result->head.samples,
                         .rejected = result->head.rejected};
    memcpy(finding.rejected_by, result->head.rejected_by, sizeof finding.rejected_by);
    return finding;
}

void hinge_write_json(FILE *file, const char *event, const report_t *report, const jcal_hinge_result_t *result)
{
    json_t json = report_json_begin(file, event, report);
    report_json_axes(&json, &report->finding);
    json_number(&json, "sign_margin", (result->sign_margin > 0.0f) ? result->sign_margin : NAN);
    if (result->head.engine == JCAL_ENGINE_WINDOW) {
        json_bool(&json, "paper_accepted", result->paper_accepted);
    }
    report_json_end(&json, &report->finding);
}

static void print_pairing(FILE *file, float margin)
{
    if (margin > 0.0f) {
        (void)fprintf(file, "  %-18s the other one explains the data %.3g times worse\n", "sign pairing",
                      (double)margin);
    } else {
        report_print_words(file, "sign pairing", "unknown");
    }
}

void hinge_print_summary(FILE *file, const report_t *report, const jcal_hinge_result_t *result)
{
    report_print_head(file, report);
    report_print_axes(file, report);
    print_pairing(file, result->sign_margin);
    report_print_state(file, report);
    if (result->head.engine == JCAL_ENGINE_WINDOW) {
        report_print_words(file, "paper's test", result->paper_accepted ? "accepted" : "not accepted");
    }
    report_print_exit(file, report);
}
