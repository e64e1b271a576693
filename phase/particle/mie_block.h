#pragma once
// Scattering matrices of many spheres at many angles, fast: what tables of droplets are made from.
//
// The Lorenz-Mie series of a sphere, with N ~ x terms, is a polynomial of degree N in cos(theta). Instead of adding
// N terms at every angle (Wiscombe 1980), its coefficients are turned into those of a cosine series, the series is summed
// on a uniform grid by a fast Fourier transform, and the angles asked for are interpolated from the grid, a
// fixed number of points each. So the work grows as N log N + angles, not as N x angles. In detail: see the source.

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

#include "phase/particle/scattering.h"

namespace arcus::phase {

/// Spheres that are computed together. Calls are fastest with multiples of this many, in order of size: a block
/// costs what its largest sphere costs.
inline constexpr int mie_block_radii = 16;

/// Elements of the scattering matrix in the order of mie_block's result.
inline constexpr int mie_block_elements = 4;

/// The scattering angles of a table, and what can be prepared for them. Immutable: threads can share one.
class MieAngles {
 public:
  /// scattering_angles_rad: 0 ... pi, in any order, at least one; neighbours in memory are best neighbours in angle.
  /// largest_size_parameter: of all spheres that will be asked for, at most 1e5.
  /// Takes about 1 us per angle, and memory of about 700 bytes per angle and 200 per unit of size parameter.
  /// Throws bad_input for values outside these ranges.
  MieAngles(std::span<const double> scattering_angles_rad, double largest_size_parameter);
  ~MieAngles();
  MieAngles(MieAngles&&) noexcept;
  MieAngles& operator=(MieAngles&&) noexcept;

  std::size_t size() const;
  double largest_size_parameter() const;

  struct Plan;
  const Plan& plan() const { return *plan_; }

 private:
  std::unique_ptr<const Plan> plan_;
};

/// Which machine code runs. Both give the same bits.
enum class Instructions { avx2, avx512 };

/// The best that this processor has.
Instructions best_instructions();

/// Scattering matrices and efficiencies of spheres of one material at one wavelength.
///
/// size_parameters: x = 2 pi r / wavelength, 1e-3 ... angles.largest_size_parameter(), best in ascending order.
/// relative_index: m = n + ik, as for mie_sphere.
/// matrix: [radius][element][angle], angle fastest: size_parameters.size() x mie_block_elements x angles.size() numbers
///   i11 = (|S1|^2 + |S2|^2)/2, i12 = (|S2|^2 - |S1|^2)/2, i33 = Re(S2 S1*), i34 = Im(S2 S1*).
///   The phase function is i11 / (pi x^2 Q_sca) per steradian.
/// efficiencies: [radius].
///
/// Accuracy against mie_sphere: efficiencies 1e-9; amplitudes 1e-5 of the largest |S1|, |S2| within half an oscillation,
/// 90 degrees/x, of the angle.
/// Runs in the calling thread and can be called from many threads at once. The numbers of a sphere depend on its block
/// of mie_block_radii, counted from the start of the call, so split long lists at multiples of it; in that way they
/// don't depend on the number of threads.
/// Throws bad_input for values outside these ranges.
void mie_block(const MieAngles& angles, std::span<const double> size_parameters, std::complex<double> relative_index,
               std::span<float> matrix, std::span<SphereEfficiencies> efficiencies,
               Instructions instructions = best_instructions());

}  // namespace arcus::phase
