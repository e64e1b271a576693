#include "media/air/atmosphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "media/air/exponential_layer.h"
#include "media/air/flight.h"
#include "phase/base/quadrature.h"
#include "phase/optics/air.h"

namespace arcus::media {
namespace {

constexpr double ozone_begins_m = 10000, ozone_peaks_m = 25000, ozone_ends_m = 40000;
constexpr int points = 8, points_in_ozone = 3;
/// way_to_space_m() asks for it.
constexpr double least_radius_over_scale_height = 500;
/// As much as rounding may put a place on the ground below it.
constexpr double below_sea_level_m = 1e-3;

/// ∫ exp(−x t − k t²) dt for t from −½ to ½, to 10⁻⁸ where x is at most 1 and k at most 0.1.
double mean_of_exponential(double x, double k) {
  const double x2 = x * x, x4 = x2 * x2;
  return 1 + (x2 / 2 - k) / 12 + (x4 / 24 - k * x2 / 2 + k * k / 2) / 80 + (x4 * x2 / 720 - k * x4 / 24 + k * k * x2 / 4 - k * k * k / 6) / 448;
}

}  // namespace

Atmosphere::Atmosphere(const AirSettings& settings)
    : settings_(settings),
      molecules_per_m3_(phase::air_molecules_per_m3_at_sea_level * settings.pressure_hpa / 1013.25),
      haze_per_m_(settings.haze_depth_550 / settings.haze_scale_height_m),
      most_ozone_per_m3_(settings.ozone_dobson_units * phase::molecules_per_m2_in_dobson_unit / (0.5 * (ozone_ends_m - ozone_begins_m))),
      is_thin_(least_radius_over_scale_height * std::max(settings.molecule_scale_height_m, haze_per_m_ > 0 ? settings.haze_scale_height_m : 0.0) <= settings.planet_radius_m) {}

double Atmosphere::height_m(const Vec3& position_m) const {
  const double radius = settings_.planet_radius_m;
  const double squares = position_m.x * position_m.x + position_m.y * position_m.y + position_m.z * (2 * radius + position_m.z);
  return squares / (std::sqrt(squares + radius * radius) + radius);
}

double Atmosphere::ozone_per_m3(double height_m) const {
  const double up = (height_m - ozone_begins_m) / (ozone_peaks_m - ozone_begins_m), down = (ozone_ends_m - height_m) / (ozone_ends_m - ozone_peaks_m);
  return most_ozone_per_m3_ * std::max(0.0, std::min(up, down));
}

AirColumns Atmosphere::density(double height_m) const {
  if (height_m >= settings_.top_m) return {};
  const double h = std::max(0.0, height_m);
  return {molecules_per_m3_ * std::exp(-h / settings_.molecule_scale_height_m), ozone_per_m3(h),
          haze_per_m_ == 0 ? 0 : haze_per_m_ * std::exp(-h / settings_.haze_scale_height_m)};
}

Ray Atmosphere::clipped(const Ray& ray) const {
  const Flight flight(ray.origin_m, ray.direction, settings_.planet_radius_m, height_m(ray.origin_m));
  const double half = flight.half_below_m(settings_.top_m);
  Ray inside = ray;
  inside.nearest_m = std::max(ray.nearest_m, flight.to_lowest_m - half);
  inside.farthest_m = std::min(ray.farthest_m, flight.to_lowest_m + half);
  return inside;
}

std::optional<AirColumns> Atmosphere::short_columns(const Ray& ray) const {
  // Height is a parabola of the way, around its middle: the next term is length³ / (16 radius²), 12 mm for 20 km.
  constexpr double longest_m = 20000;
  const double length = ray.farthest_m - ray.nearest_m;
  if (!(length > 0 && length < longest_m)) return std::nullopt;
  const Vec3 middle = ray.at(0.5 * (ray.nearest_m + ray.farthest_m));
  const double height = height_m(middle), radius = settings_.planet_radius_m;
  const double climb = dot(Vec3(middle.x, middle.y, middle.z + radius), ray.direction) / (radius + height);
  const double rise = climb * length, bend = (1 - climb * climb) * length * length / (2 * (radius + height));
  const double lowest = height - 0.5 * std::fabs(rise), highest = height + 0.5 * std::fabs(rise) + 0.25 * bend;
  if (!(lowest >= -below_sea_level_m && highest < ozone_begins_m)) return std::nullopt;
  const auto mean = [&](double scale_height) { return std::exp(-height / scale_height) * mean_of_exponential(rise / scale_height, bend / scale_height); };
  const auto is_good = [&](double scale_height) { return std::fabs(rise) < scale_height && bend < 0.1 * scale_height; };
  if (!is_good(settings_.molecule_scale_height_m)) return std::nullopt;
  AirColumns sum{molecules_per_m3_ * length * mean(settings_.molecule_scale_height_m), 0, 0};
  if (haze_per_m_ > 0) {
    if (!is_good(settings_.haze_scale_height_m)) return std::nullopt;
    sum.haze_depth_550 = haze_per_m_ * length * mean(settings_.haze_scale_height_m);
  }
  return sum;
}

std::optional<AirColumns> Atmosphere::long_columns(const Flight& flight, double begin, double end) const {
  const double radius = settings_.planet_radius_m;
  struct Place {
    double height_m, climb;
  };
  const auto place = [&](double s) {
    const double height = flight.height_m(s);
    return Place{height, (s - flight.to_lowest_m) / (radius + height)};
  };
  const Place first = place(begin), last = place(end);
  const bool turns = flight.to_lowest_m > begin && flight.to_lowest_m < end;
  if (std::min(first.height_m, last.height_m) < -below_sea_level_m || (turns && flight.lowest_m < -below_sea_level_m)) return std::nullopt;
  // From the lowest point up to both sides, or what lies beyond the lower end less what lies beyond the higher.
  const auto way = [&](double scale_height) {
    const auto beyond = [&](const Place& from) { return way_to_space_m(from.height_m, std::fabs(from.climb), scale_height, radius); };
    const double ends = beyond(first), other_ends = beyond(last);
    return turns ? 2 * way_to_space_m(flight.lowest_m, 0, scale_height, radius) - ends - other_ends : std::fabs(ends - other_ends);
  };
  AirColumns sum{molecules_per_m3_ * way(settings_.molecule_scale_height_m), 0, haze_per_m_ > 0 ? haze_per_m_ * way(settings_.haze_scale_height_m) : 0};
  if (std::max(first.height_m, last.height_m) <= ozone_begins_m) return sum;

  // Between its corners ozone is linear in height, and height along a line nearly a parabola, on either side of the lowest point.
  static const Quadrature rule = gauss_legendre(points_in_ozone);
  const double half[] = {flight.half_below_m(ozone_begins_m), flight.half_below_m(ozone_peaks_m), flight.half_below_m(ozone_ends_m)};
  const auto piece = [&](double from, double to) {
    const double left = std::max(from, begin), right = std::min(to, end), half_length = 0.5 * (right - left), middle = 0.5 * (right + left);
    if (!(half_length > 0)) return;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      sum.ozone_per_m2 += half_length * rule.weights[i] * ozone_per_m3(flight.height_m(middle + half_length * rule.nodes[i]));
  };
  const double lowest = flight.to_lowest_m;
  for (int i = 0; i < 2; ++i) {
    if (begin < lowest) piece(lowest - half[i + 1], lowest - half[i]);
    if (end > lowest) piece(lowest + half[i], lowest + half[i + 1]);
  }
  return sum;
}

AirColumns Atmosphere::columns(const Ray& ray) const {
  if (is_thin_)
    if (const auto sum = short_columns(ray)) return *sum;
  const Flight flight(ray.origin_m, ray.direction, settings_.planet_radius_m, height_m(ray.origin_m));
  const double half_below_top = flight.half_below_m(settings_.top_m);
  const double begin = std::max(ray.nearest_m, flight.to_lowest_m - half_below_top), end = std::min(ray.farthest_m, flight.to_lowest_m + half_below_top);
  if (!(begin < end)) return {};
  if (is_thin_)
    if (const auto sum = long_columns(flight, begin, end)) return *sum;
  return columns_by_quadrature(flight, begin, end);
}

AirColumns Atmosphere::columns_by_quadrature(const Flight& flight, double begin, double end) const {
  // Panels end at sea level, where ozone has its corners, and before molecules or haze have fallen to less than e⁻³ in one: so eight points are good
  // to a millionth.
  static constexpr std::array<double, 12> layers{0, 500, 1500, 3000, 5000, 7500, 10000, 25000, 40000, 65000, 90000, 110000};
  std::array<double, 2 * layers.size() + 3> ends;
  std::size_t count = 0;
  const auto add = [&](double s) {
    if (s > begin && s < end) ends[count++] = s;
  };
  for (const double layer : layers) {
    const double half_below = flight.half_below_m(layer);
    if (half_below == 0) continue;
    add(flight.to_lowest_m - half_below);
    add(flight.to_lowest_m + half_below);
  }
  add(flight.to_lowest_m);
  ends[count++] = end;
  std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count));

  static const Quadrature rule = gauss_legendre(points);
  AirColumns sum;
  double left = begin;
  for (std::size_t panel = 0; panel < count; ++panel) {
    const double right = ends[panel], half_length = 0.5 * (right - left), middle = 0.5 * (right + left);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const AirColumns here = density(flight.height_m(middle + half_length * rule.nodes[i]));
      const double weight = half_length * rule.weights[i];
      sum += AirColumns{weight * here.molecules_per_m2, weight * here.ozone_per_m2, weight * here.haze_depth_550};
    }
    left = right;
  }
  return sum;
}

double Atmosphere::distance_to_sea_level_m(const Ray& ray) const {
  const Flight flight(ray.origin_m, ray.direction, settings_.planet_radius_m, height_m(ray.origin_m));
  const double distance = flight.to_lowest_m - flight.half_below_m(0);
  return flight.lowest_m < 0 && flight.to_lowest_m > 0 ? std::max(0.0, distance) : std::numeric_limits<double>::infinity();
}

double Atmosphere::optical_depth(const AirColumns& columns, double wavelength_nm, double haze_ratio) {
  return columns.molecules_per_m2 * phase::air_scattering_cross_section_m2(wavelength_nm) +
         columns.ozone_per_m2 * phase::ozone_absorption_cross_section_m2(wavelength_nm) + columns.haze_depth_550 * haze_ratio;
}

}  // namespace arcus::media
