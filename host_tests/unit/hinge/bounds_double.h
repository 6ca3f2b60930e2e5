/* SPDX-License-Identifier: MIT */
/// @file
/// The bounds of lib/hinge/bounds.h in double precision: information by elimination instead of factors,
/// eigenvectors by Jacobi's rotations.
#ifndef HINGE_BOUNDS_DOUBLE_H
#define HINGE_BOUNDS_DOUBLE_H

#include "hinge/refine.h"
#include "jointcal/hinge.h"
#include "unit/hinge/double.h"

#include <string.h>

/// Packed float matrix to a full double one (n x n).
static inline void dunpack(const float *packed, size_t n, double *out)
{
    for (size_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < n; ++k) {
            out[(n * i) + k] = (double)packed[jcal_sym_at(i, k)];
        }
    }
}

/// Eigenvectors (columns of v, 4 x 4) of a (4 x 4), which becomes diagonal.
static inline void djacobi(double a[4][4], double v[4][4])
{
    memset(v, 0, 16 * sizeof(double));
    for (int i = 0; i < 4; ++i) {
        v[i][i] = 1.0;
    }
    for (int turn = 0; turn < 20 * 6; ++turn) {
        const int pairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
        const int p = pairs[turn % 6][0];
        const int q = pairs[turn % 6][1];
        const double angle = 0.5 * atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
        const double c = cos(angle);
        const double s = sin(angle);
        for (int i = 0; i < 4; ++i) {
            const double ip = a[i][p];
            const double iq = a[i][q];
            a[i][p] = (c * ip) - (s * iq);
            a[i][q] = (s * ip) + (c * iq);
        }
        for (int i = 0; i < 4; ++i) {
            const double pi = a[p][i];
            const double qi = a[q][i];
            const double vp = v[i][p];
            const double vq = v[i][q];
            a[p][i] = (c * pi) - (s * qi);
            a[q][i] = (s * pi) + (c * qi);
            v[i][p] = (c * vp) - (s * vq);
            v[i][q] = (s * vp) + (c * vq);
        }
    }
}

/// Scatter met over scatter expected, with 6 blocks of what the size of the residuals lets expect.
static inline double dblend(double met, double noise, double blocks)
{
    const double correlation = 0.5 + (3.0 / (1.0 + (20.0 / noise)));
    return ((met * blocks) + (6.0 * correlation * noise)) / (blocks + 6.0);
}

static inline double dquadratic(double m[4][4], const double v[4])
{
    double sum = 0.0;
    for (int i = 0; i < 16; ++i) {
        sum += v[i / 4] * m[i / 4][i % 4] * v[i % 4];
    }
    return sum;
}

/// Information of the tilts with the biases eliminated, each with `prior` readings of its own.
static inline void dinformation(const jcal_hinge_refine_t *refine, double prior, double out[4][4])
{
    double m[64];
    dunpack(refine->matrix, 8, m);
    for (int p = 7; p >= 4; --p) {
        m[9 * p] += prior;
    }
    for (int p = 7; p >= 4; --p) {
        for (int i = 0; i < p; ++i) {
            for (int k = 0; k < p; ++k) {
                m[(8 * i) + k] -= m[(8 * i) + p] * m[(8 * p) + k] / m[9 * p];
            }
        }
    }
    for (int i = 0; i < 16; ++i) {
        out[i / 4][i % 4] = m[(8 * (i / 4)) + (i % 4)];
    }
}

/// 95 % radius of one axis for its covariance, wider where the sums are hardly linear.
static inline double dbound(const jcal_hinge_t *self, int axis, const double c[3])
{
    const jcal_hinge_refine_t *const r = &self->refine;
    const double along = (double)r->along[axis];
    const double across = (double)r->across;
    /* Eigenvalues of the 2 x 2 block by trace and determinant. */
    const double half_trace = 0.5 * (c[0] + c[2]);
    const double root = sqrt(fmax((half_trace * half_trace) - ((c[0] * c[2]) - (c[1] * c[1])), 0.0));
    const double bound = fmin(sqrt((3.84 * (half_trace + root)) + (2.15 * (half_trace - root))), 1.57079633);
    /* The model is linear where a tilt changes the rate across the axis by less than a fifth. */
    const double reach = 0.2 * sqrt(across / along);
    /* Nearly planar motion needs ten blocks that tell of this axis. */
    const double blocks =
        fmax((double)r->told[axis] * (double)r->told[axis] / fmax((double)r->told2[axis], 1e-20), 1.0);
    const double few = 1.0 + (10.0 / blocks / (1.0 + (100.0 * across / along)));
    /* And only what has turned about its axis says anything: 0.03 rad^2/s in readings of 0.05 s. */
    const double assumed = (double)self->cfg.gyr_noise_rad_s;
    const bool turned = along * assumed * assumed * 0.05 > 0.03;
    return turned ? fmin(few * bound * fmax(1.0, bound / reach), 1.57079633) : 1.57079633;
}

/// 95 % bounds of both axes, rad, and the largest inflation.
/* The formula from top to bottom. NOLINTNEXTLINE(readability-function-size) */
static inline void bounds_in_double(const jcal_hinge_t *self, double out[2], double *largest)
{
    const jcal_hinge_refine_t *const r = &self->refine;
    const double cost = (double)r->cost;
    const double noise = fmax(cost / (2.0 * (double)r->time_s / 0.05), 0.01);
    const double counted = (double)r->information * (double)r->information / (double)r->information2;
    const double blocks = fmin(counted, 2.0 * (double)r->blocks);
    double scatter[4][4];
    dunpack(r->scatter, 4, &scatter[0][0]);
    double met = 0.0;
    for (size_t i = 0; i < 4; ++i) {
        met += 0.25 * scatter[i][i] / (double)r->matrix[jcal_sym_at(i, i)];
    }
    /* All of the information, and what is believed of it. */
    jcal_hinge_lin_t acc;
    jcal_hinge_linearise_acc(&self->coarse.moments, &self->cfg, &r->point, &acc);
    const double acc_cost = (double)acc.cost_acc;
    const double trust = 1.0 / (1.0 + (0.1 * acc_cost));
    double all[4][4];
    double sure[4][4];
    double of_acc[16];
    double vectors[4][4];
    dunpack(acc.matrix, 4, of_acc);
    dinformation(r, dblend(met, noise, blocks), all);
    for (int i = 0; i < 16; ++i) {
        const bool diagonal = (i % 5) == 0;
        sure[i / 4][i % 4] =
            all[i / 4][i % 4] + (trust * of_acc[i]) - (diagonal ? ((0.5 * cost) + (trust * acc_cost)) : 0.0);
        all[i / 4][i % 4] += of_acc[i];
    }
    djacobi(sure, vectors);
    /* Variance along each eigenvector, summed up per axis. */
    const double pull = 10.0 + (6000.0 * noise / fmax((double)r->blocks, 1.0));
    const double mismatch = (double)self->cfg.rate_mismatch;
    /* Of the residual beyond 5 mrad/s a share acts alike: 30 times its share of the rate along the axis, at most 1.1; as a variance.
       All of it where blocks scatter four times as much as independent readings, none where they scatter no more than those; six
       blocks' weight for three times as much. */
    const double quiet = 0.005 / (double)self->cfg.gyr_noise_rad_s;
    const double beside = (((met / noise) * blocks) + (3.0 * 6.0)) / (blocks + 6.0);
    const double follows = fmin(fmax((beside - 1.0) / 3.0, 0.0), 1.0);
    const double left = follows * follows * fmax(cost - (quiet * quiet * (double)r->time_s / 0.05), 0.0);
    /* What a scale or a lag explains, but for a share by chance. */
    const double scale = fmax(fabs((double)r->alike.scale) - (cost / 2.0), 0.0);
    const double lag = (double)r->alike.lag;
    const double of_both = fmin((scale * scale / (double)r->across) + (lag * lag / (double)r->alike.change), cost);
    const double explained = fmax(of_both - (0.3 * cost / blocks), 0.0);
    const double rates = (double)r->along[0] + (double)r->along[1] + (2.0 * (double)r->across);
    double covariance[2][3] = {{0.0}};
    *largest = 0.0;
    for (int k = 0; k < 4; ++k) {
        double v[4];
        double systematic = 0.0;
        for (int i = 0; i < 4; ++i) {
            v[i] = vectors[i][k];
            const double along = (double)r->along[i / 2];
            const double alike = fmin(30.0 * sqrt(left / along), 1.1);
            systematic += v[i] * v[i] * ((0.69 * mismatch * mismatch * rates) + explained + (alike * alike * left)) /
                          (3.84 + 2.15);
        }
        const double ratio = dquadratic(scatter, v) / dquadratic(all, v);
        const double inflation = dblend(fmax(ratio, 0.25 * noise), noise, blocks);
        const double pulled = pull * 0.05 / sure[k][k];
        const bool open = !(sure[k][k] > 1.0);
        const double variance = open ? 10.0 : (((inflation + systematic) / sure[k][k]) + (pulled * pulled));
        *largest = fmax(*largest, inflation);
        for (int axis = 0; axis < 2; ++axis) {
            covariance[axis][0] += variance * v[2 * axis] * v[2 * axis];
            covariance[axis][1] += variance * v[2 * axis] * v[(2 * axis) + 1];
            covariance[axis][2] += variance * v[(2 * axis) + 1] * v[(2 * axis) + 1];
        }
    }
    for (int axis = 0; axis < 2; ++axis) {
        out[axis] = dbound(self, axis, covariance[axis]);
    }
}

#endif /* HINGE_BOUNDS_DOUBLE_H */
