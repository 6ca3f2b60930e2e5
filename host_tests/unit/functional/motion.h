/* SPDX-License-Identifier: MIT */
/// @file
/// A made-up hinge that moves in space, in double precision, and what two exact sensors on it make of it: ticks, and readings. With `twist`
/// or `side` it is a joint of two or three axes.
///
/// Poses are sums of sines; rates and accelerations are five-point differences of them. Ticks need no filter: with B = Q = R [w]x and the
/// sensor's own velocity U, U - B r is the velocity of the joint's centre, Q j is how the axis moves, and both are the same for both
/// sensors but for the heading. Nothing here shares a formula with the library.
#ifndef JCAL_TEST_FUNCTIONAL_MOTION_H
#define JCAL_TEST_FUNCTIONAL_MOTION_H

#include "jointcal/functional.h"
#include "unit/imu/motion.h"

#include <math.h>
#include <string.h>

#define HINGE_DEG (MOTION_PI / 180.0)
#define HINGE_STEP_S 1e-3

/// The joint, its sensors and what it does. Fields may be changed before the first call.
typedef struct {
    double mount1[9], mount2[9];  ///< Sensor to segment; the axis is y of both segments.
    double r1[3], r2[3];          ///< Joint to sensor, each in its sensor's frame, m.
    double heading, drift_rad_s;  ///< L2 to L1 at time 0, and how it drifts.
    double pace;                  ///< Factor of all frequencies.
    double swing;                 ///< Factor of the joint's angle; 0: it does not bend.
    double bent;                  ///< Angle about which it bends, rad.
    double twist;                 ///< Factor of turning about x of the second segment; 0: a hinge.
    double side;                  ///< Factor of leaning about z of the second segment; 0: no ball joint.
    double lift;                  ///< Factor of the centre's motion.
    double turn;                  ///< Factor of the first segment's turns.
    double rest_s;                ///< So long nothing moves; the motion begins smoothly.
    double skin_rad;              ///< By so much sensor 2 rocks on its segment, each axis, 1 Hz.
    double slip_s;                ///< From this time on sensor 2 sits otherwise,
    double slip[3];               ///< by this rotation vector.
} hinge_t;

static inline hinge_t hinge_usual(void)
{
    hinge_t h;
    memset(&h, 0, sizeof h);
    const double tilt1[3] = {0.4, -0.3, 0.6};
    const double tilt2[3] = {-0.5, 0.2, 0.35};
    mat_turn(tilt1, h.mount1);
    mat_turn(tilt2, h.mount2);
    const double r1[3] = {0.05, -0.20, 0.06};
    const double r2[3] = {-0.04, 0.18, 0.05};
    memcpy(h.r1, r1, sizeof r1);
    memcpy(h.r2, r2, sizeof r2);
    h.heading = 0.8;
    h.pace = h.swing = h.lift = h.turn = 1.0;
    h.slip_s = 1e9;
    return h;
}

/// Time that the motion has got to: stands still until rest_s, then gathers pace within a second.
static inline double hinge_phase(const hinge_t *h, double t)
{
    const double since = t - h->rest_s;
    const double got =
        (since <= 0.0) ? 0.0 : ((since < 1.0) ? since * since * since * (1.0 - 0.5 * since) : since - 0.5);
    return h->pace * got;
}

/// The joint's angle, rad.
static inline double hinge_angle(const hinge_t *h, double t)
{
    const double p = hinge_phase(h, t);
    return h->bent + h->swing * (0.7 * sin(2.3 * p) + 0.4 * sin(3.7 * p + 0.5));
}

/// What a joint that is no hinge turns by after it has bent: about z, then about x of the second segment.
static inline void hinge_turn_more(const hinge_t *h, double p, double turn[9])
{
    const double more[2][3] = {{0.0, 0.0, h->side * 0.5 * sin(2.9 * p + 1.3)},
                               {h->twist * (0.6 * sin(2.7 * p + 0.4) + 0.3 * sin(4.1 * p)), 0.0, 0.0}};
    double step[9];
    for (int i = 0; i < 2; ++i) {
        mat_turn(more[i], step);
        mat_mul(turn, step, turn);
    }
}

/// Poses of both sensors, to level frame 1, and the joint's centre.
static inline void hinge_pose(const hinge_t *h, double t, double turn1[9], double turn2[9], double centre[3])
{
    const double p = hinge_phase(h, t);
    const double parts[3][3] = {{0.0, 0.0, h->turn * (0.6 * sin(0.9 * p) + 0.3 * p)},
                                {0.0, h->turn * 0.6 * sin(1.3 * p + 1.0), 0.0},
                                {h->turn * 0.5 * sin(1.9 * p), 0.0, 0.0}};
    double segment[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    double step[9];
    for (int i = 0; i < 3; ++i) {
        mat_turn(parts[i], step);
        mat_mul(segment, step, segment);
    }
    mat_mul(segment, h->mount1, turn1);
    const double bend[3] = {0.0, hinge_angle(h, t), 0.0};
    mat_turn(bend, step);
    mat_mul(segment, step, turn2);
    hinge_turn_more(h, p, turn2);
    const double rock[3] = {h->skin_rad * sin(6.1 * p), h->skin_rad * sin(6.7 * p + 1.0),
                            h->skin_rad * sin(7.1 * p + 2.0)};
    mat_turn(rock, step);
    mat_mul(turn2, step, turn2);
    mat_mul(turn2, h->mount2, turn2);
    if (t >= h->slip_s) {
        mat_turn(h->slip, step);
        mat_mul(turn2, step, turn2);
    }
    centre[0] = h->lift * 0.10 * sin(4.9 * p);
    centre[1] = h->lift * 0.08 * sin(5.7 * p + 0.7);
    centre[2] = h->lift * 0.09 * sin(6.3 * p + 1.9);
}

/// What one sensor is and does, in its own level frame.
typedef struct {
    double turn[9];
    double gyr[3];       ///< rad/s, sensor frame.
    double velocity[3];  ///< m/s.
    double force[3];     ///< Specific force, m/s^2, sensor frame.
} hinge_sensor_t;

static inline void hinge_sensor(const hinge_t *h, double t, int which, hinge_sensor_t *out)
{
    static const double first[5] = {1.0 / 12.0, -8.0 / 12.0, 0.0, 8.0 / 12.0, -1.0 / 12.0};
    static const double second[5] = {-1.0 / 12.0, 16.0 / 12.0, -30.0 / 12.0, 16.0 / 12.0, -1.0 / 12.0};
    const double about_z[3] = {0.0, 0.0, (which == 2) ? -(h->heading + h->drift_rad_s * t) : 0.0};
    double level[9];
    double slope[9] = {0.0};
    double acceleration[3] = {0.0};
    double back[9];
    memset(out->velocity, 0, sizeof out->velocity);
    mat_turn(about_z, level);
    hinge_t here = *h; /* no slip between the places of a difference */
    here.slip_s = (t >= h->slip_s) ? -1e9 : 1e9;
    for (int k = 0; k < 5; ++k) {
        double turn1[9];
        double turn2[9];
        double p[3];
        double arm[3];
        hinge_pose(&here, t + (k - 2) * HINGE_STEP_S, turn1, turn2, p);
        double *const turn = (which == 1) ? turn1 : turn2;
        mat_times(turn, (which == 1) ? h->r1 : h->r2, arm);
        mat_mul(level, turn, turn);
        for (int i = 0; i < 9; ++i) {
            slope[i] += first[k] / HINGE_STEP_S * turn[i];
        }
        for (int i = 0; i < 3; ++i) {
            p[i] += arm[i];
        }
        mat_times(level, p, p);
        for (int i = 0; i < 3; ++i) {
            out->velocity[i] += first[k] / HINGE_STEP_S * p[i];
            acceleration[i] += second[k] / (HINGE_STEP_S * HINGE_STEP_S) * p[i];
        }
        if (k == 2) {
            memcpy(out->turn, turn, sizeof out->turn);
        }
    }
    mat_transpose(out->turn, back);
    acceleration[2] += MOTION_G;
    mat_times(back, acceleration, out->force);
    mat_mul(back, slope, slope);
    out->gyr[0] = 0.5 * (slope[7] - slope[5]);
    out->gyr[1] = 0.5 * (slope[2] - slope[6]);
    out->gyr[2] = 0.5 * (slope[3] - slope[1]);
}

static inline jcal_tick_t hinge_tick(const hinge_t *h, double t, int which, uint64_t t_us)
{
    hinge_sensor_t s;
    jcal_tick_t out;
    memset(&out, 0, sizeof out);
    hinge_sensor(h, t, which, &s);
    const double cross[9] = {0.0, -s.gyr[2], s.gyr[1], s.gyr[2], 0.0, -s.gyr[0], -s.gyr[1], s.gyr[0], 0.0};
    double q[9];
    mat_mul(s.turn, cross, q);
    for (int i = 0; i < 9; ++i) {
        out.turn[i] = (float)s.turn[i];
        out.rate[i] = (float)q[i];
        out.lever[i] = (float)q[i];
    }
    out.t_us = t_us;
    out.epoch = 1u;
    out.dt_s = 0.05f;
    out.since_s = (float)t;
    out.velocity = to_vec3(s.velocity);
    out.gyr = to_vec3(s.gyr);
    out.acc_level_m_s2 = 9.81f;
    return out;
}

/// The axis in a sensor's frame: y of the segment, as it is mounted (at that time).
static inline jcal_vec3_t hinge_axis(const hinge_t *h, int which, double t)
{
    const double y[3] = {0.0, 1.0, 0.0};
    double mount[9];
    double back[9];
    double out[3];
    memcpy(mount, (which == 1) ? h->mount1 : h->mount2, sizeof mount);
    if ((which == 2) && (t >= h->slip_s)) {
        double step[9];
        mat_turn(h->slip, step);
        mat_mul(mount, step, mount);
    }
    mat_transpose(mount, back);
    mat_times(back, y, out);
    return to_vec3(out);
}

/// The orientation of a sensor to its level frame.
static inline jcal_quat_t hinge_quat(const hinge_t *h, double t, int which)
{
    hinge_sensor_t s;
    hinge_sensor(h, t, which, &s);
    const double *const m = s.turn;
    /* the largest of the four, so that no small number is divided by */
    const double squares[4] = {1.0 + m[0] + m[4] + m[8], 1.0 + m[0] - m[4] - m[8], 1.0 - m[0] + m[4] - m[8],
                               1.0 - m[0] - m[4] + m[8]};
    const double rows[4][4] = {{squares[0], m[7] - m[5], m[2] - m[6], m[3] - m[1]},
                               {m[7] - m[5], squares[1], m[1] + m[3], m[2] + m[6]},
                               {m[2] - m[6], m[1] + m[3], squares[2], m[5] + m[7]},
                               {m[3] - m[1], m[2] + m[6], m[5] + m[7], squares[3]}};
    int best = 0;
    for (int i = 1; i < 4; ++i) {
        best = (squares[i] > squares[best]) ? i : best;
    }
    const double scale = 0.5 / sqrt(squares[best]);
    const jcal_quat_t out = {(float)(scale * rows[best][0]), (float)(scale * rows[best][1]),
                             (float)(scale * rows[best][2]), (float)(scale * rows[best][3])};
    return out;
}

#endif /* JCAL_TEST_FUNCTIONAL_MOTION_H */
