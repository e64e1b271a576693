#include "media/air/air_march.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "media/air/flight.h"

namespace arcus::media {

StepEnds step_ends(const Atmosphere& air, const Vec3& origin_m, const Vec3& direction) {
  // As thick as densities let them be: haze lies low, ozone has corners at 10, 25 and 40 km.
  static constexpr std::array<double, 27> layers{60,   150,   300,   500,   750,   1000,  1400,  1900,  2500,  3200,  4000,  5000,  6200, 7500,
                                                 9000, 10000, 12000, 14500, 17500, 21000, 25000, 30000, 35000, 40000, 50000, 65000, 85000};
  constexpr double longest_m = 8000, longest_share = 0.1;  // of a step; of the way to it
  constexpr int most_parts = 8;
  const Flight flight(origin_m, direction, air.settings().planet_radius_m, air.height_m(origin_m));
  StepEnds ends;
  const Ray inside = air.clipped({origin_m, direction});
  double begin = inside.nearest_m, end = inside.farthest_m;
  if (flight.lowest_m < 0 && flight.to_lowest_m > 0) {
    const double ground_m = std::max(0.0, flight.to_lowest_m - flight.half_below_m(0));
    ends.is_at_sea_level = true;
    end = std::min(end, ground_m);
  }
  if (!(begin < end)) {
    if (ends.is_at_sea_level) {
      ends.count = 1;
      ends.at_m[0] = end;
    }
    return ends;
  }
  std::array<double, 2 * layers.size() + 2> cuts;
  std::size_t count = 0;
  const auto add = [&](double s) {
    if (s > begin && s < end) cuts[count++] = s;
  };
  for (const double height : layers) {
    const double half_below = flight.half_below_m(height);
    if (half_below == 0) continue;
    add(flight.to_lowest_m - half_below);
    add(flight.to_lowest_m + half_below);
  }
  add(flight.to_lowest_m);
  std::sort(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(count));
  cuts[count++] = end;
  ends.at_m[ends.count++] = begin;
  double from = begin;
  for (std::size_t i = 0; i < count; ++i) {
    const double length = cuts[i] - from;
    const double longest = std::max(longest_m, longest_share * (from - begin));
    const int parts = std::clamp(static_cast<int>(std::ceil(length / longest)), 1, most_parts);
    for (int part = 1; part <= parts && ends.count < StepEnds::most; ++part) ends.at_m[ends.count++] = from + length * part / parts;
    from = cuts[i];
  }
  return ends;
}

}  // namespace arcus::media
