#include "src/light/moon.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "phase/base/curve.h"
#include "phase/base/units.h"
#include "src/data/embedded.h"

namespace arcus::render {
namespace {

/// Where the magnitudes refer to: the middle of the V band.
constexpr double v_nm = 550;
constexpr double suns_v = -26.74;

/// Solves a symmetric 3 x 3 system.
std::array<double, 3> solved(double m[3][4]) {
  for (int i = 0; i < 3; ++i)
    for (int row = 0; row < 3; ++row) {
      if (row == i) continue;
      const double factor = m[row][i] / m[i][i];
      for (int k = i; k < 4; ++k) m[row][k] -= factor * m[i][k];
    }
  return {m[0][3] / m[0][0], m[1][3] / m[1][1], m[2][3] / m[2][2]};
}

/// ln of the disc reflectance as a parabola in t = (wavelength - 550 nm) / 100 nm, by least squares.
std::array<double, 3> reflectance_parabola(double phase_angle_deg) {
  const double g = std::clamp(phase_angle_deg, 1.55, 97.0), rad = radians(g);  // where it was measured
  const Columns table = read_columns(data::lunar_reflectance(), "lunar_reflectance.csv");
  const auto& nm = table.named("wavelength_nm");
  double m[3][4] = {};
  for (std::size_t i = 0; i < nm.size(); ++i) {
    const auto c = [&](const char* name) { return table.named(name)[i]; };
    const double ln = c("a0") + rad * (c("a1") + rad * (c("a2") + rad * c("a3"))) + c("d1") * std::exp(-g / 4.06054) + c("d2") * std::exp(-g / 12.8802) +
                      c("d3") * std::cos((g + 30.5858) / 16.7498);
    const double t = (nm[i] - v_nm) / 100, powers[3] = {1, t, t * t};
    for (int row = 0; row < 3; ++row) {
      for (int k = 0; k < 3; ++k) m[row][k] += powers[row] * powers[k];
      m[row][3] += powers[row] * ln;
    }
  }
  return solved(m);
}

}  // namespace

MoonReflection::MoonReflection(double phase_angle_deg) {
  const double g = phase_angle_deg;
  const double v = -12.73 + 0.026 * g + 4e-9 * g * g * g * g;
  const auto parabola = reflectance_parabola(g);
  c0_ = -0.4 * std::log(10.0) * (v - suns_v);
  c1_ = parabola[1];
  c2_ = parabola[2];
}

double MoonReflection::irradiance_over_suns(double wavelength_nm) const {
  const double t = (wavelength_nm - v_nm) / 100;
  return std::exp(c0_ + t * (c1_ + t * c2_));
}

MoonFace::MoonFace(double phase_angle_deg) : sine_(std::sin(radians(phase_angle_deg))), cosine_(std::cos(radians(phase_angle_deg))) {
  // The whole moon's brightness over that at full, by this law: 1 - sin(g/2) tan(g/2) ln cot(g/4), the mean of mu0 / (mu0 + mu) over half of the disc's.
  const double half = radians(phase_angle_deg) / 2;
  const double brightness = phase_angle_deg == 0 ? 1 : 1 - std::sin(half) * std::tan(half) * std::log(1 / std::tan(half / 2));
  per_mean_ = 2 / brightness;
  most_ = phase_angle_deg == 0 ? 1 : per_mean_;  // at the bright limb, where mu is 0
}

double MoonFace::mu_of(Place place) { return std::sqrt(std::max(0.0, 1 - place.x * place.x - place.y * place.y)); }

double MoonFace::relative_radiance(Place place) const {
  const double mu = mu_of(place), mu0 = place.x * sine_ + mu * cosine_;
  if (sine_ == 0) return 1;
  return mu0 > 0 ? per_mean_ * mu0 / (mu0 + mu) : 0;
}

MoonFace::Place MoonFace::lit_place(Place place) const {
  const double half_chord = std::sqrt(std::max(0.0, 1 - place.y * place.y));
  // From [-h, h] to [-h cos g, h].
  return {half_chord + lit_share() * (place.x - half_chord), place.y};
}

}  // namespace arcus::render
