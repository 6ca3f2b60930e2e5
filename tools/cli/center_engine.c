/* SPDX-License-Identifier: MIT */
/* One face for both engines of the joint centre. */
#include "center_engine.h"

#include <stdlib.h>

bool center_engine_start(center_engine_t *engine, const center_engine_config_t *config)
{
    engine->kind = config->kind;
    engine->storage = NULL;
    if (engine->kind == JCAL_ENGINE_STREAM) {
        return jcal_center_init(&engine->as.stream, &config->config.center) == JCAL_OK;
    }
    const size_t bytes = jcal_center_window_storage_bytes(&config->config);
    engine->storage = malloc(bytes);
    return engine->storage != NULL &&
           jcal_center_window_init(&engine->as.window, &config->config, engine->storage, bytes) == JCAL_OK;
}

static jcal_status_t push(center_engine_t *engine, const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    if (engine->kind == JCAL_ENGINE_STREAM) {
        return (attitudes == NULL) ? jcal_center_push(&engine->as.stream, pair)
                                   : jcal_center_push_oriented(&engine->as.stream, pair, attitudes);
    }
    return (attitudes == NULL) ? jcal_center_window_push(&engine->as.window, pair)
                               : jcal_center_window_push_oriented(&engine->as.window, pair, attitudes);
}

bool center_engine_update(center_engine_t *engine, const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    if (push(engine, pair, attitudes) < JCAL_OK) {
        return false;
    }
    return ((engine->kind == JCAL_ENGINE_STREAM) ? jcal_center_step(&engine->as.stream)
                                                 : jcal_center_window_step(&engine->as.window)) >= JCAL_OK;
}

void center_engine_get(const center_engine_t *engine, jcal_center_result_t *result)
{
    /* The only error is a null pointer. */
    if (engine->kind == JCAL_ENGINE_STREAM) {
        (void)jcal_center_get(&engine->as.stream, result);
    } else {
        (void)jcal_center_window_get(&engine->as.window, result);
    }
}

void center_engine_reset(center_engine_t *engine)
{
    if (engine->kind == JCAL_ENGINE_STREAM) {
        (void)jcal_center_reset(&engine->as.stream);
    } else {
        (void)jcal_center_window_reset(&engine->as.window);
    }
}

void center_engine_stop(center_engine_t *engine)
{
    free(engine->storage);
    engine->storage = NULL;
}
