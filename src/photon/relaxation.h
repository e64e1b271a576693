#pragma once
// Photon relaxation: photons of a caustic push one another aside until they lie evenly, so that a density estimate from few of them is calm and the
// caustic's edges stay sharp. Our form of the idea of B. Spencer and M. Jones ("Into the Blue: Better Caustics through Photon Relaxation",
// Computer Graphics Forum 28(2), 2009; "Photon Parameterisation for Robust Relaxation Constraints", 32(2), 2013). No photon's share of the light is
// touched, so what falls on a surface in all is exact. Biased all the same: light moves by less than the spacing of photons.

#include <functional>
#include <optional>
#include <vector>

#include "src/photon/photon.h"
#include "src/shape/surfaces.h"

namespace arcus::render {

struct Relaxation {
  int iterations = 12;          ///< at most
  int neighbours = 24;          ///< that push a photon, all of its own ancestry: crossing sheets of light do not disturb each other
  double strength = 0.3;        ///< of the push; 0.6 would never settle
  double reach = 1.75;          ///< how far it reaches, in spacings
  double longest_move = 0.4;    ///< in one iteration, in spacings
  /// Where a photon's neighbours lie to one side, it is at an edge and must not leave it: their centroid's distance over the radius where moves
  /// across begin to be held back, and from where on there are none.
  double edge_begins = 0.2, edge_holds = 0.3;
  double enough = 0.02;         ///< it stops when the mean move is less, in spacings
  /// Photons of parted colours push those of like colour besides, farther away, so that each colour lies evenly: in so many parts of the
  /// visible range. 1: no difference of colours.
  int wavelength_bands = 4;
  double colour_strength = 0.1; ///< of that push
};

/// What came of it.
struct Relaxed {
  int iterations = 0;
  double last_move = 0;  ///< mean of the last one, in spacings
};

/// Moves the photons on their surfaces; the borders of a surface are walls. In parallel; the same bits for any number of threads.
/// Nothing, and photons half-way, where must_stop says so before an iteration.
std::optional<Relaxed> relax_until(std::vector<Photon>& photons, const Surfaces& surfaces, const Relaxation& relaxation, const std::function<bool()>& must_stop);
Relaxed relax(std::vector<Photon>& photons, const Surfaces& surfaces, const Relaxation& relaxation);

}  // namespace arcus::render
