/* SPDX-License-Identifier: MIT */
/// @file
/// Follows a sensor's clock. See packet/envelope.h.
#include "packet/envelope.h"

#include "math/scalar.h"

#define US_PER_NS 1e-3f
#define S_PER_NS 1e-9f

/// Length of a block at first, and at last, ns.
#define BLOCK_FIRST_NS 250000000u
#define BLOCK_LAST_NS 8000000000u
/// What is older is forgotten, us: after a long silence.
#define POINT_OLDEST_US 600000000u
/// Fewer points tell no slope.
#define POINTS_MIN 8u
/// Share of mean height over time that bounds the slope, and what is added, ppm.
#define BOUND_SHARE 2.0f
#define BOUND_FLOOR_PPM 0.5f
/// Packets over which the mean height is taken.
#define JITTER_PACKETS 64u
/// High above the line is beyond this, us, and so many times the mean height; for so long, us.
#define HIGH_US 5000.0f
#define HIGH_JITTERS 6.0f
#define HIGH_LASTS_US 5000000u
/// Far below it is beyond this, us, and so many times the mean height.
#define LOW_US 20000.0f
#define LOW_JITTERS 8.0f

#define POINTS (JCAL_ENVELOPE_BLOCKS + 1u)

/// Points as seen from the newest: s, and us above the line of now's slope.
typedef struct {
    float x[POINTS];
    float y[POINTS];
} view_t;

static uint32_t readings_in(uint64_t ns, uint32_t period_ns)
{
    const uint32_t readings = (uint32_t)(ns / period_ns);
    return (readings > 0u) ? readings : 1u;
}

static void open_block(jcal_envelope_t *self, uint64_t at, uint64_t us)
{
    self->points[self->count].at = (uint32_t)at;
    self->points[self->count].us = (uint32_t)us;
    self->count++;
    self->open_at = (uint32_t)at;
}

static void set_anchor(jcal_envelope_t *self, uint64_t at, uint64_t us)
{
    self->anchor_at = at;
    self->anchor_us = us;
    self->above_us = 0.0f;
}

void jcal_envelope_begin(jcal_envelope_t *self, const jcal_packet_config_t *cfg, uint64_t at, uint64_t us)
{
    self->count = 0u;
    self->width = readings_in(BLOCK_FIRST_NS, cfg->period_ns);
    self->bound_ppm = cfg->max_drift_ppm;
    self->open_us = 0.0f;
    self->is_high = false;
    set_anchor(self, at, us);
    open_block(self, at, us);
}

float jcal_envelope_above(const jcal_envelope_t *self, uint32_t period_ns, uint64_t at, uint64_t us)
{
    const int64_t far_us = 2 * JCAL_ENVELOPE_FAR_US;
    int64_t since_us = (int64_t)(us - self->anchor_us);
    since_us = (since_us < far_us) ? since_us : far_us;
    since_us = (since_us > -far_us) ? since_us : -far_us;
    const int64_t readings = (int64_t)(at - self->anchor_at);
    const int64_t over_ns = (since_us * 1000) - (readings * (int64_t)period_ns);
    const float way_s = jcal_float_of(readings) * ((float)period_ns * S_PER_NS);
    return (jcal_float_of(over_ns) * US_PER_NS) - self->above_us - (self->drift_ppm * way_s); /* ppm of s are us */
}

/// By how much b is later than its readings after a say, ns.
static int64_t over_ns(const jcal_envelope_point_t *b, const jcal_envelope_point_t *a, uint32_t period_ns)
{
    const int32_t readings = (int32_t)(b->at - a->at);
    const int32_t us = (int32_t)(b->us - a->us);
    return ((int64_t)us * 1000) - ((int64_t)readings * (int64_t)period_ns);
}

/// The points as seen from the last one.
static void look(const jcal_envelope_t *self, uint32_t period_ns, view_t *view)
{
    const jcal_envelope_point_t *const last = &self->points[self->count - 1u];
    const float period_s = (float)period_ns * S_PER_NS;
    for (uint32_t k = 0u; k < self->count; ++k) {
        const int32_t readings = (int32_t)(self->points[k].at - last->at);
        view->x[k] = (float)readings * period_s;
        view->y[k] =
            (jcal_float_of(over_ns(&self->points[k], last, period_ns)) * US_PER_NS) - (self->drift_ppm * view->x[k]);
    }
}

/// True if b is on or above the line from a to c: no corner of the lower hull.
static bool is_above(const view_t *view, uint32_t a, uint32_t b, uint32_t c)
{
    const float left = (view->y[b] - view->y[a]) * (view->x[c] - view->x[b]);
    const float right = (view->y[c] - view->y[b]) * (view->x[b] - view->x[a]);
    return left >= right;
}

/// Slope, ppm, of the edge of the lower hull that spans the middle of the times.
static float hull_slope(const view_t *view, uint32_t count)
{
    uint32_t corner[POINTS];
    uint32_t corners = 2u;
    corner[0] = 0u;
    corner[1] = 1u;
    for (uint32_t k = 2u; k < count; ++k) {
        while ((corners >= 2u) && is_above(view, corner[corners - 2u], corner[corners - 1u], k)) {
            corners--; /* each point goes once at most */
        }
        corner[corners] = k;
        corners++;
    }
    const float middle = 0.5f * (view->x[0] + view->x[count - 1u]);
    uint32_t k = 1u;
    while (((k + 1u) < corners) && (view->x[corner[k]] < middle)) {
        k++;
    }
    const uint32_t a = corner[k - 1u];
    const uint32_t b = corner[k];
    return (view->y[b] - view->y[a]) / (view->x[b] - view->x[a]);
}

/// Lowest y above a line of this slope through the last point, which is at 0.
static float lowest_above(const view_t *view, uint32_t count, float slope_ppm)
{
    float lowest = 0.0f;
    for (uint32_t k = 0u; k < count; ++k) {
        lowest = jcal_min(view->y[k] - (slope_ppm * view->x[k]), lowest);
    }
    return lowest;
}

/// Mean height above the line of this slope that touches the points; not of the open block's, and two are on the line.
static float mean_height(const view_t *view, uint32_t count, float slope_ppm)
{
    const float lowest = lowest_above(view, count, slope_ppm);
    float sum = 0.0f;
    for (uint32_t k = 0u; (k + 1u) < count; ++k) {
        sum += (view->y[k] - (slope_ppm * view->x[k])) - lowest;
    }
    return sum / (float)(count - 3u);
}

/// Moves the drift as far as the points tell it; returns by how much, ppm.
static float follow_slope(jcal_envelope_t *self, const jcal_packet_config_t *cfg, const view_t *view)
{
    const float most = cfg->max_drift_ppm;
    if (self->count < POINTS_MIN) {
        return 0.0f;
    }
    const float slope_ppm = hull_slope(view, self->count);
    const float mean_us = mean_height(view, self->count, slope_ppm);
    self->bound_ppm = jcal_min(BOUND_FLOOR_PPM - (BOUND_SHARE * mean_us / view->x[0]), most);
    const float share = 1.0f - ((self->bound_ppm * self->bound_ppm) / (most * most));
    const float before_ppm = self->drift_ppm;
    self->drift_ppm = jcal_max(jcal_min(before_ppm + (share * slope_ppm), most), -most);
    return self->drift_ppm - before_ppm;
}

/// Draws the line anew; its anchor is the last point, which is the packet `at`.
static void draw(jcal_envelope_t *self, const jcal_packet_config_t *cfg, uint64_t at, uint64_t us)
{
    view_t view;
    look(self, cfg->period_ns, &view);
    const float turned_ppm = follow_slope(self, cfg, &view);
    set_anchor(self, at, us);
    self->above_us = lowest_above(&view, self->count, turned_ppm);
    self->open_us = -self->above_us;
}

/// True if b, which is later, is lower than a, both above any line of the slope of now.
static bool is_lower(const jcal_envelope_t *self, uint32_t period_ns, const jcal_envelope_point_t *b,
                     const jcal_envelope_point_t *a)
{
    const int32_t readings = (int32_t)(b->at - a->at);
    const float drift_ns = self->drift_ppm * 1e-6f * ((float)readings * (float)period_ns);
    return jcal_float_of(over_ns(b, a, period_ns)) < drift_ns;
}

/// Of each two neighbours the lower one stays; blocks take twice as long.
static void join(jcal_envelope_t *self, uint32_t period_ns)
{
    for (uint32_t k = 0u; (2u * k) + 1u < self->count; ++k) {
        const jcal_envelope_point_t *const a = &self->points[2u * k];
        const jcal_envelope_point_t *const b = &self->points[(2u * k) + 1u];
        self->points[k] = is_lower(self, period_ns, b, a) ? *b : *a;
    }
    self->count /= 2u; /* 16 of them */
    self->width *= 2u;
}

static void drop(jcal_envelope_t *self, uint32_t count)
{
    for (uint32_t k = count; k < self->count; ++k) {
        self->points[k - count] = self->points[k];
    }
    self->count -= count;
}

/// After so long a silence the low bits of the points mean nothing any more.
static bool is_long_since(const jcal_envelope_t *self, uint64_t us)
{
    return (int64_t)(us - self->anchor_us) > (int64_t)POINT_OLDEST_US;
}

/// The open block is over.
static void close_block(jcal_envelope_t *self, uint32_t period_ns, uint64_t us)
{
    uint32_t old = is_long_since(self, us) ? self->count : 0u;
    while ((old < self->count) && (((uint32_t)us - self->points[old].us) > POINT_OLDEST_US)) {
        old++;
    }
    drop(self, old);
    if (self->count < JCAL_ENVELOPE_BLOCKS) {
        return;
    }
    if ((2u * self->width) <= readings_in(BLOCK_LAST_NS, period_ns)) {
        join(self, period_ns);
    } else {
        drop(self, 1u);
    }
}

/// True if the packets of some time say that the line is of another past. Follows the mean height.
static bool is_past(jcal_envelope_t *self, float above_us, uint64_t us, float max_drift_ppm)
{
    const bool is_known = self->jitter_count == JITTER_PACKETS;
    if (is_known && (above_us > (HIGH_US + (HIGH_JITTERS * self->jitter_us)))) {
        self->high_us = self->is_high ? self->high_us : us;
        self->is_high = true;
        return (us - self->high_us) > HIGH_LASTS_US;
    }
    self->is_high = false;
    if ((self->bound_ppm < max_drift_ppm) && (above_us < -(LOW_US + (LOW_JITTERS * self->jitter_us)))) {
        return true;
    }
    self->jitter_count += is_known ? 0u : 1u;
    self->jitter_us += (jcal_max(above_us, 0.0f) - self->jitter_us) / (float)self->jitter_count;
    return false;
}

bool jcal_envelope_put(jcal_envelope_t *self, const jcal_packet_config_t *cfg, uint64_t at, uint64_t us)
{
    const float above_us = jcal_envelope_above(self, cfg->period_ns, at, us);
    if (is_past(self, above_us, us, cfg->max_drift_ppm)) {
        jcal_envelope_begin(self, cfg, at, us);
        return true;
    }
    self->above_us += jcal_min(above_us, 0.0f);
    self->count = ((self->count - 1u) < POINTS) ? self->count : 1u; /* memory may be damaged */
    if ((((uint32_t)at - self->open_at) >= self->width) || is_long_since(self, us)) {
        close_block(self, cfg->period_ns, us);
        open_block(self, at, us);
        draw(self, cfg, at, us);
    } else if (above_us < self->open_us) {
        self->points[self->count - 1u].at = (uint32_t)at;
        self->points[self->count - 1u].us = (uint32_t)us;
        self->open_us = jcal_max(above_us, 0.0f);
    } else {
        /* others of the block are faster */
    }
    return false;
}
