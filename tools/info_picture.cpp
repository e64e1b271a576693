#include "tools/info_picture.h"

#include <algorithm>
#include <cmath>

#include "src/film/image_file.h"
#include "src/film/tone.h"

namespace arcus::tools {
namespace {

constexpr int gap_px = 12;
constexpr double middle_depth = 8;  // shown as half of white
constexpr double widest_px = 1600, highest_px = 1000;

struct Panel {
  const media::Projection* projection;
  double width_m, height_m;
};

}  // namespace

void write_projections(const std::string& path, const std::array<media::Projection, 3>& projections, const Vec3& voxel_m) {
  const Panel panels[3] = {
      {&projections[1], projections[1].width * voxel_m.x, projections[1].height * voxel_m.z},
      {&projections[0], projections[0].width * voxel_m.y, projections[0].height * voxel_m.z},
      {&projections[2], projections[2].width * voxel_m.x, projections[2].height * voxel_m.y},
  };
  double width_m = 0, height_m = 0;
  for (const Panel& panel : panels) {
    width_m += panel.width_m;
    height_m = std::max(height_m, panel.height_m);
  }
  const double px_per_m = std::min(widest_px / width_m, highest_px / height_m);
  const auto pixels = [&](double metres) { return std::max(1, static_cast<int>(std::lround(metres * px_per_m))); };
  render::DisplayPicture picture;
  picture.height_px = pixels(height_m) + 2 * gap_px;
  picture.width_px = gap_px;
  for (const Panel& panel : panels) picture.width_px += pixels(panel.width_m) + gap_px;
  picture.rgb.assign(static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px) * 3, 60);
  int left = gap_px;
  for (const Panel& panel : panels) {
    const int width = pixels(panel.width_m), height = pixels(panel.height_m), top = picture.height_px - gap_px - height;
    for (int y = 0; y < height && !panel.projection->depth.empty(); ++y)
      for (int x = 0; x < width; ++x) {
        const auto column = static_cast<std::size_t>((x + 0.5) / width * panel.projection->width);
        const auto row = static_cast<std::size_t>((y + 0.5) / height * panel.projection->height);
        const double depth = panel.projection->depth[row * static_cast<std::size_t>(panel.projection->width) + column];
        const auto grey = static_cast<std::uint8_t>(std::lround(255 * render::srgb_encoded(depth / (depth + middle_depth))));
        std::uint8_t* to = &picture.rgb[(static_cast<std::size_t>(top + y) * static_cast<std::size_t>(picture.width_px) + static_cast<std::size_t>(left + x)) * 3];
        to[0] = to[1] = to[2] = grey;
      }
    left += width + gap_px;
  }
  render::write_png(path, picture);
}

}  // namespace arcus::tools
