#pragma once
// Where the halos that have names stand in the sky, in closed form: W. Tape, Atmospheric Halos (1994); W. Tape and J. Moilanen,
// Atmospheric Halos and the Search for Angle x (2006); R. Greenler, Rainbows, Halos, and Glories (1980).

#include <string>
#include <vector>

#include "phase/crystal/crystal_population.h"

namespace arcus::phase {

struct HaloPlace {
  double azimuth_deg;    ///< from the sun's, clockwise, -180 ... 180
  double elevation_deg;
};

struct NamedHalo {
  std::string name;
  std::vector<HaloPlace> places;  ///< points of it, those that observers look for first
};

/// Those that crystals without tilt can make under a sun at that elevation; n: index of ice relative to air. Below the horizon, too.
/// Pillars take the tilt that the crystals have.
std::vector<NamedHalo> named_halos(const CrystalSettings& crystals, double n, double sun_elevation_deg);

}  // namespace arcus::phase
