/* SPDX-License-Identifier: MIT */
/* Lines of a body session. */
#include "output/body_report.h"

#include "jointcal/body.h"
#include "jointcal/remember.h"

#include <math.h>
#include <string.h>

/* ---- Pieces ---- */

void body_report_time(const body_report_t *self, json_t *json, uint64_t t_us)
{
    /* The hub's times before the first packet are 0. */
    const bool known = t_us > self->origin_us / 2u;
    json_time(json, "t_s", known, known ? (int64_t)(t_us - self->origin_us) + self->start_us : 0);
}

static json_t begin_line(const body_report_t *self, const char *event, uint64_t t_us)
{
    json_t json = json_begin(self->file);
    json_word(&json, "event", event);
    body_report_time(self, &json, t_us);
    return json;
}

static void end_line(json_t *json)
{
    json_end(json);
    (void)fputc('\n', json->file);
    (void)fflush(json->file);
}

static const char *name_of(const body_name_t *names, unsigned count, unsigned number)
{
    return (number < count) ? names[number] : NULL;
}

static const char *joint_name(const body_report_t *self, unsigned joint)
{
    return name_of(self->joints, self->joint_count, joint);
}

static const char *sensor_name(const body_report_t *self, unsigned sensor)
{
    return name_of(self->sensors, self->sensor_count, sensor);
}

/* A right angle is how a bound says that nothing is known. */
static void write_bound(json_t *json, const char *key, float bound_rad)
{
    json_number(json, key, (bound_rad < JCAL_BOUND_UNKNOWN_RAD) ? bound_rad : NAN);
}

static void write_vector(json_t *json, const char *key, jcal_vec3_t vector)
{
    const float values[] = {vector.x, vector.y, vector.z};
    const bool known = values[0] != 0.0f || values[1] != 0.0f || values[2] != 0.0f;
    const bool is_number = isfinite(values[0]) && isfinite(values[1]) && isfinite(values[2]);
    json_numbers(json, key, known && is_number, values, 3);
}

static void write_text(json_t *json, const char *key, const char *text)
{
    json_key(json, key);
    (void)fputc('"', json->file);
    for (const char *at = text; *at != '\0'; at++) {
        (void)fprintf(json->file, (*at == '"' || *at == '\\') ? "\\%c" : "%c", *at);
    }
    (void)fputc('"', json->file);
}

/* ---- Events ---- */

/* The library's word; the same as the reason's where they mean the same. */
static const char *event_word(unsigned kind)
{
    const char *word = jcal_body_event_string((jcal_body_event_kind_t)kind);
    return (kind == (unsigned)JCAL_BODY_NOT_ONE) ? jcal_reason_string(JCAL_REASON_NOT_ONE_JOINT) : word;
}

static void write_what(json_t *json, const char *word, const jcal_body_event_t *event)
{
    if (event->kind == (uint8_t)JCAL_BODY_LEFT_READY) {
        json_word(json, "reason", jcal_reason_string((jcal_reason_t)event->what));
    } else if (event->kind == (uint8_t)JCAL_BODY_SENSOR_BAD) {
        json_word(json, "finding", jcal_finding_string((jcal_finding_t)event->what));
        json_number(json, "fact", event->value);
    } else if (event->kind == (uint8_t)JCAL_BODY_LAG_FOUND) {
        json_number(json, "lag_s", event->value);
    } else if (strcmp(word, jcal_remember_state_string(JCAL_REMEMBER_DROPPED)) == 0) {
        json_word(json, "reason", jcal_remember_reason_string((jcal_remember_reason_t)event->what));
    }
}

void body_report_event(body_report_t *self, const jcal_body_event_t *event)
{
    const char *word = event_word(event->kind);
    json_t json = begin_line(self, (word != NULL) ? word : "unknown", event->t_us);
    if (word == NULL) {
        json_count(&json, "kind", event->kind);
    }
    if (event->joint != JCAL_BODY_NONE) {
        json_word(&json, "joint", joint_name(self, event->joint));
    }
    if (event->sensor != JCAL_BODY_NONE) {
        json_word(&json, "sensor", sensor_name(self, event->sensor));
    }
    write_what(&json, (word != NULL) ? word : "", event);
    end_line(&json);
}

/* ---- States ---- */

void body_report_body_keys(json_t *json, const message_body_state_t *state)
{
    json_count(json, "rounds", state->status.rounds);
    json_count(json, "restarts", state->status.restarts);
    json_count(json, "lags_refused", state->status.lags_refused);
    json_count(json, "events_dropped", state->status.events_dropped);
    json_count(json, "flash_writes", state->writes);
}

static void write_findings(json_t *json, unsigned bad)
{
    json_key(json, "bad");
    (void)fputc('[', json->file);
    bool first = true;
    for (unsigned k = 0; k < 16u; k++) {
        const char *word = ((bad & (1u << k)) != 0u) ? jcal_finding_string((jcal_finding_t)k) : NULL;
        if (word != NULL) {
            (void)fprintf(json->file, "%s\"%s\"", first ? "" : ", ", word);
            first = false;
        }
    }
    (void)fputc(']', json->file);
}

void body_report_sensor_keys(const body_report_t *self, json_t *json, const message_sensor_state_t *state)
{
    const jcal_body_sensor_result_t *sensor = &state->result;
    const jcal_packets_status_t *packets = &sensor->packets;
    json_word(json, "sensor", sensor_name(self, state->sensor));
    json_bool(json, "heard", sensor->is_heard);
    write_findings(json, sensor->bad);
    json_count(json, "readings", packets->readings);
    json_count(json, "lost", packets->lost);
    json_count(json, "late", packets->late);
    json_count(json, "duplicate", packets->duplicate);
    json_count(json, "odd", packets->odd);
    json_count(json, "restarts", packets->restarts);
    json_count(json, "steps", packets->steps);
    json_count(json, "overruns", packets->overruns);
    json_number(json, "period_s", packets->period_s);
    json_number(json, "drift_ppm", packets->drift_ppm);
    json_number(json, "shift_s", sensor->shift_s);
    json_count(json, "samples", sensor->samples);
    json_count(json, "missed", sensor->missed);
    json_count(json, "rejected", sensor->rejected);
    json_count(json, "late_readings", sensor->late);
}

void body_report_joint_keys(const body_report_t *self, json_t *json, const message_joint_state_t *state)
{
    const jcal_body_joint_result_t *joint = &state->result;
    json_word(json, "joint", joint_name(self, state->joint));
    json_word(json, "status", jcal_calibration_string(joint->head.status));
    json_word(json, "reason", jcal_reason_string(joint->head.reason));
    json_word(json, "hint", jcal_hint_string(joint->head.hint));
    json_word(json, "weak", jcal_weak_string(joint->head.weak));
    json_word(json, "kept", joint->has_kept ? jcal_remember_state_string(joint->kept) : NULL);
    json_word(json, "kept_reason", joint->has_kept ? jcal_remember_reason_string(joint->kept_reason) : NULL);
    json_number(json, "lag_s", joint->lag_known ? joint->lag_s : NAN);
    json_number(json, "lag_bound_s", joint->lag_known ? joint->lag_bound_s : NAN);
    write_vector(json, "axis1", joint->axis1);
    write_vector(json, "axis2", joint->axis2);
    write_bound(json, "uncertainty1_rad", joint->uncertainty1_rad);
    write_bound(json, "uncertainty2_rad", joint->uncertainty2_rad);
    write_vector(json, "joint_to_sensor1_m", joint->joint_to_sensor1_m);
    write_vector(json, "joint_to_sensor2_m", joint->joint_to_sensor2_m);
    json_number(json, "heading_rad", joint->heading.known ? joint->heading.heading_rad : NAN);
    write_bound(json, "flexion_bound_rad", joint->flexion_bound_rad);
    write_bound(json, "relative_bound_rad", joint->relative_bound_rad);
    json_bool(json, "asleep", state->asleep);
    json_count(json, "samples", joint->head.samples);
}

void body_report_body(body_report_t *self, const message_body_state_t *state)
{
    json_t json = begin_line(self, "body", state->status.t_us);
    body_report_body_keys(&json, state);
    end_line(&json);
}

void body_report_sensor(body_report_t *self, uint64_t t_us, const message_sensor_state_t *state)
{
    json_t json = begin_line(self, "sensor", t_us);
    body_report_sensor_keys(self, &json, state);
    end_line(&json);
}

void body_report_joint(body_report_t *self, uint64_t t_us, const message_joint_state_t *state)
{
    json_t json = begin_line(self, "joint", t_us);
    body_report_joint_keys(self, &json, state);
    end_line(&json);
}

void body_report_advice(body_report_t *self, uint64_t t_us, const message_advice_t *advice)
{
    json_t json = begin_line(self, "advice", t_us);
    json_word(&json, "joint", joint_name(self, advice->advice.joint));
    json_word(&json, "sensor", sensor_name(self, advice->advice.sensor));
    json_word(&json, "hint", jcal_hint_string(advice->advice.hint));
    json_word(&json, "reason", jcal_reason_string(advice->advice.reason));
    write_text(&json, "text", advice->text);
    end_line(&json);
}

/* ---- Angles ---- */

void body_report_flexions(body_report_t *self, const message_flexions_t *flexions)
{
    body_report_flush(self);
    self->has_angles = true;
    self->angles_us = flexions->t_us;
    memset(self->known, 0, sizeof self->known);
    for (unsigned k = 0; k < flexions->count; k++) {
        const unsigned joint = flexions->of[k].joint;
        if (joint < self->joint_count && self->kinds[joint] == (uint8_t)JCAL_BODY_HINGE) {
            self->known[joint] = isfinite(flexions->of[k].flexion_rad);
            self->angle_rad[joint] = flexions->of[k].flexion_rad;
            self->bound_rad[joint] = flexions->of[k].bound_rad;
        }
    }
}

void body_report_orientations(body_report_t *self, const message_orientations_t *orientations)
{
    for (unsigned k = 0; k < orientations->count && self->has_angles && self->angles_us == orientations->t_us; k++) {
        const unsigned joint = orientations->of[k].joint;
        const jcal_quat_t q = orientations->of[k].relative;
        if (joint < self->joint_count && self->kinds[joint] != (uint8_t)JCAL_BODY_HINGE) {
            self->known[joint] = isfinite(q.w) && isfinite(q.x) && isfinite(q.y) && isfinite(q.z);
            self->relative[joint] = q;
            self->bound_rad[joint] = orientations->of[k].bound_rad;
        }
    }
}

void body_report_flush(body_report_t *self)
{
    if (!self->has_angles) {
        return;
    }
    self->has_angles = false;
    json_t json = begin_line(self, "angles", self->angles_us);
    json_key(&json, "angles");
    json_t angles = json_begin(self->file);
    for (unsigned k = 0; k < self->joint_count; k++) {
        if (self->kinds[k] == (uint8_t)JCAL_BODY_HINGE) {
            json_number(&angles, self->joints[k], self->known[k] ? self->angle_rad[k] : NAN);
        } else {
            const jcal_quat_t q = self->relative[k];
            const float values[] = {q.w, q.x, q.y, q.z};
            json_numbers(&angles, self->joints[k], self->known[k], values, 4);
        }
    }
    json_end(&angles);
    json_key(&json, "bounds_rad");
    json_t bounds = json_begin(self->file);
    for (unsigned k = 0; k < self->joint_count; k++) {
        write_bound(&bounds, self->joints[k], self->known[k] ? self->bound_rad[k] : NAN);
    }
    json_end(&bounds);
    end_line(&json);
}
