/* SPDX-License-Identifier: MIT */
/// @file
/// Follows the best minimum and looks for others, one bounded slice at a time. Private.
#ifndef JCAL_HINGE_SEARCH_H
#define JCAL_HINGE_SEARCH_H

#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/coarse.h"
#include "jointcal/private/hinge/search.h"

#include <stdbool.h>

/// What the search may conclude.
typedef struct {
    /// A better cost of the other sign pairing makes it the estimate. Later on the judgement decides, which knows what the rates say.
    bool pairing_is_free;
    bool joint_has_moved;     ///< A round over all starts counts.
    const int8_t *kept_sign;  ///< Of both axes; what the user's hint means.
} jcal_hinge_scope_t;

/// One Gauss-Newton step of the estimate, and the accelerometers' constant at the refined axes.
void jcal_hinge_track(jcal_hinge_coarse_t *self, const jcal_hinge_config_t *cfg, const jcal_hinge_point_t *refined);

/// One slice of the global check: begins a probe from the next start, or moves it by one step, or files what it found. Returns true if
/// the estimate is another one now: what was known of the old one is void.
///
/// Starts: the 9 pairs of eigenvectors of the rates' second moments, each with the sign pairing that the specific forces
/// prefer, then the present estimate with axis 2 turned round.
bool jcal_hinge_search(jcal_hinge_search_t *self, jcal_hinge_coarse_t *coarse, const jcal_hinge_config_t *cfg,
                       const jcal_hinge_scope_t *scope);

/// The other sign pairing becomes the estimate: what was known of the old one is void.
void jcal_hinge_turn_round(jcal_hinge_search_t *self, jcal_hinge_coarse_t *coarse);

/// The best axes of the other sign pairing than that of `point`.
jcal_hinge_point_t jcal_hinge_flipped(const jcal_hinge_search_t *self, const jcal_hinge_point_t *point);

/// Cost of the best other minimum.
float jcal_hinge_cost_of_rival(const jcal_hinge_search_t *self, const jcal_hinge_moments_t *moments,
                               const jcal_hinge_config_t *cfg);

#endif /* JCAL_HINGE_SEARCH_H */
