/* SPDX-License-Identifier: MIT */
/// @file
/// Power that goes at any of 1,000 moments of a body's sessions: a new body remembers what was kept last.
///
/// A thigh and a shank on three days, each day mounted otherwise, so that each day has something worth a write. A moment is a step of
/// the body or an access of flash: an eighth of an erase, a byte that is programmed. What reaches flash is written down; so the flash of every
/// moment can be made again, and a new body begins with it.
#include "unit/body/fixture.h"
#include "unit/keep/fixture.h"

enum { DAYS = 3, DAY_STEPS = 14000, CUTS = 1000, OPS_MAX = 200, LEFT_OF_DAY = 30 };
#define ERASE_OP UINT32_MAX

/* What reached flash, and at which step of which day. */
typedef struct {
    uint32_t step, slot, offset, n;
    uint8_t bytes[JCAL_KEPT_BYTES];
} op_t;

static op_t ops[OPS_MAX];
static unsigned op_count;
static uint32_t step_now;
static ram_flash_t ram;
static body_fixture_t f;

static void note(unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    TEST_ASSERT_TRUE(op_count < OPS_MAX && n <= sizeof ops[0].bytes);
    op_t *const op = &ops[op_count];
    op->step = step_now;
    op->slot = slot;
    op->offset = offset;
    op->n = n;
    if (n > 0u) {
        memcpy(op->bytes, bytes, n);
    }
    ++op_count;
}

static bool erase_noted(void *context, unsigned slot)
{
    note(slot, ERASE_OP, NULL, 0u);
    return ram_erase(context, slot);
}

static bool program_noted(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    note(slot, offset, bytes, n);
    return ram_program(context, slot, offset, bytes, n);
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void begin_day(const jcal_flash_t *flash)
{
    body_fill(&f, 2u);
    f.sensors[0].serial = 11u;
    f.sensors[1].serial = 12u;
    f.table.flash = flash;
    body_begin(&f);
}

static void send_both(const hinge_t *hinge, uint32_t k)
{
    for (unsigned s = 0u; s < 2u; ++s) {
        hinge_sensor_t of;
        hinge_sensor(hinge, 0.01 * k, (int)s + 1, &of);
        const float values[6] = {(float)of.gyr[0],   (float)of.gyr[1],   (float)of.gyr[2],
                                 (float)of.force[0], (float)of.force[1], (float)of.force[2]};
        body_send(&f, s, 777000u + ((uint64_t)k * BODY_PERIOD_US), values);
    }
}

static void play_days(const jcal_flash_t *flash)
{
    for (unsigned day = 0u; day < DAYS; ++day) {
        hinge_t hinge = hinge_usual();
        const double more[3] = {0.6 * day, 0.4 * day, -0.5 * day};
        mat_turn(more, hinge.mount2);
        begin_day(flash);
        for (uint32_t k = 0u; k < DAY_STEPS; ++k, ++step_now) {
            send_both(&hinge, k);
            (void)body_work(&f, 777000u + ((uint64_t)k * BODY_PERIOD_US));
            if (jcal_body_keep_due(&f.body)) {
                TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_keep(&f.body));
            }
        }
    }
}

/* The flash as it was when `accesses` of an op had been made, and all ops before it. */
static void make_flash(unsigned op, uint32_t accesses)
{
    const uint32_t noise = ram.noise;
    (void)ram_flash(&ram);
    ram.noise = noise;
    for (unsigned k = 0u; k <= op && k < op_count; ++k) {
        ram.left = (k == op) ? accesses : POWER_FOR_EVER;
        if (ops[k].offset == ERASE_OP) {
            (void)ram_erase(&ram, ops[k].slot);
        } else {
            (void)ram_program(&ram, ops[k].slot, ops[k].offset, ops[k].bytes, ops[k].n);
        }
    }
    ram.left = POWER_FOR_EVER;
}

/* Writes that had come to their end before an op: heads that were programmed, at offset 0, last of each write. */
static uint32_t writes_before(unsigned op)
{
    uint32_t writes = 0u;
    for (unsigned k = 0u; k < op; ++k) {
        writes += (ops[k].offset == 0u) ? 1u : 0u;
    }
    return writes;
}

static unsigned ops_until(uint32_t step)
{
    unsigned k = 0u;
    while (k < op_count && ops[k].step < step) {
        ++k;
    }
    return k;
}

/* A new body on the flash of that moment: what was written `writes` times is remembered, or, in the last op of a write, one more. */
static void assert_comes_back(const jcal_flash_t *flash, uint32_t writes, bool may_be_one_more)
{
    const uint32_t found = jcal_keep_writes(flash);
    TEST_ASSERT_TRUE(found == writes || (may_be_one_more && found == writes + 1u));
    begin_day(flash);
    const hinge_t hinge = hinge_usual();
    for (uint32_t k = 0u; k < LEFT_OF_DAY; ++k) {
        send_both(&hinge, k);
        (void)body_work(&f, 777000u + ((uint64_t)k * BODY_PERIOD_US));
    }
    const jcal_body_joint_result_t joint = body_joint(&f, 0u);
    TEST_ASSERT_EQUAL(found > 0u, joint.has_kept);
    jcal_kept_t kept;
    const jcal_kept_wanted_t wanted = {JCAL_KEPT_HINGE, 0u, 11u, 12u};
    TEST_ASSERT_EQUAL_INT((found > 0u) ? JCAL_KEPT_FITS : JCAL_KEPT_NONE, jcal_keep_load(flash, &wanted, &kept));
    if (found > 0u) {
        TEST_ASSERT_EQUAL_INT(JCAL_REMEMBERED, joint.kept);
        TEST_ASSERT_EQUAL_UINT32(found, kept.sequence); /* each write had something new */
    }
    TEST_ASSERT_NOT_EQUAL_INT(JCAL_READY, joint.head.status);
}

static void what_was_kept_last_comes_back(void)
{
    jcal_flash_t flash = ram_flash(&ram);
    flash.erase = erase_noted;
    flash.program = program_noted;
    play_days(&flash);
    TEST_ASSERT_TRUE(writes_before(op_count) >= DAYS);
    flash.erase = ram_erase;
    flash.program = ram_program;
    uint32_t seed = 88172645u;
    for (unsigned cut = 0u; cut < CUTS; ++cut) {
        if ((cut % 2u) == 0u) { /* at a step: nothing of the next access, or a part of its first byte */
            const unsigned op = ops_until(chance(&seed) % (DAYS * DAY_STEPS));
            make_flash(op, 0u);
            assert_comes_back(&flash, writes_before(op), false);
        } else { /* within an access of flash */
            const unsigned op = chance(&seed) % op_count;
            const uint32_t most = (ops[op].offset == ERASE_OP) ? ERASE_STAGES : ops[op].n;
            make_flash(op, chance(&seed) % (most + 1u));
            assert_comes_back(&flash, writes_before(op), ops[op].offset == 0u);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(what_was_kept_last_comes_back);
    return UNITY_END();
}
