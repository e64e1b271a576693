#pragma once
// The grid of a map of the sky whose left half is the mirror image of its right half: nodes at equal steps of elevation and of
// azimuth from the sun, each in the middle of its cell.

#include <cstddef>
#include <vector>

namespace arcus::phase {

class SkyGrid {
 public:
  /// The nearest step that divides 180 degrees.
  explicit SkyGrid(double step_deg);

  int steps() const { return steps_; }  ///< both ways: a row has steps + 1 nodes, and there are as many rows
  std::size_t row() const { return static_cast<std::size_t>(steps_) + 1; }
  std::size_t size() const { return row() * row(); }
  double step_rad() const;
  double elevation_deg(int row) const { return -90 + 180.0 * row / steps_; }
  double azimuth_deg(int column) const { return 180.0 * column / steps_; }

  /// Solid angle of a cell on one side of the sun's vertical plane or around it, that is, in the whole sky [sr]: the share of
  /// a pole that belongs to its azimuth.
  double cell_sr(int row) const { return cell_sr_[static_cast<std::size_t>(row)]; }
  /// Cells of the whole sky that a cell of this column stands for: itself and its mirror image.
  static double images(int column, int steps) { return column == 0 || column == steps ? 1 : 2; }

 private:
  int steps_;
  std::vector<double> cell_sr_;
};

}  // namespace arcus::phase
