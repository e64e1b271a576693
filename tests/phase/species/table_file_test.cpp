#include "phase/species/table_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/function/analytic.h"
#include "phase/settings/number_text.h"
#include "phase/species/make_species.h"
#include "phase/species/species_file.h"
#include "tests/phase/base/netcdf_kit.h"
#include "tests/phase/species/scratch_folder.h"

namespace arcus::phase {
namespace {

Wavelengths at(float nm) { return {{nm, nm, nm, nm}}; }
Vec3 towards(double angle_deg) { return Vec3(std::sin(radians(angle_deg)), 0, std::cos(radians(angle_deg))); }

/// Two sizes and two wavelengths of droplets, computed once.
const ScatteringTable& droplets() {
  static const ScatteringTable table =
      compute_table(recipe_from_text("size_um = [3, 4]\nwavelength_nm = [500, 600]\nradii = 300\nmaterial = { n = 1.33, k = 0.0001 }", "recipe"));
  return table;
}

/// A table in the layout of libRadtran's mie: wavelengths in descending order, angles descending in every other row, and one
/// row with every second of its angles left out.
struct Layout {
  double scale = 4 * pi;                  ///< mean 1 over the sphere
  std::vector<std::string> leave_out;     ///< variables
  std::size_t elements = 4;
  std::function<void(std::vector<double>& theta, std::vector<double>& phase)> change = [](auto&, auto&) {};
};
void write_libradtran(const std::string& path, const ScatteringTable& t, const Layout& layout = {}) {
  const std::size_t sizes = t.size_um.size(), waves = t.wavelength_nm.size(), angles = t.scattering_angle_deg.size();
  std::vector<double> wavelength_um, ntheta, theta, phase, ext, ssa;
  for (std::size_t w = waves; w-- > 0;) {
    wavelength_um.push_back(1e-3 * t.wavelength_nm[w]);
    for (std::size_t r = 0; r < sizes; ++r) {
      const std::vector<float>* const elements[] = {&t.p11, &t.p12, &t.p33, &t.p34};
      const double sphere_g = 4.0 / 3 * pi * std::pow(1e-6 * t.size_um[r], 3) * 1e6;
      ext.push_back(1e3 * t.extinction_cross_section_m2[t.row(r, w)] / sphere_g);
      ssa.push_back(t.scattering_cross_section_m2[t.row(r, w)] / t.extinction_cross_section_m2[t.row(r, w)]);
      for (std::size_t e = 0; e < layout.elements; ++e) {
        std::vector<double> own_theta, own_phase;
        for (std::size_t i = 0; i < angles; ++i) {
          if (w == 0 && r == 1 && i % 2 == 1 && i + 1 < angles) continue;
          own_theta.push_back(t.scattering_angle_deg[i]);
          own_phase.push_back(layout.scale * (*elements[e])[t.first(r, w) + i]);
        }
        if (r == 0) {
          std::reverse(own_theta.begin(), own_theta.end());
          std::reverse(own_phase.begin(), own_phase.end());
        }
        ntheta.push_back(static_cast<double>(own_theta.size()));
        own_theta.resize(angles, -999);
        own_phase.resize(angles, -999);
        theta.insert(theta.end(), own_theta.begin(), own_theta.end());
        phase.insert(phase.end(), own_phase.begin(), own_phase.end());
      }
    }
  }
  layout.change(theta, phase);
  kit::NewNetcdf file(path);
  file.dimension("nlam", waves);
  file.dimension("nreff", sizes);
  file.dimension("nphamat", layout.elements);
  file.dimension("nthetamax", angles);
  const auto add = [&](const std::string& name, const std::vector<std::string>& along, const std::vector<double>& values, nc_type type) {
    if (std::find(layout.leave_out.begin(), layout.leave_out.end(), name) == layout.leave_out.end()) file.variable(name, along, values, {}, type);
  };
  add("wavelen", {"nlam"}, wavelength_um, NC_DOUBLE);
  add("reff", {"nreff"}, t.size_um, NC_DOUBLE);
  add("ntheta", {"nlam", "nreff", "nphamat"}, ntheta, NC_INT);
  add("theta", {"nlam", "nreff", "nphamat", "nthetamax"}, theta, NC_FLOAT);
  add("phase", {"nlam", "nreff", "nphamat", "nthetamax"}, phase, NC_FLOAT);
  add("ext", {"nlam", "nreff"}, ext, NC_DOUBLE);
  add("ssa", {"nlam", "nreff"}, ssa, NC_DOUBLE);
}

class TableFileTest : public testing::Test {
 protected:
  std::string path(const std::string& name) { return scratch_.path(name); }
  std::string refusal(const std::string& name) {
    try {
      read_table_file(path(name));
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << "the file is not named: " << error.what();
      return error.what();
    }
    ADD_FAILURE() << name << " was read";
    return "";
  }
  std::string refused_text(const std::string& text) {
    write_whole_file(path("t.txt"), text);
    return refusal("t.txt");
  }
  /// Henyey-Greenstein as columns, every tenth of a degree in front and every half behind, times a factor.
  void write_hg(const std::string& name, double g, double factor) {
    const HenyeyGreenstein hg(g);
    std::string text = "# angle value\n";
    for (double deg = 0; deg <= 180; deg += deg < 20 ? 0.125 : 0.5) {
      const double sine = std::sin(0.5 * radians(deg)), cosine = std::cos(0.5 * radians(deg));
      text += number_text(deg) + " " + number_text(factor * hg.value_per_sr(HalfAngle{sine * sine, cosine * cosine})) + "\n";
    }
    write_whole_file(path(name), text);
  }
  ScratchFolder scratch_;
};

TEST_F(TableFileTest, HenyeyGreensteinAsTextIsWhatItsFormulaSays) {
  write_hg("hg.txt", 0.85, 1);
  const TableFile file = read_table_file(path("hg.txt"));
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_NEAR(file.table.asymmetry.at(0), 0.85, 5e-4);
  const auto species = make_species(recipe_from_text("type = 'table'\nfile = '" + path("hg.txt") + "'", "recipe"), {});
  const PhaseFunction table = species->phase_function(1, 0), formula{HenyeyGreenstein(0.85)};
  for (double deg = 0; deg <= 180; deg += 1.3) {
    const double exact = formula.value({0, 0, 1}, towards(deg), at(550))[0];
    EXPECT_NEAR(table.value({0, 0, 1}, towards(deg), at(550))[0], exact, 3e-3 * exact) << deg;
  }
}

TEST_F(TableFileTest, UsualNormalisationsOfTextAreSilentAndOthersAWarning) {
  for (const double factor : {1.0, 2 * pi, 4 * pi, 1.005}) {
    write_hg("hg.txt", 0.5, factor);
    EXPECT_TRUE(read_table_file(path("hg.txt")).warnings.empty()) << factor;
  }
  write_hg("hg.txt", 0.5, 1.03);
  const TableFile file = read_table_file(path("hg.txt"));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("1.0"), std::string::npos) << file.warnings[0];
  EXPECT_NEAR(sphere_integral(file.table.scattering_angle_deg, file.table.p11.data()), 1, 1e-5);
  // Who makes the species hears of it.
  std::string told;
  SpeciesOptions options;
  options.log = [&](std::string_view line) { told += line; };
  make_species(recipe_from_text("type = 'table'\nfile = '" + path("hg.txt") + "'", "recipe"), options);
  EXPECT_NE(told.find("only its shape"), std::string::npos);
}

TEST_F(TableFileTest, MoreColumnsAreMoreWavelengths) {
  write_whole_file(path("t.txt"), "angle,450nm,650\n0,1,3\n90,1,2\n180,1,1\n");
  const TableFile file = read_table_file(path("t.txt"));
  EXPECT_EQ(file.table.wavelength_nm, (std::vector<double>{450, 650}));
  check_table(file.table, "t");
  const auto species = make_species(recipe_from_text("type = 'table'\nfile = '" + path("t.txt") + "'", "recipe"), {});
  EXPECT_NEAR(species->phase_function(1, 0).value({0, 0, 1}, {0, 0, 1}, at(450))[0], 1 / (4 * pi), 1e-4);
  EXPECT_NEAR(species->phase_function(1, 0).value({0, 0, 1}, {0, 0, 1}, at(650))[0], 3 / (8 * pi), 1e-4);
}

TEST_F(TableFileTest, TextThatIsNoTableIsRefused) {
  EXPECT_NE(refused_text("0 1 1\n180 1 1\n").find("without names"), std::string::npos);
  EXPECT_NE(refused_text("angle red 550\n0 1 1\n180 1 1\n").find("'red'"), std::string::npos);
  EXPECT_NE(refused_text("angle 650 550\n0 1 1\n180 1 1\n").find("550 nm after 650 nm"), std::string::npos);
  EXPECT_NE(refused_text("angle 450 550\n0 1 0\n180 1 0\n").find("column '550': zero"), std::string::npos);
  EXPECT_NE(refused_text("0\n180\n").find("one column"), std::string::npos);
  EXPECT_NE(refused_text("0 1\n90 nan\n180 1\n").find("'nan'"), std::string::npos);
  refused_text("");
  refusal("missing.txt");
}

TEST_F(TableFileTest, LayoutOfLibradtranGivesTheSameSpecies) {
  const ScatteringTable& t = droplets();
  write_libradtran(path("mie.cdf"), t);
  const TableFile file = read_table_file(path("mie.cdf"));
  EXPECT_TRUE(file.warnings.empty()) << file.warnings[0];
  EXPECT_EQ(file.table.size_um, t.size_um);
  ASSERT_EQ(file.table.scattering_angle_deg.size(), t.scattering_angle_deg.size());
  for (std::size_t r = 0; r < 2; ++r)
    for (std::size_t w = 0; w < 2; ++w) {
      const std::size_t row = t.row(r, w);
      EXPECT_NEAR(file.table.wavelength_nm[w], t.wavelength_nm[w], 1e-9);
      EXPECT_NEAR(file.table.extinction_cross_section_m2[row] / t.extinction_cross_section_m2[row], 1, 1e-9);
      EXPECT_NEAR(file.table.scattering_cross_section_m2[row] / t.scattering_cross_section_m2[row], 1, 1e-9);
      if (w == 0 && r == 1) continue;  // half of its angles were left out
      EXPECT_NEAR(file.table.asymmetry[row], t.asymmetry[row], 1e-4);  // of the interpolant, not of the series
      for (std::size_t i = 0; i < t.scattering_angle_deg.size(); ++i) {
        const std::size_t k = t.first(r, w) + i;
        EXPECT_NEAR(file.table.p11[k], t.p11[k], 1e-4 * t.p11[k]);
        EXPECT_NEAR(file.table.p12[k], t.p12[k], 1e-4 * t.p11[k]);
        EXPECT_NEAR(file.table.p34[k], t.p34[k], 1e-4 * t.p11[k]);
      }
    }
  // Between its own nodes a row is linear in cos θ.
  const std::size_t k = file.table.first(1, 0) + 5;
  const auto& deg = t.scattering_angle_deg;
  const double share = (sin2_half_deg(deg[5]) - sin2_half_deg(deg[4])) / (sin2_half_deg(deg[6]) - sin2_half_deg(deg[4]));
  EXPECT_NEAR(file.table.p11[k], (1 - share) * file.table.p11[k - 1] + share * file.table.p11[k + 1], 1e-5 * file.table.p11[k]);
  // What the renderer asks.
  const auto species = make_species(recipe_from_text("type = 'table'\nfile = '" + path("mie.cdf") + "'", "recipe"), {.sun_angular_radius_rad = 0.00465});
  const Species own(t, {.sun_angular_radius_rad = 0.00465});
  EXPECT_NEAR(species->albedo(4, at(600))[0], own.albedo(4, at(600))[0], 1e-6);
  EXPECT_NEAR(species->extinction_ratio(3, at(500))[0], own.extinction_ratio(3, at(500))[0], 1e-5);
  for (const double angle : {0.1, 10.0, 100.0, 140.0, 179.0}) {
    const double value = own.phase_function(3, 0).value({0, 0, 1}, towards(angle), at(600))[0];
    EXPECT_NEAR(species->phase_function(3, 0).value({0, 0, 1}, towards(angle), at(600))[0], value, 1e-3 * value) << angle;
  }
}

TEST_F(TableFileTest, WavelengthsFarFromLightAreLeftOut) {
  ScatteringTable t;
  t.size_um = {5};
  t.wavelength_nm = {250, 300, 350, 500, 700, 780, 900, 1600};
  t.scattering_angle_deg = {0, 1, 2, 90, 180};
  t.p11.assign(8 * 5, static_cast<float>(0.25 / pi));
  t.p12 = t.p33 = t.p34 = std::vector<float>(8 * 5, 0);
  t.extinction_cross_section_m2 = t.scattering_cross_section_m2 = std::vector<double>(8, 1e-10);
  write_libradtran(path("mie.cdf"), t);
  const std::vector<double> found = read_table_file(path("mie.cdf")).table.wavelength_nm;
  ASSERT_EQ(found.size(), 4u);
  EXPECT_NEAR(found.front(), 350, 1e-9);
  EXPECT_NEAR(found.back(), 780, 1e-9);
}

TEST_F(TableFileTest, IntensityAloneIsEnough) {
  write_libradtran(path("mie.cdf"), droplets(), {.elements = 1});
  const TableFile file = read_table_file(path("mie.cdf"));
  EXPECT_EQ(file.table.p12.size(), file.table.p11.size());
  EXPECT_EQ(file.table.p12[7], 0);
}

TEST_F(TableFileTest, NormalisationOfLibradtranIsCheckedAndMended) {
  write_libradtran(path("mie.cdf"), droplets(), {.scale = 4 * pi * 1.05});
  const TableFile file = read_table_file(path("mie.cdf"));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("5"), std::string::npos) << file.warnings[0];
  check_table(file.table, "mended");
  write_libradtran(path("mie.cdf"), droplets(), {.scale = 1});
  EXPECT_NE(refusal("mie.cdf").find("1 expected, as libRadtran"), std::string::npos);
}

TEST_F(TableFileTest, LayoutsThatAreNoneAreRefused) {
  for (const char* name : {"wavelen", "theta", "phase", "ext", "ssa"}) {
    write_libradtran(path("mie.cdf"), droplets(), {.leave_out = {name}});
    EXPECT_NE(refusal("mie.cdf").find("libRadtran"), std::string::npos) << name;
  }
  write_libradtran(path("mie.cdf"), droplets(), {.leave_out = {"reff"}});
  EXPECT_NE(refusal("mie.cdf").find("'reff'"), std::string::npos);
  write_libradtran(path("mie.cdf"), droplets(), {.change = [](auto&, auto& phase) { phase[3] = std::nan(""); }});
  EXPECT_NE(refusal("mie.cdf").find("NaN"), std::string::npos);
  write_libradtran(path("mie.cdf"), droplets(), {.change = [](auto&, auto& phase) { phase[3] = -1; }});
  EXPECT_NE(refusal("mie.cdf").find("-1"), std::string::npos);
  write_libradtran(path("mie.cdf"), droplets(), {.change = [](auto& theta, auto&) { theta[0] = 170; }});
  EXPECT_NE(refusal("mie.cdf").find("from 0 to 180"), std::string::npos);
}

TEST_F(TableFileTest, TablesOfThisProgramAreReadAsTheyAre) {
  write_species_file(path("own.nc"), {droplets(), "type = 'mie'", "00", ""});
  const TableFile file = read_table_file(path("own.nc"));
  EXPECT_EQ(file.table.p11, droplets().p11);
  EXPECT_EQ(file.table.p34, droplets().p34);
  EXPECT_EQ(file.table.extinction_cross_section_m2, droplets().extinction_cross_section_m2);
  // Its id depends on the content alone.
  const auto id = [&](const std::string& name) { return recipe_id(recipe_from_text("type = 'table'\nfile = '" + path(name) + "'", "recipe")); };
  write_species_file(path("same.nc"), {droplets(), "type = 'mie'", "00", ""});
  write_species_file(path("other.nc"), {droplets(), "type = 'mie'", "01", ""});
  EXPECT_EQ(id("own.nc"), id("same.nc"));
  EXPECT_NE(id("own.nc"), id("other.nc"));
}

}  // namespace
}  // namespace arcus::phase
