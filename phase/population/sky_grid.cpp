#include "phase/population/sky_grid.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {

SkyGrid::SkyGrid(double step_deg) : steps_(std::max(2, static_cast<int>(std::lround(180 / step_deg)))) {
  for (int i = 0; i <= steps_; ++i) {
    const double low = std::max(-90.0, elevation_deg(i) - 90.0 / steps_), high = std::min(90.0, elevation_deg(i) + 90.0 / steps_);
    // A difference of sines, without the loss of digits at the poles.
    const double band = 2 * std::cos(radians(0.5 * (low + high))) * std::sin(radians(0.5 * (high - low)));
    cell_sr_.push_back(band * step_rad());
  }
}

double SkyGrid::step_rad() const { return pi / steps_; }

}  // namespace arcus::phase
