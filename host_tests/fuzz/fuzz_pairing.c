/* SPDX-License-Identifier: MIT */
/* Any bytes as readings of two sensors with times: pairs are at common times that increase, each number is within what its two neighbours
 * span, every common time is counted once, and what is said of the lag is within its limits. */
#include "bytes.h"
#include "jointcal/pairing.h"
#include "jointcal/sensor.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define HEAD_BYTES 3u     /* kind of run and repeats, period, gap */
#define READING_BYTES 15u /* what happens, 2 of time, 12 of values */
#define NUMBERS 6u
#define KEPT 128u /* more common times than wait and are in a stretch */
#define ROUNDING                                                                                                       \
    4.8e-7f /* an interpolated number may be so far outside of what its neighbours span, as a share of the larger one */
#define LAG_MOST_S 0.261f /* 0.25 and the largest bound, and rounding */
#define TAKEN_MOST_S 0.301f
#define BOUND_MOST_S 0.01001f

/* The two readings around a common time, as the larger and the smaller of each number. */
typedef struct {
    uint64_t t_us;
    float low[NUMBERS], high[NUMBERS];
} span_t;

/* A sensor as it was pushed; times less what was taken off. */
typedef struct {
    span_t span[KEPT]; /* the last ones, a ring */
    uint32_t offered;  /* common times between two readings */
    uint64_t t_us;
    float last[NUMBERS];
    bool has_last;
} side_t;

typedef struct {
    jcal_pairing_t pairing;
    jcal_lag_t lag;
    jcal_sensor_t sensor[2];
    side_t side[2];
    uint64_t period_us, gap_us;
    uint64_t last_us; /* of the last pair */
    uint64_t hole_us; /* no pair within so much after it */
    int64_t shift_us;
    uint32_t pairs, rejected;
    bool has_pair, went_back, was_shifted, with_lag;
} run_t;

static void numbers_of(const jcal_imu_t *imu, float *out)
{
    const float all[NUMBERS] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z,
                                imu->acc_m_s2.x,  imu->acc_m_s2.y,  imu->acc_m_s2.z};
    memcpy(out, all, sizeof all);
}

/* The common times since the reading before, if that is not too long ago. */
static void remember(run_t *run, side_t *side, const jcal_reading_t *reading, uint64_t t_us)
{
    float now[NUMBERS];
    numbers_of(&reading->imu, now);
    const uint64_t first_us = (side->t_us / run->period_us + 1u) * run->period_us;
    const bool is_next = side->has_last && t_us > side->t_us && t_us - side->t_us <= run->gap_us;
    const bool goes_on = is_next && first_us > side->t_us; /* not at the end of time */
    for (uint64_t at_us = first_us; goes_on && at_us <= t_us && at_us >= first_us; at_us += run->period_us) {
        span_t *const span = &side->span[side->offered % KEPT];
        span->t_us = at_us;
        for (size_t k = 0; k < NUMBERS; k++) {
            span->low[k] = fminf(side->last[k], now[k]);
            span->high[k] = fmaxf(side->last[k], now[k]);
        }
        side->offered++;
    }
    run->went_back = run->went_back || (side->has_last && t_us < side->t_us);
    memcpy(side->last, now, sizeof now);
    side->t_us = t_us;
    side->has_last = true;
}

static void check_imu(const side_t *side, const jcal_imu_t *imu, uint64_t t_us)
{
    float found[NUMBERS];
    numbers_of(imu, found);
    const uint32_t most = (side->offered < KEPT) ? side->offered : KEPT;
    uint32_t back = 1;
    while (back <= most && side->span[(side->offered - back) % KEPT].t_us != t_us) {
        back++;
    }
    require(back <= most);
    const span_t *const span = &side->span[(side->offered - back) % KEPT];
    for (size_t k = 0; k < NUMBERS; k++) {
        const float off = ROUNDING * fmaxf(fabsf(span->low[k]), fabsf(span->high[k]));
        require_within(found[k], span->low[k] - off, span->high[k] + off);
    }
}

static void check_pair(run_t *run, const jcal_pair_t *pair)
{
    require(pair->t_us % run->period_us == 0u);
    require(!run->has_pair || run->went_back ||
            (pair->t_us > run->last_us && pair->t_us - run->last_us > run->hole_us));
    check_imu(&run->side[0], &pair->imu1, pair->t_us);
    check_imu(&run->side[1], &pair->imu2, pair->t_us);
    run->went_back = run->went_back && run->has_pair && pair->t_us > run->last_us;
    run->last_us = pair->t_us;
    run->hole_us = 0u;
    run->has_pair = true;
    run->pairs++;
}

/* What waits not, and is in no hole, is a pair or lost. */
static void check_counters(const run_t *run, bool all_pulled)
{
    jcal_pairing_result_t result;
    require(jcal_pairing_get(&run->pairing, &result) == JCAL_OK);
    require(result.pairs == run->pairs && result.rejected == run->rejected);
    require((result.ahead == 1u || result.ahead == 2u) && result.waiting <= JCAL_PAIRING_WAITING);
    require(fabsf(result.shift_s - 1e-6f * (float)run->shift_us) < 1e-7f);
    const uint32_t lost[2] = {result.lost1, result.lost2};
    for (unsigned k = 0; k < 2; k++) {
        const uint32_t told = result.pairs + lost[k] + (result.ahead == k + 1u ? result.waiting : 0u);
        require(told <= run->side[k].offered);
        require(!all_pulled || run->was_shifted || told == run->side[k].offered);
    }
}

static void check_lag(const jcal_lag_t *lag)
{
    jcal_lag_result_t result;
    require(jcal_lag_get(lag, &result) == JCAL_OK);
    require_within(result.taken_s, -TAKEN_MOST_S, TAKEN_MOST_S);
    require_within(result.left, 0.0f, 1.0f);
    require_within(result.motion_s, 0.0f, 30.5f);
    if (result.lag_known) {
        require_within(result.lag_s, -LAG_MOST_S, LAG_MOST_S);
        require_within(result.bound_s, 0.002f, BOUND_MOST_S);
    } else {
        require(result.lag_s == result.taken_s && result.bound_s == JCAL_LAG_UNKNOWN_S);
    }
}

/* Times before and after are not to be compared any more; readings that waited are lost. */
static void begin_anew(run_t *run, int64_t by_us)
{
    run->shift_us += by_us;
    run->side[1].has_last = false;
    run->hole_us = JCAL_PAIRING_HOLE_US;
    run->was_shifted = true;
}

static void learn(run_t *run, const jcal_pair_t *pair)
{
    const jcal_reading_t reading1 = {pair->t_us, pair->imu1};
    const jcal_reading_t reading2 = {pair->t_us, pair->imu2};
    const jcal_status_t of1 = jcal_sensor_push(&run->sensor[0], &reading1);
    const jcal_status_t of2 = jcal_sensor_push(&run->sensor[1], &reading2);
    if (of1 == JCAL_TICK && of2 == JCAL_TICK) {
        require(jcal_lag_add(&run->lag, jcal_sensor_tick(&run->sensor[0]), jcal_sensor_tick(&run->sensor[1])) >=
                JCAL_OK);
    }
    require(jcal_lag_step(&run->lag) >= JCAL_OK);
    jcal_pairing_result_t before;
    jcal_pairing_result_t after;
    require(jcal_pairing_get(&run->pairing, &before) == JCAL_OK);
    const jcal_status_t status = jcal_pairing_align(&run->pairing, &run->lag);
    require(jcal_pairing_get(&run->pairing, &after) == JCAL_OK);
    require(status == JCAL_OK || status == JCAL_IDLE);
    if (status == JCAL_OK) {
        begin_anew(run, llroundf(1e6f * (after.shift_s - before.shift_s)));
    }
    check_lag(&run->lag);
}

static void pull_all(run_t *run)
{
    jcal_pair_t pair;
    jcal_status_t status = jcal_pairing_pull(&run->pairing, &pair);
    for (unsigned k = 0; k <= JCAL_PAIRING_WAITING && status == JCAL_OK; k++) {
        check_pair(run, &pair);
        if (run->with_lag) {
            learn(run, &pair);
        }
        status = jcal_pairing_pull(&run->pairing, &pair);
    }
    require(status == JCAL_IDLE);
    check_counters(run, true);
}

/* A lag of the caller's, within +-0.33 s. */
static void shift(run_t *run, const uint8_t *data)
{
    const float lag_s = component(data, AS_SENSOR, 0.33f);
    const int64_t by_us = (int64_t)(1e6f * lag_s + (lag_s < 0.0f ? -0.5f : 0.5f));
    const int64_t all_us = run->shift_us + by_us;
    const jcal_status_t status = jcal_pairing_shift(&run->pairing, lag_s);
    require((status == JCAL_OK) == (all_us <= 300000 && all_us >= -300000));
    if (status == JCAL_OK) {
        begin_anew(run, by_us);
    }
}

static void push(run_t *run, const uint8_t *data, reading_t kind, uint64_t *t_us)
{
    const unsigned index = data[0] & 1u;
    int16_t step;
    memcpy(&step, data + 1, sizeof step);
    const bool jumps = (data[0] & 0x70u) == 0x10u;
    *t_us += jumps ? (uint64_t)((int64_t)step * 1000) : (uint64_t)((uint16_t)step % 20000u);
    const jcal_reading_t reading = {*t_us, imu_at(data + 3, kind, 35.0f, 160.0f)};
    const jcal_status_t status = jcal_pairing_push(&run->pairing, index + 1u, &reading);
    require(status == JCAL_OK || status == JCAL_REJECTED);
    run->rejected += (status == JCAL_REJECTED) ? 1u : 0u;
    if (status == JCAL_OK) {
        const int64_t off_us = (index == 1u) ? run->shift_us : 0;
        require(off_us <= 0 || reading.t_us >= (uint64_t)off_us);
        remember(run, &run->side[index], &reading, reading.t_us - (uint64_t)off_us);
    }
    if ((data[0] & 0x0Eu) != 0u) {
        pull_all(run); /* mostly */
    } else {
        check_counters(run, false);
    }
}

static void run_readings(const uint8_t *data, size_t size)
{
    static run_t run;
    memset(&run, 0, sizeof run);
    run.period_us = 4000u + 46000u * (uint64_t)data[1] / 255u;
    run.gap_us = 5000u + 94900u * (uint64_t)data[2] / 255u;
    run.with_lag = (data[0] & 4u) != 0u;
    const jcal_pairing_config_t config = {1e-6f * (float)run.period_us, 1e-6f * ((float)run.gap_us + 0.5f)};
    require(jcal_pairing_init(&run.pairing, &config) == JCAL_OK && jcal_lag_init(&run.lag) == JCAL_OK);
    require(jcal_sensor_init(&run.sensor[0]) == JCAL_OK && jcal_sensor_init(&run.sensor[1]) == JCAL_OK);
    const reading_t kind = (data[0] & 1u) != 0u ? AS_SENSOR : AS_FLOATS;
    uint64_t t_us = (data[0] & 2u) != 0u ? UINT64_MAX - 1000000u : 0u;
    for (unsigned repeat = 0; repeat < 1u + data[0] / 16u; repeat++) {
        for (size_t at = HEAD_BYTES; at + READING_BYTES <= size; at += READING_BYTES) {
            if ((data[at] & 0xF0u) == 0x20u && !run.with_lag) {
                shift(&run, data + at + 1);
            }
            push(&run, data + at, kind, &t_us);
        }
    }
    pull_all(&run);
}

/* The lag alone: ticks that no two sensors of one motion would make, too. */
static void run_ticks(const uint8_t *data, size_t size)
{
    static jcal_lag_t lag;
    require(jcal_lag_init(&lag) == JCAL_OK);
    const reading_t kind = (data[0] & 1u) != 0u ? AS_SENSOR : AS_FLOATS;
    uint64_t t_us = 0;
    for (unsigned repeat = 0; repeat < 1u + data[0] / 16u; repeat++) {
        for (size_t at = HEAD_BYTES; at + TICK_BYTES <= size; at += TICK_BYTES) {
            const uint64_t step_us = step_of(data + at, kind, 5000u) * 4u;
            t_us += step_us;
            const float dt_s = (kind == AS_SENSOR) ? 1e-6f * (float)step_us : component(data + at, kind, 1.0f);
            jcal_tick_t tick1 = tick_at(data + at + 2, kind, t_us, dt_s);
            jcal_tick_t tick2 = tick_at(data + at + 70, kind, t_us, dt_s);
            tick1.since_s = 0.25f * (float)data[at]; /* filters are warm, mostly */
            tick2.since_s = 0.25f * (float)data[at + 1];
            require(jcal_lag_add(&lag, &tick1, &tick2) >= JCAL_OK);
            for (unsigned k = 0; k < data[1] % 8u; k++) {
                require(jcal_lag_step(&lag) >= JCAL_OK);
                (void)jcal_lag_take(&lag);
                check_lag(&lag);
            }
        }
    }
}

/* Three bytes of settings; then readings, or ticks. All of it several times: a lag is learnt over seconds. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < HEAD_BYTES) {
        return 0;
    }
    if ((data[0] & 8u) != 0u) {
        run_ticks(data, size);
    } else {
        run_readings(data, size);
    }
    return 0;
}
