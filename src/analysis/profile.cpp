#include "src/analysis/profile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/settings/number_text.h"
#include "src/analysis/rings.h"
#include "src/scene/picture_metadata.h"

namespace arcus::render {
namespace {

struct Centre {
  Vec3 direction;
  std::string words;
  Profile::Scattering scattering = Profile::Scattering::none;
};

std::optional<std::pair<double, double>> two_numbers(std::string_view text) {
  double a = 0, b = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, a);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != ',') return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, b);
  if (second.ec != std::errc() || second.ptr != end || !std::isfinite(a) || !std::isfinite(b))
    return std::nullopt;
  return std::pair(a, b);
}

Centre centre_of(const Image& image, const std::string& around, std::string_view where) {
  if (around == "zenith") return {{0, 0, 1}, "the zenith"};
  if (around == "sun" || around == "antisolar") {
    const auto sun = read_sun(image.metadata);
    if (!sun)
      throw bad_input(where, "no place of the sun (metadata arcus:sun:*)",
                      "a picture that arcus rendered expected",
                      "Give the direction as AZIMUTH,ELEVATION");
    const Vec3 to_sun = direction_of(sun->azimuth_deg, sun->elevation_deg);
    if (around == "sun") return {to_sun, "the sun", Profile::Scattering::angle};
    return {-to_sun, "the antisolar point", Profile::Scattering::supplement};
  }
  const auto place = two_numbers(around);
  if (!place || std::fabs(place->second) > 90)
    throw bad_input(
        "--around", "'" + around + "'",
        "sun, antisolar, zenith, or AZIMUTH,ELEVATION in degrees (elevation -90 to 90) expected");
  return {
      direction_of(place->first, place->second),
      "azimuth " + number_text(place->first) + "°, elevation " + number_text(place->second) + "°"};
}

/// Directions of a picture at the corners of a lattice of n x n squares a pixel.
class Lattice {
 public:
  Lattice(const Camera& camera, const PixelBox& box, int n) : camera_(camera), box_(box), n_(n) {}
  /// Directions along lattice line `line` (0 to n x height), n x width + 1 of them.
  std::vector<std::optional<Vec3>> line(int line) const {
    std::vector<std::optional<Vec3>> directions;
    const int count = n_ * box_.width() + 1;
    directions.reserve(static_cast<std::size_t>(count));
    const double y = box_.y0 + line / static_cast<double>(n_);
    for (int i = 0; i < count; ++i) {
      const auto ray = camera_.ray(box_.x0 + i / static_cast<double>(n_), y);
      directions.push_back(ray ? std::optional(ray->direction) : std::nullopt);
    }
    return directions;
  }

 private:
  const Camera& camera_;
  PixelBox box_;
  int n_;
};

/// Typical angle between neighbouring pixels: the root of the solid angle of a pixel in the middle
/// of the picture.
double pixel_angle_deg(const Camera& camera, const PixelBox& box) {
  const double x = std::floor(0.5 * (box.x0 + box.x1)), y = std::floor(0.5 * (box.y0 + box.y1));
  const auto a = camera.ray(x, y), b = camera.ray(x + 1, y), c = camera.ray(x, y + 1);
  if (!a || !b || !c) return 0.1;
  return degrees(
      std::sqrt(length(cross(b->direction - a->direction, c->direction - a->direction))));
}

double round_number_near(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double step : {1.0, 2.0, 5.0})
    if (x <= 1.2 * step * power) return step * power;
  return 10 * power;
}

/// What share of a pixel lies in which bin; the weight is its solid angle.
struct PixelShare {
  std::size_t bin;
  double weight, share;
};

void add_share(std::vector<PixelShare>& shares, std::size_t bin, double weight, double share) {
  for (PixelShare& s : shares) {
    if (s.bin != bin) continue;
    s.weight += weight;
    s.share += share;
    return;
  }
  shares.push_back({bin, weight, share});
}

/// Channels of a picture that are profiled, and the channel with the variance of each where there
/// is one.
struct ChannelPlan {
  std::vector<std::size_t> value;
  std::vector<std::optional<std::size_t>> variance;

  explicit ChannelPlan(const Image& image) {
    for (std::size_t c = 0; c < image.channel_names().size(); ++c) {
      const std::string& name = image.channel_names()[c];
      if (name.starts_with("variance.")) continue;
      value.push_back(c);
      variance.push_back(image.channel("variance." + name));
    }
  }
};

/// Sums over a bin.
struct BinSums {
  double weight = 0, pixels = 0;
  double squared_weight = 0;  ///< sum of the squares of the pixels' weights
  std::vector<double> value, squared_value,
      variance;  ///< weighted; the variance with the square of the weight

  void add(const PixelShare& s, const float* values, const ChannelPlan& plan) {
    weight += s.weight;
    pixels += s.share;
    squared_weight += s.weight * s.weight;
    for (std::size_t k = 0; k < plan.value.size(); ++k) {
      const double v = values[plan.value[k]];
      value[k] += s.weight * v;
      squared_value[k] += s.weight * v * v;
      if (plan.variance[k]) variance[k] += s.weight * s.weight * values[*plan.variance[k]];
    }
  }
  double standard_error(std::size_t k, bool from_variance) const {
    if (from_variance) return std::sqrt(variance[k]) / weight;
    const double mean = value[k] / weight;
    const double scatter = std::fmax(0, squared_value[k] / weight - mean * mean);
    const double independent = weight * weight / squared_weight;
    return independent > 1 ? std::sqrt(scatter / (independent - 1))
                           : std::numeric_limits<double>::infinity();
  }
};

/// Divides every pixel into n x n squares and adds its values to the bins they lie in. A pixel that
/// is only partly on the picture (at the edge of a fisheye's circle) also holds the black beside
/// it, and is left out.
std::vector<BinSums> summed(const Image& image, const ChannelPlan& plan, const Camera& camera,
                            const Rings& rings, int n) {
  const PixelBox& box = image.box();
  const Lattice lattice(camera, box, n);
  const std::vector<double> zeros(plan.value.size());
  std::vector<BinSums> sums(rings.count(), BinSums{0, 0, 0, zeros, zeros, zeros});
  std::vector<PixelShare> shares;
  std::vector<std::vector<std::optional<Vec3>>> lines(static_cast<std::size_t>(n) + 1);
  const float* values = image.values().data();
  for (int y = 0; y < box.height(); ++y) {
    for (int j = 0; j <= n; ++j) lines[static_cast<std::size_t>(j)] = lattice.line(y * n + j);
    for (int x = 0; x < box.width(); ++x, values += image.channel_names().size()) {
      if (!std::all_of(plan.value.begin(), plan.value.end(),
                       [&](auto c) { return std::isfinite(values[c]); }))
        continue;
      shares.clear();
      bool is_whole = true;
      for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j) {
        for (int i = 0; i < n; ++i) {
          const auto column = static_cast<std::size_t>(x * n + i);
          const auto &a = lines[j][column], &b = lines[j][column + 1];
          const auto &c = lines[j + 1][column], &d = lines[j + 1][column + 1];
          is_whole = is_whole && a && b && c && d;
          if (!is_whole) continue;
          const auto bin = rings.ring_of(normalize(*a + *b + *c + *d));
          if (bin) add_share(shares, *bin, 0.5 * length(cross(*d - *a, *c - *b)), 1.0 / (n * n));
        }
      }
      if (!is_whole) continue;
      for (const PixelShare& share : shares) sums[share.bin].add(share, values, plan);
    }
  }
  return sums;
}

}  // namespace

const ProfileChannel* Profile::channel(std::string_view name) const {
  for (const ProfileChannel& c : channels)
    if (c.name == name) return &c;
  return nullptr;
}

Profile measure_profile(const Image& image, const ProfileSettings& settings,
                        std::string_view where) {
  const auto camera_settings = read_camera(image);
  if (!camera_settings)
    throw bad_input(where, "no camera (metadata arcus:camera:*)",
                    "a picture that arcus rendered expected");
  if (camera_settings->type == "orthographic")
    throw bad_input(where, "an orthographic camera",
                    "pixels that look in different directions expected");
  const auto camera = make_camera(*camera_settings);
  const Centre centre = centre_of(image, settings.around, where);
  const double pixel_deg = pixel_angle_deg(*camera, image.box());
  const ChannelPlan plan(image);

  Profile profile;
  profile.around = centre.words;
  profile.centre = centre.direction;
  profile.scattering = centre.scattering;
  profile.bin_deg = settings.bin_deg != 0 ? settings.bin_deg : round_number_near(pixel_deg);
  const Rings rings(centre.direction, settings.from_deg, settings.to_deg, profile.bin_deg,
                    settings.sector_from_deg, settings.sector_to_deg);
  const int n = std::clamp(static_cast<int>(std::ceil(2 * pixel_deg / profile.bin_deg)), 2, 16);
  const std::vector<BinSums> sums = summed(image, plan, *camera, rings, n);

  for (std::size_t k = 0; k < plan.value.size(); ++k)
    profile.channels.push_back(
        {image.channel_names()[plan.value[k]], {}, {}, plan.variance[k].has_value()});
  for (std::size_t b = 0; b < rings.count(); ++b) {
    const BinSums& bin = sums[b];
    if (!(bin.weight > 0)) continue;
    profile.angle_deg.push_back(rings.middle_deg(b));
    profile.solid_angle_sr.push_back(bin.weight);
    profile.pixels.push_back(bin.pixels);
    for (std::size_t k = 0; k < plan.value.size(); ++k) {
      profile.channels[k].mean.push_back(bin.value[k] / bin.weight);
      profile.channels[k].standard_error.push_back(
          bin.standard_error(k, plan.variance[k].has_value()));
    }
  }
  if (profile.angle_deg.empty())
    throw bad_input(where,
                    "no pixel between " + number_text(settings.from_deg) + " and " +
                        number_text(settings.to_deg) + " degrees from " + centre.words +
                        (rings.is_sector() ? " in that sector" : ""),
                    "a range that is on the picture expected");
  return profile;
}

std::string csv_of(const Profile& profile, std::string_view picture_name) {
  std::string known;
  for (const auto& c : profile.channels)
    if (c.error_is_from_variance) known += (known.empty() ? "" : ", ") + c.name;
  std::string text =
      "# mean radiance [W m-2 sr-1 nm-1] against the angle from " + profile.around +
      "\n# picture: " + std::string(picture_name) + "\n# bins of " + number_text(profile.bin_deg) +
      " degrees, named by their middle\n# standard errors: " +
      (known.empty() ? "" : known + " from the picture's variance channels, others ") +
      "from the scatter of the pixels in a bin\n";
  const bool has_scattering = profile.scattering != Profile::Scattering::none;
  text += has_scattering ? "angle_deg,scattering_angle_deg,solid_angle_sr,pixels"
                         : "angle_deg,solid_angle_sr,pixels";
  for (const auto& c : profile.channels) text += "," + c.name + "," + c.name + "_standard_error";
  text += "\n";
  const auto add = [&](const char* format, double value) {
    char number[40];
    std::snprintf(number, sizeof number, format, value);
    text += number;
  };
  for (std::size_t b = 0; b < profile.angle_deg.size(); ++b) {
    const double angle = profile.angle_deg[b];
    add("%.10g", angle);
    if (has_scattering)
      add(",%.10g", profile.scattering == Profile::Scattering::angle ? angle : 180 - angle);
    add(",%.6g", profile.solid_angle_sr[b]);
    add(",%.6g", profile.pixels[b]);
    for (const auto& c : profile.channels) {
      add(",%.7g", c.mean[b]);
      add(",%.3g", c.standard_error[b]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace arcus::render
