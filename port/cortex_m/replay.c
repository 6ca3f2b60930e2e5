/* SPDX-License-Identifier: MIT */
/* Replays samples through an engine and prints a hash of every result, on the host and on a target.
 *
 * Reads `samples.bin` (records laid out like jcal_pair_t, jcal_orientation_pair_t, jcal_triple_t or jcal_reading_t, little endian) from
 * the working directory; on a target that is a file of the host, by semihosting. Equal hashes mean equal bits of every field of every result. The functions
 * replay_mark_* tell tools/budget.py's instruction counter where a call begins and ends.
 *
 * Compile definitions: REPLAY_TWO_DOF, REPLAY_CENTER, REPLAY_CHAIN (stream engine of the 2-DoF joint, of the joint centre, of
 * hip and knee; otherwise that of the hinge), REPLAY_SENSOR (the stage of one sensor), REPLAY_HEALTH (the health of one), REPLAY_FUNCTIONAL (the functional hinge: a push is
 * jcal_functional_add at a tick, a step one jcal_functional_step, an update both; the stages of its sensors are not counted), REPLAY_TWO_AXES
 * (a person's joint with two axes, in the same way),
 * REPLAY_SHOW_SLICES (a line before each step of it: which slice), REPLAY_AUTO (a hinge of either kind), REPLAY_WINDOW (window engine of the hinge, N_max 125), REPLAY_SLICES=N (slices_per_s of the stream engine), REPLAY_SIXTEEN (sixteen stream engines, one call is the
 * update of all of them; the hash is that of the last), REPLAY_SPLIT (push and step apart), REPLAY_STACK (paint
 * the stack before every call and print how deep the deepest one went), REPLAY_LEG (hip and knee of a person, with their sensors' stages),
 * REPLAY_PACKETS (packets of four raw readings with jitter; a step is one pull), REPLAY_PAIRING (sensor 2 reads 3.7 ms later; a step is one
 * pull), REPLAY_LAG (the estimate of the lag, as REPLAY_FUNCTIONAL), REPLAY_BODY (replay_body.h; an update is a hundredth of a second),
 * REPLAY_PERSON (replay_person.h, in the same way; samples are packets). */
#include "jointcal/center.h"
#include "jointcal/chain.h"
#include "jointcal/functional.h"
#include "jointcal/health.h"
#include "jointcal/hinge.h"
#include "jointcal/hinge_auto.h"
#include "jointcal/hinge_window.h"
#include "jointcal/lag.h"
#include "jointcal/leg.h"
#include "jointcal/packet.h"
#include "jointcal/pairing.h"
#include "jointcal/sensor.h"
#include "jointcal/two_axes.h"
#include "jointcal/two_dof.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 64, N_MAX = 125, PAINT_WORDS = 1024 };
#define PAINT 0xC5A3C5A3u

typedef char pair_has_no_padding[(sizeof(jcal_pair_t) == 56) ? 1 : -1];
typedef char triple_has_no_padding[(sizeof(jcal_triple_t) == 80) ? 1 : -1];
typedef char reading_has_no_padding[(sizeof(jcal_reading_t) == 32) ? 1 : -1];
typedef char orientations_have_no_padding[(sizeof(jcal_orientation_pair_t) == 40) ? 1 : -1];

#ifdef REPLAY_TWO_DOF
typedef jcal_orientation_pair_t sample_t;
typedef jcal_two_dof_result_t result_t;
static jcal_two_dof_t replayed;
#define engine_push jcal_two_dof_push
#define engine_step jcal_two_dof_step
#define engine_update jcal_two_dof_update
#define engine_get jcal_two_dof_get

static jcal_status_t engine_init(void)
{
    const jcal_two_dof_config_t config = jcal_two_dof_config_default();
    return jcal_two_dof_init(&replayed, &config);
}
#elif defined(REPLAY_CENTER)
typedef jcal_pair_t sample_t;
typedef jcal_center_result_t result_t;
static jcal_center_t replayed;
#define engine_push jcal_center_push
#define engine_step jcal_center_step
#define engine_update jcal_center_update
#define engine_get jcal_center_get
#define has_axes has_center

static jcal_status_t engine_init(void)
{
    const jcal_center_config_t config = jcal_center_config_default();
    return jcal_center_init(&replayed, &config);
}
#elif defined(REPLAY_CHAIN)
typedef jcal_triple_t sample_t;
typedef jcal_chain_result_t result_t;
static jcal_chain_t replayed;
#define engine_step jcal_chain_step
#define engine_get jcal_chain_get
#define has_axes has_places

static jcal_status_t engine_push(jcal_chain_t *self, const jcal_triple_t *triple)
{
    return jcal_chain_push(self, triple, NULL);
}

#ifndef REPLAY_SPLIT
static void engine_update(jcal_chain_t *self, const jcal_triple_t *triple)
{
    (void)engine_push(self, triple);
    (void)engine_step(self);
}
#endif

static jcal_status_t engine_init(void)
{
    const jcal_chain_config_t config = jcal_chain_config_default();
    return jcal_chain_init(&replayed, &config);
}
#elif defined(REPLAY_LEG)
typedef jcal_triple_t sample_t;
typedef jcal_leg_result_t result_t;
static jcal_leg_t replayed;
#define engine_push jcal_leg_push
#define engine_step jcal_leg_step
#define engine_update jcal_leg_update
#define engine_get jcal_leg_get
#define has_axes has_joint[JCAL_LEG_KNEE]

static jcal_status_t engine_init(void)
{
    const jcal_leg_config_t config = jcal_leg_config_default();
    return jcal_leg_init(&replayed, &config, NULL);
}
#elif defined(REPLAY_SENSOR)
typedef jcal_reading_t sample_t;
typedef struct {
    jcal_quat_t orientation;
    jcal_vec3_t bias;
    jcal_tick_t tick;
} result_t;
static jcal_sensor_t replayed;
#define engine_update jcal_sensor_push

static jcal_status_t engine_init(void)
{
    return jcal_sensor_init(&replayed);
}

static jcal_status_t engine_get(const jcal_sensor_t *self, result_t *out)
{
    const jcal_tick_t *const tick = jcal_sensor_tick(self);
    memset(out, 0, sizeof(*out));
    out->orientation = jcal_sensor_orientation(self);
    out->bias = jcal_sensor_gyr_bias(self);
    if (tick != NULL) {
        out->tick = *tick;
    }
    return JCAL_OK;
}
#elif defined(REPLAY_HEALTH)
typedef jcal_reading_t sample_t;
typedef jcal_health_result_t result_t;
static jcal_health_t replayed;
#define engine_update jcal_health_push
#define engine_get jcal_health_get

static jcal_status_t engine_init(void)
{
    return jcal_health_init(&replayed);
}
#elif defined(REPLAY_FUNCTIONAL)
#define OF_TICKS
typedef jcal_pair_t sample_t;
typedef jcal_functional_result_t result_t;
static jcal_functional_t replayed;
static jcal_sensor_t sensors[2];
static uint64_t last_us;
#define engine_get jcal_functional_get
#define joint_add jcal_functional_add
#define joint_step jcal_functional_step
#define joint_slice replayed.slice

static jcal_status_t engine_init(void)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    const bool ready = (jcal_sensor_init(&sensors[0]) == JCAL_OK) && (jcal_sensor_init(&sensors[1]) == JCAL_OK);
    return ready ? jcal_functional_init(&replayed, &config) : JCAL_ERR_ARG;
}
#elif defined(REPLAY_TWO_AXES)
#define OF_TICKS
typedef jcal_pair_t sample_t;
typedef jcal_two_axes_result_t result_t;
static jcal_two_axes_t replayed;
static jcal_sensor_t sensors[2];
static uint64_t last_us;
#define engine_get jcal_two_axes_get
#define joint_add jcal_two_axes_add
#define joint_step jcal_two_axes_step
#define joint_slice replayed.ball.slice

static jcal_status_t engine_init(void)
{
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    const bool ready = (jcal_sensor_init(&sensors[0]) == JCAL_OK) && (jcal_sensor_init(&sensors[1]) == JCAL_OK);
    return ready ? jcal_two_axes_init(&replayed, &config) : JCAL_ERR_ARG;
}
#elif defined(REPLAY_LAG)
#define OF_TICKS
typedef jcal_pair_t sample_t;
typedef jcal_lag_result_t result_t;
static jcal_lag_t replayed;
static jcal_sensor_t sensors[2];
static uint64_t last_us;
#define engine_get jcal_lag_get
#define joint_add jcal_lag_add
#define joint_step jcal_lag_step
#define joint_slice replayed.search.slice

static jcal_status_t engine_init(void)
{
    const bool ready = (jcal_sensor_init(&sensors[0]) == JCAL_OK) && (jcal_sensor_init(&sensors[1]) == JCAL_OK);
    return ready ? jcal_lag_init(&replayed) : JCAL_ERR_ARG;
}
#elif defined(REPLAY_PAIRING)
typedef jcal_pair_t sample_t;
typedef struct {
    jcal_pairing_result_t counts;
    jcal_pair_t last;
} result_t;
static jcal_pairing_t replayed;
static jcal_pair_t last_pair;

static jcal_status_t engine_init(void)
{
    const jcal_pairing_config_t config = jcal_pairing_config_default();
    return jcal_pairing_init(&replayed, &config);
}

static jcal_status_t engine_get(const jcal_pairing_t *self, result_t *out)
{
    out->last = last_pair;
    return jcal_pairing_get(self, &out->counts);
}
#elif defined(REPLAY_PACKETS)
enum { PER_PACKET = 4, SLOTS = 16 };
typedef jcal_reading_t sample_t;
typedef struct {
    jcal_packets_status_t counts;
    jcal_reading_t last;
} result_t;
static jcal_packets_t replayed;
static unsigned char packet_storage[JCAL_PACKETS_STORAGE_BYTES(SLOTS, PER_PACKET, JCAL_PACKET_RAW)];
static jcal_reading_t last_reading;
static int16_t packet_values[PER_PACKET * JCAL_PACKET_VALUES];
static jcal_scale_t packet_scale;
static uint32_t packet_counter;

static jcal_status_t engine_init(void)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.per_packet = PER_PACKET;
    config.packets = SLOTS;
    config.values = JCAL_PACKET_RAW;
    const jcal_status_t has_scale = jcal_chip_scale("LSM6DSV", 2000.0f, 16.0f, &config.scale);
    packet_scale = config.scale;
    return (has_scale == JCAL_OK) ? jcal_packets_init(&replayed, &config, packet_storage, sizeof(packet_storage))
                                  : has_scale;
}

static jcal_status_t engine_get(const jcal_packets_t *self, result_t *out)
{
    out->last = last_reading;
    return jcal_packets_get(self, &out->counts);
}
#elif defined(REPLAY_BODY)
#include "replay_body.h"
#elif defined(REPLAY_PERSON)
#include "replay_person.h"
#elif defined(REPLAY_AUTO)
typedef jcal_pair_t sample_t;
typedef jcal_hinge_auto_result_t result_t;
static jcal_hinge_auto_t replayed;
#define engine_update jcal_hinge_auto_update
#define engine_get jcal_hinge_auto_get

static jcal_status_t engine_init(void)
{
    const jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    return jcal_hinge_auto_init(&replayed, &config);
}
#else
typedef jcal_pair_t sample_t;
typedef jcal_hinge_result_t result_t;
#ifdef REPLAY_WINDOW
static jcal_hinge_window_t replayed;
static float storage[JCAL_HINGE_WINDOW_STORAGE_BYTES(N_MAX, 21) / sizeof(float) + 1u];
#define engine_push jcal_hinge_window_push
#define engine_step jcal_hinge_window_step
#define engine_update jcal_hinge_window_update
#define engine_get jcal_hinge_window_get

static jcal_status_t engine_init(void)
{
    jcal_hinge_window_config_t config = jcal_hinge_window_config_default();
    config.n_max = N_MAX;
    return jcal_hinge_window_init(&replayed, &config, storage, sizeof(storage));
}
#else
#ifdef REPLAY_SIXTEEN
enum { INSTANCES = 16 };
#else
enum { INSTANCES = 1 };
#endif
static jcal_hinge_t engines[INSTANCES];
#define replayed engines[INSTANCES - 1]
#define engine_push jcal_hinge_push
#define engine_step jcal_hinge_step
#define engine_get jcal_hinge_get

#ifndef REPLAY_SPLIT
static void engine_update(const jcal_hinge_t *last, const jcal_pair_t *pair)
{
    (void)last;
    for (int k = 0; k < INSTANCES; ++k) {
        (void)jcal_hinge_update(&engines[k], pair);
    }
}
#endif

static jcal_status_t engine_init(void)
{
    jcal_hinge_config_t config = jcal_hinge_config_default();
#ifdef REPLAY_SLICES
    config.slices_per_s = (float)REPLAY_SLICES;
#endif
    jcal_status_t status = JCAL_OK;
    for (int k = 0; (k < INSTANCES) && (status == JCAL_OK); ++k) {
        status = jcal_hinge_init(&engines[k], &config);
    }
    return status;
}
#endif
#endif

static sample_t chunk[CHUNK];

/* Places that the instruction counter knows by name; the volatile keeps them apart and alive. */
extern volatile int replay_place;
volatile int replay_place;
void replay_mark_push(void);
void replay_mark_step(void);
void replay_mark_update(void);
void replay_mark_end(void);
__attribute__((noinline)) void replay_mark_push(void)
{
    replay_place = 1;
}
__attribute__((noinline)) void replay_mark_step(void)
{
    replay_place = 2;
}
__attribute__((noinline)) void replay_mark_update(void)
{
    replay_place = 3;
}
__attribute__((noinline)) void replay_mark_end(void)
{
    replay_place = 0;
}

#if defined(REPLAY_PAIRING)
static void push_one(unsigned which, const jcal_reading_t *reading)
{
    replay_mark_push();
    (void)jcal_pairing_push(&replayed, which, reading);
    replay_mark_end();
    jcal_status_t status = JCAL_OK;
    for (unsigned k = 0; (k <= JCAL_PAIRING_WAITING) && (status == JCAL_OK); ++k) {
        replay_mark_step();
        status = jcal_pairing_pull(&replayed, &last_pair);
        replay_mark_end();
    }
}

static __attribute__((noinline)) void call_engine(const sample_t *pair)
{
    const jcal_reading_t readings[2] = {{pair->t_us, pair->imu1}, {pair->t_us + 3700u, pair->imu2}};
    push_one(1u, &readings[0]);
    push_one(2u, &readings[1]);
}
#elif defined(REPLAY_PACKETS)
static int16_t raw_of(float value, float scale)
{
    const float raw = value / scale;
    return (int16_t)((raw > 32767.0f) ? 32767.0f : ((raw < -32768.0f) ? -32768.0f : raw));
}

/* Up to 8 ms of delay. */
static __attribute__((noinline)) void call_engine(const sample_t *reading)
{
    const jcal_imu_t *const imu = &reading->imu;
    const float values[JCAL_PACKET_VALUES] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z,
                                              imu->acc_m_s2.x,  imu->acc_m_s2.y,  imu->acc_m_s2.z};
    int16_t *const to = &packet_values[(packet_counter % PER_PACKET) * JCAL_PACKET_VALUES];
    for (unsigned k = 0; k < JCAL_PACKET_VALUES; ++k) {
        to[k] = raw_of(values[k], (k < 3u) ? packet_scale.gyr_rad_s : packet_scale.acc_m_s2);
    }
    ++packet_counter;
    if ((packet_counter % PER_PACKET) != 0u) {
        return;
    }
    const uint64_t delay_us = (packet_counter * 2654435761u) >> 19;
    const jcal_packet_t packet = {reading->t_us + delay_us, packet_counter - PER_PACKET, PER_PACKET, packet_values,
                                  NULL};
    replay_mark_push();
    (void)jcal_packets_push(&replayed, &packet);
    replay_mark_end();
    jcal_status_t status = JCAL_OK;
    for (unsigned k = 0; (k <= PER_PACKET) && ((status == JCAL_OK) || (status == JCAL_REJECTED)); ++k) {
        replay_mark_step();
        status = jcal_packets_pull(&replayed, &last_reading);
        replay_mark_end();
    }
}
#elif defined(REPLAY_BODY)
static __attribute__((noinline)) void call_engine(const sample_t *pair)
{
    tick_body(pair, replay_mark_update, replay_mark_end);
}
#elif defined(REPLAY_PERSON)
static __attribute__((noinline)) void call_engine(const sample_t *packet)
{
    take_packet(packet, replay_mark_update, replay_mark_end);
}
#elif defined(OF_TICKS)
/* As jcal_functional_pair_update and its like, with the marks of the parts that are asked for. */
static void mark_part(void (*mark)(void))
{
#ifdef REPLAY_SPLIT
    mark();
#else
    (void)mark;
#endif
}

static void step_all(uint64_t t_us)
{
    const unsigned most = 1u + (unsigned)(90u * (uint32_t)(t_us - last_us) / 1000000u);
    jcal_status_t status = JCAL_OK;
    for (unsigned k = 0; (k < most) && (status == JCAL_OK); ++k) {
#ifdef REPLAY_SHOW_SLICES
        printf("slice %u\n", (unsigned)joint_slice);
#endif
        mark_part(replay_mark_step);
        status = joint_step(&replayed);
        mark_part(replay_mark_end);
    }
}

static __attribute__((noinline)) void call_engine(const sample_t *pair)
{
    const jcal_reading_t readings[2] = {{pair->t_us, pair->imu1}, {pair->t_us, pair->imu2}};
    const jcal_status_t of1 = jcal_sensor_push(&sensors[0], &readings[0]);
    const jcal_status_t of2 = jcal_sensor_push(&sensors[1], &readings[1]);
#ifndef REPLAY_SPLIT
    replay_mark_update();
#endif
    if ((of1 == JCAL_TICK) && (of2 == JCAL_TICK)) {
        mark_part(replay_mark_push);
        (void)joint_add(&replayed, jcal_sensor_tick(&sensors[0]), jcal_sensor_tick(&sensors[1]));
        mark_part(replay_mark_end);
    }
    step_all(pair->t_us);
    last_us = pair->t_us;
#ifndef REPLAY_SPLIT
    replay_mark_end();
#endif
}
#else
static __attribute__((noinline)) void call_engine(const sample_t *pair)
{
#ifdef REPLAY_SPLIT
    replay_mark_push();
    (void)engine_push(&replayed, pair);
    replay_mark_end();
    replay_mark_step();
    (void)engine_step(&replayed);
    replay_mark_end();
#else
    replay_mark_update();
    (void)engine_update(&replayed, pair);
    replay_mark_end();
#endif
}
#endif

#ifdef REPLAY_STACK
/* The words below this function's frame; nothing else uses them between the two calls, and no interrupt is on. */
static __attribute__((noinline)) uint32_t call_and_measure(const sample_t *pair)
{
    volatile uint32_t *const top = (volatile uint32_t *)__builtin_frame_address(0) - 16;
    for (int k = 0; k < PAINT_WORDS; ++k) {
        top[-k] = PAINT;
    }
    call_engine(pair);
    uint32_t deepest = 0;
    for (uint32_t k = 0; k < PAINT_WORDS; ++k) {
        if (*(top - k) != PAINT) {
            deepest = k;
        }
    }
    return 4u * (deepest + 16u);
}
#else
static uint32_t call_and_measure(const sample_t *pair)
{
    call_engine(pair);
    return 0;
}
#endif

/* FNV-1a, 64 bit, least significant byte first. */
static uint64_t hash_u64(uint64_t hash, uint64_t value, int bytes)
{
    for (int k = 0; k < bytes; ++k) {
        hash = (hash ^ (value & 0xFFu)) * UINT64_C(0x100000001B3);
        value >>= 8;
    }
    return hash;
}

static uint64_t hash_f32(uint64_t hash, float value)
{
    uint32_t bits = 0x7FC00000u; /* NaNs differ between targets in bits that mean nothing */
    if (!isnan(value)) {
        memcpy(&bits, &value, sizeof(bits));
    }
    return hash_u64(hash, bits, 4);
}

#if defined(REPLAY_LAG)
static uint64_t hash_result(uint64_t hash, const result_t *r)
{
    hash = hash_f32(hash_f32(hash_f32(hash, r->lag_s), r->bound_s), r->taken_s);
    return hash_u64(hash_f32(hash_f32(hash, r->left), r->motion_s), r->lag_known ? 1u : 0u, 4);
}
#elif defined(REPLAY_PAIRING) || defined(REPLAY_PACKETS)
static uint64_t hash_vec3(uint64_t hash, jcal_vec3_t v)
{
    return hash_f32(hash_f32(hash_f32(hash, v.x), v.y), v.z);
}

static uint64_t hash_imu(uint64_t hash, const jcal_imu_t *imu)
{
    return hash_vec3(hash_vec3(hash, imu->gyr_rad_s), imu->acc_m_s2);
}

static uint64_t hash_result(uint64_t hash, const result_t *r)
{
#ifdef REPLAY_PAIRING
    const uint32_t words[] = {r->counts.pairs, r->counts.lost1, r->counts.lost2, r->counts.rejected, r->counts.waiting};
    hash = hash_imu(hash_imu(hash, &r->last.imu1), &r->last.imu2);
#else
    const uint32_t words[] = {r->counts.readings, r->counts.lost, r->counts.late, r->counts.duplicate, r->counts.odd};
    hash = hash_f32(hash_f32(hash_f32(hash, r->counts.drift_ppm), r->counts.bound_ppm), r->counts.jitter_s);
    hash = hash_imu(hash, &r->last.imu);
#endif
    for (size_t k = 0; k < sizeof(words) / sizeof(words[0]); ++k) {
        hash = hash_u64(hash, words[k], 4);
    }
    return hash_u64(hash, r->last.t_us, 8);
}
#elif defined(REPLAY_SENSOR)
static uint64_t hash_array(uint64_t hash, const float *values, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        hash = hash_f32(hash, values[k]);
    }
    return hash;
}

static uint64_t hash_result(uint64_t hash, const result_t *r)
{
    const jcal_tick_t *const tick = &r->tick;
    const float floats[] = {r->orientation.w, r->orientation.x, r->orientation.y, r->orientation.z,
                            r->bias.x,        r->bias.y,        r->bias.z,        tick->velocity.x,
                            tick->velocity.y, tick->velocity.z, tick->gyr.x,      tick->gyr.y,
                            tick->gyr.z,      tick->dt_s,       tick->since_s,    tick->acc_level_m_s2};
    hash = hash_array(hash, floats, sizeof(floats) / sizeof(floats[0]));
    hash = hash_array(hash, tick->turn, 9);
    hash = hash_array(hash, tick->rate, 9);
    hash = hash_array(hash, tick->lever, 9);
    return hash_u64(hash_u64(hash, tick->epoch, 4), tick->t_us, 8);
}
#elif defined(REPLAY_HEALTH)
static uint64_t hash_result(uint64_t hash, const result_t *r)
{
    for (size_t k = 0; k < JCAL_FINDING_COUNT; ++k) {
        hash = hash_f32(hash_u64(hash, (uint32_t)r->state[k], 4), r->fact[k]);
    }
    for (size_t k = 0; k < 3u; ++k) {
        hash = hash_u64(hash, (uint32_t)(10 + r->way.column[k]) + (100u * (uint32_t)(10 + r->way.sign[k])), 4);
    }
    const uint32_t words[] = {
        r->readings, r->rejected, r->gaps, r->dead, r->clipped, r->way_known ? 1u : 0u, r->way_of_gyr ? 1u : 0u};
    for (size_t k = 0; k < sizeof(words) / sizeof(words[0]); ++k) {
        hash = hash_u64(hash, words[k], 4);
    }
    const float floats[] = {r->rate_hz,  r->longest_gap_s, r->rest_s,    r->rms_rad_s,
                            r->motion_s, r->scale_bound,   r->fast_share};
    for (size_t k = 0; k < sizeof(floats) / sizeof(floats[0]); ++k) {
        hash = hash_f32(hash, floats[k]);
    }
    return hash;
}
#else
#ifdef REPLAY_TWO_DOF
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    const float floats[] = {r->axis1.x,
                            r->axis1.y,
                            r->axis1.z,
                            r->axis2.x,
                            r->axis2.y,
                            r->axis2.z,
                            r->heading_offset_rad,
                            r->carrying_angle_rad,
                            r->uncertainty1_rad,
                            r->uncertainty2_rad,
                            r->uncertainty_heading_rad,
                            r->progress_axis1,
                            r->progress_axis2,
                            r->progress_heading};
#elif defined(REPLAY_CENTER)
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    const jcal_vec3_t vectors[] = {r->joint_to_sensor1_m, r->joint_to_sensor2_m, r->weakest_direction1,
                                   r->weakest_direction2, r->acc_bias1_m_s2,     r->acc_bias2_m_s2};
    for (size_t k = 0; k < sizeof(vectors) / sizeof(vectors[0]); ++k) {
        hash = hash_f32(hash_f32(hash_f32(hash, vectors[k].x), vectors[k].y), vectors[k].z);
    }
    const float floats[] = {r->uncertainty1_m,
                            r->uncertainty2_m,
                            r->uncertainty_weakest1_m,
                            r->uncertainty_weakest2_m,
                            r->heading_offset_rad,
                            r->misfit,
                            r->progress1,
                            r->progress2};
#elif defined(REPLAY_CHAIN)
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    for (int k = 0; k < JCAL_CHAIN_PLACES; ++k) {
        hash = hash_f32(hash_f32(hash_f32(hash, r->place_m[k].x), r->place_m[k].y), r->place_m[k].z);
    }
    const float floats[] = {r->uncertainty_m[0],       r->uncertainty_m[1],      r->uncertainty_m[2],
                            r->uncertainty_m[3],       r->segment_length_m,      r->uncertainty_segment_m,
                            (float)r->joint_status[0], (float)r->joint_status[1]};
#elif defined(REPLAY_LEG)
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    for (int k = 0; k < JCAL_CHAIN_PLACES; ++k) {
        hash = hash_f32(hash_f32(hash_f32(hash, r->place_m[k].x), r->place_m[k].y), r->place_m[k].z);
        hash = hash_u64(hash_f32(hash, r->uncertainty_m[k]), r->known[k] ? 1u : 0u, 4);
    }
    const float floats[] = {r->heading[0].heading_rad,     r->heading[1].heading_rad, r->uncertainty_heading_rad[0],
                            r->uncertainty_heading_rad[1], r->segment_length_m,       r->uncertainty_segment_m};
#elif defined(REPLAY_FUNCTIONAL)
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    hash = hash_u64(hash, (r->for_axes ? 1u : 0u) + (r->for_flexion ? 2u : 0u) + (r->heading.known ? 4u : 0u), 4);
    const float flexion =
        jcal_functional_flexion(&replayed, jcal_sensor_orientation(&sensors[0]), jcal_sensor_orientation(&sensors[1]));
    const float floats[] = {r->axis1.x,
                            r->axis1.y,
                            r->axis1.z,
                            r->axis2.x,
                            r->axis2.y,
                            r->axis2.z,
                            r->uncertainty1_rad,
                            r->uncertainty2_rad,
                            r->flexion_uncertainty_rad,
                            r->rate_share,
                            r->bend_rad,
                            r->sign_margin,
                            r->heading.heading_rad,
                            r->joint_to_sensor1_m.x,
                            r->joint_to_sensor1_m.y,
                            r->joint_to_sensor1_m.z,
                            r->joint_to_sensor2_m.x,
                            r->joint_to_sensor2_m.y,
                            r->joint_to_sensor2_m.z,
                            r->progress_axis1,
                            r->progress_axis2,
                            r->progress_sign,
                            flexion};
#elif defined(REPLAY_TWO_AXES)
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    const jcal_ball_result_t *const b = &r->ball;
    hash = hash_u64(hash,
                    (r->for_heading ? 1u : 0u) + (r->for_axis1 ? 2u : 0u) + (r->for_axis2 ? 4u : 0u) +
                        (b->for_center1 ? 8u : 0u) + (b->for_center2 ? 16u : 0u) + (b->heading.known ? 32u : 0u) +
                        (64u * r->windows1) + (16384u * r->windows2),
                    4);
    const jcal_quat_t q =
        jcal_ball_relative(&replayed.ball, jcal_sensor_orientation(&sensors[0]), jcal_sensor_orientation(&sensors[1]));
    const float floats[] = {r->axis1.x,
                            r->axis1.y,
                            r->axis1.z,
                            r->axis2.x,
                            r->axis2.y,
                            r->axis2.z,
                            r->uncertainty1_rad,
                            r->uncertainty2_rad,
                            r->progress_axis1,
                            r->progress_axis2,
                            b->heading.heading_rad,
                            b->uncertainty_heading_rad,
                            b->joint_to_sensor1_m.x,
                            b->joint_to_sensor1_m.y,
                            b->joint_to_sensor1_m.z,
                            b->joint_to_sensor2_m.x,
                            b->joint_to_sensor2_m.y,
                            b->joint_to_sensor2_m.z,
                            b->uncertainty1_m,
                            b->uncertainty2_m,
                            b->speed_m_s,
                            b->gravity_off_m_s2,
                            b->progress_heading,
                            b->progress_center1,
                            b->progress_center2,
                            q.w,
                            q.x,
                            q.y,
                            q.z};
#elif defined(REPLAY_BODY) || defined(REPLAY_PERSON)
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    const float floats[] = {r->axis1.x,
                            r->axis1.y,
                            r->axis1.z,
                            r->axis2.x,
                            r->axis2.y,
                            r->axis2.z,
                            r->uncertainty1_rad,
                            r->uncertainty2_rad,
                            r->flexion_rad,
                            r->flexion_bound_rad,
                            r->heading.heading_rad,
                            r->lag_s,
                            r->lag_bound_s,
                            r->joint_to_sensor1_m.x,
                            r->joint_to_sensor1_m.y,
                            r->joint_to_sensor1_m.z,
                            r->joint_to_sensor2_m.x,
                            r->joint_to_sensor2_m.y,
                            r->joint_to_sensor2_m.z};
#elif defined(REPLAY_AUTO)
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    hash = hash_u64(hash, (uint32_t)r->model + (8u * (uint32_t)r->ready_for), 4);
    const jcal_hinge_result_t *const h = &r->hinge;
    const float floats[] = {h->axis1.x,
                            h->axis1.y,
                            h->axis1.z,
                            h->axis2.x,
                            h->axis2.y,
                            h->axis2.z,
                            h->uncertainty1_rad,
                            h->uncertainty2_rad,
                            h->sign_margin,
                            h->progress_axis1,
                            h->progress_axis2,
                            h->progress_sign,
                            r->flexion_uncertainty_rad,
                            r->bend_rad,
                            r->heading.heading_rad,
                            r->joint_to_sensor1_m.x,
                            r->joint_to_sensor1_m.y,
                            r->joint_to_sensor1_m.z,
                            r->joint_to_sensor2_m.x,
                            r->joint_to_sensor2_m.y,
                            r->joint_to_sensor2_m.z,
                            jcal_hinge_auto_flexion(&replayed)};
#else
static uint64_t hash_floats(uint64_t hash, const result_t *r)
{
    hash = hash_u64(hash, r->paper_accepted ? 1u : 0u, 4);
    const float floats[] = {r->axis1.x,     r->axis1.y,        r->axis1.z,          r->axis2.x,
                            r->axis2.y,     r->axis2.z,        r->uncertainty1_rad, r->uncertainty2_rad,
                            r->sign_margin, r->progress_axis1, r->progress_axis2,   r->progress_sign};
#endif
    for (size_t k = 0; k < sizeof(floats) / sizeof(floats[0]); ++k) {
        hash = hash_f32(hash, floats[k]);
    }
    return hash;
}

#ifdef REPLAY_AUTO
#define head hinge.head
#define has_axes hinge.has_axes
#elif defined(REPLAY_TWO_AXES)
#define head ball.head
#define has_axes ball.has_estimate
#elif defined(REPLAY_BODY) || defined(REPLAY_PERSON)
#define has_axes lag_known
#endif
static uint64_t hash_result(uint64_t hash, const result_t *r)
{
    const jcal_head_t *const h = &r->head;
    const uint32_t words[] = {(uint32_t)h->status, (uint32_t)h->engine,   (uint32_t)h->weak, (uint32_t)h->hint,
                              (uint32_t)h->reason, r->has_axes ? 1u : 0u, h->samples,        h->rejected};
    for (size_t k = 0; k < sizeof(words) / sizeof(words[0]); ++k) {
        hash = hash_u64(hash, words[k], 4);
    }
    hash = hash_floats(hash, r);
    for (int k = 0; k < JCAL_REJECT_COUNT; ++k) {
        hash = hash_u64(hash, h->rejected_by[k], 4);
    }
    return hash_u64(hash, h->t_us, 8);
}
#endif

/* False where there is no status. */
static bool is_ready(const result_t *r)
{
#if defined(REPLAY_SENSOR) || defined(REPLAY_HEALTH) || defined(REPLAY_LAG) || defined(REPLAY_PAIRING) ||              \
    defined(REPLAY_PACKETS)
    (void)r;
    return false;
#else
    return r->head.status == JCAL_READY;
#endif
}

int main(void)
{
    FILE *const file = fopen("samples.bin", "rb");
    if (file == NULL || engine_init() != JCAL_OK) {
        puts("no samples.bin, or no engine");
        return EXIT_FAILURE;
    }
    uint64_t hash = UINT64_C(0xCBF29CE484222325);
    uint32_t samples = 0;
    uint32_t stack = 0;
    uint32_t before_ready = 0;
    bool was_ready = false;
    result_t result;
    for (size_t count = fread(chunk, sizeof(chunk[0]), CHUNK, file); count > 0;
         count = fread(chunk, sizeof(chunk[0]), CHUNK, file)) {
        for (size_t k = 0; k < count; ++k) {
            const uint32_t deep = call_and_measure(&chunk[k]);
            stack = (deep > stack) ? deep : stack;
            (void)engine_get(&replayed, &result);
            hash = hash_result(hash, &result);
            ++samples;
            was_ready = was_ready || is_ready(&result);
            before_ready += was_ready ? 0u : 1u;
        }
    }
    (void)fclose(file);
#ifdef REPLAY_ROWS
    write_ends();
#endif
    printf("samples %lu hash %08lx%08lx state %lu stack %lu before_ready %lu\n", (unsigned long)samples,
           (unsigned long)(hash >> 32), (unsigned long)(hash & 0xFFFFFFFFu), (unsigned long)sizeof(replayed),
           (unsigned long)stack, (unsigned long)before_ready);
    return (samples > 0) ? EXIT_SUCCESS : EXIT_FAILURE;
}
