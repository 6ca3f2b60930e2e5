/* SPDX-License-Identifier: MIT */
/// @file
/// Readiness of the ball joint: what speaks against one joint, and which of its quantities are known. Private.
#ifndef JCAL_BALL_JUDGE_H
#define JCAL_BALL_JUDGE_H

#include "jointcal/private/ball/stream.h"

#include <stdbool.h>

/// Status, reason, weak and hint of the verdict, and what it is good for.
void jcal_ball_judge(jcal_ball_t *self);

/// True if nothing has spoken against one joint for three judgements.
bool jcal_ball_is_joint(const jcal_ball_t *self);

/// True if there is a heading of this moment, with a bound; whether the bound holds is another question, jcal_ball_is_joint.
bool jcal_ball_knows_heading(const jcal_ball_t *self);

#endif /* JCAL_BALL_JUDGE_H */
