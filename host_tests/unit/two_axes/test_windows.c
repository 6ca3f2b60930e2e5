/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of two_axes/windows.h: what a window shows, each condition by itself, and what becomes of an axis that was found.
#include "two_axes/windows.h"

#include "jointcal/head.h"
#include "unit/two_axes/fixture.h"

/* A sixteenth of a second: sums of it are exact, so that a part ends after 40 ticks. */
#define STEP_S 0.0625f
#define PART_TICKS 40

static jcal_axis_windows_t windows;
static jcal_window_context_t context;
static const jcal_plane_t straight = {1.0f, 0.0f};

/* Two sensors on a joint that turns to and fro about a line of frame 1: by so much, so often; frame 2 is frame 1 where it does not bend,
 * turned by `mount`. */
typedef struct {
    double line[3];
    double amplitude, frequency;
    double carry; /* so much the first sensor itself turns */
    double mount[9];
    double heading;
    double t;
} swing_t;

static swing_t swing_about(double x, double y, double z)
{
    const double size = sqrt(x * x + y * y + z * z);
    swing_t out = {{x / size, y / size, z / size}, 0.8, 3.0, 0.3, {0.0}, 0.0, 0.0};
    const double mount[3] = {0.5, -0.7, 0.2};
    mat_turn(mount, out.mount);
    return out;
}

static void pose(const swing_t *s, double t, double turn1[9], double turn2[9])
{
    const double first[3] = {0.0, 0.0, s->carry * sin(1.1 * t)};
    const double then[3] = {s->carry * sin(0.7 * t + 1.0), 0.0, 0.0};
    const double angle = s->amplitude * sin(s->frequency * t);
    const double bend[3] = {angle * s->line[0], angle * s->line[1], angle * s->line[2]};
    const double level[3] = {0.0, 0.0, -s->heading};
    double step[9];
    mat_turn(first, turn1);
    mat_turn(then, step);
    mat_mul(turn1, step, turn1);
    mat_turn(bend, step);
    mat_mul(turn1, step, turn2);
    mat_turn(level, step);
    mat_mul(step, turn2, turn2);
    mat_mul(turn2, s->mount, turn2);
}

static jcal_tick_t tick_at(const swing_t *s, int which)
{
    const double h = 1e-4;
    double turns[3][9] = {{0.0}};
    double ignored[9] = {0.0};
    for (int k = 0; k < 3; ++k) {
        const double t = s->t + (k - 1) * h;
        pose(s, t, (which == 1) ? turns[k] : ignored, (which == 1) ? ignored : turns[k]);
    }
    double slope[9];
    double back[9];
    for (int i = 0; i < 9; ++i) {
        slope[i] = (turns[2][i] - turns[0][i]) / (2.0 * h);
    }
    mat_transpose(turns[1], back);
    mat_mul(back, slope, slope);
    const double gyr[3] = {0.5 * (slope[7] - slope[5]), 0.5 * (slope[2] - slope[6]), 0.5 * (slope[3] - slope[1])};
    jcal_tick_t out;
    memset(&out, 0, sizeof out);
    for (int i = 0; i < 9; ++i) {
        out.turn[i] = (float)turns[1][i];
    }
    out.gyr = to_vec3(gyr);
    out.dt_s = STEP_S;
    return out;
}

/* So many ticks, and the work that they make; returns how many slices that was. */
static int swing(swing_t *s, int ticks, jcal_plane_t heading)
{
    int slices = 0;
    for (int k = 0; k < ticks; ++k) {
        const jcal_tick_t tick1 = tick_at(s, 1);
        const jcal_tick_t tick2 = tick_at(s, 2);
        jcal_axis_windows_add(&windows, &tick1, &tick2, heading);
        while (jcal_axis_windows_step(&windows, &context)) {
            ++slices;
        }
        s->t += (double)STEP_S;
    }
    return slices;
}

/* The lever of sensor 2 along a line of frame 1 where the joint does not bend. */
static void reach(const swing_t *s, double x, double y, double z)
{
    const double line[3] = {0.2 * x, 0.2 * y, 0.2 * z};
    double back[9];
    double r[3];
    mat_transpose(s->mount, back);
    mat_times(back, line, r);
    context.r2 = to_vec3(r);
}

static jcal_vec3_t in_frame2(const swing_t *s)
{
    double back[9];
    double out[3];
    mat_transpose(s->mount, back);
    mat_times(back, s->line, out);
    return to_vec3(out);
}

void setUp(void)
{
    memset(&windows, 0, sizeof windows);
    jcal_axis_windows_cut(&windows);
    windows.found[0].bound_rad = windows.found[1].bound_rad = JCAL_BOUND_UNKNOWN_RAD;
    const jcal_window_context_t usual = {{0.0f, 0.0f, 0.3f}, {0.2f, 0.0f, 0.0f}, {1.0f, 0.0f}, 0.02f, 0.03f, true};
    context = usual;
}

void tearDown(void)
{
}

/* float32 turns a rate of 2.4 rad/s forth and back within a few roundings, and the eigenvector is as exact. */
#define EXACT_RAD 2e-6
#define FLOOR_RAD (2.0f / 57.29578f)

/* A bound with what so many windows of an axis, which overlap by half, may show that is none. */
static float with_lone(float seen_rad, int axis, int number)
{
    const float lone = ((axis == 1) ? 6.0f : 12.0f) / 57.29578f * 2.0f / (float)(number + 1);
    return sqrtf((seen_rad * seen_rad) + (lone * lone));
}

static void bending_shows_the_first_axis(void)
{
    swing_t s = swing_about(0.2, 0.9, 0.1);
    reach(&s, 0.9, -0.2, 0.0);
    TEST_ASSERT_EQUAL_INT(2, swing(&s, PART_TICKS, straight)); /* half a window is looked at, and not worth more */
    TEST_ASSERT_EQUAL_INT(0, windows.found[0].windows);
    TEST_ASSERT_EQUAL_INT(4, swing(&s, PART_TICKS, straight));
    TEST_ASSERT_EQUAL_INT(1, windows.found[0].windows);
    TEST_ASSERT_EQUAL_INT(0, windows.found[1].windows);
    TEST_ASSERT_TRUE(line_angle(windows.found[0].axis, to_vec3(s.line)) < EXACT_RAD);
    /* the root of an eigenvalue that is 0 but for 3e-8 of the first */
    TEST_ASSERT_FLOAT_WITHIN(2e-4f, with_lone(FLOOR_RAD + 0.5f * 0.02f, 1, 1), windows.found[0].bound_rad);
    TEST_ASSERT_EQUAL_INT(5, swing(&s, PART_TICKS, straight)); /* it joins the other */
    TEST_ASSERT_EQUAL_INT(2, windows.found[0].windows);
    TEST_ASSERT_FLOAT_WITHIN(2e-4f, with_lone(FLOOR_RAD + 0.5f * 0.02f, 1, 2), windows.found[0].bound_rad);
    TEST_ASSERT_TRUE(line_angle(windows.found[0].axis, to_vec3(s.line)) < EXACT_RAD);
}

static void turning_shows_the_second_axis(void)
{
    swing_t s = swing_about(0.9, 0.2, -0.3);
    s.heading = 0.7;
    const jcal_plane_t heading = {(float)cos(0.7), (float)sin(0.7)};
    reach(&s, 0.9, 0.1, -0.2);
    (void)swing(&s, 2 * PART_TICKS, heading);
    TEST_ASSERT_EQUAL_INT(0, windows.found[0].windows);
    TEST_ASSERT_EQUAL_INT(1, windows.found[1].windows);
    TEST_ASSERT_TRUE(line_angle(windows.found[1].axis, in_frame2(&s)) < EXACT_RAD);
}

/* A heading that is wrong about a segment that rests is wrong about nothing that the turning axis is made of. */
static void the_heading_counts_as_much_as_what_carries(void)
{
    swing_t s = swing_about(1.0, 0.0, 0.0);
    reach(&s, 1.0, 0.0, 0.0);
    context.heading_rad = 0.4f;
    s.carry = 0.0;
    (void)swing(&s, 2 * PART_TICKS, straight);
    TEST_ASSERT_FLOAT_WITHIN(2e-4f, with_lone(FLOOR_RAD, 2, 1), windows.found[1].bound_rad);
    setUp();
    reach(&s, 1.0, 0.0, 0.0);
    context.heading_rad = 0.4f;
    s.carry = 3.0; /* more than what turns */
    (void)swing(&s, 2 * PART_TICKS, straight);
    TEST_ASSERT_FLOAT_WITHIN(2e-4f, with_lone(FLOOR_RAD + 0.5f * 0.4f, 2, 1), windows.found[1].bound_rad);
    setUp();
    reach(&s, 1.0, 0.0, 0.0);
    context.heading_rad = 0.4f;
    s.carry = 0.5;
    (void)swing(&s, 2 * PART_TICKS, straight);
    double carried = 0.0;
    double relative = 0.0;
    for (int k = 0; k < 2 * PART_TICKS; ++k) { /* the same motion, by its rates */
        s.t -= (double)STEP_S;
        const jcal_tick_t tick1 = tick_at(&s, 1);
        const double rate = s.amplitude * s.frequency * cos(s.frequency * s.t);
        const double weight = 1.0 / (1.0 + rate * rate / 4.0);
        carried += weight * (double)jcal_vec3_dot(tick1.gyr, tick1.gyr);
        relative += weight * rate * rate;
    }
    TEST_ASSERT_FLOAT_WITHIN(3e-4f, with_lone(FLOOR_RAD + 0.5f * 0.4f * (float)sqrt(carried / relative), 2, 1),
                             windows.found[1].bound_rad);
    setUp();
    reach(&s, 0.0, 0.0, 1.0); /* of bending a heading that is wrong is wrong about all */
    context.r1 = (jcal_vec3_t){0.0f, 0.3f, 0.0f};
    context.heading_rad = 0.4f;
    s.carry = 0.0;
    (void)swing(&s, 2 * PART_TICKS, straight);
    TEST_ASSERT_FLOAT_WITHIN(2e-4f, with_lone(FLOOR_RAD + 0.5f * 0.4f, 1, 1), windows.found[0].bound_rad);
}

/* The bound of the heading is that of the moment at which the window is judged; from there on back it may have been another one. */
static void a_heading_that_moves_counts_as_far_as_it_moved(void)
{
    swing_t s = swing_about(0.0, 1.0, 0.0);
    reach(&s, 1.0, 0.0, 0.0);
    context.heading_rad = 0.06f;
    context.heading = (jcal_plane_t){cosf(0.08f), -sinf(0.08f)};
    (void)swing(&s, 2 * PART_TICKS, straight);
    TEST_ASSERT_FLOAT_WITHIN(2e-4f, with_lone(FLOOR_RAD + 0.5f * 0.1f, 1, 1), windows.found[0].bound_rad);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.1f, windows.found[0].heading_rad);
}

/* Axes that a window shows: a bit for each. */
static int shown_by(swing_t *s)
{
    (void)swing(s, 2 * PART_TICKS, straight);
    const int out = ((windows.found[0].windows > 0) ? 1 : 0) + ((windows.found[1].windows > 0) ? 2 : 0);
    const jcal_window_context_t kept = context;
    setUp();
    context = kept;
    s->t = 0.0;
    return out;
}

static void where_the_line_lies_beside_the_levers(void)
{
    swing_t s = swing_about(0.0, 1.0, 0.0);
    reach(&s, sqrt(1.0 - 0.49 * 0.49), 0.49, 0.0); /* across to 0.5 of its cosine */
    TEST_ASSERT_EQUAL_INT(1, shown_by(&s));
    reach(&s, sqrt(1.0 - 0.51 * 0.51), -0.51, 0.0);
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
    reach(&s, sqrt(1.0 - 0.89 * 0.89), 0.89, 0.0); /* along from 0.9 */
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
    reach(&s, sqrt(1.0 - 0.91 * 0.91), -0.91, 0.0);
    TEST_ASSERT_EQUAL_INT(2, shown_by(&s));
    reach(&s, 1.0, 0.0, 0.0);
    context.r1 = (jcal_vec3_t){0.0f, 0.84f, sqrtf(1.0f - 0.84f * 0.84f)}; /* skin from 0.85 */
    TEST_ASSERT_EQUAL_INT(1, shown_by(&s));
    context.r1 = (jcal_vec3_t){0.0f, -0.86f, sqrtf(1.0f - 0.86f * 0.86f)};
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
}

/* A forearm that only turns says nothing of its lever along itself, which then looks short and across. */
static void a_lever_that_is_short_or_unknown_tells_nothing(void)
{
    swing_t s = swing_about(0.0, 1.0, 0.0);
    reach(&s, 1.0, 0.0, 0.0);
    context.r2 = jcal_vec3_scale(context.r2, 0.11f / 0.2f);
    TEST_ASSERT_EQUAL_INT(1, shown_by(&s));
    context.bound2_m = 9.0f; /* bending never tells the lever along its own axis */
    TEST_ASSERT_EQUAL_INT(1, shown_by(&s));
    context.r2 = jcal_vec3_scale(context.r2, 0.09f / 0.11f);
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
    reach(&s, 0.0, 1.0, 0.0);
    context.bound2_m = 0.099f;
    TEST_ASSERT_EQUAL_INT(2, shown_by(&s));
    context.bound2_m = 0.101f; /* more than half of it */
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
    context.bound2_m = 0.03f;
    context.r2 = jcal_vec3_scale(context.r2, 0.11f / 0.2f);
    TEST_ASSERT_EQUAL_INT(2, shown_by(&s));
    context.r2 = jcal_vec3_scale(context.r2, 0.09f / 0.11f);
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
}

/* Of slow swings one with so many seconds of motion in a window: rate^2 / (rate^2 + 0.3) of its time. */
static double frequency_that_moves(const swing_t *s, double seconds)
{
    double frequency = 0.1;
    for (double found = 0.0; found < seconds; frequency += 1e-4) {
        found = 0.0;
        for (int k = 0; k < 2 * PART_TICKS; ++k) {
            const double rate = s->amplitude * frequency * cos(frequency * k * (double)STEP_S);
            found += (double)STEP_S * rate * rate / (rate * rate + 0.3);
        }
    }
    return frequency;
}

static void what_a_window_must_show(void)
{
    swing_t s = swing_about(0.0, 1.0, 0.0);
    reach(&s, 1.0, 0.0, 0.0);
    context.is_joint = false;
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
    context.is_joint = true;
    /* 0.2 rad rms; seven swings and a bit, and what the cosine leaves of its square are 1 % each */
    s.frequency = 9.0;
    s.amplitude = 0.2 * 1.41421356 * 0.97;
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
    s.amplitude = 0.2 * 1.41421356 * 1.03;
    TEST_ASSERT_EQUAL_INT(1, shown_by(&s));
    s.amplitude = 0.8;
    s.frequency = frequency_that_moves(&s, 0.97);
    TEST_ASSERT_EQUAL_INT(0, shown_by(&s));
    s.frequency = frequency_that_moves(&s, 1.03);
    TEST_ASSERT_EQUAL_INT(1, shown_by(&s));
}

/* Ticks about two lines that take turns, the second with rates of a share of the first; halves are alike. The second eigenvalue over the
   first is worked out from the rates. */
static int with_a_second_line(double share, double *sideways)
{
    swing_t s = swing_about(0.0, 1.0, 0.0);
    double squares[2] = {0.0};
    reach(&s, 1.0, 0.0, 0.0);
    for (int k = 0; k < 2 * PART_TICKS; ++k) {
        const int which = k % 2;
        const double line[3] = {0.0, (which == 1) ? 0.0 : 1.0, (which == 1) ? 1.0 : 0.0};
        memcpy(s.line, line, sizeof line);
        s.amplitude = (which == 1) ? 0.4 * sqrt(share) : 0.4;
        const double rate = s.amplitude * s.frequency * cos(s.frequency * s.t);
        squares[which] += rate * rate / (1.0 + rate * rate / 4.0);
        (void)swing(&s, 1, straight);
    }
    const int out = windows.found[0].windows;
    *sideways = squares[1] / squares[0];
    setUp();
    return out;
}

static void one_line_must_dominate(void)
{
    double below = 0.0;
    double sideways = 0.0;
    for (double share = 0.08; sideways <= 0.12; share += 5e-4) {
        below = sideways;
        const int found = with_a_second_line(share, &sideways);
        TEST_ASSERT_EQUAL_INT(sideways <= 0.12, found);
    }
    TEST_ASSERT_TRUE((below > 0.115) && (sideways < 0.125));
}

static int with_halves_apart(double degrees)
{
    swing_t s = swing_about(0.0, 1.0, 0.0);
    reach(&s, 1.0, 0.0, 0.0);
    (void)swing(&s, PART_TICKS, straight);
    s.line[1] = cos(degrees * HINGE_DEG);
    s.line[2] = sin(degrees * HINGE_DEG);
    (void)swing(&s, PART_TICKS, straight);
    const int out = windows.found[0].windows;
    setUp();
    return out;
}

static void both_halves_must_show_the_same_line(void)
{
    TEST_ASSERT_EQUAL_INT(1, with_halves_apart(14.5));
    TEST_ASSERT_EQUAL_INT(0, with_halves_apart(15.5));
    TEST_ASSERT_EQUAL_INT(1, with_halves_apart(180.0 - 14.5));
}

/* The same line in frame 1, while sensor 2 sits otherwise in the second half: its frame sees another. */
static void both_frames_are_asked(void)
{
    swing_t s = swing_about(0.0, 1.0, 0.0);
    reach(&s, 1.0, 0.0, 0.0);
    (void)swing(&s, PART_TICKS, straight);
    const double slip[3] = {0.3, 0.0, 0.0};
    double step[9];
    mat_turn(slip, step);
    mat_mul(s.mount, step, s.mount);
    (void)swing(&s, PART_TICKS, straight);
    TEST_ASSERT_EQUAL_INT(0, windows.found[0].windows);
}

/* A window about a line that is `degrees` away, on its own. */
static void window_about(double degrees)
{
    swing_t s = swing_about(0.0, cos(degrees * HINGE_DEG), sin(degrees * HINGE_DEG));
    reach(&s, 1.0, 0.0, 0.0);
    context.r1 = (jcal_vec3_t){0.3f, 0.0f, 0.0f};
    jcal_axis_windows_cut(&windows);
    (void)swing(&s, 2 * PART_TICKS, straight);
}

static double found_at_deg(void)
{
    const jcal_vec3_t axis = windows.found[0].axis;
    return atan2((double)axis.z, (double)axis.y) / HINGE_DEG;
}

static void windows_that_agree_are_one(void)
{
    context.heading_rad = 0.2f; /* bounds of 7.7 deg each */
    window_about(0.0);
    const jcal_vec3_t first = windows.found[0].axis;
    context.heading_rad = 0.1f;
    window_about(10.0);
    TEST_ASSERT_EQUAL_INT(2, windows.found[0].windows);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 5.0, fabs(remainder(found_at_deg(), 180.0)));
    TEST_ASSERT_TRUE(jcal_vec3_dot(first, windows.found[0].axis) > 0.0f);
    /* two lines of the same weight are half of their angle off, which is a second eigenvalue of tan^2(5 deg) */
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, with_lone(FLOOR_RAD + 0.5f * 0.15f + 0.5f * tanf(5.0f / 57.29578f), 1, 2),
                             windows.found[0].bound_rad);
    /* of a line near (0, 1, -1) another component becomes the largest: its sense stays all the same */
    setUp();
    context.heading_rad = 0.2f;
    window_about(-43.0);
    const jcal_vec3_t before = windows.found[0].axis;
    window_about(-50.0);
    TEST_ASSERT_EQUAL_INT(2, windows.found[0].windows);
    TEST_ASSERT_TRUE(jcal_vec3_dot(before, windows.found[0].axis) > 0.9f);
}

static void what_a_heading_may_add_is_the_mean_of_all_windows(void)
{
    context.heading_rad = 0.2f;
    window_about(0.0);
    context.heading_rad = 0.1f;
    window_about(10.0);
    context.heading_rad = 0.3f;
    window_about(5.0);
    TEST_ASSERT_EQUAL_INT(3, windows.found[0].windows);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.2f, windows.found[0].heading_rad);
}

static void two_windows_that_say_otherwise_are_believed(void)
{
    window_about(0.0);
    context.heading_rad = 0.03f;
    window_about(40.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.0, remainder(found_at_deg(), 180.0));
    TEST_ASSERT_EQUAL_INT(1, windows.found[0].against);
    window_about(0.0); /* one that agrees: what spoke against it is forgotten */
    TEST_ASSERT_EQUAL_INT(0, windows.found[0].against);
    window_about(40.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.0, remainder(found_at_deg(), 180.0));
    windows.found[0].kept_sign = 2;
    window_about(40.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 40.0, fabs(remainder(found_at_deg(), 180.0)));
    TEST_ASSERT_EQUAL_INT(1, windows.found[0].windows);
    TEST_ASSERT_EQUAL_INT(0, windows.found[0].against);
    TEST_ASSERT_EQUAL_INT(0, windows.found[0].kept_sign); /* the sign is of the axis that was */
    TEST_ASSERT_EQUAL_FLOAT(0.03f, windows.found[0].heading_rad);
}

static void a_window_that_is_surer_is_believed_at_once(void)
{
    context.heading_rad = 0.3f;
    window_about(0.0);
    context.heading_rad = 0.02f;
    window_about(40.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 40.0, fabs(remainder(found_at_deg(), 180.0)));
    setUp();
    context.heading_rad = 0.3f;
    window_about(0.0);
    window_about(0.0);
    context.heading_rad = 0.02f; /* against two that agree it must come again */
    window_about(40.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.0, remainder(found_at_deg(), 180.0));
}

/* Lines agree within the root of the sum of both bounds' squares. */
static void how_far_apart_is_otherwise(void)
{
    const float each = with_lone(FLOOR_RAD + 0.5f * 0.1f, 1, 1) * 57.29578f;
    for (int k = 0; k < 2; ++k) {
        setUp();
        context.heading_rad = 0.1f;
        window_about(0.0);
        window_about((double)each * 1.41421356 + ((k == 0) ? -0.2 : 0.2));
        TEST_ASSERT_EQUAL_INT((k == 0) ? 2 : 1, windows.found[0].windows);
    }
}

/* The last twelve windows count: a line that creeps is followed. */
static void old_windows_are_forgotten(void)
{
    for (int k = 0; k < 12; ++k) {
        window_about(0.0);
    }
    TEST_ASSERT_EQUAL_INT(12, windows.found[0].windows);
    const float full = windows.found[0].seen[2];
    window_about(0.0);
    TEST_ASSERT_EQUAL_INT(12, windows.found[0].windows);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f * full, full, windows.found[0].seen[2]);
    for (int k = 0; k < 60; ++k) {
        window_about(5.0);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 5.0, fabs(remainder(found_at_deg(), 180.0)));
}

/* The joint was lost: another window that agrees ends the doubt, any other is believed at once. */
static void an_axis_in_doubt(void)
{
    window_about(0.0);
    window_about(0.0);
    windows.found[0].in_doubt = true;
    window_about(0.0);
    TEST_ASSERT_FALSE(windows.found[0].in_doubt);
    TEST_ASSERT_EQUAL_INT(3, windows.found[0].windows);
    windows.found[0].in_doubt = true;
    context.heading_rad = 0.1f;
    window_about(40.0);
    TEST_ASSERT_FALSE(windows.found[0].in_doubt);
    TEST_ASSERT_EQUAL_INT(1, windows.found[0].windows);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 40.0, fabs(remainder(found_at_deg(), 180.0)));
}

/* After a cut nothing of before is in a window, and no work is left. */
static void a_cut_gives_up_both_halves(void)
{
    swing_t s = swing_about(0.0, 1.0, 0.0);
    reach(&s, 1.0, 0.0, 0.0);
    (void)swing(&s, PART_TICKS + PART_TICKS / 2, straight);
    jcal_axis_windows_cut(&windows);
    TEST_ASSERT_FALSE(jcal_axis_windows_step(&windows, &context));
    TEST_ASSERT_EQUAL_INT(0, swing(&s, PART_TICKS - 1, straight));
    TEST_ASSERT_EQUAL_INT(2, swing(&s, 1, straight));
    TEST_ASSERT_EQUAL_INT(0, windows.found[0].windows);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(bending_shows_the_first_axis);
    RUN_TEST(turning_shows_the_second_axis);
    RUN_TEST(the_heading_counts_as_much_as_what_carries);
    RUN_TEST(a_heading_that_moves_counts_as_far_as_it_moved);
    RUN_TEST(where_the_line_lies_beside_the_levers);
    RUN_TEST(a_lever_that_is_short_or_unknown_tells_nothing);
    RUN_TEST(what_a_window_must_show);
    RUN_TEST(one_line_must_dominate);
    RUN_TEST(both_halves_must_show_the_same_line);
    RUN_TEST(both_frames_are_asked);
    RUN_TEST(windows_that_agree_are_one);
    RUN_TEST(what_a_heading_may_add_is_the_mean_of_all_windows);
    RUN_TEST(two_windows_that_say_otherwise_are_believed);
    RUN_TEST(a_window_that_is_surer_is_believed_at_once);
    RUN_TEST(how_far_apart_is_otherwise);
    RUN_TEST(old_windows_are_forgotten);
    RUN_TEST(an_axis_in_doubt);
    RUN_TEST(a_cut_gives_up_both_halves);
    return UNITY_END();
}
