/* SPDX-License-Identifier: MIT */
/// @file
/// A person's hip and knee: readings to three sensors, their ticks to both joints, and whose slice is next.
#include "imu/follow.h"
#include "jointcal/ball.h"
#include "jointcal/leg.h"
#include "leg/places.h"
#include "math/clear.h"

#include <stddef.h>

typedef char jcal_leg_fits_its_budget[(sizeof(jcal_leg_t) <= 5120u) ? 1 : -1];

jcal_status_t jcal_leg_init(jcal_leg_t *self, const jcal_leg_config_t *config, const jcal_gate_config_t *limits)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_leg_config_t cfg = *config; /* the caller may hand over self->cfg, and self->limits */
    const jcal_gate_config_t gate = (limits != NULL) ? *limits : jcal_gate_config_default();
    if ((jcal_leg_config_check(&cfg) != NULL) || (jcal_gate_config_check(&gate) != NULL)) {
        return JCAL_ERR_CONFIG;
    }
    jcal_ball_config_t ball = jcal_ball_config_default();
    ball.max_heading_rad = cfg.max_heading_rad;
    ball.max_lever_m = cfg.max_lever_m;
    jcal_clear(self, sizeof *self);
    self->cfg = cfg;
    self->limits = gate;
    jcal_status_t status = JCAL_OK;
    for (unsigned i = 0u; i < 2u; ++i) {
        jcal_gate_init(&self->gate[i]);
        status = (status == JCAL_OK) ? jcal_ball_init(&self->joint[i], &ball) : status;
    }
    for (unsigned i = 0u; i < 3u; ++i) {
        status = (status == JCAL_OK) ? jcal_sensor_init(&self->sensor[i]) : status;
    }
    return status;
}

/// False for null and for what init has never prepared: all zero, say.
static bool is_prepared(const jcal_leg_t *self)
{
    return (self != NULL) && (self->cfg.max_lever_m > 0.0f);
}

jcal_status_t jcal_leg_reset(jcal_leg_t *self)
{
    return is_prepared(self) ? jcal_leg_init(self, &self->cfg, &self->limits) : JCAL_ERR_ARG;
}

/// What both gates say: the first cause of either counts. `follow`: all three sensors may take the reading.
static jcal_reject_t check(jcal_leg_t *self, const jcal_triple_t *triple, bool *follow)
{
    const jcal_pair_t upper = {triple->t_us, triple->imu1, triple->imu2};
    const jcal_pair_t lower = {triple->t_us, triple->imu2, triple->imu3};
    const jcal_reject_t hip = jcal_gate_check(&self->gate[0], &self->limits, &upper);
    const jcal_reject_t knee = jcal_gate_check(&self->gate[1], &self->limits, &lower);
    *follow = jcal_follow_may(hip) && jcal_follow_may(knee) && jcal_sensor_may_take(&triple->imu1) &&
              jcal_sensor_may_take(&triple->imu2) && jcal_sensor_may_take(&triple->imu3);
    return (hip < knee) ? hip : knee;
}

/// New ticks of all three sensors to both joints.
static void add_ticks(jcal_leg_t *self)
{
    const jcal_tick_t *const thigh = jcal_sensor_tick(&self->sensor[1]);
    (void)jcal_ball_add(&self->joint[0], jcal_sensor_tick(&self->sensor[0]), thigh);
    (void)jcal_ball_add(&self->joint[1], thigh, jcal_sensor_tick(&self->sensor[2]));
    jcal_ball_result_t joints[2];
    jcal_leg_places_t places;
    jcal_leg_places_now(self, joints, &places);
    for (unsigned i = 0u; i < JCAL_CHAIN_PLACES; ++i) {
        self->was_known[i] = places.known[i];
    }
}

jcal_status_t jcal_leg_push(jcal_leg_t *self, const jcal_triple_t *triple)
{
    if (!is_prepared(self) || (triple == NULL)) {
        return JCAL_ERR_ARG;
    }
    bool follow;
    const jcal_reject_t cause = check(self, triple, &follow);
    self->samples += 1u;
    if (cause != JCAL_REJECT_NONE) {
        self->rejected_by[cause] += 1u;
    }
    if (!follow) {
        return JCAL_REJECTED;
    }
    const jcal_imu_t *const readings[3] = {&triple->imu1, &triple->imu2, &triple->imu3};
    unsigned ticks = 0u;
    for (unsigned i = 0u; i < 3u; ++i) {
        const jcal_reading_t reading = {triple->t_us, *readings[i]};
        ticks += (jcal_sensor_push(&self->sensor[i], &reading) == JCAL_TICK) ? 1u : 0u;
    }
    if (ticks == 3u) {
        add_ticks(self);
    }
    self->last_us = triple->t_us;
    return (cause == JCAL_REJECT_NONE) ? JCAL_OK : JCAL_REJECTED;
}

jcal_status_t jcal_leg_step(jcal_leg_t *self)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    const unsigned first = self->turn;
    self->turn = (uint8_t)(1u - first);
    const jcal_status_t status = jcal_ball_step(&self->joint[first]);
    return (status == JCAL_IDLE) ? jcal_ball_step(&self->joint[1u - first]) : status;
}

jcal_status_t jcal_leg_update(jcal_leg_t *self, const jcal_triple_t *triple)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    const uint64_t before_us = self->last_us;
    const jcal_status_t status = jcal_leg_push(self, triple);
    if ((status < JCAL_OK) || (self->last_us == before_us)) {
        return status; /* nothing was followed: nothing is paid for */
    }
    const unsigned slices = 2u * jcal_follow_slices(self->joint[0].cfg.slices_per_s, self->last_us - before_us);
    for (unsigned k = 0u; (k < slices) && (jcal_leg_step(self) == JCAL_OK); ++k) {
    }
    return status;
}
