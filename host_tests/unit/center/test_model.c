/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of center/model.h and center/sums.h against direct evaluation and finite differences in double precision.
#include "center/model.h"
#include "center/sums.h"
#include "jointcal/vec3.h"
#include "math/plane.h"
#include "math/sym.h"
#include "unit/center/motion.h"

#include <string.h>
#include <unity.h>

#define SAMPLES 60u
#define READING_S 0.1

static jcal_kinematic_t samples[SAMPLES];
static const double anywhere[12] = {-0.1, 0.04, 0.03, 0.05, 0.12, -0.06, 0.1, -0.2, 0.15, -0.05, 0.12, 0.3};

void setUp(void)
{
    center_motion_t m = center_lively(2);
    m.noise = 0.3; /* residuals of some size */
    const jcal_kinematics_config_t cfg = {JCAL_DERIVATIVE_FIVE_POINT, 0.08f};
    jcal_kinematics_t chain;
    jcal_kinematics_begin(&chain);
    uint32_t k = 0;
    for (unsigned n = 0; n < SAMPLES; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        if (jcal_kinematics_put(&chain, &cfg, &pair, NULL, &samples[n])) {
            ++n;
        }
    }
}

void tearDown(void)
{
}

static jcal_center_point_t point_of(const double *x)
{
    const jcal_center_point_t p = {{{(float)x[0], (float)x[1], (float)x[2]}, {(float)x[3], (float)x[4], (float)x[5]}},
                                   {(float)x[6], (float)x[7], (float)x[8]},
                                   {(float)x[9], (float)x[10], (float)x[11]},
                                   {1.0f, 0.0f},
                                   false};
    return p;
}

/* a - T b - K r in double. */
static void remaining(const jcal_segment_t *body, const double *r, const double *b, double *v)
{
    v[0] = (double)body->a.x;
    v[1] = (double)body->a.y;
    v[2] = (double)body->a.z;
    for (int i = 0; i < 3; ++i) {
        v[0] -= (double)body->k[i].x * r[i] + (double)body->turn[i].x * b[i];
        v[1] -= (double)body->k[i].y * r[i] + (double)body->turn[i].y * b[i];
        v[2] -= (double)body->k[i].z * r[i] + (double)body->turn[i].z * b[i];
    }
}

static double square_of(const double *v)
{
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/* (16) of [OLS17] in double. */
static double residual_of(const jcal_kinematic_t *s, const double *x)
{
    double v1[3];
    double v2[3];
    remaining(&s->body1, &x[0], &x[6], v1);
    remaining(&s->body2, &x[3], &x[9], v2);
    return sqrt(square_of(v1)) - sqrt(square_of(v2));
}

static double squared_form(const jcal_kinematic_t *s, const double *x)
{
    const double none[3] = {0.0, 0.0, 0.0};
    double v1[3];
    double v2[3];
    remaining(&s->body1, &x[0], none, v1);
    remaining(&s->body2, &x[3], none, v2);
    return square_of(v1) - square_of(v2);
}

static void features_times_monomials_are_the_squared_form(void)
{
    const jcal_center_point_t p = point_of(anywhere);
    float phi[JCAL_CENTER_FEATURES];
    jcal_center_monomials(&p.place, phi);
    for (unsigned n = 0; n < SAMPLES; ++n) {
        float f[JCAL_CENTER_FEATURES];
        jcal_center_features(&samples[n], f);
        double sum = 0.0;
        for (unsigned i = 0; i < JCAL_CENTER_FEATURES; ++i) {
            sum += (double)f[i] * (double)phi[i];
        }
        TEST_ASSERT_TRUE(fabs(sum - squared_form(&samples[n], anywhere)) <
                         2e-4 * square_of((double[3]){9.81, 3.0, 3.0}));
    }
}

/* Sum of the squared form's squares. */
static double total(const double *x)
{
    double sum = 0.0;
    for (unsigned n = 0; n < SAMPLES; ++n) {
        const double e = squared_form(&samples[n], x);
        sum += e * e;
    }
    return sum;
}

/* A copy of `anywhere`, one of its elements moved. */
static void moved_place(unsigned i, double by, double *x)
{
    memcpy(x, anywhere, sizeof anywhere);
    x[i] += by;
}

/* Slope of one sample's squared form by an unknown. */
static double slope_of_form(const jcal_kinematic_t *sample, unsigned i)
{
    const double h = 1e-4;
    double up[12];
    double down[12];
    moved_place(i, h, up);
    moved_place(i, -h, down);
    return (squared_form(sample, up) - squared_form(sample, down)) / (2.0 * h);
}

static void sum_moments(float *moments)
{
    memset(moments, 0, JCAL_SYM_SIZE(JCAL_CENTER_FEATURES) * sizeof *moments);
    for (unsigned n = 0; n < SAMPLES; ++n) {
        float f[JCAL_CENTER_FEATURES];
        jcal_center_features(&samples[n], f);
        jcal_sym_rank1(moments, JCAL_CENTER_FEATURES, f, 1.0f);
    }
}

static void the_form_is_the_sum_over_samples_with_its_slope(void)
{
    float moments[JCAL_SYM_SIZE(JCAL_CENTER_FEATURES)];
    float gradient[6];
    const jcal_center_point_t p = point_of(anywhere);
    sum_moments(moments);
    const double cost = (double)jcal_center_form(moments, &p.place, gradient);
    TEST_ASSERT_TRUE(fabs(cost - total(anywhere)) < 1e-3 * total(anywhere));
    const double h = 1e-4;
    for (unsigned i = 0; i < 6u; ++i) {
        double up[12];
        double down[12];
        moved_place(i, h, up);
        moved_place(i, -h, down);
        const double half_slope = (total(up) - total(down)) / (4.0 * h);
        TEST_ASSERT_TRUE(fabs((double)gradient[i] - half_slope) < 2e-3 * (fabs(half_slope) + 0.1 * cost));
    }
}

static void the_forms_matrix_is_made_of_the_residuals_slopes(void)
{
    float moments[JCAL_SYM_SIZE(JCAL_CENTER_FEATURES)];
    float matrix[21];
    const jcal_center_point_t p = point_of(anywhere);
    sum_moments(moments);
    for (size_t row = 0u; row < 6u; ++row) {
        jcal_center_form_row(moments, &p.place, row, matrix);
    }
    for (unsigned i = 0; i < 6u; ++i) {
        for (unsigned j = 0; j <= i; ++j) {
            double product = 0.0;
            for (unsigned n = 0; n < SAMPLES; ++n) {
                product += slope_of_form(&samples[n], i) * slope_of_form(&samples[n], j);
            }
            const double scale = (double)(matrix[jcal_sym_at(i, i)] + matrix[jcal_sym_at(j, j)]);
            TEST_ASSERT_TRUE(fabs((double)matrix[jcal_sym_at(i, j)] - product) < 1e-3 * scale);
        }
    }
}

static void the_row_is_the_residuals_slope(void)
{
    const jcal_center_point_t p = point_of(anywhere);
    const double h = 1e-5;
    for (unsigned n = 0; n < SAMPLES; ++n) {
        jcal_center_residual_t r;
        TEST_ASSERT_TRUE(jcal_center_residual(&samples[n], &p, &r));
        TEST_ASSERT_TRUE(fabs((double)r.e - residual_of(&samples[n], anywhere)) < 1e-5);
        for (unsigned i = 0; i < JCAL_CENTER_UNKNOWNS; ++i) {
            double up[12];
            double down[12];
            memcpy(up, anywhere, sizeof up);
            memcpy(down, anywhere, sizeof down);
            up[i] += h;
            down[i] -= h;
            const double slope = (residual_of(&samples[n], up) - residual_of(&samples[n], down)) / (2.0 * h);
            TEST_ASSERT_TRUE(fabs((double)r.row[i] - slope) < 1e-3);
        }
        double apart[12];
        memcpy(apart, anywhere, sizeof apart);
        memset(apart, 0, 6 * sizeof apart[0]);
        TEST_ASSERT_TRUE(fabs((double)r.e_apart - residual_of(&samples[n], apart)) < 1e-5);
        double none[12] = {0.0};
        double turn2 = 0.0;
        for (unsigned body = 0; body < 2u; ++body) {
            const jcal_segment_t *const b = (body == 0u) ? &samples[n].body1 : &samples[n].body2;
            jcal_segment_t alone = *b;
            alone.a = jcal_vec3(0.0f, 0.0f, 0.0f);
            double v[3];
            remaining(&alone, &anywhere[3u * body], none, v);
            turn2 += square_of(v);
        }
        TEST_ASSERT_TRUE(fabs((double)r.turn2 - turn2) < 1e-4 * (1.0 + turn2));
    }
}

static void a_row_with_orientations_is_the_residuals_slope(void)
{
    const float h = 2e-3f;
    for (size_t n = 0u; n < SAMPLES; n += 7u) {
        for (unsigned part = 0u; part < JCAL_CENTER_PARTS; ++part) {
            jcal_center_point_t at = {.place = {{0.1f, -0.2f, 0.05f}, {-0.03f, 0.08f, 0.2f}}, .is_oriented = true};
            at.heading = jcal_plane_turn(0.3f * (float)(n + 1));
            jcal_center_residual_t r;
            jcal_center_residual_oriented(&samples[n], &at, part, &r);
            TEST_ASSERT_EQUAL_UINT(part, r.part);
            for (unsigned i = 0u; i < 7u; ++i) {
                float e[2];
                for (int side = 0; side < 2; ++side) {
                    const float d = (side == 0) ? -h : h;
                    jcal_center_point_t beside = at;
                    float *const places[6] = {&beside.place.r1.x, &beside.place.r1.y, &beside.place.r1.z,
                                              &beside.place.r2.x, &beside.place.r2.y, &beside.place.r2.z};
                    if (i < 6u) {
                        *places[i] += d;
                    } else {
                        beside.heading = jcal_plane_times(at.heading, jcal_plane_turn(d));
                    }
                    jcal_center_residual_t other;
                    jcal_center_residual_oriented(&samples[n], &beside, part, &other);
                    e[side] = other.e;
                }
                TEST_ASSERT_FLOAT_WITHIN(0.02f + 0.002f * fabsf(r.row[i]), r.row[i], (e[1] - e[0]) / (2.0f * h));
            }
            for (unsigned i = 7u; i < 12u; ++i) {
                TEST_ASSERT_EQUAL_FLOAT(0.0f, r.row[i]);
            }
        }
    }
}

static void the_heading_is_that_by_which_both_forces_agree(void)
{
    jcal_kinematic_t sample = samples[3];
    for (size_t i = 0u; i < 3u; ++i) { /* no turn: both feel the force at the joint */
        sample.body1.k[i] = jcal_vec3(0.0f, 0.0f, 0.0f);
        sample.body2.k[i] = sample.body1.k[i];
    }
    const jcal_center_place_t far_off = {{1.0f, 2.0f, 3.0f}, {4.0f, 5.0f, 6.0f}};
    sample.body2.a = jcal_vec3(2.0f, 1.0f, 9.0f);
    sample.body1.a = jcal_vec3(-1.0f, 2.0f, 9.0f); /* a quarter turn to the left */
    jcal_plane_t sum = {0.0f, 0.0f};
    jcal_center_add_heading(&sample, &far_off, &sum);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, sum.re);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 5.0f, sum.im);
}

static void free_fall_has_no_direction(void)
{
    jcal_kinematic_t s = samples[0];
    const jcal_center_point_t p = {0};
    jcal_center_residual_t r;
    s.body2.a = jcal_vec3(0.1f, 0.0f, 0.0f);
    TEST_ASSERT_FALSE(jcal_center_residual(&s, &p, &r));
    s = samples[0];
    s.body1.a.y = NAN;
    TEST_ASSERT_FALSE(jcal_center_residual(&s, &p, &r));
}

static jcal_center_sums_t summed(const jcal_center_config_t *cfg, const jcal_center_point_t *at)
{
    jcal_center_sums_t sums;
    jcal_center_sums_begin(&sums, &at->place);
    sums.point = *at;
    for (unsigned n = 0; n < SAMPLES; ++n) {
        jcal_center_residual_t r;
        TEST_ASSERT_TRUE(jcal_center_residual(&samples[n], &sums.point, &r));
        jcal_center_sums_add(&sums, cfg, &r, samples[n].dt_s);
        jcal_center_sums_advance(&sums, &samples[n]);
        (void)jcal_center_sums_close(&sums);
    }
    return sums;
}

/* The weight of a residual by the default config, in double. */
static double weight_of(unsigned n, const jcal_center_residual_t *r)
{
    return (double)samples[n].dt_s / READING_S / (0.0025 + 1e-4 * (double)r->turn2);
}

static void sums_are_weighted_sums_of_squares(void)
{
    const jcal_center_config_t cfg = jcal_center_config_default();
    const jcal_center_point_t p = point_of(anywhere);
    const jcal_center_sums_t sums = summed(&cfg, &p);
    double cost = 0.0;
    double apart = 0.0;
    double lagged = 0.0;
    double time_s = 0.0;
    double e[SAMPLES];
    for (unsigned n = 0; n < SAMPLES; ++n) {
        jcal_center_residual_t r;
        TEST_ASSERT_TRUE(jcal_center_residual(&samples[n], &p, &r));
        e[n] = (double)r.e;
        const double w = weight_of(n, &r);
        cost += w * e[n] * e[n];
        apart += w * (double)r.e_apart * (double)r.e_apart;
        lagged += (n >= 4u) ? (w * e[n] * e[n - 4u]) : 0.0;
        time_s += (double)samples[n].dt_s;
    }
    TEST_ASSERT_TRUE(fabs((double)sums.cost - cost) < 1e-4 * cost);
    TEST_ASSERT_TRUE(fabs((double)sums.raw - cost) < 1e-4 * cost);
    TEST_ASSERT_TRUE(fabs((double)sums.effect - apart) < 1e-4 * apart);
    TEST_ASSERT_TRUE(fabs((double)sums.lagged - lagged) < 1e-4 * cost);
    TEST_ASSERT_TRUE(fabs((double)sums.noise - time_s / READING_S) < 1e-4 * time_s / READING_S);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, sums.blocks); /* 60 samples of 20 ms */
}

static void sums_are_weighted_sums_of_rows(void)
{
    const jcal_center_config_t cfg = jcal_center_config_default();
    const jcal_center_point_t p = point_of(anywhere);
    const jcal_center_sums_t sums = summed(&cfg, &p);
    double gradient3 = 0.0;
    double matrix37 = 0.0;
    for (unsigned n = 0; n < SAMPLES; ++n) {
        jcal_center_residual_t r;
        TEST_ASSERT_TRUE(jcal_center_residual(&samples[n], &p, &r));
        gradient3 += weight_of(n, &r) * (double)r.e * (double)r.row[3];
        matrix37 += weight_of(n, &r) * (double)r.row[3] * (double)r.row[7];
    }
    TEST_ASSERT_TRUE(fabs((double)sums.gradient[3] - gradient3) < 1e-4 * fabs(gradient3));
    TEST_ASSERT_TRUE(fabs((double)sums.matrix[jcal_sym_at(3, 7)] - matrix37) < 1e-3 * fabs(matrix37));
}

static void absolute_differences_weigh_large_ones_less(void)
{
    jcal_center_config_t cfg = jcal_center_config_default();
    const jcal_center_point_t p = point_of(anywhere);
    cfg.method = JCAL_CENTER_SA;
    const jcal_center_sums_t sums = summed(&cfg, &p);
    double cost = 0.0;
    for (unsigned n = 0; n < SAMPLES; ++n) {
        jcal_center_residual_t r;
        TEST_ASSERT_TRUE(jcal_center_residual(&samples[n], &p, &r));
        const double usual = sqrt(0.0025 + 1e-4 * (double)r.turn2);
        const double e = fabs((double)r.e);
        cost += (double)samples[n].dt_s / READING_S * ((e > usual) ? (e / usual) : (e * e / (usual * usual)));
    }
    TEST_ASSERT_TRUE(fabs((double)sums.cost - cost) < 1e-4 * cost);
}

static void moving_the_estimate_is_summing_there(void)
{
    /* Near enough that rows hardly turn: 1 mm and 1 cm/s^2. */
    const jcal_center_config_t cfg = jcal_center_config_default();
    const jcal_center_point_t p = point_of(anywhere);
    jcal_center_sums_t sums = summed(&cfg, &p);
    double x[12];
    float d[12];
    for (unsigned i = 0; i < 12u; ++i) {
        d[i] = ((i < 6u) ? 0.001f : 0.01f) * (((i % 2u) == 0u) ? 1.0f : -1.0f);
        x[i] = anywhere[i] + (double)d[i];
    }
    jcal_center_sums_move(&sums, d);
    const jcal_center_point_t q = point_of(x);
    const jcal_center_sums_t there = summed(&cfg, &q);
    TEST_ASSERT_FLOAT_WITHIN(5e-3f * there.cost, there.cost, sums.cost);
    for (unsigned i = 0; i < 12u; ++i) {
        const float scale = sqrtf(there.matrix[jcal_sym_at(i, i)] * there.cost);
        TEST_ASSERT_FLOAT_WITHIN(0.01f * scale, there.gradient[i], sums.gradient[i]);
        const float spread = there.scatter[jcal_sym_at(i, i)];
        TEST_ASSERT_FLOAT_WITHIN(0.1f * spread + (0.01f * scale * scale), spread, sums.scatter[jcal_sym_at(i, i)]);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, q.place.r2.y, sums.point.place.r2.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, q.b2.z, sums.point.b2.z);
    TEST_ASSERT_EQUAL_FLOAT(p.place.r1.x, sums.anchor.r1.x + (sums.point.place.r1.x - q.place.r1.x));
}

static jcal_center_point_t oriented_point(float heading_rad)
{
    jcal_center_point_t at = {.place = {{0.1f, -0.2f, 0.05f}, {-0.03f, 0.08f, 0.2f}}, .is_oriented = true};
    at.heading.re = (float)cos((double)heading_rad);
    at.heading.im = (float)sin((double)heading_rad);
    return at;
}

/* Rz(heading) v in double. */
static void turn_about_z(double heading, const double *v, double *out)
{
    out[0] = cos(heading) * v[0] - sin(heading) * v[1];
    out[1] = sin(heading) * v[0] + cos(heading) * v[1];
    out[2] = v[2];
}

/* R1 (a1 - K1 r1) - Rz R2 (a2 - K2 r2) in double, `times` both vectors. */
static void vector_residual(const jcal_kinematic_t *s, const jcal_center_point_t *at, double heading, double times,
                            double *e)
{
    const jcal_center_place_t *const p = &at->place;
    const double none[3] = {0.0, 0.0, 0.0};
    const double r1[3] = {times * (double)p->r1.x, times * (double)p->r1.y, times * (double)p->r1.z};
    const double r2[3] = {times * (double)p->r2.x, times * (double)p->r2.y, times * (double)p->r2.z};
    double v1[3];
    double v2[3];
    double turned[3];
    remaining(&s->body1, r1, none, v1);
    remaining(&s->body2, r2, none, v2);
    turn_about_z(heading, v2, turned);
    for (int i = 0; i < 3; ++i) {
        e[i] = v1[i] - turned[i];
    }
}

static void residuals_with_orientations_are_differences_of_vectors(void)
{
    for (unsigned n = 0u; n < SAMPLES; n += 5u) {
        const float heading = 0.4f * (float)n;
        const jcal_center_point_t at = oriented_point(heading);
        double e[3];
        double apart[3];
        vector_residual(&samples[n], &at, (double)heading, 1.0, e);
        vector_residual(&samples[n], &at, (double)heading, 0.0, apart); /* both sensors on the joint */
        for (unsigned part = 0u; part < JCAL_CENTER_PARTS; ++part) {
            jcal_center_residual_t r;
            jcal_center_residual_oriented(&samples[n], &at, part, &r);
            TEST_ASSERT_TRUE(fabs((double)r.e - e[part]) < 1e-4);
            TEST_ASSERT_TRUE(fabs((double)r.e_apart - apart[part]) < 1e-4);
        }
    }
}

static void a_sample_with_orientations_is_the_mean_of_its_three_residuals(void)
{
    jcal_center_config_t cfg = jcal_center_config_default();
    cfg.method = JCAL_CENTER_LS;
    const float most[2] = {1e9f, 25.0f};
    for (int which = 0; which < 2; ++which) {
        const jcal_center_point_t at = oriented_point(0.7f);
        jcal_center_sums_t sums;
        jcal_center_sums_begin_oriented(&sums, &at.place, at.heading);
        double e[3];
        double expected = 0.0;
        jcal_center_residual_t r;
        jcal_center_residual_oriented(&samples[4], &at, 0u, &r);
        vector_residual(&samples[4], &at, (double)0.7f, 1.0, e);
        for (int part = 0; part < 3; ++part) {
            expected += fmin(e[part] * e[part] / (0.0025 + 1e-4 * (double)r.turn2), (double)most[which]) / 3.0;
        }
        const double square = (double)jcal_center_sums_take(&sums, &cfg, &samples[4], most[which]);
        TEST_ASSERT_TRUE(fabs(square - expected) < 1e-3 * expected);
        TEST_ASSERT_EQUAL_FLOAT(samples[4].dt_s, sums.time_s); /* once for all three */
        TEST_ASSERT_TRUE(fabs((double)sums.noise - 3.0 * (double)samples[4].dt_s / READING_S) < 1e-4);
    }
}

/* Blocks' gradients before and after a step, summed by hand: what the gradient changes by is shared out evenly over all time. */
static void closed_blocks_move_by_their_share_of_the_time(void)
{
    const double first[3] = {3.0, -2.0, 5.0};
    const double second[3] = {1.0, 4.0, -6.0};
    const double h[3] = {100.0, 200.0, 300.0};
    const float d[12] = {0.03f, -0.02f, 0.01f};
    jcal_center_sums_t sums;
    memset(&sums, 0, sizeof sums);
    sums.blocks = 2.0f;
    sums.time_s = 1.25f; /* two blocks and half of the third */
    sums.block_s = 0.25f;
    sums.cost = 50.0f;
    sums.noise = 50.0f;
    for (unsigned i = 0; i < 3u; ++i) {
        sums.matrix[jcal_sym_at(i, i)] = (float)h[i];
        sums.closed[i] = (float)(first[i] + second[i]);
        sums.block[i] = 1.0f;
        sums.gradient[i] = sums.closed[i] + 1.0f;
        for (unsigned j = 0; j <= i; ++j) {
            sums.scatter[jcal_sym_at(i, j)] = (float)(first[i] * first[j] + second[i] * second[j]);
        }
    }
    jcal_center_sums_move(&sums, d);
    double a[3];
    double b[3];
    for (unsigned i = 0; i < 3u; ++i) {
        a[i] = first[i] + 0.4 * h[i] * (double)d[i]; /* 0.5 s of 1.25 s */
        b[i] = second[i] + 0.4 * h[i] * (double)d[i];
        TEST_ASSERT_TRUE(fabs((double)sums.closed[i] - a[i] - b[i]) < 1e-4);
        TEST_ASSERT_TRUE(fabs((double)sums.block[i] - 1.0 - 0.2 * h[i] * (double)d[i]) < 1e-4);
        for (unsigned j = 0; j <= i; ++j) {
            TEST_ASSERT_TRUE(fabs((double)sums.scatter[jcal_sym_at(i, j)] - a[i] * a[j] - b[i] * b[j]) < 1e-3);
        }
    }
}

static void a_large_step_drops_the_blocks_and_no_more(void)
{
    const jcal_center_config_t cfg = jcal_center_config_default();
    const double wrong[12] = {1.88, 2.04, -1.95, 0.03, 0.16, -0.04};
    const float to_truth[12] = {-2.0f, -2.0f, 2.0f};
    const jcal_center_point_t p = point_of(wrong);
    jcal_center_sums_t sums = summed(&cfg, &p);
    const jcal_center_sums_t before = sums;
    jcal_center_sums_move(&sums, to_truth);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, before.blocks);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, sums.blocks);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, sums.scatter[0]);
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(before.matrix, sums.matrix, 78);
    TEST_ASSERT_TRUE(sums.cost < before.cost);
}

static void the_gradient_has_the_priors_pull(void)
{
    jcal_center_config_t cfg = jcal_center_config_default();
    const jcal_center_point_t p = point_of(anywhere);
    const jcal_center_sums_t sums = summed(&cfg, &p);
    float prior[12];
    float gradient[12];
    jcal_center_prior(&sums, &cfg, prior);
    jcal_center_sums_gradient(&sums, prior, gradient);
    const float excess = sums.cost / sums.noise;
    TEST_ASSERT_TRUE(excess > 2.0f); /* of noise and a wrong place */
    TEST_ASSERT_FLOAT_WITHIN(1e-5f * excess, excess / 0.09f, prior[2]);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f * excess, excess / 0.09f, prior[9]);
    jcal_center_sums_t quiet = sums;
    quiet.cost = 0.1f * sums.noise; /* better than usual is no reason to trust it more */
    float weaker[12];
    jcal_center_prior(&quiet, &cfg, weaker);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 1.0f / 0.09f, weaker[2]);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f * fabsf(gradient[5]), prior[5] * (float)anywhere[5], gradient[5] - sums.gradient[5]);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f * fabsf(gradient[8]), prior[8] * (float)anywhere[8], gradient[8] - sums.gradient[8]);
    cfg.acc_bias_m_s2 = 0.0f;
    jcal_center_prior(&sums, &cfg, prior);
    TEST_ASSERT_TRUE(prior[6] > 1e7f);
}

static void halving_keeps_the_estimate_of_the_spread(void)
{
    const jcal_center_config_t cfg = jcal_center_config_default();
    const jcal_center_point_t p = point_of(anywhere);
    jcal_center_sums_t sums = summed(&cfg, &p);
    const jcal_center_sums_t before = sums;
    jcal_center_sums_halve(&sums);
    TEST_ASSERT_EQUAL_FLOAT(before.scatter[5] / before.blocks, sums.scatter[5] / sums.blocks);
    TEST_ASSERT_EQUAL_FLOAT(before.cost / before.noise, sums.cost / sums.noise);
    TEST_ASSERT_EQUAL_FLOAT(before.matrix[7] / before.time_s, sums.matrix[7] / sums.time_s);
    TEST_ASSERT_EQUAL_FLOAT(before.gradient[7] / before.weight, sums.gradient[7] / sums.weight);
    TEST_ASSERT_EQUAL_FLOAT(before.lagged / before.raw, sums.lagged / sums.raw);
    TEST_ASSERT_EQUAL_FLOAT(before.turn1 / before.effect, sums.turn1 / sums.effect);
    TEST_ASSERT_EQUAL_FLOAT(0.5f * before.closed[3], sums.closed[3]);
    TEST_ASSERT_EQUAL_FLOAT(0.5f * before.turn2, sums.turn2);
    TEST_ASSERT_EQUAL_FLOAT(0.5f * before.time_s, sums.time_s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(features_times_monomials_are_the_squared_form);
    RUN_TEST(the_form_is_the_sum_over_samples_with_its_slope);
    RUN_TEST(the_forms_matrix_is_made_of_the_residuals_slopes);
    RUN_TEST(the_row_is_the_residuals_slope);
    RUN_TEST(a_row_with_orientations_is_the_residuals_slope);
    RUN_TEST(the_heading_is_that_by_which_both_forces_agree);
    RUN_TEST(free_fall_has_no_direction);
    RUN_TEST(sums_are_weighted_sums_of_squares);
    RUN_TEST(sums_are_weighted_sums_of_rows);
    RUN_TEST(absolute_differences_weigh_large_ones_less);
    RUN_TEST(moving_the_estimate_is_summing_there);
    RUN_TEST(residuals_with_orientations_are_differences_of_vectors);
    RUN_TEST(a_sample_with_orientations_is_the_mean_of_its_three_residuals);
    RUN_TEST(closed_blocks_move_by_their_share_of_the_time);
    RUN_TEST(a_large_step_drops_the_blocks_and_no_more);
    RUN_TEST(the_gradient_has_the_priors_pull);
    RUN_TEST(halving_keeps_the_estimate_of_the_spread);
    return UNITY_END();
}
