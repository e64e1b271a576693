#include "media/author/lwc_file.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"

namespace arcus::media {
namespace {

constexpr double metres_a_km = 1000;

/// The lines of the header, one after the other.
class Header {
 public:
  Header(std::string_view text, std::string path) : rest_(text), path_(std::move(path)) {}

  std::string_view rest() const { return rest_; }
  int line() const { return line_; }
  std::string place() const { return path_ + ":" + std::to_string(line_); }

  std::string_view next(const std::string& expected) {
    if (rest_.empty()) throw bad_input(place(), "the end of the file", expected + " expected", "It may have been cut short");
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return line;
  }
  /// At least `least` numbers, from as many lines as it takes.
  std::vector<double> numbers(std::size_t least, const std::string& expected) {
    std::vector<double> values;
    while (values.size() < least) {
      const std::string_view line = next(expected);
      if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
      const Columns columns = read_columns(line, path_, line_);
      for (const auto& column : columns.columns) values.push_back(column[0]);
    }
    return values;
  }

 private:
  std::string_view rest_;
  std::string path_;
  int line_ = 0;
};

struct Form {
  bool is_csv = false;      // AT3D's: no line of temperatures
  bool with_radius = true;
};

Form form_of(Header& header) {
  std::string_view first = header.next("the kind of the file");
  first.remove_prefix(std::min(first.find_first_not_of(" \t"), first.size()));
  if (first.starts_with('#')) return {true, true};
  if (first.starts_with('1')) return {false, false};
  if (first.starts_with('2')) return {false, true};
  if (first.starts_with('3'))
    throw bad_input(header.place(), "a file of several kinds of particles (form 3)", "liquid water alone expected",
                    "Write the water as a 2 parameter LWC file: ix iy iz LWC Reff");
  throw bad_input(header.place(), "'" + std::string(first.substr(0, 40)) + "'",
                  "the number 1 or 2 that opens an LWC file of SHDOM, or the comment that opens one of AT3D, expected");
}

int whole(double value, const std::string& where, const std::string& what, double low, double high) {
  if (value != std::round(value) || value < low || value > high)
    throw bad_input(where, what + " " + number_text(value), "a whole number from " + number_text(low) + " to " + number_text(high) + " expected");
  return static_cast<int>(value);
}

void check_levels(const std::vector<double>& z, const std::string& where) {
  for (std::size_t k = 1; k < z.size(); ++k)
    if (!(z[k] > z[k - 1]))
      throw bad_input(where, number_text(z[k]) + " km after " + number_text(z[k - 1]) + " km", "ascending heights expected");
}

WaterField lattice_of(Header& header, const std::string& path, bool is_csv) {
  WaterField field;
  field.where = path;
  const std::vector<double> counts = header.numbers(3, "the numbers of points along x, y and z");
  if (counts.size() != 3) throw bad_input(header.place(), std::to_string(counts.size()) + " numbers", "three expected: points along x, y and z");
  field.count = {whole(counts[0], header.place(), "nx =", 1, 1e6), whole(counts[1], header.place(), "ny =", 1, 1e6),
                 whole(counts[2], header.place(), "nz =", 1, 1e6)};
  if (const double total = counts[0] * counts[1] * counts[2]; total > 2e9)
    throw bad_input(header.place(), number_text(total) + " cells", "at most 2e9 expected");
  const std::vector<double> steps = header.numbers(2, "the steps along x and y in km");
  if (steps.size() != 2 || !(steps[0] > 0) || !(steps[1] > 0))
    throw bad_input(header.place(), "something else", "two steps above 0 expected, along x and y, in km");
  field.step_x_m = metres_a_km * steps[0];
  field.step_y_m = metres_a_km * steps[1];

  const auto n = static_cast<std::size_t>(field.count.z);
  std::vector<double> z = header.numbers(n, "heights in km");
  if (z.size() != n && z.size() != n + 1)
    throw bad_input(header.place(), std::to_string(z.size()) + " heights",
                    std::to_string(n) + " (of points) or " + std::to_string(n + 1) + " (bounds of cells) expected");
  check_levels(z, header.place());
  for (double& height : z) height *= metres_a_km;
  if (z.size() == n + 1) {
    field.level_m = z;
    field.first_x_m = 0.5 * field.step_x_m;
    field.first_y_m = 0.5 * field.step_y_m;
  } else {
    field.level_m = bounds_between(z, std::min(field.step_x_m, field.step_y_m));
  }
  if (!is_csv) header.numbers(z.size(), "temperatures in K");
  return field;
}

}  // namespace

WaterField read_lwc_file(const std::string& path) {
  const std::string text = read_text_file(path);
  Header header(text, path);
  const Form form = form_of(header);
  WaterField field = lattice_of(header, path, form.is_csv);
  const int first_line = header.line() + 1;
  const Columns rows = read_columns(header.rest(), path, first_line);
  const std::size_t width = form.with_radius ? 5 : 4;
  if (rows.columns.size() != width)
    throw bad_input(path + ":" + std::to_string(first_line), std::to_string(rows.columns.size()) + " columns",
                    form.with_radius ? "five expected: ix iy iz LWC Reff" : "four expected: ix iy iz LWC");
  const std::size_t total = static_cast<std::size_t>(field.count.x) * static_cast<std::size_t>(field.count.y) * static_cast<std::size_t>(field.count.z);
  field.water_g_per_m3.resize(total);
  if (form.with_radius) field.radius_um.resize(total);
  std::vector<bool> is_given(total);
  for (std::size_t row = 0; row < rows.columns[0].size(); ++row) {
    const auto index = [&](std::size_t axis, const char* name, int count) {
      return whole(rows.columns[axis][row], path + ": row " + std::to_string(row + 1), name, 1, count) - 1;
    };
    const std::size_t at = field.place({index(0, "ix =", field.count.x), index(1, "iy =", field.count.y), index(2, "iz =", field.count.z)});
    if (is_given[at]) throw bad_input(path + ": row " + std::to_string(row + 1), "another line for a cell that has one", "one line for each cell expected");
    is_given[at] = true;
    field.water_g_per_m3[at] = static_cast<float>(rows.columns[3][row]);
    if (form.with_radius) field.radius_um[at] = static_cast<float>(rows.columns[4][row]);
  }
  return field;
}

}  // namespace arcus::media
