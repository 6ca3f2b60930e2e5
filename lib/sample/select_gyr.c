/* SPDX-License-Identifier: MIT */
/// @file
/// Algorithm 2 of [OLS20]: both ends of the ranking, each a heap with its innermost row at the root.
#include "sample/select.h"

#include "sample/heap.h"

/* The largest of the low scores stands at the root of the low heap (key = score), the smallest of the high ones at the
   root of the high heap (key = -score). While fewer than N_max rows were offered the two heaps share them so that no
   low score is above a high one; a row that does not fit into its heap pushes the innermost row over to the other. */

static void insert_low(jcal_select_gyr_t *self, jcal_row_t *rows, const jcal_row_t *row)
{
    jcal_heap_insert(rows, self->low, row);
    ++self->low;
}

static void insert_high(jcal_select_gyr_t *self, jcal_row_t *rows, const jcal_row_t *row)
{
    jcal_row_t turned = *row;
    turned.key = -row->key;
    jcal_heap_insert(&rows[self->low_max], self->high, &turned);
    ++self->high;
}

static jcal_row_t take_low(jcal_select_gyr_t *self, jcal_row_t *rows)
{
    const jcal_row_t root = rows[0];
    jcal_heap_remove(rows, self->low, 0u);
    --self->low;
    return root;
}

static jcal_row_t take_high(jcal_select_gyr_t *self, jcal_row_t *rows)
{
    jcal_row_t root = rows[self->low_max];
    jcal_heap_remove(&rows[self->low_max], self->high, 0u);
    --self->high;
    root.key = -root.key;
    return root;
}

void jcal_select_gyr_init(jcal_select_gyr_t *self, uint32_t n_max)
{
    self->low_max = n_max / 2u;
    self->high_max = n_max - self->low_max;
    self->low = 0u;
    self->high = 0u;
}

/* All rows are still kept: there is room in at least one heap. */
static void share(jcal_select_gyr_t *self, jcal_row_t *rows, const jcal_row_t *row)
{
    const bool is_low = (self->high > 0u) && (row->key < -rows[self->low_max].key);
    if (is_low) {
        if (self->low == self->low_max) {
            const jcal_row_t innermost = take_low(self, rows);
            /* The row may itself be the innermost one. */
            const bool stays_low = row->key < innermost.key;
            insert_low(self, rows, stays_low ? row : &innermost);
            insert_high(self, rows, stays_low ? &innermost : row);
            return;
        }
        insert_low(self, rows, row);
        return;
    }
    if (self->high == self->high_max) {
        const jcal_row_t innermost = take_high(self, rows);
        insert_low(self, rows, &innermost);
    }
    insert_high(self, rows, row);
}

void jcal_select_gyr_offer(jcal_select_gyr_t *self, jcal_row_t *rows, const jcal_row_t *row)
{
    if ((self->low < self->low_max) || (self->high < self->high_max)) {
        share(self, rows, row);
    } else if (row->key > -rows[self->low_max].key) {
        (void)take_high(self, rows);
        insert_high(self, rows, row);
    } else if (row->key < rows[0].key) {
        (void)take_low(self, rows);
        insert_low(self, rows, row);
    } else {
        /* In the middle of the ranking: half of N_max rows on either side. */
    }
}
