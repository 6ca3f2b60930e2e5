/* SPDX-License-Identifier: MIT */
/* The engine of joints with two axes for ctypes; jointcal_tools/measure/angles.py mirrors it. */
#ifndef JCAL_BATCH_JOINT_H
#define JCAL_BATCH_JOINT_H

#include "batch.h"

/* Numbers per sample, in this order: status, axis1 (3), axis2 (3), heading_offset_rad, carrying_angle_rad, the three bounds. */
#define JCAL_BATCH_JOINT_COLUMNS 12

/* A fresh instance with the default config over `count` orientations q (count x 8: q1, q2); rows: count x JCAL_BATCH_JOINT_COLUMNS.
   JCAL_BATCH_DONE or what was wrong. */
JCAL_BATCH_EXPORT int32_t jcal_batch_two_dof(const uint64_t *t_us, const float *q, size_t count, float *rows);

#endif /* JCAL_BATCH_JOINT_H */
