#pragma once
// One kind of particle and where it is: what a [[medium]] of a scene becomes.

#include <memory>
#include <string>

#include "media/space/affine.h"
#include "media/space/box.h"

namespace arcus::phase {
class Species;
}

namespace arcus::media {

class SparseGrid;

/// How values between voxels come about. A voxel's value sits at its integer index coordinates.
enum class Interpolation {
  linear,   ///< trilinear between the eight voxels around a point
  nearest,  ///< voxel i fills [i − ½, i + ½]
};

struct Component {
  std::string name;                         ///< for messages
  std::shared_ptr<const SparseGrid> grid;   ///< extinction at 550 nm (and size) by voxel; none: the same everywhere in `box`
  Box box;                                  ///< without a grid: where it is, in index space
  Affine world_from_index;                  ///< index coordinates to metres; any invertible map
  Interpolation interpolation = Interpolation::linear;
  float extinction_scale = 1;               ///< 1/m per unit of the grid's value; without a grid: extinction at 550 nm [1/m]
  float albedo_scale = 1;                   ///< multiplies the species' albedo
  float size_um = 0;                        ///< of all particles, where the grid has no sizes
  std::shared_ptr<const phase::Species> species;  ///< none: grey, albedo 1, isotropic
};

}  // namespace arcus::media
