#include "src/integrator/photon_passes.h"

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"

namespace arcus::render {
namespace {

constexpr double progressive_alpha = 2.0 / 3;

}  // namespace

int neighbours_in_pass(int first, int pass) {
  double squared_radius = first;
  for (int i = 1; i <= pass; ++i) squared_radius *= (i + progressive_alpha) / (i + 1);
  return std::max(1, static_cast<int>(std::lround(squared_radius)));
}

std::optional<Relaxed> PhotonsSentHere::relax(std::uint32_t, std::vector<Photon>& photons) {
  return sending_.relax(photons, [this] { return stop_request_ && stop_request_->load() != 0; });
}

std::optional<std::vector<PhotonPass>> gather_passes(const PhotonSending& sending, PhotonSource& source) {
  const RenderSettings& settings = sending.settings();
  std::vector<PhotonPass> passes;
  LandedPhotons caustic, all;  // of the pass that grows
  bool has_any = false;
  for (std::size_t number = 0; number < sending.range_count(); ++number) {
    const auto parts = source.landed(number);
    if (!parts) return std::nullopt;
    const std::vector<PhotonStretch> stretches = sending.range(number);
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      (stretches[i].is_aimed ? caustic : all).append((*parts)[i]);
      if (!sending.ends_pass(stretches[i])) continue;
      has_any |= !caustic.on_surfaces.empty() || !caustic.in_media.empty() || !all.on_surfaces.empty() || !all.in_media.empty();
      const auto relaxed = source.relax(stretches[i].pass, caustic.on_surfaces);
      if (!relaxed) return std::nullopt;
      const int neighbours = neighbours_in_pass(static_cast<int>(settings.neighbours), static_cast<int>(stretches[i].pass));
      passes.push_back({PhotonStore(std::move(caustic.on_surfaces)), PhotonStore(std::move(caustic.in_media)), PhotonStore(std::move(all.on_surfaces)),
                        PhotonStore(std::move(all.in_media)), neighbours, *relaxed});
      caustic = {}, all = {};
    }
  }
  // Without final gathering, light that only falls on matte surfaces leaves no photon.
  if (!has_any && settings.final_gather)
    throw bad_input("render.photons", "no photon that has landed, of " + std::to_string(settings.photons) + " sent",
                    "matte surfaces or media in the sun expected", "Is the sun hidden, or all of it smooth? More photons help where bodies are small");
  return passes;
}

}  // namespace arcus::render
