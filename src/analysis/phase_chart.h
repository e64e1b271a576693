#pragma once
// A phase function as charts: curves by colour, the colours of sunlight that it scatters, and a
// polar diagram.

#include <optional>
#include <string>
#include <vector>

#include "phase/base/curve.h"
#include "phase/species/species.h"
#include "src/analysis/chart.h"

namespace arcus::render {

struct PhaseChartSettings {
  double size_um = 0;                                ///< which size of the species
  std::vector<double> wavelength_nm{650, 550, 450};  ///< a curve each
  std::vector<double> angle_deg;                     ///< scattering angles, ascending
  bool with_sun_disc = true;  ///< averaged over the sun's disc, as the sky shows it
  std::string title;
};

/// Curves on a logarithmic axis, with two strips of the colour that a thin cloud of such particles
/// shows by the scattering angle in sunlight of the given spectrum: as it is, and divided by the
/// mean around (so that rings show).
LineChart phase_chart(const phase::Species& species, const Curve& sun_irradiance,
                      const PhaseChartSettings& settings);

/// The same curves around the particle, light coming from the left, logarithmic radius.
PolarChart phase_polar_chart(const phase::Species& species, const PhaseChartSettings& settings);

/// Scattering angles as fine as a chart needs: 0.02° near 0 and 180°, 0.1° between.
std::vector<double> chart_angles_deg(double from_deg, double to_deg);

}  // namespace arcus::render
