#include "src/shape/near_groups.h"

#include <algorithm>
#include <limits>

namespace arcus::render {
namespace {

/// How many times as large as a mesh its hierarchy may be: single precision is then within 2⁻¹⁸ of the mesh.
constexpr double most_times = 64;

double extent(const media::Box& box) { return std::max({box.size().x, box.size().y, box.size().z}); }

struct Cluster {
  media::Box box;
  double most_m;  ///< that it may extend
  std::vector<std::uint32_t> numbers;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> groups_near_together(const std::vector<PieceGroup>& groups) {
  std::vector<Cluster> alone;
  for (std::uint32_t number = 0; number < groups.size(); ++number) {
    if (groups[number].size() == 0) continue;
    const media::Box box = bounds_of(groups[number]);
    // Spheres and flat pieces are met in double precision.
    alone.push_back({box, groups[number].triangle_count() > 0 ? most_times * extent(box) : std::numeric_limits<double>::infinity(), {number}});
  }
  std::stable_sort(alone.begin(), alone.end(), [](const Cluster& a, const Cluster& b) { return extent(a.box) > extent(b.box); });
  std::vector<Cluster> clusters;
  for (Cluster& one : alone) {
    Cluster* best = nullptr;
    double least_growth_m = std::numeric_limits<double>::infinity();
    for (Cluster& cluster : clusters) {
      media::Box joined = cluster.box;
      joined.include(one.box);
      const double growth_m = extent(joined) - extent(cluster.box);
      if (extent(joined) > std::min(cluster.most_m, one.most_m) || !(growth_m < least_growth_m)) continue;
      best = &cluster;
      least_growth_m = growth_m;
    }
    if (best) {
      best->box.include(one.box);
      best->most_m = std::min(best->most_m, one.most_m);
      best->numbers.push_back(one.numbers[0]);
    } else {
      clusters.push_back(std::move(one));
    }
  }
  std::vector<std::vector<std::uint32_t>> result;
  for (Cluster& cluster : clusters) {
    std::sort(cluster.numbers.begin(), cluster.numbers.end());
    result.push_back(std::move(cluster.numbers));
  }
  return result;
}

}  // namespace arcus::render
