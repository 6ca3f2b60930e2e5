/* SPDX-License-Identifier: MIT */
/// @file
/// Which of the two models of a hinge is believed, and what follows from that. Private.
#ifndef JCAL_AUTO_JUDGE_H
#define JCAL_AUTO_JUDGE_H

#include "jointcal/hinge_auto.h"

/// A sensor has moved, or this is the beginning: neither the heading nor the zero of the angle says anything.
void jcal_hinge_auto_begin_anew(jcal_hinge_auto_t *self);

/// After both models have taken in the pair of time `t_us`: which of them is to be asked, the heading by the axes
/// of the rigid one, and the zero of the angle. Cost: two copies of a hinge's result and one step of the heading.
void jcal_hinge_auto_judge(jcal_hinge_auto_t *self, uint64_t t_us);

#endif /* JCAL_AUTO_JUDGE_H */
