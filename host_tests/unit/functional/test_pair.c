/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/functional_pair.h: readings of two exact sensors on a made-up hinge, through stages of their own.
#include "jointcal/functional_pair.h"

#include "unit/functional/fixture.h"

enum { PERIOD_US = 10000 };

static jcal_functional_pair_t joint;
static hinge_t hinge;

static jcal_pair_t pair_at(uint32_t k)
{
    const double t = (double)k * 1e-6 * PERIOD_US;
    hinge_sensor_t s1;
    hinge_sensor_t s2;
    hinge_sensor(&hinge, t, 1, &s1);
    hinge_sensor(&hinge, t, 2, &s2);
    for (int i = 0; i < 3; ++i) { /* real sensors do not repeat themselves at rest */
        s1.gyr[i] += 1e-3 * sin(11.0 * k + i);
        s2.gyr[i] += 1e-3 * sin(13.0 * k + i);
        s1.force[i] += 1e-2 * sin(17.0 * k + i);
        s2.force[i] += 1e-2 * sin(19.0 * k + i);
    }
    const jcal_pair_t out = {
        1000u + (uint64_t)k * PERIOD_US, {to_vec3(s1.gyr), to_vec3(s1.force)}, {to_vec3(s2.gyr), to_vec3(s2.force)}};
    return out;
}

static jcal_functional_result_t result(void)
{
    jcal_functional_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_pair_get(&joint, &out));
    return out;
}

void setUp(void)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    hinge = hinge_usual();
    hinge.rest_s = 1.0; /* the level frames are right from the beginning */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_pair_init(&joint, &config, NULL));
}

void tearDown(void)
{
}

/* From readings to axes, and to an angle that is the joint's but for a constant. */
static void readings_become_axes_and_an_angle(void)
{
    const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
    const jcal_vec3_t true2 = hinge_axis(&hinge, 2, 0.0);
    double zero = 0.0;
    int compared = 0;
    TEST_ASSERT_TRUE(isnan(jcal_functional_pair_flexion(&joint)));
    for (uint32_t k = 0; k < 2000u; ++k) {
        const jcal_pair_t pair = pair_at(k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_pair_update(&joint, &pair));
        const jcal_functional_result_t now = result();
        if (now.head.status != JCAL_READY) {
            continue;
        }
        const float sign = (jcal_vec3_dot(now.axis1, true1) < 0.0f) ? -1.0f : 1.0f;
        TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(now.axis1, sign), true1) < now.uncertainty1_rad);
        TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(now.axis2, sign), true2) < now.uncertainty2_rad);
        /* at 100 Hz a rate that holds for a sample is half a sample late: 5 ms of up to 3 rad/s, and the inclination's own error */
        const double off =
            (double)(sign * jcal_functional_pair_flexion(&joint)) - hinge_angle(&hinge, (double)k * 0.01);
        zero = (compared++ == 0) ? off : zero;
        TEST_ASSERT_DOUBLE_WITHIN(2.5 * HINGE_DEG, 0.0, remainder(off - zero, 2.0 * MOTION_PI));
    }
    TEST_ASSERT_TRUE(compared > 1000);
    TEST_ASSERT_EQUAL_UINT32(2000u, result().head.samples);
}

/* What cannot be is counted and leaves the estimate alone. */
static void readings_that_cannot_be_are_rejected(void)
{
    for (uint32_t k = 0; k < 800u; ++k) {
        const jcal_pair_t pair = pair_at(k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_pair_update(&joint, &pair));
    }
    const jcal_functional_t before = joint.joint;
    jcal_pair_t pair = pair_at(800u);
    pair.imu2.acc_m_s2.y = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_pair_update(&joint, &pair));
    pair = pair_at(400u);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_pair_update(&joint, &pair));
    TEST_ASSERT_EQUAL_MEMORY(&before, &joint.joint, sizeof before);
    TEST_ASSERT_EQUAL_UINT32(1u, result().head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_UINT32(1u, result().head.rejected_by[JCAL_REJECT_TIME_ORDER]);
}

/* The gate does not look at the values of the first reading after a gap. If one sensor alone refused it, ticks of both would not be of the
   same times ever after. */
static void sensors_stay_in_step_after_a_gap(void)
{
    uint32_t k = 0u;
    for (; k < 400u; ++k) {
        const jcal_pair_t pair = pair_at(k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_pair_update(&joint, &pair));
    }
    const uint32_t before = joint.joint.ticks.count;
    k += 40u;
    jcal_pair_t pair = pair_at(k);
    pair.imu2.gyr_rad_s.x = 250.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_pair_update(&joint, &pair));
    for (uint32_t end = k + 400u; k < end;) {
        pair = pair_at(++k);
        (void)jcal_functional_pair_update(&joint, &pair);
    }
    TEST_ASSERT_TRUE(joint.joint.ticks.count > before + (before / 2u));
}

static void null_and_wrong_settings_are_errors(void)
{
    jcal_functional_config_t config = jcal_functional_config_default();
    const jcal_pair_t pair = pair_at(0u);
    jcal_functional_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_pair_init(NULL, &config, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_pair_init(&joint, NULL, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_pair_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_pair_update(&joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_pair_get(NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_pair_get(&joint, NULL));
    TEST_ASSERT_TRUE(isnan(jcal_functional_pair_flexion(NULL)));
    jcal_gate_config_t limits = jcal_gate_config_default();
    limits.frozen_s = NAN;
    const jcal_functional_pair_t before = joint;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_functional_pair_init(&joint, &config, &limits));
    config.max_bound_rad = 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_functional_pair_init(&joint, &config, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &joint, sizeof before);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(readings_become_axes_and_an_angle);
    RUN_TEST(readings_that_cannot_be_are_rejected);
    RUN_TEST(sensors_stay_in_step_after_a_gap);
    RUN_TEST(null_and_wrong_settings_are_errors);
    return UNITY_END();
}
