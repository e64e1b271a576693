#include "phase/population/tabulate_crystals.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/population/crystal_angles.h"
#include "phase/population/hat_nodes.h"
#include "phase/population/shadow_lobe.h"
#include "phase/species/species.h"

namespace arcus::phase {
namespace {

/// Random prisms of 200 um without diffraction, all of whose light is kept; n as published.
CrystalTableSettings prisms(double aspect_ratio, double rays) {
  CrystalTableSettings settings;
  settings.crystals = crystals_of_habit("prism");
  settings.crystals.habit.aspect_ratio = aspect_ratio;
  settings.size_um = {200};
  settings.waves = {{550, 1.311, 0}};
  settings.diffraction = settings.remove_forward = false;
  settings.rays = rays;
  return settings;
}

/// Mean of a row of p11 over angles [1/sr]; linear in s between the nodes.
double mean_between(const ScatteringTable& t, std::size_t wavelength, double from_deg, double to_deg) {
  const HatNodes nodes(t.scattering_angle_deg);
  double sum = 0;
  constexpr int places = 200;
  for (int i = 0; i < places; ++i) {
    const double s0 = sin2_half_deg(from_deg), s1 = sin2_half_deg(to_deg);
    const HatNodes::Place place = nodes.place_of(s0 + (s1 - s0) * (i + 0.5) / places);
    const float* p = &t.p11[t.first(0, wavelength) + place.node];
    sum += p[0] + place.share * (p[1] - p[0]);
  }
  return sum / places;
}

/// Middle of the interval in which a row of p11 rises most.
double steepest_ascent_deg(const ScatteringTable& t, std::size_t wavelength, double from_deg, double to_deg) {
  double most = 0, found = 0;
  for (std::size_t i = 1; i < t.scattering_angle_deg.size(); ++i) {
    const double a = t.scattering_angle_deg[i - 1], b = t.scattering_angle_deg[i];
    const float* p = &t.p11[t.first(0, wavelength) + i - 1];
    const double slope = (p[1] - p[0]) / (b - a);
    if (a < from_deg || b > to_deg || slope < most) continue;
    most = slope;
    found = 0.5 * (a + b);
  }
  return found;
}

}  // namespace

TEST(TabulateCrystals, PrismsHavePublishedAsymmetryHaloAndUndeviatedLight) {
  const struct {
    double aspect, asymmetry, near_22, undeviated;  // undeviated: straight through, and after reflections inside; 0: not known
  } known[] = {{1, 0.542, 1.38, 0.2404}, {0.25, 0.715, 0.67, 0.5037}, {2.5, 0.667, 1.70, 0}};
  for (const auto& one : known) {
    CrystalTableSettings settings = prisms(one.aspect, 500'000);
    const ScatteringTable whole = tabulate_random_crystals(settings);
    check_table(whole, "prisms");
    EXPECT_NEAR(sphere_integral(whole.scattering_angle_deg, whole.p11.data()), 1, 1e-6);
    EXPECT_NEAR(whole.asymmetry[0], one.asymmetry, 0.003) << one.aspect;
    EXPECT_NEAR(mean_between(whole, 0, 22.0, 22.1) / one.near_22, 1, 0.03) << one.aspect;
    EXPECT_EQ(whole.forward_fraction[0], 0);

    settings.remove_forward = true;
    const ScatteringTable rest = tabulate_random_crystals(settings);
    check_table(rest, "prisms");
    const double f = rest.forward_fraction[0];
    if (one.undeviated > 0) {
      EXPECT_NEAR(f, one.undeviated, 0.003) << one.aspect;
    }
    // The rest and what goes straight on are the whole.
    EXPECT_NEAR((1 - f) * rest.asymmetry[0] + f, whole.asymmetry[0], 1e-4);
    EXPECT_NEAR((1 - f) * mean_between(rest, 0, 22, 24) / mean_between(whole, 0, 22, 24), 1, 0.002);
    EXPECT_EQ(rest.forward_angle_deg, 0);
  }
}

TEST(TabulateCrystals, HalosBeginAtLeastDeviationInEveryColour) {
  CrystalTableSettings settings = prisms(1, 1'000'000);
  settings.waves = {{450, 1.3153, 0}, {550, 1.3107, 0}, {650, 1.3077, 0}};
  const ScatteringTable t = tabulate_random_crystals(settings);
  for (std::size_t i = 0; i < settings.waves.size(); ++i) {
    const double at_22 = least_deviation_deg(-0.5, settings.waves[i].n), at_46 = least_deviation_deg(0, settings.waves[i].n);
    EXPECT_NEAR(steepest_ascent_deg(t, i, 18, 26), at_22, 0.06) << settings.waves[i].wavelength_nm;
    EXPECT_NEAR(steepest_ascent_deg(t, i, 43, 49), at_46, 0.1) << settings.waves[i].wavelength_nm;
  }
  // Red inside.
  EXPECT_LT(steepest_ascent_deg(t, 2, 18, 26), steepest_ascent_deg(t, 0, 18, 26));
}

TEST(TabulateCrystals, LeastDeviationIsTheClosedForm) {
  EXPECT_NEAR(least_deviation_deg(-0.5, 1.3107), 21.90, 0.02);
  EXPECT_NEAR(least_deviation_deg(0, 1.3107), 45.87, 0.08);
  EXPECT_LT(least_deviation_deg(0.5, 1.3107), 0);  // neighbouring faces of a prism: total reflection
  EXPECT_LT(least_deviation_deg(-1, 1.3107), 0);
}

TEST(TabulateCrystals, SmallOnesDiffractHalfOfTheLightIntoTheLobeOfTheirShadow) {
  CrystalTableSettings settings = prisms(1, 200'000);
  settings.size_um = {20};
  settings.diffraction = settings.remove_forward = true;
  const ScatteringTable t = tabulate_random_crystals(settings);
  check_table(t, "small prisms");
  const CrystalPopulation crystals(settings.crystals, 20);
  ASSERT_FALSE(is_diffraction_narrow(crystals));
  EXPECT_EQ(t.forward_fraction[0], 0);
  EXPECT_NEAR(t.extinction_cross_section_m2[0] / (2e-12 * crystals.mean_projected_area_um2()), 1, 1e-9);
  EXPECT_LT(t.normalisation_error, 1e-3);
  const double kept_asymmetry = 0.5 * (1 + 0.542);  // blurring takes a little
  EXPECT_NEAR(t.asymmetry[0], kept_asymmetry, 0.01);
  // Full width at half maximum, of a mixture of shadows.
  std::size_t half = 0;
  while (t.p11[half] > 0.5f * t.p11[0]) ++half;
  const double width = SilhouetteDiffraction(crystals.mean_projected_area_um2(), 550).width_rad();
  EXPECT_NEAR(2 * t.scattering_angle_deg[half] / degrees(width), 1, 0.08);
  // The lobe is half of the light and the undeviated quarter of the other half; 84 % of it are within the first dark ring.
  const double ring_deg = degrees(width) * 1.22 / 1.03;
  EXPECT_NEAR(mean_between(t, 0, 0, ring_deg) * 4 * pi * sin2_half_deg(ring_deg), 0.62 * 0.83, 0.02);
  // The halo's edge is washed out.
  EXPECT_LT(mean_between(t, 0, 22, 22.2) / mean_between(t, 0, 21.2, 21.6), 2);
}

TEST(TabulateCrystals, LargeOnesLoseDiffractedAndUndeviatedLight) {
  CrystalTableSettings settings = prisms(1, 200'000);
  settings.diffraction = settings.remove_forward = true;
  const ScatteringTable removed = tabulate_random_crystals(settings);
  EXPECT_NEAR(removed.forward_fraction[0], 0.5 * (1 + 0.2404), 0.002);
  settings.remove_forward = false;
  const ScatteringTable kept = tabulate_random_crystals(settings);
  check_table(kept, "kept");
  EXPECT_EQ(kept.forward_fraction[0], 0);
  EXPECT_EQ(kept.extinction_cross_section_m2[0], removed.extinction_cross_section_m2[0]);
  // What is left is the same light.
  const double rest = 1 - removed.forward_fraction[0];
  EXPECT_NEAR(mean_between(kept, 0, 22, 24) / (rest * mean_between(removed, 0, 22, 24)), 1, 0.01);

  const Wavelengths wavelengths{{450, 500, 550, 600}};
  const Species without(removed, {}), with(kept, {});
  for (int i = 0; i < wavelength_count; ++i) {
    EXPECT_NEAR(without.albedo(200, wavelengths)[i], 1, 1e-6);
    EXPECT_NEAR(with.albedo(200, wavelengths)[i], 1, 1e-6);
    EXPECT_NEAR(without.extinction_ratio(200, wavelengths)[i], rest, 1e-6);
    EXPECT_NEAR(with.extinction_ratio(200, wavelengths)[i], 1, 1e-6);
  }
  // Light that is in no p11 is left out whether lobes are clipped or not.
  EXPECT_NEAR(Species(removed, {.clip_forward_lobe = false}).extinction_ratio(200, wavelengths)[0], rest, 1e-6);
}

TEST(TabulateCrystals, AbsorptionTakesWhatTheShortestPathsSayAndDependsOnSizeTimesCoefficient) {
  CrystalTableSettings settings = prisms(1, 100'000);
  settings.waves = {{550, 1.311, 1e-5}, {560, 1.311, 1e-2}};
  settings.size_um = {50, 100, 200};
  const ScatteringTable t = tabulate_random_crystals(settings);
  check_table(t, "absorbing");
  const auto absorbed = [&](std::size_t size, std::size_t wavelength) {
    return 1 - t.scattering_cross_section_m2[t.row(size, wavelength)] / t.extinction_cross_section_m2[t.row(size, wavelength)];
  };
  // Weakly absorbing, a convex body takes 4 volume / surface times the coefficient and n² (1 − what never gets out) of diffuse light:
  // at least the chord without refraction, at most n² times it.
  for (std::size_t size = 0; size < 3; ++size) {
    const CrystalShape shape = make_crystal({.aspect_ratio = 1}, t.size_um[size]);
    const double chord = 4 * shape.volume() / shape.surface();
    EXPECT_GT(absorbed(size, 0), 1e-5 * chord);
    EXPECT_LT(absorbed(size, 0), 1e-5 * chord * 1.311 * 1.311);
  }
  EXPECT_NEAR(absorbed(1, 0) / absorbed(0, 0), 2, 0.003);
  EXPECT_NEAR(absorbed(2, 0) / absorbed(0, 0), 4, 0.01);
  EXPECT_GT(absorbed(2, 1), 0.3);
  // Twice the size with half the coefficient is the same crystal.
  settings.waves = {{550, 1.311, 5e-3}};
  settings.size_um = {200};
  const ScatteringTable other = tabulate_random_crystals(settings);
  EXPECT_NEAR(1 - other.scattering_cross_section_m2[0] / other.extinction_cross_section_m2[0], absorbed(1, 1), 1e-6);
}

TEST(TabulateCrystals, PolarisesAsFresnelAndSnellSay) {
  const ScatteringTable t = tabulate_random_crystals(prisms(1, 300'000));
  const HatNodes nodes(t.scattering_angle_deg);
  const auto degree_at = [&](double deg) {
    const std::size_t i = nodes.place_of(sin2_half_deg(deg)).node;
    return t.p12[i] / t.p11[i];
  };
  // Two refractions favour the electric field in the plane of scattering: 1/cos⁴(21.9° / 2) between the polarisations, 3.7 % at the halo.
  EXPECT_NEAR(degree_at(22.3), 0.032, 0.01);
  // Reflection outside, where the halo's ring is dark, favours the other.
  EXPECT_LT(degree_at(15), -0.02);
  for (std::size_t i = 0; i < t.p11.size(); ++i) EXPECT_LE(std::fabs(t.p12[i]), t.p11[i] * 1.0001f);
  EXPECT_TRUE(std::all_of(t.p33.begin(), t.p33.end(), [](float p) { return p == 0; }));
}

TEST(TabulateCrystals, SpreadOfSizesRaisesAreasAndWidensNothingOfTheHalo) {
  CrystalTableSettings settings = prisms(1, 100'000);
  settings.size_spread = 0.4;
  settings.diffraction = true;
  const ScatteringTable t = tabulate_random_crystals(settings);
  check_table(t, "spread");
  const CrystalPopulation crystals(settings.crystals, 200);
  EXPECT_NEAR(t.extinction_cross_section_m2[0] / (2e-12 * crystals.mean_projected_area_um2()), std::exp(0.16), 1e-9);
  EXPECT_NEAR(steepest_ascent_deg(t, 0, 18, 26), least_deviation_deg(-0.5, 1.311), 0.1);
}

TEST(TabulateCrystals, AreEqualForAnyNumberOfThreads) {
  CrystalTableSettings settings = prisms(0.7, 50'000);
  settings.crystals.aspect_spread = 0.3;
  settings.diffraction = true;
  settings.waves = {{500, 1.313, 0}, {600, 1.309, 1e-6}};
  settings.size_um = {30, 200};
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return tabulate_random_crystals(settings);
  };
  const ScatteringTable one = with_threads(1), two = with_threads(2);
  EXPECT_EQ(one.p11, two.p11);
  EXPECT_EQ(one.p12, two.p12);
  EXPECT_EQ(one.scattering_cross_section_m2, two.scattering_cross_section_m2);
}

TEST(TabulateCrystals, RefuseWhatCannotBeTraced) {
  const auto refuses = [](auto change) {
    CrystalTableSettings settings = prisms(1, 1000);
    change(settings);
    try {
      tabulate_random_crystals(settings);
      return false;
    } catch (const Error& error) {
      return error.fault() == Fault::input;
    }
  };
  EXPECT_TRUE(refuses([](auto& s) { s.size_um = {-1}; }));
  EXPECT_TRUE(refuses([](auto& s) { s.size_um.clear(); }));
  EXPECT_TRUE(refuses([](auto& s) { s.waves[0].n = 1; }));
  EXPECT_TRUE(refuses([](auto& s) { s.waves[0].absorption_per_um = NAN; }));
  EXPECT_TRUE(refuses([](auto& s) { s.crystals.habit.aspect_ratio = 0; }));
  EXPECT_TRUE(refuses([](auto& s) { s.size_spread = 2; }));
  EXPECT_TRUE(refuses([](auto& s) { s.rays = NAN; }));
}

TEST(ShadowLobe, HoldsAllLightAndKeepsAnEvenGlow) {
  const CrystalPopulation crystals(crystals_of_habit("prism"), 50);
  const ShadowLobe lobe(shadows_of(crystals, {1}), 550);
  const HatNodes nodes(crystal_angles_deg(crystals, 1.31, 1.31, 0.6));
  double whole = 0;
  for (const double light : lobe.at_nodes(nodes)) whole += light;
  EXPECT_NEAR(whole, 1, 1e-9);
  const std::vector<double> even(nodes.count(), 3.0);
  for (const double value : lobe.blurred(nodes, even)) EXPECT_NEAR(value, 3, 1e-12);
}

}  // namespace arcus::phase
