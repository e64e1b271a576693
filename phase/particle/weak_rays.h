#pragma once
// Rays of the later orders of a large sphere, added as powers: too weak for their fringes to show,
// but together the light of dark places.

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "phase/particle/edge_window.h"
#include "phase/particle/order_field.h"
#include "phase/particle/ray_images.h"
#include "phase/particle/ray_waves.h"

namespace arcus::phase {

class WeakRays {
 public:
  WeakRays() = default;
  /// Of the orders first ... last of the images, which must live as long.
  WeakRays(const RayImages& images, int first_order, int last_order);

  /// Adds what the windows (by order) leave of the rays at one angle.
  void add_to(AmplitudeProducts& sums, const RayImages& images, std::size_t angle,
              std::span<const EdgeWindow> windows, const RaySphere& sphere) const;

 private:
  struct Ray {
    float incidence_rad, sine, cos_refraction, zeta;
    float s11, s22, s12;  // over x^2: |S1|^2, |S2|^2, S2 S1
    std::int16_t order;
    bool first_of_pair;
    std::uint32_t image;
  };
  std::vector<Ray> rays_;
  std::vector<std::size_t> first_;  // [angle]
};

}  // namespace arcus::phase
