#pragma once
// What a picture's file says about its making: names of the metadata and how they are written and
// read. Enough to turn a pixel into a direction, and to make the same picture again.
//
//   arcus:version, arcus:scene (complete TOML), arcus:scene_hash                    texts
//   arcus:seed (text, so that 64 bits fit), arcus:samples_per_pixel, arcus:render_seconds
//   arcus:camera:type (text), :position_x_m, :position_y_m, :position_z_m, :azimuth_deg,
//   :elevation_deg, :fov_deg,
//       :width_m                                                                    the size is the
//       picture's own
//   arcus:sun:azimuth_deg, :elevation_deg, :angular_radius_deg

#include <cstdint>
#include <optional>
#include <string>

#include "src/camera/camera.h"
#include "src/film/image.h"

namespace arcus::render {

struct SunPlace {
  double azimuth_deg = 0, elevation_deg = 0, angular_radius_deg = 0;
};

struct MakingOf {
  std::string version, scene_text, scene_hash;
  std::uint64_t seed = 0;
  double samples_per_pixel = 0;
  double render_seconds = 0;
};

void write_camera(Metadata& metadata, const CameraSettings& camera);
void write_sun(Metadata& metadata, const SunPlace& sun);
void write_making_of(Metadata& metadata, const MakingOf& making);

/// The camera of a picture, with the size of the picture; nothing where the metadata are not
/// complete.
std::optional<CameraSettings> read_camera(const Image& image);
/// Nothing where the metadata are not complete.
std::optional<SunPlace> read_sun(const Metadata& metadata);
/// What is there of it; the rest is empty or 0.
MakingOf read_making_of(const Metadata& metadata);

}  // namespace arcus::render
