/* SPDX-License-Identifier: MIT */
/* Arm MPS2, AN386: UART 0 of the CMSDK [DDI0479, Cortex-M System Design Kit], 25 MHz. Runs in QEMU as mps2-an386. */
#include "board.h"
#include "cortex_m.h"
#include "systick.h"

#define UART 0x40004000u
#define UART_DATA REGISTER(UART + 0x00u)
#define UART_STATE REGISTER(UART + 0x04u)    /* bit 0: transmit buffer full, bit 1: receive buffer full */
#define UART_CTRL REGISTER(UART + 0x08u)     /* bits 0 to 3: TX on, RX on, TX interrupt, RX interrupt */
#define UART_INTCLEAR REGISTER(UART + 0x0Cu) /* bit 0: TX, bit 1: RX; write 1 to clear */
#define UART_BAUDDIV REGISTER(UART + 0x10u)
#define LEDS REGISTER(0x40028000u) /* FPGA I/O, bits 0 and 1 */

#define CLOCK_HZ 25000000u
#define RX_INTERRUPT 0u
#define TX_INTERRUPT 1u

static void received(void)
{
    UART_INTCLEAR = 2u;
    while ((UART_STATE & 2u) != 0) {
        board_received((uint8_t)UART_DATA);
    }
}

static volatile uint64_t periods;

static void ticked(void)
{
    periods++;
}

/* Only ends a sleep. */
static void sent(void)
{
    UART_INTCLEAR = 1u;
}

extern const vector_t board_vectors[SYSTEM_VECTORS + 2u];
__attribute__((section(".vectors"), used))
const vector_t board_vectors[SYSTEM_VECTORS + 2u] = {SYSTEM_VECTOR_TABLE(ticked), received, sent};

void board_init(void)
{
    systick_start(CLOCK_HZ);
    UART_BAUDDIV = CLOCK_HZ / 115200u;
    UART_CTRL = 0xFu;
    enable_interrupt(RX_INTERRUPT);
    enable_interrupt(TX_INTERRUPT);
}

uint64_t board_now_us(void)
{
    return systick_now_us(CLOCK_HZ, periods);
}

bool board_flash_is_deaf(void)
{
    return false;
}

bool board_can_send(void)
{
    return (UART_STATE & 1u) == 0;
}

void board_send(uint8_t byte)
{
    UART_DATA = byte;
}

/* The interrupt is always on: it comes when the buffer falls empty. */
void board_wake_when_sent(void)
{
}

void board_error_light(void)
{
    LEDS = 3u;
}
