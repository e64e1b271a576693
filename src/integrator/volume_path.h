#pragma once
// The spectral volumetric path tracer: follows light backwards from the camera, through tentative collisions (delta
// tracking), scattering in media and reflection from surfaces, and asks the sun at every one of them.
//
// A path carries four wavelengths. The first, the hero, decides where it goes; for every wavelength j two numbers are
// kept, relative to the hero's density: `weight`, what the path contributes at j, and `density`, how likely the path
// would have been had j led it. A contribution counts weight / mean(density): the balance heuristic over which of the
// four led (Wilkie et al., EGSR 2014; Miller, Georgiev and Jarosz, "A null-scattering path integral formulation of
// light transport", SIGGRAPH 2019). Where a medium is grey the two stay equal and the four share everything.

#include <algorithm>
#include <optional>

#include "media/air/air_walk.h"
#include "media/tracking/collision_walk.h"
#include "phase/base/random.h"
#include "phase/function/phase_function.h"
#include "src/integrator/integrator.h"
#include "src/integrator/smooth_surface.h"
#include "src/integrator/sun_reach.h"
#include "src/scene/scene.h"

namespace arcus::render {

class VolumePath : public Integrator {
 public:
  /// max_bounces: scatterings and reflections a path may have; 0 shows only what is seen directly.
  VolumePath(const Scene& scene, long long max_bounces);
  /// With another guess of how deep places lie, as the sun sees them: of the noise alone.
  VolumePath(const Scene& scene, long long max_bounces, SunReach sun_reach);

  /// An unbiased estimate of the radiance that arrives along the ray against its direction [W m-2 sr-1 nm-1]. Adds to `work` what
  /// it took.
  Spectrum radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first,
                    Random& random, Work& work) const override;
  Spectrum radiance(const media::Ray& camera_ray, const Wavelengths& wavelengths, const FirstNumbers& first, Random& random) const {
    Work work;
    return radiance(camera_ray, wavelengths, first, random, work);
  }

 private:
  struct Path;
  /// What all parts of one estimate share.
  struct Sample {
    Wavelengths wavelengths;
    Random& random;
    Work& work;
    SunLight sunlight;
    std::optional<media::AirOptics> air;  ///< where there is air
    Spectrum total;                       ///< the estimate so far
    double most_air_per_m = 0;            ///< extinction of air by the first wavelength at sea level
  };
  /// Follows a path until it ends.
  void follow(Path& path, Sample& sample) const;
  /// Follows a path along its ray to the next collision or else to `hit` or out of the scene; the walk may be none where the media are known
  /// to let it pass. False where it ends.
  bool advance(Path& path, media::CollisionWalk* walk, const std::optional<Hit>& hit, Sample& sample) const;
  /// How far a ray that meets no surface goes through air that is traced.
  struct AirEnd {
    double ground_m, exit_m;  ///< to the planet, and to where the sky's table takes over; infinity where there is none
    double nearest_m() const { return std::min(ground_m, exit_m); }
  };
  AirEnd air_end(const media::Ray& ray) const;
  /// Splits a camera ray through thin air alone into the share that meets nothing and the rest, which is scattered at a place that `u` in [0, 1)
  /// gives. False, and nothing done, where the air is thick.
  bool split_in_air(Path& path, const std::optional<Hit>& hit, double u, Sample& sample) const;
  /// What air takes from a path on its way to a distance along its ray.
  void dim_by_air(Path& path, double distance_m, const Sample& sample) const;
  /// Scatters at a place in the air. False where it ends.
  bool scatter_in_air(Path& path, const media::AirCollision& collision, Sample& sample) const;
  /// What follows where the medium let the path through to a surface. False where it ends.
  bool pass(Path& path, const Hit& hit, Sample& sample) const;
  /// What follows where the air that is traced let the path through. False where it ends.
  bool leave_air(Path& path, const AirEnd& end, const std::optional<Hit>& hit, Sample& sample) const;
  /// Reflects from the planet at a distance along the ray, which air has dimmed. False where it ends.
  bool meet_ground(Path& path, double distance_m, Sample& sample) const;
  /// Light that arrives where the path has left the scene, at a distance along its ray.
  Spectrum escaped(const Path& path, double distance_m, const Sample& sample) const;
  /// Scatters in the medium. False where it ends.
  bool scatter(Path& path, const media::Collision& collision, Sample& sample) const;
  /// Scatters by a phase function: adds sunlight, turns the path. False where it ends.
  bool turn(Path& path, const Vec3& position_m, const phase::PhaseFunction& function, Sample& sample) const;
  /// Goes on from a scattering with each wavelength by itself.
  void part(const Path& path, const Vec3& position_m, const phase::PhaseFunction& function, Sample& sample) const;
  /// Reflects from a surface, or goes through it: adds sunlight, turns the path. False where it ends.
  bool meet(Path& path, const Hit& hit, Sample& sample) const;
  /// The same from a surface that spreads it. False where it ends.
  template <class Lobe>
  bool reflect(Path& path, const Hit& hit, const Lobe& lobe, Sample& sample) const;
  /// Share of the light from outside, of sun or sky, that reaches a point from a direction without detours [0 to 1].
  Spectrum sun_transmittance(const Vec3& position_m, const Departure& departure, const Vec3& to_sun, Sample& sample) const;

  const Scene& scene_;
  long long max_bounces_;
  SunReach sun_reach_;
};

}  // namespace arcus::render
