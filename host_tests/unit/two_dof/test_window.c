/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/two_dof_window.h on simulated joints, and of its Jacobians against finite differences in double precision.
#include "two_dof/window_cost.h"
#include "unit/two_dof/double.h"
#include "unit/two_dof/faults.h"
#include "unit/two_dof/window_fixture.h"

#ifdef JCAL_TEST_SHORT
enum { SEEDS = 1, SECONDS = 20 };
#else
enum { SEEDS = 4, SECONDS = 30 };
#endif

static const double DEG = POSE_PI / 180.0;

static void begin_with(jcal_constraint_t constraint)
{
    config.two_dof.constraint = constraint;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_init(&engine, &config, storage, sizeof storage));
}

static double sign_of(jcal_vec3_t a, jcal_vec3_t b)
{
    return (jcal_vec3_dot(a, b) < 0.0f) ? -1.0 : 1.0;
}

static double row_residual(const jcal_two_dof_row_t *row, jcal_constraint_t constraint, const unknowns_t *p)
{
    const double_sample_t sample = {row->q1, row->q2, row->w1, row->w2};
    return residual_double(&sample, constraint, p);
}

static jcal_two_dof_row_t row_of(int k)
{
    const jcal_two_dof_row_t row = {(uint64_t)k,
                                    pose_single(pose_any(7 * k + 1)),
                                    pose_single(pose_any(17 * k + 2)),
                                    {(float)sin(1.1 * k), (float)(2.0 * cos(0.7 * k)), (float)sin(2.1 * k + 1.0)},
                                    {(float)cos(1.3 * k), (float)sin(0.5 * k), (float)(1.5 * cos(1.9 * k))},
                                    0.05f};
    return row;
}

/* Rates of up to 3.5 rad/s over sines of at least 0.2, squared at worst in the derivative: 90 times some ten roundings of 6e-8. */
static const double SLOPE_TOL = 6e-5;
static const float LEAST_SINE = 0.2f;

static void slopes_are_those_of_finite_differences(void)
{
    const jcal_constraint_t both[2] = {JCAL_CONSTRAINT_ROTATION, JCAL_CONSTRAINT_ORIENTATION};
    int compared = 0;
    for (int k = 0; k < 200; ++k) {
        const jcal_two_dof_point_t point = point_of(k);
        const jcal_two_dof_row_t row = row_of(k);
        const float sine = 0.1f;
        for (int c = 0; c < 2; ++c) {
            jcal_two_dof_residual_t got;
            jcal_two_dof_window_residual(&row, both[c], &point, sine, &got);
            if ((got.product * got.product) > (1.0f - (LEAST_SINE * LEAST_SINE))) {
                continue;
            }
            const unknowns_t at = moved(&point, sine, 0, 0.0);
            TEST_ASSERT_DOUBLE_WITHIN(SLOPE_TOL, row_residual(&row, both[c], &at), (double)got.e);
            for (int i = 0; i < 6; ++i) {
                const double h = 1e-5;
                const unknowns_t on = moved(&point, sine, i, h);
                const unknowns_t back = moved(&point, sine, i, -h);
                const double slope =
                    (row_residual(&row, both[c], &on) - row_residual(&row, both[c], &back)) / (2.0 * h);
                TEST_ASSERT_DOUBLE_WITHIN(SLOPE_TOL, slope, (double)got.slope[i]);
                ++compared;
            }
        }
    }
    TEST_ASSERT_GREATER_THAN_INT(2000, compared);
}

static void sums_are_those_of_the_rows(void)
{
    enum { ROWS = 30 };
    jcal_two_dof_row_t rows[ROWS];
    const float sine = -0.2f;
    for (int k = 0; k < ROWS; ++k) {
        rows[k] = row_of(k);
    }
    jcal_two_dof_config_t cfg = config.two_dof;
    cfg.constraint = JCAL_CONSTRAINT_ORIENTATION;
    const jcal_two_dof_rows_t all = {rows, ROWS, &cfg, JCAL_REASON_NONE};
    const jcal_two_dof_point_t point = point_of(4);
    jcal_two_dof_window_sums_t sums;
    jcal_two_dof_window_sum(&all, &point, sine, &sums);
    double cost = 0.0, mean = 0.0;
    double gradient[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int k = 0; k < ROWS; ++k) {
        const unknowns_t at = moved(&point, sine, 0, 0.0);
        const double e = row_residual(&rows[k], cfg.constraint, &at);
        cost += e * e;
        mean += (e + (double)sine) / ROWS;
        for (int i = 0; i < 6; ++i) {
            const unknowns_t on = moved(&point, sine, i, 1e-5);
            const unknowns_t back = moved(&point, sine, i, -1e-5);
            const double e1 = row_residual(&rows[k], cfg.constraint, &on);
            const double e0 = row_residual(&rows[k], cfg.constraint, &back);
            gradient[i] += 0.5 * (e1 * e1 - e0 * e0) / 2e-5;
        }
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * cost, cost, (double)sums.cost);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, mean, (double)sums.sine);
    for (int i = 0; i < 6; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(ROWS * 1e-6, gradient[i], (double)sums.gradient[i]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, (double)ROWS,
                              (double)sums.matrix[JCAL_SYM_SIZE(6u) - 1u]); /* each by sin(beta0): -1 */
}

/* A mean over 0.1 s loses (2 pi f 0.1 s)^2 / 24 of a wave: 0.0012, or 0.07 deg, of either sensor's rates at 0.27 Hz, the fastest at
   speed 0.25. The orientation-based constraint needs no rates: what single precision leaves of two directions that differ by
   0.7 rad. The carrying angle has the errors of both axes. */
static void axes_heading_and_carrying_angle_are_found(void)
{
    const jcal_constraint_t both[2] = {JCAL_CONSTRAINT_ROTATION, JCAL_CONSTRAINT_ORIENTATION};
    const double limits[2] = {0.15 * DEG, 0.005 * DEG};
    const double speeds[2] = {0.25, 1.0};
    for (int seed = 0; seed < SEEDS; ++seed) {
        sim_t sim = lively(seed);
        const jcal_vec3_t axis1 = pose_axis1(&sim.joint), axis2 = pose_axis2(&sim.joint);
        for (int c = 0; c < 2; ++c) {
            sim.speed = speeds[c];
            begin_with(both[c]);
            feed(&engine, &sim, 0, SECONDS * RATE_HZ);
            const jcal_two_dof_result_t r = result_of(&engine);
            TEST_ASSERT_TRUE(r.has_axes);
            TEST_ASSERT_EQUAL_INT(JCAL_ENGINE_WINDOW, r.head.engine);
            TEST_ASSERT_DOUBLE_WITHIN(limits[c], 0.0, apart(r.axis1, axis1));
            TEST_ASSERT_DOUBLE_WITHIN(limits[c], 0.0, apart(r.axis2, axis2));
            TEST_ASSERT_TRUE(pose_apart((double)r.heading_offset_rad, sim.heading) < limits[c]);
            const double sign = sign_of(r.axis1, axis1) * sign_of(r.axis2, axis2);
            TEST_ASSERT_DOUBLE_WITHIN(2.0 * limits[c], sign * sim.joint.carrying, (double)r.carrying_angle_rad);
        }
    }
}

/* Skin that moves by a third of a degree or so at 1 Hz: what the config takes for usual. */
static void ready_is_reached_and_its_bounds_hold(void)
{
    for (int seed = 0; seed < SEEDS; ++seed) {
        sim_t sim = lively(seed + 20);
        sim.skin = 0.005;
        const jcal_vec3_t axis1 = pose_axis1(&sim.joint), axis2 = pose_axis2(&sim.joint);
        uint32_t ready = 0;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_reset(&engine));
        for (uint32_t k = 0; k < (uint32_t)SECONDS * RATE_HZ; ++k) {
            feed(&engine, &sim, k, k + 1u);
            const jcal_two_dof_result_t r = result_of(&engine);
            if (r.head.status == JCAL_READY) {
                ++ready;
                TEST_ASSERT_TRUE(apart(r.axis1, axis1) < (double)r.uncertainty1_rad);
                TEST_ASSERT_TRUE(apart(r.axis2, axis2) < (double)r.uncertainty2_rad);
                TEST_ASSERT_TRUE(pose_apart((double)r.heading_offset_rad, sim.heading) <
                                 (double)r.uncertainty_heading_rad);
                TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, r.head.reason);
            }
        }
        TEST_ASSERT_GREATER_THAN_UINT32((uint32_t)SECONDS * RATE_HZ / 3u, ready);
    }
}

static void never_ready(const sim_t *sim, jcal_constraint_t constraint)
{
    begin_with(constraint);
    for (uint32_t k = 0; k < (uint32_t)SECONDS * RATE_HZ; ++k) {
        const jcal_orientation_pair_t pair = sample_of(sim, k);
        (void)jcal_two_dof_window_update(&engine, &pair); /* at rest samples are refused as frozen */
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    }
}

static void a_joint_that_says_too_little_is_never_ready(void)
{
    const jcal_constraint_t both[2] = {JCAL_CONSTRAINT_ROTATION, JCAL_CONSTRAINT_ORIENTATION};
    for (int seed = 0; seed < SEEDS; ++seed) {
        for (int c = 0; c < 2; ++c) {
            sim_t stiff = lively(seed + 40);
            stiff.flexion = 0.0;
            stiff.pronation = 0.0;
            never_ready(&stiff, both[c]);
            stiff.skin = 0.005;
            never_ready(&stiff, both[c]);
            sim_t rest = stiff;
            rest.swing = 0.0;
            never_ready(&rest, both[c]);
            sim_t one_angle = lively(seed + 60);
            one_angle.pronation = 0.0;
            one_angle.skin = 0.005;
            never_ready(&one_angle, both[c]);
        }
    }
}

/* Sensor 2 on another body. */
static void sensors_that_share_no_joint_are_never_ready(void)
{
    const jcal_constraint_t both[2] = {JCAL_CONSTRAINT_ROTATION, JCAL_CONSTRAINT_ORIENTATION};
    for (int c = 0; c < 2; ++c) {
        begin_with(both[c]);
        const sim_t one = lively(80), two = lively(81);
        for (uint32_t k = 0; k < (uint32_t)SECONDS * RATE_HZ; ++k) {
            jcal_orientation_pair_t pair = sample_of(&one, k);
            pair.q2 = sample_of(&two, k).q2;
            (void)jcal_two_dof_window_update(&engine, &pair);
            TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
        }
    }
}

static jcal_status_t take(const jcal_orientation_pair_t *pair)
{
    return jcal_two_dof_window_update(&engine, pair);
}

static jcal_two_dof_result_t own_result(void)
{
    return result_of(&engine);
}

static void a_source_that_fails_is_not_ready_for_long(void)
{
    const sim_t sim = lively(2);
    const two_dof_subject_t subject = {take, own_result, 40u * RATE_HZ};
    for (int fault = 0; fault < POSE_FAULTS; ++fault) {
        setUp();
        feed(&engine, &sim, 0, subject.last + 1u);
        two_dof_fault_is_complained_of(&subject, &sim, fault);
    }
}

static void once_ready_signs_stay_although_the_largest_component_is_a_tie(void)
{
    uint32_t changes = 0; /* of the component that is the largest */
    for (int seed = 0; seed < 4; ++seed) {
        const sim_t sim = tied(seed);
        jcal_two_dof_result_t before = {0};
        setUp();
        for (uint32_t k = 0; k < 60u * RATE_HZ; ++k) {
            feed(&engine, &sim, k, k + 1u);
            const jcal_two_dof_result_t r = result_of(&engine);
            if (before.head.status == JCAL_READY) {
                TEST_ASSERT_TRUE(jcal_vec3_dot(r.axis1, before.axis1) > 0.9f);
                TEST_ASSERT_TRUE(jcal_vec3_dot(r.axis2, before.axis2) > 0.9f);
                changes += ((fabsf(r.axis1.x) > fabsf(r.axis1.y)) != (fabsf(before.axis1.x) > fabsf(before.axis1.y)));
                changes += ((fabsf(r.axis2.x) > fabsf(r.axis2.y)) != (fabsf(before.axis2.x) > fabsf(before.axis2.y)));
            }
            before = r;
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32(3u, changes); /* there were ties */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(slopes_are_those_of_finite_differences);
    RUN_TEST(sums_are_those_of_the_rows);
    RUN_TEST(axes_heading_and_carrying_angle_are_found);
    RUN_TEST(ready_is_reached_and_its_bounds_hold);
    RUN_TEST(a_joint_that_says_too_little_is_never_ready);
    RUN_TEST(sensors_that_share_no_joint_are_never_ready);
    RUN_TEST(a_source_that_fails_is_not_ready_for_long);
    RUN_TEST(once_ready_signs_stay_although_the_largest_component_is_a_tie);
    return UNITY_END();
}
