/* SPDX-License-Identifier: MIT */
/// @file
/// Which reading is which: the counter without its wraps, what is new, late or there already. Private.
///
/// The number of a reading is the one with the counter's low bits that is nearest to what the sensor's clock says of the arrival: so a
/// loss of many rounds of a short counter is counted rightly. A packet that is more than `max_delay_s` beside the clock fits nothing; three
/// of them that go on from each other are a sensor that began anew.
#ifndef JCAL_PACKET_ORDER_H
#define JCAL_PACKET_ORDER_H

#include "jointcal/private/packet/packets.h"

/// What a packet is.
typedef enum {
    JCAL_ORDER_FITS = 0,
    JCAL_ORDER_ODD = 1,  ///< Fits nothing.
    JCAL_ORDER_ANEW = 2  ///< The first one, or of a sensor that began anew.
} jcal_packet_place_t;

/// Finds the number of a packet's first reading. Outputs: first, unless odd.
jcal_packet_place_t jcal_order_place(jcal_packet_order_t *self, const jcal_packet_config_t *cfg,
                                     const jcal_envelope_t *envelope, const jcal_packet_head_t *head, uint64_t *first);

/// True if the hub's clock went back since the last packet that fitted, by more than `max_delay_s`.
bool jcal_order_went_back(const jcal_packet_order_t *self, const jcal_packet_config_t *cfg, uint64_t arrival_us);

/// What is numbered anew begins with this reading.
void jcal_order_begin(jcal_packet_order_t *self, uint64_t first);

/// A reading that is before the next one: true if it has come already. Remembers it.
bool jcal_order_has(jcal_packet_order_t *self, uint64_t at);

/// The next reading, or one beyond it; returns how many are lost before it.
uint64_t jcal_order_go_on(jcal_packet_order_t *self, uint64_t at);

#endif /* JCAL_PACKET_ORDER_H */
