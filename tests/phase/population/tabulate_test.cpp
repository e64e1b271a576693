#include "phase/population/tabulate.h"

#include <gtest/gtest.h>
#include <math.h>  // j0, j1

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"
#include "phase/optics/refractive_index.h"
#include "phase/population/average.h"

namespace arcus::phase {
namespace {

Population population(std::vector<double> size_um, std::vector<double> wavelength_nm, long long radii,
                      SizesSettings distribution = {.type = "gamma", .variance = 0.1}) {
  static const RefractiveIndex water = RefractiveIndex::water();
  Population p;
  p.size_um = std::move(size_um);
  p.distribution = distribution;
  p.wavelength_nm = std::move(wavelength_nm);
  p.index_at = [](double nm) { return water.relative_to_air(nm); };
  for (const double nm : p.wavelength_nm) p.index.push_back(p.index_at(nm));
  p.radii = radii;
  return p;
}

/// Of a row of any element at an angle, by the table's own rule.
double value_at(const ScatteringTable& t, const std::vector<float>& element, std::size_t first, double deg) {
  const auto& nodes = t.scattering_angle_deg;
  const auto above = std::clamp<std::ptrdiff_t>(std::upper_bound(nodes.begin(), nodes.end(), deg) - nodes.begin(), 1,
                                                std::ssize(nodes) - 1);
  const auto i = static_cast<std::size_t>(above) - 1;
  const double s0 = sin2_half_deg(nodes[i]), s1 = sin2_half_deg(nodes[i + 1]);
  const double t01 = (sin2_half_deg(deg) - s0) / (s1 - s0);
  return (1 - t01) * element[first + i] + t01 * element[first + i + 1];
}

/// Computed once for several tests.
const ScatteringTable& small_cloud() {
  static const ScatteringTable table = tabulate(population({2, 3}, {500, 550}, 4000));
  return table;
}

}  // namespace

TEST(Tabulate, InterpolantsIntegrateToOne) {
  const ScatteringTable& t = small_cloud();
  for (std::size_t size = 0; size < 2; ++size)
    for (std::size_t nm = 0; nm < 2; ++nm) {
      EXPECT_NEAR(sphere_integral(t.scattering_angle_deg, &t.p11[t.first(size, nm)]), 1, 1e-6);
      EXPECT_NEAR(sphere_integral_of_cosine(t.scattering_angle_deg, &t.p11[t.first(size, nm)]),
                  t.asymmetry[t.row(size, nm)], 1e-3);
    }
  EXPECT_LT(t.normalisation_error, 1e-3);
  EXPECT_GT(t.normalisation_error, 0);
  EXPECT_NO_THROW(check_table(t, "cloud"));
}

TEST(Tabulate, ValuesBetweenNodesAgreeWithAnotherRadiusGrid) {
  const ScatteringTable& t = small_cloud();
  std::vector<double> angles;
  for (int i = 0; i < 300; ++i) angles.push_back(0.05 + 0.6 * i);
  const PopulationMeans direct = SphereAverage({Sizes({.type = "gamma", .variance = 0.1}, 3)}, angles, 550, 12345, false)
                                     .means(550, RefractiveIndex::water().relative_to_air(550));
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double p11 = direct.matrix[i];
    EXPECT_NEAR(value_at(t, t.p11, t.first(1, 1), angles[i]) / p11, 1, 0.005) << angles[i];
    EXPECT_NEAR(value_at(t, t.p12, t.first(1, 1), angles[i]) / p11, direct.matrix[300 + i] / p11, 0.005) << angles[i];
    EXPECT_NEAR(value_at(t, t.p33, t.first(1, 1), angles[i]) / p11, direct.matrix[600 + i] / p11, 0.005) << angles[i];
    EXPECT_NEAR(value_at(t, t.p34, t.first(1, 1), angles[i]) / p11, direct.matrix[900 + i] / p11, 0.005) << angles[i];
  }
  EXPECT_LT(t.angle_error, 0.0025);
}

TEST(Tabulate, NodesFollowTheLightAndNotAnEvenStep) {
  const ScatteringTable& t = small_cloud();
  EXPECT_LT(t.scattering_angle_deg.size(), 900u);  // within the same bound an even step needs thousands
  EXPECT_EQ(t.forward_angle_deg, 0);               // droplets keep their lobe
}

// Open: the forward fractions of a changed lobe angle, 0.40 and 0.45, await an independent value.
/// Share of the extinction that the lobe of a disc has inside an angle and above its value there, by Fraunhofer's
/// diffraction: the disc diffracts half of the extinction, 1 − J0² − J1² of it inside z = x θ, and J1² of it lies below
/// a plateau as high as its edge (Born & Wolf, Principles of Optics, section 8.5.2).
double lobe_of_discs(const Sizes& sizes, double wavelength_nm, double angle_deg) {
  double lobe = 0, discs = 0;
  for (double r = 0.05; r < 5 * sizes.effective_radius_um(); r *= 1.001) {
    const double weight = r * r * r * sizes.number_per_um(r);
    const double z = size_parameter(r, wavelength_nm) * radians(angle_deg);
    const double j0 = ::j0(z), j1 = ::j1(z);
    lobe += weight * 0.5 * (1 - j0 * j0 - 2 * j1 * j1);
    discs += weight;
  }
  return lobe / discs;
}

TEST(Tabulate, LargeDropsLoseTheirDiffractionLobe) {
  const SizesSettings drizzle{.type = "gamma", .variance = 0.05};
  Population p = population({45, 50}, {650}, 600, drizzle);
  const ScatteringTable t = tabulate(p);
  EXPECT_EQ(t.forward_angle_deg, lobe_angle_deg);
  EXPECT_TRUE(std::binary_search(t.scattering_angle_deg.begin(), t.scattering_angle_deg.end(), lobe_angle_deg));
  EXPECT_EQ(t.forward_fraction[0], 0);
  EXPECT_NEAR(t.forward_fraction[1] / lobe_of_discs(Sizes(drizzle, 50), 650, lobe_angle_deg), 1, 0.03);
  // What f says is what clipping removes.
  const auto first = t.p11.begin() + static_cast<std::ptrdiff_t>(t.first(1, 0));
  std::vector<float> clipped(first, first + std::ssize(t.scattering_angle_deg));
  clip_forward(t.scattering_angle_deg, t.forward_angle_deg, clipped.data());
  EXPECT_NEAR(1 - sphere_integral(t.scattering_angle_deg, clipped.data()), t.forward_fraction[1], 1e-4);

  p.remove_forward_lobe = false;
  p.radii = 50;
  EXPECT_EQ(tabulate(p).forward_fraction[1], 0);
}

TEST(Tabulate, RaysAloneHaveTheKnownEnergyAndBow) {
  Population p = population({500}, {589}, 100, {.type = "gamma", .variance = 0.01});
  p.index = {{1.3343, 0}};
  const ScatteringTable t = tabulate_rays(p);
  EXPECT_NEAR(sphere_integral(t.scattering_angle_deg, t.p11.data()), 1, 1e-6);
  EXPECT_NEAR(t.asymmetry[0], 0.7676, 0.002);  // geometric optics of a sphere, an independent computation
  const double disc_m2 = pi * Sizes(p.distribution, 500).mean_power_um(2) * 1e-12;
  EXPECT_NEAR(t.extinction_cross_section_m2[0] / disc_m2, 1, 1e-6);
  EXPECT_NEAR(t.scattering_cross_section_m2[0] / disc_m2, 1, 1e-4);
  // The primary bow of n = 1.3343, 138.1°: van de Hulst (1957), section 13.2.
  EXPECT_GT(value_at(t, t.p11, 0, 138.15), 10 * value_at(t, t.p11, 0, 137.8));
}

TEST(Tabulate, TellsHowFarItIs) {
  std::vector<double> shares;
  tabulate(population({1}, {550, 600}, 200), [&](double share) { shares.push_back(share); });
  ASSERT_GE(shares.size(), 4u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_DOUBLE_EQ(shares.back(), 1);
}

}  // namespace arcus::phase
