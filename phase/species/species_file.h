#pragma once
// A scattering table as a NetCDF-4 file that other programs open: CF units and names, the recipe and its id as
// attributes.

#include <string>

#include "phase/population/scattering_table.h"

namespace arcus::phase {

struct SpeciesFile {
  ScatteringTable table;
  std::string recipe;           ///< canonical TOML
  std::string recipe_id;        ///< hash of the recipe and of the optical constants
  std::string program_version;  ///< of the program that made the file; written by write_species_file itself
};

/// Writes the whole file or none. Throws cannot() where it cannot be written.
void write_species_file(const std::string& path, const SpeciesFile& file);

/// Reads a file that write_species_file wrote and checks it: a seal over all its bytes, dimensions, ascending axes, finite
/// values, integrals. Throws bad_input where it is missing, no such table, or not as it was written.
SpeciesFile read_species_file(const std::string& path);

}  // namespace arcus::phase
