/* SPDX-License-Identifier: MIT */
/// @file
/// Zeroes memory. Private.
///
/// C libraries for microcontrollers are mostly built for size: their memset takes four instructions a byte. Where words may lie at any
/// address this takes three for four bytes; the build keeps GCC from making a call of memset of it (tools/cmake/flags.cmake).
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

#endif /* JCAL_CLEAR_H */
