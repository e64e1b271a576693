// arcus info: what a .vdb, .nc, .exr or .toml file holds, in words or as JSON.

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>

#include "media/author/droplets.h"
#include "media/author/ice_crystals.h"
#include "media/grid/grid_facts.h"
#include "media/grid/projections.h"
#include "media/grid/stored_medium.h"
#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/settings/toml_text.h"
#include "phase/species/species_cache.h"
#include "phase/species/make_species.h"
#include "phase/species/oriented_file.h"
#include "phase/species/species_file.h"
#include "src/film/image_file.h"
#include "src/scene/settings.h"
#include "tools/command.h"
#include "tools/info_picture.h"

namespace arcus::tools {
namespace {

using Json = nlohmann::ordered_json;
using media::Affine;

Json of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

/// Share of the extinction that the renderer lets go straight on, at 550 nm and the sizes' ends, where the grid names a
/// recipe whose table is in the cache already: looking at a file computes no table.
Json forward_of(const media::GridFacts& grid, const std::string& where, const std::string& cache_folder) {
  for (const auto& [name, value] : grid.metadata) {
    if (name != "arcus_phase") continue;
    const phase::Recipe recipe = phase::recipe_from_text(value, where + ": arcus_phase");
    if (!recipe.is_sphere() && !recipe.is_crystal()) return 0.0;
    const std::string path = phase::SpeciesCache(cache_folder).path_of(phase::recipe_id(recipe));
    if (!std::filesystem::exists(path)) return nullptr;
    const phase::ScatteringTable table = phase::read_species_file(path).table;
    std::size_t wavelength = 0;
    while (wavelength + 1 < table.wavelength_nm.size() && table.wavelength_nm[wavelength] < 550) ++wavelength;
    double sum = 0;
    for (std::size_t size = 0; size < table.size_um.size(); ++size)
      sum += table.forward_fraction[table.row(size, wavelength)];
    return sum / static_cast<double>(table.size_um.size());
  }
  return nullptr;
}

/// Liquid water of a species of water drops, from extinction and size: 4 ρ r σ / (3 Q) a volume.
double water_kg(const media::StoredMedium& medium, const phase::Recipe& recipe) {
  constexpr double water_kg_per_m3 = 1000;
  const Vec3 edges[3] = {medium.world_from_index.vector(Vec3(1, 0, 0)), medium.world_from_index.vector(Vec3(0, 1, 0)),
                         medium.world_from_index.vector(Vec3(0, 0, 1))};
  const double volume_m3 = std::fabs(dot(edges[0], cross(edges[1], edges[2])));
  const bool is_cloud = recipe.type == "mie" && recipe.distribution.type == "gamma" && medium.smallest_size_um > 0;
  const auto efficiency = is_cloud ? std::make_optional<media::DropletExtinction>(recipe.distribution.variance, medium.smallest_size_um,
                                                                                  medium.largest_size_um * 1.001)
                                   : std::nullopt;
  double sum = 0;
  media::for_each_voxel(*medium.grid, [&](const media::Coord&, const media::Voxel& voxel) {
    const double radius_um = medium.grid->has_size() ? voxel.size_um : medium.size_um;
    sum += voxel.extinction * radius_um / (efficiency ? efficiency->efficiency(radius_um) : 2);
  });
  return sum * volume_m3 * 1e-6 * water_kg_per_m3 / 0.75;
}

/// Ice of a species of crystals, from extinction and size.
double ice_kg(const media::StoredMedium& medium, const phase::Recipe& recipe) {
  const media::IceCrystals crystals(recipe.crystal);
  double sum = 0;
  media::for_each_voxel(*medium.grid, [&](const media::Coord&, const media::Voxel& voxel) {
    const double size_um = medium.grid->has_size() ? voxel.size_um : medium.size_um;
    sum += 1e-3 * voxel.extinction / crystals.extinction_per_m(1, size_um);
  });
  return sum * std::fabs(medium.world_from_index.determinant());
}

/// Those species of a file that share the voxels of the first, as habits of one cloud do: they are seen together.
std::vector<const media::SparseGrid*> seen_together(const std::vector<media::StoredMedium>& stored) {
  const Affine& map = stored.front().world_from_index;
  std::vector<const media::SparseGrid*> grids;
  for (const media::StoredMedium& medium : stored) {
    const Affine difference = map.inverse() * medium.world_from_index, same;
    if (length(difference.x - same.x) + length(difference.y - same.y) + length(difference.z - same.z) < 1e-5 && length(difference.origin) < 1e-3)
      grids.push_back(medium.grid.get());
  }
  return grids;
}

/// What only a species has: the range of sizes, the mass of water or ice, and a picture where one is asked for.
Json species_facts(const std::string& path, const std::string& png) {
  Json all = Json::array();
  const media::StoredMedia stored = media::read_media(path, "");
  for (const media::StoredMedium& medium : stored.media) {
    Json facts{{"medium", medium.name}};
    if (medium.largest_size_um > 0) facts["size_um"] = {{"smallest", medium.smallest_size_um}, {"largest", medium.largest_size_um}};
    if (medium.is_species) {
      const phase::Recipe recipe = phase::recipe_from_text(medium.recipe, path + ": arcus_phase");
      if (recipe.is_sphere() && recipe.material == "water" && medium.largest_size_um > 0) facts["water_kg"] = water_kg(medium, recipe);
      if (recipe.is_crystal() && recipe.material == "ice" && medium.largest_size_um > 0) facts["ice_kg"] = ice_kg(medium, recipe);
    }
    all.push_back(facts);
  }
  if (!png.empty()) {
    const Affine& map = stored.media.front().world_from_index;
    const Vec3 voxel_m(length(map.vector(Vec3(1, 0, 0))), length(map.vector(Vec3(0, 1, 0))), length(map.vector(Vec3(0, 0, 1))));
    write_projections(png, media::projections(seen_together(stored.media), voxel_m), voxel_m);
  }
  return all;
}

/// Whether the file has anything that renders.
bool has_species(const std::vector<media::GridFacts>& grids) {
  for (const media::GridFacts& grid : grids)
    for (const auto& [name, value] : grid.metadata)
      if (name == "arcus_format") return true;
  return false;
}

Json vdb_facts(const std::string& path, const std::string& cache_folder, const std::string& png) {
  Json grids = Json::array();
  const std::vector<media::GridFacts> described = media::describe_vdb(path);
  for (const media::GridFacts& grid : described) {
    Json facts{{"grid", grid.label}, {"type", grid.type}};
    if (!grid.is_readable) {
      facts["note"] = "a type that OpenVDB does not know";
      grids.push_back(facts);
      continue;
    }
    facts["class"] = grid.class_words;
    if (grid.saved_as_half) facts["saved_as"] = "half";
    facts["active_voxels"] = grid.active_voxels;
    facts["memory_MiB"] = static_cast<double>(grid.memory_bytes) / (1 << 20);
    if (grid.is_affine && grid.active_voxels > 0) {
      facts["voxel_m"] = of(grid.voxel_m);
      facts["from_m"] = of(grid.bounds_m.low);
      facts["to_m"] = of(grid.bounds_m.high);
    }
    if (grid.values) {
      facts["smallest_value"] = grid.values->smallest;
      facts["largest_value"] = grid.values->largest;
      facts["mean_value"] = grid.values->mean;
      if (grid.values->not_finite > 0) facts["not_finite_values"] = grid.values->not_finite;
      const bool is_extinction = grid.label.find(".extinction") != std::string::npos;
      if (grid.values->depth && is_extinction) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto& depth = (*grid.values->depth)[axis];
          facts[std::string("optical_depth_along_") + "xyz"[axis]] = {{"mean", depth.mean}, {"largest", depth.largest}};
        }
        const Json forward = forward_of(grid, path, cache_folder);
        if (forward.is_number() && forward.get<double>() > 0) {
          facts["forward_fraction"] = forward;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& depth = (*grid.values->depth)[axis];
            const double rest = 1 - forward.get<double>();
            facts[std::string("optical_depth_rendered_along_") + "xyz"[axis]] = {{"mean", depth.mean * rest},
                                                                                 {"largest", depth.largest * rest}};
          }
        }
      }
    }
    for (const auto& [name, value] : grid.metadata) facts["metadata"][name] = value;
    grids.push_back(facts);
  }
  Json facts{{"file", path}, {"grids", grids}};
  if (has_species(described) || !png.empty()) facts["media"] = species_facts(path, png);
  return facts;
}

Json table_facts(const std::string& path) {
  const phase::SpeciesFile file = phase::read_species_file(path);
  const phase::ScatteringTable& table = file.table;
  const auto [least_forward, most_forward] = std::minmax_element(table.forward_fraction.begin(), table.forward_fraction.end());
  return {{"file", path},
          {"sizes", table.size_um.size()},
          {"size_um", {table.size_um.front(), table.size_um.back()}},
          {"wavelengths", table.wavelength_nm.size()},
          {"wavelength_nm", {table.wavelength_nm.front(), table.wavelength_nm.back()}},
          {"scattering_angles", table.scattering_angle_deg.size()},
          {"forward_angle_deg", table.forward_angle_deg},
          {"forward_fraction", {*least_forward, *most_forward}},
          {"normalisation_error", table.normalisation_error},
          {"angle_error", table.angle_error},
          {"recipe_id", file.recipe_id},
          {"program_version", file.program_version},
          {"recipe", file.recipe}};
}

Json oriented_facts(const std::string& path) {
  const phase::OrientedFile file = phase::read_oriented_file(path);
  const phase::OrientedTable& table = file.table;
  const auto [least_forward, most_forward] = std::minmax_element(table.forward_fraction.begin(), table.forward_fraction.end());
  std::vector<float> errors = table.relative_error;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return {{"file", path},
          {"sun_elevation_deg", table.sun_elevation_deg},
          {"sun_angular_radius_deg", table.sun_angular_radius_deg},
          {"sizes", table.size_um.size()},
          {"size_um", {table.size_um.front(), table.size_um.back()}},
          {"wavelengths", table.wavelength_nm.size()},
          {"wavelength_nm", {table.wavelength_nm.front(), table.wavelength_nm.back()}},
          {"elevations", table.elevation_deg.size()},
          {"azimuths", table.azimuth_deg.size()},
          {"forward_fraction", {*least_forward, *most_forward}},
          {"median_relative_error", *middle},
          {"table_id", file.id},
          {"program_version", file.program_version},
          {"recipe", file.recipe}};
}

Json picture_facts(const std::string& path) {
  const render::Image image = render::read_exr(path);
  Json facts{{"file", path},
             {"resolution", {image.width_px(), image.height_px()}},
             {"pixels_from", {image.box().x0, image.box().y0}},
             {"pixels_to", {image.box().x1, image.box().y1}},
             {"channels", image.channel_names()}};
  for (std::size_t c = 0; c < image.channel_names().size(); ++c) {
    double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0;
    long long finite = 0, others = 0;
    for (int y = image.box().y0; y < image.box().y1; ++y)
      for (int x = image.box().x0; x < image.box().x1; ++x) {
        const double value = image.value(x, y, c);
        if (!std::isfinite(value)) {
          ++others;
          continue;
        }
        least = std::min(least, value);
        most = std::max(most, value);
        sum += value;
        ++finite;
      }
    Json values{{"smallest", least}, {"mean", sum / static_cast<double>(finite)}, {"largest", most}};
    if (others > 0) values["not_finite"] = others;
    facts["values"][image.channel_names()[c]] = values;
  }
  for (const auto& [name, value] : image.metadata.entries())
    std::visit([&, name = name](const auto& v) { facts["metadata"][name] = v; }, value);
  return facts;
}

Json scene_facts(const std::string& path) {
  const render::SceneSettings scene = render::read_scene(path, {});
  Json media = Json::array();
  for (const auto& medium : scene.media) media.push_back({{"name", medium.name}, {"vdb", medium.vdb}});
  return {{"file", path}, {"media", media}, {"complete_text", text_of(scene)}};
}

/// JSON as indented lines for people.
void print_words(const Json& value, int indent) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  for (const auto& [key, entry] : value.items()) {
    const bool is_list_of_tables = entry.is_array() && !entry.empty() && entry[0].is_object();
    if (entry.is_object()) {
      std::cout << margin << key << ":\n";
      print_words(entry, indent + 2);
    } else if (is_list_of_tables) {
      for (const Json& one : entry) {
        print_words(one, indent);
        std::cout << '\n';
      }
    } else if (entry.is_string() && entry.get<std::string>().find('\n') != std::string::npos) {
      std::cout << margin << key << ":\n";
      std::istringstream lines(entry.get<std::string>());
      for (std::string line; std::getline(lines, line);) std::cout << margin << "  " << line << '\n';
    } else if (entry.is_string()) {
      std::cout << margin << key << ": " << entry.get<std::string>() << '\n';
    } else {
      std::cout << margin << key << ": " << entry.dump() << '\n';
    }
  }
}

struct InfoCommand {
  std::string file, cache_folder, png;
  bool json = false;
};

void run(const InfoCommand& command) {
  const std::string ending = std::filesystem::path(command.file).extension().string();
  Json facts;
  if (ending == ".vdb") {
    if (!command.png.empty()) check_writable(command.png);
    facts = vdb_facts(command.file, command.cache_folder.empty() ? phase::default_cache_folder() : command.cache_folder,
                      command.png);
  } else if (ending == ".nc") {
    facts = phase::is_oriented_file(command.file) ? oriented_facts(command.file) : table_facts(command.file);
  } else if (ending == ".exr") {
    facts = picture_facts(command.file);
  } else if (ending == ".toml") {
    facts = scene_facts(command.file);
  } else {
    throw bad_input(command.file, "the ending '" + ending + "'", ".vdb, .nc, .exr or .toml expected");
  }
  if (command.json) std::cout << facts.dump(1) << '\n';
  else print_words(facts, 0);
}

}  // namespace

void add_info(CLI::App& program) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App* app = program.add_subcommand("info", "What a .vdb, .nc, .exr or .toml file holds");
  app->add_option("FILE", command->file, "the file")->required();
  app->add_flag("--json", command->json, "for programs");
  app->add_option("--png", command->png, "OUT.png: a medium from the south, the east and above; the brighter the more light is stopped");
  app->add_option("--cache", command->cache_folder, "folder of the phase tables (default: $XDG_CACHE_HOME/arcus/phase)");
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
