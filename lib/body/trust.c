/* SPDX-License-Identifier: MIT */
/// @file
/// What is believed of what a joint's engine says. See body/trust.h.
#include "body/trust.h"

void jcal_trust(const jcal_trust_t *trust, jcal_head_t *head)
{
    if ((trust->bad1 != 0u) || (trust->bad2 != 0u)) {
        head->status = JCAL_COLLECTING;
        head->reason = JCAL_REASON_SENSOR_BAD;
        head->hint = JCAL_HINT_CHECK_SENSORS;
        head->weak = (trust->bad1 != 0u) ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2;
    } else if (trust->not_one) {
        head->status = JCAL_COLLECTING;
        head->reason = JCAL_REASON_NOT_ONE_JOINT;
        head->hint = JCAL_HINT_CHECK_SENSORS;
        head->weak = JCAL_WEAK_AXIS1;
    } else if (!trust->lag_known && (head->status == JCAL_READY)) {
        head->status = JCAL_COLLECTING;
        head->reason = JCAL_REASON_OUT_OF_STEP;
        head->hint = JCAL_HINT_MOVE_JOINT;
        head->weak = JCAL_WEAK_HEADING;
    } else {
        /* the engine's word stands */
    }
}

uint16_t jcal_trust_findings(uint16_t before, const jcal_health_result_t *result)
{
    unsigned named = before;
    for (unsigned k = 0u; k < (unsigned)JCAL_FINDING_COUNT; ++k) {
        const unsigned bit = 1u << k;
        if (result->state[k] == JCAL_HEALTH_NAMED) {
            named |= bit;
        } else if (result->state[k] == JCAL_HEALTH_FINE) {
            named &= ~bit;
        } else {
            /* not told */
        }
    }
    return (uint16_t)(named & JCAL_TRUST_BAD);
}
