#pragma once
// Where a rejected comparison leaves its numbers.

#include <string>

namespace arcus::statistics {

/// Writes a CSV named after the running test into the build folder (statistics_reports/) and
/// returns its the n-th report of a test ends in .n.csv. Returns a sentence when it cannot be
/// written.
std::string write_report(const std::string& csv);

}  // namespace arcus::statistics
