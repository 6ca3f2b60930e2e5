/* SPDX-License-Identifier: MIT */
/// @file
/// The keys of a hinge, which the hub's estimates have too.
#ifndef JCAL_CLI_COMMANDS_HINGE_H
#define JCAL_CLI_COMMANDS_HINGE_H

#include "output/json.h"

#include "jointcal/hinge.h"

/// Writes the keys that only a hinge has.
void hinge_write_keys(json_t *json, const jcal_hinge_result_t *result);

#endif
