/* SPDX-License-Identifier: MIT */
/* One face for both hinge engines. */
#include "engine.h"

#include <stdlib.h>

bool engine_start(engine_t *engine, const engine_config_t *config)
{
    engine->kind = config->kind;
    engine->storage = NULL;
    if (engine->kind == JCAL_ENGINE_STREAM) {
        return jcal_hinge_init(&engine->as.stream, &config->config.hinge) == JCAL_OK;
    }
    const size_t bytes = jcal_hinge_window_storage_bytes(&config->config);
    engine->storage = malloc(bytes);
    return engine->storage != NULL &&
           jcal_hinge_window_init(&engine->as.window, &config->config, engine->storage, bytes) == JCAL_OK;
}

bool engine_update(engine_t *engine, const jcal_pair_t *pair)
{
    const jcal_status_t status = (engine->kind == JCAL_ENGINE_STREAM)
                                     ? jcal_hinge_update(&engine->as.stream, pair)
                                     : jcal_hinge_window_update(&engine->as.window, pair);
    return status >= JCAL_OK;
}

void engine_get(const engine_t *engine, jcal_hinge_result_t *result)
{
    /* The only error is a null pointer. */
    if (engine->kind == JCAL_ENGINE_STREAM) {
        (void)jcal_hinge_get(&engine->as.stream, result);
    } else {
        (void)jcal_hinge_window_get(&engine->as.window, result);
    }
}

void engine_stop(engine_t *engine)
{
    free(engine->storage);
    engine->storage = NULL;
}
