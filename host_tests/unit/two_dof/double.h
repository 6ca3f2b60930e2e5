/* SPDX-License-Identifier: MIT */
/// @file
/// Residuals of a 2-DoF joint in double precision, for comparison: by matrices, nothing of the library's.
#ifndef JCAL_TEST_TWO_DOF_DOUBLE_H
#define JCAL_TEST_TWO_DOF_DOUBLE_H

#include "two_dof/point.h"
#include "unit/angles/pose.h"

#include <math.h>

/* Angle between the lines through two unit vectors, rad. */
static inline double apart(jcal_vec3_t a, jcal_vec3_t b)
{
    const double p[3] = {a.x, a.y, a.z};
    const double q[3] = {b.x, b.y, b.z};
    const double x = p[1] * q[2] - p[2] * q[1];
    const double y = p[2] * q[0] - p[0] * q[2];
    const double z = p[0] * q[1] - p[1] * q[0];
    return atan2(sqrt(x * x + y * y + z * z), fabs(p[0] * q[0] + p[1] * q[1] + p[2] * q[2]));
}

/* Residuals in double precision, by matrices; nothing of the library's. */

/// One sample: orientations, and rates in the earth frames.
typedef struct {
    jcal_quat_t q1, q2;
    jcal_vec3_t w1, w2;
} double_sample_t;

/// Axes, heading offset and sine of the carrying angle.
typedef struct {
    double j1[3], j2[3], delta, sine;
} unknowns_t;

static inline void rotate(jcal_quat_t q, const double *v, double *out)
{
    const double w = q.w, x = q.x, y = q.y, z = q.z;
    const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    for (int i = 0; i < 3; ++i) {
        out[i] = r[i][0] * v[0] + r[i][1] * v[1] + r[i][2] * v[2];
    }
}

static inline void about_z(double delta, double *v)
{
    const double x = v[0];
    v[0] = cos(delta) * x - sin(delta) * v[1];
    v[1] = sin(delta) * x + cos(delta) * v[1];
}

static inline double residual_double(const double_sample_t *row, jcal_constraint_t constraint, const unknowns_t *p)
{
    double a[3], b[3];
    double w2[3] = {row->w2.x, row->w2.y, row->w2.z};
    const double w1[3] = {row->w1.x, row->w1.y, row->w1.z};
    rotate(row->q1, p->j1, a);
    rotate(row->q2, p->j2, b);
    about_z(p->delta, b);
    if (constraint == JCAL_CONSTRAINT_ORIENTATION) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - p->sine;
    }
    about_z(p->delta, w2);
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return ((w1[0] - w2[0]) * n[0] + (w1[1] - w2[1]) * n[1] + (w1[2] - w2[2]) * n[2]) / length;
}

static inline void moved_axis(const double *j, const jcal_tangent_t *t, const double *d, double *out)
{
    const double u[3] = {t->u.x, t->u.y, t->u.z};
    const double v[3] = {t->v.x, t->v.y, t->v.z};
    double square = 0.0;
    for (int i = 0; i < 3; ++i) {
        out[i] = j[i] + d[0] * u[i] + d[1] * v[i];
        square += out[i] * out[i];
    }
    for (int i = 0; i < 3; ++i) {
        out[i] /= sqrt(square);
    }
}

/* The unknowns moved by `size` along number `which` of the six. */
static inline unknowns_t moved(const jcal_two_dof_point_t *point, float sine, int which, double size)
{
    const double j1[3] = {point->j1.x, point->j1.y, point->j1.z};
    const double j2[3] = {point->j2.x, point->j2.y, point->j2.z};
    const jcal_tangent_t t1 = jcal_sphere_tangent(point->j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(point->j2);
    double d[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    unknowns_t out;
    d[which] = size;
    moved_axis(j1, &t1, &d[0], out.j1);
    moved_axis(j2, &t2, &d[2], out.j2);
    out.delta = atan2((double)point->heading.im, (double)point->heading.re) + d[4];
    out.sine = (double)sine + d[5];
    return out;
}

static inline jcal_two_dof_point_t point_of(int k)
{
    const jcal_vec3_t j1 = pose_axis(pose_any(11 * k + 3), 0);
    const jcal_vec3_t j2 = pose_axis(pose_any(13 * k + 5), 1);
    const jcal_two_dof_point_t point = {j1, j2, {(float)cos(0.9 * k), (float)sin(0.9 * k)}};
    return point;
}

#endif /* JCAL_TEST_TWO_DOF_DOUBLE_H */
