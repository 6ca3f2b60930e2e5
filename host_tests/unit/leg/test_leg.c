/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/leg.h: exact motion of pelvis, thigh and shank, what a known thigh length does, what stays open, what sensors refuse,
/// and the interface.
#include "jointcal/leg.h"

#include "jointcal/vec3.h"
#include "unit/leg/motion.h"

#include <string.h>
#include <unity.h>

/* Shorter: everything is known after six seconds already; what the longer time adds is other motions, and sums that were merged. */
#ifdef JCAL_TEST_SHORT
#define SEEDS 1
#define RUN_S 9.0
#else
#define SEEDS 6
#define RUN_S 30.0
#endif

/// Shares of a lever that skin may hide, of the proximal and of the distal sensor of a joint: docs/METHOD_PEOPLE.md, section 13.
static const double SKIN[JCAL_CHAIN_PLACES] = {0.17, 0.10, 0.17, 0.10};

static jcal_leg_t leg;
static jcal_leg_config_t config;

static void begin(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_init(&leg, &config, NULL));
}

void setUp(void)
{
    config = jcal_leg_config_default();
    begin();
}

void tearDown(void)
{
}

static jcal_leg_result_t result_of(const jcal_leg_t *self)
{
    jcal_leg_result_t r;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_get(self, &r));
    return r;
}

static jcal_leg_result_t result(void)
{
    return result_of(&leg);
}

static uint32_t sample_at(const chain_motion_t *m, double t_s)
{
    return (uint32_t)(t_s * m->hip.rate_hz);
}

static void run(const chain_motion_t *m, double from_s, double to_s)
{
    for (uint32_t k = sample_at(m, from_s); k < sample_at(m, to_s); ++k) {
        const jcal_triple_t triple = leg_sample(m, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_update(&leg, &triple));
    }
}

static double length_of(const chain_motion_t *m)
{
    return sqrt(m->thigh[0] * m->thigh[0] + m->thigh[1] * m->thigh[1] + m->thigh[2] * m->thigh[2]);
}

static double error_of(const chain_motion_t *m, const jcal_leg_result_t *r, int place)
{
    double truth[3];
    chain_truth(m, (jcal_chain_place_t)place, truth);
    return center_error(r->place_m[place], truth);
}

/* Nothing slips on a rigid mount: the truth is inside what the bound is without the share of skin. */
static void assert_true_without_skin(const chain_motion_t *m, const jcal_leg_result_t *r, int place)
{
    const double skin = SKIN[place] * (double)jcal_vec3_norm(r->place_m[place]);
    TEST_ASSERT_TRUE(r->known[place]);
    TEST_ASSERT_TRUE(error_of(m, r, place) < (double)r->uncertainty_m[place] - skin);
}

static void exact_motion_gets_ready_and_the_truth_is_inside(void)
{
    for (int seed = 0; seed < SEEDS; ++seed) {
        const chain_motion_t m = leg_lively(seed);
        setUp();
        run(&m, 0.0, RUN_S);
        const jcal_leg_result_t r = result();
        TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_WEAK_NONE, r.head.weak);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_NONE, r.head.hint);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, r.head.reason);
        TEST_ASSERT_EQUAL_UINT32(sample_at(&m, RUN_S), r.head.samples);
        for (int i = 0; i < JCAL_CHAIN_PLACES; ++i) {
            assert_true_without_skin(&m, &r, i);
            TEST_ASSERT_TRUE(r.uncertainty_m[i] <= 1.2f * config.max_lever_m);
        }
        TEST_ASSERT_EQUAL_FLOAT(r.uncertainty_m[1] + r.uncertainty_m[2], r.uncertainty_segment_m);
        TEST_ASSERT_TRUE(fabs((double)r.segment_length_m - length_of(&m)) < (double)r.uncertainty_segment_m);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, r.length_factor);
    }
}

/* Relative orientations from the headings and the sensors' own orientations are those of the motion. */
static void headings_are_those_of_the_motion(void)
{
    const chain_motion_t m = leg_lively(1);
    run(&m, 0.0, RUN_S);
    const jcal_leg_result_t r = result();
    const double t_s = ((double)sample_at(&m, RUN_S) - 1.0) / m.hip.rate_hz;
    for (int joint = 0; joint < JCAL_LEG_JOINTS; ++joint) {
        TEST_ASSERT_EQUAL_INT(JCAL_READY, r.joint_status[joint]);
        TEST_ASSERT_TRUE(r.heading[joint].known);
        const jcal_quat_t q1 = jcal_sensor_orientation(&leg.sensor[joint]);
        const jcal_quat_t q2 = jcal_sensor_orientation(&leg.sensor[joint + 1]);
        const pose_quat_t own1 = {(double)q1.w, (double)q1.x, (double)q1.y, (double)q1.z};
        const pose_quat_t own2 = {(double)q2.w, (double)q2.x, (double)q2.y, (double)q2.z};
        const pose_quat_t turned = pose_mul(pose_turn((double)r.heading[joint].heading_rad, 0.0, 0.0, 1.0), own2);
        const pose_quat_t found = pose_mul(pose_conj(own1), turned);
        const pose_quat_t truth =
            pose_mul(pose_conj(leg_orientation(&m, joint + 1, t_s)), leg_orientation(&m, joint + 2, t_s));
        const pose_quat_t off = pose_mul(pose_conj(truth), found);
        const double angle = 2.0 * atan2(sqrt(off.x * off.x + off.y * off.y + off.z * off.z), fabs(off.w));
        /* the heading's bound, half a sample of up to 6 rad/s each (sensor.h), and a degree of tilt each */
        TEST_ASSERT_TRUE(angle < (double)r.uncertainty_heading_rad[joint] + 0.06 + 0.035);
        TEST_ASSERT_TRUE(r.uncertainty_heading_rad[joint] < config.max_heading_rad);
    }
}

/* A length that is given: both vectors on the thigh by one factor, their bounds without the share of skin, the others as they are. */
static void a_known_length_scales_both_vectors_on_the_thigh(void)
{
    const chain_motion_t m = leg_lively(2);
    run(&m, 0.0, RUN_S);
    const jcal_leg_result_t free = result();
    const double lengths[] = {0.95, 1.0, 1.12};
    for (size_t n = 0u; n < sizeof lengths / sizeof lengths[0]; ++n) {
        config.thigh_length_m = (float)(lengths[n] * length_of(&m));
        begin();
        run(&m, 0.0, RUN_S);
        const jcal_leg_result_t r = result();
        const double factor = (double)config.thigh_length_m / (double)free.segment_length_m;
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, factor, (double)r.length_factor);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, (double)config.thigh_length_m, (double)r.segment_length_m);
        TEST_ASSERT_EQUAL_MEMORY(&free.place_m[0], &r.place_m[0], sizeof free.place_m[0]);
        TEST_ASSERT_EQUAL_MEMORY(&free.place_m[3], &r.place_m[3], sizeof free.place_m[3]);
        TEST_ASSERT_EQUAL_FLOAT(free.uncertainty_m[0], r.uncertainty_m[0]);
        TEST_ASSERT_EQUAL_FLOAT(free.uncertainty_m[3], r.uncertainty_m[3]);
        double rest[2];
        double size[2];
        for (int i = 1; i <= 2; ++i) {
            const jcal_vec3_t scaled = jcal_vec3_scale(free.place_m[i], r.length_factor);
            TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(scaled, r.place_m[i])) < 1e-6f);
            size[i - 1] = (double)jcal_vec3_norm(free.place_m[i]);
            rest[i - 1] = (double)free.uncertainty_m[i] - SKIN[i] * size[i - 1];
            TEST_ASSERT_TRUE(r.uncertainty_m[i] < free.uncertainty_m[i]);
        }
        /* at least 5 % and what was left of its own bound; at most what was left of either */
        for (int i = 1; i <= 2; ++i) {
            const double least = factor * (0.05 * size[i - 1] + rest[i - 1]);
            const double most = factor * (0.05 * size[i - 1] + fmax(rest[0], rest[1]));
            TEST_ASSERT_TRUE((double)r.uncertainty_m[i] > least - 1e-6);
            TEST_ASSERT_TRUE((double)r.uncertainty_m[i] < most + 1e-6);
        }
        TEST_ASSERT_EQUAL_FLOAT(r.uncertainty_m[1] + r.uncertainty_m[2], r.uncertainty_segment_m);
    }
}

/* Skin that goes along with the thigh: what it turns less by, the vectors are longer by. Both come back with the length. */
static void a_known_length_takes_out_a_common_factor(void)
{
    const chain_motion_t m = leg_lively(3);
    config.thigh_length_m = (float)length_of(&m);
    begin();
    run(&m, 0.0, RUN_S);
    leg.joint[0].point.r2 = jcal_vec3_scale(leg.joint[0].point.r2, 1.11f);
    leg.joint[1].point.r1 = jcal_vec3_scale(leg.joint[1].point.r1, 1.11f);
    leg.joint[0].verdict.bound2_m *= 1.11f;
    leg.joint[1].verdict.bound1_m *= 1.11f;
    const jcal_leg_result_t r = result();
    for (int i = 1; i <= 2; ++i) {
        const double left = 0.05 * (double)jcal_vec3_norm(r.place_m[i]);
        TEST_ASSERT_TRUE(error_of(&m, &r, i) < (double)r.uncertainty_m[i] - left);
    }
}

/* No skin makes a thigh twice as long: sensors are exchanged, or it is another thigh. */
static void a_length_that_cannot_be_leaves_the_thigh_unknown(void)
{
    const chain_motion_t m = leg_lively(2);
    const double lengths[] = {0.6, 1.5};
    for (size_t n = 0u; n < sizeof lengths / sizeof lengths[0]; ++n) {
        config.thigh_length_m = (float)(lengths[n] * length_of(&m));
        begin();
        run(&m, 0.0, RUN_S);
        const jcal_leg_result_t r = result();
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, r.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, r.length_factor);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty_segment_m);
        TEST_ASSERT_TRUE(fabs((double)r.segment_length_m - length_of(&m)) < 0.03); /* as it was found */
        for (int i = 0; i < JCAL_CHAIN_PLACES; ++i) {
            const bool on_thigh = (i == JCAL_CHAIN_HIP_TO_THIGH) || (i == JCAL_CHAIN_KNEE_TO_THIGH);
            TEST_ASSERT_EQUAL(!on_thigh, r.known[i]);
            TEST_ASSERT_EQUAL(on_thigh, r.uncertainty_m[i] >= JCAL_BOUND_UNKNOWN_M);
        }
    }
}

/* While bounds are as wide as the difference itself, the length contradicts nothing. */
static void a_length_that_is_not_excluded_yet_asks_for_more_motion(void)
{
    const chain_motion_t m = leg_lively(2);
    config.thigh_length_m = (float)(1.5 * length_of(&m));
    config.max_lever_m = 0.5f;
    begin();
    run(&m, 0.0, RUN_S);
    leg.joint[0].verdict.bound2_m = 0.2f;
    leg.joint[1].verdict.bound1_m = 0.2f;
    const jcal_leg_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, r.head.reason);
    TEST_ASSERT_TRUE(r.head.hint == JCAL_HINT_MOVE_SEGMENT1 || r.head.hint == JCAL_HINT_MOVE_SEGMENT2);
    TEST_ASSERT_FALSE(r.known[JCAL_CHAIN_HIP_TO_THIGH]);
}

/* What hardly turns says little of where it sits, and never with a bound that does not hold; the others are known all the same. */
static void a_pelvis_that_hardly_turns_never_has_a_bound_that_is_too_small(void)
{
    const double turns_rad[] = {0.005, 0.01, 0.02, 0.05, 0.1, 0.2};
    for (size_t n = 0u; n < sizeof turns_rad / sizeof turns_rad[0]; ++n) {
        for (int seed = 0; seed < SEEDS; ++seed) {
            chain_motion_t m = leg_lively(seed);
            m.hip.base = turns_rad[n];
            setUp();
            run(&m, 0.0, RUN_S);
            const jcal_leg_result_t r = result();
            TEST_ASSERT_TRUE(error_of(&m, &r, JCAL_CHAIN_HIP_TO_PELVIS) < (double)r.uncertainty_m[0]);
            for (int i = 1; i < JCAL_CHAIN_PLACES; ++i) {
                assert_true_without_skin(&m, &r, i);
            }
        }
    }
}

/* What does not turn says nothing of where it sits. */
static void a_pelvis_at_rest_leaves_its_own_vector_open(void)
{
    for (int seed = 0; seed < SEEDS; ++seed) {
        chain_motion_t m = leg_lively(seed);
        m.hip.base = 0.0;
        setUp();
        run(&m, 0.0, RUN_S);
        const jcal_leg_result_t r = result();
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_WEAK_CENTER1, r.head.weak);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, r.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_SEGMENT1, r.head.hint);
        TEST_ASSERT_FALSE(r.known[JCAL_CHAIN_HIP_TO_PELVIS]);
        TEST_ASSERT_TRUE(error_of(&m, &r, JCAL_CHAIN_HIP_TO_PELVIS) < (double)r.uncertainty_m[0]);
        for (int i = 1; i < JCAL_CHAIN_PLACES; ++i) {
            assert_true_without_skin(&m, &r, i);
        }
    }
}

/* Where skin alone is above the limit no motion helps. */
static void no_motion_is_asked_for_that_would_not_help(void)
{
    const chain_motion_t m = leg_lively(1);
    config.max_lever_m = 0.012f;
    begin();
    run(&m, 0.0, RUN_S);
    const jcal_leg_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_CENTER2, r.head.weak); /* the thigh from the knee: 17 % of 20 cm */
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_NONE, r.head.hint);
}

/* A joint that is none yet stands before any bound. */
static void without_motion_nothing_is_known(void)
{
    chain_motion_t m = leg_lively(0);
    m.hip.base = 0.0;
    m.hip.joint = 0.0;
    m.hip.carried = 0.0;
    run(&m, 0.0, 10.0);
    jcal_leg_result_t r = result(); /* the knee moves */
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_HEADING, r.head.weak);
    TEST_ASSERT_TRUE(r.head.reason != JCAL_REASON_NONE);
    TEST_ASSERT_FALSE(r.has_joint[JCAL_LEG_HIP]);
    TEST_ASSERT_FALSE(r.known[JCAL_CHAIN_HIP_TO_PELVIS] || r.known[JCAL_CHAIN_HIP_TO_THIGH]);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, r.segment_length_m);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty_segment_m);
    begin();
    r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, r.head.hint);
}

/* One sensor sends nothing of use for a second: all begin anew together, and what was known comes back. */
static void a_gap_in_one_sensor_leaves_all_in_step(void)
{
    static jcal_leg_t before;
    const chain_motion_t m = leg_lively(1);
    run(&m, 0.0, RUN_S);
    before = leg;
    for (int sensor = 1; sensor <= 3; ++sensor) {
        leg = before;
        uint32_t k = sample_at(&m, RUN_S);
        const uint32_t ticks = leg.joint[0].ticks.count;
        for (uint32_t end = k + 50u; k < end; ++k) {
            jcal_triple_t triple = leg_sample(&m, k);
            jcal_imu_t *const imus[3] = {&triple.imu1, &triple.imu2, &triple.imu3};
            imus[sensor - 1]->acc_m_s2.y = NAN;
            TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_leg_update(&leg, &triple));
        }
        TEST_ASSERT_EQUAL_UINT32(ticks, leg.joint[0].ticks.count);
        for (uint32_t end = k + 800u; k < end; ++k) { /* headings are learnt anew */
            const jcal_triple_t triple = leg_sample(&m, k);
            (void)jcal_leg_update(&leg, &triple);
        }
        const jcal_leg_result_t r = result();
        TEST_ASSERT_EQUAL_UINT32(50u, r.head.rejected_by[JCAL_REJECT_NOT_FINITE]);
        TEST_ASSERT_EQUAL_UINT32(1u, r.head.rejected_by[JCAL_REJECT_GAP]);
        TEST_ASSERT_EQUAL_UINT32(51u, r.head.rejected);
        /* a tick each 60 ms of 16 s, of which the first second or so is the filters' */
        TEST_ASSERT_TRUE(leg.joint[0].ticks.count > ticks + 240u);
        TEST_ASSERT_EQUAL_UINT32(leg.joint[0].ticks.count, leg.joint[1].ticks.count);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
        for (int i = 0; i < JCAL_CHAIN_PLACES; ++i) {
            assert_true_without_skin(&m, &r, i);
        }
    }
}

/* The gate does not look at the values of the first reading after a gap. If one sensor alone refused it, ticks would not be of the same
   times ever after. At 200 Hz: what the gate refuses next is no gap to the sensors then. */
static void sensors_stay_in_step_when_one_refuses_the_first_reading_after_a_gap(void)
{
    for (int sensor = 1; sensor <= 3; ++sensor) {
        chain_motion_t m = leg_lively(0);
        m.hip.rate_hz = 200.0;
        setUp();
        run(&m, 0.0, 1.0);
        uint32_t k = sample_at(&m, 2.0);
        const uint32_t ticks = leg.joint[0].ticks.count;
        jcal_triple_t triple = leg_sample(&m, k);
        jcal_imu_t *const imus[3] = {&triple.imu1, &triple.imu2, &triple.imu3};
        imus[sensor - 1]->gyr_rad_s.x = 250.0f;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_leg_update(&leg, &triple));
        for (uint32_t end = k + 400u; k < end;) {
            triple = leg_sample(&m, ++k);
            (void)jcal_leg_update(&leg, &triple);
        }
        TEST_ASSERT_TRUE(leg.joint[0].ticks.count > ticks + 30u); /* 40 in 2 s, less those of the beginning */
        TEST_ASSERT_TRUE(leg.joint[1].ticks.count > ticks + 30u);
    }
}

/* A fault of the thigh's sensor is one of both joints, but one reading. The first cause of either joint counts. */
static void what_is_refused_is_counted_once(void)
{
    const chain_motion_t m = leg_lively(0);
    run(&m, 0.0, 4.0);
    jcal_triple_t triple = leg_sample(&m, sample_at(&m, 4.0));
    triple.imu2.gyr_rad_s.z = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_leg_update(&leg, &triple));
    triple = leg_sample(&m, sample_at(&m, 4.0) + 1u);
    triple.imu1.acc_m_s2.x = 4e3f;
    triple.imu3.acc_m_s2.x = INFINITY;
    const jcal_ball_t before[2] = {leg.joint[0], leg.joint[1]};
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_leg_update(&leg, &triple));
    TEST_ASSERT_EQUAL_MEMORY(before, leg.joint, sizeof before);
    const jcal_leg_result_t r = result();
    TEST_ASSERT_EQUAL_UINT32(2u, r.head.rejected);
    TEST_ASSERT_EQUAL_UINT32(2u, r.head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_UINT32(sample_at(&m, 4.0) + 2u, r.head.samples);
}

/* What the gate of one joint refuses, the sensor of the other does not follow either. */
static void a_reading_that_one_gate_refuses_is_followed_by_none(void)
{
    for (int sensor = 1; sensor <= 3; ++sensor) {
        const chain_motion_t m = leg_lively(0);
        setUp();
        run(&m, 0.0, 4.0);
        jcal_triple_t triple = leg_sample(&m, sample_at(&m, 4.0));
        const uint64_t before_us = leg.sensor[0].last_us;
        jcal_imu_t *const imus[3] = {&triple.imu1, &triple.imu2, &triple.imu3};
        imus[sensor - 1]->gyr_rad_s.x = 50.0f; /* no sensor stage would mind */
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_leg_update(&leg, &triple));
        TEST_ASSERT_EQUAL_UINT32(1u, result().head.rejected_by[JCAL_REJECT_OUT_OF_RANGE]);
        for (int i = 0; i < 3; ++i) {
            TEST_ASSERT_TRUE(before_us == leg.sensor[i].last_us);
        }
    }
}

/* What clips or repeats is followed all the same: a turn that is left out is lost. */
static void a_repeated_reading_is_counted_and_followed(void)
{
    const chain_motion_t m = leg_lively(0);
    run(&m, 0.0, 4.0);
    const jcal_triple_t last = leg_sample(&m, sample_at(&m, 4.0) - 1u);
    jcal_triple_t triple = leg_sample(&m, sample_at(&m, 4.0));
    triple.imu3 = last.imu3;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_leg_update(&leg, &triple));
    TEST_ASSERT_EQUAL_UINT32(1u, result().head.rejected_by[JCAL_REJECT_REPEATED]);
    for (int i = 0; i < 3; ++i) {
        TEST_ASSERT_TRUE(triple.t_us == leg.sensor[i].last_us);
    }
}

/* Accelerations of the shank in g: its joint is not to be believed, the hip is. */
static void wrong_units_of_one_sensor_are_told_and_spare_the_other_joint(void)
{
    const chain_motion_t m = leg_lively(1);
    run(&m, 0.0, RUN_S);
    for (uint32_t k = sample_at(&m, RUN_S); k < sample_at(&m, RUN_S + 6.0); ++k) {
        jcal_triple_t triple = leg_sample(&m, k);
        triple.imu3.acc_m_s2 = jcal_vec3_scale(triple.imu3.acc_m_s2, 1.0f / 9.81f);
        (void)jcal_leg_update(&leg, &triple);
    }
    const jcal_leg_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_ACC, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
    TEST_ASSERT_TRUE(r.known[0] && r.known[1]);
    TEST_ASSERT_FALSE(r.known[2] || r.known[3]);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.joint_status[JCAL_LEG_KNEE]);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.joint_status[JCAL_LEG_HIP]);
}

/* A shank sensor that turns on its segment. */
static void a_slip_of_one_sensor_is_noticed_and_spares_the_other_joint(void)
{
    const chain_motion_t m = leg_lively(1);
    run(&m, 0.0, RUN_S);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result().head.status);
    bool moved = false;
    for (uint32_t k = sample_at(&m, RUN_S); k < sample_at(&m, RUN_S + 6.0) && !moved; ++k) {
        jcal_triple_t triple = leg_sample(&m, k);
        const jcal_imu_t felt = triple.imu3;
        triple.imu3.gyr_rad_s = jcal_vec3(-felt.gyr_rad_s.y, felt.gyr_rad_s.x, felt.gyr_rad_s.z);
        triple.imu3.acc_m_s2 = jcal_vec3(-felt.acc_m_s2.y, felt.acc_m_s2.x, felt.acc_m_s2.z);
        (void)jcal_leg_update(&leg, &triple);
        moved = result().head.status == JCAL_MOVED;
    }
    TEST_ASSERT_TRUE(moved);
    const jcal_leg_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_MOVED, r.joint_status[JCAL_LEG_KNEE]);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.joint_status[JCAL_LEG_HIP]);
    TEST_ASSERT_TRUE(r.known[0] && r.known[1]);
    TEST_ASSERT_FALSE(r.known[2] || r.known[3]);
}

/* Work is shared: both joints pay for the same number of slices, and one that has nothing to do leaves its turn to the other. */
static void steps_are_shared_between_the_joints(void)
{
    const chain_motion_t m = leg_lively(0);
    run(&m, 0.0, 3.0);
    for (uint32_t k = sample_at(&m, 3.0); k < sample_at(&m, 4.0); ++k) {
        const jcal_triple_t triple = leg_sample(&m, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_push(&leg, &triple));
    }
    const float full[2] = {leg.joint[0].credit, leg.joint[1].credit};
    for (int i = 0; i < 6; ++i) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_step(&leg));
    }
    TEST_ASSERT_EQUAL_FLOAT(full[0] - 3.0f, leg.joint[0].credit);
    TEST_ASSERT_EQUAL_FLOAT(full[1] - 3.0f, leg.joint[1].credit);
    leg.joint[0].credit = 0.0f;
    for (int i = 0; i < 2; ++i) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_step(&leg));
    }
    TEST_ASSERT_EQUAL_FLOAT(full[1] - 5.0f, leg.joint[1].credit);
    leg.joint[1].credit = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_leg_step(&leg));
}

/* A leg of which everything is known, with places and bounds that are made up. */
static void make_up(float bound_m)
{
    begin();
    for (int i = 0; i < JCAL_LEG_JOINTS; ++i) {
        jcal_ball_t *const joint = &leg.joint[i];
        joint->has_estimate = true;
        joint->verdict.status = (uint8_t)JCAL_READY;
        joint->verdict.agreed = 3u;
        joint->verdict.heading_rad = 0.1f;
        joint->verdict.bound1_m = bound_m;
        joint->verdict.bound2_m = bound_m;
        joint->point.r1 = jcal_vec3(0.0f, 0.1f, 0.0f);
        joint->point.r2 = jcal_vec3(0.0f, -0.3f, 0.0f);
    }
}

/* By hand: r_h = 0.3 and r_k = 0.1 m, 0.4 m in all; the rests are 0.05 - 0.1 * 0.3 = 0.02 and 0.077 - 0.17 * 0.1 = 0.06 m. */
static void bounds_with_a_known_length_are_those_worked_out_by_hand(void)
{
    config.thigh_length_m = 0.44f;
    make_up(0.05f);
    leg.joint[1].verdict.bound1_m = 0.077f;
    jcal_leg_result_t r = result();
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.1f, r.length_factor);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.33f, r.place_m[1].y);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.11f, r.place_m[2].y);
    /* s = 0.75: common 0.25 * 0.02 + 0.75 * 0.06 = 0.05, more than 0.02 */
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.1f * (0.05f + 0.05f * 0.3f), r.uncertainty_m[1]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.1f * (0.06f + 0.05f * 0.1f), r.uncertainty_m[2]);
    /* the other way round: rests 0.06 and 0.02, common 0.03 */
    leg.joint[0].verdict.bound2_m = 0.09f;
    leg.joint[1].verdict.bound1_m = 0.037f;
    r = result();
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.1f * (0.06f + 0.05f * 0.3f), r.uncertainty_m[1]);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.1f * (0.03f + 0.05f * 0.1f), r.uncertainty_m[2]);
}

/* The worst of what is not known is named, of the joint that it belongs to. */
static void the_worst_that_is_open_is_named(void)
{
    static const jcal_hint_t hints[JCAL_CHAIN_PLACES] = {JCAL_HINT_MOVE_SEGMENT1, JCAL_HINT_MOVE_SEGMENT2,
                                                         JCAL_HINT_MOVE_SEGMENT1, JCAL_HINT_MOVE_SEGMENT2};
    for (int worst = 0; worst < JCAL_CHAIN_PLACES; ++worst) {
        make_up(0.08f);
        jcal_ball_verdict_t *const verdict = &leg.joint[worst / 2].verdict;
        *((worst % 2 == 0) ? &verdict->bound1_m : &verdict->bound2_m) = 0.2f;
        const jcal_leg_result_t r = result();
        TEST_ASSERT_EQUAL_INT((worst < 2) ? JCAL_WEAK_CENTER1 : JCAL_WEAK_CENTER2, r.head.weak);
        TEST_ASSERT_EQUAL_INT(hints[worst], r.head.hint);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, r.head.reason);
    }
}

/* A joint that is not known as one has no vector that is, whatever its bounds; of two the one with the wider heading is told. */
static void each_joint_stands_for_itself(void)
{
    for (int open = 0; open < JCAL_LEG_JOINTS; ++open) {
        make_up(0.02f);
        leg.joint[open].verdict.status = (uint8_t)JCAL_COLLECTING;
        leg.joint[open].verdict.reason = (uint8_t)JCAL_REASON_NO_BEND;
        leg.joint[open].verdict.hint = (uint8_t)JCAL_HINT_MOVE_JOINT;
        jcal_leg_result_t r = result();
        for (int i = 0; i < JCAL_CHAIN_PLACES; ++i) {
            TEST_ASSERT_EQUAL(i / 2 != open, r.known[i]);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_WEAK_HEADING, r.head.weak);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_BEND, r.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, r.head.hint);
        jcal_ball_verdict_t *const other = &leg.joint[1 - open].verdict;
        other->status = (uint8_t)JCAL_COLLECTING;
        other->reason = (uint8_t)JCAL_REASON_UNCERTAIN;
        other->hint = (uint8_t)JCAL_HINT_MOVE_FASTER;
        other->heading_rad = 0.5f;
        r = result();
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, r.head.reason);
        TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_FASTER, r.head.hint);
    }
}

/* What a gate complains of is its joint's: neither of its vectors is known then. */
static void a_complaint_takes_both_vectors_of_its_joint(void)
{
    for (int bad = 0; bad < JCAL_LEG_JOINTS; ++bad) {
        make_up(0.02f);
        leg.gate[bad].bad_share = 0.9f;
        const jcal_leg_result_t r = result();
        for (int i = 0; i < JCAL_CHAIN_PLACES; ++i) {
            TEST_ASSERT_EQUAL(i / 2 != bad, r.known[i]);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, r.head.reason);
        TEST_ASSERT_EQUAL_INT((bad == 0) ? JCAL_WEAK_CENTER1 : JCAL_WEAK_CENTER2, r.head.weak);
    }
}

/* Settings reach both joints, and limits survive a reset. */
static void settings_reach_the_joints(void)
{
    jcal_gate_config_t limits = jcal_gate_config_default();
    limits.gyr_max_rad_s = 20.0f;
    config.max_heading_rad = 0.05f;
    config.max_lever_m = 0.025f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_init(&leg, &config, &limits));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_reset(&leg));
    for (int i = 0; i < JCAL_LEG_JOINTS; ++i) {
        TEST_ASSERT_EQUAL_FLOAT(0.05f, leg.joint[i].cfg.max_heading_rad);
        TEST_ASSERT_EQUAL_FLOAT(0.025f, leg.joint[i].cfg.max_lever_m);
    }
    const chain_motion_t m = leg_lively(0);
    jcal_triple_t triple = leg_sample(&m, 0u);
    triple.imu3.gyr_rad_s.x = 25.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_leg_update(&leg, &triple));
}

/* As many slices as two joints are due: with 100 a second each, two and two at 50 Hz. */
static void an_update_does_what_is_due_for_both_joints(void)
{
    const chain_motion_t m = leg_lively(0);
    run(&m, 0.0, 4.0);
    const jcal_triple_t triple = leg_sample(&m, sample_at(&m, 4.0));
    jcal_leg_t by_hand = leg;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_push(&by_hand, &triple));
    for (int i = 0; i < 4; ++i) {
        (void)jcal_leg_step(&by_hand);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_update(&leg, &triple));
    TEST_ASSERT_EQUAL_FLOAT(by_hand.joint[0].credit, leg.joint[0].credit);
    TEST_ASSERT_EQUAL_FLOAT(by_hand.joint[1].credit, leg.joint[1].credit);
    TEST_ASSERT_TRUE(triple.t_us == leg.last_us);
    TEST_ASSERT_TRUE(leg.joint[0].ticks.last_us == result().head.t_us);
}

/* What is known may become worse by a fifth before it is not any more. */
static void what_is_known_stays_so_while_its_bound_breathes(void)
{
    const chain_motion_t m = leg_lively(1);
    run(&m, 0.0, RUN_S);
    leg.joint[0].verdict.bound1_m = 1.15f * config.max_lever_m;
    TEST_ASSERT_TRUE(result().known[JCAL_CHAIN_HIP_TO_PELVIS]);
    leg.joint[0].verdict.bound1_m = 1.25f * config.max_lever_m;
    TEST_ASSERT_FALSE(result().known[JCAL_CHAIN_HIP_TO_PELVIS]);
    leg.joint[0].verdict.bound1_m = 1.15f * config.max_lever_m;
    memset(leg.was_known, 0, sizeof leg.was_known);
    TEST_ASSERT_FALSE(result().known[JCAL_CHAIN_HIP_TO_PELVIS]);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result().head.status);
}

static void a_copy_goes_on_with_the_same_bits_and_reset_begins_anew(void)
{
    const chain_motion_t m = leg_lively(0);
    const jcal_leg_t fresh = leg;
    run(&m, 0.0, 6.0);
    jcal_leg_t copy = leg;
    for (uint32_t k = sample_at(&m, 6.0); k < sample_at(&m, 9.0); ++k) {
        const jcal_triple_t triple = leg_sample(&m, k);
        TEST_ASSERT_EQUAL_INT(jcal_leg_update(&leg, &triple), jcal_leg_update(&copy, &triple));
    }
    TEST_ASSERT_EQUAL_MEMORY(&leg, &copy, sizeof leg);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_leg_reset(&leg));
    TEST_ASSERT_EQUAL_MEMORY(&fresh, &leg, sizeof leg);
}

static void settings_have_ranges(void)
{
    TEST_ASSERT_NULL(jcal_leg_config_check(&config));
    TEST_ASSERT_EQUAL_STRING("config", jcal_leg_config_check(NULL));
    TEST_ASSERT_EQUAL_FLOAT(0.06f, config.max_lever_m);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.261799f, config.max_heading_rad); /* 15 deg */
    TEST_ASSERT_EQUAL_FLOAT(0.0f, config.thigh_length_m);
    const float levers[] = {0.0009f, 1.01f, NAN};
    const float headings[] = {0.009f, 1.01f, NAN};
    const float lengths[] = {0.09f, 1.01f, -0.4f, NAN};
    for (size_t i = 0u; i < sizeof levers / sizeof levers[0]; ++i) {
        jcal_leg_config_t wrong = config;
        wrong.max_lever_m = levers[i];
        TEST_ASSERT_EQUAL_STRING("max_lever_m", jcal_leg_config_check(&wrong));
        wrong = config;
        wrong.max_heading_rad = headings[i];
        TEST_ASSERT_EQUAL_STRING("max_heading_rad", jcal_leg_config_check(&wrong));
    }
    for (size_t i = 0u; i < sizeof lengths / sizeof lengths[0]; ++i) {
        jcal_leg_config_t wrong = config;
        wrong.thigh_length_m = lengths[i];
        TEST_ASSERT_EQUAL_STRING("thigh_length_m", jcal_leg_config_check(&wrong));
    }
    config.thigh_length_m = 0.1f;
    TEST_ASSERT_NULL(jcal_leg_config_check(&config));
    config.thigh_length_m = 1.0f;
    TEST_ASSERT_NULL(jcal_leg_config_check(&config));
}

static void null_wrong_settings_and_what_was_never_prepared_are_errors(void)
{
    const chain_motion_t m = leg_lively(0);
    const jcal_triple_t triple = leg_sample(&m, 0u);
    jcal_leg_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_init(NULL, &config, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_init(&leg, NULL, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_push(NULL, &triple));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_push(&leg, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_update(NULL, &triple));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_update(&leg, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_get(NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_get(&leg, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_reset(NULL));
    const jcal_leg_t before = leg;
    jcal_gate_config_t limits = jcal_gate_config_default();
    limits.gap_s = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_leg_init(&leg, &config, &limits));
    config.thigh_length_m = 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_leg_init(&leg, &config, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &leg, sizeof before);
    memset(&leg, 0, sizeof leg);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_push(&leg, &triple));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_update(&leg, &triple));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_step(&leg));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_leg_reset(&leg));
    const jcal_leg_result_t r = result();
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_FALSE(r.known[0] || r.known[1] || r.known[2] || r.known[3]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(exact_motion_gets_ready_and_the_truth_is_inside);
    RUN_TEST(headings_are_those_of_the_motion);
    RUN_TEST(a_known_length_scales_both_vectors_on_the_thigh);
    RUN_TEST(a_known_length_takes_out_a_common_factor);
    RUN_TEST(a_length_that_cannot_be_leaves_the_thigh_unknown);
    RUN_TEST(a_length_that_is_not_excluded_yet_asks_for_more_motion);
    RUN_TEST(a_pelvis_that_hardly_turns_never_has_a_bound_that_is_too_small);
    RUN_TEST(a_pelvis_at_rest_leaves_its_own_vector_open);
    RUN_TEST(no_motion_is_asked_for_that_would_not_help);
    RUN_TEST(without_motion_nothing_is_known);
    RUN_TEST(a_gap_in_one_sensor_leaves_all_in_step);
    RUN_TEST(sensors_stay_in_step_when_one_refuses_the_first_reading_after_a_gap);
    RUN_TEST(what_is_refused_is_counted_once);
    RUN_TEST(a_reading_that_one_gate_refuses_is_followed_by_none);
    RUN_TEST(a_repeated_reading_is_counted_and_followed);
    RUN_TEST(wrong_units_of_one_sensor_are_told_and_spare_the_other_joint);
    RUN_TEST(a_slip_of_one_sensor_is_noticed_and_spares_the_other_joint);
    RUN_TEST(steps_are_shared_between_the_joints);
    RUN_TEST(what_is_known_stays_so_while_its_bound_breathes);
    RUN_TEST(bounds_with_a_known_length_are_those_worked_out_by_hand);
    RUN_TEST(the_worst_that_is_open_is_named);
    RUN_TEST(each_joint_stands_for_itself);
    RUN_TEST(a_complaint_takes_both_vectors_of_its_joint);
    RUN_TEST(settings_reach_the_joints);
    RUN_TEST(an_update_does_what_is_due_for_both_joints);
    RUN_TEST(a_copy_goes_on_with_the_same_bits_and_reset_begins_anew);
    RUN_TEST(settings_have_ranges);
    RUN_TEST(null_wrong_settings_and_what_was_never_prepared_are_errors);
    return UNITY_END();
}
