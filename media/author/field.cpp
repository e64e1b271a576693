#include "media/author/field.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>

#include "media/author/lwc_file.h"
#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"

namespace arcus::media {
namespace {

constexpr double most_voxels = 2e9;

/// Values on a lattice, z fastest.
struct Field {
  Coord count;
  Vec3 first_m, step_m;
  std::vector<float> values, sizes;  // sizes: empty, or as many
};

std::string place(const Coord& c) {
  return "voxel (" + std::to_string(c.x) + ", " + std::to_string(c.y) + ", " + std::to_string(c.z) + ")";
}

Coord dimensions_of(const FieldSettings& settings) {
  if (settings.dimensions.size() != 3)
    throw bad_input("dimensions", std::to_string(settings.dimensions.size()) + " numbers",
                    "must be three: voxels along x, y and z");
  double product = 1;
  for (const double n : settings.dimensions) product *= n;
  if (product > most_voxels) throw bad_input("dimensions", number_text(product) + " voxels", "at most 2e9 expected");
  return {static_cast<int>(settings.dimensions[0]), static_cast<int>(settings.dimensions[1]),
          static_cast<int>(settings.dimensions[2])};
}

/// Where the voxel of the file's k-th number stands, z fastest.
std::size_t place_of(std::size_t k, const Coord& n, bool x_fastest) {
  if (!x_fastest) return k;
  const auto nx = static_cast<std::size_t>(n.x), ny = static_cast<std::size_t>(n.y), nz = static_cast<std::size_t>(n.z);
  return (k % nx * ny + k / nx % ny) * nz + k / nx / ny;
}

template <class Number>
std::vector<float> numbers_in(const std::string& bytes, const Coord& n, bool x_fastest) {
  static_assert(std::endian::native == std::endian::little);
  std::vector<float> values(bytes.size() / sizeof(Number));
  for (std::size_t k = 0; k < values.size(); ++k) {
    Number number;
    std::memcpy(&number, bytes.data() + k * sizeof number, sizeof number);
    values[place_of(k, n, x_fastest)] = static_cast<float>(number);
  }
  return values;
}

std::vector<float> read_raw(const std::string& path, const FieldSettings& settings, const Coord& n) {
  const std::string bytes = read_text_file(path);
  const std::size_t width = settings.real_format() == "float64" ? 8 : 4;
  const std::size_t expected = width * static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z);
  if (bytes.size() != expected)
    throw bad_input(path, std::to_string(bytes.size()) + " bytes",
                    std::to_string(expected) + " expected: " + std::to_string(n.x) + " x " + std::to_string(n.y) + " x " +
                        std::to_string(n.z) + " numbers of " + std::to_string(width) + " bytes");
  const bool x_fastest = settings.order == "x_fastest";
  return width == 8 ? numbers_in<double>(bytes, n, x_fastest) : numbers_in<float>(bytes, n, x_fastest);
}

/// The positions along one axis, and the step between them.
struct Axis {
  double first = 0, step = 1;
  int count = 1;
};
Axis axis_of(std::vector<double> positions, const std::string& where, const char* name) {
  std::sort(positions.begin(), positions.end());
  const double extent = positions.back() - positions.front();
  double step = extent;
  for (std::size_t i = 1; i < positions.size(); ++i)  // equal positions may differ by rounding
    if (const double gap = positions[i] - positions[i - 1]; gap > 1e-6 * extent) step = std::min(step, gap);
  if (extent == 0) return {.first = positions.front()};
  const double count = std::round(extent / step);
  step = extent / count;
  for (const double p : positions) {
    const double index = (p - positions.front()) / step;
    if (std::fabs(index - std::round(index)) > 1e-3)
      throw bad_input(where + ": column " + name, number_text(p) + " m",
                      "equal steps expected, here of " + number_text(step) + " m", "Resample the field to even levels");
  }
  if (count > 1e6) throw bad_input(where + ": column " + name, number_text(count) + " steps", "at most 1e6 expected");
  return {positions.front(), step, static_cast<int>(count) + 1};
}

Field read_positions(const std::string& path, const Columns& columns) {
  Field field;
  Axis axes[3];
  const char* names[] = {"x", "y", "z"};
  for (std::size_t a = 0; a < 3; ++a) axes[a] = axis_of(columns.columns[a], path, names[a]);
  // A single layer has no step of its own: it gets the smallest of the others.
  double least = 0;
  for (const Axis& axis : axes)
    if (axis.count > 1) least = least == 0 ? axis.step : std::min(least, axis.step);
  for (Axis& axis : axes)
    if (axis.count == 1) axis.step = least == 0 ? 1 : least;
  field.count = {axes[0].count, axes[1].count, axes[2].count};
  field.first_m = {axes[0].first, axes[1].first, axes[2].first};
  field.step_m = {axes[0].step, axes[1].step, axes[2].step};
  const double total = 1.0 * field.count.x * field.count.y * field.count.z;
  if (total > most_voxels) throw bad_input(path, "a lattice of " + number_text(total) + " voxels", "at most 2e9 expected");
  const bool with_size = columns.columns.size() == 5;
  field.values.resize(static_cast<std::size_t>(total));
  if (with_size) field.sizes.resize(field.values.size());
  std::vector<bool> is_given(field.values.size());
  for (std::size_t row = 0; row < columns.columns[0].size(); ++row) {
    std::size_t at = 0;
    for (std::size_t a = 0; a < 3; ++a)
      at = at * static_cast<std::size_t>(axes[a].count) +
           static_cast<std::size_t>(std::lround((columns.columns[a][row] - axes[a].first) / axes[a].step));
    if (is_given[at])
      throw bad_input(path, "two lines for the position " + number_text(columns.columns[0][row]) + ", " +
                                number_text(columns.columns[1][row]) + ", " + number_text(columns.columns[2][row]),
                      "one expected");
    is_given[at] = true;
    field.values[at] = static_cast<float>(columns.columns[3][row]);
    if (with_size) field.sizes[at] = static_cast<float>(columns.columns[4][row]);
  }
  return field;
}

Field read_field(const FieldSettings& settings, const std::string& folder) {
  const std::string path = path_from(folder, settings.file);
  Field field;
  field.first_m = settings.first_m;
  const auto& steps = settings.voxel_m;
  field.step_m = steps.size() == 1 ? Vec3(steps[0]) : Vec3(steps[0], steps[1], steps[2]);
  if (settings.real_format() != "columns") {
    field.count = dimensions_of(settings);
    field.values = read_raw(path, settings, field.count);
    if (!settings.size_file.empty()) field.sizes = read_raw(path_from(folder, settings.size_file), settings, field.count);
    return field;
  }
  const Columns columns = read_columns_file(path);
  const std::size_t width = columns.columns.size();
  if (width == 4 || width == 5) return read_positions(path, columns);
  if (width != 1)
    throw bad_input(path, std::to_string(width) + " columns", "one (values), four (x, y, z, value) or five (and size) expected");
  field.count = dimensions_of(settings);
  const std::size_t total =
      static_cast<std::size_t>(field.count.x) * static_cast<std::size_t>(field.count.y) * static_cast<std::size_t>(field.count.z);
  if (columns.columns[0].size() != total)
    throw bad_input(path, std::to_string(columns.columns[0].size()) + " values", std::to_string(total) + " expected by dimensions");
  field.values.resize(total);
  for (std::size_t k = 0; k < total; ++k)
    field.values[place_of(k, field.count, settings.order == "x_fastest")] = static_cast<float>(columns.columns[0][k]);
  return field;
}

/// A recipe in place of the one that the species has, where there is one.
void set_recipe(const FieldSettings& settings, const std::string& folder, NewSpecies& species) {
  if (!settings.has_phase) return;
  phase::Recipe recipe =
      settings.phase_file.empty() ? settings.phase : phase::recipe_from_file(path_from(folder, settings.phase_file));
  if (settings.phase_file.empty()) phase::resolve_files(recipe, folder);
  phase::make_files_absolute(recipe);
  species.recipe = text_of(recipe);
  species.phase_id = phase::recipe_id(recipe);
}

AuthoredField author_water(const FieldSettings& settings, const std::string& folder) {
  const std::string path = path_from(folder, settings.file);
  const bool sizes_are_given = settings.has_size || settings.droplets.drops_per_cm3 > 0;
  ModelOutput output;
  if (settings.real_format() == "lwc") {
    output.field = read_lwc_file(path);
    if (sizes_are_given) output.field.radius_um.clear();
  } else {
    std::optional<GivenLattice> given;
    if (settings.has_voxel) {
      const auto& step = settings.voxel_m;
      given = {{settings.first_m.x, settings.first_m.y, settings.first_m.z}, {step[0], step[step.size() / 2], step.back()}};
    }
    output = read_model_output(path, settings.model, given, sizes_are_given);
  }
  for (float& water : output.field.water_g_per_m3) water *= static_cast<float>(settings.scale);
  DropletSettings droplets = settings.droplets;
  droplets.size_um = settings.size_um;
  if (output.field.radius_um.empty() && output.field.drops_per_cm3.empty())
    output.notes.push_back(droplets.drops_per_cm3 > 0 ? number_text(droplets.drops_per_cm3) + " droplets in a cm3 everywhere"
                                                      : "effective radius " + number_text(droplets.size_um) + " um everywhere");
  WaterSpecies water = species_of_water(output.field, droplets);
  water.species.name = settings.name == FieldSettings{}.name ? "cloud" : settings.name;
  set_recipe(settings, folder, water.species);
  output.notes.insert(output.notes.end(), water.notes.begin(), water.notes.end());
  const FilledRange range = range_of(water.species);
  return {grids_of(std::move(water.species)), output.notes, range};
}

}  // namespace

std::string FieldSettings::real_format() const {
  if (format != "auto") return format;
  std::string ending = file.substr(std::min(file.size(), file.find_last_of('.')));
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".nc" || ending == ".nc4" || ending == ".cdf" || ending == ".netcdf") return "netcdf";
  if (ending == ".lwc") return "lwc";
  return ending == ".csv" || ending == ".txt" || ending == ".dat" ? "columns" : "float32";
}

void list_keys(Keys& keys, FieldSettings& field) {
  keys.text("file", field.file, "raw numbers, columns of text, NetCDF of a cloud model, or an LWC file of SHDOM, I3RC or AT3D");
  if (field.file.empty() && !keys.documents()) keys.refuse("file", "nothing", "the name of a file expected");
  keys.choice("format", field.format, {"auto", "float32", "float64", "columns", "netcdf", "lwc"},
              "float32, float64: raw, little-endian; auto: by the ending .csv, .txt, .dat (columns), .nc, .nc4, .cdf, .netcdf, .lwc, else float32");
  const bool is_water = field.is_water();
  if (keys.only_if(!is_water, "raw or columns")) {
    keys.text("size_file", field.size_file, "raw numbers only: sizes in um, in the same order");
    keys.numbers("dimensions", field.dimensions, between(1, 1e6), 0, 3,
                 "number of voxels along x, y and z; not needed for columns with positions");
    keys.choice("order", field.order, {"z_fastest", "x_fastest"}, "which index runs first through the file");
  }
  keys.vector3("first_m", field.first_m, "position of the first voxel's value; not needed where the file has positions");
  field.has_voxel = field.has_voxel || keys.is_given("voxel_m");
  keys.numbers("voxel_m", field.voxel_m, above(0), 1, 3, "distance between neighbours along x, y and z; one number: along all");
  if (field.voxel_m.size() == 2) keys.refuse("voxel_m", "2 numbers", "must be one or three");
  keys.number("scale", field.scale, at_least(0), "multiplies the values");
  keys.text("name", field.name, "of the density grid, or of the species where a recipe is given; density for liquid water: cloud");
  field.has_phase = field.has_phase || keys.is_given("phase");
  field.has_size = field.has_size || keys.is_given("size_um");
  if (keys.only_if(field.has_phase || is_water, "species: with a recipe, values are in 1/m; or liquid water"))
    keys.number("size_um", field.size_um, above(0), "size of all particles where no sizes are given; liquid water: effective radius in place of the file's");
  if (keys.only_if(is_water, "liquid water: netcdf or lwc")) list_keys(keys, field.droplets);
  if (keys.only_if(field.real_format() == "netcdf", "netcdf")) list_keys(keys, field.model);
  if (keys.only_if(field.has_phase, "makes a species of it"))
    keys.word_or_table("phase", field.phase_file, field.phase,
                       "recipe of the phase functions: a table of recipe keys or the name of a recipe file; liquid water has its own");
}

AuthoredField author_field(const FieldSettings& settings, const std::string& folder) {
  if (settings.is_water()) return author_water(settings, folder);
  const Field field = read_field(settings, folder);
  const Coord& n = field.count;
  NewSpecies species;
  species.world_from_index = Affine::translation(field.first_m) * Affine::scaling(field.step_m);
  constexpr int edge = SparseGrid::brick_edge;
  const auto at = [&](const Coord& c) {
    return (static_cast<std::size_t>(c.x) * static_cast<std::size_t>(n.y) + static_cast<std::size_t>(c.y)) *
               static_cast<std::size_t>(n.z) +
           static_cast<std::size_t>(c.z);
  };
  for (int x = 0; x < n.x; x += edge)
    for (int y = 0; y < n.y; y += edge)
      for (int z = 0; z < n.z; z += edge) {
        NewBrick extinction{{x, y, z}, {}}, size{{x, y, z}, {}};
        bool is_empty = true;
        for (int i = 0; i < SparseGrid::brick_voxels; ++i) {
          const Coord c{x + (i >> 6), y + (i >> 3 & 7), z + (i & 7)};
          if (c.x >= n.x || c.y >= n.y || c.z >= n.z) continue;
          const float value = static_cast<float>(settings.scale) * field.values[at(c)];
          if (!(value >= 0) || std::isinf(value))
            throw bad_input(settings.file + ": " + place(c), std::isnan(value) ? "NaN" : number_text(value),
                            "a finite value that is not negative expected");
          if (value == 0) continue;
          is_empty = false;
          extinction.values[static_cast<std::size_t>(i)] = value;
          if (field.sizes.empty()) continue;
          const float own_size = field.sizes[at(c)];
          if (!(own_size > 0) || std::isinf(own_size))
            throw bad_input(settings.file + ": " + place(c), std::isnan(own_size) ? "size NaN" : "size " + number_text(own_size),
                            "a size above 0 expected");
          size.values[static_cast<std::size_t>(i)] = own_size;
        }
        if (is_empty) continue;
        species.extinction.push_back(extinction);
        if (!field.sizes.empty()) species.size.push_back(size);
      }
  if (species.extinction.empty())
    throw bad_input(settings.file, "zeros alone", "at least one value above 0 expected");
  if (!settings.has_phase) {
    NewGrid density;
    density.name = settings.name;
    density.world_from_index = species.world_from_index;
    density.bricks = std::move(species.extinction);
    return {.grids = {density}, .notes = {}, .range = {}};
  }
  species.name = settings.name;
  set_recipe(settings, folder, species);
  species.size_um = static_cast<float>(settings.size_um);
  return {.grids = grids_of(std::move(species)), .notes = {}, .range = {}};
}

}  // namespace arcus::media
