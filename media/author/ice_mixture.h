#pragma once
// Ice as a mixture of habits: each becomes a species of its own, since each has phase functions of its own.

#include <functional>
#include <string>
#include <vector>

#include "media/author/ice_crystals.h"
#include "media/grid/new_grid.h"
#include "phase/settings/keys.h"

namespace arcus::media {

struct IceMixtureSettings {
  std::vector<std::string> habits{"plate", "column", "prism"};  ///< each becomes a species NAME_HABIT
  std::vector<double> shares{1};        ///< of the ice, in proportion; one number: equal
  std::vector<double> tilt_deg{1};      ///< of oriented ones; one number: all
  std::vector<double> aspect_ratio{0};  ///< length over diameter, one number: all; 0: by habit
  double aspect_spread = 0;             ///< standard deviation of the logarithm of the aspect ratio
  bool by_temperature = false;          ///< shares of plates and columns follow the temperature
  long long size_nodes = 2;             ///< at most so many sizes in a recipe
};
void list_keys(Keys& keys, IceMixtureSettings& mixture);

class IceMixture {
 public:
  explicit IceMixture(const IceMixtureSettings& settings);

  struct Part {
    std::string habit;
    phase::CrystalSettings settings;
    IceCrystals crystals;
    double share;       ///< of the ice; they add up to 1
    int lean;           ///< which temperatures it prefers: +1 those of columns, -1 those of plates, 0 neither
  };
  const std::vector<Part>& parts() const { return parts_; }
  /// Share of part i in the ice; they add up to 1 at every temperature.
  double share(std::size_t i, double temperature_c) const;

  /// Of all together; sizes are maximum dimensions, the same for all parts.
  double extinction_per_m(double ice_g_per_m3, double size_um, double temperature_c) const;
  double fall_speed_m_per_s(double size_um, double air_kg_per_m3, double temperature_c) const;
  double crystals_per_m3(double ice_g_per_m3, double size_um, double temperature_c) const;

  /// Recipe of a part for sizes between the two, with few nodes, since each costs a table or a map of the sky: one where even the
  /// smallest is so large that halos no longer depend on it. On a lattice that all clouds share, so that a like one finds them in the cache.
  std::string recipe(std::size_t i, double smallest_um, double largest_um) const;

 private:
  double weight(const Part& part, double temperature_c) const;

  IceMixtureSettings settings_;
  std::vector<Part> parts_;
};

struct AuthoredIce {
  std::vector<NewSpecies> species;  ///< one for each habit
  double ice_kg = 0;
  double mean_optical_depth = 0;    ///< along z, of all species, over the domain
  float largest_extinction_per_m = 0;  ///< of all species together
  float smallest_size_um = 0, largest_size_um = 0;
};

/// How ice becomes species. `ice` has ice water content [g/m³] in place of extinction.
struct IceUse {
  std::string name;
  double area_m2 = 1;        ///< of the domain
  double optical_depth = 0;  ///< mean over the domain that all is scaled to; 0: as it is
  std::function<double(double z_m)> temperature_c;  ///< at a height of the world
};
AuthoredIce author_ice(const NewSpecies& ice, const IceMixture& mixture, const IceUse& use);

}  // namespace arcus::media
