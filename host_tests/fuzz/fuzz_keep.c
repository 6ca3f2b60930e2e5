/* SPDX-License-Identifier: MIT */
/* Any bytes as flash with kept calibrations: what is believed is valid and comes back the same; a write on top of it works. */
#include "bytes.h"
#include "jointcal/keep_flash.h"
#include "keep/bytes.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define JOINTS 3u
#define SLOT_BYTES JCAL_KEEP_IMAGE_BYTES(JOINTS)

static uint8_t memory[2][SLOT_BYTES];

static bool erase(void *context, unsigned slot)
{
    (void)context;
    memset(memory[slot], 0xFF, SLOT_BYTES);
    return true;
}

static bool program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    require(slot < 2u && offset <= SLOT_BYTES && n <= SLOT_BYTES - offset);
    for (uint32_t i = 0; i < n; i++) {
        require(memory[slot][offset + i] == 0xFFu);
        memory[slot][offset + i] = bytes[i];
    }
    return true;
}

static bool read(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n)
{
    (void)context;
    require(slot < 2u && offset <= SLOT_BYTES && n <= SLOT_BYTES - offset);
    memcpy(bytes, &memory[slot][offset], n);
    return true;
}

static void check_kept(const jcal_kept_t *kept)
{
    uint8_t bytes[JCAL_KEPT_BYTES];
    jcal_kept_t again;
    require(kept->joint < JCAL_KEEP_JOINTS_MAX && kept->serial1 != kept->serial2);
    require_within(kept->bound1_rad, 0.0f, JCAL_BOUND_UNKNOWN_RAD);
    require_within(kept->bound_lever2_m, 0.0f, JCAL_BOUND_UNKNOWN_M);
    if (kept->kind != JCAL_KEPT_BALL) {
        require_within(jcal_vec3_norm(kept->axis1), 0.99f, 1.01f);
        require_within(jcal_vec3_norm(kept->axis2), 0.99f, 1.01f);
    }
    require(jcal_kept_encode(kept, bytes) == JCAL_OK);
    require(jcal_kept_decode(bytes, NULL, &again) == JCAL_KEPT_FITS);
    require(!jcal_kept_worth(kept, &again));
}

/* Which CRCs are put right says the first byte, so that what lies behind them is reached. */
static void fill(const uint8_t *data, size_t size)
{
    for (unsigned slot = 0; slot < 2u; slot++) {
        for (unsigned i = 0; i < SLOT_BYTES; i++) {
            const size_t at = 1u + slot * SLOT_BYTES + i;
            memory[slot][i] = (at < size) ? data[at] : 0xFFu;
        }
        if ((data[0] & (1u << slot)) != 0u) {
            jcal_put_u32(&memory[slot][28], jcal_crc32(memory[slot], 28u));
        }
        for (unsigned joint = 0; joint < JOINTS; joint++) {
            uint8_t *record = &memory[slot][JCAL_KEEP_IMAGE_BYTES(joint)];
            if ((data[0] & (4u << joint)) != 0u) {
                jcal_put_u32(record + 124, jcal_crc32(record, 124u));
            }
        }
    }
}

static unsigned load_all(const jcal_flash_t *flash, jcal_kept_t kept[JOINTS])
{
    unsigned found = 0;
    for (unsigned joint = 0; joint < JOINTS; joint++) {
        for (unsigned slot = 0; slot < 2u; slot++) {
            jcal_kept_t sample;
            if (jcal_kept_decode(&memory[slot][JCAL_KEEP_IMAGE_BYTES(joint)], NULL, &sample) != JCAL_KEPT_FITS) {
                continue;
            }
            check_kept(&sample);
            const jcal_kept_wanted_t wanted = {sample.kind, (uint8_t)joint, sample.serial1, sample.serial2};
            if (jcal_keep_load(flash, &wanted, &kept[joint]) == JCAL_KEPT_FITS) {
                require(kept[joint].joint == joint);
                found |= 1u << joint;
            }
        }
    }
    return found;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1u) {
        return 0;
    }
    static const jcal_flash_t flash = {NULL, SLOT_BYTES, 4u, erase, program, read};
    jcal_kept_t before[JOINTS];
    jcal_kept_t after[JOINTS];
    fill(data, size);
    const unsigned found = load_all(&flash, before);
    const uint32_t writes = jcal_keep_writes(&flash);
    jcal_keep_writer_t writer;
    require(jcal_keep_begin(&writer, &flash, JOINTS) == JCAL_OK);
    if ((data[0] & 32u) != 0u && found != 0u) {
        jcal_kept_t kept = before[(found & 1u) != 0u ? 0 : (found & 2u) != 0u ? 1 : 2];
        require(jcal_keep_put(&writer, &kept) == JCAL_OK);
        require(jcal_keep_put(&writer, &kept) == JCAL_ERR_ARG);
    }
    require(jcal_keep_commit(&writer) == JCAL_OK);
    require(jcal_keep_writes(&flash) == writes + 1u);
    (void)load_all(&flash, after);
    return 0;
}
