#include "media/medium/medium.h"

#include <cmath>

#include "media/grid/sparse_grid.h"
#include "media/majorant/majorant_grid.h"
#include "media/medium/lookup.h"
#include "media/medium/scatterer.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/species/species.h"

namespace arcus::media {
namespace {

void check(const Component& component) {
  const double volume = component.world_from_index.determinant();
  const Affine& map = component.world_from_index;
  const double scale = length(map.x) * length(map.y) * length(map.z);
  if (!std::isfinite(volume) || !(std::fabs(volume) > 1e-12 * scale))
    throw bad_input(component.name, "a transform that makes the medium flat", "it must be invertible");
}

Lookup lookup_of(const Component& component) {
  Lookup lookup{.grid = component.grid.get(),
                .box = component.box,
                .index_from_world = component.world_from_index.inverse(),
                .is_linear = component.interpolation == Interpolation::linear,
                .scale = component.extinction_scale,
                .sizes_vary = component.grid && component.grid->has_size(),
                .size_um = component.size_um,
                .ratios = {}};
  if (component.species) {
    const float smallest = static_cast<float>(component.species->smallest_size_um()),
                largest = static_cast<float>(component.species->largest_size_um());
    lookup.ratios = lookup.sizes_vary ? RatioTable(*component.species, smallest, largest)
                                      : RatioTable(*component.species, component.size_um, component.size_um);
    lookup.sizes_vary = lookup.ratios.row_count() > 1;
  }
  return lookup;
}

}  // namespace

Medium::Medium(std::vector<Component> components) : components_(std::move(components)) {
  std::vector<MajorantSource> sources;
  for (const Component& component : components_) {
    check(component);
    lookups_.push_back(lookup_of(component));
    const Lookup& lookup = lookups_.back();
    sources.push_back({.grid = lookup.grid,
                       .box = lookup.box,
                       .world_from_index = component.world_from_index,
                       .largest_factor = lookup.scale * lookup.ratios.largest(),
                       .smallest_factor = lookup.scale * lookup.ratios.smallest()});
  }
  majorants_ = std::make_unique<MajorantGrid>(sources);
  bounds_m_ = majorants_->bounds_m();
}

Medium::~Medium() = default;

Spectrum Medium::extinction_per_m(const Vec3& position_m, const Wavelengths& wavelengths) const {
  const RatioTable::Columns columns = RatioTable::mean_columns(wavelengths);
  Spectrum total;
  for (const Lookup& lookup : lookups_)
    total += lookup.interpolated(lookup.index_from_world.point(position_m), columns);
  return total;
}

Scatterer Medium::scatterer(const Collision& collision, const Wavelengths& wavelengths, float u) const {
  const Component& component = components_[static_cast<std::size_t>(collision.component)];
  if (!component.species) return {Spectrum::filled(component.albedo_scale), phase::PhaseFunction()};
  return {component.species->albedo(collision.size_um, wavelengths) * component.albedo_scale,
          component.species->phase_function(collision.size_um, u)};
}

std::size_t Medium::memory_bytes() const {
  std::size_t bytes = majorants_->memory_bytes();
  for (const Lookup& lookup : lookups_)
    bytes += (lookup.grid ? lookup.grid->memory_bytes() : 0) + lookup.ratios.memory_bytes();
  return bytes;
}

}  // namespace arcus::media
