/* SPDX-License-Identifier: MIT */
/* A board to begin with: it compiles and does nothing. Copy the folder, add its name to ../CMakeLists.txt, fill in every
 * place marked TO FILL IN, and the memories in memory.ld. ../stm32f405/board.c is an example of the same length. */
#include "board.h"
#include "cortex_m.h"

/* TO FILL IN: number of the UART's interrupt. */
#define UART_INTERRUPT 0u

static void uart(void)
{
    /* TO FILL IN: while the UART has a byte, hand it over:
     *     board_received((uint8_t)UART_DATA);
     * Clear whatever the UART wants cleared, errors included; damaged bytes show in the CRC. If the interrupt for an empty
     * transmitter stays pending, switch it off here: board_wake_when_sent switches it on again. */
}

#define INTERRUPTS (UART_INTERRUPT + 1u)
extern const vector_t board_vectors[SYSTEM_VECTORS + INTERRUPTS];
__attribute__((section(".vectors"), used)) const vector_t board_vectors[SYSTEM_VECTORS + INTERRUPTS] = {
    SYSTEM_VECTOR_TABLE(
        start_fault), /* TO FILL IN: the handler of the processor's own timer, if board_now_us uses it (ticked of systick.h) */
    [SYSTEM_VECTORS + UART_INTERRUPT] = uart};

void board_init(void)
{
    /* TO FILL IN: clock, pins, UART with 115200 baud, 8 bits, no parity, one stop bit, its receive interrupt. The UART must
     * not lose bytes while another interrupt runs: no other interrupt may take longer than one byte, 87 us. */
    enable_interrupt(UART_INTERRUPT);
}

uint64_t board_now_us(void)
{
    /* TO FILL IN: microseconds since the start, from a timer that goes on in sleep and interrupts at least every 10 ms. ../common/systick.h
     * does it where the processor's own timer goes on (../stm32f405/board.c); ../nrf52840/board.c has another timer. While this says
     * 0, everything works with senders that give arrivals, but a deaf flash is only written when all granted frames have come. */
    return 0;
}

bool board_flash_is_deaf(void)
{
    return true; /* TO FILL IN: false if interrupts are served while flash is erased, as from another bank or from RAM. */
}

bool board_can_send(void)
{
    return true; /* TO FILL IN: is the transmit register empty? */
}

void board_send(uint8_t byte)
{
    (void)byte; /* TO FILL IN: write it to the transmit register. */
}

void board_wake_when_sent(void)
{
    /* TO FILL IN: switch on the interrupt for an empty transmit register, unless it is always on. */
}

void board_error_light(void)
{
    /* TO FILL IN: something that can be seen without a debugger. */
}
