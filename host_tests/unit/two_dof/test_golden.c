/* SPDX-License-Identifier: MIT */
/// @file
/// The 2-DoF joint's residuals, derivatives, costs and angles against the float64 numpy reference, tools/maintain/make_golden.py.
#include "golden/two_dof.h"
#include "jointcal/joint_angles.h"
#include "jointcal/quat.h"
#include "two_dof/model.h"
#include "two_dof/window_cost.h"

#include <math.h>
#include <string.h>
#include <unity.h>

/* Rates up to 3 rad/s, a few roundings of 6e-8; over sines of the angle between the axes of at least 0.2, squared in a slope. */
static const double E_TOL = 5e-6;
static const double SLOPE_TOL = 6e-5;
static const float LEAST_SINE = 0.2f;
/* Sums of 30 squares. */
static const double COST_TOL = 1e-5;

void setUp(void)
{
}

void tearDown(void)
{
}

static jcal_quat_t quaternion(const float *v)
{
    return (jcal_quat_t){v[0], v[1], v[2], v[3]};
}

static jcal_vec3_t vector(const float *v)
{
    return (jcal_vec3_t){v[0], v[1], v[2]};
}

static jcal_two_dof_sample_t sample(int k)
{
    const float *const s = golden_samples[k];
    return (jcal_two_dof_sample_t){jcal_quat_normalise(quaternion(&s[0])), jcal_quat_normalise(quaternion(&s[4])),
                                   vector(&s[8]), vector(&s[11])};
}

static jcal_two_dof_point_t point(int p)
{
    const float *const g = golden_points[p];
    return (jcal_two_dof_point_t){vector(&g[0]), vector(&g[3]), {cosf(g[6]), sinf(g[6])}};
}

/* A gradient by a free vector, along a tangent. */
static double along(const double *gradient, jcal_vec3_t t)
{
    return gradient[0] * (double)t.x + gradient[1] * (double)t.y + gradient[2] * (double)t.z;
}

static void rows_are_those_of_the_reference(void)
{
    const jcal_two_dof_point_t at = point(0);
    const jcal_tangent_t t1 = jcal_sphere_tangent(at.j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(at.j2);
    int compared = 0;
    for (int k = 0; k < GOLDEN_SAMPLES; ++k) {
        const jcal_two_dof_sample_t s = sample(k);
        const jcal_two_dof_row_t row = {0u, s.q1, s.q2, s.w1, s.w2, 0.05f};
        for (int c = 0; c < 2; ++c) {
            const jcal_constraint_t constraint = (c == 0) ? JCAL_CONSTRAINT_ROTATION : JCAL_CONSTRAINT_ORIENTATION;
            const double *const g = (c == 0) ? golden_rotation[k] : golden_orientation[k];
            jcal_two_dof_residual_t got;
            jcal_two_dof_window_residual(&row, constraint, &at, 0.0f, &got);
            if ((c == 0) && ((got.product * got.product) > (1.0f - (LEAST_SINE * LEAST_SINE)))) {
                continue;
            }
            ++compared;
            TEST_ASSERT_DOUBLE_WITHIN(E_TOL, g[0], (double)got.e);
            TEST_ASSERT_DOUBLE_WITHIN(SLOPE_TOL, along(&g[1], t1.u), (double)got.slope[0]);
            TEST_ASSERT_DOUBLE_WITHIN(SLOPE_TOL, along(&g[1], t1.v), (double)got.slope[1]);
            TEST_ASSERT_DOUBLE_WITHIN(SLOPE_TOL, along(&g[4], t2.u), (double)got.slope[2]);
            TEST_ASSERT_DOUBLE_WITHIN(SLOPE_TOL, along(&g[4], t2.v), (double)got.slope[3]);
            TEST_ASSERT_DOUBLE_WITHIN(SLOPE_TOL, g[7], (double)got.slope[4]);
        }
    }
    TEST_ASSERT_GREATER_THAN_INT(GOLDEN_SAMPLES * 3 / 2, compared);
}

static void sums_are_those_of_the_reference(void)
{
    static jcal_two_dof_moments_t moments;
    memset(&moments, 0, sizeof moments);
    for (int k = 0; k < GOLDEN_SAMPLES; ++k) {
        const jcal_two_dof_sample_t s = sample(k);
        float f[JCAL_TWO_DOF_FEATURES];
        jcal_two_dof_rotation_features(&s, f);
        jcal_two_dof_add(moments.rotation, f, 1.0f);
        jcal_two_dof_orientation_features(s.q1, s.q2, f);
        jcal_two_dof_add(moments.orientation, f, 1.0f);
        for (int i = 0; i < JCAL_TWO_DOF_FEATURES; ++i) {
            moments.mean[i] += f[i];
        }
        moments.weight += 1.0f;
    }
    for (int p = 0; p < GOLDEN_POINTS; ++p) {
        const jcal_two_dof_point_t at = point(p);
        jcal_two_dof_lin_t lin;
        float parts[2];
        jcal_two_dof_form(moments.rotation, &at, &lin);
        jcal_two_dof_combine(&moments, JCAL_CONSTRAINT_COMBINED, &at, &lin, parts);
        TEST_ASSERT_DOUBLE_WITHIN(COST_TOL * golden_costs[p][0], golden_costs[p][0], (double)parts[0]);
        TEST_ASSERT_DOUBLE_WITHIN(COST_TOL * golden_costs[p][1], golden_costs[p][1], (double)parts[1]);
    }
}

static void angles_are_those_of_the_reference(void)
{
    const float *const g = golden_points[0];
    jcal_joint_frames_t frames;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_frames_two_dof(vector(&g[0]), vector(&g[3]), &frames));
    for (int k = 0; k < GOLDEN_SAMPLES; ++k) {
        const jcal_two_dof_sample_t s = sample(k);
        const jcal_joint_angles_t got = jcal_two_dof_angles(jcal_joint_orientation(&frames, s.q1, s.q2, g[6]));
        /* near a carrying angle of a right angle the other two are not told apart: errors grow as 1 / cos */
        const double tol = 2e-6 / cos(golden_angles[k][1]);
        TEST_ASSERT_DOUBLE_WITHIN(tol, 0.0,
                                  remainder(golden_angles[k][0] - (double)got.flexion_rad, 6.283185307179586));
        TEST_ASSERT_DOUBLE_WITHIN(tol, golden_angles[k][1], (double)got.carrying_rad);
        TEST_ASSERT_DOUBLE_WITHIN(tol, 0.0,
                                  remainder(golden_angles[k][2] - (double)got.pronation_rad, 6.283185307179586));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(rows_are_those_of_the_reference);
    RUN_TEST(sums_are_those_of_the_reference);
    RUN_TEST(angles_are_those_of_the_reference);
    return UNITY_END();
}
