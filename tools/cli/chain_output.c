/* SPDX-License-Identifier: MIT */
/* What `jointcal chain` writes: the parts that only hip and knee have. */
#include "chain_output.h"

#include <math.h>
#include <string.h>

#define MM_PER_M 1000.0f

const report_words_t CHAIN_WORDS = {
    .name = "Hip and knee",
    .misfit =
        "no fixed point of both segments explains the data: soft tissue, a joint that glides, sensors that share none, or another "
        "thigh length than the one given",
    .ambiguous = "other centres explain the data about equally",
    .move_joint = "turn both segments of that joint about all axes, briskly",
    .asked_for = "both centres from all sensors",
    .bounded = "hip and knee",
    .unit = "mm",
    .per_unit = MM_PER_M,
    .unknown = JCAL_BOUND_UNKNOWN_M,
};

static const char *const KEYS[JCAL_CHAIN_PLACES] = {"hip_to_pelvis_m", "hip_to_thigh_m", "knee_to_thigh_m",
                                                    "knee_to_shank_m"};
static const char *const LABELS[JCAL_CHAIN_PLACES] = {"hip to pelvis", "hip to thigh", "knee to thigh",
                                                      "knee to shank"};

finding_t chain_finding(const jcal_chain_result_t *result)
{
    const float *bounds = result->uncertainty_m;
    finding_t finding = {.status = result->head.status,
                         .engine = JCAL_ENGINE_STREAM,
                         .weak = result->head.weak,
                         .hint = result->head.hint,
                         .reason = result->head.reason,
                         .has_estimate = result->has_places,
                         .bound1 = fmaxf(bounds[0], bounds[1]),
                         .bound2 = fmaxf(bounds[2], bounds[3]),
                         .samples = result->head.samples,
                         .rejected = result->head.rejected};
    memcpy(finding.rejected_by, result->head.rejected_by, sizeof finding.rejected_by);
    return finding;
}

void chain_write_json(FILE *file, const char *event, const report_t *report, const jcal_chain_result_t *result)
{
    json_t json = report_json_begin(file, event, report);
    bool bounded = false;
    for (int k = 0; k < JCAL_CHAIN_PLACES; k++) {
        const jcal_vec3_t r = result->place_m[k];
        const float values[3] = {r.x, r.y, r.z};
        json_numbers(&json, KEYS[k], result->has_places, values, 3);
        bounded = bounded || (result->has_places && result->uncertainty_m[k] < JCAL_BOUND_UNKNOWN_M);
    }
    json_numbers(&json, "uncertainty_m", bounded, result->uncertainty_m, JCAL_CHAIN_PLACES);
    json_number(&json, "segment_length_m", result->has_places ? result->segment_length_m : NAN);
    json_number(&json, "uncertainty_segment_m",
                (result->has_places && result->uncertainty_segment_m < JCAL_BOUND_UNKNOWN_M)
                    ? result->uncertainty_segment_m
                    : NAN);
    report_json_end(&json, &report->finding);
}

static void print_bound(FILE *file, float bound)
{
    if (bound < JCAL_BOUND_UNKNOWN_M) {
        (void)fprintf(file, "to within %.1f mm\n", (double)(MM_PER_M * bound));
    } else {
        (void)fputs("uncertainty unknown\n", file);
    }
}

static void print_places(FILE *file, const jcal_chain_result_t *result)
{
    for (int k = 0; k < JCAL_CHAIN_PLACES; k++) {
        const jcal_vec3_t r = result->place_m[k];
        (void)fprintf(file, "  %-18s %8.1f %8.1f %8.1f mm   ", LABELS[k], (double)(MM_PER_M * r.x),
                      (double)(MM_PER_M * r.y), (double)(MM_PER_M * r.z));
        print_bound(file, result->uncertainty_m[k]);
    }
    (void)fprintf(file, "  %-18s %8.1f mm                     ", "from hip to knee",
                  (double)(MM_PER_M * result->segment_length_m));
    print_bound(file, result->uncertainty_segment_m);
}

void chain_print_summary(FILE *file, const report_t *report, const jcal_chain_result_t *result,
                         const char *orientations)
{
    report_print_head(file, report);
    if (result->has_places) {
        print_places(file, result);
    } else {
        report_print_words(file, "places", "unknown");
    }
    report_print_words(file, "orientations", orientations);
    report_print_state(file, report);
    report_print_exit(file, report);
}
