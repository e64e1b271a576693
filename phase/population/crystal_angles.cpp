#include "phase/population/crystal_angles.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

struct Edge {
  double from_deg, to_deg;
};

/// Inner edges of all halos, from the least index's to the largest's.
std::vector<Edge> edges_of(const CrystalPopulation& crystals, double least_n, double largest_n) {
  std::vector<Edge> edges;
  for (const CrystalShape& shape : crystals.shapes())
    for (const CrystalFace& a : shape.faces())
      for (const CrystalFace& b : shape.faces()) {
        const double cosine = dot(a.normal, b.normal);
        const double from = least_deviation_deg(cosine, least_n), to = least_deviation_deg(cosine, largest_n);
        if (from < 0) continue;
        const bool is_known = std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
          return std::fabs(edge.from_deg - from) < 1e-3;
        });
        if (!is_known) edges.push_back({from, to < 0 ? from : to});
      }
  return edges;
}

double distance_to(const std::vector<Edge>& edges, double angle_deg) {
  double least = 180;
  for (const Edge& edge : edges)
    least = std::min(least, std::max({0.0, edge.from_deg - angle_deg, angle_deg - edge.to_deg}));
  return least;
}

}  // namespace

double least_deviation_deg(double cosine_of_normals, double n) {
  // The wedge between the faces; light that passes symmetrically is deviated least.
  const double wedge = std::acos(std::clamp(-cosine_of_normals, -1.0, 1.0));
  const double sine = n * std::sin(0.5 * wedge);
  if (wedge < 1e-6 || sine >= 1) return -1;
  return degrees(2 * std::asin(sine) - wedge);
}

std::vector<double> crystal_angles_deg(const CrystalPopulation& crystals, double least_n, double largest_n, double lobe_width_deg) {
  const std::vector<Edge> edges = edges_of(crystals, least_n, largest_n);
  const auto step_deg = [&](double angle_deg) {
    const double most = angle_deg < 60 ? 0.25 : 0.5;
    double step = std::clamp(0.05 + 0.1 * (distance_to(edges, angle_deg) - 0.5), 0.05, most);
    // Rings of the lobe lie one width apart, and fade.
    if (lobe_width_deg > 0) step = std::min(step, std::max(lobe_width_deg / 10, angle_deg / 20));
    // The sun's disc is averaged over these nodes, too.
    if (lobe_width_deg > 0 && angle_deg < 0.6) step = std::min(step, 0.05);
    return step;
  };
  std::vector<double> nodes{0};
  // The innermost rings of the sphere are so small that few rays meet them.
  double next = lobe_width_deg > 0 ? step_deg(0) : 0.5;
  while (next < 179.4) {
    nodes.push_back(next);
    next += step_deg(next);
  }
  nodes.push_back(180);
  return nodes;
}

}  // namespace arcus::phase
