/* SPDX-License-Identifier: MIT */
/// @file
/// A clock that begins anew, one wild time stamp and 32-bit microseconds that run over, in every engine: what was ready is ready again
/// within a second, and what was found is kept.
#include "jointcal/jointcal.h"
#include "unit/center/motion.h"
#include "unit/hinge/motion.h"
#include "unit/two_dof/motion.h"

#include <string.h>
#include <unity.h>

enum { N_MAX = 500, READY_S = 60, ON_S = 10 };

static jcal_hinge_t hinge;
static jcal_hinge_window_t hinge_window;
static jcal_two_dof_t two_dof;
static jcal_two_dof_window_t two_dof_window;
static jcal_center_t center;
static jcal_center_window_t center_window;
static uint64_t storage[JCAL_CENTER_WINDOW_STORAGE_BYTES(N_MAX) / sizeof(uint64_t) + 4096u];

void setUp(void)
{
}

void tearDown(void)
{
}

/* What the clock says for a time, from sample `jump` on. */
typedef uint64_t (*jump_t)(uint64_t t_us, uint64_t jump_us, bool first);

static uint64_t from_zero(uint64_t t_us, uint64_t jump_us, bool first)
{
    (void)first;
    return (t_us < jump_us) ? t_us : (t_us - jump_us);
}

static uint64_t one_wild(uint64_t t_us, uint64_t jump_us, bool first)
{
    (void)jump_us;
    return first ? (t_us + (1ull << 40)) : t_us;
}

/* Low 32 bits of a clock that runs over at the jump. */
static uint64_t low_half(uint64_t t_us, uint64_t jump_us, bool first)
{
    (void)first;
    return (uint32_t)(t_us - jump_us);
}

static const jump_t JUMPS[] = {from_zero, one_wild, low_half};
/* On targets the first kind only: the others take the same way through each engine. */
#if defined(JCAL_TEST_SHORT)
#define KINDS 1u
#else
#define KINDS (sizeof JUMPS / sizeof JUMPS[0])
#endif

typedef struct {
    double rate_hz;
    jcal_head_t (*update)(uint32_t k, uint64_t jump_us, jump_t jump, bool first);
    void (*begin)(void);
    jcal_vec3_t (*found)(void);
    const char *name;
} engine_t;

static motion_t hinge_motion;
static sim_t two_dof_motion;
static center_motion_t center_motion;

static void hinge_begin(void)
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    hinge_motion = motion_lively(3);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&hinge, &config));
}

static jcal_head_t hinge_update(uint32_t k, uint64_t jump_us, jump_t jump, bool first)
{
    jcal_pair_t pair = motion_sample(&hinge_motion, k);
    pair.t_us = jump(pair.t_us, jump_us, first);
    (void)jcal_hinge_update(&hinge, &pair);
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_get(&hinge, &result));
    return result.head;
}

static jcal_vec3_t hinge_found(void)
{
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_get(&hinge, &result));
    return result.axis1;
}

static void hinge_window_begin(void)
{
    jcal_hinge_window_config_t config = jcal_hinge_window_config_default();
    config.n_max = N_MAX;
    hinge_motion = motion_lively(3);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&hinge_window, &config, storage, sizeof storage));
}

static jcal_head_t hinge_window_update(uint32_t k, uint64_t jump_us, jump_t jump, bool first)
{
    jcal_pair_t pair = motion_sample(&hinge_motion, k);
    pair.t_us = jump(pair.t_us, jump_us, first);
    (void)jcal_hinge_window_update(&hinge_window, &pair);
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_get(&hinge_window, &result));
    return result.head;
}

static jcal_vec3_t hinge_window_found(void)
{
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_get(&hinge_window, &result));
    return result.axis1;
}

static void two_dof_begin(void)
{
    const jcal_two_dof_config_t config = jcal_two_dof_config_default();
    two_dof_motion = lively(1);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&two_dof, &config));
}

static jcal_head_t two_dof_update(uint32_t k, uint64_t jump_us, jump_t jump, bool first)
{
    jcal_orientation_pair_t pair = sample_of(&two_dof_motion, k);
    pair.t_us = jump(pair.t_us, jump_us, first);
    (void)jcal_two_dof_update(&two_dof, &pair);
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_get(&two_dof, &result));
    return result.head;
}

static jcal_vec3_t two_dof_found(void)
{
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_get(&two_dof, &result));
    return result.axis1;
}

static void two_dof_window_begin(void)
{
    jcal_two_dof_window_config_t config = jcal_two_dof_window_config_default();
    two_dof_motion = lively(1);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_init(&two_dof_window, &config, storage, sizeof storage));
}

static jcal_head_t two_dof_window_update(uint32_t k, uint64_t jump_us, jump_t jump, bool first)
{
    jcal_orientation_pair_t pair = sample_of(&two_dof_motion, k);
    pair.t_us = jump(pair.t_us, jump_us, first);
    (void)jcal_two_dof_window_update(&two_dof_window, &pair);
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_get(&two_dof_window, &result));
    return result.head;
}

static jcal_vec3_t two_dof_window_found(void)
{
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_get(&two_dof_window, &result));
    return result.axis1;
}

static void center_begin(void)
{
    const jcal_center_config_t config = jcal_center_config_default();
    center_motion = center_lively(1);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_init(&center, &config));
}

static jcal_head_t center_update(uint32_t k, uint64_t jump_us, jump_t jump, bool first)
{
    jcal_pair_t pair = center_sample(&center_motion, k);
    pair.t_us = jump(pair.t_us, jump_us, first);
    (void)jcal_center_update(&center, &pair);
    jcal_center_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_get(&center, &result));
    return result.head;
}

static jcal_vec3_t center_found(void)
{
    jcal_center_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_get(&center, &result));
    return jcal_vec3_scale(result.joint_to_sensor1_m, 10.0f); /* 5 mm count like 0.05 rad */
}

static void center_window_begin(void)
{
    jcal_center_window_config_t config = jcal_center_window_config_default();
    config.n_max = N_MAX;
    center_motion = center_lively(1);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_init(&center_window, &config, storage, sizeof storage));
}

static jcal_head_t center_window_update(uint32_t k, uint64_t jump_us, jump_t jump, bool first)
{
    jcal_pair_t pair = center_sample(&center_motion, k);
    pair.t_us = jump(pair.t_us, jump_us, first);
    (void)jcal_center_window_update(&center_window, &pair);
    jcal_center_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_get(&center_window, &result));
    return result.head;
}

static jcal_vec3_t center_window_found(void)
{
    jcal_center_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_get(&center_window, &result));
    return jcal_vec3_scale(result.joint_to_sensor1_m, 10.0f);
}

static void check(const engine_t *engine, jump_t jump)
{
    engine->begin();
    const uint32_t before = (uint32_t)(READY_S * engine->rate_hz);
    const uint32_t second = (uint32_t)engine->rate_hz;
    const uint32_t after = (uint32_t)(ON_S * engine->rate_hz);
    const uint64_t jump_us = 1000000ull * (READY_S + 1u); /* the motions begin a while after zero */
    jcal_head_t head;
    memset(&head, 0, sizeof head);
    uint32_t k = 0;
    for (; (k < before) || (head.status != JCAL_READY); ++k) {
        TEST_ASSERT_TRUE_MESSAGE(k < (2u * before), engine->name);
        head = engine->update(k, UINT64_MAX, from_zero, false);
    }
    const jcal_vec3_t found = engine->found();
    const uint32_t rejected = head.rejected;
    uint32_t lost = 0;
    for (uint32_t i = 0; i < after; ++i, ++k) {
        head = engine->update(k, jump_us, jump, i == 0u);
        lost += ((i > second) && (head.status != JCAL_READY)) ? 1u : 0u;
        TEST_ASSERT_NOT_EQUAL_MESSAGE(JCAL_MOVED, head.status, engine->name);
    }
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(0, lost, engine->name);
    const uint32_t cost = head.rejected - rejected;
    TEST_ASSERT_TRUE_MESSAGE((cost >= 1u) && (cost < second), engine->name);
    TEST_ASSERT_TRUE_MESSAGE(jcal_vec3_norm(jcal_vec3_sub(found, engine->found())) < 0.05f, engine->name);
}

static void what_is_ready_is_ready_again_within_a_second(void)
{
    const engine_t engines[] = {
        {50.0, hinge_update, hinge_begin, hinge_found, "hinge"},
        {50.0, hinge_window_update, hinge_window_begin, hinge_window_found, "hinge, window"},
        {100.0, two_dof_update, two_dof_begin, two_dof_found, "two axes"},
        {100.0, two_dof_window_update, two_dof_window_begin, two_dof_window_found, "two axes, window"},
        {50.0, center_update, center_begin, center_found, "centre"},
        {50.0, center_window_update, center_window_begin, center_window_found, "centre, window"},
    };
    for (unsigned e = 0; e < sizeof engines / sizeof engines[0]; ++e) {
        for (unsigned j = 0; j < KINDS; ++j) {
            check(&engines[e], JUMPS[j]);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(what_is_ready_is_ready_again_within_a_second);
    return UNITY_END();
}
