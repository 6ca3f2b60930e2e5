/* SPDX-License-Identifier: MIT */
/// @file
/// Payloads of the frames: what a sender and a hub tell each other. Specification: docs/PROTOCOL.md.
///
/// A `write` function fills a payload; a `read` function returns false if the payload is not exactly such a message.
#ifndef JCAL_HUB_MESSAGES_H
#define JCAL_HUB_MESSAGES_H

#include "frame.h"
#include "jointcal/hinge_auto.h"

/// A sample's time if it is not known: the sample is counted as not finite.
#define MESSAGE_TIME_UNKNOWN UINT64_MAX

typedef struct {
    uint32_t nonce;     ///< Chosen by the sender; hello repeats it.
    uint64_t every_us;  ///< Estimate and counters every so often in sample time; 0: only when something happens.
    float max_bound_rad;
    uint8_t sign_hint;  ///< jcal_sign_hint_t.
} message_start_t;

typedef struct {
    uint32_t nonce;
    bool refused;        ///< The library refused the configuration; the hub does not run.
    uint8_t credit;      ///< Frames that may be on their way at a time.
    uint8_t version[3];  ///< Of the library: major, minor, patch.
} message_hello_t;

/// Why an estimate was sent; several may hold.
#define MESSAGE_EVENT_READY 1u
#define MESSAGE_EVENT_MOVED 2u
#define MESSAGE_EVENT_DUE 4u
#define MESSAGE_EVENT_REQUESTED 8u

typedef struct {
    uint8_t events;
    uint32_t token;                   ///< Of the request, else 0.
    uint64_t now_us;                  ///< Largest sample time so far; MESSAGE_TIME_UNKNOWN before any.
    jcal_hinge_auto_result_t result;  ///< Without bend_rad and gravity_off_m_s2.
} message_estimate_t;

typedef struct {
    uint32_t token;  ///< Of the request, else 0.
    frame_counts_t link;
    uint32_t unknown;  ///< Frames taken whose version, type or length is none of ours.
    uint32_t overrun;  ///< Frames taken for which there was no room: the sender went beyond its credit.
    uint32_t samples;  ///< Samples that reached the estimator.
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} message_counters_t;

void message_write_start(frame_writer_t *out, const message_start_t *in);
bool message_read_start(const frame_t *frame, message_start_t *out);

void message_write_sample(frame_writer_t *out, const jcal_pair_t *in);
bool message_read_sample(const frame_t *frame, jcal_pair_t *out);

/// Requests and credits are one number each: the token, and the first sequence number that must not be sent yet.
void message_write_number(frame_writer_t *out, uint32_t number);
bool message_read_number(const frame_t *frame, uint32_t *number);

void message_write_hello(frame_writer_t *out, const message_hello_t *in);
bool message_read_hello(const frame_t *frame, message_hello_t *out);

void message_write_estimate(frame_writer_t *out, const message_estimate_t *in);
bool message_read_estimate(const frame_t *frame, message_estimate_t *out);

void message_write_counters(frame_writer_t *out, const message_counters_t *in);
bool message_read_counters(const frame_t *frame, message_counters_t *out);

#endif
