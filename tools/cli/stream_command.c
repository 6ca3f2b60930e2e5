/* SPDX-License-Identifier: MIT */
/* `jointcal stream`: rows to a hub, the hub's estimates out. */
#include "stream_command.h"

#include "hinge_output.h"
#include "hub_link.h"
#include "input.h"
#include "message.h"
#include "progress.h"
#include "recording.h"
#include "stream_options.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The hub's time of the first row that has one, as in `jointcal hinge`. */
#define ORIGIN_US ((uint64_t)1 << 62)

/* How long to wait for an answer before asking again. */
#define ASK_AGAIN_US 500000

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    stream_options_t options;
    input_t input;
    recording_t recording;
    hub_link_t link;
    progress_t progress;
    message_hello_t hello;
    message_estimate_t estimate; /* answer to the last question */
    message_counters_t counters;
    bool has_hello, has_estimate, has_counters; /* answers to the last question */
    bool output_failed;
    uint32_t token;
    bool has_start;
    int64_t start_us; /* first time in the file */
    int64_t began_us; /* by the clock, when that row was sent */
} session_t;

/* Each event is flushed, so that readers of a pipe get it at once. */
static void emit(session_t *session, const char *event, const message_estimate_t *estimate)
{
    const report_t report = {.finding = hinge_finding(&estimate->result),
                             .clock.has_time = estimate->now_us != MESSAGE_TIME_UNKNOWN,
                             .clock.t_us = (int64_t)(estimate->now_us - ORIGIN_US + (uint64_t)session->start_us)};
    progress_clear(&session->progress);
    hinge_write_json(stdout, event, &report, &estimate->result);
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        session->output_failed = true;
    }
}

static void take_estimate(session_t *session, const message_estimate_t *estimate)
{
    if ((estimate->events & MESSAGE_EVENT_READY) != 0) {
        emit(session, "ready", estimate);
    }
    if ((estimate->events & MESSAGE_EVENT_MOVED) != 0) {
        emit(session, "moved", estimate);
    }
    if ((estimate->events & MESSAGE_EVENT_DUE) != 0) {
        emit(session, "estimate", estimate);
    }
    if ((estimate->events & MESSAGE_EVENT_REQUESTED) != 0 && estimate->token == session->token) {
        session->estimate = *estimate;
        session->has_estimate = true;
    }
}

/* A hub_frame_t. */
static void on_frame(void *context, const frame_t *frame)
{
    session_t *session = context;
    message_hello_t hello;
    message_estimate_t estimate;
    message_counters_t counters;
    if (frame->type == FRAME_HELLO && message_read_hello(frame, &hello) && hello.nonce == session->token) {
        session->hello = hello;
        session->has_hello = true;
    } else if (frame->type == FRAME_ESTIMATE && message_read_estimate(frame, &estimate)) {
        take_estimate(session, &estimate);
    } else if (frame->type == FRAME_COUNTERS && message_read_counters(frame, &counters) &&
               counters.token == session->token) {
        session->counters = counters;
        session->has_counters = true;
    }
}

static exit_status_t hub_trouble(session_t *session, const char *text)
{
    progress_clear(&session->progress);
    complain(session->options.target, 0, 0, "%s", text);
    return EXIT_TROUBLE;
}

static exit_status_t silent(session_t *session)
{
    progress_clear(&session->progress);
    complain(session->options.target, 0, 0, "the hub has been silent for %g seconds",
             (double)session->options.timeout_us * 1e-6);
    return EXIT_TROUBLE;
}

static exit_status_t output_trouble(session_t *session)
{
    progress_clear(&session->progress);
    complain("standard output", 0, 0, "%s", strerror(errno));
    return EXIT_TROUBLE;
}

/* Waits for what `done` tells, at most until it is time to ask again. */
static bool wait_answer(session_t *session, const bool *done)
{
    const int64_t until_us = hub_link_clock_us() + ASK_AGAIN_US;
    for (int64_t left_us = ASK_AGAIN_US; left_us > 0 && !*done; left_us = until_us - hub_link_clock_us()) {
        if (!hub_link_wait(&session->link, left_us)) {
            return false;
        }
    }
    return true;
}

static bool send_start(session_t *session)
{
    const message_start_t start = {.nonce = session->token,
                                   .every_us = (uint64_t)session->options.every_us,
                                   .max_bound_rad = session->options.max_bound_rad,
                                   .sign_hint = (uint8_t)session->options.sign_hint};
    frame_writer_t payload;
    message_write_start(&payload, &start);
    session->link.next = 0;
    return hub_link_send(&session->link, FRAME_START, &payload);
}

/* Says hello to the hub until it answers. Numbers that differ from run to run tell this session's answers from old ones. */
static exit_status_t greet(session_t *session)
{
    session->token = (uint32_t)hub_link_clock_us() ^ ((uint32_t)getpid() << 16);
    const int64_t until_us = hub_link_clock_us() + session->options.timeout_us;
    while (!session->has_hello) {
        session->token++;
        if (!send_start(session) || !wait_answer(session, &session->has_hello)) {
            return hub_trouble(session, session->link.error);
        }
        if (!session->has_hello && hub_link_clock_us() > until_us) {
            return silent(session);
        }
    }
    if (session->hello.refused) {
        return hub_trouble(session, "the hub refuses the configuration");
    }
    session->link.limit = session->link.next + session->hello.credit;
    return EXIT_READY;
}

static bool ask(session_t *session)
{
    frame_writer_t payload;
    session->token++;
    session->has_estimate = false;
    session->has_counters = false;
    message_write_number(&payload, session->token);
    return hub_link_send(&session->link, FRAME_REQUEST, &payload);
}

/* Until the hub can take another frame. If nothing moves, frames of the last credit or its renewal were lost: a question,
 * which needs no credit, makes the hub renew it. */
static exit_status_t wait_credit(session_t *session)
{
    int64_t ask_us = hub_link_clock_us() + ASK_AGAIN_US;
    while ((int32_t)(session->link.limit - session->link.next) <= 0) {
        if (!hub_link_wait(&session->link, ASK_AGAIN_US)) {
            return hub_trouble(session, session->link.error);
        }
        if (hub_link_silence_us(&session->link) > session->options.timeout_us) {
            return silent(session);
        }
        if (hub_link_clock_us() > ask_us) {
            ask_us += ASK_AGAIN_US;
            if (!ask(session)) {
                return hub_trouble(session, session->link.error);
            }
        }
    }
    return EXIT_READY;
}

/* Until the row is due, if the recording is played at its own pace. */
static exit_status_t wait_due(session_t *session, int64_t row_us)
{
    if (session->options.speed <= 0.0f) {
        return EXIT_READY;
    }
    const double after_us = (double)(row_us - session->start_us) / (double)session->options.speed;
    const int64_t due_us = session->began_us + (int64_t)after_us;
    for (int64_t left_us = due_us - hub_link_clock_us(); left_us > 0; left_us = due_us - hub_link_clock_us()) {
        if (!hub_link_wait(&session->link, left_us)) {
            return hub_trouble(session, session->link.error);
        }
    }
    return EXIT_READY;
}

static exit_status_t send_row(session_t *session, const recording_row_t *row)
{
    jcal_pair_t pair = {MESSAGE_TIME_UNKNOWN, row->imu1, row->imu2};
    if (row->has_time) {
        if (!session->has_start) {
            session->has_start = true;
            session->start_us = row->t_us;
            session->began_us = hub_link_clock_us();
        }
        pair.t_us = ORIGIN_US + (uint64_t)row->t_us - (uint64_t)session->start_us;
        const exit_status_t status = wait_due(session, row->t_us);
        if (status != EXIT_READY) {
            return status;
        }
    }
    const exit_status_t status = wait_credit(session);
    if (status != EXIT_READY) {
        return status;
    }
    frame_writer_t payload;
    message_write_sample(&payload, &pair);
    /* A look at what has come, so that estimates are written when they are made. */
    if (!hub_link_send(&session->link, FRAME_SAMPLE, &payload) || !hub_link_wait(&session->link, 0)) {
        return hub_trouble(session, session->link.error);
    }
    return session->output_failed ? output_trouble(session) : EXIT_READY;
}

/* Says why the recording could not be read on. */
static exit_status_t give_up(session_t *session, recording_event_t event)
{
    const recording_fault_t *fault = &session->recording.fault;
    progress_clear(&session->progress);
    if (event == RECORDING_BAD) {
        complain(session->input.name, fault->line, fault->column, "%s", fault->text);
        return EXIT_INPUT;
    }
    complain(session->input.name, 0, 0, "%s", strerror((session->input.error != 0) ? session->input.error : ENOMEM));
    return EXIT_TROUBLE;
}

/* On standard error, if there is something to tell or the user wants to know. */
static void tell_counters(const session_t *session)
{
    const message_counters_t *hub = &session->counters;
    const frame_counts_t *to = &hub->link;
    const frame_counts_t *from = &session->link.from_hub.counts;
    const uint32_t faults = to->lost + to->repeated + to->corrupted + to->reordered + to->stale + hub->unknown +
                            hub->overrun + from->lost + from->repeated + from->corrupted + from->reordered +
                            from->stale;
    if (faults == 0 && !session->options.counters) {
        return;
    }
    (void)fprintf(stderr,
                  "frames to the hub: %" PRIu32 " received, %" PRIu32 " lost, %" PRIu32 " repeated, %" PRIu32
                  " corrupted, %" PRIu32 " reordered, %" PRIu32 " stale, %" PRIu32 " unknown, %" PRIu32 " overrun\n",
                  to->received, to->lost, to->repeated, to->corrupted, to->reordered, to->stale, hub->unknown,
                  hub->overrun);
    (void)fprintf(stderr,
                  "frames from the hub: %" PRIu32 " received, %" PRIu32 " lost, %" PRIu32 " repeated, %" PRIu32
                  " corrupted, %" PRIu32 " reordered, %" PRIu32 " stale\n",
                  from->received, from->lost, from->repeated, from->corrupted, from->reordered, from->stale);
}

/* The end: estimate and counters of all that arrived, asked for until they come. */
static exit_status_t finish(session_t *session)
{
    const int64_t until_us = hub_link_clock_us() + session->options.timeout_us;
    while (!(session->has_estimate && session->has_counters)) {
        if (!ask(session) || !wait_answer(session, &session->has_counters)) {
            return hub_trouble(session, session->link.error);
        }
        if (!session->has_counters && hub_link_clock_us() > until_us) {
            return silent(session);
        }
    }
    emit(session, "end", &session->estimate);
    if (session->output_failed) {
        return output_trouble(session);
    }
    tell_counters(session);
    return (session->estimate.result.head.status == JCAL_READY) ? EXIT_READY : EXIT_NOT_READY;
}

static exit_status_t run_rows(session_t *session)
{
    recording_row_t row;
    recording_event_t event = recording_next(&session->recording, &row);
    for (; event == RECORDING_ROW; event = recording_next(&session->recording, &row)) {
        const exit_status_t status = send_row(session, &row);
        if (status != EXIT_READY) {
            return status;
        }
        progress_show(&session->progress, session->recording.csv.bytes);
    }
    if (event != RECORDING_END) {
        return give_up(session, event);
    }
    session->has_estimate = false;
    session->has_counters = false;
    return finish(session);
}

static exit_status_t run_recording(session_t *session)
{
    const recording_event_t event = recording_open(&session->recording, input_read, &session->input);
    exit_status_t status = EXIT_READY;
    if (event != RECORDING_ROW) {
        status = give_up(session, event);
    } else if (!hub_link_open(&session->link, session->options.target, session->options.baud)) {
        status = hub_trouble(session, session->link.error);
        hub_link_close(&session->link);
    } else {
        hub_link_listen(&session->link, on_frame, session);
        status = greet(session);
        if (status == EXIT_READY) {
            progress_start(&session->progress, session->input.size);
            status = run_rows(session);
        }
        hub_link_close(&session->link);
    }
    recording_close(&session->recording);
    return status;
}

int stream_command(int argc, char **argv)
{
    session_t *session = calloc(1, sizeof *session);
    if (session == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    session->options = stream_options(argc, argv);
    exit_status_t status = EXIT_INPUT;
    if (input_open(&session->input, session->options.recording) != 0) {
        complain(session->options.recording, 0, 0, "%s", strerror(session->input.error));
    } else {
        status = run_recording(session);
        input_close(&session->input);
    }
    free(session);
    return (int)status;
}
