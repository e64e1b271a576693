// Partial waves of eight spheres, as Legendre series: against single spheres.
#include "phase/particle/mie_waves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "phase/base/units.h"
#include "phase/particle/mie.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

struct Waves {
  Waves(const EightSpheres& spheres, Instructions instructions)
      : terms(spheres.terms()), memory((terms + 1) * 4) {
    std::vector<double> inverse(terms + 3);
    for (std::size_t n = 1; n < inverse.size(); ++n) inverse[n] = 1.0 / static_cast<double>(n);
    legendre_coefficients(spheres, inverse, memory.data(), efficiencies, instructions);
  }

  // Of S1 (0) or S2 (1).
  Complex coefficient(int n, int amplitude, int lane) const {
    const double* row = memory.data() + (4 * n + 2 * amplitude) * lanes + lane;
    return {row[0], row[lanes]};
  }

  Complex sum(int amplitude, int lane, double angle) const {
    double before = 0, value = 1;
    Complex total = 0;
    for (int n = 0; n <= terms; ++n) {
      total += coefficient(n, amplitude, lane) * value;
      const double next = ((2 * n + 1) * std::cos(angle) * value - n * before) / (n + 1);
      before = value;
      value = next;
    }
    return total;
  }

  int terms;
  LaneMemory memory;
  SphereEfficiencies efficiencies[lanes];
};

EightSpheres spheres(double x, double ratio, Complex index) {
  EightSpheres result;
  result.relative_index = index;
  for (double& size : result.size_parameter) {
    size = x;
    x *= ratio;
  }
  return result;
}

TEST(MieWaves, LegendreSeriesAreTheAmplitudes) {
  const double angles[] = {0, 0.01, 1.0, pi / 2, 2.4, pi};
  for (const Complex index : {Complex(1.333, 1e-9), Complex(0.7), Complex(1.5, 1.0)})
    // Eight of nearly one size, and from tiny to large in one go.
    for (const auto& [x, ratio] :
         {std::pair(0.01, 1.01), {10.0, 1.02}, {700.0, 1.001}, {0.001, 7.0}}) {
      const EightSpheres eight = spheres(x, ratio, index);
      const Waves waves(eight, best_instructions());
      for (int lane = 0; lane < lanes; ++lane) {
        const SphereAmplitudes single = mie_sphere(eight.size_parameter[lane], index, angles);
        for (int i = 0; i < 6; ++i) {
          const double size = std::max(std::abs(single.s1[i]), std::abs(single.s2[i]));
          EXPECT_LT(std::abs(waves.sum(0, lane, angles[i]) - single.s1[i]), 1e-8 * size)
              << eight.size_parameter[lane] << index << angles[i];
          EXPECT_LT(std::abs(waves.sum(1, lane, angles[i]) - single.s2[i]), 1e-8 * size)
              << eight.size_parameter[lane] << index << angles[i];
        }
        const SphereEfficiencies &found = waves.efficiencies[lane], &q = single.efficiencies;
        EXPECT_NEAR(found.extinction / q.extinction, 1, 1e-9);
        EXPECT_NEAR(found.scattering / q.scattering, 1, 1e-9);
        EXPECT_NEAR(found.backscatter / q.backscatter, 1, 1e-9);
        EXPECT_NEAR(found.asymmetry, q.asymmetry, 1e-9);
        // Weak absorption is its own sum here too.
        EXPECT_NEAR(found.extinction - found.scattering, q.extinction - q.scattering,
                    1e-9 * (q.extinction - q.scattering) + 1e-15 * q.extinction);
      }
    }
}

TEST(MieWaves, BothInstructionSetsGiveTheSameBits) {
  if (best_instructions() != Instructions::avx512) GTEST_SKIP() << "this processor has no AVX-512";
  for (const Complex index : {Complex(1.333, 1e-9), Complex(1.333), Complex(1.5, 1.0)})
    for (const double x : {0.01, 3.0, 50.0, 1000.0}) {
      const EightSpheres eight = spheres(x, 1.003, index);
      const Waves narrow(eight, Instructions::avx2), wide(eight, Instructions::avx512);
      for (int n = 0; n <= narrow.terms; ++n)
        for (int lane = 0; lane < lanes; ++lane)
          for (const int amplitude : {0, 1})
            ASSERT_EQ(narrow.coefficient(n, amplitude, lane), wide.coefficient(n, amplitude, lane))
                << x << index << " n " << n;
    }
}

}  // namespace
}  // namespace arcus::phase
