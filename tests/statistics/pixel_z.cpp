#include "tests/statistics/pixel_z.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "tests/statistics/budget.h"
#include "tests/statistics/report.h"
#include "tests/statistics/seed.h"

namespace arcus::statistics {

namespace {

bool is_whole(const Picture& p) {
  return p.width > 0 && !p.mean.empty() && p.mean.size() % p.width == 0 &&
         p.variance_of_mean.size() == p.mean.size();
}

/// Standard errors by which a difference exceeds what is allowed.
double excess_z(double difference, double variance, double allowed, double scale) {
  const double excess = std::max(0.0, std::fabs(difference) - allowed);
  if (variance > 0) return excess / std::sqrt(variance);
  return excess <= 1e-6 * scale ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

double normal_p(double z) { return std::erfc(std::fabs(z) / std::sqrt(2.0)); }

testing::AssertionResult pictures_agree(const Picture& a, const Picture& b,
                                        PictureOptions options) {
  if (!is_whole(a) || !is_whole(b) || a.width != b.width || a.mean.size() != b.mean.size())
    return testing::AssertionFailure() << "pictures of different or no size";
  const std::size_t pixels = a.mean.size();
  std::vector<double> z(pixels);
  double difference = 0, variance = 0, scale = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double va = a.variance_of_mean[i], vb = b.variance_of_mean[i];
    if (!std::isfinite(a.mean[i]) || !std::isfinite(b.mean[i]) || !(va >= 0) || !(vb >= 0) ||
        !std::isfinite(va + vb))
      return testing::AssertionFailure()
             << "pixel (" << i % a.width << ", " << i / a.width << "): " << a.mean[i]
             << " variance " << va << " and " << b.mean[i] << " variance " << vb;
    const double size = 0.5 * (std::fabs(a.mean[i]) + std::fabs(b.mean[i]));
    z[i] = excess_z(a.mean[i] - b.mean[i], va + vb, options.relative_tolerance * size, size);
    difference += a.mean[i] - b.mean[i];
    variance += va + vb;
    scale += size;
  }
  const double z_all = excess_z(difference, variance, options.relative_tolerance * scale, scale);
  const double each = sidak(false_alarms_per_test, options.comparisons);
  const double level = sidak(each, static_cast<double>(pixels) + 1);
  const double worst = *std::max_element(z.begin(), z.end());
  std::ostringstream text;
  text.precision(8);
  text << pixels << " pixels: whole picture z = " << z_all << " (relative difference "
       << difference / scale << " +- " << std::sqrt(variance) / scale
       << "), worst pixel z = " << worst << ", rejected below p = " << level;
  if (normal_p(z_all) >= level && normal_p(worst) >= level)
    return testing::AssertionSuccess() << text.str();

  std::vector<std::size_t> order(pixels);
  for (std::size_t i = 0; i < pixels; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return z[i] > z[j]; });
  text << "; worst:";
  for (std::size_t i = 0; i < std::min<std::size_t>(3, pixels); ++i) {
    const std::size_t p = order[i];
    text << "\n  pixel (" << p % a.width << ", " << p / a.width << "): " << a.mean[p] << " +- "
         << std::sqrt(a.variance_of_mean[p]) << " and " << b.mean[p] << " +- "
         << std::sqrt(b.variance_of_mean[p]) << ", z = " << z[p];
  }
  std::ostringstream table;
  table.precision(9);
  table << "x,y,mean_a,variance_a,mean_b,variance_b,z\n";
  for (std::size_t i = 0; i < pixels; ++i)
    table << i % a.width << ',' << i / a.width << ',' << a.mean[i] << ',' << a.variance_of_mean[i]
          << ',' << b.mean[i] << ',' << b.variance_of_mean[i] << ',' << z[i] << '\n';
  text << "\n  " << test_name() << ", " << how_to_repeat() << ", pixels in "
       << write_report(table.str());
  return testing::AssertionFailure() << text.str();
}

}  // namespace arcus::statistics
