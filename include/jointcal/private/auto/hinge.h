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
    jcal_joint_heading_t heading;  ///< By the rigid model's axes, from when they were first believed.
    bool believed;                 ///< The rigid model is ready, and the functional one has nothing against it.
    uint8_t objection;             ///< What the functional model has against it, a jcal_reason_t.
    bool person;                   ///< The rates say that the segments are not rigid.
    bool follows;                  ///< It was so once, and no sensor has moved since.
    bool has_zero;    ///< Either was ready once, and no sensor has moved since: the angle counts from `zero`.
    uint8_t zero[2];  ///< As of functional/twist.h.
} jcal_hinge_auto_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_AUTO_HINGE_H */
