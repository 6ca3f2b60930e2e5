/* SPDX-License-Identifier: MIT */
/* Runs a body over arrays of packets. */
#include "batch_body.h"

#include "body_row.h"

#include <string.h>

#define SLOTS 64u
#define PER_PACKET 4u
#define STEP_US 10000u

typedef struct {
    unsigned char storage[JCAL_BATCH_BODY_SENSORS][JCAL_PACKETS_STORAGE_BYTES(SLOTS, PER_PACKET, JCAL_PACKET_SI)];
    jcal_packet_config_t packets;
    jcal_body_sensor_spec_t sensors[JCAL_BATCH_BODY_SENSORS];
    jcal_body_joint_spec_t joints[JCAL_BATCH_BODY_JOINTS];
    jcal_body_sensor_t sensor_states[JCAL_BATCH_BODY_SENSORS];
    jcal_body_joint_t joint_states[JCAL_BATCH_BODY_JOINTS];
    jcal_functional_t hinges[JCAL_BATCH_BODY_JOINTS];
    jcal_body_shared_t shared;
    jcal_flash_t flash;
    jcal_health_t health;
    jcal_body_t body;
} whole_t;

static bool flash_erase(void *context, unsigned slot)
{
    memset((uint8_t *)context + slot * JCAL_BATCH_SLOT_BYTES, 0xFF, JCAL_BATCH_SLOT_BYTES);
    return true;
}

static bool flash_program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    memcpy((uint8_t *)context + slot * JCAL_BATCH_SLOT_BYTES + offset, bytes, n);
    return true;
}

static bool flash_read(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n)
{
    memcpy(bytes, (uint8_t *)context + slot * JCAL_BATCH_SLOT_BYTES + offset, n);
    return true;
}

/* What is ready is written, whatever the schedule says. */
static bool keep_all(const whole_t *w, unsigned joints)
{
    jcal_keep_writer_t writer;
    if (jcal_keep_begin(&writer, &w->flash, joints) != JCAL_OK) {
        return false;
    }
    for (unsigned j = 0; j < joints; j++) {
        jcal_kept_t kept;
        if (jcal_body_kept(&w->body, j, &kept) == JCAL_OK && jcal_keep_put(&writer, &kept) != JCAL_OK) {
            return false;
        }
    }
    return jcal_keep_commit(&writer) == JCAL_OK;
}

static bool begin(whole_t *w, const jcal_batch_body_in_t *in)
{
    const unsigned sensors = (unsigned)in->sensor_count;
    const unsigned joints = (unsigned)in->joint_count;
    const jcal_functional_config_t settings = jcal_functional_config_default();
    const jcal_body_config_t config = jcal_body_config_default();
    w->packets = jcal_packet_config_default();
    w->packets.per_packet = PER_PACKET;
    w->packets.packets = SLOTS;
    w->packets.counter_bits = (uint8_t)in->counter_bits;
    w->packets.max_delay_s = 0.5f;
    for (unsigned s = 0; s < sensors; s++) {
        const jcal_body_sensor_spec_t spec = {NULL, &w->packets, w->storage[s], sizeof(w->storage[s]),
                                              (in->serials != NULL) ? in->serials[s] : 0u};
        w->sensors[s] = spec;
    }
    for (unsigned j = 0; j < joints; j++) {
        const jcal_body_joint_spec_t spec = {
            NULL, in->proximal[j], in->distal[j], JCAL_BODY_HINGE, {.hinge = &w->hinges[j]}};
        w->joints[j] = spec;
        if (jcal_functional_init(&w->hinges[j], &settings) != JCAL_OK) {
            return false;
        }
    }
    const jcal_flash_t flash = {in->flash, JCAL_BATCH_SLOT_BYTES, 32u, flash_erase, flash_program, flash_read};
    w->flash = flash;
    const jcal_body_table_t table = {w->sensors, w->sensor_states, sensors,
                                     w->joints,  w->joint_states,  joints,
                                     &w->shared, &w->health,       (in->flash != NULL) ? &w->flash : NULL};
    return jcal_body_init(&w->body, &table, &config) == JCAL_OK;
}

static void write_rows(const whole_t *w, const jcal_batch_body_in_t *in, uint64_t now_us, jcal_batch_body_out_t *out)
{
    float *row = out->rows + out->row_count * (size_t)in->joint_count * JCAL_BATCH_BODY_COLUMNS;
    for (unsigned j = 0; j < (unsigned)in->joint_count; j++) {
        jcal_body_joint_result_t r;
        jcal_functional_result_t f;
        (void)jcal_body_joint(&w->body, j, &r);
        (void)jcal_functional_get(&w->hinges[j], &f);
        body_row(&r, f.for_axes, row);
        row[BODY_ROW_COLUMNS] = r.has_kept ? 1.0f : 0.0f;
        row[BODY_ROW_COLUMNS + 1] = (float)r.kept;
        row[BODY_ROW_COLUMNS + 2] = (float)r.kept_reason;
        row += JCAL_BATCH_BODY_COLUMNS;
    }
    jcal_body_sensor_result_t first;
    (void)jcal_body_sensor(&w->body, 0, &first);
    out->row_us[out->row_count] = now_us;
    out->time_us[out->row_count] = first.t_us;
    out->row_count++;
}

static void note_events(whole_t *w, jcal_batch_body_out_t *out)
{
    jcal_body_event_t e;
    while (jcal_body_event(&w->body, &e) == JCAL_OK) {
        if (out->event_count < out->event_room) {
            const float values[JCAL_BATCH_EVENT_COLUMNS] = {(float)e.kind, (float)e.joint, (float)e.sensor,
                                                            (float)e.what, e.value};
            out->event_us[out->event_count] = e.t_us;
            memcpy(out->events + out->event_count * JCAL_BATCH_EVENT_COLUMNS, values, sizeof(values));
        }
        out->event_count++;
    }
}

static void put_to_sleep(whole_t *w, unsigned joints)
{
    for (unsigned j = 0; j < joints; j++) {
        if (!jcal_body_sleeps(&w->body, j)) {
            (void)jcal_body_sleep(&w->body, j, true); /* rejected while it is not ready */
        }
    }
}

static void step(whole_t *w, const jcal_batch_body_in_t *in, uint64_t now_us, jcal_batch_body_out_t *out)
{
    jcal_body_status_t before;
    jcal_body_status_t after;
    const uint32_t mark = (uint32_t)in->mark;
    (void)jcal_body_status(&w->body, &before);
    if (mark > 0u && out->steps == mark) {
        out->mark_units = before.units;
    }
    if (mark > 0u && in->sleeps != 0 && out->steps >= mark) {
        put_to_sleep(w, (unsigned)in->joint_count);
    }
    const jcal_status_t status = jcal_body_step(&w->body, now_us, (unsigned)in->units);
    (void)jcal_body_status(&w->body, &after);
    const uint32_t used = (uint32_t)(after.units - before.units);
    out->most_units = (used > out->most_units) ? used : out->most_units;
    out->full_steps += (status == JCAL_OK) ? 1u : 0u;
    out->steps++;
    note_events(w, out);
    if ((out->steps % (uint32_t)in->every) == 0u && out->row_count < out->room) {
        write_rows(w, in, now_us, out);
    }
}

int32_t jcal_batch_body(const jcal_batch_body_in_t *in, jcal_batch_body_out_t *out)
{
    static whole_t whole;
    memset(&whole, 0, sizeof(whole));
    if (in->sensor_count > JCAL_BATCH_BODY_SENSORS || in->joint_count > JCAL_BATCH_BODY_JOINTS || in->count == 0u ||
        !begin(&whole, in)) {
        return JCAL_BATCH_CONFIG;
    }
    uint64_t now_us = in->arrival_us[0];
    for (size_t k = 0; k < in->count; k++) {
        while (in->arrival_us[k] > now_us) {
            step(&whole, in, now_us, out);
            now_us += STEP_US;
        }
        const unsigned from = in->which[k];
        const jcal_packet_t packet = {in->arrival_us[k], in->counter[k], in->readings[k], NULL,
                                      in->si[from] + 6u * (size_t)in->at[k]};
        (void)jcal_body_push(&whole.body, from, &packet);
    }
    for (unsigned k = 0; k < 200u; k++) { /* what still waits */
        step(&whole, in, now_us, out);
        now_us += STEP_US;
    }
    out->state_bytes = (uint32_t)JCAL_BODY_STATE_BYTES(in->sensor_count, in->joint_count,
                                                       (size_t)in->joint_count * sizeof(jcal_functional_t));
    (void)jcal_body_status(&whole.body, &out->status);
    for (unsigned s = 0; s < (unsigned)in->sensor_count; s++) {
        (void)jcal_body_sensor(&whole.body, s, &out->sensors[s]);
    }
    if (in->flash != NULL && in->keeps != 0 && !keep_all(&whole, (unsigned)in->joint_count)) {
        return JCAL_BATCH_CONFIG;
    }
    return JCAL_BATCH_DONE;
}
