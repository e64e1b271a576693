#include "tests/statistics/seed.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace arcus::statistics {

namespace {

std::uint64_t sweep() {
  const char* text = std::getenv("TEST_SEED");
  if (text == nullptr || *text == 0) return 0;
  const std::string_view view(text);
  std::uint64_t value = 0;
  const auto [end, fault] = std::from_chars(view.begin(), view.end(), value);
  if (fault != std::errc() || end != view.end())
    throw std::invalid_argument("TEST_SEED: " + std::string(view) + " found; expected a number");
  return value;
}

/// Finalizer of splitmix64 (Steele, Lea & Flood, OOPSLA 2014): every input bit moves every output
/// bit.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

std::string test_name() {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  if (test == nullptr) return "outside_a_test";
  return std::string(test->test_suite_name()) + "." + test->name();
}

std::uint64_t test_seed(std::uint64_t which) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a, 64 bits
  for (const char c : test_name()) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return mixed(hash ^ mixed(sweep() ^ mixed(which)));
}

double test_effort() {
  const char* text = std::getenv("TEST_EFFORT");
  if (text == nullptr || *text == 0) return 1;
  const std::string_view view(text);
  double value = 0;
  const auto [end, fault] = std::from_chars(view.begin(), view.end(), value);
  if (fault != std::errc() || end != view.end() || !(value > 0))
    throw std::invalid_argument("TEST_EFFORT: " + std::string(view) + " found; expected a positive number");
  return value;
}

std::string how_to_repeat() { return "TEST_SEED=" + std::to_string(sweep()); }

}  // namespace arcus::statistics
