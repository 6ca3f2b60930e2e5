/* SPDX-License-Identifier: MIT */
/// @file
/// The equations of lib/hinge/refine.h in double precision: residuals of a block as a function of tilts and
/// biases, derivatives by central differences.
#ifndef HINGE_REFINE_DOUBLE_H
#define HINGE_REFINE_DOUBLE_H

#include "unit/hinge/double.h"

#include "hinge/refine.h"

#include <complex.h>
#include <string.h>

enum { BLOCK_MAX = 128, UNKNOWNS = 8, COLUMNS = 9 };

/* Step of the central differences: third-order terms and rounding are both below 1e-9 of the derivative. */
#define DIFFERENCE 1e-4

/// Samples of one block with what weighs them, and where they are looked at from.
typedef struct {
    double w[BLOCK_MAX][2][3];
    double a[BLOCK_MAX][2][3];
    double dt_s[BLOCK_MAX];
    double acc_weight[BLOCK_MAX];
    int count;
    double j[2][3], u[2][3], v[2][3];
    double bias[4];  ///< In standard deviations, along u1, v1, u2, v2.
    double noise_rad_s, bias_rad_s;
} dblock_t;

/// What a block looks like with all its unknowns moved.
typedef struct {
    double complex z[2][BLOCK_MAX];
    double theta[BLOCK_MAX];  ///< From the first sample of the block on.
} dseen_t;

/// i y.
static inline double complex dimaginary(double y)
{
    return (double complex)I * y;
}

/// exp(i angle).
static inline double complex dturn(double angle)
{
    return cexp(dimaginary(angle));
}

static inline void dcross(const double *a, const double *b, double *out)
{
    out[0] = (a[1] * b[2]) - (a[2] * b[1]);
    out[1] = (a[2] * b[0]) - (a[0] * b[2]);
    out[2] = (a[0] * b[1]) - (a[1] * b[0]);
}

static inline void dnormalise(double v[3])
{
    const double length = sqrt(ddot(v, v));
    for (int i = 0; i < 3; ++i) {
        v[i] /= length;
    }
}

/// Looks at the following samples from an engine's present axes and biases.
static inline void dblock_begin(dblock_t *block, const jcal_hinge_t *engine)
{
    const jcal_hinge_point_t *const p = &engine->refine.point;
    block->count = 0;
    for (int s = 0; s < 2; ++s) {
        dset((s == 0) ? p->axis1.j : p->axis2.j, block->j[s]);
        dset((s == 0) ? p->axis1.u : p->axis2.u, block->u[s]);
        dcross(block->j[s], block->u[s], block->v[s]);
    }
    for (int i = 0; i < 4; ++i) {
        block->bias[i] = (double)engine->refine.bias[i];
    }
    block->noise_rad_s = (double)engine->cfg.gyr_noise_rad_s;
    block->bias_rad_s = (double)engine->cfg.gyr_bias_rad_s;
}

static inline void dblock_add(dblock_t *block, const jcal_hinge_sample_t *sample)
{
    const int k = block->count++;
    dset(sample->w1, block->w[k][0]);
    dset(sample->w2, block->w[k][1]);
    dset(sample->a1, block->a[k][0]);
    dset(sample->a2, block->a[k][1]);
    block->dt_s[k] = (double)sample->dt_s;
    block->acc_weight[k] = (double)sample->acc_weight;
}

/// Weight of sample k: readings of 0.05 s each, at the assumed noise.
static inline double dweight(const dblock_t *block, int k)
{
    return block->dt_s[k] / (0.05 * block->noise_rad_s * block->noise_rad_s);
}

/// Axis s tilted by x along u and v. The tangent directions are carried along.
/* One comparison, step by step. NOLINTNEXTLINE(readability-function-size) */
static inline void dtilted(const dblock_t *block, int s, const double *x, double j[3], double u[3], double v[3])
{
    for (int i = 0; i < 3; ++i) {
        j[i] = block->j[s][i] + (x[0] * block->u[s][i]) + (x[1] * block->v[s][i]);
    }
    dnormalise(j);
    const double along = ddot(j, block->u[s]);
    for (int i = 0; i < 3; ++i) {
        u[i] = block->u[s][i] - (along * j[i]);
    }
    dnormalise(u);
    dcross(j, u, v);
}

/// z and theta of all samples with the 8 unknowns moved by x. `turned`: axis 2 is the other way round, its u the same.
static inline void dlook(const dblock_t *block, const double x[UNKNOWNS], bool turned, dseen_t *out)
{
    double along[2][BLOCK_MAX];
    for (int s = 0; s < 2; ++s) {
        double j[3];
        double u[3];
        double v[3];
        dtilted(block, s, &x[2 * s], j, u, v);
        const double sign = (turned && (s == 1)) ? -1.0 : 1.0;
        for (int k = 0; k < block->count; ++k) {
            double w[3];
            for (int i = 0; i < 3; ++i) {
                /* A bias is a vector of its sensor: it does not tilt with the axis. */
                w[i] = block->w[k][s][i] -
                       (block->bias_rad_s * (((block->bias[2 * s] + x[4 + (2 * s)]) * block->u[s][i]) +
                                             ((block->bias[(2 * s) + 1] + x[5 + (2 * s)]) * block->v[s][i])));
            }
            out->z[s][k] = ddot(w, u) + dimaginary(sign * ddot(w, v));
            along[s][k] = sign * ddot(w, j);
        }
    }
    out->theta[0] = 0.0;
    for (int k = 1; k < block->count; ++k) {
        const double now = along[1][k] - along[0][k];
        const double before = along[1][k - 1] - along[0][k - 1];
        out->theta[k] = out->theta[k - 1] + (0.5 * block->dt_s[k] * (now + before));
    }
}

/// Sum of conj(exp(-i theta) z1) z2: its direction is the best phase, its length what the phase can explain.
static inline double complex dmatch(const dblock_t *block, const dseen_t *seen)
{
    double complex sum = 0.0;
    for (int k = 0; k < block->count; ++k) {
        sum += dweight(block, k) * conj(dturn(-seen->theta[k]) * seen->z[0][k]) * seen->z[1][k];
    }
    return sum;
}

static inline double dpower(const dblock_t *block, const dseen_t *seen)
{
    double sum = 0.0;
    for (int k = 0; k < block->count; ++k) {
        const double z1 = cabs(seen->z[0][k]);
        const double z2 = cabs(seen->z[1][k]);
        sum += dweight(block, k) * ((z1 * z1) + (z2 * z2));
    }
    return sum;
}

/// Cost of a block with its best phase.
static inline double dcost(const dblock_t *block, const double x[UNKNOWNS], bool turned)
{
    dseen_t seen;
    dlook(block, x, turned, &seen);
    return dpower(block, &seen) - (2.0 * cabs(dmatch(block, &seen)));
}

static inline double complex dbest_phase(const dblock_t *block, const double x[UNKNOWNS])
{
    dseen_t seen;
    dlook(block, x, false, &seen);
    const double complex match = dmatch(block, &seen);
    return match / cabs(match);
}

/// Weighted residuals at a phase.
static inline void dresiduals(const dblock_t *block, const double x[UNKNOWNS], double complex phase,
                              double complex r[BLOCK_MAX])
{
    dseen_t seen;
    dlook(block, x, false, &seen);
    for (int k = 0; k < block->count; ++k) {
        r[k] = sqrt(dweight(block, k)) * ((phase * dturn(-seen.theta[k]) * seen.z[0][k]) - seen.z[1][k]);
    }
}

/// Residuals (element 0) and their derivatives. `phase` 0: each with its own best phase.
typedef struct {
    double complex r[BLOCK_MAX];
    double complex by[COLUMNS][BLOCK_MAX];  ///< By the 8 unknowns and, at a given phase, by that.
} dslopes_t;

static inline void dslopes(const dblock_t *block, double complex phase, dslopes_t *out)
{
    const bool best = cabs(phase) == 0.0;
    const double zero[UNKNOWNS] = {0.0};
    dresiduals(block, zero, best ? dbest_phase(block, zero) : phase, out->r);
    for (int i = 0; i < COLUMNS; ++i) {
        double complex end[2][BLOCK_MAX];
        for (int side = 0; side < 2; ++side) {
            double x[COLUMNS] = {0.0};
            x[i] = (side == 0) ? -DIFFERENCE : DIFFERENCE;
            const double complex at = best ? dbest_phase(block, x) : (phase * dturn(x[COLUMNS - 1]));
            dresiduals(block, x, at, end[side]);
        }
        for (int k = 0; k < block->count; ++k) {
            out->by[i][k] = (end[1][k] - end[0][k]) / (2.0 * DIFFERENCE);
        }
    }
}

/// Real part of the sum of conj(a) b.
static inline double dinner(const double complex *a, const double complex *b, int count)
{
    double sum = 0.0;
    for (int k = 0; k < count; ++k) {
        sum += creal(conj(a[k]) * b[k]);
    }
    return sum;
}

static inline double dlength(const double complex *a, int count)
{
    return sqrt(dinner(a, a, count));
}

/// Removes unknown p of n from matrix (row-major) and gradient by elimination.
static inline void deliminate(double *matrix, double *gradient, int n, int p)
{
    const double pivot = matrix[(p * n) + p];
    double column[COLUMNS];
    for (int i = 0; i < n; ++i) {
        column[i] = matrix[(i * n) + p];
    }
    const double of_p = gradient[p];
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            matrix[(i * n) + k] -= column[i] * column[k] / pivot;
        }
        gradient[i] -= column[i] * of_p / pivot;
    }
}

/// Sums that a block with this phase at its first sample adds, its phase eliminated with a prior of half a reading.
static inline void dsums(const dblock_t *block, double complex phase, double matrix[64], double gradient[8])
{
    static dslopes_t slopes;
    dslopes(block, phase, &slopes);
    double m[COLUMNS * COLUMNS];
    double g[COLUMNS];
    double units = 0.0;
    for (int k = 0; k < block->count; ++k) {
        units += block->dt_s[k] / 0.05;
    }
    for (int i = 0; i < COLUMNS; ++i) {
        for (int k = 0; k < COLUMNS; ++k) {
            m[(i * COLUMNS) + k] = dinner(slopes.by[i], slopes.by[k], block->count);
        }
        g[i] = dinner(slopes.by[i], slopes.r, block->count);
    }
    m[(COLUMNS * COLUMNS) - 1] += 0.5 * units;
    deliminate(m, g, COLUMNS, COLUMNS - 1);
    for (int i = 0; i < UNKNOWNS; ++i) {
        for (int k = 0; k < UNKNOWNS; ++k) {
            matrix[(i * UNKNOWNS) + k] = m[(i * COLUMNS) + k];
        }
        gradient[i] = g[i];
    }
}

/// Half the gradient of the accelerometer part of the cost by the 4 tilts.
static inline void dacc_score(const dblock_t *block, double constant, double out[4])
{
    for (int i = 0; i < 4; ++i) {
        double cost[2] = {0.0, 0.0};
        for (int side = 0; side < 2; ++side) {
            double x[4] = {0.0};
            x[i] = (side == 0) ? -DIFFERENCE : DIFFERENCE;
            double j[2][3];
            double u[3];
            double v[3];
            dtilted(block, 0, &x[0], j[0], u, v);
            dtilted(block, 1, &x[2], j[1], u, v);
            for (int k = 0; k < block->count; ++k) {
                const double e = ddot(j[0], block->a[k][0]) - ddot(j[1], block->a[k][1]) - constant;
                cost[side] += block->acc_weight[k] * e * e;
            }
        }
        out[i] = (cost[1] - cost[0]) / (4.0 * DIFFERENCE);
    }
}

#endif /* HINGE_REFINE_DOUBLE_H */
