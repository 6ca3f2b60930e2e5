/* SPDX-License-Identifier: MIT */
/// @file
/// The hinge constraint in double precision, sample by sample: what moments and derivatives are compared with.
#ifndef HINGE_DOUBLE_H
#define HINGE_DOUBLE_H

#include "hinge/model.h"
#include "hinge/point.h"
#include "math/rng.h"
#include "math/sym.h"

#include <math.h>

/// A point of the parameter space; index 0 is sensor 1.
typedef struct {
    double j[2][3];
} dpoint_t;

/// A sample with its weights.
typedef struct {
    double w[2][3];
    double a[2][3];
    double gyr_weight;
    double acc_weight;
} dsample_t;

static inline double ddot(const double *a, const double *b)
{
    return (a[0] * b[0]) + (a[1] * b[1]) + (a[2] * b[2]);
}

static inline void dset(jcal_vec3_t v, double out[3])
{
    out[0] = (double)v.x;
    out[1] = (double)v.y;
    out[2] = (double)v.z;
}

static inline jcal_vec3_t dget(const double v[3])
{
    return jcal_vec3((float)v[0], (float)v[1], (float)v[2]);
}

static inline dpoint_t dpoint(const jcal_hinge_point_t *point)
{
    dpoint_t p = {0};
    dset(point->axis1.j, p.j[0]);
    dset(point->axis2.j, p.j[1]);
    return p;
}

/// |w x j|^2 by the cross product: nothing in common with the expanded form in lib/.
static inline double dacross2(const double w[3], const double j[3])
{
    const double c[3] = {(w[1] * j[2]) - (w[2] * j[1]), (w[2] * j[0]) - (w[0] * j[2]), (w[0] * j[1]) - (w[1] * j[0])};
    return ddot(c, c);
}

static inline double de_gyr(const dsample_t *s, const dpoint_t *p)
{
    return dacross2(s->w[0], p->j[0]) - dacross2(s->w[1], p->j[1]);
}

static inline double de_acc(const dsample_t *s, const dpoint_t *p)
{
    return ddot(s->a[0], p->j[0]) - ddot(s->a[1], p->j[1]);
}

/// Moves one of the 4 unknowns of hinge/model.h by h: along u or v of an axis.
static inline dpoint_t dmoved(const jcal_hinge_point_t *point, unsigned unknown, double h)
{
    dpoint_t p = dpoint(point);
    const unsigned s = unknown / 2u;
    const jcal_hinge_axis_t *const axis = (s == 0u) ? &point->axis1 : &point->axis2;
    double t[3];
    dset(((unknown % 2u) == 0u) ? axis->u : jcal_vec3_cross(axis->j, axis->u), t);
    for (int i = 0; i < 3; ++i) {
        p.j[s][i] += h * t[i];
    }
    const double norm = sqrt(ddot(p.j[s], p.j[s]));
    for (int i = 0; i < 3; ++i) {
        p.j[s][i] /= norm;
    }
    return p;
}

/// Adds a sample to moments, with the layout that hinge.h and hinge/model.h state.
static inline void add_to_moments(const dsample_t *s, jcal_hinge_moments_t *moments)
{
    float z[JCAL_HINGE_FEATURES];
    jcal_hinge_features(dget(s->w[0]), dget(s->w[1]), z);
    jcal_sym_rank1(moments->gyr, JCAL_HINGE_FEATURES, z, (float)s->gyr_weight);
    const float y[7] = {(float)s->a[0][0],
                        (float)s->a[0][1],
                        (float)s->a[0][2],
                        -(float)s->a[1][0],
                        -(float)s->a[1][1],
                        -(float)s->a[1][2],
                        1.0f};
    jcal_sym_rank1(moments->acc, 7u, y, (float)s->acc_weight);
}

/// Random numbers, each a float, so that both precisions see the same.
static inline dsample_t random_sample(jcal_rng_t *rng)
{
    dsample_t s;
    for (int sensor = 0; sensor < 2; ++sensor) {
        for (int i = 0; i < 3; ++i) {
            s.w[sensor][i] = (double)(3.0f * jcal_rng_symmetric(rng));
            s.a[sensor][i] = (double)(9.0f * jcal_rng_symmetric(rng));
        }
    }
    s.gyr_weight = (double)(1.5f + jcal_rng_symmetric(rng));
    s.acc_weight = (double)(0.15f + (0.1f * jcal_rng_symmetric(rng)));
    return s;
}

static inline void random_axis(jcal_rng_t *rng, jcal_hinge_axis_t *axis)
{
    axis->u = jcal_rng_unit(rng);
    jcal_hinge_axis_set(axis, jcal_rng_unit(rng));
}

static inline jcal_hinge_point_t random_point(jcal_rng_t *rng)
{
    jcal_hinge_point_t point;
    random_axis(rng, &point.axis1);
    random_axis(rng, &point.axis2);
    return point;
}

#endif /* HINGE_DOUBLE_H */
