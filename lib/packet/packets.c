/* SPDX-License-Identifier: MIT */
/// @file
/// Packets of a wireless sensor become readings. See packet.h.
#include "jointcal/packet.h"

#include "math/clear.h"
#include "packet/envelope.h"
#include "packet/order.h"
#include "packet/pace.h"
#include "packet/queue.h"

jcal_status_t jcal_packets_init(jcal_packets_t *self, const jcal_packet_config_t *config, void *storage,
                                size_t storage_bytes)
{
    if ((self == NULL) || (config == NULL) || (storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_packet_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    if (storage_bytes < JCAL_PACKETS_STORAGE_BYTES(config->packets, config->per_packet, config->values)) {
        return JCAL_ERR_STORAGE;
    }
    const jcal_packet_config_t cfg = *config; /* which may be in self */
    jcal_clear(self, sizeof *self);
    self->cfg = cfg;
    self->storage = (unsigned char *)storage;
    self->envelope.bound_ppm = cfg.max_drift_ppm;
    return JCAL_OK;
}

/// The values of a packet, as bytes.
static const void *values_of(const jcal_packets_t *self, const jcal_packet_t *packet)
{
    return (self->cfg.values == JCAL_PACKET_RAW) ? (const void *)packet->raw : (const void *)packet->si;
}

jcal_status_t jcal_packets_push(jcal_packets_t *self, const jcal_packet_t *packet)
{
    if ((self == NULL) || (packet == NULL) || (self->storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    const void *const values = values_of(self, packet);
    if ((values == NULL) || (packet->count < 1u) || (packet->count > self->cfg.per_packet)) {
        return JCAL_ERR_ARG;
    }
    unsigned char *const slot = jcal_queue_room(self);
    if (slot == NULL) {
        return JCAL_ERR_FULL;
    }
    const jcal_packet_head_t head = {packet->arrival_us, packet->counter, packet->count};
    jcal_copy(slot, &head, sizeof head);
    jcal_copy(&slot[sizeof head], values,
              packet->count * JCAL_PACKET_VALUES * JCAL_PACKET_VALUE_BYTES(self->cfg.values));
    jcal_ring_publish(&self->ring);
    return JCAL_OK;
}

/// A sensor that is new, or began anew.
static void begin(jcal_packets_t *self, const jcal_packet_head_t *head, uint64_t first)
{
    const uint64_t ahead_us = ((uint64_t)(head->count - 1u) * self->cfg.period_ns) / 1000u;
    self->counts.restarts += self->order.has_next ? 1u : 0u;
    self->pace.has_last = self->pace.has_last && !jcal_order_went_back(&self->order, &self->cfg, head->arrival_us);
    jcal_order_begin(&self->order, first);
    jcal_envelope_begin(&self->envelope, &self->cfg, first + (head->count - 1u), head->arrival_us);
    jcal_pace_begin(&self->pace, self->cfg.period_ns, first, head->arrival_us - ahead_us);
}

/// Counts the readings that are before the next one; they are at the beginning of a packet. Returns how many.
static uint32_t skip_old(jcal_packets_t *self, const jcal_packet_head_t *head, uint64_t first)
{
    uint32_t old = 0u;
    while ((old < head->count) && ((int64_t)((first + old) - self->order.next) < 0)) {
        const bool has = jcal_order_has(&self->order, first + old);
        self->counts.duplicate += has ? 1u : 0u;
        self->counts.late += has ? 0u : 1u;
        old++;
    }
    return old;
}

/// Finds out what a packet is. False if nothing of it is used.
static bool open_packet(jcal_packets_t *self, const unsigned char *slot)
{
    jcal_packet_open_t *const open = &self->open;
    jcal_copy(&open->head, slot, sizeof open->head);
    if ((open->head.count < 1u) || (open->head.count > self->cfg.per_packet)) {
        return false; /* memory is damaged: push took no such packet */
    }
    const jcal_packet_place_t place =
        jcal_order_place(&self->order, &self->cfg, &self->envelope, &open->head, &open->first);
    if (place == JCAL_ORDER_ODD) {
        self->counts.odd += open->head.count;
        return false;
    }
    if (place == JCAL_ORDER_ANEW) {
        begin(self, &open->head, open->first);
    }
    self->order.fit_us = open->head.arrival_us;
    open->index = skip_old(self, &open->head, open->first);
    open->is_open = open->index < open->head.count;
    if (open->is_open && (place == JCAL_ORDER_FITS)) {
        const uint64_t last = open->first + (open->head.count - 1u);
        const bool is_step = jcal_envelope_put(&self->envelope, &self->cfg, last, open->head.arrival_us);
        self->counts.steps += is_step ? 1u : 0u;
    }
    return open->is_open;
}

/// The values of one reading, in SI.
static jcal_imu_t convert(const jcal_packet_config_t *cfg, const unsigned char *values, uint32_t index)
{
    float si[JCAL_PACKET_VALUES];
    int16_t raw[JCAL_PACKET_VALUES];
    if (cfg->values == JCAL_PACKET_RAW) {
        jcal_copy(raw, &values[index * sizeof raw], sizeof raw);
        for (uint32_t k = 0u; k < JCAL_PACKET_VALUES; ++k) {
            si[k] = (float)raw[k] * ((k < 3u) ? cfg->scale.gyr_rad_s : cfg->scale.acc_m_s2);
        }
    } else {
        jcal_copy(si, &values[index * sizeof si], sizeof si);
    }
    const jcal_imu_t imu = {{si[0], si[1], si[2]}, {si[3], si[4], si[5]}};
    return imu;
}

jcal_status_t jcal_packets_pull(jcal_packets_t *self, jcal_reading_t *out)
{
    if ((self == NULL) || (out == NULL) || (self->storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    const unsigned char *const slot = jcal_queue_peek(self);
    if (slot == NULL) {
        return JCAL_IDLE;
    }
    jcal_packet_open_t *const open = &self->open;
    const bool is_sound = (open->index < open->head.count) && (open->head.count <= self->cfg.per_packet);
    if (open->is_open ? !is_sound : !open_packet(self, slot)) {
        open->is_open = false;
        jcal_ring_release(&self->ring);
        return JCAL_REJECTED;
    }
    const uint64_t at = open->first + open->index;
    self->counts.lost += (uint32_t)jcal_order_go_on(&self->order, at);
    self->counts.readings += 1u;
    out->t_us = jcal_pace_to(&self->pace, self->cfg.period_ns, &self->envelope, at);
    out->imu = convert(&self->cfg, &slot[sizeof open->head], open->index);
    open->index++;
    if (open->index >= open->head.count) {
        open->is_open = false;
        jcal_ring_release(&self->ring);
    }
    return JCAL_OK;
}

jcal_status_t jcal_packets_get(const jcal_packets_t *self, jcal_packets_status_t *out)
{
    if ((self == NULL) || (out == NULL) || (self->storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_packet_counts_t *const counts = &self->counts;
    const jcal_packets_status_t status = {
        .readings = counts->readings,
        .lost = counts->lost,
        .late = counts->late,
        .duplicate = counts->duplicate,
        .odd = counts->odd,
        .restarts = counts->restarts,
        .steps = counts->steps,
        .overruns = self->ring.overrun,
        .waiting = jcal_ring_waiting(&self->ring),
        .period_s = 1e-9f * (float)self->cfg.period_ns * (1.0f + (1e-6f * self->envelope.drift_ppm)),
        .drift_ppm = self->envelope.drift_ppm,
        .bound_ppm = self->envelope.bound_ppm,
        .jitter_s = 1e-6f * self->envelope.jitter_us,
    };
    *out = status;
    return JCAL_OK;
}
