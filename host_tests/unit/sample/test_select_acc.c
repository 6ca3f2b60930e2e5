/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of sample/select.h: Algorithm 3 against brute force.
#include "sample/select.h"

#include "math/eig.h"
#include "math/sym.h"
#include "unity.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 700, N_MAX = 60 };

static jcal_row_t rows[N_MAX + 1];

static float next_value(uint32_t *state)
{
    *state = (*state * 1664525u) + 1013904223u;
    return ((float)(*state >> 16) / 32768.0f) - 1.0f;
}

/* How many of `count` keys are above and below a value. */
static void rank(const float *keys, int count, float value, int *above, int *below)
{
    *above = 0;
    *below = 0;
    for (int k = 0; k < count; ++k) {
        *above += (keys[k] > value) ? 1 : 0;
        *below += (keys[k] < value) ? 1 : 0;
    }
}

void setUp(void)
{
}

void tearDown(void)
{
}

static jcal_row_t acc_row(int k, float penalty, uint32_t *state)
{
    jcal_row_t row = {penalty, (uint32_t)k, {0.0f}};
    for (size_t i = 0; i < 6; ++i) {
        row.v[i] = next_value(state) + ((i == 1) ? 5.0f : 0.0f) + ((i == 3) ? -5.0f : 0.0f);
    }
    return row;
}

static void assert_heap_and_ids(const jcal_select_acc_t *self, int offered)
{
    bool seen[SAMPLES] = {false};
    for (uint32_t i = 0; i < self->count; ++i) {
        TEST_ASSERT_TRUE((i == 0) || (rows[(i - 1) / 2].key >= rows[i].key));
        TEST_ASSERT_TRUE(rows[i].id < (uint32_t)offered);
        TEST_ASSERT_FALSE(seen[rows[i].id]);
        seen[rows[i].id] = true;
    }
}

static void accelerometer_rows_are_all_kept_until_there_are_more_than_n_max(void)
{
    jcal_select_acc_t self;
    uint32_t state = 3;
    jcal_select_acc_init(&self, N_MAX, 0, 1.0f);
    for (int k = 0; k < N_MAX; ++k) {
        const jcal_row_t row = acc_row(k, JCAL_PENALTY_INFINITE, &state);
        jcal_select_acc_offer(&self, rows, &row);
        TEST_ASSERT_EQUAL_UINT32((uint32_t)(k + 1), self.count);
        assert_heap_and_ids(&self, k + 1);
    }
    const jcal_row_t calm = acc_row(N_MAX, 0.5f, &state);
    jcal_select_acc_offer(&self, rows, &calm);
    TEST_ASSERT_EQUAL_UINT32(1, self.count);
    TEST_ASSERT_EQUAL_UINT32(N_MAX, rows[0].id);
}

static void never_fewer_than_acc_min_rows_are_kept_and_those_are_the_calmest(void)
{
    enum { ACC_MIN = 25 };
    float keys[SAMPLES];
    jcal_select_acc_t self;
    uint32_t state = 5;
    jcal_select_acc_init(&self, N_MAX, ACC_MIN, 1.0f);
    for (int k = 0; k < SAMPLES; ++k) {
        keys[k] = 1.5f + (fabsf(next_value(&state)) * 10.0f); /* all above the threshold */
        const jcal_row_t row = acc_row(k, keys[k], &state);
        jcal_select_acc_offer(&self, rows, &row);
        if (k >= N_MAX) {
            TEST_ASSERT_EQUAL_UINT32(ACC_MIN, self.count);
            int above = 0;
            int below = 0;
            rank(keys, k + 1, rows[0].key, &above, &below);
            TEST_ASSERT_EQUAL_INT(ACC_MIN - 1, below);
        }
        assert_heap_and_ids(&self, k + 1);
    }
    for (int k = 0; k < ACC_MIN; ++k) { /* calm rows push the lively ones out one by one */
        const jcal_row_t row = acc_row(k, 0.5f, &state);
        jcal_select_acc_offer(&self, rows, &row);
        TEST_ASSERT_EQUAL_UINT32(ACC_MIN, self.count);
    }
    TEST_ASSERT_TRUE(rows[0].key <= 1.0f);
}

static void a_minimum_above_n_max_counts_as_n_max(void)
{
    jcal_select_acc_t self;
    jcal_select_acc_init(&self, N_MAX, 10000, 1.0f);
    TEST_ASSERT_EQUAL_UINT32(N_MAX, self.acc_min);
}

/* Algorithm 3's loop body by full eigenvectors; the number of the sample that has to go. */
static uint32_t brute_redundant(const jcal_row_t *all, int count)
{
    float ata[JCAL_SYM_SIZE(6)];
    float values[6];
    float vectors[36];
    jcal_sym_zero(ata, 6);
    for (int k = 0; k < count; ++k) {
        jcal_sym_rank1(ata, 6, all[k].v, 1.0f);
    }
    TEST_ASSERT_TRUE(jcal_eig_symmetric(ata, 6, values, vectors));
    int worst = -1;
    int largest = 0;
    for (int k = 0; k < count; ++k) {
        double along = 0.0;
        double norm = 0.0;
        for (int i = 0; i < 6; ++i) {
            along += (double)all[k].v[i] * (double)vectors[i];
            norm += (double)all[k].v[i] * (double)all[k].v[i];
        }
        largest = (all[k].key > all[largest].key) ? k : largest;
        if ((fabs(along) / sqrt(norm) > 0.5) && ((worst < 0) || (all[k].key > all[worst].key))) {
            worst = k;
        }
    }
    return all[(worst < 0) ? largest : worst].id;
}

static void accelerometer_selection_removes_what_the_singular_vector_says(void)
{
    jcal_select_acc_t self;
    uint32_t state = 7;
    int agreed = 0;
    int removals = 0;
    jcal_select_acc_init(&self, N_MAX, 0, 1.0f);
    for (int k = 0; k < SAMPLES; ++k) {
        jcal_row_t before[N_MAX + 1];
        jcal_row_t row = acc_row(k, 0.5f * (1.0f + next_value(&state)), &state);
        if (k % 3 == 0) { /* a third of the rows point elsewhere */
            row.v[1] = 0.0f;
            row.v[3] = 0.0f;
        }
        memcpy(before, rows, sizeof before);
        const uint32_t count = self.count;
        before[count] = row;
        jcal_select_acc_offer(&self, rows, &row);
        if (count == N_MAX) {
            const uint32_t expected = brute_redundant(before, N_MAX + 1);
            bool gone = true;
            for (uint32_t i = 0; i < self.count; ++i) {
                gone = gone && (rows[i].id != expected);
            }
            agreed += gone ? 1 : 0;
            ++removals;
            TEST_ASSERT_EQUAL_UINT32(N_MAX, self.count);
        }
        assert_heap_and_ids(&self, k + 1);
    }
    TEST_ASSERT_EQUAL_INT(removals, agreed);
    TEST_ASSERT_TRUE(removals > 600);
}

/* Rows of a conference matrix: C C^T = 5 I, and no row is nearer than c = 1 / sqrt(5) to an axis. */
static const float conference[6][6] = {
    {0, 1, 1, 1, 1, 1},   {1, 0, 1, -1, -1, 1}, {1, 1, 0, 1, -1, -1},
    {1, -1, 1, 0, 1, -1}, {1, -1, -1, 1, 0, 1}, {1, 1, -1, -1, 1, 0},
};

static void without_a_coherent_row_the_largest_penalty_goes(void)
{
    enum { CAPACITY = 35, LARGEST = 17 };
    jcal_select_acc_t self;
    jcal_select_acc_init(&self, CAPACITY, 0, 100.0f);
    for (int k = 0; k <= CAPACITY; ++k) { /* six rows of each: A^T A is a multiple of I, w_1 an axis */
        jcal_row_t row = {(k == LARGEST) ? 9.0f : 1.0f, (uint32_t)k, {0.0f}};
        memcpy(row.v, conference[k % 6], sizeof row.v);
        jcal_select_acc_offer(&self, rows, &row);
    }
    TEST_ASSERT_EQUAL_UINT32(CAPACITY, self.count);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, rows[0].key);
    for (uint32_t i = 0; i < self.count; ++i) {
        TEST_ASSERT_TRUE(rows[i].id != LARGEST);
    }
}

static void rows_without_a_finite_matrix_go_by_their_penalty(void)
{
    jcal_select_acc_t self;
    jcal_select_acc_init(&self, 20, 0, 100.0f);
    for (int k = 0; k <= 20; ++k) {
        const jcal_row_t row = {(float)k, (uint32_t)k, {3e19f, 3e19f, 0.0f, 0.0f, 0.0f, 0.0f}};
        jcal_select_acc_offer(&self, rows, &row);
    }
    TEST_ASSERT_EQUAL_UINT32(20, self.count);
    TEST_ASSERT_EQUAL_FLOAT(19.0f, rows[0].key);
}

/* A million; on an emulated target fewer, which still is six hundred refreshes. */
#if defined(JCAL_TEST_SHORT)
enum { UPDATES = 30000 };
#else
enum { UPDATES = 1000000 };
#endif

static void the_matrix_follows_the_rows_over_a_million_updates(void)
{
    jcal_select_acc_t self;
    jcal_select_acc_t fresh;
    uint32_t state = 9;
    jcal_select_acc_init(&self, N_MAX, 0, 1.0f);
    for (int k = 0; k < UPDATES; ++k) {
        const jcal_row_t row = acc_row(k, 0.5f * (1.0f + next_value(&state)), &state);
        jcal_select_acc_offer(&self, rows, &row);
        if (k % 50 == 0) { /* the engine does it once a second */
            jcal_select_acc_refresh(&self, rows);
        }
    }
    fresh = self;
    jcal_select_acc_refresh(&fresh, rows);
    for (size_t i = 0; i < 21; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(2e-2f, fresh.ata[i], self.ata[i]); /* of up to 1600 */
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(accelerometer_rows_are_all_kept_until_there_are_more_than_n_max);
    RUN_TEST(never_fewer_than_acc_min_rows_are_kept_and_those_are_the_calmest);
    RUN_TEST(a_minimum_above_n_max_counts_as_n_max);
    RUN_TEST(accelerometer_selection_removes_what_the_singular_vector_says);
    RUN_TEST(without_a_coherent_row_the_largest_penalty_goes);
    RUN_TEST(rows_without_a_finite_matrix_go_by_their_penalty);
    RUN_TEST(the_matrix_follows_the_rows_over_a_million_updates);
    return UNITY_END();
}
