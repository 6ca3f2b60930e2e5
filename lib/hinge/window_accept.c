/* SPDX-License-Identifier: MIT */
/// @file
/// Local and global uncertainty of [OLS20] section 6.
#include "hinge/window_accept.h"

#include "math/angle.h"
#include "math/chol.h"
#include "math/sphere.h"

enum { UNKNOWNS = 4 };

/* Square of (58); not positive if there is no scatter or fewer than two residuals. */
static float residual_variance(const jcal_hinge_kind_t *kind)
{
    if (kind->n < 2u) {
        return 0.0f;
    }
    const float n = (float)kind->n;
    return (kind->square - ((kind->sum * kind->sum) / n)) / (n - 1.0f);
}

void jcal_hinge_local_uncertainty(const jcal_hinge_sums_t *sums, float local_rad[2])
{
    local_rad[0] = JCAL_HALF_PI;
    local_rad[1] = JCAL_HALF_PI;
    const float variance_gyr = residual_variance(&sums->gyr);
    const float variance_acc = residual_variance(&sums->acc);
    if (!((variance_gyr > 0.0f) && (variance_acc > 0.0f))) {
        return;
    }
    /* (57): J_s^T J_s; the weights of (24), (25) cancel against those in the standard deviations. */
    float information[JCAL_SYM_SIZE(UNKNOWNS)]; /* 4 x 4 */
    float covariance[JCAL_SYM_SIZE(UNKNOWNS)];  /* 4 x 4, rad^2 */
    for (size_t k = 0u; k < JCAL_SYM_SIZE(UNKNOWNS); ++k) {
        information[k] = (sums->gyr.matrix[k] / variance_gyr) + (sums->acc.matrix[k] / variance_acc);
    }
    if (!jcal_chol_factor(information, UNKNOWNS, information, NULL)) {
        return;
    }
    jcal_chol_inverse(information, UNKNOWNS, covariance);
    for (size_t s = 0u; s < 2u; ++s) {
        const size_t a = 2u * s;
        const float local = jcal_angle_mean_plus_2_sigma(
            covariance[jcal_sym_at(a, a)], covariance[jcal_sym_at(a + 1u, a)], covariance[jcal_sym_at(a + 1u, a + 1u)]);
        local_rad[s] = (local < JCAL_HALF_PI) ? local : JCAL_HALF_PI;
    }
}

static float lesser(float a, float b)
{
    return (a < b) ? a : b;
}

static float larger(float a, float b)
{
    return (a > b) ? a : b;
}

/* (66), (67): the sign that brings one of the axes nearest to its previous place; the deviation of the other. */
static float sequential_deviation(jcal_hinge_accept_t *self, const jcal_hinge_axes_t *axes)
{
    jcal_hinge_axes_t chosen = *axes;
    float deviation = JCAL_PI;
    if (self->has_previous) {
        const float same1 = jcal_sphere_angle(axes->j[0], self->previous.j[0]);
        const float same2 = jcal_sphere_angle(axes->j[1], self->previous.j[1]);
        const float turned1 = JCAL_PI - same1;
        const float turned2 = JCAL_PI - same2;
        const bool keep = lesser(same1, same2) <= lesser(turned1, turned2);
        deviation = keep ? larger(same1, same2) : larger(turned1, turned2);
        const float sign = keep ? 1.0f : -1.0f;
        chosen.j[0] = jcal_vec3_scale(axes->j[0], sign);
        chosen.j[1] = jcal_vec3_scale(axes->j[1], sign);
    }
    self->previous = chosen;
    self->has_previous = true;
    return deviation;
}

void jcal_hinge_accept_update(jcal_hinge_accept_t *self, const jcal_hinge_window_config_t *cfg,
                              const jcal_hinge_axes_t *axes, const jcal_hinge_sums_t *sums)
{
    self->seqad_rad = sequential_deviation(self, axes);
    if (!(self->seqad_rad < cfg->accept_bound_rad)) {
        self->agreeing = 0u;
    } else if (self->agreeing < cfg->accept_count) {
        ++self->agreeing;
    } else {
        /* (68) holds for as long as needed. */
    }
    jcal_hinge_local_uncertainty(sums, self->local_rad);
    self->accepted = (larger(self->local_rad[0], self->local_rad[1]) < cfg->accept_bound_rad) &&
                     (self->agreeing >= cfg->accept_count);
}
