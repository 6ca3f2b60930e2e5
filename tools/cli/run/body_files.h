/* SPDX-License-Identifier: MIT */
/// @file
/// The recording of a whole body: one file with two or three sensors, or a file for each sensor; and the packets that its sensors would have
/// sent, in the order of their arrival.
#ifndef JCAL_CLI_RUN_BODY_FILES_H
#define JCAL_CLI_RUN_BODY_FILES_H

#include "output/message.h"
#include "run/radio.h"

/// Most sensors that are played.
#define BODY_FILES_MAX 32

typedef struct {
    unsigned count;    ///< Sensors.
    int64_t start_us;  ///< First time of sensor 1's file: times of all others are turned into those of this file.
    int64_t end_us;    ///< Time of the last row.
    radio_t radios[BODY_FILES_MAX];
    int64_t shift_us[BODY_FILES_MAX];  ///< What was taken off the times of a file that has other times than the first.

    /* Private. */
    size_t at[BODY_FILES_MAX]; /* next packet of each sensor */
} body_files_t;

/// Reads all files into memory. Files whose times are about those of the first are taken as they are; others to begin with it.
/// EXIT_READY, or another status after a message.
exit_status_t body_files_read(body_files_t *self, const char *const *names, unsigned count, bool sorted);

/// The packet that arrives next and its sensor; null if there are no more.
const radio_packet_t *body_files_next(body_files_t *self, unsigned *sensor);

/// Releases memory; also after a failed read.
void body_files_free(body_files_t *self);

#endif
