/* SPDX-License-Identifier: MIT */
/// @file
/// 95 % bounds of the two axes. See hinge/bounds.h.
#include "hinge/bounds.h"

#include "hinge/model.h"
#include "hinge/refine.h"
#include "jointcal/head.h"
#include "math/chol.h"
#include "math/eig.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <math.h>

#define TILTS JCAL_HINGE_TILTS

/// Blocks below which nothing is said; and the weight in blocks of what is assumed of the scatter before they are many.
#define BLOCKS_MIN 3.5f
#define PRIOR_BLOCKS 6.0f
/// Assumed scatter of a block's score over that of independent readings: quiet sensors, and what is added where the residual is far
/// above their noise. That is not noise but soft tissue or the like, which lasts longer than a block.
#define PRIOR_QUIET 0.5f
#define PRIOR_DISTURBED 3.0f
#define DISTURBED_NOISE 20.0f
/// Least scatter, in the same measure.
#define SCATTER_MIN 0.25f

/// Information that noise in the regressors pretends, as a share of the cost: a quarter for white noise; with a margin.
#define PRETENDED_SHARE 0.5f
/// Share of the power of the accelerometer residual that may act alike in every sample.
#define ACC_SYSTEMATIC 0.1f
/// (sum |l| |w|)^2 over sum l^2 sum |w|^2, for rates l along the axis and w that change like noise does; 1 for steady ones.
#define TOGETHER 0.69f
/// Share of the residual that is taken to act alike in every sample, per share that it has of the rate along the axis, and at most.
/// The residual that a quiet gyroscope has, rad/s, is noise. Scatter of the blocks over that of independent readings, beyond 1, at
/// which all of the residual is taken to follow the motion, and the scatter that is assumed before blocks are many. docs/METHOD.md,
/// section 5, says where these are from.
#define LEFT_ALIKE 30.0f
#define LEFT_ALIKE_MAX 1.1f
#define QUIET_RAD_S 0.005f
#define FOLLOWS_SCATTER 3.0f
#define FOLLOWS_PRIOR 3.0f
/// Share of a residual that two numbers explain by chance, times the blocks: each has about six independent readings.
#define BY_CHANCE 0.3f
/// Assumed standard deviation of the place to which the refined axes are pulled, rad.
#define COARSE_RAD 0.05f
/// Share of the rate across the axis that a tilt within the bound may make up for; beyond it the phase of a block is not
/// known well enough for a linear statement.
#define LINEAR_SHARE 0.2f
/// Blocks in which nearly planar motion has found its phase, and the power along the axis over that across it at which motion is
/// half planar: with fewer, bounds are wider.
#define PLANAR_BLOCKS 10.0f
#define PLANAR_RATIO 100.0f

/// Integral of the squared rate along an axis below which its segment has not turned, rad^2/s: a third of a second at 0.3 rad/s.
#define TURNED_MIN 0.03f

/// 95 % points: of a squared normal variable, and what a second one of the same size adds to that.
#define ONE_DIRECTION 3.84f
#define SECOND_DIRECTION 2.15f

/// Information below which a direction is open. The cost is in units of independent readings: 1 is one reading at 1 rad.
#define OPEN_INFORMATION 1.0f
/// Squared bound of an open direction, rad^2: more than any angle.
#define OPEN_BOUND2 10.0f

/// Sums of the refinement with the biases eliminated, packed 4 x 4: all of it, and what may be believed.
typedef struct {
    float all[10];
    float sure[10];
} information_t;

/// A quarter of the cost is what white noise in the rates pretends to know of a tilt that moves nothing: it makes the
/// regressors of a stiff joint differ from zero. What remains of (25) is mostly the neglected right-hand side of (17), which
/// follows the motion and does not average out: its information is limited to what a fixed number of such residuals leave.
///
/// `prior` weighs the prior of the biases: where the real scatter is so many times the assumed one, the prior counts so much more
/// beside the sums.
static bool inform(const jcal_hinge_refine_t *refine, const jcal_hinge_lin_t *acc, float prior, information_t *out)
{
    const float trust = 1.0f / (1.0f + (ACC_SYSTEMATIC * acc->cost_acc));
    float biases[10];
    for (unsigned i = 0u; i < TILTS; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            biases[jcal_sym_at(i, k)] = refine->matrix[jcal_sym_at(TILTS + i, TILTS + k)];
        }
        biases[jcal_sym_at(i, i)] += prior;
    }
    float scale[TILTS];
    if (!jcal_chol_factor_damped(biases, TILTS, 0.0f, scale)) {
        return false;
    }
    for (unsigned i = 0u; i < TILTS; ++i) {
        float column[TILTS];
        for (unsigned k = 0u; k < TILTS; ++k) {
            column[k] = refine->matrix[jcal_sym_at(TILTS + k, i)];
        }
        jcal_chol_solve_scaled(biases, TILTS, scale, column);
        for (unsigned k = 0u; k <= i; ++k) {
            const size_t at = jcal_sym_at(i, k);
            float sum = refine->matrix[at];
            for (unsigned m = 0u; m < TILTS; ++m) {
                sum -= column[m] * refine->matrix[jcal_sym_at(TILTS + m, k)];
            }
            out->all[at] = sum + acc->matrix[at];
            out->sure[at] = sum + (trust * acc->matrix[at]);
        }
        out->sure[jcal_sym_at(i, i)] -= (PRETENDED_SHARE * refine->cost) + (trust * acc->cost_acc);
    }
    return true;
}

/// 95 % radius for a covariance a, b, d on the tangent plane.
static float radius(const float covariance[3])
{
    const float mean = 0.5f * (covariance[0] + covariance[2]);
    const float differ = 0.5f * (covariance[0] - covariance[2]);
    const float half = sqrtf((differ * differ) + (covariance[1] * covariance[1]));
    const float radius2 = (ONE_DIRECTION * (mean + half)) + (SECOND_DIRECTION * jcal_max(mean - half, 0.0f));
    return jcal_min(sqrtf(radius2), JCAL_BOUND_UNKNOWN_RAD);
}

/// True if a segment has turned about its axis long enough for its rates, and not another sensor's readings, to show it.
static bool has_turned(const jcal_hinge_refine_t *refine, const jcal_hinge_config_t *cfg, unsigned axis)
{
    const float noise = cfg->gyr_noise_rad_s;
    return (refine->along[axis] * noise * noise * JCAL_HINGE_UNIT_S) > TURNED_MIN;
}

/// The bound, made wider where a tilt by it changes the rate across the axis too much for linear sums.
static float widen(const jcal_hinge_refine_t *refine, unsigned axis, float bound_rad)
{
    const float along = jcal_max(refine->along[axis], 1e-20f);
    const float reach = LINEAR_SHARE * sqrtf(refine->across / along);
    const float planar = along / (along + (PLANAR_RATIO * refine->across));
    const float few = 1.0f + (planar * PLANAR_BLOCKS / jcal_max(jcal_hinge_refine_blocks_of(refine, axis), 1.0f));
    return jcal_min(few * bound_rad * jcal_max(1.0f, bound_rad / jcal_max(reach, 1e-6f)), JCAL_BOUND_UNKNOWN_RAD);
}

/// How much more the score scatters than its matrix says: what blocks show and what residuals of this power let expect.
static float inflate(float met, float noise, float blocks)
{
    const float assumed = noise * (PRIOR_QUIET + (PRIOR_DISTURBED * noise / (noise + DISTURBED_NOISE)));
    return ((met * blocks) + (assumed * PRIOR_BLOCKS)) / (blocks + PRIOR_BLOCKS);
}

/// The scatter beside the matrix, mean over the tilts.
static float mean_scatter(const jcal_hinge_refine_t *refine)
{
    float sum = 0.0f;
    for (unsigned i = 0u; i < TILTS; ++i) {
        const size_t at = jcal_sym_at(i, i);
        sum += refine->scatter[at] / jcal_max(refine->matrix[at], 1e-20f);
    }
    return 0.25f * sum;
}

/// What of the residual's power a scale or a lag of one sensor explains, beyond what two numbers explain by chance.
///
/// A scale s leaves s z along z, a lag t leaves t dz/dt. Where noise is part of the residual it lowers what one sensor's z tells of a
/// scale and raises what the other's does, by half the cost each: what both tell of it counts.
static float explained_by_one_sensor(const jcal_hinge_refine_t *refine)
{
    const jcal_hinge_alike_t *const alike = &refine->alike;
    const float scale = jcal_max(0.0f, fabsf(alike->scale) - (0.5f * refine->cost));
    const float by_scale = scale * scale / jcal_max(refine->across, 1e-20f);
    const float by_lag = alike->lag * alike->lag / jcal_max(alike->change, 1e-20f);
    const float by_chance = refine->cost * BY_CHANCE / jcal_max(jcal_hinge_refine_blocks(refine), 1.0f);
    return jcal_max(0.0f, jcal_min(refine->cost, by_scale + by_lag) - by_chance); /* NaN stays */
}

/// How far blocks show that the residual follows the motion: 0 where they scatter as independent readings do, 1 from four times that.
/// `met`: their scatter over that of independent readings.
static float follows_motion(float met, float blocks)
{
    const float scatter = ((met * blocks) + (FOLLOWS_PRIOR * PRIOR_BLOCKS)) / (blocks + PRIOR_BLOCKS);
    return jcal_min(jcal_max((scatter - 1.0f) / FOLLOWS_SCATTER, 0.0f), 1.0f);
}

/// What does not average out, as a power beside the scatter.
///
/// An error of the rates that acts alike in every sample, of power P summed, moves axis i by at most sqrt(P / sum l_i^2). What is taken
/// for such an error:
/// - a share `rate_mismatch` of the rates of both sensors;
/// - what a scale or a lag explains of the residual;
/// - of all of it, where blocks scatter (`met`, as above) like what follows the motion, a share that grows with the residual beside the rate along the
///   axis: good sensors on rigid segments leave 2 to 3 % of it, which to the most part averages out.
static void find_systematic(const jcal_hinge_refine_t *refine, const jcal_hinge_config_t *cfg, float met,
                            float of_axis[2])
{
    const float rates = refine->along[0] + refine->along[1] + (2.0f * refine->across);
    const float quiet = QUIET_RAD_S / cfg->gyr_noise_rad_s;
    const float follows = follows_motion(met, jcal_hinge_refine_blocks(refine));
    const float left =
        follows * follows * jcal_max(refine->cost - (quiet * quiet * refine->time_s / JCAL_HINGE_UNIT_S), 0.0f);
    const float both = (TOGETHER * cfg->rate_mismatch * cfg->rate_mismatch * rates) + explained_by_one_sensor(refine);
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        const float along = jcal_max(refine->along[axis], 1e-20f);
        const float alike = jcal_min(LEFT_ALIKE * LEFT_ALIKE * (left / along), LEFT_ALIKE_MAX * LEFT_ALIKE_MAX);
        of_axis[axis] = (both + (alike * left)) / (ONE_DIRECTION + SECOND_DIRECTION);
    }
}

static float of_axes(const float of_axis[2], const float v[TILTS])
{
    return (of_axis[0] * ((v[0] * v[0]) + (v[1] * v[1]))) + (of_axis[1] * ((v[2] * v[2]) + (v[3] * v[3])));
}

bool jcal_hinge_bounds(const jcal_hinge_refine_t *refine, const jcal_hinge_moments_t *moments,
                       const jcal_hinge_config_t *cfg, jcal_hinge_bounds_t *out)
{
    const float blocks = jcal_hinge_refine_blocks(refine);
    const float noise = jcal_hinge_refine_noise(refine);
    const float pull = jcal_hinge_refine_pull(refine);
    information_t information;
    float values[TILTS];
    float vectors[TILTS * TILTS];
    if (!(refine->blocks >= BLOCKS_MIN)) {
        return false;
    }
    const float scatter = mean_scatter(refine);
    jcal_hinge_lin_t acc;
    jcal_hinge_linearise_acc(moments, cfg, &refine->point, &acc);
    if (!inform(refine, &acc, inflate(scatter, noise, blocks), &information) ||
        !jcal_eig_symmetric(information.sure, TILTS, values, vectors)) {
        return false;
    }
    float systematic[2];
    find_systematic(refine, cfg, scatter / noise, systematic);
    float covariance[2][3] = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    out->inflation = 0.0f;
    for (unsigned k = 0u; k < TILTS; ++k) {
        const float *const v = &vectors[TILTS * k];
        const float met = jcal_sym_quadratic(refine->scatter, TILTS, v) /
                          jcal_max(jcal_sym_quadratic(information.all, TILTS, v), 1e-20f);
        /* Moving sums along with the axes is not exact: never less than what quick noise leaves; NaN stays. */
        const float least = SCATTER_MIN * noise;
        const float inflation = inflate((met < least) ? least : met, noise, blocks);
        float variance = OPEN_BOUND2;
        if (values[k] > OPEN_INFORMATION) {
            const float pulled = pull * COARSE_RAD / values[k];
            variance = ((inflation + of_axes(systematic, v)) / values[k]) + (pulled * pulled);
        }
        for (unsigned axis = 0u; axis < 2u; ++axis) {
            const float *const part = &v[2u * axis];
            covariance[axis][0] += variance * part[0] * part[0];
            covariance[axis][1] += variance * part[0] * part[1];
            covariance[axis][2] += variance * part[1] * part[1];
        }
        out->inflation = jcal_max(out->inflation, inflation);
    }
    out->bound1_rad = has_turned(refine, cfg, 0u) ? widen(refine, 0u, radius(covariance[0])) : JCAL_BOUND_UNKNOWN_RAD;
    out->bound2_rad = has_turned(refine, cfg, 1u) ? widen(refine, 1u, radius(covariance[1])) : JCAL_BOUND_UNKNOWN_RAD;
    return true;
}
