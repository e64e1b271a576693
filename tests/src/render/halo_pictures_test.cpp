// Halos in rendered light stand where geometry puts them. Slow: makes maps of the sky.
//
// An edge is where light rises most over a quarter of a degree (steepest_rise); the sun's disc moves that of a caustic a little, so
// what is expected is the same measure of light that Snell's law sends through two faces from the same disc (wedge_light). Where a
// closed form is the same thing, that is asked as well.

#include <gtest/gtest.h>

#include <iomanip>
#include <iostream>

#include "src/render/picture.h"
#include "tests/src/render/wedge_light.h"

namespace arcus::render {
namespace {

constexpr double close_deg = 0.15;

void tell(const std::string& what, double nm, double found, double expected) {
  std::cout << std::fixed << std::setprecision(2) << what << ", " << std::setprecision(0) << nm << " nm: found " << std::setprecision(2) << found
            << " expected " << expected << '\n';
}

const phase::OrientationSettings random_lie{.type = "random"}, plate_lie{.type = "plate", .tilt_deg = 0}, column_lie{.type = "column", .tilt_deg = 0};

/// Where no edge is looked for: a map of a quarter of the work.
phase::Recipe coarse_plates() {
  phase::Recipe recipe = ice_recipe(0.5, plate_lie, 1);
  recipe.map_step_deg = 0.2;
  return recipe;
}

}  // namespace

TEST(HaloPictures, The22And46DegreeHalosBeginAtTheirRadii) {
  const SunSettings sun = ice_sun(25);
  phase::Recipe recipe = ice_recipe(1, random_lie, 8);
  recipe.optics = "wave";
  const ThinIce ice{sun, {ice_species(recipe, sun)}};
  const Vec3 to_sun = direction_of(0, 25);
  const struct {
    double wedge_deg, from, to;
    int face_out;
  } halos[] = {{60, 19, 24, 5}, {90, 43, 49, 1}};
  for (const auto& halo : halos) {
    const Strip strip = radial_strip(to_sun, halo.from, halo.to);
    const Brightness light = rendered(ice, strip, 64);
    for (int c = 0; c < colours; ++c) {
      const double n = ice_index(colour_nm[c]), least = least_deviation_deg(n, halo.wedge_deg);
      const auto search = [&](const std::vector<double>& curve) { return steepest_rise(strip, curve, halo.from + 0.5, halo.to - 0.5); };
      const double disc = search(wedge_light(strip, colour_nm[c], 3, halo.face_out, random_lie, sun, 1e6)).at;
      const Edge found = search(light[c]);
      tell("halo", colour_nm[c], found.at, disc);
      EXPECT_NEAR(found.at, least, close_deg);
      EXPECT_NEAR(found.at, disc, close_deg);
      EXPECT_GT(found.high, 1.2 * found.low);
      // An index that is 0.01 wrong is found out.
      EXPECT_GT(std::fabs(found.at - least_deviation_deg(n - 0.01, halo.wedge_deg)), 3 * close_deg);
      if (halo.wedge_deg == 60 && c == 1) {
        EXPECT_NEAR(found.at, 21.89, close_deg);
      }
    }
  }
}

TEST(HaloPictures, ParheliaStandBesideTheSun) {
  for (const double elevation : {0.0, 20.0, 40.0}) {
    const SunSettings sun = ice_sun(elevation);
    const ThinIce ice{sun, {ice_species(ice_recipe(0.5, plate_lie), sun)}};
    const double nearest = least_turn_deg(ice_index(650), 60, elevation);
    const Strip strip = level_strip(elevation, nearest - 3, nearest + 5, 0.8);
    const Brightness light = rendered(ice, strip, 256);
    for (int c = 0; c < colours; ++c) {
      const auto search = [&](const std::vector<double>& curve) { return steepest_rise(strip, curve, nearest - 2.5, nearest + 4.5); };
      const Edge found = search(light[c]);
      const double disc = search(wedge_light(strip, colour_nm[c], 3, 5, plate_lie, sun, 1e6)).at;
      const double wrong = search(wedge_light(strip, colour_nm[c], 3, 5, plate_lie, sun, 1e6, -0.01)).at;
      tell("parhelion's azimuth, sun at " + std::to_string(static_cast<int>(elevation)), colour_nm[c], found.at, disc);
      EXPECT_NEAR(found.at, disc, close_deg);
      EXPECT_NEAR(found.at, least_turn_deg(ice_index(colour_nm[c]), 60, elevation), 0.3);
      EXPECT_GT(std::fabs(found.at - wrong), 3 * close_deg);
      EXPECT_GT(found.high, 2 * found.low);
    }
  }
}

// Light in through the top of level plates and out of a side, or in through a side and out of the bottom, leaves at one height.
TEST(HaloPictures, CircumzenithalAndCircumhorizontalArcsStandAtTheirHeights) {
  const struct {
    double sun_deg;
    bool is_zenithal;
  } arcs[] = {{5, true}, {15, true}, {25, true}, {65, false}};
  for (const auto& arc : arcs) {
    const SunSettings sun = ice_sun(arc.sun_deg);
    const ThinIce ice{sun, {ice_species(ice_recipe(0.5, plate_lie), sun)}};
    const auto height = [&](double n) {
      const double h = radians(arc.sun_deg);
      return degrees(arc.is_zenithal ? std::asin(std::sqrt(n * n - std::pow(std::cos(h), 2))) : std::acos(std::sqrt(n * n - std::pow(std::sin(h), 2))));
    };
    const double middle = height(ice_index(550));
    const Strip strip = upright_strip(0, middle - 3, middle + 3, 2);
    const Brightness light = rendered(ice, strip, 512);
    for (int c = 0; c < colours; ++c) {
      const double n = ice_index(colour_nm[c]), found = centre(strip, light[c], 0.7);
      const double disc = centre(strip, wedge_light(strip, colour_nm[c], arc.is_zenithal ? 1 : 3, arc.is_zenithal ? 3 : 2, plate_lie, sun, 2e6), 0.7);
      tell(std::string(arc.is_zenithal ? "circumzenithal" : "circumhorizontal") + " arc, sun at " + std::to_string(static_cast<int>(arc.sun_deg)), colour_nm[c], found, disc);
      EXPECT_NEAR(found, disc, close_deg);
      EXPECT_NEAR(found, height(n), close_deg);
      EXPECT_GT(std::fabs(found - height(n - 0.01)), 2 * close_deg);
    }
  }
}

// What is to be seen beyond the limits is dark to one part in ten thousand of the arc within them. Level plates send light of a sun at height h
// to heights h, -h and those of the two arcs alone.
TEST(HaloPictures, ArcsAboutTheZenithEndWhereLightIsReflectedTotally) {
  const double n = ice_index(550), limit = degrees(std::acos(std::sqrt(n * n - 1)));
  std::cout << "limits at 550 nm: " << limit << " and " << 90 - limit << ", with the index in vacuum "
            << degrees(std::acos(std::sqrt(std::pow(n * phase::air_index(550), 2) - 1))) << '\n';
  const auto brightness = [](double elevation, double from, double to) {
    const SunSettings sun = ice_sun(elevation);
    const ThinIce ice{sun, {ice_species(coarse_plates(), sun)}};
    const Strip strip = upright_strip(0, from, to, 30, 0.1);
    const Brightness light = rendered(ice, strip, 256);
    double sum = 0;
    for (const double value : light[1]) sum += value / strip.pixels();
    return sum;
  };
  // The disc reaches a quarter of a degree beyond its centre.
  const double zenithal = brightness(limit - 1, 70, 90), no_zenithal = brightness(limit + 0.5, 70, 90);
  const double horizontal = brightness(90 - limit + 1, 2, 40), no_horizontal = brightness(90 - limit - 0.5, 2, 40);
  std::cout << std::scientific << "circumzenithal " << zenithal << " beyond its limit " << no_zenithal << "; circumhorizontal " << horizontal << ", " << no_horizontal << '\n';
  EXPECT_GT(zenithal, 0);
  EXPECT_LT(no_zenithal, 1e-4 * zenithal);
  EXPECT_LT(no_horizontal, 1e-4 * horizontal);
}

TEST(HaloPictures, ParhelicCircleIsColourlessAtTheSunsHeight) {
  const double elevation = 25;
  const SunSettings sun = ice_sun(elevation);
  const ThinIce ice{sun, {ice_species(ice_recipe(0.5, plate_lie), sun)}};
  const auto sum = [](const std::vector<double>& curve) {
    double result = 0;
    for (const double value : curve) result += value;
    return result;
  };
  for (const double azimuth : {60.0, 90.0, 105.0, 135.0, 160.0}) {
    const Strip strip = upright_strip(azimuth, elevation - 3, elevation + 3, 2);
    const Brightness light = rendered(ice, strip, 512);
    for (int c = 0; c < colours; ++c) {
      const double found = centre(strip, light[c], 1);
      tell("parhelic circle's height at azimuth " + std::to_string(static_cast<int>(azimuth)), colour_nm[c], found, elevation);
      EXPECT_NEAR(found, elevation, close_deg);
    }
    // All of it lies within the disc: what the smoothing of the map sends further off than a cell is little.
    double aside = 0;
    for (int i = 0; i < strip.pixels(); ++i)
      if (std::fabs(strip.middle(i) - elevation) > sun.angular_radius_deg + 0.1) aside += light[1][static_cast<std::size_t>(i)];
    std::cout << std::setprecision(5) << "share beside the disc: " << aside / sum(light[1]) << '\n';
    EXPECT_LT(aside, 0.02 * sum(light[1]));
    std::cout << "blue and red over green: " << sum(light[0]) / sum(light[1]) << ' ' << sum(light[2]) / sum(light[1]) << '\n';
    EXPECT_NEAR(sum(light[0]) / sum(light[1]), 1, 0.1) << azimuth;
    EXPECT_NEAR(sum(light[2]) / sum(light[1]), 1, 0.1) << azimuth;
  }
  // The same measure calls a parhelion coloured.
  const double edge = least_turn_deg(ice_index(550), 60, elevation);
  const Brightness parhelion = rendered(ice, level_strip(elevation, edge - 0.6, edge, 1), 512);
  EXPECT_GT(sum(parhelion[2]), 1.3 * sum(parhelion[0]));

  const Strip along = level_strip(elevation, 117, 123, 1), up = upright_strip(120, elevation - 3, elevation + 3, 1);
  const Brightness light = rendered(ice, along, 512), upright = rendered(ice, up, 512);
  for (int c = 0; c < colours; ++c) {
    const double found = centre(along, light[c], 0.7);
    tell("120 degree parhelion", colour_nm[c], found, 120);
    EXPECT_NEAR(found, 120, close_deg);
    EXPECT_NEAR(centre(up, upright[c], 0.7), elevation, close_deg);
    EXPECT_NEAR(sum(light[c]) / sum(light[1]), 1, 0.1);
  }
}

TEST(HaloPictures, SubsunLiesAsFarBelowTheHorizonAsTheSunStandsAbove) {
  for (const double elevation : {25.0, 50.0}) {
    const SunSettings sun = ice_sun(elevation);
    const ThinIce ice{sun, {ice_species(coarse_plates(), sun)}, 2e-4, 150};
    const Strip up = upright_strip(0, -elevation - 3, -elevation + 3, 1), along = level_strip(-elevation, -3, 3, 1);
    const Brightness upright = rendered(ice, up, 512), level = rendered(ice, along, 512);
    for (int c = 0; c < colours; ++c) {
      const double found = centre(up, upright[c], 0.7);
      tell("subsun", colour_nm[c], found, -elevation);
      EXPECT_NEAR(found, -elevation, close_deg);
      EXPECT_NEAR(centre(along, level[c], 0.7) * std::cos(radians(elevation)), 0, close_deg);
    }
  }
}

// Long level columns. Light that goes through them in the sun's vertical plane touches the 22 degree halo, above and below. Columns that
// point at the sun pass light aside of it only where n' < 2 for its height over their cross-section: a sun above 29.3 degrees.
TEST(HaloPictures, TangentArcsTouchTheHaloAndJoinAboutIt) {
  const double n550 = ice_index(550);
  std::cout << "arcs join at " << degrees(std::acos(std::sqrt((4 - n550 * n550) / 3))) << '\n';
  for (const double elevation : {26.0, 36.0}) {
    const SunSettings sun = ice_sun(elevation);
    const ThinIce ice{sun, {ice_species(ice_recipe(8, column_lie, 10), sun)}};
    const Vec3 to_sun = direction_of(0, elevation);
    for (const double side : {1.0, -1.0}) {
      // From the sun upwards or downwards.
      const Strip strip = turned_strip(Vec3(side, 0, 0), to_sun, 19, 26, 0.5);
      const Brightness light = rendered(ice, strip, 512);
      for (int c = 0; c < colours; ++c) {
        const auto search = [&](const std::vector<double>& curve) { return steepest_rise(strip, curve, 19.5, 25.5); };
        const Edge found = search(light[c]);
        const double disc = search(wedge_light(strip, colour_nm[c], 3, 5, column_lie, sun, 5e6)).at;
        tell(std::string(side > 0 ? "upper" : "lower") + " tangent arc, sun at " + std::to_string(static_cast<int>(elevation)), colour_nm[c], found.at, disc);
        EXPECT_NEAR(found.at, disc, close_deg);
        EXPECT_NEAR(found.at, least_deviation_deg(ice_index(colour_nm[c]), 60), 0.3);
        EXPECT_GT(found.high, 3 * found.low);
      }
    }
    // Around the axis of the columns that point at the sun: an angle of 60 degrees around it and more is where their light would be.
    const Strip aside = turned_strip(Vec3(0, -1, 0), to_sun, 25, 115, 0.5, 0.2);
    const Brightness light = rendered(ice, aside, 512);
    const auto search = [&](const std::vector<double>& curve) { return steepest_rise(aside, curve, 30, 110, 1); };
    for (int c = 0; c < colours; ++c) {
      const Edge found = search(light[c]);
      if (elevation > 30) {
        const auto across = [&](double turn) { return degrees(2 * std::asin(std::sin(radians(elevation)) * std::sin(radians(turn) / 2))); };
        const double disc = search(wedge_light(aside, colour_nm[c], 3, 5, column_lie, sun, 5e6)).at;
        tell("circumscribed halo beside the sun at " + std::to_string(static_cast<int>(elevation)), colour_nm[c], across(found.at), across(disc));
        EXPECT_NEAR(across(found.at), across(disc), close_deg);
        EXPECT_NEAR(across(found.at), least_deviation_deg(ice_index(colour_nm[c]), 60, 90 - elevation), 0.4);
      }
      std::cout << std::setprecision(6) << "aside: " << found.low << " to " << found.high << " at " << found.at << '\n';
      if (elevation > 30) {
        EXPECT_GT(found.high, 2 * found.low);
      } else {
        EXPECT_LT(found.high, 1.5 * found.low);
      }
    }
  }
}

TEST(HaloPictures, PyramidsMakeTheirSixHalos) {
  const SunSettings sun = ice_sun(30);
  const Strip strip = radial_strip(direction_of(0, 30), 7, 38);
  // The 23 degree halo needs large ends, the others large pyramids.
  const auto seen = [&](double aspect_ratio, double height) {
    phase::Recipe recipe = ice_recipe(aspect_ratio, random_lie, 20);
    recipe.crystal.habit.upper.height = recipe.crystal.habit.lower.height = height;
    recipe.wavelength_nm = {550};
    return rendered({sun, {ice_species(recipe, sun)}}, strip, 128)[1];
  };
  const std::vector<double> pyramids = seen(0.4, 0.6), cut_off = seen(0.05, 0.2);
  const struct {
    double wedge_deg;
    const char* name;
    const std::vector<double>& light;
  } halos[] = {{28.0, "9", pyramids}, {52.4, "18", pyramids}, {56.0, "20", pyramids}, {62.0, "23", cut_off}, {63.8, "24", pyramids}, {80.2, "35", pyramids}};
  for (const auto& halo : halos) {
    const double least = least_deviation_deg(ice_index(550), halo.wedge_deg);
    const Edge found = steepest_rise(strip, halo.light, least - 0.45, least + 0.45);
    tell(std::string(halo.name) + " degree halo", 550, found.at, least);
    std::cout << std::setprecision(4) << "  " << found.low << " to " << found.high << '\n';
    EXPECT_NEAR(found.at, least, close_deg);
    EXPECT_GT(found.high, 1.1 * found.low);
  }
}

// The same through camera and film: a fisheye's picture of plates and random prisms, cut out above and beside the sun.
TEST(HaloPictures, PicturesHaveThemInTheirPixels) {
  SceneSettings settings;
  settings.sun = ice_sun(20);
  settings.camera = {.type = "fisheye", .azimuth_deg = 0, .elevation_deg = 20, .fov_deg = 70, .width_px = 1400, .height_px = 1400};
  settings.film.channels = {"spectral"};
  settings.render.samples_per_pixel = 400;
  settings.render.max_bounces = 1;
  // Both ends of the film's bins around 450, 550 and 650 nm.
  phase::Recipe plates = ice_recipe(0.5, plate_lie, 3), prisms = ice_recipe(1, random_lie);
  plates.wavelength_nm = prisms.wavelength_nm = {440, 460, 540, 560, 640, 660};
  const ThinIce ice{settings.sun, {ice_species(plates, settings.sun), ice_species(prisms, settings.sun)}};
  Scene scene = ice.scene();
  scene.camera = make_camera(settings.camera);
  const Vec3 to_sun = scene.sun.to_centre();
  const double n550 = ice_index(550), parhelion = least_turn_deg(n550, 60, 20);

  // From the pixels to strips, by where the camera looks.
  const auto cut_out = [&](const Strip& strip, const PixelBox& box) {
    const Image image = render_picture(settings, scene, box, {}).image;
    Brightness light;
    for (int c = 0; c < colours; ++c) {
      const auto channel = image.channel("S0." + std::to_string(static_cast<int>(colour_nm[c])) + ".0nm");
      std::vector<double> sum(static_cast<std::size_t>(strip.pixels())), count(sum.size());
      for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
          const auto [along, across] = strip.place(scene.camera->ray(x + 0.5, y + 0.5)->direction);
          const double bin = std::floor((along - strip.from) / strip.step);
          if (bin < 0 || bin >= strip.pixels() || std::fabs(across) > strip.half_width) continue;
          sum[static_cast<std::size_t>(bin)] += image.value(x, y, channel.value());
          ++count[static_cast<std::size_t>(bin)];
        }
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= std::max(1.0, count[i]);
      light[c] = sum;
    }
    return light;
  };
  const auto pixel_of = [&](const Vec3& direction) { return scene.camera->image_point(direction * 100).value(); };
  const ImagePoint centre_px = pixel_of(to_sun), beside = pixel_of(direction_of(parhelion, 20));
  EXPECT_NEAR(centre_px.x, 700, 1e-6);
  const int middle = static_cast<int>(centre_px.x), right = static_cast<int>(beside.x), level = static_cast<int>(beside.y);

  const Strip halo = radial_strip(to_sun, 20, 25, 0.07), level_one = level_strip(20, parhelion - 2, parhelion + 2, 0.8, 0.07);
  const Brightness above = cut_out(halo, {middle - 20, middle - 500, middle + 20, middle - 400});
  const Brightness aside = cut_out(level_one, {right - 40, level - 20, right + 40, level + 20});
  for (int c = 0; c < colours; ++c) {
    const double n = ice_index(colour_nm[c]);
    const double ring = steepest_rise(halo, above[c], 20.4, 24.4).at;
    const double dog = steepest_rise(level_one, aside[c], parhelion - 1.5, parhelion + 1.5).at;
    const double disc = steepest_rise(level_one, wedge_light(level_one, colour_nm[c], 3, 5, plate_lie, settings.sun, 1e6), parhelion - 1.5, parhelion + 1.5).at;
    tell("22 degree halo in a picture", colour_nm[c], ring, least_deviation_deg(n, 60));
    tell("parhelion's azimuth in a picture", colour_nm[c], dog, disc);
    EXPECT_NEAR(ring, least_deviation_deg(n, 60), close_deg);
    EXPECT_NEAR(dog, disc, close_deg);
  }
}

}  // namespace arcus::render
