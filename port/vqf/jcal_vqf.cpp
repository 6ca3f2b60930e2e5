/* SPDX-License-Identifier: MIT */
/* VQF in storage of the caller. */
#include "jcal_vqf.h"

#include <vqf.hpp>

#include <cmath>
#include <new>
#include <type_traits>

static_assert(sizeof(vqf_real_t) == sizeof(float), "VQF must be compiled with VQF_SINGLE_PRECISION");
static_assert(sizeof(jcal_vqf_t) == sizeof(VQF), "JCAL_VQF_BYTES is not the size of VQF's state");
static_assert(alignof(jcal_vqf_t) >= alignof(VQF), "jcal_vqf_t is not aligned for VQF");
/* Storage may be dropped or reused without telling us. */
static_assert(std::is_trivially_destructible<VQF>::value, "VQF owns something");

static VQF *filter_of(jcal_vqf_t *self)
{
    return static_cast<VQF *>(static_cast<void *>(self->bytes));
}

static bool period_valid(float period_s)
{
    return period_s >= JCAL_VQF_PERIOD_MIN_S && period_s <= JCAL_VQF_PERIOD_MAX_S;
}

static bool finite3(const float v[3])
{
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

jcal_status_t jcal_vqf_init(jcal_vqf_t *self, float gyr_period_s, float acc_period_s)
{
    if (self == nullptr) {
        return JCAL_ERR_ARG;
    }
    if (!period_valid(gyr_period_s) || !period_valid(acc_period_s)) {
        return JCAL_ERR_CONFIG;
    }
    (void)new (self->bytes) VQF(gyr_period_s, acc_period_s);
    return JCAL_OK;
}

jcal_status_t jcal_vqf_update(jcal_vqf_t *self, const float gyr[3], const float acc[3], float quat[4])
{
    if (self == nullptr || gyr == nullptr || acc == nullptr || quat == nullptr) {
        return JCAL_ERR_ARG;
    }
    if (!finite3(gyr) || !finite3(acc)) {
        return JCAL_REJECTED;
    }
    VQF *filter = filter_of(self);
    filter->update(gyr, acc);
    filter->getQuat6D(quat);
    return JCAL_OK;
}

jcal_status_t jcal_vqf_reset(jcal_vqf_t *self)
{
    if (self == nullptr) {
        return JCAL_ERR_ARG;
    }
    filter_of(self)->resetState();
    return JCAL_OK;
}
