/* SPDX-License-Identifier: MIT */
/// @file
/// The sender's end of the wire to a hub: a socket or a serial line, frames both ways, credit.
#ifndef JCAL_CLI_RUN_HUB_LINK_H
#define JCAL_CLI_RUN_HUB_LINK_H

#include "messages.h"

/// Called for every frame that came in order.
typedef void hub_frame_t(void *context, const frame_t *frame);

typedef struct {
    const char *target;  ///< As the user gave it.
    char error[160];     ///< What went wrong.
    frame_link_t from_hub;
    uint32_t next;   ///< Number of the next frame to send.
    uint32_t limit;  ///< First number that there is no credit for yet.
    uint8_t speaks;  ///< Version of the last frame that came, if it is not this program's; else 0.

    /* Private. */
    int descriptor;
    frame_decoder_t decoder;
    bool linked; /* hello has come: numbers from the hub are followed */
    int64_t heard_us;
    hub_frame_t *on_frame;
    void *context;
} hub_link_t;

/// Opens `unix:PATH`, `tcp:HOST:PORT` or a serial device. False with `error` set.
bool hub_link_open(hub_link_t *link, const char *target, unsigned long baud);

/// True if `target` is written as one of the three; says nothing about whether it exists.
bool hub_link_target_ok(const char *target);

/// Whom to tell of frames.
void hub_link_listen(hub_link_t *link, hub_frame_t *on_frame, void *context);

/// Sends a frame, reading meanwhile so that neither side waits for the other. False with `error` set.
bool hub_link_send(hub_link_t *link, frame_type_t type, const frame_writer_t *payload);

/// Reads what comes within so many microseconds, or until something has come. False with `error` set.
bool hub_link_wait(hub_link_t *link, int64_t us);

/// Microseconds since the hub last said something.
int64_t hub_link_silence_us(const hub_link_t *link);

/// Microseconds of a clock that never jumps.
int64_t hub_link_clock_us(void);

void hub_link_close(hub_link_t *link);

#endif
