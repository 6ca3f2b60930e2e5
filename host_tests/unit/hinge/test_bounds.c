/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/hinge/bounds.h: what bounds must do whatever their formula, then the formula in double precision.
#include "hinge/bounds.h"
#include "unit/hinge/bounds_double.h"
#include "unit/hinge/motion.h"

#include <string.h>

static jcal_hinge_t engine;
static jcal_hinge_bounds_t bounds;
static bool planar;  /* both segments turn about the joint axis only; what noise there is comes on top */
static bool swapped; /* sensor 1 on the distal segment, 2 on the proximal one */

void setUp(void)
{
    swapped = false;
    planar = false;
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
}

void tearDown(void)
{
}

static jcal_vec3_t about(jcal_vec3_t axis, jcal_vec3_t w, jcal_rng_t *rng)
{
    const jcal_vec3_t along = jcal_vec3_scale(axis, jcal_vec3_dot(axis, w));
    return jcal_vec3_add(along, jcal_vec3_scale(jcal_rng_unit(rng), 0.01f));
}

/* Refined sums of a motion, begun at the true axes; the weight of the specific forces is given. */
static void add_motion(const motion_t *motion, uint32_t begin, uint32_t end, float acc_weight)
{
    jcal_rng_t rng = {motion->seed};
    for (uint32_t k = begin; k < end; ++k) {
        jcal_pair_t p = motion_sample(motion, k);
        if (planar) {
            p.imu1.gyr_rad_s = about(motion_axis(motion, 0), p.imu1.gyr_rad_s, &rng);
            p.imu2.gyr_rad_s = about(motion_axis(motion, 1), p.imu2.gyr_rad_s, &rng);
        }
        if (swapped) {
            const jcal_imu_t imu1 = p.imu1;
            p.imu1 = p.imu2;
            p.imu2 = imu1;
        }
        jcal_hinge_sample_t s = {.w1 = p.imu1.gyr_rad_s,
                                 .w2 = p.imu2.gyr_rad_s,
                                 .a1 = p.imu1.acc_m_s2,
                                 .a2 = p.imu2.acc_m_s2,
                                 .dt_s = (float)(1.0 / motion->rate_hz),
                                 .acc_weight = acc_weight};
        s.w1_2 = jcal_vec3_dot(s.w1, s.w1);
        s.w2_2 = jcal_vec3_dot(s.w2, s.w2);
        dsample_t d = {{{0.0}}, {{0.0}}, 0.0, 0.0};
        dset(s.a1, d.a[0]);
        dset(s.a2, d.a[1]);
        d.acc_weight = (double)acc_weight;
        add_to_moments(&d, &engine.coarse.moments);
        (void)jcal_hinge_refine_add(&engine.refine, &engine.cfg, &engine.coarse, &s);
    }
}

static bool bounds_of(const motion_t *motion, uint32_t begin, uint32_t end, float acc_weight)
{
    const jcal_hinge_config_t cfg = engine.cfg;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &cfg));
    engine.coarse.has_point = true;
    jcal_hinge_point_set(&engine.coarse.point, motion_axis(motion, swapped ? 1 : 0),
                         motion_axis(motion, swapped ? 0 : 1));
    jcal_hinge_refine_restart(&engine.refine, &engine.coarse.point);
    add_motion(motion, begin, end, acc_weight);
    return jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds);
}

/* Noise that leaves less than 5 mrad/s: none of it is taken to act alike in every sample. */
#define QUIET_RAD_S 0.002

static void twice_the_data_with_noise_of_its_own_shrinks_the_bounds_by_the_root_of_two(void)
{
    double ratio[2] = {0.0, 0.0};
    enum { RUNS = 12 };
    engine.cfg.rate_mismatch = 0.0f; /* systematic errors do not shrink; here are none */
    for (uint32_t seed = 0; seed < RUNS; ++seed) {
        motion_t motion = motion_lively(seed);
        motion.gyr_noise_rad_s = QUIET_RAD_S;
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
    for (int turn = 0; turn < 2; ++turn) {
        swapped = (turn == 1);
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, 2000, 0.0f));
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, swapped ? bounds.bound2_rad : bounds.bound1_rad);
        /* The other turns about nothing but its axis. */
        TEST_ASSERT_TRUE((swapped ? bounds.bound1_rad : bounds.bound2_rad) < 3.0f * JCAL_RAD_PER_DEG);
    }
}

static void with_less_than_four_blocks_nothing_is_said(void)
{
    const motion_t motion = motion_lively(2);
    int silent = 0;
    for (uint32_t end = 0; end < 60; ++end) {
        bounds.bound1_rad = -1.0f;
        const bool said = bounds_of(&motion, 0, end, 0.1f);
        TEST_ASSERT_TRUE(said == (engine.refine.blocks >= 4.0f));
        TEST_ASSERT_TRUE(said == (bounds.bound1_rad >= 0.0f));
        silent += said ? 0 : 1;
    }
    /* One block of 0.1 s that finds the phase, three of 0.2 s: at 50 Hz the fourth ends with sample 35, or 5 later if
       the first one was of no use but for the phase. */
    TEST_ASSERT_TRUE((silent >= 35) && (silent <= 40));
}

/* Never a bound that says more than without NaN. */
static void assert_no_better_with_nan(float *sums, size_t count, const jcal_hinge_bounds_t *whole)
{
    for (size_t k = 0; k < count; ++k) {
        const float kept = sums[k];
        sums[k] = NAN;
        if (jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds)) {
            TEST_ASSERT_TRUE((bounds.bound1_rad >= whole->bound1_rad) && (bounds.bound2_rad >= whole->bound2_rad));
            TEST_ASSERT_TRUE(bounds.bound1_rad <= JCAL_BOUND_UNKNOWN_RAD);
            TEST_ASSERT_TRUE(bounds.bound2_rad <= JCAL_BOUND_UNKNOWN_RAD);
        }
        sums[k] = kept;
    }
}

static void sums_that_hold_nan_give_no_bound(void)
{
    const motion_t motion = motion_lively(2);
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 1000, 0.1f));
    const jcal_hinge_bounds_t whole = bounds;
    assert_no_better_with_nan(engine.refine.matrix, JCAL_SYM_SIZE(8u), &whole);
    assert_no_better_with_nan(engine.refine.scatter, JCAL_SYM_SIZE(4u), &whole);
    assert_no_better_with_nan(engine.coarse.moments.acc, JCAL_SYM_SIZE(7u), &whole);
    assert_no_better_with_nan(engine.refine.along, 2, &whole);
    assert_no_better_with_nan(&engine.refine.alike.scale, 1, &whole);
    assert_no_better_with_nan(&engine.refine.alike.lag, 1, &whole);
    assert_no_better_with_nan(&engine.refine.alike.change, 1, &whole);
    assert_no_better_with_nan(&engine.refine.across, 1, &whole);
    assert_no_better_with_nan(&engine.refine.cost, 1, &whole);
    assert_no_better_with_nan(&engine.refine.blocks, 1, &whole);
    engine.refine.matrix[0] = NAN;
    TEST_ASSERT_FALSE(jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds));
}

static void an_axis_about_which_nothing_turned_has_no_bound(void)
{
    motion_t motion = motion_lively(2);
    motion.gyr_noise_rad_s = QUIET_RAD_S;
    TEST_ASSERT_TRUE(bounds_of(&motion, 0, 1000, 0.1f));
    engine.cfg.rate_mismatch = 0.0f; /* of all rates, and so of what is taken away below */
    TEST_ASSERT_TRUE(jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds));
    const jcal_hinge_bounds_t whole = bounds;
    const float unit =
        engine.cfg.gyr_noise_rad_s * engine.cfg.gyr_noise_rad_s * 0.05f; /* rad^2/s in units of the sums */
    for (int axis = 0; axis < 2; ++axis) {
        const float along = engine.refine.along[axis];
        engine.refine.along[axis] = 0.031f / unit;
        TEST_ASSERT_TRUE(jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds));
        /* Less along the axis is less planar, which narrows a bound by up to 1 + 10 / blocks / 100: 1 % with ten blocks. */
        TEST_ASSERT_FLOAT_WITHIN(1e-2f * whole.bound1_rad, whole.bound1_rad, bounds.bound1_rad);
        TEST_ASSERT_FLOAT_WITHIN(1e-2f * whole.bound2_rad, whole.bound2_rad, bounds.bound2_rad);
        engine.refine.along[axis] = 0.029f / unit; /* limit: 0.03 rad^2/s */
        TEST_ASSERT_TRUE(jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds));
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, (axis == 0) ? bounds.bound1_rad : bounds.bound2_rad);
        TEST_ASSERT_TRUE(((axis == 0) ? bounds.bound2_rad : bounds.bound1_rad) < 0.1f);
        engine.refine.along[axis] = along;
    }
}

static void a_mismatch_of_the_rates_is_a_floor_that_more_data_do_not_lower(void)
{
    motion_t motion = motion_lively(2);
    motion.gyr_noise_rad_s = QUIET_RAD_S;
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

/* What float loses in elimination and eigenvectors where information differs by some powers of ten: 1e-7 each. */
static void assert_bounds_in_double(float tolerance)
{
    double expected[2];
    double inflation;
    bounds_in_double(&engine, expected, &inflation);
    TEST_ASSERT_FLOAT_WITHIN(tolerance * (float)expected[0], (float)expected[0], bounds.bound1_rad);
    TEST_ASSERT_FLOAT_WITHIN(tolerance * (float)expected[1], (float)expected[1], bounds.bound2_rad);
    TEST_ASSERT_FLOAT_WITHIN(tolerance * (float)inflation, (float)inflation, bounds.inflation);
}

static void bounds_equal_their_formula_in_double(void)
{
    for (uint32_t seed = 0; seed < 6; ++seed) {
        motion_t motion = motion_lively(seed);
        motion.gyr_noise_rad_s = 0.01 * (1.0 + (double)seed);
        motion.acc_noise_m_s2 = 0.5;
        engine.cfg.rate_mismatch = 0.002f * (float)seed;
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, 1500, ((seed % 2u) == 0u) ? 0.02f : 0.3f));
        assert_bounds_in_double(1e-4f);
        TEST_ASSERT_TRUE(bounds.bound1_rad < 0.2f); /* so that something is compared */
    }
}

static void bounds_of_hardly_moving_segments_equal_their_formula_in_double(void)
{
    for (uint32_t seed = 0; seed < 6; ++seed) {
        motion_t motion = motion_lively(seed);
        motion.speed = 0.02; /* segment 1 turns a little, segment 2 about the joint */
        motion.gyr_noise_rad_s = 0.005 + (0.002 * (double)seed);
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, 3000, 0.05f));
        assert_bounds_in_double(1e-3f);
    }
}

static void bounds_of_planar_motion_equal_their_formula_in_double(void)
{
    planar = true;
    for (uint32_t seed = 0; seed < 6; ++seed) {
        const motion_t motion = motion_lively(seed);
        TEST_ASSERT_TRUE(bounds_of(&motion, 0, 800, 0.05f));
        assert_bounds_in_double(1e-3f);
        /* Wider than the linear model says: that holds while a tilt makes less than a fifth of the rate across, here
           0.01 rad/s of noise, and the rate along is above 1 rad/s. */
        TEST_ASSERT_TRUE((bounds.bound1_rad > 0.002f) && (bounds.bound1_rad < 0.5f));
    }
}

static void information_below_one_reading_at_one_radian_is_none(void)
{
    jcal_hinge_refine_t *const refine = &engine.refine;
    jcal_hinge_point_set(&engine.coarse.point, jcal_vec3(1.0f, 0.0f, 0.0f), jcal_vec3(0.0f, 1.0f, 0.0f));
    jcal_hinge_refine_restart(refine, &engine.coarse.point);
    refine->blocks = 100.0f;
    refine->time_s = 5.0f;
    refine->information = 100.0f;
    refine->information2 = 100.0f;
    engine.cfg.rate_mismatch = 0.0f;
    refine->across = 1e8f; /* so that a tilt of any size is small beside what it would change */
    refine->alike.change = 1.0f;
    refine->along[0] = 1e4f;
    refine->along[1] = 1e4f;
    for (size_t i = 0; i < 4; ++i) {
        refine->matrix[jcal_sym_at(i, i)] = 1.1f;
    }
    TEST_ASSERT_TRUE(jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds));
    assert_bounds_in_double(1e-4f);
    TEST_ASSERT_TRUE(bounds.bound1_rad < 1.5f);
    refine->matrix[jcal_sym_at(0, 0)] = 0.9f;
    TEST_ASSERT_TRUE(jcal_hinge_bounds(&engine.refine, &engine.coarse.moments, &engine.cfg, &bounds));
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, bounds.bound1_rad);
    TEST_ASSERT_TRUE(bounds.bound2_rad < 1.5f);
}

/* On an emulated target fewer: 95 in 100 of 40 axes, and half of 20 runs. */
#if defined(JCAL_TEST_SHORT)
enum { ENGINE_RUNS = 20 };
#else
enum { ENGINE_RUNS = 150 };
#endif

static void bounds_of_the_whole_engine_cover_its_errors_and_are_not_idle(void)
{
    uint32_t covered = 0;
    uint32_t sharp = 0;
    for (uint32_t seed = 0; seed < ENGINE_RUNS; ++seed) {
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
    TEST_ASSERT_TRUE(covered >= (2u * ENGINE_RUNS * 95u) / 100u);
    /* Noise alone is less than what the bounds allow for, soft tissue and mismatch; yet they keep to a measure. */
    TEST_ASSERT_TRUE(sharp > ENGINE_RUNS / 2u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(twice_the_data_with_noise_of_its_own_shrinks_the_bounds_by_the_root_of_two);
    RUN_TEST(a_stiff_joint_leaves_both_axes_open_however_long_it_is_watched);
    RUN_TEST(a_segment_at_rest_leaves_its_own_axis_open);
    RUN_TEST(with_less_than_four_blocks_nothing_is_said);
    RUN_TEST(sums_that_hold_nan_give_no_bound);
    RUN_TEST(an_axis_about_which_nothing_turned_has_no_bound);
    RUN_TEST(a_mismatch_of_the_rates_is_a_floor_that_more_data_do_not_lower);
    RUN_TEST(bounds_equal_their_formula_in_double);
    RUN_TEST(bounds_of_hardly_moving_segments_equal_their_formula_in_double);
    RUN_TEST(information_below_one_reading_at_one_radian_is_none);
    RUN_TEST(bounds_of_planar_motion_equal_their_formula_in_double);
    RUN_TEST(bounds_of_the_whole_engine_cover_its_errors_and_are_not_idle);
    return UNITY_END();
}
