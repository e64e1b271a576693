#pragma once
// Haze: particles of the air that do not fall. Log-normal populations of spheres, mixed as in M. Hess, P. Koepke, I. Schult, "Optical Properties of
// Aerosols and Clouds: The Software Package OPAC", Bulletin of the American Meteorological Society 79, 831, 1998 (their tables 1 and 4), with the
// water that they hold at a relative humidity of 80 %.

#include <memory>
#include <string>
#include <vector>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "phase/species/make_species.h"

namespace arcus::media {

struct HazeSettings {
  std::string type = "none";     ///< none | continental | maritime | desert
  double optical_depth = 0.1;    ///< straight up at 550 nm
  double visibility_m = 0;       ///< at sea level; 0: optical_depth holds
  double scale_height_m = 1200;  ///< density falls to 1/e
};

/// Visibility is where a black object has lost all but 2 % of its contrast against the sky (Koschmieder): ln 50 over the extinction of haze and
/// molecules. The optical depth of the haze at 550 nm straight up, negative where clean air alone lets one see less far.
double haze_depth_550(const HazeSettings& settings, double molecules_per_m3);

/// One population of a mixture.
struct HazeMode {
  std::string name;
  double particles_per_cm3;
  double median_um, geometric_deviation;  ///< of the radii
  std::string material;                   ///< of phase::RefractiveIndex; empty: n and k
  double n, k;
};
/// Those of a type. Throws bad_input for one that is not known.
std::vector<HazeMode> haze_modes(const std::string& type);
/// The recipe of a mode's phase function.
phase::Recipe recipe_of(const HazeMode& mode);

class Haze {
 public:
  static constexpr int most_modes = 4;
  /// Makes the phase functions: seconds for the first time, then from the cache.
  Haze(const std::string& type, const phase::SpeciesOptions& options);

  int mode_count() const { return static_cast<int>(modes_.size()); }
  /// Extinction of a mode over that of all of them at 550 nm.
  Spectrum extinction_ratio(int mode, const Wavelengths& wavelengths) const;
  /// Share of that which is scattered.
  Spectrum albedo(int mode, const Wavelengths& wavelengths) const;
  /// Where it goes. Valid as long as the haze.
  phase::PhaseFunction phase_function(int mode) const;

 private:
  struct Mode {
    std::shared_ptr<const phase::Species> species;
    float share, size_um;
  };
  std::vector<Mode> modes_;
};

}  // namespace arcus::media
