/* SPDX-License-Identifier: MIT */
/// @file
/// Levers and headings of the ball joint. See ball/solve.h.
#include "ball/solve.h"

#include "levers/levers.h"
#include "math/plane.h"
#include "math/scalar.h"

#include <float.h>

/// Floor of the residual's mean square, (m/s)^2: 7 mm/s.
#define SIZE_FLOOR 5e-5f
/// Share of it that never averages out, and motion that takes one independent reading, s.
#define LASTING 0.16f
#define READING_S 1.0f
/// Share of the mean diagonal that keeps levers in directions in which nothing turned at zero.
#define RIDGE 3e-4f

float jcal_ball_weight(const jcal_ball_sums_t *sums, const jcal_ball_point_t *point)
{
    return 1.0f / (point->size * ((LASTING * sums->motion_s) + READING_S));
}

float jcal_ball_past_pull(const jcal_ball_past_t *past)
{
    return (past->known > 0.0f) ? (past->known / (1.0f + (past->known / JCAL_BALL_PULL))) : 0.0f;
}

static void find_levers(const jcal_ball_sums_t *sums, jcal_ball_point_t *point)
{
    float x[16];
    jcal_levers_cross(&sums->levers, point->heading, x);
    const jcal_levers_t found = jcal_levers_solve(&sums->levers, x, RIDGE);
    const float motion_s = jcal_max(sums->motion_s, FLT_MIN);
    point->r1 = found.r1;
    point->r2 = found.r2;
    point->lack = found.lack;
    point->speed2 = found.own / motion_s;
    point->size = jcal_max(found.lack / (3.0f * motion_s), SIZE_FLOOR);
}

/// The pull of block b, with what a unit counts.
static jcal_plane_t pull_of(const jcal_ball_sums_t *sums, const jcal_ball_point_t *point, size_t b)
{
    const float weight = jcal_ball_weight(sums, point);
    const jcal_plane_t pull = jcal_levers_pull(&sums->levers, b, point->r1, point->r2);
    const jcal_plane_t out = {weight * pull.re, weight * pull.im};
    return out;
}

static void turn_to(jcal_plane_t *heading, jcal_plane_t pull)
{
    if (jcal_plane_norm2(pull) > FLT_MIN) {
        *heading = jcal_plane_direction(pull);
    }
}

static void find_headings(const jcal_ball_sums_t *sums, const jcal_ball_past_t *past, jcal_ball_point_t *point)
{
    const bool has_closed = sums->block_motion_s[1] > 0.0f;
    if (has_closed) {
        const jcal_plane_t pull = pull_of(sums, point, 1u);
        const float tie = (sums->block_motion_s[0] > 0.0f) ? JCAL_BALL_PULL : 0.0f;
        const jcal_plane_t own = {pull.re, -pull.im};
        const jcal_plane_t before = jcal_plane_add(own, jcal_ball_past_pull(past), past->heading);
        turn_to(&point->heading[1], jcal_plane_add(before, tie, point->heading[0]));
    }
    const jcal_plane_t pull = pull_of(sums, point, 0u);
    const jcal_plane_t own = {pull.re, -pull.im};
    turn_to(&point->heading[0], jcal_plane_add(own, has_closed ? JCAL_BALL_PULL : 0.0f, point->heading[1]));
}

void jcal_ball_round(const jcal_ball_sums_t *sums, const jcal_ball_past_t *past, jcal_ball_point_t *point,
                     unsigned part)
{
    if (part == 0u) {
        find_levers(sums, point);
    } else {
        find_headings(sums, past, point);
    }
}

void jcal_ball_past_add(jcal_ball_past_t *past, const jcal_ball_point_t *point, const float *left)
{
    const float before = jcal_ball_past_pull(past);
    const float own = (left[0] > 0.0f) ? (left[2] - JCAL_BALL_PULL - before) : 0.0f;
    past->known = before + jcal_max(own, 0.0f);
    past->heading = point->heading[1];
}

void jcal_ball_turn(jcal_ball_point_t *point, unsigned number)
{
    static const jcal_plane_t eighths[8] = {
        {1.0f, 0.0f},  {0.70710678f, 0.70710678f},   {0.0f, 1.0f},  {-0.70710678f, 0.70710678f},
        {-1.0f, 0.0f}, {-0.70710678f, -0.70710678f}, {0.0f, -1.0f}, {0.70710678f, -0.70710678f}};
    for (size_t b = 0u; b < JCAL_LEVER_BLOCKS; ++b) {
        point->heading[b] = jcal_plane_direction(jcal_plane_times(point->heading[b], eighths[number % 8u]));
    }
}
