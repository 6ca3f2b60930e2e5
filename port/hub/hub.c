/* SPDX-License-Identifier: MIT */
/* The hub's application. See hub.h. */
#include "hub.h"

#include "jointcal/jointcal.h"

#include <string.h>

/* One piece of work answers with at most an estimate, counters, and a credit; a start with less. */
#define OUT_ROOM (3u * FRAME_WIRE_MAX)

/* Credit is renewed in steps of so many frames, so that answers are few beside samples. */
#define CREDIT_STEP 8u

/* So long nothing must have come before a processor that flash makes deaf writes it. */
#define QUIET_US 20000u

/* A body whose hub has a clock works at least so often, whether packets come or not. */
#define PASS_US 10000u

void hub_init(hub_t *self)
{
    memset(self, 0, sizeof *self);
}

void hub_set_flash(hub_t *self, const jcal_flash_t *flash, bool is_deaf)
{
    self->flash = *flash;
    self->has_flash = true;
    self->flash_is_deaf = is_deaf;
}

void hub_time(hub_t *self, uint64_t now_us)
{
    self->now_high = (uint32_t)(now_us >> 32);
    self->now_low = (uint32_t)now_us;
}

/* An interrupt that changes the time between both halves makes no time that never was. */
static uint64_t time_of(const hub_t *self)
{
    const uint32_t high = self->now_high;
    const uint32_t low = self->now_low;
    const uint32_t again = self->now_high;
    return (again == high) ? (((uint64_t)high << 32) | low) : ((uint64_t)again << 32);
}

/* ---- Receiving side ---- */

static bool queue_full(const hub_t *self)
{
    return self->queued - self->taken >= HUB_QUEUE;
}

static void enqueue(hub_t *self, const frame_t *frame)
{
    if (queue_full(self)) {
        self->overrun++;
        return;
    }
    hub_item_t *const slot = &self->queue[self->queued % HUB_QUEUE];
    slot->type = frame->type;
    slot->size = (uint8_t)frame->size;
    slot->sequence = frame->sequence;
    slot->now_us = time_of(self);
    memcpy(slot->payload, frame->payload, frame->size);
    __atomic_signal_fence(__ATOMIC_RELEASE); /* all of the item before it counts */
    self->queued = self->queued + 1u;
}

/* The nonce is the first field of both. */
static bool read_nonce(const frame_t *frame, uint32_t *nonce)
{
    message_start_t start;
    message_begin_t begin;
    if (frame->type == FRAME_START && message_read_start(frame, &start)) {
        *nonce = start.nonce;
        return true;
    }
    if (frame->type == FRAME_BEGIN && message_read_begin(frame, &begin)) {
        *nonce = begin.nonce;
        return true;
    }
    return false;
}

/* A start with a new nonce begins a new link, whatever its number; the same once more is a repeated frame. */
static void receive_start(hub_t *self, const frame_t *frame)
{
    uint32_t nonce = 0;
    if (!read_nonce(frame, &nonce) || queue_full(self)) {
        return; /* the sender hears nothing and tries again */
    }
    if (self->linked && nonce == self->nonce) {
        (void)frame_link_count(&self->link, frame->sequence);
        return;
    }
    self->linked = true;
    self->told = false;
    self->nonce = nonce;
    self->unknown = 0;
    self->overrun = 0;
    frame_link_start(&self->link, frame->sequence);
    enqueue(self, frame);
}

/* Types that a hub knows, and sizes that they may have: what is inside is read when it is worked off. */
static bool is_known(const frame_t *frame)
{
    switch (frame->type) {
    case FRAME_SAMPLE:
        return frame->size == 56u;
    case FRAME_REQUEST:
        return frame->size == 4u;
    case FRAME_SENSOR:
        return frame->size == 47u;
    case FRAME_JOINT:
        return frame->size == 24u;
    case FRAME_PACKET:
        return frame->size >= 25u && (frame->size - 13u) % 12u == 0;
    case FRAME_TIME:
        return frame->size == 8u;
    case FRAME_PUT_KEPT:
        return frame->size == 4u + JCAL_KEPT_BYTES;
    case FRAME_GET_KEPT:
    case FRAME_FORGET:
        return frame->size == 5u;
    case FRAME_SLEEP:
        return frame->size == 2u;
    default:
        return false;
    }
}

/* Another version: told once on a stream, and at every start. */
static void receive_other(hub_t *self, const frame_t *frame)
{
    if (!self->told || frame->type == FRAME_START) {
        self->told = true;
        self->refused_version = (frame->version != 0) ? frame->version : UINT8_MAX;
    }
}

void hub_receive(hub_t *self, uint8_t byte)
{
    frame_t frame;
    const frame_event_t event = frame_decode(&self->decoder, byte, &frame);
    self->heard_us = self->now_low;
    if (event == FRAME_BAD) {
        self->link.counts.corrupted++;
    }
    if (event != FRAME_GOOD) {
        return;
    }
    const bool is_ours = frame.version == FRAME_VERSION;
    if (!is_ours) {
        receive_other(self, &frame);
    }
    if (is_ours && (frame.type == FRAME_START || frame.type == FRAME_BEGIN)) {
        receive_start(self, &frame);
    } else if (self->linked && frame_link_count(&self->link, frame.sequence) == FRAME_TAKEN) {
        if (is_ours && is_known(&frame)) {
            enqueue(self, &frame);
        } else {
            self->unknown++;
        }
    }
}

/* ---- Main loop ---- */

/* Whoever wants numbers that belong together asks when nothing else is on its way. */
static void answer_counters(hub_t *self, uint32_t token)
{
    message_counters_t counters;
    frame_writer_t payload;
    memset(&counters, 0, sizeof counters);
    counters.token = token;
    counters.link = self->link.counts;
    counters.unknown = self->unknown + self->strange;
    counters.overrun = self->overrun;
    if (self->session == HUB_PAIR) {
        hub_pair_count(&self->of.pair, &counters);
    } else {
        counters.samples = self->of.body.pushed;
    }
    message_write_counters(&payload, &counters);
    hub_out_put(&self->out, FRAME_COUNTERS, &payload);
}

/* Frames up to this one are dealt with. */
static void give_credit(hub_t *self)
{
    const uint32_t limit = self->item_sequence + 1u + HUB_CREDIT;
    if (limit - self->limit < CREDIT_STEP) {
        return;
    }
    self->limit = limit;
    frame_writer_t payload;
    message_write_number(&payload, limit);
    hub_out_put(&self->out, FRAME_CREDIT, &payload);
}

static void begin(hub_t *self, const frame_t *frame)
{
    message_start_t start;
    message_begin_t body;
    message_hello_t hello = {.credit = HUB_CREDIT,
                             .version = {JCAL_VERSION_MAJOR, JCAL_VERSION_MINOR, JCAL_VERSION_PATCH}};
    bool accepted = false;
    if (frame->type == FRAME_START) {
        (void)message_read_start(frame, &start);
        hello.nonce = start.nonce;
        accepted = hub_pair_begin(&self->of.pair, &start);
        self->session = accepted ? HUB_PAIR : HUB_NO_SESSION;
    } else {
        (void)message_read_begin(frame, &body);
        hello.nonce = body.nonce;
        accepted = hub_body_begin(&self->of.body, &body, self->has_flash ? &self->flash : NULL);
        self->session = accepted ? HUB_BODY : HUB_NO_SESSION;
    }
    hello.refused = !accepted;
    self->out.sequence = 0;
    self->strange = 0;
    self->limit = frame->sequence + 1u + HUB_CREDIT;
    frame_writer_t payload;
    message_write_hello(&payload, &hello);
    hub_out_put(&self->out, FRAME_HELLO, &payload);
}

static void take_pair(hub_t *self, const frame_t *frame)
{
    jcal_pair_t pair;
    uint32_t token = 0;
    if (frame->type == FRAME_SAMPLE && message_read_sample(frame, &pair)) {
        if (hub_pair_sample(&self->of.pair, &self->out, &pair)) {
            answer_counters(self, 0);
        }
    } else if (frame->type == FRAME_REQUEST && message_read_number(frame, &token)) {
        hub_pair_estimate(&self->of.pair, &self->out, MESSAGE_EVENT_REQUESTED, token);
        answer_counters(self, token);
    } else {
        self->strange++;
    }
    give_credit(self);
}

static void take_body(hub_t *self, const frame_t *frame, uint64_t now_us)
{
    if (!hub_body_take(&self->of.body, frame, now_us)) {
        self->strange++;
    }
    if (self->of.body.phase == HUB_BODY_IDLE) {
        give_credit(self);
    }
}

/* The next frame of the queue. */
static void work_off(hub_t *self)
{
    const hub_item_t *const slot = &self->queue[self->taken % HUB_QUEUE];
    const hub_item_t item = *slot;
    __atomic_signal_fence(__ATOMIC_RELEASE); /* the copy is whole before its place is free */
    self->taken = self->taken + 1u;
    const frame_t frame = {.version = FRAME_VERSION,
                           .type = item.type,
                           .sequence = item.sequence,
                           .payload = item.payload,
                           .size = item.size};
    self->item_sequence = item.sequence;
    if (item.type == FRAME_START || item.type == FRAME_BEGIN) {
        begin(self, &frame);
    } else if (self->session == HUB_PAIR) {
        take_pair(self, &frame);
    } else if (self->session == HUB_BODY) {
        take_body(self, &frame, item.now_us);
    } else {
        /* refused: only another start helps */
    }
}

static bool is_busy(const hub_t *self)
{
    return self->session == HUB_BODY && self->of.body.phase != HUB_BODY_IDLE;
}

/* A hub whose clock goes on works without packets, too: sensors that fall silent are missed. */
static bool is_passing(const hub_t *self)
{
    const hub_body_t *const body = &self->of.body;
    return self->session == HUB_BODY && body->running && body->is_live && time_of(self) > body->now_us + PASS_US;
}

/* What is granted and has not come would be lost while the processor is deaf. Requests may go beyond. */
static bool may_write(const hub_t *self)
{
    const uint32_t beyond = self->link.next - self->limit;
    return !self->flash_is_deaf || beyond < UINT32_MAX / 2u || self->now_low - self->heard_us > QUIET_US;
}

static void work_body(hub_t *self)
{
    hub_body_t *const body = &self->of.body;
    if (hub_body_counts(body)) {
        answer_counters(self, body->token);
        hub_body_counted(body);
    } else if (hub_body_is_to_write(body)) {
        if (may_write(self)) {
            hub_body_write(body);
        }
        self->is_held = hub_body_is_to_write(body);
    } else {
        (void)hub_body_work(body, &self->out);
    }
    if (body->phase == HUB_BODY_IDLE) {
        give_credit(self);
    }
}

static void refuse_version(hub_t *self)
{
    frame_writer_t payload;
    message_write_other_version(&payload, self->refused_version);
    self->refused_version = 0;
    hub_out_put(&self->out, FRAME_OTHER_VERSION, &payload);
}

bool hub_waiting(const hub_t *self)
{
    if (is_busy(self)) {
        return self->refused_version != 0 || !self->is_held || may_write(self);
    }
    return self->refused_version != 0 || self->queued != self->taken || is_passing(self);
}

bool hub_work(hub_t *self)
{
    if (!hub_waiting(self) || hub_out_room(&self->out) < OUT_ROOM) {
        return false;
    }
    if (self->refused_version != 0) {
        refuse_version(self);
    } else if (is_busy(self)) {
        work_body(self);
    } else if (self->queued != self->taken) {
        work_off(self);
    } else {
        hub_body_pass(&self->of.body, time_of(self));
    }
    return true;
}

bool hub_send(hub_t *self, uint8_t *byte)
{
    if (self->out.taken == self->out.written) {
        return false;
    }
    *byte = self->out.bytes[self->out.taken % HUB_OUT_BYTES];
    self->out.taken++;
    return true;
}

uint32_t hub_send_count(const hub_t *self)
{
    return self->out.written - self->out.taken;
}
