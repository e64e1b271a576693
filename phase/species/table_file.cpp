#include "phase/species/table_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/base/netcdf_file.h"
#include "phase/settings/number_text.h"
#include "phase/species/libradtran_table.h"
#include "phase/species/species_file.h"

namespace arcus::phase {
namespace {

/// Angles between two rows such that what is linear in angle is followed by what is linear in s = sin²(θ/2) within
/// 1e-4 of the larger value in every column: the rows' step is halved while the curves differ by more.
void add_between(double a_deg, double b_deg, const std::vector<double>& a, const std::vector<double>& b, std::vector<double>& angles) {
  const double middle = 0.5 * (a_deg + b_deg);
  const double s0 = sin2_half_deg(a_deg), s1 = sin2_half_deg(b_deg);
  const double t = (sin2_half_deg(middle) - s0) / (s1 - s0);
  bool is_near = true;
  std::vector<double> value(a.size());
  for (std::size_t c = 0; c < a.size(); ++c) {
    value[c] = 0.5 * (a[c] + b[c]);
    is_near = is_near && std::fabs((t - 0.5) * (b[c] - a[c])) <= 1e-4 * std::max(a[c], b[c]);
  }
  if (is_near || b_deg - a_deg < 1e-4) return;
  add_between(a_deg, middle, a, value, angles);
  angles.push_back(middle);
  add_between(middle, b_deg, value, b, angles);
}

/// Wavelengths from the names of the columns: "550", "550nm", "550_nm".
std::vector<double> wavelengths_of(const Columns& columns, const std::string& path) {
  const std::size_t count = columns.columns.size() - 1;
  if (count == 1) return {550};
  const std::string how = "a first line of names expected: angle, then the wavelengths in nm";
  if (columns.names.empty()) throw bad_input(path, std::to_string(count + 1) + " columns without names", how, "Two columns need none");
  std::vector<double> nm;
  for (std::size_t c = 1; c <= count; ++c) {
    const std::string& name = columns.names[c];
    double value = 0;
    const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), value);
    const std::string_view rest(end, static_cast<std::size_t>(name.data() + name.size() - end));
    if (fault != std::errc() || !(value >= 100 && value <= 1e5) || (!rest.empty() && rest != "nm" && rest != "_nm"))
      throw bad_input(path, "the column name '" + name + "'", how);
    if (!nm.empty() && !(value > nm.back()))
      throw bad_input(path, number_text(value) + " nm after " + number_text(nm.back()) + " nm", "ascending wavelengths expected");
    nm.push_back(value);
  }
  return nm;
}

bool is_usual(double integral) {
  for (const double usual : {1.0, 2 * pi, 4 * pi})
    if (std::fabs(integral / usual - 1) <= 0.01) return true;
  return false;
}

TableFile table_of_columns(const std::string& path) {
  const Columns columns = read_columns_file(path);
  if (columns.columns.size() < 2)
    throw bad_input(path, "one column", "two expected: angle in degrees, value; more values for more wavelengths");
  const std::vector<double>& angle = columns.columns[0];
  TableFile file;
  ScatteringTable& t = file.table;
  t.size_um = {1};
  t.wavelength_nm = wavelengths_of(columns, path);
  std::vector<Curve> curves;
  for (std::size_t c = 1; c < columns.columns.size(); ++c) {
    curves.emplace_back(angle, columns.columns[c], path);
    if (const double least = *std::min_element(columns.columns[c].begin(), columns.columns[c].end()); least < 0)
      throw bad_input(path, "the value " + number_text(least), "must be at least 0");
  }
  if (angle.front() != 0 || angle.back() != 180)
    throw bad_input(path, "angles from " + number_text(angle.front()) + " to " + number_text(angle.back()),
                    "must reach from 0 to 180 degrees");
  const auto values_at = [&](std::size_t row) {
    std::vector<double> values;
    for (std::size_t c = 1; c < columns.columns.size(); ++c) values.push_back(columns.columns[c][row]);
    return values;
  };
  for (std::size_t i = 0; i < angle.size(); ++i) {
    if (i > 0) add_between(angle[i - 1], angle[i], values_at(i - 1), values_at(i), t.scattering_angle_deg);
    t.scattering_angle_deg.push_back(angle[i]);
  }
  const std::size_t rows = curves.size(), count = rows * t.scattering_angle_deg.size();
  std::vector<double> scale;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::vector<double>& values = columns.columns[row + 1];
    scale.push_back(*std::max_element(values.begin(), values.end()));
    for (const double deg : t.scattering_angle_deg) t.p11.push_back(static_cast<float>(scale[row] > 0 ? curves[row](deg) / scale[row] : 0));
  }
  t.p12.assign(count, 0);
  t.p33 = t.p34 = t.p12;
  // Scattering alone is known; as for the closed forms, albedo 1.
  t.extinction_cross_section_m2.assign(rows, 1);
  t.scattering_cross_section_m2 = t.extinction_cross_section_m2;
  t.asymmetry.assign(rows, 0);
  t.forward_fraction.assign(rows, 0);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::string column = rows == 1 ? path : path + ": column '" + columns.names[row + 1] + "'";
    const double whole = normalise_row(t, row, column) * scale[row];
    char words[40];
    std::snprintf(words, sizeof words, "%.4g", whole);
    if (!is_usual(whole))
      file.warnings.push_back(column + ": its integral over the sphere is " + words + ", not 1, 2 pi or 4 pi: only its shape is used");
  }
  return file;
}

std::string first_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(4, ' ');
  file.read(bytes.data(), 4);
  return bytes;
}

}  // namespace

double normalise_row(ScatteringTable& t, std::size_t row, const std::string& where) {
  const std::size_t count = t.scattering_angle_deg.size(), first = row * count;
  const double whole = sphere_integral(t.scattering_angle_deg, &t.p11[first]);
  if (!(whole > 0)) throw bad_input(where, "zero everywhere", "a phase function expected");
  for (std::vector<float>* element : {&t.p11, &t.p12, &t.p33, &t.p34})
    for (std::size_t i = first; i < first + count; ++i) (*element)[i] = static_cast<float>((*element)[i] / whole);
  t.asymmetry[row] = std::clamp(sphere_integral_of_cosine(t.scattering_angle_deg, &t.p11[first]), -1.0, 1.0);
  return whole;
}

TableFile read_table_file(const std::string& path) {
  const std::string head = first_bytes(path);
  if (!head.starts_with("CDF") && head != "\x89HDF") return table_of_columns(path);
  bool is_own = false, is_libradtran = false;
  {
    const NetcdfFile file(path);
    is_own = file.number(nullptr, "arcus_format").has_value();
    is_libradtran = is_libradtran_table(file);
    if (!is_own && !is_libradtran)
      throw bad_input(path, "the variables " + file.all_variables(),
                      "a phase table of arcus phase compute, or of libRadtran's mie (wavelen, reff, theta, phase ...), expected");
  }
  if (is_own) return {read_species_file(path).table, {}};
  return read_libradtran_table(path);
}

}  // namespace arcus::phase
