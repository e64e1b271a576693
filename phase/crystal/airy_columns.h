#pragma once
// Diffraction by the shadows of hundreds of crystals at once: small turns of their light, drawn from the pattern of
// silhouette_diffraction.h.

#include <vector>

#include "phase/crystal/orientation_columns.h"

namespace arcus::phase {

class AiryColumns {
 public:
  AiryColumns();

  /// By ray: cosine of the angle of turning, and its sine times cosine and sine of the azimuth.
  struct Turns {
    Column cosine, side, other;
  };
  /// size_parameter: of the disc as large as the shadow.
  void draw(const Column& size_parameter, RandomColumns& random, Turns& turns) const;

 private:
  std::vector<float> squares_;  ///< of v by -ln(1 - share within v), evenly spaced
};

/// Turns directions (unit) about axes of their own.
void turn(const AiryColumns::Turns& turns, VectorColumns& directions);

}  // namespace arcus::phase
