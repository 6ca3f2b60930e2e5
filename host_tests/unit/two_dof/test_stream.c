/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/two_dof.h: what the stream engine finds on simulated joints, what it never finds, and its interface.
#include "jointcal/quat.h"
#include "jointcal/two_dof.h"
#include "unit/two_dof/double.h"
#include "unit/two_dof/faults.h"
#include "unit/two_dof/motion.h"

#include <string.h>
#include <unity.h>

#ifdef JCAL_TEST_SHORT
enum { SEEDS = 1, SECONDS = 40, NEVER_SECONDS = 15 };
#else
enum { SEEDS = 6, SECONDS = 40, NEVER_SECONDS = 60 };
#endif

static const double DEG = POSE_PI / 180.0;

static jcal_two_dof_t engine;
static jcal_two_dof_config_t config;

void setUp(void)
{
    config = jcal_two_dof_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&engine, &config));
}

void tearDown(void)
{
}

static void begin_with(jcal_constraint_t constraint)
{
    config.constraint = constraint;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&engine, &config));
}

static jcal_two_dof_result_t result_of(const jcal_two_dof_t *self)
{
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_get(self, &result));
    return result;
}

static void feed(jcal_two_dof_t *self, const sim_t *sim, uint32_t from, uint32_t to)
{
    for (uint32_t k = from; k < to; ++k) {
        const jcal_orientation_pair_t pair = sample_of(sim, k);
        (void)jcal_two_dof_update(self, &pair); /* at rest samples are refused as frozen */
    }
}

static bool is_inside(const sim_t *sim)
{
    const jcal_two_dof_result_t r = result_of(&engine);
    return (apart(r.axis1, pose_axis1(&sim->joint)) < (double)r.uncertainty1_rad) &&
           (apart(r.axis2, pose_axis2(&sim->joint)) < (double)r.uncertainty2_rad) &&
           (pose_apart((double)r.heading_offset_rad, sim->heading) < (double)r.uncertainty_heading_rad);
}

/* Largest error of the axes, rad. */
static double error_of(const sim_t *sim)
{
    const jcal_two_dof_result_t r = result_of(&engine);
    return fmax(apart(r.axis1, pose_axis1(&sim->joint)), apart(r.axis2, pose_axis2(&sim->joint)));
}

static void ready_is_reached_and_its_bounds_hold(void)
{
    for (int c = 0; c < 3; ++c) {
        for (int seed = 0; seed < SEEDS; ++seed) {
            const sim_t sim = lively(seed);
            /* the angle between the axes alone is the weakest of the constraints */
            config.max_bound_rad = ((c == (int)JCAL_CONSTRAINT_ORIENTATION) ? 4.0f : 3.0f) * (float)DEG;
            begin_with((jcal_constraint_t)c);
            uint32_t ready = 0;
            uint32_t inside = 0;
            for (uint32_t k = 0; k < (uint32_t)SECONDS * RATE_HZ; ++k) {
                feed(&engine, &sim, k, k + 1u);
                if (result_of(&engine).head.status == JCAL_READY) {
                    TEST_ASSERT_TRUE((ready > 0u) || is_inside(&sim)); /* when it is said first */
                    ++ready;
                    inside += is_inside(&sim) ? 1u : 0u;
                    TEST_ASSERT_TRUE(error_of(&sim) < 3.0 * DEG);
                }
            }
            TEST_ASSERT_GREATER_THAN_UINT32((uint32_t)SECONDS * RATE_HZ / 4u, ready);
            TEST_ASSERT_TRUE((double)inside >= 0.95 * (double)ready);
            TEST_ASSERT_TRUE(is_inside(&sim));
            TEST_ASSERT_TRUE(error_of(&sim) < 0.75 * DEG); /* the mismatch of the config */
            const jcal_two_dof_result_t r = result_of(&engine);
            TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, r.head.reason);
            TEST_ASSERT_EQUAL_INT(JCAL_WEAK_NONE, r.head.weak);
            TEST_ASSERT_EQUAL_INT(JCAL_HINT_NONE, r.head.hint);
            TEST_ASSERT_EQUAL_INT(JCAL_ENGINE_STREAM, r.head.engine);
        }
    }
}

static void signs_follow_the_largest_component_and_the_carrying_angle_with_them(void)
{
    const sim_t sim = lively(2);
    feed(&engine, &sim, 0, (uint32_t)SECONDS * RATE_HZ);
    const jcal_two_dof_result_t r = result_of(&engine);
    const jcal_vec3_t axes[2] = {r.axis1, r.axis2};
    for (int i = 0; i < 2; ++i) {
        const float c[3] = {axes[i].x, axes[i].y, axes[i].z};
        int largest = 0;
        for (int k = 1; k < 3; ++k) {
            largest = (fabsf(c[k]) > fabsf(c[largest])) ? k : largest;
        }
        TEST_ASSERT_TRUE(c[largest] > 0.0f);
    }
    const float sign = jcal_vec3_dot(r.axis1, pose_axis1(&sim.joint)) * jcal_vec3_dot(r.axis2, pose_axis2(&sim.joint));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, (sign > 0.0f) ? sim.joint.carrying : -sim.joint.carrying,
                              (double)r.carrying_angle_rad);
}

static void exchanged_sensors_give_the_exchanged_result(void)
{
    const sim_t sim = lively(1);
    jcal_two_dof_t other;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&other, &config));
    for (uint32_t k = 0; k < (uint32_t)SECONDS * RATE_HZ; ++k) {
        const jcal_orientation_pair_t pair = sample_of(&sim, k);
        const jcal_orientation_pair_t exchanged = {pair.t_us, pair.q2, pair.q1};
        (void)jcal_two_dof_update(&engine, &pair);
        (void)jcal_two_dof_update(&other, &exchanged);
    }
    const jcal_two_dof_result_t a = result_of(&engine);
    const jcal_two_dof_result_t b = result_of(&other);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, a.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, b.head.status);
    TEST_ASSERT_TRUE(apart(a.axis1, b.axis2) < 0.002);
    TEST_ASSERT_TRUE(apart(a.axis2, b.axis1) < 0.002);
    TEST_ASSERT_TRUE(pose_apart((double)a.heading_offset_rad, -(double)b.heading_offset_rad) < 0.005);
}

static void never_ready(const sim_t *sim, jcal_reason_t reason)
{
    setUp();
    for (uint32_t k = 0; k < (uint32_t)NEVER_SECONDS * RATE_HZ; ++k) {
        feed(&engine, sim, k, k + 1u);
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    }
    if (reason != JCAL_REASON_NONE) {
        TEST_ASSERT_EQUAL_INT(reason, result_of(&engine).head.reason);
    }
}

static void motion_that_says_too_little_is_never_ready(void)
{
    for (int seed = 0; seed < SEEDS; ++seed) {
        sim_t sim = lively(seed + 40);
        sim.flexion = 0.0;
        sim.pronation = 0.0;
        never_ready(&sim, JCAL_REASON_NONE);
        sim.skin = 0.005;
        never_ready(&sim, JCAL_REASON_NONE);
        sim.swing = 0.0;
        never_ready(&sim, JCAL_REASON_NONE);
        sim = lively(seed + 60);
        sim.pronation = 0.0; /* a hinge: one axis only */
        sim.skin = 0.003;
        never_ready(&sim, JCAL_REASON_NONE);
        sim = lively(seed + 80);
        sim.flexion = 0.0;
        sim.skin = 0.003;
        never_ready(&sim, JCAL_REASON_NONE);
    }
}

static void with_the_first_segment_at_rest_the_heading_stays_open(void)
{
    for (int seed = 0; seed < SEEDS; ++seed) {
        sim_t sim = lively(seed);
        sim.swing = 0.0;
        sim.skin = 0.003;
        never_ready(&sim, JCAL_REASON_NONE);
        const jcal_two_dof_result_t r = result_of(&engine);
        TEST_ASSERT_TRUE((r.head.weak == JCAL_WEAK_HEADING) || (r.head.weak == JCAL_WEAK_AXIS1));
        TEST_ASSERT_TRUE(r.uncertainty_heading_rad > config.max_bound_rad);
    }
}

static void bodies_that_share_no_joint_do_not_fit(void)
{
    for (int seed = 0; seed < SEEDS; ++seed) {
        const sim_t one = lively(seed + 20);
        const sim_t two = lively(seed + 30);
        const uint32_t count = (uint32_t)NEVER_SECONDS * RATE_HZ;
        uint32_t said = 0;
        setUp();
        for (uint32_t k = 0; k < count; ++k) {
            jcal_orientation_pair_t pair = sample_of(&one, k);
            pair.q2 = sample_of(&two, k).q2;
            (void)jcal_two_dof_update(&engine, &pair);
            const jcal_two_dof_result_t r = result_of(&engine);
            TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, r.head.status);
            if (r.head.reason == JCAL_REASON_DOES_NOT_FIT) {
                ++said;
                TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
            }
        }
        /* after some seconds, and but for moments when another minimum is taken up */
        TEST_ASSERT_GREATER_THAN_UINT32((count - (6u * RATE_HZ)) * 8u / 10u, said);
    }
}

static void frozen_values_are_never_ready(void)
{
    const sim_t sim = lively(1);
    const jcal_orientation_pair_t first = sample_of(&sim, 0);
    for (uint32_t k = 0; k < (uint32_t)NEVER_SECONDS * RATE_HZ; ++k) {
        jcal_orientation_pair_t pair = sample_of(&sim, k);
        pair.q1 = first.q1;
        (void)jcal_two_dof_update(&engine, &pair);
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    }
    TEST_ASSERT_TRUE(result_of(&engine).head.rejected_by[JCAL_REJECT_FROZEN] > 1000u);
}

/* A slip: from now on sensor 1 sits turned. */
static jcal_orientation_pair_t slipped(const sim_t *sim, uint32_t k)
{
    sim_t after = *sim;
    after.joint.q_b1_s1 = pose_mul(pose_turn(0.5, 1.0, -2.0, 1.0), sim->joint.q_b1_s1);
    return sample_of(&after, k);
}

static void a_slip_is_noticed_and_calibrated_anew(void)
{
    const uint32_t slip = 30u * RATE_HZ;
    for (int seed = 0; seed < SEEDS; ++seed) {
        const sim_t sim = lively(seed);
        setUp();
        feed(&engine, &sim, 0, slip);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
        uint32_t moved = 0;
        uint32_t again = 0;
        for (uint32_t k = slip; k < (slip + (60u * RATE_HZ)); ++k) {
            const jcal_orientation_pair_t pair = slipped(&sim, k);
            (void)jcal_two_dof_update(&engine, &pair);
            const jcal_calibration_t status = result_of(&engine).head.status;
            moved = ((moved == 0u) && (status == JCAL_MOVED)) ? k : moved;
            again = ((moved > 0u) && (again == 0u) && (status == JCAL_READY)) ? k : again;
        }
        TEST_ASSERT_TRUE((moved > 0u) && ((moved - slip) < (5u * RATE_HZ)));
        TEST_ASSERT_TRUE(again > moved);
        sim_t after = sim;
        after.joint.q_b1_s1 = pose_mul(pose_turn(0.5, 1.0, -2.0, 1.0), sim.joint.q_b1_s1);
        TEST_ASSERT_TRUE(is_inside(&after));
    }
}

/* Seconds until ready again if the orientations do not fit for 20 s after a slip, as those of a filter that the slip has upset. */
static void after_a_slip_what_does_not_fit_is_given_up(void)
{
    const sim_t sim = lively(1);
    const uint32_t slip = 30u * RATE_HZ, upset = 20u * RATE_HZ;
    feed(&engine, &sim, 0, slip);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    uint32_t again = 0;
    for (uint32_t k = slip; k < (slip + upset + (30u * RATE_HZ)); ++k) {
        jcal_orientation_pair_t pair = slipped(&sim, k);
        if (k < (slip + upset)) {
            const float t = (float)(k - slip) / (float)RATE_HZ;
            pair.q2 = jcal_quat_mul(
                jcal_quat_normalise(jcal_quat(1.0f, 0.2f * sinf(4.1f * t), 0.2f * sinf(5.3f * t), 0.0f)), pair.q2);
        }
        (void)jcal_two_dof_update(&engine, &pair);
        const bool ready = (k > (slip + (5u * RATE_HZ))) && (result_of(&engine).head.status == JCAL_READY);
        TEST_ASSERT_FALSE(ready && (k < (slip + upset)));
        again = (ready && (again == 0u)) ? k : again;
    }
    TEST_ASSERT_TRUE((again > 0u) && (again < (slip + upset + (20u * RATE_HZ))));
}

static void rest_after_ready_is_no_slip_and_keeps_the_axes(void)
{
    const sim_t sim = lively(3);
    feed(&engine, &sim, 0, 30u * RATE_HZ);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    sim_t still = sim;
    still.flexion = 0.0;
    still.pronation = 0.0;
    still.swing = 0.0;
    still.skin = 1e-4; /* what a sensor at rest still shows */
    const uint32_t rest = (uint32_t)NEVER_SECONDS * 10u * RATE_HZ;
    feed(&engine, &still, 0, 1); /* time goes back once: rejected */
    for (uint32_t k = 30u * RATE_HZ; k < ((30u * RATE_HZ) + rest); ++k) {
        feed(&engine, &still, k, k + 1u);
        TEST_ASSERT_NOT_EQUAL_INT(JCAL_MOVED, result_of(&engine).head.status);
    }
    const jcal_two_dof_result_t r = result_of(&engine);
    TEST_ASSERT_TRUE(apart(r.axis1, pose_axis1(&sim.joint)) < (double)r.uncertainty1_rad);
    TEST_ASSERT_TRUE(apart(r.axis2, pose_axis2(&sim.joint)) < (double)r.uncertainty2_rad);
    TEST_ASSERT_EQUAL_UINT32(1u, r.head.rejected_by[JCAL_REJECT_TIME_ORDER]);
}

static void the_heading_is_followed_as_it_drifts(void)
{
    const double drift_rad_s = 3.0 * POSE_PI / 180.0 / 60.0; /* 3 deg/min */
    sim_t sim = lively(4);
    const double heading = sim.heading;
    uint32_t ready = 0;
    uint32_t inside = 0;
    for (uint32_t k = 0; k < (uint32_t)NEVER_SECONDS * 2u * RATE_HZ; ++k) {
        sim.heading = heading + drift_rad_s * (double)k / RATE_HZ;
        feed(&engine, &sim, k, k + 1u);
        if (result_of(&engine).head.status == JCAL_READY) {
            ++ready;
            inside += is_inside(&sim) ? 1u : 0u;
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT32((uint32_t)NEVER_SECONDS * RATE_HZ, ready);
    TEST_ASSERT_TRUE((double)inside >= 0.95 * (double)ready);
}

static void shifting_all_times_changes_no_bit(void)
{
    const sim_t sim = lively(1);
    jcal_two_dof_t later;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&later, &config));
    for (uint32_t k = 0; k < 15u * RATE_HZ; ++k) {
        jcal_orientation_pair_t pair = sample_of(&sim, k);
        (void)jcal_two_dof_update(&engine, &pair);
        pair.t_us += UINT64_C(0x123456789ABCDEF);
        (void)jcal_two_dof_update(&later, &pair);
    }
    jcal_two_dof_result_t a = result_of(&engine);
    jcal_two_dof_result_t b = result_of(&later);
    TEST_ASSERT_TRUE(a.head.t_us + UINT64_C(0x123456789ABCDEF) ==
                     b.head.t_us); /* small builds of Unity know no 64-bit types */
    a.head.t_us = 0u;
    b.head.t_us = 0u;
    TEST_ASSERT_EQUAL_MEMORY(&a, &b, sizeof a);
}

static void push_and_step_are_update_and_a_copy_goes_on_alike(void)
{
    const sim_t sim = lively(1);
    jcal_two_dof_t split;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&split, &config));
    for (uint32_t k = 0; k < 15u * RATE_HZ; ++k) {
        const jcal_orientation_pair_t pair = sample_of(&sim, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_update(&engine, &pair));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_push(&split, &pair));
        (void)jcal_two_dof_step(&split);
        if (k == 700u) {
            const jcal_two_dof_t copy = split;
            memset(&split, 0xA5, sizeof split);
            split = copy;
        }
    }
    const jcal_two_dof_result_t a = result_of(&engine);
    const jcal_two_dof_result_t b = result_of(&split);
    TEST_ASSERT_EQUAL_MEMORY(&a, &b, sizeof a);
}

static void without_step_the_ring_is_full(void)
{
    const sim_t sim = lively(1);
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        const jcal_orientation_pair_t pair = sample_of(&sim, 4u * k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_push(&engine, &pair));
    }
    const jcal_orientation_pair_t next = sample_of(&sim, 4u * JCAL_INBOX_CAPACITY);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, jcal_two_dof_push(&engine, &next));
    TEST_ASSERT_EQUAL_UINT32(JCAL_INBOX_CAPACITY, result_of(&engine).head.samples);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_step(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_push(&engine, &next));
}

static void null_is_refused(void)
{
    const jcal_orientation_pair_t pair = {0};
    jcal_two_dof_result_t r;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_init(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_push(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_push(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_get(NULL, &r));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_get(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_reset(NULL));
}

static void reset_forgets_all_but_the_config(void)
{
    const sim_t sim = lively(1);
    config.max_bound_rad = 0.06f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&engine, &config));
    const jcal_two_dof_t fresh = engine;
    feed(&engine, &sim, 0, 10u * RATE_HZ);
    TEST_ASSERT_TRUE(result_of(&engine).has_axes);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_reset(&engine));
    TEST_ASSERT_EQUAL_MEMORY(&fresh, &engine, sizeof engine);
}

static void every_field_out_of_its_range_is_named(void)
{
    jcal_two_dof_config_t c = config;
    const struct {
        const char *name;
        float *field;
        float low, high;
    } fields[] = {
        {"max_bound_rad", &c.max_bound_rad, 0.001f, 0.5f},
        {"mismatch_rad", &c.mismatch_rad, 0.0f, 0.1f},
        {"rate_noise_rad_s", &c.rate_noise_rad_s, 1e-3f, 1.0f},
        {"rate_error", &c.rate_error, 0.0f, 0.5f},
        {"angle_noise_rad", &c.angle_noise_rad, 1e-3f, 0.5f},
        {"heading_drift_rad_s", &c.heading_drift_rad_s, 0.0f, 0.05f},
        {"memory_s", &c.memory_s, 2.0f, 600.0f},
        {"gate.gap_s", &c.gate.gap_s, 0.02f, 10.0f},
    };
    TEST_ASSERT_NULL(jcal_two_dof_config_check(&config));
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; ++i) {
        const float bad[4] = {nextafterf(fields[i].low, -1.0f), nextafterf(fields[i].high, INFINITY), NAN, INFINITY};
        for (int k = 0; k < 4; ++k) {
            c = config;
            *fields[i].field = bad[k];
            TEST_ASSERT_EQUAL_STRING(fields[i].name, jcal_two_dof_config_check(&c));
            TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_two_dof_init(&engine, &c));
        }
        c = config;
        *fields[i].field = fields[i].low;
        TEST_ASSERT_NULL(jcal_two_dof_config_check(&c));
        *fields[i].field = fields[i].high;
        TEST_ASSERT_NULL(jcal_two_dof_config_check(&c));
    }
    float *const directions[6] = {&c.axis1_toward.x, &c.axis1_toward.y, &c.axis1_toward.z,
                                  &c.axis2_toward.x, &c.axis2_toward.y, &c.axis2_toward.z};
    for (int i = 0; i < 6; ++i) {
        const float bad[3] = {NAN, INFINITY, 2e6f};
        for (int k = 0; k < 3; ++k) {
            c = config;
            *directions[i] = bad[k];
            TEST_ASSERT_EQUAL_STRING((i < 3) ? "axis1_toward" : "axis2_toward", jcal_two_dof_config_check(&c));
        }
    }
    TEST_ASSERT_EQUAL_STRING("config", jcal_two_dof_config_check(NULL));
    c = config;
    c.constraint = (jcal_constraint_t)3;
    TEST_ASSERT_EQUAL_STRING("constraint", jcal_two_dof_config_check(&c));
    c.constraint = (jcal_constraint_t)-1;
    TEST_ASSERT_EQUAL_STRING("constraint", jcal_two_dof_config_check(&c));
}

static void before_any_data_nothing_is_claimed(void)
{
    const jcal_two_dof_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.head.reason);
    TEST_ASSERT_FALSE(r.has_axes);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.5707964f, r.uncertainty1_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.5707964f, r.uncertainty_heading_rad);
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_two_dof_step(&engine));
}

static void no_orientation_is_lost_where_samples_become_rarer(void)
{
    /* At 100 Hz the work on one that is kept is shared out over four steps; then there is a step for each only. */
    const sim_t sim = lively(1);
    float gain[3];
    feed(&engine, &sim, 0, 100);
    for (uint32_t i = 0; i < 3u; ++i) {
        const jcal_orientation_pair_t pair = sample_of(&sim, 100u + (4u * i));
        const float weight = engine.moments.weight;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_update(&engine, &pair));
        gain[i] = engine.moments.weight - weight;
    }
    TEST_ASSERT_TRUE(gain[1] > 1.5f * gain[2]); /* what was left over, and its own */
}

static jcal_status_t take(const jcal_orientation_pair_t *pair)
{
    return jcal_two_dof_update(&engine, pair);
}

static jcal_two_dof_result_t own_result(void)
{
    return result_of(&engine);
}

static void a_source_that_fails_is_not_ready_for_long(void)
{
    const sim_t sim = lively(2);
    const two_dof_subject_t subject = {take, own_result, 30u * RATE_HZ};
    for (int fault = 0; fault < POSE_FAULTS; ++fault) {
        setUp();
        feed(&engine, &sim, 0, subject.last + 1u);
        two_dof_fault_is_complained_of(&subject, &sim, fault);
        const uint32_t again = subject.last + ((fault == POSE_FAULT_GAPS) ? (80u * RATE_HZ) : (2u * RATE_HZ));
        feed(&engine, &sim, again + 1u, again + (8u * RATE_HZ)); /* the axes were not forgotten */
        TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    }
}

static void once_ready_signs_stay_although_the_largest_component_is_a_tie(void)
{
    uint32_t changes = 0; /* of the component that is the largest */
    for (int seed = 0; seed < 4; ++seed) {
        const sim_t sim = tied(seed);
        jcal_two_dof_result_t before = {0};
        setUp();
        for (uint32_t k = 0; k < 60u * RATE_HZ; ++k) {
            feed(&engine, &sim, k, k + 1u);
            const jcal_two_dof_result_t r = result_of(&engine);
            if (before.head.status == JCAL_READY) {
                TEST_ASSERT_TRUE(jcal_vec3_dot(r.axis1, before.axis1) > 0.9f);
                TEST_ASSERT_TRUE(jcal_vec3_dot(r.axis2, before.axis2) > 0.9f);
                TEST_ASSERT_FLOAT_WITHIN(0.05f, before.carrying_angle_rad, r.carrying_angle_rad);
                changes += ((fabsf(r.axis1.x) > fabsf(r.axis1.y)) != (fabsf(before.axis1.x) > fabsf(before.axis1.y)));
                changes += ((fabsf(r.axis2.x) > fabsf(r.axis2.y)) != (fabsf(before.axis2.x) > fabsf(before.axis2.y)));
            }
            before = r;
        }
        TEST_ASSERT_EQUAL_INT(JCAL_READY, before.head.status);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(3u, changes); /* there were ties */
}

static void a_user_may_say_where_the_axes_point(void)
{
    const sim_t sim = lively(2);
    const float senses[4][2] = {{1.0f, 1.0f}, {1.0f, -1.0f}, {-1.0f, 1.0f}, {-1.0f, -1.0f}};
    for (int i = 0; i < 4; ++i) {
        setUp();
        config.axis1_toward = jcal_vec3_scale(pose_axis1(&sim.joint), 1e-3f * senses[i][0]);
        config.axis2_toward = jcal_vec3_scale(pose_axis2(&sim.joint), 1e3f * senses[i][1]);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_init(&engine, &config));
        feed(&engine, &sim, 0, 30u * RATE_HZ);
        const jcal_two_dof_result_t r = result_of(&engine);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
        TEST_ASSERT_TRUE(senses[i][0] * jcal_vec3_dot(r.axis1, pose_axis1(&sim.joint)) > 0.9f);
        TEST_ASSERT_TRUE(senses[i][1] * jcal_vec3_dot(r.axis2, pose_axis2(&sim.joint)) > 0.9f);
        TEST_ASSERT_DOUBLE_WITHIN(0.02, (double)(senses[i][0] * senses[i][1]) * sim.joint.carrying,
                                  (double)r.carrying_angle_rad);
    }
}

static void what_was_never_prepared_does_nothing(void)
{
    const sim_t sim = lively(1);
    const jcal_orientation_pair_t pair = sample_of(&sim, 0);
    memset(&engine, 0, sizeof engine);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_push(&engine, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_step(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_update(&engine, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_two_dof_reset(&engine));
    TEST_ASSERT_FALSE(result_of(&engine).has_axes);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result_of(&engine).head.status);
}

static void pushes_without_a_step_do_not_overflow(void)
{
    const sim_t sim = lively(1);
    jcal_orientation_pair_t pair = sample_of(&sim, 0);
    const uint64_t begin_us = pair.t_us;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_update(&engine, &pair));
    for (uint32_t k = 1; k < 600u; ++k) {
        pair = sample_of(&sim, k);
        pair.t_us = begin_us + (10u * k); /* none of which is kept */
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_push(&engine, &pair));
    }
    TEST_ASSERT_EQUAL_UINT8(UINT8_MAX, engine.kept.pushes);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ready_is_reached_and_its_bounds_hold);
    RUN_TEST(signs_follow_the_largest_component_and_the_carrying_angle_with_them);
    RUN_TEST(exchanged_sensors_give_the_exchanged_result);
    RUN_TEST(motion_that_says_too_little_is_never_ready);
    RUN_TEST(with_the_first_segment_at_rest_the_heading_stays_open);
    RUN_TEST(bodies_that_share_no_joint_do_not_fit);
    RUN_TEST(frozen_values_are_never_ready);
    RUN_TEST(a_slip_is_noticed_and_calibrated_anew);
    RUN_TEST(after_a_slip_what_does_not_fit_is_given_up);
    RUN_TEST(rest_after_ready_is_no_slip_and_keeps_the_axes);
    RUN_TEST(the_heading_is_followed_as_it_drifts);
    RUN_TEST(shifting_all_times_changes_no_bit);
    RUN_TEST(push_and_step_are_update_and_a_copy_goes_on_alike);
    RUN_TEST(without_step_the_ring_is_full);
    RUN_TEST(null_is_refused);
    RUN_TEST(reset_forgets_all_but_the_config);
    RUN_TEST(every_field_out_of_its_range_is_named);
    RUN_TEST(before_any_data_nothing_is_claimed);
    RUN_TEST(no_orientation_is_lost_where_samples_become_rarer);
    RUN_TEST(pushes_without_a_step_do_not_overflow);
    RUN_TEST(a_source_that_fails_is_not_ready_for_long);
    RUN_TEST(once_ready_signs_stay_although_the_largest_component_is_a_tie);
    RUN_TEST(a_user_may_say_where_the_axes_point);
    RUN_TEST(what_was_never_prepared_does_nothing);
    return UNITY_END();
}
