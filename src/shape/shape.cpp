#include "src/shape/shape.h"

#include <cmath>

#include "media/space/affine.h"
#include "phase/base/frame.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"
#include "src/shape/mesh_file.h"

namespace arcus::render {
namespace {

Sphere sphere_at(const Vec3& offset_m, double radius_m) {
  return {static_cast<float>(offset_m.x), static_cast<float>(offset_m.y), static_cast<float>(offset_m.z), static_cast<float>(radius_m)};
}

void divide(PieceGroup& group, const Vec3& offset_m, double edge_m, int depth, const Vec3 (&corners)[4]) {
  if (depth == 0) {
    group.spheres.push_back(sphere_at(offset_m, 0.5 * edge_m));
    return;
  }
  for (const Vec3& corner : corners) divide(group, offset_m + corner * (0.5 * edge_m), 0.5 * edge_m, depth - 1, corners);
}

Terrain read_terrain(const ShapeSettings& shape, const std::string& path, const std::string& where, const RasterReader& read) {
  Raster heights = read(path, where);
  // About 100 bytes a pixel in all, most of them of the hierarchy: 1.8 GB.
  constexpr std::size_t most_pixels = std::size_t{1} << 24;
  if (heights.pixels() > most_pixels)
    throw bad_input(where + ": " + path, std::to_string(heights.width) + " x " + std::to_string(heights.height) + " heights", "at most " + std::to_string(most_pixels) + " in all expected",
                    "Make the picture smaller, or cut it");
  return Terrain(std::move(heights), {shape.centre_m, shape.size_m[0], shape.size_m[1], shape.low_m, shape.high_m});
}

}  // namespace

void list_keys(Keys& keys, ShapeSettings& shape) {
  const auto is = [&](const char* type) { return shape.type == type; };
  keys.choice("type", shape.type, {"plane", "sphere", "rectangle", "disc", "mesh", "terrain", "gasket"},
              "plane: horizontal, reaches to the horizon; mesh: triangles of a PLY or OBJ file; terrain: land by a picture of heights; gasket: Sierpinski's tetrahedron of touching spheres");
  if (keys.only_if(is("plane"), "plane")) keys.number("height_m", shape.height_m, any(), "height of the plane above z = 0");
  if (keys.only_if(is("sphere") || is("rectangle") || is("disc") || is("terrain") || is("gasket"), "sphere, rectangle, disc, terrain, gasket"))
    keys.vector3("centre_m", shape.centre_m, "its centre; of a terrain: what its heights are counted from");
  if (keys.only_if(is("sphere") || is("disc"), "sphere, disc")) keys.number("radius_m", shape.radius_m, above(0), "its radius");
  if (keys.only_if(is("rectangle"), "rectangle")) {
    keys.vector3("edge_u_m", shape.edge_u_m, "one side, from corner to corner");
    keys.vector3("edge_v_m", shape.edge_v_m, "the other side");
    if (!keys.documents() && !(squared_length(cross(shape.edge_u_m, shape.edge_v_m)) > 0))
      keys.refuse("edge_v_m", "a side along edge_u_m", "must lead elsewhere than edge_u_m");
  }
  if (keys.only_if(is("disc"), "disc")) {
    keys.vector3("normal", shape.normal, "across the disc, of any length");
    if (!keys.documents() && !(squared_length(shape.normal) > 0)) keys.refuse("normal", "[0, 0, 0]", "must have a length");
    keys.number("inner_radius_m", shape.inner_radius_m, at_least(0), "of a round hole in its middle, less than radius_m");
    if (!keys.documents() && !(shape.inner_radius_m < shape.radius_m))
      keys.refuse("inner_radius_m", number_text(shape.inner_radius_m), "must be less than radius_m = " + number_text(shape.radius_m));
  }
  if (keys.only_if(is("mesh") || is("terrain"), "mesh, terrain")) {
    keys.text("file", shape.file, "mesh: PLY or OBJ in metres; terrain: picture of heights, north at its top, PNG, TIFF, EXR or another kind, of which the first channel counts; relative to the scene file");
    if (shape.file.empty() && !keys.documents()) keys.refuse("file", "nothing", is("mesh") ? "the name of a PLY or OBJ file expected" : "the name of a picture of heights expected");
  }
  if (keys.only_if(is("terrain"), "terrain")) {
    keys.numbers("size_m", shape.size_m, above(0), 2, 2, "of the whole picture, from west to east and from south to north");
    keys.number("low_m", shape.low_m, any(), "height above centre_m where the picture has 0, black");
    keys.number("high_m", shape.high_m, any(), "where it has 1, which is white: the largest whole number of the file's type; floating-point heights in metres need neither key");
    if (!keys.documents() && shape.low_m == shape.high_m) keys.refuse("high_m", number_text(shape.high_m), "must differ from low_m");
  }
  if (keys.only_if(is("mesh"), "mesh")) {
    keys.number("scale", shape.scale, above(0), "applied first");
    keys.vector3("rotate_deg", shape.rotate_deg, "applied after scale: about x, then y, then z");
    keys.vector3("translate_m", shape.translate_m, "applied last");
  }
  if (keys.only_if(is("gasket"), "gasket")) {
    keys.number("edge_m", shape.edge_m, above(0), "edge of the tetrahedron whose corners the outermost spheres fill");
    keys.integer("depth", shape.depth, between(0, 11), "how often it is divided: 4^depth spheres");
  }
}

PieceGroup gasket(const Vec3& centre_m, double edge_m, int depth) {
  // Corners of a regular tetrahedron of edge 1 around its centre of mass, one of them on top.
  const double below = -std::sqrt(1.0 / 24), around = std::sqrt(1.0 / 3);
  const Vec3 corners[4] = {{0, 0, std::sqrt(3.0 / 8)},
                           {0, around, below},
                           {0.5, -0.5 * around, below},
                           {-0.5, -0.5 * around, below}};
  PieceGroup group;
  group.centre_m = centre_m;
  group.spheres.reserve(std::size_t{1} << (2 * depth));
  divide(group, Vec3(0), edge_m, depth, corners);
  return group;
}

PieceGroup pieces_of(const ShapeSettings& shape, const std::string& folder, const std::string& where, const RasterReader& heights) {
  PieceGroup group;
  if (shape.type == "sphere") {
    group.centre_m = shape.centre_m;
    group.spheres = {sphere_at(Vec3(0), shape.radius_m)};
  } else if (shape.type == "rectangle") {
    group.flats = {{shape.centre_m, shape.edge_u_m * 0.5, shape.edge_v_m * 0.5, false}};
  } else if (shape.type == "disc") {
    const Frame frame = frame_around(normalize(shape.normal));
    group.flats = {{shape.centre_m, frame.side * shape.radius_m, frame.other * shape.radius_m, true, shape.inner_radius_m / shape.radius_m}};
  } else if (shape.type == "gasket") {
    group = gasket(shape.centre_m, shape.edge_m, static_cast<int>(shape.depth));
  } else if (shape.type == "terrain") {
    group.terrain = std::make_shared<const Terrain>(read_terrain(shape, path_from(folder, shape.file), where, heights));
  } else {
    const auto placement = media::Affine::translation(shape.translate_m) * media::Affine::rotation_deg(shape.rotate_deg) *
                           media::Affine::scaling(Vec3(shape.scale));
    group.triangles = read_mesh(path_from(folder, shape.file), where);
    for (Triangle& t : group.triangles) t = {placement.point(t.a_m), placement.point(t.b_m), placement.point(t.c_m)};
  }
  return group;
}

}  // namespace arcus::render
