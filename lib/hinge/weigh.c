/* SPDX-License-Identifier: MIT */
/// @file
/// A sample and how much it counts. See hinge/weigh.h.
#include "hinge/weigh.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"

#include <math.h>

/// Keeps the weight 1 / (|w1|^2 + |w2|^2 + eps) finite at rest, (rad/s)^2; docs/METHOD.md section 2.
#define RATE_EPS 0.05f

/// Time constant of the product of the rates, s.
#define PRODUCT_TIME_S 0.2f

/// Readings of the same pose add little: their weight falls like 1 / (1 + t) while both specific forces stay within
/// this, (m/s^2)^2, and is nothing after DWELL_MAX_S: hours of it would only round.
#define DWELL_ACC2 1.0f
#define DWELL_MAX_S 10.0f

/// Rest: both rates below this, squared sum, (rad/s)^2. Its weight falls like 1 / (1 + t^2), so that a rest of any length counts as
/// 1.6 s.
#define REST_RATE2 0.02f

/// Errors in |w1| - |w2| that no joint motion causes: scale errors as a share of the rate, and noise, rad/s.
#define DIFFERENCE_SHARE 0.03f
#define DIFFERENCE_NOISE_RAD_S 0.02f

/// Memory of the joint's turn, s, and the turn below which what is met may be trembling, rad: 3 deg at 2 Hz are 0.65 rad/s, at 12 Hz
/// 4 rad/s, and no joint is shaken like that.
#define BEND_TIME_S 1.0f
#define BEND_MIN_RAD 0.04f

/// Variance of the accelerometers' residual (25) of [OLS20], (m/s^2)^2: it grows with fast motion, where (17) is not zero.
static float acc_variance(const jcal_hinge_weigh_t *self, const jcal_hinge_config_t *cfg)
{
    const float violation = cfg->lever_arm_m * self->rate_product;
    return (cfg->acc_noise_m_s2 * cfg->acc_noise_m_s2) + (violation * violation);
}

/// Weight of the accelerometer reading: less in fast motion and while a pose lasts.
static float acc_weight(jcal_hinge_weigh_t *self, const jcal_hinge_sample_t *sample)
{
    const jcal_vec3_t away1 = jcal_vec3_sub(sample->a1, self->rest_acc1);
    const jcal_vec3_t away2 = jcal_vec3_sub(sample->a2, self->rest_acc2);
    if ((jcal_vec3_dot(away1, away1) + jcal_vec3_dot(away2, away2)) > DWELL_ACC2) {
        self->rest_acc1 = sample->a1;
        self->rest_acc2 = sample->a2;
        self->dwell_s = 0.0f;
    }
    self->dwell_s += sample->dt_s;
    if (self->dwell_s > DWELL_MAX_S) {
        return 0.0f; /* so small a weight would only round */
    }
    return (sample->dt_s / JCAL_HINGE_UNIT_S) / (sample->acc_variance * (1.0f + self->dwell_s));
}

jcal_hinge_sample_t jcal_hinge_weigh(jcal_hinge_weigh_t *self, const jcal_hinge_config_t *cfg, const jcal_pair_t *pair,
                                     float dt_s)
{
    jcal_hinge_sample_t sample;
    sample.w1 = pair->imu1.gyr_rad_s;
    sample.w2 = pair->imu2.gyr_rad_s;
    sample.a1 = pair->imu1.acc_m_s2;
    sample.a2 = pair->imu2.acc_m_s2;
    sample.w1_2 = jcal_vec3_dot(sample.w1, sample.w1);
    sample.w2_2 = jcal_vec3_dot(sample.w2, sample.w2);
    sample.dt_s = dt_s;
    const float share = dt_s / (dt_s + PRODUCT_TIME_S);
    self->rate_product += share * (sqrtf(sample.w1_2 * sample.w2_2) - self->rate_product);
    self->rest_s = ((sample.w1_2 + sample.w2_2) < REST_RATE2) ? (self->rest_s + dt_s) : 0.0f;
    sample.acc_variance = acc_variance(self, cfg);
    sample.acc_weight = acc_weight(self, &sample);
    const float noise = cfg->gyr_noise_rad_s;
    sample.gyr_weight = (dt_s / JCAL_HINGE_UNIT_S) / (noise * noise * (sample.w1_2 + sample.w2_2 + RATE_EPS) *
                                                      (1.0f + (self->rest_s * self->rest_s)));
    return sample;
}

void jcal_hinge_count(jcal_hinge_amount_t *self, const jcal_hinge_sample_t *sample)
{
    const float difference = fabsf(sqrtf(sample->w1_2) - sqrtf(sample->w2_2));
    const float errors = (DIFFERENCE_SHARE * sqrtf(jcal_max(sample->w1_2, sample->w2_2))) + DIFFERENCE_NOISE_RAD_S;
    const float excess = jcal_max(difference - errors, 0.0f);
    const float signed_excess = (sample->w1_2 < sample->w2_2) ? excess : -excess;
    self->bend += sample->dt_s * (signed_excess - (self->bend / BEND_TIME_S));
    self->excitation += (fabsf(self->bend) > BEND_MIN_RAD) ? (sample->dt_s * excess * excess) : 0.0f;
    self->motion += sample->dt_s * (sample->w1_2 + sample->w2_2);
    self->weight_acc2 += sample->acc_weight * sample->acc_weight / sample->dt_s;
}
