/* SPDX-License-Identifier: MIT */
/* What `jointcal two-dof` writes: the parts that only a joint with two axes has. */
#include "two_dof_output.h"

#include <math.h>

const report_words_t TWO_DOF_WORDS = {
    .name = "Joint with two axes",
    .misfit = "no joint with two axes explains the data: another kind of joint, or sensors that share none",
    .ambiguous = "other axes or headings explain the data about equally",
    .move_joint = "move the joint about both axes, in all combinations",
    .asked_for = "both axes and the heading",
    .bounded = "axes",
    .unit = "deg",
    .per_unit = DEG_PER_RAD,
    .unknown = BOUND_UNKNOWN_RAD,
};

finding_t two_dof_finding(const jcal_two_dof_result_t *result)
{
    return (finding_t){.status = result->head.status,
                       .engine = result->head.engine,
                       .weak = result->head.weak,
                       .hint = result->head.hint,
                       .reason = result->head.reason,
                       .has_estimate = result->has_axes,
                       .axis1 = result->axis1,
                       .axis2 = result->axis2,
                       .bound1 = result->uncertainty1_rad,
                       .bound2 = result->uncertainty2_rad};
}

/* In (-180, 180]: rounding may lead past the ends. */
static float heading_deg(float rad)
{
    const float deg = DEG_PER_RAD * rad;
    return (deg <= -180.0f || deg > 180.0f) ? 180.0f : deg;
}

static bool heading_bounded(const jcal_two_dof_result_t *result)
{
    return result->has_axes && result->uncertainty_heading_rad < BOUND_UNKNOWN_RAD;
}

void two_dof_write_json(FILE *file, const char *event, const report_t *report, const jcal_two_dof_result_t *result)
{
    const bool known = result->has_axes;
    const float bound_deg = DEG_PER_RAD * result->uncertainty_heading_rad;
    json_t json = report_json_begin(file, event, report);
    report_json_axes(&json, &report->finding);
    json_number(&json, "heading_offset_deg", known ? heading_deg(result->heading_offset_rad) : NAN);
    json_number(&json, "uncertainty_heading_deg", heading_bounded(result) ? bound_deg : NAN);
    json_number(&json, "carrying_angle_deg", known ? DEG_PER_RAD * result->carrying_angle_rad : NAN);
    if (result->head.engine == JCAL_ENGINE_WINDOW) {
        json_word(&json, "paper_accepted", NULL); /* Laidig et al. have no such test */
    }
    report_json_end(&json, &report->finding);
}

static void print_heading(FILE *file, const jcal_two_dof_result_t *result)
{
    (void)fprintf(file, "  %-18s %8.1f deg   ", "heading offset", (double)heading_deg(result->heading_offset_rad));
    if (heading_bounded(result)) {
        (void)fprintf(file, "to within %.1f deg\n", (double)(DEG_PER_RAD * result->uncertainty_heading_rad));
    } else {
        (void)fputs("uncertainty unknown\n", file);
    }
    (void)fprintf(file, "  %-18s %8.1f deg\n", "carrying angle", (double)(DEG_PER_RAD * result->carrying_angle_rad));
}

void two_dof_print_summary(FILE *file, const report_t *report, const jcal_two_dof_result_t *result,
                           const char *orientations)
{
    report_print_head(file, report);
    report_print_axes(file, report);
    if (result->has_axes) {
        print_heading(file, result);
    } else {
        report_print_words(file, "heading offset", "unknown");
        report_print_words(file, "carrying angle", "unknown");
    }
    report_print_words(file, "orientations", orientations);
    report_print_state(file, report);
    report_print_exit(file, report);
}
