/* SPDX-License-Identifier: MIT */
/* Frames of rates and accelerations. */
#include "input/check_frames.h"

#include <math.h>
#include <string.h>

/* Blocks from which on there is a verdict, 5 s of slow motion: of fewer, chance explains as much. */
#define ENOUGH_BLOCKS 50

void check_frames_push(check_frames_t *frames, jcal_vec3_t turn_rad, jcal_vec3_t acc, jcal_vec3_t change)
{
    const double th[3] = {(double)turn_rad.x, (double)turn_rad.y, (double)turn_rad.z};
    const double a[3] = {(double)acc.x, (double)acc.y, (double)acc.z};
    const double da[3] = {(double)change.x, (double)change.y, (double)change.z};
    const double cross[3] = {(a[1] * da[2]) - (a[2] * da[1]), (a[2] * da[0]) - (a[0] * da[2]),
                             (a[0] * da[1]) - (a[1] * da[0])};
    const double turn2 = (th[0] * th[0]) + (th[1] * th[1]) + (th[2] * th[2]);
    frames->count++;
    frames->change2 += (da[0] * da[0]) + (da[1] * da[1]) + (da[2] * da[2]);
    frames->turn2_acc2 += turn2 * ((a[0] * a[0]) + (a[1] * a[1]) + (a[2] * a[2]));
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            frames->cross[i][j] += th[i] * cross[j];
            for (int k = 0; k < 9; k++) {
                frames->products[i][j][k / 3][k % 3] += th[i] * th[j] * a[k / 3] * a[k % 3];
            }
        }
    }
}

/* A way to read the accelerations: x, y, z are `sign` times column `column`. A rotation. */
typedef struct {
    int column[3];
    int sign[3];
} reading_way_t;

/* The k-th of 24 rotations that map axes to axes. */
static reading_way_t way(int k)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    reading_way_t found;
    memcpy(found.column, orders[k / 4], sizeof found.column);
    found.sign[0] = ((k & 1) != 0) ? -1 : 1;
    found.sign[1] = ((k & 2) != 0) ? -1 : 1;
    /* The first three orders are even: their signs have the product 1, those of the others -1. */
    found.sign[2] = found.sign[0] * found.sign[1] * ((k < 12) ? 1 : -1);
    return found;
}

/* Share of the changes that a way explains, with the sign of the scale. With y = Q da and x = -th x Q a: scale = sum x.y / sum x.x. */
static double fit_of(const check_frames_t *frames, const reading_way_t *q, double *scale)
{
    double xy = 0.0;
    double xx = frames->turn2_acc2;
    for (int i = 0; i < 3; i++) {
        xy -= q->sign[i] * frames->cross[i][q->column[i]];
        for (int j = 0; j < 3; j++) {
            xx -= q->sign[i] * q->sign[j] * frames->products[i][j][q->column[i]][q->column[j]];
        }
    }
    const bool moving = xx > 1e-9 * frames->turn2_acc2 && frames->change2 > 0.0;
    *scale = moving ? xy / xx : 0.0;
    return moving ? xy * fabs(xy) / (xx * frames->change2) : 0.0;
}

bool check_frames_get(const check_frames_t *frames, check_frames_result_t *result)
{
    memset(result, 0, sizeof *result);
    result->count = frames->count;
    for (int k = 0; k < 24; k++) {
        const reading_way_t q = way(k);
        double scale = 0.0;
        const double fit = fit_of(frames, &q, &scale);
        if (k == 0) {
            result->fit_as_is = fit;
            result->scale_as_is = scale;
        }
        if (fabs(fit) > result->fit) {
            result->fit_next = result->fit;
            result->fit = fabs(fit);
            result->scale = scale;
            /* The opposite says the same with fewer signs turned round, if two or three are. */
            const int turn = (q.sign[0] + q.sign[1] + q.sign[2] < 0) ? -1 : 1;
            for (int i = 0; i < 3; i++) {
                result->column[i] = q.column[i];
                result->sign[i] = turn * q.sign[i];
            }
        } else if (fabs(fit) > result->fit_next) {
            result->fit_next = fabs(fit);
        }
    }
    return frames->count >= ENOUGH_BLOCKS && result->fit > 0.0;
}
