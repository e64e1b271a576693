#pragma once
// Four values at the four wavelengths of a path. One register wide.

#include <algorithm>

namespace arcus {

inline constexpr int wavelength_count = 4;

struct Spectrum {
  typedef float Lanes __attribute__((vector_size(16)));
  Lanes lanes{};

  Spectrum() = default;
  Spectrum(Lanes l) : lanes(l) {}
  Spectrum(float a, float b, float c, float d) : lanes{a, b, c, d} {}
  static Spectrum filled(float x) { return Spectrum(x, x, x, x); }

  float operator[](int i) const { return lanes[i]; }
  float& operator[](int i) { return reinterpret_cast<float*>(&lanes)[i]; }

  float sum() const { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }
  float mean() const { return 0.25f * sum(); }
  float max() const { return std::max(std::max(lanes[0], lanes[1]), std::max(lanes[2], lanes[3])); }
  float min() const { return std::min(std::min(lanes[0], lanes[1]), std::min(lanes[2], lanes[3])); }
  bool is_zero() const { return max() == 0 && min() == 0; }

  Spectrum& operator+=(Spectrum b) { lanes += b.lanes; return *this; }
  Spectrum& operator-=(Spectrum b) { lanes -= b.lanes; return *this; }
  Spectrum& operator*=(Spectrum b) { lanes *= b.lanes; return *this; }
  Spectrum& operator/=(Spectrum b) { lanes /= b.lanes; return *this; }
  Spectrum& operator*=(float b) { lanes *= b; return *this; }

  friend Spectrum operator+(Spectrum a, Spectrum b) { return a.lanes + b.lanes; }
  friend Spectrum operator-(Spectrum a, Spectrum b) { return a.lanes - b.lanes; }
  friend Spectrum operator*(Spectrum a, Spectrum b) { return a.lanes * b.lanes; }
  friend Spectrum operator/(Spectrum a, Spectrum b) { return a.lanes / b.lanes; }
  friend Spectrum operator*(Spectrum a, float b) { return a.lanes * b; }
  friend Spectrum operator*(float a, Spectrum b) { return b.lanes * a; }
  friend Spectrum operator/(Spectrum a, float b) { return a.lanes * (1 / b); }
};

}  // namespace arcus
