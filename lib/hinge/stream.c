/* SPDX-License-Identifier: MIT */
/// @file
/// Stream engine of the hinge: samples into sums, and the schedule of the work. Method: docs/METHOD.md.
#include "jointcal/hinge.h"

#include "hinge/judge.h"
#include "hinge/model.h"
#include "hinge/point.h"
#include "hinge/refine.h"
#include "hinge/search.h"
#include "hinge/slip.h"
#include "hinge/smooth.h"
#include "hinge/stream.h"
#include "hinge/weigh.h"
#include "joint/sign.h"
#include "joint/watch.h"
#include "jointcal/vec3.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/solve.h"
#include "math/sym.h"
#include "sample/clock.h"
#include "sample/ring.h"

#include <math.h>
#include <stddef.h>

#define MICROSECONDS 1e-6f

/// A sample stands for the time since the one before it, but never for more than this, s: 10 samples a second, with 5 % for clocks.
#define STEP_MAX_S JCAL_CLOCK_SLOW_S

/// Rest after which the refined axes leave it out, s.
#define REST_MAX_S 1.0f

/// Growth of the usual residual of the rates with them, squared: scale and misalignment of the gyroscopes.
#define RATE_SHARE2 4e-4f
/// Share of the accelerometers' assumed variance that changes within a second; the rest, biases say, is there all the time.
#define WATCH_ACC_SHARE 0.3f

/// Before the first `ready` the sums are given up when they have contradicted every hinge for so long, s of motion.
#define DOUBT_S 4.0f

/// Axes may be off by this, rad, beyond their bounds before a sensor is said to have moved.
#define SLIP_RAD 0.06f

/// Sums are halved when they reach this: half an hour at 1 rad/s, four minutes at 3 rad/s, rad^2/s. One more sample then changes a
/// sum by 2^-17 of itself, a hundred times what float32 resolves.
#define MOTION_MAX 3600.0f
#define ACC_WEIGHT_MAX 2e4f

/// Slices of work are paid for with time, so that the work per second does not depend on the rate: with four times as much once the
/// calibration is ready and changes slowly.
#define PRICE_READY 4.0f
#define SLICES_MAX 10u
/// A judgement, and a block of the refined axes that closes, cost more than other slices. Where slices are few, a block costs this
/// much time or that of its step, so that blocks leave some to the other slices, and there is no other work in that step.
#define JUDGE_SLICES 2.0f
#define CLOSE_SLICES 3.0f
#define CLOSE_S 0.015f
#define SLICES_PER_CYCLE 8u
#define SETTLED_ROUNDS 4u

/// With the slots of the default inbox.
typedef char jcal_hinge_fits_its_budget[((sizeof(jcal_hinge_t) - sizeof(jcal_inbox_t)) <= (2048u - 232u)) ? 1 : -1];

/// Nothing is known yet, or no more.
static void say_nothing_is_known(jcal_hinge_verdict_t *verdict)
{
    verdict->agreed = 0u;
    verdict->bound1_rad = JCAL_BOUND_UNKNOWN_RAD;
    verdict->bound2_rad = JCAL_BOUND_UNKNOWN_RAD;
    verdict->status = (uint8_t)JCAL_COLLECTING;
    verdict->reason = (uint8_t)(verdict->after_doubt ? JCAL_REASON_DOES_NOT_FIT : JCAL_REASON_NO_DATA);
    verdict->hint = (uint8_t)(verdict->after_doubt ? JCAL_HINT_CHECK_SENSORS : JCAL_HINT_MOVE_JOINT);
    verdict->weak = (uint8_t)JCAL_WEAK_AXIS1;
}

/// Empties what was learnt of the joint: all that follows the inbox. Push, which may preempt this, does not touch it.
static void clear(jcal_hinge_t *self)
{
    const size_t first = offsetof(jcal_hinge_t, coarse);
    jcal_clear((unsigned char *)self + first, sizeof *self - first);
    self->coarse.damping = JCAL_GN_DAMPING_START;
    say_nothing_is_known(&self->verdict);
}

void jcal_hinge_start(jcal_hinge_t *self, const jcal_hinge_config_t *config)
{
    const jcal_hinge_config_t cfg = *config; /* the caller may hand over self->cfg */
    jcal_clear(self, sizeof *self);
    self->cfg = cfg;
    jcal_gate_init(&self->gate);
    clear(self);
}

jcal_status_t jcal_hinge_init(jcal_hinge_t *self, const jcal_hinge_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_hinge_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    jcal_hinge_start(self, config);
    return JCAL_OK;
}

jcal_status_t jcal_hinge_reset(jcal_hinge_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_hinge_init(self, &self->cfg);
}

jcal_status_t jcal_hinge_push(jcal_hinge_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    uint32_t slot;
    if (!jcal_ring_room(&self->inbox.ring, &slot)) {
        return JCAL_ERR_FULL;
    }
    if (jcal_gate_check(&self->gate, &self->cfg.gate, pair) != JCAL_REJECT_NONE) {
        return JCAL_REJECTED;
    }
    self->inbox.slots[slot] = *pair;
    jcal_ring_publish(&self->inbox.ring);
    return JCAL_OK;
}

/// Time that pays for one slice before the calibration is ready, s.
static float slice_s(const jcal_hinge_t *self)
{
    return 1.0f / self->cfg.slices_per_s;
}

/// Halves all sums: nothing saturates, and old data count less.
static void halve(jcal_hinge_t *self)
{
    jcal_sym_scale(self->coarse.moments.gyr, JCAL_HINGE_FEATURES, 0.5f);
    jcal_sym_scale(self->coarse.moments.acc, 7u, 0.5f);
    jcal_hinge_refine_fade(&self->refine, 0.5f);
    self->amount.excitation *= 0.5f;
    self->amount.motion *= 0.5f;
    self->amount.weight_acc2 *= 0.5f;
}

/// Residuals of this sample at the refined axes, (24) and (25) of [OLS20], in units of what is usual.
static void watch_fit(jcal_hinge_t *self, const jcal_hinge_sample_t *sample)
{
    const jcal_vec3_t j1 = self->refine.point.axis1.j;
    const jcal_vec3_t j2 = self->refine.point.axis2.j;
    const float rate2 = sample->w1_2 + sample->w2_2;
    const float motion_s = sample->dt_s * jcal_watch_motion(rate2);
    const float gyr = jcal_vec3_norm(jcal_vec3_cross(sample->w1, j1)) - jcal_vec3_norm(jcal_vec3_cross(sample->w2, j2));
    const float acc = jcal_vec3_dot(sample->a1, j1) - jcal_vec3_dot(sample->a2, j2) - self->coarse.acc_constant_m_s2;
    const float noise = self->cfg.gyr_noise_rad_s;
    jcal_watch_add(&self->watch, 0u, gyr * gyr / ((noise * noise) + (RATE_SHARE2 * rate2)), motion_s);
    jcal_watch_add(&self->watch, 1u, acc * acc / (WATCH_ACC_SHARE * sample->acc_variance), motion_s);
}

/// True if the last seconds contradict a calibration that was ready.
static bool has_slipped(const jcal_hinge_t *self)
{
    const float bound = jcal_max(self->verdict.bound1_rad, self->verdict.bound2_rad);
    return self->watch.on &&
           jcal_hinge_slip_alarm(&self->refine.slip, SLIP_RAD + jcal_min(bound, self->cfg.max_bound_rad));
}

/// What was learnt of the joint is void; the samples go on.
static void begin_anew(jcal_hinge_t *self)
{
    const jcal_hinge_weigh_t weigh = self->weigh;
    const uint64_t last_us = self->last_us;
    clear(self);
    self->weigh = weigh;
    self->last_us = last_us;
    self->has_last = true;
}

/// Before the first `ready`: counts how long the sums contradict every hinge, in time of motion. True if that is long enough to begin
/// anew without them: sensors that were handled before they were on the joint. What comes later must agree as long before nothing is
/// said of it any more.
static bool is_contradicted(jcal_hinge_t *self, const jcal_hinge_sample_t *sample)
{
    const float motion_s = sample->dt_s * jcal_watch_motion(sample->w1_2 + sample->w2_2);
    const float least_s = self->verdict.after_doubt ? -DOUBT_S : 0.0f;
    float *const doubt_s = &self->watch.seen_s[0]; /* free until the watch begins */
    if (self->watch.on) {
        return false;
    }
    *doubt_s = jcal_max(*doubt_s + (self->verdict.contradicted ? motion_s : -motion_s), least_s);
    self->verdict.after_doubt = self->verdict.after_doubt && (*doubt_s > -DOUBT_S);
    return *doubt_s > DOUBT_S;
}

/// Returns true if a block of the refined axes closed.
static bool sum_up(jcal_hinge_t *self, const jcal_hinge_sample_t *sample)
{
    bool closed = false;
    jcal_hinge_count(&self->amount, sample);
    float z[JCAL_HINGE_FEATURES];
    jcal_hinge_features(sample->w1, sample->w2, z);
    jcal_sym_rank1(self->coarse.moments.gyr, JCAL_HINGE_FEATURES, z, sample->gyr_weight);
    const float y[7] = {sample->a1.x, sample->a1.y, sample->a1.z, -sample->a2.x, -sample->a2.y, -sample->a2.z, 1.0f};
    jcal_sym_rank1(self->coarse.moments.acc, 7u, y, sample->acc_weight);
    if (self->weigh.rest_s >= REST_MAX_S) {
        jcal_hinge_refine_interrupt(&self->refine);
    } else if (self->coarse.has_point) {
        closed = jcal_hinge_refine_add(&self->refine, &self->cfg, &self->coarse, sample);
        watch_fit(self, sample);
    } else {
        /* nothing to refine yet */
    }
    if ((self->amount.motion > MOTION_MAX) || (self->coarse.moments.acc[jcal_sym_at(6u, 6u)] > ACC_WEIGHT_MAX)) {
        halve(self);
    }
    return closed;
}

/// Another point is the estimate of the coarse search: what was judged was the old one.
static void go_on_there(jcal_hinge_t *self)
{
    say_nothing_is_known(&self->verdict);
    jcal_hinge_refine_go(&self->refine, &self->coarse.point);
}

void jcal_hinge_look_around(jcal_hinge_t *self)
{
    const jcal_hinge_scope_t scope = {!(self->refine.blocks > 0.0f), self->amount.excitation > 0.0f, self->kept_sign};
    if (jcal_hinge_search(&self->search, &self->coarse, &self->cfg, &scope)) {
        go_on_there(self);
    }
}

void jcal_hinge_go_round(jcal_hinge_t *self)
{
    jcal_hinge_turn_round(&self->search, &self->coarse);
    go_on_there(self);
}

/// That of axis 2 is reported with the sign of axis 1; what is kept of it is what the user's hint compares.
static void keep_signs(jcal_hinge_t *self)
{
    const jcal_hinge_point_t *const point = &self->refine.point;
    jcal_sign_keep(&self->kept_sign[0], point->axis1.j, self->cfg.axis1_toward);
    jcal_sign_keep(&self->kept_sign[1], point->axis2.j, jcal_vec3(0.0f, 0.0f, 0.0f));
}

void jcal_hinge_take_stock(jcal_hinge_t *self)
{
    const jcal_hinge_evidence_t evidence = {.cfg = &self->cfg,
                                            .coarse = &self->coarse,
                                            .refine = &self->refine,
                                            .search = &self->search,
                                            .amount = &self->amount,
                                            .complaint = jcal_gate_complaint(&self->gate),
                                            .kept_sign = self->kept_sign};
    if (jcal_hinge_judge(&evidence, &self->verdict)) {
        jcal_hinge_go_round(self);
    }
    if (self->verdict.status == (uint8_t)JCAL_READY) {
        keep_signs(self);
    }
}

/// One slice of the cycle: 2 steps of the estimate, 5 slices of the global check, 1 judgement. Once the starts have
/// been tried a few times, every other cycle leaves the global check out: what is known changes slowly then.
static void work(jcal_hinge_t *self)
{
    const bool settled = self->search.rounds >= SETTLED_ROUNDS;
    const bool rests = settled && (self->slice >= SLICES_PER_CYCLE);
    switch (self->slice % SLICES_PER_CYCLE) {
    case 0u:
    case SLICES_PER_CYCLE / 2u:
        jcal_hinge_track(&self->coarse, &self->cfg, &self->refine.point);
        break;
    case SLICES_PER_CYCLE - 1u:
        jcal_hinge_take_stock(self);
        self->credit_s -= (JUDGE_SLICES - 1.0f) * slice_s(self);
        break;
    default:
        if (!rests) {
            jcal_hinge_look_around(self);
        }
        break;
    }
    self->slice = (uint8_t)((self->slice + 1u) % (2u * SLICES_PER_CYCLE));
}

void jcal_hinge_consume(jcal_hinge_t *self, const jcal_pair_t *pair)
{
    const float since_s = (float)(pair->t_us - self->last_us) * MICROSECONDS;
    const bool first = !self->has_last;
    self->last_us = pair->t_us;
    self->has_last = true;
    if (first) {
        return;
    }
    if (since_s > STEP_MAX_S) {
        jcal_hinge_refine_interrupt(&self->refine);
    }
    const float dt_s = jcal_min(since_s, STEP_MAX_S);
    const jcal_hinge_sample_t sample = jcal_hinge_weigh(&self->weigh, &self->cfg, pair, dt_s);
    const bool closed = sum_up(self, &sample);
    if (self->verdict.status == (uint8_t)JCAL_READY) {
        jcal_watch_start(&self->watch);
    }
    if (jcal_watch_alarm(&self->watch) || (closed && has_slipped(self))) {
        begin_anew(self);
        self->verdict.status = (uint8_t)JCAL_MOVED;
        return;
    }
    if (is_contradicted(self, &sample)) {
        begin_anew(self);
        self->verdict.after_doubt = true;
        say_nothing_is_known(&self->verdict);
        return;
    }
    self->credit_s -= closed ? jcal_min(CLOSE_SLICES * slice_s(self), jcal_max(CLOSE_S, dt_s)) : 0.0f;
    self->credit_s = jcal_min(self->credit_s + dt_s, (float)SLICES_MAX * slice_s(self));
    for (unsigned i = 0u; i < SLICES_MAX; ++i) {
        const float price_s = slice_s(self) * ((self->verdict.status == (uint8_t)JCAL_READY) ? PRICE_READY : 1.0f);
        if (self->credit_s < price_s) {
            break;
        }
        self->credit_s -= price_s;
        work(self);
    }
}

void jcal_hinge_take(jcal_hinge_t *self, const jcal_pair_t *pair)
{
    const float since_s = (float)(pair->t_us - self->last_us) * MICROSECONDS;
    if (!self->has_last || (since_s > STEP_MAX_S)) {
        jcal_hinge_smooth_begin(&self->smooth, pair);
    }
    const jcal_pair_t smooth = jcal_hinge_smooth(&self->smooth, pair, jcal_min(since_s, STEP_MAX_S));
    jcal_hinge_consume(self, &smooth);
}

jcal_status_t jcal_hinge_step(jcal_hinge_t *self)
{
    uint32_t slot;
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    if (!jcal_ring_peek(&self->inbox.ring, &slot)) {
        return JCAL_IDLE;
    }
    const jcal_pair_t pair = self->inbox.slots[slot];
    jcal_ring_release(&self->inbox.ring);
    jcal_hinge_take(self, &pair);
    return JCAL_OK;
}

jcal_status_t jcal_hinge_update(jcal_hinge_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    for (uint32_t left = jcal_ring_waiting(&self->inbox.ring); left > 0u; --left) {
        (void)jcal_hinge_step(self); /* pushed without a step */
    }
    const jcal_status_t pushed = jcal_hinge_push(self, pair);
    return (pushed == JCAL_OK) ? jcal_hinge_step(self) : pushed;
}
