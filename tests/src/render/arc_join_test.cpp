// The upper and the lower tangent arc of level columns join beside the sun where Snell's law lets them. Slow: makes maps of the sky.
//
// Light that meets prism faces alone keeps its component along a column. So every direction of the sky shows light of those columns only that lie
// at one azimuth from the sun, the clock angle: at right angles to the chord from the sun to there. Column and sun make an angle whose cosine
// is cos(elevation) cos(clock); in the plane at right angles to the column its index is n' with n'^2 - 1 = (n^2 - 1) / (1 - that cosine
// squared), and a wedge of 60 degrees turns light by 2 asin(n'/2) - 60 degrees at least and passes none where n' > 2 (A. Bravais 1847).
// Both wings end at the clock angle where n' = 2; between them, beside the sun, there is a gap. It closes for a sun at
// the elevation of joining, sin^2 = (n^2 - 1) / 3. Near their ends the wings fade out (as the square of what n' is short of 2), below what
// else columns send there. But the turn of a wing's edge at any clock angle says what n' is there, and so where the ends are.

#include <gtest/gtest.h>

#include <iomanip>
#include <iostream>

#include "tests/src/render/wedge_light.h"

namespace arcus::render {
namespace {

constexpr double close_deg = 0.15;

void tell(const char* what, double sun_deg, double nm, double found, double expected) {
  std::cout << std::fixed << what << ", sun at " << std::setprecision(1) << sun_deg << ", " << std::setprecision(0) << nm << " nm: arcs join at " << std::setprecision(2)
            << found << " expected " << expected << '\n';
}

const phase::OrientationSettings level_columns{.type = "column", .tilt_deg = 0};

double join_deg(double n) { return degrees(std::asin(std::sqrt((n * n - 1) / 3))); }
/// Where the wings end under a sun at this elevation; 0: they have joined.
double gap_edge_deg(double join, double sun_deg) { return degrees(std::acos(std::min(1.0, std::cos(radians(join)) / std::cos(radians(sun_deg))))); }

/// The sky beside the sun by clock angle and turn about the columns that lie there. Clock angles below 0: the upper arc's wing.
class ClockSky {
 public:
  explicit ClockSky(double sun_deg) : sun_(direction_of(0, sun_deg)) {}

  Vec3 direction(double clock_deg, double turn_deg) const {
    const Vec3 axis = direction_of(clock_deg, 0), along = axis * dot(axis, sun_);
    return along + (sun_ - along) * std::cos(radians(turn_deg)) + cross(sun_, axis) * std::sin(radians(turn_deg));
  }
  struct Place {
    double clock_deg, turn_deg;
  };
  Place place(const Vec3& d) const {
    const Vec3 level = normalize(Vec3(sun_.y - d.y, d.x - sun_.x, 0)), axis = level.y < 0 ? -level : level;
    return {azimuth_deg_of(axis), degrees(std::atan2(dot(d, cross(sun_, axis)), dot(d, sun_ - axis * dot(axis, sun_))))};
  }
  /// 1 - cos^2 of the angle between the sun and columns of a clock angle.
  double slant(double clock_deg) const { return 1 - std::pow(dot(direction_of(clock_deg, 0), sun_), 2); }
  /// Turn of the edge of wings that join under a sun at `join`.
  double edge_turn_deg(double clock_deg, double join) const {
    const double squared = 1 + 3 * std::pow(std::sin(radians(join)), 2) / slant(clock_deg);
    return squared < 4 ? degrees(2 * std::asin(std::sqrt(squared) / 2)) - 60 : 120;
  }
  /// The elevation of joining, were the wing's edge here.
  double join_deg_at(const Place& place) const {
    const double squared = std::pow(2 * std::sin(radians(place.turn_deg + 60) / 2), 2);
    return degrees(std::asin(std::sqrt(std::clamp((squared - 1) / 3 * slant(place.clock_deg), 0.0, 1.0))));
  }
  /// By the elevation of joining, over a range of clock angles: an edge of a wing lies straight across.
  Strip strip(double clock_deg, double half_width, double from, double to) const {
    return {from, to, 0.04, half_width, [=, this](double along, double across) { return direction(clock_deg + across, edge_turn_deg(clock_deg + across, along)); },
            [=, this](const Vec3& d) {
              const Place at = place(d);
              return std::array{join_deg_at(at), at.turn_deg > 0 && at.turn_deg < 120 ? at.clock_deg - clock_deg : 1e9};
            }};
  }

 private:
  Vec3 sun_;
};

/// What falls on pixels, over their solid angles: those of the strip are not equal.
void divide_by_area(const Strip& strip, std::vector<double>& light) {
  for (int i = 0; i < strip.pixels(); ++i) {
    constexpr int parts = 8;
    double area = 0;
    for (int j = 0; j < parts; ++j) {
      const double across = ((j + 0.5) / parts * 2 - 1) * strip.half_width, along = strip.middle(i), d = 1e-3;
      area += length(cross(strip.direction(along + d, across) - strip.direction(along - d, across), strip.direction(along, across + d) - strip.direction(along, across - d)));
    }
    light[static_cast<std::size_t>(i)] /= area;
  }
}

bool passes_wedge(double n, double sun_deg, double clock_deg) {
  const Vec3 beam = -direction_of(0, sun_deg), axis = direction_of(clock_deg, 0), up(0, 0, 1), side = cross(up, axis);
  for (double roll = 0; roll < 360; roll += 0.01) {
    const auto normal = [&](double deg) { return side * std::cos(radians(deg)) + up * std::sin(radians(deg)); };
    const Vec3 in = normal(roll), out = normal(roll + 120);
    if (dot(beam, in) >= 0) continue;
    const auto inside = refracted_or_none(beam, in, 1 / n);
    if (dot(*inside, out) > 0 && refracted_or_none(*inside, -out, n)) return true;
  }
  return false;
}

}  // namespace

// The closed form against light sent through wedges one by one.
TEST(ArcJoin, WingsEndWhereSnellsLawPassesNoLight) {
  for (const double nm : colour_nm) {
    const double n = ice_index(nm), join = join_deg(n);
    for (const double sun : {27.0, 28.0, 28.5}) {
      const double edge = gap_edge_deg(join, sun);
      std::cout << std::fixed << std::setprecision(2) << nm << " nm: arcs join at " << join << "; sun at " << sun << ": wings end at clock angles of " << edge << '\n';
      EXPECT_FALSE(passes_wedge(n, sun, edge - 0.05)) << nm << ' ' << sun;
      EXPECT_TRUE(passes_wedge(n, sun, edge + 0.05)) << nm << ' ' << sun;
    }
    EXPECT_FALSE(passes_wedge(n, join - 0.01, 0));
    EXPECT_TRUE(passes_wedge(n, join + 0.01, 0));
    EXPECT_TRUE(passes_wedge(n, 30, 0));
  }
}

TEST(ArcJoin, RenderedWingsEndAndJoinWhereSnellsLawHasIt) {
  const struct {
    double sun_deg;
    std::vector<double> clock_deg;
  } skies[] = {{28, {-16, 16}}, {31.2, {0}}};
  for (const auto& [elevation, clocks] : skies) {
    const SunSettings sun = ice_sun(elevation);
    const ClockSky sky(elevation);
    // Long columns, so that little enters or leaves through their ends; windows of the map's smoothing as small as they can be.
    phase::Recipe recipe = ice_recipe(30, level_columns, 5);
    recipe.map_noise = 1;
    const ThinIce ice{sun, {ice_species(recipe, sun)}};
    std::array<double, colours> wings_rise{};
    for (const double clock : clocks) {
      const Strip strip = sky.strip(clock, clock == 0 ? 3 : 2, 26.5, 30.7);
      const Brightness light = rendered(ice, strip, 1024);
      for (int c = 0; c < colours; ++c) {
        const double n = ice_index(colour_nm[c]), join = join_deg(n);
        const auto search = [&](const std::vector<double>& curve) { return steepest_rise(strip, curve, 27.1, 30.1, 0.4); };
        const auto expected = [&](double added) {
          std::vector<double> curve = wedge_light(strip, colour_nm[c], 3, 5, level_columns, sun, 1e7, added);
          divide_by_area(strip, curve);
          return search(curve).at;
        };
        // The outermost of the disc makes the edge: it lies nearer to the sun than that of its centre.
        const Edge found = search(light[c]);
        const double disc = expected(0), wrong = expected(-0.01), corrected = found.at + join - disc;
        tell(clock == 0 ? "joined beside the sun" : clock < 0 ? "upper wing" : "lower wing", elevation, colour_nm[c], found.at, disc);
        std::cout << "  turned by " << sky.edge_turn_deg(clock, join) << ", " << found.high / found.low << " times as bright; without the disc's width they join at " << corrected
                  << " (Snell's law: " << join << "), and for suns at 27, 28, 28.5 end at clock angles of";
        for (const double low_sun : {27.0, 28.0, 28.5}) std::cout << ' ' << gap_edge_deg(corrected, low_sun);
        std::cout << '\n';
        EXPECT_NEAR(found.at, disc, close_deg);
        EXPECT_NEAR(found.at, join, 0.3);
        EXPECT_GT(std::fabs(found.at - wrong), 3 * close_deg);
        EXPECT_GT(found.high, 1.5 * found.low);
        wings_rise[static_cast<std::size_t>(c)] = found.high - found.low;
      }
    }
    if (elevation > 29) continue;
    // Beside the sun, in the gap, nothing rises where the wings' edge would be, had they joined under a lower sun.
    const Strip gap = sky.strip(0, 4, 24, 28);
    const Brightness in_gap = rendered(ice, gap, 512);
    for (int c = 0; c < colours; ++c) {
      const Edge none = steepest_rise(gap, in_gap[c], 24.5, 27.5, 0.4);
      const double share = (none.high - none.low) / wings_rise[static_cast<std::size_t>(c)];
      std::cout << colour_nm[c] << " nm: greatest rise in the gap over that at the wing's edge: " << share << '\n';
      EXPECT_LT(share, 0.15);
    }
  }
}

}  // namespace arcus::render
