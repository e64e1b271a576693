#pragma once
// Surfaces for tests, without a scene file.

#include "src/shape/surfaces.h"

namespace arcus::render {

inline Surfaces matte_plane(double height_m, double albedo) {
  SurfaceParts parts;
  parts.planes.push_back({height_m, 0});
  parts.materials.push_back(Material(Matte(albedo)));
  return Surfaces(std::move(parts));
}

/// One sphere around a place.
inline PieceGroup one_sphere(const Vec3& centre_m, double radius_m) {
  PieceGroup group;
  group.centre_m = centre_m;
  group.spheres = {{0, 0, 0, static_cast<float>(radius_m)}};
  return group;
}

inline Material dielectric(double n, double k = 0) {
  return Material(Dielectric{ClearBody(phase::RefractiveIndex::constant({n, k}), SmoothSpectrum(1), 1)});
}
inline Material water() { return Material(Dielectric{ClearBody(phase::RefractiveIndex::water(), SmoothSpectrum(1), 1)}); }

}  // namespace arcus::render
