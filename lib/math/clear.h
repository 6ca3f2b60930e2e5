/* SPDX-License-Identifier: MIT */
/// @file
/// Zeroes and copies memory. Private.
///
/// C libraries for microcontrollers are mostly built for size: their memset takes four instructions a byte, their memcpy three. Where
/// words may lie at any address this takes three to five for four bytes; the build keeps GCC from making a call of memset or memcpy of it
/// (tools/cmake/flags.cmake).
#ifndef JCAL_CLEAR_H
#define JCAL_CLEAR_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/// memory (size bytes) <- 0.
static inline void jcal_clear(void *memory, size_t size)
{
#ifdef __ARM_FEATURE_UNALIGNED
    const uint32_t zero = 0u;
    unsigned char *const to = (unsigned char *)memory;
    size_t k = 0u;
    for (; (k + sizeof zero) <= size; k += sizeof zero) {
        (void)memcpy(&to[k], &zero, sizeof zero); /* one instruction */
    }
    for (; k < size; ++k) {
        to[k] = 0u;
    }
#else
    (void)memset(memory, 0, size);
#endif
}

/// to (size bytes) <- from; they may not overlap.
static inline void jcal_copy(void *to, const void *from, size_t size)
{
#ifdef __ARM_FEATURE_UNALIGNED
    uint32_t word;
    unsigned char *const at = (unsigned char *)to;
    const unsigned char *const of = (const unsigned char *)from;
    size_t k = 0u;
    for (; (k + sizeof word) <= size; k += sizeof word) {
        (void)memcpy(&word, &of[k], sizeof word); /* one instruction each */
        (void)memcpy(&at[k], &word, sizeof word);
    }
    for (; k < size; ++k) {
        at[k] = of[k];
    }
#else
    (void)memcpy(to, from, size);
#endif
}

#endif /* JCAL_CLEAR_H */
