#pragma once
// The picture of `arcus info --png`: a medium from the east, the south and above.

#include <array>
#include <string>

#include "media/grid/projections.h"

namespace arcus::tools {

/// Writes the three projections beside each other, to one scale; the brighter the deeper.
void write_projections(const std::string& path, const std::array<media::Projection, 3>& projections, const Vec3& voxel_m);

}  // namespace arcus::tools
