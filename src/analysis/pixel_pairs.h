#pragma once
// The pixels of two pictures of equal box, side by side.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "src/film/image.h"

namespace arcus::render {

/// Where a channel lies in both pictures, and its variance.
struct Pairing {
  std::size_t a = 0, b = 0;
  std::optional<std::size_t> variance_a, variance_b;
};

struct PixelPair {
  int x, y;
  double a, b;
  std::optional<double> variance;  ///< of a - b, where both are known

  bool is_finite() const { return std::isfinite(a) && std::isfinite(b); }
  /// The difference over its standard deviation; nothing where that is not known or 0.
  std::optional<double> z() const {
    if (!is_finite() || !variance || !(*variance > 0) || !std::isfinite(*variance))
      return std::nullopt;
    return (a - b) / std::sqrt(*variance);
  }
};

class PixelPairs {
 public:
  /// The pictures must outlive this and have the same box.
  PixelPairs(const Image& a, const Image& b) : a_(a), b_(b) {}

  /// A channel that both have.
  Pairing channel(const std::string& name) const {
    return {*a_.channel(name), *b_.channel(name), a_.channel("variance." + name),
            b_.channel("variance." + name)};
  }
  PixelPair pair(const Pairing& channel, int x, int y) const {
    PixelPair p{x, y, a_.value(x, y, channel.a), b_.value(x, y, channel.b), std::nullopt};
    if (channel.variance_a && channel.variance_b)
      p.variance = static_cast<double>(a_.value(x, y, *channel.variance_a)) +
                   b_.value(x, y, *channel.variance_b);
    return p;
  }
  /// Calls action(PixelPair) for every pixel, row by row.
  template <class Action>
  void for_each(const Pairing& channel, const Action& action) const {
    const PixelBox& box = a_.box();
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x) action(pair(channel, x, y));
  }
  /// Pixels where a value of a common channel, variances aside, is not finite in either.
  std::size_t pixels_not_finite() const {
    std::vector<char> is_bad(a_.box().pixels());
    for (const std::string& name : a_.channel_names()) {
      if (name.starts_with("variance.") || !b_.channel(name)) continue;
      std::size_t i = 0;
      for_each(channel(name), [&](const PixelPair& p) {
        if (!p.is_finite()) is_bad[i] = 1;
        ++i;
      });
    }
    std::size_t count = 0;
    for (const char bad : is_bad) count += bad ? 1 : 0;
    return count;
  }

 private:
  const Image& a_;
  const Image& b_;
};

}  // namespace arcus::render
