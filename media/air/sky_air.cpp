#include "media/air/sky_air.h"

#include <algorithm>
#include <cmath>

#include "phase/base/quadrature.h"
#include "phase/function/analytic.h"
#include "phase/optics/air.h"

namespace arcus::media {
namespace {

double legendre(int degree, double x) {
  double before = 1, here = x;
  if (degree == 0) return 1;
  for (int l = 2; l <= degree; ++l) {
    const double next = ((2 * l - 1) * x * here - (l - 1) * before) / l;
    before = here;
    here = next;
  }
  return here;
}

/// Scattering of the modes of haze together, weighted by what each scatters; by `value` of their phase functions.
template <class Value>
Spectrum mean_phase(const Haze& haze, const Wavelengths& wavelengths, const Value& value) {
  Spectrum sum, scattering;
  for (int mode = 0; mode < haze.mode_count(); ++mode) {
    const Spectrum share = haze.extinction_ratio(mode, wavelengths) * haze.albedo(mode, wavelengths);
    sum += share * value(haze.phase_function(mode));
    scattering += share;
  }
  return sum / scattering;
}

}  // namespace

SkyAir::SkyAir(const Haze* haze) : haze_(haze) {
  for (int lane = 0; lane < sky_lane_count; ++lane) {
    const double nm = sky_wavelength_nm(lane);
    wavelengths_[static_cast<std::size_t>(lane / wavelength_count)].nm[static_cast<std::size_t>(lane % wavelength_count)] = static_cast<float>(nm);
    scattering_m2_[lane] = static_cast<float>(phase::air_scattering_cross_section_m2(nm));
    ozone_m2_[lane] = static_cast<float>(phase::ozone_absorption_cross_section_m2(nm));
  }
  const Quadrature rule = gauss_legendre(64);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    molecular_second_ += 2 * pi * rule.weights[i] * static_cast<double>(molecular_phase_per_sr(rule.nodes[i])) * legendre(2, rule.nodes[i]);
  if (!haze_) return;
  for (int group = 0; group < sky_lane_count / wavelength_count; ++group)
    for (int mode = 0; mode < haze_->mode_count(); ++mode) {
      const Wavelengths& wavelengths = wavelengths_[static_cast<std::size_t>(group)];
      const Spectrum extinction = haze_->extinction_ratio(mode, wavelengths), albedo = haze_->albedo(mode, wavelengths);
      for (int j = 0; j < wavelength_count; ++j) {
        haze_extinction_[group * wavelength_count + j] += extinction[j];
        haze_scattering_[group * wavelength_count + j] += extinction[j] * albedo[j];
      }
    }
  // Moments with nodes that crowd around straight on: θ = π t².
  const Quadrature dense = gauss_legendre(400);
  haze_moments_.resize(most_degree + 2);
  for (std::size_t i = 0; i < dense.nodes.size(); ++i) {
    const double t = 0.5 * (1 + dense.nodes[i]), theta = pi * t * t, cosine = std::cos(theta);
    const double weight = 0.5 * dense.weights[i] * 2 * pi * t * std::sin(theta) * 2 * pi;
    const SkyLanes value = haze_phase_per_sr(cosine);
    for (int l = 0; l <= most_degree + 1; ++l) haze_moments_[static_cast<std::size_t>(l)].add(static_cast<float>(weight * legendre(l, cosine)), value);
  }
  for (int lane = 0; lane < sky_lane_count; ++lane) {
    const float whole = haze_moments_[0][lane], peak = haze_moments_[most_degree + 1][lane] / whole;
    for (SkyLanes& moment : haze_moments_) moment[lane] = (moment[lane] / whole - peak) / (1 - peak);
    haze_diffuse_scattering_[lane] = haze_scattering_[lane] * (1 - peak);
    haze_diffuse_extinction_[lane] = haze_extinction_[lane] - haze_scattering_[lane] * peak;
  }
}

SkyLanes SkyAir::diffuse_depth(const AirColumns& columns) const {
  SkyLanes result = static_cast<float>(columns.molecules_per_m2) * scattering_m2_;
  result.add(static_cast<float>(columns.ozone_per_m2), ozone_m2_);
  result.add(static_cast<float>(columns.haze_depth_550), haze_diffuse_extinction_);
  return result;
}

float SkyAir::molecular_phase_per_sr(double cosine) {
  static const phase::Rayleigh function;
  return static_cast<float>(function.value_per_sr({0.5 * (1 - cosine), 0.5 * (1 + cosine)}));
}

SkyLanes SkyAir::haze_phase_per_sr(double cosine) const {
  SkyLanes result;
  if (!haze_) return result;
  const Vec3 incoming(0, 0, 1), outgoing(std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine);
  for (int group = 0; group < sky_lane_count / wavelength_count; ++group) {
    const Wavelengths& wavelengths = wavelengths_[static_cast<std::size_t>(group)];
    const Spectrum value = mean_phase(*haze_, wavelengths, [&](const phase::PhaseFunction& function) { return function.value(incoming, outgoing, wavelengths); });
    for (int j = 0; j < wavelength_count; ++j) result[group * wavelength_count + j] = value[j];
  }
  return result;
}

SkyLanes SkyAir::diffuse_haze_phase_per_sr(double cosine) const {
  SkyLanes result;
  for (int l = 0; haze_ && l <= most_degree; ++l)
    result.add(static_cast<float>((2 * l + 1) / (4 * pi) * legendre(l, cosine)), haze_moments_[static_cast<std::size_t>(l)]);
  return result;
}

Spectrum SkyAir::haze_phase_per_sr(const Vec3& incoming, const Vec3& to_sun, const Wavelengths& wavelengths) const {
  return mean_phase(*haze_, wavelengths, [&](const phase::PhaseFunction& function) {
    return function.includes_sun_disc() ? function.sunlit_value(incoming, to_sun, wavelengths) : function.value(incoming, to_sun, wavelengths);
  });
}

}  // namespace arcus::media
