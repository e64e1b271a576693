#include "media/author/model_output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "media/author/air_density.h"
#include "media/author/droplets.h"
#include "media/author/field.h"
#include "phase/base/error.h"
#include "phase/settings/toml_text.h"
#include "tests/phase/base/netcdf_kit.h"
#include "tests/phase/species/scratch_folder.h"

namespace arcus::media {
namespace {

using Attributes = kit::NewNetcdf::Attributes;

/// What a model may have written; the water is 0.1 x + 0.01 y + 0.001 z in indices, plus 0.05.
struct Model {
  std::vector<std::string> order{"z", "y", "x"};
  std::vector<double> x{0, 50, 100, 150}, y{0, 50, 100}, z{400, 440, 480, 520, 560};
  std::string x_units = "m", z_units = "m", water_units = "g/m3", water_name = "QC";
  int mode = 0, times = 0;
  double bad_value = 0;  ///< in place of the water of cell (2, 1, 3)
  bool with_coordinates = true;
};

class ModelOutputTest : public testing::Test {
 protected:
  static double water(std::size_t x, std::size_t y, std::size_t z) {
    return 0.05 + 0.1 * static_cast<double>(x) + 0.01 * static_cast<double>(y) + 0.001 * static_cast<double>(z);
  }
  /// A value at every point, in the model's order, [time] first.
  template <class Value>
  static std::vector<double> values(const Model& m, const Value& value) {
    const std::size_t n[] = {m.x.size(), m.y.size(), m.z.size()};
    std::size_t axis[3];
    for (std::size_t i = 0; i < 3; ++i) axis[i] = static_cast<std::size_t>(m.order[i][0] - 'x');
    std::vector<double> result;
    for (int t = 0; t < std::max(m.times, 1); ++t) {
      std::size_t at[3];
      for (at[axis[0]] = 0; at[axis[0]] < n[axis[0]]; ++at[axis[0]])
        for (at[axis[1]] = 0; at[axis[1]] < n[axis[1]]; ++at[axis[1]])
          for (at[axis[2]] = 0; at[axis[2]] < n[axis[2]]; ++at[axis[2]]) result.push_back(value(at[0], at[1], at[2]) * (1 + t));
    }
    return result;
  }
  std::string path() { return scratch_.path("les.nc"); }
  /// Writes it; `more` adds variables.
  void write(const Model& m, const std::function<void(kit::NewNetcdf&, const std::vector<std::string>&)>& more = {}) {
    kit::NewNetcdf file(path(), m.mode);
    std::vector<std::string> along = m.order;
    if (m.times > 0) {
      file.dimension("time", static_cast<std::size_t>(m.times));
      along.insert(along.begin(), "time");
      file.variable("time", {"time"}, std::vector<double>(static_cast<std::size_t>(m.times), 0), {{"units", "seconds since 2000-01-01"}}, NC_DOUBLE);
    }
    const std::vector<double>* const positions[] = {&m.x, &m.y, &m.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::string name(1, "xyz"[a]);
      file.dimension(name, positions[a]->size());
      const std::string units = a == 2 ? m.z_units : m.x_units;
      if (m.with_coordinates) file.variable(name, {name}, *positions[a], units.empty() ? Attributes{} : Attributes{{"units", units}}, NC_DOUBLE);
    }
    file.variable(m.water_name, along,
                  values(m, [&](std::size_t x, std::size_t y, std::size_t z) { return m.bad_value != 0 && x == 2 && y == 1 && z == 3 ? m.bad_value : water(x, y, z); }),
                  m.water_units.empty() ? Attributes{} : Attributes{{"units", m.water_units}});
    if (more) more(file, along);
  }
  ModelOutput read(const ModelSettings& settings = {}, const std::optional<GivenLattice>& given = std::nullopt) {
    return read_model_output(path(), settings, given, false);
  }
  std::string refusal(const ModelSettings& settings = {}) {
    try {
      species_of_water(read(settings).field, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input);
      EXPECT_NE(std::string(error.what()).find("les.nc"), std::string::npos) << "the file is not named: " << error.what();
      return error.what();
    }
    ADD_FAILURE() << "was read";
    return "";
  }
  static testing::AssertionResult says(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words)
      if (text.find(word) == std::string::npos) return testing::AssertionFailure() << "'" << word << "' is not in: " << text;
    return testing::AssertionSuccess();
  }
  phase::ScratchFolder scratch_;
};

TEST_F(ModelOutputTest, AnyOrderOfDimensionsAndEitherFormatGiveTheSameField) {
  for (const auto& order : {"zyx", "xyz", "yzx", "xzy"})
    for (const int mode : {0, NC_NETCDF4}) {
      Model m;
      m.mode = mode;
      m.order = {std::string(1, order[0]), std::string(1, order[1]), std::string(1, order[2])};
      write(m);
      const WaterField field = read().field;
      ASSERT_EQ(field.count, (Coord{4, 3, 5}));
      EXPECT_EQ(field.first_x_m, 0);
      EXPECT_EQ(field.step_y_m, 50);
      EXPECT_EQ(field.level_m, (std::vector<double>{380, 420, 460, 500, 540, 580}));
      EXPECT_NEAR(field.water_g_per_m3[field.place({3, 2, 4})], water(3, 2, 4), 1e-6);
      EXPECT_NEAR(field.water_g_per_m3[field.place({3, 0, 1})], water(3, 0, 1), 1e-6);
    }
}

TEST_F(ModelOutputTest, DescendingAxesAndKilometresAreTurned) {
  Model m;
  m.x_units = m.z_units = "km";
  m.y = {0.1, 0.05, 0};
  m.x = {0, 0.05, 0.1, 0.15};
  m.z = {0.56, 0.52, 0.48, 0.44, 0.4};
  write(m);
  const WaterField field = read().field;
  EXPECT_NEAR(field.step_x_m, 50, 1e-9);
  EXPECT_NEAR(field.level_m[0], 380, 1e-9);
  EXPECT_NEAR(field.water_g_per_m3[field.place({1, 0, 0})], water(1, 2, 4), 1e-6);
}

TEST_F(ModelOutputTest, TimesArePickedByIndex) {
  Model m;
  m.times = 3;
  write(m);
  EXPECT_TRUE(says(refusal(), {"3 times", "time_index", "0 to 2"}));
  const WaterField field = read({.time_index = 2}).field;
  EXPECT_NEAR(field.water_g_per_m3[field.place({1, 1, 1})], 3 * water(1, 1, 1), 1e-6);
  EXPECT_TRUE(says(refusal({.time_index = 3}), {"time_index", "3 found"}));
  m.times = 1;
  write(m);
  EXPECT_NEAR(read().field.water_g_per_m3[0], water(0, 0, 0), 1e-6);
}

TEST_F(ModelOutputTest, UnitsAreUnderstood) {
  const struct {
    const char* unit;
    double factor;
    bool per_kg;
  } cases[] = {{"g/m3", 1, false}, {"kg m-3", 1e3, false}, {"g kg-1", 1, true}, {"kg/kg", 1e3, true}, {"kg kg**-1", 1e3, true}, {"1", 1e3, true}};
  for (const auto& c : cases) {
    Model m;
    m.water_units = c.unit;
    write(m);
    const WaterField field = read().field;
    const double air = c.per_kg ? standard_air_density_kg_per_m3(480) : 1;
    EXPECT_NEAR(field.water_g_per_m3[field.place({1, 1, 2})], water(1, 1, 2) * c.factor * air, 2e-6 * c.factor) << c.unit;
  }
  Model m;
  m.water_units = "";
  write(m);
  EXPECT_TRUE(says(refusal(), {"'QC'", "no attribute units", "water_unit"}));
  EXPECT_NEAR(read({.water_unit = "kg/m3"}).field.water_g_per_m3[0], 50, 1e-4);
  m.water_units = "mm";
  write(m);
  EXPECT_TRUE(says(refusal(), {"units 'mm'", "g/kg", "water_unit"}));
}

TEST_F(ModelOutputTest, DensityOfTheAirComesFromTheFileWhereItCan) {
  Model m;
  m.water_units = "g/kg";
  write(m, [&](kit::NewNetcdf& file, const auto&) { file.variable("RHO", {"z"}, {1, 0.9, 0.8, 0.7, 0.6}, {{"units", "kg/m3"}}); });
  ModelOutput output = read();
  EXPECT_NEAR(output.field.water_g_per_m3[output.field.place({2, 1, 3})], 0.7 * water(2, 1, 3), 1e-6);
  EXPECT_TRUE(says(output.notes.back(), {"'QC'", "'RHO'"}));
  output = read({.density = "standard"});
  EXPECT_NEAR(output.field.water_g_per_m3[0], standard_air_density_kg_per_m3(400) * water(0, 0, 0), 1e-6);
  write(m, [&](kit::NewNetcdf& file, const auto& along) {
    file.variable("p", {"z"}, {950, 945, 940, 935, 930}, {{"units", "hPa"}});
    file.variable("TABS", along, values(m, [](auto, auto, std::size_t z) { return 285.0 - static_cast<double>(z); }), {{"units", "K"}});
  });
  output = read();
  EXPECT_NEAR(output.field.water_g_per_m3[output.field.place({2, 1, 3})], air_density_kg_per_m3(93500, 282) * water(2, 1, 3), 1e-6);
  write(m, [&](kit::NewNetcdf& file, const auto&) {  // WRF's P is a perturbation
    file.variable("P", {"z"}, {95, 94.5, 94, 93.5, 93}, {{"units", "Pa"}});
    file.variable("T", {"z"}, {285, 284, 283, 282, 281}, {{"units", "K"}});
  });
  EXPECT_TRUE(says(refusal(), {"'P'", "95 Pa", "pressure", "standard"}));
}

TEST_F(ModelOutputTest, SizesComeFromRadiusThenNumber) {
  Model m;
  const auto number = [&](kit::NewNetcdf& file, const auto& along) {
    file.variable("NC", along, values(m, [](auto, auto, auto) { return 80e6; }), {{"units", "1/m3"}});
  };
  write(m, number);
  const WaterField counted = read().field;
  EXPECT_TRUE(counted.radius_um.empty());
  EXPECT_NEAR(counted.drops_per_cm3[5], 80, 1e-4);
  write(m, [&](kit::NewNetcdf& file, const auto& along) {
    number(file, along);
    file.variable("reff", along, values(m, [](std::size_t x, auto, auto) { return 1e-5 + 1e-6 * static_cast<double>(x); }), {{"units", "m"}});
  });
  const WaterField sized = read().field;
  EXPECT_TRUE(sized.drops_per_cm3.empty());
  EXPECT_NEAR(sized.radius_um[sized.place({3, 0, 0})], 13, 1e-4);
}

TEST_F(ModelOutputTest, BecomesASpeciesInMetres) {
  Model m;
  write(m, [&](kit::NewNetcdf& file, const auto& along) { file.variable("re", along, values(m, [](auto, auto, auto) { return 9; }), {{"units", "um"}}); });
  FieldSettings settings = settings_from_text<FieldSettings>("file = \"les.nc\"\nscale = 0.5", "test");
  const AuthoredField made = author_field(settings, scratch_.folder());
  ASSERT_EQ(made.grids.size(), 2u);
  EXPECT_EQ(made.grids[0].name, "cloud.extinction");
  EXPECT_LT(length(made.grids[0].world_from_index.point({3, 2, 4}) - Vec3(150, 100, 560)), 1e-9);
  EXPECT_NEAR(made.grids[0].bricks.at(0).values[3 * 64 + 2 * 8 + 4], DropletExtinction(0.1, 9, 9.09).per_m(0.5 * water(3, 2, 4), 9), 1e-6);
  settings = settings_from_text<FieldSettings>("file = \"les.nc\"\nnumber_per_cm3 = 50\nname = \"stratus\"", "test");
  const AuthoredField other = author_field(settings, scratch_.folder());
  EXPECT_EQ(other.grids[1].name, "stratus.size");
  EXPECT_NEAR(other.range.largest_size_um, effective_radius_um(water(3, 2, 4), 50, 0.1), 1e-4);
}

TEST_F(ModelOutputTest, RefusalsSayWhatThereIs) {
  Model m;
  m.water_name = "moisture";
  write(m);
  EXPECT_TRUE(says(refusal(), {"lwc, qc", "'moisture' (z, y, x)", "water = "}));
  EXPECT_TRUE(says(refusal({.water = "moistrue"}), {"'moistrue' (water)", "Did you mean 'moisture'"}));
  EXPECT_NEAR(read({.water = "moisture"}).field.water_g_per_m3[0], 0.05, 1e-7);

  m = {};
  m.bad_value = -0.5;
  write(m);
  EXPECT_TRUE(says(refusal(), {"'QC'", "cell (2, 1, 3)", "x = 100 m", "y = 50 m", "z = 520 m", "-0.5"}));
  m.bad_value = std::nan("");
  write(m);
  EXPECT_TRUE(says(refusal(), {"cell (2, 1, 3)", "NaN"}));

  m = {};
  m.x = {0, 50, 110, 150};
  write(m);
  EXPECT_TRUE(says(refusal(), {"60 m along x after 50 m", "equal steps"}));
  m.x = {0, 50, 50, 150};
  write(m);
  EXPECT_TRUE(says(refusal(), {"'x'", "50 m beside 50 m"}));
  m = {};
  m.x_units = "degrees_east";
  write(m);
  EXPECT_TRUE(says(refusal(), {"latitude or longitude", "Project it"}));
  m = {};
  m.z_units = "hPa";
  write(m);
  EXPECT_TRUE(says(refusal(), {"'z'", "pressure", "heights"}));
  m.z_units = "furlong";
  write(m);
  EXPECT_TRUE(says(refusal(), {"'z'", "'furlong'", "m or km"}));
  m = {};
  write(m, [](kit::NewNetcdf& file, const auto&) {
    file.dimension("zm", 6);
    file.variable("NC", {"zm", "y", "x"}, std::vector<double>(72, 1e8), {{"units", "m-3"}});
  });
  EXPECT_TRUE(says(refusal({.number = "NC"}), {"'NC'", "other dimensions", "staggered"}));
}

TEST_F(ModelOutputTest, DimensionsWithoutCoordinatesNeedALattice) {
  Model m;
  m.with_coordinates = false;
  write(m);
  EXPECT_TRUE(says(refusal(), {"without a coordinate variable", "voxel_m"}));
  const WaterField field = read({}, GivenLattice{{100, 200, 300}, {10, 20, 30}}).field;
  EXPECT_EQ(field.first_y_m, 200);
  EXPECT_EQ(field.step_y_m, 20);
  EXPECT_EQ(field.level_m[0], 285);
  EXPECT_NEAR(field.water_g_per_m3[field.place({3, 2, 4})], water(3, 2, 4), 1e-6);
}

TEST_F(ModelOutputTest, AxesCanBeNamed) {
  {
    kit::NewNetcdf file(path());
    for (const char* name : {"i", "j", "k"}) file.dimension(name, 2);
    file.variable("heights", {"k"}, {100, 130}, {{"units", "m"}});
    file.variable("east", {"i"}, {0, 1}, {{"units", "km"}});
    file.variable("north", {"j"}, {0, 1}, {{"units", "km"}});
    file.variable("LWC", {"i", "j", "k"}, {1, 2, 3, 4, 5, 6, 7, 8}, {{"units", "g m-3"}});
  }
  EXPECT_TRUE(says(refusal(), {"'i'", "Say which"}));
  const WaterField field = read({.axes = {.x = "east", .y = "north", .z = "heights", .time = ""}}).field;
  EXPECT_EQ(field.step_x_m, 1000);
  EXPECT_EQ(field.water_g_per_m3[field.place({1, 0, 1})], 6);
}

}  // namespace
}  // namespace arcus::media
