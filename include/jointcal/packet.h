/* SPDX-License-Identifier: MIT */
/// @file
/// Packets of a wireless sensor become readings with times of the hub.
///
/// How it is used:
///
///     static jcal_packets_t thigh;
///     static unsigned char thigh_storage[JCAL_PACKETS_STORAGE_BYTES(16u, 4u, JCAL_PACKET_RAW)];
///     jcal_packet_config_t config = jcal_packet_config_default();
///     config.per_packet = 4u;
///     config.values = JCAL_PACKET_RAW;
///     (void)jcal_chip_scale("LSM6DSV", 2000.0f, 16.0f, &config.scale);
///     (void)jcal_packets_init(&thigh, &config, thigh_storage, sizeof thigh_storage);
///
///     (void)jcal_packets_push(&thigh, &packet);                  in the interrupt of the radio
///
///     do {                                                        in the task
///         status = jcal_packets_pull(&thigh, &reading);
///         if (status == JCAL_OK) {
///             (void)jcal_sensor_push(&sensor, &reading);
///         }
///     } while ((status == JCAL_OK) || (status == JCAL_REJECTED));
///
/// The sensor's clock has an offset and a drift; a packet arrives later than it was sent, never earlier. So the clock is the line below all
/// arrivals of the last one to two minutes, over the counter. What the fastest packet needs cannot be told from an offset: hub times
/// are late by that, and two sensors on one kind of radio by the same.
///
/// Hub times strictly increase. They follow the line by at most 1 % of the time between two readings, so that a step of the clock becomes
/// none of the motion; only if they are more than 50 ms off, as after a radio that became slower, they jump there, or wait by 10 % of a
/// period. Lost readings are a gap in time, as long as what was lost. A sensor that begins anew gets a new line, at once. Only a hub whose
/// own clock goes back by more than `max_delay_s` makes times go back, and it counts as a restart.
///
/// With delays of 5 to 30 ms and a drift of 500 ppm times are right to 0.3 ms rms from 30 s on, the drift to 9 ppm after two minutes
/// (unit/packet/test_clock.c). Where packets wait for slots of the radio that beat with the sensor's period, to 4 ms.
///
/// Cost: 0.4 KiB of state besides the storage.
/// Threads: as types.h says: one push may run beside pull or get; pull and get belong to one task.
#ifndef JCAL_PACKET_H
#define JCAL_PACKET_H

#include "jointcal/packet_config.h"
#include "jointcal/private/packet/packets.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Most readings of one packet.
#define JCAL_PACKET_READINGS_MAX 16u
/// Values of a reading: gyr x, y, z, acc x, y, z.
#define JCAL_PACKET_VALUES 6u

/// A packet as it came. One of `raw` and `si` is read, as the config's `values` says.
typedef struct {
    uint64_t arrival_us;  ///< Time at the hub, us, any origin; it does not go back from packet to packet.
    uint32_t counter;     ///< The sensor's counter of the first reading; bits beyond `counter_bits` are ignored.
    uint8_t count;        ///< Readings, 1 to the config's `per_packet`, one period of the sensor apart.
    const int16_t *raw;   ///< count x 6 raw values.
    const float *si;      ///< count x 6 values in rad/s and m/s^2; not a number is passed on.
} jcal_packet_t;

/// What became of the packets. Readings that were put in = readings + late + duplicate + odd + those that wait.
typedef struct {
    uint32_t readings;   ///< Readings that pull gave out.
    uint32_t lost;       ///< Readings that had not come when a later one did.
    uint32_t late;       ///< Readings that came after a later one, and were dropped; most of them count as lost too.
    uint32_t duplicate;  ///< Readings that came once more, and were dropped; after 64 others they count as late.
    uint32_t odd;        ///< Readings of packets that fitted no time, and were dropped.
    uint32_t
        restarts;  ///< Times that the counter began anew: three packets went on from each other, and not from those before.
    uint32_t
        steps;  ///< Times that the clock was learnt anew while the counter went on: packets came otherwise than before.
    uint32_t overruns;  ///< Packets that found no room; written by push.
    uint32_t waiting;   ///< Packets that wait.
    float period_s;     ///< Period of the sensor by the hub's clock, s.
    float drift_ppm;    ///< By how much that is longer than the nominal one, ppm; 0 as long as nothing is known.
    float bound_ppm;    ///< Bound of the drift's error, ppm; the config's `max_drift_ppm` as long as nothing is known.
    float jitter_s;     ///< Mean time that packets were under way beyond the fastest, s.
} jcal_packets_status_t;

/// Bytes of one value.
#define JCAL_PACKET_VALUE_BYTES(values) (((values) == JCAL_PACKET_RAW) ? sizeof(int16_t) : sizeof(float))

/// Bytes of storage for fields of a config; usable in array sizes: 1 KiB for 16 packets of 4 raw readings.
#define JCAL_PACKETS_STORAGE_BYTES(packets, per_packet, values)                                                        \
    ((size_t)(packets) *                                                                                               \
     (sizeof(jcal_packet_head_t) + ((size_t)(per_packet)*JCAL_PACKET_VALUES * JCAL_PACKET_VALUE_BYTES(values))))

/// Prepares the packets of a sensor; whatever `self` and the storage held before is lost.
/// A struct that this never prepared, all zero: every call returns JCAL_ERR_ARG.
///
/// Inputs:   storage, of any alignment, of at least JCAL_PACKETS_STORAGE_BYTES of the config; it belongs to `self` as long as `self` is used.
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_packet_config_check says which field); JCAL_ERR_STORAGE (too small); self untouched.
/// Threads:  nothing else runs on `self` meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_packets_init(jcal_packets_t *self, const jcal_packet_config_t *config, void *storage,
                                                size_t storage_bytes);

/// Copies a packet for pull. May run in an interrupt that preempts pull; no floating point.
///
/// Returns:  JCAL_OK; JCAL_ERR_FULL (counted as overrun); JCAL_ERR_ARG (null, never prepared, count out of range); those leave no trace.
/// Cost:     constant but for the copy, at most 384 bytes: 110 instructions on a Cortex-M4F for one raw reading, 470 for 16.
/// Threads:  may preempt pull and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_packets_push(jcal_packets_t *self, const jcal_packet_t *packet);

/// The next reading, and its time at the hub.
///
/// Outputs:  out; untouched unless JCAL_OK.
/// Returns:  JCAL_OK; JCAL_REJECTED: a packet was dropped, call again; JCAL_IDLE: no packet waits; JCAL_ERR_ARG (null, never prepared).
/// Cost:     constant: about 850 instructions on a Cortex-M4F for the first reading of a packet, 400 for each other; every 0.25 to 8 s, when
///           a line is drawn, 3,000. Stack <= 0.5 KiB.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_packets_pull(jcal_packets_t *self, jcal_reading_t *out);

/// What became of the packets so far. Errors: JCAL_ERR_ARG (null, never prepared); out untouched.
/// Threads:  the task of pull, or behind a lock; a push may preempt it.
jcal_status_t jcal_packets_get(const jcal_packets_t *self, jcal_packets_status_t *out);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PACKET_H */
