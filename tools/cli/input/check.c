/* SPDX-License-Identifier: MIT */
/* What is wrong with a recording as a whole. */
#include "input/check.h"

#include "units.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Sensors that are compared with each other. */
static const int PAIRS[CHECK_PAIRS][2] = {{0, 1}, {0, 2}, {1, 2}};

/* Rows that tell whether two sensors are the same one, and how many of them must be equal. */
#define ENOUGH_ROWS 50u
#define SAME_SHARE 0.95

/* Equal to the last digit or so, and not because both are dead. */
static bool same(jcal_vec3_t a, jcal_vec3_t b)
{
    const float size = jcal_vec3_norm(a);
    return size > 0.0f && jcal_vec3_norm(jcal_vec3_sub(a, b)) <= 1e-5f * size;
}

static void compare_sensors(check_t *check, const check_row_t *row)
{
    for (int k = 0; k < CHECK_PAIRS; k++) {
        const jcal_imu_t *a = row->imu[PAIRS[k][0]];
        const jcal_imu_t *b = row->imu[PAIRS[k][1]];
        if (a != NULL && b != NULL && isfinite(a->gyr_rad_s.x) && isfinite(b->gyr_rad_s.x)) {
            check->pair_rows[k]++;
            check->same_gyr[k] += same(a->gyr_rad_s, b->gyr_rad_s) ? 1u : 0u;
            check->same_acc[k] += same(a->acc_m_s2, b->acc_m_s2) ? 1u : 0u;
        }
    }
}

void check_push(check_t *check, const check_row_t *row)
{
    check->rows++;
    check_time_push(&check->times, row->t_s);
    if (check->times_only) {
        return;
    }
    compare_sensors(check, row);
    for (int k = 0; k < CHECK_SENSORS; k++) {
        if (row->has_time && row->imu[k] != NULL) {
            check_sensor_push(&check->sensors[k], row->imu[k], row->t_us);
            check_health_push(&check->health[k], row->imu[k], row->t_us);
        }
    }
}

void check_say(check_findings_t *findings, const char *format, ...)
{
    if (findings->count < CHECK_SENTENCES) {
        va_list arguments;
        va_start(arguments, format);
        (void)vsnprintf(findings->sentences[findings->count++], SENTENCE_MAX, format, arguments);
        va_end(arguments);
    }
}

void check_put_first(check_findings_t *findings, const check_findings_t *first, jcal_reason_t reason)
{
    const check_findings_t rest = *findings;
    memcpy(findings->sentences, first->sentences, sizeof findings->sentences);
    findings->count = first->count;
    for (size_t k = 0; k < rest.count; k++) {
        check_say(findings, "%s", rest.sentences[k]);
    }
    findings->explains = true;
    findings->reason = reason;
}

static void say_same(const check_t *check, check_findings_t *findings)
{
    for (int k = 0; k < CHECK_PAIRS; k++) {
        const double rows = SAME_SHARE * check->pair_rows[k];
        const bool gyr = check->same_gyr[k] > rows;
        const bool acc = check->same_acc[k] > rows;
        if (check->pair_rows[k] >= ENOUGH_ROWS && (gyr || acc)) {
            const char *what = (gyr && acc) ? "columns" : (gyr ? "rates" : "accelerations");
            check_say(findings, "the %s of sensor %d are those of sensor %d: the same sensor was written twice", what,
                      PAIRS[k][1] + 1, PAIRS[k][0] + 1);
            findings->refuses = true;
            findings->reason = JCAL_REASON_BAD_SAMPLES;
        }
    }
}

/* Unit of rates that gravity turns `scale` times as fast as. Gyroscopes count 14 to 131 to the degree a second. */
static void say_rate_unit(check_findings_t *findings, int sensor, double scale)
{
    const double per_rad_s = 1.0 / scale;
    const double per_deg_s = per_rad_s / (double)DEG_PER_RAD;
    if (scale > 1.0) {
        check_say(
            findings,
            "rates of sensor %d: gravity turns %.3g times as fast as they say with t_s in seconds; rad/s and s are needed",
            sensor, scale);
    } else if (per_deg_s > 0.6 && per_deg_s < 1.7) {
        check_say(findings, "rates of sensor %d look like deg/s; rad/s are needed: multiply by 0.0174533", sensor);
    } else if (per_deg_s > 600.0 && per_deg_s < 1700.0) {
        check_say(findings,
                  "rates of sensor %d look like thousandths of deg/s; rad/s are needed: multiply by 1.74533e-05",
                  sensor);
    } else if (per_deg_s > 8.0 && per_deg_s < 200.0) {
        check_say(
            findings,
            "rates of sensor %d look like raw counts, about %.0f to 1 deg/s; rad/s are needed: divide by what the data "
            "sheet says and multiply by 0.0174533",
            sensor, per_deg_s);
    } else {
        check_say(findings, "rates of sensor %d are about %.3g times as large as rad/s, which are needed", sensor,
                  per_rad_s);
    }
}

static void say_frames(check_findings_t *findings, int sensor, const check_sensor_verdict_t *verdict)
{
    char way[32] = "";
    for (int k = 0; k < 3; k++) {
        const size_t length = strlen(way);
        (void)snprintf(way + length, sizeof way - length, "%s%s%c", (k > 0) ? ", " : "",
                       (verdict->sign[k] < 0) ? "-" : "", "xyz"[verdict->column[k]]);
    }
    check_say(findings, "rates and accelerations of sensor %d are not in one right-handed frame%s%s", sensor,
              verdict->way_known ? "; they fit if acc x, y, z are read from the columns "
                                 : ": check order and signs of the columns",
              verdict->way_known ? way : "");
}

/* Unit of accelerations in which gravity reads so much. */
static void say_acc_unit(check_findings_t *findings, int sensor, double gravity)
{
    static const struct {
        double gravity;
        const char *words;
    } units[] = {{1.0, "g; m/s^2 are needed: multiply by 9.80665"},
                 {32.174, "ft/s^2; m/s^2 are needed: multiply by 0.3048"},
                 {256.0, "raw counts, 256 to 1 g; m/s^2 are needed: multiply by 0.0383072"},
                 {512.0, "raw counts, 512 to 1 g; m/s^2 are needed: multiply by 0.0191536"},
                 {1000.0, "mg (or cm/s^2); m/s^2 are needed: multiply by 0.00980665 (or 0.01)"},
                 {2048.0, "raw counts, 2048 to 1 g; m/s^2 are needed: multiply by 0.0047884"},
                 {4096.0, "raw counts, 4096 to 1 g; m/s^2 are needed: multiply by 0.0023942"},
                 {8192.0, "raw counts, 8192 to 1 g; m/s^2 are needed: multiply by 0.0011971"},
                 {9806.65, "mm/s^2; m/s^2 are needed: multiply by 0.001"},
                 {16384.0, "raw counts, 16384 to 1 g; m/s^2 are needed: multiply by 0.00059855"}};
    for (size_t k = 0; k < sizeof units / sizeof units[0]; k++) {
        if (fabs(log(gravity / units[k].gravity)) < 0.09) {
            check_say(findings, "accelerations of sensor %d look like %s", sensor, units[k].words);
            return;
        }
    }
    check_say(
        findings,
        "accelerations of sensor %d: gravity is %.3g in them where it is 9.81 m/s^2; check their unit, and whether gravity "
        "was taken out",
        sensor, gravity);
}

static jcal_reason_t reason_of(check_sensor_fault_t fault)
{
    switch (fault) {
    case CHECK_SENSOR_RATE_UNIT:
        return JCAL_REASON_WRONG_UNITS_GYR;
    case CHECK_SENSOR_ACC_UNIT:
        return JCAL_REASON_WRONG_UNITS_ACC;
    case CHECK_SENSOR_FRAMES:
    case CHECK_SENSOR_TURNS_BACK:
    case CHECK_SENSOR_RATES:
    case CHECK_SENSOR_NO_GRAVITY:
    case CHECK_SENSOR_FINE:
    default:
        return JCAL_REASON_BAD_SAMPLES;
    }
}

static void say_sensor(const check_sensor_t *sensor, int number, check_findings_t *findings)
{
    const check_sensor_verdict_t verdict = check_sensor_verdict(sensor);
    switch (verdict.fault) {
    case CHECK_SENSOR_RATE_UNIT:
        say_rate_unit(findings, number, verdict.scale);
        break;
    case CHECK_SENSOR_FRAMES:
        say_frames(findings, number, &verdict);
        break;
    case CHECK_SENSOR_TURNS_BACK:
        check_say(
            findings,
            "rates of sensor %d turn the wrong way round: all three have the wrong sign, or its frame is left-handed; turn the signs of "
            "its rates round",
            number);
        break;
    case CHECK_SENSOR_RATES:
        check_say(
            findings,
            "rates of sensor %d do not fit how gravity turns: check that they are in rad/s, and order and signs of the "
            "columns",
            number);
        break;
    case CHECK_SENSOR_NO_GRAVITY:
        check_say(
            findings,
            "no gravity in the accelerations of sensor %d: it was taken out; record what the accelerometer reads, which is "
            "9.81 m/s^2 upward at rest",
            number);
        break;
    case CHECK_SENSOR_ACC_UNIT:
        say_acc_unit(findings, number, verdict.gravity);
        break;
    case CHECK_SENSOR_FINE:
    default:
        return;
    }
    findings->refuses = true;
    if (findings->reason == JCAL_REASON_NONE || findings->reason == JCAL_REASON_BAD_SAMPLES) {
        findings->reason = reason_of(verdict.fault);
    }
}

/* How often a reading comes, for all sensors that share it. */
static void say_held(check_findings_t *findings, const char *what, const int times[static CHECK_SENSORS])
{
    for (int k = 0; k < CHECK_SENSORS; k++) {
        if (times[k] < 2 || (k > 0 && times[k] == times[0]) || (k > 1 && times[k] == times[1])) {
            continue;
        }
        char names[32] = "";
        const char *before = "";
        for (int j = k; j < CHECK_SENSORS; j++) {
            if (times[j] == times[k]) {
                const size_t length = strlen(names);
                (void)snprintf(names + length, sizeof names - length, "%s%d", before, j + 1);
                before = " and ";
            }
        }
        check_say(findings,
                  "each reading of the %s comes %d times (sensor%s %s): it is held between new ones, which is no fault",
                  what, times[k], (strlen(names) > 1) ? "s" : "", names);
    }
}

static void say_times(const check_t *check, check_findings_t *findings)
{
    findings->count +=
        check_time_sentences(&check->times, &findings->sentences[findings->count], CHECK_SENTENCES - findings->count);
}

/* A gyroscope that is off by more than this makes answers wrong that fit. */
#define GRAVE_SCALE 0.1

/* With such a finding an answer would be wrong although it may fit. */
static bool is_grave(const jcal_health_result_t *result, jcal_finding_t finding)
{
    return finding == JCAL_FINDING_DEAD || finding == JCAL_FINDING_FRAMES ||
           (finding == JCAL_FINDING_SCALE && fabs((double)result->fact[finding] - 1.0) > GRAVE_SCALE);
}

/* What the library's health adds of one sensor; of units and frames nothing where something was said of them. */
static void say_health_of(const check_t *check, int sensor, bool grave, check_findings_t *findings)
{
    const jcal_health_result_t result = check_health_get(&check->health[sensor]);
    const check_sensor_t *own = &check->sensors[sensor];
    const bool is_told = check_sensor_verdict(own).fault != CHECK_SENSOR_FINE;
    const bool is_held =
        check_sensor_acc_held(own) > 1 || check_sensor_gyr_held(own) > 1 || check_sensor_both_held(own) > 1;
    for (int k = (int)JCAL_FINDING_FROZEN; k < (int)JCAL_FINDING_COUNT && findings->count < CHECK_SENTENCES; k++) {
        const jcal_finding_t finding = (jcal_finding_t)k;
        const bool of_columns = k >= (int)JCAL_FINDING_NO_GRAVITY;
        if ((finding == JCAL_FINDING_HELD && is_held) || (of_columns && is_told) ||
            is_grave(&result, finding) != grave) {
            continue;
        }
        if (check_health_sentence(&result, finding, sensor + 1, findings->sentences[findings->count])) {
            findings->count++;
            findings->refuses = findings->refuses || grave;
        }
    }
}

/* Rows have one time for all sensors, so what the first one's readings say of times is enough. */
static void say_health_times(const check_t *check, check_findings_t *findings)
{
    const jcal_health_result_t result = check_health_get(&check->health[0]);
    for (int k = 0; k < (int)JCAL_FINDING_FROZEN && findings->count < CHECK_SENTENCES; k++) {
        if (check_health_sentence(&result, (jcal_finding_t)k, 1, findings->sentences[findings->count])) {
            findings->count++;
        }
    }
}

static void say_health(const check_t *check, check_findings_t *findings)
{
    if (!check_time_explains(&check->times)) {
        say_health_times(check, findings);
    }
    for (int k = 0; k < CHECK_SENSORS; k++) {
        say_health_of(check, k, false, findings);
    }
}

static void say_sensors(const check_t *check, check_findings_t *findings)
{
    say_same(check, findings);
    for (int k = 0; k < CHECK_SENSORS; k++) {
        say_sensor(&check->sensors[k], k + 1, findings);
        say_health_of(check, k, true, findings);
    }
}

jcal_health_result_t check_health_of(const check_t *check, int index)
{
    return check_health_get(&check->health[index]);
}

static void say_remarks(const check_t *check, check_findings_t *findings)
{
    int acc[CHECK_SENSORS];
    int gyr[CHECK_SENSORS];
    int both[CHECK_SENSORS];
    for (int k = 0; k < CHECK_SENSORS; k++) {
        acc[k] = check_sensor_acc_held(&check->sensors[k]);
        gyr[k] = check_sensor_gyr_held(&check->sensors[k]);
        both[k] = check_sensor_both_held(&check->sensors[k]);
    }
    say_held(findings, "accelerometer", acc);
    say_held(findings, "gyroscope", gyr);
    say_held(findings, "whole sensor", both);
}

void check_findings(const check_t *check, check_findings_t *findings)
{
    const bool times_explain = check_time_explains(&check->times);
    memset(findings, 0, sizeof *findings);
    if (check->rows == 0) {
        check_say(findings, "there is a header line and no row below it");
    }
    if (times_explain) {
        say_times(check, findings);
    }
    if (!check->times_only) {
        say_sensors(check, findings);
    }
    findings->explains = findings->count > 0;
    if (findings->reason == JCAL_REASON_NONE || times_explain) {
        findings->reason = JCAL_REASON_BAD_SAMPLES;
    }
    if (!times_explain) {
        say_times(check, findings);
    }
    if (!check->times_only) {
        say_remarks(check, findings);
        say_health(check, findings);
    }
}

void check_measures(const check_t *check, check_measures_t *measures)
{
    memset(measures, 0, sizeof *measures);
    measures->step_s = check_time_step_s(&check->times);
    measures->out_of_order = check_time_out_of_order(&check->times);
    for (int k = 0; k < CHECK_SENSORS; k++) {
        const check_sensor_verdict_t verdict = check_sensor_verdict(&check->sensors[k]);
        measures->gravity_m_s2[k] = verdict.gravity;
        measures->gravity_turns[k] = verdict.scale;
        measures->gravity_fit[k] = verdict.fit;
    }
}
