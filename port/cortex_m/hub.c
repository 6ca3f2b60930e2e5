/* SPDX-License-Identifier: MIT */
/* What a hub's firmware uses of the library, for its size: one stream engine, fed and read. With HUB_EMPTY the same program
 * without it; tools/budget.py reports the difference of the two linked images. */
#include "jointcal/hinge.h"

extern volatile jcal_pair_t hub_pair;
extern volatile float hub_axis_x;
volatile jcal_pair_t hub_pair;
volatile float hub_axis_x;

#ifndef HUB_EMPTY
static jcal_hinge_t engine;
#endif

int main(void)
{
    const jcal_pair_t pair = hub_pair;
#ifdef HUB_EMPTY
    hub_axis_x = pair.imu1.acc_m_s2.x;
#else
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    jcal_hinge_result_t result;
    if ((jcal_hinge_init(&engine, &config) != JCAL_OK) || (jcal_hinge_update(&engine, &pair) != JCAL_OK) ||
        (jcal_hinge_get(&engine, &result) != JCAL_OK)) {
        return 1;
    }
    hub_axis_x = result.axis1.x;
#endif
    return 0;
}
