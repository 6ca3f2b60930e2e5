/* SPDX-License-Identifier: MIT */
/// @file
/// A made-up motion of a rigid body with sensors anywhere on it, in double precision: rates and accelerations are sums of sines, so that
/// everything a sensor reads is known exactly, and so is its orientation. Nothing here shares a formula with the library.
#ifndef JCAL_TEST_IMU_MOTION_H
#define JCAL_TEST_IMU_MOTION_H

#include "jointcal/sensor.h"

#include <math.h>
#include <string.h>

#define MOTION_PI 3.14159265358979323846
#define MOTION_G 9.81
#define MOTION_STEP_S 0.001

/// How a sensor sits: frame (sensor to body), place in the body's frame (m), heading of its earth frame (rad).
typedef struct {
    double frame[9];
    double place[3];
    double heading;
} motion_mount_t;

/// The body: what it does, and where it is.
typedef struct {
    double rate;     ///< Size of the rates, rad/s.
    double force;    ///< Size of the accelerations, m/s^2.
    double pace;     ///< Factor of all frequencies.
    double turn[9];  ///< Body to earth at time t.
    double t_s;
} motion_t;

static inline void mat_mul(const double a[9], const double b[9], double out[9])
{
    double found[9];
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            found[3 * i + k] = a[3 * i] * b[k] + a[3 * i + 1] * b[3 + k] + a[3 * i + 2] * b[6 + k];
        }
    }
    memcpy(out, found, sizeof found);
}

static inline void mat_times(const double a[9], const double v[3], double out[3])
{
    const double x[3] = {v[0], v[1], v[2]};
    for (int i = 0; i < 3; ++i) {
        out[i] = a[3 * i] * x[0] + a[3 * i + 1] * x[1] + a[3 * i + 2] * x[2];
    }
}

static inline void mat_transpose(const double a[9], double out[9])
{
    const double found[9] = {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
    memcpy(out, found, sizeof found);
}

static inline void vec_cross(const double a[3], const double b[3], double out[3])
{
    const double found[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    memcpy(out, found, sizeof found);
}

/// The rotation by a rotation vector, rad (Rodrigues).
static inline void mat_turn(const double v[3], double out[9])
{
    const double angle = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double s = (angle > 0.0) ? sin(angle) / angle : 1.0;
    const double c = (angle > 0.0) ? (1.0 - cos(angle)) / (angle * angle) : 0.5;
    const double k[9] = {0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0};
    double square[9];
    mat_mul(k, k, square);
    for (int i = 0; i < 9; ++i) {
        out[i] = ((i % 4 == 0) ? 1.0 : 0.0) + s * k[i] + c * square[i];
    }
}

static inline double mat_angle_between(const double a[9], const double b[9])
{
    double back[9];
    double d[9];
    mat_transpose(a, back);
    mat_mul(back, b, d);
    const double sine =
        0.5 * sqrt((d[7] - d[5]) * (d[7] - d[5]) + (d[2] - d[6]) * (d[2] - d[6]) + (d[3] - d[1]) * (d[3] - d[1]));
    return atan2(sine, 0.5 * (d[0] + d[4] + d[8] - 1.0));
}

static inline motion_t motion_begin(double rate, double force, double pace)
{
    motion_t out = {rate, force, pace, {0.0}, 0.0};
    const double start[3] = {0.9, -0.4, 0.7};
    mat_turn(start, out.turn);
    return out;
}

/// Rate and its derivative in the body's frame at a time.
static inline void motion_rate(const motion_t *m, double t, double w[3], double dw[3])
{
    static const double f[3] = {4.1, 5.3, 3.2};
    static const double g[3] = {1.7, 2.3, 2.9};
    for (int i = 0; i < 3; ++i) {
        const double a = m->pace * f[i];
        const double b = m->pace * g[i];
        w[i] = m->rate * (sin(a * t + i) + 0.6 * cos(b * t + 0.5 * i) + 0.1);
        dw[i] = m->rate * (a * cos(a * t + i) - 0.6 * b * sin(b * t + 0.5 * i));
    }
}

/// Moves the body on to a time.
static inline void motion_to(motion_t *m, double t_s)
{
    while (m->t_s < t_s - 1e-12) {
        const double h = fmin(MOTION_STEP_S, t_s - m->t_s);
        double w[3];
        double dw[3];
        double step[9];
        motion_rate(m, m->t_s + 0.5 * h, w, dw);
        for (int i = 0; i < 3; ++i) {
            w[i] *= h;
        }
        mat_turn(w, step);
        mat_mul(m->turn, step, m->turn);
        m->t_s += h;
    }
}

/// What a sensor reads, and its orientation (sensor to its earth frame).
static inline void motion_read(const motion_t *m, const motion_mount_t *mount, double gyr[3], double acc[3],
                               double turn[9])
{
    double w[3];
    double dw[3];
    double a[3];
    double part[3];
    double twice[3];
    double back[9];
    const double pace = m->pace;
    motion_rate(m, m->t_s, w, dw);
    const double force[3] = {m->force * sin(pace * 3.1 * m->t_s), m->force * cos(pace * 2.7 * m->t_s + 1.0),
                             MOTION_G + 0.7 * m->force * sin(pace * 5.1 * m->t_s + 2.0)};
    mat_transpose(m->turn, back);
    mat_times(back, force, a);
    vec_cross(dw, mount->place, part);
    vec_cross(w, mount->place, twice);
    vec_cross(w, twice, twice);
    for (int i = 0; i < 3; ++i) {
        a[i] += part[i] + twice[i];
    }
    mat_transpose(mount->frame, back);
    mat_times(back, w, gyr);
    mat_times(back, a, acc);
    const double about_z[3] = {0.0, 0.0, mount->heading};
    double heading[9];
    mat_turn(about_z, heading);
    mat_mul(heading, m->turn, turn);
    mat_mul(turn, mount->frame, turn);
}

/// A mount, turned by a rotation vector.
static inline motion_mount_t motion_mount(const double turn[3], const double place[3], double heading)
{
    motion_mount_t out = {{0.0}, {place[0], place[1], place[2]}, heading};
    mat_turn(turn, out.frame);
    return out;
}

static inline jcal_vec3_t to_vec3(const double v[3])
{
    const jcal_vec3_t out = {(float)v[0], (float)v[1], (float)v[2]};
    return out;
}

static inline jcal_reading_t to_reading(uint64_t t_us, const double gyr[3], const double acc[3])
{
    const jcal_reading_t out = {t_us, {to_vec3(gyr), to_vec3(acc)}};
    return out;
}

/// The matrix of a quaternion.
static inline void mat_of(jcal_quat_t q, double out[9])
{
    const double w = (double)q.w;
    const double v[3] = {(double)q.x, (double)q.y, (double)q.z};
    const double k[9] = {0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0};
    double square[9];
    mat_mul(k, k, square);
    for (int i = 0; i < 9; ++i) {
        out[i] = ((i % 4 == 0) ? 1.0 : 0.0) + 2.0 * w * k[i] + 2.0 * square[i];
    }
}

#endif /* JCAL_TEST_IMU_MOTION_H */
