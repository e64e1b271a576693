#include "media/grid/grid_facts.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>

#include "media/grid/vdb_reader.h"

namespace arcus::media {
namespace {

constexpr std::int64_t most_columns = std::int64_t{1} << 26;

/// Calls visit(box, value) for every active value of a tree: voxels, and tiles as a whole.
template <class Grid, class Visit>
void for_values(const Grid& grid, const Visit& visit) {
  for (auto value = grid.tree().cbeginValueOn(); value; ++value) {
    const openvdb::CoordBBox box = value.getBoundingBox();
    visit(IndexBox{{box.min().x(), box.min().y(), box.min().z()}, {box.max().x(), box.max().y(), box.max().z()}},
          static_cast<double>(*value));
  }
}

template <class Grid>
ValueFacts::Depth depth_along(const Grid& grid, const IndexBox& box, int axis, double step_m) {
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;  // the other two
  const auto component = [](const Coord& c, int i) { return i == 0 ? c.x : i == 1 ? c.y : c.z; };
  const auto width = static_cast<std::size_t>(box.size(b));
  std::vector<double> columns(static_cast<std::size_t>(box.size(a)) * width);
  for_values(grid, [&](const IndexBox& part, double value) {
    if (!std::isfinite(value)) return;
    const double amount = value * step_m * static_cast<double>(part.size(axis));
    for (int i = component(part.low, a); i <= component(part.high, a); ++i)
      for (int j = component(part.low, b); j <= component(part.high, b); ++j)
        columns[static_cast<std::size_t>(i - component(box.low, a)) * width +
                static_cast<std::size_t>(j - component(box.low, b))] += amount;
  });
  ValueFacts::Depth depth;
  for (const double column : columns) {
    depth.mean += column / static_cast<double>(columns.size());
    depth.largest = std::max(depth.largest, column);
  }
  return depth;
}

template <class Grid>
ValueFacts values_of(const Grid& grid, const GridFacts& facts) {
  ValueFacts values;
  double sum = 0, count = 0;
  for_values(grid, [&](const IndexBox& part, double value) {
    const double voxels = static_cast<double>(part.size(0)) * static_cast<double>(part.size(1)) * static_cast<double>(part.size(2));
    if (!std::isfinite(value)) {
      values.not_finite += static_cast<std::uint64_t>(voxels);
      return;
    }
    values.smallest = count == 0 ? value : std::min(values.smallest, value);
    values.largest = count == 0 ? value : std::max(values.largest, value);
    sum += value * voxels;
    count += voxels;
  });
  values.mean = count > 0 ? sum / count : 0;
  const IndexBox& box = facts.active_box;
  const double x = static_cast<double>(box.size(0)), y = static_cast<double>(box.size(1)), z = static_cast<double>(box.size(2));
  if (facts.is_affine && !box.is_empty() && std::max({x * y, y * z, x * z}) <= static_cast<double>(most_columns))
    values.depth = {depth_along(grid, box, 0, facts.voxel_m.x), depth_along(grid, box, 1, facts.voxel_m.y),
                    depth_along(grid, box, 2, facts.voxel_m.z)};
  return values;
}

}  // namespace

GridFacts VdbGrid::facts() const {
  GridFacts facts;
  const auto& grid = *static_cast<const openvdb::GridBase*>(grid_.get());
  facts.class_words = class_words();
  facts.metadata = metadata();
  facts.active_voxels = grid.activeVoxelCount();
  facts.memory_bytes = grid.memUsage();
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (facts.active_voxels > 0)
    facts.active_box = {{box.min().x(), box.min().y(), box.min().z()}, {box.max().x(), box.max().y(), box.max().z()}};
  facts.is_affine = is_affine();
  if (facts.is_affine) {
    facts.world_from_index = affine();
    facts.voxel_m = {length(facts.world_from_index.x), length(facts.world_from_index.y), length(facts.world_from_index.z)};
    if (facts.active_voxels > 0) facts.bounds_m = bounds_of(facts.world_from_index, facts.active_box.box().grown_by(0.5));
  }
  if (grid.isType<openvdb::FloatGrid>())
    facts.values = values_of(static_cast<const openvdb::FloatGrid&>(grid), facts);
  else if (grid.isType<openvdb::DoubleGrid>())
    facts.values = values_of(static_cast<const openvdb::DoubleGrid&>(grid), facts);
  return facts;
}

std::vector<GridFacts> describe_vdb(const std::string& path) {
  VdbReader reader(path);
  std::vector<GridFacts> all;
  for (std::size_t i = 0; i < reader.entries().size(); ++i) {
    const VdbEntry& entry = reader.entries()[i];
    GridFacts facts;
    if (reader.read_header(i)) facts = reader.read(i).facts();
    else facts.is_readable = false;
    facts.label = entry.label();
    facts.type = entry.type;
    facts.saved_as_half = entry.saved_as_half;
    all.push_back(std::move(facts));
  }
  return all;
}

}  // namespace arcus::media
