/* SPDX-License-Identifier: MIT */
/* Times of rows. */
#include "input/row_clock.h"

/* The library's time of the first row that has one. Rows before it in time must still get a smaller one. */
#define ORIGIN_US ((uint64_t)1 << 62)

uint64_t row_clock_advance(row_clock_t *clock, const recording_row_t *row)
{
    if (!row->has_time) {
        return clock->pushed_us;
    }
    if (!clock->has_time) {
        clock->has_time = true;
        clock->start_us = row->t_us;
        clock->t_us = row->t_us;
    }
    if (row->t_us > clock->t_us) {
        clock->t_us = row->t_us;
    }
    clock->pushed_us = ORIGIN_US + (uint64_t)row->t_us - (uint64_t)clock->start_us;
    return clock->pushed_us;
}
