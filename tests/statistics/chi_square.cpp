#include "tests/statistics/chi_square.h"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "tests/statistics/budget.h"
#include "tests/statistics/report.h"
#include "tests/statistics/seed.h"

namespace arcus::statistics {

namespace {

struct Group {
  std::vector<std::size_t> cells;
  double expected = 0, observed = 0;
  double excess() const { return observed - expected; }
  double share() const { return excess() * excess() / expected; }
};

/// Every cell that expects enough is a group; the others together are one, joined to the smallest
/// group if even together they expect too little.
std::vector<Group> groups_of(std::span<const std::int64_t> counts,
                             std::span<const double> probabilities, double draws) {
  std::vector<Group> groups;
  Group pool;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (probabilities[i] == 0) continue;
    const double expected = draws * probabilities[i], observed = static_cast<double>(counts[i]);
    if (expected >= least_expected) {
      groups.push_back({{i}, expected, observed});
    } else {
      pool.cells.push_back(i);
      pool.expected += expected;
      pool.observed += observed;
    }
  }
  if (pool.cells.empty()) return groups;
  if (pool.expected < least_expected && !groups.empty()) {
    auto& smallest =
        *std::min_element(groups.begin(), groups.end(),
                          [](const Group& a, const Group& b) { return a.expected < b.expected; });
    smallest.cells.insert(smallest.cells.end(), pool.cells.begin(), pool.cells.end());
    smallest.expected += pool.expected;
    smallest.observed += pool.observed;
  } else {
    groups.push_back(pool);
  }
  return groups;
}

}  // namespace

double chi_square_p(double x, double degrees) {
  return std::isinf(x) ? 0 : boost::math::gamma_q(degrees / 2, x / 2);
}

testing::AssertionResult chi_square(std::span<const std::int64_t> counts, std::int64_t outside,
                                    std::span<const double> probabilities,
                                    const std::function<std::string(std::size_t)>& name_of_cell,
                                    int comparisons) {
  const std::int64_t draws = std::accumulate(counts.begin(), counts.end(), outside);
  const double total = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  std::ostringstream text;
  const auto rejected = [&] {
    std::ostringstream table;
    table.precision(12);
    table << "cell,observed,expected\n";
    for (std::size_t i = 0; i < counts.size(); ++i)
      table << '"' << name_of_cell(i) << "\"," << counts[i] << ','
            << static_cast<double>(draws) * probabilities[i] << '\n';
    text << "\n  " << test_name() << ", " << how_to_repeat() << ", cells in "
         << write_report(table.str());
    return testing::AssertionFailure() << text.str();
  };
  if (!(std::fabs(total - 1) <= 1e-4)) {
    text.precision(8);
    text << "the density integrates to " << total << " over its cells, not to 1";
    return rejected();
  }
  if (outside > 0) {
    text << outside << " of " << draws << " draws lie in no cell";
    return rejected();
  }
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (probabilities[i] == 0 && counts[i] > 0) {
      text << counts[i] << " of " << draws << " draws where the density is 0: " << name_of_cell(i);
      return rejected();
    }
  std::vector<Group> groups = groups_of(counts, probabilities, static_cast<double>(draws) / total);
  if (groups.size() < 2) {
    text << draws << " draws fill only " << groups.size() << " cell: nothing can be tested";
    return rejected();
  }
  double x = 0;
  for (const Group& group : groups) x += group.share();
  const double p = chi_square_p(x, static_cast<double>(groups.size() - 1));
  const double level = sidak(false_alarms_per_test, comparisons);
  text << "chi-square " << x << " of " << draws << " draws in " << groups.size() << " cells ("
       << counts.size() << " before pooling), p = " << p << ", rejected below " << level;
  if (p >= level) return testing::AssertionSuccess() << text.str();
  std::sort(groups.begin(), groups.end(),
            [](const Group& a, const Group& b) { return a.share() > b.share(); });
  text << "; worst:";
  for (std::size_t i = 0; i < std::min<std::size_t>(3, groups.size()); ++i) {
    text << "\n  " << name_of_cell(groups[i].cells.front());
    if (groups[i].cells.size() > 1)
      text << " and " << groups[i].cells.size() - 1 << " pooled with it";
    text << ": observed " << groups[i].observed << ", expected " << groups[i].expected;
  }
  return rejected();
}

}  // namespace arcus::statistics
