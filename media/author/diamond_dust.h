#pragma once
// Diamond dust: a few crystals in the cold air over the ground, without a cloud. V. P. Walden, S. G. Warren and E. Tuttle, J. Appl. Meteorol.
// 42, 1391 (2003): tens to hundreds in a litre.

#include <string>

#include "media/author/ice_mixture.h"

namespace arcus::media {

struct DiamondDustSettings {
  std::string name = "diamond_dust";  ///< of the species NAME_HABIT
  Vec3 centre_m{0, 0, 0};             ///< middle of the domain, on the ground
  std::vector<double> size_m{1500};   ///< of the domain along x and y; one number: both
  double depth_m = 200;               ///< of the layer, over the ground
  double voxel_m = 10;
  double number_per_l = 100;          ///< crystals in a litre near the ground, mean over the domain
  double optical_depth = 0;           ///< vertical, mean over the domain; above 0 it decides the number
  std::vector<double> crystal_um{120};  ///< maximum dimension at the ground and at the top; one number: both
  double temperature_c = -20;
  double patchiness = 0.3;            ///< standard deviation of ln N from place to place
  double patch_m = 150;               ///< size of the largest patches
  long long seed = 1;
  IceMixtureSettings crystals{.habits = {"plate", "column"}};
};
void list_keys(Keys& keys, DiamondDustSettings& dust);

/// The layer, equal for any number of threads. Throws bad_input where there are more than 2·10⁹ voxels.
AuthoredIce author_diamond_dust(const DiamondDustSettings& settings);

}  // namespace arcus::media
