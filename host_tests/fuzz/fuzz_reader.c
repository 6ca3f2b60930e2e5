/* SPDX-License-Identifier: MIT */
/* Any bytes as a recording: the reader ends, stays in bounds, and says where what is wrong. */
#include "input/recording.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A source that hands over its text in pieces, because chunk borders may fall anywhere. */
typedef struct {
    const uint8_t *data;
    size_t size;
    size_t piece;
} memory_t;

static long read_memory(void *context, char *buffer, size_t size)
{
    memory_t *memory = context;
    size_t count = (memory->piece < memory->size) ? memory->piece : memory->size;
    count = (count < size) ? count : size;
    if (count > 0) {
        memcpy(buffer, memory->data, count);
    }
    memory->data += count;
    memory->size -= count;
    return (long)count;
}

static void require(bool condition)
{
    if (!condition) {
        abort();
    }
}

/* The first byte sets the size of the pieces; the rest is the file. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static recording_t recording;
    if (size == 0) {
        return 0;
    }
    memory_t memory = {data + 1, size - 1, (size_t)data[0] + 1};
    recording_event_t event = recording_open(&recording, read_memory, &memory);
    if (event == RECORDING_ROW) {
        event = recording_check_orientations(&recording);
        recording.want_orientations = recording.has_orientations;
    }
    recording_row_t row;
    size_t rows = 0;
    while (event == RECORDING_ROW) {
        require(++rows <= size);
        event = recording_next(&recording, &row);
    }
    require(event == RECORDING_END || event == RECORDING_BAD);
    if (event == RECORDING_BAD) {
        const recording_fault_t *fault = &recording.fault;
        require(strlen(fault->text) > 0 && fault->line <= size && fault->column <= size);
    }
    recording_close(&recording);
    return 0;
}
