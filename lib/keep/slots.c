/* SPDX-License-Identifier: MIT */
/// @file
/// Records of all joints in two slots of flash. See jointcal/keep_flash.h; the layout: docs/METHOD_HUB.md, section 2.
#include "jointcal/keep_flash.h"

#include "keep/bytes.h"

#include <stddef.h>

#define MAGIC 0x534B434Au /* JCKS */
#define SLOTS 2u
#define HEAD JCAL_KEEP_HEAD_BYTES

/* Where things are in the head. */
enum { AT_MAGIC = 0, AT_VERSION = 4, AT_RECORD_BYTES = 5, AT_JOINTS = 6, AT_SEQUENCE = 8, AT_CRC = 28 };

/// What the head of a slot says.
typedef struct {
    bool is_valid;
    uint8_t joints;
    uint32_t sequence;
} head_t;

static void encode_head(uint8_t bytes[HEAD], unsigned joints, uint32_t sequence)
{
    for (unsigned i = 0u; i < HEAD; ++i) {
        bytes[i] = 0u;
    }
    jcal_put_u32(bytes + AT_MAGIC, MAGIC);
    bytes[AT_VERSION] = JCAL_KEPT_VERSION;
    bytes[AT_RECORD_BYTES] = JCAL_KEPT_BYTES;
    bytes[AT_JOINTS] = (uint8_t)joints;
    jcal_put_u32(bytes + AT_SEQUENCE, sequence);
    jcal_put_u32(bytes + AT_CRC, jcal_crc32(bytes, AT_CRC));
}

static bool is_same(const uint8_t *a, const uint8_t *b, unsigned n)
{
    unsigned differs = 0u;
    for (unsigned i = 0u; i < n; ++i) {
        differs |= (unsigned)(a[i] ^ b[i]);
    }
    return differs == 0u;
}

/// A head is what encode_head writes and nothing else.
static head_t read_head(const jcal_flash_t *flash, unsigned slot)
{
    uint8_t bytes[HEAD];
    uint8_t again[HEAD];
    head_t head = {0};
    if (!flash->read(flash->context, slot, 0u, bytes, HEAD)) {
        return head;
    }
    head.joints = bytes[AT_JOINTS];
    head.sequence = jcal_get_u32(bytes + AT_SEQUENCE);
    encode_head(again, head.joints, head.sequence);
    head.is_valid = is_same(bytes, again, HEAD) && (head.joints <= JCAL_KEEP_JOINTS_MAX) &&
                    (JCAL_KEEP_IMAGE_BYTES((uint32_t)head.joints) <= flash->slot_bytes);
    return head;
}

/// The slot of the newest image, with its head; SLOTS if there is none. Numbers of writes may wrap.
static unsigned newest(const jcal_flash_t *flash, head_t *out)
{
    const head_t heads[SLOTS] = {read_head(flash, 0u), read_head(flash, 1u)};
    const bool is_one_newer = (uint32_t)(heads[1].sequence - heads[0].sequence) < 0x80000000u;
    unsigned slot = SLOTS;
    if (heads[0].is_valid && heads[1].is_valid) {
        slot = is_one_newer ? 1u : 0u;
    } else if (heads[0].is_valid || heads[1].is_valid) {
        slot = heads[1].is_valid ? 1u : 0u;
    }
    *out = (slot < SLOTS) ? heads[slot] : (head_t){0};
    return slot;
}

static bool is_port(const jcal_flash_t *flash)
{
    return (flash != NULL) && (flash->erase != NULL) && (flash->program != NULL) && (flash->read != NULL);
}

static uint32_t offset_of(unsigned joint)
{
    return HEAD + ((uint32_t)joint * JCAL_KEPT_BYTES);
}

/// The bytes of a record; false if they cannot be read.
static bool read_record(const jcal_flash_t *flash, unsigned slot, unsigned joint, uint8_t bytes[JCAL_KEPT_BYTES])
{
    return flash->read(flash->context, slot, offset_of(joint), bytes, JCAL_KEPT_BYTES);
}

/// Looks at each byte of what is to be the image.
static bool reads_erased(const jcal_flash_t *flash, unsigned slot, unsigned joints)
{
    uint8_t bytes[HEAD];
    const uint32_t end = JCAL_KEEP_IMAGE_BYTES((uint32_t)joints);
    for (uint32_t at = 0u; at < end; at += HEAD) {
        if (!flash->read(flash->context, slot, at, bytes, HEAD) || !jcal_is_erased(bytes, HEAD)) {
            return false;
        }
    }
    return true;
}

jcal_status_t jcal_keep_begin(jcal_keep_writer_t *self, const jcal_flash_t *flash, unsigned joints)
{
    if ((self == NULL) || !is_port(flash) || (joints == 0u) || (joints > JCAL_KEEP_JOINTS_MAX)) {
        return JCAL_ERR_ARG;
    }
    const bool is_unit = (flash->unit_bytes != 0u) && (flash->unit_bytes <= HEAD) && ((HEAD % flash->unit_bytes) == 0u);
    if (!is_unit || (flash->slot_bytes < JCAL_KEEP_IMAGE_BYTES((uint32_t)joints))) {
        return JCAL_ERR_CONFIG;
    }
    head_t head;
    const unsigned kept = newest(flash, &head);
    *self = (jcal_keep_writer_t){0};
    self->flash = flash;
    self->sequence = head.sequence + 1u;
    self->slot = (kept == 0u) ? 1u : 0u;
    self->joints = (uint8_t)joints;
    if (!flash->erase(flash->context, self->slot) || !reads_erased(flash, self->slot, joints)) {
        return JCAL_ERR_FLASH;
    }
    self->is_open = true;
    return JCAL_OK;
}

/// Programs bytes and reads them back, HEAD at a time.
static jcal_status_t write_checked(jcal_keep_writer_t *self, uint32_t offset, const uint8_t *bytes, unsigned n)
{
    const jcal_flash_t *const flash = self->flash;
    uint8_t back[HEAD];
    for (unsigned at = 0u; at < n; at += HEAD) {
        if (!flash->program(flash->context, self->slot, offset + at, bytes + at, HEAD) ||
            !flash->read(flash->context, self->slot, offset + at, back, HEAD) || !is_same(back, bytes + at, HEAD)) {
            self->is_open = false;
            return JCAL_ERR_FLASH;
        }
    }
    return JCAL_OK;
}

static bool may_take(const jcal_keep_writer_t *self, unsigned joint)
{
    return (self != NULL) && self->is_open && (joint < self->joints) && ((self->put & (1u << joint)) == 0u);
}

jcal_status_t jcal_keep_put(jcal_keep_writer_t *self, const jcal_kept_t *kept)
{
    uint8_t bytes[JCAL_KEPT_BYTES];
    if ((kept == NULL) || !may_take(self, kept->joint)) {
        return JCAL_ERR_ARG;
    }
    jcal_kept_t now = *kept;
    now.sequence = self->sequence;
    if (jcal_kept_encode(&now, bytes) != JCAL_OK) {
        return JCAL_ERR_ARG;
    }
    self->put |= 1u << kept->joint;
    return write_checked(self, offset_of(kept->joint), bytes, JCAL_KEPT_BYTES);
}

jcal_status_t jcal_keep_drop(jcal_keep_writer_t *self, unsigned joint)
{
    if (!may_take(self, joint)) {
        return JCAL_ERR_ARG;
    }
    self->put |= 1u << joint;
    return JCAL_OK;
}

/// Carries one joint over from the newest image. What is no record any more is left out.
static jcal_status_t carry_over(jcal_keep_writer_t *self, unsigned joint)
{
    uint8_t bytes[JCAL_KEPT_BYTES];
    jcal_kept_t kept;
    const bool is_record = read_record(self->flash, 1u - self->slot, joint, bytes) &&
                           (jcal_kept_decode(bytes, NULL, &kept) == JCAL_KEPT_FITS) && (kept.joint == joint);
    return is_record ? write_checked(self, offset_of(joint), bytes, JCAL_KEPT_BYTES) : JCAL_OK;
}

jcal_status_t jcal_keep_commit(jcal_keep_writer_t *self)
{
    uint8_t bytes[HEAD];
    if ((self == NULL) || !self->is_open) {
        return JCAL_ERR_ARG;
    }
    const head_t kept = read_head(self->flash, 1u - self->slot);
    const unsigned joints = kept.is_valid ? kept.joints : 0u;
    for (unsigned joint = 0u; (joint < joints) && (joint < self->joints); ++joint) {
        if (may_take(self, joint) && (carry_over(self, joint) != JCAL_OK)) {
            return JCAL_ERR_FLASH;
        }
    }
    encode_head(bytes, self->joints, self->sequence);
    const jcal_status_t status = write_checked(self, 0u, bytes, HEAD);
    self->is_open = false;
    return status;
}

/// `wanted` null: of whatever kind and sensors.
static jcal_kept_refusal_t load_from(const jcal_flash_t *flash, unsigned slot, unsigned joint,
                                     const jcal_kept_wanted_t *wanted, jcal_kept_t *out)
{
    uint8_t bytes[JCAL_KEPT_BYTES];
    return read_record(flash, slot, joint, bytes) ? jcal_kept_decode(bytes, wanted, out) : JCAL_KEPT_DAMAGED;
}

static jcal_kept_refusal_t load(const jcal_flash_t *flash, unsigned joint, const jcal_kept_wanted_t *wanted,
                                jcal_kept_t *out)
{
    head_t head;
    const unsigned slot = newest(flash, &head);
    if ((slot == SLOTS) || (joint >= head.joints)) {
        return JCAL_KEPT_NONE;
    }
    const jcal_kept_refusal_t refusal = load_from(flash, slot, joint, wanted, out);
    const head_t older = read_head(flash, 1u - slot);
    if ((refusal == JCAL_KEPT_DAMAGED) && older.is_valid && (joint < older.joints) &&
        (load_from(flash, 1u - slot, joint, wanted, out) == JCAL_KEPT_FITS)) {
        return JCAL_KEPT_FITS;
    }
    return refusal;
}

jcal_kept_refusal_t jcal_keep_load(const jcal_flash_t *flash, const jcal_kept_wanted_t *wanted, jcal_kept_t *out)
{
    if (!is_port(flash) || (wanted == NULL) || (out == NULL)) {
        return JCAL_KEPT_DAMAGED;
    }
    return load(flash, wanted->joint, wanted, out);
}

jcal_kept_refusal_t jcal_keep_read(const jcal_flash_t *flash, unsigned joint, jcal_kept_t *out)
{
    return (is_port(flash) && (out != NULL)) ? load(flash, joint, NULL, out) : JCAL_KEPT_DAMAGED;
}

uint32_t jcal_keep_writes(const jcal_flash_t *flash)
{
    head_t head = {0};
    if (is_port(flash)) {
        (void)newest(flash, &head);
    }
    return head.sequence;
}
