#include "phase/population/sun_light.h"

#include <cmath>

#include "phase/base/quick_math.h"
#include "phase/base/units.h"

namespace arcus::phase {

SunLight::SunLight(double elevation_deg, double angular_radius_deg, double wavelength_nm, DiscKind disc) : square_{} {
  const double e = radians(elevation_deg);
  centre_ = {std::cos(e), 0, std::sin(e)};
  above_ = {-std::sin(e), 0, std::cos(e)};
  if (angular_radius_deg <= 0) return;
  const double sine = std::sin(radians(angular_radius_deg) / 2);
  sin2_half_radius_ = static_cast<float>(sine * sine);
  // With radiance sum c_k mu^k, mu^2 = 1 - rho^2, the share of light outside of rho is sum c_k 2 / (k + 2) mu^(k + 2).
  const auto c = DiscProfile(radians(angular_radius_deg), disc).coefficients(wavelength_nm);
  for (int i = 1; i <= nodes; ++i) {
    double low = 0, high = 1;  // mu
    const double outside = 1 - static_cast<double>(i) / nodes;
    while (high - low > 1e-9) {
      const double mu = 0.5 * (low + high);
      double share = 0, power = mu * mu;
      for (int k = 0; k < 6; ++k, power *= mu) share += c[static_cast<std::size_t>(k)] * 2 / (k + 2) * power;
      (share < outside ? low : high) = mu;
    }
    square_[static_cast<std::size_t>(i)] = static_cast<float>(1 - low * low);
  }
  square_[nodes + 1] = square_[nodes];
}

void SunLight::draw(RandomColumns& random, VectorColumns& light) const {
  Column share, azimuth;
  random.uniform(share.values, column_rays);
  random.uniform(azimuth.values, column_rays);
  const auto cx = static_cast<float>(centre_.x), cz = static_cast<float>(centre_.z);
  const float* squares = square_.data();
  for (int i = 0; i < column_rays; ++i) {
    const float at = share[i] * nodes;
    const auto node = static_cast<std::int32_t>(at);
    const float square = squares[node] + (at - static_cast<float>(node)) * (squares[node + 1] - squares[node]);
    const float sin2_half = square * sin2_half_radius_;
    const float sine = 2 * std::sqrt(sin2_half * (1 - sin2_half)), cosine = 1 - 2 * sin2_half;
    const QuickSineCosine around = quick_sine_and_cosine_of_turn(azimuth[i]);
    const float up = sine * around.sine;
    light.x[i] = -(cx * cosine - cz * up);
    light.y[i] = -(sine * around.cosine);
    light.z[i] = -(cz * cosine + cx * up);
  }
}

}  // namespace arcus::phase
