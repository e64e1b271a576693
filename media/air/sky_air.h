#pragma once
// The air's cross sections and phase functions at the wavelengths of the sky's table.

#include <array>
#include <vector>

#include "media/air/atmosphere.h"
#include "media/air/haze.h"
#include "media/air/sky_lanes.h"

namespace arcus::media {

class SkyAir {
 public:
  /// Degree up to which light that was scattered before is described where there is haze; the forward peak beyond counts as not scattered
  /// (W. Wiscombe, "The delta-M method", Journal of the Atmospheric Sciences 34, 1408, 1977).
  static constexpr int most_degree = 8;

  explicit SkyAir(const Haze* haze);

  bool has_haze() const { return haze_ != nullptr; }
  /// Degrees that are needed: 2 without haze.
  int degree() const { return haze_ ? most_degree : 2; }
  /// Optical depth of columns, without what haze sends straight on.
  SkyLanes diffuse_depth(const AirColumns& columns) const;
  SkyLanes molecular_scattering(const AirColumns& columns) const { return static_cast<float>(columns.molecules_per_m2) * scattering_m2_; }
  /// All that haze scatters, and that without what it sends straight on.
  SkyLanes haze_scattering(const AirColumns& columns) const { return static_cast<float>(columns.haze_depth_550) * haze_scattering_; }
  SkyLanes diffuse_haze_scattering(const AirColumns& columns) const { return static_cast<float>(columns.haze_depth_550) * haze_diffuse_scattering_; }
  /// Phase function of molecules at a scattering angle with that cosine [1/sr], the same at all wavelengths.
  static float molecular_phase_per_sr(double cosine);
  /// Of haze, all modes together; without haze 0.
  SkyLanes haze_phase_per_sr(double cosine) const;
  /// That without its peak, by its moments: smooth, and normalised.
  SkyLanes diffuse_haze_phase_per_sr(double cosine) const;
  /// The same at a path's wavelengths; where `to_centre` is asked for, sunlight from its disc.
  Spectrum haze_phase_per_sr(const Vec3& incoming, const Vec3& to_sun, const Wavelengths& wavelengths) const;
  /// 2π ∫ p P_l dμ by degree, of molecules, and of haze without its peak.
  double molecular_moment(int degree) const { return degree == 0 ? 1 : degree == 2 ? molecular_second_ : 0; }
  const SkyLanes& haze_moment(int degree) const { return haze_moments_[static_cast<std::size_t>(degree)]; }

 private:
  const Haze* haze_;
  std::array<Wavelengths, sky_lane_count / wavelength_count> wavelengths_;
  SkyLanes scattering_m2_, ozone_m2_, haze_extinction_, haze_scattering_, haze_diffuse_scattering_, haze_diffuse_extinction_;
  double molecular_second_ = 0;
  std::vector<SkyLanes> haze_moments_;
};

}  // namespace arcus::media
