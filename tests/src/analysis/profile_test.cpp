#include "src/analysis/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "src/analysis/profile_chart.h"
#include "tests/src/analysis/ring_picture.h"

namespace arcus::render {
namespace {

std::string message_of(const Image& image, const ProfileSettings& settings) {
  try {
    measure_profile(image, settings, "picture.exr");
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST(Profile, FindsTheRadiusOfARingInEveryKindOfPicture) {
  for (const auto& camera : {camera_towards_antisolar("perspective", 100, 300, 240),
                             camera_towards_antisolar("fisheye", 180, 320, 320),
                             camera_towards_antisolar("equirectangular", 360, 640, 320)}) {
    const RingPicture ring{camera};
    const Profile profile = measure_profile(ring.made(), {}, "ring");
    for (std::size_t c = 0; c < 3; ++c) {
      const auto peaks = peaks_of(profile, profile.channels[c]);
      ASSERT_EQ(peaks.size(), 1u) << camera.type;
      EXPECT_NEAR(peaks[0].position, RingPicture::radius_deg(c), 0.02)
          << camera.type << " bins " << profile.bin_deg;
      EXPECT_NEAR(peaks[0].prominence, 1, 0.16)
          << camera.type;  // pixels of 0.56 degrees blur a ring of 0.5
    }
    EXPECT_EQ(profile.scattering, Profile::Scattering::supplement);
  }
}

TEST(Profile, SectorsOfARingAgreeAndShareThePixels) {
  const RingPicture ring{camera_towards_antisolar("perspective", 100, 300, 240)};
  const Image image = ring.made();
  const Profile whole =
      measure_profile(image, {.bin_deg = 0.5, .from_deg = 30, .to_deg = 50}, "ring");
  const Profile left = measure_profile(
      image,
      {.bin_deg = 0.5, .from_deg = 30, .to_deg = 50, .sector_from_deg = 180, .sector_to_deg = 0},
      "ring");
  const Profile right = measure_profile(
      image,
      {.bin_deg = 0.5, .from_deg = 30, .to_deg = 50, .sector_from_deg = 0, .sector_to_deg = 180},
      "ring");
  ASSERT_EQ(left.angle_deg.size(), right.angle_deg.size());
  for (std::size_t i = 0; i < left.angle_deg.size(); ++i) {
    EXPECT_NEAR(left.channels[0].mean[i], right.channels[0].mean[i],
                0.02);  // pixels are not equally wide
    EXPECT_NEAR(left.solid_angle_sr[i] + right.solid_angle_sr[i], whole.solid_angle_sr[i], 1e-12);
  }
}

TEST(Profile, PositionAnglesCountFromUpToTheRight) {
  // A white pixel to the right of the centre lies in the sector around 90 degrees.
  CameraSettings camera = camera_towards_antisolar("perspective", 40, 101, 101);
  camera.azimuth_deg = 30;
  camera.elevation_deg = 10;
  Image image(101, 101, {"R"});
  write_camera(image.metadata, camera);
  image.value(80, 50, 0) = 1;
  const auto mean = [&](double from, double to) {
    const Profile p = measure_profile(
        image, {.around = "30,10", .bin_deg = 100, .sector_from_deg = from, .sector_to_deg = to},
        "p");
    return p.channels[0].mean[0];
  };
  EXPECT_GT(mean(60, 120), 0);
  EXPECT_EQ(mean(240, 300), 0);
  EXPECT_EQ(mean(330, 30), 0);
  // About the zenith it is the compass azimuth: a fisheye that looks up has east to the right.
  camera = camera_towards_antisolar("fisheye", 180, 101, 101);
  camera.azimuth_deg = 0;
  camera.elevation_deg = 90;
  write_camera(image.metadata, camera);
  const auto about_zenith = [&](double from, double to) {
    return measure_profile(
               image,
               {.around = "zenith", .bin_deg = 100, .sector_from_deg = from, .sector_to_deg = to},
               "p")
        .channels[0]
        .mean[0];
  };
  EXPECT_GT(about_zenith(80, 100), 0);
  EXPECT_EQ(about_zenith(260, 280), 0);
}

TEST(Profile, SolidAngleOfAllBinsIsThatOfThePicture) {
  const RingPicture panorama{camera_towards_antisolar("equirectangular", 360, 180, 90)};
  const Profile sphere = measure_profile(panorama.made(), {.around = "0,0"}, "p");
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < sphere.angle_deg.size(); ++i) {
    sum += sphere.solid_angle_sr[i];
    pixels += sphere.pixels[i];
  }
  EXPECT_NEAR(sum / (4 * pi), 1, 2e-4);
  EXPECT_NEAR(pixels, 180 * 90, 1e-6);
}

TEST(Profile, StandardErrorsFromVarianceChannelsExplainTheNoise) {
  RingPicture ring{camera_towards_antisolar("perspective", 90, 240, 200)};
  const Profile truth = measure_profile(ring.made(), {}, "p");
  ring.noise = 0.3;
  ring.has_variance = true;
  const Profile noisy = measure_profile(ring.made(), {}, "p");
  EXPECT_TRUE(noisy.channels[0].error_is_from_variance);
  EXPECT_EQ(noisy.channels.size(), 3u) << "variances are no channels of their own";
  double sum = 0, count = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < truth.angle_deg.size(); ++i) {
      sum += std::pow((noisy.channels[c].mean[i] - truth.channels[c].mean[i]) /
                          noisy.channels[c].standard_error[i],
                      2);
      ++count;
    }
  // Neighbouring bins share pixels, so fewer values are independent than bins; errors 10 % wrong
  // would show.
  EXPECT_GT(count, 400);
  EXPECT_NEAR(std::sqrt(sum / count), 1, 0.08);
}

TEST(Profile, StandardErrorsFromScatterAgreeWithThoseFromVariance) {
  RingPicture ring{camera_towards_antisolar("perspective", 90, 240, 200)};
  ring.noise = 0.3;
  ring.has_variance = true;
  const ProfileSettings flat{.bin_deg = 1, .from_deg = 48, .to_deg = 60};
  const Profile by_variance = measure_profile(ring.made(), flat, "p");
  ring.has_variance = false;
  const Profile by_scatter = measure_profile(ring.made(), flat, "p");
  EXPECT_FALSE(by_scatter.channels[0].error_is_from_variance);
  for (std::size_t i = 0; i < by_scatter.angle_deg.size(); ++i)
    EXPECT_NEAR(
        by_scatter.channels[0].standard_error[i] / by_variance.channels[0].standard_error[i], 1,
        0.15);
}

TEST(Profile, CropMeasuresTheSameAsTheWhole) {
  const RingPicture ring{camera_towards_antisolar("perspective", 100, 300, 240)};
  const Image whole = ring.made();
  Image crop(300, 240, {100, 20, 220, 140}, whole.channel_names());
  crop.metadata = whole.metadata;
  for (int y = 20; y < 140; ++y)
    for (int x = 100; x < 220; ++x)
      for (std::size_t c = 0; c < 3; ++c) crop.value(x, y, c) = whole.value(x, y, c);
  const Profile profile = measure_profile(crop, {.bin_deg = 0.5, .from_deg = 38}, "p");
  const auto peaks = peaks_of(profile, profile.channels[0]);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_NEAR(peaks[0].position, RingPicture::radius_deg(0), 0.02);
}

TEST(Profile, CsvHasAColumnForEachChannelAndReadsBack) {
  const RingPicture ring{camera_towards_antisolar("perspective", 60, 60, 40)};
  const Profile profile = measure_profile(ring.made(), {}, "p");
  const Columns table = read_columns(csv_of(profile, "ring.exr"), "csv");
  EXPECT_EQ(table.names,
            (std::vector<std::string>{"angle_deg", "scattering_angle_deg", "solid_angle_sr",
                                      "pixels", "R", "R_standard_error", "G", "G_standard_error",
                                      "B", "B_standard_error"}));
  ASSERT_EQ(table.columns[0].size(), profile.angle_deg.size());
  for (std::size_t i = 0; i < profile.angle_deg.size(); ++i) {
    EXPECT_NEAR(table.named("angle_deg")[i] + table.named("scattering_angle_deg")[i], 180, 1e-7);
    EXPECT_NEAR(table.named("G")[i], profile.channels[1].mean[i], 1e-6);
  }
}

TEST(Profile, WhatCannotBeMeasuredIsBadInput) {
  const RingPicture ring{camera_towards_antisolar("perspective", 60, 60, 40)};
  Image image = ring.made();
  EXPECT_TRUE(contains(message_of(image, {.around = "moon"}), "sun, antisolar, zenith"));
  EXPECT_TRUE(contains(message_of(image, {.around = "10,95"}), "--around"));
  EXPECT_TRUE(contains(message_of(image, {.around = "sun", .to_deg = 20}),
                       "no pixel between 0 and 20 degrees"));
  EXPECT_TRUE(contains(message_of(image, {.from_deg = 20, .to_deg = 10}), "ascending"));
  EXPECT_TRUE(contains(message_of(image, {.bin_deg = 1e-9}), "million"));
  Image bare(4, 4, {"R"});
  EXPECT_TRUE(contains(message_of(bare, {}), "no camera"));
  write_camera(bare.metadata, ring.camera);
  EXPECT_TRUE(contains(message_of(bare, {}), "no place of the sun"));
  EXPECT_EQ(message_of(bare, {.around = "0,0"}), "no error");
  CameraSettings flat = ring.camera;
  flat.type = "orthographic";
  write_camera(image.metadata, flat);
  EXPECT_TRUE(contains(message_of(image, {}), "orthographic"));
}

TEST(Profile, PixelsThatAreNotFiniteAreLeftOut) {
  const RingPicture ring{camera_towards_antisolar("perspective", 60, 60, 40)};
  Image image = ring.made();
  image.value(30, 20, 1) = std::nanf("");
  const Profile profile = measure_profile(image, {}, "p");
  for (const auto& channel : profile.channels)
    for (const double v : channel.mean) EXPECT_TRUE(std::isfinite(v));
}

}  // namespace arcus::render
