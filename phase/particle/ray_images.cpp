#include "phase/particle/ray_images.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

/// The formulas of RaysOfOrder continued to complex angles of incidence, and the phase that goes
/// with them.
class ComplexRays {
 public:
  ComplexRays(int order, double n) : order_(order), n_(n) {}

  Complex refraction(Complex incidence) const { return std::asin(std::sin(incidence) / n_); }
  Complex turned(Complex incidence) const {
    return (order_ - 1) * pi + 2.0 * incidence - 2.0 * order_ * refraction(incidence);
  }
  Complex turned_slope(Complex incidence) const {
    return 2.0 - 2.0 * order_ * std::cos(incidence) / (n_ * std::cos(refraction(incidence)));
  }
  /// Phase over x of the ray that leaves towards `turned`, up to multiples of pi/2 that are not
  /// counted here: the stationary value of -2 f(1) + 2 p f(n) + b turned, with f(z) = sqrt(z^2 -
  /// b^2) - b acos(b / z) and b = sin(incidence).
  Complex rate(Complex incidence, double turned) const {
    const Complex b = std::sin(incidence), beta = refraction(incidence);
    return -2.0 * (std::cos(incidence) - b * (0.5 * pi - incidence)) +
           2.0 * order_ * (n_ * std::cos(beta) - b * (0.5 * pi - beta)) + b * turned;
  }
  struct Amplitudes {
    Complex of[2];
  };
  Amplitudes amplitudes(Complex incidence) const {
    const Complex c = std::cos(incidence), t = std::cos(refraction(incidence));
    const Complex s = (c - n_ * t) / (c + n_ * t), p = (n_ * c - t) / (n_ * c + t);
    if (order_ == 0) return {{s, p}};
    return {{(1.0 - s * s) * std::pow(-s, order_ - 1), (1.0 - p * p) * std::pow(-p, order_ - 1)}};
  }

 private:
  int order_;
  double n_;
};

/// exp(i pi k / 4)
Complex eighth(int k) { return std::polar(1.0, 0.25 * pi * k); }

/// All that the images of one order have in common.
class OrderImages {
 public:
  OrderImages(int order, double n, double least_x)
      : rays_(order, n), complex_(order, n), order_(order) {
    if (const auto bow = rays_.bow_incidence_rad()) {
      const double c = std::cos(*bow);
      bow_turned_ = rays_.turned_rad(*bow);
      // Airy's variable is (distance beyond the bow) x^(2/3) / h^(1/3), h half the curvature by
      // distance from the axis.
      const double h = 0.5 * rays_.turned_curvature(*bow) / (c * c);
      dark_ = std::min(0.35, 10 * std::cbrt(h) / std::pow(least_x, 2.0 / 3));
    }
  }

  void add(double angle, std::vector<RayImage>& images) const {
    const double inside = std::clamp(angle, 1e-7, pi - 1e-7);
    const double least = rays_.bow_incidence_rad()
                             ? bow_turned_ - dark_
                             : std::min(rays_.turned_rad(0), rays_.turned_rad(0.5 * pi));
    const double most = std::max(rays_.turned_rad(0), rays_.turned_rad(0.5 * pi));
    for (const int side : {1, -1}) {
      const int first = static_cast<int>(std::ceil((least - side * inside) / (2 * pi)));
      for (int turns = first; side * inside + 2 * pi * turns <= most; ++turns) {
        const RayImage image = image_at(inside, side, turns);
        if (matters(image)) images.push_back(image);
      }
    }
  }

 private:
  static bool matters(const RayImage& image) {
    if (image.is_pair()) return true;
    const auto strength = [](const RayImage::Ray& ray) {
      return std::hypot(ray.amplitude[0], ray.amplitude[1]);
    };
    return (image.has_inner && strength(image.inner) > 3e-4) ||
           (image.has_outer && strength(image.outer) > 3e-4);
  }

  RayImage image_at(double angle, int side, int turns) const {
    RayImage image;
    image.order = order_;
    image.side = side;
    const double turned = side * angle + 2 * pi * turns;
    // Of -(-1)^turns exp(-i (p - 1) pi/2) and the side's exp(-+ i pi/4): see EdgeWaves for the
    // convention.
    const Complex phase = eighth(4 + 4 * (turns & 1) - 2 * (order_ - 1) - side);
    const auto bow = rays_.bow_incidence_rad();
    if (!bow) {
      if (const auto incidence = rays_.incidence_of(turned, 0, 0.5 * pi)) {
        image.has_outer = true;
        image.outer = ray_at(*incidence, turned, angle, phase);
      }
      return image;
    }
    constexpr double close = 1e-5;  // nearer to the bow the formulas below lose their digits
    if (std::fabs(turned - bow_turned_) < close) {
      const auto below = pair_at(bow_turned_ - close, angle, phase),
                 above = pair_at(bow_turned_ + close, angle, phase);
      const double t = (turned - bow_turned_ + close) / (2 * close);
      image = below;
      image.order = order_;
      image.side = side;
      const auto mix = [t](double& a, double b) { a = (1 - t) * a + t * b; };
      mix(image.pair.zeta, above.pair.zeta);
      mix(image.pair.rate, above.pair.rate);
      for (int j = 0; j < 2; ++j) {
        mix(image.pair.g0[j], above.pair.g0[j]);
        mix(image.pair.g1[j], above.pair.g1[j]);
      }
      return image;
    }
    image = pair_at(turned, angle, phase);
    image.order = order_;
    image.side = side;
    return image;
  }

  RayImage::Ray ray_at(double incidence, double turned, double angle, Complex phase) const {
    RayImage::Ray ray;
    ray.incidence_rad = incidence;
    const double b = std::sin(incidence), c = std::max(std::cos(incidence), 1e-12);
    ray.cos_refraction = std::cos(rays_.refraction_rad(incidence));
    ray.rate = complex_.rate(incidence, turned).real();
    const double slope = rays_.turned_slope(incidence),
                 curvature = rays_.turned_curvature(incidence);
    const auto reflected = rays_.amplitudes(incidence);
    const double spread = std::sqrt(b * c / (std::fabs(slope) * std::sin(angle)));
    ray.amplitude[0] = reflected.perpendicular * spread;
    ray.amplitude[1] = reflected.parallel * spread;
    ray.phase = phase * eighth(slope > 0 ? -1 : 1);
    // Next order of the stationary phase for the share's window: phase x Phi(tau) with Phi'' = -c
    // D', Phi''' = 2 b D' - c D''; integrand G = sqrt(b) c e(tau), e Fresnel's factors. The
    // correction is i / (2 x Phi'') (w'' + w' (2 G'/G - Phi'''/Phi'')).
    const double phi2 = -c * slope, phi3 = 2 * b * slope - c * curvature;
    ray.zone = 0.5 / phi2;
    const double step = std::min(1e-5, 0.25 * std::min(incidence, 0.5 * pi - incidence));
    if (step > 1e-9) {
      const auto before = rays_.amplitudes(incidence - step),
                 after = rays_.amplitudes(incidence + step);
      const double e_slope[2] = {(after.perpendicular - before.perpendicular) / (2 * step),
                                 (after.parallel - before.parallel) / (2 * step)};
      const double common = c / b - 2 * b / c - phi3 / phi2;  // 2 (sqrt(b) c)' / (sqrt(b) c) - ...
      for (int j = 0; j < 2; ++j)
        ray.amplitude_slope[j] = 2 * e_slope[j] * spread + ray.amplitude[j] * common;
    }
    // A ray through the centre reaches the axis there and at b = 0 only; others pass the axis as a
    // ring.
    const bool through_centre = std::fabs(turned - rays_.turned_rad(0)) < 0.3 && b < 0.8;
    ray.ring = through_centre ? 0 : b * std::min(angle, pi - angle);
    return ray;
  }

  RayImage pair_at(double turned, double angle, Complex phase) const {
    RayImage image;
    const double bow = *rays_.bow_incidence_rad();
    const Complex tau_bow = bow;
    Complex tau[2];  // inner, outer
    const bool bright = turned > bow_turned_;
    if (bright) {
      const auto inner = rays_.incidence_of(turned, 0, bow),
                 outer = rays_.incidence_of(turned, bow, 0.5 * pi);
      if (inner) {
        image.has_inner = true;
        image.inner = ray_at(*inner, turned, angle, phase);
        tau[0] = *inner;
      }
      if (outer) {
        image.has_outer = true;
        image.outer = ray_at(*outer, turned, angle, phase);
        tau[1] = *outer;
      }
      if (!image.is_pair()) return image;
    } else {
      image.has_inner = image.has_outer = true;
      const double depth = bow_turned_ - turned;
      Complex incidence = tau_bow + Complex(0, std::sqrt(2 * depth / rays_.turned_curvature(bow)));
      for (int i = 0; i < 50; ++i) {
        const Complex step =
            (complex_.turned(incidence) - turned) / complex_.turned_slope(incidence);
        incidence -= step;
        if (std::abs(step) < 1e-14) break;
      }
      tau[1] = incidence;
      tau[0] = std::conj(incidence);
      for (RayImage::Ray* ray : {&image.inner, &image.outer}) {
        ray->incidence_rad = incidence.real();
        ray->cos_refraction = std::cos(complex_.refraction(incidence)).real();
      }
    }
    // Map the phase to t^3/3 + zeta t + rate: the inner ray (a minimum of the phase) is at t =
    // +sqrt(-zeta).
    const Complex rate_in = complex_.rate(tau[0], turned), rate_out = complex_.rate(tau[1], turned);
    RayImage::Pair& pair = image.pair;
    pair.rate = 0.5 * (rate_in + rate_out).real();
    Complex t;
    if (bright) {
      pair.zeta = -std::pow(std::max(0.75 * (rate_out - rate_in).real(), 0.0), 2.0 / 3);
      t = std::sqrt(-pair.zeta);
    } else {
      // At t = i s the phase is rate + (2/3) i s^3.
      const double s = std::cbrt(1.5 * (0.5 * (rate_in - rate_out)).imag());
      pair.zeta = s * s;
      t = Complex(0, s);
    }
    // g(t) = sqrt(b) e(tau) db/dt with (db/dt)^2 = 2 t / Phi'' and Phi''(b) = -D'(tau) / cos(tau)
    Complex g[2][2];
    for (int k = 0; k < 2; ++k) {
      const Complex at = k == 0 ? t : -t;
      const Complex rate2 = -complex_.turned_slope(tau[k]) / std::cos(tau[k]);
      const Complex width = std::sqrt(2.0 * at / rate2);
      const auto e = complex_.amplitudes(tau[k]);
      for (int j = 0; j < 2; ++j) g[k][j] = std::sqrt(std::sin(tau[k])) * width * e.of[j];
    }
    const double front = std::sqrt(2 * pi / std::sin(angle));
    for (int j = 0; j < 2; ++j) {
      // The branch of the root: the two are conjugates on the dark side.
      if (!bright &&
          std::abs(g[0][j] - std::conj(g[1][j])) > std::abs(g[0][j] + std::conj(g[1][j])))
        g[1][j] = -g[1][j];
      pair.g0[j] = front * (0.5 * (g[0][j] + g[1][j])).real();
      pair.g1[j] = front * ((g[0][j] - g[1][j]) / (2.0 * t)).real();
    }
    pair.phase = phase;
    return image;
  }

  RaysOfOrder rays_;
  ComplexRays complex_;
  int order_;
  double bow_turned_ = 0, dark_ = 0;
};

}  // namespace

RayImages ray_images(double n, int highest_order, double least_size_parameter,
                     std::span<const double> angles_rad) {
  RayImages result;
  result.angles = angles_rad.size();
  for (int p = 0; p <= highest_order; ++p) {
    const OrderImages order(p, n, least_size_parameter);
    for (const double angle : angles_rad) {
      result.first.push_back(result.images.size());
      order.add(angle, result.images);
    }
  }
  result.first.push_back(result.images.size());
  return result;
}

}  // namespace arcus::phase
