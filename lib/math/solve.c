/* SPDX-License-Identifier: MIT */
/// @file
/// Damped Gauss-Newton steps: Marquardt's scaled damping, Nielsen-like adaptation by the gain ratio.
#include "math/solve.h"

#include "math/sphere.h"

#include <math.h>

/* Gain ratios above which the model is trusted more, and below which less. */
static const float gain_good = 0.75f;
static const float gain_poor = 0.25f;
static const float damping_down = 0.2f;
static const float damping_up = 4.0f;
static const float damping_refused = 10.0f;

static void set_damping(jcal_gn_t *gn, float damping)
{
    const float low = (damping > JCAL_GN_DAMPING_MIN) ? damping : JCAL_GN_DAMPING_MIN;
    gn->damping = (low < JCAL_GN_DAMPING_MAX) ? low : JCAL_GN_DAMPING_MAX;
}

/* out <- matrix + damping D, D = max(diagonal, share of the largest diagonal element). */
static void damped_matrix(const jcal_gn_model_t *model, float damping, float *out)
{
    float largest = 0.0f;
    for (size_t i = 0u; i < model->n; ++i) {
        const float d = model->matrix[jcal_sym_at(i, i)];
        largest = (d > largest) ? d : largest;
    }
    for (size_t k = 0u; k < JCAL_SYM_SIZE(model->n); ++k) {
        out[k] = model->matrix[k];
    }
    const float least = JCAL_GN_DIAGONAL_SHARE * largest;
    for (size_t i = 0u; i < model->n; ++i) {
        const size_t ii = jcal_sym_at(i, i);
        out[ii] += damping * ((out[ii] > least) ? out[ii] : least);
    }
}

float jcal_gn_predict(const jcal_gn_model_t *model, const float *d)
{
    float linear = 0.0f;
    for (size_t i = 0u; i < model->n; ++i) {
        linear += model->gradient[i] * d[i];
    }
    return linear + (0.5f * jcal_sym_quadratic(model->matrix, model->n, d));
}

bool jcal_gn_step(jcal_gn_t *gn, const jcal_gn_model_t *model, float *d, float *predicted)
{
    if ((gn == NULL) || (model == NULL) || (d == NULL) || (model->n < 1u) || (model->n > JCAL_CHOL_MAX)) {
        return false;
    }
    float work[JCAL_SYM_SIZE(JCAL_CHOL_MAX)]; /* n x n, packed */
    damped_matrix(model, gn->damping, work);
    if (!jcal_chol_factor(work, model->n, work, NULL)) {
        set_damping(gn, gn->damping * damping_refused);
        return false;
    }
    float step[JCAL_CHOL_MAX];
    for (size_t i = 0u; i < model->n; ++i) {
        step[i] = -model->gradient[i];
    }
    jcal_chol_solve(work, model->n, step, step);
    const float promise = jcal_gn_predict(model, step);
    if (!(promise <= 0.0f)) { /* NaN in the gradient, or a matrix that is not semidefinite */
        set_damping(gn, gn->damping * damping_refused);
        return false;
    }
    for (size_t i = 0u; i < model->n; ++i) {
        d[i] = step[i];
    }
    if (predicted != NULL) {
        *predicted = promise;
    }
    return true;
}

bool jcal_gn_judge(jcal_gn_t *gn, float predicted, float actual)
{
    if (predicted == 0.0f) {
        return false;
    }
    const float gain = actual / predicted;
    if (!((predicted < 0.0f) && (gain > JCAL_GN_KEEP_RATIO))) {
        set_damping(gn, gn->damping * damping_refused);
        return false;
    }
    if (gain > gain_good) {
        set_damping(gn, gn->damping * damping_down);
    } else if (gain < gain_poor) {
        set_damping(gn, gn->damping * damping_up);
    } else {
        /* As good as a quadratic model may be: the damping fits. */
    }
    return true;
}

void jcal_gn_move(jcal_vec3_t *axes, size_t k, float *plain, size_t m, const float *d)
{
    for (size_t i = 0u; i < k; ++i) {
        const jcal_tangent_t t = jcal_sphere_tangent(axes[i]);
        axes[i] = jcal_sphere_move(axes[i], &t, d[2u * i], d[(2u * i) + 1u]);
    }
    for (size_t i = 0u; i < m; ++i) {
        plain[i] += d[(2u * k) + i];
    }
}

float jcal_gn_length(const float *d, size_t n)
{
    float square = 0.0f;
    for (size_t i = 0u; i < n; ++i) {
        square += d[i] * d[i];
    }
    return sqrtf(square);
}
