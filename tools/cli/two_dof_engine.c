/* SPDX-License-Identifier: MIT */
/* One face for both engines of a joint with two axes. */
#include "two_dof_engine.h"

#include <stdlib.h>

bool two_dof_engine_start(two_dof_engine_t *engine, const two_dof_engine_config_t *config)
{
    engine->kind = config->kind;
    engine->storage = NULL;
    if (engine->kind == JCAL_ENGINE_STREAM) {
        return jcal_two_dof_init(&engine->as.stream, &config->config.two_dof) == JCAL_OK;
    }
    const size_t bytes = jcal_two_dof_window_storage_bytes(&config->config);
    engine->storage = malloc(bytes);
    return engine->storage != NULL &&
           jcal_two_dof_window_init(&engine->as.window, &config->config, engine->storage, bytes) == JCAL_OK;
}

bool two_dof_engine_update(two_dof_engine_t *engine, const jcal_orientation_pair_t *pair)
{
    const jcal_status_t status = (engine->kind == JCAL_ENGINE_STREAM)
                                     ? jcal_two_dof_update(&engine->as.stream, pair)
                                     : jcal_two_dof_window_update(&engine->as.window, pair);
    return status >= JCAL_OK;
}

void two_dof_engine_get(const two_dof_engine_t *engine, jcal_two_dof_result_t *result)
{
    /* The only error is a null pointer. */
    if (engine->kind == JCAL_ENGINE_STREAM) {
        (void)jcal_two_dof_get(&engine->as.stream, result);
    } else {
        (void)jcal_two_dof_window_get(&engine->as.window, result);
    }
}

void two_dof_engine_reset(two_dof_engine_t *engine)
{
    if (engine->kind == JCAL_ENGINE_STREAM) {
        (void)jcal_two_dof_reset(&engine->as.stream);
    } else {
        (void)jcal_two_dof_window_reset(&engine->as.window);
    }
}

void two_dof_engine_stop(two_dof_engine_t *engine)
{
    free(engine->storage);
    engine->storage = NULL;
}
