/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge_auto.h: a rigid hinge and one of a person, from readings to what is said and for what.
#include "auto/judge.h"
#include "jointcal/functional_pair.h"
#include "jointcal/hinge_auto.h"

#include "unit/functional/fixture.h"

enum { PERIOD_US = 10000 };

static jcal_hinge_auto_t knee;
static hinge_t hinge;

/* So far skin turns sensor 2 on its segment. */
#define SKIN_RAD (4.0 * HINGE_DEG)

static jcal_imu_t imu_at(double t, int which, uint32_t k)
{
    hinge_sensor_t s;
    hinge_sensor(&hinge, t, which, &s);
    for (int i = 0; i < 3; ++i) { /* real sensors do not repeat themselves at rest */
        s.gyr[i] += 1e-3 * sin((9.0 + 2.0 * which) * k + i);
        s.force[i] += 1e-2 * sin((15.0 + 2.0 * which) * k + i);
    }
    const jcal_imu_t out = {to_vec3(s.gyr), to_vec3(s.force)};
    return out;
}

static jcal_pair_t pair_at(uint32_t k)
{
    const double t = (double)k * 1e-6 * PERIOD_US;
    const jcal_pair_t out = {1000u + (uint64_t)k * PERIOD_US, imu_at(t, 1, k), imu_at(t, 2, k)};
    return out;
}

static jcal_hinge_auto_result_t result(void)
{
    jcal_hinge_auto_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_get(&knee, &out));
    return out;
}

static void feed(uint32_t from, uint32_t to)
{
    for (uint32_t k = from; k < to; ++k) {
        const jcal_pair_t pair = pair_at(k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_update(&knee, &pair));
    }
}

/* Feeds until it is ready; returns the number of the next sample. */
static uint32_t feed_until_ready(uint32_t most)
{
    uint32_t k = 0u;
    while (result().ready_for == JCAL_FOR_NOTHING) {
        TEST_ASSERT_TRUE_MESSAGE(k < most, "it did not become ready");
        feed(k, k + 1u);
        ++k;
    }
    return k;
}

static void begin(const jcal_hinge_auto_config_t *config)
{
    const jcal_hinge_auto_config_t usual = jcal_hinge_auto_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_init(&knee, (config != NULL) ? config : &usual));
}

void setUp(void)
{
    hinge = hinge_usual();
    hinge.rest_s = 1.0; /* the level frames are right from the beginning */
    begin(NULL);
}

void tearDown(void)
{
}

/* Angles between the axes that are said and the true ones, both with the sign that axis1 needs, as shares of their bounds. */
static void expect_axes_within(double shares, double t)
{
    const jcal_hinge_result_t h = result().hinge;
    hinge_t still = hinge; /* what skin does has no mean */
    still.skin_rad = 0.0;
    const jcal_vec3_t true1 = hinge_axis(&still, 1, t);
    const jcal_vec3_t true2 = hinge_axis(&still, 2, t);
    const float sign = (jcal_vec3_dot(h.axis1, true1) < 0.0f) ? -1.0f : 1.0f;
    TEST_ASSERT_TRUE((double)jcal_sphere_angle(jcal_vec3_scale(h.axis1, sign), true1) <
                     shares * (double)h.uncertainty1_rad);
    TEST_ASSERT_TRUE((double)jcal_sphere_angle(jcal_vec3_scale(h.axis2, sign), true2) <
                     shares * (double)h.uncertainty2_rad);
}

/* The angle grows about the axis that is reported: it is the true one with that sign, but for a constant. */
static void expect_flexion(uint32_t from, uint32_t to, double tolerance_rad)
{
    const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
    double zero = 0.0;
    for (uint32_t k = from; k < to; ++k) {
        feed(k, k + 1u);
        const double sign = (jcal_vec3_dot(result().hinge.axis1, true1) < 0.0f) ? -1.0 : 1.0;
        const double off =
            (double)jcal_hinge_auto_flexion(&knee) - sign * hinge_angle(&hinge, (double)k * 1e-6 * PERIOD_US);
        zero = (k == from) ? off : zero;
        TEST_ASSERT_DOUBLE_WITHIN(tolerance_rad, 0.0, remainder(off - zero, 2.0 * MOTION_PI));
    }
}

static void rigid_segments_are_the_rigid_models(void)
{
    TEST_ASSERT_TRUE(isnan(jcal_hinge_auto_flexion(&knee)));
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_NOTHING, result().ready_for);
    const uint32_t k = feed_until_ready(1500u);
    for (int n = 0; n < 10; ++n) {
        feed(k + 100u * (uint32_t)n, k + 100u * (uint32_t)(n + 1));
        TEST_ASSERT_EQUAL_INT(JCAL_MODEL_RIGID, result().model);
        TEST_ASSERT_EQUAL_INT(JCAL_FOR_AXES, result().ready_for);
        expect_axes_within(1.0, 0.0);
    }
    knee.person = true; /* whatever the rates say, this one is ready */
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_RIGID, result().model);
    knee.person = false;
    const jcal_hinge_auto_result_t now = result();
    TEST_ASSERT_TRUE(now.has_levers && now.heading.known && (now.bend_rad > 0.1f));
    TEST_ASSERT_TRUE((now.flexion_uncertainty_rad > 0.0f) &&
                     (now.flexion_uncertainty_rad < now.hinge.uncertainty1_rad));
    TEST_ASSERT_TRUE(now.gravity_off_m_s2 < 0.1f);
    expect_flexion(k + 1000u, k + 1500u, 2.5 * HINGE_DEG);
}

/* The angle makes no step when the rigid model is not believed for a while, or when the functional one chooses another zero. */
static void the_angle_has_one_zero(void)
{
    const uint32_t k = feed_until_ready(1500u);
    feed(k, k + 500u);
    const float before = jcal_hinge_auto_flexion(&knee);
    TEST_ASSERT_TRUE(knee.has_zero && knee.believed);
    for (int n = 0; n < 2; ++n) {
        uint8_t *const zero = &knee.functional.joint.track.zero[n];
        *zero = (uint8_t)((*zero + 1u) % 3u);
        TEST_ASSERT_EQUAL_FLOAT(before, jcal_hinge_auto_flexion(&knee));
    }
    knee.believed = false;
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_NOTHING, result().ready_for);
    TEST_ASSERT_EQUAL_FLOAT(before, jcal_hinge_auto_flexion(&knee));
}

/* Sensors on skin: the rigid model does not fit, and the functional one speaks. */
static void a_person_is_the_functional_models(void)
{
    hinge.skin_rad = SKIN_RAD;
    const uint32_t k = feed_until_ready(4000u);
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_FUNCTIONAL, result().model);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().hinge.head.status);
    feed(k, k + 1000u);
    const jcal_hinge_auto_result_t now = result();
    jcal_functional_result_t functional;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_pair_get(&knee.functional, &functional));
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_FUNCTIONAL, now.model);
    TEST_ASSERT_EQUAL_INT(functional.for_axes ? JCAL_FOR_AXES : JCAL_FOR_FLEXION, now.ready_for);
    TEST_ASSERT_EQUAL_FLOAT(functional.uncertainty1_rad, now.hinge.uncertainty1_rad);
    TEST_ASSERT_EQUAL_FLOAT(functional.uncertainty2_rad, now.hinge.uncertainty2_rad);
    TEST_ASSERT_EQUAL_FLOAT(functional.sign_margin, now.hinge.sign_margin);
    expect_axes_within(1.0, 0.0);
    expect_flexion(k + 1000u, k + 1500u, 2.0 * SKIN_RAD);
}

/* The rates that agree better for a while: what is ready is not given up for that; what is not ready is the rigid model's again. */
static void a_calm_while_does_not_take_a_person_away(void)
{
    hinge.skin_rad = SKIN_RAD;
    const uint32_t k = feed_until_ready(4000u);
    float *const size = &knee.functional.joint.point.size[JCAL_FAMILY_RATE];
    const float usual = *size;
    const struct {
        float share;
        bool ready, person;
    } cases[] = {{0.07f, true, true},  {0.05f, true, true},   {0.03f, true, false}, {0.07f, true, false},
                 {0.09f, false, true}, {0.07f, false, false}, {0.09f, true, true},  {0.05f, true, true}};
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; ++n) {
        *size = cases[n].share * cases[n].share;
        knee.functional.joint.verdict.status = (uint8_t)(cases[n].ready ? JCAL_READY : JCAL_COLLECTING);
        jcal_hinge_auto_judge(&knee, 1000u + (uint64_t)k * PERIOD_US);
        TEST_ASSERT_EQUAL_INT(cases[n].person, knee.person);
        if (cases[n].ready) {
            TEST_ASSERT_EQUAL_INT(cases[n].person ? JCAL_MODEL_FUNCTIONAL : JCAL_MODEL_RIGID, result().model);
        }
    }
    *size = usual;
}

/* A limit that the axes of a person cannot hold leaves the angle, which can. */
static void what_is_no_axis_may_be_good_for_the_angle(void)
{
    jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    config.hinge.max_bound_rad = 1.5f * (float)HINGE_DEG;
    begin(&config);
    hinge.skin_rad = SKIN_RAD;
    (void)feed_until_ready(4000u);
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_FLEXION, result().ready_for);
    TEST_ASSERT_TRUE(result().flexion_uncertainty_rad <= config.max_flexion_rad);
}

/* Both models are told what the user knows. */
static void settings_reach_both_models(void)
{
    jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    const jcal_vec3_t true1 = hinge_axis(&hinge, 1, 0.0);
    hinge.skin_rad = SKIN_RAD;
    for (int n = 0; n < 2; ++n) {
        config.hinge.axis1_toward = jcal_vec3_scale(true1, (n == 0) ? 1.0f : -1.0f);
        config.hinge.sign_hint = (n == 0) ? JCAL_SIGN_SAME : JCAL_SIGN_OPPOSITE;
        config.max_flexion_rad = 0.04f;
        begin(&config);
        TEST_ASSERT_EQUAL_INT(config.hinge.sign_hint, knee.functional.joint.cfg.sign_hint);
        TEST_ASSERT_EQUAL_FLOAT(0.04f, knee.functional.joint.cfg.max_flexion_rad);
        TEST_ASSERT_EQUAL_FLOAT(config.hinge.max_bound_rad, knee.functional.joint.cfg.max_bound_rad);
        config.hinge.sign_hint = JCAL_SIGN_UNKNOWN;
        begin(&config);
        (void)feed_until_ready(4000u);
        TEST_ASSERT_TRUE(jcal_vec3_dot(result().hinge.axis1, config.hinge.axis1_toward) > 0.9f);
    }
}

/* What the rigid model calls a slip is one for the functional model, too. */
static void a_slip_begins_both_anew(void)
{
    hinge.slip_s = 19.9;
    hinge.slip[0] = 0.6;
    hinge.slip[2] = 0.5;
    uint32_t k = feed_until_ready(1500u);
    feed(k, 1990u);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().hinge.head.status);
    TEST_ASSERT_TRUE(result().has_levers);
    for (k = 1990u; (k < 4000u) && (result().hinge.head.status != JCAL_MOVED); ++k) {
        feed(k, k + 1u);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_MOVED, result().hinge.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_MODEL_RIGID, result().model);
    TEST_ASSERT_EQUAL_INT(JCAL_FOR_NOTHING, result().ready_for);
    TEST_ASSERT_FALSE(result().has_levers);
    TEST_ASSERT_TRUE(isnan(jcal_hinge_auto_flexion(&knee)));
    for (; (k < 6000u) && (result().ready_for == JCAL_FOR_NOTHING); ++k) {
        feed(k, k + 1u);
    }
    expect_axes_within(1.0, 60.0);
}

/* Through the inbox the same pairs give the same bits. */
static void the_inbox_changes_nothing(void)
{
    static jcal_hinge_auto_t other;
    const jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_init(&other, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_hinge_auto_step(&other));
    for (uint32_t k = 0u; k < 600u; ++k) {
        const jcal_pair_t pair = pair_at(k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_push(&other, &pair));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_step(&other));
    }
    feed(0u, 600u);
    jcal_hinge_auto_result_t theirs;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_get(&other, &theirs));
    const jcal_hinge_auto_result_t ours = result();
    TEST_ASSERT_EQUAL_MEMORY(&ours.hinge.axis1, &theirs.hinge.axis1, sizeof ours.hinge.axis1);
    TEST_ASSERT_EQUAL_FLOAT(ours.flexion_uncertainty_rad, theirs.flexion_uncertainty_rad);
    TEST_ASSERT_EQUAL_UINT32(600u, theirs.hinge.head.samples);
    TEST_ASSERT_EQUAL_UINT32(0u, theirs.hinge.head.overrun);
    for (uint32_t k = 600u; k < 600u + JCAL_INBOX_CAPACITY; ++k) {
        const jcal_pair_t pair = pair_at(k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_push(&other, &pair));
    }
    const jcal_pair_t pair = pair_at(700u);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, jcal_hinge_auto_push(&other, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_get(&other, &theirs));
    TEST_ASSERT_EQUAL_UINT32(1u, theirs.hinge.head.overrun);
}

static void orientations_are_of_the_sensor_that_is_asked_for(void)
{
    feed(0u, 500u);
    for (unsigned which = 1u; which <= 2u; ++which) {
        const jcal_quat_t q = jcal_hinge_auto_orientation(&knee, which);
        const jcal_quat_t wanted = jcal_sensor_orientation((which == 1u) ? &knee.functional.sensors.sensor1
                                                                         : &knee.functional.sensors.sensor2);
        TEST_ASSERT_EQUAL_MEMORY(&wanted, &q, sizeof q);
    }
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_hinge_auto_orientation(NULL, 1u).w);
}

static void null_and_wrong_settings_are_errors(void)
{
    jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    jcal_hinge_auto_result_t out;
    const jcal_pair_t pair = pair_at(0u);
    TEST_ASSERT_NULL(jcal_hinge_auto_config_check(&config));
    TEST_ASSERT_EQUAL_STRING("config", jcal_hinge_auto_config_check(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_init(&knee, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_update(&knee, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_push(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_push(&knee, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_get(NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_auto_get(&knee, NULL));
    TEST_ASSERT_TRUE(isnan(jcal_hinge_auto_flexion(NULL)));
    const jcal_hinge_auto_t before = knee;
    config.max_flexion_rad = NAN;
    TEST_ASSERT_EQUAL_STRING("max_flexion_rad", jcal_hinge_auto_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_hinge_auto_init(&knee, &config));
    config = jcal_hinge_auto_config_default();
    config.hinge.max_bound_rad = 2.0f;
    TEST_ASSERT_EQUAL_STRING("max_bound_rad", jcal_hinge_auto_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_hinge_auto_init(&knee, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &knee, sizeof before);
    TEST_ASSERT_EQUAL_STRING("rigid", jcal_model_string(JCAL_MODEL_RIGID));
    TEST_ASSERT_EQUAL_STRING("functional", jcal_model_string(JCAL_MODEL_FUNCTIONAL));
    TEST_ASSERT_EQUAL_STRING("axes", jcal_ready_for_string(JCAL_FOR_AXES));
    TEST_ASSERT_EQUAL_STRING("flexion", jcal_ready_for_string(JCAL_FOR_FLEXION));
    TEST_ASSERT_EQUAL_STRING("angles", jcal_ready_for_string(JCAL_FOR_ANGLES));
    TEST_ASSERT_NULL(jcal_ready_for_string(JCAL_FOR_NOTHING));
}

static void add_ripple(jcal_vec3_t *v, float amplitude, float phase)
{
    v->x += amplitude * sinf(phase);
    v->y += amplitude * sinf(phase + 1.0f);
    v->z += amplitude * sinf(phase + 2.0f);
}

/* One stiff body that turns; sensor 2 vibrates on its strap at 7 Hz about one line, by `amplitude` rad/s. The lengths of both rates are
   those of a hinge about that line. Faster vibration does not pass the rigid model's low-pass. */
static jcal_pair_t vibrating_at(uint32_t k, float amplitude)
{
    const float t = 1e-6f * (float)PERIOD_US * (float)k;
    const float pitch = 0.9f * sinf(1.1f * t);
    const float yaw_rate = 0.42f * cosf(0.7f * t);
    const jcal_imu_t body = {{-yaw_rate * sinf(pitch), 0.99f * cosf(1.1f * t), yaw_rate * cosf(pitch)},
                             {-9.81f * sinf(pitch), 0.0f, 9.81f * cosf(pitch)}};
    jcal_pair_t pair = {1000u + (uint64_t)k * PERIOD_US, body, body};
    const float vibration = amplitude * sinf(43.98f * t);
    pair.imu2.gyr_rad_s.x += 0.6f * vibration;
    pair.imu2.gyr_rad_s.z += 0.8f * vibration;
    const float n = (float)k; /* real sensors do not repeat themselves */
    add_ripple(&pair.imu1.gyr_rad_s, 5e-3f, 9.1f * n);
    add_ripple(&pair.imu2.gyr_rad_s, 5e-3f, 11.3f * n);
    add_ripple(&pair.imu1.acc_m_s2, 0.1f, 15.7f * n);
    add_ripple(&pair.imu2.acc_m_s2, 0.1f, 17.9f * n);
    return pair;
}

static void a_stiff_body_with_a_vibrating_sensor_is_no_hinge(void)
{
    const float amplitudes[3] = {1.0f, 1.5f, 2.0f};
    for (int a = 0; a < 3; ++a) {
        bool rigid_was_ready = false;
        begin(NULL);
        for (uint32_t k = 0u; k < 3000u; ++k) {
            const jcal_pair_t pair = vibrating_at(k, amplitudes[a]);
            (void)jcal_hinge_auto_update(&knee, &pair);
            jcal_hinge_result_t rigid;
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_get(&knee.rigid, &rigid));
            rigid_was_ready = rigid_was_ready || (rigid.head.status == JCAL_READY);
            TEST_ASSERT_TRUE(result().hinge.head.status != JCAL_READY);
        }
        TEST_ASSERT_TRUE(rigid_was_ready); /* or this would prove nothing */
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_BEND, result().hinge.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, result().hinge.head.hint);
    }
}

/* A hinge whose second accelerometer's components are not in the order of its gyroscope's: all rates are those of a hinge. */
static void accelerometers_that_see_no_common_centre_are_no_hinge(void)
{
    bool centre_objected = false;
    for (uint32_t k = 0u; k < 3000u; ++k) {
        jcal_pair_t pair = pair_at(k);
        const jcal_vec3_t acc = pair.imu2.acc_m_s2;
        pair.imu2.acc_m_s2 = (jcal_vec3_t){acc.y, acc.x, acc.z};
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_auto_update(&knee, &pair));
        centre_objected = centre_objected || (knee.objection == (uint8_t)JCAL_REASON_NOT_ONE_JOINT);
        TEST_ASSERT_TRUE(result().ready_for == JCAL_FOR_NOTHING);
    }
    TEST_ASSERT_TRUE(centre_objected);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(rigid_segments_are_the_rigid_models);
    RUN_TEST(the_angle_has_one_zero);
    RUN_TEST(a_person_is_the_functional_models);
    RUN_TEST(a_calm_while_does_not_take_a_person_away);
    RUN_TEST(what_is_no_axis_may_be_good_for_the_angle);
    RUN_TEST(settings_reach_both_models);
    RUN_TEST(a_slip_begins_both_anew);
    RUN_TEST(the_inbox_changes_nothing);
    RUN_TEST(orientations_are_of_the_sensor_that_is_asked_for);
    RUN_TEST(null_and_wrong_settings_are_errors);
    RUN_TEST(a_stiff_body_with_a_vibrating_sensor_is_no_hinge);
    RUN_TEST(accelerometers_that_see_no_common_centre_are_no_hinge);
    return UNITY_END();
}
