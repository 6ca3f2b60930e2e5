/* SPDX-License-Identifier: MIT */
/// @file
/// Units that people read, and those of the library.
#ifndef JCAL_CLI_UNITS_H
#define JCAL_CLI_UNITS_H

#define RAD_PER_DEG 0.0174532925f
#define DEG_PER_RAD 57.2957795f
#define MM_PER_M 1000.0f

#endif
