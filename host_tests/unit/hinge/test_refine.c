/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/hinge/refine.h: every sum of a block against double precision, what moves and what is given up
/// with the axes, and that the axes get where they should.
#include "hinge/refine.h"
#include "jointcal/hinge.h"
#include "unit/hinge/motion.h"
#include "unit/hinge/refine_double.h"

#include <stddef.h>

#define RATE_HZ 100.0

/* Sums of some tens of float terms: their error beside the sum of magnitudes. */
static const double SUM_TOL = 1e-5;

enum { PHASE = UNKNOWNS };

static const double nowhere[UNKNOWNS]; /* no unknown moved */
static jcal_hinge_t engine;
static dblock_t block;
static dslopes_t slopes;

void setUp(void)
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
}

void tearDown(void)
{
}

static void assert_near(double expected, float actual, double tolerance)
{
    TEST_ASSERT_TRUE(fabs((double)actual - expected) <= tolerance);
}

static motion_t motion_for(uint32_t mounting, double noise_rad_s)
{
    motion_t motion = motion_lively(mounting);
    motion.rate_hz = RATE_HZ;
    motion.gyr_noise_rad_s = noise_rad_s;
    motion.acc_noise_m_s2 = (noise_rad_s > 0.0) ? 0.05 : 0.0;
    return motion;
}

static jcal_hinge_sample_t sample_of(const motion_t *motion, uint32_t k)
{
    const jcal_pair_t pair = motion_sample(motion, k);
    jcal_hinge_sample_t s = {0};
    s.w1 = pair.imu1.gyr_rad_s;
    s.w2 = pair.imu2.gyr_rad_s;
    s.a1 = pair.imu1.acc_m_s2;
    s.a2 = pair.imu2.acc_m_s2;
    s.w1_2 = jcal_vec3_dot(s.w1, s.w1);
    s.w2_2 = jcal_vec3_dot(s.w2, s.w2);
    s.dt_s = (float)(1.0 / motion->rate_hz);
    s.acc_weight = 0.02f;
    return s;
}

static jcal_vec3_t beside(jcal_vec3_t j, jcal_vec3_t towards, float degrees)
{
    const jcal_vec3_t across = jcal_vec3_normalise(jcal_vec3_cross(j, towards));
    const float rad = degrees * JCAL_RAD_PER_DEG;
    return jcal_vec3_add(jcal_vec3_scale(j, cosf(rad)), jcal_vec3_scale(across, sinf(rad)));
}

/* Both axes this far beside the truth, in directions of no meaning; the minimum of the moments is there too. */
static void start_beside(const motion_t *motion, float degrees1, float degrees2)
{
    engine.coarse.has_point = true;
    jcal_hinge_point_set(&engine.coarse.point, beside(motion_axis(motion, 0), jcal_vec3(0.6f, -0.48f, 0.64f), degrees1),
                         beside(motion_axis(motion, 1), jcal_vec3(-0.8f, 0.36f, 0.48f), degrees2));
    jcal_hinge_refine_restart(&engine.refine, &engine.coarse.point);
}

static void feed(const motion_t *motion, uint32_t begin, uint32_t end)
{
    for (uint32_t k = begin; k < end; ++k) {
        const jcal_hinge_sample_t s = sample_of(motion, k);
        (void)jcal_hinge_refine_add(&engine.refine, &engine.cfg, &engine.coarse, &s);
    }
}

/* NaN in the sums of the specific forces: then there is no step, and the sums stay as the block left them. */
static void hold_still(void)
{
    engine.coarse.moments.acc[0] = NAN;
}

static void set_phase(double complex phase)
{
    engine.refine.phase.re = (float)creal(phase);
    engine.refine.phase.im = (float)cimag(phase);
}

enum { BLOCK_SAMPLES = 20 };

/* One block of 0.2 s from sample `first` on, with axes and biases `beside` the truth (1: half a degree and a third of a
   standard deviation), its phase off by `off_rad` from the best one. */
static void add_one_block(const motion_t *motion, uint32_t first, float size, double off_rad)
{
    const float biases[4] = {0.3f * size, -0.2f * size, 0.1f * size, 0.4f * size};
    start_beside(motion, 0.5f * size, 0.4f * size);
    memcpy(engine.refine.bias, biases, sizeof biases);
    hold_still();
    dblock_begin(&block, &engine);
    for (uint32_t k = first; k < (first + BLOCK_SAMPLES); ++k) {
        const jcal_hinge_sample_t s = sample_of(motion, k);
        dblock_add(&block, &s);
    }
    set_phase(dbest_phase(&block, nowhere) * dturn(off_rad));
    engine.refine.phase_weight = 1.0f; /* known: so the block is not the short one that finds it */
    feed(motion, first, first + BLOCK_SAMPLES);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, engine.refine.blocks);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, engine.refine.block.time_s);
}

/* An assumed noise so small that the floor below the power of the rates is 1e-6 of that. */
static void assume_little_noise(void)
{
    engine.cfg.gyr_noise_rad_s = 1e-3f;
}

/* Half the gradient of the cost of the block, each time with its best phase. */
static double half_gradient(int i)
{
    double x[UNKNOWNS] = {0.0};
    x[i] = DIFFERENCE;
    const double above = dcost(&block, x, false);
    x[i] = -DIFFERENCE;
    return (above - dcost(&block, x, false)) / (4.0 * DIFFERENCE);
}

static void a_block_adds_half_the_gradient_of_the_cost_with_the_best_phase(void)
{
    for (uint32_t seed = 0; seed < 6; ++seed) {
        const motion_t motion = motion_for(seed, 0.02);
        setUp();
        assume_little_noise();
        add_one_block(&motion, 40u + (90u * seed), 1.0f, 0.0);
        dslopes(&block, dbest_phase(&block, nowhere), &slopes);
        for (int i = 0; i < UNKNOWNS; ++i) {
            /* A residual is the difference of two rates, one of them turned 20 times: 1e-6 of these, in float. */
            const double size =
                (SUM_TOL * dlength(slopes.r, block.count)) + (1e-6 * dlength(slopes.by[PHASE], block.count));
            assert_near(half_gradient(i), engine.refine.gradient[i], size * dlength(slopes.by[i], block.count));
        }
    }
}

/* A phase off by e moves a gradient by e H_ip, H_ip = sum dr/dp dr/dx_i; eliminated, what remains is of the order of e
   times the residuals and of e^2. */
static void a_phase_a_little_off_is_made_up_for(void)
{
    const double off_rad = 0.01;
    int would_show = 0;
    for (uint32_t seed = 0; seed < 6; ++seed) {
        const motion_t motion = motion_for(seed, 0.005);
        setUp();
        assume_little_noise();
        add_one_block(&motion, 40u + (90u * seed), 0.3f, off_rad);
        dslopes(&block, dbest_phase(&block, nowhere), &slopes);
        for (int i = 0; i < UNKNOWNS; ++i) {
            const double slope = dlength(slopes.by[i], block.count);
            const double second = slope * ((off_rad * dlength(slopes.r, block.count)) +
                                           (off_rad * off_rad * dlength(slopes.by[PHASE], block.count)));
            const double first = off_rad * fabs(dinner(slopes.by[PHASE], slopes.by[i], block.count));
            /* Two such terms: in the gradient itself and in what is taken off for the phase. */
            assert_near(half_gradient(i), engine.refine.gradient[i], 2.0 * second);
            would_show += (first > 4.0 * second) ? 1 : 0;
        }
    }
    TEST_ASSERT_TRUE(would_show > 10);
}

static void a_block_adds_the_gauss_newton_matrix_of_the_residual_with_the_best_phase(void)
{
    static dslopes_t fixed;
    for (uint32_t seed = 0; seed < 6; ++seed) {
        /* At the truth and without noise: where residuals are not zero the two differ by their square. */
        const motion_t motion = motion_for(seed, 0.0);
        setUp();
        assume_little_noise();
        add_one_block(&motion, 40u + (90u * seed), 0.0f, 0.0);
        dslopes(&block, 0.0, &slopes);
        dslopes(&block, dbest_phase(&block, nowhere), &fixed);
        for (int i = 0; i < UNKNOWNS; ++i) {
            for (int k = 0; k <= i; ++k) {
                const double expected = dinner(slopes.by[i], slopes.by[k], block.count);
                const double size = dlength(fixed.by[i], block.count) * dlength(fixed.by[k], block.count);
                assert_near(expected, engine.refine.matrix[jcal_sym_at((size_t)i, (size_t)k)], SUM_TOL * size);
            }
        }
    }
}

static void counts_of_a_block_are_what_they_say(void)
{
    const motion_t motion = motion_for(3, 0.02);
    add_one_block(&motion, 100, 1.0f, 0.0);
    const jcal_hinge_refine_t *const got = &engine.refine;
    double along[2] = {0.0, 0.0};
    double joint = 0.0;
    double across = 0.0;
    for (int k = 0; k < block.count; ++k) {
        const double weight = dweight(&block, k);
        double l[2];
        for (int s = 0; s < 2; ++s) {
            l[s] = ddot(block.w[k][s], block.j[s]);
            along[s] += weight * l[s] * l[s];
        }
        joint += weight * (l[1] - l[0]) * (l[1] - l[0]);
    }
    dseen_t seen;
    dlook(&block, nowhere, false, &seen);
    across = 0.5 * dpower(&block, &seen);
    for (int s = 0; s < 2; ++s) {
        assert_near(along[s], got->along[s], SUM_TOL * along[s]);
    }
    assert_near(joint, got->joint, SUM_TOL * joint);
    assert_near(across, got->across, SUM_TOL * across);
    assert_near(0.2, got->time_s, 0.2 * SUM_TOL);
    const double trace = (double)(got->matrix[jcal_sym_at(0, 0)] + got->matrix[jcal_sym_at(1, 1)] +
                                  got->matrix[jcal_sym_at(2, 2)] + got->matrix[jcal_sym_at(3, 3)]);
    assert_near(trace, got->information, SUM_TOL * trace);
    assert_near(trace * trace, got->information2, 2.0 * SUM_TOL * trace * trace);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.0f, jcal_hinge_refine_blocks(got));
    for (unsigned s = 0; s < 2u; ++s) {
        const size_t u = 2u * s;
        const double told = (double)(got->matrix[jcal_sym_at(u, u)] + got->matrix[jcal_sym_at(u + 1u, u + 1u)]);
        assert_near(told, got->told[s], SUM_TOL * told);
        assert_near(told * told, got->told2[s], 2.0 * SUM_TOL * told * told);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.0f, jcal_hinge_refine_blocks_of(got, s));
    }
    /* Cost of 2 units: in units of the noise of both directions. */
    assert_near((double)got->cost / 8.0, jcal_hinge_refine_noise(got), 1e-6 * (double)got->cost);
}

static void what_a_scale_and_a_lag_explain_is_what_the_lengths_say(void)
{
    const motion_t motion = motion_for(3, 0.02);
    add_one_block(&motion, 100, 1.0f, 0.0);
    const jcal_hinge_refine_t *const got = &engine.refine;
    dseen_t seen;
    dlook(&block, nowhere, false, &seen);
    const double across = 0.5 * dpower(&block, &seen);
    double scale = 0.0;
    double lag = 0.0;
    double change = 0.0;
    for (int k = 0; k < block.count; ++k) {
        const double weight = dweight(&block, k);
        const double z1 = cabs(seen.z[0][k]);
        const double z2 = cabs(seen.z[1][k]);
        scale += 0.5 * weight * ((z1 * z1) - (z2 * z2));
        if (k > 0) { /* nothing goes before the first sample */
            const double b1 = cabs(seen.z[0][k - 1]);
            const double b2 = cabs(seen.z[1][k - 1]);
            const double rate = (z2 - b2) / block.dt_s[k];
            lag += weight * 0.5 * ((z1 + b1) - (z2 + b2)) * rate;
            change += weight * rate * rate;
        }
    }
    assert_near(scale, got->alike.scale, SUM_TOL * 2.0 * across); /* each of two sums to SUM_TOL */
    assert_near(lag, got->alike.lag, SUM_TOL * sqrt(across * change));
    assert_near(change, got->alike.change, SUM_TOL * change);
}

static void costs_of_both_pairings_are_those_of_axis_2_as_it_is_and_turned_round(void)
{
    int told_apart = 0;
    for (uint32_t seed = 0; seed < 6; ++seed) {
        const motion_t motion = motion_for(seed, 0.01);
        setUp();
        add_one_block(&motion, 40u + (90u * seed), 0.3f, 0.0);
        dseen_t seen;
        dlook(&block, nowhere, false, &seen);
        const double power = dpower(&block, &seen);
        const double same = dcost(&block, nowhere, false);
        const double other = dcost(&block, nowhere, true);
        /* The cost is the difference of sums of the size of the power. */
        assert_near(same, engine.refine.cost, SUM_TOL * power);
        const double noise = fmax(same / 8.0, 0.01);
        const double share = 0.2 / (power + (8.0 * noise * 4.0));
        assert_near(share * same, engine.refine.same, SUM_TOL * 0.2);
        assert_near(share * other, engine.refine.other, SUM_TOL * 0.2);
        assert_near(share * power, engine.refine.sign_time_s, SUM_TOL * 0.2);
        told_apart += (other > 3.0 * same) ? 1 : 0;
    }
    TEST_ASSERT_TRUE(told_apart >= 3); /* not where the joint hardly moves for the 0.2 s */
}

/* What the sums should be, block by block: scores in double, at the axes, biases and phase that the engine had then. */
typedef struct {
    double matrix[64];
    double gradient[8];
    double unmoved[8];   /* the same without the steps */
    double score[64][4]; /* of each block: tilts less what the biases explain */
    double trace[64];
    double information;
    int count;
} ledger_t;

static ledger_t ledger;

static void less_biases(const double in[8], double gain[4][4], double out[4])
{
    for (int i = 0; i < 4; ++i) {
        out[i] = in[i];
        for (int k = 0; k < 4; ++k) {
            out[i] -= gain[i][k] * in[4 + k];
        }
    }
}

/* Gain of the ledger's own matrix with the prior of the biases, each diagonal element 2e-5 of itself larger. */
static void gain_of(double prior, double gain[4][4])
{
    double m[64];
    double g[8] = {0.0};
    for (int i = 0; i < 64; ++i) {
        m[i] = ledger.matrix[i];
    }
    for (int i = 0; i < 4; ++i) {
        double *const diagonal = &m[(9 * (4 + i))];
        *diagonal = (*diagonal + prior) * (1.0 + 2e-5);
    }
    /* H_tb H_bb^-1: eliminating the biases from unit vectors put in as gradients leaves minus its columns. */
    for (int k = 0; k < 4; ++k) {
        double copy[64];
        memcpy(copy, m, sizeof copy);
        memset(g, 0, sizeof g);
        g[4 + k] = 1.0;
        for (int p = 4; p < 8; ++p) {
            deliminate(copy, g, 8, p);
            for (int i = 0; i < 8; ++i) { /* done with p: nothing left of it */
                copy[(8 * i) + p] = 0.0;
                copy[(8 * p) + i] = 0.0;
            }
            copy[9 * p] = 1.0;
        }
        for (int i = 0; i < 4; ++i) {
            gain[i][k] = -g[i];
        }
    }
}

/* How far axes and biases have moved from where the block looks at them. */
static void moved_by(double d[8])
{
    const jcal_hinge_refine_t *const now = &engine.refine;
    for (int s = 0; s < 2; ++s) {
        double j[3];
        dset((s == 0) ? now->point.axis1.j : now->point.axis2.j, j);
        const double along = ddot(j, block.j[s]);
        d[2 * s] = ddot(j, block.u[s]) / along;
        d[(2 * s) + 1] = ddot(j, block.v[s]) / along;
    }
    for (int i = 0; i < 4; ++i) {
        d[4 + i] = (double)now->bias[i] - block.bias[i];
    }
}

/* The block has been closed: enters it and the step that followed it. */
static void enter_block(double complex phase, const jcal_hinge_refine_t *before)
{
    double matrix[64];
    double score[8];
    double acc[4];
    double gain[4][4];
    dsums(&block, phase, matrix, score);
    dacc_score(&block, (double)engine.coarse.acc_constant_m_s2, acc);
    const int n = ledger.count++;
    ledger.trace[n] = matrix[0] + matrix[9] + matrix[18] + matrix[27];
    ledger.information += ledger.trace[n];
    for (int i = 0; i < 64; ++i) {
        ledger.matrix[i] += matrix[i];
    }
    for (int i = 0; i < 8; ++i) {
        ledger.gradient[i] += score[i];
        ledger.unmoved[i] += score[i];
        score[i] += (i < 4) ? acc[i] : 0.0;
    }
    for (int i = 0; i < 16; ++i) {
        gain[i / 4][i % 4] = (double)before->gain[i / 4][i % 4];
    }
    less_biases(score, gain, ledger.score[n]);
    /* The step. */
    double d[8];
    double shift[8] = {0.0};
    double tilts[4];
    moved_by(d);
    for (int i = 0; i < 64; ++i) {
        shift[i / 8] += ledger.matrix[i] * d[i % 8];
    }
    gain_of(2.0 * (double)jcal_hinge_refine_noise(&engine.refine), gain);
    less_biases(shift, gain, tilts);
    for (int i = 0; i < 8; ++i) {
        ledger.gradient[i] += shift[i];
    }
    for (int k = 0; k < ledger.count; ++k) {
        for (int i = 0; i < 4; ++i) {
            ledger.score[k][i] += (ledger.trace[k] / ledger.information) * tilts[i];
        }
    }
}

/* Feeds samples and keeps the ledger; true phases from the start, so that no block is spent on finding them. */
static void feed_with_ledger(const motion_t *motion, uint32_t begin, uint32_t end)
{
    jcal_hinge_refine_t before = engine.refine;
    double complex phase = 0.0;
    for (uint32_t k = begin; k < end; ++k) {
        const jcal_hinge_sample_t s = sample_of(motion, k);
        if (engine.refine.block.time_s == 0.0f) {
            before = engine.refine;
            dblock_begin(&block, &engine);
        }
        dblock_add(&block, &s);
        if (block.count == 1) {
            /* Carried over from the last sample, by the trapezoidal rule too. */
            const double along = ddot(block.w[0][0], block.j[0]) - ddot(block.w[0][1], block.j[1]);
            const double last = (double)(before.last1.along - before.last2.along);
            const double turn = before.has_last ? (0.5 * block.dt_s[0] * (along + last)) : 0.0;
            phase = ((double)before.phase.re + dimaginary((double)before.phase.im)) * dturn(turn);
        }
        (void)jcal_hinge_refine_add(&engine.refine, &engine.cfg, &engine.coarse, &s);
        if (engine.refine.block.time_s == 0.0f) {
            enter_block(phase, &before);
        }
    }
}

static void begin_ledger(const motion_t *motion, uint32_t first)
{
    memset(&ledger, 0, sizeof ledger);
    start_beside(motion, 0.8f, 0.7f);
    engine.coarse.acc_constant_m_s2 = 0.2f;
    dblock_begin(&block, &engine);
    for (uint32_t k = first; k < (first + BLOCK_SAMPLES); ++k) {
        const jcal_hinge_sample_t s = sample_of(motion, k);
        dblock_add(&block, &s);
    }
    set_phase(dbest_phase(&block, nowhere));
}

static void assert_ledger(void)
{
    const jcal_hinge_refine_t *const got = &engine.refine;
    /* None was given up, so that the ledger holds what the engine holds. */
    TEST_ASSERT_EQUAL_FLOAT((float)ledger.count, got->blocks);
    for (size_t i = 0; i < 8; ++i) {
        double rounding = 0.0;
        for (size_t k = 0; k < 8; ++k) {
            const double expected = ledger.matrix[(8u * i) + k];
            const double size = sqrt(ledger.matrix[9u * i] * ledger.matrix[9u * k]);
            assert_near(expected, got->matrix[jcal_sym_at(i, k)], SUM_TOL * size);
            rounding += 2e-7 * fabs(expected);
        }
        /* Axes are known to 1e-7 rad and biases likewise, here and there, residuals to 1e-6 of the rates. */
        rounding += 1e-6 * sqrt(ledger.matrix[9u * i] * (double)got->across);
        assert_near(ledger.gradient[i], got->gradient[i], rounding);
        TEST_ASSERT_TRUE((i >= 4u) ||
                         (fabs(ledger.unmoved[i] - ledger.gradient[i]) > 10.0 * rounding)); /* steps matter */
    }
    double information2 = 0.0;
    double lean[4] = {0.0};
    double scatter[4][4] = {{0.0}};
    for (int n = 0; n < ledger.count; ++n) {
        information2 += ledger.trace[n] * ledger.trace[n];
        for (int i = 0; i < 16; ++i) {
            lean[i / 4] += ((i % 4) == 0) ? (ledger.trace[n] * ledger.score[n][i / 4]) : 0.0;
            scatter[i / 4][i % 4] += ledger.score[n][i / 4] * ledger.score[n][i % 4];
        }
    }
    assert_near(ledger.information, got->information, SUM_TOL * ledger.information);
    assert_near(information2, got->information2, SUM_TOL * information2);
    for (size_t i = 0; i < 4; ++i) {
        /* A score moves by thousands of times what it is in the end: 1e-7 of that, ten and more times over. */
        assert_near(lean[i], got->lean[i], 10.0 * SUM_TOL * sqrt(information2 * scatter[i][i]));
        for (size_t k = 0; k <= i; ++k) {
            assert_near(scatter[i][k], got->scatter[jcal_sym_at(i, k)],
                        10.0 * SUM_TOL * sqrt(scatter[i][i] * scatter[k][k]));
        }
    }
}

static void sums_over_blocks_move_along_with_the_axes(void)
{
    for (uint32_t seed = 0; seed < 4; ++seed) {
        const motion_t motion = motion_for(seed, 0.02);
        setUp();
        begin_ledger(&motion, 50);
        feed_with_ledger(&motion, 50, 400);
        TEST_ASSERT_TRUE(ledger.count > 12);
        assert_ledger();
    }
}

static void a_step_leads_to_where_sums_pull_and_prior_balance(void)
{
    const motion_t motion = motion_for(2, 0.02);
    begin_ledger(&motion, 50);
    jcal_hinge_point_set(&engine.coarse.point, beside(engine.coarse.point.axis1.j, jcal_vec3(1.0f, 0.0f, 0.0f), 1.0f),
                         beside(engine.coarse.point.axis2.j, jcal_vec3(0.0f, 1.0f, 0.0f), 1.0f));
    for (uint32_t k = 50; k < 450; ++k) { /* specific forces pull too */
        const jcal_hinge_sample_t s = sample_of(&motion, k);
        dsample_t d = {{{0.0}}, {{0.0}}, 0.0, 0.02};
        dset(s.a1, d.a[0]);
        dset(s.a2, d.a[1]);
        add_to_moments(&d, &engine.coarse.moments);
    }
    feed_with_ledger(&motion, 50, 330);
    jcal_hinge_lin_t acc;
    jcal_hinge_linearise_acc(&engine.coarse.moments, &engine.cfg, &engine.refine.point, &acc);
    const double noise = (double)engine.refine.cost / (2.0 * (double)engine.refine.time_s / 0.05);
    const double pull = 10.0 + (6000.0 * noise / (double)engine.refine.blocks);
    for (size_t i = 0; i < 4; ++i) {
        double axis[3];
        const jcal_hinge_axis_t *const to = (i < 2u) ? &engine.coarse.point.axis1 : &engine.coarse.point.axis2;
        const jcal_hinge_axis_t *const at = (i < 2u) ? &engine.refine.point.axis1 : &engine.refine.point.axis2;
        dset(to->j, axis);
        double tangent[3];
        dset(((i % 2u) == 0u) ? at->u : jcal_hinge_v(at), tangent);
        const double back = -pull * ddot(axis, tangent);
        const double prior = 2.0 * noise * (double)engine.refine.bias[i];
        double rounding = 0.0;
        for (size_t k = 0; k < 8; ++k) {
            rounding += 2e-7 * fabs((double)engine.refine.matrix[jcal_sym_at(i, k)]);
        }
        /* The step is known to 1e-7 rad; its damping leaves 2e-5 of the last one, which is less. */
        assert_near(-back, engine.refine.gradient[i] + acc.gradient[i], rounding);
        assert_near(-prior, engine.refine.gradient[4u + i], 1e-3 * fabs(prior));
        TEST_ASSERT_TRUE(fabs(back) > 10.0 * rounding);
    }
}

/* p exp(-i theta) of a sample: what turns z1 into z2, from the two themselves. */
static double complex true_phase(const jcal_hinge_sample_t *s, double *rate)
{
    dblock_begin(&block, &engine);
    dblock_add(&block, s);
    dseen_t seen;
    dlook(&block, nowhere, false, &seen);
    *rate = fmin(cabs(seen.z[0][0]), cabs(seen.z[1][0]));
    return dbest_phase(&block, nowhere);
}

static void the_phase_is_found_once_and_then_carried_from_block_to_block(void)
{
    const motion_t motion = motion_for(5, 0.0);
    start_beside(&motion, 0.0f, 0.0f);
    hold_still();
    jcal_hinge_sample_t s = sample_of(&motion, 0);
    double rate;
    set_phase(true_phase(&s, &rate) * dturn(2.0)); /* a start of no use */
    int compared = 0;
    for (uint32_t k = 0; k < 1500; ++k) {
        s = sample_of(&motion, k);
        (void)jcal_hinge_refine_add(&engine.refine, &engine.cfg, &engine.coarse, &s);
        if (k == 9) { /* 0.1 s: its sums are of no use, its phase is */
            TEST_ASSERT_EQUAL_FLOAT(0.0f, engine.refine.blocks);
            TEST_ASSERT_EQUAL_FLOAT(0.0f, engine.refine.matrix[0]);
        }
        const double complex truth = true_phase(&s, &rate);
        const double complex got = (double)engine.refine.phase.re + dimaginary((double)engine.refine.phase.im);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.0f, (float)cabs(got));
        if ((k >= 9u) && (rate > 0.3)) {
            /* The trapezoidal rule is off by dt^2 / 12 times the change of the rates: 1e-5 s^2 times 8 rad/s^2. */
            TEST_ASSERT_TRUE(fabs(carg(got / truth)) < 8e-5);
            ++compared;
        }
    }
    TEST_ASSERT_TRUE(compared > 1000);
}

static void a_known_phase_is_changed_by_a_block_only_as_much_as_the_block_knows(void)
{
    const motion_t motion = motion_for(3, 0.02);
    for (int n = 0; n < 3; ++n) {
        const double known[3] = {1e-3, 3e4, 1e9};
        setUp();
        add_one_block(&motion, 100, 0.3f, 0.0); /* for its samples */
        dseen_t seen;
        dlook(&block, nowhere, false, &seen);
        const double complex match = dmatch(&block, &seen);
        const double complex off = dturn(0.2);
        setUp();
        start_beside(&motion, 0.15f, 0.12f);
        hold_still();
        const float biases[4] = {0.09f, -0.06f, 0.03f, 0.12f};
        memcpy(engine.refine.bias, biases, sizeof biases);
        set_phase(off * match / cabs(match));
        engine.refine.phase_weight = (float)known[n];
        feed(&motion, 100, 100 + BLOCK_SAMPLES);
        const double complex both = known[n] + (cabs(match) * conj(off));
        const double complex expected =
            /* The analyser gives up on loops. NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage) */
            dturn(-seen.theta[BLOCK_SAMPLES - 1]) * off * (match / cabs(match)) * (both / cabs(both));
        assert_near(creal(expected), engine.refine.phase.re, SUM_TOL);
        assert_near(cimag(expected), engine.refine.phase.im, SUM_TOL);
        assert_near(0.7 * cabs(both), engine.refine.phase_weight, SUM_TOL * cabs(both));
    }
}

static void blocks_last_a_tenth_of_the_time_covered_within_limits(void)
{
    const motion_t motion = motion_for(5, 0.0);
    start_beside(&motion, 0.0f, 0.0f);
    float begun_s = 0.0f;
    bool known = false; /* the phase */
    for (uint32_t k = 0; k < 2000; ++k) {
        const float before_s = engine.refine.block.time_s;
        known = (before_s > 0.0f) ? known : (engine.refine.phase_weight > 0.0f);
        const jcal_hinge_sample_t s = sample_of(&motion, k);
        (void)jcal_hinge_refine_add(&engine.refine, &engine.cfg, &engine.coarse, &s);
        if (engine.refine.block.time_s > 0.0f) {
            continue;
        }
        /* Half a sample is what a block may be off. */
        const float length_s = before_s + s.dt_s;
        const float expected_s = !known ? 0.1f : fminf(0.6f, fmaxf(0.2f, 0.1f * begun_s));
        TEST_ASSERT_FLOAT_WITHIN((0.5f * s.dt_s) + 1e-4f, expected_s, length_s);
        begun_s = engine.refine.time_s;
    }
    TEST_ASSERT_TRUE(begun_s > 19.0f);
}

static void no_block_spans_an_interruption(void)
{
    const motion_t motion = motion_for(5, 0.02);
    start_beside(&motion, 0.5f, 0.5f);
    feed(&motion, 0, 300);
    uint32_t next = 300;
    while (engine.refine.block.time_s > 0.0f) { /* to the end of a block */
        feed(&motion, next, next + 1u);
        ++next;
    }
    jcal_hinge_t without = engine;
    feed(&motion, next, next + 8u); /* a part of a block, then a gap */
    TEST_ASSERT_TRUE(engine.refine.block.time_s > 0.05f);
    jcal_hinge_refine_interrupt(&engine.refine);
    jcal_hinge_refine_interrupt(&without.refine);
    without.refine.phase = engine.refine.phase;
    feed(&motion, 800, 900);
    const jcal_hinge_t with = engine;
    engine = without;
    feed(&motion, 800, 900);
    TEST_ASSERT_TRUE(engine.refine.blocks > without.refine.blocks);
    TEST_ASSERT_EQUAL_MEMORY(with.refine.matrix, engine.refine.matrix, sizeof engine.refine.matrix);
    TEST_ASSERT_EQUAL_MEMORY(with.refine.gradient, engine.refine.gradient, sizeof engine.refine.gradient);
    TEST_ASSERT_EQUAL_MEMORY(with.refine.scatter, engine.refine.scatter, sizeof engine.refine.scatter);
    TEST_ASSERT_EQUAL_MEMORY(&with.refine.block, &engine.refine.block, sizeof engine.refine.block);
    TEST_ASSERT_EQUAL_FLOAT(with.refine.cost, engine.refine.cost);
    TEST_ASSERT_EQUAL_FLOAT(with.refine.time_s, engine.refine.time_s);
}

static void fading_scales_every_sum_and_nothing_else(void)
{
    const motion_t motion = motion_for(5, 0.02);
    start_beside(&motion, 0.5f, 0.5f);
    feed(&motion, 0, 555);
    feed(&motion, 555, (engine.refine.block.time_s > 0.0f) ? 555 : 556); /* not just at the end of a block */
    const jcal_hinge_refine_t before = engine.refine;
    TEST_ASSERT_TRUE(before.block.time_s > 0.0f);
    jcal_hinge_refine_fade(&engine.refine, 0.25f);
    jcal_hinge_refine_t expected = before;
    float *const single[] = {&expected.information, &expected.information2, &expected.cost,     &expected.joint,
                             &expected.across,      &expected.along[0],     &expected.along[1], &expected.alike.change,
                             &expected.blocks,      &expected.time_s,       &expected.same,     &expected.other,
                             &expected.sign_time_s, &expected.told[0],      &expected.told[1],  &expected.told2[0],
                             &expected.told2[1]};
    for (size_t k = 0; k < (sizeof single / sizeof single[0]); ++k) {
        TEST_ASSERT_TRUE(*single[k] > 0.0f);
        *single[k] *= 0.25f; /* exact */
    }
    TEST_ASSERT_TRUE((expected.alike.scale != 0.0f) && (expected.alike.lag != 0.0f));
    expected.alike.scale *= 0.25f;
    expected.alike.lag *= 0.25f;
    jcal_sym_scale(expected.matrix, 8u, 0.25f);
    jcal_sym_scale(expected.scatter, 4u, 0.25f);
    for (size_t i = 0; i < 8; ++i) {
        expected.gradient[i] *= 0.25f;
        expected.lean[i / 2u] *= 0.5f; /* twice */
    }
    TEST_ASSERT_EQUAL_MEMORY(&expected, &engine.refine, offsetof(jcal_hinge_refine_t, has_last));
    /* Half the data twice are the data: ratios stay. */
    TEST_ASSERT_EQUAL_FLOAT(jcal_hinge_refine_noise(&before), jcal_hinge_refine_noise(&engine.refine));
}

/* Rounding that ends in NaN must not reach the axes: the gains of the biases and the step are refused one by one. */
static void sums_that_are_no_numbers_move_nothing(void)
{
    const motion_t motion = motion_for(5, 0.02);
    const size_t spoilt[2] = {jcal_sym_at(4, 4), jcal_sym_at(0, 0)};
    for (int i = 0; i < 2; ++i) {
        start_beside(&motion, 0.5f, 0.5f);
        feed(&motion, 0, 200);
        const jcal_hinge_point_t before = engine.refine.point;
        engine.refine.matrix[spoilt[i]] = NAN;
        feed(&motion, 200, 300);
        TEST_ASSERT_EQUAL_MEMORY(&before, &engine.refine.point, sizeof before);
    }
}

static void an_axis_goes_over_alone_only_while_the_other_one_is_where_it_was(void)
{
    const motion_t motion = motion_for(5, 0.02);
    for (int moved = 0; moved < 2; ++moved) {
        start_beside(&motion, 0.0f, 0.0f);
        feed(&motion, 0, 200);
        engine.refine.matrix[jcal_sym_at(2, 2)] = 0.0f; /* nothing known of axis 2 */
        engine.refine.matrix[jcal_sym_at(3, 3)] = 0.0f;
        jcal_hinge_point_t to = engine.refine.point;
        const jcal_vec3_t towards = jcal_vec3(0.36f, 0.48f, 0.8f);
        jcal_hinge_point_set(&to, beside(to.axis1.j, towards, (moved == 1) ? 20.0f : 0.0f),
                             beside(to.axis2.j, towards, 40.0f));
        jcal_hinge_refine_go(&engine.refine, &to);
        TEST_ASSERT_TRUE(jcal_sphere_angle(to.axis1.j, engine.refine.point.axis1.j) < 1e-3f);
        TEST_ASSERT_TRUE(jcal_sphere_angle(to.axis2.j, engine.refine.point.axis2.j) < 1e-3f);
        TEST_ASSERT_TRUE((engine.refine.blocks > 0.0f) == (moved == 0)); /* else it begins anew */
    }
}

static float error_of(const motion_t *motion, int sensor)
{
    const jcal_hinge_axis_t *const axis = (sensor == 0) ? &engine.refine.point.axis1 : &engine.refine.point.axis2;
    return jcal_sphere_line_angle(axis->j, motion_axis(motion, sensor));
}

static void exact_motion_leads_from_two_degrees_off_to_the_truth(void)
{
    for (uint32_t seed = 0; seed < 10; ++seed) {
        motion_t motion = motion_for(seed, 0.0);
        motion.rate_hz = (seed < 5) ? 100.0 : 50.0;
        setUp();
        start_beside(&motion, 2.0f, 2.0f);
        feed(&motion, 0, 3000);
        TEST_ASSERT_TRUE(error_of(&motion, 0) < 0.05f * JCAL_RAD_PER_DEG);
        TEST_ASSERT_TRUE(error_of(&motion, 1) < 0.05f * JCAL_RAD_PER_DEG);
    }
}

static void a_bias_of_the_gyroscopes_is_found(void)
{
    for (uint32_t seed = 0; seed < 6; ++seed) {
        const motion_t motion = motion_for(seed, 0.0);
        setUp();
        start_beside(&motion, 1.0f, 1.0f);
        const jcal_vec3_t b1 = jcal_vec3_scale(engine.coarse.point.axis1.u, 0.01f);
        const jcal_vec3_t b2 = jcal_vec3_scale(jcal_hinge_v(&engine.coarse.point.axis2), -0.01f);
        for (uint32_t k = 0; k < 2000; ++k) {
            jcal_hinge_sample_t s = sample_of(&motion, k);
            s.w1 = jcal_vec3_add(s.w1, b1);
            s.w2 = jcal_vec3_add(s.w2, b2);
            (void)jcal_hinge_refine_add(&engine.refine, &engine.cfg, &engine.coarse, &s);
        }
        const float unit = engine.cfg.gyr_bias_rad_s;
        const jcal_hinge_point_t *const p = &engine.refine.point;
        const float met[4] = {jcal_vec3_dot(b1, p->axis1.u), jcal_vec3_dot(b1, jcal_hinge_v(&p->axis1)),
                              jcal_vec3_dot(b2, p->axis2.u), jcal_vec3_dot(b2, jcal_hinge_v(&p->axis2))};
        for (int i = 0; i < 4; ++i) {
            /* The prior, two readings of the least noise beside 400, holds back some percent where little turns. */
            TEST_ASSERT_FLOAT_WITHIN(3e-4f, met[i], unit * engine.refine.bias[i]);
        }
    }
}

/* Both segments turn about the joint axis and about nothing else. */
static jcal_hinge_sample_t planar_sample(const motion_t *motion, uint32_t k)
{
    jcal_hinge_sample_t s = sample_of(motion, k);
    const jcal_vec3_t j1 = motion_axis(motion, 0);
    const jcal_vec3_t j2 = motion_axis(motion, 1);
    s.w1 = jcal_vec3_scale(j1, jcal_vec3_dot(j1, s.w1));
    s.w2 = jcal_vec3_scale(j2, jcal_vec3_dot(j2, s.w2));
    s.w1_2 = jcal_vec3_dot(s.w1, s.w1);
    s.w2_2 = jcal_vec3_dot(s.w2, s.w2);
    return s;
}

static void planar_motion_shows_the_axes_to_first_order(void)
{
    for (uint32_t seed = 0; seed < 10; ++seed) {
        motion_t motion = motion_for(seed, 0.0);
        setUp();
        start_beside(&motion, 3.0f, 3.0f);
        for (uint32_t k = 0; k < 2000; ++k) {
            const jcal_hinge_sample_t s = planar_sample(&motion, k);
            (void)jcal_hinge_refine_add(&engine.refine, &engine.cfg, &engine.coarse, &s);
        }
        TEST_ASSERT_TRUE(error_of(&motion, 0) < 0.5f * JCAL_RAD_PER_DEG);
        TEST_ASSERT_TRUE(error_of(&motion, 1) < 0.5f * JCAL_RAD_PER_DEG);
    }
}

static void noisy_planar_motion_shows_the_axes_too(void)
{
    for (uint32_t seed = 0; seed < 6; ++seed) {
        const motion_t motion = motion_for(seed, 0.0);
        setUp();
        start_beside(&motion, 3.0f, 3.0f);
        jcal_rng_t rng = {seed + 1u};
        for (uint32_t k = 0; k < 3000; ++k) {
            jcal_hinge_sample_t s = planar_sample(&motion, k);
            s.w1 = jcal_vec3_add(s.w1, jcal_vec3_scale(jcal_rng_unit(&rng), 0.01f));
            s.w2 = jcal_vec3_add(s.w2, jcal_vec3_scale(jcal_rng_unit(&rng), 0.01f));
            (void)jcal_hinge_refine_add(&engine.refine, &engine.cfg, &engine.coarse, &s);
        }
        /* 0.01 / sqrt(3) rad/s beside 1 rad/s and more along, 3000 samples: some hundredths of a degree. */
        TEST_ASSERT_TRUE(error_of(&motion, 0) < 0.1f * JCAL_RAD_PER_DEG);
        TEST_ASSERT_TRUE(error_of(&motion, 1) < 0.1f * JCAL_RAD_PER_DEG);
    }
}

static void axes_far_from_those_of_the_moments_begin_anew_there(void)
{
    const motion_t motion = motion_for(4, 0.0);
    start_beside(&motion, 0.0f, 0.0f);
    feed(&motion, 0, 500);
    const jcal_hinge_t kept = engine;
    for (int axis = 0; axis < 2; ++axis) {
        const float degrees[2] = {10.0f, 14.0f}; /* up to 11.5 deg it is the same minimum */
        for (int n = 0; n < 2; ++n) {
            engine = kept;
            jcal_hinge_axis_t *const to = (axis == 0) ? &engine.coarse.point.axis1 : &engine.coarse.point.axis2;
            jcal_hinge_axis_set(to, beside(to->j, jcal_vec3(0.0f, 0.6f, 0.8f), degrees[n]));
            uint32_t k = 500;
            do { /* to the end of the next block */
                feed(&motion, k, k + 1u);
                ++k;
            } while ((engine.refine.block.time_s > 0.0f) && (k < 600));
            if (n == 0) {
                TEST_ASSERT_EQUAL_FLOAT(kept.refine.blocks + 1.0f, engine.refine.blocks);
                TEST_ASSERT_TRUE(error_of(&motion, axis) < 0.2f * JCAL_RAD_PER_DEG);
            } else {
                jcal_hinge_refine_t anew;
                jcal_hinge_refine_restart(&anew, &engine.coarse.point);
                TEST_ASSERT_EQUAL_MEMORY(&anew, &engine.refine, offsetof(jcal_hinge_refine_t, has_last));
                TEST_ASSERT_FALSE(engine.refine.has_last);
            }
        }
    }
}

/* What an axis' sums know of the other unknowns once the axis itself is eliminated, in double. */
static void without_axis(int axis, double matrix[64], double gradient[8])
{
    deliminate(matrix, gradient, 8, 2 * axis);
    deliminate(matrix, gradient, 8, (2 * axis) + 1);
}

/* One comparison, step by step. NOLINTNEXTLINE(readability-function-size) */
static void a_jump_gives_up_what_the_sums_know_of_that_axis_and_keeps_the_other(void)
{
    for (int axis = 0; axis < 2; ++axis) {
        const motion_t motion = motion_for(1, 0.0);
        setUp();
        /* 5 deg off, and much is known of it: the step there, 0.087 rad, is a jump beyond 0.06. */
        start_beside(&motion, (axis == 0) ? 5.0f : 0.0f, (axis == 0) ? 0.0f : 5.0f);
        hold_still();
        uint32_t next = 0;
        while ((next < 2000) || (engine.refine.block.time_s > 0.0f)) {
            feed(&motion, next, next + 1u);
            ++next;
        }
        engine.coarse.moments.acc[0] = 0.0f;
        jcal_hinge_point_set(&engine.coarse.point, motion_axis(&motion, 0), motion_axis(&motion, 1));
        const jcal_hinge_refine_t before = engine.refine;
        TEST_ASSERT_TRUE(before.blocks > 30.0f);
        dblock_begin(&block, &engine);
        for (uint32_t k = next; k < (next + 60u); ++k) { /* blocks of 0.6 s by now */
            const jcal_hinge_sample_t s = sample_of(&motion, k);
            dblock_add(&block, &s);
        }
        const double turn = ddot(block.w[0][0], block.j[0]) - ddot(block.w[0][1], block.j[1]) +
                            (double)(before.last1.along - before.last2.along);
        const double complex phase =
            ((double)before.phase.re + dimaginary((double)before.phase.im)) * dturn(0.5 * block.dt_s[0] * turn);
        feed(&motion, next, next + 60u);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, engine.refine.block.time_s);
        double matrix[64];
        double gradient[8];
        double size[8];
        double d[8];
        dsums(&block, phase, matrix, gradient);
        moved_by(d);
        TEST_ASSERT_TRUE(hypot(d[2 * axis], d[(2 * axis) + 1]) > 0.06);
        for (int i = 0; i < 64; ++i) {
            matrix[i] += (double)before.matrix[jcal_sym_at((size_t)i / 8u, (size_t)i % 8u)];
            gradient[i / 8] += ((i % 8) == 0) ? (double)before.gradient[i / 8] : 0.0;
        }
        for (int i = 0; i < 64; ++i) {
            gradient[i / 8] += matrix[i] * d[i % 8];
        }
        for (int i = 0; i < 8; ++i) {
            size[i] = matrix[9 * i];
        }
        without_axis(axis, matrix, gradient);
        const jcal_hinge_refine_t *const got = &engine.refine;
        TEST_ASSERT_EQUAL_FLOAT(0.0f, got->blocks);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, got->information);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, got->cost);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, got->along[axis]);
        TEST_ASSERT_TRUE(got->along[1 - axis] > 0.0f);
        for (size_t i = 0; i < 8; ++i) {
            for (size_t k = 0; k <= i; ++k) {
                /* The elimination loses some digits of what is small beside what it was. */
                assert_near(matrix[(8u * i) + k], got->matrix[jcal_sym_at(i, k)], SUM_TOL * sqrt(size[i] * size[k]));
            }
            assert_near(gradient[i], got->gradient[i], SUM_TOL * 0.1 * sqrt(size[i] * size[2 * axis]));
        }
        feed(&motion, next + 60u, next + 3000u);
        /* And it arrives: as near as exact motion leads in half a minute, see above. */
        TEST_ASSERT_TRUE(error_of(&motion, axis) < 0.05f * JCAL_RAD_PER_DEG);
    }
}

/* One comparison, step by step. NOLINTNEXTLINE(readability-function-size) */
static void an_axis_far_from_where_its_sums_began_keeps_half_of_them(void)
{
    const motion_t motion = motion_for(2, 0.02);
    for (int axis = 0; axis < 2; ++axis) {
        setUp();
        start_beside(&motion, 0.5f, 0.5f);
        feed(&motion, 0, 300);
        jcal_hinge_t far = engine;
        jcal_hinge_note_t *const anchor = &far.refine.anchor[axis];
        *anchor = jcal_hinge_note(
            beside(jcal_hinge_noted(*anchor), jcal_vec3(0.6f, 0.0f, 0.8f), 4.0f)); /* limit: 0.05 rad, 2.9 deg */
        const float blocks = engine.refine.blocks;
        uint32_t k = 300;
        while (engine.refine.blocks == blocks) { /* to the end of the block */
            feed(&motion, k, k + 1u);
            ++k;
        }
        const jcal_hinge_refine_t near = engine.refine;
        engine = far;
        feed(&motion, 300, k);
        far = engine;
        TEST_ASSERT_EQUAL_FLOAT(0.5f * near.blocks, far.refine.blocks);
        TEST_ASSERT_EQUAL_FLOAT(0.5f * near.cost, far.refine.cost);
        TEST_ASSERT_EQUAL_FLOAT(0.5f * near.along[axis], far.refine.along[axis]);
        TEST_ASSERT_EQUAL_FLOAT(near.along[1 - axis], far.refine.along[1 - axis]);
        TEST_ASSERT_EQUAL_MEMORY(&near.point, &far.refine.point, sizeof near.point);
        const jcal_hinge_note_t here = jcal_hinge_note((axis == 0) ? near.point.axis1.j : near.point.axis2.j);
        TEST_ASSERT_EQUAL_MEMORY(&here, &far.refine.anchor[axis], sizeof here);
        double m[2][64];
        double g[2][8];
        for (int i = 0; i < 64; ++i) {
            m[0][i] = (double)near.matrix[jcal_sym_at((size_t)i / 8u, (size_t)i % 8u)];
            m[1][i] = (double)far.refine.matrix[jcal_sym_at((size_t)i / 8u, (size_t)i % 8u)];
        }
        for (int i = 0; i < 8; ++i) {
            g[0][i] = (double)near.gradient[i];
            g[1][i] = (double)far.refine.gradient[i];
        }
        /* Of each of its two unknowns half is kept: a quarter of the determinant. */
        const int own = 9 * 2 * axis;
        double det[2];
        double size[8];
        for (int n = 0; n < 2; ++n) {
            det[n] = (m[n][own] * m[n][own + 9]) - (m[n][own + 1] * m[n][own + 1]);
        }
        assert_near(0.25 * det[0], (float)det[1], 10.0 * SUM_TOL * m[1][own] * m[1][own + 9]);
        for (int i = 0; i < 8; ++i) {
            size[i] = sqrt(m[0][9 * i]);
        }
        /* The others lose nothing of what they know by themselves. */
        without_axis(axis, m[0], g[0]);
        without_axis(axis, m[1], g[1]);
        for (int i = 0; i < 64; ++i) {
            if (((i / 16) != axis) && (((i % 8) / 2) != axis)) {
                assert_near(m[0][i], (float)m[1][i], SUM_TOL * size[i / 8] * size[i % 8]);
                assert_near(g[0][i / 8], (float)g[1][i / 8], 1e-4 * fabs(g[0][i / 8]));
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_block_adds_half_the_gradient_of_the_cost_with_the_best_phase);
    RUN_TEST(a_phase_a_little_off_is_made_up_for);
    RUN_TEST(a_block_adds_the_gauss_newton_matrix_of_the_residual_with_the_best_phase);
    RUN_TEST(counts_of_a_block_are_what_they_say);
    RUN_TEST(what_a_scale_and_a_lag_explain_is_what_the_lengths_say);
    RUN_TEST(costs_of_both_pairings_are_those_of_axis_2_as_it_is_and_turned_round);
    RUN_TEST(sums_over_blocks_move_along_with_the_axes);
    RUN_TEST(a_step_leads_to_where_sums_pull_and_prior_balance);
    RUN_TEST(the_phase_is_found_once_and_then_carried_from_block_to_block);
    RUN_TEST(a_known_phase_is_changed_by_a_block_only_as_much_as_the_block_knows);
    RUN_TEST(blocks_last_a_tenth_of_the_time_covered_within_limits);
    RUN_TEST(no_block_spans_an_interruption);
    RUN_TEST(fading_scales_every_sum_and_nothing_else);
    RUN_TEST(sums_that_are_no_numbers_move_nothing);
    RUN_TEST(an_axis_goes_over_alone_only_while_the_other_one_is_where_it_was);
    RUN_TEST(exact_motion_leads_from_two_degrees_off_to_the_truth);
    RUN_TEST(a_bias_of_the_gyroscopes_is_found);
    RUN_TEST(planar_motion_shows_the_axes_to_first_order);
    RUN_TEST(noisy_planar_motion_shows_the_axes_too);
    RUN_TEST(axes_far_from_those_of_the_moments_begin_anew_there);
    RUN_TEST(a_jump_gives_up_what_the_sums_know_of_that_axis_and_keeps_the_other);
    RUN_TEST(an_axis_far_from_where_its_sums_began_keeps_half_of_them);
    return UNITY_END();
}
