/* SPDX-License-Identifier: MIT */
/* What a user's project does first: include, init, compare the versions of header and library. */
#include "jointcal/jointcal.h"

#include <string.h>

int main(void)
{
    const jcal_hinge_config_t config = jcal_hinge_config_default();
    jcal_hinge_t hinge;
    if (jcal_hinge_init(&hinge, &config) != JCAL_OK) {
        return 1;
    }
    return strcmp(jcal_version(), JCAL_VERSION_STRING);
}
