#pragma once
// Phase functions that somebody else computed or measured, as a table: what `type = "table"` names.

#include <string>
#include <vector>

#include "phase/population/scattering_table.h"

namespace arcus::phase {

struct TableFile {
  ScatteringTable table;
  std::vector<std::string> warnings;  ///< what a user should be told, with the file's name
};

/// Reads a table, known by its content:
///
/// - text: the columns angle [°] from 0 to 180 and value, linear between. Several columns of values are wavelengths, named in nm by a
///   first line such as `angle 450 550 650`. One size, albedo 1, the same extinction at all wavelengths. Whatever their
///   scale, values are divided by their integral over the sphere; one that is within 1 % of none of 1, 2π (∫ p dcos θ = 1) and 4π (mean 1) is
///   a warning;
/// - NetCDF written by this program (`arcus phase compute`);
/// - NetCDF written by libRadtran's mie: see read_libradtran_table.
///
/// Throws bad_input where it is none of these, with what is wrong and where.
TableFile read_table_file(const std::string& path);

/// Divides a row of p11 by its integral and the other elements with it, and sets the asymmetry. Returns the integral; throws bad_input
/// where it is not above 0. [angle] arrays at the table's nodes; `where` names the row.
double normalise_row(ScatteringTable& table, std::size_t row, const std::string& where);

}  // namespace arcus::phase
