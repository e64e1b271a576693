#pragma once
// The field of one of Debye's orders in one direction: a few waves whose phases grow differently
// with the size of the sphere.

#include <complex>

namespace arcus::phase {

/// Sums of |S1|^2, |S2|^2 and S2 S1*.
struct AmplitudeProducts {
  double i1 = 0, i2 = 0;
  std::complex<double> i3 = 0;
  void add(const AmplitudeProducts& other, double factor) {
    i1 += factor * other.i1;
    i2 += factor * other.i2;
    i3 += factor * other.i3;
  }
};

class OrderField {
 public:
  struct Wave {
    std::complex<double> s1, s2;
    double turn = 0;  ///< phase as it grows with the size: x times the wave's optical path in radii
    bool known = false;   ///< the turn is set
    bool used = false;    ///< it has light
    bool phased = false;  ///< exp(i turn) is already part of s1 and s2
  };

  /// The four that every order may have: side +1 or -1 of the axis, branch 0 (inside of the bow)
  /// or 1.
  Wave& slot(int side, int branch) { return waves_[(side > 0 ? 0 : 2) + branch]; }
  /// One of those that a few directions have beyond.
  Wave& extra() { return waves_[extras_ < most ? extras_++ : most - 1]; }

  /// Forgets all waves.
  void clear();
  /// Gives every wave its phase, so that others can be added to it.
  void apply_phases();
  /// Adds the products of the field. Fringes are averaged over sizes with a hat function whose half
  /// width is relative_step: each pair of waves keeps fringe_left of its difference of turns.
  void add_to(AmplitudeProducts& sums, double relative_step);

 private:
  static constexpr int most = 8;
  Wave waves_[most];
  int extras_ = 4;
};

/// Share of a fringe that the hat function leaves, sinc^2(relative_step turn / 2), up to its first zero
/// and nothing beyond. `turn` grows in proportion to the size.
double fringe_left(double relative_step, double turn);

}  // namespace arcus::phase
