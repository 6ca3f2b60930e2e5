/* SPDX-License-Identifier: MIT */
/* The lag of a clock over time. */
#include "run/clock_line.h"

#include <math.h>
#include <stdlib.h>

/* Part of every bound that more points do not make smaller, s, and the least spread of a point. */
#define FLOOR_S 0.002
#define SPREAD_LEAST_S 0.0005

/* Drift that is expected, 68 %: half of 500 ppm. */
#define DRIFT_SPREAD 250e-6

/* Spreads from which on a point counts less, and rounds of weighting. */
#define HUBER 2.0
#define ROUNDS 20

static double spread_of(const clock_point_t *point)
{
    return fmax(0.5 * (point->bound_s - FLOOR_S), SPREAD_LEAST_S);
}

/* Weight of a point beside the line: as least squares have it, less if it is far off. */
static double weight_of(const clock_line_t *line, const clock_point_t *point)
{
    const double spread_s = spread_of(point);
    const double off = fabs(point->lag_s - clock_line_at(line, point->t_s)) / spread_s;
    return ((off > HUBER) ? HUBER / off : 1.0) / (spread_s * spread_s);
}

/* One round: the line for the weights that the line before gives. */
static void draw(clock_line_t *line)
{
    double sum = 0.0;
    double at = 0.0;
    double lag = 0.0;
    for (size_t k = 0; k < line->count; k++) {
        const double weight = weight_of(line, &line->points[k]);
        sum += weight;
        at += weight * line->points[k].t_s;
        lag += weight * line->points[k].lag_s;
    }
    const double t0_s = at / sum;
    const double mean_s = lag / sum;
    double across = 0.0;
    double square = 1.0 / (DRIFT_SPREAD * DRIFT_SPREAD);
    for (size_t k = 0; k < line->count; k++) {
        const double weight = weight_of(line, &line->points[k]);
        const double since_s = line->points[k].t_s - t0_s;
        across += weight * since_s * (line->points[k].lag_s - mean_s);
        square += weight * since_s * since_s;
    }
    line->t0_s = t0_s;
    line->lag0_s = mean_s;
    line->drift = across / square;
    line->variance[0] = 1.0 / sum;
    line->variance[1] = 1.0 / square;
}

/* How many times as far off as their bounds say the points are; at least 1. */
static double excess(const clock_line_t *line)
{
    double squares = 0.0;
    for (size_t k = 0; k < line->count; k++) {
        const double off_s = line->points[k].lag_s - clock_line_at(line, line->points[k].t_s);
        squares += weight_of(line, &line->points[k]) * off_s * off_s;
    }
    return (line->count > 2) ? fmax(1.0, sqrt(squares / (double)(line->count - 2))) : 1.0;
}

bool clock_line_add(clock_line_t *line, clock_point_t point)
{
    if (line->count == line->capacity) {
        const size_t capacity = (line->capacity == 0) ? 64 : 2 * line->capacity;
        clock_point_t *points = realloc(line->points, capacity * sizeof *points);
        if (points == NULL) {
            return false;
        }
        line->points = points;
        line->capacity = capacity;
    }
    line->points[line->count++] = point;
    for (int round = 0; round < ROUNDS; round++) {
        draw(line);
    }
    const double times = excess(line);
    line->variance[0] *= times * times;
    line->variance[1] *= times * times;
    line->drift_bound = 2.0 * sqrt(line->variance[1]);
    return true;
}

double clock_line_at(const clock_line_t *line, double t_s)
{
    return line->lag0_s + line->drift * (t_s - line->t0_s);
}

double clock_line_bound(const clock_line_t *line, double t_s)
{
    if (line->count == 0) {
        return (double)INFINITY;
    }
    const double since_s = t_s - line->t0_s;
    return FLOOR_S + 2.0 * sqrt(line->variance[0] + line->variance[1] * since_s * since_s);
}

void clock_line_free(clock_line_t *line)
{
    free(line->points);
    line->points = NULL;
}
