#include "src/scene/picture_metadata.h"

#include <charconv>

namespace arcus::render {

void write_camera(Metadata& metadata, const CameraSettings& camera) {
  metadata.set("arcus:camera:type", camera.type);
  metadata.set("arcus:camera:position_x_m", camera.position_m.x);
  metadata.set("arcus:camera:position_y_m", camera.position_m.y);
  metadata.set("arcus:camera:position_z_m", camera.position_m.z);
  metadata.set("arcus:camera:azimuth_deg", camera.azimuth_deg);
  metadata.set("arcus:camera:elevation_deg", camera.elevation_deg);
  metadata.set("arcus:camera:fov_deg",
               camera.fov_deg == 0 ? usual_fov_deg(camera.type) : camera.fov_deg);
  metadata.set("arcus:camera:width_m", camera.width_m);
}

void write_sun(Metadata& metadata, const SunPlace& sun) {
  metadata.set("arcus:sun:azimuth_deg", sun.azimuth_deg);
  metadata.set("arcus:sun:elevation_deg", sun.elevation_deg);
  metadata.set("arcus:sun:angular_radius_deg", sun.angular_radius_deg);
}

void write_making_of(Metadata& metadata, const MakingOf& making) {
  metadata.set("arcus:version", making.version);
  metadata.set("arcus:scene", making.scene_text);
  metadata.set("arcus:scene_hash", making.scene_hash);
  metadata.set("arcus:seed", std::to_string(making.seed));
  metadata.set("arcus:samples_per_pixel", making.samples_per_pixel);
  metadata.set("arcus:render_seconds", making.render_seconds);
}

std::optional<CameraSettings> read_camera(const Image& image) {
  const Metadata& metadata = image.metadata;
  const auto type = metadata.text("arcus:camera:type");
  const auto x = metadata.number("arcus:camera:position_x_m"),
             y = metadata.number("arcus:camera:position_y_m"),
             z = metadata.number("arcus:camera:position_z_m");
  const auto azimuth = metadata.number("arcus:camera:azimuth_deg"),
             elevation = metadata.number("arcus:camera:elevation_deg"),
             fov = metadata.number("arcus:camera:fov_deg"),
             width = metadata.number("arcus:camera:width_m");
  if (!type || !x || !y || !z || !azimuth || !elevation || !fov || !width) return std::nullopt;
  CameraSettings camera;
  camera.type = *type;
  camera.position_m = Vec3(*x, *y, *z);
  camera.azimuth_deg = *azimuth;
  camera.elevation_deg = *elevation;
  camera.fov_deg = *fov;
  camera.width_m = *width;
  camera.width_px = image.width_px();
  camera.height_px = image.height_px();
  return camera;
}

std::optional<SunPlace> read_sun(const Metadata& metadata) {
  const auto azimuth = metadata.number("arcus:sun:azimuth_deg"),
             elevation = metadata.number("arcus:sun:elevation_deg"),
             radius = metadata.number("arcus:sun:angular_radius_deg");
  if (!azimuth || !elevation || !radius) return std::nullopt;
  return SunPlace{*azimuth, *elevation, *radius};
}

MakingOf read_making_of(const Metadata& metadata) {
  MakingOf making;
  making.version = metadata.text("arcus:version").value_or("");
  making.scene_text = metadata.text("arcus:scene").value_or("");
  making.scene_hash = metadata.text("arcus:scene_hash").value_or("");
  const std::string seed = metadata.text("arcus:seed").value_or("");
  std::from_chars(seed.data(), seed.data() + seed.size(), making.seed);
  making.samples_per_pixel = metadata.number("arcus:samples_per_pixel").value_or(0);
  making.render_seconds = metadata.number("arcus:render_seconds").value_or(0);
  return making;
}

}  // namespace arcus::render
