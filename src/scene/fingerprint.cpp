#include "src/scene/fingerprint.h"

#include <utility>

#include "phase/base/content_hash.h"
#include "phase/settings/toml_text.h"

namespace arcus::render {
namespace {

/// Replaces names by the hashes of what they name.
class Naming {
 public:
  explicit Naming(std::string folder) : folder_(std::move(folder)) {}

  void file(std::string& name) {
    name = noted(name, [&] { return file_hash(path_from(folder_, name)); });
  }
  /// The recipe's own hash covers the files that it names.
  void recipe(MediumSettings& medium) {
    if (!medium.phase_file.empty()) {
      medium.phase_file = noted(medium.phase_file, [&] { return phase::recipe_id(phase::recipe_from_file(path_from(folder_, medium.phase_file))); });
    } else if (medium.has_phase) {
      phase::Recipe recipe = medium.phase;
      phase::resolve_files(recipe, folder_);
      const std::string hash = phase::recipe_id(recipe);
      inputs_.push_back({"phase of medium '" + medium.name + "'", hash});
    }
  }
  /// The file with a body's index, where there is one.
  void index(MaterialSettings& material) {
    const bool has_index = material.type == "transparent" || material.type == "dielectric" || material.type == "sea";
    if (has_index && !material.index.empty() && !phase::RefractiveIndex::is_built_in(material.index)) file(material.index);
  }
  std::vector<SceneInput> inputs() && { return std::move(inputs_); }

 private:
  /// A large file that several media share is read once.
  template <class Hash>
  std::string noted(const std::string& name, const Hash& hash) {
    for (const SceneInput& input : inputs_)
      if (input.name == name) return input.hash;
    inputs_.push_back({name, hash()});
    return inputs_.back().hash;
  }

  std::string folder_;
  std::vector<SceneInput> inputs_;
};

}  // namespace

SceneIdentity scene_identity(const SceneSettings& settings) {
  SceneSettings named = settings;
  Naming naming(settings.folder);
  named.film.exposure_ev = 0;
  named.film.adaptation = "day";
  if (named.sun.spectrum != "solar" && named.sun.spectrum != "equal_energy") naming.file(named.sun.spectrum);
  if (named.sky.type == "image") naming.file(named.sky.file);
  for (MediumSettings& medium : named.media) {
    naming.recipe(medium);
    naming.file(medium.vdb);
  }
  for (SurfaceSettings& surface : named.surfaces) {
    if (surface.shape.type == "mesh" || surface.shape.type == "terrain") naming.file(surface.shape.file);
    naming.index(surface.material);
    if (surface.material.type != "matte") continue;
    if (surface.material.pattern == "image") naming.file(surface.material.image);
    else if (!surface.material.albedo_file.empty()) naming.file(surface.material.albedo_file);
  }
  for (DropletsSettings& drops : named.droplets) naming.index(drops.material);
  SceneIdentity identity{"", std::move(naming).inputs()};
  std::string all = text_of(named);
  for (const SceneInput& input : identity.inputs) all += input.hash;
  identity.hash = content_hash(all);
  return identity;
}

std::string scene_fingerprint(const SceneSettings& settings) { return scene_identity(settings).hash; }

}  // namespace arcus::render
