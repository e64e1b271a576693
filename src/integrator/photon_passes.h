#pragma once
// The maps of a photon map, pass by pass, put together from ranges of photons.

#include <optional>
#include <vector>

#include "src/integrator/photon_sending.h"
#include "src/photon/photon_store.h"
#include "src/photon/relaxation.h"

namespace arcus::render {

/// One pass: light straight from smooth surfaces, and all of it (without final gathering: what is neither that nor straight from the sun).
struct PhotonPass {
  PhotonStore caustic_on_surfaces, caustic_in_media, on_surfaces, in_media;
  int neighbours;
  Relaxed relaxed;  ///< of caustic_on_surfaces
};

/// Where the photons of a map come from. Each answer is nothing where the work is to be given up.
class PhotonSource {
 public:
  virtual ~PhotonSource() = default;
  /// What lands of a range, as PhotonSending::send.
  virtual std::optional<std::vector<LandedPhotons>> landed(std::size_t range) = 0;
  /// Relaxes the caustics of a pass on surfaces, all of its photons there.
  virtual std::optional<Relaxed> relax(std::uint32_t pass, std::vector<Photon>& photons) = 0;
};

/// Photons that are sent and relaxed here, until stop_request becomes non-zero.
class PhotonsSentHere : public PhotonSource {
 public:
  explicit PhotonsSentHere(const PhotonSending& sending, const std::atomic<int>* stop_request = nullptr) : sending_(sending), stop_request_(stop_request) {}
  std::optional<std::vector<LandedPhotons>> landed(std::size_t range) override { return sending_.send(range, stop_request_); }
  std::optional<Relaxed> relax(std::uint32_t pass, std::vector<Photon>& photons) override;

 private:
  const PhotonSending& sending_;
  const std::atomic<int>* stop_request_;
};

/// Asks for all ranges in their order and makes the maps of all passes. Nothing where the source gave up. Throws bad_input where no
/// photon has landed at all.
std::optional<std::vector<PhotonPass>> gather_passes(const PhotonSending& sending, PhotonSource& source);

/// Neighbours in pass i = 0, 1, 2, ...: their number falls as the squared radius r²_{i+1} = r²_i (i + α) / (i + 1), α = 2/3.
int neighbours_in_pass(int first, int pass);

}  // namespace arcus::render
