#include "phase/population/scattering_table.h"

#include <algorithm>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

void check_axis(const std::vector<double>& axis, const std::string& where, double low, double high) {
  if (axis.empty()) throw bad_input(where, "no node", "at least one expected");
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (!(axis[i] >= low && axis[i] <= high))
      throw bad_input(where, number_text(axis[i]),
                      "must be between " + number_text(low) + " and " + number_text(high));
    if (i > 0 && !(axis[i] > axis[i - 1]))
      throw bad_input(where, number_text(axis[i]) + " after " + number_text(axis[i - 1]), "must be ascending");
  }
}

template <class Number>
void check_values(const std::vector<Number>& values, std::size_t count, double low, double high,
                  const std::string& where) {
  if (values.size() != count)
    throw bad_input(where, std::to_string(values.size()) + " values", std::to_string(count) + " expected");
  const auto wrong = std::find_if(values.begin(), values.end(), [=](Number x) { return !(x >= low && x <= high); });
  if (wrong != values.end())
    throw bad_input(where, number_text(static_cast<double>(*wrong)),
                    "must be between " + number_text(low) + " and " + number_text(high));
}

/// Sum over the intervals of the integral of a linear function times (a + b s).
double integral(const std::vector<double>& angle_deg, const float* p, double a, double b) {
  double sum = 0, s0 = sin2_half_deg(angle_deg[0]);
  for (std::size_t i = 1; i < angle_deg.size(); ++i) {
    const double s1 = sin2_half_deg(angle_deg[i]), width = s1 - s0;
    const double p0 = p[i - 1], p1 = p[i];
    sum += width * (0.5 * a * (p0 + p1) + b * (p0 * (2 * s0 + s1) + p1 * (s0 + 2 * s1)) / 6);
    s0 = s1;
  }
  return 4 * pi * sum;
}

}  // namespace

double sphere_integral(const std::vector<double>& angle_deg, const float* values) {
  return integral(angle_deg, values, 1, 0);
}

double sphere_integral_of_cosine(const std::vector<double>& angle_deg, const float* values) {
  return integral(angle_deg, values, 1, -2);  // cos θ = 1 − 2 s
}

void check_table(const ScatteringTable& t, const std::string& where) {
  check_axis(t.size_um, where + ": size_um", 1e-6, 1e9);
  check_axis(t.wavelength_nm, where + ": wavelength_nm", 1e-3, 1e9);
  check_axis(t.scattering_angle_deg, where + ": scattering_angle_deg", 0, 180);
  if (t.scattering_angle_deg.front() != 0 || t.scattering_angle_deg.back() != 180)
    throw bad_input(where + ": scattering_angle_deg",
                    number_text(t.scattering_angle_deg.front()) + " to " + number_text(t.scattering_angle_deg.back()),
                    "must reach from 0 to 180");
  const std::size_t rows = t.size_um.size() * t.wavelength_nm.size(), angles = t.scattering_angle_deg.size();
  check_values(t.extinction_cross_section_m2, rows, 1e-300, 1, where + ": extinction_cross_section");
  check_values(t.scattering_cross_section_m2, rows, 1e-300, 1, where + ": scattering_cross_section");
  check_values(t.asymmetry, rows, -1, 1, where + ": asymmetry");
  check_values(t.forward_fraction, rows, 0, 0.999, where + ": forward_fraction");
  constexpr double most = 1e30;
  check_values(t.p11, rows * angles, 0, most, where + ": P11");
  check_values(t.p12, rows * angles, -most, most, where + ": P12");
  check_values(t.p33, rows * angles, -most, most, where + ": P33");
  check_values(t.p34, rows * angles, -most, most, where + ": P34");
  for (std::size_t row = 0; row < rows; ++row) {
    const double whole = sphere_integral(t.scattering_angle_deg, &t.p11[row * angles]);
    if (!(whole > 1 - 1e-4 && whole < 1 + 1e-4))
      throw bad_input(where + ": P11", "an integral over the sphere of " + number_text(whole), "must be 1");
  }
}

}  // namespace arcus::phase
