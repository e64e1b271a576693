#pragma once
// The light of the scene: the sun, a disc of given radius with limb darkening and a spectrum, or the moon in its place, at any phase. Seen directly,
// drawn from, and asked for its irradiance. Wherever the code says sun, it is this one light.

#include <array>
#include <optional>
#include <string>

#include "phase/base/curve.h"
#include "phase/base/frame.h"
#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "phase/optics/sun_disc.h"
#include "phase/settings/keys.h"
#include "src/light/moon.h"

namespace arcus::render {

struct SunSettings {
  double azimuth_deg = 180;            ///< compass azimuth, clockwise from north
  double elevation_deg = 20;           ///< above the horizon
  std::string body = "sun";            ///< sun | moon
  double phase_angle_deg = 0;          ///< of the moon: 0 full, 90 half, towards 180 new
  double bright_limb_deg = 270;        ///< of the moon: where its lit edge is, counterclockwise from the top as it is seen
  double angular_radius_deg = phase::mean_sun_radius_deg;  ///< apparent radius of the disc
  std::string spectrum = "solar";      ///< solar | equal_energy | a file of two columns: nm (vacuum), W m-2 nm-1; the moon sends on its share
  double irradiance_scale = 1;         ///< multiplies the spectrum; 0 turns the light off

  bool is_moon() const { return body == "moon"; }
  phase::DiscKind disc() const { return is_moon() ? phase::DiscKind::uniform : phase::DiscKind::limb_darkened; }
};
void list_keys(Keys& keys, SunSettings& sun);

/// Spectral irradiance [W m-2 nm-1] against vacuum wavelength [nm] on a surface that faces the sun or moon, scale included.
/// `folder`: where a file's relative path starts. The built-in solar spectrum is Gueymard's (2004) at 1 AU.
/// Throws bad_input for a file that is no such table or has negative values.
Curve sun_irradiance(const SunSettings& sun, const std::string& folder);

/// The sun's light at a path's four wavelengths: made once a path, asked often.
struct SunLight {
  Spectrum irradiance_w_per_m2_nm;           ///< on a surface that faces the sun
  std::array<Spectrum, 6> radiance_by_mu;    ///< radiance = Σ radiance_by_mu[k] mu^k, mu = √(1 − rho²) [W m-2 sr-1 nm-1]; of the moon: the disc's mean, and zeros

  /// The same where the first wavelength has changed places with another.
  SunLight with_first(int j) const {
    SunLight result = *this;
    std::swap(result.irradiance_w_per_m2_nm[0], result.irradiance_w_per_m2_nm[j]);
    for (Spectrum& part : result.radiance_by_mu) std::swap(part[0], part[j]);
    return result;
  }
};

class Sun {
 public:
  Sun(const SunSettings& settings, Curve irradiance_w_per_m2_nm);

  bool is_on() const { return is_on_; }
  /// Unit vector from the scene to the disc's centre.
  const Vec3& to_centre() const { return frame_.along; }
  double angular_radius_rad() const { return angular_radius_rad_; }
  const Curve& irradiance_curve() const { return irradiance_; }

  /// Irradiance on a surface that faces the sun [W m-2 nm-1].
  Spectrum irradiance_w_per_m2_nm(const Wavelengths& wavelengths) const;
  SunLight light(const Wavelengths& wavelengths) const;
  /// Radiance seen in a direction (unit, from the scene) [W m-2 sr-1 nm-1]; 0 outside the disc.
  Spectrum radiance(const Vec3& direction, const SunLight& light) const;
  /// Nowhere on the disc is more at the first wavelength.
  float most_radiance(const SunLight& light) const;
  /// Density of draw() [1/sr] in a direction; 0 outside the disc, and on its dark part.
  double density_per_sr(const Vec3& direction) const;
  /// A direction on the lit part of the disc, uniform in solid angle; u, v in [0, 1).
  Vec3 draw(double u, double v) const { return face_ ? draw_on_face(u, v) : direction_in_cone(frame_, sin2_half_radius_, u, v); }

 private:
  /// Place on the moon's face in a direction of the disc.
  MoonFace::Place place_of(const Vec3& direction) const;
  Vec3 draw_on_face(double u, double v) const;

  Frame frame_;  // of the moon: side towards the bright limb
  double angular_radius_rad_, sin2_half_radius_, solid_angle_sr_;
  bool is_on_;
  Curve irradiance_;
  phase::DiscProfile profile_;
  std::optional<MoonFace> face_;  // of a moon that is not full
};

}  // namespace arcus::render
