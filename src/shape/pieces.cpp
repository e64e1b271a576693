#include "src/shape/pieces.h"

namespace arcus::render {

media::Box bounds_of(const PieceGroup& group) {
  media::Box box;
  for (const Sphere& sphere : group.spheres) {
    box.include(group.centre_m + sphere.offset_m() - Vec3(sphere.radius_m));
    box.include(group.centre_m + sphere.offset_m() + Vec3(sphere.radius_m));
  }
  for (const Flat& flat : group.flats)
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0}) box.include(flat.centre_m + flat.edge_u_m * u + flat.edge_v_m * v);
  if (group.terrain) box.include(group.terrain->bounds_m());
  for (const Triangle& t : group.triangles)
    for (const Vec3& corner : {t.a_m, t.b_m, t.c_m}) box.include(corner);
  return box;
}

}  // namespace arcus::render
