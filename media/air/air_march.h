#pragma once
// Through the air in steps: what the sky's table is integrated with.

#include "media/air/atmosphere.h"

namespace arcus::media {

/// Part of a ray in which densities change little.
struct AirStep {
  Vec3 middle_m;
  double height_m;     ///< of the middle
  AirColumns columns;  ///< along the step, within a thousandth
};

struct MarchEnd {
  bool is_at_sea_level;
  Vec3 position_m;
};

/// Where steps of a ray from `origin_m` end, ascending [m from there]; the first is where they begin. `is_at_sea_level`: the last one lies there.
struct StepEnds {
  static constexpr int most = 320;
  int count = 0;
  double at_m[most];
  bool is_at_sea_level = false;
};
StepEnds step_ends(const Atmosphere& air, const Vec3& origin_m, const Vec3& direction);

/// Calls visit(step) for each of the steps, from the origin on, until it is false, sea level or the top of the air.
template <class Visit>
MarchEnd march(const Atmosphere& air, const Vec3& origin_m, const Vec3& direction, const Visit& visit) {
  const StepEnds ends = step_ends(air, origin_m, direction);
  const auto at = [&](double s) { return origin_m + direction * s; };
  if (ends.count == 0) return {false, origin_m};
  AirColumns begin = air.density(air.height_m(at(ends.at_m[0])));
  for (int i = 1; i < ends.count; ++i) {
    const double length = ends.at_m[i] - ends.at_m[i - 1];
    AirStep step;
    step.middle_m = at(0.5 * (ends.at_m[i - 1] + ends.at_m[i]));
    step.height_m = air.height_m(step.middle_m);
    const AirColumns middle = air.density(step.height_m), end = air.density(air.height_m(at(ends.at_m[i])));
    const auto simpson = [&](double a, double m, double b) { return length / 6 * (a + 4 * m + b); };
    step.columns = {simpson(begin.molecules_per_m2, middle.molecules_per_m2, end.molecules_per_m2),
                    simpson(begin.ozone_per_m2, middle.ozone_per_m2, end.ozone_per_m2),
                    simpson(begin.haze_depth_550, middle.haze_depth_550, end.haze_depth_550)};
    begin = end;
    if (!visit(step)) return {false, step.middle_m};
  }
  return {ends.is_at_sea_level, at(ends.at_m[ends.count - 1])};
}

}  // namespace arcus::media
