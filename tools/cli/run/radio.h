/* SPDX-License-Identifier: MIT */
/// @file
/// What a wireless sensor would have sent: packets of raw readings made from the rows of a recording, with a clock, losses and delays of
/// the sensor's own.
///
/// The sensor reads every `period_us` of its own clock, from its first row on. A reading is interpolated between the two rows around it; where
/// rows are missing, so are readings: the counter counts them, and no packet spans them.
///
/// The result depends on rows, config, seed and the sensor's number alone.
#ifndef JCAL_CLI_RUN_RADIO_H
#define JCAL_CLI_RUN_RADIO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// gyr x, y, z, acc x, y, z.
#define RADIO_VALUES 6
/// Most readings of a packet.
#define RADIO_PER_PACKET_MAX 16
/// Mean time between two bursts, s.
#define RADIO_BURST_EVERY_S 30.0

/// A row of the recording.
typedef struct {
    int64_t t_us;
    float values[RADIO_VALUES]; /* rad/s, m/s^2; not finite: no reading */
} radio_row_t;

/// How the sensor sends.
typedef struct {
    unsigned sensor;           ///< Its number.
    unsigned per_packet;       ///< Readings of a packet, 1 to 16.
    double clock_ppm;          ///< Its clock is slow by so much: its period is longer.
    double delay_us;           ///< A packet is under way for so long, from its last reading on ...
    double jitter_us;          ///< ... and up to so much longer.
    double loss;               ///< Share of packets that get lost, 0 to 1.
    double burst_s;            ///< Once in 30 s it is not heard for so long; 0: never.
    float gyr_step, acc_step;  ///< One step of a raw value, rad/s and m/s^2.
    uint64_t seed;
} radio_config_t;

/// A packet that arrives.
typedef struct {
    int64_t arrival_us; /* of the time of the rows */
    uint32_t counter;   /* of its first reading, 16 bits */
    uint32_t first;     /* that reading is raw[first] */
    uint8_t count;
} radio_packet_t;

/// Start from all zero.
typedef struct {
    radio_row_t *rows;
    size_t row_count;
    double period_us;              ///< Mean distance of rows, missing ones taken into account.
    int16_t (*raw)[RADIO_VALUES];  ///< Readings, also those of packets that got lost.
    radio_packet_t *packets;       ///< In the order of arrival.
    uint32_t readings, missing;    ///< Readings made; those that rows did not tell.
    uint32_t clipped;              ///< Readings beyond the range.
    uint32_t packet_count, lost;   ///< Packets that arrive; that got lost.
    size_t capacity;               /* private */
} radio_t;

/// Adds a row; one whose time is not after that of the row before is left out. False if memory runs out.
bool radio_add(radio_t *self, const radio_row_t *row);

/// The mean distance of rows, us; 0 if there are fewer than two.
double radio_period_us(const radio_t *self);

/// Makes the packets. False if memory runs out.
bool radio_make(radio_t *self, const radio_config_t *config);

/// Releases memory.
void radio_free(radio_t *self);

#endif
