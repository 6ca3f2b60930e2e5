/* SPDX-License-Identifier: MIT */
/// @file
/// What is known of a person's hip and knee.
#include "joint/head.h"
#include "jointcal/leg.h"
#include "leg/places.h"
#include "math/clear.h"

#include <stddef.h>

/// The joint that is not known as one, of two the one whose heading is known less; JCAL_LEG_JOINTS if both are known.
static unsigned open_joint(const jcal_ball_result_t joints[2])
{
    const bool hip = joints[0].head.status != JCAL_READY;
    const bool knee = joints[1].head.status != JCAL_READY;
    if (hip && knee) {
        return (joints[1].uncertainty_heading_rad > joints[0].uncertainty_heading_rad) ? 1u : 0u;
    }
    return hip ? 0u : (knee ? 1u : (unsigned)JCAL_LEG_JOINTS);
}

/// The worst of the vectors that are not known; JCAL_CHAIN_PLACES if all are.
static unsigned open_place(const jcal_leg_places_t *places)
{
    unsigned worst = JCAL_CHAIN_PLACES;
    for (unsigned i = 0u; i < JCAL_CHAIN_PLACES; ++i) {
        const bool is_worse = (worst == JCAL_CHAIN_PLACES) || (places->bound_m[i] > places->bound_m[worst]);
        worst = (!places->known[i] && is_worse) ? i : worst;
    }
    return worst;
}

/// The motion that makes a vector's bound smaller, if one does.
static jcal_hint_t hint_for(const jcal_leg_t *self, const jcal_leg_places_t *places, unsigned place)
{
    if (places->length_refused && !places->length_possible) {
        return JCAL_HINT_CHECK_SENSORS;
    }
    if (places->skin_m[place] > self->cfg.max_lever_m) {
        return JCAL_HINT_NONE;
    }
    return ((place % 2u) == 0u) ? JCAL_HINT_MOVE_SEGMENT1 : JCAL_HINT_MOVE_SEGMENT2;
}

static void tell_status(const jcal_leg_t *self, const jcal_ball_result_t joints[2], const jcal_leg_places_t *places,
                        jcal_head_t *head)
{
    const bool moved = (joints[0].head.status == JCAL_MOVED) || (joints[1].head.status == JCAL_MOVED);
    const unsigned joint = open_joint(joints);
    const unsigned place = open_place(places);
    head->status = moved ? JCAL_MOVED : JCAL_COLLECTING;
    if (joint < (unsigned)JCAL_LEG_JOINTS) {
        head->weak = JCAL_WEAK_HEADING;
        head->hint = joints[joint].head.hint;
        head->reason = joints[joint].head.reason;
    } else if (place < JCAL_CHAIN_PLACES) {
        const bool contradicts = places->length_refused && !places->length_possible;
        head->weak = (place < (unsigned)JCAL_CHAIN_KNEE_TO_THIGH) ? JCAL_WEAK_CENTER1 : JCAL_WEAK_CENTER2;
        head->hint = hint_for(self, places, place);
        head->reason = contradicts ? JCAL_REASON_DOES_NOT_FIT : JCAL_REASON_UNCERTAIN;
    } else {
        head->status = JCAL_READY;
    }
}

static void tell_joint(const jcal_leg_t *self, const jcal_ball_result_t *joint, unsigned which, jcal_leg_result_t *out)
{
    const jcal_reason_t complaint = jcal_gate_complaint(&self->gate[which]);
    out->has_joint[which] = joint->has_estimate;
    out->heading[which] = joint->heading;
    out->uncertainty_heading_rad[which] = joint->uncertainty_heading_rad;
    out->joint_status[which] = joint->head.status;
    if (complaint != JCAL_REASON_NONE) {
        jcal_head_complain(&out->head, complaint, (which == 0u) ? JCAL_WEAK_CENTER1 : JCAL_WEAK_CENTER2);
        out->joint_status[which] = JCAL_COLLECTING;
        out->known[2u * which] = false;
        out->known[(2u * which) + 1u] = false;
    }
}

jcal_status_t jcal_leg_get(const jcal_leg_t *self, jcal_leg_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_ball_result_t joints[2];
    jcal_leg_places_t places;
    jcal_leg_places_now(self, joints, &places);
    jcal_clear(out, sizeof *out);
    for (unsigned i = 0u; i < JCAL_CHAIN_PLACES; ++i) {
        out->place_m[i] = places.at_m[i];
        out->uncertainty_m[i] = places.bound_m[i];
        out->known[i] = places.known[i];
    }
    out->segment_length_m = places.length_m;
    out->uncertainty_segment_m = places.length_bound_m;
    out->length_factor = places.factor;
    out->head.engine = JCAL_ENGINE_STREAM;
    tell_status(self, joints, &places, &out->head);
    tell_joint(self, &joints[1], 1u, out);
    tell_joint(self, &joints[0], 0u, out); /* of two complaints the hip's is told */
    const uint64_t hip_us = joints[0].head.t_us;
    const uint64_t knee_us = joints[1].head.t_us;
    out->head.t_us = (hip_us > knee_us) ? hip_us : knee_us;
    jcal_head_count(&out->head, self->samples, self->rejected_by);
    return JCAL_OK;
}
