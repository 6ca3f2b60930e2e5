/* SPDX-License-Identifier: MIT */
/// @file
/// What the hub has to say, to the board's UART.
#ifndef JCAL_BOARDS_SEND_H
#define JCAL_BOARDS_SEND_H

#include "board.h"
#include "hub.h"

static inline void send_what_fits(hub_t *hub)
{
    uint8_t byte = 0;
    while (board_can_send() && hub_send(hub, &byte)) {
        board_send(byte);
    }
}

#endif
