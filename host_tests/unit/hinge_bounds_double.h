/* SPDX-License-Identifier: MIT */
/// @file
/// The bounds of docs/METHOD.md section 5 in double precision: powers summed sample by sample, information by
/// elimination instead of factors and eigenvectors.
#ifndef HINGE_BOUNDS_DOUBLE_H
#define HINGE_BOUNDS_DOUBLE_H

#include "hinge_double.h"

/// Weighted sums over samples; index 0 is sensor 1.
typedef struct {
    double along2[2];  ///< (w . j)^2
    double all2[2];    ///< |w|^2
    double along4[2];  ///< (w . j)^4
    double mixed[2];   ///< |w x j|^2 |w|^2
    double product;    ///< (w1 . j1)^2 (w2 . j2)^2
} power_sums_t;

static inline void add_powers(const dsample_t *s, const jcal_hinge_point_t *point, power_sums_t *p)
{
    const dpoint_t at = dpoint(point);
    const double zero[3] = {0.0, 0.0, 0.0};
    double along2[2];
    for (int i = 0; i < 2; ++i) {
        const double along = ddot(s->w[i], at.j[i]);
        const double all2 = ddot(s->w[i], s->w[i]);
        along2[i] = along * along;
        p->along2[i] += s->gyr_weight * along2[i];
        p->all2[i] += s->gyr_weight * all2;
        p->along4[i] += s->gyr_weight * along2[i] * along2[i];
        p->mixed[i] += s->gyr_weight * dacross2(s->w[i], zero, at.j[i]) * all2;
    }
    p->product += s->gyr_weight * along2[0] * along2[1];
}

/// Inverse (n x n, in place) by Gauss and Jordan; positive definite matrices need no pivoting.
static inline void invert(double *m, int n)
{
    for (int p = 0; p < n; ++p) {
        const double pivot = m[(p * n) + p];
        m[(p * n) + p] = 1.0;
        for (int c = 0; c < n; ++c) {
            m[(p * n) + c] /= pivot;
        }
        for (int r = 0; r < n; ++r) {
            const double factor = m[(r * n) + p];
            if (r != p) {
                m[(r * n) + p] = 0.0;
                for (int c = 0; c < n; ++c) {
                    m[(r * n) + c] -= factor * m[(p * n) + c];
                }
            }
        }
    }
}

/// Mean square of the noise across one direction, from what is left of |q1| - |q2|.
static inline double noise_in_double(const jcal_hinge_evidence_t *e)
{
    const double mean = (double)e->noise_sum / (double)e->noise_weight;
    const double across = (double)e->across_rate2 / (double)e->fit_time_s;
    return 1.15 * mean * (0.5 + (1.6 * fmin(mean / across, 0.6)));
}

/// Information of the axes (4 x 4): noise power taken off, accelerometer discounted, biases eliminated with their prior
/// counted `prior` times. gain (4 x 4) is what a unit of an axis moves the biases by.
static inline void information_in_double(const jcal_hinge_lin_t *lin, const double pretended[2], const double prior[2],
                                         double s[16], double gain[16])
{
    const double trust = 1.0 / (1.0 + (0.1 * (double)lin->cost_acc));
    double b[16];
    for (size_t i = 0; i < 16; ++i) {
        b[i] = (double)lin->matrix[jcal_sym_at(4u + (i / 4u), 4u + (i % 4u))];
        b[i] += ((i / 4u) == (i % 4u)) ? (prior[i / 8u] - 1.0) : 0.0;
    }
    invert(b, 4);
    for (size_t r = 0; r < 4; ++r) {
        for (size_t c = 0; c < 4; ++c) {
            gain[(4u * r) + c] = 0.0;
            for (size_t k = 0; k < 4; ++k) {
                gain[(4u * r) + c] += b[(4u * r) + k] * (double)lin->matrix[jcal_sym_at(4u + k, c)];
            }
        }
    }
    for (size_t r = 0; r < 4; ++r) {
        for (size_t c = 0; c < 4; ++c) {
            double sum = (double)lin->matrix[jcal_sym_at(r, c)];
            sum -= (1.0 - trust) * (double)lin->matrix_acc[jcal_sym_at(r, c)];
            sum -= (r == c) ? pretended[r / 2u] : 0.0;
            for (size_t k = 0; k < 4; ++k) {
                sum -= (double)lin->matrix[jcal_sym_at(4u + k, r)] * gain[(4u * k) + c];
            }
            s[(4u * r) + c] = sum;
        }
    }
}

/// Half the trace of (information of one axis)^-1 times the scatter of its score, the own biases eliminated from both
/// and without their prior.
static inline double ratio_in_double(const jcal_hinge_lin_t *lin, const float *scatter, size_t axis,
                                     const double gain[16])
{
    const size_t first = 2u * axis;
    const size_t own[4] = {first, first + 1u, 4u + first, 5u + first};
    double block[4];
    double reduced[4];
    for (size_t i = 0; i < 4; ++i) {
        /* Rows (e_r, -gain of own biases): the score of the axis minus what the biases explain of it. */
        double rows[2][4] = {{0.0}};
        const size_t unknown[2] = {i / 2u, i % 2u};
        for (size_t k = 0; k < 2; ++k) {
            rows[k][unknown[k]] = 1.0;
            rows[k][2] = -gain[(4u * first) + first + unknown[k]];
            rows[k][3] = -gain[(4u * (first + 1u)) + first + unknown[k]];
        }
        reduced[i] = 0.0;
        block[i] = 0.0;
        for (size_t k = 0; k < 16; ++k) {
            const double both = rows[0][k / 4u] * rows[1][k % 4u];
            const double prior = ((k / 4u == k % 4u) && (k / 4u >= 2u)) ? 1.0 : 0.0;
            reduced[i] += both * (double)scatter[jcal_sym_at(k / 4u, k % 4u)];
            block[i] += both * ((double)lin->matrix[jcal_sym_at(own[k / 4u], own[k % 4u])] - prior);
        }
    }
    invert(block, 2);
    return 0.5 *
           ((block[0] * reduced[0]) + (block[1] * reduced[2]) + (block[2] * reduced[1]) + (block[3] * reduced[3]));
}

static inline double blend_in_double(double coarse, double fine, double blocks)
{
    const double mean = ((coarse * blocks) + (1.5 * fine * 6.0)) / (blocks + 6.0);
    return fmax(mean * (1.0 + (4.0 / blocks)), fine);
}

/// Squared bound by the second order.
static inline double second_in_double(const power_sums_t *p, size_t axis, double noise, double scatter)
{
    const size_t other = 1u - axis;
    const double left = p->along4[axis] - (p->product * p->product / p->along4[other]) -
                        (2.0 * 4.0 * noise * (p->along2[0] + p->along2[1]));
    const double unequal = noise * p->along2[axis];
    if (!(left > 0.0)) {
        return 10.0;
    }
    return sqrt(((4.0 * scatter) + (unequal * unequal)) / p->along4[axis] / left);
}

/// How much more than independent residuals the score of an axis scatters.
static inline double inflation_in_double(const jcal_hinge_scatter_t *e, const jcal_hinge_lin_t *lin, size_t axis,
                                         const double gain[16], double *second)
{
    const double closed = (double)e->information - (double)e->coarse_information;
    const double blocks = closed * closed / (double)e->information2;
    const double scale = (double)e->information_all / (double)e->information;
    *second = scale * blend_in_double((double)e->second, (double)e->fine_second, blocks);
    return blend_in_double(scale * ratio_in_double(lin, e->scatter, axis, gain),
                           scale * ratio_in_double(lin, e->fine_scatter, axis, gain), blocks);
}

/// 95 % bounds of both axes, rad, for information without an open direction.
static inline void bounds_in_double(const jcal_hinge_t *self, const jcal_hinge_lin_t *lin, const power_sums_t *p,
                                    double out[2])
{
    const double noise = noise_in_double(&self->evidence);
    const double mismatch = (double)self->cfg.rate_mismatch;
    const double floor = 4.0 * mismatch * mismatch * (p->mixed[0] + p->mixed[1]) / (3.84 + 2.15);
    const double of_acc = (double)lin->cost_acc / (1.0 + (0.1 * (double)lin->cost_acc));
    const double pretended[2] = {(4.0 * noise * p->along2[0]) + of_acc, (4.0 * noise * p->along2[1]) + of_acc};
    const double once[2] = {1.0, 1.0};
    double s[16];
    double gain[16];
    double second[2];
    information_in_double(lin, pretended, once, s, gain);
    const double inflation[2] = {inflation_in_double(&self->evidence.axis1, lin, 0, gain, &second[0]),
                                 inflation_in_double(&self->evidence.axis2, lin, 1, gain, &second[1])};
    information_in_double(lin, pretended, inflation, s, gain);
    invert(s, 4);
    for (size_t axis = 0; axis < 2; ++axis) {
        const double *const c = &s[(4u * 2u * axis) + (2u * axis)]; /* own 2 x 2 block, rows 4 apart */
        const double mean = 0.5 * (c[0] + c[5]);
        const double half = sqrt((0.25 * (c[0] - c[5]) * (c[0] - c[5])) + (c[1] * c[1]));
        const double first = (inflation[axis] + floor) * ((3.84 * (mean + half)) + (2.15 * (mean - half)));
        const double by_second = second_in_double(p, axis, noise, second[axis]);
        const bool holds = first * p->along2[axis] < 0.16 * (p->all2[axis] - p->along2[axis]);
        out[axis] =
            sqrt(holds ? fmin(first, by_second) : fmax(first, by_second)) + (1.5 * (double)self->moved_rad[axis]);
    }
}

#endif /* HINGE_BOUNDS_DOUBLE_H */
