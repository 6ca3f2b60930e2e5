/* SPDX-License-Identifier: MIT */
/* One face for the engines of a joint with two axes. */
#include "two_dof_engine.h"

bool two_dof_engine_exists(jcal_engine_t kind)
{
    return kind == JCAL_ENGINE_STREAM;
}

bool two_dof_engine_start(two_dof_engine_t *engine, const two_dof_engine_config_t *config)
{
    engine->kind = config->kind;
    return jcal_two_dof_init(&engine->stream, &config->config) == JCAL_OK;
}

bool two_dof_engine_update(two_dof_engine_t *engine, const jcal_orientation_pair_t *pair)
{
    return jcal_two_dof_update(&engine->stream, pair) >= JCAL_OK;
}

void two_dof_engine_get(const two_dof_engine_t *engine, jcal_two_dof_result_t *result)
{
    /* The only error is a null pointer. */
    (void)jcal_two_dof_get(&engine->stream, result);
}

void two_dof_engine_reset(two_dof_engine_t *engine)
{
    (void)jcal_two_dof_reset(&engine->stream);
}

void two_dof_engine_stop(two_dof_engine_t *engine)
{
    (void)engine;
}
