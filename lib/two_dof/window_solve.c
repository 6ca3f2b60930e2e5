/* SPDX-License-Identifier: MIT */
/// @file
/// Steps, search and judgement of the 2-DoF window engine. See two_dof/window_solve.h.
#include "two_dof/window_solve.h"

#include "joint/watch.h"
#include "math/scalar.h"
#include "two_dof/starts.h"
#include "two_dof/step.h"
#include "two_dof/verdict.h"

#include <float.h>
#include <string.h>

/// The estimate's steps are damped by this little: enough for directions in which nothing moves.
#define FOLLOW_DAMPING 1e-4f

/// Kept samples from one judgement to the next.
#define TURNS 4u
/// Passes besides the estimate's own.
#define SEARCH_PASSES 2u

static const float s_per_us = 1e-6f;

static void begin(jcal_two_dof_trace_t *trace, const jcal_two_dof_point_t *point, float sine)
{
    *trace = (jcal_two_dof_trace_t){0};
    trace->point = *point;
    trace->from = *point;
    trace->sine = sine;
    trace->from_sine = sine;
    trace->damping = JCAL_GN_DAMPING_START;
}

/// A step from trace->point, where the sums are `sums`. Returns its length, rad.
static float make_step(jcal_two_dof_trace_t *trace, jcal_gn_t *gn, const jcal_two_dof_window_sums_t *sums, unsigned n)
{
    const jcal_gn_model_t model = {n, sums->gradient, sums->matrix};
    float d[JCAL_TWO_DOF_WINDOW_UNKNOWNS] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    trace->from = trace->point;
    trace->from_sine = trace->sine;
    const float length = jcal_two_dof_make_step(gn, &model, &trace->point, d, &trace->predicted);
    trace->sine += d[5];
    return length;
}

/// Judges the last step and makes the next one; costs are compared per row, as rows came in meanwhile.
static float advance(jcal_two_dof_trace_t *trace, const jcal_two_dof_rows_t *rows,
                     const jcal_two_dof_window_sums_t *sums)
{
    const float count = (float)rows->count;
    const float change = 0.5f * (sums->cost - (trace->from_cost * count));
    jcal_gn_t gn = {trace->damping};
    if ((trace->steps > 0u) && (trace->predicted < 0.0f)) {
        const bool kept = jcal_gn_judge(&gn, trace->predicted, change);
        if (!kept && (change > (JCAL_TWO_DOF_HARMLESS_SHARE * sums->cost))) {
            trace->damping = gn.damping;
            trace->point = trace->from;
            trace->sine = trace->from_sine;
            trace->predicted = 0.0f;
            return JCAL_TWO_DOF_STEP_MAX_RAD;
        }
        gn.damping = kept ? gn.damping : trace->damping;
    }
    trace->cost = sums->weighted;
    trace->from_cost = sums->cost / count;
    const float length = make_step(trace, &gn, sums, jcal_two_dof_window_unknowns(rows->cfg->constraint));
    trace->damping = gn.damping;
    return length;
}

/// One step of a minimum that is followed, as B.2 has it: always taken.
static void follow(jcal_two_dof_trace_t *trace, const jcal_two_dof_rows_t *rows, jcal_two_dof_window_sums_t *sums)
{
    jcal_gn_t gn = {FOLLOW_DAMPING};
    jcal_two_dof_window_sum(rows, &trace->point, trace->sine, sums);
    trace->cost = sums->weighted;
    (void)make_step(trace, &gn, sums, jcal_two_dof_window_unknowns(rows->cfg->constraint));
}

static void start_anywhere(jcal_two_dof_window_search_t *search, const jcal_two_dof_rows_t *rows)
{
    float costs[JCAL_TWO_DOF_HEADINGS];
    float sines[JCAL_TWO_DOF_HEADINGS];
    jcal_two_dof_point_t point = jcal_two_dof_start(search->start);
    jcal_two_dof_window_costs(rows, &point, costs, sines);
    const unsigned least = jcal_two_dof_least(costs);
    point.heading = jcal_two_dof_start_headings()[least];
    begin(&search->probe, &point, sines[least]);
    search->start = jcal_two_dof_start_after(search->start);
}

/// Every other start, once there is an estimate, is the estimate with its axes exchanged.
static void begin_probe(jcal_two_dof_window_search_t *search, const jcal_two_dof_rows_t *rows,
                        const jcal_two_dof_row_t *newest)
{
    if (search->has_best && search->exchange) {
        const jcal_two_dof_point_t other = jcal_two_dof_exchanged(&search->best.point, newest->q1, newest->q2);
        begin(&search->probe, &other, search->best.sine);
        search->exchanges = (uint8_t)((search->exchanges < UINT8_MAX) ? (search->exchanges + 1u) : UINT8_MAX);
    } else {
        start_anywhere(search, rows);
    }
    search->exchange = !search->exchange;
    search->probing = true;
}

/// Makes a minimum the estimate; the one before it becomes the rival.
static void adopt(jcal_two_dof_window_search_t *search, jcal_two_dof_verdict_t *verdict,
                  const jcal_two_dof_trace_t *found)
{
    const jcal_two_dof_trace_t next = *found; /* it may be the rival */
    search->rival = search->best;
    search->has_rival = search->has_best;
    search->best = next;
    search->has_best = true;
    search->exchanges = 0u;
    verdict->agreed = 0u;
    verdict->status = (uint8_t)JCAL_COLLECTING;
    verdict->reason = (uint8_t)JCAL_REASON_UNCERTAIN;
    verdict->sine = next.sine;
    verdict->sign1 = 0; /* other axes */
    verdict->sign2 = 0;
}

/// The probe becomes the estimate that it is close to; the senses of the axes stay.
static void refine(jcal_two_dof_window_search_t *search)
{
    jcal_two_dof_trace_t *const best = &search->best;
    jcal_two_dof_trace_t next = search->probe;
    const float turned = jcal_vec3_dot(next.point.j1, best->point.j1) * jcal_vec3_dot(next.point.j2, best->point.j2);
    next.point.j1 = jcal_two_dof_in_sense_of(next.point.j1, best->point.j1);
    next.point.j2 = jcal_two_dof_in_sense_of(next.point.j2, best->point.j2);
    next.sine = (turned < 0.0f) ? -next.sine : next.sine;
    *best = next;
}

/// Files what a finished probe found: the estimate itself, a better minimum or a rival.
static void file_probe(jcal_two_dof_window_search_t *search, jcal_two_dof_verdict_t *verdict)
{
    const jcal_two_dof_trace_t *const probe = &search->probe;
    search->tried = (uint8_t)((search->tried < UINT8_MAX) ? (search->tried + 1u) : UINT8_MAX);
    search->probing = false;
    if (!search->has_best) {
        adopt(search, verdict, probe);
        return;
    }
    const bool better = probe->cost < (search->best.cost - (JCAL_TWO_DOF_BETTER * verdict->excess));
    const bool same = jcal_two_dof_is_near(&search->best.point, &probe->point, JCAL_TWO_DOF_SAME_COSINE);
    if (same && better) {
        refine(search);
    } else if (better) {
        adopt(search, verdict, probe);
    } else if (!same && (!search->has_rival || (probe->cost < search->rival.cost))) {
        search->rival = *probe;
        search->has_rival = true;
    } else {
        /* neither the best nor the second */
    }
}

/// True if the next steps would have to gain several times what the last one promised to come near the estimate's cost.
static bool is_hopeless(const jcal_two_dof_window_search_t *search, const jcal_two_dof_window_sums_t *sums,
                        float excess)
{
    const float share = 1.0f + (JCAL_TWO_DOF_HOPE * 2.0f * search->probe.predicted / (sums->cost + FLT_MIN));
    return search->has_best && (search->probe.steps >= JCAL_TWO_DOF_HOPELESS_STEPS) &&
           ((sums->weighted * share) > (search->best.cost + (JCAL_TWO_DOF_HOPELESS_GAP * excess)));
}

/// One pass of the probe.
static void probe(jcal_two_dof_window_search_t *search, jcal_two_dof_verdict_t *verdict,
                  const jcal_two_dof_rows_t *rows, const jcal_two_dof_row_t *newest)
{
    if (!search->probing) {
        begin_probe(search, rows, newest);
        return;
    }
    jcal_two_dof_trace_t *const trace = &search->probe;
    jcal_two_dof_window_sums_t sums;
    jcal_two_dof_window_sum(rows, &trace->point, trace->sine, &sums);
    const float length = advance(trace, rows, &sums);
    trace->steps = (uint8_t)(trace->steps + 1u);
    const bool joined =
        search->has_best && jcal_two_dof_is_near(&search->best.point, &trace->point, JCAL_TWO_DOF_JOINED_COSINE);
    if ((length < JCAL_TWO_DOF_STEP_MIN_RAD) || (trace->steps >= JCAL_TWO_DOF_PROBE_STEPS) || joined ||
        is_hopeless(search, &sums, verdict->excess)) {
        file_probe(search, verdict);
    }
}

/// A step of the rival, which may turn out to be the estimate or better than it.
static void follow_rival(jcal_two_dof_window_search_t *search, jcal_two_dof_verdict_t *verdict,
                         const jcal_two_dof_rows_t *rows)
{
    jcal_two_dof_window_sums_t sums;
    follow(&search->rival, rows, &sums);
    if (jcal_two_dof_is_near(&search->best.point, &search->rival.point, JCAL_TWO_DOF_SAME_COSINE)) {
        search->has_rival = false;
    } else if (search->rival.cost < (search->best.cost - (JCAL_TWO_DOF_BETTER * verdict->excess))) {
        adopt(search, verdict, &search->rival);
    } else {
        /* the second best it stays */
    }
}

/// Mean age of the rows, rest left out, s.
static float age_of(const jcal_two_dof_rows_t *rows, const jcal_two_dof_row_t *newest)
{
    float sum = 0.0f;
    float time_s = 0.0f;
    for (size_t k = 0u; k < rows->count; ++k) {
        const jcal_two_dof_row_t *const row = &rows->rows[k];
        const float rate2 = jcal_vec3_dot(row->w1, row->w1) + jcal_vec3_dot(row->w2, row->w2);
        const float weight = row->dt_s * jcal_watch_motion(rate2);
        sum += weight * ((float)(newest->t_us - row->t_us) * s_per_us);
        time_s += weight;
    }
    return sum / (time_s + FLT_MIN);
}

/// covariance (5 x 5) of a cost in which all rows weigh alike, A^-1 B A^-1 with A = J' J and B its spread; false if A is singular.
static bool covariance_of(const jcal_two_dof_window_sums_t *sums, unsigned n, float excess, float *covariance)
{
    float matrix[JCAL_SYM_SIZE(JCAL_TWO_DOF_WINDOW_UNKNOWNS)];
    float inverse[JCAL_SYM_SIZE(JCAL_TWO_DOF_WINDOW_UNKNOWNS)];
    float full[JCAL_TWO_DOF_WINDOW_UNKNOWNS * JCAL_TWO_DOF_WINDOW_UNKNOWNS];
    (void)memcpy(matrix, sums->matrix, sizeof matrix);
    if (!jcal_two_dof_covariance(matrix, n, inverse)) {
        return false;
    }
    for (unsigned i = 0u; i < n; ++i) {
        for (unsigned k = 0u; k < n; ++k) {
            full[(i * n) + k] = inverse[jcal_sym_at(i, k)];
        }
    }
    jcal_sym_congruence(sums->spread, n, full, n, covariance);
    jcal_sym_scale(covariance, n, excess);
    return true;
}

/// Judges the estimate, at which the sums are `sums`.
static void judge(const jcal_two_dof_window_search_t *search, jcal_two_dof_verdict_t *verdict,
                  const jcal_two_dof_rows_t *rows, const jcal_two_dof_row_t *newest,
                  const jcal_two_dof_window_sums_t *sums)
{
    const bool turn = rows->cfg->constraint == JCAL_CONSTRAINT_ROTATION;
    const float per_excess = 1.0f / verdict->excess;
    float covariance[JCAL_SYM_SIZE(JCAL_TWO_DOF_WINDOW_UNKNOWNS)];
    const bool known =
        covariance_of(sums, jcal_two_dof_window_unknowns(rows->cfg->constraint), verdict->excess, covariance);
    const jcal_two_dof_evidence_t evidence = {
        .point = &search->best.point,
        .covariance = known ? covariance : NULL,
        .parts = {turn ? sums->weighted : 0.0f, turn ? 0.0f : sums->weighted},
        .moving_s = sums->moving_s,
        .age_s = age_of(rows, newest),
        .sine = sums->sine,
        .complaint = rows->complaint,
        .cost = search->best.cost * per_excess,
        .rival_cost = search->rival.cost * per_excess,
        .has_rival = search->has_rival,
        .tried = search->tried,
        .exchanges = search->exchanges,
    };
    jcal_two_dof_conclude(verdict, rows->cfg, &evidence);
}

void jcal_two_dof_window_work(jcal_two_dof_window_search_t *search, jcal_two_dof_verdict_t *verdict,
                              const jcal_two_dof_rows_t *rows, const jcal_two_dof_row_t *newest)
{
    unsigned passes = SEARCH_PASSES;
    if (search->has_best) {
        jcal_two_dof_window_sums_t sums;
        follow(&search->best, rows, &sums);
        verdict->sine = sums.sine;
        if (search->turn == 0u) {
            judge(search, verdict, rows, newest, &sums);
        }
    }
    if (search->has_rival && (search->turn == (TURNS - 1u))) {
        follow_rival(search, verdict, rows);
        passes -= 1u;
    }
    for (unsigned i = 0u; i < passes; ++i) {
        probe(search, verdict, rows, newest);
    }
    search->turn = (uint8_t)((search->turn + 1u) % TURNS);
}
