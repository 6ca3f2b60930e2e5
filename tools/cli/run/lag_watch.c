/* SPDX-License-Identifier: MIT */
/* The lag of two sensors from their readings. */
#include "run/lag_watch.h"

#include <math.h>
#include <string.h>

/* Time of the first row of a file that has both sensors. */
#define ORIGIN_US UINT64_C(1000000000000)

#define US_PER_S 1e6

/* Sums that shrink to less than this share of what they were began anew; those that shrink less were faded. */
#define FADED_SHARE 0.3f

bool lag_watch_begin(lag_watch_t *watch)
{
    memset(watch, 0, sizeof *watch);
    return jcal_sensor_init(&watch->sensor1) == JCAL_OK && jcal_sensor_init(&watch->sensor2) == JCAL_OK &&
           lag_watch_again(watch);
}

bool lag_watch_again(lag_watch_t *watch)
{
    const jcal_pairing_config_t config = jcal_pairing_config_default();
    watch->motion_s = 0.0f;
    watch->bound_s = 0.0f;
    watch->weighted_us = 0.0;
    watch->anew_us = watch->now_us;
    return jcal_pairing_init(&watch->pairing, &config) == JCAL_OK && jcal_lag_init(&watch->lag) == JCAL_OK;
}

/* Follows when the motion was that is in the estimator's sums. */
static void follow_motion(lag_watch_t *watch)
{
    jcal_lag_result_t result;
    (void)jcal_lag_get(&watch->lag, &result);
    const float before_s = watch->motion_s;
    const double since_us = (double)(int64_t)(watch->now_us - watch->begun_us);
    if (result.motion_s >= before_s) {
        watch->weighted_us += (double)(result.motion_s - before_s) * since_us;
        watch->all_motion_s += result.motion_s - before_s;
    } else if (result.motion_s > FADED_SHARE * before_s) {
        watch->weighted_us *= (double)(result.motion_s / before_s);
    } else {
        watch->weighted_us = (double)result.motion_s * since_us;
    }
    if (result.lag_known && result.bound_s != watch->bound_s && result.motion_s > 0.0f) {
        const double middle_us = watch->weighted_us / (double)result.motion_s; /* judged just now */
        watch->left = result.left;
        watch->at_us = watch->begun_us + (uint64_t)(int64_t)middle_us;
    }
    watch->bound_s = result.bound_s;
    watch->motion_s = result.motion_s;
    watch->most_motion_s = fmaxf(watch->most_motion_s, result.motion_s);
}

static void learn(lag_watch_t *watch, const jcal_pair_t *pair)
{
    const jcal_reading_t reading1 = {pair->t_us, pair->imu1};
    const jcal_reading_t reading2 = {pair->t_us, pair->imu2};
    if (watch->begun_us == 0u) {
        watch->begun_us = pair->t_us;
    }
    if (watch->anew_us == 0u) {
        watch->anew_us = pair->t_us;
    }
    watch->now_us = pair->t_us;
    const jcal_status_t of1 = jcal_sensor_push(&watch->sensor1, &reading1);
    const jcal_status_t of2 = jcal_sensor_push(&watch->sensor2, &reading2);
    if (of1 == JCAL_TICK && of2 == JCAL_TICK) {
        (void)jcal_lag_add(&watch->lag, jcal_sensor_tick(&watch->sensor1), jcal_sensor_tick(&watch->sensor2));
    }
    (void)jcal_lag_step(&watch->lag);
    follow_motion(watch);
    (void)jcal_pairing_align(&watch->pairing, &watch->lag);
}

static bool same(jcal_vec3_t a, jcal_vec3_t b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool lag_watch_same(const jcal_imu_t *a, const jcal_imu_t *b)
{
    return same(a->gyr_rad_s, b->gyr_rad_s) && same(a->acc_m_s2, b->acc_m_s2);
}

static bool repeats(lag_watch_t *watch, unsigned which, const jcal_imu_t *imu)
{
    jcal_imu_t *last = &watch->last[which - 1u];
    const bool again = watch->has_last[which - 1u] && lag_watch_same(last, imu);
    *last = *imu;
    watch->has_last[which - 1u] = true;
    return again;
}

void lag_watch_push(lag_watch_t *watch, unsigned which, const jcal_reading_t *reading)
{
    if (repeats(watch, which, &reading->imu)) {
        return;
    }
    (void)jcal_pairing_push(&watch->pairing, which, reading); /* what it rejects is no business of the lag */
    jcal_pair_t pair;
    while (jcal_pairing_pull(&watch->pairing, &pair) == JCAL_OK) {
        learn(watch, &pair);
    }
}

void lag_watch_row(lag_watch_t *watch, const recording_row_t *row, int64_t start_us)
{
    if (row->has_time) {
        const uint64_t t_us = ORIGIN_US + (uint64_t)row->t_us - (uint64_t)start_us;
        const jcal_reading_t readings[2] = {{t_us, row->imu1}, {t_us, row->imu2}};
        lag_watch_push(watch, 1u, &readings[0]);
        lag_watch_push(watch, 2u, &readings[1]);
    }
}

lag_found_t lag_watch_found(const lag_watch_t *watch)
{
    jcal_lag_result_t result;
    (void)jcal_lag_get(&watch->lag, &result);
    return (lag_found_t){.known = result.lag_known,
                         .lag_s = (double)result.lag_s,
                         .bound_s = (double)result.bound_s,
                         .at_us = watch->at_us,
                         .spent_s = (double)(int64_t)(watch->now_us - watch->anew_us) / US_PER_S,
                         .left = (double)watch->left,
                         .all_motion_s = (double)watch->all_motion_s,
                         .motion_s = (double)watch->most_motion_s};
}

report_lag_t lag_watch_report(const lag_watch_t *watch, const check_t *check, check_findings_t *findings)
{
    const lag_found_t found = lag_watch_found(watch);
    const report_lag_t lag = {
        .known = found.known, .lag_us = (int64_t)llround(US_PER_S * found.lag_s), .bound_s = (float)found.bound_s};
    check_measures_t measures;
    check_measures(check, &measures);
    report_advise_lag(&lag, measures.step_s, findings);
    return lag;
}
