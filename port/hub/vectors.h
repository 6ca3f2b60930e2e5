/* SPDX-License-Identifier: MIT */
/// @file
/// Vectors in payloads: x, y, z.
#ifndef JCAL_HUB_VECTORS_H
#define JCAL_HUB_VECTORS_H

#include "frame.h"
#include "jointcal/types.h"

static inline void message_write_vector(frame_writer_t *out, jcal_vec3_t vector)
{
    frame_write_f32(out, vector.x);
    frame_write_f32(out, vector.y);
    frame_write_f32(out, vector.z);
}

static inline jcal_vec3_t message_read_vector(frame_reader_t *in)
{
    jcal_vec3_t vector;
    vector.x = frame_read_f32(in);
    vector.y = frame_read_f32(in);
    vector.z = frame_read_f32(in);
    return vector;
}

#endif
