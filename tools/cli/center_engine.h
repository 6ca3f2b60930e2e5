/* SPDX-License-Identifier: MIT */
/// @file
/// One face for both engines of the joint centre.
#ifndef JCAL_CLI_CENTER_ENGINE_H
#define JCAL_CLI_CENTER_ENGINE_H

#include "jointcal/jointcal.h"

/// Config of the window engine, whose `center` part serves both.
typedef struct {
    jcal_engine_t kind;
    jcal_center_window_config_t config;
} center_engine_config_t;

typedef struct {
    jcal_engine_t kind;
    void *storage;
    union {
        jcal_center_t stream;
        jcal_center_window_t window;
    } as;
} center_engine_t;

/// False if memory ran out. The config has been checked before.
bool center_engine_start(center_engine_t *engine, const center_engine_config_t *config);

/// Takes in one pair, with orientations unless `attitudes` is null; false if the library refuses the call itself, which would be a
/// mistake of this program.
bool center_engine_update(center_engine_t *engine, const jcal_pair_t *pair, const jcal_attitudes_t *attitudes);

void center_engine_get(const center_engine_t *engine, jcal_center_result_t *result);

/// Forgets all data, its counters included.
void center_engine_reset(center_engine_t *engine);

/// Releases memory.
void center_engine_stop(center_engine_t *engine);

#endif
