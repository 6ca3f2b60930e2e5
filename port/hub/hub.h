/* SPDX-License-Identifier: MIT */
/// @file
/// The hub's application, the same on a PC and on every board: bytes in, frames, sessions, answers, bytes out.
///
/// Two sides. hub_receive belongs into the interrupt that receives bytes: it decodes, counts, and puts what came into a queue. hub_work and
/// hub_send belong into the main loop or a task: hub_work does one bounded piece of work, hub_send hands over the bytes to transmit. What
/// came is worked off in order, each when everything of the one before is done, so that the same frames give the same answers to the
/// bit, however slow the hub is; the sender is held back by credit (docs/PROTOCOL.md).
///
/// A session is of one of two kinds: a pair session (hub_pair.h) has one hinge and both sensors' readings at the same times; a body session
/// (hub_body.h) has a table of sensors and joints, and each sensor's packets.
///
/// One core, and an interrupt that runs to its end; nothing here masks interrupts.
#ifndef JCAL_HUB_HUB_H
#define JCAL_HUB_HUB_H

#include "frame.h"
#include "hub_body.h"
#include "hub_out.h"
#include "hub_pair.h"

/// Frames that a sender may have on their way. Requests are exempt, hence the larger queue.
#define HUB_CREDIT 24u
/// Places in the queue, one of which stays empty; a power of two.
#define HUB_QUEUE 32u

/// Private: a frame that waits for the main loop, and the hub's time when it came.
typedef struct {
    uint8_t type, size;
    uint32_t sequence;
    uint64_t now_us;
    uint8_t payload[FRAME_PAYLOAD_MAX];
} hub_item_t;

/// All members are private. Prepared by hub_init.
typedef struct {
    /* Written by the receiving side. */
    frame_decoder_t decoder;
    frame_link_t link;
    uint32_t nonce;
    uint32_t unknown;
    uint32_t overrun;
    volatile uint32_t now_high, now_low;  ///< The hub's clock, as far as it was told, us.
    volatile uint32_t heard_us;           ///< When the last byte came, low word.
    bool linked;                          ///< A start or begin was received.
    bool told;                            ///< Another version was answered on this stream.
    hub_item_t queue[HUB_QUEUE];
    volatile uint32_t queued;
    volatile uint8_t refused_version;  ///< To be answered; 0: none.

    /* Written by the main loop. */
    volatile uint32_t taken;
    enum { HUB_NO_SESSION = 0, HUB_PAIR = 1, HUB_BODY = 2 } session;
    union {
        hub_pair_t pair;
        hub_body_t body;
    } of;
    jcal_flash_t flash;
    bool has_flash;
    bool flash_is_deaf;      ///< The processor stands still while flash is written.
    bool is_held;            ///< Flash is to be written, and all else waits until what is under way has come.
    uint32_t strange;        ///< Frames of the other kind of session, or with wrong contents.
    uint32_t item_sequence;  ///< Of the frame that is worked at.
    uint32_t limit;          ///< Credit last given.
    hub_out_t out;
} hub_t;

/// Begins with nothing; a flash has to be set anew.
void hub_init(hub_t *self);

/// Where calibrations are kept; the struct is copied. `is_deaf`: received bytes are lost while it erases or programs, so that the sender must
/// be silent then. Before the first byte.
void hub_set_flash(hub_t *self, const jcal_flash_t *flash, bool is_deaf);

/// What the hub's clock says, us, any origin: before hub_receive, and before hub_work. It stamps packets whose sender leaves the arrival to the hub,
/// and says when the wire is silent enough for a flash that makes deaf. Of the receiving side: elsewhere with interrupts masked.
void hub_time(hub_t *self, uint64_t now_us);

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
