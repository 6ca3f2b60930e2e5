/* SPDX-License-Identifier: MIT */
/// @file
/// `jointcal stream` with a whole body.
#ifndef JCAL_CLI_COMMANDS_STREAM_BODY_H
#define JCAL_CLI_COMMANDS_STREAM_BODY_H

#include "commands/stream_options.h"
#include "output/message.h"
#include "run/hub_session.h"

/// All options of the command.
typedef struct {
    hub_target_t hub;
    float speed;    ///< Times real time; 0: as fast as the hub can.
    bool counters;  ///< Tell the hub's counters at the end.
    stream_body_options_t body;
} stream_options_t;

/// Plays the files to the hub. Ready: all joints are.
exit_status_t stream_body(const common_options_t *common, const stream_options_t *options);

#endif
