/* SPDX-License-Identifier: MIT */
/* From reset to main, and where faults end. */
#include "board.h"
#include "cortex_m.h"

/* From the linker script. */
extern uint32_t start_data_load, start_data, start_data_end, start_bss, start_bss_end;
extern const vector_t board_vectors[];

int main(void);

void start_reset(void)
{
    /* The vector table may lie elsewhere when a loader has started us. */
    VTOR = (uint32_t)(uintptr_t)board_vectors;
    CPACR |= 0xFu << 20;
    __asm volatile("dsb\n isb" ::: "memory");
    const uint32_t *from = &start_data_load;
    // cppcheck-suppress comparePointers ; the linker script puts both into one section
    for (uint32_t *to = &start_data; to < &start_data_end; to++) {
        *to = *from;
        from++;
    }
    // cppcheck-suppress comparePointers
    for (uint32_t *to = &start_bss; to < &start_bss_end; to++) {
        *to = 0;
    }
    (void)main();
    start_fault();
}

/* On the wire the text is between zeros, so a sender counts it as a corrupted piece and a person can read it. */
void start_fault(void)
{
    static const char TEXT[] = "\0FAULT\n";
    __asm volatile("cpsid i" ::: "memory");
    board_error_light();
    for (unsigned k = 0; k < sizeof TEXT; k++) {
        /* A dead UART must not keep the light from being the last word. */
        for (uint32_t patience = 1000000u; patience > 0 && !board_can_send(); patience--) {
        }
        board_send((uint8_t)TEXT[k]);
    }
    for (;;) {
        __asm volatile("wfi");
    }
}
