/* SPDX-License-Identifier: MIT */
/// @file
/// Residual and features of the joint centre. Equations: center/model.h.
#include "center/model.h"

#include "jointcal/vec3.h"
#include "math/plane.h"
#include "math/sym.h"

#include <stddef.h>

/// Least |a - K r| that has a direction, m/s^2.
#define FORCE_MIN 0.5f

/// Features of one body: 1, r, r r'.
#define OWN 9u

/* The 9 features of sign |a - K r|^2 that are not constant. */
static void own_features(const jcal_segment_t *body, float sign, float *f)
{
    const jcal_vec3_t *const k = body->k;
    for (size_t i = 0u; i < 3u; ++i) {
        f[i] = -2.0f * sign * jcal_vec3_dot(k[i], body->a);
    }
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t j = 0u; j <= i; ++j) {
            f[3u + jcal_sym_at(i, j)] = ((i == j) ? 1.0f : 2.0f) * sign * jcal_vec3_dot(k[i], k[j]);
        }
    }
}

void jcal_center_features(const jcal_kinematic_t *sample, float *f)
{
    f[0] = jcal_vec3_dot(sample->body1.a, sample->body1.a) - jcal_vec3_dot(sample->body2.a, sample->body2.a);
    own_features(&sample->body1, 1.0f, &f[1]);
    own_features(&sample->body2, -1.0f, &f[1u + OWN]);
}

static void own_monomials(jcal_vec3_t r, float *phi)
{
    phi[0] = r.x;
    phi[1] = r.y;
    phi[2] = r.z;
    phi[3] = r.x * r.x;
    phi[4] = r.x * r.y;
    phi[5] = r.y * r.y;
    phi[6] = r.x * r.z;
    phi[7] = r.y * r.z;
    phi[8] = r.z * r.z;
}

void jcal_center_monomials(const jcal_center_place_t *place, float *phi)
{
    phi[0] = 1.0f;
    own_monomials(place->r1, &phi[1]);
    own_monomials(place->r2, &phi[1u + OWN]);
}

/// One element of a sparse derivative of phi.
typedef struct {
    uint8_t at;   ///< Which monomial of the body.
    uint8_t by;   ///< Its derivative: the component of r ...
    float times;  ///< ... this often; with by = 3, one.
} slope_t;

/// d phi / d r_x, r_y, r_z of one body: four elements each.
static const slope_t slopes[3][4] = {{{0u, 3u, 1.0f}, {3u, 0u, 2.0f}, {4u, 1u, 1.0f}, {6u, 2u, 1.0f}},
                                     {{1u, 3u, 1.0f}, {4u, 0u, 1.0f}, {5u, 1u, 2.0f}, {7u, 2u, 1.0f}},
                                     {{2u, 3u, 1.0f}, {6u, 0u, 1.0f}, {7u, 1u, 1.0f}, {8u, 2u, 2.0f}}};

/* d phi / d unknown, as places in phi and values, four each. */
static void slope_of(const jcal_center_place_t *place, size_t unknown, size_t *at, float *value)
{
    const jcal_vec3_t r = (unknown < 3u) ? place->r1 : place->r2;
    const float components[4] = {r.x, r.y, r.z, 1.0f};
    const size_t first = (unknown < 3u) ? 1u : (1u + OWN);
    const slope_t *const slope = slopes[unknown % 3u];
    for (size_t i = 0u; i < 4u; ++i) {
        at[i] = first + slope[i].at;
        value[i] = slope[i].times * components[slope[i].by];
    }
}

float jcal_center_form(const float *moments, const jcal_center_place_t *place, float *gradient)
{
    float phi[JCAL_CENTER_FEATURES];
    float on[JCAL_CENTER_FEATURES]; /* M phi */
    jcal_center_monomials(place, phi);
    jcal_sym_times(moments, JCAL_CENTER_FEATURES, phi, on);
    float cost = 0.0f;
    for (size_t i = 0u; i < JCAL_CENTER_FEATURES; ++i) {
        cost += phi[i] * on[i];
    }
    for (size_t i = 0u; i < JCAL_CENTER_PLACE_UNKNOWNS; ++i) {
        size_t at[4];
        float value[4];
        slope_of(place, i, at, value);
        gradient[i] = (value[0] * on[at[0]]) + (value[1] * on[at[1]]) + (value[2] * on[at[2]]) + (value[3] * on[at[3]]);
    }
    return cost;
}

void jcal_center_form_row(const float *moments, const jcal_center_place_t *place, size_t row, float *matrix)
{
    size_t at[4];
    float value[4];
    slope_of(place, row, at, value);
    for (size_t j = 0u; j <= row; ++j) {
        size_t other_at[4];
        float other[4];
        slope_of(place, j, other_at, other);
        float sum = 0.0f;
        for (size_t k = 0u; k < 4u; ++k) {
            for (size_t l = 0u; l < 4u; ++l) {
                sum += value[k] * other[l] * moments[jcal_sym_at(at[k], other_at[l])];
            }
        }
        matrix[jcal_sym_at(row, j)] = sum;
    }
}

/* sign times the derivatives of |a - b - K r| by r and b, along its direction. */
static void own_row(const jcal_segment_t *body, jcal_vec3_t along, float *by_r, float *by_b)
{
    const jcal_vec3_t *const k = body->k;
    by_r[0] = -jcal_vec3_dot(k[0], along);
    by_r[1] = -jcal_vec3_dot(k[1], along);
    by_r[2] = -jcal_vec3_dot(k[2], along);
    by_b[0] = -jcal_vec3_dot(body->turn[0], along);
    by_b[1] = -jcal_vec3_dot(body->turn[1], along);
    by_b[2] = -jcal_vec3_dot(body->turn[2], along);
}

bool jcal_center_residual(const jcal_kinematic_t *sample, const jcal_center_point_t *point, jcal_center_residual_t *out)
{
    const jcal_vec3_t a1 = jcal_vec3_sub(sample->body1.a, jcal_segment_turn(&sample->body1, point->b1));
    const jcal_vec3_t a2 = jcal_vec3_sub(sample->body2.a, jcal_segment_turn(&sample->body2, point->b2));
    const jcal_vec3_t turn1 = jcal_segment_times(&sample->body1, point->place.r1);
    const jcal_vec3_t turn2 = jcal_segment_times(&sample->body2, point->place.r2);
    const jcal_vec3_t v1 = jcal_vec3_sub(a1, turn1);
    const jcal_vec3_t v2 = jcal_vec3_sub(a2, turn2);
    const float n1 = jcal_vec3_norm(v1);
    const float n2 = jcal_vec3_norm(v2);
    if (!((n1 > FORCE_MIN) && (n2 > FORCE_MIN))) {
        return false;
    }
    out->part = 0u;
    own_row(&sample->body1, jcal_vec3_scale(v1, 1.0f / n1), &out->row[0], &out->row[6]);
    own_row(&sample->body2, jcal_vec3_scale(v2, -1.0f / n2), &out->row[3], &out->row[9]);
    out->e = n1 - n2;
    out->e_apart = jcal_vec3_norm(a1) - jcal_vec3_norm(a2);
    out->turn2 = jcal_vec3_dot(turn1, turn1) + jcal_vec3_dot(turn2, turn2);
    return true;
}

/* Rz v. */
static jcal_vec3_t turned(jcal_plane_t heading, jcal_vec3_t v)
{
    return jcal_vec3((heading.re * v.x) - (heading.im * v.y), (heading.im * v.x) + (heading.re * v.y), v.z);
}

static float component(jcal_vec3_t v, unsigned part)
{
    return (part == 0u) ? v.x : ((part == 1u) ? v.y : v.z);
}

void jcal_center_residual_oriented(const jcal_kinematic_t *sample, const jcal_center_point_t *point, unsigned part,
                                   jcal_center_residual_t *out)
{
    const jcal_segment_t *const body1 = &sample->body1;
    const jcal_segment_t *const body2 = &sample->body2;
    const jcal_vec3_t turn1 = jcal_segment_times(body1, point->place.r1);
    const jcal_vec3_t turn2 = jcal_segment_times(body2, point->place.r2);
    const jcal_vec3_t apart = jcal_vec3_sub(body1->a, turned(point->heading, body2->a));
    const jcal_vec3_t at2 = turned(point->heading, jcal_vec3_sub(body2->a, turn2));
    const jcal_vec3_t e = jcal_vec3_sub(jcal_vec3_sub(body1->a, turn1), at2);
    *out = (jcal_center_residual_t){0};
    out->e = component(e, part);
    out->e_apart = component(apart, part);
    out->turn2 = jcal_vec3_dot(turn1, turn1) + jcal_vec3_dot(turn2, turn2);
    out->part = part;
    for (size_t i = 0u; i < 3u; ++i) {
        out->row[i] = -component(body1->k[i], part);
        out->row[3u + i] = component(turned(point->heading, body2->k[i]), part);
    }
    out->row[6] = component(jcal_vec3(at2.y, -at2.x, 0.0f), part);
}

void jcal_center_add_heading(const jcal_kinematic_t *sample, const jcal_center_place_t *place, jcal_plane_t *sum)
{
    const jcal_vec3_t f1 = jcal_vec3_sub(sample->body1.a, jcal_segment_times(&sample->body1, place->r1));
    const jcal_vec3_t f2 = jcal_vec3_sub(sample->body2.a, jcal_segment_times(&sample->body2, place->r2));
    const jcal_plane_t flat1 = {f1.x, f1.y};
    const jcal_plane_t flat2 = {f2.x, f2.y};
    *sum = jcal_plane_add(*sum, 1.0f, jcal_plane_against(flat2, flat1));
}
