/* SPDX-License-Identifier: MIT */
/// @file
/// Words for a ball joint.
#ifndef JCAL_CLI_COMMANDS_BALL_H
#define JCAL_CLI_COMMANDS_BALL_H

#include "output/report.h"

extern const report_words_t BALL_WORDS;

#endif
