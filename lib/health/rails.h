/* SPDX-License-Identifier: MIT */
/// @file
/// Where components stop. Private.
///
/// A component that clips has flat peaks, and all of them at one value; a calibration of the factory, after the clipping, spreads that value by a few
/// per cent. A peak is flat if twice as many of its readings are within 2.5 % of its top as there are on the way down to 80 %: of a smooth peak as many are.
/// One large value is no peak of that kind, so a glitch is not believed, and neither are rest and the range of gravity, for they lie below the floors.
#ifndef JCAL_HEALTH_RAILS_H
#define JCAL_HEALTH_RAILS_H

#include "jointcal/private/health/state.h"

/// Takes in a reading. Cost: six comparisons, and some counting for each component that is beyond its floor.
void jcal_health_rails_add(jcal_health_rails_t *self, const jcal_imu_t *imu);

/// True if the side stops.
bool jcal_health_rail_clips(const jcal_health_rail_t *rail);

/// Where, rad/s or m/s^2; `component` 0 to 5.
float jcal_health_rail_level(const jcal_health_rail_t *rail, unsigned component);

#endif /* JCAL_HEALTH_RAILS_H */
