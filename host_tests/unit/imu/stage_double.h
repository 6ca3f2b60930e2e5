/* SPDX-License-Identifier: MIT */
/// @file
/// The sensor stage a second time, in double precision and in the words of its sources: the orientation as two rotations as in VQF, a
/// Butterworth low-pass in direct form, the bias by one update with a 3 x 3 inverse, exponentials of libm. For equal steps of time only.
#ifndef JCAL_TEST_IMU_STAGE_DOUBLE_H
#define JCAL_TEST_IMU_STAGE_DOUBLE_H

#include "unit/imu/motion.h"

#define DOUBLE_DEG (MOTION_PI / 180.0)
#define DOUBLE_TAU 3.0

/// y <- low-pass of x: a running mean at first.
typedef struct {
    double x1, x2, y1, y2;
} double_lowpass_t;

/// Three one-poles.
typedef struct {
    double y[3];
} double_poles_t;

/// A high-pass.
typedef struct {
    double h, x;
} double_high_t;

typedef struct {
    double_poles_t q[9], v[3], w[3];
    double way[3];
    double v_first[3];  ///< Half of the first one, of samples that have not been taken in.
    double v_before[3];
    double_high_t lever[9][3];
    double_high_t velocity[3][2];
    double u[3];
    double rate[9], lever_low[9], velocity_low[3];
} double_features_t;

typedef struct {
    double dt, tick_s, since_s;
    double strap[9], level[9];
    double w_before[3];
    double sum[3], sum_s;
    double_lowpass_t force[3];
    double bias[3], p[9];
    double rest_gyr[3], rest_acc[3], rest_s;
    double_lowpass_t turn[9], part[2];
    double_features_t features;
    double now[9];  ///< Sensor to earth.
} double_stage_t;

static inline double double_lowpass(double_lowpass_t *f, double x, double tick_s, double since_s)
{
    if (since_s <= DOUBLE_TAU + 0.5 * tick_s) {
        f->y1 += (x - f->y1) * tick_s / since_s;
        f->x1 = f->y1;
        f->x2 = f->y1;
        f->y2 = f->y1;
        return f->y1;
    }
    const double c = tan(sqrt(2.0) / DOUBLE_TAU * 0.5 * tick_s);
    const double d = 1.0 + sqrt(2.0) * c + c * c;
    const double y =
        (c * c * (x + 2.0 * f->x1 + f->x2) - 2.0 * (c * c - 1.0) * f->y1 - (1.0 - sqrt(2.0) * c + c * c) * f->y2) / d;
    f->x2 = f->x1;
    f->x1 = x;
    f->y2 = f->y1;
    f->y1 = y;
    return y;
}

static inline double double_put(double_poles_t *f, double x, double hz, double dt)
{
    const double a = 1.0 - exp(-2.0 * MOTION_PI * hz * dt);
    for (int i = 0; i < 3; ++i) {
        f->y[i] += a * (x - f->y[i]);
        x = f->y[i];
    }
    return x;
}

static inline double double_high(double_high_t *f, double x, double hz, double dt)
{
    f->h = exp(-2.0 * MOTION_PI * hz * dt) * (f->h + x - f->x);
    f->x = x;
    return f->h;
}

/// R [w]x.
static inline void double_rate(const double r[9], const double w[3], double out[9])
{
    const double k[9] = {0.0, -w[2], w[1], w[2], 0.0, -w[0], -w[1], w[0], 0.0};
    mat_mul(r, k, out);
}

static inline void double_features_begin(double_features_t *f, const double r[9], const double w[3], const double a[3])
{
    memset(f, 0, sizeof *f);
    double q[9];
    double_rate(r, w, q);
    for (int i = 0; i < 9; ++i) {
        for (int k = 0; k < 3; ++k) {
            f->q[i].y[k] = q[i];
        }
        f->lever[i][0].x = q[i];
    }
    mat_times(r, a, f->v_first);
    f->v_first[2] -= MOTION_G;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            f->w[i].y[k] = w[i];
        }
    }
}

static inline void double_features_sample(double_features_t *f, const double r[9], const double w[3], const double a[3],
                                          double dt)
{
    double q[9];
    double force[3];
    double_rate(r, w, q);
    mat_times(r, a, force);
    for (int i = 0; i < 9; ++i) {
        f->rate[i] = double_put(&f->q[i], q[i], 5.0, dt);
    }
    for (int i = 0; i < 3; ++i) {
        if (f->v_first[i] != 0.0) {
            f->v_before[i] = double_put(&f->v[i], 0.5 * f->v_first[i], 5.0, dt);
            f->way[i] += 0.5 * dt * f->v_before[i];
            f->v_first[i] = 0.0;
        }
        const double v = double_put(&f->v[i], force[i] - ((i == 2) ? MOTION_G : 0.0), 5.0, dt);
        f->way[i] += 0.5 * dt * (v + f->v_before[i]);
        f->v_before[i] = v;
        (void)double_put(&f->w[i], w[i], 5.0, dt);
    }
}

static inline void double_features_tick(double_features_t *f, double tick_s)
{
    const double c = 1.0 - exp(-2.0 * MOTION_PI * 3.0 * tick_s);
    for (int i = 0; i < 9; ++i) {
        double x = f->rate[i];
        for (int k = 0; k < 3; ++k) {
            x = double_high(&f->lever[i][k], x, 0.4, tick_s);
        }
        f->lever_low[i] += c * (x - f->lever_low[i]);
    }
    for (int i = 0; i < 3; ++i) {
        f->u[i] = exp(-2.0 * MOTION_PI * 0.4 * tick_s) * (f->u[i] + f->way[i]);
        f->way[i] = 0.0;
        double x = f->u[i];
        for (int k = 0; k < 2; ++k) {
            x = double_high(&f->velocity[i][k], x, 0.4, tick_s);
        }
        f->velocity_low[i] += c * (x - f->velocity_low[i]);
    }
}

/// The smallest rotation of a direction to z.
static inline void double_upright(const double force[3], double out[9])
{
    const double flat = sqrt(force[0] * force[0] + force[1] * force[1]);
    const double angle = atan2(flat, force[2]);
    const double v[3] = {(flat > 0.0) ? angle * force[1] / flat : 0.0, (flat > 0.0) ? -angle * force[0] / flat : 0.0,
                         0.0};
    mat_turn(v, out);
}

static inline void double_stage_begin(double_stage_t *s, double dt, double tick_s, const double w[3], const double a[3])
{
    memset(s, 0, sizeof *s);
    s->dt = dt;
    s->tick_s = tick_s;
    for (int i = 0; i < 9; i += 4) {
        s->strap[i] = 1.0;
        s->p[i] = 0.5 * DOUBLE_DEG * 0.5 * DOUBLE_DEG;
    }
    double_upright(a, s->level);
    memcpy(s->now, s->level, sizeof s->now);
    memcpy(s->w_before, w, sizeof s->w_before);
    memcpy(s->rest_gyr, w, sizeof s->rest_gyr);
    memcpy(s->rest_acc, a, sizeof s->rest_acc);
    double_features_begin(&s->features, s->now, w, a);
}

static inline void mat_inverse(const double a[9], double out[9])
{
    const double c[9] = {a[4] * a[8] - a[5] * a[7], a[2] * a[7] - a[1] * a[8], a[1] * a[5] - a[2] * a[4],
                         a[5] * a[6] - a[3] * a[8], a[0] * a[8] - a[2] * a[6], a[2] * a[3] - a[0] * a[5],
                         a[3] * a[7] - a[4] * a[6], a[1] * a[6] - a[0] * a[7], a[0] * a[4] - a[1] * a[3]};
    const double det = a[0] * c[0] + a[1] * c[3] + a[2] * c[6];
    for (int i = 0; i < 9; ++i) {
        out[i] = c[i] / det;
    }
}

/// b += K e, P -= K C P, K = P C' (C P C' + diag noise2)^-1.
static inline void double_update(double_stage_t *s, const double c[9], const double e[3], const double noise2[3])
{
    double back[9];
    double pc[9];
    double inner[9];
    double gain[9];
    double less[9];
    double step[3];
    mat_transpose(c, back);
    mat_mul(s->p, back, pc);
    mat_mul(c, pc, inner);
    for (int i = 0; i < 3; ++i) {
        inner[4 * i] += noise2[i];
    }
    mat_inverse(inner, inner);
    mat_mul(pc, inner, gain);
    mat_times(gain, e, step);
    mat_transpose(pc, back);
    mat_mul(gain, back, less);
    for (int i = 0; i < 9; ++i) {
        s->p[i] -= less[i];
    }
    for (int i = 0; i < 3; ++i) {
        s->bias[i] += step[i];
    }
}

static inline double double_steady(double sigma_deg, double growth)
{
    const double p = sigma_deg * DOUBLE_DEG * sigma_deg * DOUBLE_DEG;
    return p * p / growth + p;
}

static inline void double_stage_bias(double_stage_t *s, const double direction[3])
{
    double c[9];
    double part[3];
    mat_times(s->now, s->bias, part);
    for (int i = 0; i < 9; ++i) {
        c[i] = double_lowpass(&s->turn[i], s->now[i], s->tick_s, s->since_s);
    }
    double taken[2];
    for (int i = 0; i < 2; ++i) {
        taken[i] = double_lowpass(&s->part[i], part[i], s->tick_s, s->since_s);
    }
    const double growth = 0.1 * DOUBLE_DEG * 0.1 * DOUBLE_DEG * s->tick_s / 100.0;
    for (int i = 0; i < 9; i += 4) {
        s->p[i] += growth;
    }
    if (s->rest_s > 2.0 - 0.5 * s->dt) {
        const double unit[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
        const double n = double_steady(0.065, growth);
        const double noise2[3] = {n, n, n};
        const double e[3] = {s->rest_gyr[0] - s->bias[0], s->rest_gyr[1] - s->bias[1], s->rest_gyr[2] - s->bias[2]};
        double_update(s, unit, e, noise2);
    } else if (s->since_s > DOUBLE_TAU + 0.5 * s->tick_s) {
        const double n = double_steady(0.1, growth);
        const double noise2[3] = {n, n, 1e4 * n};
        mat_times(c, s->bias, part);
        const double e[3] = {-direction[1] / s->tick_s + taken[0] - part[0],
                             direction[0] / s->tick_s + taken[1] - part[1], -part[2]};
        double_update(s, c, e, noise2);
    } else {
        /* nothing is told */
    }
}

/// Rest: the one-poles and the time.
static inline void double_stage_rest(double_stage_t *s, const double w[3], const double a[3])
{
    double gyr2 = 0.0;
    double acc2 = 0.0;
    const double k = s->dt / (s->dt + 0.5);
    for (int i = 0; i < 3; ++i) {
        gyr2 += (w[i] - s->rest_gyr[i]) * (w[i] - s->rest_gyr[i]);
        acc2 += (a[i] - s->rest_acc[i]) * (a[i] - s->rest_acc[i]);
        s->rest_gyr[i] += k * (w[i] - s->rest_gyr[i]);
        s->rest_acc[i] += k * (a[i] - s->rest_acc[i]);
    }
    bool rests = (gyr2 < 4.0 * DOUBLE_DEG * DOUBLE_DEG) && (acc2 < 0.25);
    for (int i = 0; i < 3; ++i) {
        rests = rests && (fabs(s->rest_gyr[i]) <= 2.0 * DOUBLE_DEG);
    }
    s->rest_s = rests ? s->rest_s + s->dt : 0.0;
}

/// Takes in a sample; `due`: it makes a tick.
static inline void double_stage_put(double_stage_t *s, const double gyr[3], const double a[3], bool due)
{
    double w[3];
    double angle[3];
    double step[9];
    double force[3];
    double_stage_rest(s, gyr, a);
    for (int i = 0; i < 3; ++i) {
        w[i] = gyr[i] - s->bias[i];
        angle[i] = 0.5 * s->dt * (w[i] + s->w_before[i]);
        s->w_before[i] = w[i];
    }
    mat_turn(angle, step);
    mat_mul(s->strap, step, s->strap);
    mat_times(s->strap, a, force); /* in the almost inertial frame */
    s->sum_s += s->dt;
    for (int i = 0; i < 3; ++i) {
        s->sum[i] += s->dt * force[i];
    }
    mat_mul(s->level, s->strap, s->now);
    if (due) {
        s->since_s += s->tick_s;
        double low[3];
        double direction[3];
        double correction[9];
        for (int i = 0; i < 3; ++i) {
            low[i] = double_lowpass(&s->force[i], s->sum[i] / s->sum_s, s->tick_s, s->since_s);
            s->sum[i] = 0.0;
        }
        s->sum_s = 0.0;
        mat_times(s->level, low, direction);
        const double length =
            sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
        for (int i = 0; i < 3; ++i) {
            direction[i] /= length;
        }
        double_upright(direction, correction);
        mat_mul(correction, s->level, s->level);
        mat_mul(s->level, s->strap, s->now);
        double_stage_bias(s, direction);
    }
    double_features_sample(&s->features, s->now, w, a, s->dt);
    if (due) {
        double_features_tick(&s->features, s->tick_s);
    }
}

#endif /* JCAL_TEST_IMU_STAGE_DOUBLE_H */
