/* SPDX-License-Identifier: MIT */
/// @file
/// State of the window engine of the hinge. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_HINGE_WINDOW_H
#define JCAL_PRIVATE_HINGE_WINDOW_H

#include "jointcal/private/hinge/stream.h"
#include "jointcal/private/select.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Both axes. j[0] in sensor frame 1, j[1] in sensor frame 2; unit.
typedef struct {
    jcal_vec3_t j[2];
} jcal_hinge_axes_t;

/// A full solve on its way.
typedef struct {
    uint8_t phase;       ///< See lib/hinge/window_solve.c.
    uint8_t iterations;  ///< Done in this phase.
    float damping;
    uint32_t random;          ///< State of the generator of starts.
    jcal_hinge_axes_t at;     ///< The estimate of this phase.
    jcal_hinge_axes_t first;  ///< The result from the start, before its other pairing was tried.
} jcal_hinge_solve_t;

/// Algorithm 4.
typedef struct {
    jcal_hinge_axes_t previous;  ///< The last estimate, with the sign of (66).
    bool has_previous;
    bool accepted;
    uint16_t agreeing;   ///< Consecutive estimates with SEQAD below E_max; stops at n_min.
    float seqad_rad;     ///< (67) of the last estimate.
    float local_rad[2];  ///< mu + 2 sigma of the last estimate; pi/2 if unknown.
} jcal_hinge_accept_t;

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
