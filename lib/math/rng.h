/* SPDX-License-Identifier: MIT */
/// @file
/// Small deterministic random numbers: PCG-RXS-M-XS with 32 bits of state (O'Neill 2014). Not for secrets.
#ifndef JCAL_RNG_H
#define JCAL_RNG_H

#include "jointcal/vec3.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Tries of jcal_rng_unit before it gives up being uniform; one in 10^10 calls gets there.
#define JCAL_RNG_TRIES 32u

/// State of a generator. Any value is a valid seed; equal seeds give equal sequences on every machine.
typedef struct {
    uint32_t state;
} jcal_rng_t;

/// Next 32 random bits; period 2^32.
static inline uint32_t jcal_rng_next(jcal_rng_t *rng)
{
    const uint32_t s = rng->state;
    rng->state = (s * 747796405u) + 2891336453u;
    const uint32_t word = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return (word >> 22u) ^ word;
}

/// Uniform number in [-1, 1), a multiple of 2^-23.
static inline float jcal_rng_symmetric(jcal_rng_t *rng)
{
    const float unit = (float)(jcal_rng_next(rng) >> 8u) * (1.0f / 8388608.0f); /* [0, 2) */
    return unit - 1.0f;
}

/// Uniform unit vector: a point of the cube, drawn again until it lies in the ball and not too near its centre.
///
/// Cost:     1.9 tries on average, at most JCAL_RNG_TRIES; after that (1, 0, 0).
static inline jcal_vec3_t jcal_rng_unit(jcal_rng_t *rng)
{
    for (uint32_t tries = 0u; tries < JCAL_RNG_TRIES; ++tries) {
        const float x = jcal_rng_symmetric(rng);
        const float y = jcal_rng_symmetric(rng);
        const float z = jcal_rng_symmetric(rng);
        const float square = (x * x) + (y * y) + (z * z);
        if ((square <= 1.0f) && (square >= 1e-4f)) {
            return jcal_vec3_scale(jcal_vec3(x, y, z), 1.0f / sqrtf(square));
        }
    }
    return jcal_vec3(1.0f, 0.0f, 0.0f);
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_RNG_H */
