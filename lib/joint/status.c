/* SPDX-License-Identifier: MIT */
/// @file
/// Words for enumerators, and the version.
#include "jointcal/jointcal.h"

#include <stddef.h>

/// Entry `index` of a table of `count` words; `fallback` beyond its end.
static const char *word(const char *const *words, size_t count, int index, const char *fallback)
{
    return ((index >= 0) && ((size_t)index < count)) ? words[index] : fallback;
}

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

const char *jcal_version(void)
{
    return JCAL_VERSION_STRING;
}

const char *jcal_status_string(jcal_status_t status)
{
    switch (status) {
    case JCAL_OK:
        return "ok";
    case JCAL_REJECTED:
        return "sample rejected";
    case JCAL_IDLE:
        return "nothing to do";
    case JCAL_TICK:
        return "new features";
    case JCAL_ERR_ARG:
        return "invalid argument";
    case JCAL_ERR_CONFIG:
        return "config field out of range";
    case JCAL_ERR_STORAGE:
        return "storage too small or not aligned";
    case JCAL_ERR_FULL:
        return "inbox full";
    case JCAL_ERR_FLASH:
        return "flash failed";
    default:
        return "unknown";
    }
}

const char *jcal_calibration_string(jcal_calibration_t calibration)
{
    static const char *const words[] = {"collecting", "ambiguous", "ready", "moved"};
    return word(words, COUNT(words), (int)calibration, "unknown");
}

const char *jcal_engine_string(jcal_engine_t engine)
{
    static const char *const words[] = {"stream", "window"};
    return word(words, COUNT(words), (int)engine, "unknown");
}

const char *jcal_weak_string(jcal_weak_t weak)
{
    static const char *const words[] = {NULL, "axis1", "axis2", "sign", "heading", "center1", "center2"};
    return word(words, COUNT(words), (int)weak, NULL);
}

const char *jcal_hint_string(jcal_hint_t hint)
{
    static const char *const words[] = {NULL,        "move_joint",    "move_segment1",   "move_segment2",
                                        "tilt_axis", "check_sensors", "more_directions", "move_faster",
                                        "bend_only", "turn_only"};
    return word(words, COUNT(words), (int)hint, NULL);
}

const char *jcal_reason_string(jcal_reason_t reason)
{
    static const char *const words[] = {NULL,
                                        "no_data",
                                        "no_motion",
                                        "uncertain",
                                        "sign_open",
                                        "other_minimum",
                                        "does_not_fit",
                                        "bad_samples",
                                        "wrong_units_gyr",
                                        "wrong_units_acc",
                                        "rate_too_low",
                                        "gravity_off",
                                        "not_one_joint",
                                        "no_bend",
                                        "more_axes",
                                        "sensor_bad",
                                        "out_of_step"};
    return word(words, COUNT(words), (int)reason, NULL);
}
