#pragma once
// How the features of a drop's phase function move with wavelength. Bows shift with the refractive index, their
// supernumeraries open as wavelength^(2/3) (Airy), the rings of corona and glory as wavelength. Between two wavelengths
// 10 nm apart the bow of a 1 mm drop moves by its own width, so that values at one fixed angle cannot be interpolated;
// values along a track can.
//
// Tracks are found in the table itself: nothing is assumed about the material. Where a table shows no bow (small
// particles, other shapes) nothing moves. Tracks only choose where to interpolate; an imperfect one costs accuracy,
// never consistency.

#include <array>
#include <span>
#include <vector>

namespace arcus::phase {

class FeatureTracks {
 public:
  /// Angles ascending from 0 to 180 [deg]; rows: p11 of one size, [wavelength][angle]; rings_in_front: the forward
  /// lobe was not clipped, so that its rings are there.
  FeatureTracks(const std::vector<double>& angle_deg, const std::vector<double>& wavelength_nm,
                std::span<const float> rows, double size_um, bool rings_in_front);

  bool anything_moves() const { return !angle_deg_.empty(); }

  /// What moves the surroundings of an angle: shares of both bows and of the rings.
  struct Mover {
    double primary, secondary, faint;  ///< shares of the bows' own shifts
    double opening;                    ///< share × angle from the bow's maximum [deg]
    double ring;                       ///< share × angle from 0 or, negative, from 180° [deg]
  };
  /// What moves every angle node at a wavelength, to be followed between low_nm and high_nm. Only
  /// where anything_moves().
  void movers(double wavelength_nm, double low_nm, double high_nm, std::span<Mover> mover) const;

  /// Where what moves does so from one wavelength to another, smoothly in both.
  struct Shift {
    double primary, secondary, faint;  // of the bows [deg]
    double opening, ring;              // relative
    double of(const Mover& m) const {
      return m.primary * primary + m.secondary * secondary + m.faint * faint +
             m.opening * opening + m.ring * ring;
    }
  };
  Shift shift(double from_nm, double to_nm) const;

  /// Angle of the maximum of a bow.
  struct Track {
    bool found = false;
    double first_nm = 0, last_nm = 0;      ///< where it was found
    double centre = 0, half_range = 1;     // of t = 1e5 / wavelength²
    std::array<double, 4> coefficients{};  // of powers of (t − centre)/half_range [deg]
    double at_nm(double wavelength_nm) const;
  };
  /// The bow of one internal reflection, of two, and a fainter one in the dark between them, which
  /// may merge with one of them beyond some wavelength.
  const Track& primary() const { return primary_; }
  const Track& secondary() const { return secondary_; }
  const Track& faint() const { return faint_; }

 private:
  std::vector<double> angle_deg_;  // empty where nothing moves
  double middle_nm_ = 0;
  double unit_deg_ = 0;        // Airy's unit of angle in the first bow at middle_nm_
  double ring_range_deg_ = 0;  // reach of the rings at middle_nm_
  bool rings_in_front_ = false;
  Track primary_, secondary_, faint_;
};

}  // namespace arcus::phase
