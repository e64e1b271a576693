#pragma once
// What is sent for a photon map, cut into ranges that can be sent apart, by several processes or one after the other: the photons of all
// passes stand in one order, and a range is so many of them, neighbours in that order. How many goes by the scene alone. Gathered in their
// order, ranges are what one sending gives, to the bit. Then the caustics of each pass are relaxed.

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "src/integrator/photon_tracer.h"
#include "src/photon/relaxation.h"
#include "src/scene/settings.h"

namespace arcus::render {

/// Photons of one pass that are sent in one way: numbers first to last, not included.
struct PhotonStretch {
  std::uint32_t pass = 0;
  bool is_aimed = false;  ///< at smooth surfaces, for caustics; otherwise over the whole scene
  std::uint32_t first = 0, last = 0;
  bool operator==(const PhotonStretch&) const = default;
};

class PhotonSending {
 public:
  /// The scene must outlive it. Throws what PhotonTracer does.
  PhotonSending(const Scene& scene, const RenderSettings& settings);

  std::size_t range_count() const;
  /// The stretches of a range: at most one of each pass and way.
  std::vector<PhotonStretch> range(std::size_t number) const;
  /// Sends a range, on all cores; gives what lands of each of its stretches. Nothing where stop_request becomes non-zero before the end.
  std::optional<std::vector<LandedPhotons>> send(std::size_t number, const std::atomic<int>* stop_request = nullptr) const;

  /// Whether caustics are relaxed at all.
  bool relaxes() const { return settings_.iterations > 0 && tracer_.has_targets(); }
  /// Relaxes the caustics of a pass on surfaces, all of its photons there, as relax_until.
  std::optional<Relaxed> relax(std::vector<Photon>& photons, const std::function<bool()>& must_stop) const;

  std::uint32_t aimed() const { return aimed_; }  ///< photons in a pass
  /// Whether a stretch holds the last photon of its pass.
  bool ends_pass(const PhotonStretch& stretch) const { return !stretch.is_aimed && stretch.last == over_all_; }
  const PhotonTracer& tracer() const { return tracer_; }
  const RenderSettings& settings() const { return settings_; }

 private:
  const Scene& scene_;
  RenderSettings settings_;
  PhotonTracer tracer_;
  std::uint32_t aimed_, over_all_;  ///< photons in a pass
  std::uint64_t photons_in_range_;
};

}  // namespace arcus::render
