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

#endif /* JCAL_BALL_JUDGE_H */
