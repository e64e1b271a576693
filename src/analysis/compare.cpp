#include "src/analysis/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "phase/base/error.h"
#include "src/analysis/pixel_pairs.h"

namespace arcus::render {
namespace {

bool is_variance(std::string_view name) { return name.starts_with("variance."); }

std::string size_text(const Image& image) {
  const PixelBox& b = image.box();
  return std::to_string(image.width_px()) + " x " + std::to_string(image.height_px()) +
         " pixels, columns " + std::to_string(b.x0) + " to " + std::to_string(b.x1) + " and rows " +
         std::to_string(b.y0) + " to " + std::to_string(b.y1);
}

std::vector<std::string> missing_from(const Image& image, const Image& other) {
  std::vector<std::string> names;
  for (const std::string& name : image.channel_names())
    if (!other.channel(name)) names.push_back(name);
  return names;
}

struct NoiseSums {
  double squared_z = 0, difference = 0, variance = 0;
  std::size_t beyond_3 = 0, pixels = 0;

  void add(double difference_of_pixel, double variance_of_pixel) {
    if (!(variance_of_pixel > 0) || !std::isfinite(variance_of_pixel)) return;
    const double z = difference_of_pixel / std::sqrt(variance_of_pixel);
    squared_z += z * z;
    beyond_3 += std::fabs(z) > 3 ? 1 : 0;
    difference += difference_of_pixel;
    variance += variance_of_pixel;
    ++pixels;
  }
  NoiseFigures figures() const {
    if (pixels == 0) return {};
    const auto count = static_cast<double>(pixels);
    return {std::sqrt(squared_z / count), static_cast<double>(beyond_3) / count,
            difference / std::sqrt(variance), pixels};
  }
};

ChannelDifference compared(const PixelPairs& pairs, const std::string& name) {
  ChannelDifference result;
  result.name = name;
  const Pairing channel = pairs.channel(name);
  double count = 0;
  pairs.for_each(channel, [&](const PixelPair& p) {
    if (!p.is_finite()) return;
    ++count;
    result.mean_a += p.a;
    result.mean_b += p.b;
  });
  if (count == 0) return result;
  result.mean_a /= count;
  result.mean_b /= count;
  const double softening = result.mean_b * result.mean_b / 1000;
  NoiseSums noise;
  pairs.for_each(channel, [&](const PixelPair& p) {
    if (!p.is_finite()) return;
    const double difference = p.a - p.b;
    result.mean_difference += difference / count;
    result.rmse += difference * difference / count;
    // Two equal pixels differ by nothing, also where both are black.
    if (difference != 0)
      result.relative_mse += difference * difference / (p.b * p.b + softening) / count;
    if (std::fabs(difference) > result.largest) {
      result.largest = std::fabs(difference);
      result.largest_x = p.x;
      result.largest_y = p.y;
    }
    if (p.variance) noise.add(difference, *p.variance);
  });
  result.rmse = std::sqrt(result.rmse);
  if (channel.variance_a && channel.variance_b) result.noise = noise.figures();
  return result;
}

std::string number(double x, const char* format = "%.4g") {
  char text[40];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

}  // namespace

Comparison compare(const Image& a, const Image& b, std::string_view name_a,
                   std::string_view name_b) {
  if (a.width_px() != b.width_px() || a.height_px() != b.height_px() || !(a.box() == b.box()))
    throw Error(Fault::mismatch, std::string(name_b) + ": " + size_text(b) + " found; " +
                                     size_text(a) + " expected, as in " + std::string(name_a));
  Comparison result;
  result.only_a = missing_from(a, b);
  result.only_b = missing_from(b, a);
  const PixelPairs pairs(a, b);
  result.is_equal = true;
  for (const std::string& name : a.channel_names()) {
    if (is_variance(name) || !b.channel(name)) continue;
    result.channels.push_back(compared(pairs, name));
    result.is_equal = result.is_equal && result.channels.back().largest == 0;
  }
  if (result.channels.empty())
    throw Error(Fault::mismatch, std::string(name_a) + " and " + std::string(name_b) +
                                     ": no common channel found; at "
                                     "least one expected, such as R, G and B");
  result.not_finite = pairs.pixels_not_finite();
  result.pixels = a.box().pixels() - result.not_finite;
  result.is_equal = result.is_equal && result.not_finite == 0;
  return result;
}

std::string figures_text(const Comparison& comparison) {
  const std::vector<std::string> header{"channel", "mean A", "mean B", "A - B", "RMSE",  "relMSE",
                                        "largest", "at",     "rms z",  "|z|>3", "mean z"};
  std::vector<std::vector<std::string>> rows{header};
  for (const ChannelDifference& c : comparison.channels) {
    std::vector<std::string> row{c.name,
                                 number(c.mean_a),
                                 number(c.mean_b),
                                 number(c.mean_difference, "%+.3g"),
                                 number(c.rmse, "%.3g"),
                                 number(c.relative_mse, "%.3g"),
                                 number(c.largest, "%.3g"),
                                 std::to_string(c.largest_x) + "," + std::to_string(c.largest_y)};
    if (c.noise) {
      row.push_back(number(c.noise->rms_z, "%.3f"));
      row.push_back(number(100 * c.noise->share_beyond_3, "%.2f") + "%");
      row.push_back(number(c.noise->mean_difference_z, "%+.2f"));
    } else {
      row.insert(row.end(), {"-", "-", "-"});
    }
    rows.push_back(std::move(row));
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::size_t width = 0;
      for (const auto& other : rows) width = std::max(width, other[i].size());
      const std::string space(width - row[i].size(), ' ');
      text += i == 0 ? row[i] + space : "  " + space + row[i];
    }
    text += "\n";
  }
  text += std::to_string(comparison.pixels) + " pixels compared";
  if (comparison.not_finite > 0)
    text += ", " + std::to_string(comparison.not_finite) + " left out: not finite";
  text += comparison.is_equal ? "; equal\n" : "\n";
  if (std::none_of(comparison.channels.begin(), comparison.channels.end(),
                   [](const auto& c) { return c.noise.has_value(); }))
    text += "no z: both pictures need the channel \"variance\" (film.channels)\n";
  return text;
}

}  // namespace arcus::render
