#include "phase/population/angle_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"
#include "phase/population/scattering_table.h"

namespace arcus::phase {
namespace {

std::vector<double> uniform_angles(int count) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back(180.0 * i / (count - 1));
  return angles;
}

/// A forward peak, a bow with a steep side, and ripple.
double curve(double deg, double bow_deg) {
  const double s = sin2_half_deg(deg);
  return 0.05 + 100 / (1 + 1e4 * s) + 0.5 / (1 + std::exp((bow_deg - deg) / 0.1)) * std::exp(-(deg - bow_deg) / 5) +
         0.01 * std::sin(deg);
}

}  // namespace

TEST(AngleNodes, EveryCurveStaysWithinTheBoundAtEveryCandidate) {
  const std::vector<double> angles = uniform_angles(18001);
  std::vector<double> curves;
  for (const double bow : {137.0, 138.5})
    for (const double deg : angles) curves.push_back(curve(deg, bow));
  const std::vector<std::size_t> nodes = sufficient_nodes(angles, curves, 0.002);
  EXPECT_EQ(nodes.front(), 0u);
  EXPECT_EQ(nodes.back(), angles.size() - 1);
  EXPECT_LT(nodes.size(), 600u);
  for (std::size_t c = 0; c < 2; ++c) {
    const std::span values = std::span(curves).subspan(c * angles.size(), angles.size());
    EXPECT_LE(interpolation_error(angles, values, nodes), 0.002 * 1.0001);
  }
  // The bound decides: with a looser one there are fewer, about as the root.
  const double ratio = static_cast<double>(nodes.size()) / static_cast<double>(sufficient_nodes(angles, curves, 0.008).size());
  EXPECT_NEAR(ratio, 2, 0.5);
}

TEST(AngleNodes, AreWhereTheCurveBends) {
  const std::vector<double> angles = uniform_angles(18001);
  std::vector<double> values;
  for (const double deg : angles) values.push_back(curve(deg, 138));
  const auto nodes = sufficient_nodes(angles, values, 0.002);
  const auto between = [&](double low, double high) {
    return std::count_if(nodes.begin(), nodes.end(), [&](std::size_t i) { return angles[i] >= low && angles[i] < high; });
  };
  EXPECT_GT(between(137, 139), 5 * between(100, 102));
}

TEST(AngleNodes, JoinedSpansAreKeptWithMarginAndFixedAnglesAreNodes) {
  const std::vector<double> coarse{0, 60, 120, 180}, fine{0, 50, 50.5, 51, 51.5, 52, 90, 180};
  std::vector<AngleSpan> spans;
  add_spans(coarse, 0.02, 1, spans);
  add_spans(fine, 0.02, 1, spans);
  const std::vector<double> fixed{0.5, 77};
  const std::vector<double> nodes = nodes_of(spans, fixed);
  EXPECT_EQ(nodes.front(), 0);
  EXPECT_EQ(nodes.back(), 180);
  EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end()));
  for (const double angle : fixed) EXPECT_EQ(std::count(nodes.begin(), nodes.end(), angle), 1);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const double step = nodes[i + 1] - nodes[i];
    EXPECT_LE(step, 60 + 1e-12);
    // The fine pilot's half degree holds from 49 to 53: its spans reach one degree further.
    if (nodes[i + 1] > 49 && nodes[i] < 53) {
      EXPECT_LE(step, 0.5 + 1e-12) << nodes[i];
    }
  }
  EXPECT_LT(nodes.size(), 25u);
}

TEST(AngleNodes, CandidatesAreFineInRingsAndBows) {
  AngularDetail detail;
  detail.smallest_size_parameter = 500;
  detail.largest_size_parameter = 5000;
  const std::vector<double> angles = candidate_angles_deg(detail);
  EXPECT_EQ(angles.front(), 0);
  EXPECT_EQ(angles.back(), 180);
  EXPECT_LT(angles.size(), 20000u);
  const auto step_at = [&](double deg) {
    const auto above = std::upper_bound(angles.begin(), angles.end(), deg);
    return *above - *(above - 1);
  };
  EXPECT_LT(step_at(0.0), 0.02 * 180 / 5000);
  EXPECT_LT(step_at(179.999), 0.02 * 180 / 5000);
  EXPECT_LT(step_at(138), 0.01);
  EXPECT_GT(step_at(90), step_at(138));
}

}  // namespace arcus::phase
