#pragma once
// A table of oriented crystals as a NetCDF-4 file that other programs open, and how to come by one.

#include <string>

#include "phase/crystal/path_filter.h"
#include "phase/population/oriented_table.h"
#include "phase/species/make_species.h"

namespace arcus::phase {

struct OrientedFile {
  OrientedTable table;
  std::string recipe;           ///< canonical TOML
  std::string id;               ///< oriented_table_id
  std::string program_version;  ///< of the program that made the file; written by write_oriented_file itself
};

/// Writes the whole file or none, compressed without loss. Throws cannot() where it cannot be written.
void write_oriented_file(const std::string& path, const OrientedFile& file);

/// Reads a file that write_oriented_file wrote and checks it. Throws bad_input where it is missing, no such table, or not as it
/// was written.
OrientedFile read_oriented_file(const std::string& path);

/// Whether a file holds such a table; throws bad_input where it is missing or not as it was written.
bool is_oriented_file(const std::string& path);

/// 32 hexadecimal digits that name the table of a recipe under a sun or moon; the radius is that of its disc. paths: the light in the map.
std::string oriented_table_id(const Recipe& recipe, double sun_elevation_deg, double sun_angular_radius_deg,
                              const PathFilter& paths = {}, DiscKind disc = DiscKind::limb_darkened);

/// The table of a recipe of crystals: from the cache of options, or computed and kept. The disc's place and radius are what the arguments say,
/// whatever the options have; its kind is that of the options. Crystals that lie at random are as good as others. Throws bad_input for other recipes
/// and for an elevation outside of -90 to 90.
OrientedTable oriented_table_of(const Recipe& recipe, double sun_elevation_deg, double sun_angular_radius_deg,
                                const SpeciesOptions& options, const PathFilter& paths = {});

}  // namespace arcus::phase
