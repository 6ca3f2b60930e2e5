/* SPDX-License-Identifier: MIT */
/// @file
/// What the window engine and tests use of the stream engine beside its public verbs. Private.
#ifndef JCAL_HINGE_STREAM_H
#define JCAL_HINGE_STREAM_H

#include "jointcal/hinge.h"

/// Begins anew with a valid config.
void jcal_hinge_start(jcal_hinge_t *self, const jcal_hinge_config_t *config);

/// Takes one pair that has passed a gate, as step does with one from the inbox: smooths its rates and works it off.
void jcal_hinge_take(jcal_hinge_t *self, const jcal_pair_t *pair);

/// Works off one pair with smooth rates.
void jcal_hinge_consume(jcal_hinge_t *self, const jcal_pair_t *pair);

/// One slice of the global check, and what follows from it.
void jcal_hinge_look_around(jcal_hinge_t *self);

/// The other sign pairing becomes the estimate, and what follows from it.
void jcal_hinge_go_round(jcal_hinge_t *self);

/// A judgement, and what follows from it.
void jcal_hinge_take_stock(jcal_hinge_t *self);

#endif /* JCAL_HINGE_STREAM_H */
