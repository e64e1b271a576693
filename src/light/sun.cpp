#include "src/light/sun.h"

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "src/data/embedded.h"
#include "phase/optics/refractive_index.h"
#include "phase/settings/toml_text.h"

namespace arcus::render {

void list_keys(Keys& keys, SunSettings& sun) {
  keys.number("azimuth_deg", sun.azimuth_deg, any(), "compass azimuth of the sun, clockwise from north");
  keys.number("elevation_deg", sun.elevation_deg, between(-90, 90), "elevation above the horizon");
  const std::string before = sun.body;
  keys.choice("body", sun.body, {"sun", "moon"},
              "what shines; moon: the sun's light sent on by the moon, redder and some 400,000 times weaker, in place of the sun");
  if (sun.body != before) sun.angular_radius_deg = sun.is_moon() ? phase::mean_moon_radius_deg : phase::mean_sun_radius_deg;
  if (keys.only_if(sun.is_moon(), "body = moon")) {
    keys.number("phase_angle_deg", sun.phase_angle_deg, between(0, most_phase_angle_deg), "angle sun - moon - eye: 0 full, 90 half, towards 180 new");
    keys.number("bright_limb_deg", sun.bright_limb_deg, any(),
                "where the middle of the lit edge is, from the top of the disc counterclockwise as it is seen: 270 to the right, as of a waxing moon of the north");
  }
  keys.number("angular_radius_deg", sun.angular_radius_deg, above_up_to(0, 90), "apparent radius of the disc; 0.2590 for the moon");
  keys.text("spectrum", sun.spectrum,
            "solar (measured, at 1 AU), equal_energy (1 W m-2 nm-1), or a file of two columns: nm, W m-2 nm-1; of the sun, whose light the moon sends on");
  keys.number("irradiance_scale", sun.irradiance_scale, at_least(0), "multiplies the spectrum; 0 turns the light off");
}

namespace {

Curve scaled(std::vector<double> nm, std::vector<double> value, double scale, std::string_view where) {
  for (double& v : value) {
    if (v < 0) throw bad_input(where, "a negative irradiance", "values of at least 0 expected");
    v *= scale;
  }
  return Curve(std::move(nm), std::move(value), where);
}

}  // namespace

namespace {

Curve irradiance_of_sun(const SunSettings& sun, const std::string& folder) {
  if (sun.spectrum == "equal_energy") return Curve({1}, {sun.irradiance_scale}, "sun.spectrum");
  if (sun.spectrum == "solar") {
    const Columns table = read_columns(data::solar_spectrum_toa(), "solar_spectrum_toa.csv");
    std::vector<double> nm = table.named("wavelength_nm");
    for (double& air_nm : nm) air_nm *= phase::air_index(air_nm);  // the table is in air
    return scaled(std::move(nm), table.named("irradiance"), sun.irradiance_scale, "solar_spectrum_toa.csv");
  }
  const std::string path = path_from(folder, sun.spectrum);
  Columns table = read_columns_file(path);
  if (table.columns.size() != 2)
    throw bad_input(path, std::to_string(table.columns.size()) + " columns",
                    "two expected: wavelength [nm] and irradiance [W m-2 nm-1]");
  return scaled(std::move(table.columns[0]), std::move(table.columns[1]), sun.irradiance_scale, path);
}

/// Every nanometre, between which the moon's share is straight: the sun's own steps where they are finer.
Curve sent_on_by_moon(const Curve& suns, double phase_angle_deg) {
  const MoonReflection moon(phase_angle_deg);
  std::vector<double> nm = suns.x();
  for (int i = 0; i <= 400; ++i) nm.push_back(shortest_wavelength_nm + i);
  std::sort(nm.begin(), nm.end());
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  std::vector<double> values;
  for (const double at : nm) values.push_back(suns(at) * moon.irradiance_over_suns(at));
  return Curve(std::move(nm), std::move(values), "light of the moon");
}

}  // namespace

Curve sun_irradiance(const SunSettings& sun, const std::string& folder) {
  const Curve suns = irradiance_of_sun(sun, folder);
  return sun.is_moon() ? sent_on_by_moon(suns, sun.phase_angle_deg) : suns;
}

Sun::Sun(const SunSettings& settings, Curve irradiance_w_per_m2_nm)
    : frame_(frame_around(direction_of(settings.azimuth_deg, settings.elevation_deg))),
      angular_radius_rad_(radians(settings.angular_radius_deg)),
      sin2_half_radius_(std::pow(std::sin(angular_radius_rad_ / 2), 2)),
      solid_angle_sr_(4 * pi * sin2_half_radius_),
      is_on_(settings.irradiance_scale > 0),
      irradiance_(std::move(irradiance_w_per_m2_nm)),
      profile_(angular_radius_rad_, settings.disc()) {
  if (!settings.is_moon() || settings.phase_angle_deg == 0) return;
  face_.emplace(settings.phase_angle_deg);
  const double limb = radians(settings.bright_limb_deg), azimuth = radians(settings.azimuth_deg), elevation = radians(settings.elevation_deg);
  const Vec3 up(-std::sin(elevation) * std::sin(azimuth), -std::sin(elevation) * std::cos(azimuth), std::cos(elevation));
  const Vec3 right(std::cos(azimuth), -std::sin(azimuth), 0);
  frame_.side = up * std::cos(limb) - right * std::sin(limb);
  frame_.other = cross(frame_.along, frame_.side);
}

Spectrum Sun::irradiance_w_per_m2_nm(const Wavelengths& wavelengths) const {
  Spectrum result;
  for (int i = 0; i < wavelength_count; ++i) result[i] = static_cast<float>(irradiance_(wavelengths[i]));
  return result;
}

SunLight Sun::light(const Wavelengths& wavelengths) const {
  SunLight light{irradiance_w_per_m2_nm(wavelengths), {}};
  for (int i = 0; i < wavelength_count; ++i) {
    const auto coefficients = profile_.coefficients(wavelengths[i]);
    const double mean = is_on_ ? light.irradiance_w_per_m2_nm[i] / solid_angle_sr_ : 0;
    for (std::size_t k = 0; k < coefficients.size(); ++k) light.radiance_by_mu[k][i] = static_cast<float>(mean * coefficients[k]);
  }
  return light;
}

Spectrum Sun::radiance(const Vec3& direction, const SunLight& light) const {
  const double s = sin2_half_angle(direction, frame_.along);
  if (s >= sin2_half_radius_) return {};
  if (face_) return light.radiance_by_mu[0] * static_cast<float>(face_->relative_radiance(place_of(direction)));
  // rho: distance from the disc's centre over its radius, as the disc is seen in projection; mu is the cosine on the sun's sphere.
  const double rho2 = s * (1 - s) / (sin2_half_radius_ * (1 - sin2_half_radius_));
  const auto mu = static_cast<float>(std::sqrt(std::fmax(0.0, 1 - rho2)));
  Spectrum result;
  for (std::size_t k = light.radiance_by_mu.size(); k-- > 0;) result = result * mu + light.radiance_by_mu[k];
  return result;
}

double Sun::density_per_sr(const Vec3& direction) const {
  if (!(sin2_half_angle(direction, frame_.along) < sin2_half_radius_)) return 0;
  if (!face_) return 1 / solid_angle_sr_;
  return face_->is_lit(place_of(direction)) ? 1 / (solid_angle_sr_ * face_->lit_share()) : 0;
}

float Sun::most_radiance(const SunLight& light) const {
  if (face_) return light.radiance_by_mu[0][0] * static_cast<float>(face_->most_radiance());
  return radiance(to_centre(), light)[0];
}

MoonFace::Place Sun::place_of(const Vec3& direction) const {
  // rho = sin(delta/2) / sin(radius/2), so that equal areas are equal solid angles; across the direction to the centre lies sin(delta) = 2
  // sin(delta/2) cos(delta/2).
  const double s = sin2_half_angle(direction, frame_.along);
  const double scale = 1 / (2 * std::sqrt(sin2_half_radius_ * (1 - s)));
  return {dot(direction, frame_.side) * scale, dot(direction, frame_.other) * scale};
}

Vec3 Sun::draw_on_face(double u, double v) const {
  const double rho = std::sqrt(u);
  const MoonFace::Place place = face_->lit_place({rho * std::cos(2 * pi * v), rho * std::sin(2 * pi * v)});
  const double s = (place.x * place.x + place.y * place.y) * sin2_half_radius_;
  const double scale = 2 * std::sqrt(sin2_half_radius_ * (1 - s));
  return normalize(frame_.to_world(place.x * scale, place.y * scale, 1 - 2 * s));
}

}  // namespace arcus::render
