/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/calib/hinge_evidence.h: every sum against double precision, sample by sample.
#include "hinge_evidence_fixture.h"

/* Sums of 900 float terms of one sign: their relative error. Signed sums are compared with the sum of magnitudes. */
static const double SUM_TOL = 2e-5;

static void assert_sum(double expected, double size, float actual)
{
    TEST_ASSERT_TRUE(fabs((double)actual - expected) < SUM_TOL * size);
}

static dsample_t dsample(const jcal_hinge_sample_t *s)
{
    dsample_t d = {0};
    dset(s->w1, d.w[0]);
    dset(s->w2, d.w[1]);
    dset(s->a1, d.a[0]);
    dset(s->a2, d.a[1]);
    d.gyr_weight = (double)s->gyr_weight;
    d.acc_weight = (double)s->acc_weight;
    return d;
}

/* Half the gradient of one sample's cost by the four unknowns of one sensor, by central differences, and the gradient
   by the square of a tilt, -(w . j)^2, with the sign that the scatter ignores. */
static void scores_of(uint32_t k, unsigned sensor, double out[5])
{
    const dsample_t s = dsample(&samples[k]);
    const dpoint_t here = dpoint(&point);
    const double e = de_gyr(&s, &here);
    const double ea = de_acc(&s, &here) - (double)ACC_CONSTANT_M_S2;
    const unsigned unknowns[4] = {2u * sensor, (2u * sensor) + 1u, 4u + (2u * sensor), 5u + (2u * sensor)};
    for (int i = 0; i < 4; ++i) {
        const double h = 1e-5;
        const dpoint_t plus = dmoved(&point, unknowns[i], h, (double)UNIT_RAD_S);
        const dpoint_t minus = dmoved(&point, unknowns[i], -h, (double)UNIT_RAD_S);
        out[i] = ((s.gyr_weight * e * (de_gyr(&s, &plus) - de_gyr(&s, &minus))) +
                  (s.acc_weight * ea * (de_acc(&s, &plus) - de_acc(&s, &minus)))) /
                 (2.0 * h);
    }
    double u[3];
    for (int i = 0; i < 3; ++i) {
        u[i] = s.w[sensor][i] - here.b[sensor][i];
    }
    const double along = ddot(u, here.j[sensor]);
    out[4] = ((sensor == 0u) ? 1.0 : -1.0) * s.gyr_weight * e * along * along;
}

static double information_of(uint32_t k, unsigned sensor)
{
    const double rate2 = (double)((sensor == 0u) ? samples[k].w1_2 : samples[k].w2_2);
    return ((double)samples[k].gyr_weight * rate2 * rate2) + (4.0 * (double)samples[k].acc_weight);
}

/* What the sums of one sensor should be. */
typedef struct {
    double fine[4][4], coarse[4][4], fine_second, second, information, information2;
    int coarse_blocks;
} expected_t;

static void close_block(const double score[5], double scatter[4][4], double *second)
{
    for (int i = 0; i < 16; ++i) {
        scatter[i / 4][i % 4] += score[i / 4] * score[i % 4];
    }
    *second += score[4] * score[4];
}

static expected_t expect(unsigned sensor)
{
    expected_t x;
    memset(&x, 0, sizeof x);
    double fine[5] = {0.0};
    double coarse[5] = {0.0};
    double fine_s = 0.0;
    double coarse_s = 0.0;
    double information = 0.0;
    for (uint32_t k = 0; k < SAMPLES; ++k) {
        const double dt = (double)samples[k].dt_s;
        double score[5];
        scores_of(k, sensor, score);
        for (int i = 0; i < 5; ++i) {
            fine[i] += score[i];
        }
        fine_s += dt;
        coarse_s += dt;
        information += information_of(k, sensor);
        x.information += information_of(k, sensor);
        /* A block ends with the sample that brings it nearest to its length. */
        if (fine_s >= 0.05 - (0.5 * dt)) {
            close_block(fine, x.fine, &x.fine_second);
            for (int i = 0; i < 5; ++i) {
                coarse[i] += fine[i];
                fine[i] = 0.0;
            }
            fine_s = 0.0;
        }
        if (coarse_s >= fmin(1.0, fmax(0.1, 0.05 * times_s[k])) - (0.5 * dt)) {
            close_block(coarse, x.coarse, &x.second);
            memset(coarse, 0, sizeof coarse);
            x.information2 += information * information;
            information = 0.0;
            coarse_s = 0.0;
            ++x.coarse_blocks;
        }
    }
    return x;
}

static void scatter_of_the_gradient_equals_sums_over_blocks_in_double(void)
{
    add_all(SAMPLES);
    for (unsigned sensor = 0; sensor < 2; ++sensor) {
        const jcal_hinge_scatter_t *const got = (sensor == 0u) ? &evidence.axis1 : &evidence.axis2;
        const expected_t x = expect(sensor);
        TEST_ASSERT_TRUE(x.coarse_blocks > 10);
        for (size_t i = 0; i < 4; ++i) {
            for (size_t k = 0; k <= i; ++k) {
                const double fine = sqrt(x.fine[i][i] * x.fine[k][k]);
                const double coarse = sqrt(x.coarse[i][i] * x.coarse[k][k]);
                assert_sum(x.fine[i][k], 5.0 * fine, got->fine_scatter[jcal_sym_at(i, k)]);
                assert_sum(x.coarse[i][k], 5.0 * coarse, got->scatter[jcal_sym_at(i, k)]);
            }
        }
        assert_sum(x.fine_second, 5.0 * x.fine_second, got->fine_second);
        assert_sum(x.second, 5.0 * x.second, got->second);
        assert_sum(x.information, x.information, got->information);
        assert_sum(x.information, x.information, got->information_all);
        assert_sum(x.information2, x.information2, got->information2);
        assert_sum(times_s[SAMPLES - 1], times_s[SAMPLES - 1], got->time_s);
    }
}

static double across_of(const jcal_vec3_t w, unsigned sensor, double *along)
{
    const dpoint_t p = dpoint(&point);
    double v[3];
    dset(w, v);
    *along = ((v[0] - p.b[sensor][0]) * p.j[sensor][0]) + ((v[1] - p.b[sensor][1]) * p.j[sensor][1]) +
             ((v[2] - p.b[sensor][2]) * p.j[sensor][2]);
    return dacross2(v, p.b[sensor], p.j[sensor]);
}

static void sums_of_the_fit_equal_those_in_double(void)
{
    double error2 = 0.0, rate2 = 0.0, difference2 = 0.0, noise = 0.0, weight = 0.0, acc = 0.0, acc2 = 0.0;
    add_all(SAMPLES);
    for (uint32_t k = 0; k < SAMPLES; ++k) {
        const jcal_hinge_sample_t *const s = &samples[k];
        const double dt = (double)s->dt_s;
        double along1;
        double along2;
        const double across1 = across_of(s->w1, 0, &along1);
        const double across2 = across_of(s->w2, 1, &along2);
        const double error = sqrt(across1) - sqrt(across2);
        const double difference = sqrt((double)s->w1_2) - sqrt((double)s->w2_2);
        const double w = (double)s->gyr_weight * ((along1 * along1) + (along2 * along2));
        error2 += dt * error * error;
        rate2 += dt * (across1 + across2) / 2.0;
        difference2 += dt * difference * difference;
        noise += w * error * error;
        weight += w;
        acc += (double)s->acc_weight;
        acc2 += (double)s->acc_weight * (double)s->acc_weight / dt;
    }
    assert_sum(times_s[SAMPLES - 1], times_s[SAMPLES - 1], evidence.fit_time_s);
    assert_sum(error2, error2, evidence.across_error2);
    assert_sum(rate2, rate2, evidence.across_rate2);
    assert_sum(difference2, difference2, evidence.difference2);
    assert_sum(noise, noise, evidence.noise_sum);
    assert_sum(weight, weight, evidence.noise_weight);
    assert_sum(acc, acc, evidence.pair_acc);
    assert_sum(acc2, acc2, evidence.pair_acc2);
}

static void excitation_is_the_difference_of_the_rates_beyond_what_errors_make(void)
{
    double sum = 0.0;
    add_all(SAMPLES);
    for (uint32_t k = 0; k < SAMPLES; ++k) {
        const double n1 = sqrt((double)samples[k].w1_2);
        const double n2 = sqrt((double)samples[k].w2_2);
        const double excess = fmax(fabs(n1 - n2) - ((0.03 * fmax(n1, n2)) + 0.02), 0.0); /* 3 % and 0.02 rad/s */
        sum += (double)samples[k].dt_s * excess * excess;
    }
    assert_sum(sum, sum, evidence.excitation);
}

/* j . (w x w') + (w . j) |w x j|^2 of docs/METHOD.md section 4 with w in the middle and w' the difference quotient. */
static double turn_of(jcal_vec3_t before, jcal_vec3_t now, unsigned sensor, double base)
{
    const dpoint_t p = dpoint(&point);
    const jcal_vec3_t middle = jcal_vec3_scale(jcal_vec3_add(before, now), 0.5f);
    const jcal_vec3_t quotient = jcal_vec3_scale(jcal_vec3_sub(now, before), (float)(1.0 / base));
    double product[3];
    double along;
    dset(jcal_vec3_cross(middle, quotient), product);
    const double across2 = across_of(middle, sensor, &along);
    return ddot(product, p.j[sensor]) + (along * across2);
}

static void turns_about_the_axis_equal_those_in_double(void)
{
    double same = 0.0, other = 0.0, time = 0.0, base = 1.0;
    uint32_t before = 0;
    add_all(SAMPLES);
    for (uint32_t k = 0; k < SAMPLES; ++k) {
        base += (double)samples[k].dt_s;
        if (base < 0.019) {
            continue;
        }
        if (base < 0.1) {
            const double t1 = turn_of(samples[before].w1, samples[k].w1, 0, base);
            const double t2 = turn_of(samples[before].w2, samples[k].w2, 1, base);
            const double rate2 = (0.5 * (double)(samples[k].w1_2 + samples[k].w2_2)) + 0.1;
            const double weight = 1.0 / ((t1 * t1) + (t2 * t2) + (0.03 * rate2 * rate2 * rate2));
            same += base / 0.05 * weight * (t1 - t2) * (t1 - t2);
            other += base / 0.05 * weight * (t1 + t2) * (t1 + t2);
            time += base * weight * ((t1 * t1) + (t2 * t2));
        }
        before = k;
        base = 0.0;
    }
    /* Rates are multiplied by 1 / 0.02 s: their rounding counts fifty times. */
    TEST_ASSERT_TRUE(fabs((double)evidence.turn_same - same) < 1e-3 * same);
    TEST_ASSERT_TRUE(fabs((double)evidence.turn_other - other) < 1e-3 * other);
    TEST_ASSERT_TRUE(fabs((double)evidence.turn_time_s - time) < 1e-3 * time);
}

static void the_turn_of_exact_motion_tells_the_pairing(void)
{
    motion_t motion = motion_lively(8);
    motion.rate_hz = 200.0;
    motion.gyr_noise_rad_s = 0.0;
    point = (jcal_hinge_point_t){0};
    jcal_hinge_axis_set(&point.axis1, motion_axis(&motion, 0));
    jcal_hinge_axis_set(&point.axis2, motion_axis(&motion, 1));
    for (uint32_t k = 0; k < 2000; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        const jcal_hinge_sample_t s = sample_of(&pair, 0.005f, k);
        jcal_hinge_evidence_add(&evidence, &point, 0.0f, UNIT_RAD_S, &s);
    }
    /* What is left is the error of the difference quotient over 20 ms. */
    TEST_ASSERT_TRUE(evidence.turn_same < 0.01f * evidence.turn_other);
    TEST_ASSERT_TRUE(evidence.turn_time_s > 2.0f);
}

static void rates_across_a_hole_make_no_turn(void)
{
    evidence.before_s = 0.0f;
    samples[0].dt_s = 0.11f; /* longer than a difference quotient may span */
    add_all(1);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, evidence.turn_time_s);
    samples[1].dt_s = 0.05f;
    jcal_hinge_evidence_add(&evidence, &point, 0.0f, UNIT_RAD_S, &samples[1]);
    TEST_ASSERT_TRUE(evidence.turn_time_s > 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(scatter_of_the_gradient_equals_sums_over_blocks_in_double);
    RUN_TEST(sums_of_the_fit_equal_those_in_double);
    RUN_TEST(excitation_is_the_difference_of_the_rates_beyond_what_errors_make);
    RUN_TEST(turns_about_the_axis_equal_those_in_double);
    RUN_TEST(the_turn_of_exact_motion_tells_the_pairing);
    RUN_TEST(rates_across_a_hole_make_no_turn);
    return UNITY_END();
}
