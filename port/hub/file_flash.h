/* SPDX-License-Identifier: MIT */
/// @file
/// A flash of two slots of 4 KiB in a file, for the hub on a PC. What is erased or programmed is in the file when the call returns.
#ifndef JCAL_HUB_FILE_FLASH_H
#define JCAL_HUB_FILE_FLASH_H

#include "jointcal/keep_flash.h"

#define FILE_FLASH_SLOT_BYTES 4096u

/// All members are private.
typedef struct {
    int file;
    bool (*may)(void *context);  ///< Asked before each access and in the middle of each; false: the power is off.
    void *context;
} file_flash_t;

/// Opens the file, or makes one that is erased; false with errno. `may` may be null.
bool file_flash_open(file_flash_t *self, const char *path, bool (*may)(void *context), void *context);

/// The port; `self` belongs to it.
jcal_flash_t file_flash(file_flash_t *self);

#endif
