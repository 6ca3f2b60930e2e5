/* SPDX-License-Identifier: MIT */
/* Talk with a hub. */
#include "run/hub_session.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* How long to wait for an answer before asking again. */
#define ASK_AGAIN_US 500000

static void take_estimate(hub_session_t *session, const message_estimate_t *estimate)
{
    if ((estimate->events & MESSAGE_EVENT_READY) != 0) {
        session->on_event(session->context, "ready", estimate);
    }
    if ((estimate->events & MESSAGE_EVENT_MOVED) != 0) {
        session->on_event(session->context, "moved", estimate);
    }
    if ((estimate->events & MESSAGE_EVENT_DUE) != 0) {
        session->on_event(session->context, "estimate", estimate);
    }
    if ((estimate->events & MESSAGE_EVENT_REQUESTED) != 0 && estimate->token == session->token) {
        session->estimate = *estimate;
        session->has_estimate = true;
    }
}

/* A hub_frame_t. */
static void on_frame(void *context, const frame_t *frame)
{
    hub_session_t *session = context;
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
    } else if (session->on_other != NULL) {
        session->on_other(session->context, frame);
    }
}

static exit_status_t trouble(hub_session_t *session, const char *text)
{
    progress_clear(session->progress);
    complain(session->target.target, 0, 0, "%s", text);
    return EXIT_TROUBLE;
}

static exit_status_t silent(hub_session_t *session)
{
    progress_clear(session->progress);
    complain(session->target.target, 0, 0, "the hub has been silent for %g seconds",
             (double)session->target.timeout_us * 1e-6);
    return EXIT_TROUBLE;
}

/* Waits for what `done` tells, at most until it is time to ask again. */
static bool wait_answer(hub_session_t *session, const bool *done)
{
    const int64_t until_us = hub_link_clock_us() + ASK_AGAIN_US;
    for (int64_t left_us = ASK_AGAIN_US; left_us > 0 && !*done && session->link.speaks == 0;
         left_us = until_us - hub_link_clock_us()) {
        if (!hub_link_wait(&session->link, left_us)) {
            return false;
        }
    }
    return true;
}

exit_status_t hub_session_open(hub_session_t *session, const hub_target_t *target, progress_t *progress)
{
    memset(session, 0, sizeof *session);
    session->target = *target;
    session->progress = progress;
    if (!hub_link_open(&session->link, target->target, target->baud)) {
        hub_link_close(&session->link);
        return trouble(session, session->link.error);
    }
    hub_link_listen(&session->link, on_frame, session);
    return EXIT_READY;
}

void hub_session_listen(hub_session_t *session, hub_event_t *on_event, void *context)
{
    session->on_event = on_event;
    session->context = context;
}

/* The nonce is the first field. */
static bool send_start(hub_session_t *session, frame_type_t type, frame_writer_t *start)
{
    frame_writer_t nonce;
    message_write_number(&nonce, session->token);
    memcpy(start->bytes, nonce.bytes, nonce.size);
    session->link.next = 0;
    return hub_link_send(&session->link, type, start);
}

static exit_status_t speaks_other(hub_session_t *session)
{
    progress_clear(session->progress);
    complain(session->target.target, 0, 0, "the hub speaks protocol %u, this program %u",
             (unsigned)session->link.speaks, FRAME_VERSION);
    return EXIT_TROUBLE;
}

/* Numbers that differ from run to run tell this session's answers from old ones. */
static exit_status_t greet(hub_session_t *session, frame_type_t type, frame_writer_t *start)
{
    session->token = (uint32_t)hub_link_clock_us() ^ ((uint32_t)getpid() << 16);
    const int64_t until_us = hub_link_clock_us() + session->target.timeout_us;
    while (!session->has_hello) {
        session->token++;
        if (!send_start(session, type, start) || !wait_answer(session, &session->has_hello)) {
            return (session->link.speaks != 0) ? speaks_other(session) : trouble(session, session->link.error);
        }
        if (!session->has_hello && session->link.speaks != 0) {
            return speaks_other(session);
        }
        if (!session->has_hello && hub_link_clock_us() > until_us) {
            return silent(session);
        }
    }
    session->link.limit = session->link.next + session->hello.credit;
    return EXIT_READY;
}

exit_status_t hub_session_greet(hub_session_t *session, message_start_t start)
{
    frame_writer_t payload;
    message_write_start(&payload, &start);
    const exit_status_t status = greet(session, FRAME_START, &payload);
    return (status == EXIT_READY && session->hello.refused) ? trouble(session, "the hub refuses the configuration")
                                                            : status;
}

exit_status_t hub_session_greet_body(hub_session_t *session, frame_writer_t *begin, hub_other_t *on_other,
                                     void *context)
{
    session->on_other = on_other;
    session->context = context;
    const exit_status_t status = greet(session, FRAME_BEGIN, begin);
    return (status == EXIT_READY && session->hello.refused)
               ? trouble(session, "the hub has no room for so many sensors or joints")
               : status;
}

static bool ask(hub_session_t *session)
{
    frame_writer_t payload;
    session->token++;
    session->has_estimate = session->on_other != NULL;
    session->has_counters = false;
    message_write_number(&payload, session->token);
    return hub_link_send(&session->link, FRAME_REQUEST, &payload);
}

/* Until the hub can take another frame. If nothing moves, frames of the last credit or its renewal were lost: a question,
 * which needs no credit, makes the hub renew it. */
static exit_status_t wait_credit(hub_session_t *session)
{
    int64_t ask_us = hub_link_clock_us() + ASK_AGAIN_US;
    while ((int32_t)(session->link.limit - session->link.next) <= 0) {
        if (!hub_link_wait(&session->link, ASK_AGAIN_US)) {
            return trouble(session, session->link.error);
        }
        if (hub_link_silence_us(&session->link) > session->target.timeout_us) {
            return silent(session);
        }
        if (hub_link_clock_us() > ask_us) {
            ask_us += ASK_AGAIN_US;
            if (!ask(session)) {
                return trouble(session, session->link.error);
            }
        }
    }
    return EXIT_READY;
}

exit_status_t hub_session_send_frame(hub_session_t *session, frame_type_t type, const frame_writer_t *payload)
{
    const exit_status_t status = wait_credit(session);
    if (status != EXIT_READY) {
        return status;
    }
    /* A look at what has come, so that it is written when it is made. */
    if (!hub_link_send(&session->link, type, payload) || !hub_link_wait(&session->link, 0)) {
        return trouble(session, session->link.error);
    }
    return EXIT_READY;
}

exit_status_t hub_session_send(hub_session_t *session, const jcal_pair_t *pair)
{
    frame_writer_t payload;
    message_write_sample(&payload, pair);
    return hub_session_send_frame(session, FRAME_SAMPLE, &payload);
}

exit_status_t hub_session_wait_for(hub_session_t *session, const bool *done)
{
    const int64_t until_us = hub_link_clock_us() + session->target.timeout_us;
    while (!*done) {
        if (!wait_answer(session, done)) {
            return trouble(session, session->link.error);
        }
        if (!*done && hub_link_clock_us() > until_us) {
            return silent(session);
        }
    }
    return EXIT_READY;
}

exit_status_t hub_session_wait(hub_session_t *session, int64_t us)
{
    return hub_link_wait(&session->link, us) ? EXIT_READY : trouble(session, session->link.error);
}

exit_status_t hub_session_ask(hub_session_t *session)
{
    const int64_t until_us = hub_link_clock_us() + session->target.timeout_us;
    session->has_estimate = session->on_other != NULL; /* a body session has none */
    session->has_counters = false;
    while (!(session->has_estimate && session->has_counters)) {
        if (!ask(session) || !wait_answer(session, &session->has_counters)) {
            return trouble(session, session->link.error);
        }
        if (!session->has_counters && hub_link_clock_us() > until_us) {
            return silent(session);
        }
    }
    return EXIT_READY;
}

void hub_session_tell_counters(const hub_session_t *session, bool always)
{
    const message_counters_t *hub = &session->counters;
    const frame_counts_t *to = &hub->link;
    const frame_counts_t *from = &session->link.from_hub.counts;
    const uint32_t faults = to->lost + to->repeated + to->corrupted + to->reordered + to->stale + hub->unknown +
                            hub->overrun + from->lost + from->repeated + from->corrupted + from->reordered +
                            from->stale;
    if (faults == 0 && !always) {
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

void hub_session_close(hub_session_t *session)
{
    hub_link_close(&session->link);
}
