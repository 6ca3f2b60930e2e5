/* SPDX-License-Identifier: MIT */
/// @file
/// Vectors of a plane. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_PLANE_H
#define JCAL_PRIVATE_PLANE_H

#ifdef __cplusplus
extern "C" {
#endif

/// A complex number: a vector in a plane, or a turn of it.
typedef struct {
    float re, im;
} jcal_plane_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_PLANE_H */
