#include "src/scene/droplets_from_medium.h"

#include <algorithm>
#include <cmath>

#include "media/grid/sparse_grid.h"
#include "phase/base/error.h"
#include "phase/base/random.h"
#include "phase/population/size_draw.h"

namespace arcus::render {
namespace {

/// The populations of a recipe's size nodes, and how many drops an extinction is.
class Populations {
 public:
  explicit Populations(const DropSource& source) : size_um_(source.size_um) {
    for (std::size_t k = 0; k < size_um_.size(); ++k) {
      const phase::Sizes sizes(source.distribution, size_um_[k]);
      draws_.emplace_back(sizes);
      // So many of those that are drawn have the geometric cross-section of all.
      drops_m2_.push_back(sizes.mean_power_um(2) / draws_.back().drawn_mean_square_um2() / source.cross_section_m2[k]);
    }
  }

  /// Sizes between two nodes are a mixture of both, by extinction, with weights linear in ln size (phase/species/species.h).
  struct Mixture {
    std::size_t node = 0;
    double share = 0;  ///< of the extinction, by the next node
  };
  Mixture mixture(double size_um) const {
    if (size_um_.size() == 1 || size_um <= size_um_.front()) return {};
    if (size_um >= size_um_.back()) return {size_um_.size() - 2, 1};
    const auto node = static_cast<std::size_t>(std::upper_bound(size_um_.begin(), size_um_.end(), size_um) - size_um_.begin()) - 1;
    return {node, std::log(size_um / size_um_[node]) / std::log(size_um_[node + 1] / size_um_[node])};
  }
  /// Drops a volume and unit of extinction [1/m³ over 1/m].
  double drops_m2(const Mixture& m) const { return lower(m) + upper(m); }
  /// Radius [µm] of one of them; u and v in [0, 1).
  double radius_um(const Mixture& m, double u, double v) const {
    return draws_[u * drops_m2(m) < lower(m) ? m.node : m.node + 1].radius_um(v);
  }

 private:
  double lower(const Mixture& m) const { return (1 - m.share) * drops_m2_[m.node]; }
  double upper(const Mixture& m) const { return m.share > 0 ? m.share * drops_m2_[m.node + 1] : 0; }

  std::vector<double> size_um_;
  std::vector<phase::SizeDraw> draws_;
  std::vector<double> drops_m2_;  // [node]
};

/// A source made ready: its voxels one after the other, with the number of drops in all before.
class Source {
 public:
  explicit Source(const DropSource& source)
      : component_(source.component), populations_(source) {
    const double voxel_m3 = std::fabs(component_.world_from_index.determinant());
    const media::SparseGrid& grid = *component_.grid;
    const media::IndexBox& all = grid.voxels();
    constexpr int edge = media::SparseGrid::brick_edge;
    for (int x = all.low.x; x <= all.high.x; x += edge)
      for (int y = all.low.y; y <= all.high.y; y += edge)
        for (int z = all.low.z; z <= all.high.z; z += edge) {
          const media::IndexBox brick{{x, y, z}, {std::min(x + edge - 1, all.high.x), std::min(y + edge - 1, all.high.y), std::min(z + edge - 1, all.high.z)}};
          if (grid.range(brick, false).largest > 0) add_voxels(brick, voxel_m3);
        }
  }

  double number() const { return cumulative_.empty() ? 0 : cumulative_.back(); }
  /// One of its drops; `at` in [0, number()).
  DropDraw draw(double at, Random& random) const {
    const auto i = static_cast<std::size_t>(std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, at) - cumulative_.begin());
    const media::Coord& c = voxels_[i];
    const bool is_linear = component_.interpolation == media::Interpolation::linear;
    Vec3 index{static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.z)};
    for (int axis = 0; axis < 3; ++axis) {
      // The weight of a voxel in a linear interpolation is a tent around it, two uniform numbers' sum.
      index[axis] += random.uniform_double() - 0.5;
      if (is_linear) index[axis] += random.uniform_double() - 0.5;
    }
    const double u = random.uniform_double(), v = random.uniform_double();
    return {component_.world_from_index.point(index), populations_.radius_um(populations_.mixture(size_um(component_.grid->at(c.x, c.y, c.z))), u, v) * 1e-6};
  }

 private:
  double size_um(const media::Voxel& voxel) const { return component_.grid->has_size() ? voxel.size_um : component_.size_um; }
  void add_voxels(const media::IndexBox& box, double voxel_m3) {
    for (int x = box.low.x; x <= box.high.x; ++x)
      for (int y = box.low.y; y <= box.high.y; ++y)
        for (int z = box.low.z; z <= box.high.z; ++z) {
          const media::Voxel voxel = component_.grid->at(x, y, z);
          if (!(voxel.extinction > 0)) continue;
          const double drops = static_cast<double>(voxel.extinction) * component_.extinction_scale * voxel_m3 * populations_.drops_m2(populations_.mixture(size_um(voxel)));
          voxels_.push_back({x, y, z});
          cumulative_.push_back(number() + drops);
        }
  }

  const media::Component& component_;
  Populations populations_;
  std::vector<media::Coord> voxels_;
  std::vector<double> cumulative_;
};

}  // namespace

DrawnDrops drops_from_medium(const std::vector<DropSource>& sources, long long count, long long seed, const std::string& where) {
  std::vector<Source> ready;
  DrawnDrops result;
  for (const DropSource& source : sources) {
    ready.emplace_back(source);
    result.number_meant += ready.back().number();
  }
  if (!(result.number_meant > 0)) throw bad_input(where, "a medium with nothing that scatters", "drops to draw expected");
  result.enlargement = std::sqrt(result.number_meant / static_cast<double>(count));
  result.group = place_drops(
      static_cast<std::size_t>(count),
      [&](std::size_t i, unsigned attempt) {
        Random random(static_cast<std::uint64_t>(seed), i, attempt);
        double at = random.uniform_double() * result.number_meant;
        std::size_t k = 0;
        for (; k + 1 < ready.size() && at >= ready[k].number(); ++k) at -= ready[k].number();
        DropDraw drop = ready[k].draw(at, random);
        drop.radius_m *= result.enlargement;
        return drop;
      },
      where);
  return result;
}

}  // namespace arcus::render
