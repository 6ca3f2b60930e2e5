/* SPDX-License-Identifier: MIT */
/* A flash in a file. See file_flash.h. */
#include "file_flash.h"

#include <fcntl.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

#define SLOTS 2u
/* Programmed at a time, as by a microcontroller. */
#define UNIT_BYTES 4u

static bool has(unsigned slot, uint32_t offset, uint32_t n)
{
    return slot < SLOTS && offset <= FILE_FLASH_SLOT_BYTES && n <= FILE_FLASH_SLOT_BYTES - offset;
}

static off_t place(unsigned slot, uint32_t offset)
{
    return (off_t)slot * (off_t)FILE_FLASH_SLOT_BYTES + (off_t)offset;
}

static bool may(const file_flash_t *self)
{
    return self->may == NULL || self->may(self->context);
}

static bool put(const file_flash_t *self, off_t at, const uint8_t *bytes, size_t n)
{
    return may(self) && pwrite(self->file, bytes, n, at) == (ssize_t)n;
}

/* In two halves, so that a cut may leave one. */
static bool erase(void *context, unsigned slot)
{
    const file_flash_t *const self = context;
    uint8_t bytes[FILE_FLASH_SLOT_BYTES / 2u];
    memset(bytes, 0xFF, sizeof bytes);
    return has(slot, 0, 0) && put(self, place(slot, 0), bytes, sizeof bytes) &&
           put(self, place(slot, (uint32_t)sizeof bytes), bytes, sizeof bytes) && fsync(self->file) == 0;
}

static bool read_slot(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n)
{
    const file_flash_t *const self = context;
    return has(slot, offset, n) && pread(self->file, bytes, n, place(slot, offset)) == (ssize_t)n;
}

/* Bits are cleared only, as in flash. */
static bool program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    const file_flash_t *const self = context;
    uint8_t unit[UNIT_BYTES];
    if (!has(slot, offset, n) || offset % UNIT_BYTES != 0 || n % UNIT_BYTES != 0) {
        return false;
    }
    for (uint32_t at = 0; at < n; at += UNIT_BYTES) {
        if (!read_slot(context, slot, offset + at, unit, UNIT_BYTES)) {
            return false;
        }
        for (uint32_t k = 0; k < UNIT_BYTES; k++) {
            unit[k] = (uint8_t)(unit[k] & bytes[at + k]);
        }
        if (!put(self, place(slot, offset + at), unit, UNIT_BYTES)) {
            return false;
        }
    }
    return true;
}

bool file_flash_open(file_flash_t *self, const char *path, bool (*may_go_on)(void *context), void *context)
{
    *self = (file_flash_t){.file = open(path, O_RDWR | O_CREAT, 0666)};
    if (self->file < 0) {
        return false;
    }
    uint8_t erased[SLOTS * FILE_FLASH_SLOT_BYTES];
    memset(erased, 0xFF, sizeof erased);
    const off_t size = lseek(self->file, 0, SEEK_END);
    if (size < 0 || (size < (off_t)sizeof erased && !put(self, size, erased, sizeof erased - (size_t)size))) {
        return false;
    }
    self->may = may_go_on;
    self->context = context;
    return true;
}

jcal_flash_t file_flash(file_flash_t *self)
{
    const jcal_flash_t flash = {self, FILE_FLASH_SLOT_BYTES, UNIT_BYTES, erase, program, read_slot};
    return flash;
}
