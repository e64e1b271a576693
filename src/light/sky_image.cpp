#include "src/light/sky_image.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::render {

SkyImage::SkyImage(Raster rgb, ThreeSpectra basis, double azimuth_deg)
    : rgb_(std::move(rgb)), basis_(std::move(basis)), azimuth_rad_(radians(azimuth_deg)), aliases_(rgb_.pixels()) {
  // Each pixel's share of what is asked for, times the number of pixels.
  const auto width = static_cast<std::size_t>(rgb_.width);
  std::vector<double> share(rgb_.pixels());
  const auto integrated = [&](const auto& value) {
    double sum = 0;
    for (int y = 0; y < rgb_.height; ++y) {
      const double solid_angle = (upper_sine(y) - upper_sine(y + 1)) * 2 * pi / rgb_.width;
      for (int x = 0; x < rgb_.width; ++x) sum += share[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = value(rgb_.at(x, y)) * solid_angle;
    }
    return sum;
  };
  flux_ = integrated(brightness);
  // With a part in a million more, lest rounding finds something to ask in an even sky.
  plain_ = 2 * flux_ / (4 * pi) * (1 + 1e-6);
  const double asked = integrated([this](const float* rgb) { return excess(rgb); });
  share_asked_ = asked / flux_;
  if (!is_asked()) {
    aliases_ = {};
    return;
  }
  for (double& here : share) here *= static_cast<double>(share.size()) / asked;

  // From below grow the pixels with less than the mean, from above those with more.
  std::vector<std::uint32_t> order(share.size());
  std::size_t less = 0, more = order.size();
  for (std::uint32_t i = 0; i < order.size(); ++i) (share[i] < 1 ? order[less++] : order[--more]) = i;
  std::size_t waiting = more;  // the first that has more to give
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint32_t i = order[k];
    if (waiting <= k) waiting = k + 1;
    if (waiting >= order.size()) {
      aliases_[i] = {1, i};
      continue;
    }
    const std::uint32_t giver = order[waiting];
    aliases_[i] = {static_cast<float>(share[i]), giver};
    share[giver] -= 1 - share[i];
    if (share[giver] < 1) ++waiting;  // it is the next to be filled up
  }
}

int SkyImage::column(const Vec3& direction) const {
  double turn = (std::atan2(direction.x, direction.y) - azimuth_rad_) / (2 * pi) + 0.5;
  turn -= std::floor(turn);
  return std::min(static_cast<int>(turn * rgb_.width), rgb_.width - 1);
}

int SkyImage::row(const Vec3& direction) const {
  const double elevation = std::atan2(direction.z, std::hypot(direction.x, direction.y));
  return std::clamp(static_cast<int>((0.5 - elevation / pi) * rgb_.height), 0, rgb_.height - 1);
}

double SkyImage::upper_sine(int row) const { return std::cos(pi * row / rgb_.height); }

std::optional<Vec3> SkyImage::draw(double u, double v) const {
  if (!(u < share_asked_)) return std::nullopt;
  const double place = u / share_asked_ * static_cast<double>(aliases_.size());
  const std::size_t bin = std::min(static_cast<std::size_t>(place), aliases_.size() - 1);
  const Alias& alias = aliases_[bin];
  const double rest = place - static_cast<double>(bin), own = static_cast<double>(alias.own);
  const bool is_own = rest < own;
  const std::size_t pixel = is_own ? bin : alias.other;
  const double across = is_own ? rest / own : (rest - own) / (1 - own);
  const auto x = static_cast<int>(pixel % static_cast<std::size_t>(rgb_.width)), y = static_cast<int>(pixel / static_cast<std::size_t>(rgb_.width));
  // A little within the pixel's edges, that the density found in the direction is that of the pixel.
  const auto within = [](double t) { return std::clamp(t, 1e-9, 1 - 1e-9); };
  const double azimuth = azimuth_rad_ + 2 * pi * ((x + within(across)) / rgb_.width - 0.5);
  const double sine = upper_sine(y) + (upper_sine(y + 1) - upper_sine(y)) * within(v);
  const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  return Vec3(std::sin(azimuth) * cosine, std::cos(azimuth) * cosine, sine);
}

}  // namespace arcus::render
