#include "phase/function/disc_convolution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "phase/base/quadrature.h"
#include "phase/base/units.h"

namespace arcus::phase {

namespace {

constexpr int powers = 6;
constexpr int series_terms = 4;

double square(double x) { return x * x; }

/// ∫ (1 − u²)^(k/2) u^(2p) du over [−1, 1], a beta function, times the coefficient of y^p in
/// 1/√(1 − y).
struct SeriesIntegrals {
  double value[powers][series_terms];
  SeriesIntegrals() {
    for (int k = 0; k < powers; ++k) {
      double coefficient = 1;
      for (int p = 0; p < series_terms; ++p) {
        value[k][p] = coefficient * std::beta(p + 0.5, 0.5 * k + 1);
        coefficient *= (p + 0.5) / (p + 1);
      }
    }
  }
};

/// Midpoints of a quarter turn; they integrate smooth periodic functions to all digits.
struct QuarterTurn {
  static constexpr int points = 24;
  double sine_squared[points], cosine[points];
  QuarterTurn() {
    for (int i = 0; i < points; ++i) {
      const double angle = (i + 0.5) * pi / (2 * points);
      sine_squared[i] = square(std::sin(angle));
      cosine[i] = std::cos(angle);
    }
  }
};

/// What the rings around the outgoing direction see of a disc whose centre is at an angle θ from it.
class DiscRings {
 public:
  DiscRings(double theta_rad, double disc_radius_rad)
      : theta_(theta_rad),
        sine_(std::sin(theta_rad)),
        s_disc_(square(std::sin(disc_radius_rad / 2))) {}

  /// Mean of mu^k over the azimuths of the ring of radius θ', with 0 where it is outside of the disc.
  ///
  /// A point of the ring is at δ from the disc's centre with sin²(δ/2) = A + B sin²(φ/2),
  /// A = sin²((θ−θ')/2), B = sin θ sin θ'; mu² = 1 − sin²(δ/2)/s_disc = (room − B sin²(φ/2))/s_disc
  /// with room = s_disc − A.
  std::array<double, powers> mean_powers(double ring_rad) const {
    static const SeriesIntegrals series;
    static const QuarterTurn quarter;
    constexpr double largest_series_m = 0.01;  // the first term left out is below 3e-9

    std::array<double, powers> mean{};
    const double room = s_disc_ - square(std::sin((theta_ - ring_rad) / 2));
    if (room <= 0) return mean;
    const double b = sine_ * std::sin(ring_rad);
    if (room >= b) {  // the whole ring lies on the disc
      for (int i = 0; i < quarter.points; ++i)
        add_powers(mean, std::sqrt((room - b * quarter.sine_squared[i]) / s_disc_),
                   1.0 / quarter.points);
      return mean;
    }
    // With sin(φ/2) = √m u, m = room/B: dφ = 2√m du / √(1 − m u²), mu² = (room/s_disc) (1 − u²).
    const double m = room / b, mu_middle = std::sqrt(room / s_disc_);
    if (m < largest_series_m) {
      double power = std::sqrt(m) / pi;
      for (int k = 0; k < powers; ++k, power *= mu_middle) {
        double sum = 0;
        for (int p = series_terms - 1; p >= 0; --p) sum = sum * m + series.value[k][p];
        mean[k] = power * sum;
      }
      return mean;
    }
    for (int i = 0; i < quarter.points; ++i) {  // u = sin χ
      const double weight = std::sqrt(m) * quarter.cosine[i] /
                            (quarter.points * std::sqrt(1 - m * quarter.sine_squared[i]));
      add_powers(mean, mu_middle * quarter.cosine[i], weight);
    }
    return mean;
  }

 private:
  static void add_powers(std::array<double, powers>& sum, double mu, double weight) {
    for (int k = 0; k < powers; ++k, weight *= mu) sum[k] += weight;
  }

  double theta_, sine_, s_disc_;
};

}  // namespace

DiscConvolution::DiscConvolution(const std::vector<double>& angle_deg, const DiscProfile& disc)
    : disc_(disc), stencils_(angle_deg.size()) {
  for (const double deg : angle_deg) angle_rad_.push_back(radians(deg));
  tbb::parallel_for(0, static_cast<int>(angle_rad_.size()),
                    [this](int i) { stencils_[i] = stencil_at(i); });
}

DiscConvolution::Stencil DiscConvolution::stencil_at(int node) const {
  static const Quadrature rules[] = {gauss_legendre(3), gauss_legendre(6), gauss_legendre(16)};
  const double theta = angle_rad_[node], radius = disc_.angular_radius_rad();
  const double from = std::fmax(0.0, theta - radius), to = std::fmin(pi, theta + radius);
  const DiscRings rings(theta, radius);
  const double s_disc = square(std::sin(radius / 2));

  Stencil stencil;
  stencil.first = static_cast<int>(std::upper_bound(angle_rad_.begin(), angle_rad_.end(), from) - angle_rad_.begin()) - 1;
  stencil.first = std::max(0, stencil.first);
  for (int j = stencil.first; j + 1 < static_cast<int>(angle_rad_.size()) && angle_rad_[j] < to; ++j) {
    if (stencil.weight.empty()) stencil.weight.push_back({});
    stencil.weight.push_back({});
    auto& lower = stencil.weight[stencil.weight.size() - 2];
    auto& upper = stencil.weight.back();
    const double a = angle_rad_[j], b = angle_rad_[j + 1];
    const double width = std::sin((b - a) / 2) * std::sin((b + a) / 2);  // in s

    // The ring's share in the disc has a kink where the ring begins to lie inside of it.
    double ends[] = {std::fmax(a, from), std::fmin(b, to), std::fmin(b, to)};
    int pieces = 1;
    for (const double kink : {radius - theta, 2 * pi - radius - theta})
      if (kink > ends[0] && kink < ends[1]) {
        ends[1] = kink;
        pieces = 2;
      }
    for (int piece = 0; piece < pieces; ++piece) {
      const double share_of_radius = (ends[piece + 1] - ends[piece]) / radius;
      const Quadrature& rule = rules[share_of_radius > 0.25 ? 2 : share_of_radius > 0.05 ? 1 : 0];
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        // x = t² (3 − 2t) makes the square roots at the disc's edges smooth.
        const double t = 0.5 * (1 + rule.nodes[q]), length = ends[piece + 1] - ends[piece];
        const double ring = ends[piece] + length * t * t * (3 - 2 * t);
        const double d_ring = 0.5 * rule.weights[q] * length * 6 * t * (1 - t);
        const double share = std::sin((ring - a) / 2) * std::sin((ring + a) / 2) / width;
        const double scale = 0.5 * std::sin(ring) * d_ring / s_disc;  // ds / s_disc
        const auto mean = rings.mean_powers(ring);
        for (int k = 0; k < powers; ++k) {
          lower[k] += scale * (1 - share) * mean[k];
          upper[k] += scale * share * mean[k];
        }
      }
    }
  }
  // The mean of mu^k over the disc is 2/(k+2); what quadrature missed is spread evenly.
  for (int k = 0; k < powers; ++k) {
    double sum = 0;
    for (const auto& weight : stencil.weight) sum += weight[k];
    for (auto& weight : stencil.weight) weight[k] *= 2.0 / (k + 2) / sum;
  }
  return stencil;
}

void DiscConvolution::apply(std::span<const float> values, int rows,
                            const WavelengthGrid& wavelengths, std::span<float> result) const {
  const std::size_t angles = angle_rad_.size(), count = wavelengths.count();
  std::vector<std::array<double, powers>> radiance;  // [wavelength][power]
  for (std::size_t k = 0; k < count; ++k)
    radiance.push_back(disc_.coefficients(wavelengths.wavelength_nm(static_cast<double>(k))));

  tbb::parallel_for(std::size_t{0}, angles, [&](std::size_t i) {
    const Stencil& stencil = stencils_[i];
    std::vector<float> weights(stencil.weight.size() * count);  // [neighbour][wavelength]
    for (std::size_t j = 0; j < stencil.weight.size(); ++j)
      for (std::size_t k = 0; k < count; ++k) {
        double sum = 0;
        for (int p = 0; p < powers; ++p) sum += stencil.weight[j][p] * radiance[k][p];
        weights[j * count + k] = static_cast<float>(sum);
      }
    for (int row = 0; row < rows; ++row) {
      float* out = result.data() + (row * angles + i) * count;
      std::fill_n(out, count, 0.0f);
      const float* in = values.data() + (row * angles + stencil.first) * count;
      for (std::size_t j = 0; j < stencil.weight.size(); ++j)
        for (std::size_t k = 0; k < count; ++k) out[k] += weights[j * count + k] * in[j * count + k];
    }
  });
}

}  // namespace arcus::phase
