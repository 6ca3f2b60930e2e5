/* SPDX-License-Identifier: MIT */
/// @file
/// State of the packets of one sensor. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_PACKET_PACKETS_H
#define JCAL_PRIVATE_PACKET_PACKETS_H

#include "jointcal/packet_config.h"
#include "jointcal/private/packet/envelope.h"
#include "jointcal/private/ring.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What stands before the values of a packet in its slot.
typedef struct {
    uint64_t arrival_us;
    uint32_t counter;
    uint32_t count;
} jcal_packet_head_t;

/// Which readings have come.
typedef struct {
    uint64_t next;         ///< Number of the reading that is to come; grows as long as the sensor is known.
    uint64_t seen;         ///< Bit k: reading next - 1 - k has come.
    uint64_t fit_us;       ///< Arrival of the last packet that fitted.
    uint64_t odd_us;       ///< Arrival of the last packet that fitted nothing ...
    uint32_t odd_counter;  ///< ... its counter ...
    uint32_t odd_run;      ///< ... and how many of them went on from each other.
    bool has_next;
} jcal_packet_order_t;

/// Hub time of the last reading.
typedef struct {
    uint64_t at;  ///< Its number.
    uint64_t us;
    uint32_t ns;  ///< What is left, below 1000.
    bool has_last;
} jcal_packet_pace_t;

/// Readings and packets by what became of them; written by pull only.
typedef struct {
    uint32_t readings, lost, late, duplicate, odd, restarts, steps;
} jcal_packet_counts_t;

/// The packet that pull is at.
typedef struct {
    jcal_packet_head_t head;
    uint64_t first;  ///< Number of its first reading.
    uint32_t index;  ///< The next of its readings.
    bool is_open;
} jcal_packet_open_t;

/// The packets of one sensor. Caller-owned, plain; all members are private.
typedef struct {
    jcal_packet_config_t cfg;
    unsigned char *storage;  ///< cfg.packets slots; null: never prepared.
    jcal_ring_t ring;
    jcal_envelope_t envelope;
    jcal_packet_order_t order;
    jcal_packet_pace_t pace;
    jcal_packet_open_t open;
    jcal_packet_counts_t counts;
} jcal_packets_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_PACKET_PACKETS_H */
