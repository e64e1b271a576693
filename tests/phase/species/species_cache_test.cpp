#include "phase/species/species_cache.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "phase/base/units.h"
#include "phase/base/whole_file.h"
#include "tests/phase/species/scratch_folder.h"

namespace {
bool has_locks = true;
}

/// Stands before the library's, in this program: a file system such as NFS without its lock service, when wanted.
extern "C" int flock(int file, int operation) {
  if (has_locks) return static_cast<int>(::syscall(SYS_flock, file, operation));
  errno = ENOLCK;
  return -1;
}

namespace arcus::phase {
namespace {

const std::string id = "00112233445566778899aabbccddeeff";

SpeciesFile isotropic(double size_um) {
  SpeciesFile file;
  ScatteringTable& t = file.table;
  t.size_um = {size_um};
  t.wavelength_nm = {550};
  t.scattering_angle_deg = {0, 180};
  t.extinction_cross_section_m2 = t.scattering_cross_section_m2 = {1e-10};
  t.asymmetry = t.forward_fraction = {0};
  t.p11.assign(2, static_cast<float>(0.25 / pi));
  t.p12 = t.p33 = t.p34 = {0, 0};
  file.recipe_id = id;
  return file;
}

struct Told {
  std::string text;
  std::function<void(std::string_view)> log() {
    return [this](std::string_view line) { text.append(line).append("\n"); };
  }
};

int files_in(const std::string& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

}  // namespace

TEST(SpeciesCache, MakesWhatIsMissingOnceAndKeepsIt) {
  const ScratchFolder folder;
  Told told;
  const SpeciesCache cache(folder.path("new/phase"), told.log());
  int made = 0;
  const auto make = [&] { return ++made, isotropic(7); };
  EXPECT_EQ(cache.find_or_make(id, make).size_um[0], 7);
  EXPECT_EQ(cache.find_or_make(id, make).size_um[0], 7);
  EXPECT_EQ(made, 1);
  EXPECT_EQ(told.text, "");
  EXPECT_EQ(files_in(folder.path("new/phase")), 1);  // the table; no lock, nothing temporary
}

TEST(SpeciesCache, MakesADamagedTableAgainAndWarns) {
  const ScratchFolder folder;
  Told told;
  const SpeciesCache cache(folder.folder(), told.log());
  int made = 0;
  const auto make = [&] { return ++made, isotropic(7); };
  cache.find_or_make(id, make);
  write_whole_file(cache.path_of(id), "damaged");
  EXPECT_EQ(cache.find_or_make(id, make).size_um[0], 7);
  EXPECT_EQ(made, 2);
  EXPECT_NE(told.text.find("warning"), std::string::npos);
  EXPECT_NE(told.text.find(id), std::string::npos);
  cache.find_or_make(id, make);
  EXPECT_EQ(made, 2);
}

TEST(SpeciesCache, DoesNotTakeTheTableOfAnotherRecipe) {
  const ScratchFolder folder;
  Told told;
  const SpeciesCache cache(folder.folder(), told.log());
  const std::string other = "ffffffffffffffffffffffffffffffff";
  cache.find_or_make(id, [] { return isotropic(7); });
  std::filesystem::rename(cache.path_of(id), cache.path_of(other));
  SpeciesFile right = isotropic(8);
  right.recipe_id = other;
  EXPECT_EQ(cache.find_or_make(other, [&] { return right; }).size_um[0], 8);
  EXPECT_NE(told.text.find("another recipe"), std::string::npos);
}

TEST(SpeciesCache, AFolderThatCannotBeWrittenCostsAWarningOnly) {
  const ScratchFolder folder;
  write_whole_file(folder.path("file"), "in the way");
  Told told;
  const SpeciesCache cache(folder.path("file/phase"), told.log());
  EXPECT_EQ(cache.find_or_make(id, [] { return isotropic(7); }).size_um[0], 7);
  EXPECT_NE(told.text.find("warning"), std::string::npos);
}

TEST(SpeciesCache, WithoutAFolderNothingIsKept) {
  int made = 0;
  const SpeciesCache cache("");
  for (int i = 0; i < 2; ++i) cache.find_or_make(id, [&] { return ++made, isotropic(7); });
  EXPECT_EQ(made, 2);
}

TEST(SpeciesCache, AnErrorWhileMakingLeavesNothingBehind) {
  const ScratchFolder folder;
  const SpeciesCache cache(folder.folder());
  EXPECT_THROW(cache.find_or_make(id, []() -> SpeciesFile { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_EQ(files_in(folder.folder()), 0);
}

TEST(SpeciesCache, OfTwoProcessesOneComputesAndTheOtherWaits) {
  const ScratchFolder folder;
  const SpeciesCache cache(folder.folder());
  const auto make_slowly = [&] {
    write_whole_file(folder.path("made-by-" + std::to_string(::getpid())), "");
    ::usleep(300000);
    return isotropic(7);
  };
  const auto in_a_process = [&] {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(cache.find_or_make(id, make_slowly).size_um[0] == 7 ? 0 : 1);
    return child;
  };
  const pid_t children[] = {in_a_process(), in_a_process(), in_a_process()};
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(files_in(folder.folder()), 2);  // the table, and one process that made it
}

TEST(SpeciesCache, WithoutLocksEveryProcessComputesAndNoneWaits) {
  const ScratchFolder folder;
  Told told;
  const SpeciesCache cache(folder.folder(), told.log());
  has_locks = false;
  pid_t children[3];
  for (pid_t& child : children) {
    child = ::fork();
    if (child != 0) continue;
    const bool is_right = cache.find_or_make(id, [] { return ::usleep(200000), isotropic(7); }).size_um[0] == 7;
    ::_exit(is_right && told.text.empty() ? 0 : 1);
  }
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  has_locks = true;
  EXPECT_EQ(files_in(folder.folder()), 1);  // the table; each wrote all of it
  EXPECT_EQ(cache.find_or_make(id, []() -> SpeciesFile { throw std::runtime_error("no"); }).size_um[0], 7);
}

TEST(SpeciesCache, LiesWhereUsersOfLinuxExpectIt) {
  const char* home = std::getenv("HOME");
  const std::string saved_home = home ? home : "";
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const std::string saved_cache = cache ? cache : "";
  ::setenv("HOME", "/users/somebody", 1);
  ::unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(default_cache_folder(), "/users/somebody/.cache/arcus/phase");
  ::setenv("XDG_CACHE_HOME", "/fast", 1);
  EXPECT_EQ(default_cache_folder(), "/fast/arcus/phase");
  ::setenv("XDG_CACHE_HOME", "relative", 1);  // to be ignored: XDG Base Directory Specification
  EXPECT_EQ(default_cache_folder(), "/users/somebody/.cache/arcus/phase");
  ::unsetenv("XDG_CACHE_HOME");
  ::unsetenv("HOME");
  EXPECT_EQ(default_cache_folder(), "");
  if (home) ::setenv("HOME", saved_home.c_str(), 1);
  if (cache) ::setenv("XDG_CACHE_HOME", saved_cache.c_str(), 1);
}

}  // namespace arcus::phase
