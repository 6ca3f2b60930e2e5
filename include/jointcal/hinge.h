/* SPDX-License-Identifier: MIT */
/// @file
/// Hinge joint: both joint axes from gyroscopes and accelerometers. Stream engine, and what both engines share.
///
/// Primary source: [OLS20]. Unknowns are j1 and j2, the unit joint axis in sensor frames 1 and 2.
#ifndef JCAL_HINGE_H
#define JCAL_HINGE_H

#include "jointcal/gate.h"
#include "jointcal/inbox.h"
#include "jointcal/status.h"
#include "jointcal/types.h"
#include "jointcal/watch.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the user knows about the sign pairing beforehand.
typedef enum {
    JCAL_SIGN_UNKNOWN = 0,  ///< Find it out (default).
    JCAL_SIGN_SAME = 1,     ///< The largest components of axis1 and axis2 have the same sign.
    JCAL_SIGN_OPPOSITE = 2  ///< They have opposite signs.
} jcal_sign_hint_t;

/// The bound of something of which nothing is known: a right angle, the largest angle between two lines, rad.
#define JCAL_BOUND_UNKNOWN_RAD 1.57079633f

/// What both hinge engines say.
typedef struct {
    jcal_calibration_t status;
    jcal_engine_t engine;
    jcal_weak_t weak;      ///< The unknown that keeps the status from `ready`, if there is one.
    jcal_hint_t hint;      ///< The motion that would help.
    jcal_reason_t reason;  ///< Why the status is not `ready`.
    bool has_axes;         ///< False until there is any estimate; then axis1, axis2 are zero.
    bool paper_accepted;   ///< Window engine: what Algorithm 4 of [OLS20] says. Stream engine: false.
    jcal_vec3_t axis1;     ///< Unit joint axis in sensor frame 1; its largest component is positive.
    jcal_vec3_t axis2;     ///< Unit joint axis in sensor frame 2, sign following the pairing.
    /// 95 % bound of the angle between axis1 and the truth; JCAL_BOUND_UNKNOWN_RAD if unknown.
    float uncertainty1_rad;
    float uncertainty2_rad;  ///< The same for axis2.
    float sign_margin;       ///< Cost of the other sign pairing over the cost of this one; 0 while unknown.
    float progress_axis1;    ///< 0 to 1: how far axis1 is on the way to its bound.
    float progress_axis2;    ///< The same for axis2.
    float progress_sign;     ///< The same for the evidence of the sign pairing.
    uint64_t t_us;           ///< Time of the last sample that went into this result; 0 before any.
    uint32_t samples;        ///< Samples pushed.
    uint32_t rejected;       ///< Samples rejected, all causes.
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} jcal_hinge_result_t;

/// Settings that both hinge engines share. Start from jcal_hinge_config_default().
///
/// The noise and bias fields set how much each kind of data counts and what may be blamed on a bias; bounds are made
/// from the residuals that are really met, so that a wrong value here costs sharpness, not honesty.
typedef struct {
    jcal_gate_config_t gate;  ///< Limits of single samples.
    float max_bound_rad;      ///< `ready` needs both bounds below this, rad. Range [0.001, 0.5], default 3 deg.
    /// What the model leaves out (scale, misalignment, timing of the gyroscopes), as a share of the rate: the floor
    /// of every bound. Range [0, 0.05], default 0.002. Larger: wider bounds.
    float rate_mismatch;
    /// Usual disagreement of the two rates across the axis, rad/s. Range [1e-4, 1], default 0.03.
    float gyr_noise_rad_s;
    /// Usual disagreement of the two specific forces along the axis in slow motion, m/s^2, with what it lasts longer
    /// than that of the rates. Range [1e-3, 10], default 1.5.
    float acc_noise_m_s2;
    /// Growth of that disagreement with the product of the rates, m: the distance from the joint axis, again with its
    /// longer duration. Range [0, 5], default 1.
    float lever_arm_m;
    float gyr_bias_rad_s;        ///< Standard deviation of each component of a gyroscope's bias, rad/s.
                                 ///< Range [1e-5, 0.2], default 0.007 (0.4 deg/s). 1e-5 turns the bias states off.
    float acc_bias_m_s2;         ///< The same of an accelerometer, m/s^2. Range [1e-4, 5], default 0.5.
    jcal_sign_hint_t sign_hint;  ///< Default JCAL_SIGN_UNKNOWN.
    /// Slices of work per second of sample time, a quarter of it once `ready`; at most 10 in one step. Range [20, 800], default
    /// 200. Fewer: less work in the busiest step, longer until `ready`; docs/METHOD.md, section 8, has the measured trade.
    float slices_per_s;
} jcal_hinge_config_t;

/// Number of features of the gyroscope residual; lib/hinge/model.h says which.
#define JCAL_HINGE_FEATURES 12

/// Private: weighted sums over all samples, packed symmetric.
typedef struct {
    float gyr[78];  ///< 12 x 12: products of the gyroscope features.
    float acc[28];  ///< 7 x 7: products of (a1, -a2, 1).
} jcal_hinge_moments_t;

/// Private: one axis and a direction across it.
typedef struct {
    jcal_vec3_t j;
    jcal_vec3_t u;
} jcal_hinge_axis_t;

/// Private: a point of the parameter space.
typedef struct {
    jcal_hinge_axis_t axis1;
    jcal_hinge_axis_t axis2;
} jcal_hinge_point_t;

/// Private: a point without its tangent directions.
typedef struct {
    jcal_vec3_t j1, j2;
} jcal_hinge_place_t;

/// Private: one sensor's rate, less its bias, in the directions of its axis.
typedef struct {
    jcal_plane_t across;  ///< Along u and v.
    float along;          ///< Along j.
} jcal_hinge_view_t;

/// Private: sums of the current block; lib/hinge/refine.h has the equations.
typedef struct {
    float matrix[45];          ///< Packed 9 x 9: tilts of axis 1, of axis 2, biases of sensor 1, of sensor 2, phase.
    float gradient[9];         ///< Half the gradient in the same unknowns.
    float acc_score[4];        ///< Half the gradient of the accelerometer part.
    float power2;              ///< Weighted sum of |z2|^2; that of |z1|^2 is in the matrix.
    float units;               ///< Time in units of one reading.
    float joint;               ///< Weighted sum of the joint's own squared rate.
    float time_s;              ///< Time in the block.
    jcal_plane_t match;        ///< How z1, turned, matches z2.
    jcal_plane_t match_other;  ///< The same for the other sign pairing.
    jcal_plane_t turn_other;   ///< exp(-i theta) of the other pairing.
    jcal_plane_t path1;        ///< Integral of z1 since the block began.
    jcal_plane_t path2;
} jcal_hinge_block_t;

/// Private: what the last seconds alone say of the axes; lib/hinge/slip.h.
typedef struct {
    float gradient[4];  ///< Half the gradient of the tilts, biases eliminated.
    float matrix[10];   ///< Packed 4 x 4.
    float cost;         ///< Squared residuals, in units of the assumed noise.
    float units;        ///< Readings.
    float time_s;
} jcal_hinge_slip_t;

/// Private: the refined axes and the sums that they rest on.
typedef struct {
    jcal_hinge_point_t point;   ///< The axes.
    jcal_hinge_place_t anchor;  ///< Where they were when the sums began.
    float bias[4];              ///< Biases of the gyroscopes along u1, v1, u2, v2, in standard deviations.
    jcal_hinge_block_t block;
    jcal_hinge_view_t last1;  ///< The previous sample.
    jcal_hinge_view_t last2;
    jcal_plane_t phase;  ///< p exp(-i theta): turns z1 into z2.
    float phase_weight;  ///< How well it is known from earlier blocks; 0: not at all.
    float matrix[36];    ///< Packed 8 x 8, all blocks, phases eliminated.
    float gradient[8];   ///< Half the gradient at `point`.
    float gain[4][4];    ///< What a bias of one unit moves the tilts' gradient by, biases eliminated.
    float scatter[10];   ///< Sum of score score' over blocks, biases eliminated.
    float lean[4];       ///< Sum of the scores, each times its block's information.
    float information;   ///< Sum of the blocks' information, the trace of the tilts' part ...
    float information2;  ///< ... and of its squares.
    float told[2];       ///< The same for the tilts of each axis alone ...
    float told2[2];      ///< ... and of its squares.
    float cost;          ///< Sum of the squared residuals, in units of the assumed noise.
    float units;         ///< Readings that went in.
    float joint;         ///< Sum of the joint's own squared rate, in the units of the cost ...
    float along[2];      ///< ... of that along each axis ...
    float lever[2];      ///< ... of its magnitude times that of both rates ...
    float across;        ///< ... and of that across the axes, mean of both.
    float blocks;        ///< How many blocks.
    float time_s;        ///< Time that they cover.
    float same;          ///< Residual of this sign pairing, as a share of what could match, integrated over time ...
    float other;         ///< ... of the other pairing ...
    float sign_time_s;   ///< ... and the time for which there was something to match.
    jcal_hinge_slip_t slip;
    bool has_last;
} jcal_hinge_refine_t;

/// Private: where the search for other minima stands.
typedef struct {
    jcal_hinge_place_t probe;  ///< Where the probe is.
    jcal_hinge_place_t rival;  ///< Best other minimum.
    jcal_hinge_place_t flip;   ///< Best axes of the other sign pairing.
    float damping;
    uint8_t rounds;      ///< Complete rounds over all starts since the joint first moved.
    uint8_t start;       ///< Which start the probe came from.
    uint8_t iterations;  ///< Steps that the probe has made.
    bool running, has_flip, has_rival;
} jcal_hinge_search_t;

/// Private: the last judgement.
typedef struct {
    float bound1_rad;
    float bound2_rad;
    float sign_margin;
    float sign_progress;
    uint8_t status, weak, hint, reason;  ///< As in jcal_hinge_result_t.
} jcal_hinge_verdict_t;

/// The stream engine. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_hinge_config_t cfg;
    jcal_gate_t gate;
    jcal_inbox_t inbox;
    jcal_hinge_moments_t moments;
    jcal_hinge_point_t point;  ///< Minimum of the moments: where the refined axes begin.
    jcal_hinge_refine_t refine;
    jcal_hinge_search_t search;
    jcal_hinge_verdict_t verdict;
    jcal_watch_t watch;     ///< Of the gyroscopes' residual and the accelerometers'.
    jcal_vec3_t rest_acc1;  ///< Specific forces at which the present dwelling began ...
    jcal_vec3_t rest_acc2;
    float dwell_s;       ///< ... and how long it has lasted.
    float rest_s;        ///< How long neither sensor has turned.
    float rate_product;  ///< Low-passed |w1| |w2|.
    float weight_acc;    ///< Sum of accelerometer weights ...
    float weight_acc2;   ///< ... and of their squares per second.
    float motion;        ///< Integral of the squared rates: what the sums are limited by.
    /// Integral of the squared difference of |w1| and |w2| beyond what errors make.
    float excitation;
    float acc_constant_m_s2;  ///< Estimate of c = j1 . b_a1 - j2 . b_a2.
    float damping;
    float credit_s;  ///< Time not yet paid for with slices of work.
    uint64_t last_us;
    uint8_t slice;   ///< Next slice of the cycle.
    uint8_t agreed;  ///< Judgements in a row that found nothing missing.
    bool has_last, has_point;
} jcal_hinge_t;

/// The defaults described at each field.
jcal_hinge_config_t jcal_hinge_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid.
const char *jcal_hinge_config_check(const jcal_hinge_config_t *config);

/// Prepares an estimator; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_hinge_config_check says which field); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_hinge_init(jcal_hinge_t *self, const jcal_hinge_config_t *config);

/// Takes in one sample pair: checks it and puts it into the inbox. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL.
jcal_status_t jcal_hinge_push(jcal_hinge_t *self, const jcal_pair_t *pair);

/// Works off one sample of the inbox and one bounded slice of solving.
///
/// Returns:  JCAL_OK; JCAL_IDLE if the inbox was empty; JCAL_ERR_ARG.
jcal_status_t jcal_hinge_step(jcal_hinge_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
jcal_status_t jcal_hinge_update(jcal_hinge_t *self, const jcal_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_hinge_get(const jcal_hinge_t *self, jcal_hinge_result_t *out);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_hinge_reset(jcal_hinge_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_H */
