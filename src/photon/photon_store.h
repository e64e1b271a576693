#pragma once
// Photons by place, and how dense they lie: the density estimate of photon mapping (H. W. Jensen, "Global Illumination using Photon Maps",
// Eurographics Workshop on Rendering 1996; Realistic Image Synthesis Using Photon Mapping, 2001) with Epanechnikov's kernel.
//
// The k nearest count, within the distance r of the one after them: so the mean is right where photons lie evenly. The kernel falls to 0 at r,
// so that a place in the dark, whose nearest photons all lie at the far edge, hardly sees them.

#include <vector>

#include "media/space/box.h"
#include "phase/function/phase_function.h"
#include "src/photon/photon.h"
#include "src/photon/point_tree.h"
#include "src/photon/spectral_kernel.h"

namespace arcus::render {

/// What photons around a place bring.
struct Gathered {
  Spectrum value;
  double radius_m = 0;  ///< of the circle or ball that they were looked for in
};

class PhotonStore {
 public:
  static constexpr int most_neighbours = 1000;

  PhotonStore() : PhotonStore(std::vector<Photon>()) {}
  explicit PhotonStore(std::vector<Photon> photons);

  bool is_empty() const { return photons_.empty(); }
  const std::vector<Photon>& photons() const { return photons_; }

  /// Irradiance over that of a surface which faces the sun. Photons of surfaces that stand more than 26° askew are left out. `flat`: the piece that
  /// the place is on, where it is a flat one: what of the circle lies beyond its borders holds no photons and does not count; a straight border
  /// is exact, corners and bent ones nearly so.
  Gathered irradiance(const Vec3& position_m, const Vec3& normal, int neighbours, const SpectralQuery& query, const Flat* flat = nullptr) const;

  /// Light that is scattered against `incoming`, per albedo and sun's irradiance [1/sr]. What of the ball lies outside the medium's bounds
  /// holds no photons and does not count; a single face is exact, edges and corners nearly so.
  Gathered scattered(const Vec3& position_m, const Vec3& incoming, const phase::PhaseFunction& function, const Wavelengths& wavelengths,
                     int neighbours, const SpectralQuery& query, const media::Box& bounds_m) const;

 private:
  std::vector<Photon> photons_;
  PointTree tree_;
};

}  // namespace arcus::render
