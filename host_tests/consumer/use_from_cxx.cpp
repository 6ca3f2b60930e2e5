/* SPDX-License-Identifier: MIT */
/* The library from C++: all of its functions that a C++ program needs must link. */
#include "jointcal/jointcal.h"

#include <cstring>

int main()
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    jcal_hinge_t hinge;
    if (jcal_hinge_init(&hinge, &config) != JCAL_OK) {
        return 1;
    }
    const jcal_pair_t pair = {};
    (void)jcal_hinge_update(&hinge, &pair);
    jcal_hinge_result_t result;
    if (jcal_hinge_get(&hinge, &result) != JCAL_OK || result.head.samples != 1) {
        return 1;
    }
    return std::strcmp(jcal_version(), JCAL_VERSION_STRING);
}
