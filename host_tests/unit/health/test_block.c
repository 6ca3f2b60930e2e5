/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of health/block.h: turns within a block beside double precision, where axes change from reading to reading.
#include "health/block.h"

#include "imu/turn.h"
#include "unit/health/fixture.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* Ten readings of 10 ms at 4 rad/s, whose axis goes round. */
static void rates_of(int k, double w[3])
{
    w[0] = 4.0 * cos(0.5 * k);
    w[1] = 4.0 * sin(0.5 * k);
    w[2] = 1.0;
}

/* The block, and beside it in double precision the orientation at its end and the sum of forces turned back. */
static jcal_health_block_t fill(float scale, double end[9], double sum[3])
{
    jcal_health_block_t block;
    memset(&block, 0, sizeof block);
    world_t world = world_begin();
    memset(sum, 0, 3 * sizeof(double));
    for (int k = 0; k < 10; ++k) {
        double w[3];
        rates_of(k, w);
        const jcal_imu_t imu = {{(float)w[0], (float)w[1], (float)w[2]}, {3.0f, -7.0f, 5.0f}};
        const bool is_full = jcal_health_block_add(&block, &imu, 0.01f, scale);
        TEST_ASSERT_EQUAL(k == 9, is_full);
        const double half[3] = {0.005 * (double)scale * w[0], 0.005 * (double)scale * w[1],
                                0.005 * (double)scale * w[2]};
        world_turn(world.r, half);
        for (int i = 0; i < 3; ++i) {
            sum[i] += 3.0 * world.r[3 * i] - 7.0 * world.r[3 * i + 1] + 5.0 * world.r[3 * i + 2];
        }
        world_turn(world.r, half);
    }
    memcpy(end, world.r, sizeof(world.r));
    return block;
}

/* A series to second order in turns of up to 0.2 rad: angles are right to a third of a thousandth, forces to 0.2^3 / 6. */
static void turns_and_forces_are_right_to_second_order(void)
{
    const float scales[] = {1.0f, 0.8f};
    for (unsigned n = 0u; n < 2u; ++n) {
        double end[9];
        double sum[3];
        const jcal_health_block_t block = fill(scales[n], end, sum);
        float r[9];
        jcal_turn_matrix(jcal_turn_by(block.angle), r);
        for (int i = 0; i < 9; ++i) {
            TEST_ASSERT_FLOAT_WITHIN(7e-4f, (float)end[i], r[i]);
        }
        const float found[3] = {block.back_sum.x, block.back_sum.y, block.back_sum.z};
        for (int i = 0; i < 3; ++i) {
            TEST_ASSERT_FLOAT_WITHIN(10.0f * 9.1f * 5e-4f, (float)sum[i], found[i]);
        }
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.1f, block.length_s);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, 30.0f, block.acc_sum.x);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.1f * scales[n], block.turn.z);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(turns_and_forces_are_right_to_second_order);
    return UNITY_END();
}
