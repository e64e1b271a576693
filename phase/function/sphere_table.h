#pragma once
// The phase functions of randomly oriented or spherical particles as the renderer reads them: over
// effective size, wavelength and scattering angle, arranged so that the four wavelengths of a path
// at one angle lie together, with all that is needed to draw from them exactly.
//
// Between angle nodes a phase function is linear in s = sin²(θ/2); between the nodes of the fine
// wavelength grid it is linear on that grid; between sizes a caller picks a node at random. value
// and draw describe the same function, so a drawn direction always has value equal to density.

#include <cstdint>
#include <vector>

#include "phase/base/random.h"
#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "phase/function/half_angle.h"
#include "phase/function/large_vector.h"
#include "phase/function/wavelength_grid.h"
#include "phase/optics/sun_disc.h"
#include "phase/population/scattering_table.h"

namespace arcus::phase {

struct SphereTableOptions {
  /// Radius of the sun's disc that sunlit values are averaged over [rad]; 0: none are made.
  double sun_angular_radius_rad = 0;
  /// How bright that disc is from its centre to its edge.
  DiscKind disc = DiscKind::limb_darkened;
  /// Remove the forward lobe where the table declares a forward fraction. What is left is
  /// renormalised to 1; the caller scales cross-sections by (1 − forward_fraction). A forward
  /// fraction that is in no p11 (forward_angle_deg = 0) is left out in either case.
  bool clip_forward_lobe = true;
  /// Nodes of the fine wavelength grid, at least 2; 0: as many as bring the error of linear
  /// interpolation below 0.2 %, between 41 and what largest_memory_bytes allows.
  int wavelength_nodes = 0;
  /// Bound on the automatic number of nodes.
  std::size_t largest_memory_bytes = 300'000'000;
};

class SphereTable {
 public:
  /// Takes 1 s for 24 sizes × 2000 angles × 300 fine wavelengths on two cores. The table is not kept.
  explicit SphereTable(const ScatteringTable& table, const SphereTableOptions& options = {});

  int size_count() const { return size_count_; }
  int angle_count() const { return static_cast<int>(angles_.size()); }
  /// Angle of a node; ascending from θ = 0 to 180°. The table's nodes, and 90°.
  HalfAngle angle(int node) const { return angles_[node]; }
  /// The fine wavelength grid of values and draws.
  const WavelengthGrid& wavelengths() const { return plain_.grid; }
  bool includes_sun_disc() const { return !sunlit_.values.empty(); }
  /// Bytes held by the arrays.
  std::size_t memory_bytes() const;

  /// Phase function of a size node at an angle [1/sr]. Wavelengths beyond the table's are taken at
  /// its ends.
  Spectrum value_per_sr(int size, const HalfAngle& angle, const Wavelengths& wavelengths) const;
  /// The same averaged over the sun's disc; `angle` is to the disc's centre. Only where
  /// includes_sun_disc().
  Spectrum sunlit_value_per_sr(int size, const HalfAngle& angle,
                               const Wavelengths& wavelengths) const;

  struct AngleDraw {
    HalfAngle angle;
    Spectrum value_per_sr;
  };
  /// An angle distributed as value_per_sr at the first wavelength, and the values there at all four.
  AngleDraw draw(int size, const Wavelengths& wavelengths, Random& random) const;

  /// Mean cosine at a node of the fine grid, of what value_per_sr gives: a clipped lobe left out.
  double asymmetry(int size, int wavelength_node) const;

 private:
  /// An interval between neighbouring angle nodes, in a key that has full relative precision at
  /// both ends: s = sin²(θ/2) up to 90°, which is always a node, and −cos²(θ/2) beyond.
  struct Interval {
    double low, high;  // keys at its ends
    double per_width;  // 1/(high − low)
    double width() const { return high - low; }
  };
  /// Values [size][angle][wavelength], wavelength fastest [1/sr].
  struct Layer {
    WavelengthGrid grid;
    LargeVector<float> values;
  };
  struct Place;    // a position between two angle nodes
  struct Columns;  // positions between the nodes of a wavelength grid

  std::size_t row(const WavelengthGrid& grid, int size, int angle_node) const {
    return (static_cast<std::size_t>(size) * angles_.size() + angle_node) * grid.count();
  }
  Place place_of(const HalfAngle& angle) const;
  static Columns columns_of(const WavelengthGrid& grid, const Wavelengths& wavelengths);
  Spectrum read(const Layer& layer, int size, const Place& place, const Columns& columns) const;

  void set_angles(const std::vector<double>& angle_deg);
  void normalise(Layer& layer) const;
  void make_cumulative(int size);

  int size_count_ = 0;
  std::vector<HalfAngle> angles_;     // [angle]
  std::vector<Interval> intervals_;   // [angle], one fewer
  // The interval in which a cell begins; cells in the order of angle, see sphere_table_guides.h.
  std::vector<std::uint16_t> angle_guide_;
  Layer plain_, sunlit_;  // sunlit_: averaged over the sun's disc; no values without one
  // [size][wavelength][angle], angle fastest: probability of a smaller angle, in 1/(2^32 − 1).
  LargeVector<std::uint32_t> cumulative_;
  // [size][wavelength][cell of probability]: the interval in which the cell begins.
  LargeVector<std::uint16_t> draw_guide_;
};

}  // namespace arcus::phase
