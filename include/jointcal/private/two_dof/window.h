/* SPDX-License-Identifier: MIT */
/// @file
/// State of the window engine of the joint with two axes. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_TWO_DOF_WINDOW_H
#define JCAL_PRIVATE_TWO_DOF_WINDOW_H

#include "jointcal/private/two_dof/row.h"
#include "jointcal/private/two_dof/stream.h"
#include "jointcal/private/two_dof/window_search.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The window engine. Caller-owned; all members are private.
///
/// It may be copied together with its storage; jcal_two_dof_window_attach() then tells the copy where its storage is.
typedef struct {
    jcal_two_dof_window_config_t cfg;
    void *storage;
    jcal_orientation_gate_t gate;
    jcal_two_dof_kept_t kept;
    uint16_t count;  ///< Rows in the storage.
    uint16_t next;   ///< Where the next one goes.
    jcal_two_dof_window_search_t search;
    jcal_two_dof_verdict_t verdict;
} jcal_two_dof_window_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_WINDOW_H */
