#include "src/material/sea.h"

#include <algorithm>
#include <cmath>

#include "phase/base/frame.h"
#include "phase/base/quadrature.h"
#include "phase/optics/fresnel.h"
#include "src/material/matte.h"

namespace arcus::render {
namespace {

constexpr double foam_reflectance = 0.22;
const double per_root_pi = 1 / std::sqrt(pi);

/// Share of even light from above that a smooth surface reflects.
double mean_reflectance(double index) {
  return integrate([&](double cosine) { return 2 * cosine * phase::fresnel_reflectance(cosine, index).unpolarised(); }, 0, 1, 1e-9);
}

}  // namespace

SlopeVariance cox_munk_slopes(double wind_m_per_s, bool is_isotropic) {
  constexpr double smooth = 1e-6;
  const double w = wind_m_per_s, half = 0.5 * (0.003 + 0.00512 * w);
  if (is_isotropic) return {half, half};
  return {std::max(smooth, 0.00316 * w), 0.003 + 0.00192 * w};
}

double foam_cover(double wind_m_per_s) { return std::min(1.0, 2.95e-6 * std::pow(wind_m_per_s, 3.52)); }

Sea::Sea(const ClearBody& water, const SlopeVariance& slopes, double wind_from_deg, const SmoothSpectrum& water_reflectance, double foam)
    : water_(water),
      water_reflectance_(water_reflectance),
      foam_(foam),
      upwind_(direction_of(wind_from_deg, 0)),
      width_along_(std::sqrt(2 * slopes.along)),
      width_across_(std::sqrt(2 * slopes.across)),
      index_(water.index(550)) {
  // Of even light from below as much passes as of even light from above, over n^2.
  inner_reflectance_ = 1 - (1 - mean_reflectance(index_)) / (index_ * index_);
  mean_water_reflectance_ = 0;
  for (int i = 0; i < 20; ++i) mean_water_reflectance_ += water_reflectance.at(shortest_wavelength_nm + (i + 0.5) * 20) / 20;
}

SeaView::SeaView(const Sea& sea, const Vec3& normal, const Vec3& back, const Wavelengths& wavelengths) : sea_(sea), normal_(normal) {
  const Vec3 along = sea.upwind_ - normal * dot(sea.upwind_, normal);
  along_ = squared_length(along) > 1e-12 ? normalize(along) : frame_around(normal).side;
  across_ = cross(normal_, along_);
  back_ = local(back);
  back_.z = std::max(back_.z, 1e-9);
  smith_back_ = smith(back_);
  const double x = sea.width_along_ * back_.x, y = sea.width_across_ * back_.y, flat = std::hypot(x, y), whole = std::hypot(flat, back_.z);
  cosine_ = back_.z / whole;
  sine_ = flat / whole;
  turn_x_ = flat > 0 ? x / flat : 1;
  turn_y_ = flat > 0 ? y / flat : 0;

  const double n2 = sea.index_ * sea.index_;
  const Spectrum reflectance = sea.water_reflectance_.at(wavelengths);
  for (int i = 0; i < wavelength_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    index_[k] = sea.water_.index(wavelengths[i]);
    const double out = 1 - phase::fresnel_reflectance(back_.z, index_[k]).unpolarised();
    from_below_[i] = static_cast<float>(reflectance[i] * out / (pi * n2 * (1 - reflectance[i] * sea.inner_reflectance_)));
  }
  // Guesses of how much comes each way, the same for all wavelengths: of the noise alone.
  const double reflected = phase::fresnel_reflectance(back_.z, sea.index_).unpolarised();
  const double diffuse = (1 - sea.foam_) * sea.mean_water_reflectance_ / n2 * (1 - reflected) + sea.foam_ * foam_reflectance;
  specular_share_ = diffuse > 0 ? std::clamp(reflected / (reflected + diffuse), 0.25, 0.95) : 1;
}

double SeaView::smith(const Local& v) const {
  const double a = v.z / std::hypot(sea_.width_along_ * v.x, sea_.width_across_ * v.y);
  if (!(a < 6)) return 0;
  return 0.5 * (std::exp(-a * a) * per_root_pi / a - std::erfc(a));
}

double SeaView::normals(const Local& half) const {
  const double x = half.x / (half.z * sea_.width_along_), y = half.y / (half.z * sea_.width_across_), z2 = half.z * half.z;
  return std::exp(-x * x - y * y) / (pi * sea_.width_along_ * sea_.width_across_ * z2 * z2);
}

Spectrum SeaView::value_per_sr(const Vec3& away) const {
  const Local to = local(away);
  if (!(to.z > 0)) return {};
  const Local sum{to.x + back_.x, to.y + back_.y, to.z + back_.z};
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  const Local half{sum.x / length, sum.y / length, sum.z / length};
  const double facing = std::min(1.0, half.x * back_.x + half.y * back_.y + half.z * back_.z);
  const double facets = normals(half) / (4 * back_.z * to.z * (1 + smith_back_ + smith(to))) * (1 - sea_.foam_);
  Spectrum value;
  for (int i = 0; i < wavelength_count; ++i) {
    const double index = index_[static_cast<std::size_t>(i)];
    const double in = 1 - phase::fresnel_reflectance(to.z, index).unpolarised();
    const double from_below = (1 - sea_.foam_) * in * static_cast<double>(from_below_[i]);
    value[i] = static_cast<float>(facets * phase::fresnel_reflectance(facing, index).unpolarised() + from_below + sea_.foam_ * foam_reflectance / pi);
  }
  return value;
}

double SeaView::density_per_sr(const Vec3& away) const {
  const Local to = local(away);
  if (!(to.z > 0)) return 0;
  const Local sum{to.x + back_.x, to.y + back_.y, to.z + back_.z};
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  const double visible = normals({sum.x / length, sum.y / length, sum.z / length}) / (4 * back_.z * (1 + smith_back_));
  return specular_share_ * visible + (1 - specular_share_) * to.z / pi;
}

/// Where the roughness is 1 both ways, slopes along the view are seen with the density (cos + u sin) exp(-u^2) above -cot, u towards the eye. Its
/// integral is inverted by Newton's steps, halving where those leave the bracket.
double SeaView::visible_slope(double share) const {
  constexpr double far = 6;  // exp(-36)
  const double first = sine_ * far > cosine_ ? -cosine_ / sine_ : -far;
  const auto integral = [&](double u) {
    return 0.5 * cosine_ * (std::erf(u) - std::erf(first)) + 0.5 * per_root_pi * sine_ * (std::exp(-first * first) - std::exp(-u * u));
  };
  const double wanted = share * integral(far);
  double low = first, high = far, u = std::clamp(0.0, low, high);
  for (int round = 0; round < 60 && high - low > 1e-12; ++round) {
    const double error = integral(u) - wanted;
    (error < 0 ? low : high) = u;
    const double slope = per_root_pi * (cosine_ + u * sine_) * std::exp(-u * u);
    const double next = u - error / slope;
    if (std::fabs(next - u) < 1e-10) break;
    u = slope > 0 && next > low && next < high ? next : 0.5 * (low + high);
  }
  return u;
}

Vec3 SeaView::draw(Random& random) const {
  const double kind = random.uniform_double(), a = random.uniform_double(), b = random.uniform_double();
  if (kind >= specular_share_) return Matte::draw(normal_, a, b);
  const double u = visible_slope(a), v = std::sqrt(-std::log1p(-b)) * std::cos(2 * pi * random.uniform_double());
  const double x = sea_.width_along_ * (u * turn_x_ - v * turn_y_), y = sea_.width_across_ * (u * turn_y_ + v * turn_x_);
  const double z = 1 / std::sqrt(1 + x * x + y * y);
  const Local half{x * z, y * z, z};
  const double twice = 2 * (half.x * back_.x + half.y * back_.y + half.z * back_.z);
  return normalize(along_ * (twice * half.x - back_.x) + across_ * (twice * half.y - back_.y) + normal_ * (twice * half.z - back_.z));
}

}  // namespace arcus::render
