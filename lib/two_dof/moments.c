/* SPDX-License-Identifier: MIT */
/// @file
/// Features and moments of the 2-DoF joint. Equations: two_dof/model.h.
#include "jointcal/quat.h"
#include "math/sym.h"
#include "two_dof/model.h"

#include <stddef.h>

#define PAIRS 9u

/// Columns of the rotation matrix of q.
typedef struct {
    jcal_vec3_t column[3];
} rotation_t;

static rotation_t rotation_of(jcal_quat_t q)
{
    const rotation_t r = {{jcal_quat_rotate(q, jcal_vec3(1.0f, 0.0f, 0.0f)),
                           jcal_quat_rotate(q, jcal_vec3(0.0f, 1.0f, 0.0f)),
                           jcal_quat_rotate(q, jcal_vec3(0.0f, 0.0f, 1.0f))}};
    return r;
}

/* a . D_m b for m = 0, 1, 2, with D_0 = diag(1, 1, 0), D_1 = z x, D_2 = diag(0, 0, 1). */
static void dot_turned(jcal_vec3_t a, jcal_vec3_t b, float *out)
{
    out[0] = (a.x * b.x) + (a.y * b.y);
    out[1] = (a.y * b.x) - (a.x * b.y);
    out[2] = a.z * b.z;
}

void jcal_two_dof_rotation_features(const jcal_two_dof_sample_t *sample, float *f)
{
    const rotation_t r1 = rotation_of(sample->q1);
    const rotation_t r2 = rotation_of(sample->q2);
    for (size_t i = 0u; i < 3u; ++i) {
        /* w1 . (a x D b) = (w1 x a) . D b, and w2 . (D' a x b) = -(w2 x b) . D' a = -a . D (w2 x b). */
        const jcal_vec3_t turned1 = jcal_vec3_cross(sample->w1, r1.column[i]);
        for (size_t k = 0u; k < 3u; ++k) {
            const jcal_vec3_t turned2 = jcal_vec3_cross(sample->w2, r2.column[k]);
            float first[3];
            float second[3];
            dot_turned(turned1, r2.column[k], first);
            dot_turned(r1.column[i], turned2, second);
            float *const out = &f[((i * 3u) + k) * 3u];
            out[0] = first[0] + second[0];
            out[1] = first[1] + second[1];
            out[2] = first[2] + second[2];
        }
    }
}

void jcal_two_dof_orientation_features(jcal_quat_t q1, jcal_quat_t q2, float *g)
{
    const rotation_t r1 = rotation_of(q1);
    const rotation_t r2 = rotation_of(q2);
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t k = 0u; k < 3u; ++k) {
            dot_turned(r1.column[i], r2.column[k], &g[((i * 3u) + k) * 3u]);
        }
    }
}

/* row (3) <- row + s v (3) */
static inline void add3(float *row, float s, const float *v)
{
    row[0] += s * v[0];
    row[1] += s * v[1];
    row[2] += s * v[2];
}

void jcal_two_dof_add(float *m, const float *v, float weight)
{
    float *row = m;
    for (size_t a = 0u; a < PAIRS; ++a) {
        const float *const va = &v[3u * a];
        const float s0 = weight * va[0];
        const float s1 = weight * va[1];
        const float s2 = weight * va[2];
        float *const row1 = row + (3u * a) + 1u;
        float *const row2 = row1 + (3u * a) + 2u;
        for (size_t b = 0u; b < (3u * a); b += 3u) {
            add3(&row[b], s0, &v[b]);
            add3(&row1[b], s1, &v[b]);
            add3(&row2[b], s2, &v[b]);
        }
        const size_t d = 3u * a;
        row[d] += s0 * va[0];
        row1[d] += s1 * va[0];
        row1[d + 1u] += s1 * va[1];
        add3(&row2[d], s2, va);
        row = row2 + d + 3u;
    }
}

/* (x, y) turned */
static inline void turn2(float *x, float *y, jcal_plane_t turn)
{
    const float a = *x;
    const float b = *y;
    *x = (turn.re * a) - (turn.im * b);
    *y = (turn.im * a) + (turn.re * b);
}

/* m <- U m U', U turning the first two of each three. */
static void turn_form(float *m, jcal_plane_t turn)
{
    for (size_t a = 0u; a < PAIRS; ++a) {
        float *const row0 = &m[JCAL_SYM_SIZE(3u * a)];
        float *const row1 = &m[JCAL_SYM_SIZE((3u * a) + 1u)];
        float *const row2 = &m[JCAL_SYM_SIZE((3u * a) + 2u)];
        for (size_t b = 0u; b < a; ++b) {
            for (size_t q = 3u * b; q < ((3u * b) + 3u); ++q) {
                turn2(&row0[q], &row1[q], turn);
            }
            turn2(&row0[3u * b], &row0[(3u * b) + 1u], turn);
            turn2(&row1[3u * b], &row1[(3u * b) + 1u], turn);
            turn2(&row2[3u * b], &row2[(3u * b) + 1u], turn);
        }
        const size_t d = 3u * a;
        float lower[2] = {row0[d], row1[d]};      /* first column of the diagonal block ... */
        float upper[2] = {row1[d], row1[d + 1u]}; /* ... and second */
        turn2(&lower[0], &lower[1], turn);
        turn2(&upper[0], &upper[1], turn);
        turn2(&lower[0], &upper[0], turn);
        turn2(&lower[1], &upper[1], turn);
        row0[d] = lower[0];
        row1[d] = lower[1];
        row1[d + 1u] = upper[1];
        turn2(&row2[d], &row2[d + 1u], turn);
    }
}

void jcal_two_dof_turn(jcal_two_dof_moments_t *moments, jcal_plane_t turn)
{
    turn_form(moments->rotation, turn);
    turn_form(moments->orientation, turn);
    for (size_t a = 0u; a < PAIRS; ++a) {
        turn2(&moments->mean[3u * a], &moments->mean[(3u * a) + 1u], turn);
    }
}

void jcal_two_dof_fade(jcal_two_dof_moments_t *moments, float share)
{
    jcal_sym_scale(moments->rotation, JCAL_TWO_DOF_FEATURES, share);
    jcal_sym_scale(moments->orientation, JCAL_TWO_DOF_FEATURES, share);
    for (size_t i = 0u; i < JCAL_TWO_DOF_FEATURES; ++i) {
        moments->mean[i] *= share;
    }
    moments->weight *= share;
}
