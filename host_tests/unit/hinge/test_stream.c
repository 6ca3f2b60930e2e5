/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge.h: what it finds, symmetries, long runs. What it refuses is in hinge/test_never.c.
#include "unit/hinge/fixture.h"

static void axes_and_pairing_are_recovered_for_any_mounting_and_become_ready(void)
{
    for (uint32_t mounting = 0; mounting < 16; ++mounting) {
        const motion_t motion = motion_lively(mounting);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
        for (uint32_t k = 0; k < RUN; ++k) {
            run(&engine, &motion, k, k + 1);
            const jcal_hinge_result_t r = result_of(&engine);
            assert_sane(&r);
            if (r.head.status == JCAL_READY) {
                TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis1, motion_axis(&motion, 0)) < config.max_bound_rad);
                TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis2, motion_axis(&motion, 1)) < config.max_bound_rad);
            }
        }
        const jcal_hinge_result_t r = result_of(&engine);
        assert_axes(&r, &motion);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_WEAK_NONE, r.head.weak);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_NONE, r.head.hint);
        TEST_ASSERT_TRUE(r.sign_margin > 1.3f);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, r.progress_axis1);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, r.progress_axis2);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, r.progress_sign);
    }
}

static void axes_are_recovered_at_every_rate(void)
{
    const double rates[8] = {10.0, 12.5, 19.0, 25.0, 40.0, 60.0, 128.0, 200.0};
    for (int i = 0; i < 8; ++i) {
        motion_t motion = motion_lively((uint32_t)i);
        motion.rate_hz = rates[i];
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
        run(&engine, &motion, 0, (uint32_t)(20.0 * rates[i]));
        const jcal_hinge_result_t r = result_of(&engine);
        assert_axes(&r, &motion);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    }
}

static void below_ten_samples_a_second_nothing_is_claimed_and_the_rate_is_named(void)
{
    const double rates[3] = {9.0, 6.0, 4.5};
    for (int i = 0; i < 3; ++i) {
        motion_t motion = motion_lively((uint32_t)i);
        motion.rate_hz = rates[i];
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
        for (uint32_t k = 0; k < 400u; ++k) {
            run(&engine, &motion, k, k + 1u);
            TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_RATE_TOO_LOW, result_of(&engine).head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, result_of(&engine).head.hint);
    }
}

static void the_largest_component_of_axis1_is_positive_and_axes_are_unit(void)
{
    for (uint32_t mounting = 20; mounting < 28; ++mounting) {
        const motion_t motion = motion_lively(mounting);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
        run(&engine, &motion, 0, 400);
        const jcal_hinge_result_t r = result_of(&engine);
        assert_normal_form(&r);
    }
}

static void either_pairing_is_found_without_a_hint_and_kept_with_the_right_one(void)
{
    for (int same = 0; same < 2; ++same) {
        const motion_t motion = motion_paired(same == 1);
        const jcal_sign_hint_t hints[2] = {JCAL_SIGN_UNKNOWN, (same == 1) ? JCAL_SIGN_SAME : JCAL_SIGN_OPPOSITE};
        for (int h = 0; h < 2; ++h) {
            config.sign_hint = hints[h];
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
            run(&engine, &motion, 0, RUN);
            const jcal_hinge_result_t r = result_of(&engine);
            assert_axes(&r, &motion);
            TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
            TEST_ASSERT_EQUAL_INT(same == 1, (r.axis1.z * r.axis2.z) > 0.0f);
        }
    }
}

static void a_hint_decides_the_pairing_even_against_the_data(void)
{
    for (int same = 0; same < 2; ++same) {
        const motion_t motion = motion_paired(same == 1);
        config.sign_hint = (same == 1) ? JCAL_SIGN_OPPOSITE : JCAL_SIGN_SAME; /* the user says the contrary */
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
        for (uint32_t k = 0; k < RUN; ++k) {
            run(&engine, &motion, k, k + 1);
            const jcal_hinge_result_t r = result_of(&engine);
            TEST_ASSERT_EQUAL_FLOAT(1.0f, r.progress_sign);
            if (k > 200) {
                TEST_ASSERT_EQUAL_INT(same == 0, (r.axis1.z * r.axis2.z) > 0.0f);
            }
        }
        TEST_ASSERT_TRUE(result_of(&engine).sign_margin < 1.0f);
    }
}

static void a_hint_that_the_data_contradict_is_never_ready(void)
{
    for (int same = 0; same < 2; ++same) {
        const motion_t motion = motion_paired(same == 1);
        config.sign_hint = (same == 1) ? JCAL_SIGN_OPPOSITE : JCAL_SIGN_SAME;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
        for (uint32_t k = 0; k < 3u * RUN; ++k) {
            run(&engine, &motion, k, k + 1);
            TEST_ASSERT_NOT_EQUAL(JCAL_READY, result_of(&engine).head.status);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_SIGN_OPEN, result_of(&engine).head.reason);
    }
}

static jcal_imu_t turned(const jcal_imu_t *imu, jcal_quat_t q)
{
    const jcal_imu_t out = {jcal_quat_rotate(q, imu->gyr_rad_s), jcal_quat_rotate(q, imu->acc_m_s2)};
    return out;
}

/* Symmetries hold for the minimum; the iteration towards it rounds differently. 0.05 deg is a tenth of the error that
   the noise leaves. Where the refined axes began is a matter of rounding too: the runs are long enough for it to matter little. */
#define SYMMETRY_RUN (4u * RUN)
static const float SYMMETRY_TOL_RAD = 0.05f * JCAL_RAD_PER_DEG;

static void turning_the_frame_of_sensor_1_turns_axis1_alone(void)
{
    const motion_t motion = motion_lively(30);
    const jcal_quat_t q = jcal_quat_normalise(jcal_quat(0.3f, -0.5f, 0.7f, 0.4f));
    jcal_hinge_t other = engine;
    for (uint32_t k = 0; k < SYMMETRY_RUN; ++k) {
        jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        pair.imu1 = turned(&pair.imu1, q);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&other, &pair));
    }
    const jcal_hinge_result_t a = result_of(&engine);
    const jcal_hinge_result_t b = result_of(&other);
    const jcal_vec3_t expected = jcal_quat_rotate(q, a.axis1);
    const float sign = (jcal_vec3_dot(expected, b.axis1) < 0.0f) ? -1.0f : 1.0f; /* axis1 is shown with its main + */
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(expected, sign), b.axis1) < SYMMETRY_TOL_RAD);
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(a.axis2, sign), b.axis2) < SYMMETRY_TOL_RAD);
    TEST_ASSERT_EQUAL_INT(a.head.status, b.head.status);
    TEST_ASSERT_FLOAT_WITHIN(0.1f * a.uncertainty1_rad, a.uncertainty1_rad, b.uncertainty1_rad);
    TEST_ASSERT_FLOAT_WITHIN(0.1f * a.uncertainty2_rad, a.uncertainty2_rad, b.uncertainty2_rad);
}

static void exchanging_the_sensors_exchanges_the_axes(void)
{
    const motion_t motion = motion_lively(31);
    jcal_hinge_t other = engine;
    for (uint32_t k = 0; k < SYMMETRY_RUN; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        const jcal_pair_t exchanged = {pair.t_us, pair.imu2, pair.imu1};
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&other, &exchanged));
    }
    const jcal_hinge_result_t a = result_of(&engine);
    const jcal_hinge_result_t b = result_of(&other);
    const float sign = (jcal_vec3_dot(a.axis1, b.axis2) < 0.0f) ? -1.0f : 1.0f;
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(a.axis1, sign), b.axis2) < SYMMETRY_TOL_RAD);
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(a.axis2, sign), b.axis1) < SYMMETRY_TOL_RAD);
    TEST_ASSERT_FLOAT_WITHIN(0.1f * a.uncertainty1_rad, a.uncertainty1_rad, b.uncertainty2_rad);
    TEST_ASSERT_FLOAT_WITHIN(0.1f * a.uncertainty2_rad, a.uncertainty2_rad, b.uncertainty1_rad);
}

static void gyroscope_and_accelerometer_biases_are_taken_up(void)
{
    /* 0.5 deg/s and 0.3 m/s^2, within the standard deviations of the config. Without bias states the slow stretches
       would turn the axes by degrees. */
    const motion_t motion = motion_lively(32);
    const jcal_vec3_t gyr1 = {0.006f, -0.005f, 0.004f};
    const jcal_vec3_t gyr2 = {-0.005f, 0.006f, 0.004f};
    const jcal_vec3_t acc2 = {0.2f, -0.2f, 0.1f};
    for (uint32_t k = 0; k < 4u * RUN; ++k) {
        jcal_pair_t pair = motion_sample(&motion, k);
        pair.imu1.gyr_rad_s = jcal_vec3_add(pair.imu1.gyr_rad_s, gyr1);
        pair.imu2.gyr_rad_s = jcal_vec3_add(pair.imu2.gyr_rad_s, gyr2);
        pair.imu2.acc_m_s2 = jcal_vec3_add(pair.imu2.acc_m_s2, acc2);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
    }
    const jcal_hinge_result_t r = result_of(&engine);
    assert_axes(&r, &motion);
    const jcal_hinge_axis_t *const axes[2] = {&engine.refine.point.axis1, &engine.refine.point.axis2};
    const jcal_vec3_t biases[2] = {gyr1, gyr2};
    for (int i = 0; i < 2; ++i) {
        const jcal_vec3_t v = jcal_vec3_cross(axes[i]->j, axes[i]->u);
        const float *const found = &engine.refine.bias[2 * i]; /* in standard deviations, along u and v */
        /* 0.1 deg/s: a third of what was there or less */
        TEST_ASSERT_FLOAT_WITHIN(0.1f * JCAL_RAD_PER_DEG, jcal_vec3_dot(biases[i], axes[i]->u),
                                 config.gyr_bias_rad_s * found[0]);
        TEST_ASSERT_FLOAT_WITHIN(0.1f * JCAL_RAD_PER_DEG, jcal_vec3_dot(biases[i], v),
                                 config.gyr_bias_rad_s * found[1]);
    }
    const float sign = (jcal_vec3_dot(axes[0]->j, motion_axis(&motion, 0)) < 0.0f) ? -1.0f : 1.0f;
    const float c = -sign * jcal_vec3_dot(motion_axis(&motion, 1), acc2);
    TEST_ASSERT_FLOAT_WITHIN(0.05f, c, engine.coarse.acc_constant_m_s2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(axes_and_pairing_are_recovered_for_any_mounting_and_become_ready);
    RUN_TEST(axes_are_recovered_at_every_rate);
    RUN_TEST(below_ten_samples_a_second_nothing_is_claimed_and_the_rate_is_named);
    RUN_TEST(the_largest_component_of_axis1_is_positive_and_axes_are_unit);
    RUN_TEST(either_pairing_is_found_without_a_hint_and_kept_with_the_right_one);
    RUN_TEST(a_hint_decides_the_pairing_even_against_the_data);
    RUN_TEST(a_hint_that_the_data_contradict_is_never_ready);
    RUN_TEST(turning_the_frame_of_sensor_1_turns_axis1_alone);
    RUN_TEST(exchanging_the_sensors_exchanges_the_axes);
    RUN_TEST(gyroscope_and_accelerometer_biases_are_taken_up);
    return UNITY_END();
}
