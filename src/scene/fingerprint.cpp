#include "src/scene/fingerprint.h"

#include "phase/base/content_hash.h"
#include "phase/settings/toml_text.h"

namespace arcus::render {
namespace {

/// The recipe's own hash covers the files that it names.
std::string recipe_fingerprint(const MediumSettings& medium, const std::string& folder) {
  if (!medium.phase_file.empty()) return phase::recipe_id(phase::recipe_from_file(path_from(folder, medium.phase_file)));
  if (!medium.has_phase) return "";
  phase::Recipe recipe = medium.phase;
  phase::resolve_files(recipe, folder);
  return phase::recipe_id(recipe);
}

/// Of the file with a body's index, where there is one.
std::string index_fingerprint(const MaterialSettings& material, const std::string& folder) {
  const bool is_clear = material.type == "transparent" || material.type == "dielectric";
  if (!is_clear || material.index.empty() || material.index == "water" || material.index == "ice") return "";
  return file_hash(path_from(folder, material.index));
}

}  // namespace

std::string scene_fingerprint(const SceneSettings& settings) {
  std::string all = text_of(settings);
  const std::string& sun = settings.sun.spectrum;
  if (sun != "solar" && sun != "equal_energy") all += file_hash(path_from(settings.folder, sun));
  for (const MediumSettings& medium : settings.media) {
    all += file_hash(path_from(settings.folder, medium.vdb));
    all += recipe_fingerprint(medium, settings.folder);
  }
  for (const SurfaceSettings& surface : settings.surfaces) {
    if (surface.shape.type == "mesh") all += file_hash(path_from(settings.folder, surface.shape.file));
    all += index_fingerprint(surface.material, settings.folder);
  }
  for (const DropletsSettings& drops : settings.droplets) all += index_fingerprint(drops.material, settings.folder);
  return content_hash(all);
}

}  // namespace arcus::render
