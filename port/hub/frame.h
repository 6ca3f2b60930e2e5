/* SPDX-License-Identifier: MIT */
/// @file
/// Frames between a sender of samples and a hub: COBS, CRC-32, sequence numbers. Specification: docs/PROTOCOL.md.
///
/// Nothing here waits, allocates or knows a platform; all state is in structs of the caller. Bytes are decoded one by one,
/// so that a UART's interrupt can do it.
#ifndef JCAL_HUB_FRAME_H
#define JCAL_HUB_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// First byte of every frame. Another number means another protocol.
#define FRAME_VERSION 3u

/// Version, type, sequence number before the payload; CRC behind it.
#define FRAME_HEAD_BYTES 6u
#define FRAME_CRC_BYTES 4u
#define FRAME_PAYLOAD_MAX 206u
#define FRAME_MAX (FRAME_HEAD_BYTES + FRAME_PAYLOAD_MAX + FRAME_CRC_BYTES)

/// On the wire: one byte of COBS, as frames are shorter than 254 bytes, and the zero that ends the frame.
#define FRAME_WIRE_MAX (FRAME_MAX + 2u)

typedef enum {
    /* To the hub. */
    FRAME_START = 0x01,     ///< Begins a pair session with this configuration.
    FRAME_SAMPLE = 0x02,    ///< A pair of readings.
    FRAME_REQUEST = 0x03,   ///< Answer with all states and counters.
    FRAME_BEGIN = 0x04,     ///< Begins a body session.
    FRAME_SENSOR = 0x05,    ///< A sensor of its table.
    FRAME_JOINT = 0x06,     ///< A joint of its table.
    FRAME_PACKET = 0x07,    ///< Readings of one sensor.
    FRAME_TIME = 0x08,      ///< Nothing came until then.
    FRAME_PUT_KEPT = 0x09,  ///< A record into flash.
    FRAME_GET_KEPT = 0x0a,  ///< A record out of flash.
    FRAME_FORGET = 0x0b,    ///< A record, or all, out of the way.
    FRAME_SLEEP = 0x0c,     ///< A joint's estimator only watches, or works.
    /* From the hub. */
    FRAME_HELLO = 0x81,         ///< Answer to start and begin.
    FRAME_ESTIMATE = 0x82,      ///< Pair session: the result.
    FRAME_COUNTERS = 0x83,      ///< What became of the frames and samples.
    FRAME_CREDIT = 0x84,        ///< How far the sender may go.
    FRAME_TABLE = 0x85,         ///< The table is complete, and right or refused.
    FRAME_EVENT = 0x86,         ///< Something happened.
    FRAME_JOINT_STATE = 0x87,   ///< What is known of a joint.
    FRAME_SENSOR_STATE = 0x88,  ///< What became of a sensor.
    FRAME_BODY_STATE = 0x89,    ///< What became of the body.
    FRAME_FLEXIONS = 0x8a,      ///< Angles of hinges.
    FRAME_ORIENTATIONS = 0x8b,  ///< Orientations of sensor 2 in sensor 1 of the other joints.
    FRAME_ADVICE = 0x8c,        ///< What to do next.
    FRAME_KEPT = 0x8d,          ///< Answer to put, get and forget.
    FRAME_OTHER_VERSION = 0x8e  ///< The other side speaks another version.
} frame_type_t;

/// A frame that passed its check; the payload points into the decoder and lives until its next byte.
typedef struct {
    uint8_t version;
    uint8_t type;
    uint32_t sequence;
    const uint8_t *payload;
    size_t size;
} frame_t;

/// CRC-32 of IEEE 802.3: reflected, polynomial 0xEDB88320, start and final inversion.
uint32_t frame_crc32(const uint8_t *bytes, size_t size);

/// Writes a whole frame with its final zero; returns its length on the wire, 0 if the payload is too long.
size_t frame_encode(uint8_t wire[FRAME_WIRE_MAX], frame_type_t type, uint32_t sequence, const uint8_t *payload,
                    size_t size);

typedef enum {
    FRAME_NONE = 0,  ///< The frame is not complete yet.
    FRAME_GOOD = 1,  ///< A frame came to its end and its CRC is right.
    FRAME_BAD = 2    ///< Bytes came to their end that are no frame.
} frame_event_t;

/// Decoder. All zero is its start.
typedef struct {
    uint8_t bytes[FRAME_MAX];
    size_t size;
    uint8_t left;     ///< Bytes of the COBS group that are still to come.
    bool zero_next;   ///< A zero stands between this group and the next.
    bool begun;       ///< There were bytes since the last zero.
    bool overflowed;  ///< More bytes than any frame has.
} frame_decoder_t;

/// Takes in one byte. After FRAME_GOOD, `frame` is set.
frame_event_t frame_decode(frame_decoder_t *self, uint8_t byte, frame_t *frame);

/// How many sequence numbers back a late frame is still told from a repeated one.
#define FRAME_HISTORY 64u

/// What became of the frames of one direction; docs/PROTOCOL.md defines each number.
typedef struct {
    uint32_t received;   ///< Frames with a right CRC; the sum of taken, repeated, reordered and stale.
    uint32_t taken;      ///< Frames that came in order, gaps allowed: only these are used.
    uint32_t lost;       ///< Sequence numbers that never came; one that comes late is taken off again.
    uint32_t repeated;   ///< Frames whose number had come before.
    uint32_t corrupted;  ///< Pieces between zeros that are no frame.
    uint32_t reordered;  ///< Frames that came after a later one; not used.
    uint32_t stale;      ///< Frames more than FRAME_HISTORY numbers late.
} frame_counts_t;

/// Follows the sequence numbers of one direction.
typedef struct {
    frame_counts_t counts;
    uint32_t next;     ///< The number that comes next if nothing is lost.
    uint64_t missing;  ///< Bit k: number next - 1 - k has not come.
} frame_link_t;

typedef enum { FRAME_TAKEN, FRAME_REPEATED, FRAME_REORDERED, FRAME_STALE } frame_order_t;

/// Counters to zero; the frame with this number has come and counts as taken.
void frame_link_start(frame_link_t *self, uint32_t sequence);

/// Counts a frame by its number.
frame_order_t frame_link_count(frame_link_t *self, uint32_t sequence);

/// Writes numbers into a payload, least significant byte first. Beyond the end it writes nothing and `ok` becomes false.
typedef struct {
    uint8_t bytes[FRAME_PAYLOAD_MAX];
    size_t size;
    bool ok;
} frame_writer_t;

void frame_write_begin(frame_writer_t *self);
void frame_write_u8(frame_writer_t *self, uint8_t value);
void frame_write_u16(frame_writer_t *self, uint16_t value);
void frame_write_u32(frame_writer_t *self, uint32_t value);
void frame_write_u64(frame_writer_t *self, uint64_t value);
void frame_write_f32(frame_writer_t *self, float value);
void frame_write_bytes(frame_writer_t *self, const uint8_t *bytes, size_t size);
/// `size` bytes: the text, cut if it is longer, and zeros.
void frame_write_text(frame_writer_t *self, const char *text, size_t size);

/// Reads them again. Beyond the end it gives zeros and `ok` becomes false.
typedef struct {
    const uint8_t *bytes;
    size_t size;
    size_t at;
    bool ok;
} frame_reader_t;

frame_reader_t frame_read_begin(const frame_t *frame);
uint8_t frame_read_u8(frame_reader_t *self);
uint16_t frame_read_u16(frame_reader_t *self);
uint32_t frame_read_u32(frame_reader_t *self);
uint64_t frame_read_u64(frame_reader_t *self);
float frame_read_f32(frame_reader_t *self);
void frame_read_bytes(frame_reader_t *self, uint8_t *bytes, size_t size);
/// `size` bytes into a text of size + 1, with a zero behind; what is no printable ASCII becomes '?'.
void frame_read_text(frame_reader_t *self, char *text, size_t size);
/// Bytes that are left.
size_t frame_read_left(const frame_reader_t *self);

/// True if everything was there and nothing is left.
bool frame_read_all(const frame_reader_t *self);

#endif
