/* SPDX-License-Identifier: MIT */
/// @file
/// The hinge constraint as a quadratic form in moments. See hinge/model.h for the equations.
#include "hinge/model.h"

#include "hinge/point.h"
#include "jointcal/vec3.h"
#include "math/block.h"
#include "math/sym.h"

/// Accelerometer features: a_1, -a_2 and the constant.
#define ACC_AXES 6u

/// Products of a vector with itself.
#define PRODUCTS 6u

/// The six products of a vector with itself, in the order xx, yy, zz, xy, xz, yz.
static void products(jcal_vec3_t w, float *out)
{
    out[0] = w.x * w.x;
    out[1] = w.y * w.y;
    out[2] = w.z * w.z;
    out[3] = w.x * w.y;
    out[4] = w.x * w.z;
    out[5] = w.y * w.z;
}

void jcal_hinge_features(jcal_vec3_t w1, jcal_vec3_t w2, float z[JCAL_HINGE_FEATURES])
{
    products(w1, &z[JCAL_HINGE_Z_W1W1]);
    products(w2, &z[JCAL_HINGE_Z_W2W2]);
}

/// Coefficients of |w x j|^2 = w' (I - j j') w.
static void coefficients_of_sensor(jcal_vec3_t j, float sign, float *out)
{
    out[0] = sign * (1.0f - (j.x * j.x));
    out[1] = sign * (1.0f - (j.y * j.y));
    out[2] = sign * (1.0f - (j.z * j.z));
    out[3] = sign * (-2.0f * j.x * j.y);
    out[4] = sign * (-2.0f * j.x * j.z);
    out[5] = sign * (-2.0f * j.y * j.z);
}

void jcal_hinge_coefficients(const jcal_hinge_point_t *point, float f[JCAL_HINGE_FEATURES])
{
    coefficients_of_sensor(point->axis1.j, 1.0f, &f[JCAL_HINGE_Z_W1W1]);
    coefficients_of_sensor(point->axis2.j, -1.0f, &f[JCAL_HINGE_Z_W2W2]);
}

/// One column of the derivative of f: the axis moves along the tangent t, d(I - j j') = -(j t' + t j'). It is zero but for
/// the six features of one sensor.
static void column_along(jcal_vec3_t j, jcal_vec3_t t, float sign, float column[PRODUCTS])
{
    column[0] = sign * (-2.0f * j.x * t.x);
    column[1] = sign * (-2.0f * j.y * t.y);
    column[2] = sign * (-2.0f * j.z * t.z);
    column[3] = sign * (-2.0f * ((j.x * t.y) + (j.y * t.x)));
    column[4] = sign * (-2.0f * ((j.x * t.z) + (j.z * t.x)));
    column[5] = sign * (-2.0f * ((j.y * t.z) + (j.z * t.y)));
}

/// Prior weight of the constant c = j1 . b_a1 - j2 . b_a2 in the units of the normalised cost.
static float acc_prior(const jcal_hinge_config_t *cfg)
{
    return 1.0f / (2.0f * cfg->acc_bias_m_s2 * cfg->acc_bias_m_s2);
}

/// out (12) <- M f.
static void gyr_times(const jcal_hinge_moments_t *moments, const float f[JCAL_HINGE_FEATURES],
                      float out[JCAL_HINGE_FEATURES])
{
    float own[PRODUCTS];
    jcal_block_diagonal6(moments->gyr, JCAL_HINGE_Z_W1W1, &f[JCAL_HINGE_Z_W1W1], &out[JCAL_HINGE_Z_W1W1]);
    jcal_block_add_above6(moments->gyr, &f[JCAL_HINGE_Z_W2W2], &out[JCAL_HINGE_Z_W1W1]);
    jcal_block_diagonal6(moments->gyr, JCAL_HINGE_Z_W2W2, &f[JCAL_HINGE_Z_W2W2], own);
    jcal_block_below6(moments->gyr, &f[JCAL_HINGE_Z_W1W1], &out[JCAL_HINGE_Z_W2W2]);
    jcal_add6(&out[JCAL_HINGE_Z_W2W2], 1.0f, own);
}

static float dot12(const float *a, const float *b)
{
    return jcal_dot6(a, b) + jcal_dot6(&a[PRODUCTS], &b[PRODUCTS]);
}

float jcal_hinge_cost_gyr(const jcal_hinge_moments_t *moments, const jcal_hinge_point_t *point)
{
    float f[JCAL_HINGE_FEATURES];
    float mf[JCAL_HINGE_FEATURES];
    jcal_hinge_coefficients(point, f);
    gyr_times(moments, f, mf);
    return dot12(f, mf);
}

float jcal_hinge_cost_gyr_alone(const jcal_hinge_moments_t *moments)
{
    const float f[JCAL_HINGE_FEATURES] = {1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f, -1.0f, -1.0f, -1.0f, 0.0f, 0.0f, 0.0f};
    float mf[JCAL_HINGE_FEATURES];
    gyr_times(moments, f, mf);
    return dot12(f, mf);
}

/// Two 3-vectors, one per sensor.
typedef struct {
    jcal_vec3_t of1, of2;
} both_t;

static float dot_both(const both_t *a, const both_t *b)
{
    return jcal_vec3_dot(a->of1, b->of1) + jcal_vec3_dot(a->of2, b->of2);
}

static both_t axes_of(const jcal_hinge_point_t *point)
{
    const both_t axes = {point->axis1.j, point->axis2.j};
    return axes;
}

static both_t acc_sums(const jcal_hinge_moments_t *moments)
{
    const float *const sums = jcal_block_row(moments->acc, ACC_AXES, 0u);
    const both_t out = {{sums[0], sums[1], sums[2]}, {sums[3], sums[4], sums[5]}};
    return out;
}

/// 1 / (n + prior): weighs s s' where the constant c is eliminated.
static float acc_share(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg)
{
    return 1.0f / (moments->acc[jcal_sym_at(ACC_AXES, ACC_AXES)] + acc_prior(cfg));
}

/// A y with A = S - s s' / (n + prior): the second moments with the constant c eliminated.
static both_t acc_times(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg, const both_t *y)
{
    const both_t sums = acc_sums(moments);
    const float c = acc_share(moments, cfg) * dot_both(&sums, y);
    const float *const m = moments->acc;
    both_t out;
    out.of1 = jcal_vec3_add(jcal_block_diagonal3(m, 0u, y->of1), jcal_block_above3(m, y->of2));
    out.of2 = jcal_vec3_add(jcal_block_below3(m, y->of1), jcal_block_diagonal3(m, 3u, y->of2));
    out.of1 = jcal_vec3_sub(out.of1, jcal_vec3_scale(sums.of1, c));
    out.of2 = jcal_vec3_sub(out.of2, jcal_vec3_scale(sums.of2, c));
    return out;
}

float jcal_hinge_cost_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point)
{
    const both_t y = axes_of(point);
    const both_t ay = acc_times(moments, cfg, &y);
    return dot_both(&y, &ay);
}

float jcal_hinge_cost(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                      const jcal_hinge_point_t *point)
{
    return jcal_hinge_cost_gyr(moments, point) + jcal_hinge_cost_acc(moments, cfg, point);
}

/// Adds the accelerometer part to what the gyroscope part has put there, or to zeros. Tangent directions concern one sensor each,
/// so that half of every product with A drops out.
static void add_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                    const jcal_hinge_point_t *point, jcal_hinge_lin_t *out)
{
    const float *const m = moments->acc;
    const jcal_vec3_t t1[2] = {point->axis1.u, jcal_hinge_v(&point->axis1)};
    const jcal_vec3_t t2[2] = {point->axis2.u, jcal_hinge_v(&point->axis2)};
    const both_t y = axes_of(point);
    const both_t ay = acc_times(moments, cfg, &y);
    const both_t sums = acc_sums(moments);
    const float share = acc_share(moments, cfg);
    const float s1[2] = {jcal_vec3_dot(sums.of1, t1[0]), jcal_vec3_dot(sums.of1, t1[1])};
    const float s2[2] = {jcal_vec3_dot(sums.of2, t2[0]), jcal_vec3_dot(sums.of2, t2[1])};
    out->cost_acc = dot_both(&y, &ay);
    for (unsigned r = 0u; r < 2u; ++r) {
        const jcal_vec3_t own1 = jcal_block_diagonal3(m, 0u, t1[r]);
        const jcal_vec3_t own2 = jcal_block_diagonal3(m, 3u, t2[r]);
        const jcal_vec3_t across = jcal_block_below3(m, t1[r]);
        out->gradient[r] += jcal_vec3_dot(t1[r], ay.of1);
        out->gradient[2u + r] += jcal_vec3_dot(t2[r], ay.of2);
        for (unsigned c = 0u; c < 2u; ++c) {
            if (c <= r) {
                out->matrix[jcal_sym_at(r, c)] += jcal_vec3_dot(t1[c], own1) - (share * s1[r] * s1[c]);
                out->matrix[jcal_sym_at(2u + r, 2u + c)] += jcal_vec3_dot(t2[c], own2) - (share * s2[r] * s2[c]);
            }
            out->matrix[jcal_sym_at(2u + c, r)] += jcal_vec3_dot(t2[c], across) - (share * s1[r] * s2[c]);
        }
    }
}

void jcal_hinge_linearise_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                              const jcal_hinge_point_t *point, jcal_hinge_lin_t *out)
{
    *out = (jcal_hinge_lin_t){0};
    add_acc(moments, cfg, point, out);
}

void jcal_hinge_linearise(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point, jcal_hinge_lin_t *out)
{
    float f[JCAL_HINGE_FEATURES];
    float mf[JCAL_HINGE_FEATURES];
    float columns[JCAL_HINGE_TILTS][PRODUCTS];
    jcal_hinge_coefficients(point, f);
    gyr_times(moments, f, mf);
    out->cost_gyr = dot12(f, mf);
    column_along(point->axis1.j, point->axis1.u, 1.0f, columns[0]);
    column_along(point->axis1.j, jcal_hinge_v(&point->axis1), 1.0f, columns[1]);
    column_along(point->axis2.j, point->axis2.u, -1.0f, columns[2]);
    column_along(point->axis2.j, jcal_hinge_v(&point->axis2), -1.0f, columns[3]);
    for (unsigned r = 0u; r < JCAL_HINGE_TILTS; ++r) {
        const unsigned first = (r < 2u) ? 0u : 2u;
        const unsigned start = (r < 2u) ? JCAL_HINGE_Z_W1W1 : JCAL_HINGE_Z_W2W2;
        float product[PRODUCTS];
        out->gradient[r] = jcal_dot6(columns[r], &mf[start]);
        jcal_block_diagonal6(moments->gyr, start, columns[r], product);
        for (unsigned c = first; c <= r; ++c) {
            out->matrix[jcal_sym_at(r, c)] = jcal_dot6(columns[c], product);
        }
    }
    for (unsigned c = 0u; c < 2u; ++c) {
        float product[PRODUCTS];
        jcal_block_below6(moments->gyr, columns[c], product);
        out->matrix[jcal_sym_at(2u, c)] = jcal_dot6(columns[2], product);
        out->matrix[jcal_sym_at(3u, c)] = jcal_dot6(columns[3], product);
    }
    add_acc(moments, cfg, point, out);
}

/// (f' - f)' M (f' + f) for the two parts, so that nothing is lost when both costs are large and nearly equal.
float jcal_hinge_change(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                        const jcal_hinge_point_t *from, const jcal_hinge_point_t *to)
{
    float f[JCAL_HINGE_FEATURES];
    float g[JCAL_HINGE_FEATURES];
    float sum[JCAL_HINGE_FEATURES];
    jcal_hinge_coefficients(from, f);
    jcal_hinge_coefficients(to, g);
    for (unsigned i = 0u; i < JCAL_HINGE_FEATURES; ++i) {
        const float first = f[i];
        f[i] = g[i] + first;
        g[i] -= first;
    }
    gyr_times(moments, f, sum);
    const both_t both = {jcal_vec3_add(from->axis1.j, to->axis1.j), jcal_vec3_add(from->axis2.j, to->axis2.j)};
    const both_t apart = {jcal_vec3_sub(to->axis1.j, from->axis1.j), jcal_vec3_sub(to->axis2.j, from->axis2.j)};
    const both_t sum_acc = acc_times(moments, cfg, &both);
    return dot12(g, sum) + dot_both(&apart, &sum_acc);
}

float jcal_hinge_acc_constant(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                              const jcal_hinge_point_t *point)
{
    const both_t y = axes_of(point);
    const both_t sums = acc_sums(moments);
    return acc_share(moments, cfg) * dot_both(&sums, &y);
}
