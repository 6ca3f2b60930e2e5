/* SPDX-License-Identifier: MIT */
/* STM32F405 [RM0090]: USART1 on PA9 (TX) and PA10 (RX), error light on PC13, active low, as on many boards.
 *
 * The clock is the internal 16 MHz oscillator that runs after reset: 1 % accurate, enough for 115200 baud and for one
 * joint at 100 Hz. Runs in QEMU as netduinoplus2. */
#include "board.h"
#include "cortex_m.h"
#include "systick.h"

#define RCC 0x40023800u
#define RCC_AHB1ENR REGISTER(RCC + 0x30u) /* bit 0: GPIOA, bit 2: GPIOC */
#define RCC_APB2ENR REGISTER(RCC + 0x44u) /* bit 4: USART1 */

#define GPIOA 0x40020000u
#define GPIOC 0x40020800u
#define GPIO_MODER(port) REGISTER((port) + 0x00u) /* two bits per pin: 0 input, 1 output, 2 alternate function */
#define GPIO_BSRR(port) REGISTER((port) + 0x18u)  /* bits 16 to 31 reset pins */
#define GPIO_AFRH(port) REGISTER((port) + 0x24u)  /* four bits per pin from pin 8 on */
#define USART1_FUNCTION 7u
#define LIGHT_PIN 13u

#define USART1 0x40011000u
#define USART_SR REGISTER(USART1 + 0x00u) /* bit 5: received, bit 7: transmit register empty */
#define USART_DR REGISTER(USART1 + 0x04u)
#define USART_BRR REGISTER(USART1 + 0x08u)
#define USART_CR1 REGISTER(USART1 + 0x0Cu)
#define SR_RXNE (1u << 5)
#define SR_TXE (1u << 7)
#define SR_ERRORS 0xFu /* parity, framing, noise, overrun: cleared by reading SR, then DR */
#define CR1_RE (1u << 2)
#define CR1_TE (1u << 3)
#define CR1_RXNEIE (1u << 5)
#define CR1_TXEIE (1u << 7)
#define CR1_UE (1u << 13)

#define CLOCK_HZ 16000000u
#define USART1_INTERRUPT 37u

static void usart(void)
{
    if ((USART_SR & (SR_RXNE | SR_ERRORS)) != 0) {
        board_received((uint8_t)USART_DR);
    }
    /* The wish to be woken is fulfilled; the flag itself would come again and again. */
    USART_CR1 &= ~CR1_TXEIE;
}

static volatile uint64_t periods;

static void ticked(void)
{
    periods++;
}

#define INTERRUPTS (USART1_INTERRUPT + 1u)
extern const vector_t board_vectors[SYSTEM_VECTORS + INTERRUPTS];
__attribute__((section(".vectors"), used)) const vector_t board_vectors[SYSTEM_VECTORS + INTERRUPTS] = {
    SYSTEM_VECTOR_TABLE(ticked), [SYSTEM_VECTORS + USART1_INTERRUPT] = usart};

void board_init(void)
{
    systick_start(CLOCK_HZ);
    RCC_AHB1ENR |= (1u << 0) | (1u << 2);
    RCC_APB2ENR |= 1u << 4;
    (void)RCC_APB2ENR; /* a clock takes two cycles to come */
    GPIO_AFRH(GPIOA) = (GPIO_AFRH(GPIOA) & ~0xFF0u) | (USART1_FUNCTION << 4) | (USART1_FUNCTION << 8);
    GPIO_MODER(GPIOA) = (GPIO_MODER(GPIOA) & ~(0xFu << 18)) | (0xAu << 18);
    USART_BRR = (CLOCK_HZ + 115200u / 2u) / 115200u;
    USART_CR1 = CR1_UE | CR1_TE | CR1_RE | CR1_RXNEIE;
    enable_interrupt(USART1_INTERRUPT);
}

uint64_t board_now_us(void)
{
    return systick_now_us(CLOCK_HZ, periods);
}

bool board_flash_is_deaf(void)
{
    return true; /* code is in flash, and the bus waits for it */
    ;
}

bool board_can_send(void)
{
    return (USART_SR & SR_TXE) != 0;
}

void board_send(uint8_t byte)
{
    USART_DR = byte;
}

/* Called with interrupts on: between this and the sleep the interrupt may come and switch itself off, and then the sleep
 * is left out, because the register is empty. */
void board_wake_when_sent(void)
{
    USART_CR1 |= CR1_TXEIE;
}

void board_error_light(void)
{
    RCC_AHB1ENR |= 1u << 2;
    (void)RCC_AHB1ENR;
    GPIO_BSRR(GPIOC) = UINT32_C(1) << (16u + LIGHT_PIN);
    GPIO_MODER(GPIOC) = (GPIO_MODER(GPIOC) & ~(3u << (2u * LIGHT_PIN))) | (1u << (2u * LIGHT_PIN));
}
