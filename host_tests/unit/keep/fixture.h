/* SPDX-License-Identifier: MIT */
/// @file
/// Calibrations to keep, and a flash in RAM that can lose its power after any byte and at any stage of an erase.
#ifndef KEEP_FIXTURE_H
#define KEEP_FIXTURE_H

#include "jointcal/keep_flash.h"
#include "unity.h"

#include <string.h>

/* ---- calibrations */

static inline jcal_kept_t hinge_of(uint8_t joint)
{
    jcal_kept_t kept = {0};
    kept.kind = JCAL_KEPT_HINGE;
    kept.model = JCAL_MODEL_FUNCTIONAL;
    kept.heading = JCAL_KEPT_HEADING_BY_CENTER;
    kept.joint = joint;
    kept.sequence = 0x01020304u;
    kept.serial1 = UINT64_C(0x1122334455667788);
    kept.serial2 = UINT64_C(0x99AABBCCDDEEFF00);
    kept.axis1 = (jcal_vec3_t){0.6f, 0.0f, -0.8f};
    kept.axis2 = (jcal_vec3_t){0.0f, 1.0f, 0.0f};
    kept.bound1_rad = 0.03125f;
    kept.bound2_rad = 0.0625f;
    kept.flexion_bound_rad = 0.015625f;
    kept.has_levers = true;
    kept.lever1_m = (jcal_vec3_t){0.25f, -0.5f, 0.125f};
    kept.lever2_m = (jcal_vec3_t){-0.0625f, 1.0f, 2.0f};
    kept.bound_lever1_m = 0.5f;
    kept.bound_lever2_m = 10.0f;
    kept.has_zero = true;
    kept.flexion_zero_rad = -1.5f;
    kept.pronation_zero_rad = 0.75f;
    return kept;
}

static inline jcal_kept_t ball_of(uint8_t joint)
{
    jcal_kept_t kept = hinge_of(joint);
    kept.kind = JCAL_KEPT_BALL;
    kept.model = JCAL_MODEL_RIGID;
    kept.sequence = 7u;
    kept.serial1 = 1u;
    kept.serial2 = 2u;
    kept.axis1 = (jcal_vec3_t){0};
    kept.axis2 = (jcal_vec3_t){0};
    kept.bound1_rad = 0.0f;
    kept.bound2_rad = 0.0f;
    kept.flexion_bound_rad = 0.0f;
    kept.flexion_zero_rad = 0.0f;
    kept.pronation_zero_rad = 0.0f;
    kept.frames.q_b1_s1 = (jcal_quat_t){0.5f, -0.5f, 0.5f, 0.5f};
    kept.frames.q_b2_s2 = (jcal_quat_t){1.0f, 0.0f, 0.0f, 0.0f};
    return kept;
}

static inline jcal_kept_wanted_t wanted_of(const jcal_kept_t *kept)
{
    const jcal_kept_wanted_t wanted = {kept->kind, kept->joint, kept->serial1, kept->serial2};
    return wanted;
}

static inline void assert_vec3(jcal_vec3_t expected, jcal_vec3_t actual)
{
    TEST_ASSERT_EQUAL_MEMORY(&expected, &actual, sizeof expected);
}

/* Every field, to the bit; structs may have holes. */
static inline void assert_kept(const jcal_kept_t *expected, const jcal_kept_t *actual)
{
    TEST_ASSERT_EQUAL_INT(expected->kind, actual->kind);
    TEST_ASSERT_EQUAL_INT(expected->model, actual->model);
    TEST_ASSERT_EQUAL_INT(expected->heading, actual->heading);
    TEST_ASSERT_EQUAL_UINT8(expected->joint, actual->joint);
    TEST_ASSERT_EQUAL_UINT32(expected->sequence, actual->sequence);
    TEST_ASSERT_TRUE(expected->serial1 == actual->serial1);
    TEST_ASSERT_TRUE(expected->serial2 == actual->serial2);
    assert_vec3(expected->axis1, actual->axis1);
    assert_vec3(expected->axis2, actual->axis2);
    TEST_ASSERT_EQUAL_FLOAT(expected->bound1_rad, actual->bound1_rad);
    TEST_ASSERT_EQUAL_FLOAT(expected->bound2_rad, actual->bound2_rad);
    TEST_ASSERT_EQUAL_FLOAT(expected->flexion_bound_rad, actual->flexion_bound_rad);
    TEST_ASSERT_EQUAL(expected->has_levers, actual->has_levers);
    assert_vec3(expected->lever1_m, actual->lever1_m);
    assert_vec3(expected->lever2_m, actual->lever2_m);
    TEST_ASSERT_EQUAL_FLOAT(expected->bound_lever1_m, actual->bound_lever1_m);
    TEST_ASSERT_EQUAL_FLOAT(expected->bound_lever2_m, actual->bound_lever2_m);
    TEST_ASSERT_EQUAL(expected->has_zero, actual->has_zero);
    TEST_ASSERT_EQUAL_FLOAT(expected->flexion_zero_rad, actual->flexion_zero_rad);
    TEST_ASSERT_EQUAL_FLOAT(expected->pronation_zero_rad, actual->pronation_zero_rad);
    TEST_ASSERT_EQUAL(expected->has_lag, actual->has_lag);
    TEST_ASSERT_EQUAL_FLOAT(expected->lag_s, actual->lag_s);
    TEST_ASSERT_EQUAL_FLOAT(expected->lag_bound_s, actual->lag_bound_s);
    TEST_ASSERT_EQUAL(expected->has_usual, actual->has_usual);
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(expected->usual, actual->usual, 3);
    TEST_ASSERT_EQUAL_MEMORY(&expected->frames, &actual->frames, sizeof expected->frames);
}

/* ---- numbers by chance */

static inline uint32_t chance(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

/* ---- flash */

#define FLASH_JOINTS 3u
#define FLASH_BYTES JCAL_KEEP_IMAGE_BYTES(FLASH_JOINTS)
#define FLASH_UNIT 4u
#define ERASE_STAGES 8u
#define POWER_FOR_EVER 0xFFFFFFFFu

typedef struct {
    uint8_t bytes[2][FLASH_BYTES];
    uint32_t left;      /* bytes and stages of erase until the power goes */
    uint32_t noise;     /* which bits have changed in what was cut short */
    unsigned erases[2]; /* begun */
    uint32_t worn_from; /* erase of this number and all later ones leave a bit behind; 0: none */
    bool is_misused;    /* programmed what was not erased, or pieces that are none */
    bool refuses_to_read;
} ram_flash_t;

static inline bool ram_has_power(ram_flash_t *ram)
{
    if (ram->left == POWER_FOR_EVER) {
        return true;
    }
    if (ram->left > 0u) {
        --ram->left;
        return true;
    }
    return false;
}

/* Each stage erases some of the bits that are left; the last one all of them. */
static inline bool ram_erase(void *context, unsigned slot)
{
    ram_flash_t *ram = (ram_flash_t *)context;
    ++ram->erases[slot];
    for (unsigned stage = 0u; stage < ERASE_STAGES; ++stage) {
        if (!ram_has_power(ram)) {
            return false;
        }
        for (unsigned i = 0u; i < FLASH_BYTES; ++i) {
            ram->bytes[slot][i] |= (uint8_t)(chance(&ram->noise) >> 9);
        }
    }
    memset(ram->bytes[slot], 0xFF, FLASH_BYTES);
    if (ram->worn_from != 0u && ram->erases[0] + ram->erases[1] >= ram->worn_from) {
        ram->bytes[slot][FLASH_BYTES - 1u] = 0xFEu;
    }
    return ram_has_power(ram);
}

/* A byte at which the power goes has some of its bits cleared. */
static inline bool ram_program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    ram_flash_t *ram = (ram_flash_t *)context;
    ram->is_misused = ram->is_misused || offset % FLASH_UNIT != 0u || n % FLASH_UNIT != 0u;
    for (uint32_t i = 0u; i < n; ++i) {
        uint8_t *to = &ram->bytes[slot][offset + i];
        ram->is_misused = ram->is_misused || *to != 0xFFu;
        if (!ram_has_power(ram)) {
            *to = (uint8_t)(*to & (bytes[i] | (chance(&ram->noise) >> 9)));
            return false;
        }
        *to = (uint8_t)(*to & bytes[i]);
    }
    return true;
}

static inline bool ram_read(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n)
{
    const ram_flash_t *ram = (const ram_flash_t *)context;
    memcpy(bytes, &ram->bytes[slot][offset], n);
    return !ram->refuses_to_read;
}

static inline jcal_flash_t ram_flash(ram_flash_t *ram)
{
    memset(ram, 0, sizeof *ram);
    memset(ram->bytes, 0xFF, sizeof ram->bytes);
    ram->left = POWER_FOR_EVER;
    ram->noise = 2463534242u;
    const jcal_flash_t flash = {ram, FLASH_BYTES, FLASH_UNIT, ram_erase, ram_program, ram_read};
    return flash;
}

/* Joint k of image n, each one different. */
static inline jcal_kept_t joint_of_image(uint8_t joint, unsigned n)
{
    jcal_kept_t kept = (joint == 1u) ? ball_of(joint) : hinge_of(joint);
    kept.bound_lever1_m = 0.001f * (float)(n + 1u);
    return kept;
}

/* Writes all joints; false if it did not come to its end. */
static inline bool write_image(const jcal_flash_t *flash, unsigned n)
{
    jcal_keep_writer_t writer;
    bool ok = jcal_keep_begin(&writer, flash, FLASH_JOINTS) == JCAL_OK;
    for (uint8_t joint = 0u; ok && joint < FLASH_JOINTS; ++joint) {
        const jcal_kept_t kept = joint_of_image(joint, n);
        ok = jcal_keep_put(&writer, &kept) == JCAL_OK;
    }
    return ok && jcal_keep_commit(&writer) == JCAL_OK;
}

/* Of which image a joint is; -1 if nothing is believed. What is believed is whole. */
static inline int image_of(const jcal_flash_t *flash, uint8_t joint)
{
    const jcal_kept_t sample = joint_of_image(joint, 0u);
    const jcal_kept_wanted_t wanted = wanted_of(&sample);
    jcal_kept_t kept;
    if (jcal_keep_load(flash, &wanted, &kept) != JCAL_KEPT_FITS) {
        return -1;
    }
    const int n = (int)(1000.0f * kept.bound_lever1_m + 0.5f) - 1;
    jcal_kept_t expected = joint_of_image(joint, (unsigned)n);
    expected.sequence = kept.sequence;
    assert_kept(&expected, &kept);
    return n;
}

#endif /* KEEP_FIXTURE_H */
