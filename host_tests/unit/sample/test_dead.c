/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/gate.h: components that are dead, and what only looks so.
#include "unit/sample/gate_fixture.h"

#define STEP_S 0.02f

/* Both sensors turn about all axes, gravity with them; a little noise. `seen` changes what the gate sees. */
static jcal_vec3_t gravity;

static jcal_pair_t turning(uint32_t k)
{
    const float t = STEP_S * (float)k;
    jcal_pair_t pair = good();
    const jcal_vec3_t w = {1.2f * sinf(1.9f * t), 1.5f * cosf(1.3f * t), 1.1f * sinf(2.3f * t + 1.0f)};
    gravity = (k == 0u) ? jcal_vec3(3.0f, 5.0f, 7.8f) : gravity;
    gravity = jcal_vec3_add(gravity, jcal_vec3_scale(jcal_vec3_cross(gravity, w), STEP_S));
    gravity = jcal_vec3_scale(jcal_vec3_normalise(gravity), 9.81f);
    pair.imu1.gyr_rad_s = jcal_vec3_add(w, jcal_vec3_scale(pair.imu1.gyr_rad_s, 0.1f));
    pair.imu1.acc_m_s2 = jcal_vec3_add(gravity, jcal_vec3_scale(pair.imu1.acc_m_s2, 0.01f));
    pair.imu2 = pair.imu1;
    return pair;
}

/* Rejected as frozen from sample `from` on, of 250. */
static uint32_t frozen_with(int field, float value, int copy_of, uint32_t from, uint32_t until)
{
    setUp();
    uint32_t frozen = 0;
    for (uint32_t k = 0; k < 250u; ++k) {
        jcal_pair_t pair = turning(k);
        if ((k >= from) && (k < until)) {
            *component(&pair, field) = (copy_of >= 0) ? *component(&pair, copy_of) : value;
        }
        const jcal_reject_t cause = check(&pair);
        frozen += (cause == JCAL_REJECT_FROZEN) ? 1u : 0u;
        TEST_ASSERT_TRUE((cause == JCAL_REJECT_FROZEN) || (cause == JCAL_REJECT_NONE));
    }
    return frozen;
}

static void components_that_live_are_not_dead(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, frozen_with(0, 0.0f, -1, 999u, 999u));
}

static void a_component_that_is_always_zero_or_stuck_is_noticed_within_two_seconds(void)
{
    for (int field = 0; field < 12; ++field) {
        const float values[2] = {0.0f, is_rate(field) ? 0.19f : 5.5f};
        for (int i = 0; i < 2; ++i) {
            TEST_ASSERT_TRUE(frozen_with(field, values[i], -1, 0u, 999u) > 150u);
            TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, jcal_gate_complaint(&gate));
            TEST_ASSERT_TRUE(frozen_with(field, values[i], -1, 100u, 999u) > 50u);
            TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, jcal_gate_complaint(&gate));
        }
    }
}

static void a_component_that_lives_again_is_forgiven(void)
{
    for (int field = 0; field < 12; ++field) {
        const uint32_t frozen = frozen_with(field, 0.0f, -1, 0u, 120u);
        TEST_ASSERT_TRUE((frozen > 20u) && (frozen < 120u));
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_gate_complaint(&gate)); /* 2.6 s later */
    }
}

static void a_component_that_repeats_another_is_noticed(void)
{
    for (int field = 0; field < 12; ++field) {
        const int first = field - (field % 3);
        for (int other = first; other < (first + 3); ++other) {
            if (other != field) {
                TEST_ASSERT_TRUE(frozen_with(field, 0.0f, other, 0u, 999u) > 100u);
            }
        }
    }
}

static void all_components_of_a_gyroscope_or_an_accelerometer_may_be_stuck(void)
{
    for (int first = 0; first < 12; first += 3) {
        setUp();
        for (uint32_t k = 0; k < 250u; ++k) {
            jcal_pair_t pair = turning(k);
            for (int i = 0; i < 3; ++i) {
                *component(&pair, first + i) = is_rate(first) ? 0.1f : 5.0f;
            }
            (void)check(&pair);
        }
        TEST_ASSERT_TRUE(gate.rejected_by[JCAL_REJECT_FROZEN] > 125u);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, jcal_gate_complaint(&gate));
    }
}

/* A motion in one plane without noise, about an axis of each kind: some components are zero, or the same, for good. */
static void motion_in_a_plane_without_noise_is_not_dead(void)
{
    const jcal_vec3_t axes[] = {{0.0f, 0.0f, 1.0f}, {0.6f, 0.8f, 0.0f}, {0.70710678f, 0.0f, 0.70710678f}};
    const jcal_vec3_t starts[] = {{9.81f, 0.0f, 0.0f}, {0.0f, 0.0f, 9.81f}, {0.0f, 9.81f, 0.0f}};
    for (int i = 0; i < 3; ++i) {
        setUp();
        for (uint32_t k = 0; k < 1000u; ++k) {
            const float t = STEP_S * (float)k;
            const float angle = 1.1f * sinf(1.7f * t);
            const jcal_vec3_t across = jcal_vec3_cross(starts[i], axes[i]);
            jcal_pair_t pair = good();
            pair.imu1.gyr_rad_s = jcal_vec3_scale(axes[i], 1.1f * 1.7f * cosf(1.7f * t));
            pair.imu1.acc_m_s2 =
                jcal_vec3_add(jcal_vec3_scale(starts[i], cosf(angle)), jcal_vec3_scale(across, sinf(angle)));
            pair.imu2 = pair.imu1;
            TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(components_that_live_are_not_dead);
    RUN_TEST(a_component_that_is_always_zero_or_stuck_is_noticed_within_two_seconds);
    RUN_TEST(a_component_that_lives_again_is_forgiven);
    RUN_TEST(a_component_that_repeats_another_is_noticed);
    RUN_TEST(all_components_of_a_gyroscope_or_an_accelerometer_may_be_stuck);
    RUN_TEST(motion_in_a_plane_without_noise_is_not_dead);
    return UNITY_END();
}
