/* SPDX-License-Identifier: MIT */
/// @file
/// One face for both engines of a joint with two axes.
#ifndef JCAL_CLI_TWO_DOF_ENGINE_H
#define JCAL_CLI_TWO_DOF_ENGINE_H

#include "jointcal/jointcal.h"

/// Config of the window engine, whose `two_dof` part serves both.
typedef struct {
    jcal_engine_t kind;
    jcal_two_dof_window_config_t config;
} two_dof_engine_config_t;

typedef struct {
    jcal_engine_t kind;
    void *storage;
    union {
        jcal_two_dof_t stream;
        jcal_two_dof_window_t window;
    } as;
} two_dof_engine_t;

/// False if memory ran out. The config has been checked before.
bool two_dof_engine_start(two_dof_engine_t *engine, const two_dof_engine_config_t *config);

/// Takes in one pair of orientations; false if the library refuses the call itself, which would be a mistake of this program.
bool two_dof_engine_update(two_dof_engine_t *engine, const jcal_orientation_pair_t *pair);

void two_dof_engine_get(const two_dof_engine_t *engine, jcal_two_dof_result_t *result);

/// Forgets all data, its counters included.
void two_dof_engine_reset(two_dof_engine_t *engine);

/// Releases memory.
void two_dof_engine_stop(two_dof_engine_t *engine);

#endif
