/* SPDX-License-Identifier: MIT */
/// @file
/// State of a hinge of either kind. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_AUTO_HINGE_H
#define JCAL_PRIVATE_AUTO_HINGE_H

#include "jointcal/private/functional/pair.h"
#include "jointcal/private/heading.h"
#include "jointcal/private/hinge/stream.h"
#include "jointcal/private/inbox.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Both models on the same readings. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_inbox_t inbox;  ///< Pairs that were pushed and wait for step.
    jcal_hinge_t rigid;
    jcal_functional_pair_t functional;
    jcal_joint_heading_t heading;  ///< Of the rigid model's axes, while it is believed.
    bool believed;                 ///< The rigid model is ready, and the functional one has nothing against it.
} jcal_hinge_auto_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_AUTO_HINGE_H */
