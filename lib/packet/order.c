/* SPDX-License-Identifier: MIT */
/// @file
/// Which reading is which. See packet/order.h.
#include "packet/order.h"

#include "math/scalar.h"
#include "packet/envelope.h"

/// Packets that fit nothing but each other, until they are believed.
#define ODD_RUN 3u
/// Readings that are remembered.
#define SEEN_BITS 64u
/// Numbers begin here, so that those before the first one are numbers too.
#define NUMBER_ROUNDS 2u
#define ROUND_BITS 32u
/// Beyond what any drift makes of the periods of the largest time, 2^30.
#define DRIFT_MOST 1073741824.0f

static bool is_far(int64_t us)
{
    return (us > JCAL_ENVELOPE_FAR_US) || (us < -JCAL_ENVELOPE_FAR_US);
}

/// The low bits of a difference, with sign.
static int32_t wrapped(uint32_t difference, uint8_t bits)
{
    const uint32_t above = 32u - bits;
    const uint32_t top = (uint32_t)1u << (bits - 1u);
    const uint32_t low = (difference << above) >> above;
    return (int32_t)((low ^ top) - top);
}

/// The number of the last reading by counter and clock; false if the packet fits no time.
static bool number_last(const jcal_packet_config_t *cfg, const jcal_envelope_t *envelope,
                        const jcal_packet_head_t *head, uint64_t *last)
{
    const int64_t since_us = (int64_t)(head->arrival_us - envelope->anchor_us);
    if (is_far(since_us)) {
        return false;
    }
    int64_t periods = (since_us * 1000) / (int64_t)cfg->period_ns;
    const float drift = jcal_float_of(periods) * (1e-6f * envelope->drift_ppm); /* below 2^26 */
    periods -= jcal_within(drift, -DRIFT_MOST, DRIFT_MOST) ? (int32_t)drift : 0;
    const uint64_t guess = envelope->anchor_at + (uint64_t)periods;
    const uint32_t counter = head->counter + (head->count - 1u);
    *last = guess + (uint64_t)(int64_t)wrapped(counter - (uint32_t)guess, cfg->counter_bits);
    const float above_us = jcal_envelope_above(envelope, cfg->period_ns, *last, head->arrival_us);
    const float most_us = 1e6f * cfg->max_delay_s;
    return jcal_within(above_us, -most_us, most_us);
}

/// True if an odd packet goes on from the last odd one.
static bool goes_on(const jcal_packet_order_t *self, const jcal_packet_config_t *cfg, const jcal_packet_head_t *head)
{
    const int32_t readings = wrapped(head->counter - self->odd_counter, cfg->counter_bits);
    const int64_t since_us = (int64_t)(head->arrival_us - self->odd_us);
    if ((self->odd_run == 0u) || (readings <= 0) || (since_us < 0) || is_far(since_us)) {
        return false;
    }
    const float off_s = 1e-9f * jcal_float_of((since_us * 1000) - ((int64_t)readings * (int64_t)cfg->period_ns));
    return jcal_within(off_s, -cfg->max_delay_s, cfg->max_delay_s);
}

/// A number beyond all that were, with the counter's low bits.
static uint64_t number_anew(const jcal_packet_order_t *self, const jcal_packet_config_t *cfg, uint32_t counter)
{
    const uint64_t rounds = (self->next >> ROUND_BITS) + NUMBER_ROUNDS;
    const uint32_t above = 32u - cfg->counter_bits;
    return (rounds << ROUND_BITS) + ((counter << above) >> above);
}

jcal_packet_place_t jcal_order_place(jcal_packet_order_t *self, const jcal_packet_config_t *cfg,
                                     const jcal_envelope_t *envelope, const jcal_packet_head_t *head, uint64_t *first)
{
    uint64_t last = 0u;
    if (self->has_next && number_last(cfg, envelope, head, &last)) {
        self->odd_run = 0u;
        *first = last - (head->count - 1u);
        return JCAL_ORDER_FITS;
    }
    self->odd_run = goes_on(self, cfg, head) ? (self->odd_run + 1u) : 1u;
    self->odd_counter = head->counter;
    self->odd_us = head->arrival_us;
    if (self->has_next && (self->odd_run < ODD_RUN)) {
        return JCAL_ORDER_ODD;
    }
    *first = number_anew(self, cfg, head->counter);
    return JCAL_ORDER_ANEW;
}

bool jcal_order_went_back(const jcal_packet_order_t *self, const jcal_packet_config_t *cfg, uint64_t arrival_us)
{
    return self->has_next && ((int64_t)(self->fit_us - arrival_us) > (int32_t)(1e6f * cfg->max_delay_s));
}

void jcal_order_begin(jcal_packet_order_t *self, uint64_t first)
{
    self->next = first;
    self->seen = 0u;
    self->odd_run = 0u;
    self->has_next = true;
}

bool jcal_order_has(jcal_packet_order_t *self, uint64_t at)
{
    const uint64_t back = (self->next - 1u) - at;
    if (back >= SEEN_BITS) {
        return false;
    }
    const uint64_t bit = (uint64_t)1u << back;
    const bool has = (self->seen & bit) != 0u;
    self->seen |= bit;
    return has;
}

uint64_t jcal_order_go_on(jcal_packet_order_t *self, uint64_t at)
{
    const uint64_t lost = at - self->next;
    self->seen = ((lost + 1u) < SEEN_BITS) ? ((self->seen << (lost + 1u)) | 1u) : 1u;
    self->next = at + 1u;
    return lost;
}
