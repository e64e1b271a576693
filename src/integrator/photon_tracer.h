#pragma once
// Sends photons from the sun into the scene, and says where they land.
//
// For caustics they are aimed at the mirrors and clear bodies alone: at a circle around each piece, chosen in proportion to its area, and those
// whose first surface is not that piece are dropped, so that every ray of the sun is sent in one way only. For all other light they cross a
// ball around the scene evenly. The sun's rim is darker as at 550 nm, at all wavelengths; the light in all is right at each.

#include <atomic>
#include <cstdint>
#include <vector>

#include "phase/base/random.h"
#include "src/integrator/smooth_surface.h"
#include "src/photon/photon.h"
#include "src/scene/scene.h"

namespace arcus::render {

/// Photons where they landed, in the order in which they were sent.
struct LandedPhotons {
  std::vector<Photon> on_surfaces, in_media;

  void append(const LandedPhotons& other) {
    on_surfaces.insert(on_surfaces.end(), other.on_surfaces.begin(), other.on_surfaces.end());
    in_media.insert(in_media.end(), other.in_media.begin(), other.in_media.end());
  }
};

/// Photons first to last, not included, of `count` that are sent in a pass. What a photon does depends on the seed, the pass, its number and
/// `count` alone: what lands of neighbouring numbers, one after the other, is what lands of all of them.
struct PhotonNumbers {
  std::uint32_t first, last, count;
};

/// A ball.
struct Ball {
  Vec3 centre_m{0, 0, 0};
  double radius_m = 0;
  bool contains(const Vec3& position_m) const { return squared_length(position_m - centre_m) <= radius_m * radius_m; }
};

class PhotonTracer {
 public:
  /// max_bounces: of a photon. The scene must outlive it. Throws bad_input where there is no sun, where nothing of finite size stands that light
  /// could meet, and for media that photons cannot be asked of.
  PhotonTracer(const Scene& scene, long long max_bounces);

  /// Where photons land: all that is of finite size, and with a plane four times as far.
  const Ball& region() const { return region_; }

  /// Whether there are mirrors or clear bodies.
  bool has_targets() const { return !targets_.empty(); }
  /// Light that has met smooth surfaces alone before it lands (L S+ D). Where stop_request becomes non-zero the rest is left out, soon.
  LandedPhotons caustic(const PhotonNumbers& numbers, std::uint64_t seed, std::uint32_t pass, const std::atomic<int>* stop_request = nullptr) const;
  LandedPhotons caustic(std::uint32_t count, std::uint64_t seed, std::uint32_t pass) const { return caustic({0, count, count}, seed, pass); }
  /// All sunlight wherever it lands; without `first`, what lands straight from the sun and what caustic() has are left out.
  LandedPhotons all(const PhotonNumbers& numbers, std::uint64_t seed, std::uint32_t pass, bool first, const std::atomic<int>* stop_request = nullptr) const;
  LandedPhotons all(std::uint32_t count, std::uint64_t seed, std::uint32_t pass, bool first) const { return all({0, count, count}, seed, pass, first); }

 private:
  struct Target {
    Ball around;
    PieceId piece;        ///< piece none: any of the group
    double areas_m2 = 0;  ///< of the circles up to here
  };
  struct Flight;
  void add_targets();
  /// Sets out across a circle that faces the sun. False where a plane is in the way of the light.
  bool set_out(Flight& flight, const Ball& through) const;
  bool follow_caustic(Flight& flight, const Target& target, LandedPhotons& landed) const;
  void follow(Flight& flight, bool first, LandedPhotons& landed) const;
  /// Goes on to the next scattering in the medium, before `hit` if there is one. True where there is one.
  bool meets_medium(Flight& flight, const std::optional<Hit>& hit, LandedPhotons& landed, bool stores, bool goes_on) const;

  const Scene& scene_;
  long long max_bounces_;
  std::vector<Target> targets_;
  Ball region_;
};

}  // namespace arcus::render
