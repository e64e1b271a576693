#include "tools/phase_sky.h"

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <set>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/crystal/named_halos.h"
#include "phase/crystal/path_symmetry.h"
#include "phase/population/path_census.h"
#include "phase/settings/number_text.h"
#include "phase/species/crystal_recipe.h"
#include "phase/species/oriented_file.h"
#include "phase/species/species_cache.h"
#include "src/analysis/sky_chart.h"
#include "src/light/sun.h"
#include "tools/number_list.h"

namespace arcus::tools {
namespace {

/// Of a light's paths, those below this share are summed up.
constexpr double listed_share = 0.001;
/// Rays at each wavelength for a list of paths, where nothing else is asked for.
constexpr double census_million = 1;

struct Crystals {
  phase::Recipe recipe;
  std::string name;       ///< of its file, without the ending
  double weight = 1;      ///< optical depth
  phase::PathSymmetry symmetry;
  phase::PathFilter paths;
};

phase::CrystalShape shape_of(const phase::Recipe& recipe) { return phase::make_crystal(recipe.crystal.habit, recipe.size_um.front()); }

std::vector<double> weights_of(const SkyCommand& command, std::size_t count) {
  if (command.weights.empty()) return std::vector<double>(count, 1);
  const std::vector<double> weights = number_list(command.weights, "--weights");
  if (weights.size() != count)
    throw bad_input("--weights", std::to_string(weights.size()) + (weights.size() == 1 ? " number" : " numbers"),
                    "one for each recipe expected, " + std::to_string(count) + " in all");
  if (std::ranges::any_of(weights, [](double w) { return w < 0; }) || std::ranges::all_of(weights, [](double w) { return w == 0; }))
    throw bad_input("--weights", "'" + command.weights + "'", "numbers of at least 0, and one above it, expected");
  return weights;
}

std::set<int> faces_of(const std::vector<phase::Recipe>& recipes) {
  std::set<int> numbers;
  for (const phase::Recipe& recipe : recipes) {
    const phase::CrystalShape shape = shape_of(recipe);
    for (const phase::CrystalFace& face : shape.faces()) numbers.insert(face.number);
  }
  return numbers;
}

std::vector<phase::FacePath> paths_of(const std::vector<std::string>& texts, const std::string& option, const std::set<int>& faces) {
  std::vector<phase::FacePath> paths;
  for (const std::string& text : texts) {
    const auto path = phase::FacePath::from_text(text);
    if (!path) throw bad_input(option, "'" + text + "'", "numbers of faces in the order in which light meets them expected, as 3-5 or 1-3");
    for (int i = 0; i < path->length(); ++i) {
      if (faces.contains(path->face(i))) continue;
      std::string names;
      for (const int face : faces) names += (names.empty() ? "" : ", ") + std::to_string(face);
      throw bad_input(option, "face " + std::to_string(path->face(i)) + " in '" + text + "'", "the crystals have the faces " + names);
    }
    paths.push_back(*path);
  }
  return paths;
}

phase::PathFilter filter_of(const std::vector<phase::FacePath>& only, const std::vector<phase::FacePath>& without,
                            const phase::PathSymmetry& symmetry, bool exact) {
  const auto all = [&](const std::vector<phase::FacePath>& paths) {
    if (exact) return paths;
    std::vector<phase::FacePath> result;
    for (const phase::FacePath& path : paths)
      for (const phase::FacePath& other : symmetry.equivalents(path)) result.push_back(other);
    return result;
  };
  return {all(only), all(without)};
}

std::vector<Crystals> crystals_of(const SkyCommand& command, std::vector<phase::Recipe> recipes) {
  const std::vector<double> weights = weights_of(command, recipes.size());
  const std::set<int> faces = faces_of(recipes);
  const auto only = paths_of(command.ray_paths, "--ray-path", faces), without = paths_of(command.without_paths, "--without-path", faces);
  std::vector<Crystals> crystals;
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    phase::Recipe& recipe = recipes[i];
    recipe.size_um = {command.size_um > 0 ? command.size_um : recipe.size_um[recipe.size_um.size() / 2]};
    if (command.rays_million > 0) recipe.rays_million = command.rays_million;
    if (command.map_step_deg > 0) recipe.map_step_deg = command.map_step_deg;
    const phase::PathSymmetry symmetry(shape_of(recipe));
    crystals.push_back({recipe, std::filesystem::path(command.recipes[i]).stem().string(), weights[i], symmetry,
                        filter_of(only, without, symmetry, command.exact_path)});
  }
  return crystals;
}

std::string words_of(const phase::Recipe& recipe) {
  const auto& lies = recipe.crystal.orientation;
  std::string text = recipe.crystal.name + " " + number_text(recipe.size_um.front()) + " µm";
  if (lies.type == "random") return text + " at random";
  if (lies.type != recipe.crystal.name) text += " as " + lies.type;
  return text + ", tilt " + number_text(lies.tilt_deg) + "°";
}

std::string title_of(const std::vector<Crystals>& crystals) {
  std::string title;
  for (const Crystals& c : crystals) {
    if (!title.empty()) title += "  +  ";
    if (crystals.size() > 1 && c.weight != 1) title += number_text(c.weight) + " × ";
    title += words_of(c.recipe);
  }
  return title;
}

std::string subtitle_of(const SkyCommand& command) {
  std::string text = "sun at " + number_text(command.sun_elevation_deg) + "°";
  const auto list = [&](const std::vector<std::string>& paths, const std::string& words) {
    for (std::size_t i = 0; i < paths.size(); ++i) text += (i == 0 ? words : ", ") + paths[i];
  };
  list(command.ray_paths, "; ray paths ");
  list(command.without_paths, "; without ");
  if (command.exact_path) text += " exactly";
  return text;
}

std::vector<render::SkyLabel> labels_of(const SkyCommand& command, const std::vector<Crystals>& crystals) {
  std::vector<render::SkyLabel> labels;
  for (const Crystals& c : crystals) {
    const double n = phase::refractive_index_of(c.recipe).relative_to_air(550).real();
    for (const phase::NamedHalo& halo : phase::named_halos(c.recipe.crystal, n, command.sun_elevation_deg)) {
      if (std::ranges::any_of(labels, [&](const auto& other) { return other.text == halo.name; })) continue;
      labels.push_back({halo.name, {}});
      for (const phase::HaloPlace& p : halo.places) labels.back().points.push_back({p.azimuth_deg, p.elevation_deg});
    }
  }
  return labels;
}

void draw(const SkyCommand& command, const std::vector<Crystals>& crystals) {
  phase::SpeciesOptions options;
  options.cache_folder = command.cache_folder.empty() ? phase::default_cache_folder() : command.cache_folder;
  if (!command.quiet) options.log = [](std::string_view text) { std::cerr << text << '\n'; };
  render::SkyLight light(render::sun_irradiance({}, ""));
  for (const Crystals& c : crystals)
    if (c.weight > 0)
      light.add(phase::oriented_table_of(c.recipe, command.sun_elevation_deg, command.sun_radius_deg, options, c.paths), c.weight);
  render::SkyChart chart;
  chart.title = title_of(crystals);
  chart.subtitle = subtitle_of(command);
  chart.sun_elevation_deg = command.sun_elevation_deg;
  chart.has_lower_half = command.below;
  if (command.projection == "equal-area") chart.projection = render::SkyProjection::equal_area;
  chart.decades = command.decades;
  chart.exposure_ev = command.exposure_ev;
  chart.has_marks = !command.plain;
  chart.size_px = command.size_px;
  if (command.label) chart.labels = labels_of(command, crystals);
  write_chart(command.output, chart, light);
}

phase::SkyPlace place_of(const SkyCommand& command) {
  const std::vector<double> place = command.paths_at.find(':') == std::string::npos ? number_list(command.paths_at, "--paths-at") : std::vector<double>{};
  if (place.size() != 2 || !(std::fabs(place[0]) <= 360) || !(std::fabs(place[1]) <= 90))
    throw bad_input("--paths-at", "'" + command.paths_at + "'",
                    "AZIMUTH,ELEVATION in degrees expected: from the sun's azimuth, -360 to 360, and above the horizon, -90 to 90");
  return {place[0], place[1], command.radius_deg};
}

struct ListedPath {
  std::string crystals, path;
  double light, error;
};

/// Brightest first.
std::vector<ListedPath> listed(const SkyCommand& command, const std::vector<Crystals>& crystals, const phase::SkyPlace& place) {
  std::vector<ListedPath> list;
  const Curve sun = render::sun_irradiance({}, "");
  for (const Crystals& c : crystals) {
    if (!(c.weight > 0)) continue;
    phase::CrystalTableSettings settings = crystal_settings_of(c.recipe);
    if (command.rays_million == 0) settings.rays = std::min(settings.rays, 1e6 * census_million);
    settings.map_paths = c.paths;
    const auto name_of = [&](const phase::FacePath& path) { return command.exact_path ? path : c.symmetry.representative(path); };
    const phase::CrystalPopulation population(c.recipe.crystal, c.recipe.size_um.front());
    // Optical depths stand for cross-sections as the maps' do.
    const double factor = c.weight / population.mean_projected_area_um2();
    for (const phase::CountedPath& found : paths_at(settings, command.sun_elevation_deg, command.sun_radius_deg, place,
                                                    render::luminous_weights(c.recipe.wavelength_nm, sun), name_of))
      list.push_back({c.name, found.path.length() == 0 ? "diffracted" : found.path.text(), factor * found.light_m2_per_sr, found.relative_error});
  }
  std::ranges::stable_sort(list, [](const ListedPath& a, const ListedPath& b) { return a.light > b.light; });
  return list;
}

void print_paths(const SkyCommand& command, const std::vector<Crystals>& crystals) {
  const phase::SkyPlace place = place_of(command);
  const std::vector<ListedPath> list = listed(command, crystals, place);
  double sum = 0, others = 0;
  std::size_t count = 0;
  for (const ListedPath& path : list) sum += path.light;
  for (const ListedPath& path : list) {
    if (path.light < listed_share * sum) others += path.light / sum;
    else ++count;
  }
  if (command.json) {
    nlohmann::ordered_json out{{"sun_elevation_deg", command.sun_elevation_deg}, {"azimuth_deg", place.azimuth_deg},
                               {"elevation_deg", place.elevation_deg}, {"radius_deg", place.radius_deg},
                               {"merged_by_symmetry", !command.exact_path}, {"paths", nlohmann::ordered_json::array()},
                               {"others", list.size() - count}, {"others_share", others}};
    for (std::size_t i = 0; i < count; ++i)
      out["paths"].push_back({{"path", list[i].path}, {"share", list[i].light / sum},
                              {"share_error", list[i].error * list[i].light / sum}, {"recipe", list[i].crystals}});
    std::cout << out.dump(1) << '\n';
    return;
  }
  std::printf("# sun at %g deg; azimuth %g, elevation %g, within %g deg; luminance in sunlight%s\n", command.sun_elevation_deg,
              place.azimuth_deg, place.elevation_deg, place.radius_deg, command.exact_path ? "" : "; paths equal by symmetry together");
  if (list.empty()) {
    std::printf("# no light fell there\n");
    return;
  }
  std::printf("%8s %8s  %-24s %s\n", "share_%", "error_%", "path", "recipe");
  for (std::size_t i = 0; i < count; ++i)
    std::printf("%8.2f %8.2f  %-24s %s\n", 100 * list[i].light / sum, 100 * list[i].error * list[i].light / sum, list[i].path.c_str(),
                list[i].crystals.c_str());
  if (count < list.size()) std::printf("%8.2f %8s  %zu others\n", 100 * others, "", list.size() - count);
}

}  // namespace

void add_sky_options(CLI::App& app, SkyCommand& command) {
  const std::string group = "Crystals: the sky";
  const auto option = [&](const std::string& name, auto& value, const std::string& help) {
    return app.add_option(name, value, help)->group(group);
  };
  const auto flag = [&](const std::string& name, bool& value, const std::string& help) { app.add_flag(name, value, help)->group(group); };
  option("--sun-elevation-deg", command.sun_elevation_deg, "how high the sun stands")->check(CLI::Range(-90.0, 90.0))->capture_default_str();
  option("--weights", command.weights, "1,0.5: optical depth of each recipe's crystals (default: all alike)");
  flag("--below", command.below, "the half of the sky below the horizon, too: subsun, subparhelia");
  flag("--label", command.label, "name the halos");
  flag("--plain", command.plain, "nothing but the sky: no words, circles and sun");
  option("--projection", command.projection, "equidistant or equal-area")->check(CLI::IsMember({"equidistant", "equal-area"}))->capture_default_str();
  option("--decades", command.decades, "of brightness that the picture shows, or fewer where the whole sky is bright")->check(CLI::Range(0.5, 12.0))->capture_default_str();
  option("--exposure-ev", command.exposure_ev, "brighter by 2^EV")->check(CLI::Range(-30.0, 30.0))->capture_default_str();
  option("--size-px", command.size_px, "width of a half of the sky")->check(CLI::Range(200, 8000))->capture_default_str();
  option("--ray-path", command.ray_paths, "3-5: the light of that path alone and of those that are the same by the crystal's symmetry; may be repeated")
      ->allow_extra_args(false);
  option("--without-path", command.without_paths, "all but the light of that path; may be repeated")->allow_extra_args(false);
  flag("--exact-path", command.exact_path, "paths as they are, without those that are the same by symmetry");
  option("--paths-at", command.paths_at, "AZIMUTH,ELEVATION: print the ray paths that make that place; azimuth from the sun's, clockwise");
  option("--radius-deg", command.radius_deg, "of the place of --paths-at")->check(CLI::Range(0.01, 180.0))->capture_default_str();
  flag("--json", command.json, "the paths as JSON");
  option("--rays-million", command.rays_million, "traced at each wavelength in place of the recipe's (--paths-at: at most 1 unless given)")
      ->check(CLI::Range(1e-3, 1e5));
  option("--map-step-deg", command.map_step_deg, "between the nodes of the map in place of the recipe's")->check(CLI::Range(0.02, 5.0));
}

void run_sky(const SkyCommand& command, std::vector<phase::Recipe> recipes) {
  if (command.output.empty() && command.paths_at.empty())
    throw bad_input("--output", "nothing", "the name of a picture expected, or a place for --paths-at");
  if (command.sun_radius_deg > 45) throw bad_input("--sun-radius-deg", number_text(command.sun_radius_deg), "at most 45 expected for a map of the sky");
  const std::vector<Crystals> crystals = crystals_of(command, std::move(recipes));
  if (!command.paths_at.empty()) place_of(command);
  if (!command.output.empty()) check_writable(command.output);
  if (!command.paths_at.empty()) print_paths(command, crystals);
  if (!command.output.empty()) draw(command, crystals);
}

}  // namespace arcus::tools
