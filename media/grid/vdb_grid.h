#pragma once
// One grid of an OpenVDB file, seen without OpenVDB's headers.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "media/grid/sparse_grid.h"
#include "media/space/affine.h"

namespace arcus::media {

/// Sizes by voxel, with the value that holds where no voxel says otherwise.
struct SizeField {
  SparseGrid grid;  ///< the size takes the place of extinction
  float elsewhere = 0;
};

struct GridFacts;

class VdbGrid {
 public:
  /// `grid` points to an openvdb::GridBase; `where` names it in messages.
  VdbGrid(std::shared_ptr<void> grid, std::string where);

  const std::string& where() const { return where_; }
  bool is_level_set() const;
  /// "fog volume", "level set", "staggered" or "no class".
  std::string class_words() const;

  // Metadata of that name and type, if there is any.
  std::optional<std::string> text(const std::string& name) const;
  std::optional<std::int32_t> integer(const std::string& name) const;
  std::optional<float> number(const std::string& name) const;
  /// All metadata as text, without the statistics that OpenVDB adds.
  std::vector<std::pair<std::string, std::string>> metadata() const;

  /// Straight lines stay straight: no frustum.
  bool is_affine() const;
  /// Throws bad_input unless the transform is affine and can be inverted.
  Affine world_from_index() const;

  /// Everything about it but label and type; of a grid that has been read as a whole.
  GridFacts facts() const;

  // For float and double grids that have been read as a whole:

  /// The renderer's form. Voxels that are not active count as 0. `sizes` joins sizes to it. Throws bad_input: a background that
  /// is not 0, no active voxel, a value that is not finite or negative, a size that is not above 0 where extinction is.
  SparseGrid sparse_grid(const SizeField* sizes) const;
  /// Sizes as they are; inactive voxels count, too.
  SizeField size_field() const;

 private:
  /// Only where is_affine().
  Affine affine() const;

  std::shared_ptr<void> grid_;
  std::string where_;
};

}  // namespace arcus::media
