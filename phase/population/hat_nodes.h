#pragma once
// Light sorted by its scattering angle onto the nodes of a table: each piece is shared by the two nodes around it, in proportion to
// how near it is in s = sin²(θ/2). What is read between the nodes, linear in s, then holds exactly the light that was put there.

#include <cstdint>
#include <span>
#include <vector>

namespace arcus::phase {

class HatNodes {
 public:
  /// Ascending from 0 to 180 [degrees].
  explicit HatNodes(const std::vector<double>& angle_deg);

  std::size_t count() const { return s_.size(); }
  double s(std::size_t node) const { return s_[node]; }
  /// Solid angle that the light at a node fills [sr]: light over it is a value per sr.
  double solid_angle_sr(std::size_t node) const { return solid_angle_sr_[node]; }

  /// A place between two nodes.
  struct Place {
    std::size_t node;  ///< the lower one
    double share;      ///< of the upper one
  };
  /// s in [0, 1], up to rounding.
  Place place_of(double s) const;

 private:
  std::vector<double> s_, per_width_, solid_angle_sr_;
  std::vector<std::uint32_t> guide_;  // the interval in which a cell of equal sin(θ/2) begins
};

}  // namespace arcus::phase
