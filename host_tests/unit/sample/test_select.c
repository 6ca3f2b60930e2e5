/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of sample/select.h: scores and Algorithm 2 against brute force over all samples so far; the heap.
#include "sample/select.h"

#include "sample/heap.h"
#include "unity.h"

#include <math.h>

enum { SAMPLES = 700, N_MAX = 60, HALF_WINDOW_MAX = 30 };

/* Random selections, and calm after a violent stretch; fewer where floats are computed in software. */
#if defined(JCAL_TEST_SHORT)
enum { SEEDS = 3, HEAPS = 50, VIOLENT = 9980 };
#else
enum { SEEDS = 20, HEAPS = 200, VIOLENT = 99980 };
#endif

static jcal_pair_t recording[SAMPLES];
static double square1[SAMPLES]; /* |w1|^2, |w2|^2 of the recording */
static double square2[SAMPLES];
static double difference[SAMPLES]; /* |w1| - |w2| */
static jcal_score_slot_t slots[(2 * HALF_WINDOW_MAX) + 1];
static jcal_row_t rows[N_MAX + 1];

static float next_value(uint32_t *state)
{
    *state = (*state * 1664525u) + 1013904223u;
    return ((float)(*state >> 16) / 32768.0f) - 1.0f;
}

static double square(jcal_vec3_t v)
{
    return ((double)v.x * (double)v.x) + ((double)v.y * (double)v.y) + ((double)v.z * (double)v.z);
}

/* Calm and lively stretches, one sensor or both; gravity from all sides. */
static void make_recording(uint32_t seed)
{
    uint32_t state = seed;
    for (int k = 0; k < SAMPLES; ++k) {
        const float lively1 = ((k / 70) % 2 == 0) ? 0.3f : 3.0f;
        const float lively2 = ((k / 110) % 3 == 0) ? 4.0f : 0.5f;
        jcal_pair_t *p = &recording[k];
        p->t_us = (uint64_t)k * 20000u;
        p->imu1.gyr_rad_s =
            (jcal_vec3_t){lively1 * next_value(&state), lively1 * next_value(&state), lively1 * next_value(&state)};
        p->imu2.gyr_rad_s =
            (jcal_vec3_t){lively2 * next_value(&state), lively2 * next_value(&state), lively2 * next_value(&state)};
        p->imu1.acc_m_s2 = (jcal_vec3_t){next_value(&state), 9.0f + next_value(&state), 3.0f * next_value(&state)};
        p->imu2.acc_m_s2 = (jcal_vec3_t){9.0f + next_value(&state), next_value(&state), 3.0f * next_value(&state)};
        square1[k] = square(p->imu1.gyr_rad_s);
        square2[k] = square(p->imu2.gyr_rad_s);
        difference[k] = sqrt(square1[k]) - sqrt(square2[k]);
    }
}

/* (42)-(44) in double precision over samples [begin, end). */
static double brute_score(int k, int n, int begin, int end)
{
    double best = 1e30;
    for (int l = (k - n > begin) ? k - n : begin; (l <= k + n) && (l < end); ++l) {
        best = (fabs(difference[l]) < fabs(best)) ? difference[l] : best;
    }
    return best;
}

/* (45), (46). */
static double brute_penalty(int k, int n, int begin)
{
    if (k - n < begin) {
        return (double)JCAL_PENALTY_INFINITE;
    }
    double e1 = 0.0;
    double e2 = 0.0;
    for (int l = k - n; l <= k + n; ++l) {
        e1 += square1[l];
        e2 += square2[l];
    }
    return ((e1 < e2) ? e1 : e2) / (double)((2 * n) + 1);
}

void setUp(void)
{
    make_recording(11);
}

void tearDown(void)
{
}

static void scores_equal_brute_force_for_every_window_length(void)
{
    const int lengths[] = {0, 1, 2, 10, 21, HALF_WINDOW_MAX};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; ++i) {
        const int n = lengths[i];
        jcal_score_t score;
        jcal_score_init(&score, (uint16_t)n);
        for (int k = 0; k < SAMPLES; ++k) {
            jcal_scored_t out;
            const bool ready = jcal_score_push(&score, slots, &recording[k], (uint32_t)k, &out);
            TEST_ASSERT_EQUAL_INT(k >= n, ready);
            if (ready) {
                TEST_ASSERT_EQUAL_UINT32((uint32_t)(k - n), out.gyr.id);
                TEST_ASSERT_EQUAL_UINT32((uint32_t)(k - n), out.acc.id);
                TEST_ASSERT_FLOAT_WITHIN(2e-6f, (float)brute_score(k - n, n, 0, SAMPLES), out.gyr.key);
                const float penalty = (float)brute_penalty(k - n, n, 0);
                TEST_ASSERT_FLOAT_WITHIN(1e-5f * penalty, penalty, out.acc.key);
            }
        }
    }
}

static void rows_hold_the_sample_that_was_scored(void)
{
    jcal_score_t score;
    jcal_scored_t out;
    jcal_score_init(&score, 3);
    for (int k = 0; k < 50; ++k) {
        if (jcal_score_push(&score, slots, &recording[k], (uint32_t)k, &out)) {
            const jcal_pair_t *p = &recording[k - 3];
            const float gyr[6] = {p->imu1.gyr_rad_s.x, p->imu1.gyr_rad_s.y, p->imu1.gyr_rad_s.z,
                                  p->imu2.gyr_rad_s.x, p->imu2.gyr_rad_s.y, p->imu2.gyr_rad_s.z};
            const float acc[6] = {p->imu1.acc_m_s2.x,  p->imu1.acc_m_s2.y,  p->imu1.acc_m_s2.z,
                                  -p->imu2.acc_m_s2.x, -p->imu2.acc_m_s2.y, -p->imu2.acc_m_s2.z};
            TEST_ASSERT_EQUAL_FLOAT_ARRAY(gyr, out.gyr.v, 6);
            TEST_ASSERT_EQUAL_FLOAT_ARRAY(acc, out.acc.v, 6);
        }
    }
}

static void windows_start_anew_after_a_restart(void)
{
    const int n = 10;
    const int gap = 137;
    jcal_score_t score;
    jcal_score_init(&score, (uint16_t)n);
    for (int k = 0; k < 300; ++k) {
        jcal_scored_t out;
        if (k == gap) {
            jcal_score_restart(&score);
        }
        const bool ready = jcal_score_push(&score, slots, &recording[k], (uint32_t)k, &out);
        if (k >= gap) {
            TEST_ASSERT_EQUAL_INT(k >= gap + n, ready);
            if (ready) {
                TEST_ASSERT_FLOAT_WITHIN(2e-6f, (float)brute_score(k - n, n, gap, SAMPLES), out.gyr.key);
                const float penalty = (float)brute_penalty(k - n, n, gap);
                TEST_ASSERT_FLOAT_WITHIN(1e-5f * penalty, penalty, out.acc.key);
            }
        }
    }
}

static void energy_of_calm_samples_after_violent_ones_keeps_its_digits(void)
{
    jcal_score_t score;
    jcal_scored_t out = {0};
    jcal_score_init(&score, 5);
    for (int k = 0; k < VIOLENT + 20; ++k) {
        jcal_pair_t p = recording[0];
        const float rate = (k < VIOLENT) ? 35.0f : 1e-3f;
        p.imu1.gyr_rad_s = (jcal_vec3_t){rate, 0.0f, 0.0f};
        p.imu2.gyr_rad_s = (jcal_vec3_t){0.0f, rate, 0.0f};
        (void)jcal_score_push(&score, slots, &p, (uint32_t)k, &out);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-11f, 1e-6f, out.acc.key);
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

/* Algorithm 2 on all keys so far: a kept row is among the N/2 highest or lowest, all that must be there are there,
   none twice. */
static void assert_both_ends(const jcal_select_gyr_t *self, int n_max, const float *keys, int count)
{
    bool kept[SAMPLES] = {false};
    const int low_max = n_max / 2;
    const int high_max = n_max - low_max;
    const uint32_t sizes[2] = {self->low, self->high};
    TEST_ASSERT_EQUAL_UINT32((count < n_max) ? (uint32_t)count : (uint32_t)n_max, self->low + self->high);
    for (uint32_t part = 0; part < 2; ++part) {
        for (uint32_t i = 0; i < sizes[part]; ++i) {
            const jcal_row_t *row = &rows[(part * self->low_max) + i];
            TEST_ASSERT_FALSE(kept[row->id]);
            TEST_ASSERT_EQUAL_FLOAT(keys[row->id], (part == 0) ? row->key : -row->key);
            kept[row->id] = true;
        }
    }
    for (int k = 0; k < count; ++k) {
        int above = 0;
        int below = 0;
        rank(keys, count, keys[k], &above, &below);
        const int equal = count - above - below;
        const bool must = (above + equal <= high_max) || (below + equal <= low_max);
        const bool may = (above < high_max) || (below < low_max);
        TEST_ASSERT_TRUE(!must || kept[k]);
        TEST_ASSERT_TRUE(may || !kept[k]);
    }
}

static void check_gyr_selection(int n_max, float quantum, uint32_t seed, int every)
{
    float keys[SAMPLES];
    jcal_select_gyr_t self;
    uint32_t state = seed;
    jcal_select_gyr_init(&self, (uint32_t)n_max);
    for (int k = 0; k < SAMPLES; ++k) {
        const float value = next_value(&state) + (((k / 90) % 2 == 0) ? 0.5f : -0.5f);
        keys[k] = (quantum > 0.0f) ? (quantum * floorf(value / quantum)) : value;
        const jcal_row_t row = {keys[k], (uint32_t)k, {0.0f}};
        jcal_select_gyr_offer(&self, rows, &row);
        if ((k % every == 0) || (k < n_max + 20)) {
            assert_both_ends(&self, n_max, keys, k + 1);
        }
    }
}

static void gyroscope_selection_equals_the_batch_at_every_moment(void)
{
    for (uint32_t seed = 1; seed <= (uint32_t)SEEDS; ++seed) {
        check_gyr_selection(N_MAX - (int)(seed % 2u), 0.0f, seed, 7);
    }
}

static void gyroscope_selection_with_many_equal_scores_is_one_of_the_batch_selections(void)
{
    for (uint32_t seed = 1; seed <= (uint32_t)SEEDS; ++seed) {
        check_gyr_selection(N_MAX - (int)(seed % 2u), 0.25f, seed, 7);
        check_gyr_selection(N_MAX, 10.0f, seed, 50);
    }
}

static void gyroscope_selection_takes_rising_and_falling_scores(void)
{
    for (int falling = 0; falling < 2; ++falling) {
        float keys[SAMPLES];
        jcal_select_gyr_t self;
        jcal_select_gyr_init(&self, N_MAX);
        for (int k = 0; k < 300; ++k) {
            keys[k] = (falling == 1) ? -(float)k : (float)k;
            const jcal_row_t row = {keys[k], (uint32_t)k, {0.0f}};
            jcal_select_gyr_offer(&self, rows, &row);
            assert_both_ends(&self, N_MAX, keys, k + 1);
        }
    }
}

static void gyroscope_selection_places_a_row_between_a_full_and_a_short_heap(void)
{
    float keys[N_MAX];
    jcal_select_gyr_t self;
    jcal_select_gyr_init(&self, N_MAX);
    for (int k = 0; k < N_MAX; ++k) { /* one high row, the low heap full, then rows in between */
        keys[k] = (k == 0) ? 100.0f : ((k <= N_MAX / 2) ? (float)k : 50.0f + (0.5f * (float)(k % 7)));
        const jcal_row_t row = {keys[k], (uint32_t)k, {0.0f}};
        jcal_select_gyr_offer(&self, rows, &row);
        assert_both_ends(&self, N_MAX, keys, k + 1);
        TEST_ASSERT_TRUE((self.low == 0) || (self.high == 0) || (rows[0].key <= -rows[self.low_max].key));
    }
}

static void a_heap_gives_its_rows_back_in_order_whatever_is_removed(void)
{
    uint32_t state = 13;
    for (int pass = 0; pass < HEAPS; ++pass) {
        size_t count = 0;
        for (uint32_t k = 0; k < N_MAX; ++k) {
            const jcal_row_t row = {floorf(10.0f * next_value(&state)), k, {0.0f}};
            jcal_heap_insert(rows, count, &row);
            ++count;
        }
        for (int k = 0; k < 20; ++k) {
            jcal_heap_remove(rows, count, (size_t)((next_value(&state) + 1.0f) * 0.499f * (float)count));
            --count;
        }
        float last = 100.0f;
        while (count > 0) {
            TEST_ASSERT_TRUE(rows[0].key <= last);
            last = rows[0].key;
            jcal_heap_remove(rows, count, 0);
            --count;
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(scores_equal_brute_force_for_every_window_length);
    RUN_TEST(rows_hold_the_sample_that_was_scored);
    RUN_TEST(windows_start_anew_after_a_restart);
    RUN_TEST(energy_of_calm_samples_after_violent_ones_keeps_its_digits);
    RUN_TEST(gyroscope_selection_equals_the_batch_at_every_moment);
    RUN_TEST(gyroscope_selection_with_many_equal_scores_is_one_of_the_batch_selections);
    RUN_TEST(gyroscope_selection_takes_rising_and_falling_scores);
    RUN_TEST(gyroscope_selection_places_a_row_between_a_full_and_a_short_heap);
    RUN_TEST(a_heap_gives_its_rows_back_in_order_whatever_is_removed);
    return UNITY_END();
}
