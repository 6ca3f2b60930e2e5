/* SPDX-License-Identifier: MIT */
/// @file
/// What the engines of the joint centre tell their user. Private.
#ifndef JCAL_CENTER_RESULT_H
#define JCAL_CENTER_RESULT_H

#include "jointcal/center.h"

/// out <- what is known; engine and time are the engine's to add.
void jcal_center_report(const jcal_center_config_t *cfg, const jcal_center_work_t *work,
                        const jcal_center_input_t *input, bool has_point, jcal_center_result_t *out);

#endif /* JCAL_CENTER_RESULT_H */
