/* SPDX-License-Identifier: MIT */
/// @file
/// What to do next, and as a sentence. See body.h.
#include "body/exchange.h"
#include "body/report.h"
#include "body/restore.h"

#include <stddef.h>

/// Text that is being written.
typedef struct {
    char *text;
    size_t size, length;
} writer_t;

/// How urgent what is said of a joint is; 0: nothing is to be done. `not_one`: it was told that it is not one joint.
static unsigned urgency(const jcal_head_t *head, bool not_one)
{
    if (head->status == JCAL_READY) {
        return 0u;
    }
    if (head->reason == JCAL_REASON_SENSOR_BAD) {
        return 3u;
    }
    return not_one ? 2u : 1u;
}

jcal_status_t jcal_body_advice(const jcal_body_t *self, jcal_body_advice_t *out)
{
    if ((self == NULL) || (out == NULL) || !self->is_ready) {
        return JCAL_ERR_ARG;
    }
    jcal_body_advice_t best = {JCAL_BODY_NONE, JCAL_BODY_NONE, JCAL_HINT_NONE, JCAL_REASON_NONE};
    unsigned most = 0u;
    for (unsigned j = 0u; j < self->table.joint_count; ++j) {
        jcal_body_joint_result_t joint;
        jcal_body_report(self, j, &joint);
        const unsigned now = urgency(&joint.head, self->table.joint_states[j].not_one);
        if (now > most) {
            const jcal_body_joint_spec_t *const spec = &self->table.joints[j];
            const bool is_first = self->table.sensor_states[spec->proximal].bad != 0u;
            most = now;
            best.joint = (uint8_t)j;
            best.hint = joint.head.hint;
            best.reason = joint.head.reason;
            best.sensor = JCAL_BODY_NONE;
            if (best.reason == JCAL_REASON_SENSOR_BAD) {
                best.sensor = is_first ? spec->proximal : spec->distal;
            } else if (now == 2u) {
                best.hint = JCAL_HINT_CHECK_SENSORS;
                best.reason = JCAL_REASON_NOT_ONE_JOINT;
            } else if (best.reason == JCAL_REASON_NOT_ONE_JOINT) {
                best.hint = JCAL_HINT_MOVE_JOINT; /* a lag that is not known yet looks the same */
            } else {
                /* as the joint says */
            }
        }
    }
    *out = best;
    return JCAL_OK;
}

static void put(writer_t *writer, const char *words)
{
    for (size_t k = 0u; (words[k] != '\0') && ((writer->length + 1u) < writer->size); ++k) {
        writer->text[writer->length] = words[k];
        ++writer->length;
    }
    writer->text[writer->length] = '\0';
}

/// A name, or "joint 3" where there is none: numbers of joints and sensors are below 100.
static void put_name(writer_t *writer, const char *name, const char *kind, unsigned number)
{
    if (name != NULL) {
        put(writer, name);
        return;
    }
    const char digits[3] = {(char)('0' + (number / 10u)), (char)('0' + (number % 10u)), '\0'};
    put(writer, kind);
    put(writer, (number < 10u) ? &digits[1] : digits);
}

/// What comes before and after the joint's name.
static void words_of(const jcal_body_advice_t *advice, const char **before, const char **after)
{
    *before = "Move the ";
    *after = ".";
    switch (advice->hint) {
    case JCAL_HINT_MOVE_JOINT:
        *before = "Bend and stretch the ";
        break;
    case JCAL_HINT_MOVE_SEGMENT1:
        *before = "Turn the segment above the ";
        break;
    case JCAL_HINT_MOVE_SEGMENT2:
        *before = "Turn the segment below the ";
        break;
    case JCAL_HINT_TILT_AXIS:
        *after = " while its axis is not level, lying on the side, say.";
        break;
    case JCAL_HINT_CHECK_SENSORS:
        *before = "Check the two sensors of the ";
        *after = ": is each on its segment, and the right way in its strap?";
        break;
    case JCAL_HINT_MORE_DIRECTIONS:
        *after = " in other directions too.";
        break;
    case JCAL_HINT_MOVE_FASTER:
        *after = " faster, walking, say.";
        break;
    case JCAL_HINT_BEND_ONLY:
        *before = "Bend and stretch the ";
        *after = " for ten seconds, without turning the segment below it.";
        break;
    case JCAL_HINT_TURN_ONLY:
        *before = "Turn the segment below the ";
        *after = " about its own line for ten seconds, without bending.";
        break;
    case JCAL_HINT_NONE:
    default:
        break;
    }
}

/* The text is written to, through the writer. */
jcal_status_t jcal_body_sentence(const jcal_body_t *self, const jcal_body_advice_t *advice,
                                 char *text, /* NOLINT(readability-non-const-parameter) */
                                 size_t size)
{
    if ((self == NULL) || !self->is_ready || (advice == NULL) || (text == NULL) || (size == 0u)) {
        return JCAL_ERR_ARG;
    }
    const bool has_joint = advice->joint < self->table.joint_count;
    const bool has_sensor = advice->sensor < self->table.sensor_count;
    if ((!has_joint && (advice->joint != JCAL_BODY_NONE)) || (!has_sensor && (advice->sensor != JCAL_BODY_NONE))) {
        return JCAL_ERR_ARG;
    }
    writer_t writer = {text, size, 0u};
    if (has_sensor) {
        put(&writer, "Check the sensor on the ");
        put_name(&writer, self->table.sensors[advice->sensor].name, "segment of sensor ", advice->sensor);
        put(&writer, ": it is faulty or set up wrongly.");
    } else if (has_joint && (advice->reason == JCAL_REASON_NOT_ONE_JOINT) &&
               jcal_body_exchange_explains(self, advice->joint)) {
        put(&writer, "Exchange the sensors of the ");
        put_name(&writer, self->table.sensors[self->exchange.sensor1].name, "sensor ", self->exchange.sensor1);
        put(&writer, " and the ");
        put_name(&writer, self->table.sensors[self->exchange.sensor2].name, "sensor ", self->exchange.sensor2);
        put(&writer, ": each seems to sit on the other's segment.");
    } else if (has_joint) {
        const char *before;
        const char *after;
        words_of(advice, &before, &after);
        if ((advice->hint != JCAL_HINT_CHECK_SENSORS) && jcal_body_restore_waits(self, advice->joint)) {
            before = "Bend the ";
            after = ": its calibration of before is being checked.";
        }
        put(&writer, before);
        put_name(&writer, self->table.joints[advice->joint].name, "joint ", advice->joint);
        put(&writer, after);
    } else {
        put(&writer, "Nothing is to be done.");
    }
    return JCAL_OK;
}
