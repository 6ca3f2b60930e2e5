/* SPDX-License-Identifier: MIT */
/// @file
/// A simulated sensor, its radio, and the hub's packets: clocks in double, delays from one side.
#ifndef UNIT_PACKET_RADIO_H
#define UNIT_PACKET_RADIO_H

#include "jointcal/packet.h"

#include <string.h>

/// Most packets that wait.
#define RADIO_PACKETS 64

/// A sensor and how its packets come.
typedef struct {
    double period_s;    ///< Nominal.
    double drift_ppm;   ///< Of the sensor's clock: its periods are longer by that.
    double delay_s;     ///< Shortest ...
    double jitter_s;    ///< ... and what is added, evenly distributed.
    double every_s;     ///< Packets arrive only at multiples of this: bursts; 0: at any time.
    unsigned count;     ///< Readings of a packet.
    unsigned bits;      ///< Of the counter.
    uint32_t counter0;  ///< Counter of the first reading.
    uint64_t hub0_us;   ///< Hub time of reading 0.
    uint64_t sent;      ///< Readings sent so far; the next packet begins with this one.
    double last_s;      ///< When the last packet arrived; the radio keeps the order.
    uint32_t random;
} radio_t;

static inline radio_t radio_begin(void)
{
    const radio_t radio = {
        .period_s = 0.01, .delay_s = 0.005, .jitter_s = 0.025, .count = 1, .bits = 16, .hub0_us = 1000000, .random = 1};
    return radio;
}

/* In [0, 1). */
static inline double radio_random(radio_t *radio)
{
    radio->random = 1664525u * radio->random + 1013904223u;
    return (double)(radio->random >> 8) / 16777216.0;
}

/* True time of a reading since hub0, s. */
static inline double radio_time(const radio_t *radio, uint64_t reading)
{
    return (double)reading * radio->period_s * (1.0 + 1e-6 * radio->drift_ppm);
}

static inline uint32_t radio_counter(const radio_t *radio, uint64_t reading)
{
    const uint32_t counter = radio->counter0 + (uint32_t)reading;
    return (radio->bits < 32) ? (counter & ((1u << radio->bits) - 1u)) : counter;
}

/* The values of reading n: gyr x is n, gyr y its negative, the others are a pattern. Small enough for 16 bits and exact. */
static inline void radio_values(uint64_t reading, float si[6])
{
    const float n = (float)(reading % 30000u);
    const float values[6] = {n, -n, 1.0f, 2.0f, -3.0f, 9.0f};
    memcpy(si, values, sizeof values);
}

/* Values of a packet of readings from `first` on; they live in `values`. */
static inline jcal_packet_t radio_packet(const radio_t *radio, uint64_t first, uint64_t arrival_us, float values[96])
{
    for (unsigned k = 0; k < radio->count; ++k) {
        radio_values(first + k, &values[6 * k]);
    }
    const jcal_packet_t packet = {
        .arrival_us = arrival_us, .counter = radio_counter(radio, first), .count = (uint8_t)radio->count, .si = values};
    return packet;
}

/* When the packet whose last reading is `last` arrives, s since hub0. */
static inline double radio_arrival(radio_t *radio, uint64_t last)
{
    double t_s = radio_time(radio, last) + radio->delay_s + radio->jitter_s * radio_random(radio);
    if (radio->every_s > 0.0) {
        const double slots = t_s / radio->every_s;
        const double whole = (double)(uint64_t)slots;
        t_s = radio->every_s * ((slots > whole) ? whole + 1.0 : whole);
    }
    radio->last_s = (t_s > radio->last_s) ? t_s : radio->last_s;
    return radio->last_s;
}

/* The next packet of the sensor. */
static inline jcal_packet_t radio_next(radio_t *radio, float values[96])
{
    const uint64_t first = radio->sent;
    radio->sent += radio->count;
    const double t_s = radio_arrival(radio, radio->sent - 1u);
    return radio_packet(radio, first, radio->hub0_us + (uint64_t)(t_s * 1e6), values);
}

/* A config that fits. */
static inline jcal_packet_config_t radio_config(const radio_t *radio)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.period_ns = (uint32_t)(radio->period_s * 1e9 + 0.5);
    config.counter_bits = (uint8_t)radio->bits;
    config.per_packet = 16;
    config.packets = RADIO_PACKETS;
    config.max_delay_s = (radio->bits == 8) ? 1.0f : 2.0f;
    return config;
}

#endif /* UNIT_PACKET_RADIO_H */
