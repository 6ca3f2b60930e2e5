/* SPDX-License-Identifier: MIT */
/// @file
/// The lag of one sensor's clock behind another's over time: a robust line through points at which it was found, and its bound.
///
///     lag(t) = lag_0 + drift (t - t_0)
///
/// Least squares over the points by their bounds, those far off counting less [Huber], with what is known of clocks beforehand: the
/// drift is within 500 ppm, 95 %. So one point makes a constant whose bound grows with the distance from it.
#ifndef JCAL_CLI_RUN_CLOCK_LINE_H
#define JCAL_CLI_RUN_CLOCK_LINE_H

#include <stdbool.h>
#include <stddef.h>

/// The lag at one time; its bound is one of 95 %.
typedef struct {
    double t_s;
    double lag_s;
    double bound_s;
} clock_point_t;

/// Start from all zero: no lag, and nothing known.
typedef struct {
    double t0_s;    ///< Where the line stands on its points.
    double lag0_s;  ///< Lag there.
    double drift;   ///< Seconds a second: more than 0 if the second clock is fast.
    double drift_bound;

    /* Private. */
    clock_point_t *points;
    size_t count;
    size_t capacity;
    double variance[2]; /* of lag0, s^2, and of drift; at t0 they are independent */
} clock_line_t;

/// Adds a point and draws the line anew. False if memory ran out.
bool clock_line_add(clock_line_t *line, clock_point_t point);

/// Lag at a time, s; 0 without points.
double clock_line_at(const clock_line_t *line, double t_s);

/// 95 % bound of it, s; infinite without points.
double clock_line_bound(const clock_line_t *line, double t_s);

/// Releases memory.
void clock_line_free(clock_line_t *line);

#endif
