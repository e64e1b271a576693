#pragma once
// Crystals of one habit that fall through the air: their shapes, how they lie, and where one of
// them sends light.

#include <string>
#include <vector>

#include "phase/base/random.h"
#include "phase/crystal/crystal_habit.h"
#include "phase/crystal/crystal_rays.h"
#include "phase/crystal/orientations.h"
#include "phase/settings/keys.h"

namespace arcus::phase {

struct CrystalSettings {
  std::string name = "plate";  ///< of the habit, which decides the defaults of all that follows
  HabitSettings habit;
  double aspect_spread =
      0;  ///< standard deviation of the logarithm of the aspect ratio (log-normal)
  OrientationSettings orientation;
};
void list_keys(Keys&, CrystalSettings&);

/// The crystals that a habit's name stands for; shapes and orientations as they are mostly found in the air. plate |
/// column | needle | prism | pyramid | bullet | triangle. Throws bad_input for other names.
CrystalSettings crystals_of_habit(const std::string& name);

class CrystalPopulation {
 public:
  /// All crystals have the same maximum dimension. Throws bad_input as make_crystal and
  /// Orientations do.
  CrystalPopulation(const CrystalSettings& settings, double maximum_dimension_um);

  /// Equally many crystals have each of these shapes: the middles of 32 equal shares of the aspect
  /// ratios, or one shape where they have no spread.
  const std::vector<CrystalShape>& shapes() const { return shapes_; }
  const Orientations& orientations() const { return orientations_; }

  /// Mean shadow over all directions of light [um2]: geometric extinction of randomly oriented
  /// ones.
  double mean_projected_area_um2() const;

  /// A crystal as it lies, its chance in proportion to the shadow that it casts in light of this
  /// direction (world, unit): one that a ray of light meets.
  struct Lying {
    const CrystalShape& shape;
    Orientation orientation;
  };
  Lying draw_met(const Vec3& incoming, Random& random) const;
  /// A crystal as it lies, all alike: the mean of shape.projected_area over many is the geometric
  /// extinction in that direction.
  Lying draw_any(Random& random) const;

  /// Light of this direction after one crystal, drawn by shares of the power: geometric scattering
  /// without diffraction. light.i is the albedo of this ray, 1 without absorption; direction and
  /// place in the world's axes. None where the ray is still inside after a thousand faces, which
  /// counts as absorbed.
  std::optional<CrystalExit> draw(const Vec3& incoming, double n, double absorption_per_um,
                                  Random& random) const;

 private:
  std::vector<CrystalShape> shapes_;
  Orientations orientations_;
  double largest_shadow_um2_ = 0;
};

/// Size over the mean size of a crystal that light meets, where the sizes' logarithms have this standard deviation: crystals count
/// by their shadows. 1 where the spread is 0; takes numbers only where it is not.
double crystal_size_factor(double size_spread, Random& random);

/// Whether light of 550 nm that is diffracted by such crystals stays within two thirds of the sun's disc, so that it can count as
/// not stopped at all: maximum dimensions of about 100 um and more.
bool is_diffraction_narrow(const CrystalPopulation& crystals);

/// Absorption of power along a path, 4 pi k / wavelength [1/um], for an imaginary index k relative
/// to the surroundings.
double absorption_per_um(double k, double vacuum_wavelength_nm);

}  // namespace arcus::phase
