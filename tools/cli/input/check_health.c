/* SPDX-License-Identifier: MIT */
/* The health of one sensor, in words. */
#include "input/check_health.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void check_health_push(check_health_t *self, const jcal_imu_t *imu, int64_t t_us)
{
    if (!self->is_begun) {
        self->is_begun = jcal_health_init(&self->health) == JCAL_OK;
    }
    /* The order of signed times, in unsigned ones. */
    const jcal_reading_t reading = {(uint64_t)t_us ^ (UINT64_C(1) << 63), *imu};
    (void)jcal_health_push(&self->health, &reading);
}

jcal_health_result_t check_health_get(const check_health_t *self)
{
    jcal_health_result_t result;
    memset(&result, 0, sizeof result);
    if (self->is_begun) {
        (void)jcal_health_get(&self->health, &result);
    }
    return result;
}

const char *check_health_component(unsigned component)
{
    static const char *const names[6] = {"x of the gyroscope",     "y of the gyroscope",     "z of the gyroscope",
                                         "x of the accelerometer", "y of the accelerometer", "z of the accelerometer"};
    return (component < 6u) ? names[component] : "";
}

void check_health_way(const jcal_health_result_t *result, char way[static 32])
{
    way[0] = '\0';
    for (int k = 0; k < 3 && result->way_known; k++) {
        const size_t length = strlen(way);
        (void)snprintf(way + length, 32 - length, "%s%s%c", (k > 0) ? ", " : "", (result->way.sign[k] < 0) ? "-" : "",
                       "xyz"[result->way.column[k] % 3]);
    }
}

/* The first component that clips, and how many do. */
static unsigned first_clipped(const jcal_health_result_t *result, int *others)
{
    unsigned first = 0u;
    *others = -1;
    for (unsigned k = 12u; k > 0u; k--) {
        if ((result->clipped & (1u << (k - 1u))) != 0u) {
            first = (k - 1u) % 6u;
            (*others)++;
        }
    }
    return first;
}

static void say_clipped(const jcal_health_result_t *result, int number, sentence_t sentence)
{
    int others = 0;
    const unsigned component = first_clipped(result, &others);
    (void)snprintf(sentence, SENTENCE_MAX,
                   "%s of sensor %d stops at %.3g %s again and again: it is clipped; set a larger range",
                   check_health_component(component), number, (double)result->fact[JCAL_FINDING_CLIPPED],
                   (component < 3u) ? "rad/s" : "m/s^2");
}

static void say_frames(const jcal_health_result_t *result, int number, sentence_t sentence)
{
    char way[32];
    check_health_way(result, way);
    (void)snprintf(sentence, SENTENCE_MAX,
                   "rates and accelerations of sensor %d are not in one right-handed frame%s%s%s%s", number,
                   result->way_known ? "; they fit if " : ": check order and signs of the columns",
                   result->way_known ? (result->way_of_gyr ? "gyr" : "acc") : "",
                   result->way_known ? " x, y, z are read from the columns " : "", way);
}

static void say_values(const jcal_health_result_t *result, jcal_finding_t finding, int number, sentence_t sentence)
{
    const double fact = (double)result->fact[finding];
    switch (finding) {
    case JCAL_FINDING_FROZEN:
        (void)snprintf(sentence, SENTENCE_MAX,
                       "all values of sensor %d stood still for %.2g s: its link was lost; leave that part out", number,
                       fact);
        break;
    case JCAL_FINDING_HELD:
        (void)snprintf(sentence, SENTENCE_MAX,
                       "each reading of sensor %d comes %.2g times: record at the rate of the sensor", number, fact);
        break;
    case JCAL_FINDING_DEAD:
        (void)snprintf(sentence, SENTENCE_MAX,
                       "%s of sensor %d stays at one value while others move: it is dead, or its column was not filled",
                       check_health_component((unsigned)fmax(fact - 1.0, 0.0)), number);
        break;
    case JCAL_FINDING_CLIPPED:
        say_clipped(result, number, sentence);
        break;
    default:
        break;
    }
}

static void say_gravity(const jcal_health_result_t *result, jcal_finding_t finding, int number, sentence_t sentence)
{
    const double fact = (double)result->fact[finding];
    if (finding == JCAL_FINDING_NO_GRAVITY) {
        (void)snprintf(sentence, SENTENCE_MAX,
                       "no gravity in the accelerations of sensor %d: record what the accelerometer reads", number);
    } else {
        (void)snprintf(
            sentence, SENTENCE_MAX,
            "gravity is %.4g m/s^2 in the accelerations of sensor %d, where it is 9.81: calibrate it, or check its "
            "range and unit",
            fact, number);
    }
}

static void say_rates(const jcal_health_result_t *result, jcal_finding_t finding, int number, sentence_t sentence)
{
    const double fact = (double)result->fact[finding];
    switch (finding) {
    case JCAL_FINDING_RATE_UNIT:
        (void)snprintf(sentence, SENTENCE_MAX,
                       "rates of sensor %d look like deg/s; rad/s are needed: multiply by 0.0174533", number);
        break;
    case JCAL_FINDING_SCALE:
        (void)snprintf(sentence, SENTENCE_MAX,
                       "rates of sensor %d: gravity turns %.3f times as fast as they say, to within %.3f; check the "
                       "gyroscope's scale, and the rate behind t_s",
                       number, fact, (double)result->scale_bound);
        break;
    case JCAL_FINDING_VIBRATES:
        (void)snprintf(sentence, SENTENCE_MAX,
                       "sensor %d vibrates all the time, by %.2g rad/s or more: fasten it, or find what shakes it",
                       number, fact);
        break;
    default:
        say_frames(result, number, sentence);
        break;
    }
}

static void say_times(const jcal_health_result_t *result, jcal_finding_t finding, sentence_t sentence)
{
    const double fact = (double)result->fact[finding];
    if (finding == JCAL_FINDING_GAPS) {
        (void)snprintf(sentence, SENTENCE_MAX,
                       "%.2g %% of the rows are missing, in %u gaps of up to %.2g s: check the radio, or the logger",
                       100.0 * fact, (unsigned)result->gaps, (double)result->longest_gap_s);
    } else {
        (void)snprintf(sentence, SENTENCE_MAX,
                       "rows are uneven by %.2g ms where they are %.2g ms apart: make t_s of the sensor's own clock or "
                       "counter",
                       1e3 * fact, 1e3 / (double)result->rate_hz);
    }
}

bool check_health_sentence(const jcal_health_result_t *result, jcal_finding_t finding, int number, sentence_t sentence)
{
    if (result->state[finding] != JCAL_HEALTH_NAMED) {
        return false;
    }
    switch (finding) {
    case JCAL_FINDING_GAPS:
    case JCAL_FINDING_UNEVEN:
        say_times(result, finding, sentence);
        break;
    case JCAL_FINDING_FROZEN:
    case JCAL_FINDING_HELD:
    case JCAL_FINDING_DEAD:
    case JCAL_FINDING_CLIPPED:
        say_values(result, finding, number, sentence);
        break;
    case JCAL_FINDING_NO_GRAVITY:
    case JCAL_FINDING_GRAVITY_OFF:
        say_gravity(result, finding, number, sentence);
        break;
    default:
        say_rates(result, finding, number, sentence);
        break;
    }
    return true;
}
