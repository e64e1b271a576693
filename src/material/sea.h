#pragma once
// The sea to the horizon: waves too small to be seen one by one, as a distribution of slopes, each a smooth piece of water (Fresnel); light from
// below the surface; and foam.
//
// Slopes: normal, with the variances that C. Cox and W. Munk measured in sun glitter, "Measurement of the roughness of the sea surface from
// photographs of the sun's glitter", J. Opt. Soc. Am. 44, 838 (1954), for a wind W [m/s] at 12.5 m, 1 to 14 m/s: across the wind 0.003 + 0.00192 W,
// along it 0.00316 W, or 0.003 + 0.00512 W in all, shared evenly; skewness and peakedness are left out. Waves hide and shade one another by Smith's
// function with correlated heights (E. Heitz, "Understanding the masking-shadowing function in microfacet-based BRDFs", JCGT 3(2), 48, 2014); slopes are drawn as they are seen (E. Heitz and E. d'Eon, "Importance sampling microfacet-based BSDFs using the distribution of
// visible normals", EGSR 2014). What is reflected into another wave is lost: docs/sea.md says how much. Light is taken to be natural and leaves as
// such.
//
// From below the surface: a share R of the light that has come through the surface is sent back evenly, and leaves through the surface, part of it
// after having been reflected down again (A. Morel and B. Gentili, Applied Optics 35, 4850, 1996). Foam: coverage 2.95e-6 W^3.52 (E. Monahan and I.
// O'Muircheartaigh, J. Phys. Oceanogr. 10, 2094, 1980), matte, of reflectance 0.22 (P. Koepke, Applied Optics 23, 1816, 1984).

#include <array>

#include "phase/base/random.h"
#include "src/material/clear_body.h"
#include "src/material/smooth_spectrum.h"

namespace arcus::render {

/// Variances of the slopes along the wind and across it.
struct SlopeVariance {
  double along, across;
};
/// After Cox and Munk; evenly shared or by direction. Not below 1e-6, a smooth sea.
SlopeVariance cox_munk_slopes(double wind_m_per_s, bool is_isotropic);
/// Share of the sea that foam covers, at most 1.
double foam_cover(double wind_m_per_s);

class Sea {
 public:
  /// wind_from_deg: compass azimuth; water_reflectance: of the light below the surface, how much comes back, at most 0.5.
  Sea(const ClearBody& water, const SlopeVariance& slopes, double wind_from_deg, const SmoothSpectrum& water_reflectance, double foam);

 private:
  friend class SeaView;
  ClearBody water_;
  SmoothSpectrum water_reflectance_;
  double foam_;
  Vec3 upwind_;
  double width_along_, width_across_;       // sqrt(2 variance): Beckmann's roughness
  double index_, inner_reflectance_, mean_water_reflectance_;  // at 550 nm, 550 nm, over the visible range
};

/// The sea at a place, as it is seen from a direction.
class SeaView {
 public:
  /// normal and back (towards the eye): unit, on the same side.
  SeaView(const Sea& sea, const Vec3& normal, const Vec3& back, const Wavelengths& wavelengths);

  /// Radiance towards the eye per irradiance from a direction [1/sr]; 0 behind the surface.
  Spectrum value_per_sr(const Vec3& away) const;
  /// Density of draw() [1/sr] in a direction on the surface's side; the same for all wavelengths. It adds up to less than 1: some draws go into other
  /// waves.
  double density_per_sr(const Vec3& away) const;
  /// A direction from which much of the light comes; where it points behind the surface, the light is lost.
  Vec3 draw(Random& random) const;

 private:
  struct Local {
    double x, y, z;  // along the wind, across, up
  };
  Local local(const Vec3& v) const { return {dot(v, along_), dot(v, across_), dot(v, normal_)}; }
  double smith(const Local& v) const;        // Λ
  double normals(const Local& half) const;   // D, per projected area
  double visible_slope(double u) const;      // along the view, in units of the roughness

  const Sea& sea_;
  Vec3 normal_, along_, across_;
  Local back_;
  double smith_back_;
  double cosine_, sine_, turn_x_, turn_y_;   // of the view where the roughness is 1 both ways
  double specular_share_;                    // of the draws
  std::array<double, wavelength_count> index_;
  Spectrum from_below_;                      // what is the same for all directions of the light, with the way out
};

}  // namespace arcus::render
