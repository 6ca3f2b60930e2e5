/* SPDX-License-Identifier: MIT */
/* Options of `jointcal stream` for a whole body. */
#include "commands/stream_options.h"

#include "options/values.h"

#include "jointcal/body_config.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define NAME_HELP "1 to 16 letters, digits, - and _"

void stream_body_defaults(stream_body_options_t *options)
{
    memset(options, 0, sizeof *options);
    options->per_packet = 4;
    options->clock_ppm = (per_sensor_t){{0.0f}, 1};
    options->delay_ms = (per_sensor_t){{5.0f}, 1};
    options->jitter_ms = (per_sensor_t){{2.0f}, 1};
    options->loss_percent = (per_sensor_t){{0.0f}, 1};
    options->burst_s = (per_sensor_t){{0.0f}, 1};
    options->gyr_range_deg_s = 2000.0f;
    options->acc_range_g = 16.0f;
    options->seed = 1;
}

float per_sensor(const per_sensor_t *values, unsigned sensor)
{
    return values->values[(values->count == 1) ? 0 : sensor];
}

/* ---- Pieces ---- */

/* Copies what stands before `end`; false if that is no name. Plain characters only: names stand in JSON as they are. */
static bool take_name(const char *text, const char *end, body_name_t name)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    const size_t length = (size_t)(end - text);
    if (length == 0 || length > MESSAGE_NAME_BYTES || strspn(text, letters) < length) {
        return false;
    }
    memcpy(name, text, length);
    name[length] = '\0';
    return true;
}

/* Where the next part of a list begins; the end of `text` if there is none. */
static const char *part_end(const char *text, char separator)
{
    const char *end = strchr(text, separator);
    return (end != NULL) ? end : text + strlen(text);
}

static void take_names(struct argp_state *state, const char *text, stream_body_options_t *options)
{
    size_t count = 0;
    for (const char *at = text;; at++) {
        const char *end = part_end(at, ',');
        if (count == BODY_FILES_MAX || !take_name(at, end, options->names[count])) {
            argp_error(state, "--names: '%.*s' is no name: %s", (int)(end - at), at, NAME_HELP);
        }
        for (size_t k = 0; k < count; k++) {
            if (strcmp(options->names[k], options->names[count]) == 0) {
                argp_error(state, "--names: '%s' stands there twice", options->names[k]);
            }
        }
        count++;
        if (*end == '\0') {
            break;
        }
        at = end;
    }
    options->name_count = count;
}

/* A whole number that ends at a comma or the end. */
static bool take_whole(const char *text, char **end, uint64_t *value)
{
    errno = 0;
    *value = strtoull(text, end, 10);
    return *text >= '0' && *text <= '9' && errno == 0 && (**end == ',' || **end == '\0');
}

static void take_serials(struct argp_state *state, const char *text, stream_body_options_t *options)
{
    size_t count = 0;
    const char *at = text;
    for (char *end = NULL;; at = end + 1) {
        if (count == BODY_FILES_MAX || !take_whole(at, &end, &options->serials[count])) {
            argp_error(state, "--serials: '%s' is no list of whole numbers", text);
        }
        count++;
        if (*end == '\0') {
            break;
        }
    }
    options->serial_count = count;
}

static void take_joint(struct argp_state *state, const char *text, stream_body_options_t *options)
{
    static const char *const kinds[] = {"hinge", "ball", "two-axes"};
    if (options->joint_count == JCAL_BODY_JOINTS_MAX) {
        argp_error(state, "--joint: a body has %u joints at the most", JCAL_BODY_JOINTS_MAX);
    }
    joint_option_t *joint = &options->joints[options->joint_count];
    body_name_t kind;
    char *const parts[] = {joint->name, kind, joint->ends[0], joint->ends[1]};
    const char *at = text;
    for (size_t k = 0; k < 4; k++) {
        const char *end = part_end(at, ':');
        if (!take_name(at, end, parts[k]) || (*end == '\0') != (k == 3)) {
            argp_error(
                state,
                "--joint: '%s' is not NAME:KIND:PROXIMAL:DISTAL, such as knee:hinge:2:3; a name has 1 to %u letters, "
                "digits, '-' and '_'",
                text, MESSAGE_NAME_BYTES);
        }
        at = (*end == '\0') ? end : end + 1;
    }
    joint->kind = (uint8_t)option_one_of_three(state, "joint", kind, kinds);
    if (strcmp(joint->ends[0], joint->ends[1]) == 0) {
        argp_error(state, "--joint: '%s' is between two sensors, and '%s' is one", joint->name, joint->ends[0]);
    }
    for (unsigned k = 0; k < options->joint_count; k++) {
        if (strcmp(options->joints[k].name, joint->name) == 0) {
            argp_error(state, "--joint: there are two joints '%s'", joint->name);
        }
    }
    options->joint_count++;
}

static void take_numbers(struct argp_state *state, const char *option, const char *text, per_sensor_t *values)
{
    values->count = option_numbers(text, values->values, BODY_FILES_MAX);
    if (values->count == 0) {
        argp_error(state, "--%s: '%s' is no list of numbers, one or one for each sensor", option, text);
    }
}

static void take_range(struct argp_state *state, const char *option, const char *text, per_sensor_t *values, float most)
{
    take_numbers(state, option, text, values);
    for (size_t k = 0; k < values->count; k++) {
        const float value = values->values[k];
        const float least = (strcmp(option, "clock-ppm") != 0) ? 0.0f : -most;
        if (!(value >= least && value <= most)) {
            argp_error(state, "--%s: %g is not from %g to %g", option, (double)value, (double)least, (double)most);
        }
    }
}

/* ---- The options ---- */

static unsigned take_per_packet(struct argp_state *state, const char *text)
{
    char *end = NULL;
    uint64_t value = 0;
    if (!take_whole(text, &end, &value) || *end != '\0' || value < 1 || value > RADIO_PER_PACKET_MAX) {
        argp_error(state, "--per-packet: '%s' is not a whole number from 1 to %d", text, RADIO_PER_PACKET_MAX);
    }
    return (unsigned)value;
}

static uint64_t take_seed(struct argp_state *state, const char *text)
{
    char *end = NULL;
    uint64_t value = 0;
    if (!take_whole(text, &end, &value) || *end != '\0') {
        argp_error(state, "--seed: '%s' is not a whole number of at least 0", text);
    }
    return value;
}

/* How the radios are. */
static error_t parse_radio(int key, const char *argument, struct argp_state *state, stream_body_options_t *options)
{
    switch (key) {
    case STREAM_KEY_PER_PACKET:
        options->per_packet = take_per_packet(state, argument);
        return 0;
    case STREAM_KEY_CLOCK_PPM:
        take_range(state, "clock-ppm", argument, &options->clock_ppm, 1000.0f);
        return 0;
    case STREAM_KEY_DELAY_MS:
        take_range(state, "delay-ms", argument, &options->delay_ms, 1000.0f);
        return 0;
    case STREAM_KEY_JITTER_MS:
        take_range(state, "jitter-ms", argument, &options->jitter_ms, 1000.0f);
        return 0;
    case STREAM_KEY_LOSS:
        take_range(state, "loss", argument, &options->loss_percent, 100.0f);
        return 0;
    case STREAM_KEY_BURST:
        take_range(state, "burst", argument, &options->burst_s, 600.0f);
        return 0;
    case STREAM_KEY_SEED:
        options->seed = take_seed(state, argument);
        return 0;
    case STREAM_KEY_GYR_RANGE:
        options->gyr_range_deg_s = option_positive(state, "gyr-range", argument);
        return 0;
    case STREAM_KEY_ACC_RANGE:
        options->acc_range_g = option_positive(state, "acc-range", argument);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_body(int key, const char *argument, struct argp_state *state, stream_body_options_t *options)
{
    switch (key) {
    case STREAM_KEY_JOINT:
        take_joint(state, argument, options);
        return 0;
    case STREAM_KEY_NAMES:
        take_names(state, argument, options);
        return 0;
    case STREAM_KEY_SERIALS:
        take_serials(state, argument, options);
        return 0;
    case STREAM_KEY_KEEP:
        options->keep = true;
        return 0;
    case STREAM_KEY_ANGLES_EVERY:
        options->angles_every_us = option_duration(state, "angles-every", argument);
        return 0;
    case STREAM_KEY_PUT_KEPT:
        options->put_kept = argument;
        return 0;
    case STREAM_KEY_GET_KEPT:
        options->get_kept = argument;
        return 0;
    default:
        return parse_radio(key, argument, state, options);
    }
}

error_t stream_body_parse(int key, char *argument, struct argp_state *state, stream_body_options_t *options)
{
    static const struct argp_option table[] = {STREAM_BODY_OPTIONS};
    const error_t status = parse_body(key, argument, state, options);
    if (status == 0 && options->given == NULL) {
        options->given = table[key - STREAM_KEY_JOINT].name;
    }
    return status;
}

void stream_body_settle(struct argp_state *state, const common_options_t *common, const stream_body_options_t *options)
{
    const bool has_joints = options->joint_count > 0;
    if (!has_joints && options->file_count > 1) {
        argp_error(
            state,
            "several files are a body's: which joints has it? Say for each --joint NAME:KIND:PROXIMAL:DISTAL, such as "
            "knee:hinge:2:3");
    }
    if (!has_joints && options->given != NULL) {
        argp_error(state, "--%s is for a whole body, whose joints are given by --joint", options->given);
    }
    if (has_joints && common->sign_hint != JCAL_SIGN_UNKNOWN) {
        argp_error(state, "--sign-hint is for one hinge, without --joint");
    }
    for (unsigned k = 1; k < options->file_count; k++) {
        for (unsigned other = 0; other < k; other++) {
            if (strcmp(options->files[k], "-") == 0 && strcmp(options->files[other], "-") == 0) {
                argp_error(state, "two files, and - is standard input, which is one");
            }
        }
    }
}
