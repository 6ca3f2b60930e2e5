/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/hinge/search.h and hinge/point.h: starts, rounds, what a probe's end is filed as.
#include "hinge/refine.h"
#include "hinge/search.h"
#include "hinge/stream.h"
#include "joint/sign.h"
#include "math/solve.h"
#include "unit/hinge/double.h"
#include "unit/hinge/motion.h"
#include "unity.h"

#include <string.h>

/* 9 pairs of eigenvectors; a probe ends with its fifth step. */
enum { SAMPLES = 400, EIGEN_STARTS = 9, LAST_STEP = 4 };

static jcal_hinge_t engine;
static motion_t motion;
static dsample_t samples[SAMPLES];
static double rates4[2][3][3]; /* weighted sum of |w|^2 w w' */

static void sum_up(double sign_of_a2)
{
    memset(&engine.coarse.moments, 0, sizeof engine.coarse.moments);
    for (int k = 0; k < SAMPLES; ++k) {
        dsample_t s = samples[k];
        for (int i = 0; i < 3; ++i) {
            s.a[1][i] *= sign_of_a2;
        }
        add_to_moments(&s, &engine.coarse.moments);
    }
}

void setUp(void)
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
    motion = motion_lively(21);
    memset(rates4, 0, sizeof rates4);
    for (uint32_t k = 0; k < SAMPLES; ++k) {
        const jcal_pair_t p = motion_sample(&motion, k);
        dsample_t *const s = &samples[k];
        s->gyr_weight = 100.0;
        s->acc_weight = 0.1;
        dset(p.imu1.gyr_rad_s, s->w[0]);
        dset(p.imu2.gyr_rad_s, s->w[1]);
        dset(p.imu1.acc_m_s2, s->a[0]);
        dset(p.imu2.acc_m_s2, s->a[1]);
        for (int i = 0; i < 18; ++i) {
            const double *const w = s->w[i / 9];
            rates4[i / 9][(i / 3) % 3][i % 3] += 100.0 * ddot(w, w) * w[(i / 3) % 3] * w[i % 3];
        }
    }
    sum_up(1.0);
}

void tearDown(void)
{
}

static jcal_hinge_point_t point_of(jcal_vec3_t j1, jcal_vec3_t j2)
{
    jcal_hinge_point_t point;
    memset(&point, 0, sizeof point);
    jcal_hinge_point_set(&point, j1, j2);
    return point;
}

static jcal_hinge_point_t truth(void)
{
    return point_of(motion_axis(&motion, 0), motion_axis(&motion, 1));
}

static jcal_vec3_t opposite(jcal_vec3_t v)
{
    return jcal_vec3_scale(v, -1.0f);
}

static jcal_hinge_point_t turned(const jcal_hinge_point_t *point)
{
    return point_of(point->axis1.j, opposite(point->axis2.j));
}

static jcal_hinge_place_t place_of(const jcal_hinge_point_t *point)
{
    const jcal_hinge_place_t place = {point->axis1.j, point->axis2.j};
    return place;
}

/* An estimate as it stands after a while of refining and judging. */
static void place_at(jcal_hinge_point_t point)
{
    engine.coarse.point = point;
    engine.coarse.has_point = true;
    jcal_hinge_refine_restart(&engine.refine, &point);
    engine.refine.blocks = 5.0f;
    engine.verdict.status = (uint8_t)JCAL_READY;
    engine.verdict.agreed = 6u;
}

static void place_at_truth(void)
{
    place_at(truth());
}

static void assert_place(const jcal_hinge_point_t *expected, const jcal_hinge_place_t *place, float tol)
{
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 2.0f,
                             jcal_vec3_norm(place->j1) + jcal_vec3_norm(place->j2)); /* zero has no angle */
    TEST_ASSERT_TRUE(jcal_sphere_angle(expected->axis1.j, place->j1) <= tol);
    TEST_ASSERT_TRUE(jcal_sphere_angle(expected->axis2.j, place->j2) <= tol);
}

/* What rounding of a note turns an axis by, at most: half a 32760th in each component. */
#define NOTE_RAD 2.7e-5f

static void assert_noted(const jcal_hinge_point_t *expected, const jcal_hinge_note_t note[2], float tol)
{
    const jcal_hinge_place_t place = {jcal_hinge_noted(note[0]), jcal_hinge_noted(note[1])};
    assert_place(expected, &place, tol + NOTE_RAD);
}

static void assert_point(const jcal_hinge_point_t *expected, const jcal_hinge_point_t *point, float tol)
{
    const jcal_hinge_place_t place = place_of(point);
    assert_place(expected, &place, tol);
}

/* The eigenvalue of v, which must be an eigenvector; its share of the trace. */
static double eigenvalue(jcal_vec3_t axis, int sensor)
{
    double v[3];
    double image[3];
    dset(axis, v);
    for (int i = 0; i < 3; ++i) {
        image[i] = ddot(rates4[sensor][i], v);
    }
    const double value = ddot(image, v);
    const double trace = rates4[sensor][0][0] + rates4[sensor][1][1] + rates4[sensor][2][2];
    for (int i = 0; i < 3; ++i) {
        TEST_ASSERT_TRUE(fabs(image[i] - (value * v[i])) < 1e-5 * trace); /* float sums of 400 terms */
    }
    return value / trace;
}

/* Cost of the specific forces, sample by sample, with the constant that minimises it. */
static double direct_cost_acc(jcal_vec3_t j1, jcal_vec3_t j2, double sign_of_a2)
{
    dpoint_t p = {0};
    dset(j1, p.j[0]);
    dset(jcal_vec3_scale(j2, (float)sign_of_a2), p.j[1]);
    const double bias = (double)engine.cfg.acc_bias_m_s2;
    double weight = 1.0 / (2.0 * bias * bias);
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < SAMPLES; ++k) {
        const double e = de_acc(&samples[k], &p);
        weight += samples[k].acc_weight;
        sum += samples[k].acc_weight * e;
        squares += samples[k].acc_weight * e * e;
    }
    return squares - (sum * sum / weight);
}

static void get_start(int start, jcal_vec3_t out[2])
{
    engine.search.running = false;
    engine.search.start = (uint8_t)start;
    jcal_hinge_look_around(&engine);
    TEST_ASSERT_TRUE(engine.search.running);
    out[0] = engine.search.probe.j1;
    out[1] = engine.search.probe.j2;
}

static void the_first_9_starts_are_all_pairs_of_eigenvectors(void)
{
    double values[2][EIGEN_STARTS];
    place_at_truth();
    for (int s = 0; s < EIGEN_STARTS; ++s) {
        jcal_vec3_t start[2];
        get_start(s, start);
        for (int sensor = 0; sensor < 2; ++sensor) {
            values[sensor][s] = eigenvalue(start[sensor], sensor);
        }
    }
    for (int sensor = 0; sensor < 2;
         ++sensor) { /* each of the three comes three times, so together they make 3 traces */
        double sum = 0.0;
        for (int s = 0; s < EIGEN_STARTS; ++s) {
            sum += values[sensor][s];
        }
        TEST_ASSERT_TRUE(fabs(sum - 3.0) < 1e-4);
    }
    for (int s = 0; s < EIGEN_STARTS; ++s) { /* no pair comes twice */
        for (int other = 0; other < s; ++other) {
            const double apart1 = fabs(values[0][s] - values[0][other]);
            const double apart2 = fabs(values[1][s] - values[1][other]);
            TEST_ASSERT_TRUE((apart1 > 1e-3) || (apart2 > 1e-3));
        }
    }
}

static void each_start_has_the_pairing_that_the_specific_forces_prefer(void)
{
    jcal_vec3_t starts[2][2];
    place_at_truth();
    for (int s = 0; s < EIGEN_STARTS; ++s) {
        for (int pass = 0; pass < 2;
             ++pass) { /* with all specific forces of sensor 2 turned round the other is preferred */
            const double sign = (pass == 0) ? 1.0 : -1.0;
            sum_up(sign);
            get_start(s, starts[pass]);
            const double chosen = direct_cost_acc(starts[pass][0], starts[pass][1], sign);
            const double other = direct_cost_acc(starts[pass][0], opposite(starts[pass][1]), sign);
            TEST_ASSERT_TRUE(chosen < other);
        }
        TEST_ASSERT_TRUE(jcal_vec3_dot(starts[0][0], starts[1][0]) * jcal_vec3_dot(starts[0][1], starts[1][1]) <
                         -0.99f);
    }
}

static void the_last_start_is_the_estimate_with_axis_2_turned_round(void)
{
    place_at_truth();
    engine.search.start = EIGEN_STARTS;
    jcal_hinge_look_around(&engine);
    const jcal_vec3_t turned = jcal_vec3_scale(engine.coarse.point.axis2.j, -1.0f);
    TEST_ASSERT_EQUAL_MEMORY(&engine.coarse.point.axis1.j, &engine.search.probe.j1, sizeof turned);
    TEST_ASSERT_EQUAL_FLOAT(turned.x, engine.search.probe.j2.x);
    TEST_ASSERT_EQUAL_FLOAT(turned.y, engine.search.probe.j2.y);
    TEST_ASSERT_EQUAL_FLOAT(turned.z, engine.search.probe.j2.z);
}

static void a_round_over_all_starts_is_counted_and_stops_counting_at_its_limit(void)
{
    place_at_truth();
    engine.amount.excitation = 0.0f;
    for (int k = 0; k < 1000; ++k) {
        jcal_hinge_look_around(&engine);
    }
    TEST_ASSERT_EQUAL_UINT8(0, engine.search.rounds); /* rounds over data in which no joint moved say nothing */
    engine.amount.excitation = 1.0f;
    engine.search.running = false;
    engine.search.start = 0u;
    uint32_t starts = 0;
    for (int k = 0; (k < 1000) && (engine.search.rounds == 0u); ++k) {
        starts += engine.search.running ? 0u : 1u;
        jcal_hinge_look_around(&engine);
    }
    TEST_ASSERT_EQUAL_UINT8(1, engine.search.rounds);
    TEST_ASSERT_EQUAL_UINT32(EIGEN_STARTS + 1, starts);
    TEST_ASSERT_EQUAL_UINT8(0, engine.search.start);
    engine.search.rounds = UINT8_MAX;
    for (int k = 0; k < 1000; ++k) {
        jcal_hinge_look_around(&engine);
    }
    TEST_ASSERT_EQUAL_UINT8(UINT8_MAX, engine.search.rounds);
}

/* The probe ends here: one last step, damped so much that it leads nowhere. */
static void end_probe_at(jcal_hinge_point_t point)
{
    engine.search.probe = place_of(&point);
    engine.search.damping = JCAL_GN_DAMPING_MAX;
    engine.search.iterations = LAST_STEP;
    engine.search.running = true;
    engine.search.start = 0u;
    jcal_hinge_look_around(&engine);
    TEST_ASSERT_FALSE(engine.search.running);
}

/* With the largest damping a step is at most one millionth of one, plus roundings. */
static const float STAYS_RAD = 1e-5f;

/* Some axes, both of them 20 to 90 deg from the truth. */
static jcal_hinge_point_t elsewhere(uint32_t which)
{
    const jcal_hinge_point_t true_point = truth();
    jcal_rng_t rng = {which + 100u};
    jcal_hinge_point_t point = random_point(&rng);
    while ((fabsf(jcal_vec3_dot(point.axis1.j, true_point.axis1.j)) > 0.93f) ||
           (fabsf(jcal_vec3_dot(point.axis2.j, true_point.axis2.j)) > 0.93f)) {
        point = random_point(&rng);
    }
    return point;
}

static float cost_at(const jcal_hinge_point_t *point)
{
    return jcal_hinge_cost(&engine.coarse.moments, &engine.cfg, point);
}

static void assert_begun_anew(const jcal_hinge_point_t *expected)
{
    assert_point(expected, &engine.coarse.point, STAYS_RAD + NOTE_RAD); /* it may have been a note */
    assert_point(expected, &engine.refine.point, STAYS_RAD + NOTE_RAD);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, engine.refine.blocks);
    TEST_ASSERT_EQUAL_UINT8(JCAL_COLLECTING, engine.verdict.status); /* what was judged was another estimate */
    TEST_ASSERT_EQUAL_UINT8(JCAL_REASON_NO_DATA, engine.verdict.reason);
    TEST_ASSERT_EQUAL_UINT8(0, engine.verdict.agreed);
    TEST_ASSERT_TRUE(engine.coarse.has_point);
}

static void the_first_probe_that_ends_is_the_estimate(void)
{
    const jcal_hinge_point_t first = elsewhere(1);
    end_probe_at(first);
    assert_begun_anew(&first);
    TEST_ASSERT_FALSE(engine.search.has_rival);
    TEST_ASSERT_FALSE(engine.search.has_flip);
}

static void a_better_minimum_elsewhere_is_adopted_and_the_old_one_becomes_the_rival(void)
{
    const jcal_hinge_point_t old = elsewhere(2);
    const jcal_hinge_point_t better = truth();
    TEST_ASSERT_TRUE(cost_at(&better) < cost_at(&old));
    place_at(old);
    engine.search.has_flip = true; /* of the old axes */
    end_probe_at(better);
    assert_begun_anew(&better);
    TEST_ASSERT_TRUE(engine.search.has_rival);
    assert_noted(&old, engine.search.rival, 0.0f);
    TEST_ASSERT_FALSE(engine.search.has_flip);
}

static void of_worse_minima_elsewhere_the_best_is_the_rival(void)
{
    place_at_truth();
    float best = INFINITY;
    for (uint32_t which = 0; which < 20; ++which) {
        const jcal_hinge_point_t worse = elsewhere(which);
        TEST_ASSERT_TRUE(cost_at(&worse) > cost_at(&engine.coarse.point));
        best = fminf(best, cost_at(&worse));
        end_probe_at(worse);
        TEST_ASSERT_TRUE(engine.search.has_rival);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * best, best,
                                 jcal_hinge_cost_of_rival(&engine.search, &engine.coarse.moments, &engine.cfg));
    }
    const jcal_hinge_point_t expected = truth();
    assert_point(&expected, &engine.coarse.point, 0.0f);
    TEST_ASSERT_EQUAL_UINT8(JCAL_READY, engine.verdict.status);
    TEST_ASSERT_FALSE(engine.search.has_flip);
}

static void the_same_lines_with_the_other_pairing_are_the_flip(void)
{
    const jcal_hinge_point_t right = truth();
    const jcal_hinge_point_t wrong = turned(&right);
    TEST_ASSERT_TRUE(cost_at(&right) < cost_at(&wrong));
    place_at_truth();
    end_probe_at(wrong);
    TEST_ASSERT_TRUE(engine.search.has_flip);
    TEST_ASSERT_FALSE(engine.search.has_rival);
    assert_noted(&wrong, engine.search.flip, STAYS_RAD);
    assert_point(&right, &engine.coarse.point, 0.0f);
    /* Even a better one is only filed once there is something refined: the judgement decides then. */
    place_at(wrong);
    end_probe_at(right);
    assert_noted(&right, engine.search.flip, STAYS_RAD);
    assert_point(&wrong, &engine.coarse.point, 0.0f);
    TEST_ASSERT_EQUAL_UINT8(JCAL_READY, engine.verdict.status);
}

static void before_anything_is_refined_the_better_pairing_takes_over(void)
{
    const jcal_hinge_point_t right = truth();
    const jcal_hinge_point_t wrong = turned(&right);
    place_at(wrong);
    engine.refine.blocks = 0.0f;
    end_probe_at(right);
    assert_begun_anew(&right);
    TEST_ASSERT_TRUE(engine.search.has_flip);
    assert_noted(&wrong, engine.search.flip, 0.0f);
}

static void with_a_hint_no_other_pairing_is_ever_filed(void)
{
    const jcal_hinge_point_t right = truth();
    const jcal_hinge_point_t wrong = turned(&right);
    const bool same = jcal_sign_main(right.axis1.j) == jcal_sign_main(right.axis2.j);
    engine.cfg.sign_hint = same ? JCAL_SIGN_OPPOSITE : JCAL_SIGN_SAME; /* the wrong one */
    place_at(wrong);
    end_probe_at(right);
    TEST_ASSERT_FALSE(engine.search.has_flip);
    assert_point(&wrong, &engine.coarse.point, 0.0f);
}

static void turning_round_exchanges_the_estimate_and_the_flip(void)
{
    const jcal_hinge_point_t old = truth();
    jcal_hinge_point_t flip = turned(&old);
    const float d[4] = {0.05f, -0.02f, 0.03f, 0.04f};
    jcal_hinge_point_move(&flip, d); /* its minimum lies a little elsewhere */
    place_at(old);
    engine.search.flip[0] = jcal_hinge_note(flip.axis1.j);
    engine.search.flip[1] = jcal_hinge_note(flip.axis2.j);
    engine.search.has_flip = true;
    const jcal_hinge_point_t seen = jcal_hinge_flipped(&engine.search, &engine.coarse.point);
    assert_point(&flip, &seen, NOTE_RAD);
    jcal_hinge_go_round(&engine);
    assert_begun_anew(&flip);
    assert_noted(&old, engine.search.flip, 0.0f);
    jcal_hinge_go_round(&engine);
    assert_begun_anew(&old);
    assert_noted(&flip, engine.search.flip, 0.0f);
}

static void without_a_flip_the_other_pairing_is_axis_2_turned_round(void)
{
    place_at_truth();
    const jcal_hinge_point_t old = engine.coarse.point;
    const jcal_hinge_point_t expected = turned(&old);
    const jcal_hinge_point_t seen = jcal_hinge_flipped(&engine.search, &engine.coarse.point);
    assert_point(&expected, &seen, 0.0f);
    assert_point(&old, &engine.coarse.point, 0.0f);
    jcal_hinge_go_round(&engine);
    assert_begun_anew(&expected);
    TEST_ASSERT_TRUE(engine.search.has_flip);
    assert_noted(&old, engine.search.flip, 0.0f);
}

static void a_search_without_an_estimate_finds_the_axes(void)
{
    for (int k = 0; k < 400; ++k) {
        jcal_hinge_look_around(&engine);
        jcal_hinge_track(&engine.coarse, &engine.cfg, &engine.refine.point);
    }
    TEST_ASSERT_TRUE(engine.coarse.has_point);
    /* Noise of 0.01 rad/s, 8 s: a few tenths of a degree. */
    const jcal_hinge_point_t expected = truth();
    TEST_ASSERT_TRUE(jcal_hinge_same_lines(&engine.coarse.point, &expected));
    TEST_ASSERT_TRUE(jcal_hinge_same_pairing(&engine.coarse.point, &expected)); /* the specific forces are exact */
    TEST_ASSERT_TRUE(fabsf(jcal_vec3_dot(engine.coarse.point.axis1.j, motion_axis(&motion, 0))) > 0.9999f);
    TEST_ASSERT_TRUE(fabsf(jcal_vec3_dot(engine.coarse.point.axis2.j, motion_axis(&motion, 1))) > 0.9999f);
}

static void sums_that_hold_nan_or_nothing_give_starts_along_the_coordinates_and_no_nan(void)
{
    const float bad[2] = {NAN, 0.0f};
    for (int i = 0; i < 2; ++i) {
        setUp();
        for (size_t k = 0; k < sizeof engine.coarse.moments.gyr / sizeof(float); ++k) {
            engine.coarse.moments.gyr[k] = bad[i];
        }
        memset(engine.coarse.moments.acc, 0, sizeof engine.coarse.moments.acc);
        for (int k = 0; k < 400; ++k) {
            jcal_hinge_look_around(&engine);
            TEST_ASSERT_TRUE(jcal_vec3_is_finite(engine.search.probe.j1) &&
                             jcal_vec3_is_finite(engine.search.probe.j2));
            TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_norm(engine.search.probe.j1));
        }
        TEST_ASSERT_TRUE(jcal_vec3_is_finite(engine.coarse.point.axis1.j));
    }
}

static void tracking_without_an_estimate_does_nothing(void)
{
    const jcal_hinge_t before = engine;
    jcal_hinge_track(&engine.coarse, &engine.cfg, &engine.refine.point);
    TEST_ASSERT_EQUAL_MEMORY(&before, &engine, sizeof engine);
}

static void an_axis_carries_an_orthonormal_tangent(void)
{
    jcal_rng_t rng = {6};
    jcal_hinge_axis_t axis;
    random_axis(&rng, &axis);
    for (int k = 0; k < 1000; ++k) { /* random jumps: u is now and then nearly parallel to the new axis */
        jcal_hinge_axis_set(&axis, ((k % 10) == 9) ? axis.u : jcal_rng_unit(&rng));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_norm(axis.u));
        /* A carried tangent is projected and, if a tenth of it is left, lengthened tenfold, and its rounding with it. */
        TEST_ASSERT_FLOAT_WITHIN(3e-6f, 0.0f, jcal_vec3_dot(axis.u, axis.j));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_dot(jcal_hinge_v(&axis), jcal_vec3_cross(axis.j, axis.u)));
    }
}

static void lines_are_the_same_within_eleven_degrees_whatever_their_signs(void)
{
    jcal_rng_t rng = {7};
    const float degrees[2] = {10.0f, 13.0f};
    const jcal_hinge_point_t point = random_point(&rng);
    for (int i = 0; i < 2; ++i) {
        const float rad = degrees[i] * 0.0174532925f;
        const jcal_vec3_t near1 =
            jcal_vec3_add(jcal_vec3_scale(point.axis1.j, cosf(rad)), jcal_vec3_scale(point.axis1.u, sinf(rad)));
        const jcal_vec3_t near2 =
            jcal_vec3_add(jcal_vec3_scale(point.axis2.j, -cosf(rad)), jcal_vec3_scale(point.axis2.u, sinf(rad)));
        const jcal_hinge_point_t moved1 = point_of(near1, point.axis2.j);
        const jcal_hinge_point_t moved2 = point_of(point.axis1.j, near2);
        TEST_ASSERT_EQUAL_INT(i == 0, jcal_hinge_same_lines(&point, &moved1));
        TEST_ASSERT_EQUAL_INT(i == 0, jcal_hinge_same_lines(&point, &moved2));
        TEST_ASSERT_TRUE(jcal_hinge_same_pairing(&point, &moved1));
        TEST_ASSERT_FALSE(jcal_hinge_same_pairing(&point, &moved2));
    }
}

static void both_signs_turned_together_are_the_same_pairing(void)
{
    jcal_rng_t rng = {8};
    const jcal_hinge_point_t point = random_point(&rng);
    const jcal_hinge_point_t both = point_of(opposite(point.axis1.j), opposite(point.axis2.j));
    const jcal_hinge_point_t first = point_of(opposite(point.axis1.j), point.axis2.j);
    const jcal_hinge_point_t second = turned(&point);
    TEST_ASSERT_TRUE(jcal_hinge_same_pairing(&point, &point));
    TEST_ASSERT_TRUE(jcal_hinge_same_pairing(&point, &both));
    TEST_ASSERT_FALSE(jcal_hinge_same_pairing(&point, &first));
    TEST_ASSERT_FALSE(jcal_hinge_same_pairing(&point, &second));
    TEST_ASSERT_TRUE(jcal_hinge_same_pairing(&first, &second));
}

static void the_main_sign_is_that_of_the_largest_component(void)
{
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_main(jcal_vec3(0.5f, -0.4f, -0.3f)));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_main(jcal_vec3(0.4f, -0.5f, 0.3f)));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, jcal_sign_main(jcal_vec3(0.4f, 0.3f, -0.5f)));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_main(jcal_vec3(-0.4f, -0.3f, 0.5f)));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, jcal_sign_main(jcal_vec3(0.0f, 0.0f, 0.0f)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_first_9_starts_are_all_pairs_of_eigenvectors);
    RUN_TEST(each_start_has_the_pairing_that_the_specific_forces_prefer);
    RUN_TEST(the_last_start_is_the_estimate_with_axis_2_turned_round);
    RUN_TEST(a_round_over_all_starts_is_counted_and_stops_counting_at_its_limit);
    RUN_TEST(the_first_probe_that_ends_is_the_estimate);
    RUN_TEST(a_better_minimum_elsewhere_is_adopted_and_the_old_one_becomes_the_rival);
    RUN_TEST(of_worse_minima_elsewhere_the_best_is_the_rival);
    RUN_TEST(the_same_lines_with_the_other_pairing_are_the_flip);
    RUN_TEST(before_anything_is_refined_the_better_pairing_takes_over);
    RUN_TEST(with_a_hint_no_other_pairing_is_ever_filed);
    RUN_TEST(turning_round_exchanges_the_estimate_and_the_flip);
    RUN_TEST(without_a_flip_the_other_pairing_is_axis_2_turned_round);
    RUN_TEST(a_search_without_an_estimate_finds_the_axes);
    RUN_TEST(sums_that_hold_nan_or_nothing_give_starts_along_the_coordinates_and_no_nan);
    RUN_TEST(tracking_without_an_estimate_does_nothing);
    RUN_TEST(an_axis_carries_an_orthonormal_tangent);
    RUN_TEST(lines_are_the_same_within_eleven_degrees_whatever_their_signs);
    RUN_TEST(both_signs_turned_together_are_the_same_pairing);
    RUN_TEST(the_main_sign_is_that_of_the_largest_component);
    return UNITY_END();
}
