#include "tests/phase/function/synthetic_drops.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {

namespace {

constexpr double first_z = -6, steps_per_z = 256;

/// Ai² of −z: rises from the dark side z < 0, oscillates for z > 0. From y'' = −z y by Runge and
/// Kutta, the direction in which the solution is stable.
std::vector<double> airy_squares(double last_z) {
  double y = 9.94769436025e-6, slope = 2.47652003e-5;  // Ai(6), −Ai'(6): Abramowitz & Stegun 10.4
  const double h = 1 / steps_per_z;
  std::vector<double> squares;
  for (double z = first_z; z <= last_z; z += h) {
    squares.push_back(y * y);
    const double k1 = slope, l1 = -z * y;
    const double k2 = slope + h / 2 * l1, l2 = -(z + h / 2) * (y + h / 2 * k1);
    const double k3 = slope + h / 2 * l2, l3 = -(z + h / 2) * (y + h / 2 * k2);
    const double k4 = slope + h * l3, l4 = -(z + h) * (y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    slope += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
  }
  return squares;
}

}  // namespace

SyntheticDrops::SyntheticDrops(double size_um) : size_um_(size_um) {
  airy_squared_ = airy_squares(30);
  // Drops of many sizes (an effective variance near 0.01) leave only the first few oscillations;
  // far away 1/(2π√z) remains.
  for (std::size_t i = 0; i < airy_squared_.size(); ++i) {
    const double z = first_z + static_cast<double>(i) / steps_per_z;
    if (z < 1) continue;
    const double mean = 1 / (2 * pi * std::sqrt(z)), left = std::exp(-std::pow((z - 1) / 4, 2));
    airy_squared_[i] = mean + left * (airy_squared_[i] - mean);
  }
}

double SyntheticDrops::airy(double z) const {
  const double position = (z - first_z) * steps_per_z;
  if (position < 0) return 0;
  const auto i = static_cast<std::size_t>(position);
  if (i + 1 >= airy_squared_.size()) return 1 / (2 * pi * std::sqrt(z));
  const double share = position - static_cast<double>(i);
  return airy_squared_[i] + share * (airy_squared_[i + 1] - airy_squared_[i]);
}

double SyntheticDrops::index(double wavelength_nm) {
  return 1.324 + 3100 / (wavelength_nm * wavelength_nm);
}

double SyntheticDrops::bow_deg(double wavelength_nm, int reflections) {
  const double n = index(wavelength_nm), p = reflections + 1;
  const double incidence = std::acos(std::sqrt((n * n - 1) / (p * p - 1)));
  const double refraction = std::asin(std::sin(incidence) / n);
  const double deviation = 2 * (incidence - refraction) + reflections * (pi - 2 * refraction);
  return degrees(reflections == 1 ? deviation : 2 * pi - deviation);
}

double SyntheticDrops::shape(double angle_deg, double wavelength_nm) const {
  const double x = 2 * pi * size_um_ / um_from_nm(wavelength_nm), angle = radians(angle_deg);
  const double units = std::pow(x, 2.0 / 3) / 1.7;  // Airy's, per radian
  const double lobe = x * x / (8 * pi) / std::pow(1 + 0.3 * std::pow(x * angle, 2), 1.5);
  const double first = airy(units * radians(angle_deg - bow_deg(wavelength_nm, 1)));
  const double second = airy(units / 1.78 * radians(bow_deg(wavelength_nm, 2) - angle_deg));
  const double ring = x * (pi - angle);
  const double glory =
      ring < 40 ? std::exp(-std::pow(ring / 8, 2)) * std::pow(std::cyl_bessel_j(0, ring), 2) : 0;
  const double bright = 0.03 * std::cbrt(x);
  return lobe + 0.1 * std::exp(-4 * angle) + 0.0012 + bright * first + 0.35 * bright * second +
         0.05 * glory;
}

std::vector<double> synthetic_angles_deg(int every) {
  std::vector<double> angles;
  const auto add = [&](double from, double to, double step) {
    const int count = static_cast<int>(std::lround((to - from) / step));
    for (int i = 0; i < count; ++i) angles.push_back(from + step * i);
  };
  add(0, 0.1, 0.001);
  add(0.1, 1, 0.005);
  add(1, 5, 0.02);
  add(5, 110, 0.15);
  add(110, 124, 0.025);
  add(124, 131, 0.01);
  add(131, 136, 0.05);
  add(136, 143, 0.007);
  add(143, 150, 0.025);
  add(150, 175, 0.05);
  add(175, 179.5, 0.02);
  add(179.5, 180, 0.001);
  std::vector<double> chosen;
  for (std::size_t i = 0; i < angles.size(); i += every) chosen.push_back(angles[i]);
  // The table's forward angle stays a node.
  chosen.insert(std::lower_bound(chosen.begin(), chosen.end(), 1.0), 1.0);
  chosen.push_back(180);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

std::vector<double> synthetic_row(const SyntheticDrops& drops, double wavelength_nm,
                                  const std::vector<double>& angle_deg) {
  std::vector<double> row;
  for (const double angle : angle_deg) row.push_back(drops.shape(angle, wavelength_nm));
  const double whole = integral_over_sphere(angle_deg, row);
  for (double& value : row) value /= whole;
  return row;
}

ScatteringTable synthetic_table(const std::vector<double>& size_um,
                                const std::vector<double>& wavelength_nm, int every) {
  ScatteringTable table;
  table.size_um = size_um;
  table.wavelength_nm = wavelength_nm;
  table.scattering_angle_deg = synthetic_angles_deg(every);
  table.forward_angle_deg = 1;
  for (const double size : size_um) {
    const SyntheticDrops drops(size);
    for (const double wavelength : wavelength_nm) {
      const auto row = synthetic_row(drops, wavelength, table.scattering_angle_deg);
      table.p11.insert(table.p11.end(), row.begin(), row.end());
      const double area = pi * std::pow(m_from_um(size), 2);
      table.extinction_cross_section_m2.push_back(2 * area);
      table.scattering_cross_section_m2.push_back(2 * area);
      table.asymmetry.push_back(mean_cosine(table.scattering_angle_deg, row));
      // As for real drops: the lobe is removed where it is narrower than the sun.
      auto clipped = row;
      clip_forward(table.scattering_angle_deg, table.forward_angle_deg, clipped.data());
      table.forward_fraction.push_back(
          size < 50 ? 0 : 1 - integral_over_sphere(table.scattering_angle_deg, clipped));
    }
  }
  table.p12.resize(table.p11.size());
  table.p33.resize(table.p11.size());
  table.p34.resize(table.p11.size());
  return table;
}

std::vector<double> wavelengths_nm(double first, double last, double step) {
  std::vector<double> result;
  const int count = static_cast<int>(std::lround((last - first) / step));
  for (int i = 0; i <= count; ++i) result.push_back(first + (last - first) * i / count);
  return result;
}

ScatteringTable isotropic_table() {
  ScatteringTable table;
  table.size_um = {10};
  table.wavelength_nm = {400, 600};
  table.scattering_angle_deg = {0, 0.1, 40, 90, 179.9, 180};
  table.p11.assign(2 * table.scattering_angle_deg.size(), static_cast<float>(1 / (4 * pi)));
  table.extinction_cross_section_m2 = table.scattering_cross_section_m2 = {1e-10, 1e-10};
  table.asymmetry = table.forward_fraction = {0, 0};
  return table;
}

double integral_over_sphere(const std::vector<double>& angle_deg,
                            const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
    sum += 2 * pi * (values[i] + values[i + 1]) *
           (std::cos(radians(angle_deg[i])) - std::cos(radians(angle_deg[i + 1]))) / 2;
  return sum;
}

double mean_cosine(const std::vector<double>& angle_deg, const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double a = std::cos(radians(angle_deg[i])), b = std::cos(radians(angle_deg[i + 1]));
    sum += 2 * pi * (a - b) * (a * (2 * values[i] + values[i + 1]) + b * (values[i] + 2 * values[i + 1])) / 6;
  }
  return sum;
}

}  // namespace arcus::phase
