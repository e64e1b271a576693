#include "media/grid/stored_medium.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "media/grid/vdb_grid.h"
#include "media/grid/vdb_reader.h"
#include "phase/base/error.h"

namespace arcus::media {
namespace {

using std::string;

constexpr std::string_view extinction_suffix = ".extinction", size_suffix = ".size";

bool is_number_grid(const VdbEntry& entry) { return entry.type == "float" || entry.type == "double"; }

/// All that is read of one file.
class MediaReader {
 public:
  explicit MediaReader(const string& path) : reader_(path) {
    if (reader_.entries().empty())
      throw bad_input(path, "no grid", "at least one float grid expected", "The file is whole but empty: write it again");
    for (std::size_t i = 0; i < reader_.entries().size(); ++i)
      headers_.push_back(reader_.read_header(i));
  }

  StoredMedia read(const string& choice) {
    if (choice.empty()) {
      for (std::size_t i = 0; i < headers_.size(); ++i)
        if (is_species(i)) result_.media.push_back(read_species(i));
      if (result_.media.empty()) result_.media.push_back(read_density(default_grid()));
    } else {
      const std::size_t chosen = find(choice);
      result_.media.push_back(is_species(chosen) ? read_species(chosen) : read_density(chosen));
    }
    return std::move(result_);
  }

 private:
  const VdbEntry& entry(std::size_t i) const { return reader_.entries()[i]; }
  string where(std::size_t i) const { return reader_.where(i); }
  void note(std::size_t i, const string& text) { result_.notes.push_back(where(i) + ": " + text); }

  /// A format mark makes a species of a grid; one without a mark is a density whatever its name.
  bool is_species(std::size_t i) const {
    return entry(i).name.ends_with(extinction_suffix) && headers_[i] && headers_[i]->integer("arcus_format");
  }
  bool is_fog(std::size_t i) const {
    return is_number_grid(entry(i)) && headers_[i] && !headers_[i]->is_level_set() &&
           !(entry(i).name.ends_with(size_suffix));
  }

  std::vector<string> usable() const {
    std::vector<string> labels;
    for (std::size_t i = 0; i < headers_.size(); ++i)
      if (is_fog(i)) labels.push_back("'" + entry(i).label() + "'");
    return labels;
  }
  string hint() const {
    const auto labels = usable();
    if (labels.empty()) return "The file has no float or double fog volume";
    return (labels.size() == 1 ? "This grid would do: " : "These grids would do: ") + list_of(labels);
  }
  /// "'v' (vec3s, staggered), ..."
  string all_grids() const {
    string text;
    for (std::size_t i = 0; i < headers_.size(); ++i)
      text += (i ? ", '" : "'") + entry(i).label() + "' (" + kind(i) + ")";
    return text;
  }
  string kind(std::size_t i) const {
    const string type = entry(i).type + (entry(i).saved_as_half ? " saved as half" : "");
    return headers_[i] ? type + ", " + headers_[i]->class_words() : type;
  }

  std::size_t default_grid() {
    std::vector<std::size_t> fogs;
    std::vector<std::size_t> named;
    for (std::size_t i = 0; i < headers_.size(); ++i) {
      if (!is_fog(i)) continue;
      fogs.push_back(i);
      if (entry(i).name == "density") named.push_back(i);
    }
    if (named.size() == 1) return named[0];
    if (fogs.size() == 1) {
      note(fogs[0], "used, because it is the only float fog volume");
      return fogs[0];
    }
    if (fogs.empty()) {
      const bool has_level_set = std::any_of(headers_.begin(), headers_.end(), [](const auto& header) { return header && header->is_level_set(); });
      throw bad_input(reader_.path(), all_grids(), "a float or double fog volume expected",
                      has_level_set ? "Level sets are distances to a surface: convert them first (OpenVDB's sdfToFogVolume)"
                                    : "Convert the grid that holds the density first");
    }
    throw bad_input(reader_.path(), list_of(usable()), "one of them must be chosen", "Say which with grid = \"...\"");
  }

  std::size_t find(const string& choice) const {
    std::vector<std::size_t> matches;
    for (std::size_t i = 0; i < headers_.size(); ++i) {
      const VdbEntry& e = entry(i);
      if (e.name + "[" + std::to_string(e.index) + "]" == choice || (e.label() == choice && e.label() != e.name)) return i;
      if (e.name == choice || (is_species(i) && e.name == choice + string(extinction_suffix))) matches.push_back(i);
    }
    if (matches.size() == 1) return matches[0];
    std::vector<string> labels;
    if (matches.empty()) {
      for (std::size_t i = 0; i < headers_.size(); ++i) labels.push_back(entry(i).label());
      const string near = nearest_name(choice, labels);
      throw bad_input(reader_.path() + ": grid '" + choice + "'", "no such grid", "the file holds " + all_grids(),
                      near.empty() ? hint() : "Did you mean '" + near + "'?");
    }
    for (const std::size_t i : matches) labels.push_back("'" + entry(i).label() + "'");
    throw bad_input(reader_.path() + ": grid '" + choice + "'", std::to_string(matches.size()) + " grids of that name",
                    "one of them must be chosen", "Say which: " + list_of(labels));
  }

  /// Refuses what cannot be a density; reads the grid otherwise.
  VdbGrid read_numbers(std::size_t i) {
    if (!is_number_grid(entry(i)))
      throw bad_input(where(i), kind(i), "a float or double fog volume expected", hint());
    if (headers_[i]->is_level_set())
      throw bad_input(where(i), kind(i), "a fog volume expected, not distances to a surface",
                      "Convert it to a fog volume first (OpenVDB's sdfToFogVolume). " + hint());
    headers_[i]->world_from_index();  // throws before the values are read
    if (entry(i).type == "double") note(i, "its doubles are read as floats");
    return reader_.read(i);
  }

  void finish(std::size_t i, StoredMedium& medium, const SizeField* sizes) {
    const VdbGrid grid = read_numbers(i);
    medium.world_from_index = grid.world_from_index();
    medium.grid = std::make_shared<const SparseGrid>(grid.sparse_grid(sizes));
    if (medium.grid->voxels().is_empty()) note(i, "it is 0 everywhere: nothing will be seen of it");
  }

  StoredMedium read_density(std::size_t i) {
    StoredMedium medium;
    medium.name = entry(i).label();
    finish(i, medium, nullptr);
    return medium;
  }

  StoredMedium read_species(std::size_t i) {
    const VdbGrid& header = *headers_[i];
    StoredMedium medium;
    medium.name = entry(i).name.substr(0, entry(i).name.size() - extinction_suffix.size());
    medium.is_species = true;
    medium.recipe = header.text("arcus_phase").value_or("");
    medium.phase_id = header.text("arcus_phase_id").value_or("");
    medium.size_um = header.number("arcus_size_um").value_or(0.f);
    if (const std::int32_t format = *header.integer("arcus_format"); format != 1)
      throw bad_input(where(i), "arcus_format = " + std::to_string(format), "format 1 expected",
                      "The file was made by a newer program");
    if (medium.recipe.empty())
      throw bad_input(where(i), "no arcus_phase in its metadata", "the recipe of its phase functions expected",
                      "Remove arcus_format from its metadata to use it as a plain density");
    if (!(medium.size_um >= 0) || !std::isfinite(medium.size_um))
      throw bad_input(where(i), "arcus_size_um = " + std::to_string(medium.size_um), "a size above 0 expected");

    // Sizes first, packed, so that never more than one of OpenVDB's trees is in memory.
    std::optional<SizeField> sizes;
    if (const auto size_grid = find_sizes(i, medium.name)) {
      const VdbGrid grid = read_numbers(*size_grid);
      if (!is_nearly(grid.world_from_index(), header.world_from_index()))
        throw bad_input(where(*size_grid), "another transform than that of '" + entry(i).name + "'",
                        "the grids of a species must share their transform");
      sizes.emplace(grid.size_field());
    }
    finish(i, medium, sizes ? &*sizes : nullptr);
    if (sizes) {
      const auto range = medium.grid->size_range();
      medium.smallest_size_um = range.smallest;
      medium.largest_size_um = range.largest;
    } else {
      medium.smallest_size_um = medium.largest_size_um = medium.size_um;
    }
    return medium;
  }

  std::optional<std::size_t> find_sizes(std::size_t extinction, const string& species) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < headers_.size(); ++i) {
      if (entry(i).name != species + string(size_suffix)) continue;
      if (found || !entry(extinction).is_unique)
        throw bad_input(where(extinction), "several grids '" + entry(i).name + "'", "one size grid for a species expected");
      found = i;
    }
    return found;
  }

  /// Equal to within a thousandth of a voxel near the origin.
  static bool is_nearly(const Affine& a, const Affine& b) {
    const Affine difference = b.inverse() * a;
    const Affine same;
    return length(difference.x - same.x) < 1e-5 && length(difference.y - same.y) < 1e-5 &&
           length(difference.z - same.z) < 1e-5 && length(difference.origin) < 1e-3;
  }

  VdbReader reader_;
  std::vector<std::optional<VdbGrid>> headers_;  // without values
  StoredMedia result_;
};

}  // namespace

StoredMedia read_media(const string& path, const string& choice) { return MediaReader(path).read(choice); }

}  // namespace arcus::media
