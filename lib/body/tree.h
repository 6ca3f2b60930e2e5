/* SPDX-License-Identifier: MIT */
/// @file
/// Which sensors hang on which, and lags taken off down the tree. Private.
#ifndef JCAL_BODY_TREE_H
#define JCAL_BODY_TREE_H

#include "jointcal/body.h"

/// True if `sensor` is `root` or hangs on it: the way up from it, which is no longer than there are sensors, leads there.
bool jcal_body_hangs_on(const jcal_body_t *self, unsigned sensor, unsigned root);

/// Takes `lag_s` more off the times of the distal sensor of a joint and of all that hang on it; all of them begin anew. The joint begins
/// anew when more than 20 ms were taken off since it began. False, and counted, if a sensor would be shifted too far; nothing is changed then.
bool jcal_body_shift(jcal_body_t *self, unsigned joint, float lag_s);

#endif /* JCAL_BODY_TREE_H */
