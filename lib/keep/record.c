/* SPDX-License-Identifier: MIT */
/// @file
/// A calibration as 128 bytes, and back. See jointcal/keep.h; the layout: docs/METHOD_HUB.md, section 2.
#include "jointcal/keep.h"

#include "jointcal/keep_flash.h"
#include "keep/bytes.h"
#include "math/limits.h"
#include "math/scalar.h"
#include "math/sphere.h"

#include <stddef.h>

#define MAGIC 0x524B434Au /* JCKR */

/* Where things are. */
enum {
    AT_MAGIC = 0,
    AT_VERSION = 4,
    AT_KIND = 5,
    AT_JOINT = 6,
    AT_FLAGS = 7,
    AT_SEQUENCE = 8,
    AT_SERIAL1 = 12,
    AT_SERIAL2 = 20,
    AT_AXIS1 = 28,
    AT_AXIS2 = 40,
    AT_BOUND1 = 52,
    AT_BOUND2 = 56,
    AT_FRAME1 = 28,
    AT_FRAME2 = 44,
    AT_FLEXION = 60,
    AT_LEVER1 = 64,
    AT_LEVER2 = 76,
    AT_BOUND_LEVER1 = 88,
    AT_BOUND_LEVER2 = 92,
    AT_ZERO = 96,
    AT_LAG = 104,
    AT_BOUND_LAG = 108,
    AT_USUAL = 112,
    AT_CRC = 124
};

#define FLAG_FUNCTIONAL 1u
#define FLAG_BY_CENTER 2u
#define FLAG_LEVERS 4u
#define FLAG_ZERO 8u
#define FLAG_LAG 16u
#define FLAG_USUAL 32u
#define FLAGS_ALL 63u

/// Longest component of a lever, m.
#define LEVER_MAX_M 10.0f
/// Largest magnitude of a zero, rad: half a turn, rounded up.
#define ZERO_MAX_RAD 3.1416f
/// Largest mean square of residuals.
#define USUAL_MAX 1e3f

static bool is_axis(jcal_vec3_t axis)
{
    return jcal_within(jcal_vec3_dot(axis, axis), 0.99f, 1.01f);
}

static bool is_quat(jcal_quat_t q)
{
    return jcal_within((q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z), 0.99f, 1.01f);
}

static bool is_lever(jcal_vec3_t r)
{
    return jcal_within(r.x, -LEVER_MAX_M, LEVER_MAX_M) && jcal_within(r.y, -LEVER_MAX_M, LEVER_MAX_M) &&
           jcal_within(r.z, -LEVER_MAX_M, LEVER_MAX_M);
}

static bool is_bound(float bound, float most)
{
    return jcal_within(bound, 0.0f, most);
}

static bool has_valid_names(const jcal_kept_t *kept)
{
    const bool is_kind =
        (kept->kind == JCAL_KEPT_HINGE) || (kept->kind == JCAL_KEPT_TWO_AXES) || (kept->kind == JCAL_KEPT_BALL);
    const bool is_model = (kept->model == JCAL_MODEL_RIGID) || (kept->model == JCAL_MODEL_FUNCTIONAL);
    const bool is_heading =
        (kept->heading == JCAL_KEPT_HEADING_BY_AXES) || (kept->heading == JCAL_KEPT_HEADING_BY_CENTER);
    return is_kind && is_model && is_heading && (kept->joint < JCAL_KEEP_JOINTS_MAX) &&
           (kept->serial1 != kept->serial2);
}

static bool has_valid_axes(const jcal_kept_t *kept)
{
    return is_axis(kept->axis1) && is_axis(kept->axis2) && is_bound(kept->bound1_rad, JCAL_BOUND_UNKNOWN_RAD) &&
           is_bound(kept->bound2_rad, JCAL_BOUND_UNKNOWN_RAD) &&
           is_bound(kept->flexion_bound_rad, JCAL_BOUND_UNKNOWN_RAD) &&
           jcal_within(kept->flexion_zero_rad, -ZERO_MAX_RAD, ZERO_MAX_RAD) &&
           jcal_within(kept->pronation_zero_rad, -ZERO_MAX_RAD, ZERO_MAX_RAD);
}

static bool has_valid_frames(const jcal_kept_t *kept)
{
    return !kept->has_zero || (is_quat(kept->frames.q_b1_s1) && is_quat(kept->frames.q_b2_s2));
}

static bool has_valid_lag(const jcal_kept_t *kept)
{
    return !kept->has_lag || (jcal_within(kept->lag_s, -JCAL_KEPT_LAG_MAX_S, JCAL_KEPT_LAG_MAX_S) &&
                              is_bound(kept->lag_bound_s, JCAL_KEPT_LAG_MAX_S));
}

static bool has_valid_usual(const jcal_kept_t *kept)
{
    return !kept->has_usual || (is_bound(kept->usual[0], USUAL_MAX) && is_bound(kept->usual[1], USUAL_MAX) &&
                                is_bound(kept->usual[2], USUAL_MAX));
}

bool jcal_kept_is_valid(const jcal_kept_t *kept)
{
    if (kept == NULL) {
        return false;
    }
    const bool has_levers = !kept->has_levers || (is_lever(kept->lever1_m) && is_lever(kept->lever2_m) &&
                                                  is_bound(kept->bound_lever1_m, JCAL_BOUND_UNKNOWN_M) &&
                                                  is_bound(kept->bound_lever2_m, JCAL_BOUND_UNKNOWN_M));
    return has_valid_names(kept) && has_levers && has_valid_lag(kept) && has_valid_usual(kept) &&
           ((kept->kind == JCAL_KEPT_BALL) ? has_valid_frames(kept) : has_valid_axes(kept));
}

static uint8_t flags_of(const jcal_kept_t *kept)
{
    unsigned flags = 0u;
    flags |= (kept->model == JCAL_MODEL_FUNCTIONAL) ? FLAG_FUNCTIONAL : 0u;
    flags |= (kept->heading == JCAL_KEPT_HEADING_BY_CENTER) ? FLAG_BY_CENTER : 0u;
    flags |= kept->has_levers ? FLAG_LEVERS : 0u;
    flags |= kept->has_zero ? FLAG_ZERO : 0u;
    flags |= kept->has_lag ? FLAG_LAG : 0u;
    flags |= kept->has_usual ? FLAG_USUAL : 0u;
    return (uint8_t)flags;
}

static void put_axes(const jcal_kept_t *kept, uint8_t *bytes)
{
    jcal_put_vec3(bytes + AT_AXIS1, kept->axis1);
    jcal_put_vec3(bytes + AT_AXIS2, kept->axis2);
    jcal_put_f32(bytes + AT_BOUND1, kept->bound1_rad);
    jcal_put_f32(bytes + AT_BOUND2, kept->bound2_rad);
    if (kept->kind == JCAL_KEPT_HINGE) {
        jcal_put_f32(bytes + AT_FLEXION, kept->flexion_bound_rad);
    }
    if (kept->has_zero) {
        jcal_put_f32(bytes + AT_ZERO, kept->flexion_zero_rad);
        jcal_put_f32(bytes + AT_ZERO + 4, kept->pronation_zero_rad);
    }
}

static void put_levers(const jcal_kept_t *kept, uint8_t *bytes)
{
    jcal_put_vec3(bytes + AT_LEVER1, kept->lever1_m);
    jcal_put_vec3(bytes + AT_LEVER2, kept->lever2_m);
    jcal_put_f32(bytes + AT_BOUND_LEVER1, kept->bound_lever1_m);
    jcal_put_f32(bytes + AT_BOUND_LEVER2, kept->bound_lever2_m);
}

static void put_residuals(const jcal_kept_t *kept, uint8_t *bytes)
{
    if (kept->has_lag) {
        jcal_put_f32(bytes + AT_LAG, kept->lag_s);
        jcal_put_f32(bytes + AT_BOUND_LAG, kept->lag_bound_s);
    }
    for (unsigned f = 0u; kept->has_usual && (f < 3u); ++f) {
        jcal_put_f32(bytes + AT_USUAL + (4u * f), kept->usual[f]);
    }
}

jcal_status_t jcal_kept_encode(const jcal_kept_t *kept, uint8_t bytes[JCAL_KEPT_BYTES])
{
    if ((bytes == NULL) || !jcal_kept_is_valid(kept)) {
        return JCAL_ERR_ARG;
    }
    for (unsigned i = 0u; i < JCAL_KEPT_BYTES; ++i) {
        bytes[i] = 0u;
    }
    jcal_put_u32(bytes + AT_MAGIC, MAGIC);
    bytes[AT_VERSION] = JCAL_KEPT_VERSION;
    bytes[AT_KIND] = (uint8_t)kept->kind;
    bytes[AT_JOINT] = kept->joint;
    bytes[AT_FLAGS] = flags_of(kept);
    jcal_put_u32(bytes + AT_SEQUENCE, kept->sequence);
    jcal_put_u64(bytes + AT_SERIAL1, kept->serial1);
    jcal_put_u64(bytes + AT_SERIAL2, kept->serial2);
    if (kept->kind != JCAL_KEPT_BALL) {
        put_axes(kept, bytes);
    } else if (kept->has_zero) {
        jcal_put_quat(bytes + AT_FRAME1, kept->frames.q_b1_s1);
        jcal_put_quat(bytes + AT_FRAME2, kept->frames.q_b2_s2);
    }
    if (kept->has_levers) {
        put_levers(kept, bytes);
    }
    put_residuals(kept, bytes);
    jcal_put_u32(bytes + AT_CRC, jcal_crc32(bytes, AT_CRC));
    return JCAL_OK;
}

static void get_axes(jcal_kept_t *kept, const uint8_t *bytes)
{
    kept->axis1 = jcal_get_vec3(bytes + AT_AXIS1);
    kept->axis2 = jcal_get_vec3(bytes + AT_AXIS2);
    kept->bound1_rad = jcal_get_f32(bytes + AT_BOUND1);
    kept->bound2_rad = jcal_get_f32(bytes + AT_BOUND2);
    kept->flexion_bound_rad = jcal_get_f32(bytes + AT_FLEXION);
    kept->flexion_zero_rad = jcal_get_f32(bytes + AT_ZERO);
    kept->pronation_zero_rad = jcal_get_f32(bytes + AT_ZERO + 4);
}

static void get_all(jcal_kept_t *kept, const uint8_t *bytes)
{
    const unsigned flags = bytes[AT_FLAGS];
    *kept = (jcal_kept_t){0};
    kept->kind = (jcal_kept_kind_t)bytes[AT_KIND];
    kept->model = ((flags & FLAG_FUNCTIONAL) != 0u) ? JCAL_MODEL_FUNCTIONAL : JCAL_MODEL_RIGID;
    kept->heading = ((flags & FLAG_BY_CENTER) != 0u) ? JCAL_KEPT_HEADING_BY_CENTER : JCAL_KEPT_HEADING_BY_AXES;
    kept->has_levers = (flags & FLAG_LEVERS) != 0u;
    kept->has_zero = (flags & FLAG_ZERO) != 0u;
    kept->has_lag = (flags & FLAG_LAG) != 0u;
    kept->has_usual = (flags & FLAG_USUAL) != 0u;
    kept->joint = bytes[AT_JOINT];
    kept->sequence = jcal_get_u32(bytes + AT_SEQUENCE);
    kept->serial1 = jcal_get_u64(bytes + AT_SERIAL1);
    kept->serial2 = jcal_get_u64(bytes + AT_SERIAL2);
    if (kept->kind != JCAL_KEPT_BALL) {
        get_axes(kept, bytes);
    } else if (kept->has_zero) {
        kept->frames.q_b1_s1 = jcal_get_quat(bytes + AT_FRAME1);
        kept->frames.q_b2_s2 = jcal_get_quat(bytes + AT_FRAME2);
    }
    if (kept->has_levers) {
        kept->lever1_m = jcal_get_vec3(bytes + AT_LEVER1);
        kept->lever2_m = jcal_get_vec3(bytes + AT_LEVER2);
        kept->bound_lever1_m = jcal_get_f32(bytes + AT_BOUND_LEVER1);
        kept->bound_lever2_m = jcal_get_f32(bytes + AT_BOUND_LEVER2);
    }
    if (kept->has_lag) {
        kept->lag_s = jcal_get_f32(bytes + AT_LAG);
        kept->lag_bound_s = jcal_get_f32(bytes + AT_BOUND_LAG);
    }
    for (unsigned f = 0u; kept->has_usual && (f < 3u); ++f) {
        kept->usual[f] = jcal_get_f32(bytes + AT_USUAL + (4u * f));
    }
}

static bool is_same(const uint8_t *a, const uint8_t *b)
{
    unsigned differs = 0u;
    for (unsigned i = 0u; i < JCAL_KEPT_BYTES; ++i) {
        differs |= (unsigned)(a[i] ^ b[i]);
    }
    return differs == 0u;
}

/// Reads the values of bytes whose CRC is right. A record is what encode writes and nothing else: bytes that mean nothing are zero.
static bool read_values(const uint8_t *bytes, jcal_kept_t *kept)
{
    uint8_t again[JCAL_KEPT_BYTES];
    if (((bytes[AT_FLAGS] & ~FLAGS_ALL) != 0u) || (bytes[AT_KIND] < (uint8_t)JCAL_KEPT_HINGE) ||
        (bytes[AT_KIND] > (uint8_t)JCAL_KEPT_BALL)) {
        return false;
    }
    get_all(kept, bytes);
    return (jcal_kept_encode(kept, again) == JCAL_OK) && is_same(bytes, again);
}

jcal_kept_refusal_t jcal_kept_decode(const uint8_t bytes[JCAL_KEPT_BYTES], const jcal_kept_wanted_t *wanted,
                                     jcal_kept_t *out)
{
    jcal_kept_t kept;
    if ((bytes == NULL) || (out == NULL)) {
        return JCAL_KEPT_DAMAGED;
    }
    if (jcal_is_erased(bytes, JCAL_KEPT_BYTES)) {
        return JCAL_KEPT_NONE;
    }
    if ((jcal_get_u32(bytes + AT_MAGIC) != MAGIC) || (jcal_get_u32(bytes + AT_CRC) != jcal_crc32(bytes, AT_CRC))) {
        return JCAL_KEPT_DAMAGED;
    }
    if (bytes[AT_VERSION] != JCAL_KEPT_VERSION) {
        return JCAL_KEPT_OTHER_VERSION;
    }
    if (!read_values(bytes, &kept)) {
        return JCAL_KEPT_DAMAGED;
    }
    if ((wanted != NULL) && ((kept.kind != wanted->kind) || (kept.joint != wanted->joint))) {
        return JCAL_KEPT_OTHER_KIND;
    }
    if ((wanted != NULL) && ((kept.serial1 != wanted->serial1) || (kept.serial2 != wanted->serial2))) {
        return JCAL_KEPT_OTHER_SENSORS;
    }
    *out = kept;
    return JCAL_KEPT_FITS;
}

const char *jcal_kept_refusal_string(jcal_kept_refusal_t refusal)
{
    static const char *const WORDS[] = {"fits", "none", "damaged", "other_version", "other_kind", "other_sensors"};
    const size_t at = (size_t)(unsigned)refusal;
    return (at < (sizeof(WORDS) / sizeof(WORDS[0]))) ? WORDS[at] : "unknown";
}
