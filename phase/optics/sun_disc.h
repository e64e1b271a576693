#pragma once
// How bright the disc of the light is from its centre to its edge. The sun: limb darkening after H. Neckel and D. Labs, "Solar limb
// darkening 1986-1990 (303 nm to 1099 nm)", Solar Physics 153, 91-114 (1994), Table 1. The full moon: uniform; its light comes back from between
// grains and rocks, and the limb is as bright as the middle (M. Minnaert, "Photometry of the Moon", in Planets and Satellites, ed. Kuiper and
// Middlehurst, Chicago 1961, chapter 6: no limb darkening at full moon; the law of Lommel and Seeliger says the same).

#include <array>
#include <vector>

namespace arcus::phase {

/// Mean apparent radius of the sun seen from the Earth [deg].
inline constexpr double mean_sun_radius_deg = 0.2666;
/// And of the moon: 1737.4 km, the mean radius, at 384400 km, the mean distance.
inline constexpr double mean_moon_radius_deg = 0.2590;

/// Whose disc.
enum class DiscKind { limb_darkened, uniform };

/// Radiance over a disc relative to its mean. A place on the disc is given by rho, its distance from the centre over
/// the disc's radius; a place seen at an angle δ from the centre of a disc of angular radius α has
/// rho² = sin²(δ/2) / sin²(α/2), so that equal steps of rho² are equal solid angles.
class DiscProfile {
 public:
  /// The angular radius in (0, pi/2) [rad].
  explicit DiscProfile(double angular_radius_rad, DiscKind kind = DiscKind::limb_darkened);

  double angular_radius_rad() const { return angular_radius_rad_; }
  /// Solid angle of the disc [sr].
  double solid_angle_sr() const;

  /// Radiance at rho over the disc's mean radiance, which makes the mean of this number over the disc 1. Zero beyond
  /// rho = 1. Wavelengths beyond the sun's table of 303 to 1099 nm are taken at its ends.
  double relative_radiance(double rho, double wavelength_nm) const;

  /// The same as a polynomial: relative radiance = Σ c[k] mu^k, mu = √(1 − rho²), with Σ c[k] · 2/(k+2) = 1.
  std::array<double, 6> coefficients(double wavelength_nm) const;

 private:
  struct Row {
    double wavelength_nm;
    std::array<double, 6> coefficients;
  };
  std::vector<Row> rows_;
  double angular_radius_rad_;
};

}  // namespace arcus::phase
