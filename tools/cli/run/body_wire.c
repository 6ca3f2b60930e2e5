/* SPDX-License-Identifier: MIT */
/* Payloads of a body session. */
#include "run/body_wire.h"

/* ---- Pieces ---- */

static void write_u16(frame_writer_t *out, uint16_t value)
{
    frame_write_u8(out, (uint8_t)(value & 0xFFu));
    frame_write_u8(out, (uint8_t)(value >> 8));
}

static uint16_t read_u16(frame_reader_t *in)
{
    const unsigned low = frame_read_u8(in);
    return (uint16_t)(low | ((unsigned)frame_read_u8(in) << 8));
}

/* Zeros behind it; none if all bytes are used. */
static void write_text(frame_writer_t *out, const char *text, size_t size)
{
    bool ended = false;
    for (size_t k = 0; k < size; k++) {
        ended = ended || text[k] == '\0';
        frame_write_u8(out, ended ? 0u : (uint8_t)text[k]);
    }
}

/* A hub may send what it likes: only what a reader can take comes out. */
static void read_text(frame_reader_t *in, char *text, size_t size)
{
    size_t length = 0;
    for (size_t k = 0; k < size; k++) {
        const uint8_t byte = frame_read_u8(in);
        text[k] = (byte == 0u || (byte >= 0x20u && byte < 0x7Fu)) ? (char)byte : '?';
        length = (byte != 0u) ? k + 1 : length;
    }
    text[length] = '\0';
}

static jcal_vec3_t read_vector(frame_reader_t *in)
{
    jcal_vec3_t vector;
    vector.x = frame_read_f32(in);
    vector.y = frame_read_f32(in);
    vector.z = frame_read_f32(in);
    return vector;
}

/* ---- To the hub ---- */

void body_wire_write_begin(frame_writer_t *out, const body_wire_begin_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->nonce);
    frame_write_u64(out, in->every_us);
    frame_write_u64(out, in->angles_every_us);
    frame_write_u8(out, in->sensors);
    frame_write_u8(out, in->joints);
    frame_write_u8(out, in->flags);
}

void body_wire_write_sensor(frame_writer_t *out, const body_wire_sensor_t *in)
{
    frame_write_begin(out);
    frame_write_u8(out, in->number);
    frame_write_u64(out, in->serial);
    frame_write_u32(out, in->period_ns);
    frame_write_u8(out, in->counter_bits);
    frame_write_u8(out, in->per_packet);
    frame_write_f32(out, in->scale.gyr_rad_s);
    frame_write_f32(out, in->scale.acc_m_s2);
    write_u16(out, (uint16_t)in->scale.gyr_rail);
    write_u16(out, (uint16_t)in->scale.acc_rail);
    frame_write_f32(out, in->max_drift_ppm);
    write_text(out, in->name, BODY_WIRE_NAME_MAX);
}

void body_wire_write_joint(frame_writer_t *out, const body_wire_joint_t *in)
{
    frame_write_begin(out);
    frame_write_u8(out, in->number);
    frame_write_u8(out, in->kind);
    frame_write_u8(out, in->proximal);
    frame_write_u8(out, in->distal);
    frame_write_f32(out, in->max_bound_rad);
    write_text(out, in->name, BODY_WIRE_NAME_MAX);
}

void body_wire_write_packet(frame_writer_t *out, const body_wire_packet_t *in)
{
    frame_write_begin(out);
    frame_write_u8(out, in->sensor);
    frame_write_u64(out, in->arrival_us);
    frame_write_u32(out, in->counter);
    for (unsigned k = 0; k < 6u * in->count; k++) {
        write_u16(out, (uint16_t)in->raw[k]);
    }
}

void body_wire_write_put_kept(frame_writer_t *out, uint32_t token, const uint8_t record[BODY_WIRE_RECORD_BYTES])
{
    frame_write_begin(out);
    frame_write_u32(out, token);
    for (unsigned k = 0; k < BODY_WIRE_RECORD_BYTES; k++) {
        frame_write_u8(out, record[k]);
    }
}

void body_wire_write_get_kept(frame_writer_t *out, uint32_t token, uint8_t joint)
{
    frame_write_begin(out);
    frame_write_u32(out, token);
    frame_write_u8(out, joint);
}

/* ---- From the hub ---- */

bool body_wire_read_table(const frame_t *frame, body_wire_table_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->refused = frame_read_u8(&in) != 0u;
    out->at = frame_read_u8(&in);
    read_text(&in, out->what, BODY_WIRE_WHAT_MAX);
    return frame_read_all(&in);
}

bool body_wire_read_event(const frame_t *frame, body_wire_event_t *out)
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

bool body_wire_read_joint(const frame_t *frame, body_wire_joint_state_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->token = frame_read_u32(&in);
    out->joint = frame_read_u8(&in);
    out->status = frame_read_u8(&in);
    out->weak = frame_read_u8(&in);
    out->hint = frame_read_u8(&in);
    out->reason = frame_read_u8(&in);
    const unsigned flags = frame_read_u8(&in);
    out->lag_known = (flags & 1u) != 0u;
    out->heading_known = (flags & 2u) != 0u;
    out->record_found = (flags & 4u) != 0u;
    out->asleep = (flags & 8u) != 0u;
    out->kept = frame_read_u8(&in);
    out->kept_reason = frame_read_u8(&in);
    out->lag_s = frame_read_f32(&in);
    out->lag_bound_s = frame_read_f32(&in);
    out->axis1 = read_vector(&in);
    out->axis2 = read_vector(&in);
    out->uncertainty1_rad = frame_read_f32(&in);
    out->uncertainty2_rad = frame_read_f32(&in);
    out->joint_to_sensor1_m = read_vector(&in);
    out->joint_to_sensor2_m = read_vector(&in);
    out->heading_rad = frame_read_f32(&in);
    out->flexion_bound_rad = frame_read_f32(&in);
    out->relative_bound_rad = frame_read_f32(&in);
    out->samples = frame_read_u32(&in);
    return frame_read_all(&in);
}

bool body_wire_read_sensor(const frame_t *frame, body_wire_sensor_state_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->token = frame_read_u32(&in);
    out->sensor = frame_read_u8(&in);
    out->heard = frame_read_u8(&in) != 0u;
    out->bad = read_u16(&in);
    uint32_t *const packets[] = {&out->readings, &out->lost,     &out->late,  &out->duplicate,
                                 &out->odd,      &out->restarts, &out->steps, &out->overruns};
    for (size_t k = 0; k < sizeof packets / sizeof packets[0]; k++) {
        *packets[k] = frame_read_u32(&in);
    }
    out->period_s = frame_read_f32(&in);
    out->drift_ppm = frame_read_f32(&in);
    out->shift_s = frame_read_f32(&in);
    out->samples = frame_read_u32(&in);
    out->missed = frame_read_u32(&in);
    out->rejected = frame_read_u32(&in);
    out->late_readings = frame_read_u32(&in);
    return frame_read_all(&in);
}

bool body_wire_read_body(const frame_t *frame, body_wire_body_state_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->token = frame_read_u32(&in);
    out->t_us = frame_read_u64(&in);
    out->rounds = frame_read_u32(&in);
    out->restarts = frame_read_u32(&in);
    out->lags_refused = frame_read_u32(&in);
    out->events_dropped = frame_read_u32(&in);
    out->units = frame_read_u64(&in);
    out->writes = frame_read_u32(&in);
    return frame_read_all(&in);
}

bool body_wire_read_flexions(const frame_t *frame, body_wire_flexions_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->t_us = frame_read_u64(&in);
    for (out->count = 0; in.ok && in.at < in.size && out->count < BODY_WIRE_FLEXIONS_MAX; out->count++) {
        out->of[out->count].joint = frame_read_u8(&in);
        out->of[out->count].angle_rad = frame_read_f32(&in);
        out->of[out->count].bound_rad = frame_read_f32(&in);
    }
    return frame_read_all(&in);
}

bool body_wire_read_orientations(const frame_t *frame, body_wire_orientations_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->t_us = frame_read_u64(&in);
    for (out->count = 0; in.ok && in.at < in.size && out->count < BODY_WIRE_ORIENTATIONS_MAX; out->count++) {
        out->of[out->count].joint = frame_read_u8(&in);
        out->of[out->count].relative.w = frame_read_f32(&in);
        out->of[out->count].relative.x = frame_read_f32(&in);
        out->of[out->count].relative.y = frame_read_f32(&in);
        out->of[out->count].relative.z = frame_read_f32(&in);
        out->of[out->count].bound_rad = frame_read_f32(&in);
    }
    return frame_read_all(&in) && out->count > 0;
}

bool body_wire_read_advice(const frame_t *frame, body_wire_advice_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->joint = frame_read_u8(&in);
    out->sensor = frame_read_u8(&in);
    out->hint = frame_read_u8(&in);
    out->reason = frame_read_u8(&in);
    const size_t length = in.ok ? in.size - in.at : 0;
    if (length > BODY_WIRE_TEXT_MAX) {
        return false;
    }
    read_text(&in, out->text, length);
    return frame_read_all(&in);
}

bool body_wire_read_kept(const frame_t *frame, body_wire_kept_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->token = frame_read_u32(&in);
    out->joint = frame_read_u8(&in);
    out->refusal = frame_read_u8(&in);
    for (unsigned k = 0; k < BODY_WIRE_RECORD_BYTES; k++) {
        out->record[k] = frame_read_u8(&in);
    }
    return frame_read_all(&in);
}
