/* SPDX-License-Identifier: MIT */
/// @file
/// Compile-time switches shared by every jointcal header.
///
/// An integrator may define JCAL_CONFIG_HEADER as the name of an own header that defines JCAL_ASSERT, JCAL_BARRIER and
/// JCAL_INBOX_CAPACITY, for the library and for all that includes its headers alike: the capacity is part of the states' sizes.
#ifndef JCAL_CONFIG_H
#define JCAL_CONFIG_H

#ifdef JCAL_CONFIG_HEADER
#include JCAL_CONFIG_HEADER
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && (__FINITE_MATH_ONLY__ > 0))
#error                                                                                                                 \
    "jointcal must not be built with -ffast-math or -ffinite-math-only: they delete the NaN tests that keep results honest"
#endif

/// Samples that may wait between two calls of step, in every estimator: a power of two, 2 to 256. What a sample takes: 56 bytes for a
/// pair of readings, 88 for the joint centre, 48 for orientations.
#ifndef JCAL_INBOX_CAPACITY
#define JCAL_INBOX_CAPACITY 4u
#endif
#if ((JCAL_INBOX_CAPACITY) < 2) || ((JCAL_INBOX_CAPACITY) > 256) ||                                                    \
    (((JCAL_INBOX_CAPACITY) & ((JCAL_INBOX_CAPACITY)-1)) != 0)
#error "JCAL_INBOX_CAPACITY must be 2, 4, 8, ... or 256"
#endif

/// Between push and step: what stands before it in the code has happened, for this core and any other, before what stands after it.
/// Where push is an interrupt on the core of step, a barrier of the compiler is enough; this one is good for two cores too.
#ifndef JCAL_BARRIER
#if defined(__GNUC__)
#define JCAL_BARRIER() __atomic_thread_fence(__ATOMIC_ACQ_REL)
#elif defined(__ICCARM__)
#include <intrinsics.h>
#define JCAL_BARRIER() __DMB()
#elif defined(__CC_ARM)
#define JCAL_BARRIER() __dmb(0xF)
#else
#error                                                                                                                 \
    "define JCAL_BARRIER() in JCAL_CONFIG_HEADER: a barrier for the compiler and, where push runs on another core, for cores"
#endif
#endif

/// Checks our own mistakes, never the caller's data. Compiled out unless the integrator defines it.
#ifndef JCAL_ASSERT
#define JCAL_ASSERT(condition) ((void)0)
#endif

/// Marks a function whose result must be looked at.
#if defined(__GNUC__)
#define JCAL_MUST_CHECK __attribute__((warn_unused_result))
#else
#define JCAL_MUST_CHECK
#endif

#endif /* JCAL_CONFIG_H */
