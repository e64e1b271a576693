#include "phase/particle/ray_waves.h"

#include <cmath>

#include "phase/particle/airy.h"
#include "phase/particle/near_axis.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

constexpr double nearly_all = 1 - 1e-7;  // share of the window above which nothing is left for rays
constexpr double isolated =
    -20;  // Airy's variable below which the rays of a pair are taken one by one
constexpr double window_may_vary = -5;  // and below which the window may begin to fall (edge_window
                                        // keeps it constant nearer to the bow)
constexpr double dark = -0.01;          // above it both rays are one wave

/// Adds the image's rays to the waves of an order.
class ImageWaves {
 public:
  ImageWaves(const RayImage& image, const RaySphere& sphere, const EdgeWindow& window, bool back,
             OrderField& field)
      : image_(image),
        sphere_(sphere),
        window_(window),
        back_(back),
        field_(field),
        // A second image on one side keeps to itself.
        taken_(field.slot(image.side, inner).known || field.slot(image.side, outer).known) {}

  void add() {
    const double z = image_.pair.zeta * sphere_.root3 * sphere_.root3;
    if (!image_.is_pair() || z < isolated) {
      if (image_.has_inner) add_single(image_.inner, inner);
      if (image_.has_outer) add_single(image_.outer, outer);
    } else {
      add_pair(z);
    }
  }

 private:
  OrderField::Wave& wave_for(int branch, double rate) {
    OrderField::Wave& wave = taken_ ? field_.extra() : field_.slot(image_.side, branch);
    wave.turn = sphere_.size_parameter * rate;
    wave.known = true;
    return wave;
  }

  double left_by_absorption(const RayImage::Ray& ray) const {
    if (sphere_.absorption == 0) return 1;
    return std::exp(-2 * sphere_.absorption * sphere_.size_parameter * image_.order *
                    ray.cos_refraction);
  }

  void add_single(const RayImage::Ray& ray, int branch) {
    OrderField::Wave& wave = wave_for(branch, ray.rate);
    const EdgeWindow::Share share = window_.at(ray.incidence_rad);
    if (share.value < nearly_all) add_ray(ray, share, 1 - share.value, wave);
  }

  /// weight: of the ray itself; the slope and curvature of the window over its Fresnel zone are
  /// added.
  void add_ray(const RayImage::Ray& ray, const EdgeWindow::Share& share, double weight,
               OrderField::Wave& wave) {
    const double x = sphere_.size_parameter, zone = -ray.zone / x;
    const Complex front = x * left_by_absorption(ray) * ray.phase;
    Complex s[2];
    for (int j = 0; j < 2; ++j)
      s[j] =
          front * Complex(weight * ray.amplitude[j], zone * (ray.amplitude[j] * share.curvature +
                                                             ray.amplitude_slope[j] * share.slope));
    if (ray.ring > 0 && x * ray.ring < far_from_axis)
      apply_axis(axis_factors(x * ray.ring), image_.side, back_, s[0], s[1]);
    wave.s1 += s[0];
    wave.s2 += s[1];
    wave.used = true;
  }

  /// Near the bow: (Ai + i Bi)/2 is the inner ray, whose phase lies below the mean, (Ai - i Bi)/2
  /// the outer.
  void add_pair(double z) {
    const bool is_dark = z > dark;
    const RayImage::Pair& pair = image_.pair;
    OrderField::Wave& outside = wave_for(outer, is_dark ? pair.rate : image_.outer.rate);
    OrderField::Wave& inside = wave_for(inner, is_dark ? pair.rate : image_.inner.rate);
    const EdgeWindow::Share in = window_.at(image_.inner.incidence_rad),
                            out = window_.at(image_.outer.incidence_rad);
    if (in.value > nearly_all && out.value > nearly_all) return;
    const AiryValues a = airy(z);
    if (is_dark) {
      add_airy(a.ai, a.ai_slope,
               (1 - 0.5 * (in.value + out.value)) * left_by_absorption(image_.outer), outside);
      return;
    }
    const Complex plus(a.ai, a.bi), plus_slope(a.ai_slope, a.bi_slope);
    add_airy(0.5 * plus, 0.5 * plus_slope, (1 - in.value) * left_by_absorption(image_.inner),
             inside);
    add_airy(0.5 * std::conj(plus), 0.5 * std::conj(plus_slope),
             (1 - out.value) * left_by_absorption(image_.outer), outside);
    if (z < window_may_vary) {
      add_ray(image_.inner, in, 0, inside);
      add_ray(image_.outer, out, 0, outside);
    }
  }

  void add_airy(Complex value, Complex slope, double weight, OrderField::Wave& wave) {
    const RayImage::Pair& pair = image_.pair;
    const double x = sphere_.size_parameter, root6 = std::sqrt(sphere_.root3);
    const Complex front = weight * pair.phase * std::polar(1.0, x * pair.rate - wave.turn);
    const Complex c0 = front * (x * root6) * value, c1 = front * Complex(0, -x / root6) * slope;
    wave.s1 += c0 * pair.g0[0] + c1 * pair.g1[0];
    wave.s2 += c0 * pair.g0[1] + c1 * pair.g1[1];
    wave.used = true;
  }

  static constexpr int inner = 0, outer = 1;

  const RayImage& image_;
  const RaySphere& sphere_;
  const EdgeWindow& window_;
  bool back_;
  OrderField& field_;
  bool taken_;
};

}  // namespace

void add_rays(std::span<const RayImage> images, const RaySphere& sphere, const EdgeWindow& window,
              bool back, OrderField& field) {
  for (const RayImage& image : images) ImageWaves(image, sphere, window, back, field).add();
}

}  // namespace arcus::phase
