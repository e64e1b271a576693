#pragma once
// Diffraction by the shadow of a crystal: the Airy pattern of the disc with the same area.
// Fraunhofer's formula in the form (x^2 / 4 pi) (2 J1(v) / v)^2 (Bohren & Huffman 1983,
// section 4.4.3), taken with v = 2 x sin(theta / 2) in place of x sin(theta): equal where
// diffraction is strong, and the integral over the sphere is known in closed form.
//
// A body larger than the wavelength takes twice its shadow out of a beam; this is what becomes of
// the half that it does not hit.

namespace arcus::phase {

class SilhouetteDiffraction {
 public:
  /// projected_area_um2: of the crystal towards the light, above 0; vacuum wavelength [nm].
  SilhouetteDiffraction(double projected_area_um2, double wavelength_nm);

  /// Phase function [1/sr] at sin^2 of half the scattering angle; its integral over the sphere
  /// is 1.
  double value_per_sr(double sin2_half) const;
  /// Share of the light within that angle: 1 - J0^2 - J1^2 of v (Rayleigh 1881) over its value for
  /// the sphere.
  double share_within(double sin2_half) const;
  /// sin^2 of half the angle that the share u in [0, 1) of the light stays within: a draw for a
  /// uniform u.
  double draw_sin2_half(double u) const;

  double size_parameter() const { return x_; }  ///< of the disc
  /// Full width at half maximum [rad]; 1.03 wavelengths over the disc's diameter.
  double width_rad() const;

 private:
  double x_, whole_;
};

}  // namespace arcus::phase
