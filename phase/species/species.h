#pragma once
// The library's product: what a kind of particle does to light, by size and wavelength, ready for a renderer. How
// much it stops and where that goes come from one recipe, so they cannot be paired wrongly.
//
// Where the recipe removes the forward lobe of large drops, or what goes straight through crystals, everything here is about
// the rest: that light goes on as if nothing were there.

#include <memory>
#include <string>
#include <vector>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "phase/function/oriented_crystals.h"
#include "phase/function/phase_function.h"
#include "phase/function/sphere_table.h"
#include "phase/population/scattering_table.h"

namespace arcus::phase {

/// Mean extinction cross-section of a particle at 550 nm, diffraction included, by size node [m²]: an extinction coefficient over it is
/// a number of particles a volume.
std::vector<double> cross_sections_at_550_nm_m2(const ScatteringTable& table);

/// Sizes between two nodes are a mixture of both, with weights linear in ln size; sizes outside of the nodes are
/// those at the end. Wavelengths outside of the table's are taken at its ends. Calls are free of side effects.
class Species {
 public:
  /// Particles that scatter by a function in closed form, albedo 1, with one size. `exponent`: extinction goes with
  /// the wavelength to that power (0: grey; −4: small particles).
  Species(const PhaseFunction& function, double exponent);
  /// Particles with a table. What a renderer reads is made here: seconds, and tens of megabytes. `counted_m2`: cross-sections by size
  /// node to which extinction coefficients at 550 nm refer, where those are not the table's own: of the same particles by other optics.
  Species(ScatteringTable table, const SphereTableOptions& options, const std::vector<double>& counted_m2 = {});
  /// Crystals that lie in a preferred way.
  explicit Species(std::unique_ptr<const OrientedCrystals> crystals);
  Species(const Species&) = delete;
  Species& operator=(const Species&) = delete;

  /// (1 − f) C_ext(size, λ) / C_ext(size, 550 nm): times the extinction coefficient at 550 nm (diffraction included)
  /// it is the coefficient that a renderer uses.
  /// The mean over all directions of the light.
  Spectrum extinction_ratio(float size_um, const Wavelengths& wavelengths) const;
  /// True where extinction depends on the direction of the light, and directed_extinction_ratio tells how.
  bool is_oriented() const { return oriented_ != nullptr; }
  /// The same for light whose direction has the sine of elevation of this node (sine_nodes.h); linear between them. Only where is_oriented().
  Spectrum directed_extinction_ratio(float size_um, int sine_node, const Wavelengths& wavelengths) const;
  /// Bound of extinction_ratio over all sizes, wavelengths and directions.
  float largest_extinction_ratio() const { return largest_extinction_ratio_; }
  /// Share of that extinction that is scattered.
  Spectrum albedo(float size_um, const Wavelengths& wavelengths) const;
  /// Where it goes: that of a size node drawn with u in [0, 1). Valid as long as this species.
  PhaseFunction phase_function(float size_um, float u) const;

  /// Share f of the extinction that goes straight on; 0 where no lobe is removed.
  double forward_fraction(double size_um, double wavelength_nm) const;
  /// The particles' own table; null for a function in closed form.
  const ScatteringTable* table() const { return lobes_ ? &table_ : nullptr; }
  /// What phase_function reads; null for a function in closed form.
  const SphereTable* sphere_table() const { return lobes_.get(); }
  /// Crystals that lie in a preferred way; null for all else.
  const OrientedCrystals* oriented() const { return oriented_.get(); }
  /// Size nodes [um]; {1} for a function in closed form.
  const std::vector<double>& size_nodes_um() const { return size_um_; }
  /// Ends of the size nodes; both 1 for a function in closed form.
  double smallest_size_um() const { return size_um_.front(); }
  double largest_size_um() const { return size_um_.back(); }
  /// Bytes held by all arrays.
  std::size_t memory_bytes() const;

 private:
  struct Place {
    int node;     // the lower one
    float share;  // of the upper one; 0 where there is none
  };
  Place place_of(float size_um) const;
  Spectrum read(const std::vector<float>& values, Place place, const Wavelengths& wavelengths) const;
  void set_sizes(const std::vector<double>& size_um);
  void make_wavelength_grid(double first_nm, double last_nm);

  ScatteringTable table_;
  std::unique_ptr<const SphereTable> lobes_;
  std::unique_ptr<const OrientedCrystals> oriented_;
  PhaseFunction function_;  // where there is no table
  std::vector<double> size_um_;
  std::vector<float> log_size_;
  std::vector<unsigned short> guide_;  // cell of ln size: the node below its start
  float guide_scale_ = 0;
  int wavelength_count_ = 0;
  double first_wavelength_nm_ = 0, wavelengths_per_nm_ = 0;
  std::vector<float> extinction_ratio_, albedo_;  // [size][uniform wavelength]
  std::vector<std::vector<float>> directed_extinction_ratio_;  // [sine node], each as extinction_ratio_
  float largest_extinction_ratio_ = 1;
};

}  // namespace arcus::phase
