/* SPDX-License-Identifier: MIT */
/// @file
/// State of what follows a sensor's clock; lib/packet/envelope.h has the equations.
#ifndef JCAL_PRIVATE_PACKET_ENVELOPE_H
#define JCAL_PRIVATE_PACKET_ENVELOPE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Blocks of which the fastest packet is kept.
#define JCAL_ENVELOPE_BLOCKS 16u

/// One packet: when its last reading arrived. The low bits; distances are less than 2^31.
typedef struct {
    uint32_t at;  ///< Number of the reading.
    uint32_t us;  ///< Arrival.
} jcal_envelope_point_t;

/// The line below all arrivals.
typedef struct {
    uint64_t anchor_at;     ///< At this reading ...
    uint64_t anchor_us;     ///< ... the line is at this time ...
    float above_us;         ///< ... and this, at most 0.
    float drift_ppm;        ///< Its slope beyond that of the nominal period ...
    float bound_ppm;        ///< ... and what that may be wrong by.
    float jitter_us;        ///< Mean height of arrivals above the line ...
    uint32_t jitter_count;  ///< ... of so many, at most 64.
    jcal_envelope_point_t
        points[JCAL_ENVELOPE_BLOCKS + 1u];  ///< The lowest of each block, oldest first; the last block is open.
    uint32_t count;                         ///< Points, the open one too.
    uint32_t width;                         ///< Readings of a block.
    uint32_t open_at;                       ///< Reading with which the open block began.
    float open_us;                          ///< Height of the open block's point above the line.
    uint64_t high_us;                       ///< Arrival since which all were high above the line.
    bool is_high;
} jcal_envelope_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_PACKET_ENVELOPE_H */
