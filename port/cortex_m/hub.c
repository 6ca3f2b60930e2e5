/* SPDX-License-Identifier: MIT */
/* What a hub's firmware uses of the library, for its size: one stream engine, fed and read. With HUB_FUNCTIONAL two sensors and one
 * functional hinge instead, with HUB_TWO_AXES two sensors and a person's joint with two axes. With HUB_EMPTY the same program without either; tools/budget.py reports the differences of the linked images. */
#include "jointcal/functional.h"
#include "jointcal/hinge.h"
#include "jointcal/sensor.h"
#include "jointcal/two_axes.h"

#include <stdbool.h>

extern volatile jcal_pair_t hub_pair;
extern volatile float hub_axis_x;
volatile jcal_pair_t hub_pair;
volatile float hub_axis_x;

#ifdef HUB_FUNCTIONAL
static jcal_sensor_t sensors[2];
static jcal_functional_t joint;

/* False if anything is refused. */
static bool run(const jcal_pair_t *pair, jcal_functional_result_t *result)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    const jcal_reading_t readings[2] = {{pair->t_us, pair->imu1}, {pair->t_us, pair->imu2}};
    if ((jcal_functional_init(&joint, &config) != JCAL_OK) || (jcal_sensor_init(&sensors[0]) != JCAL_OK) ||
        (jcal_sensor_init(&sensors[1]) != JCAL_OK)) {
        return false;
    }
    if ((jcal_sensor_push(&sensors[0], &readings[0]) == JCAL_TICK) &&
        (jcal_sensor_push(&sensors[1], &readings[1]) == JCAL_TICK)) {
        (void)jcal_functional_add(&joint, jcal_sensor_tick(&sensors[0]), jcal_sensor_tick(&sensors[1]));
    }
    (void)jcal_functional_step(&joint);
    hub_axis_x =
        jcal_functional_flexion(&joint, jcal_sensor_orientation(&sensors[0]), jcal_sensor_orientation(&sensors[1]));
    return jcal_functional_get(&joint, result) == JCAL_OK;
}
#elif defined(HUB_TWO_AXES)
static jcal_sensor_t sensors[2];
static jcal_two_axes_t joint;

/* False if anything is refused. */
static bool run(const jcal_pair_t *pair, jcal_two_axes_result_t *result)
{
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    const jcal_reading_t readings[2] = {{pair->t_us, pair->imu1}, {pair->t_us, pair->imu2}};
    if ((jcal_two_axes_init(&joint, &config) != JCAL_OK) || (jcal_sensor_init(&sensors[0]) != JCAL_OK) ||
        (jcal_sensor_init(&sensors[1]) != JCAL_OK)) {
        return false;
    }
    if ((jcal_sensor_push(&sensors[0], &readings[0]) == JCAL_TICK) &&
        (jcal_sensor_push(&sensors[1], &readings[1]) == JCAL_TICK)) {
        (void)jcal_two_axes_add(&joint, jcal_sensor_tick(&sensors[0]), jcal_sensor_tick(&sensors[1]));
    }
    (void)jcal_two_axes_step(&joint);
    hub_axis_x =
        jcal_ball_relative(&joint.ball, jcal_sensor_orientation(&sensors[0]), jcal_sensor_orientation(&sensors[1])).x;
    return jcal_two_axes_get(&joint, result) == JCAL_OK;
}
#elif !defined(HUB_EMPTY)
static jcal_hinge_t engine;
#endif

int main(void)
{
    const jcal_pair_t pair = hub_pair;
#ifdef HUB_EMPTY
    hub_axis_x = pair.imu1.acc_m_s2.x;
#elif defined(HUB_FUNCTIONAL)
    jcal_functional_result_t result;
    if (!run(&pair, &result)) {
        return 1;
    }
    hub_axis_x = result.axis1.x;
#elif defined(HUB_TWO_AXES)
    jcal_two_axes_result_t result;
    if (!run(&pair, &result)) {
        return 1;
    }
    hub_axis_x = result.axis1.x;
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
