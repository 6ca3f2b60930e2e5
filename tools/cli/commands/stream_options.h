/* SPDX-License-Identifier: MIT */
/// @file
/// Options of `jointcal stream` for a whole body: joints, names, radios.
#ifndef JCAL_CLI_COMMANDS_STREAM_OPTIONS_H
#define JCAL_CLI_COMMANDS_STREAM_OPTIONS_H

#include "options/common.h"
#include "output/body_report.h"
#include "run/body_files.h"

/// Keys of these options; stream.c has those before them.
enum {
    STREAM_KEY_JOINT = OPTION_OWN + 100,
    STREAM_KEY_NAMES,
    STREAM_KEY_SERIALS,
    STREAM_KEY_KEEP,
    STREAM_KEY_ANGLES_EVERY,
    STREAM_KEY_PUT_KEPT,
    STREAM_KEY_GET_KEPT,
    STREAM_KEY_PER_PACKET,
    STREAM_KEY_CLOCK_PPM,
    STREAM_KEY_DELAY_MS,
    STREAM_KEY_JITTER_MS,
    STREAM_KEY_LOSS,
    STREAM_KEY_BURST,
    STREAM_KEY_SEED,
    STREAM_KEY_GYR_RANGE,
    STREAM_KEY_ACC_RANGE
};

/// One value for all sensors, or one for each.
typedef struct {
    float values[BODY_FILES_MAX];
    size_t count;
} per_sensor_t;

/// A joint as it was given.
typedef struct {
    body_name_t name;
    uint8_t kind;        ///< jcal_body_kind_t.
    body_name_t ends[2]; /* proximal, distal: a number from 1, or a name */
} joint_option_t;

typedef struct {
    const char *files[BODY_FILES_MAX];
    unsigned file_count;
    joint_option_t joints[BODY_REPORT_MAX];
    unsigned joint_count;
    body_name_t names[BODY_FILES_MAX];
    size_t name_count;
    uint64_t serials[BODY_FILES_MAX];
    size_t serial_count;
    unsigned per_packet;
    per_sensor_t clock_ppm, delay_ms, jitter_ms, loss_percent, burst_s;
    float gyr_range_deg_s, acc_range_g;
    uint64_t seed;
    int64_t angles_every_us;
    bool keep;
    const char *put_kept, *get_kept;
    const char *given;  ///< The first of these options that was given, for messages; null if none was.
} stream_body_options_t;

/// The rows of an argp table; argp_option has no way to join two.
#define STREAM_BODY_OPTIONS                                                                                                                                         \
    {"joint",                                                                                                                                                       \
     STREAM_KEY_JOINT,                                                                                                                                              \
     "NAME:KIND:PROXIMAL:DISTAL",                                                                                                                                   \
     0,                                                                                                                                                             \
     "A joint of a whole body, once for each: its name, hinge, ball or two-axes, and its two sensors, the one nearer to the trunk first, by number from 1 or name", \
     1},                                                                                                                                                            \
        {"names",                                                                                                                                                   \
         STREAM_KEY_NAMES,                                                                                                                                          \
         "NAME,...",                                                                                                                                                \
         0,                                                                                                                                                         \
         "What the sensors are called (default: as the files, or sensor1 ...)",                                                                                     \
         1},                                                                                                                                                        \
        {"serials", STREAM_KEY_SERIALS, "N,...", 0, "Their serial numbers (default 1, 2 ...)", 1},                                                                  \
        {"keep",                                                                                                                                                    \
         STREAM_KEY_KEEP,                                                                                                                                           \
         NULL,                                                                                                                                                      \
         0,                                                                                                                                                         \
         "The hub uses what it kept of these sensors and joints, and keeps what it finds",                                                                          \
         1},                                                                                                                                                        \
        {"angles-every", STREAM_KEY_ANGLES_EVERY, "S", 0, "Angles every S seconds", 1},                                                                             \
        {"put-kept",                                                                                                                                                \
         STREAM_KEY_PUT_KEPT,                                                                                                                                       \
         "FILE",                                                                                                                                                    \
         0,                                                                                                                                                         \
         "Have the hub keep the records of FILE first; they count from the next session on",                                                                        \
         1},                                                                                                                                                        \
        {"get-kept", STREAM_KEY_GET_KEPT, "FILE", 0, "At the end write the records that the hub keeps to FILE", 1},                                                 \
        {"per-packet", STREAM_KEY_PER_PACKET, "N", 0, "Readings of a packet, 1 to 16 (default 4)", 2},                                                              \
        {"clock-ppm",                                                                                                                                               \
         STREAM_KEY_CLOCK_PPM,                                                                                                                                      \
         "PPM,...",                                                                                                                                                 \
         0,                                                                                                                                                         \
         "Clocks are slow by so much, for each sensor or one for all (default 0)",                                                                                  \
         2},                                                                                                                                                        \
        {"delay-ms", STREAM_KEY_DELAY_MS, "MS,...", 0, "Packets are under way for so long (default 5)", 2},                                                         \
        {"jitter-ms", STREAM_KEY_JITTER_MS, "MS,...", 0, "... and at random for up to so much longer (default 2)", 2},                                              \
        {"loss", STREAM_KEY_LOSS, "PERCENT,...", 0, "So many packets of a hundred get lost (default 0)", 2},                                                        \
        {"burst",                                                                                                                                                   \
         STREAM_KEY_BURST,                                                                                                                                          \
         "S,...",                                                                                                                                                   \
         0,                                                                                                                                                         \
         "Once in 30 seconds a sensor is not heard for S seconds (default 0: never)",                                                                               \
         2},                                                                                                                                                        \
        {"seed", STREAM_KEY_SEED, "N", 0, "Other random numbers (default 1)", 2},                                                                                   \
        {"gyr-range", STREAM_KEY_GYR_RANGE, "DEG_S", 0, "Range of the gyroscopes' 16 bits (default 2000)", 2},                                                      \
    {                                                                                                                                                               \
        "acc-range", STREAM_KEY_ACC_RANGE, "G", 0, "Range of the accelerometers' 16 bits (default 16)", 2                                                           \
    }

/// What holds if nothing is given.
void stream_body_defaults(stream_body_options_t *options);

/// Takes one of these options, or ARGP_ERR_UNKNOWN.
error_t stream_body_parse(int key, char *argument, struct argp_state *state, stream_body_options_t *options);

/// Judges what goes together, once all options and files are known.
void stream_body_settle(struct argp_state *state, const common_options_t *common, const stream_body_options_t *options);

/// The value for a sensor.
float per_sensor(const per_sensor_t *values, unsigned sensor);

#endif
