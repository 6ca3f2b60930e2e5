/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/calib/hinge_bounds.h: what bounds must do whatever their formula, then the formula in double precision.
#include "calib/hinge_bounds.h"
#include "hinge_bounds_double.h"
#include "hinge_motion.h"
#include "math/angle.h"
#include "math/sphere.h"
#include "unity.h"

#include <string.h>

static jcal_hinge_t engine;
static jcal_hinge_lin_t lin;
static jcal_hinge_bounds_t bounds;
static power_sums_t powers;

void setUp(void)
{
    jcal_hinge_config_t config = jcal_hinge_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
}

void tearDown(void)
{
}

/* Sums of a motion at the true axes, weighted as in docs/METHOD.md section 2; no step was made, so nothing is added for
   it. */
static bool bounds_of(const motion_t *motion, uint32_t begin, uint32_t end, float acc_weight)
{
    const jcal_hinge_config_t cfg = engine.cfg;
    const float dt = (float)(1.0 / motion->rate_hz);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &cfg));
    memset(&powers, 0, sizeof powers);
    jcal_hinge_axis_set(&engine.point.axis1, motion_axis(motion, 0));
    jcal_hinge_axis_set(&engine.point.axis2, motion_axis(motion, 1));
    jcal_hinge_evidence_follow(&engine.evidence, &engine.point, true);
    for (uint32_t k = begin; k < end; ++k) {
        const jcal_pair_t p = motion_sample(motion, k);
        jcal_hinge_sample_t s = {.w1 = p.imu1.gyr_rad_s,
                                 .w2 = p.imu2.gyr_rad_s,
                                 .a1 = p.imu1.acc_m_s2,
                                 .a2 = p.imu2.acc_m_s2,
                                 .dt_s = dt,
                                 .acc_weight = acc_weight};
        s.w1_2 = jcal_vec3_dot(s.w1, s.w1);
        s.w2_2 = jcal_vec3_dot(s.w2, s.w2);
        s.gyr_weight = (dt / JCAL_HINGE_UNIT_S) / (9e-4f * (s.w1_2 + s.w2_2 + 0.05f));
        dsample_t d = {0};
        dset(s.w1, d.w[0]);
        dset(s.w2, d.w[1]);
        dset(s.a1, d.a[0]);
        dset(s.a2, d.a[1]);
        d.gyr_weight = (double)s.gyr_weight;
        d.acc_weight = (double)s.acc_weight;
        add_to_moments(&d, &engine.moments);
        add_powers(&d, &engine.point, &powers);
        jcal_hinge_evidence_watch(&engine.evidence, &s);
        jcal_hinge_evidence_add(&engine.evidence, &engine.point, 0.0f, cfg.gyr_bias_rad_s, &s);
    }
    jcal_hinge_linearise(&engine.moments, &cfg, &engine.point, JCAL_HINGE_UNKNOWNS, &lin);
    return jcal_hinge_bounds(&engine, &lin, &bounds);
}

static void twice_the_data_with_noise_of_its_own_shrinks_the_bounds_by_the_root_of_two(void)
{
    double ratio[2] = {0.0, 0.0};
    enum { RUNS = 12 };
    engine.cfg.rate_mismatch = 0.0f; /* systematic errors do not shrink; here are none */
    for (uint32_t seed = 0; seed < RUNS; ++seed) {
        motion_t motion = motion_lively(seed);
        motion.gyr_noise_rad_s = 0.02;
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, 3000, 0.0f));
        const jcal_hinge_bounds_t once = bounds;
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, 6000, 0.0f));
        ratio[0] += (double)(bounds.bound1_rad / once.bound1_rad) / RUNS;
        ratio[1] += (double)(bounds.bound2_rad / once.bound2_rad) / RUNS;
    }
    /* The second minute's motion is like the first's, not the same, and the scatter of 12 runs remains: 15 %. */
    TEST_ASSERT_TRUE(fabs(ratio[0] - sqrt(0.5)) < 0.15 * sqrt(0.5));
    TEST_ASSERT_TRUE(fabs(ratio[1] - sqrt(0.5)) < 0.15 * sqrt(0.5));
}

static void a_stiff_joint_leaves_both_axes_open_however_long_it_is_watched(void)
{
    const uint32_t lengths[3] = {500, 5000, 50000};
    motion_t motion = motion_lively(2);
    motion.joint_speed = 0.0;
    for (int i = 0; i < 3; ++i) {
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, lengths[i], 0.0f));
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, bounds.bound1_rad);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, bounds.bound2_rad);
    }
}

static void a_segment_at_rest_leaves_its_own_axis_open(void)
{
    motion_t motion = motion_lively(2);
    motion.speed = 0.0;
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 2000, 0.1f)); /* gravity tells axis 2: it turns about it */
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, bounds.bound1_rad);
    TEST_ASSERT_TRUE(bounds.bound2_rad < 3.0f * JCAL_RAD_PER_DEG);
}

static void without_three_finished_blocks_nothing_is_said(void)
{
    const motion_t motion = motion_lively(2);
    bounds.bound1_rad = -1.0f;
    TEST_ASSERT_FALSE(bounds_of(&motion, 0, 0, 0.1f));
    TEST_ASSERT_FALSE(bounds_of(&motion, 0, 5, 0.1f));  /* one coarse block of 0.1 s at 50 Hz */
    TEST_ASSERT_FALSE(bounds_of(&motion, 0, 12, 0.1f)); /* two */
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, bounds.bound1_rad);
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 50, 0.1f));
}

static void a_matrix_that_holds_nan_gives_no_bound(void)
{
    const motion_t motion = motion_lively(2);
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 1000, 0.1f));
    for (size_t k = 0; k < JCAL_SYM_SIZE(8u); ++k) {
        const float kept = lin.matrix[k];
        lin.matrix[k] = NAN;
        jcal_hinge_bounds_t out = {0.0f, 0.0f, 0.0f};
        if (jcal_hinge_bounds(&engine, &lin, &out)) {
            /* Never a bound that says more than without NaN. */
            TEST_ASSERT_TRUE(isfinite(out.bound1_rad) && isfinite(out.bound2_rad));
            TEST_ASSERT_TRUE((out.bound1_rad >= bounds.bound1_rad) || (out.bound2_rad >= bounds.bound2_rad));
        }
        lin.matrix[k] = kept;
    }
}

static void a_step_just_made_widens_the_bound_by_its_length(void)
{
    const motion_t motion = motion_lively(2);
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 1000, 0.1f));
    const jcal_hinge_bounds_t still = bounds;
    engine.moved_rad[0] = 0.01f;
    engine.moved_rad[1] = 0.02f;
    TEST_ASSERT_TRUE(jcal_hinge_bounds(&engine, &lin, &bounds));
    TEST_ASSERT_TRUE(bounds.bound1_rad - still.bound1_rad >= 0.01f);
    TEST_ASSERT_TRUE(bounds.bound2_rad - still.bound2_rad >= 0.02f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 2.0f * (bounds.bound1_rad - still.bound1_rad),
                             bounds.bound2_rad - still.bound2_rad);
}

static void a_mismatch_of_the_rates_is_a_floor_that_more_data_do_not_lower(void)
{
    const motion_t motion = motion_lively(2);
    engine.cfg.rate_mismatch = 0.0f;
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 12000, 0.0f));
    const jcal_hinge_bounds_t none = bounds;
    engine.cfg.rate_mismatch = 0.002f;
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 3000, 0.0f));
    const jcal_hinge_bounds_t once = bounds;
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 12000, 0.0f));
    TEST_ASSERT_TRUE(bounds.bound1_rad > 3.0f * none.bound1_rad);
    /* Four times the data would halve what averages out. */
    TEST_ASSERT_FLOAT_WITHIN(0.1f * once.bound1_rad, once.bound1_rad, bounds.bound1_rad);
    /* A tilt s changes the rate across the axis by about s times the rate: the floor is of the size of the share. */
    TEST_ASSERT_TRUE((bounds.bound1_rad > 0.002f) && (bounds.bound1_rad < 0.02f));
}

static void bounds_equal_their_formula_in_double(void)
{
    for (uint32_t seed = 0; seed < 6; ++seed) {
        motion_t motion = motion_lively(seed);
        motion.gyr_noise_rad_s = 0.01 * (1.0 + (double)seed);
        motion.acc_noise_m_s2 = 0.5;
        engine.cfg.rate_mismatch = 0.002f * (float)seed;
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, 1500, ((seed % 2u) == 0u) ? 0.02f : 0.3f));
        double expected[2];
        bounds_in_double(&engine, &lin, &powers, expected);
        TEST_ASSERT_FLOAT_WITHIN(2e-3f * (float)expected[0], (float)expected[0], bounds.bound1_rad);
        TEST_ASSERT_FLOAT_WITHIN(2e-3f * (float)expected[1], (float)expected[1], bounds.bound2_rad);
        TEST_ASSERT_TRUE(expected[0] < 0.2); /* so that something is compared */
    }
}

static void bounds_of_planar_motion_equal_their_formula_in_double(void)
{
    for (uint32_t seed = 0; seed < 6; ++seed) {
        motion_t motion = motion_lively(seed);
        motion.speed = 0.002; /* segment 1 turns a little, segment 2 about the joint */
        motion.gyr_noise_rad_s = 0.005 + (0.002 * (double)seed);
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, 3000, 0.05f));
        double expected[2];
        bounds_in_double(&engine, &lin, &powers, expected);
        TEST_ASSERT_FLOAT_WITHIN(5e-3f * (float)expected[1], (float)expected[1], bounds.bound2_rad);
    }
}

static void bounds_of_the_whole_engine_cover_its_errors_and_are_not_idle(void)
{
    enum { RUNS = 150 };
    uint32_t covered = 0;
    uint32_t sharp = 0;
    for (uint32_t seed = 0; seed < RUNS; ++seed) {
        motion_t motion = motion_lively(seed);
        motion.gyr_noise_rad_s = 0.03;
        motion.acc_noise_m_s2 = 0.3;
        setUp();
        for (uint32_t k = 0; k < 500; ++k) {
            const jcal_pair_t pair = motion_sample(&motion, k);
            (void)jcal_hinge_update(&engine, &pair);
        }
        jcal_hinge_result_t r;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_get(&engine, &r));
        const float error1 = jcal_sphere_line_angle(r.axis1, motion_axis(&motion, 0));
        const float error2 = jcal_sphere_line_angle(r.axis2, motion_axis(&motion, 1));
        covered += (error1 <= r.uncertainty1_rad) ? 1u : 0u;
        covered += (error2 <= r.uncertainty2_rad) ? 1u : 0u;
        sharp += ((r.uncertainty1_rad < 8.0f * error1) || (r.uncertainty2_rad < 8.0f * error2)) ? 1u : 0u;
    }
    TEST_ASSERT_TRUE(covered >= (2u * RUNS * 95u) / 100u);
    /* Noise alone is less than what the bounds allow for: soft tissue, mismatch. Yet they are not beyond all measure. */
    TEST_ASSERT_TRUE(sharp > RUNS / 2u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(twice_the_data_with_noise_of_its_own_shrinks_the_bounds_by_the_root_of_two);
    RUN_TEST(a_stiff_joint_leaves_both_axes_open_however_long_it_is_watched);
    RUN_TEST(a_segment_at_rest_leaves_its_own_axis_open);
    RUN_TEST(without_three_finished_blocks_nothing_is_said);
    RUN_TEST(a_matrix_that_holds_nan_gives_no_bound);
    RUN_TEST(a_step_just_made_widens_the_bound_by_its_length);
    RUN_TEST(a_mismatch_of_the_rates_is_a_floor_that_more_data_do_not_lower);
    RUN_TEST(bounds_equal_their_formula_in_double);
    RUN_TEST(bounds_of_planar_motion_equal_their_formula_in_double);
    RUN_TEST(bounds_of_the_whole_engine_cover_its_errors_and_are_not_idle);
    return UNITY_END();
}
