/* SPDX-License-Identifier: MIT */
/// @file
/// Joint with two degrees of freedom: both axes and the heading offset from orientations. Stream engine, and what both engines share.
///
/// Primary source: [LAI22]. Unknowns are j1, the unit axis fixed in segment 1 (sensor frame 1), j2, that fixed in segment 2 (sensor
/// frame 2), and the heading offset delta: v_E1 = Rz(delta) v_E2.
#ifndef JCAL_TWO_DOF_H
#define JCAL_TWO_DOF_H

#include "jointcal/orientation.h"
#include "jointcal/status.h"
#include "jointcal/watch.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Which constraint of the joint is used.
typedef enum {
    JCAL_CONSTRAINT_COMBINED = 0,    ///< Both of the following (default).
    JCAL_CONSTRAINT_ROTATION = 1,    ///< The segments do not turn against each other about j1 x j2: (7) of [LAI22].
    JCAL_CONSTRAINT_ORIENTATION = 2  ///< The angle between j1 and j2 does not change: (13) of [LAI22].
} jcal_constraint_t;

/// What both engines say.
typedef struct {
    jcal_calibration_t status;
    jcal_engine_t engine;
    jcal_weak_t weak;          ///< The unknown that keeps the status from `ready`, if there is one.
    jcal_hint_t hint;          ///< The motion that would help.
    jcal_reason_t reason;      ///< Why the status is not `ready`.
    bool has_axes;             ///< False until there is any estimate; then axes, heading and carrying angle are zero.
    jcal_vec3_t axis1;         ///< Unit axis j1 in sensor frame 1; its largest component is positive.
    jcal_vec3_t axis2;         ///< Unit axis j2 in sensor frame 2; its largest component is positive.
    float heading_offset_rad;  ///< delta, in (-pi, pi]: turns earth frame 2 to earth frame 1 about z.
    float carrying_angle_rad;  ///< beta0: j1 . j2 = sin(beta0) in a common frame.
    /// 95 % bound of the angle between axis1 and the truth; a right angle if unknown, as while other axes explain the data as well.
    float uncertainty1_rad;
    float uncertainty2_rad;         ///< The same for axis2.
    float uncertainty_heading_rad;  ///< 95 % bound of the error of the heading offset at the time t_us.
    float progress_axis1;           ///< 0 to 1: how far axis1 is on the way to its bound.
    float progress_axis2;           ///< The same for axis2.
    float progress_heading;         ///< The same for the heading offset.
    uint64_t t_us;                  ///< Time of the last sample that went into this result; 0 before any.
    uint32_t samples;               ///< Samples pushed.
    uint32_t rejected;              ///< Samples rejected, all causes.
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} jcal_two_dof_result_t;

/// Settings that both engines share. Start from jcal_two_dof_config_default().
typedef struct {
    jcal_gate_config_t gate;       ///< Of it, frozen_s and gap_s.
    jcal_constraint_t constraint;  ///< Default JCAL_CONSTRAINT_COMBINED.
    float max_bound_rad;           ///< `ready` needs all bounds below this, rad. Range [0.001, 0.5], default 3 deg.
    /// What the model leaves out (scale, misalignment, inclination errors): added to every bound, rad. Range [0, 0.1], default 0.75 deg.
    float mismatch_rad;
    /// Usual violation of the rotation-based constraint at rest, rad/s; grows by rate_error. Range [1e-3, 1], default 0.02.
    float rate_noise_rad_s;
    float
        rate_error;  ///< Growth of that violation with the rates of both sensors, share. Range [0, 0.5], default 0.02.
    float
        angle_noise_rad;  ///< Usual violation of the orientation-based constraint, rad. Range [1e-3, 0.5], default 0.013.
    float heading_drift_rad_s;  ///< How fast the heading offset may drift. Range [0, 0.05], default 3 deg/min.
    /// How long the heading offset is remembered once the status is `ready`, s: older data count for the axes only. Range [2, 600],
    /// default 5.
    float memory_s;
} jcal_two_dof_config_t;

/// Number of features of each constraint; lib/two_dof/model.h says which.
#define JCAL_TWO_DOF_FEATURES 27

/// Private: the unknowns.
typedef struct {
    jcal_vec3_t j1, j2;
    jcal_plane_t heading;  ///< exp(i delta).
} jcal_two_dof_point_t;

/// Private: weighted sums over all samples.
typedef struct {
    float rotation[378];     ///< 27 x 27, packed: products of the features of the rotation-based constraint.
    float orientation[378];  ///< The same for the orientation-based one.
    float mean[27];          ///< Sum of the features of the orientation-based one.
    float weight;            ///< Sum of its weights.
} jcal_two_dof_moments_t;

/// Private: cost at a point with half its gradient and Gauss-Newton matrix; the unknowns are the steps of j1 (2), j2 (2) and delta.
typedef struct {
    float cost;
    float gradient[5];
    float matrix[15];  ///< 5 x 5, packed.
} jcal_two_dof_lin_t;

/// Private: what forgotten samples said of the axes, as a quadratic around an anchor.
typedef struct {
    jcal_vec3_t j1, j2;  ///< The anchor.
    float gradient[4];   ///< Half the gradient there.
    float matrix[10];    ///< 4 x 4, packed.
} jcal_two_dof_prior_t;

/// Private: an iteration under way.
typedef struct {
    jcal_two_dof_point_t point;
    jcal_two_dof_point_t from;  ///< The point before the last step.
    float from_cost;            ///< Its cost.
    float predicted;            ///< Change of cost that was promised for the step.
    float damping;
    uint8_t steps;
} jcal_two_dof_probe_t;

/// Private: where the work stands.
typedef struct {
    jcal_two_dof_probe_t probe;
    jcal_two_dof_point_t rival;  ///< Best other minimum.
    jcal_two_dof_lin_t lin;      ///< Of the point that is being worked on, rotation-based part first.
    float parts[2];              ///< Of the cost at the estimate: rotation-based, orientation-based ...
    float cost;                  ///< Cost of the estimate, prior included ...
    float rival_cost;            ///< ... and of the rival.
    uint8_t turn;                ///< Next item of the cycle.
    uint8_t start;               ///< Which start the probe came from.
    uint8_t tried;               ///< Probes that ended since the sums began.
    uint8_t agreed;              ///< Judgements in a row that found nothing missing.
    uint8_t since_exchange;      ///< Starts since the exchanged axes were one.
    uint8_t exchanges;           ///< How often they were, with this estimate.
    uint8_t misfits;             ///< Judgements in a row that found that the data do not fit.
    bool half;                   ///< The rotation-based half of `lin` is done.
    bool probing, has_rival;
} jcal_two_dof_search_t;

/// Private: the last judgement.
typedef struct {
    float bound1_rad;
    float bound2_rad;
    float bound_heading_rad;
    float sine;  ///< Mean of the orientation-based constraint: sine of the carrying angle.
    float
        excess;  ///< Residuals, squared, over what the config takes for usual, at least 1: divides the data's information.
    uint8_t status, weak, hint, reason;  ///< As in jcal_two_dof_result_t.
} jcal_two_dof_verdict_t;

/// Private: orientations that wait for step, and the last ones before them. A power of two.
#define JCAL_TWO_DOF_RING 4u

/// The stream engine. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_two_dof_config_t cfg;
    jcal_orientation_gate_t gate;
    jcal_orientation_pair_t ring[JCAL_TWO_DOF_RING];
    volatile uint32_t written;  ///< Orientations ever put in; written by push only.
    volatile uint32_t taken;    ///< Orientations ever taken out; written by step only.
    jcal_two_dof_moments_t moments;
    jcal_two_dof_prior_t prior;
    jcal_two_dof_probe_t best;
    jcal_two_dof_search_t search;
    jcal_two_dof_verdict_t verdict;
    uint64_t t_us;              ///< Time of the last sample in the sums.
    jcal_plane_t heading_then;  ///< Heading offset when the sums were last faded ...
    float drift_rad_s;          ///< ... and how fast it drifts.
    float age_s;                ///< Mean age of what is in the sums.
    float moving_s;             ///< Time in the sums, rest left out.
    float since_forgot_s;       ///< Time since the sums were last faded.
    uint8_t pushes;             ///< Samples since one was last kept.
    uint8_t share;              ///< Items of work per call of step.
    uint8_t item;               ///< Next item of work on the sample last taken.
    float time_s;   ///< Weight of the sample that is being summed, s: its time, less if there is little motion.
    bool odd;       ///< Every other sample, once the status is ready, gets a slice of the search.
    bool recovers;  ///< A sensor has moved since the status was `ready`.
    bool has_best;
    jcal_watch_t watch;  ///< Of the rotation-based and the orientation-based residual.
} jcal_two_dof_t;

/// The defaults described at each field.
jcal_two_dof_config_t jcal_two_dof_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid.
const char *jcal_two_dof_config_check(const jcal_two_dof_config_t *config);

/// Prepares an estimator; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_two_dof_config_check says which field); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_two_dof_init(jcal_two_dof_t *self, const jcal_two_dof_config_t *config);

/// Takes in one pair of orientations: checks it and keeps about 25 a second. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL.
jcal_status_t jcal_two_dof_push(jcal_two_dof_t *self, const jcal_orientation_pair_t *pair);

/// Works off one bounded share of what is to be done.
///
/// Returns:  JCAL_OK; JCAL_IDLE if there is nothing to do; JCAL_ERR_ARG.
jcal_status_t jcal_two_dof_step(jcal_two_dof_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
jcal_status_t jcal_two_dof_update(jcal_two_dof_t *self, const jcal_orientation_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_two_dof_get(const jcal_two_dof_t *self, jcal_two_dof_result_t *out);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_two_dof_reset(jcal_two_dof_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_DOF_H */
