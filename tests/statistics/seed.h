#pragma once
// The seed of a statistical test follows from its name: runs repeat, and no two tests share
// numbers. How much work it may take, too, is set from outside.

#include <cstdint>
#include <string>

namespace arcus::statistics {

/// "Suite.Name" of the running test; "outside_a_test" elsewhere.
std::string test_name();

/// Seed of the running test. The environment variable TEST_SEED=n (n ≥ 0) gives all tests other
/// seeds; 0 and unset are the same. `which` tells several streams of one test apart.
/// Throws std::invalid_argument when TEST_SEED is no number.
std::uint64_t test_seed(std::uint64_t which = 0);

/// Share of its usual samples that a statistical test may take: the environment variable TEST_EFFORT=n (n > 0), 1 where unset.
/// Throws std::invalid_argument when TEST_EFFORT is no positive number.
double test_effort();

/// "seed TEST_SEED=n" for messages: what to set to see a failure again.
std::string how_to_repeat();

}  // namespace arcus::statistics
