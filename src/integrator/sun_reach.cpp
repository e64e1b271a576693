#include "src/integrator/sun_reach.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcus::render {
namespace {

const Wavelengths middle{{550, 550, 550, 550}};

}  // namespace

SunReach::SunReach(const media::Medium& medium, const Vec3& to_sun) {
  if (medium.is_empty() || medium.bounds_m().is_empty()) return;
  bounds_m_ = medium.bounds_m();
  const Vec3 size = bounds_m_.size();
  for (int axis = 0; axis < 3; ++axis) cells_per_m_[axis] = size[axis] > 0 ? cells / size[axis] : 0;

  // Mean extinction of the cells, from a few points each.
  constexpr int points = 2;
  std::vector<float> extinction_per_m(static_cast<std::size_t>(cells) * cells * cells);
  const auto cell = [](int x, int y, int z) { return (static_cast<std::size_t>(x) * cells + static_cast<std::size_t>(y)) * cells + static_cast<std::size_t>(z); };
  tbb::parallel_for(0, cells, [&](int x) {
    for (int y = 0; y < cells; ++y)
      for (int z = 0; z < cells; ++z) {
        float sum = 0;
        for (int i = 0; i < points * points * points; ++i) {
          const Vec3 share((x + (i % points + 0.5) / points) / cells, (y + (i / points % points + 0.5) / points) / cells,
                           (z + (i / points / points + 0.5) / points) / cells);
          sum += medium.extinction_per_m(bounds_m_.low + Vec3(size.x * share.x, size.y * share.y, size.z * share.z), middle)[0];
        }
        extinction_per_m[cell(x, y, z)] = sum / (points * points * points);
      }
  });

  // From every node towards the sun, cell by cell.
  depth_.resize(static_cast<std::size_t>(nodes) * nodes * nodes);
  tbb::parallel_for(0, nodes, [&](int x) {
    for (int y = 0; y < nodes; ++y)
      for (int z = 0; z < nodes; ++z) {
        const int start[3] = {x, y, z};
        int at[3];
        double crossing_m[3], spacing_m[3];
        for (int axis = 0; axis < 3; ++axis) {
          const double rate = to_sun[axis] * cells_per_m_[axis];  // cells a metre
          at[axis] = rate < 0 ? start[axis] - 1 : std::min(start[axis], cells - (rate > 0 ? 0 : 1));
          spacing_m[axis] = rate == 0 ? std::numeric_limits<double>::infinity() : 1 / std::fabs(rate);
          crossing_m[axis] = spacing_m[axis];
        }
        double depth = 0, place_m = 0;
        const auto is_inside = [&] {
          for (const int i : at)
            if (i < 0 || i >= cells) return false;
          return true;
        };
        while (is_inside()) {
          const int axis = crossing_m[0] <= crossing_m[1] ? (crossing_m[0] <= crossing_m[2] ? 0 : 2) : (crossing_m[1] <= crossing_m[2] ? 1 : 2);
          if (!std::isfinite(crossing_m[axis])) break;
          depth += extinction_per_m[cell(at[0], at[1], at[2])] * (crossing_m[axis] - place_m);
          place_m = crossing_m[axis];
          crossing_m[axis] += spacing_m[axis];
          at[axis] += to_sun[axis] > 0 ? 1 : -1;
        }
        depth_[node(x, y, z)] = static_cast<float>(depth);
      }
  });
}

float SunReach::optical_depth(const Vec3& position_m) const {
  if (depth_.empty()) return 0;
  float share[3];
  int low[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double at = (position_m[axis] - bounds_m_.low[axis]) * cells_per_m_[axis];
    if (!(at >= 0 && at <= cells)) return 0;
    low[axis] = std::min(static_cast<int>(at), cells - 1);
    share[axis] = static_cast<float>(at) - static_cast<float>(low[axis]);
  }
  const float* d = depth_.data() + node(low[0], low[1], low[2]);
  const auto along_z = [&](const float* p) { return p[0] + (p[1] - p[0]) * share[2]; };
  const auto along_y = [&](const float* p) {
    const float a = along_z(p), b = along_z(p + nodes);
    return a + (b - a) * share[1];
  };
  const float a = along_y(d), b = along_y(d + nodes * nodes);
  return a + (b - a) * share[0];
}

}  // namespace arcus::render
