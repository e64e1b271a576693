#include "src/photon/point_tree.h"

#include <nanoflann.hpp>

namespace arcus::render {
namespace {

struct Points {
  std::vector<Vec3> at_m;
  std::size_t kdtree_get_point_count() const { return at_m.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return at_m[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, 3, std::uint32_t>;

/// Takes the nearest straight into the caller's array, by insertion. Of two at equal distance the one of lower number comes first.
class Nearest {
 public:
  using DistanceType = double;
  explicit Nearest(std::span<Neighbour> found) : found_(found) {}
  std::size_t size() const { return count_; }
  bool full() const { return count_ == found_.size(); }
  double worstDist() const { return full() ? found_[count_ - 1].squared_distance_m2 : std::numeric_limits<double>::max(); }
  bool addPoint(double squared_distance_m2, std::uint32_t point) {
    const auto comes_after = [&](const Neighbour& n) {
      return n.squared_distance_m2 > squared_distance_m2 || (n.squared_distance_m2 == squared_distance_m2 && n.point > point);
    };
    if (full() && !comes_after(found_[count_ - 1])) return true;
    std::size_t i = full() ? count_ - 1 : count_++;
    for (; i > 0 && comes_after(found_[i - 1]); --i) found_[i] = found_[i - 1];
    found_[i] = {point, squared_distance_m2};
    return true;
  }

 private:
  std::span<Neighbour> found_;
  std::size_t count_ = 0;
};

}  // namespace

struct PointTree::Index {
  explicit Index(std::vector<Vec3> points_m) : points{std::move(points_m)}, tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}
  Points points;
  Tree tree;
};

PointTree::PointTree(std::vector<Vec3> points_m) : index_(std::make_unique<Index>(std::move(points_m))) {}
PointTree::PointTree(PointTree&&) noexcept = default;
PointTree& PointTree::operator=(PointTree&&) noexcept = default;
PointTree::~PointTree() = default;

std::size_t PointTree::size() const { return index_->points.at_m.size(); }

std::size_t PointTree::nearest(const Vec3& position_m, std::span<Neighbour> found) const {
  if (size() == 0 || found.empty()) return 0;
  Nearest result(found);
  const double at[3] = {position_m.x, position_m.y, position_m.z};
  index_->tree.findNeighbors(result, at, nanoflann::SearchParams());
  return result.size();
}

}  // namespace arcus::render
