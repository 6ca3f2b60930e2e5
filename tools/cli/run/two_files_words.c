/* SPDX-License-Identifier: MIT */
/* What there is to say of two files with clocks of their own. */
#include "run/two_files.h"

#include "output/json.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define US_PER_S 1e6
#define MS_PER_S 1e3
#define US_PER_MS 1000
#define PPM 1e6

/* Repeated readings that are worth a word, if most are. */
#define REPEATED 50u

two_files_lag_t two_files_lag(const two_files_t *two)
{
    two_files_lag_t lag = {.known = true, .lag_us = two->base_us};
    if (two->kind == TWO_FILES_GIVEN) {
        return lag;
    }
    const double t_s = (double)two->now_us / US_PER_S;
    lag.known = two->line.count > 0;
    lag.beyond_us = two->rough_us + (int64_t)llround(US_PER_S * clock_line_at(&two->line, t_s));
    lag.lag_us += lag.beyond_us;
    lag.bound_s = clock_line_bound(&two->line, t_s);
    lag.has_drift = two->line.count > 1;
    lag.drift = two->line.drift;
    lag.drift_bound = two->line.drift_bound;
    return lag;
}

/* The name of a file without its folders. */
static const char *short_name(const two_files_t *two, unsigned k)
{
    const char *name = two->config.names[k];
    const char *slash = strrchr(name, '/');
    return (slash != NULL) ? slash + 1 : name;
}

/* What is wrong with the times of a file; true if that explains why nothing is ready. */
static bool say_times(const two_files_t *two, unsigned k, check_findings_t *findings)
{
    const check_t *check = (two->checks[k].rows > 0) ? &two->checks[k] : &two->files[k].recording.check;
    sentence_t sentences[CHECK_SENTENCES];
    const size_t count = check_time_sentences(&check->times, sentences, CHECK_SENTENCES);
    if (check->rows == 0) {
        check_say(findings, "%.80s: there is a header line and no row below it", short_name(two, k));
    }
    for (size_t j = 0; j < count; j++) {
        check_say(findings, "%.80s: %.150s", short_name(two, k), sentences[j]);
    }
    return check->rows == 0 || check_time_explains(&check->times);
}

/* Readings that are wrong as they are: these words say more than that the lag is not known. */
static bool are_wrong(jcal_reason_t reason)
{
    return reason == JCAL_REASON_BAD_SAMPLES || reason == JCAL_REASON_WRONG_UNITS_GYR ||
           reason == JCAL_REASON_WRONG_UNITS_ACC || reason == JCAL_REASON_GRAVITY_OFF;
}

static const char *assumed(const two_files_t *two)
{
    return (two->kind == TWO_FILES_ONE_CLOCK) ? "the times as they are" : "both files beginning at once";
}

static void say_no_lag(const two_files_t *two, jcal_reason_t reason, check_findings_t *findings)
{
    check_findings_t own = {0};
    if (two->repeats) {
        check_say(
            &own,
            "the motion repeats itself: lags of sensor 2 of %.2f and %.2f s, beside %s, fit about equally; --lag S gives the lag, say "
            "of a tap that both files show",
            (double)two->best_us / US_PER_S, (double)two->rival_us / US_PER_S, assumed(two));
    } else if (two->moved) {
        check_say(&own,
                  "the lag of sensor 2 was not found within 2 s of %s: do these sensors share a joint? --lag S gives "
                  "the lag, say of a tap that both files show",
                  assumed(two));
    } else {
        check_say(&own, "too little motion to find the lag of sensor 2: it takes about 20 s of lively motion of both "
                        "segments; or --lag S gives it");
    }
    if (findings->explains || are_wrong(reason)) {
        check_say(findings, "%s", own.sentences[0]);
    } else {
        check_put_first(findings, &own, two->moved ? JCAL_REASON_NOT_ONE_JOINT : JCAL_REASON_NO_MOTION);
    }
}

/* A sensor that mostly repeats itself. */
static bool say_repeated(const two_files_t *two, unsigned k, check_findings_t *findings)
{
    const bool mostly = 2u * two->repeated[k] > two->readings[k];
    if (mostly && two->repeated[k] > REPEATED) {
        check_say(findings,
                  "%.80s: %" PRIu64 " of %" PRIu64
                  " readings repeat the one before: the sensor stands, or its packets are lost",
                  short_name(two, k), two->repeated[k], two->readings[k]);
        return two->pairs == 0;
    }
    return false;
}

jcal_health_result_t two_files_health(const two_files_t *two, unsigned k)
{
    return check_health_of(&two->files[k].recording.check, (int)k);
}

void two_files_health_findings(const two_files_t *two, const check_t *pairs, check_findings_t *findings)
{
    for (unsigned k = 0; k < 2u; k++) {
        const jcal_health_result_t own = two_files_health(two, k);
        const jcal_health_result_t paired = check_health_of(pairs, (int)k);
        for (int f = 0; f < (int)JCAL_FINDING_COUNT; f++) {
            sentence_t sentence;
            if (paired.state[f] != JCAL_HEALTH_NAMED &&
                check_health_sentence(&own, (jcal_finding_t)f, (int)k + 1, sentence)) {
                check_say(findings, "%.80s: %.150s", short_name(two, k), sentence);
            }
        }
    }
}

void two_files_findings(const two_files_t *two, jcal_reason_t reason, check_findings_t *findings)
{
    check_findings_t own = {0};
    const bool wrong1 = say_repeated(two, 0u, &own) || say_times(two, 0u, &own);
    const bool wrong2 = say_repeated(two, 1u, &own) || say_times(two, 1u, &own);
    const bool has_lag = two_files_lag(two).known;
    if (two->left_out > 0) {
        check_say(&own,
                  "%" PRIu64 " of %" PRIu64
                  " readings of sensor 2 are left out, where the lag is not known to within 12 ms: there is too "
                  "little motion, or a clock does not go evenly",
                  two->left_out, two->readings[1]);
    } else if (two->pairs == 0 && !wrong1 && !wrong2) {
        check_say(&own,
                  "no reading of one file is near one of the other in time: less than 10 a second, or another time");
    }
    if (wrong1 || wrong2 || two->pairs == 0) {
        findings->explains = false; /* that there are no pairs says less */
        findings->count = 0;
        check_put_first(findings, &own, JCAL_REASON_BAD_SAMPLES);
    } else {
        for (size_t k = 0; k < own.count; k++) {
            check_say(findings, "%s", own.sentences[k]);
        }
        if (!has_lag) {
            say_no_lag(two, reason, findings);
        }
    }
    findings->refuses = findings->refuses || !has_lag;
}

static void print_clocks(const two_files_t *two, FILE *file)
{
    char apart[32];
    const char *text = time_text(two->base_us, apart);
    if (two->kind == TWO_FILES_ONE_BEGINNING) {
        (void)fprintf(file, "  %-18s taken to begin at once, where their times are %s s apart\n", "both files", text);
    } else if (two->kind == TWO_FILES_ONE_CLOCK) {
        (void)fprintf(file, "  %-18s taken to have one clock, about\n", "both files");
    } else {
        (void)fprintf(file, "  %-18s %s s, as given by --lag\n", "lag of sensor 2", text);
    }
}

void two_files_print(const two_files_t *two, FILE *file)
{
    print_clocks(two, file);
    const two_files_lag_t lag = two_files_lag(two);
    if (!lag.known) {
        (void)fprintf(file, "  %-18s unknown\n", "lag of sensor 2");
    } else if (two->kind != TWO_FILES_GIVEN) {
        const int64_t whole_us = US_PER_MS * (int64_t)llround((double)lag.lag_us / (double)US_PER_MS);
        char whole[32];
        (void)fprintf(file, "  %-18s %s s at the end, %+.0f ms beside that, to within %.0f ms; taken off\n",
                      "lag of sensor 2", time_text(whole_us, whole), (double)lag.beyond_us / (double)US_PER_MS,
                      ceil(MS_PER_S * lag.bound_s));
    }
    if (lag.has_drift) {
        (void)fprintf(file, "  %-18s %+.0f ppm beside that of sensor 1, to within %.0f ppm; taken off\n",
                      "clock of sensor 2", PPM * lag.drift, ceil(PPM * lag.drift_bound));
    }
    (void)fprintf(file, "  %-18s %" PRIu64 " and %" PRIu64 ", which make %" PRIu64 " pairs, one every 10 ms\n",
                  "readings", two->readings[0], two->readings[1], two->pairs);
}
