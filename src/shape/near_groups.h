#pragma once
// Which groups of pieces may share a hierarchy: Embree places rays and triangles in single precision, so triangles must not be much smaller than what they share it
// with, or their edges would be as ragged as the scene is large.

#include <cstdint>
#include <vector>

#include "src/shape/pieces.h"

namespace arcus::render {

/// Numbers of the groups that have pieces, ascending, by hierarchy: one for all wherever no mesh is small in a large scene.
std::vector<std::vector<std::uint32_t>> groups_near_together(const std::vector<PieceGroup>& groups);

}  // namespace arcus::render
