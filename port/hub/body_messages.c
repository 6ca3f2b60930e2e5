/* SPDX-License-Identifier: MIT */
/* Payloads of a body session. Each write function and its read function name the same fields in the same order. */
#include "body_messages.h"

#include "vectors.h"

#include <string.h>

/* ---- To the hub ---- */

void message_write_begin(frame_writer_t *out, const message_begin_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->nonce);
    frame_write_u64(out, in->every_us);
    frame_write_u64(out, in->angles_every_us);
    frame_write_u8(out, in->sensors);
    frame_write_u8(out, in->joints);
    frame_write_u8(out, in->flags);
}

bool message_read_begin(const frame_t *frame, message_begin_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->nonce = frame_read_u32(&in);
    out->every_us = frame_read_u64(&in);
    out->angles_every_us = frame_read_u64(&in);
    out->sensors = frame_read_u8(&in);
    out->joints = frame_read_u8(&in);
    out->flags = frame_read_u8(&in);
    return frame_read_all(&in);
}

void message_write_sensor(frame_writer_t *out, const message_sensor_t *in)
{
    frame_write_begin(out);
    frame_write_u8(out, in->number);
    frame_write_u64(out, in->serial);
    frame_write_u32(out, in->packets.period_ns);
    frame_write_u8(out, in->packets.counter_bits);
    frame_write_u8(out, in->packets.per_packet);
    frame_write_f32(out, in->packets.scale.gyr_rad_s);
    frame_write_f32(out, in->packets.scale.acc_m_s2);
    frame_write_u16(out, (uint16_t)in->packets.scale.gyr_rail);
    frame_write_u16(out, (uint16_t)in->packets.scale.acc_rail);
    frame_write_f32(out, in->packets.max_drift_ppm);
    frame_write_text(out, in->name, MESSAGE_NAME_BYTES);
}

bool message_read_sensor(const frame_t *frame, message_sensor_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->number = frame_read_u8(&in);
    out->serial = frame_read_u64(&in);
    out->packets = jcal_packet_config_default();
    out->packets.values = JCAL_PACKET_RAW;
    out->packets.period_ns = frame_read_u32(&in);
    out->packets.counter_bits = frame_read_u8(&in);
    out->packets.per_packet = frame_read_u8(&in);
    out->packets.scale.gyr_rad_s = frame_read_f32(&in);
    out->packets.scale.acc_m_s2 = frame_read_f32(&in);
    out->packets.scale.gyr_rail = (int16_t)frame_read_u16(&in);
    out->packets.scale.acc_rail = (int16_t)frame_read_u16(&in);
    out->packets.max_drift_ppm = frame_read_f32(&in);
    frame_read_text(&in, out->name, MESSAGE_NAME_BYTES);
    return frame_read_all(&in);
}

void message_write_joint(frame_writer_t *out, const message_joint_t *in)
{
    frame_write_begin(out);
    frame_write_u8(out, in->number);
    frame_write_u8(out, in->kind);
    frame_write_u8(out, in->proximal);
    frame_write_u8(out, in->distal);
    frame_write_f32(out, in->max_bound_rad);
    frame_write_text(out, in->name, MESSAGE_NAME_BYTES);
}

bool message_read_joint(const frame_t *frame, message_joint_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->number = frame_read_u8(&in);
    out->kind = frame_read_u8(&in);
    out->proximal = frame_read_u8(&in);
    out->distal = frame_read_u8(&in);
    out->max_bound_rad = frame_read_f32(&in);
    frame_read_text(&in, out->name, MESSAGE_NAME_BYTES);
    return frame_read_all(&in);
}

void message_write_packet(frame_writer_t *out, const message_packet_t *in)
{
    frame_write_begin(out);
    frame_write_u8(out, in->sensor);
    frame_write_u64(out, in->arrival_us);
    frame_write_u32(out, in->counter);
    for (unsigned k = 0; k < in->count * JCAL_PACKET_VALUES; k++) {
        frame_write_u16(out, (uint16_t)in->raw[k]);
    }
}

bool message_read_packet(const frame_t *frame, message_packet_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->sensor = frame_read_u8(&in);
    out->arrival_us = frame_read_u64(&in);
    out->counter = frame_read_u32(&in);
    const size_t count = frame_read_left(&in) / (2u * JCAL_PACKET_VALUES);
    out->count = (uint8_t)((count <= JCAL_PACKET_READINGS_MAX) ? count : 0u);
    for (unsigned k = 0; k < out->count * JCAL_PACKET_VALUES; k++) {
        out->raw[k] = (int16_t)frame_read_u16(&in);
    }
    return frame_read_all(&in) && out->count > 0;
}

void message_write_time(frame_writer_t *out, uint64_t now_us)
{
    frame_write_begin(out);
    frame_write_u64(out, now_us);
}

bool message_read_time(const frame_t *frame, uint64_t *now_us)
{
    frame_reader_t in = frame_read_begin(frame);
    *now_us = frame_read_u64(&in);
    return frame_read_all(&in);
}

void message_write_put_kept(frame_writer_t *out, const message_put_kept_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->token);
    frame_write_bytes(out, in->bytes, sizeof in->bytes);
}

bool message_read_put_kept(const frame_t *frame, message_put_kept_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->token = frame_read_u32(&in);
    frame_read_bytes(&in, out->bytes, sizeof out->bytes);
    return frame_read_all(&in);
}

void message_write_ask_kept(frame_writer_t *out, const message_ask_kept_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->token);
    frame_write_u8(out, in->joint);
}

bool message_read_ask_kept(const frame_t *frame, message_ask_kept_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->token = frame_read_u32(&in);
    out->joint = frame_read_u8(&in);
    return frame_read_all(&in);
}

void message_write_sleep(frame_writer_t *out, const message_sleep_t *in)
{
    frame_write_begin(out);
    frame_write_u8(out, in->joint);
    frame_write_u8(out, in->asleep ? 1u : 0u);
}

bool message_read_sleep(const frame_t *frame, message_sleep_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->joint = frame_read_u8(&in);
    out->asleep = frame_read_u8(&in) != 0;
    return frame_read_all(&in);
}

/* ---- From the hub ---- */

void message_write_table(frame_writer_t *out, const message_table_t *in)
{
    frame_write_begin(out);
    frame_write_u8(out, in->refused ? 1u : 0u);
    frame_write_u8(out, in->at);
    frame_write_text(out, in->what, MESSAGE_WHAT_BYTES);
}

bool message_read_table(const frame_t *frame, message_table_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->refused = frame_read_u8(&in) != 0;
    out->at = frame_read_u8(&in);
    frame_read_text(&in, out->what, MESSAGE_WHAT_BYTES);
    return frame_read_all(&in);
}

void message_write_event(frame_writer_t *out, const jcal_body_event_t *in)
{
    frame_write_begin(out);
    frame_write_u64(out, in->t_us);
    frame_write_u8(out, in->kind);
    frame_write_u8(out, in->joint);
    frame_write_u8(out, in->sensor);
    frame_write_u8(out, in->what);
    frame_write_f32(out, in->value);
}

bool message_read_event(const frame_t *frame, jcal_body_event_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->t_us = frame_read_u64(&in);
    out->kind = frame_read_u8(&in);
    out->joint = frame_read_u8(&in);
    out->sensor = frame_read_u8(&in);
    out->what = frame_read_u8(&in);
    out->value = frame_read_f32(&in);
    return frame_read_all(&in);
}

#define FLAG_LAG_KNOWN 1u
#define FLAG_HEADING_KNOWN 2u
#define FLAG_HAS_KEPT 4u
#define FLAG_ASLEEP 8u

void message_write_joint_state(frame_writer_t *out, const message_joint_state_t *in)
{
    const jcal_body_joint_result_t *of = &in->result;
    frame_write_begin(out);
    frame_write_u32(out, in->token);
    frame_write_u8(out, in->joint);
    frame_write_u8(out, (uint8_t)of->head.status);
    frame_write_u8(out, (uint8_t)of->head.weak);
    frame_write_u8(out, (uint8_t)of->head.hint);
    frame_write_u8(out, (uint8_t)of->head.reason);
    frame_write_u8(out, (of->lag_known ? FLAG_LAG_KNOWN : 0u) | (of->heading.known ? FLAG_HEADING_KNOWN : 0u) |
                            (of->has_kept ? FLAG_HAS_KEPT : 0u) | (in->asleep ? FLAG_ASLEEP : 0u));
    frame_write_u8(out, (uint8_t)of->kept);
    frame_write_u8(out, (uint8_t)of->kept_reason);
    frame_write_f32(out, of->lag_s);
    frame_write_f32(out, of->lag_bound_s);
    message_write_vector(out, of->axis1);
    message_write_vector(out, of->axis2);
    frame_write_f32(out, of->uncertainty1_rad);
    frame_write_f32(out, of->uncertainty2_rad);
    message_write_vector(out, of->joint_to_sensor1_m);
    message_write_vector(out, of->joint_to_sensor2_m);
    frame_write_f32(out, of->heading.heading_rad);
    frame_write_f32(out, of->flexion_bound_rad);
    frame_write_f32(out, of->relative_bound_rad);
    frame_write_u32(out, of->head.samples);
}

bool message_read_joint_state(const frame_t *frame, message_joint_state_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    jcal_body_joint_result_t *of = &out->result;
    memset(out, 0, sizeof *out);
    out->token = frame_read_u32(&in);
    out->joint = frame_read_u8(&in);
    of->head.status = (jcal_calibration_t)frame_read_u8(&in);
    of->head.weak = (jcal_weak_t)frame_read_u8(&in);
    of->head.hint = (jcal_hint_t)frame_read_u8(&in);
    of->head.reason = (jcal_reason_t)frame_read_u8(&in);
    const uint8_t flags = frame_read_u8(&in);
    of->lag_known = (flags & FLAG_LAG_KNOWN) != 0;
    of->heading.known = (flags & FLAG_HEADING_KNOWN) != 0;
    of->has_kept = (flags & FLAG_HAS_KEPT) != 0;
    out->asleep = (flags & FLAG_ASLEEP) != 0;
    of->kept = (jcal_remember_state_t)frame_read_u8(&in);
    of->kept_reason = (jcal_remember_reason_t)frame_read_u8(&in);
    of->lag_s = frame_read_f32(&in);
    of->lag_bound_s = frame_read_f32(&in);
    of->axis1 = message_read_vector(&in);
    of->axis2 = message_read_vector(&in);
    of->uncertainty1_rad = frame_read_f32(&in);
    of->uncertainty2_rad = frame_read_f32(&in);
    of->joint_to_sensor1_m = message_read_vector(&in);
    of->joint_to_sensor2_m = message_read_vector(&in);
    of->heading.heading_rad = frame_read_f32(&in);
    of->flexion_bound_rad = frame_read_f32(&in);
    of->relative_bound_rad = frame_read_f32(&in);
    of->head.samples = frame_read_u32(&in);
    return frame_read_all(&in);
}

void message_write_sensor_state(frame_writer_t *out, const message_sensor_state_t *in)
{
    const jcal_body_sensor_result_t *of = &in->result;
    const uint32_t counts[8] = {of->packets.readings, of->packets.lost,     of->packets.late,  of->packets.duplicate,
                                of->packets.odd,      of->packets.restarts, of->packets.steps, of->packets.overruns};
    frame_write_begin(out);
    frame_write_u32(out, in->token);
    frame_write_u8(out, in->sensor);
    frame_write_u8(out, of->is_heard ? 1u : 0u);
    frame_write_u16(out, of->bad);
    for (unsigned k = 0; k < 8u; k++) {
        frame_write_u32(out, counts[k]);
    }
    frame_write_f32(out, of->packets.period_s);
    frame_write_f32(out, of->packets.drift_ppm);
    frame_write_f32(out, of->shift_s);
    frame_write_u32(out, of->samples);
    frame_write_u32(out, of->missed);
    frame_write_u32(out, of->rejected);
    frame_write_u32(out, of->late);
}

bool message_read_sensor_state(const frame_t *frame, message_sensor_state_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    jcal_body_sensor_result_t *of = &out->result;
    memset(out, 0, sizeof *out);
    out->token = frame_read_u32(&in);
    out->sensor = frame_read_u8(&in);
    of->is_heard = frame_read_u8(&in) != 0;
    of->bad = frame_read_u16(&in);
    uint32_t *const counts[8] = {&of->packets.readings,  &of->packets.lost,    &of->packets.late,
                                 &of->packets.duplicate, &of->packets.odd,     &of->packets.restarts,
                                 &of->packets.steps,     &of->packets.overruns};
    for (unsigned k = 0; k < 8u; k++) {
        *counts[k] = frame_read_u32(&in);
    }
    of->packets.period_s = frame_read_f32(&in);
    of->packets.drift_ppm = frame_read_f32(&in);
    of->shift_s = frame_read_f32(&in);
    of->samples = frame_read_u32(&in);
    of->missed = frame_read_u32(&in);
    of->rejected = frame_read_u32(&in);
    of->late = frame_read_u32(&in);
    return frame_read_all(&in);
}

void message_write_body_state(frame_writer_t *out, const message_body_state_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->token);
    frame_write_u64(out, in->status.t_us);
    frame_write_u32(out, in->status.rounds);
    frame_write_u32(out, in->status.restarts);
    frame_write_u32(out, in->status.lags_refused);
    frame_write_u32(out, in->status.events_dropped);
    frame_write_u64(out, in->status.units);
    frame_write_u32(out, in->writes);
}

bool message_read_body_state(const frame_t *frame, message_body_state_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    memset(out, 0, sizeof *out);
    out->token = frame_read_u32(&in);
    out->status.t_us = frame_read_u64(&in);
    out->status.rounds = frame_read_u32(&in);
    out->status.restarts = frame_read_u32(&in);
    out->status.lags_refused = frame_read_u32(&in);
    out->status.events_dropped = frame_read_u32(&in);
    out->status.units = frame_read_u64(&in);
    out->writes = frame_read_u32(&in);
    return frame_read_all(&in);
}

void message_write_flexions(frame_writer_t *out, const message_flexions_t *in)
{
    frame_write_begin(out);
    frame_write_u64(out, in->t_us);
    for (unsigned k = 0; k < in->count; k++) {
        frame_write_u8(out, in->of[k].joint);
        frame_write_f32(out, in->of[k].flexion_rad);
        frame_write_f32(out, in->of[k].bound_rad);
    }
}

bool message_read_flexions(const frame_t *frame, message_flexions_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->t_us = frame_read_u64(&in);
    for (out->count = 0; out->count < MESSAGE_FLEXIONS && frame_read_left(&in) > 0 && in.ok; out->count++) {
        message_flexion_t *const of = &out->of[out->count];
        of->joint = frame_read_u8(&in);
        of->flexion_rad = frame_read_f32(&in);
        of->bound_rad = frame_read_f32(&in);
    }
    return frame_read_all(&in);
}

void message_write_orientations(frame_writer_t *out, const message_orientations_t *in)
{
    frame_write_begin(out);
    frame_write_u64(out, in->t_us);
    for (unsigned k = 0; k < in->count; k++) {
        const message_orientation_t *const of = &in->of[k];
        frame_write_u8(out, of->joint);
        frame_write_f32(out, of->relative.w);
        frame_write_f32(out, of->relative.x);
        frame_write_f32(out, of->relative.y);
        frame_write_f32(out, of->relative.z);
        frame_write_f32(out, of->bound_rad);
    }
}

bool message_read_orientations(const frame_t *frame, message_orientations_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->t_us = frame_read_u64(&in);
    for (out->count = 0; out->count < MESSAGE_ORIENTATIONS && frame_read_left(&in) > 0 && in.ok; out->count++) {
        message_orientation_t *const of = &out->of[out->count];
        of->joint = frame_read_u8(&in);
        of->relative.w = frame_read_f32(&in);
        of->relative.x = frame_read_f32(&in);
        of->relative.y = frame_read_f32(&in);
        of->relative.z = frame_read_f32(&in);
        of->bound_rad = frame_read_f32(&in);
    }
    return frame_read_all(&in) && out->count > 0;
}

void message_write_advice(frame_writer_t *out, const message_advice_t *in)
{
    const size_t length = strlen(in->text);
    frame_write_begin(out);
    frame_write_u8(out, in->advice.joint);
    frame_write_u8(out, in->advice.sensor);
    frame_write_u8(out, (uint8_t)in->advice.hint);
    frame_write_u8(out, (uint8_t)in->advice.reason);
    frame_write_text(out, in->text, (length < MESSAGE_ADVICE_BYTES) ? length : MESSAGE_ADVICE_BYTES);
}

bool message_read_advice(const frame_t *frame, message_advice_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->advice.joint = frame_read_u8(&in);
    out->advice.sensor = frame_read_u8(&in);
    out->advice.hint = (jcal_hint_t)frame_read_u8(&in);
    out->advice.reason = (jcal_reason_t)frame_read_u8(&in);
    const size_t left = frame_read_left(&in);
    if (!in.ok || left > MESSAGE_ADVICE_BYTES) {
        return false;
    }
    frame_read_text(&in, out->text, left);
    return frame_read_all(&in);
}

void message_write_kept(frame_writer_t *out, const message_kept_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->token);
    frame_write_u8(out, in->joint);
    frame_write_u8(out, in->refusal);
    frame_write_bytes(out, in->bytes, sizeof in->bytes);
}

bool message_read_kept(const frame_t *frame, message_kept_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->token = frame_read_u32(&in);
    out->joint = frame_read_u8(&in);
    out->refusal = frame_read_u8(&in);
    frame_read_bytes(&in, out->bytes, sizeof out->bytes);
    return frame_read_all(&in);
}

void message_write_other_version(frame_writer_t *out, uint8_t version)
{
    frame_write_begin(out);
    frame_write_u8(out, version);
}

bool message_read_other_version(const frame_t *frame, uint8_t *version)
{
    frame_reader_t in = frame_read_begin(frame);
    *version = frame_read_u8(&in);
    return frame_read_all(&in);
}
