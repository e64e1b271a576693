#pragma once
// What a solver says about one particle at one wavelength: efficiencies and amplitudes.
// Conventions of Bohren & Huffman (1983): time factor exp(-i omega t), index m = n + ik with k >= 0
// absorbing.

#include <complex>
#include <vector>

namespace arcus::phase {

/// Cross-sections of a sphere over its geometric cross-section pi r^2, and the mean cosine.
struct SphereEfficiencies {
  double extinction = 0;   ///< Q_ext = scattering + absorption
  double scattering = 0;   ///< Q_sca, at most extinction
  double backscatter = 0;  ///< radar: 4 |S1(180 deg)|^2 / x^2
  double asymmetry = 0;    ///< mean cosine of the scattering angle; 0 where nothing is scattered
};

/// Efficiencies, and the amplitudes S1 (perpendicular to the scattering plane) and S2 (parallel) at
/// the scattering angles asked for, in their order. The differential cross-section for unpolarised
/// light is (|S1|^2 + |S2|^2) / (2 k^2), with wave number k.
struct SphereAmplitudes {
  SphereEfficiencies efficiencies;
  std::vector<std::complex<double>> s1, s2;
};

}  // namespace arcus::phase
