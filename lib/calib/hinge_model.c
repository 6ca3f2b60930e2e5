/* SPDX-License-Identifier: MIT */
/// @file
/// The hinge constraint as a quadratic form in moments. See hinge_model.h for the equations.
#include "calib/hinge_model.h"

#include "calib/hinge_point.h"
#include "jointcal/vec3.h"
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

static void store(jcal_vec3_t v, float *out)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
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

static float dot(const float *a, const float *b, unsigned n)
{
    float sum = 0.0f;
    for (unsigned i = 0u; i < n; ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

/// out (6) <- A y with A = S - s s' / (n + prior): the second moments with the constant c eliminated.
static void acc_times(const jcal_hinge_moments_t *moments, float prior, const float y[ACC_AXES], float out[ACC_AXES])
{
    jcal_sym_times(moments->acc, ACC_AXES, y, out);
    const float *const sums = &moments->acc[JCAL_SYM_SIZE(ACC_AXES)];
    const float c = dot(sums, y, ACC_AXES) / (sums[ACC_AXES] + prior);
    for (unsigned i = 0u; i < ACC_AXES; ++i) {
        out[i] -= sums[i] * c;
    }
}

static void acc_unknowns(const jcal_hinge_point_t *point, float y[ACC_AXES])
{
    store(point->axis1.j, &y[0]);
    store(point->axis2.j, &y[3]);
}

/// Prior weight of the constant c = j1 . b_a1 - j2 . b_a2 in the units of the normalised cost.
static float acc_prior(const jcal_hinge_config_t *cfg)
{
    return 1.0f / (2.0f * cfg->acc_bias_m_s2 * cfg->acc_bias_m_s2);
}

float jcal_hinge_cost_gyr(const jcal_hinge_moments_t *moments, const jcal_hinge_point_t *point)
{
    float f[JCAL_HINGE_FEATURES];
    jcal_hinge_coefficients(point, f);
    return jcal_sym_quadratic(moments->gyr, JCAL_HINGE_FEATURES, f);
}

float jcal_hinge_cost_gyr_alone(const jcal_hinge_moments_t *moments)
{
    const float f[JCAL_HINGE_FEATURES] = {1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f, -1.0f, -1.0f, -1.0f, 0.0f, 0.0f, 0.0f};
    return jcal_sym_quadratic(moments->gyr, JCAL_HINGE_FEATURES, f);
}

float jcal_hinge_cost_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point)
{
    float y[ACC_AXES];
    float ay[ACC_AXES];
    acc_unknowns(point, y);
    acc_times(moments, acc_prior(cfg), y, ay);
    return dot(y, ay, ACC_AXES);
}

float jcal_hinge_cost(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                      const jcal_hinge_point_t *point)
{
    return jcal_hinge_cost_gyr(moments, point) + jcal_hinge_cost_acc(moments, cfg, point);
}

static void add_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                    const jcal_hinge_point_t *point, jcal_hinge_lin_t *out)
{
    const float prior = acc_prior(cfg);
    float columns[JCAL_HINGE_TILTS][ACC_AXES] = {{0.0f}};
    store(point->axis1.u, &columns[0][0]);
    store(jcal_hinge_v(&point->axis1), &columns[1][0]);
    store(point->axis2.u, &columns[2][3]);
    store(jcal_hinge_v(&point->axis2), &columns[3][3]);
    float y[ACC_AXES];
    float ay[ACC_AXES];
    acc_unknowns(point, y);
    acc_times(moments, prior, y, ay);
    out->cost_acc = dot(y, ay, ACC_AXES);
    for (unsigned r = 0u; r < JCAL_HINGE_TILTS; ++r) {
        float at[ACC_AXES];
        acc_times(moments, prior, columns[r], at);
        out->gradient[r] += dot(columns[r], ay, ACC_AXES);
        for (unsigned c = 0u; c <= r; ++c) {
            out->matrix[jcal_sym_at(r, c)] += dot(columns[c], at, ACC_AXES);
        }
    }
}

void jcal_hinge_linearise_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                              const jcal_hinge_point_t *point, jcal_hinge_lin_t *out)
{
    *out = (jcal_hinge_lin_t){0};
    add_acc(moments, cfg, point, out);
}

/// Sensor, 0 or 1, to which unknown r belongs, and where its features start.
#define SENSOR_OF(r) ((r) / 2u)
#define START_OF(r) ((SENSOR_OF(r) == 0u) ? JCAL_HINGE_Z_W1W1 : JCAL_HINGE_Z_W2W2)

void jcal_hinge_linearise(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point, jcal_hinge_lin_t *out)
{
    float f[JCAL_HINGE_FEATURES];
    float mf[JCAL_HINGE_FEATURES];
    float columns[JCAL_HINGE_TILTS][PRODUCTS];
    *out = (jcal_hinge_lin_t){0};
    jcal_hinge_coefficients(point, f);
    jcal_sym_times(moments->gyr, JCAL_HINGE_FEATURES, f, mf);
    out->cost_gyr = dot(f, mf, JCAL_HINGE_FEATURES);
    column_along(point->axis1.j, point->axis1.u, 1.0f, columns[0]);
    column_along(point->axis1.j, jcal_hinge_v(&point->axis1), 1.0f, columns[1]);
    column_along(point->axis2.j, point->axis2.u, -1.0f, columns[2]);
    column_along(point->axis2.j, jcal_hinge_v(&point->axis2), -1.0f, columns[3]);
    for (unsigned r = 0u; r < JCAL_HINGE_TILTS; ++r) {
        float mt[JCAL_HINGE_FEATURES] = {0.0f};
        const jcal_sym_run_t run = {START_OF(r), PRODUCTS, columns[r]};
        jcal_sym_add_run(moments->gyr, JCAL_HINGE_FEATURES, &run, mt);
        out->gradient[r] = dot(columns[r], &mf[START_OF(r)], PRODUCTS);
        for (unsigned c = 0u; c <= r; ++c) {
            out->matrix[jcal_sym_at(r, c)] = dot(columns[c], &mt[START_OF(c)], PRODUCTS);
        }
    }
    add_acc(moments, cfg, point, out);
}

/// (a, b) <- (a + b, b - a).
static void split(float *a, float *b, unsigned n)
{
    for (unsigned i = 0u; i < n; ++i) {
        const float first = a[i];
        a[i] = first + b[i];
        b[i] -= first;
    }
}

/// (f' - f)' M (f' + f) for the two parts, so that nothing is lost when both costs are large and nearly equal.
float jcal_hinge_change(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                        const jcal_hinge_point_t *from, const jcal_hinge_point_t *to)
{
    float f[JCAL_HINGE_FEATURES];
    float g[JCAL_HINGE_FEATURES];
    jcal_hinge_coefficients(from, f);
    jcal_hinge_coefficients(to, g);
    split(f, g, JCAL_HINGE_FEATURES);
    float y[ACC_AXES];
    float x[ACC_AXES];
    float sum[ACC_AXES];
    acc_unknowns(from, y);
    acc_unknowns(to, x);
    split(y, x, ACC_AXES);
    acc_times(moments, acc_prior(cfg), y, sum);
    return jcal_sym_bilinear(moments->gyr, JCAL_HINGE_FEATURES, f, g) + dot(x, sum, ACC_AXES);
}

float jcal_hinge_acc_constant(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                              const jcal_hinge_point_t *point)
{
    float y[ACC_AXES];
    acc_unknowns(point, y);
    const float *const sums = &moments->acc[JCAL_SYM_SIZE(ACC_AXES)];
    return dot(sums, y, ACC_AXES) / (sums[ACC_AXES] + acc_prior(cfg));
}
