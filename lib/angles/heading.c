/* SPDX-License-Identifier: MIT */
/// @file
/// Heading offset with known axes. See joint_heading.h.
///
/// With a = R1 j1 in E1, b = R2 j2 in E2 and u = (cos delta, sin delta, 1), the scalar product of the axes is linear in u:
///
///     a . Rz(delta) b = G . u,   G_c = a_x b_x + a_y b_y,   G_s = a_y b_x - a_x b_y,   G_1 = a_z b_z.
///
/// Hinge: it is largest where the axes agree, so delta is the angle of the point (sum G_c, sum G_s).
/// Two axes: it is sin(carrying), so with G_1 - sin(carrying) in place of G_1 the sum of (G . u)^2 = u' M u is least.
#include "jointcal/joint_heading.h"

#include "jointcal/quat.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "sample/clock.h"
#include "sample/unit.h"

#include <stddef.h>

#define MICROSECONDS 1e-6f

/// Longest distance of two pairs that go on from each other, s; the first pair after a longer hole is left out.
#define GAP_MAX_S 10.0f

/// A pair counts for the time since the one before, but for no more than this, s; the first one for the least.
#define COUNT_MAX_S 0.1f
#define COUNT_FIRST_S 1e-3f

/// A hinge axis within about 10 deg of the vertical says nothing about the heading: least product of the horizontal parts.
#define HORIZONTAL_MIN 0.03f

/// Headings that are tried, 10 deg apart: the mean of (G . u)^2 has at most two minima.
#define HEADINGS 36u
#define HEADING_STEP_RAD (2.0f * JCAL_PI / (float)HEADINGS)
#define NEWTON_STEPS 3u

/// The other minimum must be worse by this: mean square of the sine, that of 4 deg.
#define RIVAL_MIN 0.005f
/// Least mean square slope of the scalar product: that of axes whose horizontal parts are 0.3 long and across each other.
#define SLOPE2_MIN 0.01f

static bool is_axis(jcal_vec3_t axis)
{
    return jcal_vec3_is_finite(axis) && jcal_vec3_is_finite(jcal_vec3_normalise(axis)) &&
           (jcal_vec3_norm(jcal_vec3_normalise(axis)) > 0.5f);
}

static jcal_status_t begin(jcal_joint_heading_t *self, jcal_vec3_t axis1, jcal_vec3_t axis2, float memory_s)
{
    if ((self == NULL) || !is_axis(axis1) || !is_axis(axis2) || !jcal_within(memory_s, 0.0f, 600.0f)) {
        return JCAL_ERR_ARG;
    }
    jcal_clear(self, sizeof *self);
    self->axis1 = jcal_vec3_normalise(axis1);
    self->axis2 = jcal_vec3_normalise(axis2);
    self->memory_s = memory_s;
    return JCAL_OK;
}

jcal_status_t jcal_joint_heading_hinge(jcal_joint_heading_t *self, jcal_vec3_t axis1, jcal_vec3_t axis2, float memory_s)
{
    const jcal_status_t status = begin(self, axis1, axis2, memory_s);
    if (status == JCAL_OK) {
        self->hinge = true;
    }
    return status;
}

jcal_status_t jcal_joint_heading_two_dof(jcal_joint_heading_t *self, jcal_vec3_t axis1, jcal_vec3_t axis2,
                                         float carrying_rad, float memory_s)
{
    if (!jcal_within(carrying_rad, -1.5f, 1.5f) || !(memory_s >= 1.0f)) {
        return JCAL_ERR_ARG;
    }
    const jcal_status_t status = begin(self, axis1, axis2, memory_s);
    if (status == JCAL_OK) {
        self->sin_carrying = jcal_cis(carrying_rad).im;
    }
    return status;
}

jcal_status_t jcal_joint_heading_improve(jcal_joint_heading_t *self, jcal_vec3_t axis1, jcal_vec3_t axis2,
                                         float carrying_rad)
{
    if ((self == NULL) || !is_axis(axis1) || !is_axis(axis2) || !jcal_within(carrying_rad, -1.5f, 1.5f)) {
        return JCAL_ERR_ARG;
    }
    self->axis1 = jcal_vec3_normalise(axis1);
    self->axis2 = jcal_vec3_normalise(axis2);
    self->sin_carrying = self->hinge ? 0.0f : jcal_cis(carrying_rad).im;
    return JCAL_OK;
}

/* The largest is where the axes agree; its size is the mean product of the horizontal parts. */
static void solve_hinge(jcal_joint_heading_t *self)
{
    const jcal_plane_t sum = {self->sums[0], self->sums[1]};
    if (jcal_plane_norm(sum) > (HORIZONTAL_MIN * self->weight)) {
        self->last.heading_rad = jcal_atan2(sum.im, sum.re);
        self->last.known = true;
    }
}

/* u' M u at a heading. */
static float cost(const float *m, jcal_plane_t u)
{
    return (u.re * ((m[0] * u.re) + (2.0f * ((m[1] * u.im) + m[2])))) + (u.im * ((m[3] * u.im) + (2.0f * m[4]))) + m[5];
}

/* Half the derivative of the cost by the heading, and the mean square slope of G . u. */
static void slope(const float *m, jcal_plane_t u, float *half_gradient, float *square)
{
    const float mc = (m[0] * u.re) + (m[1] * u.im) + m[2];
    const float ms = (m[1] * u.re) + (m[3] * u.im) + m[4];
    *half_gradient = (u.re * ms) - (u.im * mc);
    *square = (u.im * ((m[0] * u.im) - (2.0f * m[1] * u.re))) + (m[3] * u.re * u.re);
}

/* The best of the headings tried, and the cost of the best local minimum beside it; false if there is none. */
static bool search(const float *m, jcal_plane_t *best, float *best_cost, float *rival_cost)
{
    float costs[HEADINGS];
    jcal_plane_t headings[HEADINGS];
    unsigned lowest = 0u;
    for (unsigned i = 0u; i < HEADINGS; ++i) {
        headings[i] = jcal_cis((float)i * HEADING_STEP_RAD);
        costs[i] = cost(m, headings[i]);
        lowest = (costs[i] < costs[lowest]) ? i : lowest;
    }
    *best = headings[lowest];
    *best_cost = costs[lowest];
    bool rival = false;
    for (unsigned i = 0u; i < HEADINGS; ++i) {
        const float before = costs[(i + HEADINGS - 1u) % HEADINGS];
        const float after = costs[(i + 1u) % HEADINGS];
        if ((i != lowest) && (costs[i] <= before) && (costs[i] <= after) && (!rival || (costs[i] < *rival_cost))) {
            *rival_cost = costs[i];
            rival = true;
        }
    }
    return rival;
}

static void solve_two_dof(jcal_joint_heading_t *self)
{
    jcal_plane_t u;
    float best_cost;
    float rival_cost = 0.0f;
    const bool rival = search(self->sums, &u, &best_cost, &rival_cost);
    float square = 0.0f;
    for (unsigned i = 0u; i < NEWTON_STEPS; ++i) {
        float gradient;
        slope(self->sums, u, &gradient, &square);
        if (!(square > (SLOPE2_MIN * self->weight))) {
            return;
        }
        const float step = jcal_max(-HEADING_STEP_RAD, jcal_min(HEADING_STEP_RAD, -gradient / square));
        u = jcal_plane_direction(jcal_plane_times(u, jcal_plane_turn(step)));
    }
    /* The heading tried may have been up to half a step beside its minimum; the rival's cost is too high for the same reason. */
    best_cost = cost(self->sums, u);
    if (!rival || ((rival_cost - best_cost) > (RIVAL_MIN * self->weight))) {
        self->last.heading_rad = jcal_atan2(u.im, u.re);
        self->last.known = true;
    }
}

/* Fades what there is and adds a pair's G. */
static void add(jcal_joint_heading_t *self, jcal_vec3_t a, jcal_vec3_t b, float dt_s)
{
    const float keep = self->has_time ? (self->memory_s / (self->memory_s + dt_s)) : 0.0f;
    const float share = jcal_min(dt_s, COUNT_MAX_S);
    const float g[3] = {(a.x * b.x) + (a.y * b.y), (a.y * b.x) - (a.x * b.y), (a.z * b.z) - self->sin_carrying};
    self->weight = (keep * self->weight) + share;
    if (self->hinge) {
        self->sums[0] = (keep * self->sums[0]) + (share * g[0]);
        self->sums[1] = (keep * self->sums[1]) + (share * g[1]);
        return;
    }
    unsigned at = 0u;
    for (unsigned i = 0u; i < 3u; ++i) {
        for (unsigned k = i; k < 3u; ++k) {
            self->sums[at] = (keep * self->sums[at]) + (share * g[i] * g[k]);
            ++at;
        }
    }
}

jcal_status_t jcal_joint_heading_push(jcal_joint_heading_t *self, const jcal_orientation_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (!jcal_is_unit(pair->q1) || !jcal_is_unit(pair->q2)) {
        return JCAL_REJECTED; /* the sums would not forget a long one for hours, and zeros are no orientation */
    }
    float since_s;
    if (jcal_clock_check(&self->clock, GAP_MAX_S, pair->t_us, &since_s) != JCAL_REJECT_NONE) {
        return JCAL_REJECTED;
    }
    const jcal_vec3_t a = jcal_quat_rotate(jcal_quat_normalise(pair->q1), self->axis1);
    const jcal_vec3_t b = jcal_quat_rotate(jcal_quat_normalise(pair->q2), self->axis2);
    const bool goes_on = self->has_time && (pair->t_us > self->t_us);
    const float dt_s = goes_on ? ((float)(pair->t_us - self->t_us) * MICROSECONDS) : COUNT_FIRST_S;
    add(self, a, b, dt_s);
    self->t_us = pair->t_us;
    self->has_time = true;
    if (self->hinge) {
        solve_hinge(self);
    } else {
        solve_two_dof(self);
    }
    return JCAL_OK;
}

jcal_status_t jcal_joint_heading_get(const jcal_joint_heading_t *self, jcal_heading_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    *out = self->last;
    return JCAL_OK;
}
