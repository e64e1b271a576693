#pragma once
// A path's state, for the parts of VolumePath alone.

#include <algorithm>
#include <limits>

#include "src/integrator/volume_path.h"

namespace arcus::render {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// Expected tentative collisions of a camera ray below which it is split. Above, hardly anything passes straight on.
inline constexpr double most_forced_depth = 3;

/// Paths expected to bring less than this, in units of the mean over all directions and of what the camera sees, are left to
/// chance; those that are expected to bring more than the other are split.
inline constexpr float roulette_below = 0.2f, split_above = 1;
inline constexpr int most_splits = 4;

struct VolumePath::Path : PathLight {
  media::Ray ray;
  Departure departure;  ///< of the ray
  /// Share that a direct hit of the sun's disc counts: the rest was, or will be, found by asking the sun. 1 for what
  /// the camera sees directly.
  float sun_share = 1;
  /// The same of the sky's light, where it is asked.
  float sky_share = 1;
  /// How bright it is likely to be where the path goes, in units of the mean over all directions.
  float promise = 1;
  /// The weight of what the camera sees, in whose units it is judged what a path may bring.
  float seen_weight = 1;
  long long bounces = 0;
  /// Optical depth at the first wavelength until air is met, drawn once for many stretches; below 0: to be drawn.
  double air_depth_left = -1;

  /// True where one wavelength alone is left, the hero.
  bool is_alone() const { return density[1] == 0 && density[2] == 0 && density[3] == 0; }

  /// Sets out from a place within a medium.
  void leave(const Vec3& position_m, const Vec3& direction) {
    ray = media::Ray{position_m, direction};
    departure = {};
    polarised.depolarise();
  }

  void pass_null_collision(const media::Collision& collision) {
    const Spectrum null = Spectrum::filled(collision.majorant_per_m) - collision.extinction_per_m;
    const Spectrum ratio = null / null[0];
    weight *= ratio;
    density *= ratio;
  }

  /// What it is expected to bring, in units of the mean over all directions.
  float expectation() const { return weight.mean() / (density.mean() * seen_weight) * promise; }

  /// Ends paths that have little left to bring; the survivors take over (Arvo and Kirk 1990).
  bool survives_roulette(Random& random) {
    const float left = expectation();
    if (left >= roulette_below) return true;
    if (!(left > 0) || random.uniform() * roulette_below >= left) return false;
    weight *= roulette_below / left;
    return true;
  }

  /// How many the path is worth.
  int splits() const { return static_cast<int>(std::clamp(2 / split_above * expectation(), 1.f, static_cast<float>(most_splits))); }
};

}  // namespace arcus::render
