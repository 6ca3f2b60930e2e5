/* SPDX-License-Identifier: MIT */
/// @file
/// Where the search for other minima stands.
#ifndef JCAL_PRIVATE_HINGE_SEARCH_H
#define JCAL_PRIVATE_HINGE_SEARCH_H

#include "jointcal/private/hinge/point.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Where the search for other minima stands.
typedef struct {
    jcal_hinge_place_t probe;    ///< Where the probe is.
    jcal_hinge_note_t rival[2];  ///< Best other minimum.
    jcal_hinge_note_t flip[2];   ///< Best axes of the other sign pairing.
    float damping;
    uint8_t rounds;      ///< Complete rounds over all starts since the joint first moved.
    uint8_t start;       ///< Which start the probe came from.
    uint8_t iterations;  ///< Steps that the probe has made.
    bool running, has_flip, has_rival;
} jcal_hinge_search_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_SEARCH_H */
