#include "media/author/ice_climate.h"

#include <algorithm>
#include <cmath>

#include "media/author/smooth_step.h"

namespace arcus::media {

double mean_ice_g_per_m3(double temperature_c) {
  const double colder = std::max(0.0, -20 - temperature_c);
  return std::exp(-7.6 + 4 * std::exp(-0.2443e-3 * std::pow(colder, 2.455)));
}

double mean_width_um(double temperature_c) {
  const double t = std::clamp(temperature_c, -60.0, -20.0);  // where it was measured
  return 326.3 + t * (12.42 + t * (0.197 + t * 0.0012));
}

double columnar_share(double temperature_c) {
  const double cold = smooth_step((-35 - temperature_c) / 10), warm = smooth_step((temperature_c + 11) / 4);
  return 0.1 + 0.8 * std::max(cold, warm);
}

}  // namespace arcus::media
