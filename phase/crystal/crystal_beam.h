#pragma once
// A beam of light on falling crystals, and everything that leaves them: what tables and maps are made from.

#include <vector>

#include "phase/base/random.h"
#include "phase/crystal/crystal_packets.h"
#include "phase/crystal/crystal_population.h"

namespace arcus::phase {

/// Light of one wavelength in ice.
struct CrystalWave {
  double wavelength_nm = 550;    ///< in vacuum
  double n = 1.311;              ///< index relative to air
  double absorption_per_um = 0;  ///< of power
};

/// A part of one ray's light that leaves a crystal, in the world's axes.
struct CrystalLight {
  Vec3 incoming, outgoing;  ///< unit vectors, the way the light travels
  double power_um2;         ///< its mean over rays is the cross-section of such light
  double shadow_um2;        ///< of the crystal; likewise the geometric extinction
  const CrystalBatch& batch;
  int event, ray;

  FacePath path() const { return batch.path(event, ray); }
  /// True where it goes on exactly as it came: through parallel faces.
  bool is_undeviated() const { return dot(outgoing - incoming, outgoing - incoming) < 1e-9; }
};

/// Memory and tracers for one thread. The population must outlive it.
class CrystalBeam {
 public:
  /// events: faces met from inside after which light still in the crystal is given up.
  CrystalBeam(const CrystalPopulation& crystals, const CrystalWave& wave, int events = 10);

  /// Traces at least that many rays, whose directions are what `light` returns (called as light(random)), each through a crystal
  /// drawn without regard to its shadow, and calls receive(CrystalLight) for each exit with light. Returns the number of rays.
  template <class Light, class Receive>
  long long send(long long rays, Light&& light, Random& random, Receive&& receive) {
    long long sent = 0;
    while (sent < rays) {
      const CrystalPackets& tracer = tracers_[shape_];
      shape_ = (shape_ + 1) % tracers_.size();
      for (int ray = 0; ray < batch_.rays(); ++ray) {
        const auto i = static_cast<std::size_t>(ray);
        incoming_[i] = light(random);
        lies_[i] = crystals_.orientations().draw(random);
        batch_.set(ray, lies_[i].to_crystal(incoming_[i]), wave_.n, wave_.absorption_per_um, random);
      }
      tracer.split(batch_);
      for (int event = 0; event <= batch_.events(); ++event) {
        const auto power = batch_.column(event, CrystalBatch::i);
        for (int ray = 0; ray < batch_.rays(); ++ray) {
          const auto i = static_cast<std::size_t>(ray);
          if (!(power[i] > 0)) continue;
          const double shadow = batch_.projected_area(ray);
          receive(CrystalLight{incoming_[i], lies_[i].to_world(batch_.direction(event, ray)), power[i] * shadow, shadow, batch_, event, ray});
        }
      }
      sent += batch_.rays();
    }
    return sent;
  }

 private:
  const CrystalPopulation& crystals_;
  CrystalWave wave_;
  std::vector<CrystalPackets> tracers_;  ///< of the population's shapes
  std::size_t shape_ = 0;                ///< the next to be used
  CrystalBatch batch_;
  std::vector<Vec3> incoming_;
  std::vector<Orientation> lies_;
};

}  // namespace arcus::phase
