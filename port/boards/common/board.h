/* SPDX-License-Identifier: MIT */
/// @file
/// What the hub's main program needs from a board: one UART, a clock, a way to sleep, a light; its flash is in flash.h. Each board implements it in board.c.
#ifndef JCAL_BOARDS_BOARD_H
#define JCAL_BOARDS_BOARD_H

#include <stdbool.h>
#include <stdint.h>

/// Where the board hands over received bytes: to be called in the UART's interrupt. Implemented by common/main.c.
void board_received(uint8_t byte);

/// Starts clocks and UART, 115200 baud, 8N1, with its receive interrupt on. All interrupts have the same priority.
void board_init(void);

/// Time since the start, us; it never goes back. Called in the UART's interrupt, or with interrupts masked. Its timer ends a sleep at
/// least every 10 ms.
uint64_t board_now_us(void);

/// True if the processor, interrupts included, stands still while flash is erased or programmed.
bool board_flash_is_deaf(void);

/// Can the UART take another byte?
bool board_can_send(void);

/// Hands a byte to the UART; only after board_can_send.
void board_send(uint8_t byte);

/// Asks for an interrupt when the UART can take another byte: it ends a sleep, and has nothing else to do.
void board_wake_when_sent(void);

/// The light that says that something is wrong.
void board_error_light(void);

#endif
