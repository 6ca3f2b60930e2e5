/* SPDX-License-Identifier: MIT */
/* Frames between a sender of samples and a hub. See frame.h and docs/PROTOCOL.md. */
#include "frame.h"

#include <string.h>

uint32_t frame_crc32(const uint8_t *bytes, size_t size)
{
    /* Four bits at a time: 64 bytes of table instead of 1024, and fast enough for a UART. */
    static const uint32_t TABLE[16] = {0x00000000u, 0x1DB71064u, 0x3B6E20C8u, 0x26D930ACu, 0x76DC4190u, 0x6B6B51F4u,
                                       0x4DB26158u, 0x5005713Cu, 0xEDB88320u, 0xF00F9344u, 0xD6D6A3E8u, 0xCB61B38Cu,
                                       0x9B64C2B0u, 0x86D3D2D4u, 0xA00AE278u, 0xBDBDF21Cu};
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t k = 0; k < size; k++) {
        crc ^= bytes[k];
        crc = (crc >> 4) ^ TABLE[crc & 15u];
        crc = (crc >> 4) ^ TABLE[crc & 15u];
    }
    return crc ^ 0xFFFFFFFFu;
}

static void put_u32(uint8_t *at, uint32_t value)
{
    for (unsigned k = 0; k < 4u; k++) {
        at[k] = (uint8_t)(value >> (8u * k));
    }
}

static uint32_t get_u32(const uint8_t *at)
{
    uint32_t value = 0;
    for (unsigned k = 0; k < 4u; k++) {
        value |= (uint32_t)at[k] << (8u * k);
    }
    return value;
}

/* Consistent overhead byte stuffing: every zero becomes the distance to the next one. The input is shorter than 254 bytes,
 * so that no group is ever full. */
static size_t stuff(uint8_t *wire, const uint8_t *bytes, size_t size)
{
    size_t group = 0;
    for (size_t k = 0; k < size; k++) {
        wire[k + 1u] = bytes[k];
        if (bytes[k] == 0) {
            wire[group] = (uint8_t)(k + 1u - group);
            group = k + 1u;
        }
    }
    wire[group] = (uint8_t)(size + 1u - group);
    wire[size + 1u] = 0;
    return size + 2u;
}

size_t frame_encode(uint8_t wire[FRAME_WIRE_MAX], frame_type_t type, uint32_t sequence, const uint8_t *payload,
                    size_t size)
{
    uint8_t bytes[FRAME_MAX];
    if (size > FRAME_PAYLOAD_MAX) {
        return 0;
    }
    bytes[0] = FRAME_VERSION;
    bytes[1] = (uint8_t)type;
    put_u32(&bytes[2], sequence);
    if (size > 0) {
        memcpy(&bytes[FRAME_HEAD_BYTES], payload, size);
    }
    put_u32(&bytes[FRAME_HEAD_BYTES + size], frame_crc32(bytes, FRAME_HEAD_BYTES + size));
    return stuff(wire, bytes, FRAME_HEAD_BYTES + size + FRAME_CRC_BYTES);
}

static void keep(frame_decoder_t *self, uint8_t byte)
{
    if (self->size < sizeof self->bytes) {
        self->bytes[self->size] = byte;
        self->size++;
    } else {
        self->overflowed = true;
    }
}

/* A zero came: is what was collected a frame? */
static frame_event_t finish(const frame_decoder_t *self, frame_t *frame)
{
    if (!self->begun) {
        return FRAME_NONE;
    }
    if (self->left > 0 || self->overflowed || self->size < FRAME_HEAD_BYTES + FRAME_CRC_BYTES) {
        return FRAME_BAD;
    }
    const size_t body = self->size - FRAME_CRC_BYTES;
    if (frame_crc32(self->bytes, body) != get_u32(&self->bytes[body])) {
        return FRAME_BAD;
    }
    frame->version = self->bytes[0];
    frame->type = self->bytes[1];
    frame->sequence = get_u32(&self->bytes[2]);
    frame->payload = &self->bytes[FRAME_HEAD_BYTES];
    frame->size = body - FRAME_HEAD_BYTES;
    return FRAME_GOOD;
}

frame_event_t frame_decode(frame_decoder_t *self, uint8_t byte, frame_t *frame)
{
    if (byte == 0) {
        const frame_event_t event = finish(self, frame);
        self->size = 0;
        self->left = 0;
        self->zero_next = false;
        self->begun = false;
        self->overflowed = false;
        return event;
    }
    self->begun = true;
    if (self->left > 0) {
        keep(self, byte);
        self->left--;
        return FRAME_NONE;
    }
    if (self->zero_next) {
        keep(self, 0);
    }
    self->left = (uint8_t)(byte - 1u);
    self->zero_next = byte != 0xFFu; /* a full group stands for no zero */
    return FRAME_NONE;
}

void frame_link_start(frame_link_t *self, uint32_t sequence)
{
    *self = (frame_link_t){.counts = {.received = 1, .taken = 1}, .next = sequence + 1u};
}

static frame_order_t count_ahead(frame_link_t *self, uint32_t ahead)
{
    self->counts.lost += ahead;
    self->counts.taken++;
    self->next += ahead + 1u;
    /* The numbers that were passed over are missing, the newest is not. */
    if (ahead + 1u >= FRAME_HISTORY) {
        self->missing = UINT64_MAX - 1u;
    } else {
        self->missing = (self->missing << (ahead + 1u)) | (((UINT64_C(1) << ahead) - 1u) << 1u);
    }
    return FRAME_TAKEN;
}

frame_order_t frame_link_count(frame_link_t *self, uint32_t sequence)
{
    const uint32_t ahead = sequence - self->next;
    self->counts.received++;
    if (ahead < UINT32_C(0x80000000)) {
        return count_ahead(self, ahead);
    }
    const uint32_t behind = self->next - 1u - sequence;
    if (behind >= FRAME_HISTORY) {
        self->counts.stale++;
        return FRAME_STALE;
    }
    const uint64_t bit = UINT64_C(1) << behind;
    if ((self->missing & bit) == 0) {
        self->counts.repeated++;
        return FRAME_REPEATED;
    }
    self->missing &= ~bit;
    self->counts.lost--;
    self->counts.reordered++;
    return FRAME_REORDERED;
}

void frame_write_begin(frame_writer_t *self)
{
    self->size = 0;
    self->ok = true;
}

static void write_number(frame_writer_t *self, uint64_t value, size_t bytes)
{
    if (!self->ok || self->size + bytes > sizeof self->bytes) {
        self->ok = false;
        return;
    }
    for (size_t k = 0; k < bytes; k++) {
        self->bytes[self->size + k] = (uint8_t)(value >> (8u * k));
    }
    self->size += bytes;
}

void frame_write_u8(frame_writer_t *self, uint8_t value)
{
    write_number(self, value, 1);
}

void frame_write_u16(frame_writer_t *self, uint16_t value)
{
    write_number(self, value, 2);
}

void frame_write_u32(frame_writer_t *self, uint32_t value)
{
    write_number(self, value, 4);
}

void frame_write_u64(frame_writer_t *self, uint64_t value)
{
    write_number(self, value, 8);
}

void frame_write_f32(frame_writer_t *self, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    write_number(self, bits, 4);
}

void frame_write_bytes(frame_writer_t *self, const uint8_t *bytes, size_t size)
{
    for (size_t k = 0; k < size; k++) {
        write_number(self, bytes[k], 1);
    }
}

void frame_write_text(frame_writer_t *self, const char *text, size_t size)
{
    const size_t length = strlen(text);
    for (size_t k = 0; k < size; k++) {
        write_number(self, (k < length) ? (uint8_t)text[k] : 0u, 1);
    }
}

frame_reader_t frame_read_begin(const frame_t *frame)
{
    return (frame_reader_t){.bytes = frame->payload, .size = frame->size, .at = 0, .ok = true};
}

static uint64_t read_number(frame_reader_t *self, size_t bytes)
{
    if (!self->ok || self->size - self->at < bytes) {
        self->ok = false;
        return 0;
    }
    uint64_t value = 0;
    for (size_t k = 0; k < bytes; k++) {
        value |= (uint64_t)self->bytes[self->at + k] << (8u * k);
    }
    self->at += bytes;
    return value;
}

uint8_t frame_read_u8(frame_reader_t *self)
{
    return (uint8_t)read_number(self, 1);
}

uint16_t frame_read_u16(frame_reader_t *self)
{
    return (uint16_t)read_number(self, 2);
}

uint32_t frame_read_u32(frame_reader_t *self)
{
    return (uint32_t)read_number(self, 4);
}

uint64_t frame_read_u64(frame_reader_t *self)
{
    return read_number(self, 8);
}

float frame_read_f32(frame_reader_t *self)
{
    const uint32_t bits = (uint32_t)read_number(self, 4);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

void frame_read_bytes(frame_reader_t *self, uint8_t *bytes, size_t size)
{
    for (size_t k = 0; k < size; k++) {
        bytes[k] = (uint8_t)read_number(self, 1);
    }
}

void frame_read_text(frame_reader_t *self, char *text, size_t size)
{
    for (size_t k = 0; k < size; k++) {
        const uint8_t byte = (uint8_t)read_number(self, 1);
        text[k] = (byte == 0 || (byte >= 0x20u && byte < 0x7Fu)) ? (char)byte : '?';
    }
    text[size] = 0;
}

size_t frame_read_left(const frame_reader_t *self)
{
    return self->size - self->at;
}

bool frame_read_all(const frame_reader_t *self)
{
    return self->ok && self->at == self->size;
}
