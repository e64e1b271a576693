#include "phase/population/hat_nodes.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"
#include "phase/population/scattering_table.h"

namespace arcus::phase {
namespace {

constexpr int cells = 8192;

}  // namespace

HatNodes::HatNodes(const std::vector<double>& angle_deg) : solid_angle_sr_(angle_deg.size(), 0.0) {
  for (const double degrees : angle_deg) s_.push_back(degrees == 180 ? 1 : sin2_half_deg(degrees));
  for (std::size_t i = 0; i + 1 < s_.size(); ++i) {
    const double width = s_[i + 1] - s_[i];
    per_width_.push_back(1 / width);
    solid_angle_sr_[i] += 2 * pi * width;  // half of the interval: dΩ = 4π ds
    solid_angle_sr_[i + 1] += 2 * pi * width;
  }
  std::uint32_t node = 0;
  for (int cell = 0; cell <= cells; ++cell) {
    const double sine = static_cast<double>(cell) / cells;
    while (node + 2 < s_.size() && s_[node + 1] <= sine * sine) ++node;
    guide_.push_back(node);
  }
}

HatNodes::Place HatNodes::place_of(double s) const {
  s = std::clamp(s, 0.0, 1.0);
  std::size_t node = guide_[static_cast<std::size_t>(std::sqrt(s) * cells)];
  while (node + 2 < s_.size() && s >= s_[node + 1]) ++node;
  return {node, std::clamp((s - s_[node]) * per_width_[node], 0.0, 1.0)};
}

}  // namespace arcus::phase
