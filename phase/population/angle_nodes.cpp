#include "phase/population/angle_nodes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "phase/base/units.h"
#include "phase/population/scattering_table.h"

namespace arcus::phase {
namespace {

/// Scattering angle of the bow of order p (2: primary) by geometric optics, or nothing where there is none; folded into
/// 0 ... 180 (van de Hulst, Light Scattering by Small Particles, 1957, section 13.2).
void add_bow(double index, int order, std::vector<double>& bows_deg) {
  const double cosine2 = (index * index - 1) / (order * order - 1);
  if (!(index > 1) || cosine2 >= 1) return;
  const double incidence = std::acos(std::sqrt(cosine2)), refraction = std::asin(std::sin(incidence) / index);
  const double turned = (order - 1) * 180 + 2 * degrees(incidence) - 2 * order * degrees(refraction);
  const double folded = std::fabs(std::remainder(turned, 360.0));
  bows_deg.push_back(folded);
}

struct BowZone {
  double begin_deg, end_deg;
};

std::vector<BowZone> bow_zones(const AngularDetail& detail, double airy_deg) {
  std::vector<BowZone> zones;
  for (const int order : {2, 3}) {
    std::vector<double> bows;
    for (const double index : {detail.least_index, detail.largest_index}) add_bow(index, order, bows);
    if (bows.empty()) continue;
    const double margin = std::min(12 * airy_deg, 25.0);
    const auto [least, most] = std::minmax_element(bows.begin(), bows.end());
    zones.push_back({*least - margin, *most + margin});
  }
  return zones;
}

double distance_from_axis(double angle_deg) { return std::min(angle_deg, 180 - angle_deg); }

}  // namespace

std::vector<double> candidate_angles_deg(const AngularDetail& detail) {
  const double width = std::clamp(detail.relative_width, 0.05, 1.0);
  const double ring_deg = 180 / detail.largest_size_parameter;
  // The scale of Airy's theory, h^(1/3) x^(-2/3) with h = 4.87 for the primary bow of water.
  const double airy_deg = degrees(1.69 * std::pow(std::max(detail.largest_size_parameter, 1.0), -2.0 / 3));
  const std::vector<BowZone> zones = bow_zones(detail, airy_deg);
  // Linear interpolation of a sine within 0.1 % takes 70 nodes a period; candidates are closer.
  const double step_in_bow = std::clamp(airy_deg / 60, 0.002, 0.05), step_elsewhere = std::clamp(airy_deg / 20, 0.03, 0.1);
  const auto step_at = [&](double angle_deg) {
    // Rings are a period of 180°/x apart and survive until drops of different size are out of step.
    double step = std::max(ring_deg, distance_from_axis(angle_deg) * width / 2) / 100;
    const auto within = [&](const BowZone& z) { return angle_deg >= z.begin_deg && angle_deg <= z.end_deg; };
    return std::min(step, std::any_of(zones.begin(), zones.end(), within) ? step_in_bow : step_elsewhere);
  };
  std::vector<double> angles;
  for (double angle = 0; angle < 180; angle += step_at(angle)) angles.push_back(angle);
  if (180 - angles.back() < 0.3 * step_at(180)) angles.pop_back();
  angles.push_back(180);
  return angles;
}

std::vector<std::size_t> sufficient_nodes(std::span<const double> angle_deg, std::span<const double> curves,
                                          double tolerance) {
  const std::size_t angles = angle_deg.size(), count = curves.size() / angles;
  assert(angles >= 2 && curves.size() == angles * count);
  std::vector<double> s(angles), values(angles * count);  // [angle][curve]
  for (std::size_t i = 0; i < angles; ++i) {
    s[i] = sin2_half_deg(angle_deg[i]);
    for (std::size_t c = 0; c < count; ++c) values[i * count + c] = curves[c * angles + i];
  }
  std::vector<std::size_t> nodes{0};
  std::vector<double> low(count), high(count);
  while (nodes.back() + 1 < angles) {
    // From this node, every point that is passed narrows the slopes that a segment may have.
    const std::size_t start = nodes.back();
    const double* from = &values[start * count];
    std::fill(low.begin(), low.end(), -std::numeric_limits<double>::infinity());
    std::fill(high.begin(), high.end(), std::numeric_limits<double>::infinity());
    std::size_t best = start + 1;
    for (std::size_t j = start + 1; j < angles; ++j) {
      const double* to = &values[j * count];
      const double per_width = 1 / (s[j] - s[start]);
      int outside = 0, closed = 0;
      for (std::size_t c = 0; c < count; ++c) {
        const double slope = (to[c] - from[c]) * per_width, slack = tolerance * to[c] * per_width;
        outside += slope < low[c] || slope > high[c];
        low[c] = std::max(low[c], slope - slack);
        high[c] = std::min(high[c], slope + slack);
        closed += low[c] > high[c];
      }
      if (outside == 0) best = j;
      if (closed > 0) break;
    }
    nodes.push_back(best);
  }
  return nodes;
}

void add_spans(std::span<const double> node_deg, double relative_reach, double most_reach_deg,
               std::vector<AngleSpan>& spans) {
  const auto reach = [&](double angle_deg) {
    return std::min(relative_reach * distance_from_axis(angle_deg), most_reach_deg);
  };
  for (std::size_t i = 0; i + 1 < node_deg.size(); ++i) {
    const double a = node_deg[i], b = node_deg[i + 1];
    spans.push_back({a - reach(a), b + reach(b), b - a});
  }
}

std::vector<double> nodes_of(std::vector<AngleSpan> spans, std::span<const double> fixed_deg) {
  std::sort(spans.begin(), spans.end(), [](const AngleSpan& a, const AngleSpan& b) { return a.begin_deg < b.begin_deg; });
  std::vector<double> stops(fixed_deg.begin(), fixed_deg.end());
  stops.push_back(180);
  std::sort(stops.begin(), stops.end());
  std::vector<double> nodes{0};
  std::size_t stop = 0;
  while (stop < stops.size()) {
    const double angle = nodes.back();
    double step = stops[stop] - angle;
    for (const AngleSpan& span : spans) {
      if (span.begin_deg >= angle + step) break;
      if (span.end_deg <= angle) continue;
      step = std::min(step, std::max(span.step_deg, span.begin_deg - angle));
    }
    // A node just before one that is fixed would be wasted: share what is left.
    const double left = stops[stop] - angle;
    if (step < left) {
      nodes.push_back(angle + (left < 2 * step ? 0.5 * left : step));
    } else {
      nodes.push_back(stops[stop++]);
    }
  }
  return nodes;
}

double interpolation_error(std::span<const double> angle_deg, std::span<const double> values,
                           std::span<const std::size_t> nodes) {
  double worst = 0;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const std::size_t a = nodes[k], b = nodes[k + 1];
    const double s0 = sin2_half_deg(angle_deg[a]), s1 = sin2_half_deg(angle_deg[b]);
    for (std::size_t i = a + 1; i < b; ++i) {
      const double t = (sin2_half_deg(angle_deg[i]) - s0) / (s1 - s0);
      worst = std::max(worst, std::fabs((1 - t) * values[a] + t * values[b] - values[i]) / values[i]);
    }
  }
  return worst;
}

}  // namespace arcus::phase
