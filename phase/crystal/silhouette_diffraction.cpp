#include "phase/crystal/silhouette_diffraction.h"

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/optics/refractive_index.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

double encircled(double v) {
  if (v < 1e-2) return 0.25 * v * v;  // the difference from 1 has no digits here
  const double j0 = ::j0(v), j1 = ::j1(v);
  return 1 - j0 * j0 - j1 * j1;
}

}  // namespace

SilhouetteDiffraction::SilhouetteDiffraction(double projected_area_um2, double wavelength_nm) {
  if (!(projected_area_um2 > 0) || !std::isfinite(projected_area_um2))
    throw bad_input("projected area", number_text(projected_area_um2) + " um2", "must be above 0");
  x_ = phase::size_parameter(std::sqrt(projected_area_um2 / pi), wavelength_nm);
  whole_ = encircled(2 * x_);
}

double SilhouetteDiffraction::value_per_sr(double sin2_half) const {
  const double v = 2 * x_ * std::sqrt(std::max(0.0, sin2_half));
  const double airy = v < 1e-4 ? 1 : 2 * ::j1(v) / v;
  return x_ * x_ / (4 * pi) * airy * airy / whole_;
}

double SilhouetteDiffraction::share_within(double sin2_half) const {
  return encircled(2 * x_ * std::sqrt(std::clamp(sin2_half, 0.0, 1.0))) / whole_;
}

double SilhouetteDiffraction::draw_sin2_half(double u) const {
  const double wanted = u * whole_;
  double low = 0, high = 2 * x_;
  // In the rings the share still outside falls as 2 / (pi v).
  double v = std::min(wanted < 0.8 ? 2 * std::sqrt(wanted) : 2 / (pi * (1 - wanted)), 0.999 * high);
  for (int i = 0; i < 60 && high - low > 1e-9 * high; ++i) {
    const double miss = encircled(v) - wanted;
    (miss < 0 ? low : high) = v;
    const double j1 = ::j1(v);
    const double next =
        v - miss * v / (2 * j1 * j1);  // the slope is 2 J1^2 / v, zero at dark rings
    if (std::fabs(next - v) < 1e-12 * v) break;
    v = next > low && next < high ? next : 0.5 * (low + high);
  }
  return std::min(1.0, v * v / (4 * x_ * x_));
}

double SilhouetteDiffraction::width_rad() const {
  return 4 * std::asin(std::min(1.0, 1.61634 / (2 * x_)));  // (2 J1(v) / v)^2 = 1/2 at v = 1.61634
}

}  // namespace arcus::phase
