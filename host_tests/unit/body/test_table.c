/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/body_config.h: what a table and settings must be, and what is said of those that are otherwise.
#include "unit/body/fixture.h"

static body_fixture_t f;

void setUp(void)
{
    body_fill(&f, 4u);
}

void tearDown(void)
{
}

static void refused_as(const char *word, unsigned where)
{
    unsigned at = 99u;
    TEST_ASSERT_EQUAL_STRING(word, jcal_body_table_check(&f.table, &at));
    TEST_ASSERT_EQUAL_UINT(where, at);
    const jcal_body_t before = f.body;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_init(&f.body, &f.table, &f.config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &f.body, sizeof before);
    body_fill(&f, 4u);
}

static void a_chain_and_trees_are_taken(void)
{
    unsigned at = 99u;
    TEST_ASSERT_NULL(jcal_body_table_check(&f.table, &at));
    TEST_ASSERT_EQUAL_UINT(0u, at);
    body_begin(&f);
    f.joints[2].proximal = 0u; /* two limbs of one trunk */
    TEST_ASSERT_NULL(jcal_body_table_check(&f.table, NULL));
    f.table.joint_count = 1u; /* two sensors of four are on no joint */
    TEST_ASSERT_NULL(jcal_body_table_check(&f.table, NULL));
}

static void what_is_missing_is_named(void)
{
    TEST_ASSERT_EQUAL_STRING("table", jcal_body_table_check(NULL, NULL));
    f.table.sensor_count = 1u;
    refused_as("sensor_count", 0u);
    f.table.sensor_count = JCAL_BODY_SENSORS_MAX + 1u;
    refused_as("sensor_count", 0u);
    f.table.joint_count = 0u;
    refused_as("joint_count", 0u);
    f.table.joint_count = JCAL_BODY_JOINTS_MAX + 1u;
    refused_as("joint_count", 0u);
    f.table.sensors = NULL;
    refused_as("sensors", 0u);
    f.table.sensor_states = NULL;
    refused_as("sensor_states", 0u);
    f.table.joints = NULL;
    refused_as("joints", 0u);
    f.table.joint_states = NULL;
    refused_as("joint_states", 0u);
    f.sensors[2].packets = NULL;
    refused_as("packets", 2u);
    f.sensors[3].storage = NULL;
    refused_as("packets", 3u);
}

static void joints_that_cannot_be_are_named(void)
{
    f.joints[1].distal = 4u;
    refused_as("no_such_sensor", 1u);
    f.joints[2].proximal = 4u;
    refused_as("no_such_sensor", 2u);
    f.joints[1].distal = 1u;
    refused_as("same_sensor", 1u);
    f.joints[2].distal = 2u;
    f.joints[2].proximal = 3u;
    refused_as("distal_twice", 2u);
    f.joints[0].kind = JCAL_BODY_KIND_COUNT;
    refused_as("no_such_kind", 0u);
    f.joints[1].engine.hinge = NULL;
    refused_as("engine", 1u);
    memset(&f.hinges[1], 0, sizeof f.hinges[1]); /* never prepared */
    refused_as("engine", 1u);
}

/* 0 - 1 - 2 - 0 is a circle; sensor 3 is apart. */
static void a_circle_is_refused(void)
{
    f.joints[2].proximal = 2u;
    f.joints[2].distal = 0u;
    refused_as("circle", 0u);
    f.joints[0].proximal = 3u; /* 3 - 0, and 1 - 2 - 1 */
    f.joints[0].distal = 0u;
    f.joints[2].distal = 1u;
    refused_as("circle", 1u);
}

static void every_kind_needs_its_own_engine(void)
{
    static jcal_ball_t ball;
    static jcal_two_axes_t elbow;
    memset(&ball, 0, sizeof ball);
    memset(&elbow, 0, sizeof elbow);
    f.joints[0].kind = JCAL_BODY_BALL;
    f.joints[0].engine.ball = &ball;
    f.joints[1].kind = JCAL_BODY_TWO_AXES;
    f.joints[1].engine.two_axes = &elbow;
    TEST_ASSERT_EQUAL_STRING("engine", jcal_body_table_check(&f.table, NULL));
    const jcal_ball_config_t ball_config = jcal_ball_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_init(&ball, &ball_config));
    unsigned at;
    TEST_ASSERT_EQUAL_STRING("engine", jcal_body_table_check(&f.table, &at));
    TEST_ASSERT_EQUAL_UINT(1u, at);
    const jcal_two_axes_config_t elbow_config = jcal_two_axes_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_init(&elbow, &elbow_config));
    TEST_ASSERT_NULL(jcal_body_table_check(&f.table, &at));
    body_begin(&f);
    for (unsigned j = 0u; j < 3u; ++j) {
        const jcal_body_joint_result_t joint = body_joint(&f, j);
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, joint.head.status);
        TEST_ASSERT_TRUE((0u) == (joint.head.t_us));
        TEST_ASSERT_FALSE(joint.lag_known);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_LAG_UNKNOWN_S, joint.lag_bound_s);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, joint.uncertainty1_rad);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, joint.relative_bound_rad);
        TEST_ASSERT_TRUE(isnan(joint.flexion_rad));
        TEST_ASSERT_TRUE(isnan(joint.relative.w));
    }
}

static void settings_out_of_range_are_named(void)
{
    static const struct {
        const char *name;
        float low, high;
    } of[4] = {
        {"period_s", 0.0039f, 0.051f}, {"gap_s", 0.004f, 0.11f}, {"wait_s", 0.04f, 2.1f}, {"examine_s", 4.9f, 601.0f}};
    TEST_ASSERT_NULL(jcal_body_config_check(&f.config));
    TEST_ASSERT_EQUAL_STRING("config", jcal_body_config_check(NULL));
    for (size_t i = 0u; i < 4u; ++i) {
        const float values[3] = {of[i].low, of[i].high, NAN};
        for (size_t k = 0u; k < 3u; ++k) {
            jcal_body_config_t config = jcal_body_config_default();
            float *const fields[4] = {&config.period_s, &config.gap_s, &config.wait_s, &config.examine_s};
            *fields[i] = values[k];
            TEST_ASSERT_EQUAL_STRING(of[i].name, jcal_body_config_check(&config));
            TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_body_init(&f.body, &f.table, &config));
        }
    }
}

static void storage_that_is_too_small_is_an_error(void)
{
    f.sensors[1].storage_bytes -= 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_body_init(&f.body, &f.table, &f.config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_step(&f.body, 0u, 50u));
}

/* Before init, null, and numbers beyond the tables: an error, and nothing is written. */
static void calls_that_make_no_sense_are_errors(void)
{
    static jcal_body_t zeros;
    static const jcal_packet_t packet = {0};
    jcal_body_joint_result_t joint;
    jcal_body_sensor_result_t sensor;
    jcal_body_status_t status;
    jcal_body_event_t event;
    jcal_body_advice_t advice;
    char text[8];
    memset(&advice, 0, sizeof advice);
    jcal_body_t *const bodies[2] = {NULL, &zeros};
    for (size_t k = 0u; k < 2u; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_push(bodies[k], 0u, &packet));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_step(bodies[k], 0u, 50u));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_event(bodies[k], &event));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_joint(bodies[k], 0u, &joint));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_sensor(bodies[k], 0u, &sensor));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_status(bodies[k], &status));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_advice(bodies[k], &advice));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_sentence(bodies[k], &advice, text, sizeof text));
    }
    body_begin(&f);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_init(NULL, &f.table, &f.config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_init(&f.body, &f.table, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_push(&f.body, 4u, &packet));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_push(&f.body, 0u, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_event(&f.body, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_joint(&f.body, 3u, &joint));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_joint(&f.body, 0u, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_sensor(&f.body, 4u, &sensor));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_sensor(&f.body, 0u, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_status(&f.body, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_body_advice(&f.body, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_body_event(&f.body, &event));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_body_step(&f.body, 1u, 50u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_chain_and_trees_are_taken);
    RUN_TEST(what_is_missing_is_named);
    RUN_TEST(joints_that_cannot_be_are_named);
    RUN_TEST(a_circle_is_refused);
    RUN_TEST(every_kind_needs_its_own_engine);
    RUN_TEST(settings_out_of_range_are_named);
    RUN_TEST(storage_that_is_too_small_is_an_error);
    RUN_TEST(calls_that_make_no_sense_are_errors);
    return UNITY_END();
}
