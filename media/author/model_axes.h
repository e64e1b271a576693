#pragma once
// Which dimension of a model's variable is x, y, z or time, and where its points are.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "phase/base/netcdf_file.h"

namespace arcus::media {

/// What the axes are called, where they should not be found by themselves: names of dimensions or of their coordinate variables.
struct AxisNames {
  std::string x, y, z, time;
};

/// A lattice for dimensions without coordinates: first position and step along x, y, z.
struct GivenLattice {
  std::array<double, 3> first_m{}, step_m{};
};

/// One dimension of the variable as an axis of space.
struct ModelAxis {
  std::optional<std::size_t> dimension;  ///< place in NetcdfFile::dimensions(); nothing: the variable does not vary along it
  std::vector<double> position_m{0};     ///< ascending
  bool is_reversed = false;              ///< the file has them descending
};

struct ModelAxes {
  std::array<ModelAxis, 3> space;   ///< x, y, z
  std::optional<std::size_t> time;  ///< as above
  std::vector<std::string> notes;
};

/// Finds the axes of a variable. A dimension is known by the given names, else by its coordinate variable (attributes axis,
/// standard_name and units, then its name), else by its own name; dimensions of length 1 that are none of these do not count. Positions are in
/// metres or kilometres by the attribute units (metres, with a note, where there is none). Throws bad_input: latitude and longitude,
/// pressure as height, dimensions that are unknown or found twice, no height, positions that do not go one way.
ModelAxes find_axes(const NetcdfFile& file, const NetcdfFile::Variable& variable, const AxisNames& names,
                    const std::optional<GivenLattice>& given);

}  // namespace arcus::media
