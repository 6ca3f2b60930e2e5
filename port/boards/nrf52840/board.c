/* SPDX-License-Identifier: MIT */
/* nRF52840 [Product Specification]: UART0 (the one without DMA, which tells of every byte) on P0.06 (TX) and P0.08 (RX), the
 * pins of the nRF52840 DK's USB serial port; error light P0.13, its LED1, active low.
 *
 * Not run so far: neither on the board, nor in an emulator. */
#include "board.h"
#include "cortex_m.h"

#define CLOCK 0x40000000u
#define CLOCK_HFCLKSTART REGISTER(CLOCK + 0x000u)
#define CLOCK_HFCLKSTARTED REGISTER(CLOCK + 0x100u)

#define NVMC_ICACHECNF REGISTER(0x4001E540u) /* bit 0: instruction cache on; off after reset */

#define UART 0x40002000u
#define UART_STARTRX REGISTER(UART + 0x000u)
#define UART_STARTTX REGISTER(UART + 0x008u)
#define UART_RXDRDY REGISTER(UART + 0x108u)
#define UART_TXDRDY REGISTER(UART + 0x11Cu)
#define UART_ERROR REGISTER(UART + 0x124u)
#define UART_INTENSET REGISTER(UART + 0x304u) /* bit 2: RXDRDY, bit 7: TXDRDY, bit 9: ERROR */
#define UART_ERRORSRC REGISTER(UART + 0x480u) /* write 1 to clear */
#define UART_ENABLE REGISTER(UART + 0x500u)
#define UART_PSEL_TXD REGISTER(UART + 0x50Cu)
#define UART_PSEL_RXD REGISTER(UART + 0x514u)
#define UART_RXD REGISTER(UART + 0x518u)
#define UART_TXD REGISTER(UART + 0x51Cu)
#define UART_BAUDRATE REGISTER(UART + 0x524u)
#define UART_CONFIG REGISTER(UART + 0x56Cu) /* 0: no flow control, no parity, one stop bit */
#define UART_BAUD_115200 0x01D7E000u
#define UART_ENABLED 4u
#define UART_INTERRUPT 2u

#define GPIO_P0 0x50000000u
#define P0_OUTSET REGISTER(GPIO_P0 + 0x508u)
#define P0_OUTCLR REGISTER(GPIO_P0 + 0x50Cu)
#define P0_DIRSET REGISTER(GPIO_P0 + 0x518u)
#define TXD_PIN 6u
#define RXD_PIN 8u
#define LIGHT_PIN 13u

/* A byte is on its way: TXDRDY has not come since it was written. Written by the main loop; start_fault may look. */
static volatile bool sending;

/* The receiver holds up to six bytes; each reading of RXD makes room and, if there is another, a new event. */
static void uart(void)
{
    if (UART_ERROR != 0) {
        UART_ERROR = 0;
        UART_ERRORSRC = UART_ERRORSRC; /* what was damaged shows in the CRC */
    }
    while (UART_RXDRDY != 0) {
        UART_RXDRDY = 0;
        board_received((uint8_t)UART_RXD);
    }
    if (UART_TXDRDY != 0) {
        UART_TXDRDY = 0;
        (void)UART_TXDRDY; /* the write has arrived before the interrupt ends */
        sending = false;
    }
}

/* Timer 0 counts microseconds in 32 bits; SysTick stands still while the processor sleeps. Compare register 0 ends a sleep every 10 ms,
 * register 1 takes the time. */
#define TIMER 0x40008000u
#define TIMER_START REGISTER(TIMER + 0x000u)
#define TIMER_CAPTURE1 REGISTER(TIMER + 0x044u)
#define TIMER_COMPARE0 REGISTER(TIMER + 0x140u)
#define TIMER_INTENSET REGISTER(TIMER + 0x304u)  /* bit 16: COMPARE0 */
#define TIMER_BITMODE REGISTER(TIMER + 0x508u)   /* 3: 32 bits */
#define TIMER_PRESCALER REGISTER(TIMER + 0x510u) /* 16 MHz by 2^n */
#define TIMER_CC0 REGISTER(TIMER + 0x540u)
#define TIMER_CC1 REGISTER(TIMER + 0x544u)
#define TIMER_INTERRUPT 8u
#define WAKE_US 10000u

/* Time last taken; the timer wraps once in 71 minutes and is looked at every 10 ms. */
static volatile uint64_t time_us;

static void timer(void)
{
    TIMER_COMPARE0 = 0;
    (void)TIMER_COMPARE0; /* the write has arrived before the interrupt ends */
    TIMER_CC0 = (uint32_t)board_now_us() + WAKE_US;
}

#define INTERRUPTS (TIMER_INTERRUPT + 1u)
extern const vector_t board_vectors[SYSTEM_VECTORS + INTERRUPTS];
__attribute__((section(".vectors"), used)) const vector_t board_vectors[SYSTEM_VECTORS + INTERRUPTS] = {
    SYSTEM_VECTOR_TABLE(start_fault), [SYSTEM_VECTORS + UART_INTERRUPT] = uart,
    [SYSTEM_VECTORS + TIMER_INTERRUPT] = timer};

uint64_t board_now_us(void)
{
    TIMER_CAPTURE1 = 1;
    time_us += (uint32_t)(TIMER_CC1 - (uint32_t)time_us);
    return time_us;
}

/* The processor is halted while the controller is at work. */
bool board_flash_is_deaf(void)
{
    return true;
}

static void start_timer(void)
{
    TIMER_BITMODE = 3;
    TIMER_PRESCALER = 4;
    TIMER_CC0 = WAKE_US;
    TIMER_INTENSET = UINT32_C(1) << 16;
    enable_interrupt(TIMER_INTERRUPT);
    TIMER_START = 1;
}

void board_init(void)
{
    NVMC_ICACHECNF = 1;
    /* The crystal, because the internal oscillator is too coarse for a UART. */
    CLOCK_HFCLKSTARTED = 0;
    CLOCK_HFCLKSTART = 1;
    while (CLOCK_HFCLKSTARTED == 0) {
    }
    start_timer();
    P0_OUTSET = (1u << TXD_PIN) | (1u << LIGHT_PIN);
    P0_DIRSET = (1u << TXD_PIN) | (1u << LIGHT_PIN);
    UART_PSEL_TXD = TXD_PIN;
    UART_PSEL_RXD = RXD_PIN;
    UART_CONFIG = 0;
    UART_BAUDRATE = UART_BAUD_115200;
    UART_ENABLE = UART_ENABLED;
    UART_INTENSET = (1u << 2) | (1u << 7) | (1u << 9);
    enable_interrupt(UART_INTERRUPT);
    UART_STARTTX = 1;
    UART_STARTRX = 1;
}

/* With interrupts masked, as in start_fault, the flag is looked at directly. */
bool board_can_send(void)
{
    return !sending || UART_TXDRDY != 0;
}

void board_send(uint8_t byte)
{
    UART_TXDRDY = 0;
    sending = true;
    UART_TXD = byte;
}

/* The interrupt is always on. */
void board_wake_when_sent(void)
{
}

void board_error_light(void)
{
    P0_OUTCLR = 1u << LIGHT_PIN;
    P0_DIRSET = 1u << LIGHT_PIN;
}
