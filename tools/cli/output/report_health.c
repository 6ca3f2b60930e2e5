/* SPDX-License-Identifier: MIT */
/* What `jointcal check` writes of each sensor. */
#include "output/report_health.h"

#include "input/check_health.h"

#include <math.h>
#include <string.h>

static bool is_named(const jcal_health_result_t *result, jcal_finding_t finding)
{
    return result->state[finding] == JCAL_HEALTH_NAMED;
}

const char *report_health_verdict(const jcal_health_result_t *result)
{
    static const jcal_finding_t wrong[] = {JCAL_FINDING_DEAD,      JCAL_FINDING_NO_GRAVITY, JCAL_FINDING_GRAVITY_OFF,
                                           JCAL_FINDING_RATE_UNIT, JCAL_FINDING_FRAMES,     JCAL_FINDING_SCALE};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        if (is_named(result, wrong[k])) {
            return "wrong";
        }
    }
    for (int k = 0; k < (int)JCAL_FINDING_COUNT; k++) {
        if (is_named(result, (jcal_finding_t)k)) {
            return "doubtful";
        }
    }
    return "ok";
}

/* A finding's fact, or that it is not known. */
static void fact(FILE *file, const jcal_health_result_t *result, jcal_finding_t finding, const char *format)
{
    if (result->state[finding] == JCAL_HEALTH_UNKNOWN) {
        (void)fputs("not known", file);
    } else {
        (void)fprintf(file, format, (double)result->fact[finding]);
    }
}

void report_health_print(FILE *file, int number, const jcal_health_result_t *result)
{
    (void)fprintf(file, "  sensor %-11d %s\n", number, report_health_verdict(result));
    (void)fprintf(file, "    motion           %.3g rad/s rms, %.3g s of it above 0.3 rad/s, %.3g s at rest\n",
                  (double)result->rms_rad_s, (double)result->motion_s, (double)result->rest_s);
    (void)fputs("    gravity          ", file);
    fact(file, result, JCAL_FINDING_GRAVITY_OFF, "%.4g m/s^2");
    (void)fprintf(file, "\n    frames           %s\n",
                  (result->state[JCAL_FINDING_FRAMES] == JCAL_HEALTH_UNKNOWN)
                      ? "not known"
                      : (is_named(result, JCAL_FINDING_FRAMES) ? "wrong" : "right"));
    (void)fputs("    scale            ", file);
    fact(file, result, JCAL_FINDING_SCALE, "gravity turns %.3f times as fast as the rates say");
    if (result->state[JCAL_FINDING_SCALE] != JCAL_HEALTH_UNKNOWN) {
        (void)fprintf(file, ", to within %.3f", (double)result->scale_bound);
    }
    (void)fputs("\n    vibration        ", file);
    fact(file, result, JCAL_FINDING_VIBRATES, "%.2g rad/s all the time");
    (void)fputs("\n", file);
}

static void number_of(json_t *json, const char *key, const jcal_health_result_t *result, jcal_finding_t finding)
{
    json_number(json, key, (result->state[finding] == JCAL_HEALTH_UNKNOWN) ? NAN : result->fact[finding]);
}

static void words_of(json_t *json, const char *key, const jcal_health_result_t *result)
{
    sentence_t words[JCAL_FINDING_COUNT];
    size_t count = 0;
    for (int k = 0; k < (int)JCAL_FINDING_COUNT; k++) {
        if (is_named(result, (jcal_finding_t)k)) {
            (void)snprintf(words[count++], SENTENCE_MAX, "%s", jcal_finding_string((jcal_finding_t)k));
        }
    }
    json_sentences(json, key, (const sentence_t *)words, count);
}

/* The components of a set, named as columns of the file are. */
static void components(json_t *json, const char *key, unsigned bits)
{
    static const char *const names[6] = {"gyr_x", "gyr_y", "gyr_z", "acc_x", "acc_y", "acc_z"};
    sentence_t words[6];
    size_t count = 0;
    for (unsigned k = 0; k < 6u; k++) {
        if ((bits & (1u << k)) != 0u) {
            (void)snprintf(words[count++], SENTENCE_MAX, "%s", names[k]);
        }
    }
    json_sentences(json, key, (const sentence_t *)words, count);
}

void report_health_json(json_t *json, const jcal_health_result_t *result)
{
    char way[32];
    check_health_way(result, way);
    json_word(json, "verdict", report_health_verdict(result));
    words_of(json, "findings", result);
    json_number(json, "rate_hz", (result->rate_hz > 0.0f) ? result->rate_hz : NAN);
    number_of(json, "jitter_s", result, JCAL_FINDING_UNEVEN);
    number_of(json, "missing_share", result, JCAL_FINDING_GAPS);
    json_count(json, "gaps", result->gaps);
    number_of(json, "frozen_s", result, JCAL_FINDING_FROZEN);
    number_of(json, "times_repeated", result, JCAL_FINDING_HELD);
    components(json, "dead", result->dead);
    components(json, "clipped", (unsigned)result->clipped | ((unsigned)result->clipped >> 6u));
    number_of(json, "gravity_m_s2", result, JCAL_FINDING_GRAVITY_OFF);
    json_number(json, "rest_s", result->rest_s);
    json_word(json, "frames", jcal_health_string(result->state[JCAL_FINDING_FRAMES]));
    json_word(json, "columns", (way[0] != '\0') ? way : NULL);
    json_word(json, "columns_of", (way[0] != '\0') ? (result->way_of_gyr ? "gyr" : "acc") : NULL);
    number_of(json, "scale", result, JCAL_FINDING_SCALE);
    json_number(json, "scale_bound",
                (result->state[JCAL_FINDING_SCALE] != JCAL_HEALTH_UNKNOWN) ? result->scale_bound : NAN);
    number_of(json, "vibration_rad_s", result, JCAL_FINDING_VIBRATES);
    json_number(json, "motion_rad_s", result->rms_rad_s);
    json_number(json, "motion_s", result->motion_s);
}
