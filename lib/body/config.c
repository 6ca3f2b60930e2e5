/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of a body, and what a table must be. See body_config.h.
#include "jointcal/body_config.h"

#include "jointcal/body.h"
#include "jointcal/pairing_config.h"

#include <stddef.h>

jcal_body_config_t jcal_body_config_default(void)
{
    const jcal_pairing_config_t pairing = jcal_pairing_config_default();
    const jcal_body_config_t config = {
        .period_s = pairing.period_s,
        .gap_s = pairing.gap_s,
        .wait_s = 0.32f,
        .examine_s = 30.0f,
    };
    return config;
}

const char *jcal_body_config_check(const jcal_body_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const jcal_pairing_config_t pairing = {.period_s = config->period_s, .gap_s = config->gap_s};
    const char *const wrong = jcal_pairing_config_check(&pairing);
    if (wrong != NULL) {
        return wrong;
    }
    if (!((config->wait_s >= 0.05f) && (config->wait_s <= 2.0f))) {
        return "wait_s";
    }
    if (!((config->examine_s >= 5.0f) && (config->examine_s <= 600.0f))) {
        return "examine_s";
    }
    return NULL;
}

static const char *check_counts(const jcal_body_table_t *table)
{
    if ((table->sensor_count < 2u) || (table->sensor_count > JCAL_BODY_SENSORS_MAX)) {
        return "sensor_count";
    }
    if ((table->joint_count < 1u) || (table->joint_count > JCAL_BODY_JOINTS_MAX)) {
        return "joint_count";
    }
    if (table->sensors == NULL) {
        return "sensors";
    }
    if (table->sensor_states == NULL) {
        return "sensor_states";
    }
    if (table->joints == NULL) {
        return "joints";
    }
    return (table->joint_states == NULL) ? "joint_states" : NULL;
}

/// True if the joint's estimator is there and its settings are valid: those of zeros are not.
static bool has_engine(const jcal_body_joint_spec_t *joint)
{
    switch (joint->kind) {
    case JCAL_BODY_HINGE:
        return (joint->engine.hinge != NULL) && (jcal_functional_config_check(&joint->engine.hinge->cfg) == NULL);
    case JCAL_BODY_BALL:
        return (joint->engine.ball != NULL) && (jcal_ball_config_check(&joint->engine.ball->cfg) == NULL);
    case JCAL_BODY_TWO_AXES:
    case JCAL_BODY_KIND_COUNT:
    default:
        return (joint->engine.two_axes != NULL) && (jcal_two_axes_config_check(&joint->engine.two_axes->cfg) == NULL);
    }
}

/// `parents` (sensor_count): joint that each sensor is distal to; this one is put in.
static const char *check_joint(const jcal_body_table_t *table, unsigned j, uint8_t *parents)
{
    const jcal_body_joint_spec_t *const joint = &table->joints[j];
    if ((joint->proximal >= table->sensor_count) || (joint->distal >= table->sensor_count)) {
        return "no_such_sensor";
    }
    if (joint->proximal == joint->distal) {
        return "same_sensor";
    }
    if (parents[joint->distal] != JCAL_BODY_NONE) {
        return "distal_twice";
    }
    if ((unsigned)joint->kind >= (unsigned)JCAL_BODY_KIND_COUNT) {
        return "no_such_kind";
    }
    if (!has_engine(joint)) {
        return "engine";
    }
    parents[joint->distal] = (uint8_t)j;
    return NULL;
}

/// True if the way up from a sensor does not end: there are no more sensors than steps.
static bool goes_round(const jcal_body_table_t *table, const uint8_t *parents, unsigned sensor)
{
    unsigned at = sensor;
    for (unsigned k = 0u; k < table->sensor_count; ++k) {
        if (parents[at] == JCAL_BODY_NONE) {
            return false;
        }
        at = table->joints[parents[at]].proximal;
    }
    return true;
}

static const char *check_parts(const jcal_body_table_t *table, unsigned *at)
{
    uint8_t parents[JCAL_BODY_SENSORS_MAX];
    for (*at = 0u; *at < table->sensor_count; ++*at) {
        parents[*at] = JCAL_BODY_NONE;
        const jcal_body_sensor_spec_t *const sensor = &table->sensors[*at];
        if ((sensor->storage == NULL) || (jcal_packet_config_check(sensor->packets) != NULL)) {
            return "packets";
        }
    }
    for (*at = 0u; *at < table->joint_count; ++*at) {
        const char *const wrong = check_joint(table, *at, parents);
        if (wrong != NULL) {
            return wrong;
        }
    }
    for (*at = 0u; *at < table->joint_count; ++*at) {
        if (goes_round(table, parents, table->joints[*at].distal)) {
            return "circle";
        }
    }
    *at = 0u;
    return NULL;
}

const char *jcal_body_table_check(const jcal_body_table_t *table, unsigned *at)
{
    unsigned where = 0u;
    const char *wrong = (table == NULL) ? "table" : check_counts(table);
    if (wrong == NULL) {
        wrong = check_parts(table, &where);
    }
    if (at != NULL) {
        *at = where;
    }
    return wrong;
}
