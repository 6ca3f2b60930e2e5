/* SPDX-License-Identifier: MIT */
/// @file
/// What the window engine uses of the stream engine beside its public verbs. Private.
#ifndef JCAL_HINGE_STREAM_H
#define JCAL_HINGE_STREAM_H

#include "jointcal/hinge.h"

/// Begins anew with a valid config.
void jcal_hinge_start(jcal_hinge_t *self, const jcal_hinge_config_t *config);

/// Works off one pair that has passed a gate, as step does with one from the inbox.
void jcal_hinge_consume(jcal_hinge_t *self, const jcal_pair_t *pair);

#endif /* JCAL_HINGE_STREAM_H */
