/* SPDX-License-Identifier: MIT */
/// @file
/// What every calibration reports, whatever the joint: JSON Lines and text for people.
#ifndef JCAL_CLI_OUTPUT_REPORT_H
#define JCAL_CLI_OUTPUT_REPORT_H

#include "input/check.h"
#include "input/row_clock.h"
#include "jointcal/jointcal.h"
#include "output/json.h"

/// A bound from here on says nothing: any two axes are at most a quarter turn apart.
#define BOUND_UNKNOWN_RAD 1.5707f

/// Words that differ between joints.
typedef struct {
    const char *name;        ///< As a heading: "Hinge".
    const char *misfit;      ///< What it means that the data do not fit.
    const char *ambiguous;   ///< What it means that another minimum fits as well.
    const char *move_joint;  ///< How to move the joint.
    const char *moved;       ///< What else it may be if a sensor seems to have moved; null if nothing.
    const char *asked_for;   ///< What must be known to within the bound: "both axes".
    const char *bounded;     ///< What the two bounds of an event are of: "axes".
    const char *centers[2];  ///< What JCAL_WEAK_CENTER1 and _CENTER2 are, where they are of two joints; else null.
    const char *turn[2][2];  ///< With these: how to turn the proximal and the distal segment of each.
    const char *unit;        ///< Of bounds as a person reads them ...
    float per_unit;          ///< ... and how many of it make a rad or a metre.
    float unknown;           ///< Bounds from here on say nothing, rad or m.
} report_words_t;

/// What a line about an event tells of an estimate.
typedef struct {
    bool known;            ///< There is an estimate.
    float bound1, bound2;  ///< 95 % bounds of both axes, rad, or of both places, m.
} report_bounds_t;

/// Two axes and their bounds, rad.
typedef struct {
    bool known;  ///< At least one is; the other one is zero if it is not.
    jcal_vec3_t axis1, axis2;
    float bound1, bound2;
} report_axes_t;

/// The lag of sensor 2 behind sensor 1.
typedef struct {
    bool known;
    int64_t lag_us;  ///< Sensor 2's times less those of sensor 1 at the same moment.
    float bound_s;   ///< 95 %; NaN if it is given.
    bool two_files;  ///< They have clocks of their own:
    float drift;     ///< seconds a second by which that of sensor 2 is fast; NaN if it is not known.
} report_lag_t;

/// The head of a result and what the program knows besides.
typedef struct {
    const report_words_t *words;
    jcal_head_t head;  ///< Counters are of rows.
    report_bounds_t bounds;
    check_findings_t findings;  ///< Of the recording as a whole.
    row_clock_t clock;
    const char *orientations;  ///< Where they come from; null if none are in use.
    bool was_ready;            ///< Ready was entered at least once.
    int64_t ready_us;          ///< When it was entered first, as in the file.
    bool has_moved;            ///< A sensor has moved and the joint was not ready since ...
    int64_t moved_us;          ///< ... this time.
    void (*print_more)(const void *context,
                       FILE *file);  ///< Writes labelled lines on where the rows come from; or null.
    const void *more;                ///< Its context.
    float max_bound;                 ///< What the bounds must be below, rad or m.
} report_t;

/// False for the zeros that stand for an axis of which nothing is known.
bool report_is_axis(jcal_vec3_t axis);

/// Says so if the sign of axis 1 hangs on a tie: its two largest components are equal to within what it is uncertain by.
void report_advise_sign(const report_axes_t *axes, check_findings_t *findings);

/// Lets findings that refuse or explain take the place of what the library can say.
void report_apply_findings(report_t *report);

/// Why the status is not ready, in words; null if it is.
const char *report_reason(const report_t *report);

/// What would help, in words; null if nothing is known that would.
const char *report_help(const report_t *report);

/// Begins a line of JSON: the keys from `event` to `reason`. `event` is estimate, ready, moved or end.
json_t report_json_begin(FILE *file, const char *event, const report_t *report);

/// Goes on with the keys `axis1`, `axis2` and `uncertainty_deg`.
void report_json_axes(json_t *json, const report_axes_t *axes);

/// A vector, or null.
void report_json_vector(json_t *json, const char *key, bool known, jcal_vec3_t v);

/// The key `lag_s`; of two files `lag_uncertainty_s` and `drift_ppm` too.
void report_json_lag(json_t *json, const report_lag_t *lag);

/// Says so if the sensors of one file are out of step; `step_s` is the time from row to row, 0 if it is not known.
void report_advise_lag(const report_lag_t *lag, double step_s, check_findings_t *findings);

/// The key `rejected_by`.
void json_rejected(json_t *json, const uint32_t rejected_by[static JCAL_REJECT_COUNT]);

/// Ends it with `advice` and the counters.
void report_json_end(json_t *json, const report_t *report);

/// One line of text for an event in the middle: estimate, ready, moved.
void report_print_event(FILE *file, const char *event, const report_t *report);

/// A labelled line of the summary, or nothing if there are no words.
void report_print_words(FILE *file, const char *label, const char *words);

/// How many rows were read and rejected, and why.
void report_print_samples(FILE *file, uint32_t samples, uint32_t rejected,
                          const uint32_t rejected_by[static JCAL_REJECT_COUNT]);

/// Beginning of the summary: status.
void report_print_head(FILE *file, const report_t *report);

/// Both axes and their bounds.
void report_print_axes(FILE *file, const report_axes_t *axes);

/// A place in metres with its bound, in millimetres.
void report_print_place(FILE *file, const char *label, jcal_vec3_t place_m, float bound_m);

/// Ends a line with a bound in millimetres.
void report_print_bound_mm(FILE *file, float bound_m);

/// Where the orientations come from, if any are in use.
void report_print_orientations(FILE *file, const report_t *report);

/// Middle of the summary: what was asked for, what is missing, and the counters.
void report_print_state(FILE *file, const report_t *report);

/// Last line of the summary.
void report_print_exit(FILE *file, const report_t *report);

#endif
