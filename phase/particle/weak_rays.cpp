#include "phase/particle/weak_rays.h"

#include <cmath>

#include "phase/particle/airy.h"

namespace arcus::phase {

WeakRays::WeakRays(const RayImages& images, int first_order, int last_order) {
  for (std::size_t angle = 0; angle < images.angles; ++angle) {
    first_.push_back(rays_.size());
    for (int order = first_order; order <= last_order; ++order)
      for (const RayImage& image : images.at(order, angle)) {
        const auto add = [&](const RayImage::Ray& ray, bool first_of_pair) {
          const auto number = [](double x) { return static_cast<float>(x); };
          rays_.push_back(
              {number(ray.incidence_rad), number(std::sin(ray.incidence_rad)),
               number(ray.cos_refraction), image.is_pair() ? number(image.pair.zeta) : -1e30f,
               number(ray.amplitude[0] * ray.amplitude[0]),
               number(ray.amplitude[1] * ray.amplitude[1]),
               number(ray.amplitude[0] * ray.amplitude[1]), static_cast<std::int16_t>(order),
               first_of_pair, static_cast<std::uint32_t>(&image - images.images.data())});
        };
        if (image.has_inner) add(image.inner, image.is_pair());
        if (image.has_outer) add(image.outer, false);
      }
  }
  first_.push_back(rays_.size());
}

void WeakRays::add_to(AmplitudeProducts& sums, const RayImages& images, std::size_t angle,
                      std::span<const EdgeWindow> windows, const RaySphere& sphere) const {
  const double x = sphere.size_parameter, root3 = sphere.root3;
  for (std::size_t i = first_[angle]; i < first_[angle + 1]; ++i) {
    const Ray& ray = rays_[i];
    const EdgeWindow& window = windows[static_cast<std::size_t>(ray.order)];
    if (window.everything || ray.sine > window.whole_from_sine) continue;
    double weight = x * x * (1 - window.value_at(ray.incidence_rad));
    if (sphere.absorption > 0)
      weight *= std::exp(-4 * sphere.absorption * x * ray.order * ray.cos_refraction);
    const double z = ray.zeta * root3 * root3;
    if (z < -20) {
      sums.i1 += weight * ray.s11;
      sums.i2 += weight * ray.s22;
      sums.i3 += weight * ray.s12;
    } else if (ray.first_of_pair) {  // near the bow the pair is one
      const RayImage::Pair& pair = images.images[ray.image].pair;
      const AiryValues a = airy(z);
      const double p0 = root3 * a.ai * a.ai * weight, p1 = a.ai_slope * a.ai_slope / root3 * weight;
      sums.i1 += p0 * pair.g0[0] * pair.g0[0] + p1 * pair.g1[0] * pair.g1[0];
      sums.i2 += p0 * pair.g0[1] * pair.g0[1] + p1 * pair.g1[1] * pair.g1[1];
      sums.i3 += p0 * pair.g0[0] * pair.g0[1] + p1 * pair.g1[0] * pair.g1[1];
    }
  }
}

}  // namespace arcus::phase
