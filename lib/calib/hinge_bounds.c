/* SPDX-License-Identifier: MIT */
/// @file
/// 95 % bounds of the two axes. See hinge_bounds.h.
#include "calib/hinge_bounds.h"

#include "calib/hinge_point.h"
#include "math/chol.h"
#include "math/eig.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <math.h>
#include <string.h>

#define AXIS 4u /* unknowns of both axes, and of both biases */

/// Finished blocks below which nothing is said, and the weight in blocks of what is assumed before they are many.
#define BLOCKS_MIN 3.0f
#define PRIOR_BLOCKS 6.0f
/// Assumed ratio of the scatter over coarse blocks to that over fine ones: residuals are similar over some fine blocks.
#define PRIOR_CORRELATION 1.5f
/// Small-sample factor 1 + this / blocks.
#define SMALL_SAMPLE 4.0f

/// Noise power per direction across the axis is the mean of (|q1| - |q2|)^2 times a factor between 1/2, where the
/// rates q across the axis are large, and 1 / 0.86, where they are nothing but noise (there the mean square of q is
/// 2.3 times that mean); the line between, with a margin.
#define NOISE_MARGIN 1.15f
#define NOISE_FREE 0.5f
#define NOISE_SLOPE 1.6f
#define NOISE_RATIO_MAX 0.6f

/// Share of the power of the accelerometer residual that may act alike in every sample.
#define ACC_SYSTEMATIC 0.1f

/// 95 % points: of a squared normal variable, and what a second one of the same size adds to that.
#define ONE_DIRECTION 3.84f
#define SECOND_DIRECTION 2.15f
/// Twice the standard deviation, squared.
#define TWO_SIGMA2 4.0f

/// Share of the rate across the axis that a tilt within the bound may make up for the first order to hold.
#define LINEAR_SHARE 0.4f

/// Gauss-Newton steps of the last length that may lie between the estimate and its minimum: the sum of a series of
/// steps that shrink by a third each, as they do where the cost is of fourth order.
#define STEPS_LEFT 1.5f

/// Information below which a direction is open. The cost is in units of independent readings: 1 is one reading at 1
/// rad.
#define OPEN_INFORMATION 1.0f
/// Squared bound of an open direction, rad^2: more than any angle.
#define OPEN_BOUND2 10.0f

/// Coefficients of (w . j)^2 in the features that begin at `first`.
static void along_coefficients(jcal_vec3_t j, unsigned first, float f[JCAL_HINGE_FEATURES])
{
    for (unsigned i = 0u; i < JCAL_HINGE_FEATURES; ++i) {
        f[i] = 0.0f;
    }
    f[first] = j.x * j.x;
    f[first + 1u] = j.y * j.y;
    f[first + 2u] = j.z * j.z;
    f[first + 3u] = 2.0f * j.x * j.y;
    f[first + 4u] = 2.0f * j.x * j.z;
    f[first + 5u] = 2.0f * j.y * j.z;
}

/// Sums of one sensor that the bounds need: of (w . j)^2, of |w|^2, of (w . j)^4, and of |w x j|^2 |w|^2.
typedef struct {
    float along2;
    float all2;
    float along4;
    float mixed;
} power_t;

static power_t powers(const jcal_hinge_moments_t *moments, jcal_vec3_t j, unsigned first)
{
    float along[JCAL_HINGE_FEATURES];
    float all[JCAL_HINGE_FEATURES] = {0.0f};
    float across[JCAL_HINGE_FEATURES];
    along_coefficients(j, first, along);
    power_t power = {0.0f, 0.0f, 0.0f, 0.0f};
    for (unsigned i = first; i < (first + 3u); ++i) {
        all[i] = 1.0f;
    }
    for (unsigned i = 0u; i < JCAL_HINGE_FEATURES; ++i) {
        across[i] = all[i] - along[i];
        const float sum = moments->gyr[jcal_sym_at(JCAL_HINGE_Z_ONE, i)];
        power.along2 += along[i] * sum;
        power.all2 += all[i] * sum;
    }
    power.along4 = jcal_sym_quadratic(moments->gyr, JCAL_HINGE_FEATURES, along);
    power.mixed = jcal_sym_bilinear(moments->gyr, JCAL_HINGE_FEATURES, across, all);
    return power;
}

/// Power of the noise per direction across the axis, (rad/s)^2.
static float noise_power(const jcal_hinge_evidence_t *evidence)
{
    const float mean = evidence->noise_sum / jcal_max(evidence->noise_weight, 1e-12f);
    const float across = evidence->across_rate2 / jcal_max(evidence->fit_time_s, 1e-9f);
    const float ratio = jcal_min(mean / jcal_max(across, 1e-9f), NOISE_RATIO_MAX);
    return NOISE_MARGIN * mean * (NOISE_FREE + (NOISE_SLOPE * ratio));
}

/// Share of the accelerometer's information that counts. What remains of (25) is mostly the neglected right-hand side
/// of (17), which follows the motion, so it does not average out: the information is limited to what a fixed number
/// of residuals of that size would leave.
static float acc_trust(const jcal_hinge_lin_t *lin)
{
    return 1.0f / (1.0f + (ACC_SYSTEMATIC * lin->cost_acc));
}

/// What keeps information from being taken at its word, per sensor.
typedef struct {
    float pretended[2];  ///< Information that noise in the regressors makes up.
    float prior[2];      ///< Weight of the prior of the biases.
} doubts_t;

/// Information about the axes with the biases eliminated, S = A - C' B^-1 C (4 x 4); `gain` is B^-1 C, column by
/// column.
///
/// Noise in the regressors pretends information: the gradient -2 (w . j) q holds q's own noise. It is taken off
/// before anything is concluded (4 noise sum (w . j)^2 for the rates, the residual power for the specific forces),
/// else a stiff joint looks better known the longer it is watched.
///
/// `prior` weighs the prior of each sensor's biases. S is in units of the assumed residuals; where the real ones scatter
/// `inflation` times as much in power, all but the prior shrinks by that, so the prior enters `inflation` times.
static bool information(const jcal_hinge_lin_t *lin, const doubts_t *doubts, float s[10], float gain[AXIS][AXIS])
{
    float b[10];
    for (unsigned i = 0u; i < AXIS; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            b[jcal_sym_at(i, k)] = lin->matrix[jcal_sym_at(AXIS + i, AXIS + k)];
        }
        b[jcal_sym_at(i, i)] += doubts->prior[i / 2u] - 1.0f;
    }
    if (jcal_chol_factor(b, AXIS, b, NULL) != JCAL_OK) {
        return false;
    }
    for (unsigned k = 0u; k < AXIS; ++k) {
        float column[AXIS];
        for (unsigned i = 0u; i < AXIS; ++i) {
            column[i] = lin->matrix[jcal_sym_at(AXIS + i, k)];
        }
        jcal_chol_solve(b, AXIS, column, gain[k]);
    }
    const float doubt = 1.0f - acc_trust(lin);
    for (unsigned i = 0u; i < AXIS; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            float sum = lin->matrix[jcal_sym_at(i, k)] - ((i == k) ? doubts->pretended[i / 2u] : 0.0f);
            sum -= lin->matrix_acc[jcal_sym_at(i, k)] * doubt;
            for (unsigned m = 0u; m < AXIS; ++m) {
                sum -= lin->matrix[jcal_sym_at(AXIS + m, i)] * gain[k][m];
            }
            s[jcal_sym_at(i, k)] = sum;
        }
    }
    return true;
}

/// Half the trace of (information of one axis)^-1 times the scatter of its score, the own biases eliminated from both; 1 for
/// independent residuals of the assumed size. The prior of the biases scatters nothing and is left out.
static float scatter_ratio(const jcal_hinge_lin_t *lin, const float *scatter, unsigned axis, float gain[AXIS][AXIS])
{
    const unsigned r = 2u * axis;
    const unsigned own[AXIS] = {r, r + 1u, AXIS + r, AXIS + r + 1u};
    float block[10];
    float rows[2][AXIS];
    for (unsigned i = 0u; i < AXIS; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            block[jcal_sym_at(i, k)] = lin->matrix[jcal_sym_at(own[i], own[k])];
        }
        block[jcal_sym_at(i, i)] -= (i < 2u) ? 0.0f : 1.0f;
    }
    for (unsigned i = 0u; i < 2u; ++i) {
        rows[i][0] = (i == 0u) ? 1.0f : 0.0f;
        rows[i][1] = (i == 1u) ? 1.0f : 0.0f;
        rows[i][2] = -gain[r + i][r];
        rows[i][3] = -gain[r + i][r + 1u];
    }
    const float g00 = jcal_sym_bilinear(scatter, AXIS, rows[0], rows[0]);
    const float g01 = jcal_sym_bilinear(scatter, AXIS, rows[0], rows[1]);
    const float g11 = jcal_sym_bilinear(scatter, AXIS, rows[1], rows[1]);
    const float a = jcal_sym_bilinear(block, AXIS, rows[0], rows[0]);
    const float b = jcal_sym_bilinear(block, AXIS, rows[0], rows[1]);
    const float d = jcal_sym_bilinear(block, AXIS, rows[1], rows[1]);
    const float determinant = jcal_max((a * d) - (b * b), (1e-6f * a * d) + 1e-20f);
    return 0.5f * ((d * g00) - (2.0f * b * g01) + (a * g11)) / determinant;
}

/// Squared bound from both orders. The first order holds as long as a tilt by the bound changes the rate across the
/// axis by less than a share of what it is; beyond that its gradient turns round, and the worse of both counts.
static float combine(float first_order, float second_order, const power_t *own)
{
    const float across2 = own->all2 - own->along2;
    const bool first_holds = first_order * own->along2 < (LINEAR_SHARE * LINEAR_SHARE * across2);
    return first_holds ? jcal_min(first_order, second_order) : jcal_max(first_order, second_order);
}

/// Finished coarse blocks, each counted by its share of the information: (sum I)^2 / sum I^2.
static float block_count(const jcal_hinge_scatter_t *scatter)
{
    const float closed = scatter->information - scatter->coarse_information;
    return (closed * closed) / jcal_max(scatter->information2, 1e-20f);
}

/// Mean of what coarse blocks say and of what fine ones let expect, with the small-sample factor; never below the
/// fine ones.
static float blend(float coarse, float fine, float blocks)
{
    const float mean = ((coarse * blocks) + (PRIOR_CORRELATION * fine * PRIOR_BLOCKS)) / (blocks + PRIOR_BLOCKS);
    return jcal_max(mean * (1.0f + (SMALL_SAMPLE / blocks)), fine);
}

/// Squared 95 % radius of one axis from the eigenvalues and eigenvectors of the information.
static float linear_bound2(const float values[AXIS], const float vectors[AXIS * AXIS], unsigned axis, float inflation)
{
    float a = 0.0f;
    float b = 0.0f;
    float d = 0.0f;
    for (unsigned k = 0u; k < AXIS; ++k) {
        const float *const v = &vectors[(AXIS * k) + (2u * axis)];
        const float variance = (values[k] > OPEN_INFORMATION) ? (inflation / values[k]) : OPEN_BOUND2;
        a += variance * v[0] * v[0];
        b += variance * v[0] * v[1];
        d += variance * v[1] * v[1];
    }
    const float mean = 0.5f * (a + d);
    const float half = sqrtf((0.25f * (a - d) * (a - d)) + (b * b));
    return (ONE_DIRECTION * (mean + half)) + (SECOND_DIRECTION * jcal_max(mean - half, 0.0f));
}

/// Squared bound from the second order, for motion in the plane across the axis, where the first order says nothing.
///
/// With w along j the residual of a tilt s is (w . j)^2 s^2: s^2 is a linear unknown, known to +- 2 sigma, and
/// unequal noise powers of the two sensors pass for a tilt. Information of s1^2 is that of (w1 . j1)^2 beside (w2 .
/// j2)^2: none if the joint is stiff.
static float second_order_bound2(const power_t *own, const power_t *other, float product, float noise, float scatter)
{
    const float pretended = 2.0f * TWO_SIGMA2 * noise * (own->along2 + other->along2);
    const float left = own->along4 - ((product * product) / jcal_max(other->along4, 1e-20f)) - pretended;
    if (!(left > 0.0f) || !(own->along4 > 0.0f)) {
        return OPEN_BOUND2;
    }
    const float unequal = noise * own->along2;
    const float power = ((TWO_SIGMA2 * scatter) + (unequal * unequal)) / own->along4;
    return sqrtf(power / left);
}

/// How much more than independent residuals of the assumed size the score of an axis scatters.
static float inflation_of(const jcal_hinge_lin_t *lin, const jcal_hinge_scatter_t *scatter, unsigned axis,
                          float gain[AXIS][AXIS])
{
    const float scale = scatter->information_all / jcal_max(scatter->information, 1e-20f);
    const float coarse = scale * scatter_ratio(lin, scatter->scatter, axis, gain);
    const float fine = scale * scatter_ratio(lin, scatter->fine_scatter, axis, gain);
    return blend(coarse, fine, block_count(scatter));
}

/// The same of the second-order score, in its own units.
static float second_scatter_of(const jcal_hinge_scatter_t *scatter)
{
    const float scale = scatter->information_all / jcal_max(scatter->information, 1e-20f);
    return scale * blend(scatter->second, scatter->fine_second, block_count(scatter));
}

/// Sum of (w1 . j1)^2 (w2 . j2)^2.
static float product_of_along(const jcal_hinge_t *self)
{
    float along1[JCAL_HINGE_FEATURES];
    float along2[JCAL_HINGE_FEATURES];
    along_coefficients(self->point.axis1.j, JCAL_HINGE_Z_W1W1, along1);
    along_coefficients(self->point.axis2.j, JCAL_HINGE_Z_W2W2, along2);
    return jcal_sym_bilinear(self->moments.gyr, JCAL_HINGE_FEATURES, along1, along2);
}

bool jcal_hinge_bounds(const jcal_hinge_t *self, const jcal_hinge_lin_t *lin, jcal_hinge_bounds_t *out)
{
    const jcal_hinge_scatter_t *const scatters[2] = {&self->evidence.axis1, &self->evidence.axis2};
    if (!(block_count(scatters[0]) >= BLOCKS_MIN) || !(block_count(scatters[1]) >= BLOCKS_MIN)) {
        return false;
    }
    const power_t power[2] = {powers(&self->moments, self->point.axis1.j, JCAL_HINGE_Z_W1W1),
                              powers(&self->moments, self->point.axis2.j, JCAL_HINGE_Z_W2W2)};
    const float noise = noise_power(&self->evidence);
    const float of_acc = acc_trust(lin) * lin->cost_acc;
    doubts_t doubts = {{(4.0f * noise * power[0].along2) + of_acc, (4.0f * noise * power[1].along2) + of_acc},
                       {1.0f, 1.0f}};
    float s[10];
    float gain[AXIS][AXIS];
    float values[AXIS];
    float vectors[AXIS * AXIS];
    if (!information(lin, &doubts, s, gain)) {
        return false;
    }
    const float inflation[2] = {inflation_of(lin, scatters[0], 0u, gain), inflation_of(lin, scatters[1], 1u, gain)};
    doubts.prior[0] = inflation[0];
    doubts.prior[1] = inflation[1];
    if (!information(lin, &doubts, s, gain) || (jcal_eig_symmetric(s, AXIS, values, vectors) != JCAL_OK)) {
        return false;
    }
    /* A mismatch of the rates by a share of |w| may act alike in every sample: then it moves the estimate by about the root of
       (its power in the residual / information), by Cauchy and Schwarz. */
    const float mismatch = self->cfg.rate_mismatch;
    const float mismatch_power =
        4.0f * mismatch * mismatch * (power[0].mixed + power[1].mixed) / (ONE_DIRECTION + SECOND_DIRECTION);
    const float product = product_of_along(self);
    float bounds[2];
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        const float first_order = linear_bound2(values, vectors, axis, inflation[axis] + mismatch_power);
        const float second_order =
            second_order_bound2(&power[axis], &power[1u - axis], product, noise, second_scatter_of(scatters[axis]));
        const float around_minimum = sqrtf(combine(first_order, second_order, &power[axis]));
        bounds[axis] = jcal_min(around_minimum + (STEPS_LEFT * self->moved_rad[axis]), JCAL_BOUND_UNKNOWN_RAD);
    }
    out->inflation = jcal_max(inflation[0], inflation[1]);
    out->bound1_rad = bounds[0];
    out->bound2_rad = bounds[1];
    return true;
}
