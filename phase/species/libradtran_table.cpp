#include "phase/species/libradtran_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/base/wavelengths.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

using Variable = NetcdfFile::Variable;
constexpr double nm_a_um = 1e3;
constexpr std::size_t most_values = 200'000'000;

/// The places of values in ascending order.
std::vector<std::size_t> ascending(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

/// One element of the matrix at one wavelength and size, over s.
struct Element {
  std::vector<double> angle_deg, value;
};

class Reader {
 public:
  explicit Reader(const std::string& path) : file_(path) {
    if (!file_.find("reff"))
      throw bad_input(path, "no variable 'reff'" + std::string(file_.find("hum") ? " but 'hum'" : ""), "a table by effective radius expected",
                      "Tables of aerosol by humidity are not read");
    wavelength_um_ = file_.read<double>(with_rank("wavelen", 1));
    reff_um_ = file_.read<double>(with_rank("reff", 1));
    const Variable& phase = with_rank("phase", 4);
    elements_ = file_.dimensions()[phase.dimensions[2]].length;
    most_angles_ = file_.dimensions()[phase.dimensions[3]].length;
    theta_ = file_.read<float>(with_rank("theta", 4));
    phase_ = file_.read<float>(phase);
    angles_ = file_.read<double>(with_rank("ntheta", 3));
    extinction_ = file_.read<double>(with_rank("ext", 2));
    albedo_ = file_.read<double>(with_rank("ssa", 2));
    check_lengths();
  }

  TableFile read() {
    ScatteringTable& t = result_.table;
    const auto sizes = ascending(reff_um_), wavelengths = visible(ascending(wavelength_um_));
    for (const std::size_t r : sizes) t.size_um.push_back(reff_um_[r]);
    for (const std::size_t w : wavelengths) t.wavelength_nm.push_back(nm_a_um * wavelength_um_[w]);
    collect_angles(wavelengths);
    const std::size_t count = t.size_um.size() * t.wavelength_nm.size() * t.scattering_angle_deg.size();
    if (count > most_values)
      throw bad_input(file_.path(), number_text(static_cast<double>(count)) + " values once all angles are put together", "at most 2e8 expected",
                      "Make the table with fewer sizes or wavelengths");
    for (const std::size_t r : sizes)
      for (const std::size_t w : wavelengths) add_row(w, r);
    check_table(t, file_.path());
    if (worst_ > 0.01)
      result_.warnings.push_back(file_.path() + ": integrals over the sphere are off by up to " + number_text(std::round(1000 * worst_) / 10) + " % (" + worst_row_ +
                                 "); normalised");
    return std::move(result_);
  }

 private:
  const Variable& with_rank(const char* name, std::size_t rank) const {
    const Variable& variable = file_.get(name, "libRadtran's mie");
    if (variable.dimensions.size() != rank)
      throw bad_input(file_.where(variable), std::to_string(variable.dimensions.size()) + " dimensions", std::to_string(rank) + " expected");
    return variable;
  }
  void check_lengths() const {
    const std::size_t rows = wavelength_um_.size() * reff_um_.size();
    if (rows == 0 || elements_ == 0 || phase_.size() != rows * elements_ * most_angles_ || theta_.size() != phase_.size() ||
        angles_.size() != rows * elements_ || extinction_.size() != rows || albedo_.size() != rows)
      throw bad_input(file_.path(), "variables of other lengths than nlam, nreff, nphamat and nthetamax say", "a table as libRadtran's mie writes it expected");
  }
  std::string row_words(std::size_t w, std::size_t r) const {
    return number_text(static_cast<float>(nm_a_um * wavelength_um_[w])) + " nm, " + number_text(static_cast<float>(reff_um_[r])) + " um";
  }

  /// Ascending in angle; ends within a hundredth of a degree of 0 and 180 count as these.
  Element element(std::size_t w, std::size_t r, std::size_t e) const {
    const std::size_t place = (w * reff_um_.size() + r) * elements_ + e;
    const double n = angles_[place];
    const std::string where = file_.path() + ": " + row_words(w, r);
    if (!(n >= 2 && n <= static_cast<double>(most_angles_)))
      throw bad_input(where, "ntheta = " + number_text(n), "2 to nthetamax = " + std::to_string(most_angles_) + " expected");
    Element result;
    const auto count = static_cast<std::size_t>(n);
    const float* const theta = &theta_[place * most_angles_];
    const bool is_reversed = theta[0] > theta[count - 1];
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t from = is_reversed ? count - 1 - i : i;
      const double value = phase_[place * most_angles_ + from];
      if (!std::isfinite(value) || !std::isfinite(theta[from]) || (e == 0 && value < 0))
        throw bad_input(where + ": phase[" + std::to_string(e) + "] at " + number_text(theta[from]) + " degrees",
                        std::isnan(value) ? "NaN" : number_text(value),
                        e == 0 ? "a finite value that is not negative expected" : "a finite value expected");
      result.angle_deg.push_back(theta[from]);
      result.value.push_back(value);
    }
    if (std::fabs(result.angle_deg.front()) > 0.01 || std::fabs(result.angle_deg.back() - 180) > 0.01)
      throw bad_input(where + ": theta", number_text(result.angle_deg.front()) + " to " + number_text(result.angle_deg.back()) + " degrees",
                      "must reach from 0 to 180");
    result.angle_deg.front() = 0;
    result.angle_deg.back() = 180;
    return result;
  }

  /// Of the wavelengths in order those that light is rendered at, with one beyond each end.
  std::vector<std::size_t> visible(const std::vector<std::size_t>& order) const {
    std::size_t first = 0, last = order.size() - 1;
    while (first < last && nm_a_um * wavelength_um_[order[first + 1]] <= shortest_wavelength_nm) ++first;
    while (last > first && nm_a_um * wavelength_um_[order[last - 1]] >= longest_wavelength_nm) --last;
    return {order.begin() + static_cast<std::ptrdiff_t>(first), order.begin() + static_cast<std::ptrdiff_t>(last) + 1};
  }

  void collect_angles(const std::vector<std::size_t>& wavelengths) {
    std::vector<double> all;
    for (const std::size_t w : wavelengths)
      for (std::size_t r = 0; r < reff_um_.size(); ++r) {
        const Element p11 = element(w, r, 0);
        all.insert(all.end(), p11.angle_deg.begin(), p11.angle_deg.end());
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < 1e-5 + 1e-6 * b; }), all.end());
      }
    all.back() = 180;
    result_.table.scattering_angle_deg = all;
  }

  void add_row(std::size_t w, std::size_t r) {
    ScatteringTable& t = result_.table;
    const std::string where = file_.path() + ": " + row_words(w, r);
    std::vector<float>* const into[] = {&t.p11, &t.p12, &t.p33, &t.p34};
    for (std::size_t e = 0; e < std::size(into); ++e) {
      if (e > 0 && elements_ < std::size(into)) {  // intensity alone
        into[e]->resize(t.p11.size(), 0);
        continue;
      }
      const Element own = element(w, r, e);
      std::vector<double> s;
      for (const double deg : own.angle_deg) s.push_back(sin2_half_deg(deg));
      const Curve curve(s, own.value, where + ": theta");
      for (const double deg : t.scattering_angle_deg) into[e]->push_back(static_cast<float>(curve(sin2_half_deg(deg)) / (4 * pi)));
    }
    // ext is per mass: times the mass of a sphere of the effective radius it is a cross-section.
    const std::size_t at = w * reff_um_.size() + r;
    const double density_g_per_m3 = 1e6, radius_m = 1e-6 * reff_um_[r];
    const double sphere_g = 4.0 / 3 * pi * radius_m * radius_m * radius_m * density_g_per_m3;
    if (!(extinction_[at] > 0) || !(albedo_[at] > 0 && albedo_[at] <= 1.0001))
      throw bad_input(where, "ext " + number_text(extinction_[at]) + " and ssa " + number_text(albedo_[at]),
                      "an extinction above 0 and an albedo from 0 to 1 expected");
    t.extinction_cross_section_m2.push_back(1e-3 * extinction_[at] * sphere_g);
    t.scattering_cross_section_m2.push_back(std::min(albedo_[at], 1.0) * t.extinction_cross_section_m2.back());
    t.forward_fraction.push_back(0);
    t.asymmetry.push_back(0);
    const double error = std::fabs(normalise_row(t, t.asymmetry.size() - 1, where) - 1);
    if (error > 0.2)
      throw bad_input(where, "a mean over the sphere that is off by " + number_text(std::round(1000 * error) / 10) + " %",
                      "1 expected, as libRadtran's mie normalises it",
                      "Too few angles may have been written");
    t.normalisation_error = std::max(t.normalisation_error, error);
    if (error > worst_) {
      worst_ = error;
      worst_row_ = row_words(w, r);
    }
  }

  NetcdfFile file_;
  std::vector<double> wavelength_um_, reff_um_, angles_, extinction_, albedo_;
  std::vector<float> theta_, phase_;  // [wavelength][size][element][angle]
  std::size_t elements_ = 0, most_angles_ = 0;
  double worst_ = 0;
  std::string worst_row_;
  TableFile result_;
};

}  // namespace

bool is_libradtran_table(const NetcdfFile& file) {
  return file.find("wavelen") && file.find("ntheta") && file.find("theta") && file.find("phase") && file.find("ext") && file.find("ssa");
}

TableFile read_libradtran_table(const std::string& path) { return Reader(path).read(); }

}  // namespace arcus::phase
