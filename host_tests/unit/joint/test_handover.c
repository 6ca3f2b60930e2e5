/* SPDX-License-Identifier: MIT */
/// @file
/// The hand-over from push to step, the same for every engine: a push at any moment of a step, one from a timer's signal, inboxes that
/// run over, and update after pushes without steps.
#if defined(__linux__) && defined(__x86_64__)
#define _GNU_SOURCE
#define HAS_SIGNALS 1
#else
#define HAS_SIGNALS 0
#endif

#include "jointcal/jointcal.h"
#include "unity.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#if HAS_SIGNALS
#include <signal.h>
#include <sys/time.h>
#include <ucontext.h>
#endif

enum { N_MAX = 50, HALF_WINDOW = 2, STEP_US = 50000 };

/* The engines, all in the same place: one test runs one of them. */
typedef struct {
    jcal_hinge_t hinge;
    jcal_hinge_window_t hinge_window;
    jcal_two_dof_t two_dof;
    jcal_two_dof_window_t two_dof_window;
    jcal_center_t center;
    jcal_center_window_t center_window;
    uint64_t storage[2048];
} engines_t;

static engines_t now;

void setUp(void)
{
    memset(&now, 0, sizeof now);
}

void tearDown(void)
{
}

static jcal_imu_t segment(float tilt, float tilt_rate, float turn, float turn_rate)
{
    const float g = 9.81f;
    const float s = sinf(turn);
    const float c = cosf(turn);
    const jcal_imu_t imu = {{tilt_rate * c, -tilt_rate * s, turn_rate},
                            {g * sinf(tilt) * s, g * sinf(tilt) * c, g * cosf(tilt)}};
    return imu;
}

/* Every sample differs from all others. */
static jcal_pair_t pair_at(uint32_t k)
{
    const float t = 0.02f * (float)k;
    const float tilt = 1.0f + sinf(t);
    const jcal_pair_t pair = {(uint64_t)STEP_US * k + 1000000u,
                              segment(tilt, cosf(t), 0.4f * sinf(2.0f * t), 0.8f * cosf(2.0f * t)),
                              segment(tilt, cosf(t), 0.9f * sinf(3.0f * t), 2.7f * cosf(3.0f * t))};
    return pair;
}

static jcal_quat_t quat_at(float a, float b)
{
    return jcal_quat(cosf(a), sinf(a) * cosf(b), sinf(a) * sinf(b), 0.0f);
}

static jcal_attitudes_t attitudes_at(uint32_t k)
{
    const float t = 0.02f * (float)k;
    const jcal_attitudes_t attitudes = {quat_at(t, 0.3f), quat_at(1.3f * t, 1.0f)};
    return attitudes;
}

static jcal_orientation_pair_t orientation_at(uint32_t k)
{
    const jcal_attitudes_t a = attitudes_at(k);
    const jcal_orientation_pair_t pair = {(uint64_t)STEP_US * k + 1000000u, a.q1, a.q2};
    return pair;
}

/* The verbs of each engine: begin, push of sample k, step, update with sample k, head of the result. */
typedef struct {
    const char *name;
    void (*begin)(void);
    jcal_status_t (*push)(uint32_t k);
    jcal_status_t (*step)(void);
    jcal_status_t (*update)(uint32_t k);
    jcal_head_t (*head)(void);
} engine_t;

static void hinge_begin(void)
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&now.hinge, &config));
}

static jcal_status_t hinge_push(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    return jcal_hinge_push(&now.hinge, &pair);
}

static jcal_status_t hinge_step(void)
{
    return jcal_hinge_step(&now.hinge);
}

static jcal_status_t hinge_update(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    return jcal_hinge_update(&now.hinge, &pair);
}

static jcal_head_t hinge_head(void)
{
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_get(&now.hinge, &result));
    return result.head;
}

static void hinge_window_begin(void)
{
    jcal_hinge_window_config_t config = jcal_hinge_window_config_default();
    config.n_max = N_MAX;
    config.half_window = HALF_WINDOW;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&now.hinge_window, &config, now.storage, sizeof now.storage));
}

static jcal_status_t hinge_window_push(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    return jcal_hinge_window_push(&now.hinge_window, &pair);
}

static jcal_status_t hinge_window_step(void)
{
    return jcal_hinge_window_step(&now.hinge_window);
}

static jcal_status_t hinge_window_update(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    return jcal_hinge_window_update(&now.hinge_window, &pair);
}

static jcal_head_t hinge_window_head(void)
{
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_get(&now.hinge_window, &result));
    return result.head;
}

static void two_dof_begin(void)
{
    const jcal_two_dof_config_t config = jcal_two_dof_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&now.two_dof, &config));
}

static jcal_status_t two_dof_push(uint32_t k)
{
    const jcal_orientation_pair_t pair = orientation_at(k);
    return jcal_two_dof_push(&now.two_dof, &pair);
}

static jcal_status_t two_dof_step(void)
{
    return jcal_two_dof_step(&now.two_dof);
}

static jcal_status_t two_dof_update(uint32_t k)
{
    const jcal_orientation_pair_t pair = orientation_at(k);
    return jcal_two_dof_update(&now.two_dof, &pair);
}

static jcal_head_t two_dof_head(void)
{
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_get(&now.two_dof, &result));
    return result.head;
}

static void two_dof_window_begin(void)
{
    jcal_two_dof_window_config_t config = jcal_two_dof_window_config_default();
    config.n_max = N_MAX;
    TEST_ASSERT_EQUAL_INT(JCAL_OK,
                          jcal_two_dof_window_init(&now.two_dof_window, &config, now.storage, sizeof now.storage));
}

static jcal_status_t two_dof_window_push(uint32_t k)
{
    const jcal_orientation_pair_t pair = orientation_at(k);
    return jcal_two_dof_window_push(&now.two_dof_window, &pair);
}

static jcal_status_t two_dof_window_step(void)
{
    return jcal_two_dof_window_step(&now.two_dof_window);
}

static jcal_status_t two_dof_window_update(uint32_t k)
{
    const jcal_orientation_pair_t pair = orientation_at(k);
    return jcal_two_dof_window_update(&now.two_dof_window, &pair);
}

static jcal_head_t two_dof_window_head(void)
{
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_get(&now.two_dof_window, &result));
    return result.head;
}

static void center_begin(void)
{
    jcal_center_config_t config = jcal_center_config_default();
    config.kinematics.smoothing_s = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&now.center, &config));
}

static void center_oriented_begin(void)
{
    jcal_center_config_t config = jcal_center_config_default();
    config.method = JCAL_CENTER_LS;
    config.kinematics.smoothing_s = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&now.center, &config));
}

static jcal_status_t center_push(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    return jcal_center_push(&now.center, &pair);
}

static jcal_status_t center_oriented_push(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    const jcal_attitudes_t attitudes = attitudes_at(k);
    return jcal_center_push_oriented(&now.center, &pair, &attitudes);
}

static jcal_status_t center_step(void)
{
    return jcal_center_step(&now.center);
}

static jcal_status_t center_update(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    return jcal_center_update(&now.center, &pair);
}

static jcal_head_t center_head(void)
{
    jcal_center_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_get(&now.center, &result));
    return result.head;
}

static void center_window_begin(void)
{
    jcal_center_window_config_t config = jcal_center_window_config_default();
    config.n_max = N_MAX;
    config.center.kinematics.smoothing_s = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK,
                          jcal_center_window_init(&now.center_window, &config, now.storage, sizeof now.storage));
}

static void center_window_oriented_begin(void)
{
    jcal_center_window_config_t config = jcal_center_window_config_default();
    config.n_max = N_MAX;
    config.center.method = JCAL_CENTER_LS;
    config.center.kinematics.smoothing_s = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK,
                          jcal_center_window_init(&now.center_window, &config, now.storage, sizeof now.storage));
}

static jcal_status_t center_window_push(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    return jcal_center_window_push(&now.center_window, &pair);
}

static jcal_status_t center_window_oriented_push(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    const jcal_attitudes_t attitudes = attitudes_at(k);
    return jcal_center_window_push_oriented(&now.center_window, &pair, &attitudes);
}

static jcal_status_t center_window_step(void)
{
    return jcal_center_window_step(&now.center_window);
}

static jcal_status_t center_window_update(uint32_t k)
{
    const jcal_pair_t pair = pair_at(k);
    return jcal_center_window_update(&now.center_window, &pair);
}

static jcal_head_t center_window_head(void)
{
    jcal_center_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_get(&now.center_window, &result));
    return result.head;
}

static const engine_t engines[] = {
    {"hinge", hinge_begin, hinge_push, hinge_step, hinge_update, hinge_head},
    {"hinge window", hinge_window_begin, hinge_window_push, hinge_window_step, hinge_window_update, hinge_window_head},
    {"two axes", two_dof_begin, two_dof_push, two_dof_step, two_dof_update, two_dof_head},
    {"two axes, window", two_dof_window_begin, two_dof_window_push, two_dof_window_step, two_dof_window_update,
     two_dof_window_head},
    {"centre", center_begin, center_push, center_step, center_update, center_head},
    {"centre, window", center_window_begin, center_window_push, center_window_step, center_window_update,
     center_window_head},
    {"centre, oriented", center_oriented_begin, center_oriented_push, center_step, NULL, center_head},
    {"centre, window, oriented", center_window_oriented_begin, center_window_oriented_push, center_window_step, NULL,
     center_window_head},
};
enum { ENGINES = sizeof engines / sizeof engines[0], WITH_UPDATE = 6 };

static void work_off(const engine_t *engine)
{
    for (unsigned i = 0; (i < 200u) && (engine->step() == JCAL_OK); ++i) {
    }
}

static void fill(const engine_t *engine, uint32_t first)
{
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(JCAL_OK, engine->push(first + k), engine->name);
    }
}

static void samples_that_find_no_room_are_counted_in_the_result(void)
{
    for (unsigned e = 0; e < ENGINES; ++e) {
        setUp();
        engines[e].begin();
        fill(&engines[e], 1u);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(0, engines[e].head().overrun, engines[e].name);
        for (uint32_t k = 0; k < 3u; ++k) {
            TEST_ASSERT_EQUAL_INT_MESSAGE(JCAL_ERR_FULL, engines[e].push(100u), engines[e].name);
        }
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(3, engines[e].head().overrun, engines[e].name);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(JCAL_INBOX_CAPACITY, engines[e].head().samples, engines[e].name);
        work_off(&engines[e]);
        TEST_ASSERT_EQUAL_INT_MESSAGE(JCAL_OK, engines[e].push(JCAL_INBOX_CAPACITY + 1u), engines[e].name);
    }
}

static void samples_of_a_chain_that_find_no_room_are_counted_in_its_result(void)
{
    static jcal_chain_t chain;
    const jcal_chain_config_t config = jcal_chain_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_init(&chain, &config));
    for (uint32_t k = 1; k <= JCAL_INBOX_CAPACITY + 2u; ++k) {
        const jcal_pair_t pair = pair_at(k);
        const jcal_triple_t triple = {pair.t_us, pair.imu1, pair.imu2, pair.imu1};
        TEST_ASSERT_EQUAL_INT((k <= JCAL_INBOX_CAPACITY) ? JCAL_OK : JCAL_ERR_FULL,
                              jcal_chain_push(&chain, &triple, NULL));
    }
    jcal_chain_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_chain_get(&chain, &result));
    TEST_ASSERT_EQUAL_UINT32(2, result.head.overrun);
}

static void update_works_off_what_was_pushed_without_a_step(void)
{
    for (unsigned e = 0; e < WITH_UPDATE; ++e) {
        for (uint32_t pushed = 1; pushed <= JCAL_INBOX_CAPACITY; ++pushed) {
            setUp();
            engines[e].begin();
            for (uint32_t k = 1; k <= pushed; ++k) {
                TEST_ASSERT_EQUAL_INT(JCAL_OK, engines[e].push(k));
            }
            for (uint32_t k = pushed + 1u; k < 60u; ++k) {
                TEST_ASSERT_EQUAL_INT_MESSAGE(JCAL_OK, engines[e].update(k), engines[e].name);
            }
            TEST_ASSERT_EQUAL_UINT32(0, engines[e].head().overrun);
            const jcal_head_t mixed = engines[e].head();
            setUp();
            engines[e].begin();
            for (uint32_t k = 1; k < 60u; ++k) {
                TEST_ASSERT_EQUAL_INT(JCAL_OK, engines[e].update(k));
            }
            /* Nothing stays behind: the last sample of the result is the same. */
            TEST_ASSERT_TRUE_MESSAGE(engines[e].head().t_us == mixed.t_us, engines[e].name);
        }
    }
}

static void a_step_of_an_engine_that_was_never_begun_is_refused_or_idle(void)
{
    for (unsigned e = 0; e < ENGINES; ++e) {
        setUp();
        for (uint32_t k = 1; k < 30u; ++k) {
            (void)engines[e].push(k);
            (void)engines[e].step();
        }
        TEST_ASSERT_NOT_EQUAL(JCAL_READY, engines[e].head().status);
    }
}

#if HAS_SIGNALS

/* The state just before the step, with and without the sample that comes in between. */
static engines_t before, without, pushed_before, pushed_after;
static const engine_t *interrupted;
static volatile long instruction, fire_at;
static volatile bool fired;
static jcal_status_t pushed;
static uint32_t next;

enum { TRAP_FLAG = 0x100 };

static void on_trap(int number, siginfo_t *info, void *context)
{
    (void)number;
    (void)info;
    if (instruction == fire_at) {
        fired = true;
        pushed = interrupted->push(next);
        ((ucontext_t *)context)->uc_mcontext.gregs[REG_EFL] &= ~(greg_t)TRAP_FLAG;
    }
    instruction = instruction + 1;
}

static void trap_on(void)
{
    __asm__ volatile("pushfq\n orq $0x100, (%%rsp)\n popfq" ::: "memory", "cc");
}

static void trap_off(void)
{
    __asm__ volatile("pushfq\n andq $~0x100, (%%rsp)\n popfq" ::: "memory", "cc");
}

/* Samples of the other window engines have padding; their sums tell. */
static bool is_like(const engines_t *reference)
{
    const bool has_padding = interrupted->begin != hinge_window_begin;
    return memcmp(&now, reference, has_padding ? offsetof(engines_t, storage) : sizeof now) == 0;
}

/* A step of `waiting` samples, interrupted by a push at each of its first instructions, where it takes its sample, and at some later
   ones: the state is that of a push before the step or of one after it. */
static void interrupt_a_step(const engine_t *engine, uint32_t waiting)
{
    setUp();
    engine->begin();
    uint32_t k = 1u;
    for (; k < 60u; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, engine->push(k));
        work_off(engine);
    }
    for (uint32_t i = 0; i < waiting; ++i) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, engine->push(k++));
    }
    memcpy(&before, &now, sizeof now);
    interrupted = engine;
    next = k;
    (void)engine->step();
    memcpy(&without, &now, sizeof now);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, engine->push(k));
    work_off(engine);
    memcpy(&pushed_after, &now, sizeof now);
    memcpy(&now, &before, sizeof now);
    const bool was_full = engine->push(k) == JCAL_ERR_FULL;
    (void)engine->step();
    work_off(engine);
    memcpy(&pushed_before, &now, sizeof now);
    TEST_ASSERT_EQUAL(waiting == JCAL_INBOX_CAPACITY, was_full);
    for (fire_at = 0; fire_at < 400; fire_at = fire_at + ((fire_at < 120) ? 1 : 9)) {
        memcpy(&now, &before, sizeof now);
        instruction = 0;
        fired = false;
        trap_on();
        (void)engine->step();
        trap_off();
        if (!fired) {
            break;
        }
        work_off(engine);
        TEST_ASSERT_TRUE_MESSAGE((pushed == JCAL_OK) || was_full, engine->name);
        if (!is_like(&pushed_before) && !is_like(&pushed_after)) {
            char text[120];
            (void)snprintf(text, sizeof text, "%s, %u waiting, push at instruction %ld", engine->name, waiting,
                           fire_at);
            TEST_FAIL_MESSAGE(text);
        }
    }
    TEST_ASSERT_TRUE(fire_at > 10);
}

static void a_push_at_any_instruction_of_a_step_is_one_before_or_after_it(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_sigaction = on_trap;
    action.sa_flags = SA_SIGINFO;
    TEST_ASSERT_EQUAL_INT(0, sigaction(SIGTRAP, &action, NULL));
    for (unsigned e = 0; e < ENGINES; ++e) {
        interrupt_a_step(&engines[e], 0u);
        interrupt_a_step(&engines[e], JCAL_INBOX_CAPACITY);
    }
}

/* A timer pushes 2,000 times; each orientation names its sample, which the rate names too. */
static volatile uint32_t ticks;
enum { TICKS = 2000 };

static void on_timer(int number)
{
    (void)number;
    const uint32_t k = ticks + 1u;
    const float name = (float)(k % 1000u) * 0.001f;
    jcal_pair_t pair = pair_at(k);
    pair.imu1.gyr_rad_s.x = name;
    const jcal_attitudes_t attitudes = {quat_at(name, 0.0f), quat_at(name, 0.0f)};
    (void)jcal_center_push_oriented(&now.center, &pair, &attitudes);
    ticks = k;
}

static void a_timer_that_pushes_never_gives_a_sample_the_orientation_of_another(void)
{
    center_oriented_begin();
    now.center.cfg.gate.gap_s = 10.0f;
    ticks = 0u;
    TEST_ASSERT_TRUE(signal(SIGALRM, on_timer) != SIG_ERR);
    const struct itimerval period = {{0, 500}, {0, 500}};
    TEST_ASSERT_EQUAL_INT(0, setitimer(ITIMER_REAL, &period, NULL));
    unsigned compared = 0u;
    while (ticks < TICKS) {
        if ((jcal_center_step(&now.center) != JCAL_OK) || (now.center.input.kinematics.filled == 0u)) {
            continue;
        }
        const jcal_kinematics_t *const kinematics = &now.center.input.kinematics;
        const jcal_bin_t *const newest = &kinematics->ring[(kinematics->next + JCAL_BINS - 1u) % JCAL_BINS];
        const jcal_quat_t q = jcal_quat_normalise(newest->attitudes.q1);
        TEST_ASSERT_FLOAT_WITHIN(5e-4f, newest->imu1.gyr_rad_s.x, atan2f(q.x, q.w));
        ++compared;
    }
    const struct itimerval none = {{0, 0}, {0, 0}};
    TEST_ASSERT_EQUAL_INT(0, setitimer(ITIMER_REAL, &none, NULL));
    TEST_ASSERT_TRUE(compared > (TICKS / 4));
}

#endif

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(samples_that_find_no_room_are_counted_in_the_result);
    RUN_TEST(samples_of_a_chain_that_find_no_room_are_counted_in_its_result);
    RUN_TEST(update_works_off_what_was_pushed_without_a_step);
    RUN_TEST(a_step_of_an_engine_that_was_never_begun_is_refused_or_idle);
#if HAS_SIGNALS
    RUN_TEST(a_push_at_any_instruction_of_a_step_is_one_before_or_after_it);
    RUN_TEST(a_timer_that_pushes_never_gives_a_sample_the_orientation_of_another);
#endif
    return UNITY_END();
}
