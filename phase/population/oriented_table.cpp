#include "phase/population/oriented_table.h"

#include <algorithm>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

void check_axis(const std::vector<double>& axis, const std::string& where, double low, double high) {
  if (axis.empty()) throw bad_input(where, "no node", "at least one expected");
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (!(axis[i] >= low && axis[i] <= high))
      throw bad_input(where, number_text(axis[i]), "must be between " + number_text(low) + " and " + number_text(high));
    if (i > 0 && !(axis[i] > axis[i - 1]))
      throw bad_input(where, number_text(axis[i]) + " after " + number_text(axis[i - 1]), "must be ascending");
  }
}

void check_whole_axis(const std::vector<double>& axis, const std::string& where, double low, double high) {
  check_axis(axis, where, low, high);
  if (axis.front() != low || axis.back() != high)
    throw bad_input(where, number_text(axis.front()) + " to " + number_text(axis.back()),
                    "must reach from " + number_text(low) + " to " + number_text(high));
}

void check_number(double value, const std::string& where, double low, double high) {
  if (!(value >= low && value <= high))
    throw bad_input(where, number_text(value), "must be between " + number_text(low) + " and " + number_text(high));
}

template <class Number>
void check_values(const std::vector<Number>& values, std::size_t count, double low, double high, const std::string& where) {
  if (values.size() != count)
    throw bad_input(where, std::to_string(values.size()) + " values", std::to_string(count) + " expected");
  for (const Number value : values) check_number(static_cast<double>(value), where, low, high);
}

}  // namespace

void check_table(const OrientedTable& t, const std::string& where) {
  check_axis(t.size_um, where + ": size_um", 1e-6, 1e9);
  check_axis(t.wavelength_nm, where + ": wavelength_nm", 1e-3, 1e9);
  check_whole_axis(t.sine_elevation, where + ": sine_elevation", 0, 1);
  check_whole_axis(t.elevation_deg, where + ": elevation_deg", -90, 90);
  check_whole_axis(t.azimuth_deg, where + ": azimuth_deg", 0, 180);
  check_number(t.sun_elevation_deg, where + ": sun_elevation_deg", -90, 90);
  check_number(t.sun_angular_radius_deg, where + ": sun_angular_radius_deg", 0, 45);
  const std::size_t rows = t.size_um.size() * t.wavelength_nm.size();
  const std::size_t cells = t.size_um.size() * t.elevation_deg.size() * t.azimuth_deg.size();
  check_values(t.extinction_cross_section_m2, rows * t.sine_elevation.size(), 0, 1, where + ": extinction_cross_section");
  check_values(t.forward_fraction, rows * t.sine_elevation.size(), 0, 0.999999, where + ": forward_fraction");
  check_values(t.mean_extinction_cross_section_m2, rows, 1e-300, 1, where + ": mean_extinction_cross_section");
  check_values(t.albedo, rows, 0, 1, where + ": albedo");
  check_values(t.scattering_m2_per_sr, cells * t.wavelength_nm.size(), 0, 1e30, where + ": scattering");
  check_values(t.relative_error, cells, 0, 1e30, where + ": relative_error");
}

}  // namespace arcus::phase
