/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of a remembered calibration. See remember/sums.h.
#include "remember/sums.h"

#include "jointcal/vec3.h"
#include "math/sym.h"

#include <stddef.h>

#define UNKNOWNS JCAL_REMEMBER_UNKNOWNS
#define AXIS 2u /* column of a basis that is the axis; 0 and 1 are across it */
#define AXIS_AXIS 8u

/// m v, m row by row.
static jcal_vec3_t times(const float *m, jcal_vec3_t v)
{
    const jcal_vec3_t out = {(m[0] * v.x) + (m[1] * v.y) + (m[2] * v.z), (m[3] * v.x) + (m[4] * v.y) + (m[5] * v.z),
                             (m[6] * v.x) + (m[7] * v.y) + (m[8] * v.z)};
    return out;
}

/// Adds the products of all columns of a with all of b.
static void add_products(jcal_remember_products_t *to, const jcal_vec3_t a[3], const jcal_vec3_t b[3], float weight)
{
    for (size_t k = 0u; k < 3u; ++k) {
        const jcal_vec3_t wa = jcal_vec3_scale(a[k], weight);
        for (size_t l = 0u; l < 3u; ++l) {
            const size_t at = (3u * k) + l;
            to->re[at] += (wa.x * b[l].x) + (wa.y * b[l].y);
            to->im[at] += (wa.y * b[l].x) - (wa.x * b[l].y);
            to->up[at] += wa.z * b[l].z;
        }
    }
}

static void add_own(float *to, const jcal_vec3_t a[3], float weight)
{
    for (size_t k = 0u; k < 3u; ++k) {
        for (size_t l = 0u; l <= k; ++l) {
            to[jcal_sym_at(k, l)] += weight * jcal_vec3_dot(a[k], a[l]);
        }
    }
}

/// b' (Rz' dRz/dd) j of both columns b across the axis j.
static void add_coupling(float to[2], const jcal_vec3_t b[3], float weight)
{
    for (size_t k = 0u; k < 2u; ++k) {
        to[k] += weight * ((b[k].y * b[AXIS].x) - (b[k].x * b[AXIS].y));
    }
}

static void add_axes(jcal_remember_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                     const jcal_tick_weights_t *weights)
{
    jcal_remember_sums_t *const sums = &self->block;
    jcal_vec3_t a[3];
    jcal_vec3_t b[3];
    for (size_t k = 0u; k < 3u; ++k) {
        a[k] = times(tick1->turn, self->e1[k]);
        b[k] = times(tick2->turn, self->e2[k]);
    }
    add_products(&sums->turn, a, b, weights->motion_s);
    add_coupling(sums->turn_coupling, b, weights->motion_s);
    for (size_t k = 0u; k < 3u; ++k) {
        a[k] = times(tick1->rate, self->e1[k]);
        b[k] = times(tick2->rate, self->e2[k]);
    }
    add_products(&sums->rate, a, b, weights->spin);
    add_coupling(sums->rate_coupling, b, weights->spin);
    add_own(sums->rate1, a, weights->spin);
    add_own(sums->rate2, b, weights->spin);
}

static float squares(const float *m)
{
    float sum = 0.0f;
    for (size_t i = 0u; i < 9u; ++i) {
        sum += m[i] * m[i];
    }
    return sum;
}

static void add_levers(jcal_remember_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float motion_s)
{
    jcal_remember_sums_t *const sums = &self->block;
    const jcal_vec3_t y1 = jcal_vec3_sub(tick1->velocity, times(tick1->lever, self->kept.lever1_m));
    const jcal_vec3_t y2 = jcal_vec3_sub(tick2->velocity, times(tick2->lever, self->kept.lever2_m));
    sums->lever[0] += motion_s * ((y1.x * y2.x) + (y1.y * y2.y));
    sums->lever[1] += motion_s * ((y1.y * y2.x) - (y1.x * y2.y));
    sums->lever[2] += motion_s * (y1.z * y2.z);
    sums->gain += motion_s * (squares(tick1->lever) + squares(tick2->lever));
    sums->power += motion_s * (jcal_vec3_dot(y1, y1) + jcal_vec3_dot(y2, y2));
}

void jcal_remember_sums_add(jcal_remember_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                            const jcal_tick_weights_t *weights)
{
    if (self->has_axes) {
        add_axes(self, tick1, tick2, weights);
    }
    if (self->has_levers) {
        add_levers(self, tick1, tick2, weights->motion_s);
    }
    self->block.motion_s += weights->motion_s;
    self->block.time_s += tick1->dt_s;
}

/// a' Rz b of one pair of columns.
static float turned(const jcal_remember_products_t *p, size_t at, jcal_plane_t heading)
{
    return (heading.re * p->re[at]) + (heading.im * p->im[at]) + p->up[at];
}

/// Its derivative by the heading.
static float slope_of(const jcal_remember_products_t *p, size_t at, jcal_plane_t heading)
{
    return (heading.re * p->im[at]) - (heading.im * p->re[at]);
}

/// Minus its second derivative.
static float curve_of(const jcal_remember_products_t *p, size_t at, jcal_plane_t heading)
{
    return (heading.re * p->re[at]) + (heading.im * p->im[at]);
}

void jcal_remember_costs(const jcal_remember_sums_t *sums, jcal_plane_t heading, float pairing,
                         float cost[JCAL_REMEMBER_KINDS])
{
    const float lever = (heading.re * sums->lever[0]) + (heading.im * sums->lever[1]) + sums->lever[2];
    cost[JCAL_REMEMBER_TURN] = 2.0f * (sums->motion_s - (pairing * turned(&sums->turn, AXIS_AXIS, heading)));
    cost[JCAL_REMEMBER_RATE] =
        sums->rate1[5] + sums->rate2[5] - (2.0f * pairing * turned(&sums->rate, AXIS_AXIS, heading));
    cost[JCAL_REMEMBER_LEVER] = sums->power - (2.0f * lever);
}

void jcal_remember_slope(const jcal_remember_sums_t *sums, jcal_plane_t heading,
                         const float weight[JCAL_REMEMBER_KINDS], float slope[2])
{
    const float lever1 = (heading.re * sums->lever[1]) - (heading.im * sums->lever[0]);
    const float lever2 = (heading.re * sums->lever[0]) + (heading.im * sums->lever[1]);
    slope[0] = -(weight[JCAL_REMEMBER_TURN] * slope_of(&sums->turn, AXIS_AXIS, heading)) -
               (weight[JCAL_REMEMBER_RATE] * slope_of(&sums->rate, AXIS_AXIS, heading)) -
               (weight[JCAL_REMEMBER_LEVER] * lever1);
    slope[1] = (weight[JCAL_REMEMBER_TURN] * curve_of(&sums->turn, AXIS_AXIS, heading)) +
               (weight[JCAL_REMEMBER_RATE] * curve_of(&sums->rate, AXIS_AXIS, heading)) +
               (weight[JCAL_REMEMBER_LEVER] * lever2);
}

jcal_plane_t jcal_remember_bend(const jcal_remember_sums_t *sums, jcal_plane_t heading)
{
    const jcal_remember_products_t *const p = &sums->turn;
    const jcal_plane_t out = {0.5f * (turned(p, 0u, heading) + turned(p, 4u, heading)),
                              0.5f * (turned(p, 3u, heading) - turned(p, 1u, heading))};
    return out;
}

/// One of turn and rate, with the products of each sensor's own columns.
typedef struct {
    const jcal_remember_products_t *both;
    const float *own1, *own2;
    const float *coupling;
    float weight;
} part_t;

static void add_part(jcal_remember_system_t *to, const part_t *part, jcal_plane_t heading)
{
    const jcal_remember_products_t *const p = part->both;
    const float w = part->weight;
    for (size_t k = 0u; k < 2u; ++k) {
        for (size_t l = 0u; l < 2u; ++l) {
            to->matrix[jcal_sym_at(2u + l, k)] -= w * turned(p, (3u * k) + l, heading);
        }
        for (size_t l = 0u; l <= k; ++l) {
            to->matrix[jcal_sym_at(k, l)] += w * part->own1[jcal_sym_at(k, l)];
            to->matrix[jcal_sym_at(2u + k, 2u + l)] += w * part->own2[jcal_sym_at(k, l)];
        }
        to->matrix[jcal_sym_at(4u, k)] -= w * slope_of(p, (3u * k) + AXIS, heading);
        to->matrix[jcal_sym_at(4u, 2u + k)] += w * part->coupling[k];
        to->gradient[k] += w * (part->own1[jcal_sym_at(AXIS, k)] - turned(p, (3u * k) + AXIS, heading));
        to->gradient[2u + k] += w * (part->own2[jcal_sym_at(AXIS, k)] - turned(p, (3u * AXIS) + k, heading));
    }
}

/// Takes the heading out, the last of the unknowns.
static void eliminate_heading(jcal_remember_system_t *system)
{
    const float *const last = &system->matrix[JCAL_SYM_SIZE(UNKNOWNS - 1u)];
    const float pivot = last[UNKNOWNS - 1u];
    if (!(pivot > 0.0f)) {
        return;
    }
    for (size_t k = 0u; k < (UNKNOWNS - 1u); ++k) {
        const float share = last[k] / pivot;
        system->gradient[k] -= share * system->gradient[UNKNOWNS - 1u];
        for (size_t l = 0u; l <= k; ++l) {
            system->matrix[jcal_sym_at(k, l)] -= share * last[l];
        }
    }
}

void jcal_remember_system(const jcal_remember_sums_t *sums, jcal_plane_t heading,
                          const float weight[JCAL_REMEMBER_KINDS], jcal_remember_system_t *out)
{
    const float w = sums->motion_s;
    const float own[6] = {w, 0.0f, w, 0.0f, 0.0f, w};
    const part_t turn = {&sums->turn, own, own, sums->turn_coupling, weight[JCAL_REMEMBER_TURN]};
    const part_t rate = {&sums->rate, sums->rate1, sums->rate2, sums->rate_coupling, weight[JCAL_REMEMBER_RATE]};
    float slope[2];
    *out = (jcal_remember_system_t){0};
    add_part(out, &turn, heading);
    add_part(out, &rate, heading);
    jcal_remember_slope(sums, heading, weight, slope);
    out->gradient[UNKNOWNS - 1u] = slope[0];
    out->matrix[JCAL_SYM_SIZE(UNKNOWNS) - 1u] = slope[1];
    eliminate_heading(out);
}
