/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/keep.h: the layout beside bytes made from its description, refusals, bytes by chance.
#include "keep/bytes.h"
#include "unit/keep/fixture.h"

#include <math.h>

void setUp(void)
{
}

void tearDown(void)
{
}

/* python: struct.pack("<4sBBBBIQQ3f3f2ff3f3f2f2f20x", b"JCKR", 1, 1, 3, 15, ...) + struct.pack("<I", zlib.crc32(...)) of hinge_of(3). */
static const uint8_t HINGE[JCAL_KEPT_BYTES] = {
    0x4A, 0x43, 0x4B, 0x52, 0x01, 0x01, 0x03, 0x0F, 0x04, 0x03, 0x02, 0x01, 0x88, 0x77, 0x66, 0x55, 0x44, 0x33, 0x22,
    0x11, 0x00, 0xFF, 0xEE, 0xDD, 0xCC, 0xBB, 0xAA, 0x99, 0x9A, 0x99, 0x19, 0x3F, 0x00, 0x00, 0x00, 0x00, 0xCD, 0xCC,
    0x4C, 0xBF, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x80, 0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x3D, 0x00,
    0x00, 0x80, 0x3D, 0x00, 0x00, 0x80, 0x3C, 0x00, 0x00, 0x80, 0x3E, 0x00, 0x00, 0x00, 0xBF, 0x00, 0x00, 0x00, 0x3E,
    0x00, 0x00, 0x80, 0xBD, 0x00, 0x00, 0x80, 0x3F, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x00, 0x3F, 0x00, 0x00, 0x20,
    0x41, 0x00, 0x00, 0xC0, 0xBF, 0x00, 0x00, 0x40, 0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x61, 0x36, 0xEC, 0xCF};

/* The same with "<4sBBBBIQQ4f4f4x3f3f2f8x20x" of ball_of(30). */
static const uint8_t BALL[JCAL_KEPT_BYTES] = {
    0x4A, 0x43, 0x4B, 0x52, 0x01, 0x03, 0x1E, 0x0E, 0x07, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x02, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x3F, 0x00, 0x00, 0x00, 0xBF, 0x00, 0x00,
    0x00, 0x3F, 0x00, 0x00, 0x00, 0x3F, 0x00, 0x00, 0x80, 0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x80, 0x3E, 0x00, 0x00, 0x00, 0xBF, 0x00, 0x00, 0x00, 0x3E,
    0x00, 0x00, 0x80, 0xBD, 0x00, 0x00, 0x80, 0x3F, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x00, 0x3F, 0x00, 0x00, 0x20,
    0x41, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xF6, 0x0C, 0xFF, 0x2D};

static void close_record(uint8_t *bytes)
{
    jcal_put_u32(bytes + 124, jcal_crc32(bytes, 124u));
}

static void check_layout(const jcal_kept_t *kept, const uint8_t *expected)
{
    uint8_t bytes[JCAL_KEPT_BYTES];
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_encode(kept, bytes));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, bytes, JCAL_KEPT_BYTES);
    const jcal_kept_wanted_t wanted = wanted_of(kept);
    jcal_kept_t out;
    memset(&out, 0x5A, sizeof out);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_FITS, jcal_kept_decode(expected, &wanted, &out));
    assert_kept(kept, &out);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_FITS, jcal_kept_decode(expected, NULL, &out));
}

static void bytes_are_those_of_the_description(void)
{
    const jcal_kept_t hinge = hinge_of(3u);
    const jcal_kept_t ball = ball_of(30u);
    check_layout(&hinge, HINGE);
    check_layout(&ball, BALL);
    /* the usual check value of this CRC */
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, jcal_crc32((const uint8_t *)"123456789", 9u));
}

/* What a kind does not have, or is not known, is not written. */
static void what_is_not_known_comes_back_as_zero(void)
{
    jcal_kept_t kept = hinge_of(0u);
    kept.kind = JCAL_KEPT_TWO_AXES;
    kept.has_levers = false;
    kept.has_zero = false;
    uint8_t bytes[JCAL_KEPT_BYTES];
    jcal_kept_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_encode(&kept, bytes));
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_FITS, jcal_kept_decode(bytes, NULL, &out));
    kept.flexion_bound_rad = 0.0f;
    kept.lever1_m = (jcal_vec3_t){0};
    kept.lever2_m = (jcal_vec3_t){0};
    kept.bound_lever1_m = 0.0f;
    kept.bound_lever2_m = 0.0f;
    kept.flexion_zero_rad = 0.0f;
    kept.pronation_zero_rad = 0.0f;
    assert_kept(&kept, &out);
    for (unsigned i = 60u; i < 124u; ++i) {
        TEST_ASSERT_EQUAL_HEX8(0u, bytes[i]);
    }
}

/* The description says where: the lag at 104, its bound at 108, residuals at 112. */
static void the_lag_and_usual_residuals_come_back(void)
{
    static const uint8_t EXPECTED[] = {0x00, 0x00, 0x80, 0xBD, 0x00, 0x00, 0x00, 0x3C, 0x00, 0x00,
                                       0x00, 0x3F, 0x00, 0x00, 0x80, 0x3E, 0x00, 0x00, 0x00, 0x3B};
    jcal_kept_t kept = hinge_of(0u);
    jcal_kept_t out;
    uint8_t bytes[JCAL_KEPT_BYTES];
    kept.has_lag = true;
    kept.lag_s = -0.0625f;
    kept.lag_bound_s = 0.0078125f;
    kept.has_usual = true;
    kept.usual[0] = 0.5f;
    kept.usual[1] = 0.25f;
    kept.usual[2] = 0.001953125f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_encode(&kept, bytes));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(EXPECTED, &bytes[104], sizeof EXPECTED);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_FITS, jcal_kept_decode(bytes, NULL, &out));
    assert_kept(&kept, &out);
    kept.lag_s = 10.5f; /* beyond JCAL_KEPT_LAG_MAX_S */
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_encode(&kept, bytes));
    kept.lag_s = 0.0f;
    kept.lag_bound_s = -0.001f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_encode(&kept, bytes));
    kept.lag_bound_s = 0.0f;
    kept.usual[2] = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_encode(&kept, bytes));
}

static jcal_kept_refusal_t decode(const uint8_t *bytes, const jcal_kept_wanted_t *wanted)
{
    jcal_kept_t out;
    jcal_kept_t before;
    memset(&out, 0x5A, sizeof out);
    before = out;
    const jcal_kept_refusal_t refusal = jcal_kept_decode(bytes, wanted, &out);
    if (refusal != JCAL_KEPT_FITS) {
        TEST_ASSERT_EQUAL_MEMORY(&before, &out, sizeof out);
    }
    return refusal;
}

static void each_refusal_says_why(void)
{
    const jcal_kept_t kept = hinge_of(3u);
    jcal_kept_wanted_t wanted = wanted_of(&kept);
    uint8_t bytes[JCAL_KEPT_BYTES];
    memset(bytes, 0xFF, sizeof bytes);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_NONE, decode(bytes, &wanted));
    memset(bytes, 0, sizeof bytes);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, decode(bytes, &wanted));
    memcpy(bytes, HINGE, sizeof bytes);
    bytes[0] = 'j';
    close_record(bytes);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, decode(bytes, &wanted));
    memcpy(bytes, HINGE, sizeof bytes);
    bytes[4] = 2u;
    close_record(bytes);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_OTHER_VERSION, decode(bytes, &wanted));
    wanted.kind = JCAL_KEPT_TWO_AXES;
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_OTHER_KIND, decode(HINGE, &wanted));
    wanted = wanted_of(&kept);
    wanted.joint = 4u;
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_OTHER_KIND, decode(HINGE, &wanted));
    wanted = wanted_of(&kept);
    wanted.serial1 ^= UINT64_C(1) << 63;
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_OTHER_SENSORS, decode(HINGE, &wanted));
    wanted = wanted_of(&kept);
    wanted.serial2 ^= 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_OTHER_SENSORS, decode(HINGE, &wanted));
    wanted.serial1 = kept.serial2;
    wanted.serial2 = kept.serial1;
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_OTHER_SENSORS, decode(HINGE, &wanted));
}

static void float_at(uint8_t *bytes, const uint8_t *from, unsigned at, float value)
{
    memcpy(bytes, from, JCAL_KEPT_BYTES);
    jcal_put_f32(bytes + at, value);
    close_record(bytes);
}

/* The CRC is right and the values are none. */
static void values_that_no_record_has_are_damage(void)
{
    static const struct {
        unsigned at;
        float value;
    } WRONG[] = {{28u, 1.5f},  {28u, NAN},      {40u, 0.3f},  {52u, -0.01f}, {52u, 1.6f},   {56u, NAN},   {56u, 1.6f},
                 {60u, -1.0f}, {60u, INFINITY}, {64u, 10.5f}, {68u, -10.5f}, {72u, NAN},    {76u, 11.0f}, {80u, -11.0f},
                 {84u, NAN},   {88u, -0.1f},    {92u, 10.5f}, {96u, 3.2f},   {100u, -3.2f}, {104u, 1.0f}, {120u, 1.0f}};
    uint8_t bytes[JCAL_KEPT_BYTES];
    for (unsigned i = 0u; i < sizeof WRONG / sizeof WRONG[0]; ++i) {
        float_at(bytes, HINGE, WRONG[i].at, WRONG[i].value);
        TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, decode(bytes, NULL));
    }
    static const unsigned OF_BALL[] = {28u, 32u, 36u, 40u, 44u, 48u, 52u, 56u, 60u, 64u, 88u, 96u};
    for (unsigned i = 0u; i < sizeof OF_BALL / sizeof OF_BALL[0]; ++i) {
        float_at(bytes, BALL, OF_BALL[i], 20.0f);
        TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, decode(bytes, NULL));
    }
    static const uint8_t BYTES[][2] = {{5u, 0u}, {5u, 4u}, {6u, 31u}, {7u, 16u}, {7u, 128u}};
    for (unsigned i = 0u; i < sizeof BYTES / sizeof BYTES[0]; ++i) {
        memcpy(bytes, HINGE, sizeof bytes);
        bytes[BYTES[i][0]] = BYTES[i][1];
        close_record(bytes);
        TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, decode(bytes, NULL));
    }
    memcpy(bytes, HINGE, sizeof bytes);
    memcpy(bytes + 12, bytes + 20, 8u); /* one sensor on both sides */
    close_record(bytes);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, decode(bytes, NULL));
}

static void refuse(const jcal_kept_t *kept)
{
    uint8_t bytes[JCAL_KEPT_BYTES];
    uint8_t before[JCAL_KEPT_BYTES];
    memset(bytes, 0x5A, sizeof bytes);
    memset(before, 0x5A, sizeof before);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_encode(kept, bytes));
    TEST_ASSERT_EQUAL_MEMORY(before, bytes, sizeof bytes);
}

static void what_cannot_be_read_is_not_written(void)
{
    refuse(NULL);
    jcal_kept_t kept = hinge_of(JCAL_KEEP_JOINTS_MAX);
    refuse(&kept);
    kept = hinge_of(0u);
    kept.axis2.x = 0.5f;
    refuse(&kept);
    kept = hinge_of(0u);
    kept.bound1_rad = NAN;
    refuse(&kept);
    kept = hinge_of(0u);
    kept.serial1 = kept.serial2;
    refuse(&kept);
    kept = ball_of(0u);
    kept.frames.q_b2_s2.w = 0.0f;
    refuse(&kept);
    jcal_kept_t out;
    const jcal_kept_t good = hinge_of(0u);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_encode(&good, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, jcal_kept_decode(NULL, NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, jcal_kept_decode(HINGE, NULL, NULL));
}

/* Bytes by chance are refused; with magic, version, kind, flags, zeros and CRC put right they are refused, or come back the same. */
static void bytes_by_chance_are_refused_or_come_back(void)
{
    uint32_t noise = 1u;
    unsigned fits = 0u;
    for (unsigned n = 0u; n < 5000u; ++n) {
        uint8_t bytes[JCAL_KEPT_BYTES];
        for (unsigned i = 0u; i < sizeof bytes; ++i) {
            bytes[i] = (uint8_t)(chance(&noise) >> 11);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, decode(bytes, NULL));
        memcpy(bytes, HINGE, 6u);
        bytes[7] = (uint8_t)(bytes[7] & 3u);
        memcpy(bytes + 28, HINGE + 28, (n % 2u == 0u) ? 36u : 20u);
        memset(bytes + 64, 0, 60u);
        close_record(bytes);
        jcal_kept_t kept;
        if (jcal_kept_decode(bytes, NULL, &kept) == JCAL_KEPT_FITS) {
            uint8_t again[JCAL_KEPT_BYTES];
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_encode(&kept, again));
            TEST_ASSERT_EQUAL_MEMORY(bytes, again, sizeof bytes);
            ++fits;
        }
    }
    TEST_ASSERT_TRUE(fits > 100u && fits < 2500u);
}

static void every_refusal_has_a_word(void)
{
    static const char *const WORDS[] = {"fits", "none", "damaged", "other_version", "other_kind", "other_sensors"};
    for (int i = 0; i < 6; ++i) {
        TEST_ASSERT_EQUAL_STRING(WORDS[i], jcal_kept_refusal_string((jcal_kept_refusal_t)i));
    }
    TEST_ASSERT_EQUAL_STRING("unknown", jcal_kept_refusal_string((jcal_kept_refusal_t)7));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(bytes_are_those_of_the_description);
    RUN_TEST(what_is_not_known_comes_back_as_zero);
    RUN_TEST(the_lag_and_usual_residuals_come_back);
    RUN_TEST(each_refusal_says_why);
    RUN_TEST(values_that_no_record_has_are_damage);
    RUN_TEST(what_cannot_be_read_is_not_written);
    RUN_TEST(bytes_by_chance_are_refused_or_come_back);
    RUN_TEST(every_refusal_has_a_word);
    return UNITY_END();
}
