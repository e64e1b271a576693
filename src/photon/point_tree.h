#pragma once
// Finds the nearest of many points. The only file pair with nanoflann, a k-d tree (J. Bentley, Communications of the ACM 18(9), 1975).

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "phase/base/vec3.h"

namespace arcus::render {

struct Neighbour {
  std::uint32_t point;
  double squared_distance_m2;
};

class PointTree {
 public:
  explicit PointTree(std::vector<Vec3> points_m);
  PointTree(PointTree&&) noexcept;
  PointTree& operator=(PointTree&&) noexcept;
  ~PointTree();

  std::size_t size() const;
  /// The nearest points, nearest first, at most as many as `found` is long; returns how many.
  std::size_t nearest(const Vec3& position_m, std::span<Neighbour> found) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace arcus::render
