/* SPDX-License-Identifier: MIT */
/* Memory of running estimators that changes by itself: bits, bytes, words, numbers that are none. Then they run on, and nothing may crash,
 * hang, or leave its arrays; what they say is worth nothing.
 *
 *     corrupt COUNT [NAME...]       so many corruptions of each state; a table on standard output, exit status 1 if anything broke
 *     corrupt --one NAME NUMBER     one of them again, without a process of its own
 *
 * Left alone are pointers that the caller handed over, and how much they point at (holes below): nothing can be checked against them. A bool
 * that is neither 0 nor 1 is undefined in C, and that alone is not counted: build with -fno-sanitize=bool, or let it recover. */
#include "jointcal/body.h"
#include "jointcal/hinge_auto.h"
#include "jointcal/keep_flash.h"
#include "jointcal/pairing.h"
#include "jointcal/remember.h"
#include "unit/functional/motion.h"

#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    RATE = 100,
    SAMPLES = 5000, /* of the motion, 50 s */
    AGES = 4,       /* at which states are taken */
    RUN_ON = 300,   /* samples after a corruption */
    MOST_SECONDS = 5,
    HOLES = 12
};
static const unsigned AGE[AGES] = {50u, 700u, 2000u, SAMPLES - RUN_ON};

/* ---- what sensors tell of the motion */

static jcal_reading_t readings[2][SAMPLES];
static jcal_tick_t ticks[2][SAMPLES];
static bool has_tick[SAMPLES];
static hinge_t motion;

static void make_motion(void)
{
    motion = hinge_usual();
    motion.twist = 0.4;
    motion.rest_s = 1.0;
    static jcal_sensor_t sensors[2];
    (void)jcal_sensor_init(&sensors[0]);
    (void)jcal_sensor_init(&sensors[1]);
    for (unsigned k = 0; k < SAMPLES; k++) {
        bool both = true;
        for (int s = 0; s < 2; s++) {
            hinge_sensor_t of;
            hinge_sensor(&motion, (double)k / RATE, s + 1, &of);
            const jcal_reading_t reading = {10000u * (uint64_t)(k + 100u), {to_vec3(of.gyr), to_vec3(of.force)}};
            readings[s][k] = reading;
            const bool made = jcal_sensor_push(&sensors[s], &reading) == JCAL_TICK;
            const jcal_tick_t *const tick = jcal_sensor_tick(&sensors[s]);
            both = both && made && (tick != NULL);
            if (tick != NULL) {
                ticks[s][k] = *tick;
            }
        }
        has_tick[k] = both;
    }
}

static jcal_pair_t pair_at(unsigned k)
{
    const jcal_pair_t pair = {readings[0][k].t_us, readings[0][k].imu, readings[1][k].imu};
    return pair;
}

/* Text of a word of a result, which may be any number by now. */
static void read_words(const jcal_head_t *head)
{
    (void)jcal_calibration_string(head->status);
    (void)jcal_reason_string(head->reason);
    (void)jcal_weak_string(head->weak);
    (void)jcal_hint_string(head->hint);
}

/* ---- states: how each begins, and what one sample does to it */

typedef struct {
    size_t at, bytes;
} hole_t;

typedef struct {
    const char *name;
    void *state;
    size_t bytes;
    bool (*begin)(void);
    void (*go)(unsigned k);
    hole_t holes[HOLES];
} subject_t;

static jcal_sensor_t sensor;

static bool begin_sensor(void)
{
    return jcal_sensor_init(&sensor) == JCAL_OK;
}

static void go_sensor(unsigned k)
{
    (void)jcal_sensor_push(&sensor, &readings[0][k]);
    (void)jcal_sensor_tick(&sensor);
    (void)jcal_sensor_orientation(&sensor);
    (void)jcal_sensor_gyr_bias(&sensor);
}

static jcal_health_t health;

static bool begin_health(void)
{
    return jcal_health_init(&health) == JCAL_OK;
}

static void go_health(unsigned k)
{
    jcal_health_result_t result;
    (void)jcal_health_push(&health, &readings[0][k]);
    if ((k % 10u) == 0u) {
        (void)jcal_health_get(&health, &result);
    }
}

#define SLOTS 16u
static struct {
    jcal_packets_t packets;
    unsigned char storage[JCAL_PACKETS_STORAGE_BYTES(SLOTS, 4u, JCAL_PACKET_SI)];
} wire;

static bool begin_packets(void)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.packets = SLOTS;
    config.per_packet = 4u;
    return jcal_packets_init(&wire.packets, &config, wire.storage, sizeof wire.storage) == JCAL_OK;
}

static void fill_si(float si[6], const jcal_imu_t *imu)
{
    const float values[6] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z,
                             imu->acc_m_s2.x,  imu->acc_m_s2.y,  imu->acc_m_s2.z};
    memcpy(si, values, sizeof values);
}

static void go_packets(unsigned k)
{
    float si[24];
    jcal_reading_t reading;
    jcal_packets_status_t status;
    const unsigned count = 1u + k % 4u;
    for (unsigned i = 0; i < count; i++) {
        fill_si(si + 6u * i, &readings[0][k].imu);
    }
    const jcal_packet_t packet = {readings[0][k].t_us * 2u, k * 2u, (uint8_t)count, NULL, si};
    (void)jcal_packets_push(&wire.packets, &packet);
    for (unsigned n = 0; (n < 100u) && (jcal_packets_pull(&wire.packets, &reading) != JCAL_IDLE); n++) {
    }
    (void)jcal_packets_get(&wire.packets, &status);
}

static jcal_lag_t lag;

static bool begin_lag(void)
{
    return jcal_lag_init(&lag) == JCAL_OK;
}

static void go_lag(unsigned k)
{
    jcal_lag_result_t result;
    if (has_tick[k]) {
        (void)jcal_lag_add(&lag, &ticks[0][k], &ticks[1][k]);
    }
    (void)jcal_lag_step(&lag);
    (void)jcal_lag_get(&lag, &result);
}

static jcal_functional_t functional;

static bool begin_functional(void)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    return jcal_functional_init(&functional, &config) == JCAL_OK;
}

static void go_functional(unsigned k)
{
    jcal_functional_result_t result;
    if (has_tick[k]) {
        (void)jcal_functional_add(&functional, &ticks[0][k], &ticks[1][k]);
    }
    (void)jcal_functional_step(&functional);
    (void)jcal_functional_get(&functional, &result);
    read_words(&result.head);
}

static jcal_ball_t ball;

static bool begin_ball(void)
{
    const jcal_ball_config_t config = jcal_ball_config_default();
    return jcal_ball_init(&ball, &config) == JCAL_OK;
}

static void go_ball(unsigned k)
{
    jcal_ball_result_t result;
    if (has_tick[k]) {
        (void)jcal_ball_add(&ball, &ticks[0][k], &ticks[1][k]);
    }
    (void)jcal_ball_step(&ball);
    (void)jcal_ball_get(&ball, &result);
    read_words(&result.head);
}

static jcal_two_axes_t two_axes;

static bool begin_two_axes(void)
{
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    return jcal_two_axes_init(&two_axes, &config) == JCAL_OK;
}

static void go_two_axes(unsigned k)
{
    jcal_two_axes_result_t result;
    if (has_tick[k]) {
        (void)jcal_two_axes_add(&two_axes, &ticks[0][k], &ticks[1][k]);
    }
    (void)jcal_two_axes_step(&two_axes);
    (void)jcal_two_axes_get(&two_axes, &result);
    read_words(&result.ball.head);
}

static jcal_hinge_t hinge;

static bool begin_hinge(void)
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    return jcal_hinge_init(&hinge, &config) == JCAL_OK;
}

static void go_hinge(unsigned k)
{
    jcal_hinge_result_t result;
    const jcal_pair_t pair = pair_at(k);
    (void)jcal_hinge_update(&hinge, &pair);
    (void)jcal_hinge_get(&hinge, &result);
    read_words(&result.head);
}

static jcal_hinge_auto_t hinge_auto;

static bool begin_hinge_auto(void)
{
    const jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    return jcal_hinge_auto_init(&hinge_auto, &config) == JCAL_OK;
}

static void go_hinge_auto(unsigned k)
{
    jcal_hinge_auto_result_t result;
    const jcal_pair_t pair = pair_at(k);
    (void)jcal_hinge_auto_update(&hinge_auto, &pair);
    (void)jcal_hinge_auto_get(&hinge_auto, &result);
    read_words(&result.hinge.head);
}

static jcal_remember_t remember;

static jcal_kept_t kept_of_motion(void)
{
    jcal_kept_t kept;
    memset(&kept, 0, sizeof kept);
    kept.kind = JCAL_KEPT_HINGE;
    kept.model = JCAL_MODEL_FUNCTIONAL;
    kept.heading = JCAL_KEPT_HEADING_BY_CENTER;
    kept.serial1 = 1u;
    kept.serial2 = 2u;
    kept.axis1 = hinge_axis(&motion, 1, 0.0);
    kept.axis2 = hinge_axis(&motion, 2, 0.0);
    kept.bound1_rad = kept.bound2_rad = 0.1f;
    kept.has_levers = true;
    kept.lever1_m = to_vec3(motion.r1);
    kept.lever2_m = to_vec3(motion.r2);
    kept.bound_lever1_m = kept.bound_lever2_m = JCAL_BOUND_UNKNOWN_M;
    return kept;
}

static bool begin_remember(void)
{
    const jcal_kept_t kept = kept_of_motion();
    return jcal_remember_init(&remember, &kept, JCAL_KEPT_FITS) == JCAL_OK;
}

static void go_remember(unsigned k)
{
    jcal_remember_result_t result;
    if (has_tick[k]) {
        (void)jcal_remember_add(&remember, &ticks[0][k], &ticks[1][k]);
    }
    (void)jcal_remember_step(&remember);
    (void)jcal_remember_get(&remember, &result);
    (void)jcal_remember_state_string(result.state);
    (void)jcal_remember_reason_string(result.reason);
}

/* A flash that refuses what is in no slot, as ports do. */
#define FLASH_JOINTS 15u
#define FLASH_SLOT JCAL_KEEP_IMAGE_BYTES(31u)
static uint8_t flash_memory[2][FLASH_SLOT];

static bool is_in_slot(unsigned slot, uint32_t offset, uint32_t n)
{
    return (slot < 2u) && (offset <= FLASH_SLOT) && (n <= FLASH_SLOT - offset);
}

static bool flash_erase(void *context, unsigned slot)
{
    (void)context;
    if (slot < 2u) {
        memset(flash_memory[slot], 0xFF, FLASH_SLOT);
    }
    return slot < 2u;
}

static bool flash_program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    for (uint32_t i = 0; is_in_slot(slot, offset, n) && (i < n); i++) {
        flash_memory[slot][offset + i] &= bytes[i];
    }
    return is_in_slot(slot, offset, n);
}

static bool flash_read(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n)
{
    (void)context;
    if (is_in_slot(slot, offset, n)) {
        memcpy(bytes, &flash_memory[slot][offset], n);
    }
    return is_in_slot(slot, offset, n);
}

static const jcal_flash_t FLASH = {NULL, FLASH_SLOT, 4u, flash_erase, flash_program, flash_read};
static struct {
    jcal_keep_writer_t writer;
    jcal_keep_schedule_t schedule;
} keeper;

static bool begin_keep(void)
{
    memset(&keeper, 0, sizeof keeper);
    memset(flash_memory, 0xFF, sizeof flash_memory);
    jcal_keep_schedule_init(&keeper.schedule);
    return jcal_keep_begin(&keeper.writer, &FLASH, FLASH_JOINTS) == JCAL_OK;
}

/* A write is begun every twenty samples; in between records are put, and at last it is committed. */
static void go_keep(unsigned k)
{
    jcal_kept_t kept = kept_of_motion();
    kept.joint = (uint8_t)(k % 31u);
    if ((k % 20u) == 0u) {
        (void)jcal_keep_begin(&keeper.writer, &FLASH, FLASH_JOINTS);
    } else if ((k % 20u) == 19u) {
        (void)!jcal_keep_commit(&keeper.writer);
    } else if ((k % 20u) == 18u) {
        (void)jcal_keep_drop(&keeper.writer, kept.joint);
    } else if ((k % 5u) == 1u) {
        (void)jcal_keep_put(&keeper.writer, &kept);
    }
    if (jcal_keep_due(&keeper.schedule, (uint64_t)k * 1000000u, true)) {
        jcal_keep_written(&keeper.schedule, (uint64_t)k * 1000000u);
    }
}

static struct {
    jcal_pairing_t pairing;
} two;

static bool begin_pairing(void)
{
    const jcal_pairing_config_t config = jcal_pairing_config_default();
    return jcal_pairing_init(&two.pairing, &config) == JCAL_OK;
}

static void go_pairing(unsigned k)
{
    jcal_pair_t pair;
    jcal_pairing_result_t result;
    (void)jcal_pairing_push(&two.pairing, 1u, &readings[0][k]);
    (void)jcal_pairing_push(&two.pairing, 2u, &readings[1][k]);
    for (unsigned n = 0; (n < 100u) && (jcal_pairing_pull(&two.pairing, &pair) != JCAL_IDLE); n++) {
    }
    (void)jcal_pairing_get(&two.pairing, &result);
}

/* Four sensors, and a joint of each kind. */
#define BODY_SENSORS 4u
#define BODY_JOINTS 3u
static struct {
    jcal_body_t body;
    jcal_body_sensor_t sensors[BODY_SENSORS];
    jcal_body_joint_t joints[BODY_JOINTS];
    jcal_ball_t hip;
    jcal_functional_t knee;
    jcal_two_axes_t foot;
    jcal_body_shared_t shared;
    jcal_health_t health;
    unsigned char storage[BODY_SENSORS][JCAL_PACKETS_STORAGE_BYTES(SLOTS, 4u, JCAL_PACKET_SI)];
} whole;
static jcal_packet_config_t body_packets;
static jcal_body_sensor_spec_t body_sensors[BODY_SENSORS];
static const jcal_body_joint_spec_t BODY_JOINT_SPECS[BODY_JOINTS] = {
    {"hip", 0u, 1u, JCAL_BODY_BALL, {.ball = &whole.hip}},
    {"knee", 1u, 2u, JCAL_BODY_HINGE, {.hinge = &whole.knee}},
    {"foot", 2u, 3u, JCAL_BODY_TWO_AXES, {.two_axes = &whole.foot}}};

static bool begin_body(void)
{
    const jcal_ball_config_t ball_config = jcal_ball_config_default();
    const jcal_functional_config_t hinge_config = jcal_functional_config_default();
    const jcal_two_axes_config_t axes_config = jcal_two_axes_config_default();
    const jcal_body_config_t config = jcal_body_config_default();
    body_packets = jcal_packet_config_default();
    memset(flash_memory, 0xFF, sizeof flash_memory);
    body_packets.packets = SLOTS;
    body_packets.per_packet = 4u;
    for (unsigned s = 0; s < BODY_SENSORS; s++) {
        const jcal_body_sensor_spec_t spec = {"sensor", &body_packets, whole.storage[s], sizeof whole.storage[s],
                                              s + 1u};
        body_sensors[s] = spec;
    }
    const jcal_body_table_t table = {body_sensors,     whole.sensors, BODY_SENSORS,
                                     BODY_JOINT_SPECS, whole.joints,  BODY_JOINTS,
                                     &whole.shared,    &whole.health, &FLASH};
    return (jcal_ball_init(&whole.hip, &ball_config) == JCAL_OK) &&
           (jcal_functional_init(&whole.knee, &hinge_config) == JCAL_OK) &&
           (jcal_two_axes_init(&whole.foot, &axes_config) == JCAL_OK) &&
           (jcal_body_init(&whole.body, &table, &config) == JCAL_OK);
}

static void look_at_body(void)
{
    jcal_body_event_t event;
    jcal_body_joint_result_t joint;
    jcal_body_sensor_result_t of;
    jcal_body_status_t status;
    jcal_body_advice_t advice;
    char text[200];
    for (unsigned n = 0; (n < 300u) && (jcal_body_event(&whole.body, &event) == JCAL_OK); n++) {
        (void)jcal_body_event_string((jcal_body_event_kind_t)event.kind);
    }
    for (unsigned j = 0; j < BODY_JOINTS; j++) {
        (void)jcal_body_joint(&whole.body, j, &joint);
        read_words(&joint.head);
    }
    for (unsigned s = 0; s < BODY_SENSORS; s++) {
        (void)jcal_body_sensor(&whole.body, s, &of);
    }
    (void)jcal_body_status(&whole.body, &status);
    if (jcal_body_advice(&whole.body, &advice) == JCAL_OK) {
        (void)jcal_body_sentence(&whole.body, &advice, text, sizeof text);
    }
}

static void go_body(unsigned k)
{
    const uint64_t now_us = readings[0][k].t_us + 5000u;
    for (unsigned s = 0; s < BODY_SENSORS; s++) {
        float si[6];
        fill_si(si, &readings[s % 2u][k].imu);
        const jcal_packet_t packet = {now_us, k, 1u, NULL, si};
        (void)jcal_body_push(&whole.body, s, &packet);
    }
    (void)jcal_body_step(&whole.body, now_us, 40u);
    if (jcal_body_keep_due(&whole.body)) {
        (void)jcal_body_keep(&whole.body);
    }
    if ((k % 10u) == 0u) {
        look_at_body();
    }
}

/* What the caller handed over: storage, and how many packets of how many readings it holds. */
#define PACKET_HOLES(base)                                                                                             \
    {(base) + offsetof(jcal_packets_t, cfg), sizeof(jcal_packet_config_t)},                                            \
    {                                                                                                                  \
        (base) + offsetof(jcal_packets_t, storage), sizeof(unsigned char *)                                            \
    }
#define BODY_SENSOR(s) (offsetof(__typeof__(whole), sensors) + (s) * sizeof(jcal_body_sensor_t))
#define STATE(of) &(of), sizeof(of)

static const subject_t SUBJECTS[] = {
    {"sensor", STATE(sensor), begin_sensor, go_sensor, {{0}}},
    {"packets", STATE(wire), begin_packets, go_packets, {PACKET_HOLES(0)}},
    {"pairing", STATE(two), begin_pairing, go_pairing, {{0}}},
    {"lag", STATE(lag), begin_lag, go_lag, {{0}}},
    {"health", STATE(health), begin_health, go_health, {{0}}},
    {"functional", STATE(functional), begin_functional, go_functional, {{0}}},
    {"ball", STATE(ball), begin_ball, go_ball, {{0}}},
    {"two_axes", STATE(two_axes), begin_two_axes, go_two_axes, {{0}}},
    {"hinge", STATE(hinge), begin_hinge, go_hinge, {{0}}},
    {"hinge_auto", STATE(hinge_auto), begin_hinge_auto, go_hinge_auto, {{0}}},
    {"remember", STATE(remember), begin_remember, go_remember, {{0}}},
    {"keep", STATE(keeper), begin_keep, go_keep, {{offsetof(jcal_keep_writer_t, flash), sizeof(void *)}}},
    {"body",
     STATE(whole),
     begin_body,
     go_body,
     {{offsetof(jcal_body_t, table), sizeof(jcal_body_table_t)},
      PACKET_HOLES(BODY_SENSOR(0)),
      PACKET_HOLES(BODY_SENSOR(1)),
      PACKET_HOLES(BODY_SENSOR(2)),
      PACKET_HOLES(BODY_SENSOR(3))}}};
enum { SUBJECT_COUNT = sizeof SUBJECTS / sizeof SUBJECTS[0] };

/* ---- corruptions */

static uint64_t chance(uint64_t *state)
{
    *state += UINT64_C(0x9E3779B97F4A7C15);
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

static bool is_hole(const subject_t *subject, size_t at)
{
    for (unsigned h = 0; h < HOLES; h++) {
        if ((at >= subject->holes[h].at) && (at < subject->holes[h].at + subject->holes[h].bytes)) {
            return true;
        }
    }
    return false;
}

/* A bit, a byte, or a word: by chance, all zeros, all ones, NaN, infinities, the largest and smallest numbers. */
static void corrupt_once(const subject_t *subject, uint64_t *seed)
{
    static const uint32_t WORDS[] = {0u,          UINT32_MAX,  0x7FC00000u, 0x7F800000u, 0xFF800000u,
                                     0x7F7FFFFFu, 0x00000001u, 0x80000000u, 0x7FFFFFFFu, 0xBF800000u};
    unsigned char *const bytes = subject->state;
    size_t at = (size_t)(chance(seed) % subject->bytes);
    const uint64_t kind = chance(seed) % 4u;
    if (kind == 0u) {
        if (!is_hole(subject, at)) {
            bytes[at] ^= (unsigned char)(1u << (chance(seed) % 8u));
        }
        return;
    }
    uint32_t word = (uint32_t)chance(seed);
    if (kind == 3u) {
        word = WORDS[chance(seed) % (sizeof WORDS / sizeof WORDS[0])];
    }
    at = (kind == 1u) ? at : (at & ~(size_t)3u);
    for (size_t i = at; (i < at + ((kind == 1u) ? 1u : 4u)) && (i < subject->bytes); i++) {
        if (!is_hole(subject, i)) {
            bytes[i] = (unsigned char)(word >> (8u * (i - at)));
        }
    }
}

static unsigned char *taken[AGES];

static bool take_ages(const subject_t *subject)
{
    if (!subject->begin()) {
        return false;
    }
    unsigned age = 0;
    for (unsigned k = 0; age < AGES; k++) {
        if (k == AGE[age]) {
            taken[age] = malloc(subject->bytes);
            if (taken[age] == NULL) {
                return false;
            }
            memcpy(taken[age], subject->state, subject->bytes);
            age++;
        }
        subject->go(k);
    }
    return true;
}

/* Of this process, not of the clock: others may be using the processor. */
static void limit_time(int seconds)
{
    const struct itimerval limit = {{0, 0}, {seconds, 0}};
    (void)setitimer(ITIMER_VIRTUAL, &limit, NULL);
}

static void try_one(const subject_t *subject, unsigned long number)
{
    uint64_t seed = number * UINT64_C(0x100000001B3) + subject->bytes;
    const unsigned age = (unsigned)(chance(&seed) % AGES);
    memcpy(subject->state, taken[age], subject->bytes);
    limit_time(MOST_SECONDS);
    for (uint64_t times = 1u + chance(&seed) % 3u; times > 0u; times--) {
        corrupt_once(subject, &seed);
    }
    for (unsigned k = AGE[age]; k < AGE[age] + RUN_ON; k++) {
        subject->go(k);
    }
    limit_time(0);
}

/* In processes of their own: one that ends early is a corruption that broke something, and the next one goes on behind it. */
static unsigned try_all(const subject_t *subject, unsigned long count, volatile unsigned long *at)
{
    unsigned broken = 0;
    *at = 0;
    while (*at < count) {
        (void)fflush(stdout);
        const pid_t child = fork();
        if (child == 0) {
            for (; *at < count; ++*at) {
                try_one(subject, *at);
            }
            _exit(EXIT_SUCCESS);
        }
        int status = 0;
        if ((child < 0) || (waitpid(child, &status, 0) != child)) {
            exit(EXIT_FAILURE);
        }
        if (status != 0) {
            (void)fprintf(stderr, "BROKEN: corrupt --one %s %lu (%s)\n", subject->name, *at,
                          WIFSIGNALED(status) ? ((WTERMSIG(status) == SIGVTALRM) ? "hangs" : "signal") : "sanitizer");
            broken++;
            ++*at;
        }
    }
    return broken;
}

static bool is_wanted(const char *name, int argc, char **argv)
{
    bool wanted = argc <= 2;
    for (int k = 2; k < argc; k++) {
        wanted = wanted || (strcmp(argv[k], name) == 0);
    }
    return wanted;
}

int main(int argc, char **argv)
{
    volatile unsigned long *const at =
        mmap(NULL, sizeof(unsigned long), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    const bool is_one = (argc == 4) && (strcmp(argv[1], "--one") == 0);
    const unsigned long count = (argc > 1) ? strtoul(argv[is_one ? 3 : 1], NULL, 10) : 0u;
    if ((at == MAP_FAILED) || ((count == 0u) && !is_one)) {
        (void)fputs("usage: corrupt COUNT [NAME...] | --one NAME NUMBER\n", stderr);
        return EXIT_FAILURE;
    }
    make_motion();
    unsigned broken = 0;
    for (unsigned s = 0; s < SUBJECT_COUNT; s++) {
        const subject_t *const subject = &SUBJECTS[s];
        if (!is_wanted(subject->name, argc, argv)) {
            continue;
        }
        if (!take_ages(subject)) {
            (void)fprintf(stderr, "%s: not prepared\n", subject->name);
            return EXIT_FAILURE;
        }
        if (is_one) {
            try_one(subject, count);
            continue;
        }
        const unsigned of = try_all(subject, count, at);
        (void)printf("| %s | %lu | %lu | %u |\n", subject->name, (unsigned long)subject->bytes, count, of);
        broken += of;
        for (unsigned age = 0; age < AGES; age++) {
            free(taken[age]);
        }
    }
    return (broken == 0u) ? EXIT_SUCCESS : EXIT_FAILURE;
}
