// Many spheres at many angles against single spheres.
#include "phase/particle/mie_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/particle/mie.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

constexpr int elements = mie_block_elements;

// Denser where light is: the forward peak, the bows, the glory.
std::vector<double> table_angles() {
  std::vector<double> angles;
  const auto add = [&](double from, double to, double step) {
    for (double angle = from; angle < to; angle += step) angles.push_back(radians(angle));
  };
  add(0, 2, 0.01);
  add(2, 120, 0.5);
  add(120, 150, 0.1);
  add(150, 175, 0.5);
  add(175, 180, 0.05);
  angles.push_back(pi);
  return angles;
}

// Sixteen sizes from x upward, half a percent in all.
std::vector<double> neighbours(double x) {
  std::vector<double> sizes;
  for (int i = 0; i < mie_block_radii; ++i) sizes.push_back(x * (1 + 0.0003 * i));
  return sizes;
}

struct Result {
  std::vector<float> matrix;
  std::vector<SphereEfficiencies> efficiencies;
};

Result computed(const MieAngles& angles, const std::vector<double>& sizes, Complex index,
                Instructions instructions = best_instructions()) {
  Result result{std::vector<float>(sizes.size() * elements * angles.size()),
                std::vector<SphereEfficiencies>(sizes.size())};
  mie_block(angles, sizes, index, result.matrix, result.efficiencies, instructions);
  return result;
}

struct Expected {
  double element[elements];
  double brightness;  // the largest |S1|^2, |S2|^2 within half an oscillation
};

Expected expected(double x, Complex index, double angle) {
  std::vector<double> around;
  for (int i = -8; i <= 8; ++i)
    around.push_back(std::clamp(angle + i / 8.0 * std::min(1.0, pi / 2 / x), 0.0, pi));
  const SphereAmplitudes sphere = mie_sphere(x, index, around);
  const Complex s1 = sphere.s1[8], s2 = sphere.s2[8], product = s2 * std::conj(s1);
  Expected result{{(std::norm(s2) + std::norm(s1)) / 2, (std::norm(s2) - std::norm(s1)) / 2,
                   product.real(), product.imag()},
                  0};
  for (std::size_t i = 0; i < around.size(); ++i)
    result.brightness =
        std::max({result.brightness, std::norm(sphere.s1[i]), std::norm(sphere.s2[i])});
  return result;
}

// Every `stride`-th angle of some of the spheres.
void expect_single_spheres(const MieAngles& shared, const std::vector<double>& angles,
                           const std::vector<double>& sizes, Complex index, double tolerance,
                           std::size_t stride) {
  const Result result = computed(shared, sizes, index);
  for (std::size_t r = 0; r < sizes.size(); r += 5) {
    double worst = 0, worst_angle = 0;
    for (std::size_t i = 0; i < angles.size();
         i = i + 1 == angles.size() ? i + 1 : std::min(i + stride, angles.size() - 1)) {
      const Expected single = expected(sizes[r], index, angles[i]);
      for (int e = 0; e < elements; ++e) {
        const double value = result.matrix[(r * elements + e) * angles.size() + i];
        const double error = std::abs(value - single.element[e]) / single.brightness;
        if (!(error <= worst)) {
          worst = error;
          worst_angle = angles[i];
        }
      }
    }
    EXPECT_LT(worst, tolerance) << "x " << sizes[r] << " m " << index << " angle "
                                << degrees(worst_angle);
    const SphereEfficiencies q = mie_sphere(sizes[r], index, {}).efficiencies,
                             &found = result.efficiencies[r];
    EXPECT_NEAR(found.extinction / q.extinction, 1, 1e-9) << sizes[r] << index;
    EXPECT_NEAR(found.scattering / q.scattering, 1, 1e-9) << sizes[r] << index;
    EXPECT_NEAR(found.asymmetry, q.asymmetry, 1e-9) << sizes[r] << index;
    EXPECT_NEAR(found.backscatter / q.backscatter, 1, 1e-6) << sizes[r] << index;
  }
}

TEST(MieBlock, AgreesWithSingleSpheres) {
  const std::vector<double> angles = table_angles();
  const MieAngles shared(angles, 10050);
  for (const double x : {0.001, 0.1, 1.0, 5.5, 30.0, 150.0, 600.0})
    for (const Complex index :
         {Complex(1.333, 1e-9), Complex(1.5, 0.1), Complex(0.8), Complex(2.0, 5.0)})
      expect_single_spheres(shared, angles, neighbours(x), index, 1e-6, 17);
  expect_single_spheres(shared, angles, neighbours(2000), {1.333, 1e-9}, 1e-6, 17);
  expect_single_spheres(shared, angles, neighbours(10000), {1.333, 1e-9}, 1e-6, 61);
}

TEST(MieBlock, AgreesWithALargeSphere) {
  const std::vector<double> angles = table_angles();
  const MieAngles shared(angles, 5e4);
  expect_single_spheres(shared, angles, {5e4}, {1.333, 1e-9}, 5e-6, 61);
}

TEST(MieBlock, ResolvesAlexandersDarkBand) {
  // Between the bows, where |S|^2 is 1e-8 and less of the forward peak's: the mean over the band is
  // right to 1e-6, and so is every angle relative to that mean.
  std::vector<double> angles;
  for (double angle = 131; angle < 136; angle += 0.01) angles.push_back(radians(angle));
  const double x = 3000;
  const MieAngles shared(angles, x);
  const Result result = computed(shared, {x}, {1.333, 1e-9});
  const SphereAmplitudes single = mie_sphere(x, {1.333, 1e-9}, angles);
  double mean = 0, error = 0, worst = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double i11 = (std::norm(single.s1[i]) + std::norm(single.s2[i])) / 2;
    mean += i11 / angles.size();
    error += (result.matrix[i] - i11) / angles.size();
    worst = std::max(worst, std::abs(result.matrix[i] - i11));
  }
  EXPECT_LT(mean, 1e-8 * std::pow(x, 4) / 4);
  EXPECT_LT(std::abs(error), 1e-6 * mean);
  EXPECT_LT(worst, 1e-5 * mean);
}

TEST(MieBlock, SpheresOfManySizesShareABlock) {
  std::vector<double> sizes;
  for (double x = 0.001; sizes.size() < mie_block_radii; x *= 2.7) sizes.push_back(x);
  const std::vector<double> angles = table_angles();
  const MieAngles shared(angles, sizes.back());
  expect_single_spheres(shared, angles, sizes, {1.333, 1e-9}, 1e-6, 17);
  std::reverse(sizes.begin(), sizes.end());
  expect_single_spheres(shared, angles, sizes, {1.333, 1e-9}, 1e-6, 17);
}

TEST(MieBlock, AnyNumberOfSpheresAndAngles) {
  std::vector<double> all_angles = table_angles();
  for (const std::size_t angle_count : {1, 7, 8, 9, 63, 64, 65, 200}) {
    const std::vector<double> angles(all_angles.begin(), all_angles.begin() + angle_count);
    const MieAngles shared(angles, 60);
    for (const int sphere_count : {1, 7, 8, 9, 16, 17, 33}) {
      std::vector<double> sizes;
      for (int i = 0; i < sphere_count; ++i) sizes.push_back(40 + 0.5 * i);
      const Result result = computed(shared, sizes, 1.5);
      for (const int r : {0, sphere_count - 1}) {
        const SphereAmplitudes single = mie_sphere(sizes[r], 1.5, angles);
        for (const std::size_t i : {std::size_t(0), angle_count - 1}) {
          const double i11 = (std::norm(single.s1[i]) + std::norm(single.s2[i])) / 2;
          EXPECT_NEAR(result.matrix[r * elements * angle_count + i] / i11, 1, 1e-5)
              << angle_count << " " << sphere_count;
        }
        EXPECT_NEAR(result.efficiencies[r].extinction / single.efficiencies.extinction, 1, 1e-9);
      }
    }
  }
}

TEST(MieBlock, BothInstructionSetsGiveTheSameBits) {
  if (best_instructions() != Instructions::avx512) GTEST_SKIP() << "this processor has no AVX-512";
  const std::vector<double> angles = table_angles();
  const MieAngles shared(angles, 6100);
  for (const double x : {0.01, 1.0, 40.0, 333.0, 1500.0, 6000.0})
    for (const Complex index : {Complex(1.333, 1e-9), Complex(1.333), Complex(1.6, 0.2)}) {
      const Result narrow = computed(shared, neighbours(x), index, Instructions::avx2);
      const Result wide = computed(shared, neighbours(x), index, Instructions::avx512);
      EXPECT_EQ(narrow.matrix, wide.matrix) << x << index;
      for (int r = 0; r < mie_block_radii; ++r) {
        EXPECT_EQ(narrow.efficiencies[r].extinction, wide.efficiencies[r].extinction) << x << index;
        EXPECT_EQ(narrow.efficiencies[r].scattering, wide.efficiencies[r].scattering) << x << index;
        EXPECT_EQ(narrow.efficiencies[r].backscatter, wide.efficiencies[r].backscatter)
            << x << index;
        EXPECT_EQ(narrow.efficiencies[r].asymmetry, wide.efficiencies[r].asymmetry) << x << index;
      }
    }
}

TEST(MieBlock, RunsOfAnglesAndReusedMemoryGiveTheSameBits) {
  const std::vector<double> angles = table_angles();
  const MieAngles shared(angles, 800);
  const Result whole = computed(shared, neighbours(100), {1.333, 1e-9});
  MieBlock block(shared);
  block.compute(neighbours(700), 1.5);
  block.compute(neighbours(100), {1.333, 1e-9});
  ASSERT_EQ(block.efficiencies().size(), std::size_t(mie_block_radii));
  for (const auto& [first, count] :
       {std::pair<std::size_t, std::size_t>(0, 64), {64, 200}, {301, 17}}) {
    std::vector<float> part(mie_block_radii * elements * count);
    block.matrix(first, count, part);
    for (int row = 0; row < mie_block_radii * elements; ++row)
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(part[row * count + i], whole.matrix[row * angles.size() + first + i])
            << row << " " << i;
  }
}

TEST(MieBlock, ThreadsShareTheAngles) {
  const std::vector<double> angles = table_angles();
  const MieAngles shared(angles, 300);
  const Result alone = computed(shared, neighbours(250), 1.4);
  Result results[4];
  std::vector<std::thread> threads;
  for (Result& result : results)
    threads.emplace_back([&] { result = computed(shared, neighbours(250), 1.4); });
  for (std::thread& thread : threads) thread.join();
  for (const Result& result : results) EXPECT_EQ(result.matrix, alone.matrix);
}

TEST(MieBlock, RefusesWhatIsNoSphere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> angles = {0.0, 1.0};
  EXPECT_THROW(MieAngles({}, 10), Error);
  EXPECT_THROW(MieAngles(std::vector<double>{-0.1}, 10), Error);
  EXPECT_THROW(MieAngles(std::vector<double>{nan}, 10), Error);
  for (const double x : {0.0, nan, 1e9}) EXPECT_THROW(MieAngles(angles, x), Error) << x;
  const MieAngles shared(angles, 10);
  for (const double x : {0.0, -1.0, nan, 11.0})
    EXPECT_THROW(computed(shared, {x}, 1.33), Error) << x;
  for (const Complex m : {Complex(0), Complex(1.3, -1e-9), Complex(nan), Complex(1.3, nan)})
    EXPECT_THROW(computed(shared, {1.0}, m), Error) << m;
}

}  // namespace
}  // namespace arcus::phase
