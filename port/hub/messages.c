/* SPDX-License-Identifier: MIT */
/* Payloads of the frames. Each write function and its read function name the same fields in the same order. */
#include "messages.h"

#include "vectors.h"

#include <string.h>

void message_write_start(frame_writer_t *out, const message_start_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->nonce);
    frame_write_u64(out, in->every_us);
    frame_write_f32(out, in->max_bound_rad);
    frame_write_u8(out, in->sign_hint);
}

bool message_read_start(const frame_t *frame, message_start_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->nonce = frame_read_u32(&in);
    out->every_us = frame_read_u64(&in);
    out->max_bound_rad = frame_read_f32(&in);
    out->sign_hint = frame_read_u8(&in);
    return frame_read_all(&in);
}

void message_write_sample(frame_writer_t *out, const jcal_pair_t *in)
{
    frame_write_begin(out);
    frame_write_u64(out, in->t_us);
    message_write_vector(out, in->imu1.gyr_rad_s);
    message_write_vector(out, in->imu1.acc_m_s2);
    message_write_vector(out, in->imu2.gyr_rad_s);
    message_write_vector(out, in->imu2.acc_m_s2);
}

bool message_read_sample(const frame_t *frame, jcal_pair_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->t_us = frame_read_u64(&in);
    out->imu1.gyr_rad_s = message_read_vector(&in);
    out->imu1.acc_m_s2 = message_read_vector(&in);
    out->imu2.gyr_rad_s = message_read_vector(&in);
    out->imu2.acc_m_s2 = message_read_vector(&in);
    return frame_read_all(&in);
}

void message_write_number(frame_writer_t *out, uint32_t number)
{
    frame_write_begin(out);
    frame_write_u32(out, number);
}

bool message_read_number(const frame_t *frame, uint32_t *number)
{
    frame_reader_t in = frame_read_begin(frame);
    *number = frame_read_u32(&in);
    return frame_read_all(&in);
}

void message_write_hello(frame_writer_t *out, const message_hello_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->nonce);
    frame_write_u8(out, in->refused ? 1u : 0u);
    frame_write_u8(out, in->credit);
    for (int k = 0; k < 3; k++) {
        frame_write_u8(out, in->version[k]);
    }
}

bool message_read_hello(const frame_t *frame, message_hello_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->nonce = frame_read_u32(&in);
    out->refused = frame_read_u8(&in) != 0;
    out->credit = frame_read_u8(&in);
    for (int k = 0; k < 3; k++) {
        out->version[k] = frame_read_u8(&in);
    }
    return frame_read_all(&in);
}

#define FLAG_HAS_AXES 1u
#define FLAG_PAPER_ACCEPTED 2u
#define FLAG_HAS_LEVERS 4u
#define FLAG_HEADING_KNOWN 8u

void message_write_estimate(frame_writer_t *out, const message_estimate_t *in)
{
    const jcal_hinge_auto_result_t *all = &in->result;
    const jcal_hinge_result_t *result = &all->hinge;
    frame_write_begin(out);
    frame_write_u8(out, in->events);
    frame_write_u32(out, in->token);
    frame_write_u64(out, in->now_us);
    frame_write_u8(out, (uint8_t)result->head.status);
    frame_write_u8(out, (uint8_t)result->head.engine);
    frame_write_u8(out, (uint8_t)result->head.weak);
    frame_write_u8(out, (uint8_t)result->head.hint);
    frame_write_u8(out, (uint8_t)result->head.reason);
    frame_write_u8(out, (result->has_axes ? FLAG_HAS_AXES : 0u) | (result->paper_accepted ? FLAG_PAPER_ACCEPTED : 0u) |
                            (all->has_levers ? FLAG_HAS_LEVERS : 0u) | (all->heading.known ? FLAG_HEADING_KNOWN : 0u));
    frame_write_u8(out, (uint8_t)all->model);
    frame_write_u8(out, (uint8_t)all->ready_for);
    message_write_vector(out, result->axis1);
    message_write_vector(out, result->axis2);
    frame_write_f32(out, result->uncertainty1_rad);
    frame_write_f32(out, result->uncertainty2_rad);
    frame_write_f32(out, result->sign_margin);
    frame_write_f32(out, result->progress_axis1);
    frame_write_f32(out, result->progress_axis2);
    frame_write_f32(out, result->progress_sign);
    frame_write_f32(out, all->flexion_uncertainty_rad);
    frame_write_f32(out, all->heading.heading_rad);
    message_write_vector(out, all->joint_to_sensor1_m);
    message_write_vector(out, all->joint_to_sensor2_m);
    frame_write_u64(out, result->head.t_us);
    frame_write_u32(out, result->head.samples);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        frame_write_u32(out, result->head.rejected_by[k]);
    }
}

bool message_read_estimate(const frame_t *frame, message_estimate_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    jcal_hinge_auto_result_t *all = &out->result;
    jcal_hinge_result_t *result = &all->hinge;
    memset(out, 0, sizeof *out);
    out->events = frame_read_u8(&in);
    out->token = frame_read_u32(&in);
    out->now_us = frame_read_u64(&in);
    result->head.status = (jcal_calibration_t)frame_read_u8(&in);
    result->head.engine = (jcal_engine_t)frame_read_u8(&in);
    result->head.weak = (jcal_weak_t)frame_read_u8(&in);
    result->head.hint = (jcal_hint_t)frame_read_u8(&in);
    result->head.reason = (jcal_reason_t)frame_read_u8(&in);
    const uint8_t flags = frame_read_u8(&in);
    result->has_axes = (flags & FLAG_HAS_AXES) != 0;
    result->paper_accepted = (flags & FLAG_PAPER_ACCEPTED) != 0;
    all->has_levers = (flags & FLAG_HAS_LEVERS) != 0;
    all->heading.known = (flags & FLAG_HEADING_KNOWN) != 0;
    all->model = (jcal_model_t)frame_read_u8(&in);
    all->ready_for = (jcal_ready_for_t)frame_read_u8(&in);
    result->axis1 = message_read_vector(&in);
    result->axis2 = message_read_vector(&in);
    result->uncertainty1_rad = frame_read_f32(&in);
    result->uncertainty2_rad = frame_read_f32(&in);
    result->sign_margin = frame_read_f32(&in);
    result->progress_axis1 = frame_read_f32(&in);
    result->progress_axis2 = frame_read_f32(&in);
    result->progress_sign = frame_read_f32(&in);
    all->flexion_uncertainty_rad = frame_read_f32(&in);
    all->heading.heading_rad = frame_read_f32(&in);
    all->joint_to_sensor1_m = message_read_vector(&in);
    all->joint_to_sensor2_m = message_read_vector(&in);
    result->head.t_us = frame_read_u64(&in);
    result->head.samples = frame_read_u32(&in);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        result->head.rejected_by[k] = frame_read_u32(&in);
        result->head.rejected += result->head.rejected_by[k];
    }
    return frame_read_all(&in);
}

/* The counts of a link in the order of the wire. */
static void write_counts(frame_writer_t *out, const frame_counts_t *counts)
{
    frame_write_u32(out, counts->received);
    frame_write_u32(out, counts->taken);
    frame_write_u32(out, counts->lost);
    frame_write_u32(out, counts->repeated);
    frame_write_u32(out, counts->corrupted);
    frame_write_u32(out, counts->reordered);
    frame_write_u32(out, counts->stale);
}

static void read_counts(frame_reader_t *in, frame_counts_t *counts)
{
    counts->received = frame_read_u32(in);
    counts->taken = frame_read_u32(in);
    counts->lost = frame_read_u32(in);
    counts->repeated = frame_read_u32(in);
    counts->corrupted = frame_read_u32(in);
    counts->reordered = frame_read_u32(in);
    counts->stale = frame_read_u32(in);
}

void message_write_counters(frame_writer_t *out, const message_counters_t *in)
{
    frame_write_begin(out);
    frame_write_u32(out, in->token);
    write_counts(out, &in->link);
    frame_write_u32(out, in->unknown);
    frame_write_u32(out, in->overrun);
    frame_write_u32(out, in->samples);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        frame_write_u32(out, in->rejected_by[k]);
    }
}

bool message_read_counters(const frame_t *frame, message_counters_t *out)
{
    frame_reader_t in = frame_read_begin(frame);
    out->token = frame_read_u32(&in);
    read_counts(&in, &out->link);
    out->unknown = frame_read_u32(&in);
    out->overrun = frame_read_u32(&in);
    out->samples = frame_read_u32(&in);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        out->rejected_by[k] = frame_read_u32(&in);
    }
    return frame_read_all(&in);
}
