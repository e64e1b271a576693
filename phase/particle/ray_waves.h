#pragma once
// The waves that the rays of one order make in one direction, at one size.

#include <span>

#include "phase/particle/edge_window.h"
#include "phase/particle/order_field.h"
#include "phase/particle/ray_images.h"

namespace arcus::phase {

/// A sphere as rays see it.
struct RaySphere {
  double size_parameter, root3;  ///< x and its cube root
  double absorption;             ///< k
};

/// Adds the images of one order at one angle, which lies in the back hemisphere or not, less the
/// share of the window. Sets the turns of the waves also where the window leaves no light: edge
/// waves that stand for the same rays take them.
void add_rays(std::span<const RayImage> images, const RaySphere& sphere, const EdgeWindow& window,
              bool back, OrderField& field);

}  // namespace arcus::phase
