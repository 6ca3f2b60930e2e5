/* SPDX-License-Identifier: MIT */
/// @file
/// What changed in a joint, as events. Private.
#ifndef JCAL_BODY_LOOK_H
#define JCAL_BODY_LOOK_H

#include "jointcal/body.h"

/// Looks at a joint, and tells what is new.
void jcal_body_look(jcal_body_t *self, unsigned joint);

#endif /* JCAL_BODY_LOOK_H */
