#include "src/light/sun.h"

#include <cmath>

#include "phase/base/error.h"
#include "src/data/embedded.h"
#include "phase/optics/refractive_index.h"
#include "phase/settings/toml_text.h"

namespace arcus::render {

void list_keys(Keys& keys, SunSettings& sun) {
  keys.number("azimuth_deg", sun.azimuth_deg, any(), "compass azimuth of the sun, clockwise from north");
  keys.number("elevation_deg", sun.elevation_deg, between(-90, 90), "elevation above the horizon");
  keys.number("angular_radius_deg", sun.angular_radius_deg, above_up_to(0, 90), "apparent radius of the disc");
  keys.text("spectrum", sun.spectrum,
            "solar (measured, at 1 AU), equal_energy (1 W m-2 nm-1), or a file of two columns: nm, W m-2 nm-1");
  keys.number("irradiance_scale", sun.irradiance_scale, at_least(0), "multiplies the spectrum; 0 turns the sun off");
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

Curve sun_irradiance(const SunSettings& sun, const std::string& folder) {
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

Sun::Sun(const SunSettings& settings, Curve irradiance_w_per_m2_nm)
    : frame_(frame_around(direction_of(settings.azimuth_deg, settings.elevation_deg))),
      angular_radius_rad_(radians(settings.angular_radius_deg)),
      sin2_half_radius_(std::pow(std::sin(angular_radius_rad_ / 2), 2)),
      solid_angle_sr_(4 * pi * sin2_half_radius_),
      is_on_(settings.irradiance_scale > 0),
      irradiance_(std::move(irradiance_w_per_m2_nm)),
      profile_(angular_radius_rad_) {}

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
  // rho: distance from the disc's centre over its radius, as the disc is seen in projection; mu is the cosine on the sun's sphere.
  const double rho2 = s * (1 - s) / (sin2_half_radius_ * (1 - sin2_half_radius_));
  const auto mu = static_cast<float>(std::sqrt(std::fmax(0.0, 1 - rho2)));
  Spectrum result;
  for (std::size_t k = light.radiance_by_mu.size(); k-- > 0;) result = result * mu + light.radiance_by_mu[k];
  return result;
}

double Sun::density_per_sr(const Vec3& direction) const {
  return sin2_half_angle(direction, frame_.along) < sin2_half_radius_ ? 1 / solid_angle_sr_ : 0;
}

}  // namespace arcus::render
