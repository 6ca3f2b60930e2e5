/* SPDX-License-Identifier: MIT */
/// @file
/// Binary heap: children of i at 2 i + 1 and 2 i + 2, no key larger than its parent's.
#include "sample/heap.h"

/* Writes `row` at `at` or above, moving smaller parents down. */
static void sift_up(jcal_row_t *rows, size_t at, const jcal_row_t *row)
{
    size_t i = at;
    while ((i > 0u) && (rows[(i - 1u) / 2u].key < row->key)) {
        rows[i] = rows[(i - 1u) / 2u];
        i = (i - 1u) / 2u;
    }
    rows[i] = *row;
}

/* Place of the larger child of i; there is at least one. */
static size_t larger_child(const jcal_row_t *rows, size_t count, size_t i)
{
    const size_t left = (2u * i) + 1u;
    const size_t right = left + 1u;
    return ((right < count) && (rows[right].key > rows[left].key)) ? right : left;
}

/* Writes `row` at `at` or below, moving larger children up. */
static void sift_down(jcal_row_t *rows, size_t count, size_t at, const jcal_row_t *row)
{
    size_t i = at;
    while ((2u * i) + 1u < count) {
        const size_t child = larger_child(rows, count, i);
        if (!(rows[child].key > row->key)) {
            break;
        }
        rows[i] = rows[child];
        i = child;
    }
    rows[i] = *row;
}

void jcal_heap_insert(jcal_row_t *rows, size_t count, const jcal_row_t *row)
{
    const jcal_row_t copy = *row;
    sift_up(rows, count, &copy);
}

void jcal_heap_remove(jcal_row_t *rows, size_t count, size_t at)
{
    const size_t left = count - 1u;
    const jcal_row_t last = rows[left];
    if (at == left) {
        return;
    }
    /* The last row fills the hole; it may belong above it or below it. */
    if ((at > 0u) && (last.key > rows[(at - 1u) / 2u].key)) {
        sift_up(rows, at, &last);
    } else {
        sift_down(rows, left, at, &last);
    }
}
