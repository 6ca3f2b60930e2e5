/* SPDX-License-Identifier: MIT */
/// @file
/// A write to flash on its way, and when the next one may be. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_KEEP_WRITER_H
#define JCAL_PRIVATE_KEEP_WRITER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct jcal_flash;

/// A write on its way.
typedef struct {
    const struct jcal_flash *flash;
    uint32_t sequence;  ///< Number of this write.
    uint32_t put;       ///< Bit k: joint k has been put.
    uint8_t slot;       ///< Where it goes.
    uint8_t joints;     ///< Places in the image.
    bool is_open;       ///< Begun, not committed, nothing failed.
} jcal_keep_writer_t;

/// When a write may be.
typedef struct {
    uint64_t since_us;  ///< Of the last write, or since when there is something worth one.
    uint32_t wait_s;    ///< How long to wait from then.
    bool has_since;
} jcal_keep_schedule_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_KEEP_WRITER_H */
