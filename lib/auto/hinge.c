/* SPDX-License-Identifier: MIT */
/// @file
/// A hinge of either kind: both models on the same readings. See hinge_auto.h.
#include "auto/judge.h"
#include "jointcal/functional_pair.h"
#include "jointcal/hinge_auto.h"
#include "math/clear.h"
#include "sample/ring.h"

#include <stddef.h>

jcal_hinge_auto_config_t jcal_hinge_auto_config_default(void)
{
    const jcal_hinge_auto_config_t config = {jcal_hinge_config_default(),
                                             jcal_functional_config_default().max_flexion_rad};
    return config;
}

/// The functional model's part of the settings.
static jcal_functional_config_t functional_config(const jcal_hinge_auto_config_t *config)
{
    jcal_functional_config_t out = jcal_functional_config_default();
    out.max_bound_rad = config->hinge.max_bound_rad;
    out.max_flexion_rad = config->max_flexion_rad;
    out.sign_hint = config->hinge.sign_hint;
    out.axis1_toward = config->hinge.axis1_toward;
    return out;
}

const char *jcal_hinge_auto_config_check(const jcal_hinge_auto_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const char *const wrong = jcal_hinge_config_check(&config->hinge);
    if (wrong != NULL) {
        return wrong;
    }
    const jcal_functional_config_t functional = functional_config(config);
    return jcal_functional_config_check(&functional);
}

jcal_status_t jcal_hinge_auto_init(jcal_hinge_auto_t *self, const jcal_hinge_auto_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_hinge_auto_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    const jcal_functional_config_t functional = functional_config(config);
    jcal_clear(&self->inbox, sizeof self->inbox);
    self->believed = false;
    self->person = false;
    self->objection = (uint8_t)JCAL_REASON_UNCERTAIN;
    jcal_hinge_auto_begin_anew(self);
    const jcal_status_t status = jcal_hinge_init(&self->rigid, &config->hinge);
    return (status == JCAL_OK) ? jcal_functional_pair_init(&self->functional, &functional, &config->hinge.gate)
                               : status;
}

jcal_status_t jcal_hinge_auto_update(jcal_hinge_auto_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    const bool had_moved = self->rigid.verdict.status == (uint8_t)JCAL_MOVED;
    const jcal_status_t status = jcal_hinge_update(&self->rigid, pair);
    (void)jcal_functional_pair_update(&self->functional, pair);
    if ((self->rigid.verdict.status == (uint8_t)JCAL_MOVED) && !had_moved) {
        (void)jcal_functional_reset(&self->functional.joint); /* what it learnt is of the sensors as they sat before */
        jcal_hinge_auto_begin_anew(self);
    }
    jcal_hinge_auto_judge(self, pair->t_us);
    return status;
}

jcal_status_t jcal_hinge_auto_push(jcal_hinge_auto_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    uint32_t slot;
    if (!jcal_ring_room(&self->inbox.ring, &slot)) {
        return JCAL_ERR_FULL;
    }
    self->inbox.slots[slot] = *pair;
    jcal_ring_publish(&self->inbox.ring);
    return JCAL_OK;
}

jcal_status_t jcal_hinge_auto_step(jcal_hinge_auto_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    uint32_t slot;
    if (!jcal_ring_peek(&self->inbox.ring, &slot)) {
        return JCAL_IDLE;
    }
    const jcal_pair_t pair = self->inbox.slots[slot];
    jcal_ring_release(&self->inbox.ring);
    return jcal_hinge_auto_update(self, &pair);
}
