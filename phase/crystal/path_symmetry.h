#pragma once
// Ray paths that are the same by a crystal's own symmetry: 3-5, 4-6, 8-4 ... of a regular prism, 1-3 and 2-6. Only turns and
// mirrors that bring the crystal back onto itself count, so irregular habits have fewer of them.

#include <array>
#include <cstdint>
#include <vector>

#include "phase/crystal/crystal_shape.h"
#include "phase/crystal/face_path.h"

namespace arcus::phase {

class PathSymmetry {
 public:
  /// Of the 24 turns and mirrors of a hexagonal prism, those that the shape has.
  explicit PathSymmetry(const CrystalShape& shape);

  /// How many ways the crystal comes back onto itself, the one that leaves it alone included: 24 for regular prisms.
  int order() const { return static_cast<int>(turns_.size()); }
  /// All paths that are the same, each once, in ascending order. Faces that the shape does not have stay as they are.
  std::vector<FacePath> equivalents(const FacePath& path) const;
  /// The one of them that stands for all: that with the lowest numbers of faces from the first on.
  FacePath representative(const FacePath& path) const;

 private:
  using Turn = std::array<std::uint8_t, 32>;  // number of the face that each face goes to
  static FacePath turned(const FacePath& path, const Turn& turn);

  std::vector<Turn> turns_;
};

}  // namespace arcus::phase
