/* SPDX-License-Identifier: MIT */
/// @file
/// State of the window engine of the hinge. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_HINGE_WINDOW_H
#define JCAL_PRIVATE_HINGE_WINDOW_H

#include "jointcal/private/hinge/stream.h"
#include "jointcal/private/hinge/window_search.h"
#include "jointcal/private/select.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The window engine. Caller-owned; all members are private.
///
/// It may be copied together with its storage; jcal_hinge_window_attach() then tells the copy where its storage is.
typedef struct {
    jcal_hinge_window_config_t cfg;
    void *storage;
    jcal_score_t score;
    jcal_select_gyr_t gyr;
    jcal_select_acc_t acc;
    jcal_hinge_axes_t axes;  ///< The estimate, followed from sample to sample; its sign is free.
    float damping;
    float sign_margin;
    jcal_hinge_solve_t solve;
    jcal_hinge_accept_t accept;
    bool has_axes;
    bool has_stepped;
    bool was_ready;       ///< After the last step; leaving `ready` takes more than entering it.
    uint64_t stepped_us;  ///< Time of the last sample that step worked off.
    uint64_t solve_due_us;
    /// A stream engine over the same samples: its bounds, its readiness; gate and inbox serve both.
    jcal_hinge_t guard;
    uint32_t inbox_ids[JCAL_INBOX_CAPACITY];  ///< Number of each pair in the inbox.
} jcal_hinge_window_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_WINDOW_H */
