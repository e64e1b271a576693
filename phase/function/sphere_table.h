#pragma once
// The phase functions of randomly oriented or spherical particles as the renderer reads them: over effective size,
// wavelength and scattering angle, arranged so that the four wavelengths of a path at one angle lie together, with
// all that is needed to draw from them exactly.
//
// Between angle nodes a phase function is linear in s = sin²(θ/2); between the nodes of the fine wavelength grid it is
// linear in wavelength; between sizes a caller picks a node at random. value() and draw() describe the same function,
// so a drawn direction always has value equal to density.

#include <cstdint>
#include <vector>

#include "phase/base/random.h"
#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "phase/function/half_angle.h"
#include "phase/population/scattering_table.h"

namespace arcus::phase {

struct SphereTableOptions {
  /// Radius of the sun's disc that sunlit values are averaged over [rad]; 0: no sunlit values are made.
  double sun_angular_radius_rad = 0;
  /// Remove the forward lobe where the table declares a forward fraction. The remaining function is renormalised to 1;
  /// the caller scales cross-sections by (1 − forward_fraction).
  bool clip_forward_lobe = true;
  /// Step of the fine wavelength grid [nm], > 0; rounded so that it divides the table's range.
  double wavelength_step_nm = 2.5;
};

class SphereTable {
 public:
  explicit SphereTable(const ScatteringTable& table, const SphereTableOptions& options = {});

  int size_count() const { return size_count_; }
  int angle_count() const { return static_cast<int>(nodes_.size()); }
  int wavelength_count() const { return wavelength_count_; }
  /// Wavelength of a node of the fine grid [nm].
  double wavelength_nm(int node) const { return first_wavelength_nm_ + node * wavelength_step_nm_; }
  /// Angle of a node; ascending from θ = 0 to 180°.
  HalfAngle angle(int node) const { return {nodes_[node].sin2, nodes_[node].cos2}; }
  bool includes_sun_disc() const { return !sunlit_.empty(); }
  /// Bytes held by the arrays.
  std::size_t memory_bytes() const;

  /// Phase function of a size node at an angle [1/sr]. Wavelengths beyond the table's are taken at its ends.
  Spectrum value_per_sr(int size, const HalfAngle& angle, const Wavelengths& wavelengths) const;
  /// The same averaged over the sun's disc; `angle` is to the disc's centre. Only where includes_sun_disc().
  Spectrum sunlit_value_per_sr(int size, const HalfAngle& angle, const Wavelengths& wavelengths) const;

  struct AngleDraw {
    HalfAngle angle;
    Spectrum value_per_sr;
  };
  /// An angle distributed as value_per_sr at the first wavelength, and the values there at all four.
  AngleDraw draw(int size, const Wavelengths& wavelengths, Random& random) const;

  /// Mean cosine at a node of the fine grid: of what value_per_sr gives, clipped lobe left out.
  double asymmetry(int size, int wavelength_node) const;
  /// Value at a node of both grids [1/sr].
  float node_value_per_sr(int size, int angle_node, int wavelength_node) const {
    return value_[index(size, angle_node) + wavelength_node];
  }

 private:
  /// An angle node and what interpolation towards the next one needs.
  struct Node {
    double sin2, cos2;  // HalfAngle of the node
    double width;       // in sin², to the next node, without cancellation at either end; 0 at the last
    double per_width;   // 1/width
  };
  struct Place;     // a position between two angle nodes
  struct Columns;   // positions between the nodes of the fine wavelength grid

  std::size_t index(int size, int angle_node) const {
    return (static_cast<std::size_t>(size) * nodes_.size() + angle_node) * wavelength_count_;
  }
  Place place_of(const HalfAngle& angle) const;
  Columns columns_of(const Wavelengths& wavelengths) const;
  Spectrum read(const std::vector<float>& values, int size, const Place& place, const Columns& columns) const;
  void set_angles(const std::vector<double>& angle_deg);
  void make_cumulative();
  void make_cumulative(int size);

  int size_count_ = 0, wavelength_count_ = 0;
  double first_wavelength_nm_ = 0, wavelength_step_nm_ = 1;
  std::vector<Node> nodes_;  // ascending angle
  // The interval in which a cell begins, seen from 0 and from 180°; cells uniform in sin(θ/2) and in cos(θ/2).
  std::vector<std::uint16_t> forward_guide_, backward_guide_;
  std::vector<float> value_;   // [size][angle][wavelength], wavelength fastest, 1/sr
  std::vector<float> sunlit_;  // the same, averaged over the sun's disc; empty without one
  // [size][wavelength][angle], angle fastest: probability of a smaller angle, in units of 1/(2^32 − 1).
  std::vector<std::uint32_t> cumulative_;
  std::vector<std::uint16_t> draw_guide_;  // [size][wavelength][cell of probability]: the interval in which it begins
};

}  // namespace arcus::phase
