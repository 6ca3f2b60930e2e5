/* SPDX-License-Identifier: MIT */
/* What the readings of one sensor tell. */
#include "input/check_sensor.h"

#include <math.h>
#include <string.h>

/* Longest time from row to row over which rates can be summed. */
#define LONGEST_STEP_US 200000

#define BLOCK_S 0.1
#define WINDOW_S 2.0
#define ENOUGH_WINDOWS 2

/* A block is of slow motion if |a| at both its ends is within this share, in sum, of its median, and a changes by less than that much
 * of it: by about a radian. */
#define SLOW 0.15
#define MOST_CHANGE 1.2

/* How much of the changes a way to read the columns must explain: in 70 recordings of people and of a rig no wrong way explains
 * more than 0.46, and the right one of a moving rig 0.63 and more. And how much less it must leave open than the columns as they are. */
#define FRAMES_FIT 0.55
#define FRAMES_LEFT 0.6
/* One way stands out if what the next one leaves open is that much more. If none does, the motion was about few axes, where chance makes
 * some fit: it takes 15 s of it. */
#define FRAMES_NEXT 0.8
#define FRAMES_BLOCKS 150u

/* Gravity by rates and accelerations together is from 9.2 to 10.3 m/s^2 in recordings of all kinds. */
#define GRAVITY_LEAST 6.0
#define GRAVITY_MOST 15.0

/* Where the first and last decile of |a| are this near to its median, |a| is gravity; and if rates are right, turning it back leaves 0.93
 * of it and more in all recordings. */
#define STEADY_LEAST 0.8
#define STEADY_MOST 1.25
#define STEADY_SHARE 0.7
#define ENOUGH_STEADY 50u

/* Without gravity the mean over two seconds is far below what the sensor feels: 0.15 of it, against 0.66 and more with gravity ... */
#define NO_GRAVITY_SHARE 0.4
/* ... and readings scatter from near zero: their first decile is 0.41 of the median, against 0.56 and more. */
#define NO_GRAVITY_SCATTER 0.53
/* In no unit in use does gravity read less than this. */
#define GRAVITY_IN_ANY_UNIT 0.5

/* Rates beyond which the unit is wrong whatever else fits, rad/s: half of all readings. */
#define RATE_PLAUSIBLE 15.0

/* Rows that tell of held readings: fast enough that a reading must change from row to row, rad/s. */
#define MOVING_RATE 1.0
#define ENOUGH_MOVING 100u
#define HELD_SHARE 0.45

static bool is_finite(const jcal_imu_t *imu)
{
    return jcal_vec3_is_finite(imu->gyr_rad_s) && jcal_vec3_is_finite(imu->acc_m_s2);
}

static bool equal(jcal_vec3_t a, jcal_vec3_t b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void count_held(check_sensor_t *sensor, const jcal_imu_t *imu)
{
    if (!((double)jcal_vec3_norm(imu->gyr_rad_s) > MOVING_RATE)) {
        return;
    }
    const bool acc = equal(imu->acc_m_s2, sensor->last.acc_m_s2);
    const bool gyr = equal(imu->gyr_rad_s, sensor->last.gyr_rad_s);
    sensor->moving++;
    sensor->acc_held += (acc && !gyr) ? 1u : 0u;
    sensor->gyr_held += (gyr && !acc) ? 1u : 0u;
    sensor->both_held += (gyr && acc) ? 1u : 0u;
}

static void end_block(check_sensor_t *sensor, jcal_vec3_t acc)
{
    const double usual = histogram_quantile(&sensor->acc, 0.5);
    const jcal_vec3_t before = sensor->block_acc;
    const jcal_vec3_t change = jcal_vec3_sub(acc, before);
    const double off = fabs((double)jcal_vec3_norm(before) - usual) + fabs((double)jcal_vec3_norm(acc) - usual);
    if (off < SLOW * usual && (double)jcal_vec3_norm(change) < MOST_CHANGE * usual) {
        check_frames_push(&sensor->frames, sensor->block_turn, jcal_vec3_scale(jcal_vec3_add(before, acc), 0.5f),
                          change);
    }
}

static void start_block(check_sensor_t *sensor, jcal_vec3_t acc)
{
    sensor->block_turn = (jcal_vec3_t){0.0f, 0.0f, 0.0f};
    sensor->block_acc = acc;
    sensor->block_s = 0.0;
}

static void start_window(check_sensor_t *sensor)
{
    static const double still[4] = {1.0, 0.0, 0.0, 0.0};
    memcpy(sensor->turned, still, sizeof still);
    memset(sensor->sum, 0, sizeof sensor->sum);
    sensor->sum2 = 0.0;
    sensor->window_rows = 0;
    sensor->window_s = 0.0;
}

/* turned <- turned * (turn by w over dt). */
static void turn(double q[static 4], jcal_vec3_t w, double dt_s)
{
    const double rate = sqrt(((double)w.x * (double)w.x) + ((double)w.y * (double)w.y) + ((double)w.z * (double)w.z));
    const double half = 0.5 * rate * dt_s;
    const double s = (rate > 0.0) ? sin(half) / rate : 0.0;
    const double p[4] = {cos(half), s * (double)w.x, s * (double)w.y, s * (double)w.z};
    const double a[4] = {q[0], q[1], q[2], q[3]};
    q[0] = (a[0] * p[0]) - (a[1] * p[1]) - (a[2] * p[2]) - (a[3] * p[3]);
    q[1] = (a[0] * p[1]) + (a[1] * p[0]) + (a[2] * p[3]) - (a[3] * p[2]);
    q[2] = (a[0] * p[2]) - (a[1] * p[3]) + (a[2] * p[0]) + (a[3] * p[1]);
    q[3] = (a[0] * p[3]) + (a[1] * p[2]) - (a[2] * p[1]) + (a[3] * p[0]);
}

/* sum <- sum + q a q*: the acceleration in the frame that the sensor had when the window began. */
static void add_turned(double sum[static 3], const double q[static 4], jcal_vec3_t acc)
{
    const double a[3] = {(double)acc.x, (double)acc.y, (double)acc.z};
    const double t[3] = {2.0 * ((q[2] * a[2]) - (q[3] * a[1])), 2.0 * ((q[3] * a[0]) - (q[1] * a[2])),
                         2.0 * ((q[1] * a[1]) - (q[2] * a[0]))};
    sum[0] += a[0] + (q[0] * t[0]) + ((q[2] * t[2]) - (q[3] * t[1]));
    sum[1] += a[1] + (q[0] * t[1]) + ((q[3] * t[0]) - (q[1] * t[2]));
    sum[2] += a[2] + (q[0] * t[2]) + ((q[1] * t[1]) - (q[2] * t[0]));
}

static void end_window(check_sensor_t *sensor)
{
    const double *sum = sensor->sum;
    const double rows = sensor->window_rows;
    const double mean = sqrt((sum[0] * sum[0]) + (sum[1] * sum[1]) + (sum[2] * sum[2])) / rows;
    const double rms = sqrt(sensor->sum2 / rows);
    histogram_push(&sensor->gravity, mean);
    histogram_push(&sensor->share, (rms > 0.0) ? mean / rms : 0.0);
}

void check_sensor_push(check_sensor_t *sensor, const jcal_imu_t *imu, int64_t t_us)
{
    if (!is_finite(imu)) {
        return;
    }
    const jcal_vec3_t acc = imu->acc_m_s2;
    histogram_push(&sensor->rate, (double)jcal_vec3_norm(imu->gyr_rad_s));
    histogram_push(&sensor->acc, (double)jcal_vec3_norm(acc));
    const int64_t dt_us = t_us - sensor->last_us;
    if (!sensor->has_last || dt_us <= 0 || dt_us > LONGEST_STEP_US) {
        start_block(sensor, acc);
        start_window(sensor);
    } else {
        const double dt_s = 1e-6 * (double)dt_us;
        count_held(sensor, imu);
        sensor->block_turn = jcal_vec3_add(sensor->block_turn, jcal_vec3_scale(sensor->last.gyr_rad_s, (float)dt_s));
        sensor->block_s += dt_s;
        turn(sensor->turned, imu->gyr_rad_s, dt_s);
        add_turned(sensor->sum, sensor->turned, acc);
        sensor->sum2 += (double)jcal_vec3_dot(acc, acc);
        sensor->window_rows++;
        sensor->window_s += dt_s;
        if (sensor->block_s >= BLOCK_S - 1e-6) {
            end_block(sensor, acc);
            start_block(sensor, acc);
        }
        if (sensor->window_s >= WINDOW_S) {
            end_window(sensor);
            start_window(sensor);
        }
    }
    sensor->has_last = true;
    sensor->last_us = t_us;
    sensor->last = *imu;
}

/* Within a factor of four: no unit in use is nearer to another. */
static bool about_one(double scale)
{
    return scale > 0.25 && scale < 4.0;
}

/* What the way in which gravity turns says. */
static void judge_frames(const check_sensor_t *sensor, check_sensor_verdict_t *verdict)
{
    check_frames_result_t frames;
    if (!check_frames_get(&sensor->frames, &frames)) {
        return;
    }
    verdict->scale = frames.scale_as_is;
    verdict->fit = fmax(frames.fit_as_is, 0.0);
    if (frames.fit_as_is > FRAMES_FIT) {
        verdict->fault = about_one(frames.scale_as_is) ? CHECK_SENSOR_FINE : CHECK_SENSOR_RATE_UNIT;
        return;
    }
    const double left = 1.0 - fmax(frames.fit_as_is, 0.0);
    if (frames.fit < FRAMES_FIT || 1.0 - frames.fit > FRAMES_LEFT * left) {
        return;
    }
    const bool stands_out = 1.0 - frames.fit < FRAMES_NEXT * (1.0 - frames.fit_next);
    if (!stands_out && frames.count < FRAMES_BLOCKS) {
        return;
    }
    verdict->fault = (-frames.fit_as_is > 0.99 * frames.fit) ? CHECK_SENSOR_TURNS_BACK : CHECK_SENSOR_FRAMES;
    verdict->way_known = frames.scale > 0.0 && stands_out;
    memcpy(verdict->column, frames.column, sizeof verdict->column);
    memcpy(verdict->sign, frames.sign, sizeof verdict->sign);
}

/* What the size of gravity says. Where |a| hardly changes it is gravity; else the rates must help to find gravity in it. */
static void judge_gravity(const check_sensor_t *sensor, check_sensor_verdict_t *verdict)
{
    const double usual = histogram_quantile(&sensor->acc, 0.5);
    const double scatter = histogram_quantile(&sensor->acc, 0.1) / usual;
    const double share = histogram_quantile(&sensor->share, 0.5);
    const bool steady = scatter > STEADY_LEAST && histogram_quantile(&sensor->acc, 0.9) < STEADY_MOST * usual;
    const bool rates_fit =
        verdict->fault == CHECK_SENSOR_FINE && histogram_quantile(&sensor->rate, 0.5) < RATE_PLAUSIBLE;
    verdict->gravity = (rates_fit && !steady) ? histogram_quantile(&sensor->gravity, 0.5) : usual;
    const bool enough = sensor->gravity.count >= ENOUGH_WINDOWS || (steady && sensor->acc.count >= ENOUGH_STEADY);
    if (!enough || verdict->fault != CHECK_SENSOR_FINE) {
        return;
    }
    if (verdict->gravity > GRAVITY_LEAST && verdict->gravity < GRAVITY_MOST) {
        verdict->fault = (steady && sensor->share.count >= ENOUGH_WINDOWS && share < STEADY_SHARE) ? CHECK_SENSOR_RATES
                                                                                                   : CHECK_SENSOR_FINE;
        return;
    }
    const bool none = rates_fit && scatter < NO_GRAVITY_SCATTER && share < NO_GRAVITY_SHARE;
    verdict->fault = (none || verdict->gravity < GRAVITY_IN_ANY_UNIT) ? CHECK_SENSOR_NO_GRAVITY : CHECK_SENSOR_ACC_UNIT;
}

check_sensor_verdict_t check_sensor_verdict(const check_sensor_t *sensor)
{
    check_sensor_verdict_t verdict;
    memset(&verdict, 0, sizeof verdict);
    judge_frames(sensor, &verdict);
    judge_gravity(sensor, &verdict);
    return verdict;
}

static int held(const check_sensor_t *sensor, uint32_t rows)
{
    const double share = (sensor->moving > 0) ? (double)rows / sensor->moving : 0.0;
    if (sensor->moving < ENOUGH_MOVING || share < HELD_SHARE || share > 0.999) {
        return 1;
    }
    return (int)fmin(round(1.0 / (1.0 - share)), 1000.0);
}

int check_sensor_acc_held(const check_sensor_t *sensor)
{
    return held(sensor, sensor->acc_held);
}

int check_sensor_gyr_held(const check_sensor_t *sensor)
{
    return held(sensor, sensor->gyr_held);
}

int check_sensor_both_held(const check_sensor_t *sensor)
{
    return held(sensor, sensor->both_held);
}
