/* SPDX-License-Identifier: MIT */
/* A person's joint with two axes over arrays; of a ball joint everything but the axes. */
#ifndef JCAL_BATCH_TWO_AXES_H
#define JCAL_BATCH_TWO_AXES_H

#include "batch.h"

#include "jointcal/two_axes_pair.h"

/* Numbers per tick: status, reason, weak, hint, for_heading, for_center1, for_center2, for_axis1, for_axis2, heading_rad,
   uncertainty_heading_rad, joint_to_sensor1_m (3), joint_to_sensor2_m (3), uncertainty1_m, uncertainty2_m, axis1 (3), axis2 (3),
   uncertainty1_rad, uncertainty2_rad, windows1, windows2, what is left per second, speed2, stiffness, motion_s of the sums, is_joint,
   number of the sample. */
#define JCAL_BATCH_TWO_AXES_COLUMNS 35

typedef struct {
    float max_heading_rad;
    float max_lever_m;
    float max_bound_rad;
    float slices_per_s;
    int32_t begin; /* samples that come before this one go to the sensors only, so that their filters have settled */
} jcal_batch_two_axes_options_t;

typedef struct {
    float *rows;     /* at most count x JCAL_BATCH_TWO_AXES_COLUMNS */
    float *relative; /* count x 4, orientation of sensor 2 in sensor 1 after each sample; NaN while there is none */
    float *turns;    /* count x 8, orientations of both sensors to their level frames after each sample: w, x, y, z */
    uint64_t row_count;
} jcal_batch_two_axes_out_t;

JCAL_BATCH_EXPORT void jcal_batch_two_axes_defaults(jcal_batch_two_axes_options_t *options);

/* A fresh joint over all samples. JCAL_BATCH_DONE or what was wrong. */
JCAL_BATCH_EXPORT int32_t jcal_batch_two_axes(const jcal_batch_two_axes_options_t *options,
                                              const jcal_batch_input_t *in, jcal_batch_two_axes_out_t *out);

#endif /* JCAL_BATCH_TWO_AXES_H */
