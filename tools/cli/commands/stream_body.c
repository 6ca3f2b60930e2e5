/* SPDX-License-Identifier: MIT */
/* `jointcal stream` with a whole body: tables and packets to a hub, its events, states and angles out. */
#include "commands/stream_body.h"

#include "jointcal/body.h"
#include "jointcal/jointcal.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The hub's time of the first row. */
#define ORIGIN_US ((uint64_t)1 << 40)

#define GRAVITY_M_S2 9.80665f
#define RAD_PER_DEGREE 0.017453292519943295f
/* 16 bits with a sign: the range is one step beyond the largest value. */
#define STEPS 32768.0f
#define RAIL 32767

/* What a sensor's clock may be off by: twice what is played, and crystals of 100 ppm. */
#define DRIFT_PPM 200.0f

/* Everything of one run. */
typedef struct {
    const common_options_t *common;
    const stream_options_t *options;
    body_files_t files;
    hub_session_t hub;
    progress_t progress;
    body_report_t report;
    uint8_t ends[BODY_REPORT_MAX][2]; /* sensors of the joints */
    int64_t began_us;                 /* by the clock, when the first packet was due */

    message_table_t table;
    bool has_table;
    message_kept_t kept;
    bool has_kept;
    /* Answers to the last question. */
    uint32_t asked;
    bool answering;  /* states that come are of an answer, to this question or an earlier one */
    uint64_t now_us; /* of the last body state */
    message_body_state_t body;
    bool has_body;
    message_joint_state_t joints[BODY_REPORT_MAX];
    message_sensor_state_t sensors[BODY_FILES_MAX];
    bool has_joint[BODY_REPORT_MAX], has_sensor[BODY_FILES_MAX];
} run_t;

/* ---- What comes ---- */

static void take_body_state(run_t *run, const message_body_state_t *state)
{
    run->now_us = state->status.t_us;
    run->answering = state->token != 0u;
    if (!run->answering) {
        body_report_body(&run->report, state);
    } else if (state->token == run->hub.token) {
        /* The first of an answer. */
        memset(run->has_joint, 0, sizeof run->has_joint);
        memset(run->has_sensor, 0, sizeof run->has_sensor);
        run->body = *state;
        run->asked = state->token;
        run->has_body = true;
    }
}

static void take_joint_state(run_t *run, const message_joint_state_t *state)
{
    if (state->token == 0u) {
        body_report_joint(&run->report, run->now_us, state);
    } else if (state->token == run->asked && state->joint < run->report.joint_count) {
        run->joints[state->joint] = *state;
        run->has_joint[state->joint] = true;
    }
}

static void take_sensor_state(run_t *run, const message_sensor_state_t *state)
{
    if (state->token == 0u) {
        body_report_sensor(&run->report, run->now_us, state);
    } else if (state->token == run->asked && state->sensor < run->report.sensor_count) {
        run->sensors[state->sensor] = *state;
        run->has_sensor[state->sensor] = true;
    }
}

/* Advice has no token: it belongs to the states before it. */
static void take_advice(run_t *run, const frame_t *frame)
{
    message_advice_t advice;
    if (!run->answering && message_read_advice(frame, &advice)) {
        body_report_advice(&run->report, run->now_us, &advice);
    }
}

static void take_state(run_t *run, const frame_t *frame)
{
    message_joint_state_t joint;
    message_sensor_state_t sensor;
    message_body_state_t body;
    if (frame->type == FRAME_BODY_STATE && message_read_body_state(frame, &body)) {
        take_body_state(run, &body);
    } else if (frame->type == FRAME_JOINT_STATE && message_read_joint_state(frame, &joint)) {
        take_joint_state(run, &joint);
    } else if (frame->type == FRAME_SENSOR_STATE && message_read_sensor_state(frame, &sensor)) {
        take_sensor_state(run, &sensor);
    } else if (frame->type == FRAME_ADVICE) {
        take_advice(run, frame);
    }
}

/* A hub_other_t. */
static void on_frame(void *context, const frame_t *frame)
{
    run_t *run = context;
    jcal_body_event_t event;
    message_flexions_t flexions;
    message_orientations_t orientations;
    progress_clear(&run->progress);
    if (frame->type == FRAME_ORIENTATIONS) {
        if (message_read_orientations(frame, &orientations)) {
            body_report_orientations(&run->report, &orientations);
        }
        return;
    }
    body_report_flush(&run->report);
    switch (frame->type) {
    case FRAME_TABLE:
        run->has_table = message_read_table(frame, &run->table) || run->has_table;
        return;
    case FRAME_KEPT:
        run->has_kept = message_read_kept(frame, &run->kept) && run->kept.token == run->hub.token;
        return;
    case FRAME_EVENT:
        if (message_read_event(frame, &event)) {
            body_report_event(&run->report, &event);
        }
        return;
    case FRAME_FLEXIONS:
        if (message_read_flexions(frame, &flexions)) {
            body_report_flexions(&run->report, &flexions);
        }
        return;
    default:
        take_state(run, frame);
    }
}

/* ---- The table ---- */

/* The sensor that a joint names, by number from 1 or by name. */
static bool find_sensor(const run_t *run, const char *word, uint8_t *sensor)
{
    for (unsigned k = 0; k < run->report.sensor_count; k++) {
        char number[16];
        (void)snprintf(number, sizeof number, "%u", k + 1u);
        if (strcmp(word, number) == 0 || strcmp(word, run->report.sensors[k]) == 0) {
            *sensor = (uint8_t)k;
            return true;
        }
    }
    return false;
}

static exit_status_t find_joints(run_t *run)
{
    const stream_body_options_t *options = &run->options->body;
    for (unsigned k = 0; k < options->joint_count; k++) {
        const joint_option_t *joint = &options->joints[k];
        for (unsigned end = 0; end < 2; end++) {
            if (!find_sensor(run, joint->ends[end], &run->ends[k][end])) {
                complain("--joint", 0, 0, "%s: there is no sensor '%s': there are %u, numbered from 1", joint->name,
                         joint->ends[end], run->report.sensor_count);
                return EXIT_INPUT;
            }
        }
        memcpy(run->report.joints[k], joint->name, sizeof joint->name);
        run->report.kinds[k] = joint->kind;
    }
    run->report.joint_count = options->joint_count;
    return EXIT_READY;
}

/* What a file is called, without folder and ending; false if that is no name or one that another has. */
static bool name_of_file(run_t *run, unsigned sensor)
{
    const char *path = run->options->body.files[sensor];
    const char *begin = (strrchr(path, '/') != NULL) ? strrchr(path, '/') + 1 : path;
    const char *dot = strrchr(begin, '.');
    const size_t length = (dot != NULL) ? (size_t)(dot - begin) : strlen(begin);
    char *name = run->report.sensors[sensor];
    if (length == 0 || length > MESSAGE_NAME_BYTES) {
        return false;
    }
    for (size_t k = 0; k < length; k++) {
        const bool plain = begin[k] > ' ' && begin[k] < 0x7F && begin[k] != '"' && begin[k] != '\\' && begin[k] != ',';
        name[k] = plain ? begin[k] : '_';
    }
    name[length] = '\0';
    for (unsigned other = 0; other < sensor; other++) {
        if (strcmp(run->report.sensors[other], name) == 0) {
            return false;
        }
    }
    return true;
}

static void name_sensors(run_t *run)
{
    const stream_body_options_t *options = &run->options->body;
    bool by_file = options->file_count > 1 && options->name_count == 0;
    for (unsigned k = 0; k < run->report.sensor_count && by_file; k++) {
        by_file = name_of_file(run, k);
    }
    for (unsigned k = 0; k < run->report.sensor_count && !by_file; k++) {
        if (options->name_count > 0) {
            memcpy(run->report.sensors[k], options->names[k], sizeof options->names[k]);
        } else {
            (void)snprintf(run->report.sensors[k], sizeof run->report.sensors[k], "sensor%u", k + 1u);
        }
    }
}

/* Lists have one value, or one for each sensor. */
static exit_status_t check_counts(const run_t *run)
{
    const stream_body_options_t *options = &run->options->body;
    const unsigned sensors = run->files.count;
    const struct {
        const char *option;
        size_t count;
        size_t other; /* what is right, too */
    } lists[] = {{"--names", options->name_count, 0},          {"--serials", options->serial_count, 0},
                 {"--clock-ppm", options->clock_ppm.count, 1}, {"--delay-ms", options->delay_ms.count, 1},
                 {"--jitter-ms", options->jitter_ms.count, 1}, {"--loss", options->loss_percent.count, 1},
                 {"--burst", options->burst_s.count, 1}};
    for (size_t k = 0; k < sizeof lists / sizeof lists[0]; k++) {
        if (lists[k].count != sensors && lists[k].count != lists[k].other) {
            complain(lists[k].option, 0, 0, "%zu values for %u sensors", lists[k].count, sensors);
            return EXIT_INPUT;
        }
    }
    return EXIT_READY;
}

/* ---- Packets ---- */

static exit_status_t no_memory(void)
{
    complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
    return EXIT_TROUBLE;
}

static jcal_scale_t scale_of(const stream_body_options_t *options)
{
    return (jcal_scale_t){.gyr_rad_s = options->gyr_range_deg_s * RAD_PER_DEGREE / STEPS,
                          .acc_m_s2 = options->acc_range_g * GRAVITY_M_S2 / STEPS,
                          .gyr_rail = RAIL,
                          .acc_rail = RAIL};
}

static exit_status_t make_packets(run_t *run)
{
    const stream_body_options_t *options = &run->options->body;
    const jcal_scale_t scale = scale_of(options);
    for (unsigned k = 0; k < run->files.count; k++) {
        const radio_config_t config = {.sensor = k,
                                       .per_packet = options->per_packet,
                                       .clock_ppm = (double)per_sensor(&options->clock_ppm, k),
                                       .delay_us = 1e3 * (double)per_sensor(&options->delay_ms, k),
                                       .jitter_us = 1e3 * (double)per_sensor(&options->jitter_ms, k),
                                       .loss = 0.01 * (double)per_sensor(&options->loss_percent, k),
                                       .burst_s = (double)per_sensor(&options->burst_s, k),
                                       .gyr_step = scale.gyr_rad_s,
                                       .acc_step = scale.acc_m_s2,
                                       .seed = options->seed};
        if (!radio_make(&run->files.radios[k], &config)) {
            return no_memory();
        }
    }
    return EXIT_READY;
}

/* What is played, before anything else. */
static void tell_played(run_t *run)
{
    for (unsigned k = 0; k < run->files.count; k++) {
        const radio_t *radio = &run->files.radios[k];
        json_t json = json_begin(stdout);
        json_word(&json, "event", "played");
        json_word(&json, "sensor", run->report.sensors[k]);
        json_number(&json, "period_s", (float)(1e-6 * radio->period_us));
        json_time(&json, "times_less_s", true, run->files.shift_us[k]);
        json_count(&json, "readings", radio->readings);
        json_count(&json, "missing", radio->missing);
        json_count(&json, "clipped", radio->clipped);
        json_count(&json, "packets", radio->packet_count + radio->lost);
        json_count(&json, "packets_lost", radio->lost);
        json_end(&json);
        (void)fputc('\n', stdout);
    }
}

/* ---- To the hub ---- */

static exit_status_t send_table(run_t *run)
{
    const stream_body_options_t *options = &run->options->body;
    exit_status_t status = EXIT_READY;
    frame_writer_t payload;
    for (unsigned k = 0; k < run->report.sensor_count && status == EXIT_READY; k++) {
        const float ppm = fabsf(per_sensor(&options->clock_ppm, k));
        message_sensor_t sensor = {.number = (uint8_t)k,
                                   .serial = (options->serial_count > 0) ? options->serials[k] : k + 1u,
                                   .packets = jcal_packet_config_default()};
        sensor.packets.period_ns = (uint32_t)lrint(1e3 * run->files.radios[k].period_us);
        sensor.packets.counter_bits = 16;
        sensor.packets.per_packet = (uint8_t)options->per_packet;
        sensor.packets.scale = scale_of(options);
        sensor.packets.max_drift_ppm = fminf(1000.0f, fmaxf(DRIFT_PPM, 2.0f * ppm));
        memcpy(sensor.name, run->report.sensors[k], sizeof sensor.name);
        message_write_sensor(&payload, &sensor);
        status = hub_session_send_frame(&run->hub, FRAME_SENSOR, &payload);
    }
    for (unsigned k = 0; k < run->report.joint_count && status == EXIT_READY; k++) {
        message_joint_t joint = {.number = (uint8_t)k,
                                 .kind = run->report.kinds[k],
                                 .proximal = run->ends[k][0],
                                 .distal = run->ends[k][1],
                                 .max_bound_rad = run->common->max_bound};
        memcpy(joint.name, run->report.joints[k], sizeof joint.name);
        message_write_joint(&payload, &joint);
        status = hub_session_send_frame(&run->hub, FRAME_JOINT, &payload);
    }
    return (status == EXIT_READY) ? hub_session_wait_for(&run->hub, &run->has_table) : status;
}

/* Words of the library that are about a joint; all others are about a sensor. */
static const char *whose(const run_t *run)
{
    static const char *const joints[] = {"no_such_sensor", "same_sensor", "distal_twice",
                                         "no_such_kind",   "engine",      "circle"};
    for (size_t k = 0; k < sizeof joints / sizeof joints[0]; k++) {
        if (strcmp(run->table.what, joints[k]) == 0) {
            return (run->table.at < run->report.joint_count) ? run->report.joints[run->table.at] : "";
        }
    }
    return (run->table.at < run->report.sensor_count) ? run->report.sensors[run->table.at] : "";
}

static exit_status_t greet(run_t *run)
{
    frame_writer_t payload;
    const stream_body_options_t *options = &run->options->body;
    const message_begin_t begin = {.every_us = (uint64_t)run->common->every_us,
                                   .angles_every_us = (uint64_t)options->angles_every_us,
                                   .sensors = (uint8_t)run->report.sensor_count,
                                   .joints = (uint8_t)run->report.joint_count,
                                   .flags =
                                       (uint8_t)(MESSAGE_LAGS | MESSAGE_EXAMINE | (options->keep ? MESSAGE_KEEP : 0u))};
    message_write_begin(&payload, &begin);
    exit_status_t status = hub_session_greet_body(&run->hub, &payload, on_frame, run);
    status = (status == EXIT_READY) ? send_table(run) : status;
    if (status == EXIT_READY && run->table.refused) {
        const char *name = whose(run);
        complain(run->options->hub.target, 0, 0, "the hub refuses the table: %s%s%s", run->table.what,
                 (name[0] != '\0') ? " of " : "", name);
        status = EXIT_INPUT;
    }
    return status;
}

/* ---- Kept records ---- */

static exit_status_t file_trouble(const char *name, exit_status_t status)
{
    complain(name, 0, 0, "%s", strerror(errno));
    return status;
}

/* Sends a question about what is kept, and waits for its answer. */
static exit_status_t ask_kept(run_t *run, frame_type_t type, const frame_writer_t *payload)
{
    run->has_kept = false;
    const exit_status_t status = hub_session_send_frame(&run->hub, type, payload);
    return (status == EXIT_READY) ? hub_session_wait_for(&run->hub, &run->has_kept) : status;
}

static exit_status_t put_record(run_t *run, const uint8_t record[JCAL_KEPT_BYTES])
{
    message_put_kept_t message = {.token = ++run->hub.token};
    frame_writer_t payload;
    memcpy(message.bytes, record, sizeof message.bytes);
    message_write_put_kept(&payload, &message);
    const exit_status_t status = ask_kept(run, FRAME_PUT_KEPT, &payload);
    if (status == EXIT_READY && run->kept.refusal != MESSAGE_KEPT_WRITTEN) {
        complain(run->options->hub.target, 0, 0, "the hub does not keep a record of %s: %s",
                 run->options->body.put_kept,
                 (run->kept.refusal == MESSAGE_KEPT_FLASH_FAILED)
                     ? "its flash failed, or it has none"
                     : jcal_kept_refusal_string((jcal_kept_refusal_t)run->kept.refusal));
        return EXIT_TROUBLE;
    }
    return status;
}

/* Records stand in a file one after the other. */
static exit_status_t put_kept(run_t *run)
{
    const char *name = run->options->body.put_kept;
    FILE *file = fopen(name, "rb");
    if (file == NULL) {
        return file_trouble(name, EXIT_INPUT);
    }
    uint8_t record[JCAL_KEPT_BYTES];
    exit_status_t status = EXIT_READY;
    size_t got = fread(record, 1, sizeof record, file);
    for (; got == sizeof record && status == EXIT_READY; got = fread(record, 1, sizeof record, file)) {
        status = put_record(run, record);
    }
    if (status == EXIT_READY && ferror(file) != 0) {
        status = file_trouble(name, EXIT_TROUBLE);
    } else if (status == EXIT_READY && got != 0) {
        complain(name, 0, 0, "a record has %u bytes, and %zu are left over", JCAL_KEPT_BYTES, got);
        status = EXIT_INPUT;
    }
    (void)fclose(file);
    return status;
}

static exit_status_t get_kept(run_t *run)
{
    const char *name = run->options->body.get_kept;
    FILE *file = fopen(name, "wb");
    if (file == NULL) {
        return file_trouble(name, EXIT_TROUBLE);
    }
    exit_status_t status = EXIT_READY;
    for (unsigned k = 0; k < run->report.joint_count && status == EXIT_READY; k++) {
        const message_ask_kept_t message = {.token = ++run->hub.token, .joint = (uint8_t)k};
        frame_writer_t payload;
        message_write_ask_kept(&payload, &message);
        status = ask_kept(run, FRAME_GET_KEPT, &payload);
        if (status == EXIT_READY && run->kept.refusal == (uint8_t)JCAL_KEPT_FITS) {
            (void)fwrite(run->kept.bytes, 1, sizeof run->kept.bytes, file);
        }
    }
    const bool failed = ferror(file) != 0;
    if ((fclose(file) != 0 || failed) && status == EXIT_READY) {
        status = file_trouble(name, EXIT_TROUBLE);
    }
    return status;
}

/* Until the packet is due, if the recording is played at its own pace. */
static exit_status_t wait_due(run_t *run, int64_t arrival_us)
{
    if (run->options->speed <= 0.0f) {
        return EXIT_READY;
    }
    const double after_us = (double)(arrival_us - run->files.start_us) / (double)run->options->speed;
    const int64_t due_us = run->began_us + (int64_t)after_us;
    exit_status_t status = EXIT_READY;
    for (int64_t left_us = due_us - hub_link_clock_us(); left_us > 0 && status == EXIT_READY;
         left_us = due_us - hub_link_clock_us()) {
        status = hub_session_wait(&run->hub, left_us);
    }
    return status;
}

static exit_status_t send_packets(run_t *run)
{
    unsigned sensor = 0;
    run->began_us = hub_link_clock_us();
    const int64_t span_us = run->files.end_us - run->files.start_us;
    progress_start(&run->progress, (span_us > 0) ? (uint64_t)span_us : 0u);
    for (const radio_packet_t *packet = body_files_next(&run->files, &sensor); packet != NULL;
         packet = body_files_next(&run->files, &sensor)) {
        const int64_t since_us = packet->arrival_us - run->files.start_us;
        message_packet_t message = {.sensor = (uint8_t)sensor,
                                    .arrival_us = ORIGIN_US + (uint64_t)since_us,
                                    .counter = packet->counter,
                                    .count = packet->count};
        memcpy(message.raw, run->files.radios[sensor].raw[packet->first],
               packet->count * sizeof run->files.radios[sensor].raw[0]);
        frame_writer_t payload;
        message_write_packet(&payload, &message);
        exit_status_t status = wait_due(run, packet->arrival_us);
        status = (status == EXIT_READY) ? hub_session_send_frame(&run->hub, FRAME_PACKET, &payload) : status;
        if (status != EXIT_READY) {
            return status;
        }
        if (ferror(stdout)) {
            return complain_output("standard output");
        }
        progress_show(&run->progress, (since_us > 0) ? (uint64_t)since_us : 0u);
    }
    return EXIT_READY;
}

/* ---- The end ---- */

static bool has_all(const run_t *run)
{
    bool all = run->has_body;
    for (unsigned k = 0; k < run->report.joint_count; k++) {
        all = all && run->has_joint[k];
    }
    for (unsigned k = 0; k < run->report.sensor_count; k++) {
        all = all && run->has_sensor[k];
    }
    return all;
}

/* Asks until all parts of one answer have come. */
static exit_status_t ask(run_t *run)
{
    const int64_t until_us = hub_link_clock_us() + run->options->hub.timeout_us;
    run->has_body = false;
    for (;;) {
        const exit_status_t status = hub_session_ask(&run->hub);
        if (status != EXIT_READY || has_all(run)) {
            return status;
        }
        if (hub_link_clock_us() > until_us) {
            complain(run->options->hub.target, 0, 0, "the hub does not tell of all joints and sensors");
            return EXIT_TROUBLE;
        }
    }
}

static exit_status_t finish(run_t *run)
{
    const exit_status_t status = ask(run);
    if (status != EXIT_READY) {
        return status;
    }
    body_report_flush(&run->report);
    progress_clear(&run->progress);
    bool ready = true;
    for (unsigned k = 0; k < run->report.joint_count; k++) {
        ready = ready && run->joints[k].result.head.status == JCAL_READY;
    }
    json_t json = json_begin(stdout);
    json_word(&json, "event", "end");
    body_report_time(&run->report, &json, run->body.status.t_us);
    json_bool(&json, "ready", ready);
    json_key(&json, "joints");
    for (unsigned k = 0; k < run->report.joint_count; k++) {
        (void)fputs((k == 0) ? "[" : ", ", stdout);
        json_t joint = json_begin(stdout);
        body_report_joint_keys(&run->report, &joint, &run->joints[k]);
        json_end(&joint);
    }
    (void)fputc(']', stdout);
    json_key(&json, "sensors");
    for (unsigned k = 0; k < run->report.sensor_count; k++) {
        (void)fputs((k == 0) ? "[" : ", ", stdout);
        json_t sensor = json_begin(stdout);
        body_report_sensor_keys(&run->report, &sensor, &run->sensors[k]);
        json_end(&sensor);
    }
    (void)fputc(']', stdout);
    body_report_body_keys(&json, &run->body);
    json_count(&json, "packets", run->hub.counters.samples);
    json_end(&json);
    (void)fputc('\n', stdout);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        return complain_output("standard output");
    }
    hub_session_tell_counters(&run->hub, run->options->counters);
    return ready ? EXIT_READY : EXIT_NOT_READY;
}

static exit_status_t play(run_t *run)
{
    exit_status_t status = hub_session_open(&run->hub, &run->options->hub, &run->progress);
    if (status != EXIT_READY) {
        return status;
    }
    tell_played(run);
    status = greet(run);
    if (status == EXIT_READY && run->options->body.put_kept != NULL) {
        status = put_kept(run);
    }
    status = (status == EXIT_READY) ? send_packets(run) : status;
    if (status == EXIT_READY && run->options->body.get_kept != NULL) {
        status = get_kept(run);
    }
    status = (status == EXIT_READY) ? finish(run) : status;
    hub_session_close(&run->hub);
    return status;
}

exit_status_t stream_body(const common_options_t *common, const stream_options_t *options)
{
    run_t *run = calloc(1, sizeof *run);
    if (run == NULL) {
        return no_memory();
    }
    run->common = common;
    run->options = options;
    exit_status_t status = body_files_read(&run->files, options->body.files, options->body.file_count, common->sort);
    status = (status == EXIT_READY) ? check_counts(run) : status;
    if (status == EXIT_READY) {
        run->report.file = stdout;
        run->report.origin_us = ORIGIN_US;
        run->report.start_us = run->files.start_us;
        run->report.sensor_count = run->files.count;
        name_sensors(run);
        status = find_joints(run);
    }
    status = (status == EXIT_READY) ? make_packets(run) : status;
    status = (status == EXIT_READY) ? play(run) : status;
    body_files_free(&run->files);
    free(run);
    return status;
}
