/* SPDX-License-Identifier: MIT */
/// @file
/// Quantiles of positive numbers in constant memory: counts in bins that are a sixteenth of an octave wide, so right to 2 %.
#ifndef JCAL_CLI_INPUT_HISTOGRAM_H
#define JCAL_CLI_INPUT_HISTOGRAM_H

#include <math.h>
#include <stdint.h>

#define HISTOGRAM_PER_OCTAVE 16
#define HISTOGRAM_LOWEST (-14) /* octave of the first bin: 6e-5 */
#define HISTOGRAM_BINS (32 * HISTOGRAM_PER_OCTAVE)

/// Start from all zero.
typedef struct {
    uint32_t count;
    uint32_t bins[HISTOGRAM_BINS];
} histogram_t;

/// Takes in a number; what is outside 6e-5 to 2.6e5 counts at the end.
static inline void histogram_push(histogram_t *histogram, double value)
{
    const double bin = (value > 0.0) ? floor((log2(value) - HISTOGRAM_LOWEST) * HISTOGRAM_PER_OCTAVE) : 0.0;
    histogram->bins[(int)fmin(fmax(bin, 0.0), HISTOGRAM_BINS - 1)]++;
    histogram->count++;
}

/// The number that a share of all lies below; 0 of none.
static inline double histogram_quantile(const histogram_t *histogram, double share)
{
    if (histogram->count == 0) {
        return 0.0;
    }
    const double wanted = share * histogram->count;
    double below = 0.0;
    int bin = 0;
    while (bin < HISTOGRAM_BINS - 1 && below + histogram->bins[bin] < wanted) {
        below += histogram->bins[bin];
        bin++;
    }
    const double inside = (histogram->bins[bin] > 0) ? (wanted - below) / histogram->bins[bin] : 0.5;
    return exp2(((bin + inside) / HISTOGRAM_PER_OCTAVE) + HISTOGRAM_LOWEST);
}

#endif
