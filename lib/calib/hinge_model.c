/* SPDX-License-Identifier: MIT */
/// @file
/// The hinge constraint as a quadratic form in moments. See hinge_model.h for the equations.
#include "calib/hinge_model.h"

#include "calib/hinge_point.h"
#include "jointcal/vec3.h"
#include "math/sym.h"

/// Accelerometer features: a_1, -a_2 and the constant.
#define ACC_AXES 6u

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

static void store(jcal_vec3_t v, float scale, float *out)
{
    out[0] = scale * v.x;
    out[1] = scale * v.y;
    out[2] = scale * v.z;
}

void jcal_hinge_features(jcal_vec3_t w1, jcal_vec3_t w2, float z[JCAL_HINGE_FEATURES])
{
    products(w1, &z[JCAL_HINGE_Z_W1W1]);
    products(w2, &z[JCAL_HINGE_Z_W2W2]);
    store(w1, 1.0f, &z[JCAL_HINGE_Z_W1]);
    store(w2, 1.0f, &z[JCAL_HINGE_Z_W2]);
    z[JCAL_HINGE_Z_ONE] = 1.0f;
}

/// Coefficients of |(w - b) x j|^2 = w' (I - j j') w - 2 b . w + |b|^2 for b across j.
static void coefficients_of_sensor(const jcal_hinge_axis_t *axis, float sign, float *products_out, float *linear_out)
{
    const jcal_vec3_t j = axis->j;
    products_out[0] = sign * (1.0f - (j.x * j.x));
    products_out[1] = sign * (1.0f - (j.y * j.y));
    products_out[2] = sign * (1.0f - (j.z * j.z));
    products_out[3] = sign * (-2.0f * j.x * j.y);
    products_out[4] = sign * (-2.0f * j.x * j.z);
    products_out[5] = sign * (-2.0f * j.y * j.z);
    store(axis->bias, -2.0f * sign, linear_out);
}

void jcal_hinge_coefficients(const jcal_hinge_point_t *point, float f[JCAL_HINGE_FEATURES])
{
    coefficients_of_sensor(&point->axis1, 1.0f, &f[JCAL_HINGE_Z_W1W1], &f[JCAL_HINGE_Z_W1]);
    coefficients_of_sensor(&point->axis2, -1.0f, &f[JCAL_HINGE_Z_W2W2], &f[JCAL_HINGE_Z_W2]);
    f[JCAL_HINGE_Z_ONE] =
        jcal_vec3_dot(point->axis1.bias, point->axis1.bias) - jcal_vec3_dot(point->axis2.bias, point->axis2.bias);
}

/// Features of one sensor: its 6 products and its rate.
#define RUN 9u
#define PRODUCTS 6u

/// One column of the derivative of f: zero but for one sensor's features and the constant.
typedef struct {
    float run[RUN];
    float one;
} column_t;

/// Column of df/d(axis) along the tangent t: d(I - j j') = -(j t' + t j'), and the bias stays across j:
/// d(P b) = -j (t . b).
static column_t axis_column(const jcal_hinge_axis_t *axis, jcal_vec3_t t, float sign)
{
    const jcal_vec3_t j = axis->j;
    column_t column;
    column.run[0] = sign * (-2.0f * j.x * t.x);
    column.run[1] = sign * (-2.0f * j.y * t.y);
    column.run[2] = sign * (-2.0f * j.z * t.z);
    column.run[3] = sign * (-2.0f * ((j.x * t.y) + (j.y * t.x)));
    column.run[4] = sign * (-2.0f * ((j.x * t.z) + (j.z * t.x)));
    column.run[5] = sign * (-2.0f * ((j.y * t.z) + (j.z * t.y)));
    store(j, 2.0f * sign * jcal_vec3_dot(t, axis->bias), &column.run[PRODUCTS]);
    column.one = 0.0f;
    return column;
}

/// Column of df/d(bias) along the tangent t, for a bias counted in `unit`.
static column_t bias_column(const jcal_hinge_axis_t *axis, jcal_vec3_t t, float sign, float unit)
{
    column_t column = {{0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f}, 0.0f};
    store(t, -2.0f * sign * unit, &column.run[PRODUCTS]);
    column.one = 2.0f * sign * unit * jcal_vec3_dot(t, axis->bias);
    return column;
}

/// Sensor, 0 or 1, to which unknown r belongs, and whether it is a bias.
#define SENSOR_OF(r) (((r) / 2u) % 2u)
#define IS_BIAS(r) ((r) >= JCAL_HINGE_AXIS_UNKNOWNS)

/// The first n columns of the derivative of f: axis1 u, v; axis2 u, v; bias1 u, v; bias2 u, v.
static void derivative(const jcal_hinge_point_t *point, float bias_unit, unsigned n,
                       column_t columns[JCAL_HINGE_UNKNOWNS])
{
    for (unsigned r = 0u; r < n; ++r) {
        const jcal_hinge_axis_t *const axis = (SENSOR_OF(r) == 0u) ? &point->axis1 : &point->axis2;
        const float sign = (SENSOR_OF(r) == 0u) ? 1.0f : -1.0f;
        const jcal_vec3_t t = ((r % 2u) == 0u) ? axis->u : jcal_hinge_v(axis);
        columns[r] = IS_BIAS(r) ? bias_column(axis, t, sign, bias_unit) : axis_column(axis, t, sign);
    }
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
    store(point->axis1.j, 1.0f, &y[0]);
    store(point->axis2.j, 1.0f, &y[3]);
}

/// Prior weight of the constant c = j1 . b_a1 - j2 . b_a2 in the units of the normalised cost.
static float acc_prior(float acc_bias_m_s2)
{
    return 1.0f / (2.0f * acc_bias_m_s2 * acc_bias_m_s2);
}

float jcal_hinge_cost_gyr(const jcal_hinge_moments_t *moments, const jcal_hinge_point_t *point)
{
    float f[JCAL_HINGE_FEATURES];
    jcal_hinge_coefficients(point, f);
    return jcal_sym_quadratic(moments->gyr, JCAL_HINGE_FEATURES, f);
}

float jcal_hinge_cost_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point)
{
    float y[ACC_AXES];
    float ay[ACC_AXES];
    acc_unknowns(point, y);
    acc_times(moments, acc_prior(cfg->acc_bias_m_s2), y, ay);
    return dot(y, ay, ACC_AXES);
}

/// Adds the accelerometer part; it does not depend on the gyroscope biases.
static void linearise_acc(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point, jcal_hinge_lin_t *out)
{
    const float prior = acc_prior(cfg->acc_bias_m_s2);
    float columns[JCAL_HINGE_AXIS_UNKNOWNS][ACC_AXES] = {{0.0f}};
    store(point->axis1.u, 1.0f, &columns[0][0]);
    store(jcal_hinge_v(&point->axis1), 1.0f, &columns[1][0]);
    store(point->axis2.u, 1.0f, &columns[2][3]);
    store(jcal_hinge_v(&point->axis2), 1.0f, &columns[3][3]);
    float y[ACC_AXES];
    float ay[ACC_AXES];
    acc_unknowns(point, y);
    acc_times(moments, prior, y, ay);
    out->cost_acc = dot(y, ay, ACC_AXES);
    for (unsigned r = 0u; r < JCAL_HINGE_AXIS_UNKNOWNS; ++r) {
        float at[ACC_AXES];
        acc_times(moments, prior, columns[r], at);
        out->gradient[r] += dot(columns[r], ay, ACC_AXES);
        for (unsigned c = 0u; c <= r; ++c) {
            out->matrix_acc[jcal_sym_at(r, c)] = dot(columns[c], at, ACC_AXES);
            out->matrix[jcal_sym_at(r, c)] += out->matrix_acc[jcal_sym_at(r, c)];
        }
    }
}

/// Where the features of a sensor start.
static size_t start_of(unsigned sensor)
{
    return (sensor == 0u) ? JCAL_HINGE_Z_W1W1 : JCAL_HINGE_Z_W2W2;
}

/// mt <- the elements of M times column r that columns 0 .. r need.
static void times_column(const jcal_hinge_moments_t *moments, const column_t *column, unsigned r,
                         float mt[JCAL_HINGE_FEATURES])
{
    const size_t start = start_of(SENSOR_OF(r));
    const size_t rows = IS_BIAS(r) ? JCAL_HINGE_FEATURES : (start + RUN);
    for (size_t i = 0u; i < rows; ++i) {
        mt[i] = 0.0f;
    }
    const jcal_sym_run_t whole = {start, RUN, column->run};
    const jcal_sym_run_t linear = {start + PRODUCTS, RUN - PRODUCTS, &column->run[PRODUCTS]};
    const jcal_sym_run_t one = {JCAL_HINGE_Z_ONE, 1u, &column->one};
    if (IS_BIAS(r)) {
        jcal_sym_add_run(moments->gyr, rows, &linear, mt);
        jcal_sym_add_run(moments->gyr, rows, &one, mt);
    } else {
        jcal_sym_add_run(moments->gyr, rows, &whole, mt);
    }
}

/// Column c times a vector (19).
static float column_dot(const column_t *column, unsigned c, const float y[JCAL_HINGE_FEATURES])
{
    const float *const run = &y[start_of(SENSOR_OF(c))];
    return IS_BIAS(c)
               ? (dot(&column->run[PRODUCTS], &run[PRODUCTS], RUN - PRODUCTS) + (column->one * y[JCAL_HINGE_Z_ONE]))
               : dot(column->run, run, RUN);
}

/// Biases are counted in units of their standard deviation, so their prior is the identity.
static void add_bias_prior(float unit, const jcal_hinge_point_t *point, jcal_hinge_lin_t *out)
{
    const jcal_hinge_axis_t *const axes[2] = {&point->axis1, &point->axis2};
    for (unsigned sensor = 0u; sensor < 2u; ++sensor) {
        const unsigned r = JCAL_HINGE_AXIS_UNKNOWNS + (2u * sensor);
        out->gradient[r] += jcal_vec3_dot(axes[sensor]->bias, axes[sensor]->u) / unit;
        out->gradient[r + 1u] += jcal_vec3_dot(axes[sensor]->bias, jcal_hinge_v(axes[sensor])) / unit;
        out->matrix[jcal_sym_at(r, r)] += 1.0f;
        out->matrix[jcal_sym_at(r + 1u, r + 1u)] += 1.0f;
    }
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

void jcal_hinge_linearise(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                          const jcal_hinge_point_t *point, unsigned n, jcal_hinge_lin_t *out)
{
    float f[JCAL_HINGE_FEATURES];
    float mf[JCAL_HINGE_FEATURES];
    column_t columns[JCAL_HINGE_UNKNOWNS];
    jcal_hinge_coefficients(point, f);
    jcal_sym_times(moments->gyr, JCAL_HINGE_FEATURES, f, mf);
    out->cost_gyr = dot(f, mf, JCAL_HINGE_FEATURES);
    derivative(point, cfg->gyr_bias_rad_s, n, columns);
    for (unsigned r = 0u; r < n; ++r) {
        float mt[JCAL_HINGE_FEATURES];
        times_column(moments, &columns[r], r, mt);
        out->gradient[r] = column_dot(&columns[r], r, mf);
        for (unsigned c = 0u; c <= r; ++c) {
            out->matrix[jcal_sym_at(r, c)] = column_dot(&columns[c], c, mt);
        }
    }
    linearise_acc(moments, cfg, point, out);
    if (n > JCAL_HINGE_AXIS_UNKNOWNS) {
        add_bias_prior(cfg->gyr_bias_rad_s, point, out);
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
    acc_times(moments, acc_prior(cfg->acc_bias_m_s2), y, sum);
    const float unit = 1.0f / (cfg->gyr_bias_rad_s * cfg->gyr_bias_rad_s);
    const float of_biases =
        jcal_vec3_dot(to->axis1.bias, to->axis1.bias) - jcal_vec3_dot(from->axis1.bias, from->axis1.bias) +
        jcal_vec3_dot(to->axis2.bias, to->axis2.bias) - jcal_vec3_dot(from->axis2.bias, from->axis2.bias);
    return jcal_sym_bilinear(moments->gyr, JCAL_HINGE_FEATURES, f, g) + dot(x, sum, ACC_AXES) + (unit * of_biases);
}

float jcal_hinge_acc_constant(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                              const jcal_hinge_point_t *point)
{
    float y[ACC_AXES];
    acc_unknowns(point, y);
    const float *const sums = &moments->acc[JCAL_SYM_SIZE(ACC_AXES)];
    return dot(sums, y, ACC_AXES) / (sums[ACC_AXES] + acc_prior(cfg->acc_bias_m_s2));
}
