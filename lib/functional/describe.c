/* SPDX-License-Identifier: MIT */
/// @file
/// What the sums say of the joint. See functional/describe.h.
#include "functional/describe.h"

#include "functional/model.h"
#include "jointcal/vec3.h"
#include "math/eig3.h"
#include "math/scalar.h"

#include <float.h>
#include <math.h>

/// trace of a packed 3 x 3.
static float trace3(const float *m)
{
    return m[0] + m[2] + m[5];
}

/// j' M j of sum (w w') = tr(A) / 2 I - A, A packed.
static float along_of(const float *a, jcal_vec3_t j)
{
    const float inside = (a[0] * j.x * j.x) + (a[2] * j.y * j.y) + (a[5] * j.z * j.z) +
                         (2.0f * ((a[1] * j.x * j.y) + (a[3] * j.x * j.z) + (a[4] * j.y * j.z)));
    return (0.5f * trace3(a)) - inside;
}

/// How far the joint bent: from X of the orientations, the sum of the two smaller singular values of which is what bending leaves.
static float bend_of(const float *x, float along, float motion_s)
{
    const jcal_vec3_t a = {x[0], x[1], x[2]};
    const jcal_vec3_t b = {x[3], x[4], x[5]};
    const jcal_vec3_t c = {x[6], x[7], x[8]};
    const float squares = jcal_vec3_dot(a, a) + jcal_vec3_dot(b, b) + jcal_vec3_dot(c, c);
    const float product = fabsf(jcal_vec3_dot(a, jcal_vec3_cross(b, c))) / jcal_max(along, FLT_MIN);
    const float both = sqrtf(jcal_max(squares - (along * along) + (2.0f * product), 0.0f));
    return sqrtf(jcal_max(2.0f - (both / jcal_max(motion_s, FLT_MIN)), 0.0f));
}

void jcal_functional_describe(jcal_functional_t *self, const jcal_functional_cross_t *x)
{
    const jcal_functional_sums_t *const sums = &self->sums;
    const jcal_vec3_t j1 = self->point.j1;
    const jcal_vec3_t j2 = self->point.j2;
    const float across = 2.0f * jcal_max(sums->rate2, FLT_MIN) * jcal_functional_rate_size(sums, x->rate, j1, j2);
    const float along =
        along_of(sums->rate1, j1) + along_of(sums->rate2nd, j2) - (2.0f * jcal_functional_between(sums->along, j1, j2));
    self->verdict.share = along / jcal_max(along + jcal_max(across, 0.0f), FLT_MIN);
    self->verdict.bend_rad = bend_of(x->turn, jcal_functional_between(x->turn, j1, j2), sums->motion_s);
}

void jcal_functional_stiffness(jcal_functional_t *self)
{
    const jcal_functional_sums_t *const sums = &self->sums;
    const float rate1 = 0.5f * trace3(sums->rate1);
    const float rate2 = 0.5f * trace3(sums->rate2nd);
    self->verdict.stiffness =
        (rate1 + rate2 - (2.0f * jcal_eig3_alignment(sums->along))) / jcal_max(jcal_min(rate1, rate2), FLT_MIN);
}
