/* SPDX-License-Identifier: MIT */
/// @file
/// Files that are no text, by name and with what to do.
#ifndef JCAL_CLI_INPUT_FILE_KIND_H
#define JCAL_CLI_INPUT_FILE_KIND_H

#include <stddef.h>

/// Bytes from the beginning of a file that tell its kind.
#define FILE_KIND_BYTES 16

/// What a file is that begins so, and what to do with it; null if it may be text. More bytes than FILE_KIND_BYTES may tell more.
const char *file_kind(const char *bytes, size_t size);

#endif
