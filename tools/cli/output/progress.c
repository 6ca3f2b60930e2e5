/* SPDX-License-Identifier: MIT */
/* Progress bar on standard error. */
#include "output/progress.h"

#include <stdio.h>
#include <unistd.h>

#define BAR_WIDTH 40u

void progress_start(progress_t *progress, uint64_t total)
{
    *progress = (progress_t){.on = total > 0 && isatty(STDERR_FILENO) != 0, .total = total};
}

void progress_show(progress_t *progress, uint64_t done)
{
    if (!progress->on) {
        return;
    }
    /* A file that grows while it is read must not run the bar beyond its end. */
    const uint64_t shown = (done < progress->total) ? done : progress->total;
    const unsigned percent = (unsigned)(100.0 * (double)shown / (double)progress->total);
    if (percent == progress->percent) {
        return;
    }
    progress->percent = percent;
    progress->drawn = true;
    char bar[BAR_WIDTH + 1];
    for (unsigned k = 0; k < BAR_WIDTH; k++) {
        bar[k] = (100u * k < percent * BAR_WIDTH) ? '#' : '.';
    }
    bar[BAR_WIDTH] = '\0';
    (void)fprintf(stderr, "\r[%s] %3u %%", bar, percent);
}

void progress_clear(progress_t *progress)
{
    if (progress->drawn) {
        (void)fprintf(stderr, "\r%*s\r", (int)BAR_WIDTH + 8, "");
        progress->drawn = false;
    }
}
