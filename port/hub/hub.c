/* SPDX-License-Identifier: MIT */
/* The hub's application. See hub.h. */
#include "hub.h"

#include "jointcal/jointcal.h"

#include <math.h>
#include <string.h>

/* One piece of work answers with at most an estimate, counters, and a credit; a start with less. */
#define OUT_ROOM (3u * FRAME_WIRE_MAX)

/* Credit is renewed in steps of so many frames, so that answers are few beside samples. */
#define CREDIT_STEP 8u

void hub_init(hub_t *self)
{
    memset(self, 0, sizeof *self);
}

/* Receiving side. */

static bool queue_full(const hub_t *self)
{
    return self->queued - self->taken >= HUB_QUEUE;
}

static void enqueue(hub_t *self, const hub_item_t *item)
{
    if (queue_full(self)) {
        self->overrun++;
        return;
    }
    const uint32_t at = self->queued;
    volatile hub_item_t *const slot = &self->queue[at % HUB_QUEUE];
    *slot = *item;
    self->queued = at + 1u;
}

/* A sample without a time becomes one without a rate, which the library counts as not finite. */
static void push(hub_t *self, const jcal_pair_t *pair)
{
    jcal_pair_t known = *pair;
    if (pair->t_us == MESSAGE_TIME_UNKNOWN) {
        known.t_us = self->pair_us;
        known.imu1.gyr_rad_s.x = NAN;
    }
    self->pair_us = known.t_us;
    self->accepted = jcal_hinge_auto_push(&self->hinge, &known) == JCAL_OK;
}

static void receive_sample(hub_t *self, const hub_item_t *item)
{
    const bool idle = self->running && !self->busy && !self->direct_pending && self->queued == self->taken;
    if (!idle) {
        enqueue(self, item);
        return;
    }
    push(self, &item->as.pair);
    volatile hub_item_t *const direct = &self->direct;
    *direct = *item;
    self->direct_pending = true;
}

/* A start with a new nonce begins a new link, whatever its number; the same once more is a repeated frame. */
static void receive_start(hub_t *self, const frame_t *frame)
{
    hub_item_t item = {.type = FRAME_START, .sequence = frame->sequence};
    if (!message_read_start(frame, &item.as.start) || queue_full(self)) {
        return; /* the sender hears nothing and tries again */
    }
    if (self->linked && item.as.start.nonce == self->nonce) {
        (void)frame_link_count(&self->link, frame->sequence);
        return;
    }
    self->linked = true;
    self->nonce = item.as.start.nonce;
    self->unknown = 0;
    self->overrun = 0;
    frame_link_start(&self->link, frame->sequence);
    enqueue(self, &item);
}

static void receive_taken(hub_t *self, const frame_t *frame)
{
    hub_item_t item = {.type = frame->type, .sequence = frame->sequence};
    if (frame->version == FRAME_VERSION && frame->type == FRAME_SAMPLE && message_read_sample(frame, &item.as.pair)) {
        receive_sample(self, &item);
    } else if (frame->version == FRAME_VERSION && frame->type == FRAME_REQUEST &&
               message_read_number(frame, &item.as.token)) {
        enqueue(self, &item);
    } else {
        self->unknown++;
    }
}

void hub_receive(hub_t *self, uint8_t byte)
{
    frame_t frame;
    const frame_event_t event = frame_decode(&self->decoder, byte, &frame);
    if (event == FRAME_BAD) {
        self->link.counts.corrupted++;
    }
    if (event != FRAME_GOOD) {
        return;
    }
    if (frame.version == FRAME_VERSION && frame.type == FRAME_START) {
        receive_start(self, &frame);
    } else if (self->linked && frame_link_count(&self->link, frame.sequence) == FRAME_TAKEN) {
        receive_taken(self, &frame);
    }
}

/* Main loop. */

static uint32_t out_room(const hub_t *self)
{
    return HUB_OUT_BYTES - hub_send_count(self);
}

static void answer(hub_t *self, frame_type_t type, const frame_writer_t *payload)
{
    uint8_t wire[FRAME_WIRE_MAX];
    const size_t size = frame_encode(wire, type, self->sequence, payload->bytes, payload->size);
    self->sequence++;
    for (size_t k = 0; k < size; k++) {
        self->out[self->out_written % HUB_OUT_BYTES] = wire[k];
        self->out_written++;
    }
}

static void answer_estimate(hub_t *self, uint8_t events, uint32_t token)
{
    message_estimate_t estimate = {
        .events = events, .token = token, .now_us = self->has_time ? self->latest_us : MESSAGE_TIME_UNKNOWN};
    frame_writer_t payload;
    (void)jcal_hinge_auto_get(&self->hinge, &estimate.result);
    message_write_estimate(&payload, &estimate);
    answer(self, FRAME_ESTIMATE, &payload);
}

/* Whoever wants numbers that belong together asks when nothing else is on its way. */
static void answer_counters(hub_t *self, uint32_t token)
{
    jcal_hinge_auto_result_t all;
    (void)jcal_hinge_auto_get(&self->hinge, &all);
    const jcal_head_t *head = &all.hinge.head;
    message_counters_t counters = {.token = token,
                                   .link = self->link.counts,
                                   .unknown = self->unknown,
                                   .overrun = self->overrun,
                                   .samples = head->samples};
    memcpy(counters.rejected_by, head->rejected_by, sizeof counters.rejected_by);
    frame_writer_t payload;
    message_write_counters(&payload, &counters);
    answer(self, FRAME_COUNTERS, &payload);
}

/* Frames up to this one are dealt with. */
static void give_credit(hub_t *self, uint32_t sequence)
{
    const uint32_t limit = sequence + 1u + HUB_CREDIT;
    if (limit - self->limit < CREDIT_STEP) {
        return;
    }
    self->limit = limit;
    frame_writer_t payload;
    message_write_number(&payload, limit);
    answer(self, FRAME_CREDIT, &payload);
}

static void begin(hub_t *self, const hub_item_t *item)
{
    jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    self->config = item->as.start;
    config.hinge.max_bound_rad = self->config.max_bound_rad;
    config.hinge.sign_hint = (jcal_sign_hint_t)self->config.sign_hint;
    self->running = jcal_hinge_auto_init(&self->hinge, &config) == JCAL_OK;
    self->has_time = false;
    self->pair_us = 0;
    self->status = JCAL_COLLECTING;
    self->sequence = 0;
    self->limit = item->sequence + 1u + HUB_CREDIT;
    const message_hello_t hello = {.nonce = self->config.nonce,
                                   .refused = !self->running,
                                   .credit = HUB_CREDIT,
                                   .version = {JCAL_VERSION_MAJOR, JCAL_VERSION_MINOR, JCAL_VERSION_PATCH}};
    frame_writer_t payload;
    message_write_hello(&payload, &hello);
    answer(self, FRAME_HELLO, &payload);
}

/* True once per period of sample time. */
static bool estimate_due(hub_t *self, uint64_t t_us)
{
    const uint64_t every_us = self->config.every_us;
    if (t_us != MESSAGE_TIME_UNKNOWN) {
        if (!self->has_time) {
            self->has_time = true;
            self->latest_us = t_us;
            self->next_us = t_us + every_us;
        }
        self->latest_us = (t_us > self->latest_us) ? t_us : self->latest_us;
    }
    if (every_us == 0 || !self->has_time || self->latest_us < self->next_us) {
        return false;
    }
    self->next_us += every_us * (1u + (self->latest_us - self->next_us) / every_us);
    return true;
}

/* The pushed sample is worked off; reports what it changed. */
static void step(hub_t *self, uint64_t t_us)
{
    jcal_hinge_auto_result_t result;
    if (self->accepted) {
        (void)jcal_hinge_auto_step(&self->hinge);
    }
    (void)jcal_hinge_auto_get(&self->hinge, &result);
    const jcal_calibration_t status = result.hinge.head.status;
    uint8_t events = 0;
    if (status != self->status && status == JCAL_READY) {
        events |= MESSAGE_EVENT_READY;
    }
    if (status != self->status && status == JCAL_MOVED) {
        events |= MESSAGE_EVENT_MOVED;
    }
    self->status = status;
    const bool due = estimate_due(self, t_us);
    if (due) {
        events |= MESSAGE_EVENT_DUE;
    }
    if (events != 0) {
        answer_estimate(self, events, 0);
    }
    if (due) {
        answer_counters(self, 0);
    }
}

static void work_off(hub_t *self, const hub_item_t *item)
{
    if (item->type == FRAME_START) {
        begin(self, item);
        return;
    }
    if (!self->running) {
        return;
    }
    if (item->type == FRAME_SAMPLE) {
        push(self, &item->as.pair);
        step(self, item->as.pair.t_us);
    } else {
        answer_estimate(self, MESSAGE_EVENT_REQUESTED, item->as.token);
        answer_counters(self, item->as.token);
    }
    give_credit(self, item->sequence);
}

bool hub_waiting(const hub_t *self)
{
    return self->direct_pending || self->queued != self->taken;
}

bool hub_work(hub_t *self)
{
    if (!hub_waiting(self) || out_room(self) < OUT_ROOM) {
        return false;
    }
    /* From here to the end samples go into the queue. Whatever was pushed on reception came before all that is queued. */
    self->busy = true;
    if (self->direct_pending) {
        const volatile hub_item_t *const direct = &self->direct;
        const hub_item_t item = *direct;
        step(self, item.as.pair.t_us);
        give_credit(self, item.sequence);
        self->direct_pending = false;
    } else if (self->queued != self->taken) {
        const volatile hub_item_t *const slot = &self->queue[self->taken % HUB_QUEUE];
        const hub_item_t item = *slot;
        self->taken = self->taken + 1u;
        work_off(self, &item);
    }
    self->busy = false;
    return true;
}

bool hub_send(hub_t *self, uint8_t *byte)
{
    if (self->out_taken == self->out_written) {
        return false;
    }
    *byte = self->out[self->out_taken % HUB_OUT_BYTES];
    self->out_taken++;
    return true;
}

uint32_t hub_send_count(const hub_t *self)
{
    return self->out_written - self->out_taken;
}
