/* SPDX-License-Identifier: MIT */
/// @file
/// Compile-time switches shared by every jointcal header.
///
/// An integrator may define JCAL_CONFIG_HEADER as the name of an own header that defines JCAL_ASSERT.
#ifndef JCAL_CONFIG_H
#define JCAL_CONFIG_H

#ifdef JCAL_CONFIG_HEADER
#include JCAL_CONFIG_HEADER
#endif

#ifdef __FAST_MATH__
#error "jointcal must not be built with -ffast-math: it deletes the NaN tests that keep results honest"
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
