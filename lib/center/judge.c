/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and status of the joint centre. See center/judge.h.
#include "center/judge.h"

#include "center/gravity.h"
#include "center/place.h"
#include "center/sums.h"
#include "joint/hysteresis.h"
#include "jointcal/vec3.h"
#include "math/chol.h"
#include "math/clear.h"
#include "math/eig.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#define N JCAL_CENTER_UNKNOWNS

/// 95 % of a Gaussian along a line.
#define NORMAL_95 1.96f

/// The share of what remains unexplained and lasts that may have shifted the estimate.
#define HIDDEN_SHARE 0.65f
/// No less than this share of it is taken to last when it comes to bounds: soft tissue that follows quick motion lasts no longer than
/// noise does, and shifts the estimate all the same.
#define LASTING_MIN 0.15f
/// With more smoothing than this, s, samples that share no reading are so far apart that what lasts between them says little: all of
/// what remains may last then, and in proportion, as smoothing takes more of what remains than of the shift.
#define HIDDEN_S 0.125f

/// Blocks from which the scatter says something, and what is taken from their number.
#define BLOCKS_MIN 8.0f
#define BLOCKS_LOST 4.0f

/// Rows are wrong by this share of their length: misaligned gyroscopes, play of the joint. That much information in a direction is
/// none. Perfect hinges leave their axis entirely open; on real ones it looks known to 0.055 to 0.12 of what the rows hold in all,
/// against 0.2 to 0.5 of the worst direction of other joints.
#define ROW_ERROR 0.08f
/// More than this share of a direction's information being none leaves it open.
#define FAKE_SHARE_MAX 0.8f
/// A doubtful direction within 18 deg of a known hinge axis is that axis.
#define ALONG_COSINE2 0.9f
/// Steps of the power iteration in each judgement; it goes on from the last one.
#define POWER_STEPS 4u

/// Residuals, squared, are never taken for less than this share of what the config calls usual.
#define EXCESS_MIN 0.3f

/// Judgements in a row that found nothing missing.
#define AGREED_MIN 3u

/// Slices after the first two: pairs of columns, rows of both covariances, doubts, both bounds, the verdict.
#define SLICE_COLUMNS (JCAL_CENTER_SLICE_FACTOR + 1u)
#define SLICE_COVARIANCES (SLICE_COLUMNS + 3u)
#define SLICE_DOUBTS (SLICE_COVARIANCES + 6u)
#define SLICE_BOUNDS (SLICE_DOUBTS + 1u)
#define SLICE_VERDICT (SLICE_BOUNDS + 2u)
typedef char jcal_center_counts_its_slices[(JCAL_CENTER_JUDGE_SLICES == (SLICE_VERDICT + 1u)) ? 1 : -1];

/// Mean squared rates below this are no motion to speak of, (rad/s)^2.
#define TURN_MIN 0.1f

/// Residuals, squared, over what the config calls usual.
static float excess_of(const jcal_center_sums_t *sums)
{
    return jcal_max(sums->cost / jcal_max(sums->noise, FLT_MIN), EXCESS_MIN);
}

/// The matrix whose inverse is wanted.
static void scale(const jcal_center_config_t *cfg, jcal_center_work_t *self)
{
    jcal_center_inverse_t *const inverse = &self->as.inverse;
    float prior[N];
    jcal_center_prior(&self->sums, cfg, prior);
    (void)memcpy(inverse->of.next.matrix, self->sums.matrix, sizeof inverse->of.next.matrix);
    for (size_t i = 0u; i < N; ++i) {
        inverse->of.next.matrix[jcal_sym_at(i, i)] += prior[i];
    }
    jcal_chol_scale(inverse->of.next.matrix, N, inverse->of.next.scale);
}

static bool factor(jcal_center_inverse_t *inverse)
{
    (void)memcpy(inverse->scale, inverse->of.next.scale, sizeof inverse->scale);
    inverse->is_factored = jcal_chol_factor(inverse->of.next.matrix, N, inverse->factor, NULL);
    return inverse->is_factored;
}

static void column(jcal_center_inverse_t *inverse, size_t which)
{
    float *const x = inverse->of.columns[which];
    jcal_clear(x, sizeof inverse->of.columns[which]);
    x[which] = 1.0f;
    jcal_chol_solve_scaled(inverse->factor, N, inverse->scale, x);
}

/// One row of the covariances of r1 (rows 0 to 2) or r2 (3 to 5).
static void covariance(const jcal_center_config_t *cfg, jcal_center_work_t *self, size_t row)
{
    jcal_center_inverse_t *const inverse = &self->as.inverse;
    const jcal_center_sums_t *const sums = &self->sums;
    const float excess = excess_of(sums);
    const float own = jcal_center_excess(sums); /* of the prior, which is multiplied by it once */
    const float counted = jcal_max(sums->blocks - BLOCKS_LOST, 1.0f) * JCAL_CENTER_BLOCK_S;
    const float few = jcal_max(sums->time_s / counted, 1.0f);
    const size_t sensor = row / 3u;
    const size_t i = row % 3u;
    const float *const x = inverse->of.columns[row];
    float prior[N];
    float spread[N]; /* S x */
    jcal_center_prior(&self->sums, cfg, prior);
    jcal_sym_times(sums->scatter, N, x, spread);
    for (size_t j = 0u; j <= i; ++j) {
        const float *const y = inverse->of.columns[(3u * sensor) + j];
        float from_scatter = 0.0f;
        float from_prior = 0.0f;
        for (size_t k = 0u; k < N; ++k) {
            from_scatter += spread[k] * y[k];
            from_prior += prior[k] * x[k] * y[k];
        }
        const size_t at = jcal_sym_at(i, j);
        inverse->covariance[sensor][at] = (few * from_scatter) + (own * from_prior);
        inverse->least[sensor][at] = (excess * (x[(3u * sensor) + j] - from_prior)) + (own * from_prior);
    }
}

/// Takes the part along a unit vector out of a packed 3 x 3 covariance: C <- Q C Q, Q = I - n n'. A zero vector leaves it.
static void across(float *c, jcal_vec3_t n)
{
    const float v[3] = {n.x, n.y, n.z};
    float on[3]; /* C n */
    jcal_sym_times(c, 3u, v, on);
    const float along = (v[0] * on[0]) + (v[1] * on[1]) + (v[2] * on[2]);
    size_t k = 0u;
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t j = 0u; j <= i; ++j) {
            c[k] += (along * v[i] * v[j]) - ((on[i] * v[j]) + (v[i] * on[j]));
            ++k;
        }
    }
}

/// 95 % radius of a Gaussian with covariance c (3 x 3, packed).
static float radius(const float *c)
{
    const float trace = c[0] + c[2] + c[5];
    const float squares =
        (c[0] * c[0]) + (c[2] * c[2]) + (c[5] * c[5]) + (2.0f * ((c[1] * c[1]) + (c[3] * c[3]) + (c[4] * c[4])));
    return sqrtf(jcal_max(trace + (2.0f * sqrtf(2.0f * squares)), 0.0f));
}

float jcal_center_radius_across(float *c, jcal_vec3_t axis)
{
    across(c, axis);
    return radius(c);
}

static jcal_center_bounds_t unknown_bounds(void)
{
    const jcal_center_bounds_t b = {
        JCAL_BOUND_UNKNOWN_M, JCAL_BOUND_UNKNOWN_M, JCAL_BOUND_UNKNOWN_M, {0.0f, 0.0f, 0.0f}};
    return b;
}

static float bound(float radius_m, float hidden_m, float mismatch_m)
{
    return jcal_min(mismatch_m + sqrtf((radius_m * radius_m) + (hidden_m * hidden_m)), JCAL_BOUND_UNKNOWN_M);
}

/// Root of the information that wrong rows make of the vector of one sensor (0 or 1).
static float wrong_row(const jcal_center_sums_t *sums, size_t sensor)
{
    float power = 0.0f;
    for (size_t k = 3u * sensor; k < ((3u * sensor) + 3u); ++k) {
        power += sums->matrix[jcal_sym_at(k, k)];
    }
    return ROW_ERROR * sqrtf(jcal_max(power, 1.0f));
}

/// Finds the direction of (r1, r2) of whose information the largest share may come from wrong rows, W = D V D with V the covariance by
/// the matrix alone and D D the information that wrong rows make. V holds share y y', y = D^-1 z.
static void find_fake(jcal_center_work_t *self)
{
    jcal_center_inverse_t *const inverse = &self->as.inverse;
    float d[2];
    for (size_t i = 0u; i < 2u; ++i) {
        d[i] = wrong_row(&self->sums, i);
    }
    float *const z = inverse->fake;
    for (unsigned step = 0u; step < POWER_STEPS; ++step) {
        float on[6];
        float square = 0.0f;
        for (size_t i = 0u; i < 6u; ++i) {
            on[i] = 0.0f;
            for (size_t k = 0u; k < 6u; ++k) {
                on[i] += d[i / 3u] * inverse->of.columns[i][k] * d[k / 3u] * z[k];
            }
            square += on[i] * on[i];
        }
        const float share = sqrtf(square);
        for (size_t i = 0u; i < 6u; ++i) {
            z[i] = (share > FLT_MIN) ? (on[i] / share) : 1.0f;
        }
        inverse->fake_share = share;
    }
}

/// The doubtful direction as far as it is one of this sensor's vector, m, in any measure.
static jcal_vec3_t doubtful(const jcal_center_work_t *self, size_t sensor)
{
    const float *const z = &self->as.inverse.fake[3u * sensor];
    return jcal_vec3_scale(jcal_vec3(z[0], z[1], z[2]), 1.0f / wrong_row(&self->sums, sensor));
}

/// Takes information that wrong rows may have made out of a covariance c (3 x 3, packed) of one sensor's vector. An open direction
/// leaves each sensor's vector open by its part in it.
static void deflate(const jcal_center_work_t *self, size_t sensor, float *c)
{
    const float share = self->as.inverse.fake_share;
    const jcal_vec3_t y = doubtful(self, sensor);
    const jcal_vec3_t other = doubtful(self, 1u - sensor);
    const float own[3] = {y.x, y.y, y.z};
    float by_matrix = 0.0f;
    for (size_t i = 0u; i < 3u; ++i) {
        by_matrix += self->as.inverse.of.columns[(3u * sensor) + i][(3u * sensor) + i];
    }
    const float left = 1.0f - share;
    const float more = share * ((1.0f / (left * left)) - 1.0f) * ((c[0] + c[2] + c[5]) / jcal_max(by_matrix, FLT_MIN));
    const float length2 = jcal_vec3_dot(y, y) + jcal_vec3_dot(other, other);
    const float open = 2.0f * JCAL_BOUND_UNKNOWN_M * JCAL_BOUND_UNKNOWN_M / jcal_max(length2, FLT_MIN);
    jcal_sym_rank1(c, 3u, own, (share < FAKE_SHARE_MAX) ? more : open);
}

/// Whether the doubtful direction of one sensor's vector is the known hinge axis: then it is open as is to be expected.
static bool is_along_axis(jcal_vec3_t own, jcal_vec3_t axis)
{
    const float along = jcal_vec3_dot(own, axis);
    return (along * along) > (ALONG_COSINE2 * jcal_vec3_dot(own, own));
}

static jcal_center_bounds_t bounds_of(const jcal_center_config_t *cfg, const jcal_center_work_t *self, size_t sensor)
{
    const jcal_center_inverse_t *const inverse = &self->as.inverse;
    const jcal_vec3_t axis = (sensor == 0u) ? cfg->hinge_axis1 : cfg->hinge_axis2;
    const float mismatch_m = cfg->mismatch_m;
    const float scale_m = jcal_center_gravity_shift(&self->gravity, cfg, &self->sums.point.place, sensor);
    const float hidden_m = sqrtf((inverse->hidden_m * inverse->hidden_m) + (scale_m * scale_m));
    const bool by_scatter = radius(inverse->covariance[sensor]) > radius(inverse->least[sensor]);
    float known[6];
    float larger[6];
    (void)memcpy(known, by_scatter ? inverse->covariance[sensor] : inverse->least[sensor], sizeof known);
    (void)memcpy(larger, known, sizeof larger);
    deflate(self, sensor, larger);
    float values[3];
    float vectors[9];
    jcal_center_bounds_t b = unknown_bounds();
    if (!jcal_eig_symmetric(larger, 3u, values, vectors)) {
        return b;
    }
    b.direction = jcal_vec3(vectors[0], vectors[1], vectors[2]);
    b.weakest = bound(NORMAL_95 * sqrtf(jcal_max(values[0], 0.0f)), hidden_m, mismatch_m);
    b.second = bound(NORMAL_95 * sqrtf(jcal_max(values[1], 0.0f)), hidden_m, mismatch_m);
    if (!is_along_axis(doubtful(self, sensor), axis)) {
        (void)memcpy(known, larger, sizeof known);
    }
    b.all = bound(jcal_center_radius_across(known, axis), hidden_m, mismatch_m);
    return b;
}

/// What is missing, if anything; the most important first.
static void name_what_is_missing(const jcal_center_config_t *cfg, jcal_center_work_t *self,
                                 const jcal_center_bounds_t *b)
{
    jcal_center_verdict_t *const verdict = &self->verdict;
    const jcal_center_sums_t *const sums = &self->sums;
    const float slack = (verdict->status == (uint8_t)JCAL_READY) ? JCAL_HYSTERESIS : 1.0f;
    const float limit = cfg->max_bound_m * slack;
    const unsigned worse = (b[1].all > b[0].all) ? 1u : 0u;
    const float still = TURN_MIN * sums->time_s;
    verdict->weak = (uint8_t)JCAL_WEAK_NONE;
    verdict->reason = (uint8_t)jcal_center_gravity_objects(&self->gravity, slack);
    const bool is_grave =
        (verdict->reason != (uint8_t)JCAL_REASON_NONE) && (verdict->reason != (uint8_t)JCAL_REASON_UNCERTAIN);
    verdict->hint = (uint8_t)(is_grave ? JCAL_HINT_CHECK_SENSORS : JCAL_HINT_NONE);
    if (is_grave || (b[worse].all <= limit)) {
        return;
    }
    verdict->weak = (uint8_t)((worse == 1u) ? JCAL_WEAK_CENTER2 : JCAL_WEAK_CENTER1);
    verdict->reason = (uint8_t)JCAL_REASON_UNCERTAIN;
    if ((sums->turn1 < still) || (sums->turn2 < still)) {
        verdict->reason = (uint8_t)JCAL_REASON_NO_MOTION;
        verdict->hint = (uint8_t)((sums->turn1 < sums->turn2) ? JCAL_HINT_MOVE_SEGMENT1 : JCAL_HINT_MOVE_SEGMENT2);
    } else if (bound(0.0f, self->as.inverse.lasting_m, cfg->mismatch_m) > limit) {
        verdict->reason = (uint8_t)JCAL_REASON_DOES_NOT_FIT;
        verdict->hint = (uint8_t)JCAL_HINT_CHECK_SENSORS;
    } else if (b[worse].second >
               limit) { /* which is so too where noise hides too much: livelier motion shows more beside it */
        verdict->hint = (uint8_t)JCAL_HINT_MOVE_JOINT;
    } else {
        verdict->hint = (uint8_t)JCAL_HINT_MORE_DIRECTIONS;
    }
}

/// How far what remains unexplained may have shifted the estimate.
static void find_hidden(const jcal_center_config_t *cfg, jcal_center_work_t *self)
{
    const float more = jcal_max(cfg->kinematics.smoothing_s / HIDDEN_S, 1.0f);
    const jcal_center_sums_t *const sums = &self->sums;
    const jcal_center_place_t *const place = &sums->point.place;
    const float share = jcal_min(sums->cost / jcal_max(sums->effect, FLT_MIN), 1.0f);
    const float lasts = jcal_min(jcal_max(sums->lagged, 0.0f) / jcal_max(sums->raw, FLT_MIN), 1.0f);
    const float lasting = (more > 1.0f) ? 1.0f : lasts;
    const float length = sqrtf(jcal_max(jcal_vec3_dot(place->r1, place->r1), jcal_vec3_dot(place->r2, place->r2)));
    const float all_m = HIDDEN_SHARE * more * sqrtf(share) * length;
    self->verdict.misfit = sqrtf(share);
    self->as.inverse.lasting_m = all_m * sqrtf(lasting);
    self->as.inverse.hidden_m = (all_m * sqrtf(jcal_max(lasting, LASTING_MIN))) + (share * length);
}

static void judge(const jcal_center_config_t *cfg, jcal_center_work_t *self)
{
    jcal_center_verdict_t *const verdict = &self->verdict;
    const jcal_center_place_t told = jcal_center_place_told(cfg, &self->sums.point.place);
    const bool enough = (self->sums.blocks >= BLOCKS_MIN) && jcal_center_place_in_reach(&told);
    const jcal_center_bounds_t unknown = unknown_bounds();
    const jcal_center_bounds_t b[2] = {enough ? self->as.inverse.bounds[0] : unknown,
                                       enough ? self->as.inverse.bounds[1] : unknown};
    name_what_is_missing(cfg, self, b);
    verdict->bound1_m = b[0].all;
    verdict->bound2_m = b[1].all;
    verdict->weakest1_m = b[0].weakest;
    verdict->weakest2_m = b[1].weakest;
    verdict->direction1 = b[0].direction;
    verdict->direction2 = b[1].direction;
    if (verdict->reason != (uint8_t)JCAL_REASON_NONE) {
        verdict->agreed = 0u;
        if (verdict->status != (uint8_t)JCAL_MOVED) {
            verdict->status = (uint8_t)JCAL_COLLECTING;
        }
        return;
    }
    verdict->agreed = (uint8_t)((verdict->agreed < AGREED_MIN) ? (verdict->agreed + 1u) : AGREED_MIN);
    if (verdict->agreed >= AGREED_MIN) {
        verdict->status = (uint8_t)JCAL_READY;
    } else {
        verdict->reason = (uint8_t)JCAL_REASON_UNCERTAIN;
    }
}

bool jcal_center_judge(const jcal_center_config_t *cfg, jcal_center_work_t *self, unsigned slice)
{
    if (slice == JCAL_CENTER_SLICE_SCALE) {
        scale(cfg, self);
    } else if (slice == JCAL_CENTER_SLICE_FACTOR) {
        return factor(&self->as.inverse);
    } else if (slice < SLICE_COVARIANCES) {
        column(&self->as.inverse, 2u * (slice - SLICE_COLUMNS));
        column(&self->as.inverse, (2u * (slice - SLICE_COLUMNS)) + 1u);
    } else if (slice < SLICE_DOUBTS) {
        covariance(cfg, self, slice - SLICE_COVARIANCES);
    } else if (slice == SLICE_DOUBTS) {
        find_hidden(cfg, self);
        find_fake(self);
    } else if (slice < SLICE_VERDICT) {
        self->as.inverse.bounds[slice - SLICE_BOUNDS] = bounds_of(cfg, self, slice - SLICE_BOUNDS);
    } else {
        judge(cfg, self);
    }
    return true;
}

void jcal_center_verdict_begin(jcal_center_verdict_t *verdict, jcal_calibration_t status)
{
    jcal_clear(verdict, sizeof *verdict);
    verdict->bound1_m = JCAL_BOUND_UNKNOWN_M;
    verdict->bound2_m = JCAL_BOUND_UNKNOWN_M;
    verdict->weakest1_m = JCAL_BOUND_UNKNOWN_M;
    verdict->weakest2_m = JCAL_BOUND_UNKNOWN_M;
    verdict->status = (uint8_t)status;
    verdict->reason = (uint8_t)JCAL_REASON_NO_DATA;
    verdict->hint = (uint8_t)JCAL_HINT_MOVE_JOINT;
}

void jcal_center_solve(const jcal_center_config_t *cfg, jcal_center_work_t *self)
{
    float *const d = self->as.inverse.step;
    float prior[N];
    jcal_center_prior(&self->sums, cfg, prior);
    jcal_center_sums_gradient(&self->sums, prior, d);
    for (size_t i = 0u; i < N; ++i) {
        d[i] = -d[i];
    }
    jcal_chol_solve_scaled(self->as.inverse.factor, N, self->as.inverse.scale, d);
}
