/* SPDX-License-Identifier: MIT */
/* The library's time of rows. */
#include "timeline.h"

/* The library's time of the first row that has one. Rows before it in time must still get a smaller one. */
#define ORIGIN_US ((uint64_t)1 << 62)

uint64_t timeline_advance(timeline_t *timeline, const recording_row_t *row)
{
    if (!row->has_time) {
        return timeline->now_us;
    }
    if (!timeline->has_time) {
        timeline->has_time = true;
        timeline->start_us = row->t_us;
        timeline->latest_us = row->t_us;
    }
    if (row->t_us > timeline->latest_us) {
        timeline->latest_us = row->t_us;
    }
    timeline->now_us = ORIGIN_US + (uint64_t)row->t_us - (uint64_t)timeline->start_us;
    return timeline->now_us;
}
