/* SPDX-License-Identifier: MIT */
/// @file
/// Joint centre: where both sensors sit relative to the joint, from gyroscopes and accelerometers. Stream engine, and what both
/// engines share.
///
/// Primary sources: [OLS17], [SEE12]. Unknowns are r1 and r2, from the joint centre to sensor 1 and 2, each in its sensor's frame:
/// a_i = a_0 + K(w_i, dw_i) r_i, where a_0 is what both segments share, so that |a_1 - K_1 r1| = |a_2 - K_2 r2|.
#ifndef JCAL_CENTER_H
#define JCAL_CENTER_H

#include "jointcal/gate.h"
#include "jointcal/inbox.h"
#include "jointcal/kinematics.h"
#include "jointcal/status.h"
#include "jointcal/types.h"
#include "jointcal/watch.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What is minimised.
typedef enum {
    JCAL_CENTER_SS = 0,  ///< The sum of squared differences: (15), (16) of [OLS17] (default).
    JCAL_CENTER_SA = 1,  ///< The sum of absolute differences: (20) of [OLS17]; knocks count less.
    JCAL_CENTER_LS = 2   ///< Vectors instead of lengths, turned by the sensors' orientations: (9) to (14) of [OLS17].
} jcal_center_method_t;

/// The bound of something of which nothing is known, m.
#define JCAL_BOUND_UNKNOWN_M 10.0f

/// What both engines say.
typedef struct {
    jcal_calibration_t status;
    jcal_engine_t engine;
    jcal_weak_t weak;                ///< The unknown that keeps the status from `ready`, if there is one.
    jcal_hint_t hint;                ///< The motion that would help.
    jcal_reason_t reason;            ///< Why the status is not `ready`.
    bool has_center;                 ///< False until there is any estimate; then everything below is zero.
    jcal_vec3_t joint_to_sensor1_m;  ///< r1, from the joint centre to sensor 1, in sensor frame 1.
    jcal_vec3_t joint_to_sensor2_m;  ///< r2, from the joint centre to sensor 2, in sensor frame 2.
    /// 95 % bound of |r1 - truth|; JCAL_BOUND_UNKNOWN_M if unknown. With known hinge axes: across the axis.
    float uncertainty1_m;
    float uncertainty2_m;            ///< The same for r2.
    jcal_vec3_t weakest_direction1;  ///< Unit vector in sensor frame 1 along which r1 is known worst ...
    jcal_vec3_t weakest_direction2;  ///< ... and r2 in sensor frame 2.
    float uncertainty_weakest1_m;    ///< 95 % bound of the error of r1 along that direction.
    float uncertainty_weakest2_m;    ///< The same for r2.
    jcal_vec3_t
        acc_bias1_m_s2;  ///< Estimated bias of accelerometer 1 (part of it looks like a tilt and cannot be told).
    jcal_vec3_t acc_bias2_m_s2;  ///< The same of accelerometer 2.
    float heading_offset_rad;    ///< With JCAL_CENTER_LS: turns earth frame 2 to earth frame 1 about z; else 0.
    float misfit;                ///< Root of the share of the joint's effect that remains unexplained, 0 to 1.
    float progress1;             ///< 0 to 1: how far r1 is on the way to its bound.
    float progress2;             ///< The same for r2.
    uint64_t t_us;               ///< Time of the last sample that went into this result; 0 before any.
    uint32_t samples;            ///< Samples pushed.
    uint32_t rejected;           ///< Samples rejected, all causes.
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} jcal_center_result_t;

/// Settings that both engines share. Start from jcal_center_config_default().
typedef struct {
    jcal_gate_config_t gate;              ///< Limits of single samples.
    jcal_center_method_t method;          ///< Default JCAL_CENTER_SS.
    jcal_kinematics_config_t kinematics;  ///< Angular accelerations and smoothing.
    float max_bound_m;  ///< `ready` needs both bounds below this, m. Range [0.001, 0.1], default 0.01.
    /// What the model leaves out (scale, timing, the place of the accelerometer in its case): the floor of every bound, m.
    /// Range [0, 0.05], default 0.002.
    float mismatch_m;
    /// Usual difference of the two magnitudes in slow motion, m/s^2. Range [1e-3, 10], default 0.05.
    float acc_noise_m_s2;
    /// Growth of that difference with what the turning segments add, share. Range [0, 0.5], default 0.01.
    float turn_error;
    /// Standard deviation of each component of an accelerometer's bias, m/s^2. Range [0, 2], default 0.3; 0 turns these states off.
    float acc_bias_m_s2;
    /// Samples with both rates below this are left out, rad/s; 1.2 in [OLS17]. Range [0, 20], default 0: rest tells of biases.
    float min_rate_rad_s;
    /// Memory of the stream engine for what wanders, s: the accelerometers' biases, and with JCAL_CENTER_LS the heading, for which it is
    /// never more than 60 s. Data of twice this time count half. Range [10, 3600], default 300.
    float memory_s;
    /// Hinges: the joint axis in both sensor frames, unit vectors; both zero (default) for other joints. Any point on the axis is a
    /// centre; results are those next to both sensors, (11) and (12) of [SAL15], and bounds are those across the axis.
    jcal_vec3_t hinge_axis1;
    jcal_vec3_t hinge_axis2;
} jcal_center_config_t;

/// Number of features of the squared residual; lib/center/model.h says which.
#define JCAL_CENTER_FEATURES 19

/// Unknowns: r1, r2, biases of the accelerometers.
#define JCAL_CENTER_UNKNOWNS 12

/// Private: both joint-to-sensor vectors.
typedef struct {
    jcal_vec3_t r1, r2;
} jcal_center_place_t;

/// Private: a place and the other unknowns: with lengths the accelerometers' biases, with orientations the heading offset.
typedef struct {
    jcal_center_place_t place;
    jcal_vec3_t b1, b2;
    jcal_plane_t heading;  ///< Turns earth frame 2 to earth frame 1.
    bool is_oriented;      ///< Unknown 6 is the heading; biases are zero.
} jcal_center_point_t;

/// Private: sums at the estimate; lib/center/sums.h has the equations.
typedef struct {
    jcal_center_point_t point;   ///< The estimate.
    jcal_center_place_t anchor;  ///< Where it was when the sums began.
    float matrix[78];            ///< Packed 12 x 12.
    float gradient[12];          ///< Half the gradient at `point`, without that of the biases' prior.
    float scatter[78];           ///< Sum over blocks of gradient gradient' ...
    float closed[12];            ///< ... and of their gradients.
    float block[12];             ///< Gradient of the block that is being summed.
    float block_s;               ///< Its time.
    float blocks;                ///< Blocks in `scatter`.
    float cost;                  ///< Sum of squared residuals at `point`, weighted.
    float effect;                ///< The same of what the joint-to-sensor vectors explain: the residuals at r = 0.
    float noise;                 ///< The same of what the config calls usual.
    float weight;                ///< Sum of the weights, 1 / (m/s^2)^2.
    float raw;                   ///< Sum of squared residuals as they came in, weighted ...
    float lagged;                ///< ... and of products of those that are four samples apart.
    float recent[3][4];          ///< The last residuals, each part of them, m/s^2.
    float time_s;                ///< Time in the sums.
    float turn1, turn2;          ///< Integral of each sensor's squared rate.
} jcal_center_sums_t;

/// Private: the last judgement.
typedef struct {
    float bound1_m, bound2_m;            ///< As in the result.
    float weakest1_m, weakest2_m;        ///< As in the result.
    jcal_vec3_t direction1, direction2;  ///< As in the result.
    float misfit;                        ///< As in the result.
    uint8_t status, weak, hint, reason;  ///< As in the result.
    uint8_t agreed;                      ///< Judgements in a row that found nothing missing.
} jcal_center_verdict_t;

/// Private: bounds of one sensor's vector, m.
typedef struct {
    float all, weakest, second;
    jcal_vec3_t direction;
} jcal_center_bounds_t;

/// Private: work on the covariance of one state of the sums, a slice at a time.
typedef struct {
    float factor[78];  ///< Of the sums' matrix, prior included, scaled.
    float scale[12];   ///< Its scale.
    bool is_factored;  ///< There is a factor.
    float step[12];    ///< The Gauss-Newton step from it.
    union {
        struct {
            float matrix[78], scale[12];
        } next;                ///< What the next factor is made of ...
        float columns[6][12];  ///< ... and then those columns of the inverse that belong to r1 and r2.
    } of;
    float covariance[2][6];  ///< Of r1 and of r2, packed, from the scatter ...
    float least[2][6];       ///< ... and what it is at least, from the matrix.
    float fake[6];           ///< Direction of whose information the largest share may be none, scaled ...
    float fake_share;        ///< ... that share ...
    float lasting_m;  ///< ... how far that part of what is unexplained that lasts may have shifted the estimate ...
    float hidden_m;   ///< ... and all of it.
    jcal_center_bounds_t bounds[2];
} jcal_center_inverse_t;

/// Private: what both engines work with.
typedef struct {
    jcal_center_sums_t sums;
    jcal_center_verdict_t verdict;
    union {
        float moments[190];             ///< Packed 19 x 19: products of the features, before the sums begin ...
        jcal_center_inverse_t inverse;  ///< ... and after.
    } as;
} jcal_center_work_t;

/// Private: from readings to samples.
typedef struct {
    jcal_gate_t gate;
    jcal_inbox_t inbox;
    jcal_attitudes_t attitudes[JCAL_INBOX_CAPACITY];  ///< Of the pairs in the inbox.
    jcal_kinematics_t kinematics;
} jcal_center_input_t;

/// The stream engine. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_center_config_t cfg;
    jcal_center_input_t input;
    jcal_center_place_t start;  ///< Minimum of the moments.
    jcal_plane_t heading;       ///< Sum that points along the heading offset at `start` ...
    float heading_s;            ///< ... and its time.
    jcal_center_work_t work;
    jcal_watch_t watch;
    float moving_s;   ///< Time of motion in the moments.
    uint64_t t_us;    ///< Time of the last sample in the sums.
    uint8_t turn;     ///< Next item of the cycle.
    bool has_start;   ///< `start` is a minimum.
    bool has_point;   ///< The sums have begun.
    bool has_worked;  ///< Work was done since the last sample.
} jcal_center_t;

/// The defaults described at each field.
jcal_center_config_t jcal_center_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid.
const char *jcal_center_config_check(const jcal_center_config_t *config);

/// Prepares an estimator; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_center_config_check says which field); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_center_init(jcal_center_t *self, const jcal_center_config_t *config);

/// Takes in one sample pair: checks it and puts it into the inbox. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG (null, or JCAL_CENTER_LS); JCAL_ERR_FULL.
jcal_status_t jcal_center_push(jcal_center_t *self, const jcal_pair_t *pair);

/// The same with both sensors' orientations, each to its earth frame: with JCAL_CENTER_LS it needs them.
///
/// Returns:  as jcal_center_push; a quaternion that is not of length 1 is JCAL_REJECTED as out of range.
jcal_status_t jcal_center_push_oriented(jcal_center_t *self, const jcal_pair_t *pair,
                                        const jcal_attitudes_t *attitudes);

/// Works off one sample of the inbox and one bounded slice of solving.
///
/// Returns:  JCAL_OK; JCAL_IDLE if the inbox was empty; JCAL_ERR_ARG.
jcal_status_t jcal_center_step(jcal_center_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
jcal_status_t jcal_center_update(jcal_center_t *self, const jcal_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_center_get(const jcal_center_t *self, jcal_center_result_t *out);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_center_reset(jcal_center_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_CENTER_H */
