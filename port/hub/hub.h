/* SPDX-License-Identifier: MIT */
/// @file
/// The hub's application, the same on a PC and on every board: bytes in, frames, samples, estimates, bytes out.
///
/// Two sides. hub_receive belongs into the interrupt that receives bytes: it decodes, counts, and pushes a sample at once
/// if the estimator is idle, else puts it into a queue. hub_work and hub_send belong into the main loop: hub_work steps
/// the estimator and writes answers, hub_send hands over the bytes to transmit. A sample is pushed only when everything of
/// the one before is done, so that the same samples give the same estimates to the bit, however slow the hub is; the
/// sender is held back by credit (docs/PROTOCOL.md).
///
/// One core, and an interrupt that runs to its end; nothing here masks interrupts.
#ifndef JCAL_HUB_HUB_H
#define JCAL_HUB_HUB_H

#include "frame.h"
#include "messages.h"

/// Frames that a sender may have on their way. Requests are exempt, hence the larger queue.
#define HUB_CREDIT 24u
/// Places in the queue, one of which stays empty; a power of two.
#define HUB_QUEUE 32u
/// Bytes that may wait for transmission; a power of two.
#define HUB_OUT_BYTES 1024u

/// Private: a frame that waits for the main loop.
typedef struct {
    uint8_t type;
    uint32_t sequence;
    union {
        jcal_pair_t pair;
        message_start_t start;
        uint32_t token;
    } as;
} hub_item_t;

/// All members are private. All zero is its start.
typedef struct {
    /* Written by the receiving side. */
    frame_decoder_t decoder;
    frame_link_t link;
    uint32_t nonce;
    uint32_t unknown;
    uint32_t overrun;
    bool linked;  ///< A start was received.
    hub_item_t queue[HUB_QUEUE];
    volatile uint32_t queued;
    hub_item_t direct;             ///< A sample that was pushed on reception ...
    volatile bool direct_pending;  ///< ... and waits for its step.
    bool accepted;                 ///< The sample that was pushed last is in the inbox.

    /* Written by the main loop. */
    volatile uint32_t taken;
    volatile bool busy;  ///< The estimator is being worked on.
    jcal_hinge_auto_t hinge;
    message_start_t config;
    bool running;
    bool has_time;
    jcal_calibration_t status;
    uint64_t latest_us;  ///< Largest time of a sample.
    uint64_t next_us;    ///< When an estimate is due.
    uint64_t pair_us;    ///< Time of the last sample, for one without.
    uint32_t sequence;   ///< Of the next frame to send.
    uint32_t limit;      ///< Credit last given.
    uint8_t out[HUB_OUT_BYTES];
    uint32_t out_written;
    uint32_t out_taken;
} hub_t;

void hub_init(hub_t *self);

/// Takes in one received byte. Bounded; may run in an interrupt that preempts the functions below.
void hub_receive(hub_t *self, uint8_t byte);

/// Does one piece of work; false if there is nothing to do, or no room for an answer before bytes are sent.
bool hub_work(hub_t *self);

/// True if hub_work has something to do: look with interrupts masked before going to sleep.
bool hub_waiting(const hub_t *self);

/// The next byte to transmit; false if there is none.
bool hub_send(hub_t *self, uint8_t *byte);

/// Bytes that wait for transmission.
uint32_t hub_send_count(const hub_t *self);

#endif
