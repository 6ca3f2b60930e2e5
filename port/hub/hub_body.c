/* SPDX-License-Identifier: MIT */
/* A body session of the hub. See hub_body.h. */
#include "hub_body.h"

#include "jointcal/keep_flash.h"

#include <string.h>

/* ---- The table ---- */

static uint32_t all_of(unsigned count)
{
    return (UINT32_C(1) << count) - 1u;
}

static bool refuse(hub_body_t *self, const char *what, unsigned at)
{
    self->has_refused = true;
    self->table_answer.refused = true;
    self->table_answer.at = (uint8_t)at;
    (void)strncpy(self->table_answer.what, what, MESSAGE_WHAT_BYTES);
    self->phase = HUB_BODY_TABLE;
    return false;
}

/* True the first time that this number comes. */
static bool is_new(hub_body_t *self, uint32_t *has, unsigned number, unsigned count)
{
    if (number >= count || (*has & (UINT32_C(1) << number)) != 0) {
        return refuse(self, "twice", number);
    }
    *has |= UINT32_C(1) << number;
    return true;
}

/* As many packets as there is room for: a power of two. */
static uint16_t packets_of(uint8_t per_packet)
{
    uint16_t packets = 2u;
    while (packets < 256u &&
           JCAL_PACKETS_STORAGE_BYTES(2u * packets, per_packet, JCAL_PACKET_RAW) <= HUB_PACKETS_BYTES) {
        packets = (uint16_t)(2u * packets);
    }
    return packets;
}

static void put_sensor(hub_body_t *self, const message_sensor_t *sensor)
{
    if (!is_new(self, &self->has_sensors, sensor->number, self->begin.sensors)) {
        return;
    }
    const unsigned n = sensor->number;
    self->packets[n] = sensor->packets;
    self->packets[n].packets = packets_of(sensor->packets.per_packet);
    memcpy(self->names[n], sensor->name, sizeof sensor->name);
    self->sensors[n] = (jcal_body_sensor_spec_t){.name = (sensor->name[0] != 0) ? self->names[n] : NULL,
                                                 .packets = &self->packets[n],
                                                 .storage = self->storage[n],
                                                 .storage_bytes = HUB_PACKETS_BYTES,
                                                 .serial = sensor->serial};
    const char *wrong = jcal_packet_config_check(&self->packets[n]);
    if (wrong != NULL) {
        (void)refuse(self, wrong, n);
    }
}

static void put_joint(hub_body_t *self, const message_joint_t *joint)
{
    if (!is_new(self, &self->has_joints, joint->number, self->begin.joints)) {
        return;
    }
    const unsigned n = joint->number;
    char *const name = self->names[HUB_SENSORS + n];
    memcpy(name, joint->name, sizeof joint->name);
    self->max_bound_rad[n] = joint->max_bound_rad;
    self->joints[n] = (jcal_body_joint_spec_t){.name = (name[0] != 0) ? name : NULL,
                                               .proximal = joint->proximal,
                                               .distal = joint->distal,
                                               .kind = (jcal_body_kind_t)joint->kind};
}

/* Prepares the estimator of a joint; false if its settings are refused. A kind that there is not is the table's to refuse. */
static bool begin_engine(hub_body_t *self, unsigned n)
{
    jcal_body_joint_spec_t *const joint = &self->joints[n];
    hub_engine_t *const engine = &self->engines[n];
    const float bound = self->max_bound_rad[n];
    const bool has_bound = !(bound == 0.0f);
    if (joint->kind == JCAL_BODY_HINGE) {
        jcal_functional_config_t config = jcal_functional_config_default();
        config.max_bound_rad = has_bound ? bound : config.max_bound_rad;
        joint->engine.hinge = &engine->hinge;
        return jcal_functional_init(&engine->hinge, &config) == JCAL_OK;
    }
    if (joint->kind == JCAL_BODY_BALL) {
        const jcal_ball_config_t config = jcal_ball_config_default();
        joint->engine.ball = &engine->ball;
        return jcal_ball_init(&engine->ball, &config) == JCAL_OK;
    }
    jcal_two_axes_config_t config = jcal_two_axes_config_default();
    config.max_bound_rad = has_bound ? bound : config.max_bound_rad;
    joint->engine.two_axes = &engine->two_axes;
    return jcal_two_axes_init(&engine->two_axes, &config) == JCAL_OK;
}

/* All of the table has come. */
static void begin_table(hub_body_t *self)
{
    for (unsigned n = 0; n < self->begin.joints; n++) {
        if (!begin_engine(self, n)) {
            (void)refuse(self, "max_bound_rad", n);
            return;
        }
    }
    const uint8_t flags = self->begin.flags;
    const jcal_body_table_t table = {.sensors = self->sensors,
                                     .sensor_states = self->sensor_states,
                                     .sensor_count = self->begin.sensors,
                                     .joints = self->joints,
                                     .joint_states = self->joint_states,
                                     .joint_count = self->begin.joints,
                                     .shared = ((flags & MESSAGE_LAGS) != 0) ? &self->shared : NULL,
                                     .health = ((flags & MESSAGE_EXAMINE) != 0) ? &self->health : NULL,
                                     .flash = ((flags & MESSAGE_KEEP) != 0) ? self->flash : NULL};
    const jcal_body_config_t config = jcal_body_config_default();
    unsigned at = 0;
    const char *wrong = jcal_body_table_check(&table, &at);
    if (wrong == NULL && jcal_body_init(&self->body, &table, &config) != JCAL_OK) {
        wrong = "storage";
    }
    if (wrong != NULL) {
        (void)refuse(self, wrong, at);
        return;
    }
    self->running = true;
    self->table_answer.at = MESSAGE_ALL;
    self->phase = HUB_BODY_TABLE;
}

/* Once, when the last of the table has come. */
static void end_table(hub_body_t *self)
{
    if (!self->running && !self->has_refused && self->has_sensors == all_of(self->begin.sensors) &&
        self->has_joints == all_of(self->begin.joints)) {
        begin_table(self);
    }
}

bool hub_body_begin(hub_body_t *self, const message_begin_t *begin, const jcal_flash_t *flash)
{
    memset(self, 0, sizeof *self);
    self->begin = *begin;
    self->flash = flash;
    if (begin->sensors > HUB_SENSORS || begin->joints > HUB_JOINTS) {
        return false;
    }
    end_table(self); /* an empty one is complete at once */
    return true;
}

/* ---- Messages ---- */

/* Whatever time it is, states are due a first time one period later. */
static void begin_work(hub_body_t *self, uint64_t now_us)
{
    self->now_us = now_us;
    if (!self->has_time) {
        self->has_time = true;
        self->next_us = now_us + self->begin.every_us;
    }
    self->phase = HUB_BODY_STEP;
}

void hub_body_pass(hub_body_t *self, uint64_t now_us)
{
    if (self->running && self->phase == HUB_BODY_IDLE) {
        begin_work(self, now_us);
    }
}

static void take_packet(hub_body_t *self, const message_packet_t *packet, uint64_t now_us)
{
    const bool is_live = packet->arrival_us == MESSAGE_ARRIVAL_NOW;
    const uint64_t arrival_us = is_live ? now_us : packet->arrival_us;
    const jcal_packet_t of = {
        .arrival_us = arrival_us, .counter = packet->counter, .count = packet->count, .raw = packet->raw};
    if (!self->running || packet->sensor >= self->begin.sensors) {
        return;
    }
    if (jcal_body_push(&self->body, packet->sensor, &of) == JCAL_OK) {
        self->pushed++;
    }
    self->is_live = is_live;
    begin_work(self, arrival_us);
}

static void answer_kept(hub_body_t *self, uint32_t token, unsigned joint, unsigned refusal)
{
    self->kept.token = token;
    self->kept.joint = (uint8_t)joint;
    self->kept.refusal = (uint8_t)refusal;
    self->phase = HUB_BODY_ANSWER;
}

/* What is wrong is answered at once; what is right waits until flash may be written. */
static void put_kept(hub_body_t *self, const message_put_kept_t *put)
{
    jcal_kept_t kept;
    memset(self->kept.bytes, 0, sizeof self->kept.bytes);
    jcal_kept_refusal_t refusal = jcal_kept_decode(put->bytes, NULL, &kept);
    if (refusal == JCAL_KEPT_FITS && kept.joint >= HUB_JOINTS) {
        refusal = JCAL_KEPT_NONE; /* there is no such place */
    }
    answer_kept(self, put->token, MESSAGE_ALL, refusal);
    if (refusal == JCAL_KEPT_FITS) {
        memcpy(self->kept.bytes, put->bytes, sizeof self->kept.bytes);
        self->kept.joint = kept.joint;
        self->writes_put = true;
        self->phase = HUB_BODY_WRITE;
    }
}

/* The answer has the record with the number that this write gave it. */
static void write_put(hub_body_t *self)
{
    jcal_kept_t kept;
    jcal_keep_writer_t writer;
    const bool written = self->flash != NULL && jcal_kept_decode(self->kept.bytes, NULL, &kept) == JCAL_KEPT_FITS &&
                         jcal_keep_begin(&writer, self->flash, HUB_JOINTS) == JCAL_OK &&
                         jcal_keep_put(&writer, &kept) == JCAL_OK && jcal_keep_commit(&writer) == JCAL_OK &&
                         jcal_keep_read(self->flash, kept.joint, &kept) == JCAL_KEPT_FITS &&
                         jcal_kept_encode(&kept, self->kept.bytes) == JCAL_OK;
    if (!written) {
        memset(self->kept.bytes, 0, sizeof self->kept.bytes);
    }
    answer_kept(self, self->kept.token, self->kept.joint, written ? MESSAGE_KEPT_WRITTEN : MESSAGE_KEPT_FLASH_FAILED);
}

static void get_kept(hub_body_t *self, const message_ask_kept_t *ask)
{
    jcal_kept_t kept;
    memset(self->kept.bytes, 0, sizeof self->kept.bytes);
    if (self->flash == NULL) {
        answer_kept(self, ask->token, ask->joint, MESSAGE_KEPT_FLASH_FAILED);
        return;
    }
    jcal_kept_refusal_t refusal =
        (ask->joint < HUB_JOINTS) ? jcal_keep_read(self->flash, ask->joint, &kept) : JCAL_KEPT_NONE;
    if (refusal == JCAL_KEPT_FITS && jcal_kept_encode(&kept, self->kept.bytes) != JCAL_OK) {
        refusal = JCAL_KEPT_DAMAGED;
    }
    answer_kept(self, ask->token, ask->joint, refusal);
}

static void forget(hub_body_t *self, const message_ask_kept_t *ask)
{
    memset(self->kept.bytes, 0, sizeof self->kept.bytes);
    if (ask->joint < HUB_JOINTS || ask->joint == MESSAGE_ALL) {
        self->kept.token = ask->token;
        self->kept.joint = ask->joint;
        self->writes_put = false;
        self->phase = HUB_BODY_WRITE;
    } else {
        answer_kept(self, ask->token, ask->joint, JCAL_KEPT_NONE);
    }
}

static void write_without(hub_body_t *self)
{
    jcal_keep_writer_t writer;
    const uint8_t joint = self->kept.joint;
    bool written = self->flash != NULL && jcal_keep_begin(&writer, self->flash, HUB_JOINTS) == JCAL_OK;
    for (unsigned n = 0; written && n < HUB_JOINTS; n++) {
        if (joint == MESSAGE_ALL || joint == n) {
            written = jcal_keep_drop(&writer, n) == JCAL_OK;
        }
    }
    written = written && jcal_keep_commit(&writer) == JCAL_OK;
    answer_kept(self, self->kept.token, joint, written ? MESSAGE_KEPT_FORGOTTEN : MESSAGE_KEPT_FLASH_FAILED);
}

static bool take_table(hub_body_t *self, const frame_t *frame)
{
    union {
        message_sensor_t sensor;
        message_joint_t joint;
    } in;
    if (frame->type == FRAME_SENSOR && message_read_sensor(frame, &in.sensor)) {
        if (!self->running && !self->has_refused) {
            put_sensor(self, &in.sensor);
        }
    } else if (frame->type == FRAME_JOINT && message_read_joint(frame, &in.joint)) {
        if (!self->running && !self->has_refused) {
            put_joint(self, &in.joint);
        }
    } else {
        return false;
    }
    end_table(self);
    return true;
}

static bool take_kept(hub_body_t *self, const frame_t *frame)
{
    message_put_kept_t put;
    message_ask_kept_t ask;
    if (frame->type == FRAME_PUT_KEPT && message_read_put_kept(frame, &put)) {
        put_kept(self, &put);
    } else if (frame->type == FRAME_GET_KEPT && message_read_ask_kept(frame, &ask)) {
        get_kept(self, &ask);
    } else if (frame->type == FRAME_FORGET && message_read_ask_kept(frame, &ask)) {
        forget(self, &ask);
    } else {
        return false;
    }
    return true;
}

bool hub_body_take(hub_body_t *self, const frame_t *frame, uint64_t now_us)
{
    message_packet_t packet;
    message_sleep_t sleep;
    uint64_t time_us = 0;
    if (frame->type == FRAME_PACKET && message_read_packet(frame, &packet)) {
        take_packet(self, &packet, now_us);
    } else if (frame->type == FRAME_TIME && message_read_time(frame, &time_us)) {
        hub_body_pass(self, time_us);
    } else if (frame->type == FRAME_REQUEST && message_read_number(frame, &self->token)) {
        self->is_asked = true;
        self->phase = self->running ? HUB_BODY_STATES : HUB_BODY_COUNTERS;
        self->at = 0;
    } else if (frame->type == FRAME_SLEEP && message_read_sleep(frame, &sleep)) {
        if (self->running && sleep.joint < self->begin.joints) {
            (void)jcal_body_sleep(&self->body, sleep.joint, sleep.asleep);
        }
    } else {
        return take_table(self, frame) || take_kept(self, frame);
    }
    return true;
}

/* ---- Work and answers ---- */

bool hub_body_counts(const hub_body_t *self)
{
    return self->phase == HUB_BODY_COUNTERS;
}

/* After the answer to a request there is nothing else; after states that were due come angles. */
void hub_body_counted(hub_body_t *self)
{
    self->phase = self->is_asked ? HUB_BODY_IDLE : HUB_BODY_ANGLES;
    self->is_asked = false;
    self->token = 0;
    self->at = 0;
}

/* True once per period. A clock that went back begins a period anew. */
static bool is_due(uint64_t now_us, uint64_t every_us, uint64_t *next_us)
{
    if (*next_us > now_us && *next_us - now_us > every_us) {
        *next_us = now_us + every_us;
    }
    if (every_us == 0 || now_us < *next_us) {
        return false;
    }
    *next_us += every_us * (1u + (now_us - *next_us) / every_us);
    return true;
}

static void send_event(hub_body_t *self, hub_out_t *out)
{
    jcal_body_event_t event;
    frame_writer_t payload;
    if (jcal_body_event(&self->body, &event) == JCAL_OK) {
        message_write_event(&payload, &event);
        hub_out_put(out, FRAME_EVENT, &payload);
        return;
    }
    self->token = 0;
    self->at = 0;
    self->phase = is_due(self->now_us, self->begin.every_us, &self->next_us) ? HUB_BODY_STATES : HUB_BODY_ANGLES;
}

static void send_body(hub_body_t *self, hub_out_t *out)
{
    message_body_state_t state = {.token = self->token};
    frame_writer_t payload;
    (void)jcal_body_status(&self->body, &state.status);
    state.writes = (self->flash != NULL) ? jcal_keep_writes(self->flash) : 0u;
    message_write_body_state(&payload, &state);
    hub_out_put(out, FRAME_BODY_STATE, &payload);
    self->phase = HUB_BODY_SENSORS;
}

static void send_sensor(hub_body_t *self, hub_out_t *out)
{
    message_sensor_state_t state = {.token = self->token, .sensor = self->at};
    frame_writer_t payload;
    (void)jcal_body_sensor(&self->body, self->at, &state.result);
    message_write_sensor_state(&payload, &state);
    hub_out_put(out, FRAME_SENSOR_STATE, &payload);
    self->at++;
    if (self->at == self->begin.sensors) {
        self->at = 0;
        self->phase = HUB_BODY_JOINTS;
    }
}

static void send_joint(hub_body_t *self, hub_out_t *out)
{
    message_joint_state_t state = {.token = self->token, .joint = self->at};
    frame_writer_t payload;
    (void)jcal_body_joint(&self->body, self->at, &state.result);
    state.asleep = jcal_body_sleeps(&self->body, self->at);
    message_write_joint_state(&payload, &state);
    hub_out_put(out, FRAME_JOINT_STATE, &payload);
    self->at++;
    if (self->at == self->begin.joints) {
        self->at = 0;
        self->phase = HUB_BODY_ADVICE;
    }
}

static void send_advice(hub_body_t *self, hub_out_t *out)
{
    message_advice_t advice;
    frame_writer_t payload;
    memset(&advice, 0, sizeof advice);
    (void)jcal_body_advice(&self->body, &advice.advice);
    (void)jcal_body_sentence(&self->body, &advice.advice, advice.text, sizeof advice.text);
    message_write_advice(&payload, &advice);
    hub_out_put(out, FRAME_ADVICE, &payload);
    self->phase = HUB_BODY_COUNTERS;
}

/* Angles of hinges in one message, of the other joints from `at` on in as many as it takes. False: there are none left. */
static void send_flexions(hub_body_t *self, hub_out_t *out, uint64_t t_us)
{
    message_flexions_t flexions = {.t_us = t_us};
    frame_writer_t payload;
    for (unsigned n = 0; n < self->begin.joints; n++) {
        jcal_body_joint_result_t result;
        (void)jcal_body_joint(&self->body, n, &result);
        if (result.flexion_rad == result.flexion_rad) { /* not NaN */
            flexions.of[flexions.count++] =
                (message_flexion_t){(uint8_t)n, result.flexion_rad, result.flexion_bound_rad};
        }
    }
    message_write_flexions(&payload, &flexions);
    hub_out_put(out, FRAME_FLEXIONS, &payload);
}

static void send_orientations(hub_body_t *self, hub_out_t *out, uint64_t t_us)
{
    message_orientations_t turns = {.t_us = t_us};
    frame_writer_t payload;
    while (self->at <= self->begin.joints && turns.count < MESSAGE_ORIENTATIONS) {
        jcal_body_joint_result_t result;
        const unsigned n = self->at - 1u; /* 0 is that of the flexions */
        (void)jcal_body_joint(&self->body, n, &result);
        if (result.relative.w == result.relative.w) {
            turns.of[turns.count++] = (message_orientation_t){(uint8_t)n, result.relative, result.relative_bound_rad};
        }
        self->at++;
    }
    if (turns.count > 0) {
        message_write_orientations(&payload, &turns);
        hub_out_put(out, FRAME_ORIENTATIONS, &payload);
    }
}

static void send_angles(hub_body_t *self, hub_out_t *out)
{
    jcal_body_status_t status;
    (void)jcal_body_status(&self->body, &status);
    if (self->at == 0) {
        if (!self->has_angles_time) {
            self->has_angles_time = status.t_us != 0;
            self->next_angles_us = status.t_us;
        }
        if (!self->has_angles_time || !is_due(status.t_us, self->begin.angles_every_us, &self->next_angles_us)) {
            self->phase = HUB_BODY_KEEP;
            return;
        }
        send_flexions(self, out, status.t_us);
        self->at = 1u;
        return;
    }
    send_orientations(self, out, status.t_us);
    if (self->at > self->begin.joints) {
        self->at = 0;
        self->phase = HUB_BODY_KEEP;
    }
}

bool hub_body_is_to_write(hub_body_t *self)
{
    if (self->phase == HUB_BODY_KEEP && !jcal_body_keep_due(&self->body)) {
        self->phase = HUB_BODY_IDLE;
    }
    return self->phase == HUB_BODY_KEEP || self->phase == HUB_BODY_WRITE;
}

void hub_body_write(hub_body_t *self)
{
    if (self->phase == HUB_BODY_KEEP) {
        (void)jcal_body_keep(&self->body);
        self->phase = HUB_BODY_EVENTS; /* that it was written */
    } else if (self->writes_put) {
        write_put(self);
    } else {
        write_without(self);
    }
}

static void send_table(hub_body_t *self, hub_out_t *out)
{
    frame_writer_t payload;
    message_write_table(&payload, &self->table_answer);
    hub_out_put(out, FRAME_TABLE, &payload);
    self->phase = HUB_BODY_IDLE;
}

static void send_kept(hub_body_t *self, hub_out_t *out)
{
    frame_writer_t payload;
    message_write_kept(&payload, &self->kept);
    hub_out_put(out, FRAME_KEPT, &payload);
    self->phase = HUB_BODY_IDLE;
}

bool hub_body_work(hub_body_t *self, hub_out_t *out)
{
    switch (self->phase) {
    case HUB_BODY_TABLE:
        send_table(self, out);
        return true;
    case HUB_BODY_STEP:
        if (jcal_body_step(&self->body, self->now_us, HUB_UNITS) != JCAL_OK) {
            self->phase = HUB_BODY_EVENTS;
        }
        return true;
    case HUB_BODY_EVENTS:
        send_event(self, out);
        return true;
    case HUB_BODY_STATES:
        send_body(self, out);
        return true;
    case HUB_BODY_SENSORS:
        send_sensor(self, out);
        return true;
    case HUB_BODY_JOINTS:
        send_joint(self, out);
        return true;
    case HUB_BODY_ADVICE:
        send_advice(self, out);
        return true;
    case HUB_BODY_ANGLES:
        send_angles(self, out);
        return true;
    case HUB_BODY_ANSWER:
        send_kept(self, out);
        return true;
    case HUB_BODY_IDLE:
    case HUB_BODY_COUNTERS:
    case HUB_BODY_KEEP:
    case HUB_BODY_WRITE:
    default:
        return false;
    }
}
