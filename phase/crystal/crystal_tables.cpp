#include "phase/crystal/crystal_tables.h"

namespace arcus::phase {

void CrystalTables::add_fan(const CrystalFace* face) {
  first_triangle.push_back(static_cast<int>(triangles.size()));
  if (face == nullptr) return;
  const auto& corners = face->corners;
  double share = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3 first = corners[i] - corners[0], second = corners[i + 1] - corners[0];
    share += 0.5 * length(cross(first, second)) / face->area;
    Triangle t;
    for (int k = 0; k < 3; ++k) {
      t.corner[k] = static_cast<float>(corners[0][k]);
      t.first[k] = static_cast<float>(first[k]);
      t.second[k] = static_cast<float>(second[k]);
    }
    t.share_up_to_here = i + 2 == corners.size() ? 1.0f : static_cast<float>(share);
    triangles.push_back(t);
  }
}

CrystalTables::CrystalTables(const CrystalShape& shape) {
  const auto& faces = shape.faces();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const CrystalFace& face = faces[i];
    const bool paired = i + 1 < faces.size() && are_opposite(face, faces[i + 1]);
    const CrystalFace* other = paired ? &faces[++i] : nullptr;
    Slab slab;
    slab.nx = static_cast<float>(face.normal.x);
    slab.ny = static_cast<float>(face.normal.y);
    slab.nz = static_cast<float>(face.normal.z);
    slab.plus = static_cast<float>(face.distance);
    slab.area_plus = static_cast<float>(face.area);
    slab.number_plus = face.number;
    slab.minus = other ? static_cast<float>(other->distance) : no_face;
    slab.area_minus = other ? static_cast<float>(other->area) : 0;
    slab.number_minus = other ? other->number : 0;
    slabs.push_back(slab);
    add_fan(&face);
    add_fan(other);
  }
}

}  // namespace arcus::phase
