#include "phase/optics/sun_disc.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/base/curve.h"
#include "phase/base/units.h"
#include "phase/data/embedded.h"

namespace arcus::phase {

namespace {

/// Divides by the mean over the disc: dρ² = −dμ², so the mean of μ^k is ∫ μ^k 2μ dμ = 2/(k+2).
void normalise(std::array<double, 6>& coefficients) {
  double mean = 0;
  for (int k = 0; k < 6; ++k) mean += coefficients[k] * 2 / (k + 2);
  for (double& c : coefficients) c /= mean;
}

}  // namespace

DiscProfile::DiscProfile(double angular_radius_rad, DiscKind kind) : angular_radius_rad_(angular_radius_rad) {
  assert(angular_radius_rad > 0 && angular_radius_rad < pi / 2);
  if (kind == DiscKind::uniform) {
    rows_.push_back({550, {1, 0, 0, 0, 0, 0}});
    return;
  }
  const Columns table = read_columns(data::solar_limb_darkening(), "solar_limb_darkening.csv");
  const auto& wavelength_nm = table.named("wavelength_nm");
  for (std::size_t i = 0; i < wavelength_nm.size(); ++i) {
    Row row{wavelength_nm[i], {}};
    double sum = 0;
    for (int k = 0; k < 6; ++k) {
      row.coefficients[k] = table.columns[1 + k][i];
      sum += row.coefficients[k];
    }
    if (std::fabs(sum - 1) > 1e-3) continue;  // the misprinted row of 365.875 nm, whose intensity at the centre is 0.998
    normalise(row.coefficients);
    rows_.push_back(row);
  }
}

double DiscProfile::solid_angle_sr() const {
  const double sine = std::sin(angular_radius_rad_ / 2);
  return 4 * pi * sine * sine;
}

std::array<double, 6> DiscProfile::coefficients(double wavelength_nm) const {
  if (wavelength_nm <= rows_.front().wavelength_nm) return rows_.front().coefficients;
  if (wavelength_nm >= rows_.back().wavelength_nm) return rows_.back().coefficients;
  const auto upper = std::upper_bound(rows_.begin(), rows_.end(), wavelength_nm,
                                      [](double nm, const Row& row) { return nm < row.wavelength_nm; });
  const Row &a = *(upper - 1), &b = *upper;
  const double share = (wavelength_nm - a.wavelength_nm) / (b.wavelength_nm - a.wavelength_nm);
  std::array<double, 6> result;
  for (int k = 0; k < 6; ++k) result[k] = (1 - share) * a.coefficients[k] + share * b.coefficients[k];
  return result;
}

double DiscProfile::relative_radiance(double rho, double wavelength_nm) const {
  if (rho < 0 || rho > 1) return 0;
  const double mu = std::sqrt(1 - rho * rho);
  const std::array<double, 6> c = coefficients(wavelength_nm);
  double sum = c[5];
  for (int k = 4; k >= 0; --k) sum = sum * mu + c[k];
  return sum;
}

}  // namespace arcus::phase
