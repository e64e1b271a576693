#pragma once
// Amplitude coefficients of a plane interface (Fresnel). Time factor exp(-i omega t), m = n + ik
// with k >= 0 absorbing; sign of the parallel coefficient after Bohren & Huffman (1983),
// equations 2.67 ... 2.70: at normal incidence r_parallel = -r_perpendicular.

#include <complex>

namespace arcus::phase {

/// Amplitudes for an incident field of 1. For real m below total reflection the transmitted power
/// is m cos_transmitted / cos_incident |t|^2, and with the reflected |r|^2 it makes 1.
struct FresnelAmplitudes {
  std::complex<double> r_perpendicular, r_parallel, t_perpendicular, t_parallel;
  std::complex<double> cos_transmitted;
};

/// Light that arrives under the angle with this cosine (0 ... 1) at a medium whose index is
/// `relative_index` times that of where it comes from. Total reflection gives |r| = 1 and an
/// imaginary cos_transmitted. A complex cosine continues the formulas analytically (complex rays on
/// the dark side of a rainbow).
FresnelAmplitudes fresnel_amplitudes(std::complex<double> cos_incident,
                                     std::complex<double> relative_index);

/// Reflected powers for real angle and index: perpendicular and parallel; both 1 under total
/// reflection.
struct FresnelReflectance {
  double perpendicular = 1, parallel = 1;
  double unpolarised() const { return 0.5 * (perpendicular + parallel); }
};
FresnelReflectance fresnel_reflectance(double cos_incident, double relative_index);

}  // namespace arcus::phase
