/* SPDX-License-Identifier: MIT */
/* Any bytes as packets of one sensor: times increase, every reading is counted once, what is said of the clock is within its limits. */
#include "bytes.h"
#include "jointcal/packet.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define HEAD_BYTES 4u
#define PACKET_BYTES 8u /* kind, readings and pulls, 2 of time, 4 of counter or of a long time */
#define SLOTS 8u

/* How the time of a packet, and its counter, go on. */
typedef enum { GOES_ON, COUNTER_JUMPS, COUNTER_ANEW, TIME_JUMPS } kind_t;

/* The sensor as it was made up, and what came of it. */
typedef struct {
    jcal_packets_t packets;
    uint64_t arrival_us;
    uint32_t counter;
    uint32_t taken;      /* readings that push took */
    uint32_t last_value; /* number of the last reading that came out */
    uint64_t last_us;
    uint32_t restarts;
    bool went_back;
    bool has_last;
} run_t;

static jcal_packet_config_t config_of(const uint8_t *data)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.period_ns = 500000u + (uint32_t)data[0] * (uint32_t)data[1] * 15000u;
    config.counter_bits = (uint8_t)(8u + data[2] % 25u);
    config.per_packet = (uint8_t)(1u + data[3] % 16u);
    config.packets = (uint16_t)(2u << (data[3] >> 4) % 3u);
    const float round_s = 1e-9f * (float)((uint64_t)config.period_ns << config.counter_bits);
    config.max_delay_s = fmaxf(0.02f, fminf(2.0f, 0.4f * round_s));
    config.max_drift_ppm = 10.0f + 3.0f * (float)data[1];
    return config;
}

static void check_status(run_t *run)
{
    jcal_packets_status_t status;
    require(jcal_packets_get(&run->packets, &status) == JCAL_OK);
    const float most = run->packets.cfg.max_drift_ppm;
    require_within(status.drift_ppm, -most, most);
    require_within(status.bound_ppm, 0.0f, most);
    require_within(status.jitter_s, 0.0f, run->packets.cfg.max_delay_s);
    require(status.period_s > 0.0f && status.waiting <= SLOTS);
    const uint32_t counted = status.readings + status.late + status.duplicate + status.odd;
    require(counted <= run->taken && (status.waiting > 0u || counted == run->taken));
    run->restarts = status.restarts;
}

/* Readings come out in the order of their packets; time goes back only with the hub's, and that is a restart. */
static void check_reading(run_t *run, const jcal_reading_t *reading)
{
    const uint32_t before = run->restarts;
    check_status(run);
    const uint32_t value = (uint32_t)reading->imu.gyr_rad_s.x;
    require(!run->has_last || value > run->last_value);
    const bool goes_on = (int64_t)(reading->t_us - run->last_us) > 0;
    require(!run->has_last || goes_on || (run->went_back && run->restarts > before));
    run->last_value = value;
    run->last_us = reading->t_us;
    run->has_last = true;
}

static void pull(run_t *run, unsigned times)
{
    jcal_reading_t reading;
    jcal_status_t status = JCAL_OK;
    for (unsigned k = 0; k < times && status != JCAL_IDLE; k++) {
        status = jcal_packets_pull(&run->packets, &reading);
        require(status == JCAL_OK || status == JCAL_REJECTED || status == JCAL_IDLE);
        if (status == JCAL_OK) {
            check_reading(run, &reading);
        }
    }
}

static void go_on(run_t *run, const uint8_t *data, kind_t kind, uint32_t count)
{
    uint32_t far;
    uint16_t step;
    memcpy(&step, data + 2, sizeof step);
    memcpy(&far, data + 4, sizeof far);
    const uint64_t before_us = run->arrival_us;
    const uint64_t way_us = (uint64_t)count * run->packets.cfg.period_ns / 1000u;
    run->arrival_us += way_us - (way_us * (step & 255u)) / 2048u + (way_us * (step >> 8)) / 2048u;
    if (kind == TIME_JUMPS) {
        run->arrival_us += (uint64_t)((int64_t)(int32_t)far * (int64_t)(1u << (step % 10u)));
    }
    run->counter += (kind == COUNTER_JUMPS) ? far % 300u - 100u : 0u;
    run->counter = (kind == COUNTER_ANEW) ? far : run->counter;
    run->went_back = run->went_back || (int64_t)(run->arrival_us - before_us) < 0;
}

static void push(run_t *run, const uint8_t *data)
{
    static const kind_t kinds[16] = {COUNTER_JUMPS, COUNTER_ANEW, TIME_JUMPS, COUNTER_JUMPS};
    const uint32_t count = 1u + (data[0] >> 4) % run->packets.cfg.per_packet;
    float values[16 * JCAL_PACKET_VALUES] = {0.0f};
    go_on(run, data, kinds[data[0] & 15u], count);
    for (uint32_t k = 0; k < count; k++) {
        values[k * JCAL_PACKET_VALUES] = (float)(run->taken + k + 1u);
    }
    const jcal_packet_t packet = {run->arrival_us, run->counter, (uint8_t)count, NULL, values};
    const jcal_status_t status = jcal_packets_push(&run->packets, &packet);
    require(status == JCAL_OK || status == JCAL_ERR_FULL);
    run->taken += (status == JCAL_OK) ? count : 0u;
    run->counter += count;
}

/* Four bytes of settings; then packets, of which each says how often pull is called after it. All of it several times: clocks are learnt
 * over minutes. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static unsigned char storage[JCAL_PACKETS_STORAGE_BYTES(SLOTS, 16u, JCAL_PACKET_SI)];
    static run_t run;
    memset(&run, 0, sizeof run);
    if (size < HEAD_BYTES) {
        return 0;
    }
    const jcal_packet_config_t config = config_of(data);
    if (jcal_packets_init(&run.packets, &config, storage, sizeof storage) != JCAL_OK) {
        return 0;
    }
    run.arrival_us = (data[0] & 1u) != 0u ? UINT64_MAX - 1000000u : 0u;
    for (unsigned repeat = 0; repeat < 1u + data[2] / 32u; repeat++) {
        for (size_t at = HEAD_BYTES; at + PACKET_BYTES <= size; at += PACKET_BYTES) {
            push(&run, data + at);
            pull(&run, data[at + 1]);
        }
    }
    pull(&run, SLOTS * 17u);
    check_status(&run);
    return 0;
}
