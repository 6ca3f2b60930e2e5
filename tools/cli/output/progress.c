/* SPDX-License-Identifier: MIT */
/* Progress bar on standard error. */
#include "output/progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

#define BAR_WIDTH 40u
#define LEFT_WIDTH 20

static double clock_s(void)
{
    struct timespec now = {0, 0};
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (1e-9 * (double)now.tv_nsec);
}

/* How long the rest takes if it goes on as before, in words; nothing in the first moments. */
static const char *left_words(const progress_t *progress, uint64_t done, char buffer[static LEFT_WIDTH])
{
    const double spent_s = clock_s() - progress->began_s;
    const double left_s = spent_s * (double)(progress->total - done) / (double)done;
    buffer[0] = '\0';
    if (spent_s > 0.5 && left_s < 60.0) {
        (void)snprintf(buffer, LEFT_WIDTH, ", %.0f s left", left_s);
    } else if (spent_s > 0.5 && left_s < 360000.0) {
        (void)snprintf(buffer, LEFT_WIDTH, ", %.0f min left", left_s / 60.0);
    }
    return buffer;
}

void progress_start(progress_t *progress, uint64_t total)
{
    *progress = (progress_t){.on = total > 0 && isatty(STDERR_FILENO) != 0, .total = total, .began_s = clock_s()};
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
    char left[LEFT_WIDTH];
    (void)fprintf(stderr, "\r[%s] %3u %%%-*s", bar, percent, LEFT_WIDTH, left_words(progress, shown, left));
}

void progress_clear(progress_t *progress)
{
    if (progress->drawn) {
        (void)fprintf(stderr, "\r%*s\r", (int)BAR_WIDTH + 8 + LEFT_WIDTH, "");
        progress->drawn = false;
    }
}
