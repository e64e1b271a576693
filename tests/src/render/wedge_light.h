#pragma once
// Where Snell's law, twice, sends the light of the sun's disc through two faces of a crystal: halos without tables, tracers or maps, and
// what of a curve says where a halo stands.

#include <optional>

#include "phase/crystal/orientations.h"
#include "phase/optics/refractive_index.h"
#include "tests/src/render/thin_ice.h"

namespace arcus::render {

inline double ice_index(double nm) {
  static const phase::RefractiveIndex index = phase::RefractiveIndex::ice();
  return index.relative_to_air(nm).real();
}

/// Least deviation through a wedge; `height_deg` of the light over the plane at right angles to its edge (A. Bravais 1847).
inline double least_deviation_deg(double n, double wedge_deg, double height_deg = 0) {
  const double h = radians(height_deg), seen = std::sqrt(n * n - std::pow(std::sin(h), 2)) / std::cos(h);
  const double turned = 2 * std::asin(seen * std::sin(radians(wedge_deg) / 2)) - radians(wedge_deg);
  return degrees(2 * std::asin(std::cos(h) * std::sin(turned / 2)));
}
/// The same, as an angle about the wedge's edge: a parhelion's azimuth from the sun.
inline double least_turn_deg(double n, double wedge_deg, double height_deg) {
  const double h = radians(height_deg), seen = std::sqrt(n * n - std::pow(std::sin(h), 2)) / std::cos(h);
  return degrees(2 * std::asin(seen * std::sin(radians(wedge_deg) / 2))) - wedge_deg;
}

/// The normal of a crystal's prism face 3 to 8, of its top (1) or bottom (2), or of a pyramid (13 to 18, 23 to 28).
inline Vec3 face_normal(int face) {
  if (face < 3) return Vec3(0, 0, face == 1 ? 1 : -1);
  const double azimuth = radians(60 * (face % 10 - 3)), rise = face < 10 ? 0 : radians(face < 20 ? 28.0 : -28.0);
  return {std::cos(azimuth) * std::cos(rise), std::sin(azimuth) * std::cos(rise), std::sin(rise)};
}

/// Light of direction `d` (unit) that meets a surface with this outer normal from outside (n: of inside over outside) or, turned round,
/// from inside; nothing where it is reflected totally.
inline std::optional<Vec3> refracted_or_none(const Vec3& d, const Vec3& against, double ratio) {
  const double cosine = -dot(d, against), s = 1 - ratio * ratio * (1 - cosine * cosine);
  if (s < 0) return std::nullopt;
  return d * ratio + against * (ratio * cosine - std::sqrt(s));
}

/// What passes of natural light, whose cosines to the normal are these on both sides.
inline double passing(double cosine, double cosine_behind, double n) {
  const double s = (cosine - n * cosine_behind) / (cosine + n * cosine_behind), p = (n * cosine - cosine_behind) / (n * cosine + cosine_behind);
  return 1 - 0.5 * (s * s + p * p);
}

/// The strip, by so many rays through wedges that lie as told.
inline std::vector<double> wedge_light(const Strip& strip, double nm, int face_in, int face_out, const phase::OrientationSettings& lying,
                                       const SunSettings& sun, double rays, double n_added = 0) {
  const Vec3 in = face_normal(face_in), out = face_normal(face_out);
  const phase::Orientations orientations(lying);
  const phase::DiscProfile disc(radians(sun.angular_radius_deg));
  const Frame to_sun = frame_around(direction_of(0, sun.elevation_deg));
  const double n = ice_index(nm) + n_added, edge = std::pow(std::sin(radians(sun.angular_radius_deg) / 2), 2);
  constexpr int tasks = 32;
  std::vector<std::vector<double>> parts(tasks);
  tbb::parallel_for(0, tasks, [&](int task) {
    auto& light = parts[static_cast<std::size_t>(task)];
    light.resize(static_cast<std::size_t>(strip.pixels()));
    Random random(11, static_cast<std::uint64_t>(task), 0);
    for (int i = 0; i < rays / tasks; ++i) {
      const double s = random.uniform_double();
      const Vec3 beam = -direction_at(to_sun, edge * s, 2 * pi * random.uniform_double());
      const phase::Orientation lies = orientations.draw(random);
      const Vec3 incoming = lies.to_crystal(beam);
      const double meets = -dot(incoming, in);
      if (meets <= 0) continue;
      const Vec3 inside = *refracted_or_none(incoming, in, 1 / n);
      if (dot(inside, out) <= 0) continue;
      const auto leaves = refracted_or_none(inside, -out, n);
      if (!leaves) continue;
      const double weight = meets * passing(meets, -dot(inside, in), n) * passing(dot(*leaves, out), dot(inside, out), n) *
                            disc.relative_radiance(std::sqrt(s), nm);
      const Vec3 seen = -lies.to_world(*leaves);
      // The mirrored crystal too: its light is on the other side of the sun.
      for (const double side : {1.0, -1.0}) {
        const auto [along, across] = strip.place({side * seen.x, seen.y, seen.z});
        const double pixel = std::floor((along - strip.from) / strip.step);
        if (pixel < 0 || pixel >= strip.pixels() || std::fabs(across) > strip.half_width) continue;
        light[static_cast<std::size_t>(pixel)] += weight;
      }
    }
  });
  std::vector<double> sum(static_cast<std::size_t>(strip.pixels()));
  for (const auto& part : parts)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
  return sum;
}

struct Edge {
  double at = 0;
  double low = 0, high = 0;  ///< mean brightness on its two sides
};

/// Where a curve rises most: the difference of its means over `reach` degrees on both sides is greatest there, between two places. A
/// disc does not shift the step that random crystals make, and shifts the peak of plates and columns outwards by less than its radius.
inline Edge steepest_rise(const Strip& strip, const std::vector<double>& light, double from, double to, double reach = 0.28) {
  const int width = static_cast<int>(std::lround(reach / strip.step));
  const auto mean = [&](int first) {
    double sum = 0;
    for (int i = first; i < first + width; ++i) sum += light[static_cast<std::size_t>(i)];
    return sum / width;
  };
  const auto rise = [&](int pixel) { return mean(pixel) - mean(pixel - width); };
  int best = 0;
  for (int i = width + 1; i + width < strip.pixels(); ++i) {
    const double at = strip.from + i * strip.step;
    if (at < from || at > to) continue;
    if (best == 0 || rise(i) > rise(best)) best = i;
  }
  if (best == 0) return {};
  // The parabola through three.
  const double a = rise(best - 1), b = rise(best), c = rise(best + 1), bend = a - 2 * b + c;
  const double shift = bend < 0 ? std::clamp(0.5 * (a - c) / bend, -1.0, 1.0) : 0;
  return {strip.from + (best + shift) * strip.step, mean(best - width), mean(best)};
}

/// The brightest pixel, and the centre of light around it, over what lies `reach` beside it on both sides.
inline double centre(const Strip& strip, const std::vector<double>& light, double reach) {
  const auto top = static_cast<int>(std::max_element(light.begin(), light.end()) - light.begin());
  const int width = static_cast<int>(std::lround(reach / strip.step)), first = std::max(0, top - width), last = std::min(strip.pixels() - 1, top + width);
  const double ground = 0.5 * (light[static_cast<std::size_t>(first)] + light[static_cast<std::size_t>(last)]);
  double sum = 0, moment = 0;
  for (int i = first; i <= last; ++i) {
    const double value = light[static_cast<std::size_t>(i)] - ground;
    sum += value;
    moment += value * strip.middle(i);
  }
  return moment / sum;
}

}  // namespace arcus::render
