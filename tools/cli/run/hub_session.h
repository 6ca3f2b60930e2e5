/* SPDX-License-Identifier: MIT */
/// @file
/// Talk with a hub: greeting, credit, questions. What goes over the wire and back is hub_link's.
#ifndef JCAL_CLI_RUN_HUB_SESSION_H
#define JCAL_CLI_RUN_HUB_SESSION_H

#include "output/message.h"
#include "output/progress.h"
#include "run/hub_link.h"

/// How to reach the hub.
typedef struct {
    const char *target;  ///< Where it is.
    unsigned long baud;  ///< Of a serial line.
    int64_t timeout_us;  ///< How long it may be silent.
} hub_target_t;

/// Called with each estimate that the hub sends of its own accord; `event` is ready, moved or estimate.
typedef void hub_event_t(void *context, const char *event, const message_estimate_t *estimate);

/// Called with a frame that is none of a pair session's.
typedef void hub_other_t(void *context, const frame_t *frame);

typedef struct {
    hub_link_t link;
    message_estimate_t estimate;  ///< Answer to the last question.
    message_counters_t counters;
    uint32_t token;  ///< Of the last question.

    /* Private. */
    hub_target_t target;
    progress_t *progress; /* taken away before a message */
    hub_event_t *on_event;
    hub_other_t *on_other; /* a body session's; null in a pair session */
    void *context;
    message_hello_t hello;
    bool has_hello, has_estimate, has_counters; /* answers to the last question */
} hub_session_t;

/// Connects. EXIT_READY, or another status after a message.
exit_status_t hub_session_open(hub_session_t *session, const hub_target_t *target, progress_t *progress);

/// Whom to tell of events.
void hub_session_listen(hub_session_t *session, hub_event_t *on_event, void *context);

/// Says hello with the config until the hub answers. EXIT_READY, or another status after a message.
exit_status_t hub_session_greet(hub_session_t *session, message_start_t start);

/// The same of a body session: says begin. `begin` is its payload, whose nonce is filled in; on_other gets what comes.
exit_status_t hub_session_greet_body(hub_session_t *session, frame_writer_t *begin, hub_other_t *on_other,
                                     void *context);

/// Sends any frame as soon as the hub can take it, and looks at what has come. EXIT_READY, or another status after a message.
exit_status_t hub_session_send_frame(hub_session_t *session, frame_type_t type, const frame_writer_t *payload);

/// Waits until what `done` points to is true, for as long as the hub may be silent. EXIT_READY, or another status after a message.
exit_status_t hub_session_wait_for(hub_session_t *session, const bool *done);

/// Sends a sample as soon as the hub can take it, and looks at what has come. EXIT_READY, or another status after a message.
exit_status_t hub_session_send(hub_session_t *session, const jcal_pair_t *pair);

/// Waits, and takes in what comes. EXIT_READY, or another status after a message.
exit_status_t hub_session_wait(hub_session_t *session, int64_t us);

/// Asks for estimate and counters of all that arrived until they come. EXIT_READY, or another status after a message.
exit_status_t hub_session_ask(hub_session_t *session);

/// Tells on standard error what became of the frames, if one was lost or damaged, or if `always`.
void hub_session_tell_counters(const hub_session_t *session, bool always);

/// Closes the connection.
void hub_session_close(hub_session_t *session);

#endif
