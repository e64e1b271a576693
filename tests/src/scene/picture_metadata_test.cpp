#include "src/scene/picture_metadata.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "src/film/image_file.h"

namespace arcus::render {

TEST(PictureMetadata, CameraSunAndMakingSurviveAFile) {
  Image image(64, 48, {10, 10, 20, 20}, {"R"});
  CameraSettings camera;
  camera.type = "fisheye";
  camera.position_m = {1.0 / 3, -1e6, 0.1};
  camera.azimuth_deg = 123.456789012345;
  camera.elevation_deg = -7;
  write_camera(image.metadata, camera);
  write_sun(image.metadata, {200.1, 4.2, 0.2666});
  write_making_of(image.metadata, {"0.1.0", "[camera]\n", "abc", ~std::uint64_t{0}, 64, 1.5});
  const auto path = std::filesystem::temp_directory_path() /
                    ("picture_metadata_" + std::to_string(::getpid()) + ".exr");
  write_exr(path.string(), image);
  const Image copy = read_exr(path.string());
  std::filesystem::remove(path);

  const auto read = read_camera(copy);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->type, "fisheye");
  EXPECT_EQ(read->position_m, camera.position_m);
  EXPECT_EQ(read->azimuth_deg, camera.azimuth_deg);
  EXPECT_EQ(read->elevation_deg, camera.elevation_deg);
  EXPECT_EQ(read->fov_deg, 180) << "the usual one of its type";
  EXPECT_EQ(read->width_px, 64) << "of the whole picture";
  EXPECT_EQ(read->height_px, 48);
  const auto sun = read_sun(copy.metadata);
  ASSERT_TRUE(sun);
  EXPECT_EQ(sun->azimuth_deg, 200.1);
  const MakingOf making = read_making_of(copy.metadata);
  EXPECT_EQ(making.scene_text, "[camera]\n");
  EXPECT_EQ(making.seed, ~std::uint64_t{0});
  EXPECT_EQ(making.render_seconds, 1.5);
}

TEST(PictureMetadata, PicturesFromElsewhereHaveNoCamera) {
  EXPECT_FALSE(read_camera(Image(2, 2, {"R"})));
  EXPECT_FALSE(read_sun(Metadata()));
  EXPECT_EQ(read_making_of(Metadata()).seed, 0u);
}

}  // namespace arcus::render
