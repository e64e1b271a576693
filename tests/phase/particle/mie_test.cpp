// Lorenz-Mie spheres against arbitrary precision, published tables, and limits known in closed
// form.
#include "phase/particle/mie.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "phase/base/curve.h"
#include "phase/base/error.h"
#include "phase/base/quadrature.h"
#include "phase/base/units.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

Columns published(const std::string& name) {
  return read_columns_file(std::string(PUBLISHED_DIR) + "/" + name);
}

SphereEfficiencies efficiencies(double x, Complex m) { return mie_sphere(x, m, {}).efficiencies; }

// One sphere of mie_reference.csv, with its amplitudes at several angles.
struct Reference {
  double x;
  Complex m;
  double q_ext, q_sca, q_abs, q_back, g;
  std::vector<double> angles;
  std::vector<Complex> s1, s2;
  double tolerance() const { return x <= 1e3 ? 1e-8 : 1e-6; }
};

std::vector<Reference> references() {
  const auto c = published("mie_reference.csv").columns;
  std::vector<Reference> spheres;
  for (std::size_t i = 0; i < c[0].size(); ++i) {
    const Complex m(c[1][i], c[2][i]);
    if (spheres.empty() || spheres.back().x != c[0][i] || spheres.back().m != m)
      spheres.push_back({c[0][i], m, c[3][i], c[4][i], c[5][i], c[6][i], c[7][i], {}, {}, {}});
    spheres.back().angles.push_back(c[8][i]);
    spheres.back().s1.emplace_back(c[9][i], c[10][i]);
    spheres.back().s2.emplace_back(c[11][i], c[12][i]);
  }
  return spheres;
}

TEST(Mie, AgreesWithArbitraryPrecision) {
  for (const Reference& r : references()) {
    const SphereAmplitudes sphere = mie_sphere(r.x, r.m, r.angles);
    const SphereEfficiencies& q = sphere.efficiencies;
    EXPECT_NEAR(q.extinction / r.q_ext, 1, r.tolerance()) << r.x << r.m;
    EXPECT_NEAR(q.scattering / r.q_sca, 1, r.tolerance()) << r.x << r.m;
    EXPECT_NEAR(q.backscatter / r.q_back, 1, r.tolerance()) << r.x << r.m;
    EXPECT_NEAR(q.asymmetry / r.g, 1, r.tolerance()) << r.x << r.m;
    // The difference of two doubles cannot hold the absorption better than this.
    const double rounding = 2 * std::numeric_limits<double>::epsilon() * r.q_ext;
    EXPECT_NEAR(q.extinction - q.scattering, r.q_abs, 1e-8 * r.q_abs + rounding) << r.x << r.m;
    for (std::size_t i = 0; i < r.angles.size(); ++i) {
      EXPECT_LE(std::abs(sphere.s1[i] - r.s1[i]), r.tolerance() * std::abs(r.s1[i]))
          << r.x << r.m << r.angles[i];
      EXPECT_LE(std::abs(sphere.s2[i] - r.s2[i]), r.tolerance() * std::abs(r.s2[i]))
          << r.x << r.m << r.angles[i];
    }
  }
}

TEST(Mie, AgreesWithWiscombe1979) {
  const Columns table = published("mie_wiscombe_1979.csv");
  for (std::size_t i = 0; i < table.columns[0].size(); ++i) {
    const double x = table.named("x")[i];
    const SphereEfficiencies q = efficiencies(x, {table.named("n")[i], table.named("k")[i]});
    EXPECT_NEAR(q.extinction, table.named("q_ext")[i], 1e-6) << x;
    EXPECT_NEAR(q.scattering, table.named("q_sca")[i], 1e-6) << x;
    EXPECT_NEAR(q.asymmetry, table.named("g")[i], 1e-6) << x;
  }
}

TEST(Mie, AgreesWithBohrenAndHuffman1983) {
  const Columns table = published("mie_bohren_huffman_1983.csv");
  std::vector<double> angles;
  for (const double angle : table.named("angle_deg")) angles.push_back(radians(angle));
  const SphereAmplitudes sphere = mie_sphere(2 * pi * 0.525 / 0.6328, 1.55, angles);
  EXPECT_NEAR(sphere.efficiencies.extinction, 3.10543, 5e-6);
  EXPECT_NEAR(sphere.efficiencies.scattering, 3.10543, 5e-6);
  EXPECT_NEAR(sphere.efficiencies.backscatter, 2.92534, 5e-6);
  const double forward = std::norm(sphere.s1[0]);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const Complex s1 = sphere.s1[i], s2 = sphere.s2[i], product = s2 * std::conj(s1);
    const double s11 = (std::norm(s1) + std::norm(s2)) / 2,
                 s12 = (std::norm(s2) - std::norm(s1)) / 2;
    const auto expect_six_digits = [&](double value, double printed) {
      EXPECT_NEAR(value, printed, 5.1e-6 * std::abs(printed) + 1e-12)
          << "angle " << degrees(angles[i]);
    };
    expect_six_digits(s11 / forward, table.named("s11")[i]);
    expect_six_digits(-s12 / s11, table.named("polarisation")[i]);
    expect_six_digits(product.real() / s11, table.named("s33")[i]);
    expect_six_digits(product.imag() / s11, table.named("s34")[i]);
  }
}

TEST(Mie, TendsToRayleighForSmallDrops) {
  for (const Complex m : {Complex(1.333), Complex(1.5, 1.0), Complex(0.75), Complex(4.0, 3.0)}) {
    const double x = 1e-3;
    const Complex polarisability = (m * m - 1.0) / (m * m + 2.0);
    const double angles[] = {0.0, 1.0, 2.5};
    const SphereAmplitudes sphere = mie_sphere(x, m, angles);
    // Corrections are of order x^2, times |m|^2; of absorption too.
    EXPECT_NEAR(
        sphere.efficiencies.scattering / (8.0 / 3 * std::pow(x, 4) * std::norm(polarisability)), 1,
        3e-5);
    const double absorption = 4 * x * polarisability.imag();
    EXPECT_NEAR(sphere.efficiencies.extinction - sphere.efficiencies.scattering, absorption,
                3e-5 * absorption);
    for (int i = 0; i < 3; ++i) {
      const Complex s1 = Complex(0, -1) * std::pow(x, 3) * polarisability;
      EXPECT_LT(std::abs(sphere.s1[i] - s1), 3e-5 * std::abs(s1));
      EXPECT_LT(std::abs(sphere.s2[i] - s1 * std::cos(angles[i])), 3e-5 * std::abs(s1));
    }
  }
}

TEST(Mie, TendsToAnomalousDiffractionForNearlyMatchedIndex) {
  // van de Hulst (1957), section 11.22: Q = 2 - 4/p sin p + 4/p^2 (1 - cos p), p = 2 x (m - 1);
  // error of order m - 1.
  for (const double m_minus_1 : {1e-3, 1e-4, 1e-5}) {
    const double x = 2000, p = 2 * x * m_minus_1;
    const double expected = 2 - 4 / p * std::sin(p) + 4 / (p * p) * (1 - std::cos(p));
    EXPECT_NEAR(efficiencies(x, 1 + m_minus_1).extinction / expected, 1, 2 * m_minus_1 + 1e-4)
        << m_minus_1;
  }
}

TEST(Mie, MatchedSphereScattersNothing) {
  const double angles[] = {0.0, 1.0};
  const SphereAmplitudes sphere = mie_sphere(100, 1.0, angles);
  EXPECT_EQ(sphere.efficiencies.extinction, 0);
  EXPECT_EQ(sphere.efficiencies.asymmetry, 0);
  EXPECT_EQ(sphere.s1[1], 0.0);
}

TEST(Mie, ForwardAmplitudeGivesTheExtinction) {  // the optical theorem
  for (const double x : {1e-3, 0.3, 7.0, 300.0, 5000.0, 50000.0})
    for (const Complex m : {Complex(1.333, 1e-9), Complex(0.8), Complex(1.5, 0.5)}) {
      const double angle[] = {0.0};
      const SphereAmplitudes sphere = mie_sphere(x, m, angle);
      EXPECT_NEAR(4 / (x * x) * sphere.s1[0].real() / sphere.efficiencies.extinction, 1, 1e-12)
          << x << m;
      EXPECT_EQ(sphere.s1[0], sphere.s2[0]);
    }
}

TEST(Mie, BackwardAmplitudeGivesTheBackscatter) {
  for (const double x : {0.3, 300.0, 5000.0}) {
    const double angle[] = {pi};
    const SphereAmplitudes sphere = mie_sphere(x, {1.333, 1e-9}, angle);
    EXPECT_NEAR(4 / (x * x) * std::norm(sphere.s1[0]) / sphere.efficiencies.backscatter, 1, 1e-9)
        << x;
    EXPECT_LT(std::abs(sphere.s1[0] + sphere.s2[0]), 1e-9 * std::abs(sphere.s1[0])) << x;
  }
}

TEST(Mie, AmplitudesIntegrateToScatteringAndAsymmetry) {
  for (const double x : {0.5, 20.0, 400.0}) {
    const auto rule = gauss_legendre(static_cast<int>(2 * x) + 40);
    std::vector<double> angles;
    for (const double node : rule.nodes) angles.push_back(std::acos(node));
    const SphereAmplitudes sphere = mie_sphere(x, {1.333, 1e-3}, angles);
    double sum = 0, cosine_sum = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double power = rule.weights[i] * (std::norm(sphere.s1[i]) + std::norm(sphere.s2[i]));
      sum += power;
      cosine_sum += rule.nodes[i] * power;
    }
    EXPECT_NEAR(sum / (x * x) / sphere.efficiencies.scattering, 1, 1e-10) << x;
    EXPECT_NEAR(cosine_sum / sum, sphere.efficiencies.asymmetry, 1e-10) << x;
  }
}

TEST(Mie, ExtinctionTendsToTwiceTheShadow) {
  // Nussenzveig & Wiscombe (1980): Q_ext = 2 + 1.992386 x^(-2/3) + O(1/x) once the ripples are
  // absorbed.
  for (const double x : {1e3, 1e4, 1e5})
    EXPECT_NEAR(efficiencies(x, {1.5, 0.1}).extinction, 2 + 1.992386 * std::pow(x, -2.0 / 3), 2 / x)
        << x;
}

TEST(Mie, ReproducesWaterDropsAt550Nanometres) {
  // Radius [um] and g, as in clouds of that effective radius; n = 1.3347.
  for (const auto& [radius_um, g] :
       {std::pair(20.0, 0.870), std::pair(100.0, 0.882), std::pair(500.0, 0.884)}) {
    const double x = 2 * pi * radius_um / 0.55;
    double extinction = 0, asymmetry = 0, scattering = 0;
    const int count = 40;  // over one size in ten, as a distribution would
    for (int i = 0; i < count; ++i) {
      const SphereEfficiencies q = efficiencies(x * (0.95 + 0.1 * i / count), {1.3347, 2e-9});
      extinction += q.extinction / count;
      scattering += q.scattering / count;
      asymmetry += q.asymmetry * q.scattering / count;
    }
    EXPECT_NEAR(asymmetry / scattering, g, 0.003) << radius_um;
    EXPECT_NEAR(extinction, 2 + 1.992386 * std::pow(x, -2.0 / 3), 0.01) << radius_um;
  }
}

TEST(Mie, ScatteringNeverExceedsExtinction) {
  for (double x = 1e-3; x < 3e3; x *= 1.7)
    for (const double k : {0.0, 1e-12, 1e-6, 1e-2, 1.0, 8.0})
      for (const double n : {0.3, 0.999, 1.0, 1.333, 3.0}) {
        const SphereEfficiencies q = efficiencies(x, {n, k});
        EXPECT_GE(q.extinction, q.scattering) << x << " " << n << " " << k;
        EXPECT_LE(std::abs(q.asymmetry), 1) << x << " " << n << " " << k;
        if (k == 0) {
          EXPECT_EQ(q.extinction, q.scattering) << x << " " << n;
        }
      }
}

TEST(Mie, StaysFiniteForHugeAbsorptionAndExtremeSizes) {
  const double angles[] = {0.0, 1e-5, 1.0, pi};
  for (const double x : {1e-20, 1e-3, 1.0, 5e4})
    for (const Complex m :
         {Complex(0.05, 8.0), Complex(10, 10), Complex(1e-3, 1e-3), Complex(1.3, 100.0)}) {
      const SphereAmplitudes sphere = mie_sphere(x, m, angles);
      for (int i = 0; i < 4; ++i) {
        EXPECT_TRUE(std::isfinite(std::abs(sphere.s1[i]))) << x << m;
        EXPECT_TRUE(std::isfinite(std::abs(sphere.s2[i]))) << x << m;
      }
      EXPECT_GE(sphere.efficiencies.extinction, 0) << x << m;
      EXPECT_LT(sphere.efficiencies.extinction, 10) << x << m;
    }
}

TEST(Mie, AnglesDontInfluenceOneAnother) {
  std::vector<double> angles;
  for (int i = 0; i <= 20; ++i) angles.push_back(pi * i / 20);
  const SphereAmplitudes all = mie_sphere(50, {1.4, 0.01}, angles);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const SphereAmplitudes one = mie_sphere(50, {1.4, 0.01}, std::span(angles).subspan(i, 1));
    EXPECT_EQ(one.s1[0], all.s1[i]);
    EXPECT_EQ(one.s2[0], all.s2[i]);
  }
}

TEST(Mie, RefusesWhatIsNoSphere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, -1.0, nan, infinity, 1e9})
    EXPECT_THROW(mie_sphere(x, 1.33, {}), Error) << x;
  for (const Complex m : {Complex(0), Complex(-1.3), Complex(1.3, -1e-9), Complex(nan),
                          Complex(1.3, nan), Complex(1.3, infinity)})
    EXPECT_THROW(mie_sphere(1, m, {}), Error) << m;
  for (const double angle : {-0.1, 3.2, nan})
    EXPECT_THROW(mie_sphere(1, 1.33, std::span(&angle, 1)), Error) << angle;
}

}  // namespace
}  // namespace arcus::phase
