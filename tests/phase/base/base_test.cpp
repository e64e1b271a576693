#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include <unistd.h>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/base/frame.h"
#include "phase/base/quadrature.h"
#include "phase/base/random.h"
#include "phase/base/wavelengths.h"
#include "phase/base/whole_file.h"

namespace arcus {

TEST(Error, NamesTheNearestName) {
  const std::vector<std::string> names{"elevation_deg", "azimuth_deg", "spectrum"};
  EXPECT_EQ(nearest_name("elevation_dge", names), "elevation_deg");
  EXPECT_EQ(nearest_name("azimuth", names), "azimuth_deg");
  EXPECT_EQ(nearest_name("colour", names), "");
}

TEST(Frame, IsOrthonormalAlsoNearThePoles) {
  for (const double z : {1.0, -1.0, 1 - 1e-15, -1 + 1e-15, 0.0, 0.3}) {
    const double r = std::sqrt(std::fmax(0.0, 1 - z * z));
    const Frame f = frame_around(Vec3(r * 0.6, r * 0.8, z));
    EXPECT_NEAR(dot(f.side, f.other), 0, 1e-15);
    EXPECT_NEAR(dot(f.side, f.along), 0, 1e-15);
    EXPECT_NEAR(length(f.side), 1, 1e-15);
    EXPECT_NEAR(length(cross(f.side, f.other) - f.along), 0, 1e-14);
  }
}

TEST(Frame, CompassAzimuthRunsFromNorthToEast) {
  EXPECT_NEAR(length(direction_of(0, 0) - Vec3(0, 1, 0)), 0, 1e-15);
  EXPECT_NEAR(length(direction_of(90, 0) - Vec3(1, 0, 0)), 0, 1e-15);
  EXPECT_NEAR(length(direction_of(123, 90) - Vec3(0, 0, 1)), 0, 1e-15);
}

TEST(Frame, DirectionAtHasTheScatteringAngle) {
  const Frame f = frame_around(normalize(Vec3(0.3, -0.2, 0.9)));
  for (const double angle : {1e-6, 0.01, 1.0, 3.14}) {
    const double s = std::pow(std::sin(angle / 2), 2);
    EXPECT_NEAR(angle_between_rad(f.along, direction_at(f, s, 1.1)), angle, 1e-12);
    EXPECT_NEAR(sin2_half_angle(f.along, direction_at(f, s, 1.1)) / s, 1, 1e-9);
  }
}

TEST(Quadrature, IsExactForPolynomialsOfItsDegree) {
  for (const int n : {1, 2, 5, 16, 301}) {
    const Quadrature rule = gauss_legendre(n);
    double sum = 0, power = 0;
    const int degree = 2 * std::min(n, 12) - 2;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      sum += rule.weights[i];
      power += rule.weights[i] * std::pow(rule.nodes[i], degree);
    }
    EXPECT_NEAR(sum, 2, 1e-13);
    EXPECT_NEAR(power, 2.0 / (degree + 1), 1e-13);
  }
}

TEST(Quadrature, AdaptiveIntegralFindsANarrowPeak) {
  const double width = 1e-4;
  const double found = integrate([&](double x) { return width / (x * x + width * width); }, -1, 1, 1e-10);
  EXPECT_NEAR(found, 2 * std::atan(1 / width), 1e-8);
}

TEST(Random, DependsOnSeedStreamAndSampleAlone) {
  Random a(1, 2, 3), b(1, 2, 3);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(a.bits(), b.bits());
  std::set<std::uint32_t> first;
  for (unsigned i = 0; i < 8; ++i)
    first.insert(Random(i & 1, (i >> 1) & 1, i >> 2).bits());
  EXPECT_EQ(first.size(), 8u);
}

TEST(Random, IsUniform) {
  Random random(7, 1, 1);
  double sum = 0, squares = 0;
  const int n = 1000000;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    ASSERT_TRUE(u >= 0 && u < 1);
    sum += u;
    squares += u * u;
  }
  EXPECT_NEAR(sum / n, 0.5, 4 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(squares / n, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / n));
}

TEST(Wavelengths, DensityIntegratesToOneAndMatchesTheDraw) {
  EXPECT_NEAR(integrate(wavelength_density_per_nm, 380, 780, 1e-12), 1, 1e-10);
  for (const double u : {0.0, 0.1, 0.37, 0.99}) {
    const Wavelengths w = draw_wavelengths(u);
    for (int i = 0; i < wavelength_count; ++i) {
      const double share = std::fmod(u + 0.25 * i, 1.0);
      EXPECT_NEAR(integrate(wavelength_density_per_nm, 380, w[i], 1e-12), share, 1e-6);
    }
  }
}

TEST(Curve, InterpolatesAndIntegrates) {
  const Curve curve({0, 1, 3}, {0, 2, 0}, "test");
  EXPECT_DOUBLE_EQ(curve(0.5), 1);
  EXPECT_DOUBLE_EQ(curve(-1), 0);
  EXPECT_DOUBLE_EQ(curve(2), 1);
  EXPECT_DOUBLE_EQ(curve.integral(0, 3), 3);
  EXPECT_DOUBLE_EQ(curve.integral(0.5, 2), 0.75 + 1.5);
}

TEST(Columns, SayWhichLineIsWrong) {
  EXPECT_EQ(read_columns("# text\nx,y\n1,2\n3 4\n", "t").named("y")[1], 4);
  try {
    read_columns("1,2\n3\n", "file.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(std::string(error.what()).find("file.csv:2"), std::string::npos);
  }
  EXPECT_THROW(read_columns("1,nan\n", "t"), Error);
}

TEST(WholeFile, IsSeenWhileItIsBeingWrittenHere) {
  const auto folder = std::filesystem::temp_directory_path() / ("being_written_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "a.txt").string(), gone = (folder / ".b.partelsewhere-1-0.txt").string();
  std::ofstream(gone) << "of another machine";
  EXPECT_FALSE(is_being_written_here(path));
  {
    WholeFile file(path);
    EXPECT_TRUE(is_being_written_here(path));
    EXPECT_FALSE(is_being_written_here((folder / "b.txt").string()));
    file.commit();
    EXPECT_FALSE(is_being_written_here(path));
  }
  // A process that cannot be: numbers of processes end at 2^22.
  const WholeFile file(path);
  ASSERT_TRUE(is_being_written_here(path));
  const std::string name = std::filesystem::path(file.temporary_path()).filename().string(), mine = std::to_string(::getpid());
  std::string dead = name;
  dead.replace(dead.rfind(mine + "-"), mine.size(), "4194305").replace(1, 1, "c");
  std::ofstream((folder / dead).string()) << "of a process that was killed";
  EXPECT_FALSE(is_being_written_here((folder / "c.txt").string()));
  std::filesystem::remove_all(folder);
}

TEST(WholeFile, LeavesNothingUnlessCommitted) {
  const auto folder = std::filesystem::temp_directory_path() / ("whole_file_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  { WholeFile file((folder / "a.txt").string()); }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  write_whole_file((folder / "a.txt").string(), "text");
  EXPECT_EQ(std::filesystem::file_size(folder / "a.txt"), 4u);
  EXPECT_THROW(WholeFile((folder / "none" / "a.txt").string()), Error);
  std::filesystem::remove_all(folder);
}

}  // namespace arcus
