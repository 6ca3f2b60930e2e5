/* SPDX-License-Identifier: MIT */
/// @file
/// The hinge's costs, residuals and derivatives against the float64 numpy reference, tools/maintain/make_golden.py.
#include "golden/hinge.h"
#include "hinge/model.h"
#include "hinge/stream.h"
#include "hinge/window_residual.h"
#include "math/sym.h"
#include "unity.h"

#include <string.h>

/* Sums of 40 samples in float32 beside float64: 40 roundings of 6e-8 that partly cancel. */
static const double COST_TOL = 3e-6;
/* A single residual: a few roundings of readings up to 3 rad/s and 11 m/s^2. */
static const double GYR_TOL_RAD_S = 1e-6;
static const double ACC_TOL_M_S2 = 4e-6;
/* Derivatives of |w x j| where |w x j| is small divide by it: at the smallest, 0.1 rad/s, ten times a rounding of w. */
static const double SLOPE_TOL_RAD_S = 1e-5;

static jcal_vec3_t vector(const float v[3])
{
    return jcal_vec3(v[0], v[1], v[2]);
}

static jcal_pair_t sample(int k)
{
    const float *const s = golden_samples[k];
    const jcal_pair_t pair = {.t_us = 1000000u + ((uint64_t)(k + 1) * 20000u),
                              .imu1 = {vector(&s[0]), vector(&s[3])},
                              .imu2 = {vector(&s[6]), vector(&s[9])}};
    return pair;
}

static jcal_hinge_point_t point(int p)
{
    jcal_hinge_point_t at;
    memset(&at, 0, sizeof at);
    at.axis1.j = vector(&golden_axes[p][0]);
    at.axis2.j = vector(&golden_axes[p][3]);
    return at;
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void the_engine_sums_up_the_cost_of_the_reference(void)
{
    static jcal_hinge_t engine;
    jcal_hinge_config_t config = jcal_hinge_config_default();
    config.gyr_noise_rad_s = GOLDEN_GYR_NOISE_RAD_S;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
    jcal_pair_t before = sample(0); /* stands for no time, so it does not count */
    before.t_us -= 20000u;
    jcal_hinge_consume(&engine, &before);
    for (int k = 0; k < GOLDEN_SAMPLES; ++k) {
        const jcal_pair_t pair = sample(k);
        jcal_hinge_consume(&engine, &pair);
    }
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        const jcal_hinge_point_t at = point(p);
        const double cost = golden_costs[p][0];
        TEST_ASSERT_TRUE(fabs((double)jcal_hinge_cost_gyr(&engine.coarse.moments, &at) - cost) < COST_TOL * cost);
    }
}

static void accelerometer_moments_give_the_cost_of_the_reference(void)
{
    static jcal_hinge_moments_t moments;
    jcal_hinge_config_t config = jcal_hinge_config_default();
    config.acc_bias_m_s2 = GOLDEN_ACC_BIAS_M_S2;
    for (int k = 0; k < GOLDEN_SAMPLES; ++k) {
        const float *const s = golden_samples[k];
        const float y[7] = {s[3], s[4], s[5], -s[9], -s[10], -s[11], 1.0f};
        jcal_sym_rank1(moments.acc, 7u, y, GOLDEN_ACC_WEIGHT);
    }
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        const jcal_hinge_point_t at = point(p);
        const double cost = golden_costs[p][1];
        TEST_ASSERT_TRUE(fabs((double)jcal_hinge_cost_acc(&moments, &config, &at) - cost) < COST_TOL * cost);
    }
}

/* The derivative of j_s by a spherical angle, expressed in the tangent basis of the frame. */
static double by_angle(const jcal_hinge_frame_t *frame, const double direction[3], const float tangent_slopes[2])
{
    const double u = ((double)frame->t.u.x * direction[0]) + ((double)frame->t.u.y * direction[1]) +
                     ((double)frame->t.u.z * direction[2]);
    const double v = ((double)frame->t.v.x * direction[0]) + ((double)frame->t.v.y * direction[1]) +
                     ((double)frame->t.v.z * direction[2]);
    return (u * (double)tangent_slopes[0]) + (v * (double)tangent_slopes[1]);
}

static void gyroscope_residual_and_jacobian_are_those_of_the_reference(void)
{
    const jcal_hinge_point_t at = point(0);
    const jcal_hinge_frame_t frames[2] = {jcal_hinge_frame(at.axis1.j), jcal_hinge_frame(at.axis2.j)};
    for (int k = 0; k < GOLDEN_SAMPLES; ++k) {
        const float *const s = golden_samples[k];
        const float w[6] = {s[0], s[1], s[2], s[6], s[7], s[8]};
        float slopes[4];
        const double e = (double)jcal_hinge_gyr_residual(frames, w, slopes);
        TEST_ASSERT_TRUE(fabs(e - golden_rows[k][0]) < GYR_TOL_RAD_S);
        for (int i = 0; i < 4; ++i) {
            const double slope = by_angle(&frames[i / 2], golden_directions[i], &slopes[2 * (i / 2)]);
            TEST_ASSERT_TRUE(fabs(slope - golden_rows[k][1 + i]) < SLOPE_TOL_RAD_S);
        }
    }
}

static void accelerometer_residual_and_jacobian_are_those_of_the_reference(void)
{
    const jcal_hinge_point_t at = point(0);
    const jcal_vec3_t j[2] = {at.axis1.j, at.axis2.j};
    for (int k = 0; k < GOLDEN_SAMPLES; ++k) {
        const float *const s = golden_samples[k];
        const float a[6] = {s[3], s[4], s[5], -s[9], -s[10], -s[11]};
        TEST_ASSERT_TRUE(fabs((double)jcal_hinge_acc_residual(j, a) - golden_rows[k][5]) < ACC_TOL_M_S2);
        for (int i = 0; i < 4; ++i) { /* (25) is linear: its derivative is (25) with j replaced by the direction */
            const double *const d = golden_directions[i];
            const jcal_vec3_t zero = {0.0f, 0.0f, 0.0f};
            const jcal_vec3_t along = {(float)d[0], (float)d[1], (float)d[2]};
            const jcal_vec3_t moved[2] = {(i < 2) ? along : zero, (i < 2) ? zero : along};
            TEST_ASSERT_TRUE(fabs((double)jcal_hinge_acc_residual(moved, a) - golden_rows[k][6 + i]) < ACC_TOL_M_S2);
        }
    }
}

static void the_first_points_derivatives_are_unit_tangents_up_to_the_latitude(void)
{
    /* Guards the generator: (41) by theta is a unit tangent, by phi one of length cos theta. */
    const jcal_hinge_point_t at = point(0);
    const jcal_vec3_t j[2] = {at.axis1.j, at.axis2.j};
    for (int i = 0; i < 4; ++i) {
        const double *const d = golden_directions[i];
        const double cos_theta = sqrt(1.0 - ((double)j[i / 2].z * (double)j[i / 2].z));
        const double along = ((double)j[i / 2].x * d[0]) + ((double)j[i / 2].y * d[1]) + ((double)j[i / 2].z * d[2]);
        const double length = sqrt((d[0] * d[0]) + (d[1] * d[1]) + (d[2] * d[2]));
        TEST_ASSERT_TRUE(fabs(along) < 1e-6);
        TEST_ASSERT_TRUE(fabs(length - (((i % 2) == 0) ? 1.0 : cos_theta)) < 1e-6);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_engine_sums_up_the_cost_of_the_reference);
    RUN_TEST(accelerometer_moments_give_the_cost_of_the_reference);
    RUN_TEST(gyroscope_residual_and_jacobian_are_those_of_the_reference);
    RUN_TEST(accelerometer_residual_and_jacobian_are_those_of_the_reference);
    RUN_TEST(the_first_points_derivatives_are_unit_tangents_up_to_the_latitude);
    return UNITY_END();
}
