/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/center_window.h: what the window engine finds, what it never finds, and its interface.
#include "center/model.h"
#include "jointcal/center_window.h"
#include "jointcal/vec3.h"
#include "unit/center/faults.h"
#include "unit/center/motion.h"

#include <string.h>
#include <unity.h>

#ifdef JCAL_TEST_SHORT
#define SEEDS 1
#else
#define SEEDS 6
#endif

#define N_MAX 300u

static uint64_t storage[JCAL_CENTER_WINDOW_STORAGE_BYTES(N_MAX) / sizeof(uint64_t)];
static uint64_t other_storage[JCAL_CENTER_WINDOW_STORAGE_BYTES(N_MAX) / sizeof(uint64_t)];
static jcal_center_window_t engine;
static jcal_center_window_config_t config;

static void begin(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_init(&engine, &config, storage, sizeof storage));
}

void setUp(void)
{
    config = jcal_center_window_config_default();
    config.n_max = N_MAX;
    begin();
}

void tearDown(void)
{
}

static jcal_center_result_t result_of(const jcal_center_window_t *self)
{
    jcal_center_result_t r;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_get(self, &r));
    return r;
}

static void run(const center_motion_t *m, double from_s, double to_s)
{
    for (uint32_t k = (uint32_t)(from_s * m->rate_hz); k < (uint32_t)(to_s * m->rate_hz); ++k) {
        const jcal_pair_t pair = center_sample(m, k);
        (void)jcal_center_window_update(&engine, &pair);
    }
}

static double error_of(const center_motion_t *m)
{
    const jcal_center_result_t r = result_of(&engine);
    return fmax(center_error(r.joint_to_sensor1_m, m->r1), center_error(r.joint_to_sensor2_m, m->r2));
}

static void assert_inside(const center_motion_t *m)
{
    const jcal_center_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_ENGINE_WINDOW, r.head.engine);
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor1_m, m->r1) < (double)r.uncertainty1_m);
    TEST_ASSERT_TRUE(center_error(r.joint_to_sensor2_m, m->r2) < (double)r.uncertainty2_m);
}

static void every_method_finds_the_centre(void)
{
    for (int method = 0; method < 3; ++method) {
        for (int seed = 0; seed < SEEDS; ++seed) {
            center_motion_t m = center_lively(seed);
            m.noise = 0.01;
            config.center.method = (jcal_center_method_t)method;
            config.center.max_bound_m = 0.02f; /* six seconds of data */
            begin();
            for (uint32_t k = 0; k < (uint32_t)(12.0 * m.rate_hz); ++k) {
                const jcal_pair_t pair = center_sample(&m, k);
                const double t_s = (double)k / m.rate_hz;
                const jcal_attitudes_t attitudes = {pose_single(center_orientation(&m, 1, t_s)),
                                                    pose_single(center_orientation(&m, 2, t_s))};
                (void)jcal_center_window_push_oriented(&engine, &pair, &attitudes);
                (void)jcal_center_window_step(&engine);
            }
            assert_inside(&m);
            TEST_ASSERT_TRUE(error_of(&m) < 0.005);
        }
    }
}

static void it_agrees_with_the_stream_engine(void)
{
    static jcal_center_t stream;
    const center_motion_t m = center_lively(2);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&stream, &config.center));
    for (uint32_t k = 0; k < 300u; ++k) { /* all of it in the window */
        const jcal_pair_t pair = center_sample(&m, k);
        (void)jcal_center_update(&stream, &pair);
        (void)jcal_center_window_update(&engine, &pair);
    }
    jcal_center_result_t a;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_get(&stream, &a));
    const jcal_center_result_t b = result_of(&engine);
    const double r1[3] = {(double)b.joint_to_sensor1_m.x, (double)b.joint_to_sensor1_m.y,
                          (double)b.joint_to_sensor1_m.z};
    TEST_ASSERT_TRUE(center_error(a.joint_to_sensor1_m, r1) < 0.003);
}

static void the_window_forgets_what_is_older(void)
{
    center_motion_t m = center_lively(4);
    run(&m, 0.0, 8.0);
    TEST_ASSERT_TRUE(error_of(&m) < 0.005);
    m.r2[0] += 0.05; /* a sensor slips */
    run(&m, 8.0, 20.0);
    TEST_ASSERT_TRUE(error_of(&m) < 0.005);
}

static void a_slip_after_ready_is_noticed(void)
{
    center_motion_t m = center_lively(1);
    config.center.max_bound_m = 0.02f;
    begin();
    run(&m, 0.0, 12.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    m.r1[1] += 0.08;
    bool moved = false;
    for (int k = 0; k < 50; ++k) {
        run(&m, 12.0 + 0.1 * k, 12.1 + 0.1 * k);
        moved = moved || (result_of(&engine).head.status == JCAL_MOVED);
    }
    TEST_ASSERT_TRUE(moved);
}

static void knocks_hardly_matter_to_absolute_differences(void)
{
    double errors[2];
    const center_motion_t m = center_lively(3);
    for (int method = 0; method < 2; ++method) {
        config.center.method = (jcal_center_method_t)method;
        begin();
        for (uint32_t k = 0; k < 400u; ++k) {
            jcal_pair_t pair = center_sample(&m, k);
            pair.imu1.acc_m_s2.z += ((k % 40u) == 7u) ? 30.0f : 0.0f;
            (void)jcal_center_window_update(&engine, &pair);
        }
        errors[method] = error_of(&m);
    }
    TEST_ASSERT_TRUE(errors[1] < 0.5 * errors[0]);
}

static void motion_that_leaves_something_open_is_never_ready(void)
{
    for (int dof = CENTER_STIFF; dof <= CENTER_HINGE; ++dof) {
        center_motion_t m = center_lively(2);
        m.dof = dof;
        begin();
        for (int k = 0; k < 40; ++k) {
            run(&m, 0.4 * k, 0.4 * (k + 1));
            TEST_ASSERT_TRUE(result_of(&engine).head.status != JCAL_READY);
        }
    }
}

static void slow_samples_are_left_out_if_asked_for(void)
{
    center_motion_t m = center_lively(0);
    config.center.min_rate_rad_s = 20.0f; /* nobody is that fast */
    begin();
    run(&m, 0.0, 5.0);
    TEST_ASSERT_FALSE(result_of(&engine).has_center);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, result_of(&engine).head.reason);
}

/* The sample that came `age` after the oldest of a full window. */
static const jcal_kinematic_t *kept(uint32_t age)
{
    return &((const jcal_kinematic_t *)engine.storage)[(engine.next + age) % N_MAX];
}

static void a_full_window_holds_the_last_samples_and_ends_with_the_newest(void)
{
    const center_motion_t m = center_lively(2);
    run(&m, 0.0, 6.6); /* 330 of 300 */
    for (int k = 0; k < 3; ++k) {
        const jcal_center_point_t before = engine.work.sums.point;
        const jcal_pair_t pair = center_sample(&m, 330u + (uint32_t)k);
        (void)jcal_center_window_update(&engine, &pair);
        TEST_ASSERT_EQUAL_UINT32(N_MAX, engine.count);
        for (uint32_t age = 1u; age < N_MAX; ++age) {
            TEST_ASSERT_TRUE(kept(age)->t_us - kept(age - 1u)->t_us == 20000u);
        }
        jcal_center_residual_t r;
        TEST_ASSERT_TRUE(jcal_center_residual(kept(N_MAX - 1u), &before, &r));
        TEST_ASSERT_EQUAL_FLOAT(r.e, engine.work.sums.recent[0][3]);
        TEST_ASSERT_TRUE(jcal_center_residual(kept(N_MAX - 2u), &before, &r));
        TEST_ASSERT_EQUAL_FLOAT(r.e, engine.work.sums.recent[0][2]);
    }
}

static void the_first_step_takes_50_samples(void)
{
    const center_motion_t m = center_lively(2);
    for (uint32_t k = 0; k < 80u; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        (void)jcal_center_window_update(&engine, &pair);
        TEST_ASSERT_EQUAL_INT(engine.count >= 50u, result_of(&engine).has_center);
    }
    TEST_ASSERT_TRUE(engine.count >= 50u);
}

static void free_fall_tells_the_watch_nothing(void)
{
    const center_motion_t m = center_lively(2);
    run(&m, 0.0, 2.0);
    float recent = 0.0f;
    for (uint32_t k = 100u; k < 130u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        pair.imu2.acc_m_s2 = jcal_vec3(0.0f, 1e-3f * (float)(k % 2u), 0.0f);
        pair.imu2.gyr_rad_s = jcal_vec3_scale(pair.imu2.gyr_rad_s, 1e-3f);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_update(&engine, &pair));
        recent = (k == 115u) ? engine.watch.recent[0] : recent;
    }
    TEST_ASSERT_EQUAL_FLOAT(recent, engine.watch.recent[0]);
}

static void rest_tells_the_watch_nothing(void)
{
    center_motion_t m = center_lively(2);
    run(&m, 0.0, 2.0);
    m.base = 0.0;
    m.joint = 0.0;
    m.carried = 0.0;
    float recent = 0.0f;
    for (uint32_t k = 100u; k < 140u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        pair.imu1.acc_m_s2 = jcal_vec3_scale(pair.imu1.acc_m_s2, 1.2f); /* nothing that fits */
        (void)jcal_center_window_update(&engine, &pair);
        recent = (k == 120u) ? engine.watch.recent[0] : recent;
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, recent, engine.watch.recent[0]);
}

static void no_step_is_longer_than_30_cm(void)
{
    const center_motion_t m = center_lively(2);
    run(&m, 0.0, 4.0);
    engine.work.sums.point.place.r1.x += 2.0f;
    const jcal_center_place_t before = engine.work.sums.point.place;
    run(&m, 4.0, 4.021);
    const jcal_vec3_t d1 = jcal_vec3_sub(engine.work.sums.point.place.r1, before.r1);
    const jcal_vec3_t d2 = jcal_vec3_sub(engine.work.sums.point.place.r2, before.r2);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.3f, sqrtf(jcal_vec3_dot(d1, d1) + jcal_vec3_dot(d2, d2)));
    TEST_ASSERT_TRUE(d1.x < 0.0f);
}

static void judgements_are_half_a_second_apart(void)
{
    const center_motion_t m = center_lively(2);
    run(&m, 0.0, 5.0);
    float before_m = result_of(&engine).uncertainty1_m;
    uint32_t last = 0u;
    int judgements = 0;
    for (uint32_t k = 250u; k < 350u; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        (void)jcal_center_window_update(&engine, &pair);
        const float now_m = result_of(&engine).uncertainty1_m;
        if (now_m != before_m) {
            TEST_ASSERT_TRUE((last == 0u) || (k - last == 25u));
            last = k;
            ++judgements;
        }
        before_m = now_m;
    }
    TEST_ASSERT_EQUAL_INT(4, judgements);
}

/* a - K r in double. */
static void felt(const jcal_segment_t *body, jcal_vec3_t r, double *out)
{
    const double by[3] = {(double)r.x, (double)r.y, (double)r.z};
    out[0] = (double)body->a.x;
    out[1] = (double)body->a.y;
    for (int i = 0; i < 3; ++i) {
        out[0] -= (double)body->k[i].x * by[i];
        out[1] -= (double)body->k[i].y * by[i];
    }
}

static void the_heading_is_the_best_one_at_the_estimate(void)
{
    const center_motion_t m = center_lively(3);
    config.center.method = JCAL_CENTER_LS;
    config.n_max = 60u;
    begin();
    jcal_center_place_t at = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    for (uint32_t k = 0; k < 90u; ++k) {
        const double t_s = (double)k / m.rate_hz;
        const jcal_pair_t pair = center_sample(&m, k);
        const pose_quat_t other = pose_mul(pose_turn(-0.8, 0.0, 0.0, 1.0), center_orientation(&m, 2, t_s));
        const jcal_attitudes_t attitudes = {pose_single(center_orientation(&m, 1, t_s)), pose_single(other)};
        if (k == 89u) {
            engine.work.sums.point.place.r2.x += 1.0f; /* so far off that the heading is another one */
            at = engine.work.sums.point.place;
        }
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_push_oriented(&engine, &pair, &attitudes));
        (void)jcal_center_window_step(&engine);
    }
    double along = 0.0;
    double across = 0.0;
    for (uint32_t i = 0; i < 60u; ++i) {
        const jcal_kinematic_t *const s = &((const jcal_kinematic_t *)engine.storage)[i];
        double f1[2];
        double f2[2];
        felt(&s->body1, at.r1, f1);
        felt(&s->body2, at.r2, f2);
        along += f1[0] * f2[0] + f1[1] * f2[1];
        across += f1[1] * f2[0] - f1[0] * f2[1];
    }
    const double expected = atan2(across, along);
    TEST_ASSERT_TRUE(pose_apart(expected, 0.8) > 0.02);
    TEST_ASSERT_TRUE(pose_apart(expected, (double)result_of(&engine).heading_offset_rad) < 1e-3);
}

static void a_copy_goes_on_alike(void)
{
    const center_motion_t m = center_lively(1);
    run(&m, 0.0, 4.0);
    jcal_center_window_t copy = engine;
    memcpy(other_storage, storage, sizeof storage);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_attach(&copy, other_storage, sizeof other_storage));
    run(&m, 4.0, 7.0);
    for (uint32_t k = 200; k < 350; ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        (void)jcal_center_window_push(&copy, &pair);
        (void)jcal_center_window_step(&copy);
    }
    const jcal_center_result_t a = result_of(&engine);
    const jcal_center_result_t b = result_of(&copy);
    TEST_ASSERT_EQUAL_MEMORY(&a, &b, sizeof a);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_reset(&engine));
    TEST_ASSERT_FALSE(result_of(&engine).has_center);
    TEST_ASSERT_EQUAL_UINT32(0u, result_of(&engine).head.samples);
}

static void wrong_arguments_are_refused(void)
{
    const center_motion_t m = center_lively(1);
    const jcal_pair_t pair = center_sample(&m, 0);
    const jcal_attitudes_t attitudes = {pose_single(center_orientation(&m, 1, 0.0)),
                                        pose_single(center_orientation(&m, 2, 0.0))};
    jcal_center_result_t r;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_init(NULL, &config, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_init(&engine, NULL, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_init(&engine, &config, NULL, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_center_window_init(&engine, &config, storage, sizeof storage - 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_center_window_attach(&engine, storage, sizeof storage - 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_center_window_attach(&engine, (char *)storage + 4, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_attach(NULL, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_attach(&engine, NULL, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_push(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_push(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_push_oriented(NULL, &pair, &attitudes));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_push_oriented(&engine, NULL, &attitudes));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_push_oriented(&engine, &pair, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_get(NULL, &r));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_get(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_center_window_step(&engine));
    config.n_max = 49u;
    TEST_ASSERT_EQUAL_STRING("n_max", jcal_center_window_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_center_window_init(&engine, &config, storage, sizeof storage));
    config.n_max = 20001u;
    TEST_ASSERT_EQUAL_STRING("n_max", jcal_center_window_config_check(&config));
    config.n_max = 20000u;
    TEST_ASSERT_NULL(jcal_center_window_config_check(&config));
    config.center.max_bound_m = 0.0f;
    TEST_ASSERT_EQUAL_STRING("max_bound_m", jcal_center_window_config_check(&config));
    config = jcal_center_window_config_default();
    config.n_max = N_MAX;
    config.center.method = JCAL_CENTER_LS;
    begin();
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_push(&engine, &pair));
}

static void begin_oriented(void)
{
    config.center.method = JCAL_CENTER_LS;
    config.center.max_bound_m = 0.02f;
    begin();
}

static void take_oriented(const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    (void)jcal_center_window_push_oriented(&engine, pair, attitudes);
    (void)jcal_center_window_step(&engine);
}

static jcal_center_result_t own_result(void)
{
    return result_of(&engine);
}

static void a_source_that_fails_is_not_ready_for_long(void)
{
    const center_subject_t subject = {begin_oriented, take_oriented, own_result, 12.0, FAULTS};
    center_after_faults_it_is_not_ready(&subject);
}

static void what_was_never_prepared_does_nothing(void)
{
    const center_motion_t m = center_lively(0);
    const jcal_pair_t pair = center_sample(&m, 0);
    const jcal_attitudes_t attitudes = center_attitudes(&m, 0, 0.0);
    memset(&engine, 0, sizeof engine);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_push(&engine, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_push_oriented(&engine, &pair, &attitudes));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_update(&engine, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_step(&engine));
    TEST_ASSERT_FALSE(result_of(&engine).has_center);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_reset(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_attach(&engine, storage, sizeof storage));
    engine.storage = storage; /* but no room in it */
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_center_window_step(&engine));
    TEST_ASSERT_EQUAL_UINT(0, jcal_center_window_storage_bytes(NULL));
    TEST_ASSERT_EQUAL_STRING("config", jcal_center_window_config_check(NULL));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_method_finds_the_centre);
    RUN_TEST(it_agrees_with_the_stream_engine);
    RUN_TEST(the_window_forgets_what_is_older);
    RUN_TEST(a_slip_after_ready_is_noticed);
    RUN_TEST(knocks_hardly_matter_to_absolute_differences);
    RUN_TEST(motion_that_leaves_something_open_is_never_ready);
    RUN_TEST(slow_samples_are_left_out_if_asked_for);
    RUN_TEST(a_full_window_holds_the_last_samples_and_ends_with_the_newest);
    RUN_TEST(the_first_step_takes_50_samples);
    RUN_TEST(free_fall_tells_the_watch_nothing);
    RUN_TEST(rest_tells_the_watch_nothing);
    RUN_TEST(no_step_is_longer_than_30_cm);
    RUN_TEST(judgements_are_half_a_second_apart);
    RUN_TEST(the_heading_is_the_best_one_at_the_estimate);
    RUN_TEST(a_copy_goes_on_alike);
    RUN_TEST(wrong_arguments_are_refused);
    RUN_TEST(a_source_that_fails_is_not_ready_for_long);
    RUN_TEST(what_was_never_prepared_does_nothing);
    return UNITY_END();
}
