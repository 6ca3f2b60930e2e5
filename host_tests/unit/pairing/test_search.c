/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of pairing/lag_search.h beside double precision: the same J from the same sums, solved to the end from more headings.
#include "pairing/lag_search.h"

#include "jointcal/lag.h"
#include "pairing/lag_sums.h"
#include "unit/pairing/warm.h"

#include <math.h>
#include <string.h>

enum {
    N = JCAL_LAG_NODES,
    SIDE = JCAL_LAG_SIDE,
    UNKNOWNS = 6,
    STARTS = 8,
    ROUNDS = 60,
    TRIALS = 4,
    TRIAL_ROUNDS = 2,
    NEAR = 7,
    NEAR_SIDE = 3
};

/* Of a share: 160 terms of float32 in a sum, and what elimination of nearly dependent levers makes of that. */
static const double NODE_TOL = 1e-4;
/* A search ends after nine rounds: what is left to go. */
static const double SHARE_TOL = 2e-4;
static const double RIDGE = 1e-3;

static jcal_lag_t lag;
static uint32_t next;

void setUp(void)
{
    next = 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_init(&lag));
}

void tearDown(void)
{
}

/* Sums at one lag in double precision. */
typedef struct {
    double own1[4][4], own2[4][4], up[4][4], re[4][4], im[4][4];
} sums_t;

/* The polynomial through the seven nearest nodes by Neville's scheme. */
static double between(const double *at_nodes, double x)
{
    double p[NEAR];
    const int first = (int)fmin(fmax(floor(x + 0.5) + SIDE - NEAR_SIDE, 0.0), N - NEAR);
    memcpy(p, &at_nodes[first], sizeof p);
    for (int level = 1; level < NEAR; ++level) {
        for (int i = 0; i + level < NEAR; ++i) {
            const double xi = first + i - SIDE;
            const double xk = first + i + level - SIDE;
            p[i] = ((xk - x) * p[i] + (x - xi) * p[i + 1]) / (xk - xi);
        }
    }
    return p[0];
}

static void sums_at(double x, sums_t *out)
{
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
            const int packed = (i > k) ? i * (i + 1) / 2 + k : k * (k + 1) / 2 + i;
            double own2[N], up[N], re[N], im[N];
            for (int n = 0; n < N; ++n) {
                const jcal_lag_node_t *const node = &lag.sums.node[n];
                own2[n] = (double)node->own2[packed];
                up[n] = (double)node->up[4 * i + k];
                re[n] = (double)node->across.re[4 * i + k];
                im[n] = (double)node->across.im[4 * i + k];
            }
            out->own1[i][k] = (double)lag.sums.own1[packed];
            out->own2[i][k] = between(own2, x);
            out->up[i][k] = between(up, x);
            out->re[i][k] = between(re, x);
            out->im[i][k] = between(im, x);
        }
    }
}

/* h r = g by elimination with pivots. */
static void solve(double h[UNKNOWNS][UNKNOWNS], double *g)
{
    for (int c = 0; c < UNKNOWNS; ++c) {
        int pivot = c;
        for (int i = c + 1; i < UNKNOWNS; ++i) {
            pivot = (fabs(h[i][c]) > fabs(h[pivot][c])) ? i : pivot;
        }
        for (int k = 0; k < UNKNOWNS; ++k) {
            const double kept = h[c][k];
            h[c][k] = h[pivot][k];
            h[pivot][k] = kept;
        }
        const double kept = g[c];
        g[c] = g[pivot];
        g[pivot] = kept;
        for (int i = 0; i < UNKNOWNS; ++i) {
            const double by = (i == c) ? 0.0 : h[i][c] / h[c][c];
            for (int k = 0; k < UNKNOWNS; ++k) {
                h[i][k] -= by * h[c][k];
            }
            g[i] -= by * g[c];
        }
    }
    for (int c = 0; c < UNKNOWNS; ++c) {
        g[c] /= h[c][c];
    }
}

/* Levers for a heading: what is to be zero is the derivative by r1 and r2. */
static void levers_of(const sums_t *s, double x[4][4], double *r)
{
    double h[UNKNOWNS][UNKNOWNS];
    double trace = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            h[i][k] = s->own1[i + 1][k + 1];
            h[i + 3][k + 3] = s->own2[i + 1][k + 1];
            h[i][k + 3] = -x[i + 1][k + 1];
            h[k + 3][i] = -x[i + 1][k + 1];
        }
        r[i] = s->own1[i + 1][0] - x[i + 1][0];
        r[i + 3] = s->own2[i + 1][0] - x[0][i + 1];
        trace += s->own1[i + 1][i + 1] + s->own2[i + 1][i + 1];
    }
    for (int i = 0; i < UNKNOWNS; ++i) {
        h[i][i] += RIDGE * trace / UNKNOWNS;
    }
    solve(h, r);
}

/* a' m b of (1, -r1) and (1, -r2). */
static double form(double m[4][4], const double *a, const double *b)
{
    double out = 0.0;
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
            out += a[i] * m[i][k] * b[k];
        }
    }
    return out;
}

/* Rounds from one heading, which they turn; returns the share that is left. */
static double share_from(sums_t *s, double *at, int rounds)
{
    double share = 1.0;
    for (int round = 0; round < rounds; ++round) {
        const double heading = *at;
        double x[4][4];
        double r[UNKNOWNS];
        for (int i = 0; i < 4; ++i) {
            for (int k = 0; k < 4; ++k) {
                x[i][k] = s->up[i][k] + cos(heading) * s->re[i][k] - sin(heading) * s->im[i][k];
            }
        }
        levers_of(s, x, r);
        const double x1[4] = {1.0, -r[0], -r[1], -r[2]};
        const double x2[4] = {1.0, -r[3], -r[4], -r[5]};
        const double own = form(s->own1, x1, x1) + form(s->own2, x2, x2);
        share = fmax(own - 2.0 * form(x, x1, x2), 0.0) / own;
        *at = -atan2(form(s->im, x1, x2), form(s->re, x1, x2));
    }
    return share;
}

/* The least share that is left at a lag, nodes, of so many headings, and some more rounds of the best of them. */
static double least_of(double x, int starts, int rounds, int more)
{
    sums_t s;
    double least = INFINITY;
    double best = 0.0;
    sums_at(x, &s);
    for (int k = 0; k < starts; ++k) {
        double heading = 6.283185307179586 * k / starts;
        const double share = share_from(&s, &heading, rounds);
        best = (share < least) ? heading : best;
        least = fmin(least, share);
    }
    return (more > 0) ? share_from(&s, &best, more) : least;
}

static double share_at(double x)
{
    return least_of(x, STARTS, ROUNDS, 0);
}

/* Ticks of an arm whose sensor 2 is late and noisy; another noise for each tick. */
static void add(const hinge_t *arm, double late_s, double noise_m_s, int ticks)
{
    for (int k = 0; k < ticks; ++k) {
        const double t = 0.05 * (double)next;
        const uint64_t t_us = (uint64_t)next * TICK_US;
        const int n = (int)next;
        const jcal_tick_t tick1 = warm_tick(arm, t, 1, t_us);
        jcal_tick_t tick2 = warm_tick(arm, t - late_s, 2, t_us);
        tick2.velocity.x += (float)(noise_m_s * any(3 * n));
        tick2.velocity.y += (float)(noise_m_s * any(3 * n + 1));
        tick2.velocity.z += (float)(noise_m_s * any(3 * n + 2));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_lag_add(&lag, &tick1, &tick2));
        ++next;
    }
}

static void search(void)
{
    (void)jcal_lag_sums_finish(&lag);
    for (unsigned k = 0u; k < JCAL_LAG_SEARCH_SLICES; ++k) {
        TEST_ASSERT_EQUAL_UINT(k, lag.search.slice);
        TEST_ASSERT_EQUAL(k + 1u == JCAL_LAG_SEARCH_SLICES, jcal_lag_search(&lag));
    }
}

/* What the search found, from all sums that there are. */
static void finding_is_that_of_double_precision(void)
{
    double shares[N];
    search();
    for (int n = 0; n < N; ++n) {
        shares[n] = least_of(n - SIDE, TRIALS, TRIAL_ROUNDS, 1);
        TEST_ASSERT_DOUBLE_WITHIN(NODE_TOL, shares[n], (double)lag.search.least[n]);
    }
    const double at = (double)lag.search.best.lag;
    const double least = share_at(at);
    TEST_ASSERT_DOUBLE_WITHIN(SHARE_TOL, least, (double)jcal_lag_share(&lag.search.best));
    double rival = 1.0;
    for (int n = 0; n < N; ++n) {
        rival = (fabs(n - SIDE - at) > 1.5) ? fmin(rival, shares[n]) : rival;
    }
    TEST_ASSERT_DOUBLE_WITHIN(NODE_TOL, rival, (double)jcal_lag_rival(&lag.search, (float)at));
    const double bend = (share_at(at - 0.25) - 2.0 * least + share_at(at + 0.25)) * 16.0;
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * bend, bend, (double)lag.search.bend);
    for (int k = -10; k <= 10; ++k) {
        TEST_ASSERT_TRUE(share_at(at + 0.1 * k) > least - 1e-5);
    }
}

static void a_search_finds_the_least(void)
{
    static const double late[] = {0.0, 0.031, -0.183, 0.225, 0.12};
    static const int arms[] = {0, 1, 2, 3, 59}; /* the last one has headings that end in different places */
    for (int k = 0; k < 5; ++k) {
        const hinge_t arm = some_arm(arms[k]);
        setUp();
        add(&arm, late[k], 0.05, 160);
        finding_is_that_of_double_precision();
        TEST_ASSERT_DOUBLE_WITHIN(0.01, late[k], 0.05 * (double)lag.search.best.lag);
    }
}

/* Also if what is left has become more since. */
static void a_search_begins_anew(void)
{
    const hinge_t arm = arm_usual();
    add(&arm, 0.03, 0.0, 60);
    finding_is_that_of_double_precision();
    const float before = jcal_lag_share(&lag.search.best);
    add(&arm, 0.03, 0.2, 100);
    finding_is_that_of_double_precision();
    TEST_ASSERT_TRUE(jcal_lag_share(&lag.search.best) > 3.0f * before);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_search_finds_the_least);
    RUN_TEST(a_search_begins_anew);
    return UNITY_END();
}
