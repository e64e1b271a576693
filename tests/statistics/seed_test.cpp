#include "tests/statistics/seed.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace arcus::statistics {

namespace {

/// Sets a variable of the environment for the life of the object.
class Sweep {
 public:
  explicit Sweep(const char* value, const char* name = "TEST_SEED") : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  ~Sweep() {
    if (old_)
      setenv(name_, old_->c_str(), 1);
    else
      unsetenv(name_);
  }

 private:
  const char* name_;
  std::optional<std::string> old_;
};

}  // namespace

TEST(Seed, FollowsFromTheNameOfTheTest) {
  const Sweep none("0");
  EXPECT_EQ(test_name(), "Seed.FollowsFromTheNameOfTheTest");
  EXPECT_EQ(test_seed(), 16882539574599828602u);  // the same in every run, on every machine
}

TEST(Seed, DiffersBetweenStreamsOfOneTest) { EXPECT_NE(test_seed(0), test_seed(1)); }

TEST(Seed, IsOverriddenByTheEnvironment) {
  std::uint64_t first = 0, second = 0;
  {
    const Sweep sweep("0");
    first = test_seed();
  }
  {
    const Sweep sweep("17");
    second = test_seed();
    EXPECT_EQ(how_to_repeat(), "TEST_SEED=17");
    EXPECT_EQ(test_seed(), second);
  }
  EXPECT_NE(first, second);
}

TEST(Seed, RefusesWhatIsNoNumber) {
  for (const char* wrong : {"x", "-1", "1.5", " 1"}) {
    const Sweep sweep(wrong);
    EXPECT_THROW(test_seed(), std::invalid_argument) << wrong;
  }
}

TEST(Effort, IsOneUnlessTheEnvironmentSaysElse) {
  {
    const Sweep none("", "TEST_EFFORT");
    EXPECT_EQ(test_effort(), 1);
  }
  {
    const Sweep half("0.5", "TEST_EFFORT");
    EXPECT_EQ(test_effort(), 0.5);
  }
  for (const char* wrong : {"x", "-1", "0", "2x", "nan"}) {
    const Sweep sweep(wrong, "TEST_EFFORT");
    EXPECT_THROW(test_effort(), std::invalid_argument) << wrong;
  }
}

}  // namespace arcus::statistics
