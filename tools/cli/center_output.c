/* SPDX-License-Identifier: MIT */
/* What `jointcal center` writes: the parts that only a joint centre has. */
#include "center_output.h"

#include <math.h>
#include <string.h>

#define MM_PER_M 1000.0f

const report_words_t CENTER_WORDS = {
    .name = "Joint centre",
    .misfit =
        "no fixed point of both segments explains the data: soft tissue, a joint that glides, or sensors that share none",
    .ambiguous = "another centre explains the data about equally",
    .move_joint = "turn both segments about all axes, briskly",
    .asked_for = "the centre from both sensors",
    .bounded = "centre",
    .unit = "mm",
    .per_unit = MM_PER_M,
    .unknown = JCAL_BOUND_UNKNOWN_M,
};

finding_t center_finding(const jcal_center_result_t *result)
{
    finding_t finding = {.status = result->head.status,
                         .engine = result->head.engine,
                         .weak = result->head.weak,
                         .hint = result->head.hint,
                         .reason = result->head.reason,
                         .has_estimate = result->has_center,
                         .bound1 = result->uncertainty1_m,
                         .bound2 = result->uncertainty2_m,
                         .samples = result->head.samples,
                         .rejected = result->head.rejected};
    memcpy(finding.rejected_by, result->head.rejected_by, sizeof finding.rejected_by);
    return finding;
}

static void vector(json_t *json, const char *key, bool known, jcal_vec3_t v)
{
    const float values[3] = {v.x, v.y, v.z};
    json_numbers(json, key, known, values, 3);
}

/* Two bounds: null if both are unknown; where one of two is, it reads 10 m. */
static void bounds(json_t *json, const char *key, float bound1, float bound2)
{
    const float values[2] = {bound1, bound2};
    json_numbers(json, key, bound1 < JCAL_BOUND_UNKNOWN_M || bound2 < JCAL_BOUND_UNKNOWN_M, values, 2);
}

/* A direction is zero until there was a judgement. */
static bool is_known(jcal_vec3_t direction)
{
    return direction.x != 0.0f || direction.y != 0.0f || direction.z != 0.0f;
}

void center_write_json(FILE *file, const char *event, const report_t *report, const jcal_center_result_t *result,
                       const center_setting_t *setting)
{
    const bool known = result->has_center;
    json_t json = report_json_begin(file, event, report);
    vector(&json, "joint_to_sensor1_m", known, result->joint_to_sensor1_m);
    vector(&json, "joint_to_sensor2_m", known, result->joint_to_sensor2_m);
    bounds(&json, "uncertainty_m", result->uncertainty1_m, result->uncertainty2_m);
    vector(&json, "weakest_direction1", is_known(result->weakest_direction1), result->weakest_direction1);
    vector(&json, "weakest_direction2", is_known(result->weakest_direction2), result->weakest_direction2);
    bounds(&json, "uncertainty_weakest_m", result->uncertainty_weakest1_m, result->uncertainty_weakest2_m);
    vector(&json, "acc_bias1_m_s2", known && !setting->has_heading, result->acc_bias1_m_s2);
    vector(&json, "acc_bias2_m_s2", known && !setting->has_heading, result->acc_bias2_m_s2);
    json_number(&json, "heading_offset_deg",
                (known && setting->has_heading) ? DEG_PER_RAD * result->heading_offset_rad : NAN);
    json_number(&json, "misfit", (known && result->misfit > 0.0f) ? result->misfit : NAN);
    if (result->head.engine == JCAL_ENGINE_WINDOW) {
        json_word(&json, "paper_accepted", NULL); /* the paper has no test of that kind */
    }
    report_json_end(&json, &report->finding);
}

static void print_bound(FILE *file, float bound)
{
    if (bound < JCAL_BOUND_UNKNOWN_M) {
        (void)fprintf(file, "to within %.1f mm", (double)(MM_PER_M * bound));
    } else {
        (void)fputs("uncertainty unknown", file);
    }
}

static void print_place(FILE *file, const char *label, bool known, jcal_vec3_t r, float bound)
{
    if (!known) {
        report_print_words(file, label, "unknown");
        return;
    }
    (void)fprintf(file, "  %-18s %8.1f %8.1f %8.1f mm   ", label, (double)(MM_PER_M * r.x), (double)(MM_PER_M * r.y),
                  (double)(MM_PER_M * r.z));
    print_bound(file, bound);
    (void)fputc('\n', file);
}

static void print_direction(FILE *file, const char *label, jcal_vec3_t direction, float bound)
{
    if (is_known(direction)) {
        (void)fprintf(file, "  %-18s %8.2f %8.2f %8.2f      ", label, (double)direction.x, (double)direction.y,
                      (double)direction.z);
        print_bound(file, bound);
        (void)fputc('\n', file);
    }
}

void center_print_summary(FILE *file, const report_t *report, const jcal_center_result_t *result,
                          const center_setting_t *setting)
{
    report_print_head(file, report);
    print_place(file, "joint to sensor 1", result->has_center, result->joint_to_sensor1_m, result->uncertainty1_m);
    print_place(file, "joint to sensor 2", result->has_center, result->joint_to_sensor2_m, result->uncertainty2_m);
    print_direction(file, "weakest along", result->weakest_direction1, result->uncertainty_weakest1_m);
    print_direction(file, "    and, sensor 2,", result->weakest_direction2, result->uncertainty_weakest2_m);
    if (setting->is_hinge) {
        report_print_words(file, "along the axis",
                           "unknown: any point of a hinge's axis will do, this is the one next to both sensors");
    }
    if (setting->has_heading && result->has_center) {
        (void)fprintf(file, "  %-18s %8.1f deg\n", "heading offset",
                      (double)(DEG_PER_RAD * result->heading_offset_rad));
    }
    report_print_words(file, "orientations", setting->orientations);
    report_print_state(file, report);
    report_print_exit(file, report);
}
