/* SPDX-License-Identifier: MIT */
/// @file
/// Words for a joint with two axes.
#ifndef JCAL_CLI_COMMANDS_TWO_DOF_H
#define JCAL_CLI_COMMANDS_TWO_DOF_H

#include "output/report.h"

extern const report_words_t TWO_DOF_WORDS;

#endif
