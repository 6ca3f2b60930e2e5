/* SPDX-License-Identifier: MIT */
/// @file
/// A remembered hinge that is fed with the ticks of a made-up one. Tests of remember/.
#ifndef JCAL_TEST_REMEMBER_FIXTURE_H
#define JCAL_TEST_REMEMBER_FIXTURE_H

#include "jointcal/remember.h"
#include "unit/functional/motion.h"

#include <unity.h>

#define TICK_US 50000u

typedef struct {
    jcal_remember_t self;
    hinge_t hinge;
    uint32_t next;
    uint32_t epoch;
    bool exchanged;
    double until_s;  ///< Time at which run_until_decided stopped.
} run_t;

/* What an estimator would have kept of this hinge, exactly. */
static inline jcal_kept_t kept_of(const hinge_t *hinge)
{
    jcal_kept_t kept;
    memset(&kept, 0, sizeof kept);
    kept.kind = JCAL_KEPT_HINGE;
    kept.model = JCAL_MODEL_FUNCTIONAL;
    kept.heading = JCAL_KEPT_HEADING_BY_CENTER;
    kept.serial1 = 1u;
    kept.serial2 = 2u;
    kept.axis1 = hinge_axis(hinge, 1, 0.0);
    kept.axis2 = hinge_axis(hinge, 2, 0.0);
    kept.bound1_rad = 0.1f;
    kept.bound2_rad = 0.12f;
    kept.has_levers = true;
    kept.lever1_m = to_vec3(hinge->r1);
    kept.lever2_m = to_vec3(hinge->r2);
    kept.bound_lever1_m = JCAL_BOUND_UNKNOWN_M;
    kept.bound_lever2_m = JCAL_BOUND_UNKNOWN_M;
    return kept;
}

static inline void run_begin(run_t *run, const hinge_t *hinge, const jcal_kept_t *kept)
{
    memset(run, 0, sizeof *run);
    run->hinge = *hinge;
    run->epoch = 1u;
    run->next = 64u; /* sensors have run for more than 3 s */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_init(&run->self, kept, JCAL_KEPT_FITS));
}

static inline jcal_remember_result_t run_result(const run_t *run)
{
    jcal_remember_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_remember_get(&run->self, &out));
    return out;
}

#define CACHED 128u

/* To the bit; it is made of nothing but doubles. */
static inline bool is_same_hinge(const hinge_t *a, const hinge_t *b)
{
    uint64_t words[2][sizeof(hinge_t) / sizeof(uint64_t)];
    memcpy(words[0], a, sizeof words[0]);
    memcpy(words[1], b, sizeof words[1]);
    uint64_t differs = 0u;
    for (size_t i = 0u; i < sizeof words[0] / sizeof words[0][0]; ++i) {
        differs |= words[0][i] ^ words[1][i];
    }
    return differs == 0u;
}

/* A tick of the hinge; the last hinge's are kept, because emulated processors take long to make them. */
static inline jcal_tick_t tick_of(const hinge_t *hinge, uint32_t number, int which)
{
    static hinge_t of;
    static jcal_tick_t made[CACHED][2];
    static bool is_made[CACHED][2];
    if (!is_same_hinge(&of, hinge)) {
        of = *hinge;
        memset(is_made, 0, sizeof is_made);
    }
    const double t = 0.05 * number;
    const uint64_t t_us = (uint64_t)number * TICK_US;
    if (number >= CACHED) {
        return hinge_tick(hinge, t, which, t_us);
    }
    if (!is_made[number][which - 1]) {
        made[number][which - 1] = hinge_tick(hinge, t, which, t_us);
        is_made[number][which - 1] = true;
    }
    return made[number][which - 1];
}

static inline jcal_status_t run_tick(run_t *run)
{
    jcal_tick_t tick1 = tick_of(&run->hinge, run->next, run->exchanged ? 2 : 1);
    jcal_tick_t tick2 = tick_of(&run->hinge, run->next, run->exchanged ? 1 : 2);
    tick1.epoch = run->epoch;
    tick2.epoch = run->epoch;
    const jcal_status_t status = jcal_remember_add(&run->self, &tick1, &tick2);
    for (int k = 0; k < 3; ++k) {
        (void)jcal_remember_step(&run->self);
    }
    ++run->next;
    return status;
}

/* Runs until something is decided, for at most so many seconds. */
static inline jcal_remember_result_t run_until_decided(run_t *run, double most_s)
{
    const uint32_t begin = run->next;
    while ((run->next - begin) < (uint32_t)(20.0 * most_s) && run_result(run).state == JCAL_REMEMBERED) {
        (void)run_tick(run);
    }
    run->until_s = 0.05 * (run->next - begin);
    return run_result(run);
}

/* The axis turned about the x axis of its sensor's frame, or about y if it is nearly that. */
static inline jcal_vec3_t turned_off(jcal_vec3_t axis, double angle_deg)
{
    double turn[9];
    double v[3] = {axis.x, axis.y, axis.z};
    const double u[3] = {(fabs(v[0]) < 0.7) ? 1.0 : 0.0, (fabs(v[0]) < 0.7) ? 0.0 : 1.0, 0.0};
    double across[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double norm = sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
    for (int i = 0; i < 3; ++i) {
        across[i] *= angle_deg * HINGE_DEG / norm;
    }
    mat_turn(across, turn);
    mat_times(turn, v, v);
    return to_vec3(v);
}

#endif /* JCAL_TEST_REMEMBER_FIXTURE_H */
