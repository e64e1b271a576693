#pragma once
// Cells of nearly equal probability, cut from a density's own integral: equal angles would leave
// all but a few cells of a forward peak empty. The probabilities come from quadrature of the
// density and know nothing of the tables a sampler uses.

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "phase/base/frame.h"
#include "phase/base/vec3.h"

namespace arcus::statistics {

/// Intervals that cover [from, to].
class IntervalCells {
 public:
  /// density: per unit of x, ≥ 0; it need not be continuous. Cells hold about 1/count each;
  /// stretches where the density vanishes become cells of their own, which must get no draw.
  /// breaks: where the density jumps or has a narrow peak, in any order; without them a feature
  /// narrower than 1/256 of the range may be missed. Throws std::invalid_argument for a density
  /// that is negative or not finite, and where from < to or count ≥ 1 fails.
  IntervalCells(const std::function<double(double)>& density, double from, double to, int count,
                const std::vector<double>& breaks = {});

  std::size_t size() const { return probabilities_.size(); }
  /// Integrals of the density over the cells; they should sum to 1.
  const std::vector<double>& probabilities() const { return probabilities_; }
  /// The cell of x; nothing outside [from, to].
  std::optional<std::size_t> find(double x) const;
  /// For messages: "0.25 .. 0.5".
  std::string name(std::size_t cell) const;

 private:
  std::vector<double> edges_, probabilities_;
};

/// Patches that cover the sphere, in s = sin²(θ/2) and azimuth around an axis. They are refined
/// towards both ends of the axis down to s = 1e-12, so that a forward or backward peak of any width
/// is seen when the axis is the direction of propagation.
class SphereCells {
 public:
  /// density_per_sr: of a unit vector, ≥ 0. Cells hold at most 1/count, most of them at least half
  /// of that. peaks: unit vectors towards narrow features elsewhere, a lobe around the sun for
  /// instance. Throws as IntervalCells does.
  SphereCells(const std::function<double(const Vec3&)>& density_per_sr, const Vec3& axis, int count,
              const std::vector<Vec3>& peaks = {});

  std::size_t size() const { return probabilities_.size(); }
  const std::vector<double>& probabilities() const { return probabilities_; }
  /// The cell of a direction; nothing unless its length is 1 within 1e-4.
  std::optional<std::size_t> find(const Vec3& direction) const;
  /// For messages: "angle 0.1 .. 0.2 deg, azimuth 0 .. 45 deg".
  std::string name(std::size_t cell) const;

 private:
  using Point = std::array<double, 2>;  // s, azimuth [rad]
  struct Node {
    Point low, high;
    double probability = 0;
    bool bright = false,
         dark = false;     // holds patches where the density is positive, where it is 0
    int halved = 0;        // which coordinate
    int children = -1;     // the first of two neighbours in nodes_, or -1
    std::size_t cell = 0;  // where there are no children
  };
  struct Builder;

  Point coordinates(const Vec3& direction) const;

  Frame frame_;
  std::vector<Node> nodes_;
  std::vector<double> probabilities_;
  std::vector<std::size_t> node_of_cell_;
};

}  // namespace arcus::statistics
