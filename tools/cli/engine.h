/* SPDX-License-Identifier: MIT */
/// @file
/// One face for both hinge engines.
#ifndef JCAL_CLI_ENGINE_H
#define JCAL_CLI_ENGINE_H

#include "jointcal/jointcal.h"

/// Config of the window engine, whose `hinge` part serves both.
typedef struct {
    jcal_engine_t kind;
    jcal_hinge_window_config_t config;
} engine_config_t;

typedef struct {
    jcal_engine_t kind;
    void *storage;
    union {
        jcal_hinge_t stream;
        jcal_hinge_window_t window;
    } as;
} engine_t;

/// False if memory ran out. The config has been checked before.
bool engine_start(engine_t *engine, const engine_config_t *config);

/// Takes in one sample; false if the library refuses the call itself, which would be a mistake of this program.
bool engine_update(engine_t *engine, const jcal_pair_t *pair);

void engine_get(const engine_t *engine, jcal_hinge_result_t *result);

/// Releases memory.
void engine_stop(engine_t *engine);

#endif
