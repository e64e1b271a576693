#pragma once
// Complex refractive index of what particles are made of, by vacuum wavelength, relative to the air
// around them. m = n + ik with k >= 0 absorbing (time factor exp(-i omega t)). Between rows n is
// linear in wavelength and so is log k, as the data files ask for.

#include <complex>
#include <string>
#include <string_view>
#include <vector>

#include "phase/settings/keys.h"

namespace arcus {
struct Columns;
}

namespace arcus::phase {

/// An index that is the same at every wavelength, relative to the surroundings.
struct ConstantIndexSettings {
  double n = 1.333;
  double k = 0;
};
void list_keys(Keys&, ConstantIndexSettings&);

/// Index of standard dry air (15 C, 1 atm), 200 ... 2000 nm: B. Edlén, Metrologia 2, 71 (1966),
/// equation 1.
double air_index(double vacuum_wavelength_nm);

/// Size parameter x = 2 pi r n_air / wavelength of a particle in air.
double size_parameter(double radius_um, double vacuum_wavelength_nm);

class RefractiveIndex {
 public:
  /// Liquid water at 20 C, 300 ... 1000 nm: n of Daimon and Masumura (2007), k of Segelstein
  /// (1981).
  static RefractiveIndex water();
  /// Ice Ih at 266 K, 300 ... 1000 nm: Warren and Brandt (2008).
  static RefractiveIndex ice();
  /// Desert dust, 350 ... 800 nm: Hess, Koepke and Schult (1998).
  static RefractiveIndex mineral();
  static RefractiveIndex constant(const ConstantIndexSettings& settings);
  /// Rows of vacuum wavelength [nm], n and k, relative to the surroundings as every explicit index
  /// is (divide a table of absolute indices by air_index). Throws bad_input: unreadable, not three
  /// columns, wavelengths not ascending, n not above 0, k below 0.
  static RefractiveIndex from_file(const std::string& path);
  static RefractiveIndex from_text(std::string_view text, std::string_view where);
  /// Whether `named` knows it without a file: "water", "ice", "mineral".
  static bool is_built_in(const std::string& material);
  /// One of these, or else what a file says.
  static RefractiveIndex named(const std::string& material);

  /// m relative to air. Throws bad_input outside first_nm() ... last_nm(): optical constants are
  /// never guessed.
  std::complex<double> relative_to_air(double vacuum_wavelength_nm) const;

  double first_nm() const;
  double last_nm() const;

 private:
  static RefractiveIndex from_columns(const Columns& table, const std::string& where);

  std::string name_;
  std::vector<double> wavelength_nm_, n_, k_;  // one row: constant
};

}  // namespace arcus::phase
