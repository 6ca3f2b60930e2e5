/* SPDX-License-Identifier: MIT */
/// @file
/// Made-up sums of the joint centre and what follows from them, in double precision with matrices written out: nothing here shares a
/// formula with the library's packed ones.
#ifndef JCAL_TEST_CENTER_DOUBLE_H
#define JCAL_TEST_CENTER_DOUBLE_H

#include "jointcal/center.h"
#include "unit/center/motion.h"

#include <math.h>
#include <string.h>

#define DN 12

typedef struct {
    double m[DN][DN];
} double_matrix_t;

static inline double_matrix_t double_unpacked(const float *packed)
{
    double_matrix_t out;
    int k = 0;
    for (int i = 0; i < DN; ++i) {
        for (int j = 0; j <= i; ++j) {
            out.m[i][j] = (double)packed[k];
            out.m[j][i] = (double)packed[k];
            ++k;
        }
    }
    return out;
}

static inline double_matrix_t double_product(const double_matrix_t *a, const double_matrix_t *b)
{
    double_matrix_t out;
    for (int i = 0; i < DN; ++i) {
        for (int j = 0; j < DN; ++j) {
            out.m[i][j] = 0.0;
            for (int k = 0; k < DN; ++k) {
                out.m[i][j] += a->m[i][k] * b->m[k][j];
            }
        }
    }
    return out;
}

/// a b a.
static inline double_matrix_t double_sandwich(const double_matrix_t *a, const double_matrix_t *b)
{
    const double_matrix_t ab = double_product(a, b);
    return double_product(&ab, a);
}

/// By elimination; for positive definite matrices.
static inline double_matrix_t double_inverse(const double_matrix_t *of)
{
    double_matrix_t a = *of;
    double_matrix_t out;
    memset(&out, 0, sizeof out);
    for (int i = 0; i < DN; ++i) {
        out.m[i][i] = 1.0;
    }
    for (int p = 0; p < DN; ++p) {
        const double pivot = a.m[p][p];
        for (int j = 0; j < DN; ++j) {
            a.m[p][j] /= pivot;
            out.m[p][j] /= pivot;
        }
        for (int i = 0; i < DN; ++i) {
            const double times = (i == p) ? 0.0 : a.m[i][p];
            for (int j = 0; j < DN; ++j) {
                a.m[i][j] -= times * a.m[p][j];
                out.m[i][j] -= times * out.m[p][j];
            }
        }
    }
    return out;
}

/// The prior's information for lengths with the default config, in units of the sums.
static inline double_matrix_t double_prior(const jcal_center_sums_t *sums)
{
    const double excess = fmax((double)sums->cost / (double)sums->noise, 1.0);
    double_matrix_t out;
    memset(&out, 0, sizeof out);
    for (int i = 0; i < DN; ++i) {
        out.m[i][i] = excess / (0.3 * 0.3); /* 0.3 m, 0.3 m/s^2 */
    }
    return out;
}

/// The inverse of matrix and prior.
static inline double_matrix_t double_inverse_of(const jcal_center_sums_t *sums)
{
    double_matrix_t h = double_unpacked(sums->matrix);
    const double_matrix_t prior = double_prior(sums);
    for (int i = 0; i < DN; ++i) {
        h.m[i][i] += prior.m[i][i];
    }
    return double_inverse(&h);
}

/// 95 % radius in space, across a unit vector or, if it is zero, in all directions.
static inline double double_radius(double c[3][3], const double *axis)
{
    double q[3][3];
    double qc[3][3] = {{0.0}};
    double trace = 0.0;
    double squares = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            q[i][j] = ((i == j) ? 1.0 : 0.0) - axis[i] * axis[j];
        }
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            for (int k = 0; k < 3; ++k) {
                qc[i][j] += q[i][k] * c[k][j];
            }
        }
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            double element = 0.0;
            for (int k = 0; k < 3; ++k) {
                element += qc[i][k] * q[k][j];
            }
            trace += (i == j) ? element : 0.0;
            squares += element * element;
        }
    }
    return sqrt(trace + 2.0 * sqrt(2.0 * squares));
}

/// The block of one sensor, 0 or 1, times a factor.
static inline void double_block(const double_matrix_t *a, int sensor, double times, double c[3][3])
{
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            c[i][j] = times * a->m[3 * sensor + i][3 * sensor + j];
        }
    }
}

static inline void double_add_packed(float *packed, const double *v, double weight)
{
    int k = 0;
    for (int i = 0; i < DN; ++i) {
        for (int j = 0; j <= i; ++j) {
            packed[k] += (float)(weight * v[i] * v[j]);
            ++k;
        }
    }
}

/// Sums of 60 made-up rows, of which both sensors' x are known badly, the less the smaller `known` is; 20 blocks of a scatter
/// `spread` times as large as the rows let expect.
static inline jcal_center_sums_t double_sums(int seed, double known, double spread)
{
    jcal_center_sums_t sums;
    memset(&sums, 0, sizeof sums);
    sums.point.heading.re = 1.0f;
    for (uint32_t n = 0; n < 60u; ++n) {
        double row[DN];
        for (uint32_t i = 0; i < DN; ++i) {
            row[i] = ((i < 3u) ? 5.0 : ((i < 6u) ? 3.0 : 1.0)) * center_noise(n + 1000u * (uint32_t)seed, i);
        }
        row[3] = 0.6 * row[0] + known * row[3];
        double_add_packed(sums.matrix, row, 1.0);
    }
    for (uint32_t n = 0; n < 20u; ++n) {
        double block[DN];
        for (uint32_t i = 0; i < DN; ++i) {
            const uint32_t at = i * (i + 3u) / 2u;
            block[i] =
                spread * sqrt((double)sums.matrix[at] / 20.0) * center_noise(n + 1000u * (uint32_t)seed, 50u + i);
        }
        double_add_packed(sums.scatter, block, 1.0);
    }
    sums.point.place.r1 = (jcal_vec3_t){-0.1f, 0.02f, 0.05f};
    sums.point.place.r2 = (jcal_vec3_t){0.03f, 0.2f, -0.04f};
    sums.blocks = 20.0f;
    sums.time_s = 11.0f;
    sums.noise = 110.0f;
    sums.cost = 220.0f;
    sums.effect = 1e5f;
    sums.raw = 200.0f;
    sums.lagged = 50.0f;
    sums.turn1 = 30.0f;
    sums.turn2 = 40.0f;
    return sums;
}

#endif /* JCAL_TEST_CENTER_DOUBLE_H */
