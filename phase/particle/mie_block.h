#pragma once
// Scattering matrices of many spheres at many angles, fast: what tables of droplets are made from.
//
// The Lorenz-Mie series of a sphere, with N ~ x terms, is a polynomial of degree N in cos(theta).
// Instead of adding N terms at every angle (Wiscombe 1980), its coefficients are turned into those
// of a cosine series, the series is summed on a uniform grid by a fast Fourier transform, and the
// angles asked for are interpolated from the grid, a fixed number of points each. So the work grows
// as N log N + angles, not as N x angles. In detail: see the source.

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

#include "phase/particle/instructions.h"
#include "phase/particle/scattering.h"

namespace arcus::phase {

/// Spheres that are computed together. Calls are fastest with multiples of this many, in order of
/// size: a block costs what its largest sphere costs.
inline constexpr int mie_block_radii = 16;

/// Elements of the scattering matrix in the order of mie_block's result.
inline constexpr int mie_block_elements = 4;

/// The scattering angles of a table, and what can be prepared for them. Immutable: threads can
/// share one.
class MieAngles {
 public:
  /// scattering_angles_rad: 0 ... pi, in any order, at least one; neighbours in memory are best
  ///   neighbours in angle.
  /// largest_size_parameter: of all spheres that will be asked for, at most 1e5.
  /// For 4000 angles and x up to 1e4 it takes 0.1 s and 10 MB. Throws bad_input for values outside
  /// these ranges.
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

/// Up to mie_block_radii spheres of one material at one wavelength: computed at once, then asked
/// for their matrices, a run of angles at a time, so that who averages over sizes can do so while
/// the numbers are in the cache. Holds the memory it works in, of which about 1.2 kB times size
/// parameter are touched, for reuse: one object for each thread.
class MieBlock {
 public:
  /// `angles` must outlive the block.
  explicit MieBlock(const MieAngles& angles, Instructions instructions = best_instructions());
  ~MieBlock();
  MieBlock(MieBlock&&) noexcept;
  MieBlock& operator=(MieBlock&&) noexcept;

  /// size_parameters: x = 2 pi r / wavelength, 1e-3 ... angles.largest_size_parameter(), one to
  ///   mie_block_radii of them.
  /// relative_index: m = n + ik as for mie_sphere; |m| <= 1000.
  /// Replaces the spheres of the call before. Throws bad_input for values outside these ranges.
  void compute(std::span<const double> size_parameters, std::complex<double> relative_index);

  /// Of the spheres in the order of their size parameters.
  std::span<const SphereEfficiencies> efficiencies() const;

  /// Scattering matrices at the angles first ... first + count - 1 of MieAngles.
  /// matrix: [radius][element][angle], angle fastest, radii x mie_block_elements x count numbers:
  ///   i11 = (|S1|^2 + |S2|^2)/2, i12 = (|S2|^2 - |S1|^2)/2, i33 = Re(S2 S1*), i34 = Im(S2 S1*).
  /// The phase function is i11 / (pi x^2 Q_sca) per steradian. Fastest with multiples of 64 angles.
  void matrix(std::size_t first, std::size_t count, std::span<float> matrix) const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Scattering matrices and efficiencies of any number of spheres of one material at one wavelength,
/// in blocks of mie_block_radii from the start of the list, best in order of size. Arguments as for
/// MieBlock.
/// matrix: [radius][element][angle], angle fastest: size_parameters.size() x mie_block_elements x
///   angles.size() numbers.
/// efficiencies: [radius].
///
/// Accuracy against mie_sphere, for |m - 1| > 1e-3: efficiencies 1e-9, relative; matrix 1e-6 of the
/// largest |S1|^2 and |S2|^2 within half an oscillation, 90 degrees/x, of the angle (5e-6 above
/// x = 1e4).
/// Can be called from many threads at once. The last bits of a sphere's numbers depend on its
/// neighbours in the block: who splits a list among threads splits at multiples of
/// mie_block_radii, and gets the same bits for any number of threads.
void mie_block(const MieAngles& angles, std::span<const double> size_parameters,
               std::complex<double> relative_index, std::span<float> matrix,
               std::span<SphereEfficiencies> efficiencies,
               Instructions instructions = best_instructions());

}  // namespace arcus::phase
