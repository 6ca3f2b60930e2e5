/* SPDX-License-Identifier: MIT */
/// @file
/// Binary heap of rows in an array of the caller: the row with the largest key stands at rows[0].
#ifndef JCAL_HEAP_H
#define JCAL_HEAP_H

#include "sample/select.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Adds a row to a heap of `count` rows; afterwards there are count + 1. Cost: at most log2(count) + 1 moves.
void jcal_heap_insert(jcal_row_t *rows, size_t count, const jcal_row_t *row);

/// Takes row `at` out of a heap of `count` rows; afterwards there are count - 1. Cost: at most 2 log2(count) moves.
void jcal_heap_remove(jcal_row_t *rows, size_t count, size_t at);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HEAP_H */
