#pragma once
// Fields near the axis of a sphere, straight on and straight back: plain waves from both sides
// become Bessel functions, and the polarisations mix.

#include <complex>

namespace arcus::phase {

/// u: distance of a ring of light from the axis, in partial waves, times the angle from the axis.
inline constexpr double far_from_axis =
    60;  ///< beyond this u Bessel functions are plain waves within 1/100 of phase
inline constexpr double at_axis = 2;  ///< below it both sides of a ring are one

/// H1'(u) and H1(u)/u against sqrt(2 / (pi u)) exp(i (u - pi/4)): what becomes of a wave with
/// exp(+i l theta), in its own polarisation and mixed into the other (van de Hulst 1957,
/// section 13.31). At the axis each side gets half of both, J1 instead of H1.
struct AxisFactors {
  std::complex<double> own{1, 0}, mixed{0, 0};
};
/// u above 0; beyond far_from_axis the factors of a plain wave.
AxisFactors axis_factors(double u);

/// Applies the factors to a wave of one side (+1, -1). Straight back the sides are exchanged and
/// the mixed part changes sign.
void apply_axis(const AxisFactors& factors, int side, bool back, std::complex<double>& s1,
                std::complex<double>& s2);

/// The same for powers of waves of random phase, both sides together, relative to plain waves:
/// |S1|^2 gets own of its own polarisation and mixed of the other, S2 S1* gets both of each.
/// Fringes of u are averaged over sizes, see fringe_left.
struct AxisPowers {
  double own = 1, mixed = 0, both = 0;
};
/// x_sine: u with the sine in place of the angle.
AxisPowers axis_powers(double u, double x_sine, bool back, double relative_step);

/// The field of a ring of partial waves around u, both sides together, given its zeroth moment and
/// the first one relative to u: J1'(u) and J1(u)/u, expanded.
struct AxisExpansion {
  double own, own_first, mixed, mixed_first;
};
AxisExpansion axis_expansion(double u);

/// Bessel functions: J0(u), J1(u)/u, and for u above 0 H0(u) and H1(u) of the first kind.
double j0_of(double u);
double j1_over(double u);
struct HankelValues {
  std::complex<double> zeroth, first;
};
HankelValues hankel(double u);

}  // namespace arcus::phase
