#include "src/photon/relaxation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "phase/base/units.h"
#include "src/photon/point_tree.h"

namespace arcus::render {
namespace {

/// Photons among which there is pushing. Their numbers stand one after another.
struct Sheet {
  std::span<const std::uint32_t> photons;
};

int band_of(const Photon& photon, int bands) {
  if (!photon.is_alone()) return 0;
  const double share = (photon.wavelengths[0] - shortest_wavelength_nm) / (longest_wavelength_nm - shortest_wavelength_nm);
  return std::clamp(static_cast<int>(share * bands), 0, bands - 1);
}

std::vector<Sheet> sheets_of(const std::vector<Photon>& photons, int bands, std::vector<std::uint32_t>& order) {
  struct Key {
    std::uint64_t ancestry;
    std::uint32_t group;
    int band;
    auto operator<=>(const Key&) const = default;
  };
  const auto key = [&](std::uint32_t i) { return Key{photons[i].ancestry, photons[i].piece.group, band_of(photons[i], bands)}; };
  order.resize(photons.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<Sheet> sheets;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && key(order[end]) == key(order[begin])) ++end;
    sheets.push_back({std::span<const std::uint32_t>(order).subspan(begin, end - begin)});
    begin = end;
  }
  return sheets;
}

/// Where the neighbours push a photon, in all [m], and the spacing there.
struct Push {
  Vec3 move_m{0, 0, 0};
  double spacing_m = 0;
};

Push push_on(const Vec3& normal, std::span<const Neighbour> others, const auto& offset_to, const Relaxation& relaxation, double strength) {
  const double radius_m = std::sqrt(others.back().squared_distance_m2);
  if (!(radius_m > 0)) return {};
  const double spacing_m = radius_m * std::sqrt(pi / static_cast<double>(others.size())), reach_m = relaxation.reach * spacing_m;
  Vec3 sum(0), centroid_m(0);
  for (const Neighbour& other : others) {
    const Vec3 offset_m = offset_to(other.point);
    centroid_m += offset_m * (1 / static_cast<double>(others.size()));
    const double distance_m = std::sqrt(other.squared_distance_m2);
    if (distance_m > 0 && distance_m < reach_m) sum -= offset_m * ((1 - distance_m / reach_m) / distance_m);
  }
  Vec3 move_m = sum * (strength * spacing_m);
  move_m -= normal * dot(move_m, normal);
  const double aside = length(centroid_m) / radius_m;
  if (aside > relaxation.edge_begins) {
    const Vec3 across = normalize(centroid_m);
    const double held = std::min(1.0, (aside - relaxation.edge_begins) / (relaxation.edge_holds - relaxation.edge_begins));
    move_m -= across * (held * dot(move_m, across));
  }
  const double far = length(move_m), limit_m = relaxation.longest_move * spacing_m;
  if (far > limit_m) move_m *= limit_m / far;
  return {move_m, spacing_m};
}

/// Adds the pushes within a sheet to those of all photons.
void add_pushes(const std::vector<Photon>& photons, const Sheet& sheet, const Relaxation& relaxation, double strength,
                std::vector<Push>& pushes) {
  std::vector<Vec3> points_m;
  points_m.reserve(sheet.photons.size());
  for (const std::uint32_t i : sheet.photons) points_m.push_back(photons[i].position_m);
  const PointTree tree(points_m);
  tbb::parallel_for(std::size_t{0}, sheet.photons.size(), [&](std::size_t i) {
    std::vector<Neighbour> nearest(static_cast<std::size_t>(relaxation.neighbours) + 1);
    tree.nearest(points_m[i], nearest);
    // The photon itself stands first, or another in the very same place.
    const Push push = push_on(photons[sheet.photons[i]].normal.full(), std::span<const Neighbour>(nearest).subspan(1),
                              [&](std::uint32_t j) { return points_m[j] - points_m[i]; }, relaxation, strength);
    Push& sum = pushes[sheet.photons[i]];
    sum.move_m += push.move_m;
    if (sum.spacing_m == 0) sum.spacing_m = push.spacing_m;
  });
}

/// The photon moved on its surface; nothing where it would leave it.
std::optional<Hit> snapped(const Photon& photon, const Push& push, const Surfaces& surfaces) {
  const Vec3 normal = photon.normal.full();
  const double lift_m = 0.5 * push.spacing_m;
  const auto hit = surfaces.nearest_hit({photon.position_m + push.move_m + normal * lift_m, -normal, 0, 2 * lift_m});
  if (!hit || hit->piece.group != photon.piece.group || !hit->material->matte() || dot(hit->normal, normal) < 0.5) return {};
  return hit;
}

}  // namespace

std::optional<Relaxed> relax_until(std::vector<Photon>& photons, const Surfaces& surfaces, const Relaxation& relaxation, const std::function<bool()>& must_stop) {
  const auto neighbours = static_cast<std::size_t>(relaxation.neighbours);
  std::vector<std::vector<std::uint32_t>> orders(2);
  std::vector<std::vector<Sheet>> levels;
  levels.push_back(sheets_of(photons, 1, orders[0]));
  if (relaxation.wavelength_bands > 1) levels.push_back(sheets_of(photons, relaxation.wavelength_bands, orders[1]));
  for (std::vector<Sheet>& sheets : levels) std::erase_if(sheets, [&](const Sheet& sheet) { return sheet.photons.size() <= neighbours; });
  Relaxed result;
  if (levels.front().empty()) return result;
  std::vector<Push> pushes;
  std::vector<double> moves;
  while (result.iterations < relaxation.iterations) {
    if (must_stop()) return std::nullopt;
    pushes.assign(photons.size(), {});
    for (const std::vector<Sheet>& sheets : levels)
      for (const Sheet& sheet : sheets)
        add_pushes(photons, sheet, relaxation, &sheets == &levels.front() ? relaxation.strength : relaxation.colour_strength, pushes);
    moves.assign(photons.size(), 0);
    tbb::parallel_for(std::size_t{0}, photons.size(), [&](std::size_t i) {
      if (pushes[i].spacing_m == 0) return;
      Photon& photon = photons[i];
      const auto hit = snapped(photon, pushes[i], surfaces);
      if (!hit) return;
      moves[i] = length(hit->position_m - photon.position_m) / pushes[i].spacing_m;
      photon.position_m = hit->position_m;
      photon.normal = ShortVec(hit->normal);
      photon.piece = hit->piece;
    });
    ++result.iterations;
    result.last_move = std::accumulate(moves.begin(), moves.end(), 0.0) / static_cast<double>(photons.size());
    if (result.last_move < relaxation.enough) break;
  }
  return result;
}

Relaxed relax(std::vector<Photon>& photons, const Surfaces& surfaces, const Relaxation& relaxation) {
  return *relax_until(photons, surfaces, relaxation, [] { return false; });
}

}  // namespace arcus::render
