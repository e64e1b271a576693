#include "phase/population/shadow_lobe.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

constexpr int directions = 512;
constexpr std::size_t groups = 48;
constexpr int rings = 32, places_on_ring = 24;

/// Evenly spread over the sphere: Fibonacci's spiral.
Vec3 spread_direction(int i) {
  const double z = 1 - (2 * i + 1.0) / directions, azimuth = i * pi * (3 - std::sqrt(5.0));
  const double sine = std::sqrt(1 - z * z);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), z};
}

}  // namespace

std::vector<double> shadows_of(const CrystalPopulation& crystals, const std::vector<double>& scales) {
  std::vector<double> all;
  for (const CrystalShape& shape : crystals.shapes())
    for (int i = 0; i < directions; ++i) all.push_back(shape.projected_area(spread_direction(i)));
  // A crystal is met in proportion to its shadow; scales have their shares already.
  struct Shadow {
    double area, light;
  };
  std::vector<Shadow> shadows;
  double light = 0;
  for (const double area : all)
    for (const double scale : scales) {
      shadows.push_back({area * scale * scale, area});
      light += area;
    }
  std::sort(shadows.begin(), shadows.end(), [](const Shadow& a, const Shadow& b) { return a.area < b.area; });
  std::vector<double> means(groups, 0.0), weights(groups, 0.0);
  double before = 0;
  for (const Shadow& shadow : shadows) {
    const auto group = std::min(groups - 1, static_cast<std::size_t>((before + 0.5 * shadow.light) / light * groups));
    means[group] += shadow.area * shadow.light;
    weights[group] += shadow.light;
    before += shadow.light;
  }
  std::vector<double> result;
  for (std::size_t group = 0; group < groups; ++group)
    if (weights[group] > 0) result.push_back(means[group] / weights[group]);
  return result;
}

ShadowLobe::ShadowLobe(const std::vector<double>& shadow_um2, double wavelength_nm) {
  for (const double area : shadow_um2) patterns_.emplace_back(area, wavelength_nm);
}

double ShadowLobe::share_within(double sin2_half) const {
  double sum = 0;
  for (const SilhouetteDiffraction& pattern : patterns_) sum += pattern.share_within(sin2_half);
  return sum / static_cast<double>(patterns_.size());
}

std::vector<double> ShadowLobe::at_nodes(const HatNodes& nodes) const {
  constexpr int parts = 4;
  std::vector<double> light(nodes.count(), 0.0);
  double before = 0;
  for (std::size_t i = 0; i + 1 < nodes.count(); ++i)
    for (int part = 1; part <= parts; ++part) {
      const double upper_share = static_cast<double>(part) / parts, middle = upper_share - 0.5 / parts;
      const double within = share_within(nodes.s(i) + upper_share * (nodes.s(i + 1) - nodes.s(i)));
      light[i] += (1 - middle) * (within - before);
      light[i + 1] += middle * (within - before);
      before = within;
    }
  return light;
}

std::vector<double> ShadowLobe::blurred(const HatNodes& nodes, const std::vector<double>& values) const {
  std::vector<double> radius;  // sin² of half of it
  for (int ring = 0; ring < rings; ++ring) {
    const double share = (ring + 0.5) / rings;
    double low = 0, high = 1;  // in sin(half)
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (share_within(middle * middle) < share ? low : high) = middle;
    }
    radius.push_back(low * low);
  }
  std::vector<double> cosine;
  for (int place = 0; place < places_on_ring; ++place) cosine.push_back(std::cos(pi * (place + 0.5) / places_on_ring));

  std::vector<double> means(nodes.count());
  for (std::size_t i = 0; i < nodes.count(); ++i) {
    const double s = nodes.s(i);
    double sum = 0;
    for (const double g : radius) {
      const double reach = 2 * std::sqrt(std::max(0.0, s * (1 - s) * g * (1 - g)));
      for (const double c : cosine) {
        const HatNodes::Place place = nodes.place_of(s + g - 2 * s * g - reach * c);
        sum += values[place.node] + place.share * (values[place.node + 1] - values[place.node]);
      }
    }
    means[i] = sum / (rings * places_on_ring);
  }
  return means;
}

}  // namespace arcus::phase
