/* SPDX-License-Identifier: MIT */
/// @file
/// State of the window engine of the joint centre. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_CENTER_WINDOW_H
#define JCAL_PRIVATE_CENTER_WINDOW_H

#include "jointcal/private/center/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The window engine. Caller-owned; all members are private.
///
/// It may be copied together with its storage; jcal_center_window_attach() then tells the copy where its storage is.
typedef struct {
    jcal_center_window_config_t cfg;
    void *storage;
    jcal_center_input_t input;
    jcal_center_work_t work;
    jcal_watch_t watch;
    uint64_t t_us;      ///< Time of the newest sample.
    uint32_t next;      ///< Where the next sample goes.
    uint32_t count;     ///< Samples in the window.
    uint32_t unjudged;  ///< Samples since the last judgement.
    bool has_point;
} jcal_center_window_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CENTER_WINDOW_H */
