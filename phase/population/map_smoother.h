#pragma once
// Takes the noise out of a map of the sky that rays fell into, without washing out what they show. Every node gets the mean over
// a window around it, the smallest that is known well enough; but windows stop growing where a larger one is at odds with a
// smaller one: where a halo has an edge. (Intersection of confidence intervals: A. Goldenshluger and A. Nemirovski, "On spatially
// adaptive estimation of nonparametric regression", Math. Methods Statist. 6 (1997); V. Katkovnik, IEEE Trans. Signal Process. 47
// (1999), after O. Lepski.)

#include <cstdint>
#include <span>
#include <vector>

#include "phase/population/sky_grid.h"

namespace arcus::phase {

class MapSmoother {
 public:
  /// light, squares: sums over deposits of their weights and of squared weights by cell, [elevation][azimuth], of all wavelengths
  /// together; they decide the windows. noise: relative standard error that is good enough.
  MapSmoother(const SkyGrid& grid, std::span<const float> light, std::span<const float> squares, double noise);

  /// Light by cell becomes light per solid angle [1/sr] at the nodes, smoothed by the windows found. In place; its integral over
  /// the sky stays.
  void smooth(std::span<float> light) const;

  /// Standard error over value, of all wavelengths together; 1 where there is no light at all.
  const std::vector<float>& relative_error() const { return error_; }
  /// Half widths of the windows in steps of elevation; between two of them there are shares of both.
  float half_width(std::size_t cell) const;

 private:
  void choose_levels(std::span<const float> light, std::span<const float> squares, double noise);
  void even_levels();

  const SkyGrid& grid_;
  std::vector<double> band_sr_;  ///< of one column, sum over rows below
  std::vector<float> level_;     ///< [cell]: whole numbers are windows, between are shares of two
  std::vector<float> error_;
};

}  // namespace arcus::phase
