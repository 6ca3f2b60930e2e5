/* SPDX-License-Identifier: MIT */
/// @file
/// Axes from windows against the float64 numpy reference, tools/maintain/make_golden.py.
#include "golden/ball.h"
#include "jointcal/head.h"
#include "jointcal/vec3.h"
#include "two_axes/windows.h"

#include <math.h>
#include <string.h>
#include <unity.h>

/* 21 roundings of 6e-8 of a sum, and a dozen of what is added: a rate is turned twice before it is squared. */
static const double SUM_TOL = 33.0 * 6e-8;
/* An eigenvector is off by the error of the matrix over the gap to the next eigenvalue, which is 0.9 of the first, and Jacobi's rotations
 * add a rounding each. */
static const double AXIS_TOL = 2.0 * 33.0 * 6e-8;
/* The bound takes the root of an eigenvalue that is 0.015 of the first: an error of 4e-6 of that one is worth half of 4e-6 / 0.12 / 2. */
static const double BOUND_TOL_RAD = 1e-5;

static jcal_axis_windows_t windows;

static jcal_tick_t tick_of(const float *v)
{
    jcal_tick_t out;
    memset(&out, 0, sizeof out);
    out.dt_s = GOLDEN_WINDOW_TICK_S;
    memcpy(out.turn, v, sizeof out.turn);
    out.gyr = (jcal_vec3_t){v[9], v[10], v[11]};
    return out;
}

static double trace_of(const double *packed)
{
    return packed[0] + packed[2] + packed[5];
}

static void expect(const double *expected, const float *found, int n, double allowed)
{
    for (int i = 0; i < n; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(allowed, expected[i], (double)found[i]);
    }
}

static void expect_part(const double *g, const jcal_axis_part_t *part)
{
    expect(&g[0], part->seen[0], 6, SUM_TOL * trace_of(&g[0]));
    expect(&g[6], part->seen[1], 6, SUM_TOL * trace_of(&g[6]));
    expect(&g[12], part->mean, 9, SUM_TOL * g[23]);
    TEST_ASSERT_DOUBLE_WITHIN(SUM_TOL * g[21], g[21], (double)part->carried2);
    TEST_ASSERT_DOUBLE_WITHIN(SUM_TOL * g[22], g[22], (double)part->motion_s);
    TEST_ASSERT_DOUBLE_WITHIN(SUM_TOL * g[23], g[23], (double)part->time_s);
}

static void expect_found(const double *g, const jcal_axis_found_t *found)
{
    TEST_ASSERT_EQUAL_INT((int)g[0], found->windows);
    TEST_ASSERT_EQUAL_INT(0, found->against);
    TEST_ASSERT_DOUBLE_WITHIN(BOUND_TOL_RAD, g[1], (double)found->bound_rad);
    TEST_ASSERT_DOUBLE_WITHIN(SUM_TOL, g[2], (double)found->heading_rad);
    const float axis[3] = {found->axis.x, found->axis.y, found->axis.z};
    double along = 0.0;
    for (int i = 0; i < 3; ++i) {
        along += (double)axis[i] * g[3 + i];
    }
    const double sign = (along < 0.0) ? -1.0 : 1.0; /* a line has no sign */
    for (int i = 0; i < 3; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(AXIS_TOL, sign * g[3 + i], (double)axis[i]);
    }
}

void setUp(void)
{
    memset(&windows, 0, sizeof windows);
    jcal_axis_windows_cut(&windows);
    windows.found[0].bound_rad = windows.found[1].bound_rad = JCAL_BOUND_UNKNOWN_RAD;
}

void tearDown(void)
{
}

static void parts_and_what_they_show(void)
{
    const float *const p = golden_window_point[0];
    const jcal_plane_t heading = {p[6], p[7]};
    const jcal_window_context_t context = {{p[0], p[1], p[2]},          {p[3], p[4], p[5]},        heading,
                                           GOLDEN_WINDOW_HEADING_BOUND, GOLDEN_WINDOW_LEVER_BOUND, true};
    int parts = 0;
    for (int k = 0; k < GOLDEN_WINDOW_TICKS; ++k) {
        const jcal_tick_t tick1 = tick_of(golden_window_ticks[k]);
        const jcal_tick_t tick2 = tick_of(&golden_window_ticks[k][12]);
        jcal_axis_windows_add(&windows, &tick1, &tick2, heading);
        if (windows.part[0].time_s > 0.0f) {
            TEST_ASSERT_FALSE(jcal_axis_windows_step(&windows, &context));
            continue;
        }
        TEST_ASSERT_TRUE(parts < GOLDEN_PARTS);
        expect_part(golden_parts[parts], &windows.part[1]);
        int slices = 0;
        while (jcal_axis_windows_step(&windows, &context)) {
            ++slices;
        }
        TEST_ASSERT_TRUE((slices >= 2) && (slices <= 5));
        expect_found(&golden_found[parts][0], &windows.found[0]);
        expect_found(&golden_found[parts][6], &windows.found[1]);
        ++parts;
    }
    TEST_ASSERT_EQUAL_INT(GOLDEN_PARTS, parts);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(parts_and_what_they_show);
    return UNITY_END();
}
