/* SPDX-License-Identifier: MIT */
/// @file
/// Sums at the running estimate. See hinge_evidence.h.
#include "calib/hinge_evidence.h"

#include "calib/hinge_point.h"
#include "jointcal/vec3.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <math.h>

/// Errors in |w1| - |w2| that no joint motion causes: scale errors as a share of the rate, and noise, rad/s.
#define DIFFERENCE_SHARE 0.03f
#define DIFFERENCE_NOISE_RAD_S 0.02f

/// Weight of the accelerometer part when information is measured; only proportions matter.
#define ACC_INFORMATION 4.0f

/// Coarse blocks last a twentieth of the time covered, within these limits, so that there are soon enough of them and
/// later ones are longer than what makes residuals similar from one sample to the next.
#define BLOCK_MIN_S 0.1f
#define BLOCK_MAX_S 1.0f
#define BLOCK_SHARE 0.05f
#define SCORES 4u

/// cos 20 deg: an axis that moved further makes its earlier scores useless.
#define ANCHOR_COSINE 0.9396926f

/// Shortest base of the difference quotient of the rates, s, and the longest across which it still means something.
#define TURN_BASE_S 0.019f
#define TURN_BASE_MAX_S 0.1f
/// Rates, squared, below which the turn says nothing, (rad/s)^2, and what counts as a strong one as a share of |w|^3,
/// squared.
#define TURN_RATE2 0.1f
#define TURN_SHARE 0.03f

/// Measure of what a sample can tell of one axis, whichever way the axis points; only proportions matter.
static float information_in(const jcal_hinge_sample_t *sample, float rate2)
{
    return (sample->gyr_weight * rate2 * rate2) + (ACC_INFORMATION * sample->acc_weight);
}

void jcal_hinge_evidence_watch(jcal_hinge_evidence_t *self, const jcal_hinge_sample_t *sample)
{
    const float difference = fabsf(sqrtf(sample->w1_2) - sqrtf(sample->w2_2));
    const float errors = (DIFFERENCE_SHARE * sqrtf(jcal_max(sample->w1_2, sample->w2_2))) + DIFFERENCE_NOISE_RAD_S;
    const float excess = jcal_max(difference - errors, 0.0f);
    self->excitation += sample->dt_s * excess * excess;
    self->axis1.information_all += information_in(sample, sample->w1_2);
    self->axis2.information_all += information_in(sample, sample->w2_2);
}

/// What one sensor's axis does to a sample.
typedef struct {
    float along;         ///< (w - b) . j
    jcal_vec3_t across;  ///< The rest of w - b.
    float across2;       ///< Its square.
} view_t;

static view_t look(const jcal_hinge_axis_t *axis, jcal_vec3_t w)
{
    const jcal_vec3_t rate = jcal_vec3_sub(w, axis->bias);
    view_t view;
    view.along = jcal_vec3_dot(rate, axis->j);
    view.across = jcal_hinge_across(axis->j, rate);
    view.across2 = jcal_vec3_dot(view.across, view.across);
    return view;
}

static void close_fine(jcal_hinge_scatter_t *scatter)
{
    jcal_sym_rank1(scatter->fine_scatter, SCORES, scatter->fine, 1.0f);
    scatter->fine_second += scatter->fine[SCORES] * scatter->fine[SCORES];
    for (unsigned i = 0u; i <= SCORES; ++i) {
        scatter->coarse[i] += scatter->fine[i];
        scatter->fine[i] = 0.0f;
    }
    scatter->fine_s = 0.0f;
}

static void close_coarse(jcal_hinge_scatter_t *scatter)
{
    jcal_sym_rank1(scatter->scatter, SCORES, scatter->coarse, 1.0f);
    scatter->second += scatter->coarse[SCORES] * scatter->coarse[SCORES];
    for (unsigned i = 0u; i <= SCORES; ++i) {
        scatter->coarse[i] = 0.0f;
    }
    scatter->information2 += scatter->coarse_information * scatter->coarse_information;
    scatter->coarse_information = 0.0f;
    scatter->coarse_s = 0.0f;
}

/// Adds time and closes the blocks that are full.
static void advance(jcal_hinge_scatter_t *scatter, float information, float dt_s)
{
    const float half = 0.5f * dt_s;
    scatter->information += information;
    scatter->coarse_information += information;
    scatter->time_s += dt_s;
    scatter->fine_s += dt_s;
    scatter->coarse_s += dt_s;
    if (scatter->fine_s >= (JCAL_HINGE_UNIT_S - half)) {
        close_fine(scatter);
    }
    const float length_s = jcal_min(BLOCK_MAX_S, jcal_max(BLOCK_MIN_S, BLOCK_SHARE * scatter->time_s));
    if (scatter->coarse_s >= (length_s - half)) {
        close_coarse(scatter);
    }
}

/// A sample's residuals times their weights, as one sensor sees them: sensor 2 enters both with the opposite sign.
typedef struct {
    float gyr;
    float acc;
    float bias_unit;  ///< Unit of the bias unknowns, rad/s.
} pull_t;

/// Gradient of the sample's cost with respect to one axis and its bias.
///
/// With e = |u1 x j1|^2 - |u2 x j2|^2:  de/dj = -2 (u . j) u_across,  de/db = -2 u_across; for (25): de/dj = a.
static void add_score(jcal_hinge_scatter_t *scatter, const jcal_hinge_axis_t *axis, const view_t *view, jcal_vec3_t acc,
                      const pull_t *pull)
{
    const jcal_vec3_t v = jcal_hinge_v(axis);
    const float across_u = -2.0f * pull->gyr * jcal_vec3_dot(view->across, axis->u);
    const float across_v = -2.0f * pull->gyr * jcal_vec3_dot(view->across, v);
    scatter->fine[0] += (view->along * across_u) + (pull->acc * jcal_vec3_dot(acc, axis->u));
    scatter->fine[1] += (view->along * across_v) + (pull->acc * jcal_vec3_dot(acc, v));
    scatter->fine[2] += pull->bias_unit * across_u;
    scatter->fine[3] += pull->bias_unit * across_v;
    scatter->fine[4] += pull->gyr * view->along * view->along;
}

/// The turn of the rate across the axis about the axis, times its square: what both sensors must see alike.
///
/// The rate across the axis is one vector in space. Seen from sensor i it turns about j with (u' . (j x u)) / |u|^2,
/// and the sensor itself turns with w . j, so j . (w x w') + (w . j) |w x j|^2 is the same for both sensors. It
/// changes its sign with j, which no other gyroscope term does: it tells the sign pairing wherever the motion leaves
/// the plane. With rates a and b at a distance T, w = (a + b) / 2 and w' = (b - a) / T, the first term is j . (a x b)
/// / T. Source: docs/METHOD.md section 4.
static float turn(const jcal_hinge_axis_t *axis, jcal_vec3_t before, jcal_vec3_t now, float base_s)
{
    const jcal_vec3_t middle = jcal_vec3_scale(jcal_vec3_add(before, now), 0.5f);
    const view_t view = look(axis, middle);
    const float cross = jcal_vec3_dot(jcal_vec3_cross(before, now), axis->j) / base_s;
    return cross + (view.along * view.across2);
}

static void add_turn(jcal_hinge_evidence_t *self, const jcal_hinge_point_t *point, const jcal_hinge_sample_t *sample)
{
    self->before_s += sample->dt_s;
    if (self->before_s < TURN_BASE_S) {
        return;
    }
    const float base_s = self->before_s;
    const jcal_vec3_t before1 = self->before1;
    const jcal_vec3_t before2 = self->before2;
    self->before1 = sample->w1;
    self->before2 = sample->w2;
    self->before_s = 0.0f;
    if (base_s > TURN_BASE_MAX_S) {
        return;
    }
    const float turn1 = turn(&point->axis1, before1, sample->w1, base_s);
    const float turn2 = turn(&point->axis2, before2, sample->w2, base_s);
    const float rate2 = (0.5f * (sample->w1_2 + sample->w2_2)) + TURN_RATE2;
    const float squares = (turn1 * turn1) + (turn2 * turn2);
    const float weight = 1.0f / (squares + (TURN_SHARE * rate2 * rate2 * rate2));
    const float units = base_s / JCAL_HINGE_UNIT_S;
    const float both = 2.0f * turn1 * turn2;
    self->turn_same += units * weight * (squares - both);
    self->turn_other += units * weight * (squares + both);
    self->turn_time_s += base_s * weight * squares;
}

static void add_fit(jcal_hinge_evidence_t *self, const view_t *view1, const view_t *view2,
                    const jcal_hinge_sample_t *sample)
{
    const float error = sqrtf(view1->across2) - sqrtf(view2->across2);
    const float error2 = error * error;
    const float difference = sqrtf(sample->w1_2) - sqrtf(sample->w2_2);
    const float weight = sample->gyr_weight * ((view1->along * view1->along) + (view2->along * view2->along));
    self->fit_time_s += sample->dt_s;
    self->across_error2 += sample->dt_s * error2;
    self->across_rate2 += sample->dt_s * 0.5f * (view1->across2 + view2->across2);
    self->difference2 += sample->dt_s * difference * difference;
    self->noise_sum += weight * error2;
    self->noise_weight += weight;
    self->pair_acc += sample->acc_weight;
    self->pair_acc2 += sample->acc_weight * sample->acc_weight / sample->dt_s;
}

void jcal_hinge_evidence_add(jcal_hinge_evidence_t *self, const jcal_hinge_point_t *point, float acc_constant_m_s2,
                             float gyr_bias_rad_s, const jcal_hinge_sample_t *sample)
{
    const view_t view1 = look(&point->axis1, sample->w1);
    const view_t view2 = look(&point->axis2, sample->w2);
    const float gyr = sample->gyr_weight * (view1.across2 - view2.across2);
    const float acc_residual =
        jcal_vec3_dot(point->axis1.j, sample->a1) - jcal_vec3_dot(point->axis2.j, sample->a2) - acc_constant_m_s2;
    const float acc = sample->acc_weight * acc_residual;
    const pull_t pull1 = {gyr, acc, gyr_bias_rad_s};
    const pull_t pull2 = {-gyr, -acc, gyr_bias_rad_s};
    add_score(&self->axis1, &point->axis1, &view1, sample->a1, &pull1);
    add_score(&self->axis2, &point->axis2, &view2, sample->a2, &pull2);
    advance(&self->axis1, information_in(sample, sample->w1_2), sample->dt_s);
    advance(&self->axis2, information_in(sample, sample->w2_2), sample->dt_s);
    add_fit(self, &view1, &view2, sample);
    add_turn(self, point, sample);
}

static void restart_axis(jcal_hinge_scatter_t *scatter, jcal_vec3_t j)
{
    const float information_all = scatter->information_all;
    *scatter = (jcal_hinge_scatter_t){0};
    scatter->information_all = information_all;
    scatter->anchor = j;
}

static void restart_fit(jcal_hinge_evidence_t *self)
{
    self->fit_time_s = 0.0f;
    self->across_error2 = 0.0f;
    self->across_rate2 = 0.0f;
    self->difference2 = 0.0f;
    self->noise_sum = 0.0f;
    self->noise_weight = 0.0f;
    self->pair_acc = 0.0f;
    self->pair_acc2 = 0.0f;
    self->turn_same = 0.0f;
    self->turn_other = 0.0f;
    self->turn_time_s = 0.0f;
}

void jcal_hinge_evidence_follow(jcal_hinge_evidence_t *self, const jcal_hinge_point_t *point, bool all)
{
    const bool far1 = !(jcal_vec3_dot(self->axis1.anchor, point->axis1.j) > ANCHOR_COSINE);
    const bool far2 = !(jcal_vec3_dot(self->axis2.anchor, point->axis2.j) > ANCHOR_COSINE);
    if (all || far1) {
        restart_axis(&self->axis1, point->axis1.j);
    }
    if (all || far2) {
        restart_axis(&self->axis2, point->axis2.j);
    }
    if (all || far1 || far2) {
        restart_fit(self);
    }
}

static void halve_axis(jcal_hinge_scatter_t *scatter)
{
    jcal_sym_scale(scatter->fine_scatter, SCORES, 0.5f);
    jcal_sym_scale(scatter->scatter, SCORES, 0.5f);
    scatter->fine_second *= 0.5f;
    scatter->second *= 0.5f;
    scatter->information *= 0.5f;
    scatter->information2 *= 0.5f;
    scatter->information_all *= 0.5f;
    scatter->time_s *= 0.5f;
}

void jcal_hinge_evidence_halve(jcal_hinge_evidence_t *self)
{
    halve_axis(&self->axis1);
    halve_axis(&self->axis2);
    self->fit_time_s *= 0.5f;
    self->across_error2 *= 0.5f;
    self->across_rate2 *= 0.5f;
    self->difference2 *= 0.5f;
    self->noise_sum *= 0.5f;
    self->noise_weight *= 0.5f;
    self->pair_acc *= 0.5f;
    self->pair_acc2 *= 0.5f;
    self->turn_same *= 0.5f;
    self->turn_other *= 0.5f;
    self->turn_time_s *= 0.5f;
    self->excitation *= 0.5f;
}
