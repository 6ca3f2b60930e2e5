/* SPDX-License-Identifier: MIT */
/* Feeds random and damaged frames to the decoder and counts how many it takes: run_frames [COUNT [SEED]].
 *
 * Four kinds in turn: random bytes between zeros; a right frame with its content replaced by random bytes; a right frame with 1
 * to 64 bits flipped; a right frame cut short, lengthened or with bytes exchanged. A frame that comes out as it went in is not
 * damaged and not counted. What is accepted beyond that got past the CRC, with odds of 2^-32 each. Prints one line per kind,
 * ends with 1 if chance does not explain the number. Built with sanitizers by tools/maintain/fuzz.sh. */
#include "frame.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KINDS = 4 };
static const char *const KIND_NAMES[KINDS] = {"random bytes", "random content", "flipped bits",
                                              "cut, grown, exchanged"};

typedef struct {
    uint64_t frames, tested, accepted;
} count_t;

/* xorshift64* */
static uint64_t random_state;
static uint32_t draw(uint32_t below)
{
    random_state ^= random_state >> 12;
    random_state ^= random_state << 25;
    random_state ^= random_state >> 27;
    return (uint32_t)(((random_state * UINT64_C(0x2545F4914F6CDD1D)) >> 32) % below);
}

static size_t right_frame(uint8_t *wire)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];
    const size_t size = draw(2) == 0 ? 56u : draw(FRAME_PAYLOAD_MAX + 1u);
    for (size_t k = 0; k < size; k++) {
        payload[k] = draw(3) == 0 ? 0 : (uint8_t)draw(256);
    }
    return frame_encode(wire, (frame_type_t)draw(256), draw(UINT32_MAX), payload, size);
}

static size_t random_bytes(uint8_t *wire)
{
    const size_t size = 1u + draw(FRAME_WIRE_MAX - 1u);
    for (size_t k = 0; k + 1u < size; k++) {
        wire[k] = (uint8_t)(1u + draw(255));
    }
    wire[size - 1u] = 0;
    return size;
}

/* Random content with right stuffing, so that the CRC alone decides. */
static size_t random_content(uint8_t *wire)
{
    const size_t size = right_frame(wire);
    size_t group = wire[0];
    for (size_t k = 1; k + 1u < size; k++) {
        if (k == group) {
            group += wire[k];
        } else {
            wire[k] = (uint8_t)(1u + draw(255));
        }
    }
    return size;
}

static size_t flipped(uint8_t *wire)
{
    const size_t size = right_frame(wire);
    for (uint32_t flips = 1u + draw(64); flips > 0; flips--) {
        wire[draw((uint32_t)size)] ^= (uint8_t)(1u << draw(8));
    }
    return size;
}

static size_t reshaped(uint8_t *wire)
{
    const size_t size = right_frame(wire);
    const uint32_t at = draw((uint32_t)size);
    const uint32_t other = draw((uint32_t)size);
    const uint8_t kept = wire[at];
    switch (draw(3)) {
    case 0:
        return at + 1u;
    case 1:
        if (size < FRAME_WIRE_MAX) {
            memmove(wire + at + 1u, wire + at, size - at);
            wire[at] = (uint8_t)(1u + draw(255));
            return size + 1u;
        }
        return size;
    default:
        wire[at] = wire[other];
        wire[other] = kept;
        return size;
    }
}

/* Feeds bytes and an ending zero. */
static void feed(frame_decoder_t *decoder, const uint8_t *wire, size_t size, count_t *count)
{
    frame_t frame;
    count->frames++;
    for (size_t k = 0; k <= size; k++) {
        const frame_event_t event = frame_decode(decoder, (k < size) ? wire[k] : 0, &frame);
        count->tested += (event != FRAME_NONE) ? 1u : 0u;
        count->accepted += (event == FRAME_GOOD) ? 1u : 0u;
    }
}

int main(int argc, char **argv)
{
    const uint64_t total = (argc > 1) ? strtoull(argv[1], NULL, 10) : UINT64_C(10000000);
    random_state = (argc > 2) ? strtoull(argv[2], NULL, 10) : 1u;
    count_t counts[KINDS] = {{0}};
    uint64_t undamaged = 0, tested = 0, wrong = 0;
    frame_decoder_t decoder = {0};
    for (uint64_t k = 0; k < total; k++) {
        uint8_t wire[FRAME_WIRE_MAX + 1u], before[FRAME_WIRE_MAX + 1u];
        const unsigned kind = (unsigned)(k % KINDS);
        size_t size = 0;
        const uint64_t state = random_state;
        const size_t right = (kind == 0) ? 0 : right_frame(before);
        random_state = state;
        switch (kind) {
        case 0:
            size = random_bytes(wire);
            break;
        case 1:
            size = random_content(wire);
            break;
        case 2:
            size = flipped(wire);
            break;
        default:
            size = reshaped(wire);
            break;
        }
        /* Flips that undo each other and equal bytes exchanged leave a right frame; it must be taken. Without its end, too. */
        const bool intact = right > 0 && size >= right - 1u && memcmp(wire, before, right - 1u) == 0 &&
                            (size == right - 1u || wire[right - 1u] == 0);
        const uint64_t accepted = counts[kind].accepted;
        feed(&decoder, wire, size, &counts[kind]);
        if (intact) {
            if (counts[kind].accepted == accepted) {
                (void)printf("a right frame was refused\n");
                return EXIT_FAILURE;
            }
            counts[kind].accepted--;
            undamaged++;
        }
    }
    for (int k = 0; k < KINDS; k++) {
        (void)printf("| %s | %llu | %llu | %llu |\n", KIND_NAMES[k], (unsigned long long)counts[k].frames,
                     (unsigned long long)counts[k].tested, (unsigned long long)counts[k].accepted);
        tested += counts[k].tested;
        wrong += counts[k].accepted;
    }
    const double expected = (double)tested / 4294967296.0;
    (void)printf("tested %llu, undamaged %llu, accepted wrongly %llu, expected by the odds of the CRC %.4f\n",
                 (unsigned long long)tested, (unsigned long long)undamaged, (unsigned long long)wrong, expected);
    /* Two or more where 0.005 are expected: 1 in 80,000. */
    return (wrong <= 1u + (uint64_t)(4.0 * expected)) ? EXIT_SUCCESS : EXIT_FAILURE;
}
