/* SPDX-License-Identifier: MIT */
/* The functional joint over arrays. */
#ifndef JCAL_BATCH_FUNCTIONAL_H
#define JCAL_BATCH_FUNCTIONAL_H

#include "batch.h"

#include "jointcal/hinge_auto.h"

/* Numbers per tick: status, reason, weak, hint, axis1 (3), axis2 (3), uncertainty1_rad, uncertainty2_rad, flexion_uncertainty_rad,
   for_axes, for_flexion, is_functional, heading_rad, joint_to_sensor1_m (3), joint_to_sensor2_m (3), evidence (3), opposite, share, bend_rad,
   stiffness, lack per second, speed2, motion_s of the sums, size (3), gravity_off, motion_s, energy, number of the sample. */
#define JCAL_BATCH_FUNCTIONAL_COLUMNS 40

typedef struct {
    float max_bound_rad;
    float max_flexion_rad;
    float slices_per_s;
    int32_t sign_hint;
    int32_t either; /* 1: as of a hinge of either kind; 0: as of the functional model alone */
    int32_t begin;  /* samples that come before this one go to the sensors only, so that their filters have settled */
    int32_t hold;   /* from this sample on the estimate stays as it is and the heading is followed with it; 0: never */
} jcal_batch_functional_options_t;

typedef struct {
    float *rows;    /* at most count x JCAL_BATCH_FUNCTIONAL_COLUMNS */
    float *flexion; /* count, rad, after each sample; NaN while there is none */
    float *turns;   /* count x 8, orientations of both sensors to their level frames after each sample: w, x, y, z */
    uint64_t row_count;
} jcal_batch_functional_out_t;

JCAL_BATCH_EXPORT void jcal_batch_functional_defaults(jcal_batch_functional_options_t *options);

/* A fresh joint over all samples. JCAL_BATCH_DONE or what was wrong. */
JCAL_BATCH_EXPORT int32_t jcal_batch_functional(const jcal_batch_functional_options_t *options,
                                                const jcal_batch_input_t *in, jcal_batch_functional_out_t *out);

#endif /* JCAL_BATCH_FUNCTIONAL_H */
