#include "phase/species/species_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "phase/base/error.h"
#include "phase/base/version.h"
#include "phase/base/whole_file.h"
#include "phase/settings/toml_text.h"
#include "tests/phase/species/scratch_folder.h"

namespace arcus::phase {
namespace {

/// Two sizes, two wavelengths, three angles; p11 between them linear in s, integral 1.
SpeciesFile example() {
  SpeciesFile file;
  ScatteringTable& t = file.table;
  t.size_um = {5, 10};
  t.wavelength_nm = {500, 600};
  t.scattering_angle_deg = {0, 90, 180};
  t.extinction_cross_section_m2 = {1e-10, 2e-10, 3e-10, 4e-10};
  t.scattering_cross_section_m2 = {0.9e-10, 1.9e-10, 2.9e-10, 3.9e-10};
  t.asymmetry = {0.1, 0.2, 0.3, 0.4};
  t.forward_fraction = {0, 0, 0.4, 0.5};
  const float quarter = static_cast<float>(0.25 / pi);
  for (int row = 0; row < 4; ++row) t.p11.insert(t.p11.end(), {2 * quarter, quarter, 0});
  for (std::size_t i = 0; i < 12; ++i) t.p12.push_back(0.01f * static_cast<float>(i));
  t.p33 = t.p34 = t.p12;
  t.forward_angle_deg = 0.5;
  t.normalisation_error = 1e-4;
  t.angle_error = 2e-3;
  file.recipe = "type = \"mie\"\n";
  file.recipe_id = "0123456789abcdef0123456789abcdef";
  return file;
}

std::string refusal(const std::string& path) {
  try {
    read_species_file(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

}  // namespace

TEST(SpeciesFile, ReadsBackWhatWasWritten) {
  const ScratchFolder folder;
  const SpeciesFile written = example();
  write_species_file(folder.path("a.nc"), written);
  const SpeciesFile read = read_species_file(folder.path("a.nc"));
  EXPECT_EQ(read.recipe, written.recipe);
  EXPECT_EQ(read.recipe_id, written.recipe_id);
  EXPECT_EQ(read.program_version, version);
  const ScatteringTable &a = read.table, &b = written.table;
  EXPECT_EQ(a.size_um, b.size_um);
  EXPECT_EQ(a.wavelength_nm, b.wavelength_nm);
  EXPECT_EQ(a.scattering_angle_deg, b.scattering_angle_deg);
  EXPECT_EQ(a.extinction_cross_section_m2, b.extinction_cross_section_m2);
  EXPECT_EQ(a.scattering_cross_section_m2, b.scattering_cross_section_m2);
  EXPECT_EQ(a.asymmetry, b.asymmetry);
  EXPECT_EQ(a.forward_fraction, b.forward_fraction);
  EXPECT_EQ(a.p11, b.p11);
  EXPECT_EQ(a.p12, b.p12);
  EXPECT_EQ(a.p33, b.p33);
  EXPECT_EQ(a.p34, b.p34);
  EXPECT_EQ(a.forward_angle_deg, b.forward_angle_deg);
  EXPECT_EQ(a.normalisation_error, b.normalisation_error);
  EXPECT_EQ(a.angle_error, b.angle_error);
}

TEST(SpeciesFile, AnyDamageIsAnError) {
  const ScratchFolder folder;
  write_species_file(folder.path("a.nc"), example());
  const std::string whole = read_text_file(folder.path("a.nc"));
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 40) {
    write_whole_file(folder.path("cut.nc"), whole.substr(0, length));
    EXPECT_FALSE(refusal(folder.path("cut.nc")).empty()) << length << " bytes";
  }
  for (std::size_t place = 0; place < whole.size(); place += 1 + whole.size() / 200) {
    std::string changed = whole;
    changed[place] = static_cast<char>(changed[place] ^ 0x5a);
    write_whole_file(folder.path("changed.nc"), changed);
    EXPECT_FALSE(refusal(folder.path("changed.nc")).empty()) << "byte " << place;
  }
}

TEST(SpeciesFile, WhatIsNoTableIsRefusedWithItsName) {
  const ScratchFolder folder;
  EXPECT_NE(refusal(folder.path("none.nc")).find("none.nc"), std::string::npos);
  write_whole_file(folder.path("text.nc"), "not a table\n");
  EXPECT_NE(refusal(folder.path("text.nc")).find("text.nc"), std::string::npos);
}

TEST(SpeciesFile, TablesThatCannotBeRenderedAreRefused) {
  const ScratchFolder folder;
  const auto refused = [&](auto&& change) {
    SpeciesFile file = example();
    change(file.table);
    write_species_file(folder.path("bad.nc"), file);
    return !refusal(folder.path("bad.nc")).empty();
  };
  EXPECT_FALSE(refused([](ScatteringTable&) {}));
  EXPECT_TRUE(refused([](ScatteringTable& t) { t.p11[4] = -1; }));
  EXPECT_TRUE(refused([](ScatteringTable& t) { t.p12[4] = std::nanf(""); }));
  EXPECT_TRUE(refused([](ScatteringTable& t) { t.p11[4] *= 1.01f; }));
  EXPECT_TRUE(refused([](ScatteringTable& t) { t.scattering_angle_deg[2] = 179; }));
  EXPECT_TRUE(refused([](ScatteringTable& t) { t.size_um = {10, 5}; }));
  EXPECT_TRUE(refused([](ScatteringTable& t) { t.extinction_cross_section_m2[0] = 0; }));
  EXPECT_TRUE(refused([](ScatteringTable& t) { t.forward_fraction[0] = 1; }));
}

TEST(SpeciesFile, AFolderThatIsNotThereCannotBeWritten) {
  try {
    write_species_file("/nowhere/at/all/a.nc", example());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::failed);
  }
}

TEST(SpeciesFile, OpensInOtherProgramsWithUnitsAndNames) {
  if (std::system("ncdump > /dev/null 2>&1") == 127 * 256) GTEST_SKIP() << "ncdump is not installed";
  const ScratchFolder folder;
  write_species_file(folder.path("a.nc"), example());
  ASSERT_EQ(std::system(("ncdump -h " + folder.path("a.nc") + " > " + folder.path("header")).c_str()), 0);
  const std::string header = read_text_file(folder.path("header"));
  for (const char* part :
       {"size_um = 2", "wavelength_nm = 2", "scattering_angle_deg = 3", "double size_um(size_um)",
        "extinction_cross_section(size_um, wavelength_nm)", "extinction_cross_section:units = \"m2\"",
        "float P11(size_um, wavelength_nm, scattering_angle_deg)", "P11:units = \"sr-1\"", "P34:long_name",
        ":recipe = ", ":recipe_id = ", ":program_version = ", ":references = ", ":Conventions = \"CF-1.8\""})
    EXPECT_NE(header.find(part), std::string::npos) << part << " in\n" << header;
}

}  // namespace arcus::phase
