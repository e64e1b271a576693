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

}  // namespace

void list_keys(Keys& keys, ShapeSettings& shape) {
  const auto is = [&](const char* type) { return shape.type == type; };
  keys.choice("type", shape.type, {"plane", "sphere", "rectangle", "disc", "mesh", "gasket"},
              "plane: horizontal, reaches to the horizon; mesh: triangles of a PLY or OBJ file; gasket: Sierpinski's tetrahedron of touching spheres");
  if (keys.only_if(is("plane"), "plane")) keys.number("height_m", shape.height_m, any(), "height of the plane above z = 0");
  if (keys.only_if(is("sphere") || is("rectangle") || is("disc") || is("gasket"), "sphere, rectangle, disc, gasket"))
    keys.vector3("centre_m", shape.centre_m, "its centre");
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
  if (keys.only_if(is("mesh"), "mesh")) {
    keys.text("file", shape.file, "PLY or OBJ, relative to the scene file, in metres");
    if (shape.file.empty() && !keys.documents()) keys.refuse("file", "nothing", "the name of a PLY or OBJ file expected");
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

PieceGroup pieces_of(const ShapeSettings& shape, const std::string& folder, const std::string& where) {
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
  } else {
    const auto placement = media::Affine::translation(shape.translate_m) * media::Affine::rotation_deg(shape.rotate_deg) *
                           media::Affine::scaling(Vec3(shape.scale));
    group.triangles = read_mesh(path_from(folder, shape.file), where);
    for (Triangle& t : group.triangles) t = {placement.point(t.a_m), placement.point(t.b_m), placement.point(t.c_m)};
  }
  return group;
}

}  // namespace arcus::render
