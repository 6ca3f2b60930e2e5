/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/two_dof_auto.h: an elbow of a person and a rigid joint with two axes, from readings to what is said and for what.
#include "jointcal/two_axes_pair.h"
#include "jointcal/two_dof_auto.h"

#include "jointcal/quat.h"
#include "unit/two_axes/fixture.h"

enum { PERIOD_US = 10000 };

static jcal_two_dof_auto_t joint;
static hinge_t elbow;
static uint32_t pushed;
static int refused;

/* The first orientations after a gap are no good for either model. */
enum { MAX_REFUSED = 3 };

/* So far skin turns sensor 2 on its segment: no rigid joint has that. */
#define SKIN_RAD (4.0 * HINGE_DEG)

static jcal_pair_t pair_now(void)
{
    const double t = (double)pushed * 1e-6 * PERIOD_US;
    hinge_sensor_t s[2];
    for (int which = 0; which < 2; ++which) {
        hinge_sensor(&elbow, t, which + 1, &s[which]);
        for (int i = 0; i < 3; ++i) { /* real sensors do not repeat themselves at rest */
            s[which].gyr[i] += 1e-3 * sin((11.0 + 2.0 * which) * pushed + i);
            s[which].force[i] += 1e-2 * sin((17.0 + 2.0 * which) * pushed + i);
        }
    }
    const jcal_pair_t out = {1000u + (uint64_t)pushed * PERIOD_US,
                             {to_vec3(s[0].gyr), to_vec3(s[0].force)},
                             {to_vec3(s[1].gyr), to_vec3(s[1].force)}};
    return out;
}

static jcal_two_dof_auto_result_t result(void)
{
    jcal_two_dof_auto_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_auto_get(&joint, &out));
    return out;
}

/* The sine of the carrying angle that the orientations made here and both axes say. */
static double carrying_now(const jcal_two_dof_result_t *said)
{
    const jcal_quat_t relative = jcal_two_axes_pair_relative(&joint.functional);
    return (double)jcal_vec3_dot(said->axis1, jcal_quat_rotate(relative, said->axis2));
}

static void move(elbow_motion_t motion, double seconds)
{
    elbow_do(&elbow, motion);
    for (uint32_t end = pushed + (uint32_t)(seconds * 100.0); pushed < end; ++pushed) {
        const jcal_pair_t pair = pair_now();
        const jcal_status_t status = jcal_two_dof_auto_update(&joint, &pair, NULL);
        refused += (status == JCAL_REJECTED) ? 1 : 0;
        TEST_ASSERT_TRUE(status == JCAL_OK || (status == JCAL_REJECTED && refused <= MAX_REFUSED));
    }
}

/* A gap: what is read between two motions belongs to neither. */
static void leave_out(elbow_motion_t motion, double seconds)
{
    elbow_do(&elbow, motion);
    pushed += (uint32_t)(seconds * 100.0);
    const jcal_pair_t pair = pair_now();
    (void)jcal_two_dof_auto_update(&joint, &pair, NULL);
    ++pushed;
}

static void begin(const jcal_two_dof_auto_config_t *config)
{
    const jcal_two_dof_auto_config_t usual = jcal_two_dof_auto_config_default();
    pushed = 0u;
    refused = 0;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_auto_init(&joint, (config != NULL) ? config : &usual));
}

void setUp(void)
{
    elbow = elbow_usual();
    elbow.rest_s = 1.0; /* the level frames are right from the beginning */
    elbow.skin_rad = SKIN_RAD;
    begin(NULL);
}

void tearDown(void)
{
}

/* Each axis by itself, and when both are known the joint, for angles: skin makes bounds too wide for axes. */
static void an_elbow_of_a_person(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_RIGID, result().model);
    move(BEND, 40.0);
    jcal_two_dof_auto_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_FUNCTIONAL, r.model);
    TEST_ASSERT_TRUE(r.for_heading && r.for_axis1);
    TEST_ASSERT_FALSE(r.for_axis2);
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_NOTHING, r.ready_for);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_TURN_ONLY, r.two_dof.head.hint);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS2, r.two_dof.head.weak);
    TEST_ASSERT_TRUE(line_angle(r.two_dof.axis1, elbow_axis(&elbow, 1)) < (double)r.two_dof.uncertainty1_rad);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_vec3_norm(r.two_dof.axis2));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, r.two_dof.carrying_angle_rad);
    leave_out(TURN, 1.0);
    move(TURN, 40.0);
    r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.two_dof.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_FUNCTIONAL, r.model);
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_ANGLES, r.ready_for);
    TEST_ASSERT_TRUE(r.for_heading && r.for_axis1 && r.for_axis2 && r.two_dof.has_axes);
    TEST_ASSERT_TRUE(line_angle(r.two_dof.axis2, elbow_axis(&elbow, 2)) < (double)r.two_dof.uncertainty2_rad);
    TEST_ASSERT_EQUAL_FLOAT(r.ball.heading.heading_rad, r.two_dof.heading_offset_rad);
    TEST_ASSERT_EQUAL_FLOAT(r.ball.uncertainty_heading_rad, r.two_dof.uncertainty_heading_rad);
    TEST_ASSERT_EQUAL_UINT32(pushed - 101u, r.two_dof.head.samples); /* without the gap, and the first after it */
    /* y of the upper arm and x of the forearm are perpendicular; it is a mean, over skin that rocks by SKIN_RAD */
    TEST_ASSERT_DOUBLE_WITHIN(2.0 * SKIN_RAD, 0.0, (double)r.two_dof.carrying_angle_rad);
    TEST_ASSERT_DOUBLE_WITHIN(2.0 * SKIN_RAD, carrying_now(&r.two_dof), (double)r.two_dof.carrying_angle_rad);
    /* with a limit that is met the same joint is one for axes */
    joint.max_bound_rad = 0.5f;
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_AXES, result().ready_for);
}

/* The sign of the carrying angle follows the signs of the axes that are reported. */
static void axes_point_where_one_asks(void)
{
    jcal_two_dof_auto_config_t config = jcal_two_dof_auto_config_default();
    const jcal_vec3_t away = jcal_vec3_scale(elbow_axis(&elbow, 2), -1.0f);
    config.people.axis1_toward = elbow_axis(&elbow, 1);
    config.people.axis2_toward = away;
    begin(&config);
    move(BEND, 40.0);
    leave_out(TURN, 1.0);
    move(TURN, 40.0);
    const jcal_two_dof_auto_result_t r = result();
    TEST_ASSERT_TRUE(jcal_vec3_dot(r.two_dof.axis1, config.people.axis1_toward) > 0.9f);
    TEST_ASSERT_TRUE(jcal_vec3_dot(r.two_dof.axis2, away) > 0.9f);
    TEST_ASSERT_DOUBLE_WITHIN(2.0 * SKIN_RAD, carrying_now(&r.two_dof), (double)r.two_dof.carrying_angle_rad);
}

/* A rigid joint is the rigid model's: sharper, and with it all is known at once. */
static void a_rigid_joint(void)
{
    elbow.skin_rad = 0.0;
    for (int k = 0; (k < 12) && (result().two_dof.head.status != JCAL_READY); ++k) {
        move(BOTH, 10.0);
    }
    const jcal_two_dof_auto_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.two_dof.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_RIGID, r.model);
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_AXES, r.ready_for);
    TEST_ASSERT_TRUE(r.for_heading && r.for_axis1 && r.for_axis2);
    TEST_ASSERT_TRUE(line_angle(r.two_dof.axis1, elbow_axis(&elbow, 1)) < (double)r.two_dof.uncertainty1_rad);
    TEST_ASSERT_TRUE(line_angle(r.two_dof.axis2, elbow_axis(&elbow, 2)) < (double)r.two_dof.uncertainty2_rad);
}

static void a_gap_loses_the_heading_and_a_reset_everything(void)
{
    move(BEND, 40.0);
    TEST_ASSERT_TRUE(result().for_heading);
    leave_out(BEND, 3.0);
    move(BEND, 0.3); /* the first tick after the gap */
    TEST_ASSERT_FALSE(result().for_heading);
    TEST_ASSERT_TRUE(isnan(jcal_two_axes_pair_relative(&joint.functional).w));
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_NOTHING, result().ready_for);
    move(BEND, 15.0);
    TEST_ASSERT_TRUE(result().for_heading && result().for_axis1);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_auto_reset(&joint));
    const jcal_two_dof_auto_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_RIGID, r.model);
    TEST_ASSERT_FALSE(r.for_heading || r.for_axis1 || r.for_axis2 || r.two_dof.has_axes);
    TEST_ASSERT_EQUAL_UINT32(0u, r.two_dof.head.samples);
}

/* Orientations of the user's that begin anew are the rigid model's matter. */
static void a_restart_is_of_the_rigid_model(void)
{
    move(BEND, 40.0);
    const uint32_t before = result().ball.head.samples;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_auto_restart(&joint));
    TEST_ASSERT_EQUAL_UINT32(0u, result().two_dof.head.samples);
    TEST_ASSERT_EQUAL_UINT32(before, result().ball.head.samples);
    TEST_ASSERT_TRUE(result().for_axis1);
}

/* What both models are given is no good: that is said, not that of a person. */
static void bad_samples_speak_first(void)
{
    move(BEND, 40.0);
    jcal_pair_t pair = pair_now();
    for (int k = 0; k < 400; ++k) {
        pair.t_us += PERIOD_US;
        pair.imu1.gyr_rad_s.x = NAN;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_two_dof_auto_update(&joint, &pair, NULL));
    }
    TEST_ASSERT_FALSE(result().for_heading || result().for_axis1);
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_NOTHING, result().ready_for);
}

static void orientations_of_both_sensors(void)
{
    move(BEND, 3.0);
    for (unsigned which = 1u; which <= 2u; ++which) {
        const jcal_quat_t q = jcal_two_dof_auto_orientation(&joint, which);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.0f, (q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z));
    }
    const jcal_quat_t q1 = jcal_two_dof_auto_orientation(&joint, 1u);
    const jcal_quat_t q2 = jcal_two_dof_auto_orientation(&joint, 2u);
    TEST_ASSERT_TRUE(fabsf(q1.x - q2.x) + fabsf(q1.y - q2.y) > 0.1f);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_two_dof_auto_orientation(NULL, 1u).w);
}

static void null_and_wrong_settings_are_errors(void)
{
    jcal_two_dof_auto_config_t config = jcal_two_dof_auto_config_default();
    jcal_two_dof_auto_result_t out;
    const jcal_pair_t pair = pair_now();
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_auto_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_auto_init(&joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_auto_update(NULL, &pair, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_auto_update(&joint, NULL, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_auto_get(NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_auto_get(&joint, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_auto_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_auto_restart(NULL));
    TEST_ASSERT_EQUAL_STRING("config", jcal_two_dof_auto_config_check(NULL));
    TEST_ASSERT_NULL(jcal_two_dof_auto_config_check(&config));
    config.people.max_bound_rad = NAN;
    TEST_ASSERT_NOT_NULL(jcal_two_dof_auto_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_two_dof_auto_init(&joint, &config));
    config = jcal_two_dof_auto_config_default();
    config.two_dof.max_bound_rad = -1.0f;
    TEST_ASSERT_NOT_NULL(jcal_two_dof_auto_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_two_dof_auto_init(&joint, &config));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_elbow_of_a_person);
    RUN_TEST(axes_point_where_one_asks);
    RUN_TEST(a_rigid_joint);
    RUN_TEST(a_gap_loses_the_heading_and_a_reset_everything);
    RUN_TEST(a_restart_is_of_the_rigid_model);
    RUN_TEST(bad_samples_speak_first);
    RUN_TEST(orientations_of_both_sensors);
    RUN_TEST(null_and_wrong_settings_are_errors);
    return UNITY_END();
}
