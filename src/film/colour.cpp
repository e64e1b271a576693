#include "src/film/colour.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/base/quadrature.h"
#include "phase/base/vec3.h"
#include "phase/optics/refractive_index.h"
#include "src/data/embedded.h"

namespace arcus::render {
namespace {

constexpr std::size_t cells = 400;  // of 1 nm
static_assert(shortest_wavelength_nm == 380 && longest_wavelength_nm == 780);

/// (x, y, z, 0) at 380, 381, ... 780 nm: matching function over four times the density of the
/// wavelengths, linear between. Dividing before interpolating moves the matching functions between
/// the nodes by less than 3e-5 of their value ((cosh² kλ)''/cosh² / 8 with k = 0.0072/nm), and
/// saves four exponentials a sample. The functions so defined are used throughout, and normalised,
/// so that nothing is inconsistent.
using Rows = std::array<Spectrum, cells + 1>;

Spectrum row_at(const Rows& rows, double nm) {
  const double at = std::clamp(nm - shortest_wavelength_nm, 0.0, static_cast<double>(cells));
  const std::size_t k = std::min(static_cast<std::size_t>(at), cells - 1);
  return rows[k] + (rows[k + 1] - rows[k]) * static_cast<float>(at - static_cast<double>(k));
}

Xyz integrated(const Rows& rows, const std::function<double(double)>& spectrum) {
  static const Quadrature rule = gauss_legendre(4);
  Xyz sum;
  for (std::size_t k = 0; k < cells; ++k) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double nm = shortest_wavelength_nm + static_cast<double>(k) + 0.5 * (1 + rule.nodes[i]);
      const double weight =
          0.5 * rule.weights[i] * wavelength_count * wavelength_density_per_nm(nm) * spectrum(nm);
      const Spectrum row = row_at(rows, nm);
      sum += Xyz{row[0], row[1], row[2]} * weight;
    }
  }
  return sum;
}

Rows make_rows() {
  const std::string_view where = "cie_1931_2deg_xyz.csv";
  const Columns table = read_columns(data::cie_1931_2deg_xyz(), where);
  const std::vector<double>& air_nm = table.named("wavelength_nm");
  const Curve x(air_nm, table.named("xbar"), where), y(air_nm, table.named("ybar"), where),
      z(air_nm, table.named("zbar"), where);
  const auto filled = [&](double scale) {
    Rows rows;
    for (std::size_t k = 0; k <= cells; ++k) {
      const double nm = shortest_wavelength_nm + static_cast<double>(k);
      const double in_air = nm / phase::air_index(nm);
      const double factor = scale / (wavelength_count * wavelength_density_per_nm(nm));
      rows[k] =
          Spectrum(static_cast<float>(x(in_air) * factor), static_cast<float>(y(in_air) * factor),
                   static_cast<float>(z(in_air) * factor), 0);
    }
    return rows;
  };
  return filled(1 / integrated(filled(1), [](double) { return 1.0; }).y);
}

const Rows& matching_rows() {
  static const Rows rows = make_rows();
  return rows;
}

using Matrix = std::array<std::array<double, 3>, 3>;

Vec3 row(const Matrix& m, std::size_t i) { return {m[i][0], m[i][1], m[i][2]}; }
Vec3 operator*(const Matrix& m, const Vec3& v) {
  return {dot(row(m, 0), v), dot(row(m, 1), v), dot(row(m, 2), v)};
}

Matrix from_columns(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}};
}

Matrix operator*(const Matrix& a, const Matrix& b) {
  const auto column = [&](std::size_t j) { return a * Vec3(b[0][j], b[1][j], b[2][j]); };
  return from_columns(column(0), column(1), column(2));
}

Matrix inverse(const Matrix& m) {
  const Vec3 a = row(m, 0), b = row(m, 1), c = row(m, 2);
  const double determinant = dot(a, cross(b, c));
  return from_columns(cross(b, c) / determinant, cross(c, a) / determinant,
                      cross(a, b) / determinant);
}

Matrix diagonal(const Vec3& v) { return {{{v.x, 0, 0}, {0, v.y, 0}, {0, 0, v.z}}}; }

/// XYZ with Y = 1 of a chromaticity.
Vec3 of_chromaticity(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

/// White of Rec. ITU-R BT.709-6, item 1.4.
Vec3 rec709_white() { return of_chromaticity(0.3127, 0.3290); }

/// RGB to XYZ for the primaries of Rec. ITU-R BT.709-6, item 1.3; (1, 1, 1) is its white with Y
/// = 1.
Matrix rec709_primaries() {
  const Matrix primaries = from_columns(of_chromaticity(0.64, 0.33), of_chromaticity(0.30, 0.60),
                                        of_chromaticity(0.15, 0.06));
  return primaries * diagonal(inverse(primaries) * rec709_white());
}

/// XYZ to the cone responses of the Bradford adaptation (Lam 1985; as in ICC.1:2022, annex E).
constexpr Matrix bradford{
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

Xyz with_unit_y(const Xyz& c) { return c * (1 / c.y); }

}  // namespace

Xyz xyz_of_sample(const Spectrum& radiance, const Wavelengths& wavelengths) {
  typedef int Cells __attribute__((vector_size(16)));
  const Rows& rows = matching_rows();
  const Spectrum at = Spectrum(wavelengths[0], wavelengths[1], wavelengths[2], wavelengths[3]) -
                      Spectrum::filled(static_cast<float>(shortest_wavelength_nm));
  assert(at.min() > -0.01f && at.max() < static_cast<float>(cells) + 0.01f);
  constexpr int last_cell = static_cast<int>(cells) - 1;
  Cells cell = __builtin_convertvector(at.lanes, Cells);
  cell = cell < 0 ? Cells{} : cell > last_cell ? Cells{} + last_cell : cell;
  const Spectrum share = at - Spectrum(__builtin_convertvector(cell, Spectrum::Lanes));
  Spectrum sum;
  for (int i = 0; i < wavelength_count; ++i) {
    const Spectrum* row = rows.data() + cell[i];
    sum += (row[0] + (row[1] - row[0]) * share[i]) * radiance[i];
  }
  return {sum[0], sum[1], sum[2]};
}

Xyz xyz_of(const std::function<double(double)>& spectrum) {
  return integrated(matching_rows(), spectrum);
}

ToRgb to_rgb_from_white(const Xyz& white) {
  const Vec3 from = bradford * (Vec3(white.x, white.y, white.z) / white.y);
  if (!(white.y > 0) || !(std::min({from.x, from.y, from.z}) > 0))
    throw bad_input("film.white",
                    "a white of XYZ (" + std::to_string(white.x) + ", " + std::to_string(white.y) +
                        ", " + std::to_string(white.z) + ")",
                    "a colour that an eye can adapt to expected",
                    "Choose film.white = \"equal_energy\"");
  const Vec3 to = bradford * rec709_white();
  const Matrix adaptation =
      inverse(bradford) * diagonal(Vec3(to.x / from.x, to.y / from.y, to.z / from.z)) * bradford;
  return {inverse(rec709_primaries()) * adaptation};
}

Xyz equal_energy_white() {
  return xyz_of([](double) { return 1.0; });
}

Xyz d65_white() {
  const Columns table = read_columns(data::cie_d65(), "cie_d65.csv");
  const Curve d65(table.named("wavelength_nm"), table.named("s_d65"), "cie_d65.csv");
  return with_unit_y(xyz_of([&](double nm) { return d65(nm / phase::air_index(nm)); }));
}

Xyz planck_white(double temperature_k) {
  constexpr double second_radiation_constant_nm_k = 1.438776877e7;  // hc/k, CODATA 2018
  return with_unit_y(xyz_of([&](double nm) {
    const double at_560 = std::expm1(second_radiation_constant_nm_k / (560 * temperature_k));
    return std::pow(560 / nm, 5) * at_560 /
           std::expm1(second_radiation_constant_nm_k / (nm * temperature_k));
  }));
}

Xyz white_of(const std::string& setting, const Xyz& sun) {
  if (setting == "auto") return sun.y > 0 ? sun : equal_energy_white();
  if (setting == "D65") return d65_white();
  if (setting == "equal_energy") return equal_energy_white();
  double temperature_k = 0;
  const char* end = setting.data() + setting.size();
  const auto [stop, fault] = std::from_chars(setting.data(), end, temperature_k);
  if (fault != std::errc() || stop != end || !(temperature_k >= 1000 && temperature_k <= 1e5))
    throw bad_input("film.white", "'" + setting + "'",
                    "auto, D65, equal_energy or a temperature from 1000 to 100000 K expected");
  return planck_white(temperature_k);
}

}  // namespace arcus::render
