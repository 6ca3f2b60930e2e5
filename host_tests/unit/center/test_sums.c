/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of center/sums.h: sums that move with the estimate, against sums of blocks that are moved one by one.
#include "center/sums.h"
#include "math/sym.h"

#include <math.h>
#include <string.h>
#include <unity.h>

enum { N = JCAL_CENTER_UNKNOWNS, BLOCKS = 5 };

static jcal_center_sums_t sums;
static uint32_t state;

void setUp(void)
{
    const jcal_center_place_t place = {{0.1f, 0.0f, 0.0f}, {0.0f, 0.2f, 0.0f}};
    state = 11u;
    jcal_center_sums_begin(&sums, &place);
}

void tearDown(void)
{
}

static double chance(void)
{
    state = (state * 1664525u) + 1013904223u;
    return ((double)(state >> 8) / 16777216.0) - 0.5;
}

/* A gradient of each block; all have the same matrix. */
static void fill(double blocks[BLOCKS][N], double matrix[N][N])
{
    for (int i = 0; i < N; ++i) {
        for (int j = 0; j <= i; ++j) {
            matrix[i][j] = matrix[j][i] = (i == j) ? 20.0 + chance() : chance();
        }
    }
    for (int b = 0; b < BLOCKS; ++b) {
        for (int i = 0; i < N; ++i) {
            blocks[b][i] = 4.0 * chance();
        }
    }
    for (unsigned i = 0; i < N; ++i) {
        for (unsigned j = 0; j <= i; ++j) {
            double sum = 0.0;
            for (int b = 0; b < BLOCKS; ++b) {
                sum += blocks[b][i] * blocks[b][j];
            }
            sums.scatter[jcal_sym_at(i, j)] = (float)sum;
            sums.matrix[jcal_sym_at(i, j)] = (float)(BLOCKS * matrix[i][j]);
        }
        for (int b = 0; b < BLOCKS; ++b) {
            sums.closed[i] += (float)blocks[b][i];
            sums.gradient[i] += (float)blocks[b][i];
        }
    }
    sums.blocks = BLOCKS;
    sums.time_s = BLOCKS * JCAL_CENTER_BLOCK_S;
    sums.noise = 1e4f;
    sums.cost = 1e4f;
}

static void blocks_that_are_alike_move_exactly(void)
{
    double blocks[BLOCKS][N], matrix[N][N];
    float d[N];
    fill(blocks, matrix);
    for (int i = 0; i < N; ++i) {
        d[i] = (float)(0.2 * chance());
    }
    const float cost = sums.cost;
    double gain = 0.0;
    for (int b = 0; b < BLOCKS; ++b) {
        for (int i = 0; i < N; ++i) {
            double on = 0.0;
            for (int j = 0; j < N; ++j) {
                on += matrix[i][j] * (double)d[j];
            }
            gain += (double)d[i] * ((2.0 * blocks[b][i]) + on);
            blocks[b][i] += on;
        }
    }
    jcal_center_sums_move(&sums, d);
    for (unsigned i = 0; i < N; ++i) {
        double gradient = 0.0;
        for (int b = 0; b < BLOCKS; ++b) {
            gradient += blocks[b][i];
        }
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)gradient, sums.gradient[i]);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)gradient, sums.closed[i]);
        for (unsigned j = 0; j <= i; ++j) {
            double sum = 0.0;
            for (int b = 0; b < BLOCKS; ++b) {
                sum += blocks[b][i] * blocks[b][j];
            }
            TEST_ASSERT_FLOAT_WITHIN(1e-3f, (float)sum, sums.scatter[jcal_sym_at(i, j)]);
        }
    }
    TEST_ASSERT_FLOAT_WITHIN(0.01f, cost + (float)gain, sums.cost);
    TEST_ASSERT_EQUAL_FLOAT(0.1f + d[0], sums.point.place.r1.x);
    TEST_ASSERT_EQUAL_FLOAT(0.2f + d[4], sums.point.place.r2.y);
    TEST_ASSERT_EQUAL_FLOAT(d[8], sums.point.b1.z);
    TEST_ASSERT_EQUAL_FLOAT(d[9], sums.point.b2.x);
}

static void a_block_that_is_open_moves_by_its_time(void)
{
    double blocks[BLOCKS][N], matrix[N][N];
    float d[N] = {0.0f};
    fill(blocks, matrix);
    sums.block_s = 0.25f * sums.time_s;
    d[2] = 0.01f;
    jcal_center_sums_move(&sums, d);
    for (int i = 0; i < N; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)(0.25 * BLOCKS * 0.01 * matrix[i][2]), sums.block[i]);
    }
}

static void without_a_closed_block_there_is_no_scatter_to_move(void)
{
    double blocks[BLOCKS][N], matrix[N][N];
    float d[N] = {0.0f};
    fill(blocks, matrix);
    for (unsigned k = 0; k < JCAL_SYM_SIZE(N); ++k) {
        sums.scatter[k] = 0.0f;
    }
    sums.blocks = 0.0f;
    const float gradient = sums.gradient[3];
    d[2] = 0.01f;
    jcal_center_sums_move(&sums, d);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, gradient + (float)(BLOCKS * 0.01 * matrix[3][2]), sums.gradient[3]);
    for (unsigned k = 0; k < JCAL_SYM_SIZE(N); ++k) {
        TEST_ASSERT_EQUAL_FLOAT(0.0f, sums.scatter[k]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(blocks_that_are_alike_move_exactly);
    RUN_TEST(a_block_that_is_open_moves_by_its_time);
    RUN_TEST(without_a_closed_block_there_is_no_scatter_to_move);
    return UNITY_END();
}
