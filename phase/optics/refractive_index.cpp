#include "phase/optics/refractive_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/data/embedded.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {

void list_keys(Keys& keys, ConstantIndexSettings& index) {
  keys.number("n", index.n, above(0), "real part, relative to the surroundings");
  keys.number("k", index.k, at_least(0), "imaginary part, relative to the surroundings; absorbs");
}

double air_index(double vacuum_wavelength_nm) {
  const double inverse_um = 1000 / vacuum_wavelength_nm, s = inverse_um * inverse_um;
  return 1 + 1e-8 * (8342.13 + 2406030 / (130 - s) + 15997 / (38.9 - s));
}

double size_parameter(double radius_um, double vacuum_wavelength_nm) {
  return 2 * pi * radius_um * air_index(vacuum_wavelength_nm) / um_from_nm(vacuum_wavelength_nm);
}

RefractiveIndex RefractiveIndex::water() {
  const Columns table = read_columns(data::water_refractive_index(), "water_refractive_index.csv");
  RefractiveIndex index;
  index.name_ = "water";
  index.wavelength_nm_ = table.named("wavelength_nm");
  index.n_ = table.named("n_rel_air");
  index.k_ = table.named("k");
  return index;
}

RefractiveIndex RefractiveIndex::ice() {
  const Columns table = read_columns(data::ice_refractive_index(), "ice_refractive_index.csv");
  RefractiveIndex index;
  index.name_ = "ice";
  index.wavelength_nm_ = table.named("wavelength_nm");
  index.n_ = table.named("n");
  index.k_ = table.named("k");
  for (std::size_t i = 0; i < index.n_.size(); ++i)
    index.n_[i] /= air_index(index.wavelength_nm_[i]);
  return index;
}

RefractiveIndex RefractiveIndex::mineral() { return from_text(data::mineral_refractive_index(), "mineral_refractive_index.csv"); }

RefractiveIndex RefractiveIndex::constant(const ConstantIndexSettings& settings) {
  RefractiveIndex index;
  index.name_ = "constant";
  index.wavelength_nm_ = {0};
  index.n_ = {settings.n};
  index.k_ = {settings.k};
  return index;
}

RefractiveIndex RefractiveIndex::from_columns(const Columns& table, const std::string& where) {
  if (table.columns.size() != 3)
    throw bad_input(where, std::to_string(table.columns.size()) + " columns",
                    "must be three: wavelength in nm, n, k");
  RefractiveIndex index;
  index.name_ = where;
  index.wavelength_nm_ = table.columns[0];
  index.n_ = table.columns[1];
  index.k_ = table.columns[2];
  for (std::size_t i = 0; i < index.n_.size(); ++i) {
    const std::string row = where + ": row " + std::to_string(i + 1);
    if (index.wavelength_nm_[i] <= (i == 0 ? 0 : index.wavelength_nm_[i - 1]))
      throw bad_input(row, "wavelength " + number_text(index.wavelength_nm_[i]) + " nm",
                      "must be above 0 and above the row before");
    if (index.n_[i] <= 0)
      throw bad_input(row, "n = " + number_text(index.n_[i]), "must be above 0");
    if (index.k_[i] < 0)
      throw bad_input(row, "k = " + number_text(index.k_[i]), "must be at least 0",
                      "k above 0 absorbs");
  }
  if (index.n_.size() < 2)
    throw bad_input(where, "one row", "must be at least two", "Use { n = ..., k = ... }");
  return index;
}

RefractiveIndex RefractiveIndex::from_text(std::string_view text, std::string_view where) {
  return from_columns(read_columns(text, where), std::string(where));
}

RefractiveIndex RefractiveIndex::from_file(const std::string& path) {
  return from_columns(read_columns_file(path), path);
}

bool RefractiveIndex::is_built_in(const std::string& material) { return material == "water" || material == "ice" || material == "mineral"; }

RefractiveIndex RefractiveIndex::named(const std::string& material) {
  if (material == "water") return water();
  if (material == "ice") return ice();
  if (material == "mineral") return mineral();
  return from_file(material);
}

double RefractiveIndex::first_nm() const {
  return wavelength_nm_.size() == 1 ? 0 : wavelength_nm_.front();
}

double RefractiveIndex::last_nm() const {
  return wavelength_nm_.size() == 1 ? std::numeric_limits<double>::infinity()
                                    : wavelength_nm_.back();
}

std::complex<double> RefractiveIndex::relative_to_air(double nm) const {
  if (wavelength_nm_.size() == 1) return {n_[0], k_[0]};
  if (!(nm >= first_nm() && nm <= last_nm()))
    throw bad_input(
        "refractive index of " + name_, "wavelength " + number_text(nm) + " nm",
        "must be between " + number_text(first_nm()) + " and " + number_text(last_nm()) + " nm",
        "Optical constants are not extrapolated");
  const auto above = std::upper_bound(wavelength_nm_.begin() + 1, wavelength_nm_.end() - 1, nm);
  const auto i = static_cast<std::size_t>(above - wavelength_nm_.begin());
  const double t = (nm - wavelength_nm_[i - 1]) / (wavelength_nm_[i] - wavelength_nm_[i - 1]);
  const double n = (1 - t) * n_[i - 1] + t * n_[i];
  const bool positive = k_[i - 1] > 0 && k_[i] > 0;
  const double k =
      positive ? k_[i - 1] * std::pow(k_[i] / k_[i - 1], t) : (1 - t) * k_[i - 1] + t * k_[i];
  return {n, k};
}

}  // namespace arcus::phase
