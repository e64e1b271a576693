#include "src/integrator/photon_sending.h"

#include <algorithm>

namespace arcus::render {
namespace {

/// How many more photons are sent towards smooth surfaces than over the whole scene, whose light is looked up one bounce away.
constexpr std::uint32_t targeted_per_other = 4;
/// A range should take seconds, and what lands be of a size that is quickly read: in media a photon takes many times as long, and lands
/// as often as it is scattered.
constexpr std::uint64_t photons_in_range = 1 << 18, photons_in_range_with_media = 1 << 15;

}  // namespace

PhotonSending::PhotonSending(const Scene& scene, const RenderSettings& settings)
    : scene_(scene),
      settings_(settings),
      tracer_(scene, settings.max_bounces),
      photons_in_range_(scene.medium->is_empty() ? photons_in_range : photons_in_range_with_media) {
  const auto photons = static_cast<std::uint32_t>(settings.photons);
  aimed_ = tracer_.has_targets() ? photons : 0;
  over_all_ = tracer_.has_targets() ? (photons + targeted_per_other - 1) / targeted_per_other : photons;
}

std::size_t PhotonSending::range_count() const {
  const std::uint64_t in_all = (std::uint64_t{aimed_} + over_all_) * static_cast<std::uint64_t>(settings_.passes);
  return static_cast<std::size_t>((in_all + photons_in_range_ - 1) / photons_in_range_);
}

std::vector<PhotonStretch> PhotonSending::range(std::size_t number) const {
  const std::uint64_t in_pass = std::uint64_t{aimed_} + over_all_, in_all = in_pass * static_cast<std::uint64_t>(settings_.passes);
  const std::uint64_t end = std::min((number + 1) * photons_in_range_, in_all);
  std::vector<PhotonStretch> stretches;
  for (std::uint64_t at = number * photons_in_range_; at < end;) {
    const std::uint64_t pass = at / in_pass, within = at % in_pass;
    const bool is_aimed = within < aimed_;
    const std::uint64_t before = pass * in_pass + (is_aimed ? 0 : aimed_), next = std::min(end, before + (is_aimed ? aimed_ : over_all_));
    stretches.push_back({static_cast<std::uint32_t>(pass), is_aimed, static_cast<std::uint32_t>(at - before), static_cast<std::uint32_t>(next - before)});
    at = next;
  }
  return stretches;
}

std::optional<std::vector<LandedPhotons>> PhotonSending::send(std::size_t number, const std::atomic<int>* stop_request) const {
  const auto seed = static_cast<std::uint64_t>(settings_.seed);
  std::vector<LandedPhotons> landed;
  for (const PhotonStretch& stretch : range(number)) {
    const PhotonNumbers numbers{stretch.first, stretch.last, stretch.is_aimed ? aimed_ : over_all_};
    landed.push_back(stretch.is_aimed ? tracer_.caustic(numbers, seed, stretch.pass, stop_request)
                                      : tracer_.all(numbers, seed, stretch.pass, settings_.final_gather, stop_request));
    if (stop_request && stop_request->load() != 0) return std::nullopt;
  }
  return landed;
}

std::optional<Relaxed> PhotonSending::relax(std::vector<Photon>& photons, const std::function<bool()>& must_stop) const {
  return relax_until(photons, scene_.surfaces, {.iterations = static_cast<int>(settings_.iterations)}, must_stop);
}

}  // namespace arcus::render
