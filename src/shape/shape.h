#pragma once
// Shapes as the scene file gives them, and the pieces that they are made of.

#include <string>
#include <vector>

#include "phase/base/raster.h"
#include "phase/settings/keys.h"
#include "src/shape/pieces.h"

namespace arcus::render {

struct ShapeSettings {
  std::string type = "plane";      ///< plane | sphere | rectangle | disc | mesh | terrain | gasket
  double height_m = 0;             ///< plane: horizontal, reaches to the horizon
  Vec3 centre_m{0, 0, 0};          ///< sphere, rectangle, disc, terrain, gasket
  double radius_m = 1;             ///< sphere, disc
  Vec3 edge_u_m{2, 0, 0}, edge_v_m{0, 2, 0};  ///< rectangle: its sides
  Vec3 normal{0, 0, 1};            ///< disc: of any length
  double inner_radius_m = 0;       ///< disc: of a hole in its middle
  std::string file;                ///< mesh: PLY or OBJ; terrain: a picture of heights; relative to the scene file
  double scale = 1;                ///< mesh: applied first
  Vec3 rotate_deg{0, 0, 0};        ///< mesh: about x, then y, then z
  Vec3 translate_m{0, 0, 0};       ///< mesh: applied last
  std::vector<double> size_m{1000, 1000};  ///< terrain: of the picture from west to east and from south to north
  double low_m = 0, high_m = 1;    ///< terrain: heights above its centre of the values 0 and 1
  double edge_m = 2;               ///< gasket: of the tetrahedron between the outermost spheres' centres' hull
  long long depth = 4;             ///< gasket: 4^depth spheres
};
void list_keys(Keys& keys, ShapeSettings& shape);

/// The pieces of any shape but a plane. `folder`: where a file's relative path starts. Throws bad_input for a mesh that cannot be
/// read and for shapes without extent. `heights`: reads those of a terrain.
PieceGroup pieces_of(const ShapeSettings& shape, const std::string& folder, const std::string& where, const RasterReader& heights = {});

/// Sierpiński's tetrahedron of touching spheres: 4^depth of them, each of radius edge / 2^(depth + 1), in the corners of a regular
/// tetrahedron that stands on a side, its centre of mass in `centre_m`.
PieceGroup gasket(const Vec3& centre_m, double edge_m, int depth);

}  // namespace arcus::render
