/* SPDX-License-Identifier: MIT */
/* What the times of a recording tell. */
#include "input/check_time.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Steps that are needed for a verdict on the unit. */
#define ENOUGH_STEPS 5

/* Longest usual step of a recording that can be used, and shortest one of any sensor, s. */
#define LONGEST_STEP_S 0.15
#define SHORTEST_STEP_S 5e-5

/* A clock that runs for so long below an earlier time was set back; before that, rows are only out of order. */
#define SET_BACK_S 1.0

/* Fewer rows out of order than this, or than one in a hundred, explain nothing. */
#define OUT_OF_ORDER 3u

/* A jump forward of at least so much, followed within so many rows by one back, is not a clock that was set but a few wild times. */
#define JUMP_S 10.0
#define JUMP_ROWS 3u

static void push_step(check_time_t *times, double step_s)
{
    if (step_s > 0.0 && times->step_count < CHECK_TIME_STEPS) {
        times->steps_s[times->step_count++] = step_s;
    }
    times->standing += (step_s == 0.0) ? 1 : 0;
}

/* The clock runs below an earlier time, and has for so long that it was set back, or that the earlier time was wrong. */
static void take_set_back(check_time_t *times, double t_s)
{
    const uint64_t jumped = times->since_jump - times->below;
    if (times->since_jump > 0 && jumped <= JUMP_ROWS && times->low_s >= times->before_jump_s) {
        times->ahead += jumped;
    } else {
        times->set_back++;
        times->set_back_s = fmax(times->set_back_s, times->top_s - times->low_s);
    }
    times->below = 0;
    times->since_jump = 0;
    times->top_s = t_s;
}

void check_time_push(check_time_t *times, double t_s)
{
    if (!isfinite(t_s)) {
        return;
    }
    if (times->rows > 0) {
        const double step_s = t_s - times->last_s;
        push_step(times, step_s);
        times->since_jump += (times->since_jump > 0) ? 1u : 0u;
        if (step_s > JUMP_S) {
            times->before_jump_s = times->last_s;
            times->since_jump = 1;
        }
    }
    if (times->rows == 0 || t_s >= times->top_s) {
        times->out_of_order += times->below;
        times->below = 0;
        times->top_s = t_s;
    } else {
        times->low_s = (times->below == 0) ? t_s : fmin(times->low_s, t_s);
        times->below++;
        if (t_s - times->low_s > SET_BACK_S) {
            take_set_back(times, t_s);
        }
    }
    times->rows++;
    times->last_s = t_s;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double check_time_step_s(const check_time_t *times)
{
    double steps[CHECK_TIME_STEPS];
    memcpy(steps, times->steps_s, sizeof steps);
    qsort(steps, times->step_count, sizeof steps[0], compare);
    return (times->step_count < ENOUGH_STEPS) ? 0.0 : steps[times->step_count / 2];
}

uint64_t check_time_out_of_order(const check_time_t *times)
{
    return times->out_of_order + times->below;
}

/* The unit that makes a step one of a sensor with 5 to 5000 rows a second, in words; empty if none does. */
static const char *unit_words(double step_s)
{
    if (step_s >= 2e8) {
        return "";
    }
    if (step_s >= 2e5) {
        return ": these look like nanoseconds, divide by 1000000000";
    }
    if (step_s >= 200.0) {
        return ": these look like microseconds, divide by 1000000";
    }
    if (step_s >= 1.0) {
        return ": these look like milliseconds, divide by 1000; or like a count of rows, divide by their rate";
    }
    return (step_s < 1e-6) ? ": these look like days, multiply by 86400" : "";
}

/* More than a third of the rows have no time of their own. */
static bool stands(const check_time_t *times)
{
    return times->rows >= 20 && 3 * times->standing > times->rows;
}

static bool wrong_unit(double step_s)
{
    return step_s > LONGEST_STEP_S || (step_s > 0.0 && step_s < SHORTEST_STEP_S);
}

bool check_time_explains(const check_time_t *times)
{
    return stands(times) || wrong_unit(check_time_step_s(times)) || times->set_back > 0 ||
           (check_time_out_of_order(times) >= OUT_OF_ORDER && 100 * check_time_out_of_order(times) > times->rows);
}

size_t check_time_sentences(const check_time_t *times, sentence_t *sentences, size_t most)
{
    size_t count = 0;
    const double step_s = check_time_step_s(times);
    if (stands(times) && count < most) {
        (void)snprintf(sentences[count++], SENTENCE_MAX,
                       "%" PRIu64 " of %" PRIu64
                       " rows have the time of the row before: t_s has too few decimals, or rows come more than once",
                       times->standing, times->rows);
    } else if (count < most && wrong_unit(step_s)) {
        (void)snprintf(sentences[count++], SENTENCE_MAX, "rows are %.6g s apart; t_s is in seconds%s", step_s,
                       unit_words(step_s));
    }
    const uint64_t out_of_order = check_time_out_of_order(times);
    if (out_of_order > 0 && count < most) {
        (void)snprintf(sentences[count++], SENTENCE_MAX, "%" PRIu64 " row%s out of order: sort by t_s, or give --sort",
                       out_of_order, (out_of_order == 1) ? "" : "s");
    }
    if (times->ahead > 0 && count < most) {
        (void)snprintf(sentences[count++], SENTENCE_MAX,
                       "%" PRIu64 " times are far ahead of those before and after: that t_s is wrong", times->ahead);
    }
    if (times->set_back > 0 && count < most) {
        (void)snprintf(sentences[count++], SENTENCE_MAX,
                       (times->set_back > 1)
                           ? "t_s goes back %" PRIu32 " times, by up to %.6g s: sort by t_s, or give --sort"
                           : "t_s goes back %" PRIu32
                             " time, by %.6g s: the clock began anew, or two recordings stand in one file",
                       times->set_back, times->set_back_s);
    }
    return count;
}
