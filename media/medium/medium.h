#pragma once
// Everything that scatters in a scene, as one medium: however many grids and blocks a scene lists, a ray steps through
// one structure of majorants and never has to know which medium it is in.

#include <memory>
#include <string>
#include <vector>

#include "media/medium/component.h"
#include "media/space/box.h"
#include "media/space/ray.h"
#include "phase/base/spectrum.h"
#include "phase/base/vec3.h"
#include "phase/base/wavelengths.h"

namespace arcus::media {

class MajorantGrid;
struct Lookup;
struct Scatterer;

/// A place where light may be scattered: tentative, because the medium's extinction there is only known to lie below
/// the majorant. Light is scattered there by component k with probability σ_k/σ̄ and else goes on, so that with every
/// wavelength's own probabilities: a scattering multiplies a path's value by σ_k,j · albedo_j · p_j / σ̄ and its
/// density by σ_k,j · q_j / σ̄; a null collision multiplies both by 1 − σ_j/σ̄ (physics: Miller et al. 2019).
struct Collision {
  double distance_m = 0;               ///< from the ray's origin
  Vec3 position_m{0, 0, 0};
  float majorant_per_m = 0;            ///< σ̄ > 0; no wavelength's extinction exceeds it
  Spectrum extinction_per_m;           ///< σ_j, all components together; between 0 and σ̄
  Spectrum component_extinction_per_m; ///< σ_k,j of the component that scatters here if anything does
  int component = 0;                   ///< k, drawn in proportion to the components' extinctions at the first wavelength
  float size_um = 0;                   ///< its particles' size
};

class Medium {
 public:
  /// Builds the majorants. Throws bad_input where a component's transform is singular.
  explicit Medium(std::vector<Component> components);
  Medium(const Medium&) = delete;
  Medium& operator=(const Medium&) = delete;
  ~Medium();

  /// True where there is nothing that scatters anywhere.
  bool is_empty() const { return components_.empty(); }
  /// Everything that scatters lies within [m].
  const Box& bounds_m() const { return bounds_m_; }
  int component_count() const { return static_cast<int>(components_.size()); }
  const Component& component(int k) const { return components_[static_cast<std::size_t>(k)]; }
  const MajorantGrid& majorants() const { return *majorants_; }
  /// The components made ready for tracking, in the same order.
  const std::vector<Lookup>& lookups() const { return lookups_; }

  /// Extinction at a point, mean over all directions, interpolated in full: slow, for looking at what is there [1/m].
  Spectrum extinction_per_m(const Vec3& position_m, const Wavelengths&) const;

  /// Albedo and phase function of the component drawn at a collision; u in [0, 1) chooses between size nodes.
  Scatterer scatterer(const Collision&, const Wavelengths&, float u) const;

  /// Bytes held for rendering: grids and majorants.
  std::size_t memory_bytes() const;

 private:
  std::vector<Component> components_;
  std::vector<Lookup> lookups_;
  std::unique_ptr<MajorantGrid> majorants_;
  Box bounds_m_;
};

}  // namespace arcus::media
