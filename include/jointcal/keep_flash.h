/* SPDX-License-Identifier: MIT */
/// @file
/// Records of all joints in two slots of flash: whenever the power goes, one of them holds what was, or what is new in whole.
///
///     jcal_keep_writer_t writer;
///     if (jcal_keep_begin(&writer, &flash, 15u) == JCAL_OK) {   erases the older slot: the processor may stand still meanwhile
///         (void)jcal_keep_put(&writer, &knee);                  joints with something new
///         (void)jcal_keep_commit(&writer);                      carries the others over, then makes it count
///     }
///
///     jcal_kept_t kept;
///     const jcal_kept_wanted_t wanted = {JCAL_KEPT_HINGE, 3u, thigh_serial, shank_serial};
///     if (jcal_keep_load(&flash, &wanted, &kept) == JCAL_KEPT_FITS) { ... }
///
/// A call that fails ends the write, and the image from before is in use.
///
/// When to write: jcal_kept_worth (keep.h) says what is worth it, jcal_keep_due how often. Method, wear: docs/METHOD_HUB.md, sections 2 and 3.
/// Threads:  all calls on one flash belong to one task. Stack: 0.4 KiB.
#ifndef JCAL_KEEP_FLASH_H
#define JCAL_KEEP_FLASH_H

#include "jointcal/keep.h"
#include "jointcal/private/keep/writer.h"
#include "jointcal/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Most joints of an image.
#define JCAL_KEEP_JOINTS_MAX 31u
/// Bytes of the head of an image; all that is programmed is a multiple of this, at a multiple of this.
#define JCAL_KEEP_HEAD_BYTES 32u
/// Bytes of an image of n joints: what a slot must hold.
#define JCAL_KEEP_IMAGE_BYTES(n) (JCAL_KEEP_HEAD_BYTES + ((n)*JCAL_KEPT_BYTES))

/// The port: flash with two slots, 0 and 1, of which each is erased by itself. Each function returns false if it failed. Implementations:
/// port/boards.
typedef struct jcal_flash {
    void *context;        ///< Handed to each function.
    uint32_t slot_bytes;  ///< Size of a slot.
    uint32_t unit_bytes;  ///< Smallest piece that can be programmed: 1, 2, 4, 8, 16 or 32.
    /// Makes all bytes of a slot 0xFF.
    bool (*erase)(void *context, unsigned slot);
    /// Programs n bytes that are 0xFF; offset and n are multiples of JCAL_KEEP_HEAD_BYTES, in ascending order or not.
    bool (*program)(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n);
    /// Reads n bytes, at any offset.
    bool (*read)(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n);
} jcal_flash_t;

/// Begins a write of an image with places for joints 0 to `joints` - 1: erases the slot that does not hold the newest image.
///
/// Errors:   JCAL_ERR_ARG (null, no joints or more than JCAL_KEEP_JOINTS_MAX); JCAL_ERR_CONFIG (unit or slot do not do);
///           JCAL_ERR_FLASH (the erase failed, or left bytes that are not 0xFF).
/// Cost:     an erase, 85 ms on an nRF52840, 0.5 s for 16 KiB on an STM32F405; then each byte of the image is looked at.
JCAL_MUST_CHECK jcal_status_t jcal_keep_begin(jcal_keep_writer_t *self, const jcal_flash_t *flash, unsigned joints);

/// Programs the record of one joint, each joint at most once; its sequence becomes the number of this write.
///
/// Errors:   JCAL_ERR_ARG (null, not begun, a joint without a place or put before, values that no record has); the write goes on.
///           JCAL_ERR_FLASH (it failed, or reads otherwise): the write has ended.
jcal_status_t jcal_keep_put(jcal_keep_writer_t *self, const jcal_kept_t *kept);

/// Leaves a joint out that is in the newest image: it is forgotten. Errors: as of put.
jcal_status_t jcal_keep_drop(jcal_keep_writer_t *self, unsigned joint);

/// Carries over what was not put or dropped, programs the head, and with it the image counts.
///
/// Errors:   JCAL_ERR_ARG (null, not begun); JCAL_ERR_FLASH (it failed; what was is in use). Either way the write has ended.
JCAL_MUST_CHECK jcal_status_t jcal_keep_commit(jcal_keep_writer_t *self);

/// The newest record of a joint. One that is damaged in the newest image is taken from the older one.
///
/// Inputs:   wanted  its joint says which place is read.
/// Outputs:  out     untouched unless JCAL_KEPT_FITS.
/// Returns:  as jcal_kept_decode; of two refusals the newest image's. JCAL_KEPT_NONE: no image at all, or nothing of this joint in it.
JCAL_MUST_CHECK jcal_kept_refusal_t jcal_keep_load(const jcal_flash_t *flash, const jcal_kept_wanted_t *wanted,
                                                   jcal_kept_t *out);

/// The newest record of a joint, of whatever kind and sensors; as jcal_keep_load otherwise.
JCAL_MUST_CHECK jcal_kept_refusal_t jcal_keep_read(const jcal_flash_t *flash, unsigned joint, jcal_kept_t *out);

/// Number of writes so far; each slot has been erased about half as often. 0 if there is no image.
uint32_t jcal_keep_writes(const jcal_flash_t *flash);

/// Nothing written yet since the power came. Null: does nothing.
void jcal_keep_schedule_init(jcal_keep_schedule_t *self);

/// True if a write is to be begun now: something is worth it (`is_worth`), for the first one since a minute; for each other one since
/// 2, 4, 8 ... 128 minutes after the one before. A clock that goes back starts the wait anew.
bool jcal_keep_due(jcal_keep_schedule_t *self, uint64_t t_us, bool is_worth);

/// A write has been begun. Null: does nothing.
void jcal_keep_written(jcal_keep_schedule_t *self, uint64_t t_us);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_KEEP_FLASH_H */
