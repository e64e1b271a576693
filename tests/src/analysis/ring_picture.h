#pragma once
// A picture whose profile is known: a ring of light around the antisolar point.

#include <cmath>

#include "phase/base/frame.h"
#include "phase/base/random.h"
#include "src/camera/camera.h"
#include "src/film/image.h"
#include "src/scene/picture_metadata.h"

namespace arcus::render {

struct RingPicture {
  CameraSettings camera;
  SunPlace sun{180, 20, 0.2666};
  double width_deg = 0.5;  ///< standard deviation of the ring across
  double noise = 0;        ///< standard deviation of a pixel; known in the variance channels
  bool has_variance = false;
  std::uint64_t seed = 1;

  static double radius_deg(std::size_t channel) {
    return 42.31 - 0.6 * static_cast<double>(channel);
  }
  double value_at(double angle_deg, std::size_t channel) const {
    return 0.2 + std::exp(-0.5 * std::pow((angle_deg - radius_deg(channel)) / width_deg, 2));
  }

  Image made() const {
    std::vector<std::string> names{"R", "G", "B"};
    if (has_variance) names.insert(names.end(), {"variance.R", "variance.G", "variance.B"});
    Image image(camera.width_px, camera.height_px, names);
    write_camera(image.metadata, camera);
    write_sun(image.metadata, sun);
    const auto eye = make_camera(camera);
    const Vec3 antisolar = -direction_of(sun.azimuth_deg, sun.elevation_deg);
    for (int y = 0; y < camera.height_px; ++y)
      for (int x = 0; x < camera.width_px; ++x) {
        add_mean_over_pixel(*eye, antisolar, x, y, image);
        for (std::size_t c = 0; c < 3; ++c) {
          image.value(x, y, c) += static_cast<float>(noise_at(x, y, c));
          if (has_variance) image.value(x, y, 3 + c) = static_cast<float>(noise * noise);
        }
      }
    return image;
  }

 private:
  void add_mean_over_pixel(const Camera& eye, const Vec3& antisolar, int x, int y,
                           Image& image) const {
    constexpr int n = 3;
    for (int k = 0; k < n * n; ++k) {
      const auto ray = eye.ray(x + (k % n + 0.5) / n, y + (k / n + 0.5) / n);
      if (!ray) continue;
      const double angle_deg = degrees(angle_between_rad(ray->direction, antisolar));
      for (std::size_t c = 0; c < 3; ++c)
        image.value(x, y, c) += static_cast<float>(value_at(angle_deg, c) / (n * n));
    }
  }
  double noise_at(int x, int y, std::size_t channel) const {
    if (noise == 0) return 0;
    Random random(seed, static_cast<std::uint64_t>(y * camera.width_px + x),
                  static_cast<std::uint32_t>(channel));
    // Box and Muller's transform of two uniform numbers.
    const double u = 1 - random.uniform_double(), v = random.uniform_double();
    return noise * std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * v);
  }
};

inline CameraSettings camera_towards_antisolar(const std::string& type, double fov_deg,
                                               int width_px, int height_px) {
  CameraSettings camera;
  camera.type = type;
  camera.elevation_deg = 5;
  camera.azimuth_deg = 12;
  camera.fov_deg = fov_deg;
  camera.width_px = width_px;
  camera.height_px = height_px;
  return camera;
}

}  // namespace arcus::render
