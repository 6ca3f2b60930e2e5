/* SPDX-License-Identifier: MIT */
/// @file
/// The file or standard input that a recording is read from.
#ifndef JCAL_CLI_INPUT_INPUT_H
#define JCAL_CLI_INPUT_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    const char *name;  ///< As the user gave it.
    uint64_t size;     ///< Bytes; 0 if unknown (pipes, devices).
    bool again;        ///< It can be opened again and has the same in it.
    int error;         ///< errno of the call that failed, or 0.
    int descriptor;    /* private */
    uint64_t device, node;
} input_t;

/// Opens a file, or standard input for "-". Returns 0, or -1 with `error` set.
int input_open(input_t *input, const char *name);

/// A csv_read_t, whose context is the input_t: hands over what is there without waiting for more, so that live pipes work.
long input_read(void *context, char *buffer, size_t size);

/// True if both are one file.
bool input_same(const input_t *a, const input_t *b);

/// Closes the file.
void input_close(input_t *input);

#endif
