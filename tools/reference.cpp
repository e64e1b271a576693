// arcus reference: every key of scenes, recipes and authors, as a page for people or a schema for editors. Printed from the
// lists that read the files, so that it says what the program takes.

#include <CLI/CLI.hpp>

#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "media/author/box.h"
#include "media/author/cirrus.h"
#include "media/author/cloud.h"
#include "media/author/diamond_dust.h"
#include "media/author/field.h"
#include "media/author/fog.h"
#include "media/author/rain.h"
#include "phase/settings/reference.h"
#include "phase/species/recipe.h"
#include "src/scene/settings.h"
#include "tools/command.h"

namespace arcus::tools {
namespace {

struct Reference {
  std::string title;
  KeyList list;
};

/// The keys of S with the defaults of a new one.
template <class S>
Reference reference_of(std::string title) {
  return {std::move(title), [](Keys& keys) {
            S settings;
            list_keys(keys, settings);
          }};
}

/// What there is a reference of; a new kind of author is one line.
std::map<std::string, Reference> references() {
  return {{"scene", reference_of<render::SceneSettings>("Keys of a scene file")},
          {"recipe", reference_of<phase::Recipe>("Keys of a phase recipe")},
          {"author-rain", reference_of<media::RainSettings>("Keys of arcus author rain")},
          {"author-cloud", reference_of<media::CloudSettings>("Keys of arcus author cloud")},
          {"author-cirrus", reference_of<media::CirrusSettings>("Keys of arcus author cirrus")},
          {"author-diamond-dust", reference_of<media::DiamondDustSettings>("Keys of arcus author diamond-dust")},
          {"author-fog", reference_of<media::FogSettings>("Keys of arcus author fog")},
          {"author-box", reference_of<media::BoxSettings>("Keys of arcus author box")},
          {"author-field", reference_of<media::FieldSettings>("Keys of arcus author field")}};
}

struct ReferenceCommand {
  std::string kind = "scene";
  bool is_schema = false;
};

}  // namespace

void add_reference(CLI::App& program) {
  auto command = std::make_shared<ReferenceCommand>();
  CLI::App* app = program.add_subcommand("reference", "All keys of scenes, recipes and authors, with defaults and ranges");
  std::vector<std::string> kinds;
  for (const auto& entry : references()) kinds.push_back(entry.first);
  app->add_option("--kind", command->kind, "which keys")->check(CLI::IsMember(kinds))->capture_default_str();
  app->add_flag("--schema", command->is_schema, "as JSON Schema (draft 7) instead of Markdown");
  app->callback([command] {
    const Reference reference = references().at(command->kind);
    std::cout << (command->is_schema ? json_schema(reference.title, reference.list)
                                     : reference_page(reference.title, reference.list));
  });
}

}  // namespace arcus::tools
