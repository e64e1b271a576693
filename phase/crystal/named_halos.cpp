#include "phase/crystal/named_halos.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

double arcsine_deg(double x) { return degrees(std::asin(std::clamp(x, -1.0, 1.0))); }
double arccosine_deg(double x) { return degrees(std::acos(std::clamp(x, -1.0, 1.0))); }

/// Least deviation by two faces with that angle between them; none where light cannot pass.
std::optional<double> least_deviation_deg(double wedge_deg, double n) {
  const double sine = n * std::sin(radians(wedge_deg) / 2);
  if (sine >= 1) return std::nullopt;
  return 2 * degrees(std::asin(sine)) - wedge_deg;
}

class Finder {
 public:
  Finder(const CrystalSettings& crystals, double n, double sun_deg)
      : shape_(make_crystal(crystals.habit, 1)), lies_(crystals.orientation), n_(n), h_(sun_deg), sine_(std::sin(radians(sun_deg))),
        cosine_(std::cos(radians(sun_deg))) {}

  std::vector<NamedHalo> find() {
    if (lies_.type == "random") {
      add_circles();
    } else if (lies_.type == "plate") {
      add_vertical_prism();
      add_pillar();
    } else if (lies_.type == "column") {
      add_tangent_arcs();
      add_lateral_arcs();
      if (has(1) || has(2)) add_parhelic_circle();
      add_pillar();
    } else if (lies_.type == "parry") {
      add_parry_arcs();
      if (has(1) || has(2)) add_parhelic_circle();
      if (has(1) || has(2)) add_level_and_upright();
      add("subsun", {{0, -h_}});
    } else if (lies_.type == "lowitz") {
      add_lowitz_arcs();
    }
    return std::move(halos_);
  }

 private:
  bool has(int number) const {
    return std::ranges::any_of(shape_.faces(), [&](const CrystalFace& face) { return face.number == number; });
  }
  bool has_prism_wedge() const {
    for (int face = 3; face <= 8; ++face)
      if (has(face) && has(3 + (face - 3 + 2) % 6)) return true;
    return false;
  }

  void add(std::string name, std::vector<HaloPlace> places) {
    std::erase_if(places, [](const HaloPlace& p) { return !std::isfinite(p.azimuth_deg) || std::fabs(p.elevation_deg) > 90; });
    if (!places.empty()) halos_.push_back({std::move(name), std::move(places)});
  }
  /// On the sun's vertical; beyond the zenith or the nadir on the other side.
  static HaloPlace upright(double elevation_deg) {
    if (elevation_deg > 90) return {180, 180 - elevation_deg};
    if (elevation_deg < -90) return {180, -180 - elevation_deg};
    return {0, elevation_deg};
  }
  /// Left and right of the sun, at a distance from it; none where nothing that high is so far away.
  std::vector<HaloPlace> beside(double elevation_deg, double distance_deg) const {
    const double sine = std::sin(radians(elevation_deg)), cosine = std::cos(radians(elevation_deg));
    const double c = (std::cos(radians(distance_deg)) - sine * sine_) / (cosine * cosine_);
    if (!(std::fabs(c) <= 1)) return {};
    const double azimuth = degrees(std::acos(c));
    return {{azimuth, elevation_deg}, {-azimuth, elevation_deg}};
  }

  /// A point of the circle around the sun, by the angle from its top.
  HaloPlace on_circle(double radius_deg, double position_deg) const {
    const double r = radians(radius_deg), p = radians(position_deg);
    const double along = std::cos(r), up = std::sin(r) * std::cos(p), aside = std::sin(r) * std::sin(p);
    return {degrees(std::atan2(aside, along * cosine_ - up * sine_)), arcsine_deg(along * sine_ + up * cosine_)};
  }
  void add_circles() {
    std::set<long> names;  // radii of pairs of faces are often the same
    const auto& faces = shape_.faces();
    for (const CrystalFace& a : faces)
      for (const CrystalFace& b : faces) {
        const double wedge = 180 - arccosine_deg(dot(a.normal, b.normal));
        if (wedge < 1 || wedge > 179) continue;
        const auto radius = least_deviation_deg(wedge, n_);
        if (!radius || !names.insert(std::lround(*radius)).second) continue;
        // Each on another side, so that names of circles close together find room.
        const double turn = 25 * static_cast<double>(names.size());
        std::vector<HaloPlace> places;
        for (const double position : {60.0, -60.0, 0.0, 90.0, -90.0, 120.0, -120.0, 180.0})
          places.push_back(on_circle(*radius, position + turn));
        add(std::to_string(std::lround(*radius)) + "° halo", places);
      }
  }

  void add_parhelic_circle() { add("parhelic circle", {{70, h_}, {-70, h_}, {95, h_}, {-95, h_}, {145, h_}}); }

  /// Light between a level face and an upright one. Between them the upright part of a direction times the index stays.
  void add_level_and_upright() {
    const double above = n_ * n_ - cosine_ * cosine_, below = n_ * n_ - sine_ * sine_;
    if (h_ >= 0 && above <= 1) add("circumzenithal arc", {{0, arcsine_deg(std::sqrt(above))}});
    if (h_ >= 0 && below <= 1) add("circumhorizontal arc", {{0, arccosine_deg(std::sqrt(below))}});
  }

  void add_vertical_prism() {
    const double level = std::sqrt(n_ * n_ - sine_ * sine_) / cosine_;  // index of the projection onto the horizon
    if (has_prism_wedge()) {
      if (level <= 2) {
        const double azimuth = 2 * arcsine_deg(level / 2) - 60;
        add("parhelion", {{azimuth, h_}, {-azimuth, h_}});
        if (h_ > 0 && has(1) && has(2)) add("subparhelion", {{azimuth, -h_}, {-azimuth, -h_}});
      }
      if (has(1) && has(2) && has_neighbours()) add("120° parhelion", {{120, h_}, {-120, h_}});
    }
    add_parhelic_circle();
    if (has(1) || has(2)) add_level_and_upright();
    if (has(1) || has(2)) add("subsun", {{0, -h_}});
  }
  bool has_neighbours() const {
    for (int face = 3; face <= 8; ++face)
      if (has(face) && has(3 + (face - 3 + 1) % 6)) return true;
    return false;
  }

  /// Light that faces tilted up to two and a half standard deviations throw above the subsun, and past the horizon if the sun is low.
  void add_pillar() {
    if (!(has(1) || has(2)) || lies_.type != "plate") return;
    const double tilt = (lies_.spread == "gaussian" ? 2.5 : 1) * lies_.tilt_deg;
    // In the middle of what is lit: from the sun to 2 tilt - h, or from the horizon to there.
    if (tilt > h_) add("sun pillar", {{0, tilt}});
    else if (2 * tilt > h_) add("lower sun pillar", {{0, tilt - 0.5 * h_}});
  }

  void add_tangent_arcs() {
    const auto radius = least_deviation_deg(60, n_);
    if (!has_prism_wedge() || !radius) return;
    // From here on light passes crystals that point to the sun as steeply as they can, and the two arcs are one.
    const bool is_one = cosine_ * cosine_ <= (4 - n_ * n_) / 3;
    if (is_one) {
      add("circumscribed halo", {upright(h_ + *radius), upright(h_ - *radius)});
      return;
    }
    add("upper tangent arc", {upright(h_ + *radius)});
    add("lower tangent arc", {upright(h_ - *radius)});
  }

  /// Where they touch the 46 degree halo: light passes symmetrically, and the axis is level.
  void add_lateral_arcs() {
    const auto radius = least_deviation_deg(90, n_);
    if (!radius || !(has(1) || has(2)) || h_ < 0) return;
    const double sine_in = n_ * std::sqrt(0.5), tangent_in = sine_in / std::sqrt(1 - sine_in * sine_in);
    const double above = n_ * n_ - cosine_ * cosine_;
    if (above <= 1) {
      std::vector<HaloPlace> places;
      if (tangent_in * sine_ < 1) places = beside(arcsine_deg(tangent_in * sine_), *radius);
      places.push_back({0, arcsine_deg(std::sqrt(above))});
      add("supralateral arc", places);
    }
    if (sine_ < sine_in) add("infralateral arc", beside(arcsine_deg(sine_ / tangent_in), *radius));
  }

  /// How high light is seen that enters by a face whose normal points that high in the sun's vertical plane (0 towards the sun, 90
  /// up) and leaves by another; none where it cannot.
  std::optional<double> in_the_vertical_deg(double in_deg, double out_deg) const {
    const auto refracted = [](double direction, double axis, double ratio) -> std::optional<double> {
      const double sine = ratio * std::sin(radians(direction - axis));
      if (std::fabs(sine) > 1 || std::cos(radians(direction - axis)) <= 0) return std::nullopt;
      return axis + arcsine_deg(sine);
    };
    const auto inside = refracted(h_ + 180, in_deg + 180, 1 / n_);
    if (!inside) return std::nullopt;
    const auto outside = refracted(*inside, out_deg, n_);
    if (!outside) return std::nullopt;
    return std::remainder(*outside + 180, 360.0);
  }
  void add_parry_arcs() {
    if (!has_prism_wedge()) return;
    struct Arc {
      const char* name;
      double in_deg, out_deg;
    };
    for (const Arc& arc : {Arc{"upper suncave Parry arc", 90, 210}, Arc{"upper sunvex Parry arc", 30, 150},
                           Arc{"lower Parry arc", -30, 210}, Arc{"lower Parry arc", 30, 270}})
      if (const auto elevation = in_the_vertical_deg(arc.in_deg, arc.out_deg)) add(arc.name, {{0, *elevation}});
  }

  /// Where they touch the 22 degree halo: the diagonal about which crystals spin is level, and light inside runs along one of the
  /// other two, which makes the heights of the light and of the sun go as cos +- sin of half the deviation, 60 degrees apart.
  void add_lowitz_arcs() {
    const auto radius = least_deviation_deg(60, n_);
    if (!has_prism_wedge() || !radius) return;
    const double c = std::sqrt(3.0) * std::cos(radians(*radius / 2)), s = std::sin(radians(*radius / 2));
    const double ratio = (c + s) / (c - s);
    if (ratio * std::fabs(sine_) < 1) add("upper Lowitz arc", beside(arcsine_deg(ratio * sine_), *radius));
    add("lower Lowitz arc", beside(arcsine_deg(sine_ / ratio), *radius));
  }

  CrystalShape shape_;
  OrientationSettings lies_;
  double n_, h_, sine_, cosine_;
  std::vector<NamedHalo> halos_;
};

}  // namespace

std::vector<NamedHalo> named_halos(const CrystalSettings& crystals, double n, double sun_elevation_deg) {
  return Finder(crystals, n, sun_elevation_deg).find();
}

}  // namespace arcus::phase
